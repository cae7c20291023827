"""How figures look, and how they reach the disk.

Widths are those of a JFM page, so that what is drawn at 7 to 9 points is printed at that size.
Colours are Okabe & Ito's, told apart by colour-blind readers; polymer fraction is one sequential
map throughout, light when swollen, dark when dry.
"""

import logging
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from contextlib import contextmanager
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_pdf import FigureCanvasPdf
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.cm import ScalarMappable
from matplotlib.colorbar import Colorbar
from matplotlib.colors import BoundaryNorm, LinearSegmentedColormap, ListedColormap, to_hex
from matplotlib.figure import Figure

from gelpump.files import whole

if TYPE_CHECKING:
    from gelpump.provenance import Provenance

# it reports on every table of every font that a PDF embeds
logging.getLogger("fontTools").setLevel(logging.WARNING)

DPI = 300  # of the layout as of the PNG, so that each text is measured once for both
WIDTH = 5.3  # inches, the text width of the journal

LENS = "#0072B2"
NONLINEAR = "#D55E00"
PUBLISHED = "#000000"
SWELLING, DRYING, SEPARATING = "#0072B2", "#E69F00", "#009E73"
GREY = "#777777"
POLYMER_FRACTION = "YlGnBu"
# as blue and red as the usual maps of temperature, but dark in the middle, where lines are drawn
TEMPERATURE = LinearSegmentedColormap.from_list("temperature", ["#1f5fb4", "#857a8a", "#b2182b"])
LATER = LinearSegmentedColormap.from_list("later", ["#b8d6ee", "#4d94cc", "#08306b"])
# tubes from thick walls, ell = 0, to thin ones, ell = 1
ELL = LinearSegmentedColormap.from_list(
    "ell", ["#2d0a54", "#7a1b8c", "#c73a72", "#ef7a4a", "#f5b83d"]
)

SETTINGS = {
    "font.family": "STIXGeneral",
    "mathtext.fontset": "stix",
    "font.size": 9,
    "axes.labelsize": 9,
    "axes.titlesize": 9,
    "xtick.labelsize": 8,
    "ytick.labelsize": 8,
    "legend.fontsize": 8,
    "legend.frameon": False,
    "axes.linewidth": 0.6,
    "lines.linewidth": 1.1,
    "lines.markersize": 4,
    "xtick.direction": "in",
    "ytick.direction": "in",
    "xtick.top": True,
    "ytick.right": True,
    "image.cmap": POLYMER_FRACTION,
    "figure.dpi": DPI,
    "svg.hashsalt": "gelpump",
    "svg.fonttype": "path",
    "pdf.fonttype": 42,
}

PUBLISHED_MARKER = {
    "linestyle": "none",
    "marker": "o",
    "markersize": 4,
    "markerfacecolor": "white",
    "markeredgecolor": PUBLISHED,
    "markeredgewidth": 0.8,
}
PUBLISHED_BY_MODEL = {
    "lens": PUBLISHED_MARKER | {"markeredgecolor": LENS},
    "nonlinear": PUBLISHED_MARKER
    | {"marker": "s", "markersize": 4, "markerfacecolor": "none", "markeredgecolor": NONLINEAR},
}

# neither date nor version of the writer, so that equal data give equal bytes
METADATA = {
    "png": {"Software": None},
    "pdf": {"CreationDate": None, "Producer": None, "Creator": None},
    "svg": {"Date": None, "Creator": None},
}


# where each format keeps free text
PROVENANCE = {"png": "Description", "pdf": "Keywords", "svg": "Description"}


@contextmanager
def styled():
    """The settings of this module, for drawing as well as for saving."""
    with matplotlib.rc_context(SETTINGS):
        yield


class Quantity(StrEnum):
    """What figures draw, with its unit: headings of their CSV files."""

    TEMPERATURE = "temperature [K]"
    POLYMER = "polymer_fraction [1]"
    PRESSURE = "osmotic_pressure [k_B T/Omega_f]"
    BEAD_TIME = "t [t_BMJ]"
    BEAD_RADIUS = "r [R_dry]"
    TAU = "tau [mu_l L^2/(k Pi_00)]"
    ELL = "ell [1]"
    THICKNESS = "one_minus_ell [1]"
    AXIAL = "Z [L]"
    RADIAL = "R [a_1]"
    INNER = "B_0 [a_1]"
    OUTER = "B_1 [a_1]"
    AHEAD = "Z-Z_C [L]"
    PHI = "Phi [phi_00]"
    SHARPNESS = "A [1/L]"


class Series(NamedTuple):
    """Numbers that are drawn: ``columns`` of equal length, each named with its unit, "Z [L]"."""

    panel: str
    name: str
    columns: Mapping[str, Sequence[float]]


class ToldFigure(Figure):
    """A figure that knows its numbers, for who wants to draw them otherwise."""

    def __init__(self, *args, **options):
        super().__init__(*args, **options)
        self.series: list[Series] = []


def figure(height: float, width: float = WIDTH) -> ToldFigure:
    """An empty figure of the given size in inches, laid out without overlaps."""
    fig = ToldFigure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(fig)
    return fig


