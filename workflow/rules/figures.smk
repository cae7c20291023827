# Figures: a rule each, named like its files and its script.
DRAWN = {}


def figure(name, group, shows, data, claims=(), **params):
    """A figure: stems of the datasets that it draws, by input, and what the paper prints of it."""
    files = {key: expand(f"{DATA}/{{stem}}.nc", stem=stems) for key, stems in data.items()}
    own = {"figure": config["figures"][name]} if name in config["figures"] else {}
    compared = {"published": published(*claims)} if claims else {}
    DRAWN[name] = {
        "labels": {"figure": name[3:].partition("_")[0].lstrip("0"), "shows": shows},
        "group": group,
        "data": {
            key: each[0] if isinstance(data[key], str) else each for key, each in files.items()
        },
        "params": own | params | compared,
    }


def bead_figure(name, shows, verb):
    case = config["figures"][name]["case"]
    models = ("lens", "nonlinear")
    figure(
        name,
        "Beads",
        shows,
        {model: f"bead_{case}_{model}" for model in models},
        [f"{verb}-radius-{model}" for model in models],
        case=config["beads"][case],
    )


def materials_of(name):
    return [f"materials_{gel}" for gel in config["figures"][name]["gels"]]


def flow_figure(name, shows, **data):
    views = config["figures"][name]["views"]
    figure(
        name,
        "Tubes",
        shows,
        {"views": [f"tube_flow_{view}" for view in views], **data},
        views={view: config["tube_flow"][view] for view in views},
    )


figure(
    "fig01_lens_schematic",
    "Gel and model",
    "how LENS splits a deformation",
    {"bead": f"bead_{config['figures']['fig01_lens_schematic']['case']}_lens"},
)
figure(
    "fig02_osmotic_schema",
    "Gel and model",
    "osmotic pressure either side of T_C",
    {"material": f"materials_{config['figures']['fig02_osmotic_schema']['gel']}"},
)
bead_figure("fig03_swell_bead", "a bead swells", "swell")
bead_figure("fig04_dry_bead", "a bead dries", "dry")
figure(
    "fig05_spinodal",
    "Beads",
    "beads and the spinodal",
    {
        "material": f"materials_{config['figures']['fig05_spinodal']['gel']}",
        "beads": [f"bead_{case}_lens" for case in config["figures"]["fig05_spinodal"]["cases"]],
    },
    cases={case: config["beads"][case] for case in config["figures"]["fig05_spinodal"]["cases"]},
)
figure("fig06_tube_schematic", "Tubes", "a tube, partly collapsed", {"pulse": "tube_pulse"})
figure(
    "fig07_deswelling",
    "Tubes",
    "tubes heated everywhere at once",
    {"times": "deswelling_map", "curves": "deswelling_curves"},
    ["deswelling-curves"],
    published_times=config["deswelling_curves"]["published_times"],
)
figure(
    "fig08_profiles",
    "Tubes",
    "a pulse of heat travels along a tube",
    {"pulse": "tube_pulse"},
    ["front-fig8"],
)
figure(
    "fig09_relax",
    "Tubes",
    "the drying front and its sharpness",
    {"pulse": "tube_pulse", "fit": "front_fit"},
    ["front-phi", "A-values"],
)
flow_figure("fig10_flow", "flow around the front")
flow_figure("fig11_flow_close", "interstitial flow next to the front", budget="water_budget")
figure(
    "fig12_axial_flow",
    "Tubes",
    "the pulse of water in the lumen",
    {"pulse": "lumen_pulse"},
    ["lumen-peak-height", "lumen-far-nonzero"],
    pulse=config["lumen_pulse"],
)
figure(
    "fig13_osmotic",
    "Gel and model",
    "osmotic pressure of both gels",
    {"materials": materials_of("fig13_osmotic")},
)
figure(
    "fig14_equilibrium",
    "Gel and model",
    "equilibrium polymer fraction",
    {"materials": materials_of("fig14_equilibrium")},
    ["tc-up-anb", "tc-down-anb", "tc-hht"],
)

figure(
    "figX1_conservation",
    "Beyond the paper",
    "whether the wall conserves water, by closure",
    {"balance": "pump_balance", "conserving": "pump_pulse", "printed": "tube_pulse"},
)
figure(
    "figX2_wall",
    "Beyond the paper",
    "how fast a wall resolved in r deswells",
    {"times": "wall_times"},
)
figure(
    "figX4_pump_balance",
    "Beyond the paper",
    "where the water of the pump goes",
    {"balance": "pump_balance", "response": "pump_response"},
)

SEPARATING = next(iter(config["separation"]["drawn"]))
figure(
    "figX5_front",
    "Beyond the paper",
    "a bead that separates, to the end",
    {model: f"separation_{SEPARATING}_{model}" for model in ("nonlinear", "lens")},
)
figure(
    "figX6_coexistence",
    "Beyond the paper",
    "phases that meet at a front",
    {
        "material": f"materials_{config['separation']['coexistence']['gel']}",
        "phases": f"coexistence_{config['separation']['coexistence']['gel']}",
    },
)
figure(
    "figX9_cycle",
    "Beyond the paper",
    "beads and tubes that are heated and cooled again and again",
    {"beads": "cycle_beads", "tube": "cycle_tube"},
    curves={
        case["gel"]: config["gels"][case["gel"]]
        for case in config["cycles"]["beads"]["cases"].values()
    },
)

figure(
    "figX8_heat",
    "Beyond the paper",
    "how far the heat of a collapse holds the front back",
    {"heat": "tube_heat"},
)

FIGURES = expand(
    "results/figures/{figure}.{suffix}", figure=DRAWN, suffix=["pdf", "png", "svg", "csv"]
)

for FIGURE, drawn in DRAWN.items():

    rule:
        name:
            FIGURE
        input:
            **drawn["data"],
            src=modules(FIGURE),
        output:
            pdf=f"results/figures/{FIGURE}.pdf",
            csv=f"results/figures/{FIGURE}.csv",
            svg=f"results/figures/{FIGURE}.svg",
            png=report(
                f"results/figures/{FIGURE}.png",
                caption=f"../report/{FIGURE}.rst",
                category="Figures",
                subcategory=drawn["group"],
                labels=drawn["labels"],
            ),
        log:
            f"results/logs/{FIGURE}.log",
        benchmark:
            f"results/benchmarks/{FIGURE}.tsv"
        params:
            **drawn["params"],
        script:
            f"../scripts/{FIGURE or rule}.py"


FIGURE = None  # the line of a script is read again when a job runs, which knows its rule
