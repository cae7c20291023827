"""A design in millimetres and seconds: hand calculations, refusals, units, lights, inverse."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pint
import pytest
import xarray as xr
import yaml
from scipy.integrate import quad
from scipy.special import erfinv

from gelpump.design import __main__ as command
from gelpump.design import dataset, description, device, heat, inverse, units, validity
from gelpump.design.gel_errors import gel_errors, gel_note
from gelpump.design.result import AMBER, GREEN, RED
from gelpump.materials import measured
from gelpump.tube.deswelling import deswelling_time
from gelpump.tube.heat import FRONT_CONSTANT
from gelpump.tube.stefan import Surrounding, front_constant
from gelpump.tube.tubes import Tubes
from gelpump.tube.wall import deswelling_times

PROJECT = Path(__file__).resolve().parents[2]
GELS = yaml.safe_load((PROJECT / "config/config.yaml").read_text())["gels"]
FILES = {file.stem: file for file in (PROJECT / "config/designs").glob("*.yaml")}
UNIT = pint.UnitRegistry(autoconvert_offset_to_baseunit=True)


def block(name, **changed):
    return description.read(FILES[name]) | changed


def design(name, **changed):
    return description.checked(name, block(name, **changed), GELS)


def number(found, key):
    return next(each for each in device.results(found) if each.key == key)


def hand_time(wall, k, mu, Pi_00, M, Pi_ratio, Phi_inf):
    """t_99 from section 3.4 as it is printed, in seconds, by adaptive quadrature."""
    rate = (16 * k * Pi_00 / (mu * wall**2)).to("1/s").magnitude
    integral, _ = quad(
        lambda Phi: 1 / ((Phi_inf - Phi) * (Pi_ratio * Phi ** (5 / 3) / Phi_inf + 4 * M / 3 * Phi)),
        1, Phi_inf - (Phi_inf - 1) / 100, epsabs=0, epsrel=1e-12,
    )  # fmt: skip
    return integral / rate


def hand_gel(A0, A1, B0, B1, Omega, T, phi, **_):
    """phi dPi/dphi in units of k_B T/Omega_f by a difference quotient, and Pi itself."""

    def Pi(phi):
        chi, slope = A0 + B0 * T + (A1 + B1 * T) * phi, A1 + B1 * T
        return (
            (phi - phi ** (1 / 3)) / Omega - phi - math.log(1 - phi) - phi**2 * chi
            + phi**2 * (1 - phi) * slope
        )  # fmt: skip

    h = 1e-4 * phi
    slope = (8 * (Pi(phi + h) - Pi(phi - h)) - (Pi(phi + 2 * h) - Pi(phi - 2 * h))) / (12 * h)
    return phi * slope, Pi(phi)


def test_heat_that_the_water_takes_along_leaves_no_front():
    """An insulated tube whose water is faster than its heat: red, and no crash."""
    found = design("microtube", surrounding="insulated", thermal_diffusivity="1e-10 m^2/s")
    lights = {each.criterion.key: each for each in validity.before_solving(found)}
    assert lights["heat"].light == RED
    known = design("microtube", surrounding="insulated", thermal_diffusivity="1e-10 m^2/s",
                   enthalpy="5.5 kJ/mol")  # fmt: skip
    assert "travel_time_held_back" not in {each.key for each in device.results(known)}


def test_a_gel_that_is_unstable_where_it_starts_is_red():
    """D < 0 already at the swollen fraction when hot: a ratio of two negative numbers was green."""
    found = design("millitube", critical_temperature="309 K", heating_step="2 K")
    least, _ = validity.smallest_diffusivity(found)
    gel = found.material.gel
    assert gel.diffusivity(found.material.phi_00, found.T_hot) < 0
    assert least < 0
    assert validity.ONE_PHASE.light(least) == RED


def test_the_microtube_by_hand():
    found = design("microtube")
    k, mu, Pi = UNIT("1e-15 m^2"), UNIT("0.89 mPa*s"), UNIT("10 kPa")
    t_99 = hand_time(UNIT("50 um"), k, mu, Pi, 1.0, 1.0, 2.0)
    assert number(found, "response_time").value == pytest.approx(t_99, rel=1e-6)
    kappa, L = UNIT("1.43e-7 m^2/s"), UNIT("2 mm")
    travel = (L**2 / (4 * erfinv(0.5) ** 2 * kappa)).to("s").magnitude  # erfcinv(1/2) = erfinv(1/2)
    assert number(found, "travel_time").value == pytest.approx(travel, rel=1e-6)
    assert number(found, "Lewis_number").value == pytest.approx(
        (kappa * mu / (k * Pi)).to("").magnitude, rel=1e-12
    )


def test_the_millitube_by_hand():
    found, gel = design("millitube"), GELS["HHT"]
    kT = [UNIT("1.380649e-23 J/K") * UNIT.Quantity(T, "K") / UNIT("3e-29 m^3") for T in (303, 307)]
    phi = found.material.phi_00, found.material.phi_00 * found.material.Phi_inf
    both = [hand_gel(**gel, T=T, phi=f) for T, f in zip((303, 307), phi, strict=True)]
    moduli, zeros = zip(*both, strict=True)
    assert np.abs(zeros).max() < 1e-12
    Pi_00, Pi_hot = (each * modulus for each, modulus in zip(kT, moduli, strict=True))
    mu_s = kT[0] * phi[0] ** (1 / 3) / gel["Omega"]
    t_99 = hand_time(
        UNIT("0.4 mm"), UNIT("5e-18 m^2"), UNIT("0.89 mPa*s"), Pi_00,
        (mu_s / Pi_00).to("").magnitude, (Pi_hot / Pi_00).to("").magnitude, phi[1] / phi[0],
    )  # fmt: skip
    assert number(found, "response_time").value == pytest.approx(t_99, rel=1e-6)
    z = (2 * erfinv(0.5) * (UNIT("1.43e-7 m^2/s") * UNIT("100 s")) ** 0.5).to("mm").magnitude
    assert 10 * 1e3 * number(found, "front_coefficient").value == pytest.approx(z, rel=1e-6)


def test_the_bead_by_hand():
    found, gel = design("bead"), GELS["HHT"]
    phi = found.material.phi_00 * found.material.Phi_inf
    modulus, zero = hand_gel(**gel, T=307, phi=phi)
    assert abs(zero) < 1e-12
    Pi_hot = modulus * UNIT("1.380649e-23 J/K") * UNIT("307 K") / UNIT("3e-29 m^3")
    t = (UNIT("0.89 mPa*s") * UNIT("150 um") ** 2 / (UNIT("5e-18 m^2") * Pi_hot)).to("s").magnitude
    assert number(found, "poroelastic_time").value == pytest.approx(t, rel=1e-6)
    end = 150e-6 * found.material.Phi_inf ** (-1 / 3)
    assert number(found, "final_radius").value == pytest.approx(end, rel=1e-12)


def test_units_do_not_matter():
    other = design("microtube", a_0="5e-5 m", a_1="0.1 mm", heated_length="0.2 cm",
                   permeability="1e-9 mm^2", viscosity="8.9e-4 Pa s",
                   thermal_diffusivity="0.143 mm²/s", critical_temperature="305.15 K",
                   heating_step="3 delta_degC")  # fmt: skip
    for mine, theirs in zip(
        device.results(design("microtube")), device.results(other), strict=True
    ):
        assert theirs.value == pytest.approx(mine.value, rel=1e-12), mine.key
    for each in device.results(other):
        assert each.quantity.check(units.registry().parse_units(each.unit).dimensionality)


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"a_1": "150 K"}, "a_1 = '150 K': is in K; must be a quantity in m or the like"),
        ({"a_1": "150"}, "a_1 = '150': is in no unit; must be a quantity in m"),
        ({"a_1": "150 furlongz"}, "a_1 = '150 furlongz': is in 'furlongz', which is no unit"),
        ({"a_1": 150}, "a_1 = 150: must be of type string"),
        ({"a_1": "9**9**9**9 m"}, "is not a number with a unit"),
        ({"a_1": "__import__('os') m"}, "is not a number with a unit"),
        ({"a_1": "nan m"}, "is not a number with a unit"),
        ({"a_1": "1e999 m"}, "is not a finite number"),
        ({"a_1": "-1 mm"}, "a_1 = '-1 mm': must be greater than 0"),
        ({"a_0": "100 um"}, "a_0 = '100 um': must be less than a_1 = '100 um'"),
        ({"a_0": "1 mm"}, "a_0 = '1 mm': must be less than a_1 = '100 um'"),
        ({"radius": "1 mm"}, "radius = '1 mm': no such key; allowed: ['a_0', 'a_1',"),
        ({"kind": "cube"}, "kind = 'cube': must be one of ['tube', 'bead']"),
        ({"heating_step": "3 degC"}, "heating_step = '3 degC': must be a difference"),
        ({"heating_step": "400 K"}, "heating_step = '400 K': must leave"),
        ({"gel": "none"}, "gel = 'none': must be one of ['ANB', 'HHT', 'linear']"),
        ({"gel": "linear"}, "osmotic_modulus is missing"),
        ({"gel": "HHT", "critical_temperature": "80 degC"}, "must be within 290 to 320 K"),
        ({"gel": "HHT", "osmotic_modulus": "1 kPa"}, "osmotic_modulus = '1 kPa': not allowed"),
        ({"wanted": {"response_time": "10 m"}}, "wanted.response_time = '10 m': is in m"),
        ({"surrounding": "air"}, "surrounding = 'air': must be one of ['unknown', 'bath', 'pipe',"),
        ({"surrounding": "pipe"}, "pipe_section is missing: surrounding = 'pipe' needs it"),
        ({"pipe_section": "1 mm^2"}, "pipe_section = '1 mm^2': only goes with surrounding"),
        ({"surrounding": "pipe", "pipe_section": "0.03 mm^2"}, "pipe_section = '0.03 mm^2': must"),
        ({"surrounding": "pipe", "pipe_section": "1 mm"}, "pipe_section = '1 mm': is in mm"),
        ({"enthalpy": "-50 J/g"}, "enthalpy = '-50 J/g': is not greater than 0"),
        ({"enthalpy": "0 J/g"}, "enthalpy = '0 J/g': is not greater than 0"),
        ({"enthalpy": "50 J"}, "enthalpy = '50 J': is in J; must be a heat per dry mass"),
        ({"enthalpy": "none"}, "enthalpy = 'none': is not a number with a unit; must be a heat"),
        ({"wanted": {"colour": "red"}}, "wanted.colour = 'red': no such key"),
    ],
)  # fmt: skip
def test_refusals_name_key_value_and_what_is_allowed(change, told):
    with pytest.raises(description.DesignError) as refusal:
        design("microtube", **change)
    assert told in str(refusal.value)


@pytest.mark.parametrize("key", description.schema()["tube"]["required"])
def test_a_missing_key_is_named(key):
    rest = block("microtube")
    del rest[key]
    with pytest.raises(description.DesignError, match=f"missing.*{key}|{key} is missing"):
        description.checked("mine", rest, GELS)


def test_a_file_that_is_no_design_is_refused(tmp_path):
    file = tmp_path / "mine.yaml"
    for text in (
        "kind: tube\nkind: bead\n",
        "- 1\n",
        "kind: !!python/object:os.system x\n",
        "a: [\n",
    ):
        file.write_text(text)
        with pytest.raises(description.DesignError, match="is refused"):
            description.checked("mine", description.read(file), GELS)


@pytest.mark.parametrize("name", ["microtube", "millitube"])
@pytest.mark.parametrize("lights", [AMBER, GREEN])
def test_the_inverse_is_the_forward_solved_again(name, lights):
    found = design(name)
    wanted = found.wanted["response_time"].magnitude
    now = device.response_time(found)
    a_0, a_1 = found.si("a_0"), found.si("a_1")
    slower = device.slower(found)

    def time(**changed):
        ell = changed.get("a_0", a_0) / changed.get("a_1", a_1)
        return device.response_time(found, **changed) * slower(ell)

    forward = {
        "wall": lambda x: time(a_0=a_1 - x),
        "a_1": lambda x: time(a_1=x),
        "size": lambda x: time(a_0=x * a_0 / a_1, a_1=x),
        "permeability": lambda x: time(permeability=x),
        "osmotic_modulus": lambda x: time(osmotic_modulus=x),
    }
    ranges = inverse.ranges(found, wanted, now, lights)
    assert {each.key for each in ranges} == set(forward)
    for each in ranges:
        assert each.feasible, each
        by_time = [end for end, by in ((each.low, each.low_by), (each.high, each.high_by))
                   if by == "response time"]  # fmt: skip
        assert by_time, each
        assert forward[each.key](by_time[0]) == pytest.approx(wanted, rel=1e-9)
        for inside in np.linspace(each.low, each.high, 7):
            assert forward[each.key](inside) <= wanted * (1 + 1e-9)


def test_times_are_those_of_walls_resolved_in_r():
    """Interpolated over ell, and the longer of the two surfaces'."""
    found = design("microtube")
    slower = device.slower(found)
    ells = np.array([0.05, 0.3, 0.5, 0.8, 0.97])
    tubes = Tubes(ells, **found.material.numbers)
    times, error = deswelling_times(tubes)
    longer = times[:, 0].max(axis=0) / deswelling_time(tubes)
    doubt = (error[:, 0] / times[:, 0]).max()
    np.testing.assert_allclose([slower(ell) for ell in ells], longer, rtol=doubt)
    assert (longer > 1.6).all()
    assert slower(0.001) == slower(device.LOW)


