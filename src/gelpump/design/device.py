"""What follows from a design without solving anything: times, lengths and numbers of the model.

Everything is computed with pint quantities, so that a formula of the wrong dimension fails. With
L the heated length, t_pore = mu_l L^2/(k Pi_00) the unit of tau (eqn:nondimensionalisation):

    ell = a_0/a_1    eps = a_1/L    Le = kappa/(k Pi_00/mu_l)    G = k/a_1^2
    t_99 = t_pore tau_99 = mu_l (a_1 - a_0)^2/(16 k Pi_00) times a quadrature      (section 3.4)
    z_C = 2 erfcinv(1/2) sqrt(kappa t)                                      (eqn:temp_field_sol)
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gelpump.design import heat, units
from gelpump.design.description import Design
from gelpump.design.result import Result

if TYPE_CHECKING:
    from gelpump.tube.tubes import Tubes

LOW, HIGH, ELLS = 0.02, 0.99, 8  # ell of the walls between which `slower` is interpolated
QUADRATURE = 1e-10  # relative error of t_99, as tested


def scales(design: Design) -> dict:
    """The units of the solved model as pint quantities: time, length along, length across."""
    given, Pi_00 = design.given, units.quantity(design.material.Pi_00, "Pa")
    if design.kind == "tube":
        L = given["heated_length"]
        time = (given["viscosity"] * L**2 / (given["permeability"] * Pi_00)).to("s")
        return {"time": time, "along": L, "across": given["a_1"]}
    material = design.material
    R_dry = given["radius"] * np.cbrt(material.own_start)
    mu = units.quantity(material.gel.shear_modulus(1.0) * material.pressure_unit, "Pa")
    time = (given["viscosity"] * R_dry**2 / (given["permeability"] * mu)).to("s")
    return {"time": time, "along": R_dry, "across": R_dry}


def diffusivity(design: Design) -> Any:
    """k Pi_00/mu_l."""
    Pi_00 = units.quantity(design.material.Pi_00, "Pa")
    return (design.given["permeability"] * Pi_00 / design.given["viscosity"]).to("m^2/s")


def tubes(design: Design, eps: float | None = None) -> Tubes:
    """The tube as `gelpump.tube` takes it."""
    from gelpump.tube.tubes import Tubes

    given = design.given
    own = float((given["a_1"] / given["heated_length"]).to("").magnitude)
    ell = float((given["a_0"] / given["a_1"]).to("").magnitude)
    return Tubes(ell, own if eps is None else eps, **design.material.numbers)


def response_time(design: Design, **changed: float) -> float:
    """t_99 of a uniformly heated tube in seconds; ``changed`` replaces given SI magnitudes."""
    from gelpump.tube.deswelling import response_time

    values = {key: design.si(key) for key in ("a_0", "a_1", "permeability", "viscosity")}
    values |= {"osmotic_modulus": design.material.Pi_00} | changed
    return float(response_time(**values, **design.material.numbers))


def slower(design: Design) -> Callable[[ArrayLike], NDArray]:
    """How many times as long as `response_time` the wall takes that is resolved in r, by its ell.

    `gelpump.tube.wall.slower`, interpolated; outside LOW to HIGH as at the nearer of the two.
    """
    of = _slower(*design.material.numbers.items())
    return lambda ell: of(np.clip(ell, LOW, HIGH))[()]


@cache
def _slower(*numbers):
    from scipy.interpolate import CubicSpline

    from gelpump.tube import wall
    from gelpump.tube.tubes import Tubes

    x = np.linspace(np.log(LOW), np.log(HIGH), ELLS)
    spline = CubicSpline(x, wall.slower(Tubes(np.exp(x), **dict(numbers))))
    return lambda ell: spline(np.log(ell))


def material_results(design: Design) -> list[Result]:
    """The gel as the model knows it."""
    material, Pi_00 = design.material, design.material.Pi_00
    return [
        Result("osmotic_modulus", "osmotic modulus, swollen", "Pi_00", Pi_00, "Pa",
               "eqn:piecewise_osmotic_pressure"),
        Result("shear_modulus", "shear modulus", "mu_s", material.mu_s, "Pa", "eqn:cst"),
        Result("M", "shear over osmotic modulus", "M", material.M, "1",
               "eqn:nondimensionalisation"),
        Result("Pi_ratio", "osmotic modulus, hot over cold", "Pi~", material.Pi_ratio, "1",
               "section 3.4"),
        Result("Phi_inf", "polymer fraction, hot over cold", "Phi_inf", material.Phi_inf, "1",
               "eqn:nondimensionalisation"),
        Result("diffusivity", "diffusivity of the polymer", "k Pi_00/mu_l",
               units.si(diffusivity(design), "m^2/s"), "m^2/s", "section 3.5"),
        Result("Lewis_number", "Lewis number", "Le", lewis_number(design), "1", "section 3.5"),
    ]  # fmt: skip


def lewis_number(design: Design) -> float:
    """Le = kappa/(k Pi_00/mu_l)."""
    return units.si(design.given["thermal_diffusivity"] / diffusivity(design), "")


def tube_results(design: Design) -> list[Result]:
    """What the formulae say of a tube."""
    from gelpump.tube.deswelling import deswelling_time
    from gelpump.tube.heat import FRONT_CONSTANT

    given, tube = design.given, tubes(design)
    L, kappa, wall = (
        given["heated_length"],
        given["thermal_diffusivity"],
        given["a_1"] - given["a_0"],
    )
    t_pore = scales(design)["time"]
    tau_99 = float(deswelling_time(tube))
    back = float(deswelling_time(tube, reswelling=True))
    travel = (L**2 / (FRONT_CONSTANT**2 * kappa)).to("s")
    G = units.si(given["permeability"] / given["a_1"] ** 2, "")
    t_99, t_back = (units.si(t_pore * tau, "s") for tau in (tau_99, back))
    return [
        Result("ell", "inner over outer radius", "ell", float(tube.ell), "1", "section 3.3"),
        Result("eps", "slenderness a₁/L", "eps", float(tube.eps), "1", "section 3.3"),
        Result("wall", "thickness of the wall, swollen", "a_1 - a_0", units.si(wall, "m"), "m",
               "section 3.1"),
        *material_results(design),
        Result("coupling", "coupling of lumen and wall", "G", G, "1", "appendix B"),
        Result("poroelastic_time", "poroelastic time of the heated length", "mu_l L^2/(k Pi_00)",
               units.si(t_pore, "s"), "s", "eqn:nondimensionalisation"),
        Result("tau_99", "deswelling time, scaled", "tau_99", tau_99, "1", "section 3.4",
               QUADRATURE * tau_99),
        Result("response_time", "response time, heated everywhere", "t_99", t_99, "s",
               "section 3.4", QUADRATURE * t_99),
        Result("recovery_time", "response time, cooled again", "t_99", t_back, "s",
               "section 3.4, reversed", QUADRATURE * t_back),
        Result("travel_time", "time of the front along the heated length", "t_L",
               units.si(travel, "s"), "s", "eqn:temp_field_sol"),
        Result("front_coefficient", "front position over the root of time", "z_C/t^1/2",
               FRONT_CONSTANT * units.si(kappa, "m^2/s") ** 0.5, "m/s^0.5", "eqn:temp_field_sol"),
        Result("front_speed", "speed of the front at the end of it", "dz_C/dt",
               units.si(L / travel / 2, "m/s"), "m/s", "eqn:temp_field_sol"),
    ]  # fmt: skip


def bead_results(design: Design) -> list[Result]:
    """What the formulae say of a bead."""
    given, material = design.given, design.material
    radius = given["radius"]
    Pi_hot = units.quantity(material.Pi_00 * material.Pi_ratio, "Pa")
    t_pore = given["viscosity"] * radius**2 / (given["permeability"] * Pi_hot)
    end = radius * material.Phi_inf ** (-1 / 3)
    volume = 4 / 3 * np.pi * radius**3
    return [
        *material_results(design),
        Result("poroelastic_time", "poroelastic time of the bead", "mu_l a^2/(k Pi_0inf)",
               units.si(t_pore, "s"), "s", "eqn:poroelastic_timescale"),
        Result("final_radius", "radius when collapsed", "a Phi_inf^-1/3", units.si(end, "m"), "m",
               "eqn:div_xi"),
        Result("total_shed_volume", "water shed by the bead", "V",
               units.si(volume * (1 - 1 / material.Phi_inf), "m^3"), "m^3", "eqn:div_xi"),
    ]  # fmt: skip


def results(design: Design) -> list[Result]:
    """What the formulae say of the device."""
    own = tube_results(design) if design.kind == "tube" else bead_results(design)
    return own + heat.results(design)
