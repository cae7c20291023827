"""Rule cross_check: the FiPy solutions against those of the second solvers."""

from _helpers import job

with job(snakemake):
    from gelpump import netcdf
    from gelpump.second_solvers import cross_check
    from gelpump.text import write_json, write_text

    data = netcdf.read_all(snakemake.input.data, "results/data")
    bounds = snakemake.params.bounds
    rows = []
    for bead in snakemake.params.beads:
        solutions = data[bead], data[f"refinement/{bead}"], data[f"second/{bead}"]
        _, case, model = bead.split("_")
        rows += cross_check.bead_rows(f"{case}, {cross_check.MODELS[model]}", *solutions, bounds)
    tubes = data["tube_pulse"], data["refinement/tube_pulse"], data["second/tube_pulse"]
    rows += cross_check.tube_rows(*tubes, bounds["Phi1"])
    print(cross_check.markdown(rows))
    cross_check.require_agreement(rows)
    write_json(rows, snakemake.output.json)
    write_text(cross_check.markdown(rows), snakemake.output.md)
