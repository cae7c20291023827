"""Where the water of a collapsing tube goes: out of its wall, into its lumen, along it.

A slice dX of the wall, X being the axial coordinate of the swollen tube, has the volume
pi (1-ell^2) dX/Phi_1, all of whose change is water. Since dX = Phi_1^{1/3} dZ, the volume shed is

    pi (1-ell^2) Integral (Phi_1^{1/3} - Phi_1^{-2/3}) dZ

and the rate of shedding, from DPhi_1/Dtau = F + Phi_1 V_g,Z (`gelpump.tube.slender`),

    pi (1-ell^2) Integral [ F Phi_1^{-5/3} + Phi_1^{-2/3} V_g,Z ] dZ .

Through the edges, which slope, flows  2 pi B (U_g - B' V_g).  As printed, with U_g from eqn:ug and
eqn:phi2 and without the slope, what leaves is

    outwards:  pi (1-ell)/2 Integral F Phi_1^{-5/3} dZ,     to the lumen:  ell times as much,

together half of the source's part of the shed rate: the 16 of F against the 8 of eqn:phi2. Where
all the water of a wall that conserves it goes is told by `gelpump.tube.pump`.
"""

import numpy as np
import xarray as xr

from gelpump.netcdf import variable
from gelpump.tube import lumen, scaling
from gelpump.tube.wall_flow import Wall, lumen_share, source_coefficient

SIDES = ("behind", "ahead")


def water_budget(pulse: xr.Dataset) -> xr.Dataset:
    """Rates and volumes of each tube and time, dims (ell, tau) and the side of the front.

    `pulse` is what `gelpump.tube.solve` gives; volumes in a_1^2 L, times in mu_l L^2/(k Pi_00)
    (section 3.6.2).
    """
    wall, behind = Wall.of(pulse), pulse.attrs["cells_behind"]
    ell = pulse.ell.values[:, np.newaxis]

    def by_side(running):
        total = np.pi * running
        return np.stack([total[..., behind], total[..., -1] - total[..., behind]], axis=-1)

    source = by_side(wall.integral(wall.F * wall.Phi1 ** (-5 / 3)))
    V_g = wall.axial_velocity_face
    spread = wall.Phi1 ** (-2 / 3) * np.diff(V_g)
    along = by_side(wall.integral(spread / wall.cell_length))
    shed = (1 - ell**2)[..., np.newaxis] * (source + along)
    rates = {
        "shed_rate": (shed, "rate at which the wall sheds water"),
        "outer_rate_printed": (
            (1 - ell)[..., np.newaxis] / 2 * source,
            "flow of water out of the tube, eqn:ug with eqn:phi2",
        ),
        "lumen_rate_printed": (
            (ell * (1 - ell))[..., np.newaxis] / 2 * source,
            "flow of water into the lumen, eqn:ug with eqn:phi2",
        ),
    }
    data = {
        name: variable(("ell", "tau", "side"), values, text, scaling.VOLUME_RATE)
        for name, (values, text) in rates.items()
    }
    volume = (
        np.pi * (1 - ell**2) * wall.integral(np.cbrt(wall.Phi1) - wall.Phi1 ** (-2 / 3))[..., -1]
    )
    total = shed.sum(axis=-1)
    behind_front = (slice(None), slice(None), behind)
    lumen_area = np.pi * ell**2
    V = {name: form(wall)[..., -1] for name, form in lumen.VELOCITIES.items()}
    data |= {
        "axial_rate_front": variable(
            ("ell", "tau"),
            -np.pi * (1 - ell**2) * (wall.Phi1_face ** (-2 / 3) * V_g)[behind_front],
            "flow of water through the wall from the swollen to the dry side of the front",
            scaling.VOLUME_RATE,
        ),
        "radial_to_axial_velocity": variable(
            ("ell", "tau"),
            wall.radial_to_axial_velocity,
            "largest radial over largest axial interstitial velocity, both in the same units",
            "U_g of eqn:ug with eqn:phi2 at the outer edge of the wall",
        ),
        "shed_volume": variable(
            ("ell", "tau"), volume, "water that the wall has shed", scaling.VOLUME
        ),
        "shed_volume_error": variable(
            ("ell", "tau"),
            volume - volume[:, :1] - _since_first(pulse.tau.values, total),
            "water shed since the first time, less the integral of its rate",
            scaling.VOLUME,
        ),
        "source_coefficient": variable(
            "ell",
            source_coefficient(pulse.ell.values),
            "coefficient of F that follows from the conditions on Phi_2, where F has 16",
        ),
        "lumen_share": variable(
            "ell",
            lumen_share(pulse.ell.values),
            "part of the source's water that goes to the lumen",
        ),
    } | {
        f"far_flux_{name}": variable(
            ("ell", "tau"),
            lumen_area * far,
            f"flow of water along the lumen far ahead of the front, V {name}",
            scaling.VOLUME_RATE,
        )
        for name, far in V.items()
    }
    return xr.Dataset(
        data,
        coords={
            "ell": scaling.ell(pulse.ell.values),
            "tau": scaling.tau(pulse.tau.values),
            "side": (
                "side",
                np.arange(2, dtype="int8"),
                {
                    "long_name": "side of the front",
                    "flag_values": np.arange(2, dtype="int8"),
                    "flag_meanings": " ".join(SIDES),
                },
            ),
        },
    )


def _since_first(tau, rate):
    """Integral of the rate from the first time on; smooth in sqrt(tau), as Z_C is."""
    from scipy.interpolate import CubicSpline

    t = np.sqrt(tau)
    return CubicSpline(t, rate * 2 * t, axis=1).antiderivative()(t)
