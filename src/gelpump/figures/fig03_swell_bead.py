"""Figure 3: a bead swells after a drop in temperature; time is logarithmic, as swelling starts at
its surface long before its radius has changed much."""

from collections.abc import Mapping

from matplotlib.figure import Figure

from gelpump.figures import bead_panels


def draw(beads: Mapping, case: Mapping, published: Mapping) -> Figure:
    """The panels of ``bead_panels``, over the logarithm of time."""
    return bead_panels.draw(beads, case, published, time_scale="log")
