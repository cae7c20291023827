"""The record of the two-dimensional truth: what is said from it, in statements and in the docs."""

import json
from pathlib import Path

import numpy as np
import pytest
import yaml
from pages import Page

from gelpump.statements import truth
from gelpump.statements.statement import Evidence
from gelpump.truth import record
from gelpump.tube.wall_flow import lumen_share

PROJECT = Path(__file__).parents[2]
KEPT = PROJECT / "workflow/reference/truth.json"


@pytest.fixture(scope="module")
def data():
    return record.read(KEPT)


def judged(data):
    return {each["id"]: each for each in truth.statements.records(Evidence(data, *[{}] * 5))}


def test_the_record_is_of_the_configuration(data):
    """Else: `snakemake pump_truth`, then `snakemake record_truth`."""
    config = yaml.safe_load((PROJECT / "config/config.yaml").read_text(encoding="utf-8"))
    for name, each in data.items():
        made_from = json.loads(each.parameters)
        assert made_from["gel"] == config["gels"]["linear"], name
        for block, values in made_from.get("truth", {}).items():
            assert values == config["truth"][block], f"{name}: {block}"
    pulses = data["truth/pulses"]
    assert pulses.Le == config["tube"]["Le"]
    np.testing.assert_array_equal(pulses.ell, config["truth"]["pulses"]["ell"])


def test_what_is_written_is_read(data, tmp_path):
    named = {name.removeprefix("truth/"): each for name, each in data.items()}
    record.write(named, record.run(KEPT), tmp_path / "again.json")
    assert (tmp_path / "again.json").read_text() == KEPT.read_text()


def test_every_statement_has_a_verdict_and_can_have_another(data):
    found = judged(data)
    assert set(found) == {each.id for each in truth.statements}
    assert all(name.startswith("beyond-") for name in found)
    stands = ["beyond-shape-bends", "beyond-truth-wall", "beyond-truth-bead"]
    falls = ["front-jump", "front-left-behind", "sharpness-law", "sharpness-thin", "sheds-ahead"]
    assert all(found[name]["status"] == "reproduced" for name in stands)
    assert all(found[f"beyond-{name}"]["status"] == "deviates" for name in falls)
    other = {name: each.copy(deep=True) for name, each in data.items()}
    waves = other["truth/waves"]
    waves["jump"][:] = 0.0
    waves["width_Phi"][:, 0] = 0.01
    waves["A"][:] = 1 / (1 - waves.ell)
    waves["width_radius"][:] = 1 - waves.ell
    other["truth/pulses"]["shed_ahead"][:] = -0.1
    other["truth/slenderness"]["tau99_resolved_error"][:] = 0.1
    other["truth/verification"]["bead_radius"][:] *= 1.01
    other["truth/verification"]["wall_balance_error"][...] = 1e-6
    changed = judged(other)
    falls.remove("sharpness-law")  # of pulses
    assert all(changed[name]["status"] == "deviates" for name in stands)
    assert all(changed[f"beyond-{name}"]["status"] == "reproduced" for name in falls)
    assert found["beyond-truth-water"]["computed"] is True
    assert changed["beyond-truth-water"]["computed"] is False


def test_without_the_record_nothing_is_said(data):
    assert not judged({})
    some = judged({"truth/waves": data["truth/waves"]})
    assert some
    assert all("waves" in each["evidence"] for each in some.values())


