"""The scripts of the page's designer against Python, in a real browser: one design at a time."""

import json

import numpy as np
import pytest
import yaml

from gelpump.design import checked, device, late, validity
from gelpump.report import designer
from gelpump.report.page import ENGINE, TEMPLATES

pytestmark = pytest.mark.browser

COUNT = 150
GELS = {
    "HHT": dict(model="energy-based", A0=-62.22, A1=-58.28, B0=0.20470, B1=0.19044, Omega=720.0,
                temperature_range=[290.0, 320.0]),
    "ANB": dict(model="energy-based", A0=-12.947, A1=17.92, B0=0.04496, B1=-0.0569, Omega=100.0,
                temperature_range=[290.0, 320.0]),
    "linear": dict(model="piecewise-linear", Phi_inf=2.0, Pi_ratio=1.0, M=1.0),
}  # fmt: skip


@pytest.fixture(scope="module")
def project():
    from pathlib import Path

    return Path(__file__).parents[2]


@pytest.fixture(scope="module")
def gels(project):
    """The gels of table 2 and those of the literature that have no file of points."""
    found = dict(GELS)
    for file in (project / "config/gels").glob("*.yaml"):
        for name, block in yaml.safe_load(file.read_text(encoding="utf-8"))["gels"].items():
            if block.get("model") == "flory-rehner":
                found[name] = block
    return found


@pytest.fixture(scope="module")
def told(project, gels):
    files = (project / f"config/designs/{name}.yaml" for name in ("microtube", "millitube"))
    blocks = {file.stem: yaml.safe_load(file.read_text(encoding="utf-8")) for file in files}
    return designer.designer(gels, blocks)


@pytest.fixture(scope="module")
def engine(chromium, told):
    """What the page's own scripts, alone on an empty page, make of designs."""
    scripts = "\n".join((TEMPLATES / f"{name}.js").read_text("utf-8") for name in ENGINE)

    def run(designs):
        chromium.get("about:blank")
        return chromium.execute_script(
            f"""const data = {{ design: {json.dumps(told)} }};
            const printed = String;
            {scripts}
            const started = performance.now();
            const found = arguments[0].map((given) => {{
              try {{
                const {{ numbers, lights }} = evaluate(given);
                return {{ numbers, lights }};
              }} catch (refusal) {{
                return {{ refusal: refusal.message }};
              }}
            }});
            return [found, (performance.now() - started) / found.length];""",
            designs,
        )

    return run


def drawn(rng, gels):
    """A design at random, as given to either, SI units."""
    names = ["own", "own", *gels]
    name = names[rng.integers(len(names))]
    a_1 = 10 ** rng.uniform(-5, -2.5)
    given = {
        "a_0": a_1 * rng.uniform(0.05, 0.95),
        "a_1": a_1,
        "heated_length": a_1 * 10 ** rng.uniform(0.4, 2.0),
        "gel": str(name),
        "permeability": 10 ** rng.uniform(-18.5, -14),
        "viscosity": 10 ** rng.uniform(-3.3, -2),
        "thermal_diffusivity": 10 ** rng.uniform(-7.2, -6.5),
        "critical_temperature": 305.0,
        "heating_step": rng.uniform(0.2, 3.0),
        "density": 1000.0,
        "molecule_volume": 3e-29,
    }
    if name == "own":
        modulus, phi = 10 ** rng.uniform(2, 5.5), rng.uniform(0.01, 0.12)
        given |= {
            "osmotic_modulus": modulus,
            "osmotic_modulus_hot": modulus * 10 ** rng.uniform(-1, 1),
            "shear_modulus": modulus * 10 ** rng.uniform(-1.5, 1),
            "polymer_fraction": phi,
            "polymer_fraction_hot": phi * rng.uniform(0.9, 8),
        }
    elif gels[name]["model"] == "piecewise-linear":
        given["osmotic_modulus"] = 10 ** rng.uniform(2, 5.5)
    else:
        low, high = gels[name].get("temperature_range", (290.0, 320.0))
        given["critical_temperature"] = rng.uniform(low, high)
    return given


SI = {
    "a_0": "m",
    "a_1": "m",
    "heated_length": "m",
    "permeability": "m^2",
    "viscosity": "Pa*s",
    "thermal_diffusivity": "m^2/s",
    "critical_temperature": "K",
    "heating_step": "K",
    "density": "kg/m^3",
    "molecule_volume": "m^3",
    "osmotic_modulus": "Pa",
    "osmotic_modulus_hot": "Pa",
    "shear_modulus": "Pa",
}
OWN = ("osmotic_modulus", "osmotic_modulus_hot", "shear_modulus", "polymer_fraction",
       "polymer_fraction_hot")  # fmt: skip


def block(given, gels):
    """The same as a design's file has it."""
    said = {k: f"{v!r} {SI[k]}" if k in SI else v for k, v in given.items()}
    if given["gel"] == "own":
        said["gel"] = {key: said.pop(key) for key in OWN}
    elif gels[given["gel"]].get("model") == "flory-rehner":
        del said["molecule_volume"]
    return {"kind": "tube"} | said


def expected(given, gels):
    """Numbers with uncertainty and lights with values, by Python; or its refusal."""
    try:
        design = checked("drawn", block(given, gels), gels)
    except ValueError as refusal:
        return {"refusal": str(refusal)}
    numbers = {
        each.key: [each.value, each.uncertainty or 0.0]
        for each in [*device.results(design), *late.late_results(design)]
    }
    lights = validity.before_solving(design) + late.late_lights(design)
    return {
        "numbers": numbers,
        "lights": {each.criterion.key: (each.value, each.light) for each in lights},
    }


def test_a_thousand_designs_are_the_same_in_both(engine, gels):
    rng = np.random.default_rng(18)
    designs = [drawn(rng, gels) for _ in range(COUNT)]
    found, milliseconds = engine(designs)
    print(f"{milliseconds:.2f} ms a design")
    solved = pulses = 0
    for given, page in zip(designs, found, strict=True):
        here = expected(given, gels)
        assert ("refusal" in page) == ("refusal" in here), (given, page, here)
        if "refusal" in here:
            continue
        solved += 1
        pulses += "final_front_width" in here["numbers"]
        assert set(page["numbers"]) == set(here["numbers"])
        for key, value in here["numbers"].items():
            np.testing.assert_allclose(page["numbers"][key], value, rtol=1e-6, err_msg=f"{key} {given}")
        assert [each["key"] for each in page["lights"]] == [
            each.key for each in validity.CRITERIA if each.key in here["lights"]
        ]
        for each in page["lights"]:
            value, light = here["lights"][each["key"]]
            assert each["value"] == pytest.approx(value, rel=1e-6), (each, value, given)
            assert each["light"] == light, (each, value)
    print(f"{solved} designs, {pulses} with a late pulse")
    assert solved > COUNT / 2
    assert pulses > COUNT / 4
