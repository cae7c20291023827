"""gelpump's production solvers, SUNDIALS by the second solvers, and FiPy the textbook way."""

import math
import os

import numpy as np

os.environ["FIPY_SOLVERS"] = "scipy"

from benchmarks.lines import LensLines
from benchmarks.problems import Bead, Drop, Tubes
from gelpump.bead import lens
from gelpump.known_solutions import bead as known
from gelpump.second_solvers import lens_bead
from gelpump.second_solvers import tube as second_tube
from gelpump.tube import slender
from gelpump.tube import tubes as family
from gelpump.tube.heat import StepHeating

PICARD = 1e-4  # relative change at which the textbook's sweeps end; less changes no digit shown
MOST_SWEEPS = 100
SLOW = 0.9  # of the last change: more, and a sweep is not taken whole


def our_drop(problem: Drop, cells: int, tolerance: float):
    found, _ = known.barenblatt([cells], tolerance, inside=1.0)
    faces = np.append(0.0, found[0][0])
    dry = np.sin(np.pi / 2 * np.linspace(0, 1, cells + 1))
    return faces, np.diff(dry**3)


def our_bead(problem: Bead, cells: int, tolerance: float, order: int = 3):
    bead = lens.solve(
        problem.gel,
        problem.temperature,
        problem.phi_initial,
        problem.times,
        cells,
        tolerance=tolerance,
        order=order,
    )
    return bead.radius.values[1:]


def our_tubes(problem: Tubes, behind: int, ahead: int, tolerance: float):
    p = problem.parameters
    tubes = family.Tubes(np.array(problem.ell), p["eps"], p["M"], p["Pi_ratio"], p["Phi_inf"])
    found = slender.solve(
        tubes, StepHeating(p["Le"]), problem.tau, cells=(behind, ahead), tolerance=tolerance
    )
    return [
        list(zip(Z, Phi, strict=True))
        for Z, Phi in zip(found.Z.values, found.Phi1.values, strict=True)
    ]


def second_bead(problem: Bead, cells: int, rtol: float):
    """CVODE in J = 1/phi, cells graded to the surface, an exact dense Jacobian."""
    found = lens_bead.solve(
        problem.gel,
        problem.temperature,
        problem.phi_initial,
        problem.times,
        cells,
        rtol=rtol,
    )
    return found.radius[1:]


def second_tubes(problem: Tubes, nodes: int, rtol: float):
    """IDA on nodes that follow the front, tube after tube."""
    found = []
    for ell in problem.ell:
        profiles = second_tube.solve(problem.tau, ell, **problem.parameters, nodes=nodes, rtol=rtol)
        found.append(list(zip(*profiles, strict=True)))
    return found


def _roots_of_time(times, steps: int):
    """Times evenly spaced in sqrt(t), and those at which there is something to compare."""
    return np.unique(np.append(times[-1] * np.linspace(0, 1, steps + 1) ** 2, times))


def _picard(equation, variable, dt, update, solver):
    """Sweep until nothing changes any more: the update, since FiPy's residual is the old one.

    Each time that a sweep changes no less than the one before, the share of it that is taken is
    halved: coefficients and surface, which follow the solution one sweep behind, overshoot in the
    first steps of a bead, and sweeps taken whole would go to and fro for ever.
    """
    taken, last = 1.0, np.inf
    for _ in range(MOST_SWEEPS):
        update()
        before = variable.value.copy()
        equation.sweep(var=variable, dt=dt, solver=solver)
        change = np.abs(variable.value / before - 1).max()
        if change < PICARD:
            return
        if change > SLOW * last:
            taken /= 2
        last = change
        variable.setValue(before + taken * (variable.value - before))
    raise ArithmeticError(
        f"{MOST_SWEEPS} sweeps left a change of {change:.1g} in a step of {dt:.2g}"
    )


def textbook_drop(problem: Drop, cells: int, steps: int):
    """Cell by cell as FiPy's manual has it, the shells' areas and volumes as coefficients."""
    import fipy

    faces = np.linspace(0, problem.box, cells + 1)
    mesh = fipy.Grid1D(nx=cells, dx=problem.box / cells)
    volume = np.diff(faces**3)
    phi = fipy.CellVariable(
        mesh=mesh, value=np.diff(problem.within(faces, problem.start)) / volume, hasOld=True
    )
    weight = fipy.CellVariable(mesh=mesh, value=volume / mesh.dx)
    area = fipy.FaceVariable(mesh=mesh, value=3 * faces**2)
    equation = fipy.TransientTerm(coeff=weight) == fipy.DiffusionTerm(
        coeff=area * phi.arithmeticFaceValue
    )
    solver = fipy.LinearLUSolver(tolerance=1e-12)
    dt = (problem.end - problem.start) / steps
    for _ in range(steps):
        phi.updateOld()
        for _ in range(MOST_SWEEPS):
            before = phi.value.copy()
            equation.sweep(var=phi, dt=dt, solver=solver)
            if np.abs(phi.value - before).max() < PICARD * phi.value.max():
                break
    return faces, phi.value * volume