def test_a_range_ends_where_its_light_changes():
    found = design("microtube")
    ranges = inverse.ranges(found, 10.0, device.response_time(found), AMBER)
    widest = next(each for each in ranges if each.key == "size")
    assert widest.high_by == validity.SLENDER.text
    for factor, light in ((0.999, AMBER), (1.001, RED)):
        a_1 = widest.high * factor
        given = block("microtube", a_0=f"{a_1 / 2:.12g} m", a_1=f"{a_1:.12g} m")
        lights = validity.before_solving(description.checked("x", given, GELS))
        slender = next(each for each in lights if each.criterion is validity.SLENDER)
        assert slender.light == light


def test_a_light_that_a_parameter_does_not_move_leaves_no_range():
    """No wall makes a stout tube slender, and nothing keeps a gel whole that parts on the way."""
    stout = design("microtube", heated_length="0.2 mm")
    found = {each.key: each for each in inverse.ranges(stout, 1.0, 0.02)}
    assert {key for key, each in found.items() if each.feasible} == {"a_1", "size"}
    assert "none, whatever it is (red: the tube is slender)" in inverse.sentence(found["wall"])
    amber = design("microtube", heated_length="0.4 mm")
    assert all(each.feasible for each in inverse.ranges(amber, 1.0, 0.02, AMBER))
    green = {each.key: each for each in inverse.ranges(amber, 1.0, 0.02, GREEN)}
    assert not green["wall"].feasible
    assert green["size"].feasible
    parting = design("millitube", critical_temperature="307.6 K", heating_step="2.4 K")
    assert not any(each.feasible for each in inverse.ranges(parting, 1e9, 20.0))


