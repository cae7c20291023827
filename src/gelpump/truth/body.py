"""A gel on a mesh: which nodes are held, where water leaves, and how it evolves in time.

The unknowns y hold r, Z or z, and p of `gelpump.truth.elements`; in time they are followed by the
volumes Int q dv and by the water that has left through each surface since the beginning,

    d(lost)/dt = Int u.n ds over the surface, as the rows of its nodes give it,

so that volume and loss add up to what was there at first, to the rounding of Newton's iteration,
whatever the formula for d/dt: it is linear. Where a mesh does not end with the gel, gel in a known
state comes in, Z_t times the swollen volume of the section (times J), and its volume is added.
Time is T = (t_0 + t)^2 where t is what
`gelpump.bdf` steps in: everything begins as a power of the root of time.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_matrix, eye_array, hstack

from gelpump.bdf import Step, integrate
from gelpump.truth.elements import Elements, Material
from gelpump.truth.newton import newton

FIRST_STEP = 1e-2  # of the last root of time


@dataclass
class Body:
    """Elements of a material; `prescribed` gives R and z, or R and Z, at a root of time.

    `surfaces` are sets of pressure nodes with p = 0, `moves` the free directions of the unknowns,
    `enters` gives the volume that comes in through the ends, by pressure node, per Z_t of nodes.
    """

    elements: Elements
    material: Material
    prescribed: Callable[[float], Mapping[str, NDArray]]
    surfaces: Mapping[str, NDArray]
    moves: csr_matrix
    enters: csr_matrix | None = None
    root: float = 0.0
    tolerance: float = 1e-4
    size: int = field(init=False)

    def __post_init__(self) -> None:
        self.size = self.elements.size

    def fields(self, y: NDArray, t: float = 0.0) -> dict[str, NDArray]:
        """All fields at the nodes."""
        blocks = self.elements.blocks
        return {**self.prescribed(t), **{name: y[at] for name, at in blocks.items()}}

    def rows(
        self, y: NDArray, t: float, alpha: float, drift: NDArray | float, tangent: bool
    ) -> tuple[NDArray, csr_matrix | None]:
        """Residual and tangent, ends included; Z_t = alpha Z + `drift`."""
        fields, p = self.fields(y, t), self.elements.blocks["p"]
        residual, slope = self.elements.residual_and_tangent(
            fields, self.material, alpha, drift, tangent
        )
        if self.enters is not None:
            residual[p] -= self.enters @ (alpha * fields["Z"] + drift)
            if tangent:
                Z = self.elements.blocks["Z"]
                at = self.enters.tocoo()
                shape = (self.size, self.size)
                slope = slope - alpha * csr_matrix((at.data, (p[at.row], Z[at.col])), shape)
        return residual, slope

    def steady(self, guess: NDArray, speed: float) -> NDArray:
        """The state that a front, whose label Z advances at `speed`, carries with it."""
        return newton(lambda y, tangent: self.rows(y, 0.0, 0.0, speed, tangent), guess, self.moves)

    def outflow(self, y: NDArray, speed: float) -> NDArray:
        """Water that leaves per time at each pressure node in the state of `steady`."""
        return -self.rows(y, 0.0, 0.0, speed, False)[0][self.elements.blocks["p"]]

    def evolve(self, guess: NDArray, end: float, order: int = 3) -> Iterator[Step]:
        """Steps from the state `guess` at T = root^2 to T = end."""
        elements, moving = self.elements, self.elements.unknown
        volumes = elements.volumes(self.fields(guess, 0.0))
        initial = np.concatenate([guess, volumes, np.zeros(len(self.surfaces))])
        p, Z = elements.blocks["p"], elements.blocks.get("Z")
        stored = slice(self.size, self.size + p.size)

        def advance(t, predicted, alpha, history):
            rate = 1 / (2 * (self.root + t))  # dt/dT
            alpha, history = rate * alpha, rate * history
            drift = history[Z] if moving == "Z" else 0.0

            def equations(y, tangent):
                residual, slope = self.rows(y, t, alpha, drift, tangent)
                residual[p] += history[stored]
                return residual, slope

            y = newton(equations, predicted[: self.size], self.moves)
            leaving = -equations(y, False)[0][p]
            lost = np.array([leaving[nodes].sum() for nodes in self.surfaces.values()])
            lost = (lost - history[stored.stop :]) / alpha
            return np.concatenate([y, elements.volumes(self.fields(y, t)), lost])

        def error_norm(_, difference):
            return max(np.abs(difference[at]).max() for at in list(elements.blocks.values())[:2])

        last = np.sqrt(end) - self.root
        return integrate(
            advance,
            initial,
            last,
            order=order,
            tolerance=self.tolerance,
            first_step=FIRST_STEP * last,
            error_norm=error_norm,
        )


def gates(elements: Elements, ends: Mapping[float, float]) -> csr_matrix:
    """`Body.enters` for ends at xi_2 = key through which gel comes in, with J times +-1 = value.

    The gel is uniform there: Z_t is that of the node in the middle.
    """
    radius, at = elements.pressure_nodes
    R, share = elements.nodes
    entries, rows, columns = [], [], []
    for end, J in ends.items():
        order = np.flatnonzero(np.isclose(at, end))
        order = order[np.argsort(radius[order])]
        a, b = radius[order[:-1]], radius[order[1:]]  # Int q R dR, in both nodes of an edge
        entries += [J * (b - a) * (2 * a + b) / 6, J * (b - a) * (a + 2 * b) / 6]
        rows += [order[:-1], order[1:]]
        middle = np.abs(R - (R.min() + R.max()) / 2) + np.abs(share - end)
        columns += 2 * [np.full(a.size, middle.argmin())]
    at = np.concatenate(rows), np.concatenate(columns)
    return csr_matrix((np.concatenate(entries), at), (radius.size, R.size))


def free_moves(elements: Elements, held: Mapping[str, NDArray], tied: NDArray = ()) -> csr_matrix:
    """Directions of the unknowns: all but those `held` in a block; those of `tied` move as one."""
    stays = np.zeros(elements.size, bool)
    for name, nodes in held.items():
        stays[elements.blocks[name][nodes]] = True
    one_by_one = stays.copy()
    one_by_one[np.asarray(tied, int)] = True
    moves = eye_array(elements.size, format="csc")[:, np.flatnonzero(~one_by_one)]
    if len(tied):
        together = csr_matrix(
            (np.ones(len(tied)), (tied, np.zeros(len(tied), int))), (elements.size, 1)
        )
        moves = hstack([moves, together])
    return csr_matrix(moves)
