"""One FiPy sweep for a family of tubes whose cells drift.

`gelpump.finite_volume` tells why a family shares one mesh and how its defaults are avoided. The
tubes' cells move through the material, so their Newton correction delta has a drift as well:

    c delta - div(K grad delta) - div(u delta) + G = 0

with K the conductance and u the drift of each face (zero at the seams between two tubes), c the
local derivative of the residual and G the residual, integrated over the cells. K and u together
hold any tridiagonal Jacobian exactly: a flux a delta_right - b delta_left has K = (a + b)/2 and
u = a - b, since FiPy's central convection takes the plain mean of the two cells.
"""

import os

import numpy as np


class DriftSweep:
    """FiPy's finite-volume solve for delta on `cells` unit cells."""

    def __init__(self, cells: int):
        os.environ["FIPY_SOLVERS"] = "scipy"
        import fipy

        mesh = fipy.Grid1D(nx=cells, dx=1.0)
        self._delta = fipy.CellVariable(mesh=mesh, value=0.0)
        self._conductance = fipy.FaceVariable(mesh=mesh, value=0.0)
        self._drift = fipy.FaceVariable(mesh=mesh, rank=1, value=0.0)
        self._reaction = fipy.CellVariable(mesh=mesh, value=0.0)
        self._residual = fipy.CellVariable(mesh=mesh, value=0.0)
        self._equation = (
            fipy.ImplicitSourceTerm(coeff=self._reaction)
            - fipy.DiffusionTerm(coeff=self._conductance)
            - fipy.CentralDifferenceConvectionTerm(coeff=self._drift)
            + self._residual
        )
        self._solver = fipy.LinearLUSolver(tolerance=1e-12)
        self.sweeps = 0

    def correction(
        self, conductance: np.ndarray, drift: np.ndarray, reaction: np.ndarray, residual: np.ndarray
    ) -> np.ndarray:
        """delta, shape (cells,), from K and u on the (cells + 1) faces and c, G on the cells."""
        self._conductance.setValue(conductance)
        self._drift.setValue(drift[np.newaxis])
        self._reaction.setValue(reaction)
        self._residual.setValue(residual)
        self._delta.setValue(0.0)
        self._equation.sweep(var=self._delta, solver=self._solver)
        self.sweeps += 1
        return self._delta.value.copy()