def test_too_much_is_wanted():
    found = design("microtube")
    ranges = inverse.ranges(found, 1e-12, device.response_time(found))
    assert not any(each.feasible for each in ranges)
    assert "none" in inverse.sentence(ranges[0])


def test_a_jump_through_the_spinodal_is_red():
    jump = design("millitube", critical_temperature="307.6 K", heating_step="2.4 K")
    lights = {each.criterion.key: each for each in validity.before_solving(jump)}
    assert lights["one_phase"].light == RED
    assert lights["one_phase"].value < 0
    assert lights["linearisation"].light == RED
    assert validity.own_response_time(jump) is None


def test_the_tangents_are_exact_for_a_small_step():
    small = design("millitube", critical_temperature="302 K", heating_step="0.01 K")
    own, mine = validity.own_response_time(small), device.response_time(small)
    assert mine == pytest.approx(own, rel=1e-3)


def test_limits_of_the_formulae():
    found = design("microtube")
    assert device.response_time(found, a_0=99e-6) == pytest.approx(
        device.response_time(found) / 2500, rel=1e-9
    )
    slower = design("microtube", viscosity="1.78 mPa*s")
    assert device.response_time(slower) == pytest.approx(2 * device.response_time(found))
    assert replace(found, name="other").material == found.material


def test_the_command_answers(capsys, monkeypatch):
    monkeypatch.chdir(PROJECT)
    assert command.main([str(FILES["microtube"]), "--within", "10 ms"]) == 0
    said = capsys.readouterr().out
    assert "response time, heated everywhere" in said
    assert "thickness of the wall, same outer radius:" in said
    assert command.main([str(FILES["microtube"]), "--within", "10 mm"]) == 1
    assert command.main(["no-such-file.yaml"]) == 1


