r"""Mixed finite elements for the axisymmetric gel: where it is, what it was, and pore pressure.

A point of the gel was at X = (R, Z) in the swollen tube and is at x = (r, z). Inertia-free balance
of forces and Darcy's law with unit permeability, u = -grad p, are, in the present configuration,

    div sigma = 0,    sigma = -p I + polymer_stress(F)    (`gelpump.truth.energy`),  F = dx/dX
    dJ/dt at fixed X  =  J div grad p                     (all change of volume is water)

The osmotic pressure jumps where the temperature passes T_C, but p is an unknown and is continuous:
the gradient of temperature is in Darcy's law without being written.

Both x and X are functions of mesh coordinates xi on a fixed rectangle, a = dx/dxi, A = dX/dxi,
F = a A^{-1}. One of x and X may be prescribed in either direction: with z(xi, t) prescribed and Z
unknown the mesh is Lagrangian in the radius and follows a plane z = Z_C(t) of *space* exactly,
whatever the gel does there. Test functions v (velocities) and q (pressures) belong to xi:

    Int sigma : grad v dv = 0                                          dv = r det a dxi
    d/dt Int q dv + Int (X_t . Grad_X q + grad q . grad p) dv = - Int q u.n ds

The second is the transport theorem for test functions that move with the mesh, X_t = dX/dt at fixed
xi; q = 1 gives the balance of water of the whole mesh, to rounding. Surfaces are free of traction.
p is prescribed on surfaces, and their rows are the water that leaves through them.

x and X are biquadratic on quadrilaterals and p is bilinear (Taylor & Hood: stable when the gel
cannot yet drain and is incompressible). Derivatives for Newton's method are complex steps of what
is integrated at a quadrature point: exact to rounding, and from one source with the residual.
"""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix, csr_matrix
from skfem import Basis, ElementQuad1, ElementQuad2, MeshQuad

from gelpump.truth.energy import Gradient, Stress, polymer_stress

STEP = 1e-30  # of the complex derivative: no subtraction, so no cancellation
LATTICE = np.array([[x, y] for y in (0.0, 0.5, 1.0) for x in (0.0, 0.5, 1.0)]).T
ORDER = 5  # of the quadrature: three Gauss points in each direction

OsmoticPressure = Callable[[NDArray], tuple[NDArray, NDArray]]
"""Phi at the quadrature points (element, point) -> Pi and dPi/dPhi there."""


@dataclass
class Material:
    """What the gel is made of; `osmotic_pressure` knows which elements are hot."""

    osmotic_pressure: OsmoticPressure
    M: float
    c: float = 0.0


