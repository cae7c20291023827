"""One FiPy sweep for a whole family of one-dimensional problems.

A FiPy sweep costs about the same for a hundred cells as for some thousands, so problems that do not
touch each other share one mesh: each occupies a block of consecutive cells, the faces between two
blocks conduct nothing, and the geometry (shell areas, distances, volumes) lives in the
coefficients.  What is solved is a Newton correction delta of

    c delta = div(K grad delta) + div(u delta) - G

with K the conductance of each face (area / distance * diffusivity, zero at seams), c the local
derivative of the residual and G the residual itself, integrated over the cells; u, where cells
drift through the material, is the drift of each face (zero at seams).  K and u together hold any
tridiagonal Jacobian exactly: a flux a delta_right - b delta_left has K = (a + b)/2 and u = a - b,
since FiPy's central convection takes the plain mean of two cells.  Nothing flows through the ends
of the mesh, which is FiPy's own boundary condition.

`Equation` says this in FiPy's public terms and always works.  `gelpump.tridiagonal` solves the same
equation in a quarter of the time, but reaches into FiPy to do so: it is used if, on the first sweep
of a mesh, its answer is that of `Equation` to rounding; if not, a RuntimeWarning says so and
`Equation` makes every sweep.

Two of FiPy 4.0.3's defaults would change answers silently, and are avoided here: its default solver
skips a solve whose right-hand side looks small, so a direct one is named; and an unrelated
installed solver package would take over, which `gelpump.plain_fipy` prevents.
"""

import warnings
from collections.abc import Callable

import numpy as np

from gelpump import plain_fipy

ROUNDING = 1e-10  # of the largest correction; production's meshes agree to 1e-12

Sweep = Callable[..., np.ndarray]
"""The correction delta, shape (cells,), from K, c, G and, where cells drift, u."""


class Equation:
    """FiPy's equation for the correction, in its public terms, on unit cells.

    K, u: shape (cells + 1,), on the faces; c, G: shape (cells,).
    """

    def __init__(self, cells: int, drifts: bool):
        fipy = plain_fipy.load()
        mesh = fipy.Grid1D(nx=cells, dx=1.0)
        self.delta = fipy.CellVariable(mesh=mesh, value=0.0, hasOld=True)
        self.K, self.u = fipy.FaceVariable(mesh=mesh), fipy.FaceVariable(mesh=mesh, rank=1)
        self.c, self.G = fipy.CellVariable(mesh=mesh), fipy.CellVariable(mesh=mesh)
        self.solver = fipy.LinearLUSolver(tolerance=1e-14)

        flow = fipy.DiffusionTerm(coeff=self.K)
        if drifts:
            flow += fipy.CentralDifferenceConvectionTerm(coeff=self.u)
        # c (delta - 0)/1: FiPy's implicit source would take only a c of its own sign implicitly
        self.equation = fipy.TransientTerm(coeff=self.c) == flow - self.G

    def correction(
        self,
        conductance: np.ndarray,
        reaction: np.ndarray,
        residual: np.ndarray,
        drift: np.ndarray | None = None,
    ) -> np.ndarray:
        """delta, shape (cells,), from K, c, G and u; RuntimeError if the matrix is singular."""
        self.K.setValue(conductance)
        self.c.setValue(reaction)
        self.G.setValue(residual)
        if drift is not None:
            self.u.setValue(drift[np.newaxis])
        self.delta.setValue(0.0)
        self.delta.updateOld()
        self.equation.sweep(var=self.delta, dt=1.0, solver=self.solver)
        return self.delta.value.copy()


class NewtonSweep:
    """Solves ``c delta = div(K grad delta) + div(u delta) - G`` on ``cells`` unit cells by FiPy.

    ``drifts``: whether there is a drift u.  ``sweeps`` counts the corrections.
    """

    def __init__(self, cells: int, *, drifts: bool = False):
        self.cells, self.drifts, self.sweeps = cells, drifts, 0
        self._sweep: Sweep | None = None

    def correction(
        self,
        conductance: np.ndarray,
        reaction: np.ndarray,
        residual: np.ndarray,
        drift: np.ndarray | None = None,
    ) -> np.ndarray:
        """delta, shape (cells,), from K and u on the (cells + 1) faces and c (not 0), G on the
        cells; not finite where they are not.

        ValueError if a shape is another, or if u is given without drift or missing with it.
        """
        coefficients = [conductance, reaction, residual]
        if drift is not None:
            coefficients.append(drift)
        shapes = [each.shape for each in coefficients]
        faces, cells = (self.cells + 1,), (self.cells,)
        wanted = [faces, cells, cells] + [faces] * self.drifts
        if shapes != wanted:
            raise ValueError(f"coefficients of shapes {shapes} are not allowed here: {wanted}")
        self.sweeps += 1
        if not all(np.isfinite(each).all() for each in coefficients):
            return np.full(self.cells, np.nan)  # FiPy's direct solver would call it singular
        if not residual.any():
            return np.zeros(self.cells)  # as a first sweep it would tell nothing
        if self._sweep is None:
            self._sweep = trusted(self.cells, self.drifts, coefficients)
        return self._sweep(*coefficients)


def trusted(cells: int, drifts: bool, first: list[np.ndarray]) -> Sweep:
    """What makes the sweeps of a mesh: the fast path if it does the ``first`` as FiPy's terms do.

    A RuntimeWarning tells why not.
    """
    public = Equation(cells, drifts)
    expected = public.correction(*first)
    try:
        from gelpump.tridiagonal import Equation as Fast

        fast = Fast(cells, drifts)
        difference = np.abs(fast.correction(*first) - expected).max()
    except Exception as failure:  # of any kind: it overrides what another FiPy may have changed
        reason = repr(failure)
    else:
        if difference <= ROUNDING * np.abs(expected).max():
            return fast.correction
        reason = f"it differs by {difference:.2g} from {np.abs(expected).max():.2g}"
    warnings.warn(
        "gelpump.tridiagonal is not used with this FiPy; its public terms give the same to "
        f"rounding, in more time: {reason}",
        RuntimeWarning,
        stacklevel=2,
    )
    return public.correction