def test_the_command_takes_a_measured_gel_from_any_folder(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    points = (PROJECT / "config/gels/synthetic.csv").read_text()
    (tmp_path / "own").mkdir()
    (tmp_path / "own/points.csv").write_text(points)
    config = tmp_path / "own/mine.yaml"
    config.write_text("gels: {mine: {model: measured, points: points.csv}}")
    device_file = tmp_path / "device.yaml"
    given = block("millitube", gel="mine", critical_temperature="303 K")
    device_file.write_text(yaml.safe_dump(given))
    assert command.main([str(device_file), "--config", str(config)]) == 0
    assert "response time" in capsys.readouterr().out
    assert command.main([str(device_file)]) == 1  # mine is not among the project's gels
    assert "must be one of ['ANB', 'HHT', 'linear']" in capsys.readouterr().err
    config.write_text("gels: {mine: {model: measured, points: no.csv}}")
    assert command.main([str(device_file), "--config", str(config)]) == 1
    assert "mine: points = 'no.csv': no such file" in capsys.readouterr().err


@pytest.mark.parametrize("text", ["figures: {}", "", "gels: {}"])
def test_a_configuration_without_gels_adds_none(tmp_path, text, capsys):
    (tmp_path / "none.yaml").write_text(text)
    run = [str(FILES["microtube"]), "--config", str(tmp_path / "none.yaml")]
    assert command.main(run) == (0 if text else 1)
    assert text or "must be blocks of gels" in capsys.readouterr().err


@pytest.mark.parametrize("text", ["gels: 3", "gels: {a: 3}", "[1, 2]"])
def test_a_configuration_of_other_things_is_refused(tmp_path, text, capsys):
    (tmp_path / "odd.yaml").write_text(text)
    assert command.main([str(FILES["microtube"]), "--config", str(tmp_path / "odd.yaml")]) == 1
    assert "must be blocks of gels by name" in capsys.readouterr().err


def test_a_gel_of_the_literature_brings_its_own_solvent():
    """Its molar volume turns pressures into pascal; a second one is refused."""
    name = "acryloylpyrrolidine"
    text = (PROJECT / f"config/gels/{name}.yaml").read_text()
    gel = yaml.safe_load(text)["gels"][name]
    given = block("millitube", gel=name, critical_temperature="45 degC", heating_step="10 K")
    found = description.checked("mine", given, {name: gel})
    other = gel | {"solvent_molar_volume": 3.6e-5}
    halved = description.checked("mine", given, {name: other})
    assert halved.material.Pi_00 == pytest.approx(found.material.Pi_00 / 2, rel=1e-12)
    with pytest.raises(description.DesignError, match="molecule_volume = '3e-29 m"):
        description.checked("mine", given | {"molecule_volume": "3e-29 m^3"}, {name: gel})


def test_what_to_beware_of_in_a_measured_gel_stands_in_the_table():
    data = xr.Dataset(attrs={"gel_warnings": "Of the gel’s fit: no point is dry."})
    [(key, text, *_)] = dataset.csv_rows(data)
    assert (key, text) == ("gel_warnings", data.attrs["gel_warnings"])
    fit = measured_gel()[1]
    for chi2, light in ((1.0, GREEN), (5.0, AMBER), (20.0, RED)):
        assert validity.fitted(replace(fit, reduced_chi2=chi2)).light == light


def plausible(found):
    return next(e for e in validity.before_solving(found) if e.criterion is validity.PLAUSIBLE)


@pytest.mark.filterwarnings("ignore:eps = .* is of order one")
@pytest.mark.parametrize("name", FILES)
def test_no_input_may_be_absurd_under_green_lights(name):
    """Every quantity of the examples, a thousand to 1e18 times larger and smaller."""
    assert plausible(design(name)).light == GREEN
    given, scanned = design(name).given, 0
    for key in set(block(name)) & set(given):
        value = given[key]
        for power in (-18, -9, -6, -3, 3, 6, 9, 18):
            moved = {key: f"{value.magnitude * 10.0**power:.6e} {value.units:~C}"}
            try:
                found = design(name, **moved)
            except description.DesignError:
                continue
            scanned += 1
            light = plausible(found)
            if abs(power) > 9:
                assert light.light == RED, moved
            if key in ("viscosity", "permeability") and abs(power) > 6:
                assert light.light == RED, moved
            low, high = validity.USUAL[key]
            moved_to = value.magnitude * 10.0**power
            assert (light.light == GREEN) == (not validity.unusual(found))
            if not low <= moved_to <= high:
                assert key.replace("_", " ") in light.reason
    assert scanned > 25


def test_a_viscosity_in_megapascal_seconds_is_red_and_leaves_no_range():
    thick = design("microtube", viscosity="0.89 MPa*s")
    assert plausible(thick).light == RED
    assert "viscosity = 8.9 × 10⁵ Pa*s, usually" in plausible(thick).reason
    assert not any(each.feasible for each in inverse.ranges(thick, 1e9, 1e8))
    pebble = design("microtube", permeability="1e-9 m^2")
    assert plausible(pebble).light == RED


@pytest.mark.parametrize("criterion", validity.CRITERIA, ids=lambda each: each.key)
def test_every_criterion_has_three_lights(criterion):
    better, worse = (2.0, 0.5) if criterion.large else (0.5, 2.0)
    assert criterion.light(criterion.green) == GREEN
    assert criterion.light(criterion.green * better) == GREEN
    assert criterion.light(math.sqrt(criterion.green * criterion.amber)) == AMBER
    assert criterion.light(criterion.amber) == AMBER
    assert criterion.light(criterion.amber * worse) == RED


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [
        (12.7251, 4, "12.73"),
        (5.0, 3, "5"),
        (-2.4634, 3, "−2.46"),
        (16000, 2, "16000"),
        (1e-7, 3, "10⁻⁷"),
        (-1e7, 3, "−10⁷"),
        (1.1236e-8, 4, "1.124 × 10⁻⁸"),
        (9.999e-4, 2, "0.001"),
        (120000, 2, "1.2 × 10⁵"),
        (0.0, 3, "0"),
    ],
)
def test_numbers_as_they_are_typeset(value, digits, text):
    assert units.told(value, digits) == text


