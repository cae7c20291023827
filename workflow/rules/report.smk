# The report: everything that was found, on one page that needs no network.

TOLD_FIGURES = {Path(file).stem: told(Path(file).stem) for file in FIGURES if file.endswith(".png")}
TOLD_FIGURES["verification"] = told("verification")
TOLD_TABLES = {Path(file).stem: told(Path(file).stem) for file in TABLES if file.endswith(".csv")}
LINEAR_IN_T = [name for name in ENERGY_GELS if config["gels"][name]["model"] == "energy-based"]
PAGE_TEMPLATES = sorted(map(str, Path("src/gelpump/report/templates").glob("*.*")))

LITERATURE = sorted(map(str, Path("config/gels").glob("*.yaml")))


rule report_page:
    input:
        verdicts=[
            *rules.statements.output,
            *CHECKS,
        ],
        data=[
            *(
                file
                for file in [*MATERIALS, *BEADS, *FRONTS, *TUBES, *SENSITIVITIES]
                if file not in CHECKS
            )
        ],
        pulse=f"{DATA}/tube_pulse.nc",
        fit=f"{DATA}/front_fit.nc",
        conserving=f"{DATA}/pump_pulse.nc",
        materials=expand(f"{DATA}/materials_{{gel}}.nc", gel=LINEAR_IN_T),
        drawings=[*FIGURES, *TABLES],
        captions=[told["caption"] for told in [*TOLD_FIGURES.values(), *TOLD_TABLES.values()]],
        templates=PAGE_TEMPLATES,
        designs=[f"config/designs/{name}.yaml" for name in ("microtube", "millitube")],
        literature=LITERATURE,
        told=["CITATION.cff", "workflow/reference/seconds.json"],
        src=modules("report_page"),
    output:
        "results/report.html",
    log:
        "results/logs/report_page.log",
    benchmark:
        "results/benchmarks/report_page.tsv"
    params:
        config=config,
        figures=TOLD_FIGURES,
        tables=TOLD_TABLES,
        published={case: radii_read_off(case) for case in config["beads"]},
    script:
        "../scripts/report_page.py"
