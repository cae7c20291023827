"""Rule record_truth: keep the numbers of the last `pump_truth` with the project."""

from _helpers import job

with job(snakemake):
    import csv
    import os
    from pathlib import Path

    from gelpump import netcdf
    from gelpump.truth import record

    def taken(rule):
        with open(f"results/benchmarks/{rule}.tsv", encoding="utf-8") as file:
            row = next(csv.DictReader(file, delimiter="\t"))
        return {"wall_seconds": float(row["s"]), "cpu_seconds": float(row["cpu_time"])}

    folder = snakemake.params.folder
    rules = [name if name == "slenderness" else f"truth_{name}" for name in record.DATASETS]
    run = {"processors": os.cpu_count(), "jobs": {rule: taken(rule) for rule in rules}}
    data = {name: netcdf.read(Path(folder, f"{name}.nc")) for name in record.DATASETS}
    record.write(data, run, snakemake.params.record)