def measured_gel():
    points = measured.read(PROJECT / "config/gels/synthetic.csv")
    fit = measured.fit("synthetic", points)
    gel = {"model": "energy-based"} | dict(zip(measured.NAMES, fit.parameters, strict=True))
    return gel | {"temperature_range": list(fit.gel.temperature_range)}, fit


def test_errors_of_a_measured_gel_reach_the_numbers():
    """Linear propagation against gels drawn from the covariance itself."""
    gel, fit = measured_gel()
    given = block("millitube") | {"gel": "synthetic", "critical_temperature": "303 K"}
    errors = gel_errors("mine", given, fit)
    rng = np.random.default_rng(1)
    axes = np.linalg.eigh(fit.covariance)
    drawn = []
    for _ in range(200):
        shift = axes.eigenvectors @ (np.sqrt(np.maximum(axes.eigenvalues, 0)) * rng.normal(size=5))
        moved = gel | dict(zip(measured.NAMES, map(float, fit.parameters + shift), strict=True))
        found = device.results(description.checked("mine", given, {"synthetic": moved}))
        drawn.append({each.key: each.value for each in found})
    for key in ("response_time", "osmotic_modulus", "M", "Pi_ratio", "Phi_inf", "Lewis_number"):
        assert errors[key] == pytest.approx(np.std([each[key] for each in drawn]), rel=0.2), key
    for key in ("travel_time", "front_speed", "ell", "wall"):
        assert errors[key] == 0, key
    assert "standard error" in gel_note(errors)


