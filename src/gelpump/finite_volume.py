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

Most of what a sweep costs is not arithmetic.  FiPy assembles a sparse matrix by adding one for each
term and face side, factorises it as if its structure were unknown, and evaluates at every face what
constraints on values and gradients add, of which there are none here: nothing flows through the
ends of the mesh.  Its terms are therefore given a matrix of the three diagonals that one dimension
has, a solver for it (LAPACK's band elimination with pivoting) and the knowledge that no face is
constrained (`_tridiagonal`), which changes no bit of what they add.  What that saves is in
docs/performance.md, as is what it saves to let runs share sweeps (`together`).

Two of FiPy 4.0.3's defaults would change answers silently, and are avoided here: its default solver
skips a solve whose right-hand side looks small, so a direct one is named; and an unrelated
installed solver package would take over, so SciPy's is pinned before FiPy is first imported.
"""

import threading
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from functools import cache
from operator import itemgetter
from types import SimpleNamespace
from typing import Any

import numpy as np

from gelpump import plain_fipy


@cache
def _tridiagonal():
    """FiPy's solver and terms for tridiagonal systems; FiPy is imported only when needed."""
    plain_fipy.load()
    from fipy import (
        CellVariable,
        CentralDifferenceConvectionTerm,
        DiffusionTermNoCorrection,
        TransientTerm,
    )
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

    class Transient(TransientTerm):
        """Its coefficients as arrays, on which each further operation is one of NumPy's."""

        def _getCoeffVectors_(self, *args, **kwargs):
            vectors = super()._getCoeffVectors_(*args, **kwargs)
            return {place: vector.value for place, vector in vectors.items()}

    class Diffusion(DiffusionTermNoCorrection):
        """Between the cells of an orthogonal mesh none of whose faces is constrained."""

        def _calcConstraints(self, var):
            if var not in self.constraintL:
                self.constraintL[var] = self.constraintB[var] = np.zeros(var.shape)

    class Convection(CentralDifferenceConvectionTerm):
        """On a mesh none of whose faces is constrained."""

        def _buildMatrix(self, var, *args, **kwargs):
            if not hasattr(self, "constraintL"):
                self.constraintL = self.constraintB = CellVariable(mesh=var.mesh, value=0.0)
            return super()._buildMatrix(var, *args, **kwargs)

    return SimpleNamespace(
        solver=TridiagonalSolver(), transient=Transient, diffusion=Diffusion, convection=Convection
    )


class _System:
    """FiPy's equation for the correction, on one mesh of unit cells."""

    def __init__(self, cells: int, drifts: bool):
        fipy = plain_fipy.load()
        terms = _tridiagonal()
        mesh = fipy.Grid1D(nx=cells, dx=1.0)
        self._solver = terms.solver
        self._delta = fipy.CellVariable(mesh=mesh, value=0.0, hasOld=True)
        self._conductance = fipy.FaceVariable(mesh=mesh, value=0.0)
        self._reaction = fipy.CellVariable(mesh=mesh, value=0.0)
        self._equation = terms.transient(coeff=self._reaction) - terms.diffusion(
            coeff=self._conductance
        )
        if drifts:
            self._drift = fipy.FaceVariable(mesh=mesh, rank=1, value=0.0)
            self._equation -= terms.convection(coeff=self._drift)

    def correction(self, conductance, reaction, residual, drift=None):
        self._conductance.setValue(conductance)
        self._reaction.setValue(reaction)
        self._delta.setValue(-residual / reaction)
        self._delta.updateOld()
        if drift is not None:
            self._drift.setValue(drift[np.newaxis])
        self._equation.sweep(var=self._delta, dt=1.0, solver=self._solver)
        return self._delta.value.copy()


class NewtonSweep:
    """FiPy's finite-volume solve of ``div(K grad delta) - c delta = G`` on ``cells`` unit cells."""

    _drifts = False

    def __init__(self, cells: int):
        company = getattr(_here, "company", None)
        self._solve = company.correction if company else _System(cells, self._drifts).correction
        self.sweeps = 0

    def correction(
        self, conductance: np.ndarray, reaction: np.ndarray, residual: np.ndarray
    ) -> np.ndarray:
        """delta, shape (cells,), from K on the (cells + 1) faces and c (not 0), G on the cells."""
        self.sweeps += 1
        return self._solve(conductance, reaction, residual)


class DriftSweep(NewtonSweep):
    """The same with drifting cells: ``div(K grad delta) + div(u delta) - c delta = G``."""

    _drifts = True

    def correction(
        self, conductance: np.ndarray, reaction: np.ndarray, residual: np.ndarray, drift: np.ndarray
    ) -> np.ndarray:
        """delta, shape (cells,), from K and u on the (cells + 1) faces and c, G on the cells."""
        self.sweeps += 1
        return self._solve(conductance, reaction, residual, drift)


_here = threading.local()  # the company of this thread's run, and its rank there


class _Company:
    """Runs in step: each waits with its sweep until all do, then one sweep of FiPy serves all."""

    def __init__(self):
        self.members, self._waiting, self._systems = 1, [], {}
        self.lock = threading.Lock()

    def correction(self, *coefficients):
        """What `_System.correction` gives, of a mesh on which all that wait have a block."""
        answer = Future()
        with self.lock:
            self._waiting.append((_here.rank, coefficients, answer))
            self.go_on()
        return answer.result()

    def go_on(self):
        """Sweep if nobody is awaited any more; the lock is held."""
        if len(self._waiting) < self.members:
            return
        waiting, self._waiting = sorted(self._waiting, key=itemgetter(0)), []
        for drifts in (False, True):
            here = [each for each in waiting if (len(each[1]) == 4) == drifts]
            if here:
                self._sweep(drifts, [block for _, block, _ in here], [each[2] for each in here])

    def _sweep(self, drifts, blocks, answers):
        sizes = tuple(reaction.size for _, reaction, *_ in blocks)
        try:
            if (drifts, sizes) not in self._systems:
                self._systems[drifts, sizes] = _System(sum(sizes), drifts)
            conductance, reaction, residual, *drift = zip(*blocks, strict=True)
            delta = self._systems[drifts, sizes].correction(
                _joined(conductance),
                np.concatenate(reaction),
                np.concatenate(residual),
                *map(_joined, drift),
            )
        except Exception as failure:
            for answer in answers:
                answer.set_exception(failure)
        else:
            for answer, mine in zip(answers, np.split(delta, np.cumsum(sizes)[:-1]), strict=True):
                answer.set_result(mine)


def _joined(faces):
    """Face values of blocks side by side; what two blocks share, a seam, is zero."""
    return np.concatenate([*(np.append(0.0, each[1:-1]) for each in faces), [0.0]])


def together(*runs: Callable[[], Any]) -> list[Any]:
    """The results of ``runs``, functions without arguments, whose sweeps are shared.

    Each runs in a thread of its own until it needs a sweep of `NewtonSweep` or `DriftSweep`; one
    sweep of FiPy serves all that still run.  They need not agree in cells, times or steps, and give
    bit for bit what they would give alone, since blocks of a mesh do not touch each other.  A run
    may itself let others run together.  What the first of them raises is raised when all have
    ended.
    """
    company, rank = getattr(_here, "company", None) or _Company(), getattr(_here, "rank", ())
    at_work = len(runs)
    with company.lock:
        company.members += at_work - 1  # one has the place of the caller, who waits

    def member(own, run):
        nonlocal at_work
        _here.company, _here.rank = company, (*rank, own)
        try:
            return run()
        finally:
            with company.lock:
                at_work -= 1
                if at_work:  # the last one gives its place back
                    company.members -= 1
                    company.go_on()

    with ThreadPoolExecutor(len(runs)) as pool:
        results = [pool.submit(member, own, run) for own, run in enumerate(runs)]
    return [result.result() for result in results]
