# Cost and growth, measured; not part of a build, since nothing measured repeats to the byte.
import sys

MEASURED_COSTS = "results/benchmarks/performance/measured.json"


rule benchmarks:
    output:
        MEASURED_COSTS,
    log:
        "results/logs/benchmarks.log",
    params:
        python=sys.executable,
    shell:
        "OMP_NUM_THREADS=1 {params.python:q} -m benchmarks measure {output:q} > {log:q} 2>&1"


rule performance:
    input:
        MEASURED_COSTS,
    log:
        "results/logs/performance.log",
    params:
        python=sys.executable,
    shell:
        "{params.python:q} -m benchmarks page {input:q} docs > {log:q} 2>&1"