def test_a_gel_that_its_errors_make_impossible_is_told_so():
    _, fit = measured_gel()
    wide = replace(fit, covariance=1e6 * fit.covariance)
    with pytest.raises(description.DesignError) as refusal:
        gel_errors("mine", block("millitube") | {"gel": "synthetic"}, wide)
    assert "not carried over" in gel_note(refusal.value)


def heated(**changed):
    found = design("microtube", **changed)
    return found, next(e for e in validity.before_solving(found) if e.criterion is heat.HEAT)


def test_groups_of_heat_by_hand():
    found, light = heated(enthalpy="5.5 kJ/mol", surrounding="pipe", pipe_section="0.0628 mm^2")
    stored = UNIT("4.18e6 J/m^3/K") * UNIT("3 K")
    dry = UNIT("5.5 kJ/mol") / UNIT("113.16 g/mol") * UNIT("1100 kg/m^3")
    St = (0.05 * dry / stored).to("").magnitude
    assert number(found, "St").value == pytest.approx(St, rel=1e-12)
    assert number(found, "P").value == pytest.approx((UNIT("10 kPa") / stored).to("").magnitude)
    assert heat.groups(found)["N"] == pytest.approx(305.15 / 3, rel=1e-9)
    per_mass = heated(enthalpy=f"{5.5e3 / 113.16:.12g} J/g", surrounding="bath")[0]
    assert number(per_mass, "St").value == pytest.approx(St, rel=1e-9)
    section = 0.0628e-6 / (math.pi * 1e-8)
    assert heat.section(found) == pytest.approx(section, rel=1e-9)
    assert number(found, "f_St").value == pytest.approx(0.75 * St / section, rel=1e-9)
    tube = Tubes(0.5, 0.05)
    held = float(front_constant(tube, St, Surrounding("pipe", section))[0] / FRONT_CONSTANT)
    assert light.value == pytest.approx(1 - held, rel=1e-9)
    times = number(found, "travel_time_held_back").value, number(found, "travel_time").value
    assert times[0] / times[1] == pytest.approx(held**-2, rel=1e-9)


