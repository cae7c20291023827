# Tubes that deswell uniformly (section 3.4) or behind a pulse of heat (sections 3.5 and 3.6).

TUBES = expand(
    f"{DATA}/{{dataset}}.nc",
    dataset=[
        "deswelling_map",
        "deswelling_curves",
        "tube_pulse",
        "refinement/tube_pulse",
        "front_fit",
        "water_budget",
        "lumen_pulse",
        "pump_balance",
        "pump_pulse",
        "pump_response",
        "tube_heat",
        "wall_times",
        "cycle_tube",
        *(f"tube_flow_{view}" for view in config["tube_flow"]),
    ],
)


rule deswelling_map:
    input:
        src=modules("deswelling_map"),
    output:
        f"{DATA}/deswelling_map.nc",
    log:
        "results/logs/deswelling_map.log",
    benchmark:
        "results/benchmarks/deswelling_map.tsv"
    params:
        gel=tube_gel,
        tube=config["tube"],
        settings=config["deswelling_map"],
    script:
        "../scripts/deswelling_map.py"


rule deswelling_curves:
    input:
        src=modules("deswelling_curves"),
    output:
        f"{DATA}/deswelling_curves.nc",
    log:
        "results/logs/deswelling_curves.log",
    benchmark:
        "results/benchmarks/deswelling_curves.tsv"
    params:
        gel=tube_gel,
        tube=config["tube"],
        settings=config["deswelling_curves"],
    script:
        "../scripts/deswelling_curves.py"


rule tube_pulse:
    input:
        src=modules("tube_pulse"),
    output:
        f"{DATA}/tube_pulse.nc",
    log:
        "results/logs/tube_pulse.log",
    benchmark:
        "results/benchmarks/tube_pulse.tsv"
    priority: 3
    params:
        gel=tube_gel,
        tube=config["tube"],
        settings=config["tube_pulse"],
        numerics=config["numerics"]["tube_pulse"],
    script:
        "../scripts/tube_pulse.py"


rule refine_tube_pulse:
    input:
        pulse=f"{DATA}/tube_pulse.nc",
        src=modules("refine_tube_pulse"),
    output:
        f"{DATA}/refinement/tube_pulse.nc",
    log:
        "results/logs/refine_tube_pulse.log",
    benchmark:
        "results/benchmarks/refine_tube_pulse.tsv"
    priority: 3
    params:
        gel=tube_gel,
        tube=config["tube"],
        numerics=config["numerics"]["tube_pulse"],
        subset=config["numerics"]["refine_tube_pulse"],
    script:
        "../scripts/refine_tube_pulse.py"


rule front_fit:
    input:
        pulse=f"{DATA}/tube_pulse.nc",
        refinement=f"{DATA}/refinement/tube_pulse.nc",
        src=modules("front_fit"),
    output:
        f"{DATA}/front_fit.nc",
    log:
        "results/logs/front_fit.log",
    benchmark:
        "results/benchmarks/front_fit.tsv"
    priority: 3
    params:
        settings=config["front_fit"],
    script:
        "../scripts/front_fit.py"


rule tube_flow:
    input:
        pulse=f"{DATA}/tube_pulse.nc",
        src=modules("tube_flow"),
    output:
        expand(f"{DATA}/tube_flow_{{view}}.nc", view=config["tube_flow"]),
    log:
        "results/logs/tube_flow.log",
    benchmark:
        "results/benchmarks/tube_flow.tsv"
    params:
        views=config["tube_flow"],
    script:
        "../scripts/tube_flow.py"


rule water_budget:
    input:
        pulse=f"{DATA}/tube_pulse.nc",
        src=modules("water_budget"),
    output:
        f"{DATA}/water_budget.nc",
    log:
        "results/logs/water_budget.log",
    benchmark:
        "results/benchmarks/water_budget.tsv"
    script:
        "../scripts/water_budget.py"


rule lumen_pulse:
    input:
        pulse=f"{DATA}/tube_pulse.nc",
        fit=f"{DATA}/front_fit.nc",
        src=modules("lumen_pulse"),
    output:
        f"{DATA}/lumen_pulse.nc",
    log:
        "results/logs/lumen_pulse.log",
    benchmark:
        "results/benchmarks/lumen_pulse.tsv"
    priority: 3
    params:
        gel=tube_gel,
        tube=config["tube"],
        settings=config["lumen_pulse"],
    script:
        "../scripts/lumen_pulse.py"


# Beyond the paper: tubes that conserve water, and walls resolved in r.
rule pump_balance:
    input:
        src=modules("pump_balance"),
    output:
        balance=f"{DATA}/pump_balance.nc",
        pulse=f"{DATA}/pump_pulse.nc",
        response=f"{DATA}/pump_response.nc",
    log:
        "results/logs/pump_balance.log",
    benchmark:
        "results/benchmarks/pump_balance.tsv"
    priority: 2
    params:
        gel=tube_gel,
        tube=config["tube"],
        pulse=config["tube_pulse"],
        response=config["pump_response"],
        numerics=config["numerics"]["pump_balance"],
    script:
        "../scripts/pump_balance.py"


rule tube_heat:
    input:
        src=modules("tube_heat"),
    output:
        f"{DATA}/tube_heat.nc",
    log:
        "results/logs/tube_heat.log",
    benchmark:
        "results/benchmarks/tube_heat.tsv"
    priority: 2
    params:
        gel=tube_gel,
        tube=config["tube"],
        settings=config["tube_heat"],
        numerics=config["numerics"]["tube_heat"],
    script:
        "../scripts/tube_heat.py"


rule wall_times:
    input:
        src=modules("wall_times"),
    output:
        f"{DATA}/wall_times.nc",
    log:
        "results/logs/wall_times.log",
    benchmark:
        "results/benchmarks/wall_times.tsv"
    priority: 2
    params:
        gel=tube_gel,
        tube=config["tube"],
        settings=config["wall_times"],
    script:
        "../scripts/wall_times.py"


rule cycle_tube:
    input:
        src=modules("cycle_tube"),
    output:
        f"{DATA}/cycle_tube.nc",
    log:
        "results/logs/cycle_tube.log",
    benchmark:
        "results/benchmarks/cycle_tube.tsv"
    priority: 2
    params:
        gel=tube_gel,
        tube=config["tube"],
        settings=config["cycles"]["tube"],
        numerics=config["cycles"]["numerics"],
    script:
        "../scripts/cycle_tube.py"
