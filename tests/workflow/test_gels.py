"""Gels through the workflow: warnings where everyone sees them, refusals that delete nothing."""

import pandas as pd

from gelpump import netcdf

PNIPAM = """T (°C);phi
20;0,0473
22;0,0516
24;0,0572
26;0,0648
28;0,0762
29;0,0844
30;0,0958
31;0,1134
32;0,1473
33;0,6912
34;0,7147
35;0,7309
36;0,7431
"""
BLOCK = """gels:
  my-gel:
    model: measured
    points: points.csv
    columns: {temperature: T (°C), polymer_fraction: phi}
"""
COARSE = "20;0,0472\n25;0,0478\n30;0,0628\n35;0,3372\n40;0,5842\n45;0,5994\n50;0,6\n"


def test_a_measured_gel_and_one_that_no_form_represents(clone):
    own = clone.path / "own"
    own.mkdir()
    (own / "points.csv").write_text(PNIPAM, encoding="utf-8")
    (own / "mine.yaml").write_text(BLOCK, encoding="utf-8")
    result = clone.snakemake("gel_my-gel", config="own/mine.yaml")
    said = result.stdout + result.stderr
    assert result.returncode == 0, said
    assert "gel my-gel: errors were not given" in said
    assert "no temperature is measured in both states there" in said
    folder = clone.path / "results/gels"
    table = pd.read_csv(folder / "my-gel.csv")
    assert (table.quantity == "warning").sum() == 2
    assert "left out" in table.quantity.values  # 315 K, beyond what was measured
    data = netcdf.read(folder / "my-gel.nc")
    assert "hysteresis" in data.attrs["warnings"]
    assert float(data.temperature.max()) <= 36 + 273.15 + 5
    assert {"A0_interval", "residual", "fold_temperature_interval"} <= set(data)
    before = {file: file.read_bytes() for file in folder.iterdir()}
    (own / "points.csv").write_text("T (°C);phi\n" + COARSE, encoding="utf-8")
    result = clone.snakemake("gel_my-gel", config="own/mine.yaml")
    assert result.returncode != 0
    assert "my-gel: no form goes through the points" in result.stdout + result.stderr
    assert before == {file: file.read_bytes() for file in folder.iterdir()}
