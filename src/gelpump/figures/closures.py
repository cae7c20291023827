"""The closures of the slender tube, told apart in the same way in every figure beyond the paper."""

from gelpump.figures import style

COLOURS = {"printed": style.PUBLISHED, "conservative": style.LENS, "balanced": style.NONLINEAR}
LINES = {"printed": "--", "conservative": "-", "balanced": "-"}
MARKERS = {"printed": "x", "conservative": "o", "balanced": "s"}


def line(closure: str) -> dict:
    """How a closure's curve is drawn."""
    return {"color": COLOURS[closure], "linestyle": LINES[closure]}


def marker(closure: str) -> dict:
    """How a closure's points are drawn."""
    return {
        "color": COLOURS[closure],
        "marker": MARKERS[closure],
        "markerfacecolor": "white",
        "linestyle": "none",
        "markersize": 4.5,
    }
