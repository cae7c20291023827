"""Gels fitted to measured equilibria: recovered within their errors, or refused with the line."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gelpump.materials import from_config, measured

T_ERROR, PHI_ERROR = 0.02, 0.002


def synthetic(gel, seed, count=48):
    random = np.random.default_rng(seed)
    T = np.concatenate([np.linspace(298, 305.5, count // 2), np.linspace(305, 314, count // 2)])
    branch = ["swollen"] * (count // 2) + ["dry"] * (count // 2)
    phi = [gel.equilibrium_polymer_fraction(t, b) for t, b in zip(T, branch, strict=True)]
    return measured.Points(
        T + T_ERROR * random.normal(size=count),
        np.array(phi) + PHI_ERROR * random.normal(size=count),
        np.full(count, T_ERROR),
        np.full(count, PHI_ERROR),
        True,
    )


def test_exact_points_give_the_gel_back(anb):
    points = synthetic(anb, 0)
    pairs = zip(points.T, points.phi, strict=True)
    exact = replace(points, phi=np.array([_equilibrium(anb, *pair) for pair in pairs]))
    found = measured.fit("mine", exact)
    assert np.allclose(found.parameters, [getattr(anb, n) for n in measured.NAMES], rtol=1e-6)
    assert found.reduced_chi2 < 1e-10


def _equilibrium(gel, T, near):
    phi, stable = gel.equilibrium_polymer_fractions(T)
    phi = phi[stable]
    return phi[np.abs(phi - near).argmin()]


def test_the_errors_cover_the_truth(anb):
    truth = np.array([getattr(anb, name) for name in measured.NAMES])
    fits = [measured.fit("mine", synthetic(anb, seed)) for seed in range(80)]
    z = np.array([(each.parameters - truth) / each.errors for each in fits])
    assert np.all((z.std(axis=0) > 0.75) & (z.std(axis=0) < 1.3)), z.std(axis=0)
    assert np.all(np.abs(z.mean(axis=0)) < 0.45), z.mean(axis=0)
    assert 0.55 < (np.abs(z) < 1).mean() < 0.8
    assert 0.8 < np.mean([each.reduced_chi2 for each in fits]) < 1.2


def test_a_few_points_of_one_state_are_warned_of_or_refused(anb):
    T = np.linspace(298, 300, 8)
    phi = np.array([anb.equilibrium_polymer_fraction(t) for t in T])
    points = measured.Points(T, phi, np.full(8, 0.02), np.full(8, 1e-3), True)
    for seed in range(4):
        random = np.random.default_rng(seed)
        noisy = replace(points, phi=phi + 1e-3 * random.normal(size=8))
        assert told_of(noisy), seed


def told_of(points):
    try:
        found = measured.fit("mine", points)
    except ValueError as refusal:
        return "mine: the point" in str(refusal)
    return any("not identified" in text for text in found.warnings)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("", "is empty"),
        ("T,phi\n1,2\n", "line 1: columns"),
        ("temperature,polymer_fraction\n25,0.1\n", "line 2: temperature = '25': must be kelvin"),
        ("temperature,polymer_fraction\n300,1.5\n", "line 2: polymer_fraction = 1.5"),
        ("temperature,polymer_fraction\n300,x\n", "line 2: polymer_fraction = 'x'"),
        ("temperature,polymer_fraction\n300\n", "line 2: 1 values: must be 2"),
        ("temperature,polymer_fraction\n300,nan\n", "line 2: polymer_fraction = 'nan'"),
        ("temperature,polymer_fraction\n300,0.1\n", "1 points: must be 6 to"),
        ("temperature,polymer_fraction\n" + "300,0.1\n" * 9, "do not determine five parameters"),
    ],
)
def test_hostile_points_are_refused(tmp_path, text, told):
    (tmp_path / "points.csv").write_text(text)
    gels = {"mine": {"model": "measured", "points": "points.csv"}}
    with pytest.raises(ValueError, match="mine: ") as refusal:
        measured.resolve(gels, [tmp_path])
    assert told in str(refusal.value)


def test_a_file_that_is_missing_is_named(tmp_path):
    with pytest.raises(ValueError, match=r"mine: points = 'no.csv': no such file"):
        measured.resolve({"mine": {"model": "measured", "points": "no.csv"}}, [tmp_path])


def test_the_example_is_resolved_to_the_gel_it_was_made_from(anb):
    gels = {"synthetic": {"model": "measured", "points": "config/gels/synthetic.csv"}}
    project = Path(__file__).resolve().parents[2]
    [(name, how)] = measured.resolve(gels, [project], str).items()
    assert name == "synthetic"
    assert how["points"] == (project / "config/gels/synthetic.csv").as_posix()
    found = measured.fit("synthetic", measured.read(project / "config/gels/synthetic.csv"))
    z = (found.parameters - [getattr(anb, name) for name in measured.NAMES]) / found.errors
    assert np.abs(z).max() < 3
    gel = from_config("synthetic", gels["synthetic"])
    assert abs(gel.folds().temperature.max() - anb.folds().temperature.max()) < 0.1


# diameters of PNIPAM beads by light scattering, every 5 K: a smooth collapse
COARSE = {293.15: 0.0472, 298.15: 0.0478, 303.15: 0.0628, 308.15: 0.3372, 313.15: 0.5842,
          318.15: 0.5994, 323.15: 0.6000}  # fmt: skip


def read_pairs(tmp_path, pairs):
    rows = "\n".join(f"{T},{phi}" for T, phi in pairs)
    (tmp_path / "points.csv").write_text(f"temperature,polymer_fraction\n{rows}\n")
    return measured.read(tmp_path / "points.csv")


def test_a_point_on_the_unstable_branch_is_refused(tmp_path):
    with pytest.raises(ValueError, match=r"308.15 K, phi = 0.3372 lies on the unstable branch"):
        measured.fit("mine", read_pairs(tmp_path, COARSE.items()))


def test_no_form_represents_them_and_each_reason_is_told(tmp_path):
    with pytest.raises(ValueError, match="no form goes through the points") as refusal:
        measured.choose("mine", read_pairs(tmp_path, COARSE.items()), {})
    for form in measured.FORMS:
        assert f"{form}: " in str(refusal.value)


@pytest.mark.parametrize("form", measured.FORMS)
def test_the_criterion_finds_the_form_that_made_the_points(form, anb):
    """Exact equilibria of a gel of each form, with small noise: it or a simpler one is taken."""
    made = made_by(form, anb)
    T = np.linspace(291.0, 318.0, 36)
    random = np.random.default_rng(5)
    phi = [made.equilibrium_polymer_fraction(t) for t in T] * (1 + 1e-3 * random.normal(size=36))
    points = measured.Points(T, phi, np.full(36, 1e-3), 1e-3 * phi, True)
    found = measured.choose("mine", points, {})
    own = measured.fit("mine", points, form=form)
    assert found.criterion <= own.criterion
    assert 0.3 < own.reduced_chi2 < 2.0
    truth = [made.parameters[name][0] for name in own.names]
    assert np.abs((own.parameters - truth) / own.errors).max() < 4.0
    assert len(found.passed_over) == len(measured.FORMS) - 1
    again = from_config("again", found.block())
    np.testing.assert_allclose(
        again.equilibrium_temperature(phi), found.gel.equilibrium_temperature(phi), rtol=1e-12
    )


def made_by(form, anb):
    if form == "appendix-A":
        return anb
    chi_3 = 0.3 if form.endswith("3") else 0.0
    slopes = {"constant": -3.83, "slope": 0.0140} if form.startswith("linear") else {
        "A": -6.0, "Theta": 309.0}  # fmt: skip
    return from_config(form, {
        "model": "flory-rehner",
        "chi": {"chi_1": slopes, "chi_2": 0.25, "chi_3": chi_3},
        "network": {"elasticity": "neo-Hookean", "chain_length": 150.0},
        "temperature_range": [285.0, 325.0],
    })  # fmt: skip


def test_six_points_choose_no_form_that_goes_through_them_all(anb):
    T = np.array([292.0, 296.0, 300.0, 308.0, 311.0, 315.0])
    noise = 1 + 0.01 * np.random.default_rng(2).normal(size=6)
    phi = [anb.equilibrium_polymer_fraction(t) for t in T] * noise
    found = measured.choose("mine", measured.Points(T, phi, np.full(6, 0.1), 0.01 * phi, False), {})
    assert len(found.names) == 4
    assert any("6 points are too few for 5 parameters" in each for each in found.passed_over)


def test_the_bootstrap_agrees_with_the_covariance(anb):
    points = synthetic(anb, 11)
    found = measured.fit("mine", points)
    drawn, folds = measured.bootstrap(found, points, 150)
    kept = drawn[np.isfinite(drawn).all(axis=1)]
    assert len(kept) > 140
    np.testing.assert_allclose(kept.std(axis=0), found.errors, rtol=0.25)
    upper = np.array([each.max() for each in folds if len(each) > 1])
    assert abs(np.median(upper) - found.gel.folds().temperature.max()) < 3 * upper.std()
    again, _ = measured.bootstrap(found, points, 3)
    np.testing.assert_array_equal(again, drawn[:3])


def test_a_fit_keeps_to_its_chains(anb):
    """Other chains through the same points give another gel, which a block gives back."""
    T = np.r_[np.linspace(291, 305, 12), np.linspace(306, 318, 12)]
    phi = np.array([anb.equilibrium_polymer_fraction(t) for t in T])
    points = measured.Points(T, phi, np.full(24, 0.05), 0.01 * phi, True)
    for network in ({"elasticity": "phantom", "reference_polymer_fraction": 0.1},
                    {"elasticity": "affine"}):  # fmt: skip
        found = measured.choose("mine", points, {"network": network, "form": "linear-3"})
        again = from_config("again", found.block())
        assert again.kappa == pytest.approx(found.gel.kappa)
        assert again.Omega == pytest.approx(found.gel.Omega, rel=1e-12)
    with pytest.raises(ValueError, match="elasticity must be one of"):
        measured.choose("mine", points, {"network": {"elasticity": "stiff"}})
    with pytest.raises(ValueError, match=r"mine.form = 'any'"):
        measured.choose("mine", points, {"form": "any"})


def test_heating_and_cooling_are_kept_apart(anb):
    """Points of both branches; a gel that leaves one early is told so."""
    T = np.arange(295.0, 315.0, 0.5)
    up = np.array([anb.equilibrium_polymer_fraction(t) for t in T])
    down = np.array([anb.equilibrium_polymer_fraction(t, "dry") for t in T])
    both = measured.Points(
        np.r_[T, T], np.r_[up, down], np.full(80, 0.05), 0.01 * np.r_[up, down], True,
        np.repeat(["heating", "cooling"], 40),
    )  # fmt: skip
    found = measured.fit("mine", both)
    np.testing.assert_allclose(found.gel.folds().temperature, anb.folds().temperature, atol=1e-4)
    assert not any("jumped" in text for text in found.warnings)
    swapped = replace(both, branch=np.repeat(["cooling", "heating"], 40))
    told = measured.fit("mine", swapped).warnings
    assert any("on heating the gel has jumped at 305.00 K" in text for text in told)


def test_swollen_points_are_told_that_the_collapsed_state_is_missing(tmp_path, anb):
    pairs = [(T, round(anb.equilibrium_polymer_fraction(T), 4)) for T in range(291, 305)]
    points = read_pairs(tmp_path, pairs)
    said = outcome(points)
    assert "the collapsed state is missing" in said
    assert "1/Omega" not in said


def outcome(points):
    """The fit's warnings, or its refusal."""
    try:
        return "; ".join(measured.fit("mine", points).warnings)
    except ValueError as refusal:
        return str(refusal)


