"""Spreadsheets as people keep them: read right to the last digit, or refused in words."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gelpump.materials import measurements

T = np.array([20.0, 25.0, 28.5, 31.0, 33.25, 36.0, 40.0, 45.0])  # degC
D = np.array([812.0, 790.5, 742.25, 655.0, 402.0, 371.5, 362.0, 358.0])  # nm
PHI = 0.6 * (345.0 / D) ** 3
BALL = {"polymer_fraction": 0.6, "diameter": "345 nm"}


def rows(*columns, sign=".", sep=","):
    return "\n".join(sep.join(str(x).replace(".", sign) for x in row)
                     for row in zip(*columns, strict=True)) + "\n"  # fmt: skip


def table(heading, *columns, **options):
    return heading + "\n" + rows(*columns, **options)


NAMES = {"temperature": "T / degC", "diameter": "d / nm"}
SIZED = {"columns": NAMES, "reference": BALL}
BOTH = np.r_[T, T[::-1]], np.r_[D, D[::-1]], ["up"] * 8 + ["down"] * 8

# each: what is habitual about it, the file, what is said of it, T in degC and phi expected
READ = {
    "own names in kelvin": (
        table("temperature,polymer_fraction", T + 273.15, PHI), {}, T, PHI),
    "any names with units after a slash": (table("T / degC,d / nm", T, D), SIZED, T, PHI),
    "units in brackets": (
        table("Temp (°C),Size [nm]", T, D),
        {"columns": {"temperature": "Temp (°C)", "diameter": "Size [nm]"}, "reference": BALL},
        T, PHI),
    "units in a row of their own": (
        "Temp;Size\n°C;nm\n" + rows(T, D, sep=";"),
        {"columns": {"temperature": "Temp", "diameter": "Size"}, "reference": BALL}, T, PHI),
    "units in brackets in their row": (
        "Temp\tSize\n[K]\t(µm)\n" + rows(T + 273.15, D / 1000, sep="\t"),
        {"columns": {"temperature": "Temp", "diameter": "Size"}, "reference": BALL}, T, PHI),
    "semicolons and decimal commas": (
        table("T / degC;d / nm", T, D, sign=",", sep=";"), SIZED, T, PHI),
    "quoted decimal commas": (
        "T / degC,d / nm\n" + "".join(f'"{t}","{d}"\n'.replace(".", ",") for t, d in
                                      zip(T, D, strict=True)), SIZED, T, PHI),
    "byte order mark and Windows lines": (
        "\ufeff" + table("T / degC,d / nm", T, D).replace("\n", "\r\n"), SIZED, T, PHI),
    "instrument's preamble, other columns, blank lines": (
        "Instrument;Z\nOperator;me;\n\nNo;T / degC;PDI;d / nm;remark\n"
        + "".join(f"{i};{t};0.05;{d};ok\n\n" for i, (t, d) in enumerate(zip(T, D, strict=True))),
        SIZED, T, PHI),
    "comments": (
        "# my gel, 2023\nT / degC,d / nm\n# slow ramp\n" + rows(T, D), SIZED, T, PHI),
    "blanks where nothing was measured": (
        table("T / degC,d / nm", T, D) + "50,\n55,\n", SIZED, T, PHI),
    "a ratio of diameters": (
        table("T (degC),d/d0", T, D / 345.0),
        {"columns": {"temperature": "T (degC)", "diameter_ratio": "d/d0"},
         "reference": {"polymer_fraction": 0.6}}, T, PHI),
    "a volume swelling ratio to the dry gel": (
        table("T (degC),Q", T, 1 / PHI),
        {"columns": {"temperature": "T (degC)", "volume_ratio": "Q"},
         "reference": {"polymer_fraction": 1}}, T, PHI),
    "a mass swelling ratio": (
        table("T (degC),m/m_dry", T, 1 + (1 / PHI - 1) / 1.1),
        {"columns": {"temperature": "T (degC)", "mass_ratio": "m/m_dry"},
         "reference": {"polymer_density": "1.1 g/cm^3", "solvent_density": "1000 kg/m^3"}}, T, PHI),
    "water uptake in per cent": (
        "T,uptake\ndegC,%\n" + rows(T, 100 * (1 / PHI - 1) / 1.1),
        {"columns": {"temperature": "T", "uptake": "uptake"},
         "reference": {"polymer_density": "1.1 g/cm^3", "solvent_density": "1 g/cm^3"}}, T, PHI),
    "per cent of polymer": (
        table("T [K],phi [%]", T + 273.15, 100 * PHI),
        {"columns": {"temperature": "T [K]", "polymer_fraction": "phi [%]"}}, T, PHI),
    "degrees Fahrenheit": (
        table("T,d", T * 1.8 + 32, D),
        SIZED | {"columns": {"temperature": "T", "diameter": "d"},
                 "units": {"temperature": "degF", "diameter": "nm"}}, T, PHI),
    "heating and cooling in a column, repeated temperatures": (
        table("T / degC,d / nm,run", *BOTH),
        SIZED | {"columns": NAMES | {"branch": "run"},
                 "branches": {"heating": "up", "cooling": "down"}},
        np.r_[T, T[::-1]], np.r_[PHI, PHI[::-1]]),
    "heating and cooling side by side": (
        table("T / degC,up / nm,down / nm", T, D, D),
        SIZED | {"columns": {"temperature": "T / degC",
                             "diameter": {"heating": "up / nm", "cooling": "down / nm"}}},
        np.repeat(T, 2), np.repeat(PHI, 2)),
    "errors": (
        table("T / degC,dT / degC,d / nm,sd / nm", T, 0 * T + 0.2, D, 0.01 * D),
        SIZED | {"columns": NAMES | {"temperature_error": "dT / degC",
                                     "diameter_error": "sd / nm"}}, T, PHI),
    "an Excel's Unicode text": (
        table("T / degC\td / nm", T, D, sep="\t").encode("utf-16"), SIZED, T, PHI),
    "thousands that are told to be decimals": (
        table("T / degC;d / nm", T.astype(int), [f"{d / 1000:.3f}" for d in 1000 * D], sep=";")
        .replace(".", ","), SIZED | {"decimal": ","}, T.astype(int), PHI),
}  # fmt: skip


def written(tmp_path, text):
    path = tmp_path / "points.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode("utf-8"))
    return path


@pytest.mark.parametrize("habit", READ)
def test_a_spreadsheet_is_read_right(habit, tmp_path):
    text, how, t, phi = READ[habit]
    found = measurements.read(written(tmp_path, text), how)
    np.testing.assert_allclose(found.T, t + 273.15, rtol=1e-12)
    np.testing.assert_allclose(found.phi, phi, rtol=1e-12)
    assert found.errors_given == (habit == "errors")
    if habit == "errors":
        np.testing.assert_allclose(found.T_error, 0.2, rtol=1e-9)
        np.testing.assert_allclose(found.phi_error, 0.03 * found.phi, rtol=1e-9)
    if "heating" in habit:
        assert found.on("heating").sum() == found.on("cooling").sum() == 8
    assert bool(found.notes) == ("blanks where" in habit)


PLAIN = table("T / degC,d / nm", T, D)
REFUSED = {
    "no unit of temperature": (table("T,d / nm", T, D),
                               {"columns": {"temperature": "T", "diameter": "d / nm"}},
                               "say units: {temperature"),
    "a coulomb": (table("T / C,d / nm", T, D),
                  {"columns": {"temperature": "T / C", "diameter": "d / nm"}}, "the unit 'C'"),
    "an instrument's unit": (table("T / degC,Z (d.nm)", T, D),
                             {"columns": {"temperature": "T / degC", "diameter": "Z (d.nm)"}},
                             "the unit 'd.nm'"),
    "two units": ("T / degC,d / nm\nK,nm\n" + rows(T, D), {}, "is told as ['degC', 'K']"),
    "kelvin that are degrees": (table("T / K,d / nm", T, D),
                                {"columns": {"temperature": "T / K", "diameter": "d / nm"}},
                                "must be kelvin"),
    "a column twice": (table("T / degC,d / nm,d / nm", T, D, D), {}, "is there twice"),
    "a column that is missing": (table("T / degC,size / nm", T, D), {}, "columns ["),
    "decimal commas between commas": (
        "T / degC,d / nm\n" + "".join(f"{t},{d}\n".replace(".", ",") for t, d in
                                      zip(T, D, strict=True)), {}, "4 values: must be 2"),
    "thousands or decimals": (
        table("T / degC;d / nm", T.astype(int), ["812,250"] * 8, sep=";"), {}, "say decimal"),
    "both decimal signs": (
        "T / degC;d / nm\n20;1.812,5\n" + rows(T, D, sep=";"), {}, "both decimal commas"),
    "units in cells": (PLAIN + "50 °C,358\n", {}, "line 10: temperature = '50 °C'"),
    "not a number": (PLAIN + "50,n/a\n", {}, "line 10: diameter = 'n/a'"),
    "a footer": (PLAIN + "mean,550\n", {}, "line 10: temperature = 'mean'"),
    "a value without its temperature": (PLAIN + ",355\n", {}, "temperature is blank"),
    "more polymer than there can be": (PLAIN + "50,200\n", {}, "line 10: diameter = 2e-07"),
    "a diameter without its reference": (PLAIN, {"reference": {}}, "reference has []"),
    "a reference in other units": (PLAIN, {"reference": BALL | {"diameter": "345 K"}}, "is in K"),
    "two quantities": (PLAIN, {"columns": NAMES | {"volume_ratio": "T / degC"}}, "must name temp"),
    "an unknown branch": (
        table("T / degC,d / nm,run", *BOTH), {"columns": NAMES | {"branch": "run"}},
        "branch = 'up'"),
    "another encoding": (PLAIN.replace("d", "ö").encode("latin-1"), {}, "not in UTF-8"),
    "an Excel file": (b"PK\x03\x04" + bytes(range(128, 256)), {}, "not in UTF-8"),
    "a row cut short": (PLAIN + "50\n", {}, "line 10: 1 values: must be 2"),
    "an unclosed quote": (PLAIN + '"50,355\n', {}, "cannot be read"),
    "too few": ("T / degC,d / nm\n" + rows(T[:5], D[:5]), {}, "5 points: must be 6"),
    "an error of nothing": (
        table("T / degC,d / nm,sd / nm", T, D, 0 * D),
        {"columns": NAMES | {"diameter_error": "sd / nm"}}, "diameter_error = 0"),
}  # fmt: skip


@pytest.mark.parametrize("habit", REFUSED)
def test_a_spreadsheet_is_refused_in_words(habit, tmp_path):
    text, how, told = REFUSED[habit]
    with pytest.raises(ValueError, match=r"points\.csv") as refusal:
        measurements.read(written(tmp_path, text), SIZED | how)
    assert told in str(refusal.value)


CELLS = st.one_of(
    st.floats(0.01, 2000.0).map(lambda x: f"{x:.4g}"),
    st.floats(0.01, 2000.0).map(lambda x: f"{x:.3f}".replace(".", ",")),
    st.sampled_from(
        ["", " ", "nan", "inf", "-", "1e5", "1.2.3", "12,345", "K", "nm", '"', "é", "%"]
    ),
)


ANY = st.recursive(
    st.one_of(
        st.none(), st.booleans(), st.floats(), st.sampled_from(["", "T", "nm", ";", "heating"])
    ),
    lambda inner: st.one_of(
        st.lists(inner, max_size=2),
        st.dictionaries(
            st.sampled_from(["temperature", "diameter", "heating", "polymer_fraction", "x"]),
            inner,
            max_size=2,
        ),
    ),
    max_leaves=4,
)


@given(st.sampled_from(sorted(measurements.KEYS)), ANY)
@settings(max_examples=300, deadline=None, derandomize=True, database=None)
def test_any_value_of_any_key_is_taken_or_refused_in_words(tmp_path_factory, key, value):
    path = tmp_path_factory.mktemp("any") / "points.csv"
    path.write_text(PLAIN)
    found = read_or_refused(path, SIZED | {key: value})
    if not isinstance(found, str):
        np.testing.assert_allclose(found.T, T + 273.15, rtol=1e-12)


def read_or_refused(path, how):
    try:
        return measurements.read(path, how)
    except ValueError as refusal:
        return str(refusal)


@given(
    heading=st.sampled_from(["T / degC", "T / K", "T", "T [°C]", "T (F)"]),
    separator=st.sampled_from([",", ";", "\t"]),
    cells=st.lists(st.tuples(CELLS, CELLS), min_size=1, max_size=9),
    shift=st.floats(0.0, 30.0),
    sign=st.sampled_from([".", ","]),
)
@settings(max_examples=400, deadline=None, derandomize=True, database=None)
def test_any_table_is_read_as_it_was_written_or_refused(
    tmp_path_factory, heading, separator, cells, shift, sign
):
    """Good rows of a known meaning with any others between them, in any dialect."""
    path = tmp_path_factory.mktemp("any") / "points.csv"
    good = [(f"{t + shift:.2f}".replace(".", sign), f"{d:.1f}".replace(".", sign))
            for t, d in zip(T, D, strict=True)]  # fmt: skip
    lines = [separator.join(each) for each in [(heading, "d / nm"), *good, *cells]]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    how = {"columns": {"temperature": heading, "diameter": "d / nm"}, "reference": BALL}
    found = read_or_refused(path, how)
    if isinstance(found, str):
        assert str(path) in found
        return
    assert heading in ("T / degC", "T [°C]")
    np.testing.assert_allclose(found.T[:8], np.round(T + shift, 2) + 273.15, rtol=1e-12)
    np.testing.assert_allclose(found.phi[:8], 0.6 * (345.0 / np.round(D, 1)) ** 3, rtol=1e-12)
    written_rows = [each for each in cells if each[1].strip()]
    assert len(found.T) == 8 + len(written_rows)
    for (t, d), T_found, phi in zip(written_rows, found.T[8:], found.phi[8:], strict=True):
        assert T_found == pytest.approx(float(t.replace(",", ".")) + 273.15, rel=1e-12)
        assert phi == pytest.approx(0.6 * (345.0 / float(d.replace(",", "."))) ** 3, rel=1e-12)
