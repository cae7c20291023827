"""A sweep at its last time: the response surface, or Sobol's indices."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.ticker import FixedFormatter, FixedLocator, NullFormatter, NullLocator

from gelpump.figures import style

if TYPE_CHECKING:
    import xarray as xr

LABELS = {
    "ell": r"$\ell$",
    "M": r"$\mathcal{M}$",
    "Pi_ratio": r"$\tilde\Pi$",
    "Phi_inf": r"$\Phi_\infty$",
    "eps": r"$\epsilon$",
    "Le": r"$\mathrm{Le}$",
    "tau99": r"$\tau_{99}$",
    "A": r"$A$",
    "Phi1_front": r"$\Phi_1(Z_C)$",
    "V_peak": r"$V_{\max}$",
    "pulse_flux": "pulse flux",
}
SHOWN = {  # with their units
    "tau99": r"$\tau_{99}$  ($\mu_l L^2/k\Pi_{00}$)",
    "A": r"$A$  ($1/L$)",
    "Phi1_front": r"$\Phi_1(Z_C)$",
    "V_peak": r"$V_{\max}$  ($k\Pi_{00}/\mu_l L$)",
}
BINS = 14
FEWEST = 30  # designs of a bin on average, else bins are wider
LABELLED = ((1, 1.5, 2, 3, 4, 5, 6, 8), (1, 2, 5), (1, 3), (1,))  # of each decade, if they fit
MOST_LABELS = 5
FIRST, TOTAL = "#0072B2", "#E69F00"


def surface(dataset: "xr.Dataset", varied: dict[str, bool]) -> Figure:
    """Outputs over the two parameters that move them most: medians of the designs in each bin.

    varied: the parameters, and whether each is spaced by its logarithm.
    """
    solved = dataset.isel(index=np.flatnonzero(dataset.status.values < 3), tau=-1)
    bins = int(np.clip(np.sqrt(solved.sizes["index"] / FEWEST), 2, BINS))
    fig = style.figure(height=4.5)
    for ax, (name, label), letter in zip(
        fig.subplots(2, 2).flat, SHOWN.items(), "abcd", strict=True
    ):
        values = solved[name].values
        x, y = _most_moving(solved, varied, values)
        edges = [_edges(solved[key].values, varied[key], bins) for key in (x, y)]
        columns = [
            np.clip(np.digitize(solved[key].values, e) - 1, 0, len(e) - 2)
            for key, e in zip((x, y), edges, strict=True)
        ]
        median = np.full([len(e) - 1 for e in edges], np.nan)
        cell = columns[0] * median.shape[1] + columns[1]
        order = np.argsort(cell, kind="stable")
        cells, starts = np.unique(cell[order], return_index=True)
        for where, group in zip(cells, np.split(values[order], starts[1:]), strict=True):
            median.flat[where] = np.median(group)
        norm = LogNorm(*_limits(median))
        mesh = ax.pcolormesh(
            *edges, median.T, norm=norm, cmap=style.POLYMER_FRACTION, rasterized=True
        )
        bar = fig.colorbar(mesh, ax=ax, pad=0.02, label=label)
        label_logarithmic(bar.ax.yaxis, norm.vmin, norm.vmax)
        ax.set(xlabel=LABELS[x], ylabel=LABELS[y])
        for key, axis, ends in ((x, ax.xaxis, edges[0]), (y, ax.yaxis, edges[1])):
            levels = np.unique(solved[key].values)
            if varied[key]:
                getattr(ax, f"set_{axis.axis_name}scale")("log")
                label_logarithmic(axis, *ends[[0, -1]])
            if len(levels) <= MOST_LABELS:
                axis.set_ticks(levels, [f"{level:g}" for level in levels])
                axis.set_minor_locator(NullLocator())
        style.panel_label(ax, letter)
    fig.supxlabel(rf"medians of the designs in each bin, at $\tau = {float(solved.tau):g}$",
                  fontsize=8)  # fmt: skip
    return fig


def label_logarithmic(axis, low, high):
    """Round numbers on a logarithmic axis, as many as there is room for."""
    decades = 10.0 ** np.arange(np.floor(np.log10(low)), np.ceil(np.log10(high)) + 1)
    for steps in LABELLED:
        ticks = np.multiply.outer(decades, steps).ravel()
        ticks = ticks[(low <= ticks) & (ticks <= high)]
        if len(ticks) <= MOST_LABELS:
            break
    plain = [f"{tick:g}" if 1e-3 < tick < 1e4 else _power(tick) for tick in ticks]
    axis.set_major_locator(FixedLocator(ticks))
    axis.set_major_formatter(FixedFormatter(plain))
    axis.set_minor_formatter(NullFormatter())


def _power(tick):
    exponent = int(np.floor(np.log10(tick) + 1e-9))
    step = tick / 10.0**exponent
    return rf"$10^{{{exponent}}}$" if round(step, 6) == 1 else rf"${step:g}\times10^{{{exponent}}}$"


def _limits(median):
    low, high = np.nanmin(median), np.nanmax(median)
    return (low, high) if high > 1.0001 * low else (low / 1.01, high * 1.01)


def _most_moving(solved, varied, values):
    """The two parameters that the output's rank follows most, the first on the abscissa."""
    names = list(varied)
    if len(names) == 1:
        return names[0], names[0]
    ranks = {key: np.argsort(np.argsort(solved[key].values)) for key in names}
    output = np.argsort(np.argsort(values))
    names.sort(key=lambda key: -abs(np.corrcoef(ranks[key], output)[0, 1]))
    return names[0], names[1]


