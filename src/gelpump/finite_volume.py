"""One FiPy sweep for a whole family of one-dimensional problems.

A FiPy sweep costs about the same for a hundred cells as for some thousands, so problems that do not
touch each other share one mesh: each occupies a block of consecutive cells, the faces between two
blocks conduct nothing, and the geometry (shell areas, distances, volumes) lives in the
coefficients.  What is solved is a Newton correction delta of

    div(K grad delta) - c delta = G

with K the conductance of each face (area / distance * diffusivity, zero at seams), c the local
derivative of the residual and G the residual itself, integrated over the cells.  Where cells drift
through the material, div(u delta) is added, u being the drift of each face (zero at seams).  K and
u together hold any tridiagonal Jacobian exactly: a flux a delta_right - b delta_left has
K = (a + b)/2 and u = a - b, since FiPy's central convection takes the plain mean of two cells.

The local terms go to FiPy as one transient term, c (delta - delta_old)/1 with delta_old = -G/c: an
implicit and an explicit source would say the same for twice the time, which is what a sweep costs.

FiPy assembles a sparse matrix by adding one for each term and face side, and factorises it as if
its structure were unknown: most of what a sweep costs.  In one dimension every entry lies on three
diagonals, so FiPy's terms are given a matrix of just these to add to, and a solver for it: LAPACK's
band elimination with pivoting (`_banded`).

Two of FiPy 4.0.3's defaults would change answers silently, and are avoided here: its default solver
skips a solve whose right-hand side looks small, so a direct one is named; and an unrelated
installed solver package would take over, so SciPy's is pinned before FiPy is first imported.
"""

import os
from functools import cache

import numpy as np


@cache
def _banded():
    """FiPy's solver for tridiagonal systems, of its class; FiPy is imported only when needed."""
    from fipy.matrices.scipyMatrix import _ScipyMeshMatrix
    from fipy.solvers.scipy.scipySolver import ScipySolver
    from scipy.linalg import solve_banded

    class Diagonals:
        """The diagonals above, on and below the main one, as `solve_banded` takes them."""

        def __init__(self, cells):
            self.bands = np.zeros((3, cells))
            self.shape = cells, cells

        def __mul__(self, x):
            above, main, below = self.bands
            product = main * x
            product[:-1] += above[1:] * x[1:]
            product[1:] += below[:-1] * x[:-1]
            return product

    class TridiagonalMatrix(_ScipyMeshMatrix):
        """What FiPy's terms add their entries to."""

        def __init__(self, mesh, **_):
            super().__init__(mesh=mesh, matrix=Diagonals(mesh.numberOfCells))

        def zeroEntries(self):
            self.matrix.bands[:] = 0.0

        def addAt(self, vector, id1, id2):
            # a face, and so a pair of cells, is named once in each call
            self.matrix.bands[1 + id1 - id2, id2] += vector

        def __iadd__(self, other):
            self.matrix.bands += other.matrix.bands
            return self

        def __mul__(self, x):
            return self.matrix * x

    class TridiagonalSolver(ScipySolver):
        """Elimination with pivoting; any entry outside the three diagonals is an IndexError."""

        @property
        def _matrixClass(self):
            return TridiagonalMatrix

        def _solve_(self, L, x, b):
            return solve_banded((1, 1), L.bands, b, check_finite=False)

    return TridiagonalSolver()


class NewtonSweep:
    """FiPy's finite-volume solve of ``div(K grad delta) - c delta = G`` on ``cells`` unit cells."""

    def __init__(self, cells: int):
        os.environ["FIPY_SOLVERS"] = "scipy"
        import fipy

        self._mesh = mesh = fipy.Grid1D(nx=cells, dx=1.0)
        self._delta = fipy.CellVariable(mesh=mesh, value=0.0, hasOld=True)
        self._conductance = fipy.FaceVariable(mesh=mesh, value=0.0)
        self._reaction = fipy.CellVariable(mesh=mesh, value=0.0)
        self._equation = fipy.TransientTerm(coeff=self._reaction) - fipy.DiffusionTerm(
            coeff=self._conductance
        )
        self._solver = _banded()
        self.sweeps = 0

    def correction(
        self, conductance: np.ndarray, reaction: np.ndarray, residual: np.ndarray
    ) -> np.ndarray:
        """delta, shape (cells,), from K on the (cells + 1) faces and c (not 0), G on the cells."""
        self._conductance.setValue(conductance)
        self._reaction.setValue(reaction)
        self._delta.setValue(-residual / reaction)
        self._delta.updateOld()
        self._equation.sweep(var=self._delta, dt=1.0, solver=self._solver)
        self.sweeps += 1
        return self._delta.value.copy()


class DriftSweep(NewtonSweep):
    """The same with drifting cells: ``div(K grad delta) + div(u delta) - c delta = G``."""

    def __init__(self, cells: int):
        super().__init__(cells)
        import fipy

        self._drift = fipy.FaceVariable(mesh=self._mesh, rank=1, value=0.0)
        self._equation -= fipy.CentralDifferenceConvectionTerm(coeff=self._drift)

    def correction(
        self, conductance: np.ndarray, reaction: np.ndarray, residual: np.ndarray, drift: np.ndarray
    ) -> np.ndarray:
        """delta, shape (cells,), from K and u on the (cells + 1) faces and c, G on the cells."""
        self._drift.setValue(drift[np.newaxis])
        return super().correction(conductance, reaction, residual)
