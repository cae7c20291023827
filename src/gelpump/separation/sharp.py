r"""A bead that separates, in the sharp limit: two blocks of shells that meet at a front.

    core     R in [0, R_f] ,  its outer state one side of the coexistence at l_t = r_f/R_f
    skin     R in [R_f, 1] ,  its inner state the other side, its surface free of stress
    front    dR_f/dt = -[dr/dt] / [l_r]      (r is continuous: [dr/dt + l_r dR_f/dt] = 0)

with dr/dt|_R of ``gelpump.separation.energy`` on either side.  Faces move with the front, R = R_f X
in the core and R_f^(1-s) in the skin, where dr/dt = dr/dt|_R + l_r dR/dt.

The bead is one block, in its first phase, until its surface loses that phase's stress-free state.
Then a skin of the other phase is put on, a share ``skin`` of the dry radius thick, at the volume
that the coexistence gives it.  It is one block again when the front has come to R_f = CORE and the
rest of its core is given the skin's phase, or when the two sides of the front have become one.

CVODE integrates either model, with the exact pattern of the Jacobian.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gelpump import progress
from gelpump.separation import observed
from gelpump.separation.coexistence import (
    Coexistence,
    OnePhase,
    Surface,
    spinodal,
    surface_excess,
    surface_margin,
)
from gelpump.separation.shells import (
    clustered_outside,
    graded,
    interpolated,
    motion,
    polymer_fraction,
)

if TYPE_CHECKING:
    import xarray as xr

SKIN = 1e-3
AHEAD = 0.1  # of the layer ahead of the first front: the core's shell there
LEAST_SKIN, MOST_SKIN = 1e-4, 0.05
CORE = 0.01
DIFFERENCE = 1e-4  # of a Jacobian, over the thickness of a shell
ABSOLUTE = 0.01  # absolute tolerance over the relative one
THINNEST_SHARE = 0.003  # of the thinnest shell, the most that the tolerance may be
MAX_STEPS = 20_000
MAX_EVALUATIONS = 100_000  # of the rate; production needs some thousands
MERGED = 1e-6  # hoop stretch above the critical one, relative, at which a front has no sides
BEYOND = 1.3  # times the largest radius of an equilibrium is how far tables reach


class Whole:
    """One block: the whole bead in one phase; y holds r of its faces."""

    def __init__(self, energy, surface: Surface, cells: int):
        self.energy, self.surface = energy, surface
        self.R = clustered_outside(cells)

    def faces(self, y: NDArray) -> tuple[NDArray, NDArray]:
        """R and r of all faces."""
        return self.R, np.append(0.0, y)

    def rate(self, y: NDArray) -> NDArray:
        """dy/dt."""
        R, r = self.faces(y)
        return motion(self.energy, R, r, None, self.surface.state(r[-1])).rate[1:]

    def jacobian(self, y: NDArray) -> NDArray:
        """d(rate)/dy, dense."""
        return _banded(self.rate, y, np.diff(y, prepend=0.0))

    def margins(self, y: NDArray) -> dict[str, float]:
        """Positive each, until the surface has no state of its phase."""
        return {"surface": self.surface.margin(y[-1])}

    def between(self, R: NDArray, r: NDArray) -> NDArray:
        """The state y with the course r(R) of other faces."""
        return interpolated(R, r, self.R)[1:]


class Divided:
    """Two blocks: y holds r of the core's faces, the last of them r_f, of the skin's, and R_f."""

    def __init__(
        self, energy, sides: Coexistence, surface: Surface, dry: bool, core: int, skin: int
    ):
        self.energy, self.sides, self.surface, self.dry = energy, sides, surface, dry
        self.X, self.s = clustered_outside(core), np.linspace(0.0, 1.0, skin + 1)
        self.core = core

    def blocks(self, y: NDArray) -> tuple[NDArray, NDArray, NDArray, NDArray]:
        """R and r of the core's faces, R and r of the skin's."""
        core, skin = y[: self.core], y[self.core - 1 : -1]
        return y[-1] * self.X, np.append(0.0, core), y[-1] ** (1 - self.s), skin

    def faces(self, y: NDArray) -> tuple[NDArray, NDArray]:
        """R and r of all faces."""
        R_core, r_core, R_skin, r_skin = self.blocks(y)
        return np.append(R_core, R_skin[1:]), np.append(r_core, r_skin[1:])

    def at_hoop_stretch(self, l_t: float) -> tuple[float, float]:
        """Polymer fractions of the core's and the skin's side of a front."""
        swollen, dry = self.sides.sides(l_t)
        return (swollen, dry) if self.dry else (dry, swollen)

    def at_front(self, y: NDArray) -> tuple[float, float]:
        """Polymer fractions of the core's and the skin's side of the front."""
        return self.at_hoop_stretch(y[self.core - 1] / y[-1])

    def layer(self, r: float, phi: float, skin: float) -> float:
        """Thickness in R of the core's layer ahead of the front of a skin that is as thin as
        ``skin``, at radius r, phi the core's polymer fraction: that of a front that moves steadily,
        (E/l_r^2) / |dR_f/dt|, the skin's stress falling evenly; at most the skin's own."""
        inside, outside = self.at_hoop_stretch(r)
        at_surface = self.surface.state(r)
        drop = self.energy.radial_stress(at_surface, r) - self.energy.radial_stress(outside, r)
        stretch = 1 / (np.array([inside, outside, phi]) * r**2)
        speed = drop / (skin * stretch[1]) / (stretch[2] - stretch[1])
        diffusivity = self.energy.stiffness(inside, r) / stretch[0] ** 2
        return float(min(abs(diffusivity / speed), skin))

    def rate(self, y: NDArray) -> NDArray:
        """dy/dt."""
        fixed, drift, speed = self.parts(y)
        return fixed + drift * speed

    def parts(self, y: NDArray) -> tuple[NDArray, NDArray, float]:
        """dy/dt at fixed R, dy/dR_f of faces that move with the front, and dR_f/dt."""
        R_core, r_core, R_skin, r_skin = self.blocks(y)
        inside, outside = self.at_front(y)
        core = motion(self.energy, R_core, r_core, None, inside)
        skin = motion(self.energy, R_skin, r_skin, outside, self.surface.state(r_skin[-1]))
        speed = -(skin.rate[0] - core.rate[-1]) / (skin.radial_stretch[0] - core.radial_stretch[-1])
        fixed = np.concatenate([core.rate[1:], skin.rate[1:], [0.0]])
        moving = self.X[1:], (1 - self.s[1:]) * R_skin[1:] / y[-1]
        stretch = core.radial_stretch[1:], skin.radial_stretch[1:]
        drift = np.concatenate(
            [*(l_r * dR for l_r, dR in zip(stretch, moving, strict=True)), [1.0]]
        )
        return fixed, drift, speed

    def jacobian(self, y: NDArray) -> NDArray:
        """d(rate)/dy, dense: five diagonals, what the front's speed adds, and R_f's column."""
        _, drift, speed = self.parts(y)
        thickness = np.append(np.diff(y[:-1], prepend=0.0), min(y[-1], 1 - y[-1]))

        def at_speed(radii):
            fixed, drift, _ = self.parts(np.append(radii, y[-1]))
            return (fixed + drift * speed)[:-1]

        J = np.zeros((y.size, y.size))
        J[:-1, :-1] = _banded(at_speed, y[:-1], thickness[:-1])
        for j in (*range(self.core - 3, self.core + 2), y.size - 1):
            step = np.zeros_like(y)
            step[j] = DIFFERENCE * thickness[j : j + 2].min()
            (fixed, drifts, speeds), low = self.parts(y + step), self.parts(y - step)
            J[:, j] += drift * (speeds - low[2]) / (2 * step[j])
            if j == y.size - 1:
                J[:, j] += (fixed - low[0] + (drifts - low[1]) * speed) / (2 * step[j])
        return J

    def margins(self, y: NDArray) -> dict[str, float]:
        """Positive each, until no core is left, the sides are one, or the surface is lost."""
        return {
            "core": y[-1] - CORE,
            "front": y[self.core - 1] / y[-1] - self.sides.hoop_stretch[0] * (1 + MERGED),
            "surface": self.surface.margin(y[-2]),
        }

    def born(self, R: NDArray, r: NDArray, skin: float, layer: float) -> NDArray:
        """The state y of a bead r(R) in one phase that a skin of the other is put on.

        Along the skin J is linear; towards the front the core's J tends to the front's within
        ``layer``, exponentially, as it would ahead of a front that moves steadily.
        """
        front = 1.0 - skin
        cube = interpolated(R, r, front * self.X) ** 3
        l_t = np.cbrt(cube[-1]) / front
        inside, outside = (1 / phi for phi in self.at_hoop_stretch(l_t))
        drawn = inside - np.diff(cube)[-1] / np.diff((front * self.X) ** 3)[-1]
        cube[1:] += 3 * front**2 * layer * drawn * np.exp(front * (self.X[1:] - 1) / layer)
        R_skin = front ** (1 - self.s)
        J = outside + self.s * (1 / self.surface.state(np.cbrt(cube[-1])) - outside)
        swept = np.cumsum(0.5 * (J[1:] + J[:-1]) * np.diff(R_skin**3))
        return np.concatenate([np.cbrt(cube[1:]), np.cbrt(cube[-1] + swept), [front]])

    def completed(self, y: NDArray) -> tuple[NDArray, NDArray]:
        """R and r of all faces, what is left of the core having the skin's phase."""
        R, r = self.faces(y)
        phi = self.at_front(y)[1]
        inner = y[-1] >= R
        lost = y[self.core - 1] ** 3 - y[-1] ** 3 / phi
        return R, np.cbrt(np.where(inner, R**3 / phi, r**3 - lost))

    def completion(self, t: float, y: NDArray) -> float:
        """When R_f = 0: R_f^2 falls in proportion to time in the end."""
        return float(t - 0.5 * y[-1] / self.parts(y)[2])