def _edges(values, logarithmic, bins):
    levels = np.unique(values)
    if len(levels) <= BINS:  # a grid: a bin for each of its values
        inner = np.sqrt(levels[1:] * levels[:-1]) if logarithmic else (levels[1:] + levels[:-1]) / 2
        if logarithmic:
            ends = levels[0] ** 2 / inner[0], levels[-1] ** 2 / inner[-1]
        else:
            ends = 2 * levels[0] - inner[0], 2 * levels[-1] - inner[-1]
        return np.concatenate([ends[:1], inner, ends[1:]])
    spaced = np.geomspace if logarithmic else np.linspace
    return spaced(levels[0], levels[-1], bins + 1)


def bars(indices: "xr.Dataset") -> Figure:
    """First-order and total indices of each output at the last time, with 95 % intervals."""
    outputs, names = indices.output.values, indices.parameter.values
    last = indices.isel(tau=-1)
    fig = style.figure(height=2.4)
    axes = fig.subplots(1, len(outputs), sharey=True)
    at = np.arange(len(names))[::-1]
    for ax, output in zip(axes, outputs, strict=True):
        here = last.sel(output=output)
        for key, shift, colour, label in (
            ("ST", 0.19, TOTAL, "total"),
            ("S1", -0.19, FIRST, "first order"),
        ):
            ax.barh(
                at + shift, here[key], 0.36, xerr=here[f"{key}_conf"], color=colour, label=label,
                error_kw={"elinewidth": 0.8, "capsize": 1.5},
            )  # fmt: skip
        ax.set_title(LABELS[str(output)], pad=4)
        ax.set(xlim=(0.0, 1.08), xticks=[0, 0.5, 1], xticklabels=["0", "0.5", "1"])
        ax.set_yticks(at, [LABELS[str(name)] for name in names])
        ax.tick_params(axis="y", length=0)
    fig.supxlabel(
        rf"Sobol index of the logarithm at $\tau = {float(last.tau):g}$, with 95 per cent interval",
        fontsize=8,
    )
    handles, labels = axes[0].get_legend_handles_labels()
    fig.legend(handles[::-1], labels[::-1], loc="outside upper center", ncols=2)
    return fig
