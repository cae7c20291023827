"""Rule report_page: everything that was found, on one page."""

from _helpers import job

with job(snakemake) as provenance:
    from pathlib import Path

    from gelpump import netcdf
    from gelpump.design import read
    from gelpump.report import embedded, page
    from gelpump.report.content import gather
    from gelpump.report.designer import designer
    from gelpump.text import write_text

    params, files = snakemake.params, snakemake.input
    content = gather(params.config, params.figures, params.tables, provenance.inputs)
    cases = params.config["beads"]
    literature = {
        name: (block, file)
        for file in files.literature
        for name, block in read(file)["gels"].items()
        if name not in params.config["gels"]
    }
    files_of = {case: f"bead_{case}" for case in cases}
    for case in params.config["separation"]["drawn"]:
        files_of[f"{case}, to the end"] = f"separation_{case}"
        cases = cases | {f"{case}, to the end": cases[case] | {"published_times": []}}
    explorers = {
        "tube": embedded.tubes(
            netcdf.read(files.pulse), netcdf.read(files.fit), netcdf.read(files.conserving)
        ),
        "beads": embedded.beads(
            {
                case: {
                    model: netcdf.read(f"results/data/{stem}_{model}.nc")
                    for model in ("lens", "nonlinear")
                }
                for case, stem in files_of.items()
            },
            cases,
            params.published,
        ),
        "gels": {
            Path(file).stem.removeprefix("materials_"): embedded.gel(netcdf.read(file))
            for file in files.materials
        },
        "design": designer(
            params.config["gels"] | {name: block for name, (block, _) in literature.items()},
            {Path(file).stem: read(file) for file in files.designs},
            {name: file for name, (_, file) in literature.items()},
        ),
    }
    output = Path(snakemake.output[0])
    write_text(page.render(content, explorers, output.parent), output)
