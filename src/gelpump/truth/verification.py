"""How the truth was tried: orders, balances, free swelling, and a bead by another solver."""

from collections.abc import Mapping

import numpy as np
import xarray as xr

from gelpump.bead import nonlinear
from gelpump.materials import Gel
from gelpump.materials.piecewise_linear import PiecewiseLinearGel
from gelpump.netcdf import variable
from gelpump.truth.elements import Material
from gelpump.truth.gel import two_states
from gelpump.truth.numbers import wave_numbers
from gelpump.truth.uniform import bead, undeformed, wall
from gelpump.truth.wave import Wave

SMOOTH = ("radius_front", "share", "Phi_behind")
LIMIT = 1e-9  # polymer fractions that Newton's iteration tries may lie outside the gel's bounds


def bead_radius(
    gel: Gel, before: float, after: float, t: float, cells: tuple[int, int], tolerance: float
) -> np.ndarray:
    """Distances of the surface's nodes from the centre at t_BMJ = `t`, over the first radius.

    The bead of `gel` is in equilibrium at the temperature `before` and then kept at `after`.
    """
    phi = gel.equilibrium_polymer_fraction(before)
    mu, radius = gel.shear_modulus(1.0), phi ** (-1 / 3)
    low, high = gel.polymer_fraction_bounds

    def osmotic_pressure(Phi):
        f = np.clip(phi * Phi, low + LIMIT, high - LIMIT)
        return gel.osmotic_pressure(f, after) / mu, gel.osmotic_modulus(f, after) / mu / Phi

    body = bead(Material(osmotic_pressure, gel.shear_modulus(phi) / mu), cells, tolerance)
    *_, last = body.evolve(undeformed(body), t / radius**2)
    fields = body.fields(last.solution[: body.size])
    return np.hypot(fields["r"], fields["z"])[body.elements.nodes[0] == 1]


def verification(
    gel: PiecewiseLinearGel, bead_gel: Gel, bead_case: Mapping, ell: float, Pe: float
) -> xr.Dataset:
    """Errors and orders; dims (mesh) and (number)."""
    rows, missing = [], []
    for k in (1, 2, 4, 8):
        wave = Wave(ell, gel, (4 * k, 10 * k, 10 * k), largest_Pe=Pe)
        (y,) = wave.solve([Pe])
        numbers = wave_numbers(wave, y, Pe)
        rows.append([numbers[name] for name in SMOOTH])
        shed = (1 - ell**2) * (1 - 1 / gel.Phi_inf) * Pe / (1 - ell)
        missing.append(abs(numbers["shed"] - shed) / shed)
    rows = np.array(rows)
    change = np.abs(np.diff(rows, axis=0))

    body = wall(ell, two_states(gel, np.ones(8, bool)), 8, 1e-4)
    before = body.elements.volumes(body.fields(undeformed(body))).sum()
    worst = 0.0
    for step in body.evolve(undeformed(body), 8 * (1 - ell) ** 2):
        volume = body.elements.volumes(body.fields(step.solution[: body.size])).sum()
        worst = max(worst, abs(volume + step.solution[-2:].sum() - before) / before)
    r = body.fields(step.solution[: body.size])["r"]
    free = np.abs(r / body.elements.nodes[0] - gel.Phi_inf ** (-1 / 3)).max()

    case = (bead_case["T_initial"], bead_case["T_final"])
    phi = bead_gel.equilibrium_polymer_fraction(case[0])
    times = np.r_[0.0, bead_case["t"]]
    known = nonlinear.solve(bead_gel, case[1], phi, times, 400, tolerance=1e-8)
    known = known.radius.values[1:] * np.cbrt(phi)
    beads = np.array(
        [
            [
                bead_radius(bead_gel, *case, t, cells, bead_case["tolerance"]).mean()
                for cells in bead_case["meshes"]
            ]
            for t in times[1:]
        ]
    )
    return xr.Dataset(
        {
            "wave": variable(("mesh", "number"), rows, ", ".join(SMOOTH) + " of a wave"),
            "order": variable(
                "number", np.log2(change[-2] / change[-1]), "order of the three finest meshes"
            ),
            "wave_balance_error": variable(
                "mesh", missing, "what a wave sheds, over what geometry says, less one"
            ),
            "wall_balance_error": variable(
                (), worst, "largest share of a wall's water unaccounted for in a run"
            ),
            "free_swelling_error": variable(
                (), free, "stretch of a collapsed wall less Phi_inf^(-1/3)"
            ),
            "bead_radius": variable(
                ("t", "bead_mesh"), beads, "radius of the bead by finite elements over its first"
            ),
            "bead_radius_nonlinear": variable("t", known, "the same by shells and CVODE"),
        },
        {"t": variable("t", times[1:], "elapsed time", "t_BMJ")},
    )
