r"""The whole tube from the first instant, behind the printed front of heat.

All lengths are in a_1, times T in mu_l a_1^2/(k Pi_00) = eps^{-2} of the paper's unit, so that
T = tau/eps^2. The printed front (`gelpump.tube.heat`, lengths in L = a_1/eps) then is

    Z_C/a_1 = 2 erfcinv(1/2) sqrt(Le tau)/eps = 0.9539 sqrt(Le T):

eps is gone, and with it one tube at all T is the tube of every eps: T = 0.04 to 25 is eps from 0.5
to 0.02 at tau = 0.01. The temperature of a place in *space* passes T_C when z = Z_C(T), whatever
gel is there; mesh lines share = 0 lie on that plane, and those of share = -1 on z = 0, which is a
plane of symmetry (Z = 0, no shear, no flow). The far end of the mesh keeps its place, free of
traction, and swollen gel comes in there as the tube behind it becomes shorter.

The run begins with the swollen tube when Z_C = START thicknesses; what this leaves of the true
beginning decays as START sqrt(T_0/T).
"""

from collections.abc import Iterator

import numpy as np

from gelpump.bdf import Step
from gelpump.materials.piecewise_linear import PiecewiseLinearGel
from gelpump.truth.body import Body, free_moves, gates
from gelpump.truth.elements import Elements
from gelpump.truth.gel import two_states
from gelpump.truth.mesh import from_front, wall_mesh
from gelpump.truth.wave import BENDING, DIFFUSING, SCALE
from gelpump.tube.heat import StepHeating

START = 0.02


class Pulse:
    """The tube up to `end`, with the front of `heat`, on one mesh of `cells`."""

    def __init__(
        self,
        ell: float,
        gel: PiecewiseLinearGel,
        heat: StepHeating,
        end: float,
        cells: tuple[int, int, int] = (8, 28, 24),
        tolerance: float = 1e-4,
        start: float = START,
        c: float = 0.0,
    ) -> None:
        self.ell, self.gel, self.heat, self.end = ell, gel, heat, end
        thickness = 1 - ell
        begin = (start * thickness / heat.front(1.0)) ** 2
        if not begin < end:
            raise ValueError(f"end = {end} is not allowed: the run begins at T = {begin:.3g}")
        self.root = float(np.sqrt(begin))
        reach = BENDING * np.sqrt(thickness * (1 + ell) / 2) + DIFFUSING * thickness
        self.length = float(heat.front(end)) + reach
        self.scale = SCALE * thickness
        self.elements = Elements(wall_mesh(ell, cells), "Z")
        self.R, self.share = self.elements.nodes
        hot = self.elements.mesh.p[1][self.elements.mesh.t].mean(axis=0) < 0
        radius, _ = self.elements.pressure_nodes
        self.inner, self.outer = np.isclose(radius, ell), np.isclose(radius, 1)
        self.body = Body(
            self.elements,
            two_states(gel, hot, c),
            self.prescribed,
            {"inner": self.inner, "outer": self.outer},
            free_moves(
                self.elements,
                {"p": self.inner | self.outer, "Z": np.isclose(self.share, -1)},
            ),
            gates(self.elements, {1.0: 1.0}),
            self.root,
            tolerance,
        )

    def prescribed(self, t: float) -> dict[str, np.ndarray]:
        """R and z of the nodes at the root of time t after the beginning."""
        front = float(self.heat.front((self.root + t) ** 2))
        z = np.where(
            self.share < 0,
            front - from_front(front, self.scale, -self.share),
            front + from_front(self.length - front, self.scale, self.share),
        )
        return {"R": self.R, "z": z}

    def water(self, state: np.ndarray) -> tuple[float, float]:
        """Water and gel that a state of `steps` accounts for, 2 pi left out, and what there was.

        The volume of the gel, what has been lost, less what has come in through the far end.
        """
        size = self.elements.size
        end = np.abs(self.share - 1) + np.abs(self.R - (1 + self.ell) / 2)
        came = state[self.elements.blocks["Z"]][end.argmin()] - self.length
        volume = state[size : size + self.elements.pressures.N].sum()
        section = (1 - self.ell**2) / 2
        return volume + state[-2:].sum() - came * section, self.length * section

    def steps(self) -> Iterator[Step]:
        """The states in time; `Step.times` are roots of T less the first one, `root`."""
        swollen = np.zeros(self.elements.size)
        swollen[self.elements.blocks["r"]] = self.R
        swollen[self.elements.blocks["Z"]] = self.prescribed(0.0)["z"]
        return self.body.evolve(swollen, self.end)
