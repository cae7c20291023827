# Figures: one rule each, named like its files.

FIGURES = expand(
    "results/figures/{figure}.{suffix}",
    figure=[
        "fig01_lens_schematic",
        "fig02_osmotic_schema",
        "fig03_swell_bead",
        "fig04_dry_bead",
        "fig05_spinodal",
        "fig06_tube_schematic",
        "fig07_deswelling",
        "fig08_profiles",
        "fig09_relax",
        "fig10_flow",
        "fig11_flow_close",
        "fig12_axial_flow",
        "fig13_osmotic",
        "fig14_equilibrium",
        "figX1_conservation",
        "figX2_wall",
        "figX4_pump_balance",
    ],
    suffix=["pdf", "png", "svg", "csv"],
)


rule fig01_lens_schematic:
    input:
        bead=f"{DATA}/bead_{config['figures']['fig01_lens_schematic']['case']}_lens.nc",
        src=modules("fig01_lens_schematic"),
    output:
        pdf="results/figures/fig01_lens_schematic.pdf",
        csv="results/figures/fig01_lens_schematic.csv",
        svg="results/figures/fig01_lens_schematic.svg",
        png=report(
            "results/figures/fig01_lens_schematic.png",
            caption="../report/fig01_lens_schematic.rst",
            category="Figures",
            subcategory="Gel and model",
            labels={"figure": "1", "shows": "how LENS splits a deformation"},
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
        src=modules("fig02_osmotic_schema"),
    output:
        pdf="results/figures/fig02_osmotic_schema.pdf",
        csv="results/figures/fig02_osmotic_schema.csv",
        svg="results/figures/fig02_osmotic_schema.svg",
        png=report(
            "results/figures/fig02_osmotic_schema.png",
            caption="../report/fig02_osmotic_schema.rst",
            category="Figures",
            subcategory="Gel and model",
            labels={"figure": "2", "shows": "osmotic pressure either side of T_C"},
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
        src=modules("fig03_swell_bead"),
    output:
        pdf="results/figures/fig03_swell_bead.pdf",
        csv="results/figures/fig03_swell_bead.csv",
        svg="results/figures/fig03_swell_bead.svg",
        png=report(
            "results/figures/fig03_swell_bead.png",
            caption="../report/fig03_swell_bead.rst",
            category="Figures",
            subcategory="Beads",
            labels={"figure": "3", "shows": "a bead swells"},
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
        src=modules("fig04_dry_bead"),
    output:
        pdf="results/figures/fig04_dry_bead.pdf",
        csv="results/figures/fig04_dry_bead.csv",
        svg="results/figures/fig04_dry_bead.svg",
        png=report(
            "results/figures/fig04_dry_bead.png",
            caption="../report/fig04_dry_bead.rst",
            category="Figures",
            subcategory="Beads",
            labels={"figure": "4", "shows": "a bead dries"},
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
        src=modules("fig05_spinodal"),
    output:
        pdf="results/figures/fig05_spinodal.pdf",
        csv="results/figures/fig05_spinodal.csv",
        svg="results/figures/fig05_spinodal.svg",
        png=report(
            "results/figures/fig05_spinodal.png",
            caption="../report/fig05_spinodal.rst",
            category="Figures",
            subcategory="Beads",
            labels={"figure": "5", "shows": "beads and the spinodal"},
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


rule fig06_tube_schematic:
    input:
        pulse=f"{DATA}/tube_pulse.nc",
        src=modules("fig06_tube_schematic"),
    output:
        pdf="results/figures/fig06_tube_schematic.pdf",
        csv="results/figures/fig06_tube_schematic.csv",
        svg="results/figures/fig06_tube_schematic.svg",
        png=report(
            "results/figures/fig06_tube_schematic.png",
            caption="../report/fig06_tube_schematic.rst",
            category="Figures",
            subcategory="Tubes",
            labels={"figure": "6", "shows": "a tube, partly collapsed"},
        ),
    log:
        "results/logs/fig06_tube_schematic.log",
    benchmark:
        "results/benchmarks/fig06_tube_schematic.tsv"
    params:
        figure=config["figures"]["fig06_tube_schematic"],
    script:
        "../scripts/fig06_tube_schematic.py"


rule fig07_deswelling:
    input:
        times=f"{DATA}/deswelling_map.nc",
        curves=f"{DATA}/deswelling_curves.nc",
        src=modules("fig07_deswelling"),
    output:
        pdf="results/figures/fig07_deswelling.pdf",
        csv="results/figures/fig07_deswelling.csv",
        svg="results/figures/fig07_deswelling.svg",
        png=report(
            "results/figures/fig07_deswelling.png",
            caption="../report/fig07_deswelling.rst",
            category="Figures",
            subcategory="Tubes",
            labels={"figure": "7", "shows": "tubes heated everywhere at once"},
        ),
    log:
        "results/logs/fig07_deswelling.log",
    benchmark:
        "results/benchmarks/fig07_deswelling.tsv"
    params:
        published_times=config["deswelling_curves"]["published_times"],
        published=published("deswelling-curves"),
    script:
        "../scripts/fig07_deswelling.py"


rule fig08_profiles:
    input:
        pulse=f"{DATA}/tube_pulse.nc",
        src=modules("fig08_profiles"),
    output:
        pdf="results/figures/fig08_profiles.pdf",
        csv="results/figures/fig08_profiles.csv",
        svg="results/figures/fig08_profiles.svg",
        png=report(
            "results/figures/fig08_profiles.png",
            caption="../report/fig08_profiles.rst",
            category="Figures",
            subcategory="Tubes",
            labels={"figure": "8", "shows": "a pulse of heat travels along a tube"},
        ),
    log:
        "results/logs/fig08_profiles.log",
    benchmark:
        "results/benchmarks/fig08_profiles.tsv"
    params:
        figure=config["figures"]["fig08_profiles"],
        published=published("front-fig8"),
    script:
        "../scripts/fig08_profiles.py"


rule fig09_relax:
    input:
        pulse=f"{DATA}/tube_pulse.nc",
        fit=f"{DATA}/front_fit.nc",
        src=modules("fig09_relax"),
    output:
        pdf="results/figures/fig09_relax.pdf",
        csv="results/figures/fig09_relax.csv",
        svg="results/figures/fig09_relax.svg",
        png=report(
            "results/figures/fig09_relax.png",
            caption="../report/fig09_relax.rst",
            category="Figures",
            subcategory="Tubes",
            labels={"figure": "9", "shows": "the drying front and its sharpness"},
        ),
    log:
        "results/logs/fig09_relax.log",
    benchmark:
        "results/benchmarks/fig09_relax.tsv"
    params:
        figure=config["figures"]["fig09_relax"],
        published=published("front-phi", "A-values"),
    script:
        "../scripts/fig09_relax.py"


rule fig10_flow:
    input:
        views=expand(f"{DATA}/tube_flow_{{view}}.nc", view=config["figures"]["fig10_flow"]["views"]),
        src=modules("fig10_flow"),
    output:
        pdf="results/figures/fig10_flow.pdf",
        csv="results/figures/fig10_flow.csv",
        svg="results/figures/fig10_flow.svg",
        png=report(
            "results/figures/fig10_flow.png",
            caption="../report/fig10_flow.rst",
            category="Figures",
            subcategory="Tubes",
            labels={"figure": "10", "shows": "flow around the front"},
        ),
    log:
        "results/logs/fig10_flow.log",
    benchmark:
        "results/benchmarks/fig10_flow.tsv"
    params:
        figure=config["figures"]["fig10_flow"],
        views={view: config["tube_flow"][view] for view in config["figures"]["fig10_flow"]["views"]},
    script:
        "../scripts/fig10_flow.py"


rule fig11_flow_close:
    input:
        views=expand(
            f"{DATA}/tube_flow_{{view}}.nc", view=config["figures"]["fig11_flow_close"]["views"]
        ),
        budget=f"{DATA}/water_budget.nc",
        src=modules("fig11_flow_close"),
    output:
        pdf="results/figures/fig11_flow_close.pdf",
        csv="results/figures/fig11_flow_close.csv",
        svg="results/figures/fig11_flow_close.svg",
        png=report(
            "results/figures/fig11_flow_close.png",
            caption="../report/fig11_flow_close.rst",
            category="Figures",
            subcategory="Tubes",
            labels={"figure": "11", "shows": "interstitial flow next to the front"},
        ),
    log:
        "results/logs/fig11_flow_close.log",
    benchmark:
        "results/benchmarks/fig11_flow_close.tsv"
    params:
        figure=config["figures"]["fig11_flow_close"],
        views={
            view: config["tube_flow"][view]
            for view in config["figures"]["fig11_flow_close"]["views"]
        },
    script:
        "../scripts/fig11_flow_close.py"


rule fig12_axial_flow:
    input:
        pulse=f"{DATA}/lumen_pulse.nc",
        src=modules("fig12_axial_flow"),
    output:
        pdf="results/figures/fig12_axial_flow.pdf",
        csv="results/figures/fig12_axial_flow.csv",
        svg="results/figures/fig12_axial_flow.svg",
        png=report(
            "results/figures/fig12_axial_flow.png",
            caption="../report/fig12_axial_flow.rst",
            category="Figures",
            subcategory="Tubes",
            labels={"figure": "12", "shows": "the pulse of water in the lumen"},
        ),
    log:
        "results/logs/fig12_axial_flow.log",
    benchmark:
        "results/benchmarks/fig12_axial_flow.tsv"
    params:
        pulse=config["lumen_pulse"],
        published=published("lumen-peak-height", "lumen-far-nonzero"),
    script:
        "../scripts/fig12_axial_flow.py"


rule fig13_osmotic:
    input:
        materials=expand(
            f"{DATA}/materials_{{gel}}.nc", gel=config["figures"]["fig13_osmotic"]["gels"]
        ),
        src=modules("fig13_osmotic"),
    output:
        pdf="results/figures/fig13_osmotic.pdf",
        csv="results/figures/fig13_osmotic.csv",
        svg="results/figures/fig13_osmotic.svg",
        png=report(
            "results/figures/fig13_osmotic.png",
            caption="../report/fig13_osmotic.rst",
            category="Figures",
            subcategory="Gel and model",
            labels={"figure": "13", "shows": "osmotic pressure of both gels"},
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
        src=modules("fig14_equilibrium"),
    output:
        pdf="results/figures/fig14_equilibrium.pdf",
        csv="results/figures/fig14_equilibrium.csv",
        svg="results/figures/fig14_equilibrium.svg",
        png=report(
            "results/figures/fig14_equilibrium.png",
            caption="../report/fig14_equilibrium.rst",
            category="Figures",
            subcategory="Gel and model",
            labels={"figure": "14", "shows": "equilibrium polymer fraction"},
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


rule figX1_conservation:
    input:
        balance=f"{DATA}/pump_balance.nc",
        conserving=f"{DATA}/pump_pulse.nc",
        printed=f"{DATA}/tube_pulse.nc",
        src=modules("figX1_conservation"),
    output:
        pdf="results/figures/figX1_conservation.pdf",
        csv="results/figures/figX1_conservation.csv",
        svg="results/figures/figX1_conservation.svg",
        png=report(
            "results/figures/figX1_conservation.png",
            caption="../report/figX1_conservation.rst",
            category="Figures",
            subcategory="Beyond the paper",
            labels={"figure": "X1", "shows": "whether the wall conserves water, by closure"},
        ),
    log:
        "results/logs/figX1_conservation.log",
    benchmark:
        "results/benchmarks/figX1_conservation.tsv"
    params:
        figure=config["figures"]["figX1_conservation"],
    script:
        "../scripts/figX1_conservation.py"


rule figX2_wall:
    input:
        times=f"{DATA}/wall_times.nc",
        src=modules("figX2_wall"),
    output:
        pdf="results/figures/figX2_wall.pdf",
        csv="results/figures/figX2_wall.csv",
        svg="results/figures/figX2_wall.svg",
        png=report(
            "results/figures/figX2_wall.png",
            caption="../report/figX2_wall.rst",
            category="Figures",
            subcategory="Beyond the paper",
            labels={"figure": "X2", "shows": "how fast a wall resolved in r deswells"},
        ),
    log:
        "results/logs/figX2_wall.log",
    benchmark:
        "results/benchmarks/figX2_wall.tsv"
    script:
        "../scripts/figX2_wall.py"


rule figX4_pump_balance:
    input:
        balance=f"{DATA}/pump_balance.nc",
        response=f"{DATA}/pump_response.nc",
        src=modules("figX4_pump_balance"),
    output:
        pdf="results/figures/figX4_pump_balance.pdf",
        csv="results/figures/figX4_pump_balance.csv",
        svg="results/figures/figX4_pump_balance.svg",
        png=report(
            "results/figures/figX4_pump_balance.png",
            caption="../report/figX4_pump_balance.rst",
            category="Figures",
            subcategory="Beyond the paper",
            labels={"figure": "X4", "shows": "where the water of the pump goes"},
        ),
    log:
        "results/logs/figX4_pump_balance.log",
    benchmark:
        "results/benchmarks/figX4_pump_balance.tsv"
    params:
        figure=config["figures"]["figX4_pump_balance"],
    script:
        "../scripts/figX4_pump_balance.py"