@pytest.mark.parametrize(
    ("change", "light", "told"),
    [
        ({"surrounding": "bath", "enthalpy": "50 J/g"}, GREEN, "in a bath"),
        ({"surrounding": "bath"}, GREEN, "6.5 kJ/mol, the enthalpy being unknown"),
        ({"surrounding": "pipe", "pipe_section": "0.07 mm^2", "enthalpy": "50 J/g"}, AMBER, "pipe"),
        (
            {"surrounding": "pipe", "pipe_section": "0.0315 mm^2", "enthalpy": "150 J/g"},
            RED,
            "pipe",
        ),
        ({"surrounding": "pipe", "pipe_section": "0.0315 mm^2"}, AMBER, "unknown"),
        ({"surrounding": "pipe", "pipe_section": "10 mm^2"}, GREEN, "unknown"),
        ({"surrounding": "insulated", "enthalpy": "50 J/g"}, RED, "if insulated"),
        ({"surrounding": "unknown", "enthalpy": "50 J/g"}, AMBER, "surrounding unknown"),
        ({"gel": "linear", "osmotic_modulus": "10 kPa"}, AMBER, "polymer fraction is not given"),
    ],
)
def test_the_light_of_heat(change, light, told):
    found = heated(**change)[1]
    assert found.light == light, found
    assert told in found.reason


def test_a_bead_is_cooled_by_its_collapse():
    found = design("bead")
    light = next(e for e in validity.before_solving(found) if e.criterion is heat.HEAT)
    assert light.light == GREEN
    fast = heat.shift(design("bead", permeability="5e-15 m^2"), "bath", number(found, "St").value)
    assert abs(fast) == pytest.approx(1000 * light.value, rel=1e-9)


def test_an_energy_tells_its_own_latent_heat():
    found = design("millitube")
    gel, T = found.material.gel, 305.0
    unit = 1.380649e-23 * T**2 / 3e-29
    U = [-unit * (1 - x) * (gel.B0 + gel.B1 * x) for x in found.material.phi_00 * np.array(
        [1, found.material.Phi_inf])]  # fmt: skip
    assert number(found, "own_latent_heat").value == pytest.approx(U[1] - U[0], rel=1e-8)