def passages(data):
    """Passages of the page, numbers as {}, and what stands there."""
    waves, pulses, walls, tried, slender = data.values()
    rest, half = waves.sel(Pe=0.0), waves.sel(ell=0.5)
    T = slender["T"].values
    shown = pulses.sel(T=1.0)
    found = judged(data)

    def stated(name):
        return [found[f"beyond-{name}"][key] for key in ("computed", "uncertainty")]

    cpu = sum(each["cpu_seconds"] for each in record.run(KEPT)["jobs"].values())
    yield "takes {} s of CPU in its five", [cpu]
    water = [pulses.water_balance_error, tried.wall_balance_error, *tried.wave_balance_error]
    yield "a wave against geometry | {} |", [max(float(each) for each in water)]
    yield "(four meshes) | {}, {} |", tried.order[:2]
    yield "near two corners | {} to 2 |", [tried.order[2]]
    yield "stretch against Φ_∞^{−1/3} | {} |", [tried.free_swelling_error]
    radii = np.abs(tried.bead_radius[:, -1] - tried.bead_radius_nonlinear)
    yield "against shells and CVODE | {}, {}, {} |", radii
    resolved = slender.tau99_resolved_error.sel(surface="balanced")
    doubt = slender.tau99_resolved_error_uncertainty.sel(surface="balanced").max()
    yield (
        "ℓ = 0.1 to 0.9 | {} to {} ± {} % |",
        100 * np.array([resolved.min(), resolved.max(), doubt]),
    )
    yield "against the thin wall's | {}, {}, {} ± 1 %", walls.tau99.sel(ell=0.9)
    change = 100 * np.abs(waves.jump_energy_M / waves.jump_M).sel(M=1.0)
    error = 200 * (waves.jump_uncertainty_M / waves.jump_M).sel(M=1.0)
    yield "jump of Φ at the front by {} ± {} % at", [change, error]
    assert np.abs(walls.tau99_energy / walls.tau99).max() < 0.01
    middle = rest.sel(ell=0.75)
    yield "Φ jumps.** By {} ± {} of", [middle.jump, rest.jump_uncertainty.max()]
    assert (np.abs(rest.jump - middle.jump) < rest.jump_uncertainty).all()
    yield "*M* = 1: from {} to {})", [half.Phi_behind[0], half.Phi_ahead[0]]
    yield "moves: {} at Pe = 1, {} at 3, {} at 10", half.jump[3:]
    yield "It is {} at *M* = 0.1 and {} at *M* = 10", waves.jump_M[[0, 2]]
    yield (
        "middle of the wall {} *a*₁ at Pe = 0, {} at 1, {} at 3, {} at 10 (ℓ",
        half.width_Phi[[0, 3, 4, 5]],
    )
    stresses = np.array([rest.hoop_compression, rest.hoop_tension])
    yield "hoop stress ({} to {} Π₀₀", [stresses.min(), stresses.max()]
    at_1 = np.ravel(list(zip(shown.A, shown.A_uncertainty, strict=True)))
    yield "*A* ε is {} ± {}, {} ± {} and {} ± {} for", at_1
    yield "0.75: *n* = {} ± {}.", stated("sharpness-law")
    yield (
        "at rest) give {} ± {},",
        stated("sharpness-thin"),
    )
    yield "(1−ℓ)^{{} ± {}}", stated("shape-bends")
    yield "closure has *A* ε = {}, {}, {}:", slender.A.sel(closure="printed", T=1.0)
    yield "From {} % (early, thick)", [100 * pulses.shed_ahead.min()]
    assert 0.45 < pulses.shed_ahead.max() < 0.5
    share = waves.isel(Pe=1)
    below = 100 * (1 - share.share / lumen_share(share.ell.values))
    doubt = 100 * share.share_uncertainty / share.share
    pairs = np.ravel([[each.sel(ell=ell) for each in (below, doubt)] for ell in (0.75, 0.9)])
    yield "lumen is {} ± {} and {} ± {} % below", pairs
    yield (
        "({} ± {} against {} at ℓ = 0.5)",
        [*(x.sel(ell=0.5) for x in (share.share, share.share_uncertainty)), lumen_share(0.5)],
    )

    def rows(quantity, keep):
        errors = slender[f"{quantity}_error"].values[..., keep]
        return [(each.min(), each.max()) for each in errors]

    def cells(quantity, keep):
        (a, b), c, d = rows(quantity, keep)
        return [100 * a, 1 + b, *(100 * np.array(c)), *(100 * np.array(d))]

    late, early = T >= 1, T <= 0.1
    yield "pumped, *T* ≥ 1 | {} % to ×{} | {} to {} % | {} to {} % |", cells("pumped", late)
    yield "far ahead, *T* ≥ 1 | {} % to ×{} | {} to {} % | {} to {} % |", cells("V_far", late)
    yield "0.02 to 0.1 | {} % to ×{} | {} to {} % | {} to {} % |", cells("V_far", early)
    printed, conservative, balanced = (np.array(each) for each in rows("width", late))
    lengths = [*(100 * printed), *(100 * conservative), *(1 + balanced)]
    yield "90 %, *T* ≥ 1 | {} to {} % | {} to {} % | ×{} to ×{} |", lengths
    times = 100 * slender.tau99_error.mean("wall_ell")
    error = 100 * slender.tau99_error_uncertainty.mean("wall_ell")[2]
    yield "heated everywhere | {} % | {} % | {} ± {} % |", [*times, error]
    held = slender.tau99_resolved_error.sel(surface="conservative", place="midline").mean()
    yield "radius is {} times too fast", [1 / (1 + held)]
    yield "printed coefficient {} times.", [1 / (1 + times[0] / 100)]


def test_the_page_tells_the_record(data):
    """Each number to half a unit of the last digit that is told."""
    page = Page(PROJECT / "docs/truth.md")
    assert sum(page.tells(*each) for each in passages(data)) > 80