@dataclass
class Elements:
    """A mesh of quadrilaterals in xi, with the fields r, z, R, Z on it.

    Fields are dictionaries of values at the nodes: "r", "z", "R", "Z" and "p".
    `unknown` says whether z (Lagrangian) or Z (fixed planes z) is solved for.
    """

    mesh: MeshQuad
    unknown: str = "z"
    space: Basis = field(init=False)
    pressures: Basis = field(init=False)

    def __post_init__(self) -> None:
        self.space = Basis(self.mesh, ElementQuad2(), intorder=ORDER)
        self.pressures = self.space.with_element(ElementQuad1())
        self.weights = self.space.dx  # (element, point)
        self._shape = {"x": _shapes(self.space), "p": _shapes(self.pressures)}
        corners = Basis(self.mesh, ElementQuad2(), quadrature=(LATTICE, np.ones(LATTICE.shape[1])))
        self._lattice = {"x": _shapes(corners), "p": _shapes(corners.with_element(ElementQuad1()))}
        n = self.space.N
        self.blocks = {
            "r": np.arange(n),
            self.unknown: n + np.arange(n),
            "p": 2 * n + np.arange(self.pressures.N),
        }
        self.size = 2 * n + self.pressures.N

    @property
    def nodes(self) -> NDArray:
        """xi of the nodes of x and X, (2, node)."""
        return self.space.doflocs

    @property
    def pressure_nodes(self) -> NDArray:
        """xi of the nodes of p."""
        return self.pressures.doflocs

    def at_points(self, name: str, values: NDArray, lattice: bool = False) -> NDArray:
        """A field and its two derivatives at the quadrature points, (3, element, point).

        With `lattice` at the nodes of x in each element, where derivatives are one-sided.
        """
        shape = (self._lattice if lattice else self._shape)["p" if name == "p" else "x"]
        dofs = (self.pressures if name == "p" else self.space).element_dofs
        return np.einsum("aieq,ae->ieq", shape, values[dofs])

    def fluxes(self, s: dict, material: Material, velocity: NDArray, alpha: float) -> NDArray:
        """What multiplies (v, v_1, v_2) of r and of z, and (q, q_1, q_2); (3, 3, element, point).

        `velocity` is Z_t at fixed xi; the term d/dt Int q dv enters as alpha Int q dv.
        """
        r, a11, a12 = s["r"]
        _, a21, a22 = s["z"]
        F, det_a = deformation(s)
        dv = r * det_a
        Phi = 1 / F.J
        pressure, slope = material.osmotic_pressure(Phi.real)
        sigma = polymer_stress(F, pressure + 1j * slope * Phi.imag, material.M, material.c)
        sigma = Stress(sigma.rr - s["p"][0], sigma.rz, sigma.zz - s["p"][0], sigma.hoop - s["p"][0])
        # dv times dxi_1/dr, dxi_1/dz, dxi_2/dr, dxi_2/dz
        xi1_r, xi1_z, xi2_r, xi2_z = a22 * r, -a12 * r, -a21 * r, a11 * r
        p_r = (s["p"][1] * a22 - s["p"][2] * a21) / det_a
        p_z = (-s["p"][1] * a12 + s["p"][2] * a11) / det_a
        _, R1, R2 = s["R"]
        _, Z1, Z2 = s["Z"]
        through = velocity * dv / (R1 * Z2 - R2 * Z1)
        zero = np.zeros_like(dv)
        return np.array(
            [
                [
                    sigma.hoop * det_a,
                    sigma.rr * xi1_r + sigma.rz * xi1_z,
                    sigma.rr * xi2_r + sigma.rz * xi2_z,
                ],
                [
                    zero,
                    sigma.rz * xi1_r + sigma.zz * xi1_z,
                    sigma.rz * xi2_r + sigma.zz * xi2_z,
                ],
                [
                    alpha * dv,
                    p_r * xi1_r + p_z * xi1_z - through * R2,
                    p_r * xi2_r + p_z * xi2_z + through * R1,
                ],
            ]
        )

    def volumes(self, fields: dict) -> NDArray:
        """Int q dv for each node of p, 2 pi left out."""
        s = {name: self.at_points(name, fields[name]) for name in ("r", "z")}
        dv = s["r"][0] * (s["r"][1] * s["z"][2] - s["r"][2] * s["z"][1])
        local = np.einsum("aeq,eq->ae", self._shape["p"][:, 0], dv * self.weights)
        return np.bincount(
            self.pressures.element_dofs.ravel(), local.ravel(), minlength=self.pressures.N
        )

    def residual_and_tangent(
        self,
        fields: dict,
        material: Material,
        alpha: float = 0.0,
        velocity_history: NDArray | float = 0.0,
        tangent: bool = True,
    ) -> tuple[NDArray, csr_matrix | None]:
        """Rows of r, of z and of p (without the history of the volumes), and their derivatives.

        Z_t = alpha Z + `velocity_history` where Z is unknown, else `velocity_history`.
        """
        s = {name: self.at_points(name, v).astype(complex) for name, v in fields.items()}
        moving = self.unknown == "Z"
        history = np.broadcast_to(velocity_history, self.space.N)
        drift = self.at_points("Z", history)[0]

        def evaluate(state):
            velocity = drift + alpha * state["Z"][0] if moving else drift
            return self.fluxes(state, material, velocity, alpha)

        names = ("r", self.unknown, "p")
        flux = evaluate(s).real * self.weights
        residual = np.zeros(self.size)
        for row, name in zip(flux, names, strict=True):
            kind = "p" if name == "p" else "x"
            local = np.einsum("aieq,ieq->ae", self._shape[kind], row)
            np.add.at(residual, self._dofs(name), local)
        if not tangent:
            return residual, None
        entries, rows, columns = [], [], []
        for name in names:
            slopes = []
            for k in range(3):
                shifted = dict(s)
                shifted[name] = s[name].copy()
                shifted[name][k] += 1j * STEP
                slopes.append(evaluate(shifted).imag / STEP * self.weights)
            slopes = np.array(slopes)  # (derivative, equation, term, element, point)
            of = self._shape["p" if name == "p" else "x"]
            for j, equation in enumerate(names):
                test = self._shape["p" if equation == "p" else "x"]
                inner = np.einsum("kieq,bkeq->bieq", slopes[:, j], of)
                local = np.einsum("aieq,bieq->eab", test, inner, optimize=True)
                entries.append(local.ravel())
                at = self._dofs(equation).T[:, :, None], self._dofs(name).T[:, None, :]
                rows.append(np.broadcast_to(at[0], local.shape).ravel())
                columns.append(np.broadcast_to(at[1], local.shape).ravel())
        matrix = coo_matrix(
            (np.concatenate(entries), (np.concatenate(rows), np.concatenate(columns))),
            shape=(self.size, self.size),
        )
        return residual, matrix.tocsr()

    def _dofs(self, name: str) -> NDArray:
        if name == "p":
            return self.blocks["p"][self.pressures.element_dofs]
        return self.blocks[name][self.space.element_dofs]


def deformation(s: dict) -> tuple[Gradient, NDArray]:
    """F and det dx/dxi from the fields and their derivatives at some points."""
    r, a11, a12 = s["r"]
    _, a21, a22 = s["z"]
    R, R1, R2 = s["R"]
    _, Z1, Z2 = s["Z"]
    det_A = R1 * Z2 - R2 * Z1
    F = Gradient(
        rR=(a11 * Z2 - a12 * Z1) / det_A,
        rZ=(a12 * R1 - a11 * R2) / det_A,
        zR=(a21 * Z2 - a22 * Z1) / det_A,
        zZ=(a22 * R1 - a21 * R2) / det_A,
        hoop=r / R,
    )
    return F, a11 * a22 - a12 * a21


def _shapes(basis: Basis) -> NDArray:
    """Values and the two derivatives of the shape functions, (shape, 3, element, point)."""
    elements, points = basis.dx.shape
    return np.array(
        [
            np.concatenate(
                [
                    np.broadcast_to(np.asarray(f), (1, elements, points)),
                    np.broadcast_to(f.grad, (2, elements, points)),
                ]
            )
            for (f,) in basis.basis
        ]
    )