def graded_core(cells: int, layer: float) -> NDArray:
    """Faces X of a core that resolves the ``layer`` ahead of its first front."""
    return graded(cells, AHEAD * layer)


def _banded(rate, y: NDArray, thickness: NDArray) -> NDArray:
    """Central differences of a rate of which each row depends on two neighbours on either side."""
    J = np.zeros((y.size, y.size))
    step = DIFFERENCE * np.minimum(thickness, np.append(thickness[1:], np.inf))
    for first in range(5):
        j = np.arange(first, y.size, 5)
        shift = np.zeros(y.size)
        shift[j] = step[j]
        change = rate(y + shift) - rate(y - shift)
        for offset in range(-2, 3):
            column = j[(j + offset >= 0) & (j + offset < y.size)]
            J[column + offset, column] = change[column + offset] / (2 * step[column])
    return J


class Course:
    """What becomes of a bead: its faces at the times that were asked for, stage by stage."""

    def __init__(self, energy, times: NDArray):
        self.energy, self.times = energy, times
        self.t: list[float] = []
        self.faces: list[tuple[NDArray, NDArray]] = []
        self.surface: list[float] = []
        self.front: list[tuple[float, float]] = []
        self.events: dict[str, float] = {}
        self.unfinished = True

    def keep(self, t: float, stage: Whole | Divided, y: NDArray) -> None:
        """Note the state y of a stage at time t."""
        R, r = stage.faces(y)
        self.t.append(t)
        self.faces.append((R, r))
        self.surface.append(stage.surface.state(float(r[-1])))
        if isinstance(stage, Divided):
            self.front.append((y[-1], y[stage.core - 1]))
        else:
            self.front.append((np.nan, np.nan))

    def born_at_once(self, R: NDArray, r: NDArray, phi: float) -> None:
        """The surface has no state of the first phase from the first instant."""
        self.t, self.faces, self.surface = [0.0], [(R, r)], [phi]
        self.front = [(np.nan, np.nan)]
        self.events = {"birth_t": 0.0, "birth_radius": float(r[-1])}

    def follow(self, stage: Whole | Divided, start: NDArray, tolerance: float):
        """March ``stage`` from its start until its margins end, or to the last time; R and r of
        all faces there, for the next stage."""
        from sksundae.cvode import CVODE

        # an error of the faces as large as a shell is thick would tangle them
        tolerance = min(tolerance, THINNEST_SHARE * float(np.diff(stage.faces(start)[1]).min()))

        def rate(t, y, dydt):
            dydt[:] = stage.rate(y)

        def jacobian(t, y, dydt, J):
            J[:] = stage.jacobian(y)

        def margin(t, y, events):
            events[0] = min(stage.margins(y).values())

        solver = CVODE(
            rate,
            jacfn=jacobian,
            rtol=tolerance,
            atol=ABSOLUTE * tolerance,
            linsolver="dense",
            max_num_steps=MAX_STEPS,
            eventsfn=margin,
            num_events=1,
        )
        now = self.t[-1] if self.t else 0.0
        if not self.t:
            self.keep(now, stage, start)
        solver.init_step(now, start)
        y = start
        for time in self.times[self.times > now]:
            step = solver.step(time)
            if not step.success:
                raise RuntimeError(f"CVODE at t = {step.t}: {step.message}")
            progress.at(float(step.t), float(self.times[-1]))
            if step.nfev > MAX_EVALUATIONS:
                raise RuntimeError(f"CVODE at t = {step.t}: {step.nfev} evaluations of the rate")
            y = np.array(step.y)
            self.keep(float(step.t), stage, y)
            if step.t < time:
                return self.ended(stage, float(step.t), y)
        self.unfinished = False
        return stage.faces(y)

    def ended(self, stage: Whole | Divided, t: float, y: NDArray) -> tuple[NDArray, NDArray]:
        """What the end of a stage's margins means, and the faces that the next one begins with."""
        margins = stage.margins(y)
        lost = min(margins, key=margins.get)
        if isinstance(stage, Whole) and "birth_t" not in self.events:
            self.events |= {"birth_t": t, "birth_radius": float(y[-1])}
            return stage.faces(y)
        if lost == "surface":
            raise RuntimeError(f"at t = {t:.6g} the skin's surface loses its state: a second front")
        if lost == "front":
            self.events |= {"merged_t": t, "merged_R": float(y[-1])}
            return stage.faces(y)
        self.events["completion_t"] = stage.completion(t, y)
        return stage.completed(y)

    def dataset(self, **attributes) -> "xr.Dataset":
        """The whole course, ``gelpump.separation.observed``."""
        R, r = (np.array(each) for each in zip(*self.faces, strict=True))
        front = np.array(self.front)
        return observed.dataset(
            self.energy,
            np.array(self.t),
            R,
            r,
            np.array(self.surface),
            front,
            self.events | attributes,
        )


