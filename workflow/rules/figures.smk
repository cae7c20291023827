# Figures: one rule each, named like its files.

FIGURES = expand(
    "results/figures/{figure}.{suffix}",
    figure=[
        "fig01_lens_schematic",
        "fig02_osmotic_schema",
        "fig03_swell_bead",
        "fig04_dry_bead",
        "fig05_spinodal",
        "fig13_osmotic",
        "fig14_equilibrium",
    ],
    suffix=["pdf", "png", "svg"],
)


rule fig01_lens_schematic:
    input:
        bead=f"{DATA}/bead_{config['figures']['fig01_lens_schematic']['case']}_lens.nc",
        src=modules("netcdf", "figures/__init__", "figures/style", "figures/fig01_lens_schematic"),
    output:
        pdf="results/figures/fig01_lens_schematic.pdf",
        svg="results/figures/fig01_lens_schematic.svg",
        png=report(
            "results/figures/fig01_lens_schematic.png",
            caption="../report/fig01_lens_schematic.rst",
            category="Figures",
        ),
    log:
        "results/logs/fig01_lens_schematic.log",
    benchmark:
        "results/benchmarks/fig01_lens_schematic.tsv"
    params:
        figure=config["figures"]["fig01_lens_schematic"],
    script:
        "../scripts/fig01_lens_schematic.py"


rule fig02_osmotic_schema:
    input:
        material=f"{DATA}/materials_{config['figures']['fig02_osmotic_schema']['gel']}.nc",
        src=modules("netcdf", "figures/__init__", "figures/style", "figures/fig02_osmotic_schema"),
    output:
        pdf="results/figures/fig02_osmotic_schema.pdf",
        svg="results/figures/fig02_osmotic_schema.svg",
        png=report(
            "results/figures/fig02_osmotic_schema.png",
            caption="../report/fig02_osmotic_schema.rst",
            category="Figures",
        ),
    log:
        "results/logs/fig02_osmotic_schema.log",
    benchmark:
        "results/benchmarks/fig02_osmotic_schema.tsv"
    params:
        figure=config["figures"]["fig02_osmotic_schema"],
    script:
        "../scripts/fig02_osmotic_schema.py"


rule fig03_swell_bead:
    input:
        lens=f"{DATA}/bead_{config['figures']['fig03_swell_bead']['case']}_lens.nc",
        nonlinear=f"{DATA}/bead_{config['figures']['fig03_swell_bead']['case']}_nonlinear.nc",
        src=modules(
            "netcdf",
            "figures/__init__",
            "figures/style",
            "figures/bead_panels",
            "figures/fig03_swell_bead",
        ),
    output:
        pdf="results/figures/fig03_swell_bead.pdf",
        svg="results/figures/fig03_swell_bead.svg",
        png=report(
            "results/figures/fig03_swell_bead.png",
            caption="../report/fig03_swell_bead.rst",
            category="Figures",
        ),
    log:
        "results/logs/fig03_swell_bead.log",
    benchmark:
        "results/benchmarks/fig03_swell_bead.tsv"
    params:
        figure=config["figures"]["fig03_swell_bead"],
        case=config["beads"][config["figures"]["fig03_swell_bead"]["case"]],
        published=published("swell-radius-lens", "swell-radius-nonlinear"),
    script:
        "../scripts/fig03_swell_bead.py"


rule fig04_dry_bead:
    input:
        lens=f"{DATA}/bead_{config['figures']['fig04_dry_bead']['case']}_lens.nc",
        nonlinear=f"{DATA}/bead_{config['figures']['fig04_dry_bead']['case']}_nonlinear.nc",
        src=modules(
            "netcdf",
            "figures/__init__",
            "figures/style",
            "figures/bead_panels",
            "figures/fig04_dry_bead",
        ),
    output:
        pdf="results/figures/fig04_dry_bead.pdf",
        svg="results/figures/fig04_dry_bead.svg",
        png=report(
            "results/figures/fig04_dry_bead.png",
            caption="../report/fig04_dry_bead.rst",
            category="Figures",
        ),
    log:
        "results/logs/fig04_dry_bead.log",
    benchmark:
        "results/benchmarks/fig04_dry_bead.tsv"
    params:
        figure=config["figures"]["fig04_dry_bead"],
        case=config["beads"][config["figures"]["fig04_dry_bead"]["case"]],
        published=published("dry-radius-lens", "dry-radius-nonlinear"),
    script:
        "../scripts/fig04_dry_bead.py"


rule fig05_spinodal:
    input:
        material=f"{DATA}/materials_{config['figures']['fig05_spinodal']['gel']}.nc",
        beads=expand(
            f"{DATA}/bead_{{case}}_lens.nc", case=config["figures"]["fig05_spinodal"]["cases"]
        ),
        src=modules("netcdf", "figures/__init__", "figures/style", "figures/fig05_spinodal"),
    output:
        pdf="results/figures/fig05_spinodal.pdf",
        svg="results/figures/fig05_spinodal.svg",
        png=report(
            "results/figures/fig05_spinodal.png",
            caption="../report/fig05_spinodal.rst",
            category="Figures",
        ),
    log:
        "results/logs/fig05_spinodal.log",
    benchmark:
        "results/benchmarks/fig05_spinodal.tsv"
    params:
        figure=config["figures"]["fig05_spinodal"],
        cases={case: config["beads"][case] for case in config["figures"]["fig05_spinodal"]["cases"]},
    script:
        "../scripts/fig05_spinodal.py"


rule fig13_osmotic:
    input:
        materials=expand(
            f"{DATA}/materials_{{gel}}.nc", gel=config["figures"]["fig13_osmotic"]["gels"]
        ),
        src=modules("netcdf", "figures/__init__", "figures/style", "figures/fig13_osmotic"),
    output:
        pdf="results/figures/fig13_osmotic.pdf",
        svg="results/figures/fig13_osmotic.svg",
        png=report(
            "results/figures/fig13_osmotic.png",
            caption="../report/fig13_osmotic.rst",
            category="Figures",
        ),
    log:
        "results/logs/fig13_osmotic.log",
    benchmark:
        "results/benchmarks/fig13_osmotic.tsv"
    params:
        figure=config["figures"]["fig13_osmotic"],
    script:
        "../scripts/fig13_osmotic.py"


rule fig14_equilibrium:
    input:
        materials=expand(
            f"{DATA}/materials_{{gel}}.nc", gel=config["figures"]["fig14_equilibrium"]["gels"]
        ),
        src=modules("netcdf", "figures/__init__", "figures/style", "figures/fig14_equilibrium"),
    output:
        pdf="results/figures/fig14_equilibrium.pdf",
        svg="results/figures/fig14_equilibrium.svg",
        png=report(
            "results/figures/fig14_equilibrium.png",
            caption="../report/fig14_equilibrium.rst",
            category="Figures",
        ),
    log:
        "results/logs/fig14_equilibrium.log",
    benchmark:
        "results/benchmarks/fig14_equilibrium.tsv"
    params:
        figure=config["figures"]["fig14_equilibrium"],
        published=published("tc-up-anb", "tc-down-anb", "tc-hht"),
    script:
        "../scripts/fig14_equilibrium.py"
