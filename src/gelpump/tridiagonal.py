"""What FiPy lacks in one dimension: a matrix of three diagonals, and a solver for it.

Most of what a FiPy sweep of some hundred cells costs is not arithmetic.  FiPy assembles a sparse
matrix by adding one for each term and face side, factorises it as if its structure were unknown,
and evaluates at every face what constraints on values and gradients add, of which there are none
here.  `Equation` is that of `gelpump.finite_volume` on FiPy's own terms and mesh, but gives these
terms a matrix of the three diagonals that one dimension has, a solver for it (LAPACK's band
elimination with pivoting) and the knowledge that no face is constrained, which changes no bit of
what they add.  What that saves is in docs/performance.md.

The local terms are one transient term, c (delta - delta_old)/1 with delta_old = -G/c: a source G
beside it would say the same in more time.

All of this overrides methods that FiPy does not promise to keep.  `finite_volume.trusted` therefore
compares its first sweep with that of FiPy's public terms, and leaves it where they differ.
"""

from typing import Any

import numpy as np
from scipy.linalg import solve_banded

from gelpump import plain_fipy

fipy = plain_fipy.load()


class Diagonals:
    """The diagonals above, on and below the main one, as `solve_banded` takes them."""

    def __init__(self, cells: int):
        self.bands = np.zeros((3, cells))
        self.shape = cells, cells

    def __mul__(self, x):
        above, main, below = self.bands
        product = main * x
        product[:-1] += above[1:] * x[1:]
        product[1:] += below[:-1] * x[:-1]
        return product


class Matrix(fipy.matrices.scipyMatrix._ScipyMeshMatrix):
    """What FiPy's terms add their entries to; any outside the three diagonals is an IndexError."""

    def __init__(self, mesh: Any, **_: Any):
        super().__init__(mesh=mesh, matrix=Diagonals(mesh.numberOfCells))

    def zeroEntries(self) -> None:
        """Begin anew."""
        self.matrix.bands[:] = 0.0

    def addAt(self, vector: np.ndarray, id1: np.ndarray, id2: np.ndarray) -> None:
        """Add to the entries of rows id1 and columns id2: a face is named once in each call."""
        self.matrix.bands[1 + id1 - id2, id2] += vector

    def __iadd__(self, other):
        self.matrix.bands += other.matrix.bands
        return self

    def __mul__(self, x):
        return self.matrix * x


class Solver(fipy.solvers.scipy.scipySolver.ScipySolver):
    """Elimination with pivoting."""

    @property
    def _matrixClass(self):
        return Matrix

    def _solve_(self, L, x, b):
        return solve_banded((1, 1), L.bands, b, check_finite=False)


class Transient(fipy.TransientTerm):
    """Its coefficients as arrays, on which each further operation is one of NumPy's."""

    def _getCoeffVectors_(self, *args, **kwargs):
        vectors = super()._getCoeffVectors_(*args, **kwargs)
        return {place: vector.value for place, vector in vectors.items()}


class Diffusion(fipy.DiffusionTermNoCorrection):
    """Between the cells of an orthogonal mesh none of whose faces is constrained."""

    def _calcConstraints(self, var):
        if var not in self.constraintL:
            self.constraintL[var] = self.constraintB[var] = np.zeros(var.shape)


class Convection(fipy.CentralDifferenceConvectionTerm):
    """On a mesh none of whose faces is constrained."""

    def _buildMatrix(self, var, *args, **kwargs):
        if not hasattr(self, "constraintL"):
            self.constraintL = self.constraintB = fipy.CellVariable(mesh=var.mesh, value=0.0)
        return super()._buildMatrix(var, *args, **kwargs)


class Equation:
    """`gelpump.finite_volume.Equation`, faster."""

    def __init__(self, cells: int, drifts: bool):
        mesh = fipy.Grid1D(nx=cells, dx=1.0)
        self.delta = fipy.CellVariable(mesh=mesh, value=0.0, hasOld=True)
        self.K = fipy.FaceVariable(mesh=mesh, value=0.0)
        self.u = fipy.FaceVariable(mesh=mesh, rank=1, value=0.0)
        self.c = fipy.CellVariable(mesh=mesh, value=0.0)
        self.solver = Solver()
        self.equation = Transient(coeff=self.c) - Diffusion(coeff=self.K)
        if drifts:
            self.equation -= Convection(coeff=self.u)

    def correction(
        self,
        conductance: np.ndarray,
        reaction: np.ndarray,
        residual: np.ndarray,
        drift: np.ndarray | None = None,
    ) -> np.ndarray:
        """delta, shape (cells,), from K, c (not 0), G and u."""
        self.K.setValue(conductance)
        self.c.setValue(reaction)
        self.delta.setValue(-residual / reaction)
        self.delta.updateOld()
        if drift is not None:
            self.u.setValue(drift[np.newaxis])
        self.equation.sweep(var=self.delta, dt=1.0, solver=self.solver)
        return self.delta.value.copy()
