"""Figure 4: a bead dries after a rise in temperature; time is linear, so that the plateau shows."""

from collections.abc import Mapping

from matplotlib.figure import Figure

from gelpump.figures import bead_panels


def draw(beads: Mapping, case: Mapping, published: Mapping) -> Figure:
    """The panels of ``bead_panels``, over time."""
    return bead_panels.draw(beads, case, published, time_scale="linear")