def test_a_misfit_is_told_without_errors_too(anb):
    points = replace(synthetic(anb, 3), errors_given=False)
    assert not any("times their errors" in text for text in measured.fit("mine", points).warnings)
    far = replace(points, T_error=points.T_error / 3, phi_error=points.phi_error / 3)
    assert any("times their errors" in text for text in measured.fit("mine", far).warnings)


def test_a_hysteresis_that_no_point_shows_is_told(tmp_path, anb):
    pairs = [(T, anb.equilibrium_polymer_fraction(T)) for T in [*range(292, 305), *range(306, 316)]]
    told = measured.fit("mine", read_pairs(tmp_path, pairs)).warnings
    assert any("but no temperature is measured in both states" in text for text in told)
    dry = [
        (305.2, anb.equilibrium_polymer_fraction(305.2, branch)) for branch in ("swollen", "dry")
    ]
    told = measured.fit("mine", read_pairs(tmp_path, pairs + dry)).warnings
    assert not any("hysteresis" in text for text in told)


@given(
    middle=st.floats(300.0, 312.0),
    width=st.floats(0.3, 6.0),
    swollen=st.floats(0.01, 0.1),
    dry=st.floats(0.3, 0.9),
    step=st.floats(0.5, 4.0),
)
@settings(max_examples=60, deadline=None, derandomize=True)
def test_points_of_an_accepted_fit_are_on_stable_branches(middle, width, swollen, dry, step):
    """Sigmoids of any middle, width, ends and step: fitted and stable, or refused."""
    T = np.arange(290.0, 323.0, step)
    phi = swollen * (dry / swollen) ** (0.5 + 0.5 * np.tanh((T - middle) / width))
    points = measured.Points(T, phi, np.full(len(T), 0.1), 0.01 * phi, False)
    if outcome(points).startswith("mine: the point"):
        return
    found = measured.fit("mine", points)
    for t, f in zip(T, phi, strict=True):
        roots, stable = found.gel.equilibrium_polymer_fractions(t)
        nearest = np.abs(np.log(roots[stable] / f)).min(initial=np.inf)
        vertical = np.abs(found.gel.equilibrium_temperature(f) - t)
        on_stable = found.gel.osmotic_modulus(f, found.gel.equilibrium_temperature(f)) > 0
        misfit = found.reduced_chi2 > 3
        assert nearest < 0.1 or (on_stable and vertical < 1.0) or misfit, (t, f)
        if misfit:
            assert any("times their errors" in text for text in found.warnings)
