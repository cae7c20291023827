"""The page's designer in a real browser: its formulae against Python's, what a reader does with it,
and what it exports."""

import json
from importlib.util import find_spec
from pathlib import Path

import alone
import numpy as np
import pytest
import yaml

from gelpump.design import checked, device, late, validity
from gelpump.design.solve_tube import solve_tube
from gelpump.report import page

pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def gels():
    return alone.gels()


@pytest.fixture(scope="module")
def engine(chromium):
    """What the page's own scripts, alone on an empty page, make of designs."""
    scripts, told = page.scripts(page.ENGINE), alone.told()

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
        "repeat_unit": 0.11316,
        "polymer_density": 1100.0,
        "heat_capacity": 4.18e6,
        "surrounding": str(rng.choice(["unknown", "bath", "pipe", "insulated"])),
    }
    if given["surrounding"] == "insulated":  # of a tube whose heat is slower there is no front
        given["permeability"] = min(given["permeability"], 1e-17)
    if given["surrounding"] == "pipe":
        given["pipe_section"] = np.pi * a_1**2 * rng.uniform(1.1, 20)
    if rng.random() < 0.7:
        given["enthalpy"] = 10 ** rng.uniform(2, 4.3)
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
    "repeat_unit": "kg/mol",
    "polymer_density": "kg/m^3",
    "heat_capacity": "J/m^3/K",
    "pipe_section": "m^2",
    "enthalpy": "J/mol",
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


@pytest.mark.parametrize("count", [100, pytest.param(1000, marks=pytest.mark.evidence)])
def test_designs_at_random_are_the_same_in_both(engine, gels, count):
    rng = np.random.default_rng(18)
    designs = [drawn(rng, gels) for _ in range(count)]
    found, milliseconds = engine(designs)
    print(f"{milliseconds:.2f} ms a design")  # 50 are allowed to an update; told, not asserted
    solved = pulses = 0
    for given, shown in zip(designs, found, strict=True):
        here = expected(given, gels)
        assert ("refusal" in shown) == ("refusal" in here), (given, shown, here)
        if "refusal" in here:
            continue
        solved += 1
        pulses += "final_front_width" in here["numbers"]
        assert set(shown["numbers"]) == set(here["numbers"])
        for key, value in here["numbers"].items():
            # JSON has no infinity, which is the uncertainty of a wave whose front is not found
            pair = [np.inf if each is None else each for each in shown["numbers"][key]]
            np.testing.assert_allclose(pair, value, rtol=1e-6, err_msg=f"{key} {given}")
        assert [each["key"] for each in shown["lights"]] == [
            each.key for each in validity.CRITERIA if each.key in here["lights"]
        ]
        for each in shown["lights"]:
            value, light = here["lights"][each["key"]]
            assert each["value"] == pytest.approx(value, rel=1e-6), (each, value, given)
            assert each["light"] == light, (each, value)
    print(f"{solved} designs, {pulses} with a late pulse")
    assert solved > count / 2
    assert pulses > count / 4


@pytest.fixture
def shown(chromium, tmp_path):
    """Shows the designer at a width, in light or dark, with a fragment, and gives the browser."""
    file = tmp_path / "designer.html"
    file.write_text(alone.html(), encoding="utf-8")

    def shown(width=1280, scheme="light", fragment=""):
        size = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False}
        chromium.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
        features = [{"name": "prefers-color-scheme", "value": scheme}]
        chromium.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": features})
        chromium.get("about:blank")
        chromium.get_log("browser")
        chromium.get(file.as_uri() + fragment)
        return chromium

    return shown


def wait(browser, script):
    from selenium.webdriver.support.ui import WebDriverWait

    return WebDriverWait(browser, 60).until(lambda _: browser.execute_script(f"return {script}"))


def exported(browser):
    return yaml.safe_load(
        browser.execute_script("return document.querySelector('[data-file]').textContent")
    )


def put(browser, key, value):
    field = browser.find_element("id", f"design-{key}")
    field.clear()
    field.send_keys(str(value))


def told(browser, name):
    return browser.execute_script(
        f"return document.querySelector('#designer [data-number=\"{name}\"]').textContent"
    )


