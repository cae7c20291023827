"""Figure 9: how sharp the drying front is, in tubes of different thickness."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from gelpump.figures import style
from gelpump.figures.style import Quantity

if TYPE_CHECKING:
    import xarray as xr

REACH = 0.11  # of the profiles to either side of the front, in L
CLOSE = 0.01  # of the inset
YTICKS = [20, 50, 100, 200, 500, 1000]
STEP = {"color": style.GREY, "linewidth": 0.8}
TANH = {"linewidth": 0.7, "linestyle": (0, (4, 2))}
GUIDE = {"color": style.GREY, "linewidth": 0.9, "linestyle": ":"}


def draw(
    pulse: "xr.Dataset",
    fit: "xr.Dataset",
    ells: Sequence[float],
    published_profiles: Mapping[str, Sequence[float]],
    published_sharpness: Sequence[float],
) -> Figure:
    """(a) Profiles about the front with their tanh fits; (b) sharpness against thickness.

    pulse: ``Phi1`` over ``Z - Z_C`` of the tubes ``ells`` at the time of the fit.  fit: a dataset
    of ``tube.front_fit``; ``A`` with its uncertainty at all ell, and the power law ``prefactor``,
    ``exponent``.  published_profiles: read-off ``Phi1`` at Z_C of the tubes ``ell``.
    published_sharpness: A of ``ells``.
    """
    fig = style.figure(height=2.95)
    left, right = fig.subplots(1, 2, width_ratios=(1.2, 1.0))
    _profiles(
        fig, left, pulse.sel(tau=fit.fit_tau, method="nearest"), fit, ells, published_profiles
    )
    _sharpness(right, fit, ells, published_sharpness)
    _tell(fig, pulse.sel(tau=fit.fit_tau, method="nearest"), fit, ells)
    for name, panel, columns in (
        (
            "profile at the front published",
            "a",
            {
                Quantity.ELL: published_profiles["ell"][: len(published_profiles["Phi1"])],
                Quantity.AHEAD: 0.0,
                Quantity.PHI: published_profiles["Phi1"],
            },
        ),
        (
            "sharpness published",
            "b",
            {
                Quantity.THICKNESS: 1 - np.array(ells[: len(published_sharpness)]),
                Quantity.SHARPNESS: published_sharpness,
            },
        ),
    ):
        style.tell(fig, panel, name, columns)
    style.panel_label(left, "a")
    style.panel_label(right, "b")
    return fig


def _profiles(fig, ax, pulse, fit, ells, published):
    Phi_inf = float(pulse.Phi_inf.max())
    inset = ax.inset_axes((0.635, 0.57, 0.345, 0.4))
    for each in (ax, inset):
        each.plot([-REACH, 0, 0, REACH], [Phi_inf, Phi_inf, 1, 1], label=r"$\Phi_0(T)$", **STEP)
        _tubes(each, pulse, fit, ells, Phi_inf)
    colours = style.ell_colours(published["ell"])
    for Phi1, colour in zip(published["Phi1"], colours, strict=False):
        inset.plot(0.0, Phi1, zorder=5, **style.PUBLISHED_MARKER | {"markeredgecolor": colour})
    ax.plot([], [], label="published", **style.PUBLISHED_MARKER)
    middle = (1 + Phi_inf) / 2
    inset.set(xlim=(-CLOSE, CLOSE), ylim=(middle - 0.16, middle + 0.04))
    inset.set_xticks([-0.6 * CLOSE, 0.6 * CLOSE])
    style.zoom(ax, inset, joined=False)
    ax.set(xlim=(-REACH, REACH), xlabel="$Z-Z_C$ (in $L$)", ylabel=r"polymer fraction $\Phi_1$")
    ax.set_title(rf"$\tau={float(pulse.tau):g}$")
    ax.legend(loc="lower left", handlelength=1.6, borderaxespad=0.3)
    style.steps(fig, ax, ells, style.ell_colours(ells), r"$\ell=a_0/a_1$")


def _tubes(ax, pulse, fit, ells, Phi_inf):
    x = np.linspace(-REACH, REACH, 801)
    for rank, (ell, colour) in enumerate(zip(ells, style.ell_colours(ells), strict=True)):
        tube = pulse.sel(ell=ell, method="nearest")
        ax.plot(*_profile(tube), color=colour, linewidth=1.2)
        A = float(fit.A.sel(ell=ell, method="nearest"))
        ax.plot(
            x, _tanh(A, Phi_inf, x), color=colour, label="tanh fit" if rank == 0 else None, **TANH
        )


def _profile(tube):
    """Z - Z_C and Phi1 near the front."""
    ahead = (tube.Z - tube.Z_C).values
    near = np.abs(ahead) < 1.2 * REACH
    return ahead[near], tube.Phi1.values[near]


def _tanh(A, Phi_inf, x):
    return Phi_inf - (Phi_inf - 1) / 2 * (1 + np.tanh(A * x))


def _tell(fig, pulse, fit, ells):
    Phi_inf = float(pulse.Phi_inf.max())
    for ell in ells:
        x, Phi1 = _profile(pulse.sel(ell=ell, method="nearest"))
        tanh = _tanh(float(fit.A.sel(ell=ell, method="nearest")), Phi_inf, x)
        columns = {Quantity.ELL: ell, Quantity.AHEAD: x, Quantity.PHI: Phi1}
        style.tell(fig, "a", "profile and its tanh fit", columns | {"tanh_fit [phi_00]": tanh})
    thickness = 1 - fit.ell.values
    power_law = float(fit.prefactor) * thickness ** -float(fit.exponent)
    columns = {
        Quantity.THICKNESS: thickness,
        Quantity.SHARPNESS: fit.A,
        "A_uncertainty [1/L]": fit.A_uncertainty,
        "power_law [1/L]": power_law,
    }
    style.tell(fig, "b", "sharpness and its power law", columns)


def _sharpness(ax, fit, ells, published):
    thickness = 1 - fit.ell.values
    bounds = np.array([thickness.min() / 1.25, min(1.0, 1.2 * thickness.max())])
    c, n, error = (float(fit[key]) for key in ("prefactor", "exponent", "exponent_uncertainty"))
    digits = max(0, int(np.ceil(-np.log10(error)))) if error > 0 else 4
    ax.errorbar(
        thickness,
        fit.A,
        yerr=fit.A_uncertainty,
        fmt="o",
        markersize=2.4,
        color=style.LENS,
        elinewidth=0.8,
        label="solved",
    )
    ax.plot(
        bounds,
        c * bounds**-n,
        color=style.LENS,
        linewidth=0.8,
        label=f"$n={n:.{digits}f}\\pm{error:.{digits}f}$",
    )
    ax.plot(
        1 - np.array(ells[: len(published)]),
        published,
        label="published",
        zorder=5,
        **style.PUBLISHED_MARKER,
    )
    guide = np.array([0.16, 0.5])
    ax.plot(guide, 1.8 * c / guide, **GUIDE)
    ax.text(0.3, 2.0 * c / 0.3, "slope $-1$", color=style.GREY, ha="left", va="bottom")
    ax.set(xscale="log", yscale="log", xlim=bounds)
    ax.set(ylim=(0.42 * c, 1.7 * max(*published, float(fit.A.max()))))
    ax.set(xlabel=r"$1-\ell$", ylabel="sharpness $A$ (in $1/L$)")
    for axis, ticks in ((ax.xaxis, [0.05, 0.1, 0.2, 0.5, 1.0]), (ax.yaxis, YTICKS)):
        axis.set_ticks(ticks, labels=[f"{tick:g}" for tick in ticks])
    ax.minorticks_off()
    ax.set_title(r"$A\propto(1-\ell)^{-n}$", loc="right")
    ax.legend(loc="lower left", handlelength=1.4, borderaxespad=0.2)
