"""The problems that all tools solve, what is compared, and its error.

Each problem gives its data, and ``error(solution)``, relative; 1e-3 is what is asked for.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from scipy.interpolate import CubicSpline

from gelpump.bead.production import initial_polymer_fraction
from gelpump.materials import from_config


@dataclass(frozen=True)
class Drop:
    """A drop of polymer spreads: D = phi in the sphere, Barenblatt's solution from t = 1 to 2.

        phi_t = r^-2 (r^2 phi phi_r)_r ,   phi = 5/(2 b^3) (1 - r^2/b^2) ,   b^5 = 25 t

    Its polymer is one, in spheres of radius one.  A solution is (faces r from 0, polymer between
    them); the error is the polymer that is in the wrong place, Integral |phi - exact| d(r^3).
    """

    name: str = "Barenblatt's drop"
    start: float = 1.0
    end: float = 2.0
    box: float = 2.4  # the drop's edge is at 2.19 in the end

    def within(self, r, t):
        """Polymer within the radius r."""
        x = np.minimum(np.asarray(r) / (25 * t) ** 0.2, 1.0)
        return (5 * x**3 - 3 * x**5) / 2

    def error(self, solution) -> float:
        """Share of the polymer that is misplaced, to within a cell."""
        faces, polymer = solution
        return float(np.abs(polymer - np.diff(self.within(faces, self.end))).sum())


@dataclass(frozen=True)
class Bead:
    """A bead of the paper (section 2.1); a solution is the radius at the published times.

    ``reference`` is the converged radius; the error is the largest relative one.
    """

    name: str
    gel: object
    temperature: float
    phi_initial: float
    times: np.ndarray  # from 0
    reference: np.ndarray = field(default_factory=lambda: np.empty(0))
    reference_uncertainty: float = 0.0

    @classmethod
    def of(cls, config, case: str) -> "Bead":
        """The case of the configuration, up to the last time for which a radius is published."""
        block = config["beads"][case]
        gel = from_config(block["gel"], config["gels"][block["gel"]])
        return cls(
            f"bead, {case}",
            gel,
            block["temperature_final"],
            initial_polymer_fraction(gel, block),
            np.array([0.0, *block["published_times"]]),
        )

    def error(self, solution) -> float:
        """Largest relative error of the radius."""
        return float(np.abs(np.asarray(solution) / self.reference - 1).max())


@dataclass(frozen=True)
class Tubes:
    """Tubes of the paper (section 3.6) at the times tau, with table 1's parameters.

    A solution is, for each tube and time, (Z, Phi_1); the error is the largest of Phi_1, anywhere,
    relative to the change Phi_inf - 1.  ``reference`` holds the same on fine meshes.
    """

    name: str
    ell: Sequence[float]
    tau: np.ndarray
    parameters: dict  # eps, M, Pi_ratio, Phi_inf, Le
    reference: list = field(default_factory=list)
    reference_uncertainty: float = 0.0

    @classmethod
    def of(cls, config, name: str, ell: Sequence[float], tau: Sequence[float]) -> "Tubes":
        """Tubes of the configuration's gel, slenderness and Lewis number."""
        tube = config["tube"]
        gel = config["gels"][tube["gel"]]
        parameters = {"eps": tube["eps"], "Le": tube["Le"]}
        parameters |= {key: gel[key] for key in ("M", "Pi_ratio", "Phi_inf")}
        return cls(name, tuple(map(float, ell)), np.asarray(tau, float), parameters)

    @cached_property
    def interpolants(self) -> list:
        """Of each reference profile, one cubic on either side of the front; and the front."""
        found = []
        for profiles in self.reference:
            found.append([])
            for Z, Phi in profiles:
                front = len(Z) // 2
                sides = slice(0, front + 1), slice(front, None)
                found[-1].append((*(CubicSpline(Z[s], Phi[s]) for s in sides), Z[front], Z[-1]))
        return found

    def error(self, solution) -> float:
        """Largest error of Phi_1 at the same Z, over Phi_inf - 1."""
        worst = 0.0
        for tube, references in zip(solution, self.interpolants, strict=True):
            for (Z, Phi), (behind, ahead, front, end) in zip(tube, references, strict=True):
                exact = np.where(front >= Z, behind(np.minimum(Z, front)), 1.0)
                beyond = (front < Z) & (end > Z)
                exact[beyond] = ahead(Z[beyond])
                worst = max(worst, float(np.abs(Phi - exact).max()))
        return worst / (self.parameters["Phi_inf"] - 1)
