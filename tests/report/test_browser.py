"""The page in a real browser: what is seen, what moves, what can be operated, what is asked for."""

import json
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

from gelpump import netcdf

pytestmark = pytest.mark.browser

# long-running loads of lazy pictures are forced, as scrolling through the page would
LOAD_ALL = """
const done = arguments[0];
const images = [...document.images];
for (const image of images) image.loading = "eager";
Promise.all(images.map((image) => image.decode().catch(() => null))).then(() =>
  done(images.map((image) => [image.alt, image.naturalWidth, image.clientWidth])));
"""
PICTURE = "return document.querySelector(arguments[0]).toDataURL()"


def control(browser, explorer, name, value):
    """Set a slider or a selection as a user would, with the events of one."""
    browser.execute_script(
        """const controls = document.getElementById(arguments[0]);
        const input = controls.querySelector(`[data-control="${arguments[1]}"]`);
        input.value = arguments[2];
        input.dispatchEvent(new Event(input.matches("select") ? "change" : "input",
                                      {bubbles: true}));""",
        explorer,
        name,
        value,
    )


def shown(browser, explorer, name):
    element = f'#{explorer} [data-number="{name}"]'
    return browser.execute_script(
        "return document.querySelector(arguments[0]).textContent", element
    )


def number(text):
    """What `printed` of arrays.js says, as a number."""
    plain = text.replace("−", "-").replace("×10", "e")
    return float(plain.translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")))


def test_every_figure_is_visible(show):
    images = show().execute_async_script(LOAD_ALL)
    assert len(images) == 22
    for alt, natural, drawn in images:
        assert len(alt) > 40
        assert natural > 100, alt
        assert drawn > 100, alt


@pytest.mark.parametrize("width", [390, 1280, 1920])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_is_wrong_on_any_screen(show, width, scheme):
    browser = show(width, scheme)
    browser.execute_async_script(LOAD_ALL)
    assert browser.get_log("browser") == []
    assert browser.execute_script("return document.documentElement.scrollWidth") <= width


def test_no_request_leaves_the_machine(show):
    browser = show()
    browser.execute_async_script(LOAD_ALL)
    messages = [json.loads(each["message"])["message"] for each in browser.get_log("performance")]
    urls = [
        each["params"]["request"]["url"]
        for each in messages
        if each["method"] == "Network.requestWillBeSent"
    ]
    assert any(url.startswith("file:") for url in urls)
    assert [url for url in urls if not url.startswith(("file:", "data:", "blob:"))] == []


def test_the_first_figure_is_there_within_a_second(show, page):
    """What stands before it is small; the browser's own measure is told, and only has to be sane:
    a machine that does much else may be slow."""
    browser = show()
    paint = browser.execute_script(
        "return performance.getEntriesByName('first-contentful-paint')[0].startTime"
    )
    print(f"first contentful paint after {paint:.0f} ms")
    assert 0 < paint < 10_000
    images = "return [...document.images].map((image) => [image.loading, image.complete])"
    (loading, complete), *others = browser.execute_script(images)
    assert (loading, complete) == ("auto", True)
    assert all(loading == "lazy" for loading, _ in others)
    text = page.read_text(encoding="utf-8")
    assert text.index("</figure>") < 1_000_000
    assert text.index('id="data"') > text.rindex("</figure>"), "explorers' data come last"
    assert len(text) < 8_000_000


def test_the_tube_shows_the_numbers_of_its_dataset(show, built):
    browser = show()
    pulse = netcdf.read(built.path / "results/data/tube_pulse.nc")
    fit = netcdf.read(built.path / "results/data/front_fit.nc")
    lumen = netcdf.read(built.path / "results/data/lumen_pulse.nc")
    pictures = set()
    for i, j in ((0, 5), (3, 5), (3, pulse.sizes["tau"] - 1)):
        control(browser, "explore-tube", "ell", i)
        control(browser, "explore-tube", "tau", j)
        here = {"ell": i, "tau": j}
        for name, value in {
            "Z_C": pulse.Z_C[j],
            "Phi1_front": pulse.Phi1_front[here],
            "A": fit.A_tau[here],
        }.items():
            assert number(shown(browser, "explore-tube", name)) == pytest.approx(
                float(value), rel=6e-4
            ), name
        tau = float(pulse.tau[j])
        if np.any(np.isclose(lumen.tau, tau)):
            same = lumen.sel(tau=tau, method="nearest").isel(ell=i)
            told = number(shown(browser, "explore-tube", "V_front"))
            assert told == pytest.approx(float(same.V_front_printed), rel=6e-4)
        pictures.add(browser.execute_script(PICTURE, '#explore-tube [data-canvas="section"]'))
    assert len(pictures) == 3


def test_the_tube_shows_each_closure(show, built):
    """The same tube at the same time, as near as it was stored, with its own numbers."""
    from selenium.webdriver.support.ui import Select

    browser = show()
    balance = netcdf.read(built.path / "results/data/pump_balance.nc")
    conserving = netcdf.read(built.path / "results/data/pump_pulse.nc")
    choice = browser.find_element("css selector", '#explore-tube [data-control="closure"]')
    for closure in ("balanced", "conservative"):
        Select(choice).select_by_visible_text(closure)
        here = conserving.sel(closure=closure).sel(ell=0.5, tau=0.02, method="nearest")
        told = number(shown(browser, "explore-tube", "Phi1_front"))
        assert told == pytest.approx(float(here.Phi1_front), rel=6e-4)
        far = balance.V_far.sel(closure=closure).sel(ell=0.5, tau=0.02, method="nearest")
        assert number(shown(browser, "explore-tube", "V_far")) == pytest.approx(
            float(far), rel=3e-2
        )


def test_the_front_can_be_seen_close_up(show):
    browser = show()
    whole = browser.execute_script(PICTURE, '#explore-tube [data-canvas="section"]')
    box = browser.find_element("css selector", '#explore-tube [data-control="close"]')
    box.send_keys(" ")
    assert box.is_selected()
    assert browser.execute_script(PICTURE, '#explore-tube [data-canvas="section"]') != whole


@pytest.mark.parametrize("choice", ["light", "dark"])
def test_the_readers_choice_of_colours_reaches_the_canvases(show, choice):
    other = {"light": "dark", "dark": "light"}[choice]
    browser = show(scheme=other)
    ink = """return [getComputedStyle(document.body).color,
      document.querySelector("#explore-tube canvas").toDataURL()]"""
    before = browser.execute_script(ink)
    browser.find_element("css selector", "#theme").click()
    after = browser.execute_script(ink)
    assert before[0] != after[0]
    assert before[1] != after[1]
    assert browser.execute_script("return document.documentElement.dataset.theme") == choice


def test_the_bead_shows_the_numbers_of_its_dataset(show, built):
    browser = show()
    pictures = set()
    for case, step in (("swelling", 40), ("swelling", 150), ("drying", 150)):
        control(browser, "explore-bead", "case", case)
        control(browser, "explore-bead", "t", step)
        for model in ("lens", "nonlinear"):
            bead = netcdf.read(built.path / f"results/data/bead_{case}_{model}.nc")
            for name, values in {
                "radius": bead.radius,
                "surface": bead.surface_polymer_fraction,
                "centre": bead.polymer_fraction[:, 0],
            }.items():
                assert number(shown(browser, "explore-bead", f"{model}-{name}")) == pytest.approx(
                    float(values[step]), rel=6e-4
                )
        for canvas in ("disc", "profile", "course"):
            selector = f'#explore-bead [data-canvas="{canvas}"]'
            pictures.add(browser.execute_script(PICTURE, selector))
    assert len(pictures) == 9


def test_a_bead_goes_on_to_the_end(show, built):
    browser = show()
    control(browser, "explore-bead", "case", "separating, to the end")
    bead = netcdf.read(built.path / "results/data/separation_separating_lens.nc")
    control(browser, "explore-bead", "t", 150)
    told = number(shown(browser, "explore-bead", "lens-radius"))
    assert told == pytest.approx(float(bead.radius[150]), rel=6e-4)
    assert shown(browser, "explore-bead", "nonlinear-radius") != "stopped"


def test_a_bead_whose_phases_separate_says_so(show):
    browser = show()
    control(browser, "explore-bead", "case", "separating")
    assert shown(browser, "explore-bead", "nonlinear-radius") == "stopped"
    assert (
        "phase separation" in browser.find_element("css selector", "#explore-bead [data-note]").text
    )


def test_the_gel_is_in_equilibrium(show, hht):
    browser = show()
    control(browser, "explore-gel", "gel", "HHT")
    pictures = set()
    for step in (20, 100, 200):
        control(browser, "explore-gel", "T", step)
        phi = number(shown(browser, "explore-gel", "phi_0"))
        roots = hht.equilibrium_polymer_fractions(300.0 + 0.05 * step)
        fractions = np.atleast_1d(getattr(roots, "polymer_fraction", roots))
        assert np.min(np.abs(fractions / phi - 1)) < 1e-3
        for canvas in ("pressure", "plane"):
            selector = f'#explore-gel [data-canvas="{canvas}"]'
            pictures.add(browser.execute_script(PICTURE, selector))
    assert len(pictures) == 6


@pytest.mark.parametrize("explorer", ["explore-tube", "explore-bead", "explore-gel"])
def test_it_plays_and_pauses_by_keyboard(show, explorer):
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.support.ui import WebDriverWait

    browser = show()
    button = browser.find_element("css selector", f"#{explorer} [data-play]")
    before = browser.execute_script(PICTURE, f"#{explorer} canvas")
    button.send_keys(Keys.SPACE)
    assert button.text == "Pause"
    WebDriverWait(browser, 20).until(
        lambda _: browser.execute_script(PICTURE, f"#{explorer} canvas") != before
    )
    button.send_keys(Keys.ENTER)
    assert button.text == "Play"
    slider = browser.find_element("css selector", f'#{explorer} input[type="range"]')
    told = slider.get_attribute("aria-valuetext")
    slider.send_keys(Keys.ARROW_LEFT)
    assert slider.get_attribute("aria-valuetext") != told


def test_claims_are_filtered_and_sorted_by_keyboard(show, built):
    from selenium.webdriver.common.keys import Keys

    claims = json.loads((built.path / "results/claims.json").read_text())
    browser = show()
    rows = "#claims-table tbody tr:not([hidden])"
    browser.find_element("css selector", '.filters [data-status="deviates"]').send_keys(Keys.ENTER)
    visible = browser.find_elements("css selector", rows)
    assert len(visible) == sum(claim["status"] == "deviates" for claim in claims) > 0
    assert {row.get_attribute("data-status") for row in visible} == {"deviates"}
    browser.find_element("css selector", '.filters [data-status=""]').send_keys(Keys.SPACE)
    heading = browser.find_element("css selector", 'thead [data-sort="5"]')
    heading.send_keys(Keys.ENTER)
    heading.send_keys(Keys.ENTER)
    first = browser.find_element("css selector", rows).get_attribute("id")
    largest = max(claims, key=lambda claim: claim["relative_difference"] or -1)
    assert first == f"claim-{largest['id']}"
    sorted_by = browser.find_element("css selector", "#claims-table th:nth-child(6)")
    assert sorted_by.get_attribute("aria-sort") == "descending"


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_nothing_serious(show, scheme):
    package = find_spec("axe_playwright_python")
    if package is None:
        pytest.skip("axe-playwright-python, which holds axe-core, is not installed")
    browser = show(1280, scheme)
    browser.execute_script((Path(package.submodule_search_locations[0]) / "axe.min.js").read_text())
    violations = browser.execute_async_script("axe.run().then(arguments[0])")["violations"]
    serious = [
        (each["id"], [node["html"][:160] for node in each["nodes"]][:3])
        for each in violations
        if each["impact"] in ("serious", "critical")
    ]
    assert serious == []


def test_it_prints(show):
    import base64

    printed = show().execute_cdp_cmd("Page.printToPDF", {"preferCSSPageSize": True})
    assert base64.b64decode(printed["data"]).startswith(b"%PDF")