def tell(where, panel: str, name: str, columns: Mapping[str, Sequence[float]]) -> None:
    """Say which numbers are drawn in ``where``, axes or a figure: they come into its CSV file.

    A column is broadcast to the shape of the largest; ``name`` tells series of a panel apart, and
    has no comma.
    """
    arrays = np.broadcast_arrays(*(np.asarray(each, dtype=float) for each in columns.values()))
    flat = dict(zip(columns, map(np.ravel, arrays), strict=True))
    where.get_figure(root=True).series.append(Series(panel, name, flat))


def panel_label(axes, label: str) -> None:
    """A panel's letter at the upper left, outside the axes, as the journal sets it."""
    axes.set_title(f"({label})", loc="left", fontstyle="italic", pad=4)


def polymer_fraction_bar(fig, mappable, axes, **options) -> Colorbar:
    """A colour bar for a logarithmic scale of polymer fractions, with ticks at round ones."""
    bar = fig.colorbar(mappable, ax=axes, pad=0.02, **options)
    low, high = mappable.norm.vmin, mappable.norm.vmax
    ticks = [phi for phi in (0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.8) if low <= phi <= high]
    bar.set_ticks(ticks, labels=[f"{tick:g}" for tick in ticks])
    bar.minorticks_off()
    return bar


def zoom(axes, inset, *, joined: bool) -> None:
    """Frame in ``axes`` what ``inset``, on its left, magnifies; lines may join its right edge."""
    inset.tick_params(labelsize=7)
    inset.yaxis.offsetText.set_fontsize(7)
    box = axes.indicate_inset_zoom(inset, edgecolor=GREY, linewidth=0.6)
    for connector, right in zip(box.connectors, (False, False, True, True), strict=True):
        connector.set_visible(joined and right)


def shades(colours: LinearSegmentedColormap, count: int) -> list[str]:
    """``count`` colours of a map, from its one end to the other."""
    return [to_hex(colours(share)) for share in np.linspace(0.0, 1.0, count)]


def ell_colours(ells: Iterable[float]) -> list[str]:
    """The colour of each tube, the same in every figure."""
    return [to_hex(ELL(float(ell))) for ell in ells]


def steps(
    fig: Figure, axes, values: Sequence[float], colours: Sequence[str], label: str
) -> Colorbar:
    """A colour bar beside ``axes`` with one step a value: the legend of a family of curves."""
    edges = np.arange(len(values) + 1) - 0.5
    mappable = ScalarMappable(BoundaryNorm(edges, len(values)), ListedColormap(list(colours)))
    bar = fig.colorbar(mappable, ax=axes, ticks=range(len(values)), label=label, pad=0.02)
    bar.ax.set_yticklabels([f"{value:g}" for value in values], fontsize=7.5)
    bar.ax.tick_params(which="both", length=0)
    return bar


def save(fig: Figure, paths: Iterable[str | Path], provenance: "Provenance | None" = None) -> None:
    """Write ``fig`` to each path in the format of its suffix; a file is whole or not there.

    ``provenance`` is put into the files' metadata.  A path to a CSV file gets the numbers that
    were told of.

    The layout is settled once, so that all formats show the same and none waits for it again;
    ``fig.savefig`` would go through all of it once more for each.
    """
    fig.draw_without_rendering()
    fig.set_layout_engine("none")
    prints = {
        "pdf": FigureCanvasPdf(fig).print_pdf,
        "svg": FigureCanvasSVG(fig).print_svg,
        "png": FigureCanvasAgg(fig).print_png,
    }
    for path in map(Path, paths):
        suffix = path.suffix.lstrip(".")
        if suffix == "csv":
            with whole(path) as partial:
                partial.write_text(csv(fig.series, path.stem, provenance), "utf-8", newline="\n")
            continue
        made_from = {PROVENANCE[suffix]: provenance.text()} if provenance else {}
        fig.dpi = DPI  # vector formats change it
        with whole(path) as partial:
            prints[suffix](partial, metadata=METADATA[suffix] | made_from)


def csv(series: Sequence[Series], name: str, provenance: "Provenance | None" = None) -> str:
    """The numbers of figure ``name`` as one table: a row is a point of one series of one panel.

    A quantity has one column, empty in the rows of series without it.  Lines before the table begin
    with #: what there is, panel by panel, and what it was made from.
    """
    columns = list(dict.fromkeys(column for each in series for column in each.columns))
    rows = Counter()
    for panel, what, numbers in series:
        rows[panel, what, ", ".join(numbers)] += len(next(iter(numbers.values())))
    lines = [
        f"# {name}: the numbers that are drawn, one row a point; [1] is without a dimension",
        *(
            f"# panel {panel}, {what}; {count} rows: {quantities}"
            for (panel, what, quantities), count in rows.items()
        ),
        *([f"# made from {provenance.text()}"] if provenance else []),
        ",".join(["panel", "series", *columns]),
        "",
    ]
    return "\n".join(lines) + "".join(_rows(each, columns) for each in series)


def _rows(series, columns):
    cells = ("%.8g" if column in series.columns else "" for column in columns)
    row = ",".join([series.panel, series.name.replace("%", "%%"), *cells]) + "\n"
    values = np.stack([series.columns[c] for c in columns if c in series.columns], axis=1)
    return (row * len(values)) % tuple(values.ravel().tolist())