@pytest.mark.parametrize(("width", "scheme"), [(390, "light"), (1280, "dark"), (1920, "light")])
def test_nothing_is_wrong_on_any_screen(shown, width, scheme):
    browser = shown(width, scheme)
    wait(browser, "document.getElementById('designer').dataset.scanned")
    assert browser.get_log("browser") == []
    assert browser.execute_script("return document.documentElement.scrollWidth") <= width
    package = find_spec("axe_playwright_python")
    if package is None:
        pytest.skip("axe-playwright-python, which holds axe-core, is not installed")
    browser.execute_script((Path(package.submodule_search_locations[0]) / "axe.min.js").read_text())
    violations = browser.execute_async_script("axe.run('#design').then(arguments[0])")["violations"]
    found = [(each["id"], [node["html"][:160] for node in each["nodes"]]) for each in violations]
    assert found == []


def test_it_is_operated_by_keyboard_and_says_what_it_found(shown):
    from selenium.webdriver.common.keys import Keys

    browser = shown()
    before = told(browser, "response")
    slider = browser.find_element("css selector", '[data-field="a_1"] [type="range"]')
    number = browser.find_element("id", "design-a_1")
    slider.send_keys(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
    assert float(number.get_property("value")) > 100
    assert slider.get_attribute("aria-valuetext") == f"{number.get_property('value')} um"
    assert told(browser, "response") != before
    said = wait(browser, "document.querySelector('[data-said]').textContent")
    assert said.startswith(f"Responds in {told(browser, 'response')}.")
    slider.send_keys(Keys.TAB)
    focused = browser.switch_to.active_element
    assert focused.get_attribute("id") == "design-heated_length"


def test_a_link_and_a_choice_of_the_scan_restore_a_design(shown):
    browser = shown()
    put(browser, "viscosity", 1.5)
    wait(browser, "location.hash.includes('viscosity=1.5')")
    fragment, file = browser.execute_script("return location.hash"), exported(browser)
    assert exported(shown(fragment=fragment)) == file
    wait(browser, "document.querySelector('[data-front] button')")
    browser.find_element("css selector", "[data-front] button").send_keys("\n")
    taken = exported(browser)
    assert taken["a_0"] != file["a_0"]
    assert taken["viscosity"] == file["viscosity"]


def test_what_the_scan_offers_does_what_was_wanted(shown, gels):
    browser = shown()
    put(browser, "wanted_time", 0.02)
    wait(browser, "document.querySelector('[data-front] button')")
    browser.find_element("css selector", "[data-front] button").send_keys("\n")
    design = checked("taken", exported(browser), gels)
    numbers = {each.key: each for each in device.results(design) + late.late_results(design)}
    assert numbers["response_time"].value <= 0.02 * (1 + 1e-9)
    assert numbers["wall"].value >= 20e-6 * (1 - 1e-9)
    assert numbers["final_pumped_volume_conserving"].value >= 5e-12


@pytest.mark.parametrize(
    ("key", "value", "why"),
    [
        ("a_0", 100, "inner radius must be less than the outer"),
        ("permeability", 0, "permeability must be a number greater than 0"),
        ("polymer_fraction_hot", 0.05, "must be greater than when cold"),
        ("heating_step", 400, "above 0 K"),
    ],
)
def test_what_is_no_design_is_refused_with_the_reason(shown, key, value, why):
    browser = shown()
    put(browser, key, value)
    assert why in browser.find_element("css selector", "[role=alert]").text
    assert not browser.find_element("css selector", "[data-results]").is_displayed()
    assert browser.get_log("browser") == []


def test_an_exported_design_is_solved_to_the_same_numbers(shown, gels):
    browser = shown()
    put(browser, "a_1", 90)
    put(browser, "shear_modulus", 5)
    design = checked("exported", exported(browser), gels)
    assert design.si("a_1") == pytest.approx(90e-6)
    at_once = {each.key: each for each in late.late_results(design)}
    _, solved = solve_tube(design, {"cells": [24, 16], "tolerance": 3e-4, "reach": 10.0})
    compared = [each for each in solved if each.key in at_once]
    assert len(compared) >= 10
    for each in compared:
        wave = at_once[each.key]
        assert abs(each.value - wave.value) <= each.uncertainty + wave.uncertainty, each.key