def solve(
    energy,
    phi_initial: float,
    times: Sequence[float],
    cells: tuple[int, int],
    *,
    tolerance: float,
    skin: float = SKIN,
) -> "xr.Dataset":
    """The bead of ``energy`` from uniform ``phi_initial``, through separation where it separates.

    times: increasing from 0, in t_BMJ.  cells: of the core and of the skin.  tolerance: CVODE's,
    for the radii.  skin: what the front is born with, a share of the dry radius.  The dataset is
    that of ``gelpump.separation.observed``.

    Raises ValueError for times, cells, skin or phi_initial that no bead has, OnePhase if the
    initial state is not stable, and RuntimeError when CVODE fails.
    """
    times = np.asarray(times, dtype=float)
    if times.ndim != 1 or times.size < 2 or times[0] != 0 or not np.all(np.diff(times) > 0):
        raise ValueError(f"times = {times}: must increase from 0")
    if min(cells) < 4:
        raise ValueError(f"cells = {cells}: must be at least 4 of each")
    if not LEAST_SKIN <= skin <= MOST_SKIN:
        raise ValueError(f"skin = {skin}: must be {LEAST_SKIN} to {MOST_SKIN} of the dry radius")
    start = float(phi_initial) ** (-1 / 3)
    phase = first_phase(energy, phi_initial)
    other = "dry" if phase == "swollen" else "swollen"
    high = BEYOND * max(
        start, energy.gel.equilibrium_polymer_fraction(energy.temperature) ** (-1 / 3)
    )
    course = Course(energy, times)
    bare = sum(cells)
    R = clustered_outside(bare)
    if surface_margin(energy, start, phase) > 0.0:
        whole = Whole(energy, Surface.between(energy, phase, 1.0, high, start), bare)
        R, r = course.follow(whole, start * R[1:], tolerance)
    else:
        r = start * R
        course.born_at_once(R, r, phi_initial)
    if course.unfinished:
        surface = Surface.between(energy, other, 1.0, high, float(r[-1]))
        sides = Coexistence.between(energy, 1.0, high)
        if r[-1] * (1 - skin) <= sides.hoop_stretch[0] * (1 + MERGED) and sides.critical:
            raise OnePhase(
                f"at a = {r[-1]:.6g}, where the surface loses its state, the two sides of a front "
                "are still one: it steepens, but nothing separates"
            )
        divided = Divided(energy, sides, surface, other == "dry", *cells)
        layer = divided.layer(float(r[-1]), float(polymer_fraction(R, r)[-1]), skin)
        divided.X = graded_core(cells[0], layer)
        R, r = course.follow(divided, divided.born(R, r, skin, layer), tolerance)
    if course.unfinished:
        whole = Whole(energy, surface, bare)
        course.follow(whole, whole.between(R, r), tolerance)
    return course.dataset(phi_initial=phi_initial, tolerance=tolerance, skin=skin)


def first_phase(energy, phi: float) -> str:
    """The phase of a uniform bead, swollen or dry; OnePhase if it is not stable."""
    l_t = phi ** (-1 / 3)
    try:
        inner, outer = spinodal(energy, l_t)
    except OnePhase:
        # where there is but one phase: the one that the surface would leave
        return "swollen" if surface_excess(energy, phi, l_t) > 0 else "dry"
    if inner < phi < outer:
        raise OnePhase(f"phi = {phi:.6g} is not stable at {energy.temperature} K: E < 0")
    return "swollen" if phi <= inner else "dry"