def textbook_bead(problem: Bead, cells: int, steps: int):
    """3 R^2 dJ/dt = (3 r^4 D phi^2/R^2 J_R)_R on uniform cells of the dry radius R."""
    import fipy

    faces = np.linspace(0, 1, cells + 1)
    dry = np.diff(faces**3)
    surface = LensLines(problem, 4)
    mesh = fipy.Grid1D(nx=cells, dx=1 / cells)
    J = fipy.CellVariable(mesh=mesh, value=1 / problem.phi_initial, hasOld=True)
    J_s = fipy.Variable(value=1 / problem.phi_initial)
    J.constrain(J_s, mesh.facesRight)
    K = fipy.FaceVariable(mesh=mesh, value=0.0)
    weight = fipy.CellVariable(mesh=mesh, value=dry * cells)
    equation = fipy.TransientTerm(coeff=weight) == fipy.DiffusionTerm(coeff=K)
    solver = fipy.LinearLUSolver(tolerance=1e-12)

    def update():
        cube = np.cumsum(J.value * dry)
        phi = np.append(1 / J.value, surface.surface(cube[-1] ** (1 / 3)))
        mobility = surface.diffusivity(phi) * phi**2
        mean = (mobility[1:] + mobility[:-1]) / 2
        K.setValue(np.append(0.0, 3 * cube ** (4 / 3) / faces[1:] ** 2 * mean))
        J_s.setValue(1 / phi[-1])

    radius, now = [], 0.0
    for time in _roots_of_time(problem.times, steps)[1:]:
        J.updateOld()
        _picard(equation, J, time - now, update, solver)
        now = time
        if time in problem.times:
            radius.append((J.value * dry).sum() ** (1 / 3))
    return np.array(radius)


def textbook_tube(problem: Tubes, cells: int, steps: int):
    """The local form of eqn:tube_model on uniform cells of Z; convection and integral lagged."""
    import fipy
    from scipy.special import erfcinv

    (ell,), p = problem.ell, problem.parameters
    w = p["eps"] * (1 - ell) / 4
    speed = 2 * erfcinv(0.5) * math.sqrt(p["Le"])
    dZ = (speed * math.sqrt(problem.tau[-1]) + 12 * w) / cells
    mesh = fipy.Grid1D(nx=cells, dx=dZ)
    Z = mesh.cellCenters.value[0]
    Phi = fipy.CellVariable(mesh=mesh, value=1.0, hasOld=True)
    D, gain, decay = (fipy.CellVariable(mesh=mesh, value=0.0) for _ in range(3))
    equation = fipy.TransientTerm() == fipy.DiffusionTerm(coeff=D) + gain - fipy.ImplicitSourceTerm(
        coeff=decay
    )
    solver = fipy.LinearLUSolver(tolerance=1e-12)
    now = 0.0

    def update():
        share = np.clip((speed * math.sqrt(now) - (Z - dZ / 2)) / dZ, 0, 1)
        phi, elastic = Phi.value, 4 * p["M"] / 3 * np.cbrt(Phi.value)
        hot = p["Pi_ratio"] / p["Phi_inf"] * phi + elastic
        cold = phi + elastic
        g_hot, g_cold = (np.cbrt(phi) ** 2 * each / w**2 for each in (hot, cold))
        rate = share * g_hot * (p["Phi_inf"] - phi) + (1 - share) * g_cold * (1 - phi)
        inflow = np.cumsum(rate / phi) * dZ - rate / phi * dZ / 2
        slope = np.gradient(phi, dZ)
        mean = share * hot + (1 - share) * cold
        D.setValue(mean)
        decay.setValue(share * g_hot + (1 - share) * g_cold)
        gain.setValue(
            share * g_hot * p["Phi_inf"]
            + (1 - share) * g_cold
            - (2 / 3 * mean / phi * slope - inflow / 3) * slope
        )

    found = []
    for time in _roots_of_time(np.append(0.0, problem.tau), steps)[1:]:
        Phi.updateOld()
        dt, now = time - now, time
        _picard(equation, Phi, dt, update, solver)
        if time in problem.tau:
            found.append((Z.copy(), Phi.value.copy()))
    return [found]
