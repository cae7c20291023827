r"""The front that has travelled: a wall some thicknesses long, carried along by the front.

Once Z_C is many thicknesses long the front hardly accelerates while it passes its own length. In
the frame of the front the wall then is at rest as a shape while the gel goes through it: Z_t at
fixed xi is C, the speed of the front in the swollen tube's own length. The wall behind has
the stretch lambda_inf = Phi_inf^{-1/3} and does not move, so that Z_C' = lambda_inf C.

All lengths are in a_1, times in mu_l a_1^2/(k Pi_00), whatever eps: the wave has the parameters
ell, Phi_inf, Pi~, M and

    Pe = C (1-ell)     in the paper's scaling  Phi_inf^{1/3} Z_C'(tau) eps (1-ell), 4 times c .

Ends: free of traction, no flow along the wall, and gel that enters swollen, R C per length of
radius, and leaves at Phi_inf: exact but for what the wave leaves over at the ends of the box.
"""

from collections.abc import Sequence

import numpy as np

from gelpump.bdf import NotConverged
from gelpump.materials.piecewise_linear import PiecewiseLinearGel
from gelpump.truth.body import Body, free_moves, gates
from gelpump.truth.elements import Elements
from gelpump.truth.gel import two_states
from gelpump.truth.mesh import from_front, wall_mesh

SCALE = 0.8  # thickness of the wall: within this distance of the front cells are of one length
BENDING, DIFFUSING = 7.0, 4.0  # lengths of the box: sqrt(mean radius x thickness), thickness


class Wave:
    """Waves in a tube `ell` on one mesh of `cells` (across, behind, ahead)."""

    def __init__(
        self,
        ell: float,
        gel: PiecewiseLinearGel,
        cells: tuple[int, int, int] = (8, 24, 24),
        c: float = 0.0,
        largest_Pe: float = 0.0,
    ) -> None:
        self.ell, self.gel = ell, gel
        thickness = 1 - ell
        reach = BENDING * np.sqrt(thickness * (1 + ell) / 2) + DIFFUSING * thickness
        behind = reach + thickness * largest_Pe
        self.elements = Elements(wall_mesh(ell, cells), "Z")
        R, share = self.elements.nodes
        z = np.where(
            share < 0,
            -from_front(behind, SCALE * thickness, -share),
            from_front(reach, SCALE * thickness, share),
        )
        hot = self.elements.mesh.p[1][self.elements.mesh.t].mean(axis=0) < 0
        radius, _ = self.elements.pressure_nodes
        self.inner, self.outer = np.isclose(radius, ell), np.isclose(radius, 1)
        middle = np.flatnonzero(np.isclose(R, (1 + ell) / 2) & (share == 0))
        self.body = Body(
            self.elements,
            two_states(gel, hot, c),
            lambda t: {"R": R, "z": z},
            {"inner": self.inner, "outer": self.outer},
            free_moves(self.elements, {"p": self.inner | self.outer, "Z": middle}),
            gates(self.elements, {1.0: 1.0, -1.0: -1 / gel.Phi_inf}),
        )

    def solve(self, Pe: Sequence[float]) -> list[np.ndarray]:
        """The unknowns at each of the ascending `Pe`, from one to the next."""
        R = self.body.prescribed(0)["R"]
        z = self.body.prescribed(0)["z"]
        far = self.gel.Phi_inf ** (-1 / 3)
        bending = np.sqrt((1 - self.ell) * (1 + self.ell) / 2)
        y = np.zeros(self.elements.size)
        y[self.elements.blocks["r"]] = R * (far + (1 - far) / 2 * (1 + np.tanh(z / bending)))
        y[self.elements.blocks["Z"]] = np.where(z > 0, z, z / far)
        found, reached = [], 0.0
        for each in Pe:
            y, reached = self._approach(y, reached, each)
            found.append(y)
        return found

    def _approach(self, y, reached, Pe):
        target = Pe
        for _ in range(20):
            try:
                y, reached = self.body.steady(y, target / (1 - self.ell)), target
            except NotConverged:
                target = (reached + target) / 2
                continue
            if reached == Pe:
                return y, reached
            target = Pe
        raise NotConverged(f"no wave at Pe = {Pe:g}; the last one was at {reached:g}")

    def outflow(self, y: np.ndarray, Pe: float) -> np.ndarray:
        """Water that leaves per time at each pressure node."""
        return self.body.outflow(y, Pe / (1 - self.ell))
