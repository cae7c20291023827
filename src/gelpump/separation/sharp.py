r"""A bead that separates, in the sharp limit: stage by stage.

The bead is one block, in its first phase, until its surface loses that phase's stress-free state.
Then a skin of the other phase is put on, a share ``skin`` of the dry radius thick, at the volume
that the coexistence gives it.  It is one block again when the front has come to R_f = CORE and the
rest of its core is given the skin's phase, or when the two sides of the front have become one.

CVODE integrates either model, with the exact pattern of the Jacobian.  The stages are those of
``gelpump.separation.blocks``.  Of every state that CVODE accepts, and of every one that a stage
begins with or gives out, it is asserted that shells are in order, each holds less polymer than it
has volume, all hold the bead's, and E > 0 in each: without an energy of interfaces the equations
have no meaning where E < 0, but a coarse block passes through it with a smooth radius.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gelpump import progress
from gelpump.separation import observed
from gelpump.separation.blocks import MERGED, Divided, Whole, graded_core
from gelpump.separation.coexistence import (
    Coexistence,
    OnePhase,
    Surface,
    critical_hoop_stretch,
    spinodal,
    surface_excess,
    surface_margin,
)
from gelpump.separation.shells import (
    clustered_outside,
    polymer_fraction,
    require_sound,
    soundness,
    unsound,
)

if TYPE_CHECKING:
    import xarray as xr

SKIN = 1e-3
LEAST_SKIN, MOST_SKIN = 1e-4, 0.05
ABSOLUTE = 0.01  # absolute tolerance over the relative one
THINNEST_SHARE = 0.003  # of the thinnest shell, the most that the tolerance may be
MAX_STEPS = 20_000
MAX_EVALUATIONS = 100_000  # of the rate; production needs some thousands
BEYOND = 1.3  # times the largest radius of an equilibrium is how far tables reach


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
        """Note the state y of a stage at time t; Unsound if no bead is in it."""
        R, r = stage.faces(y)
        require_sound(self.energy, t, R, r)
        self.t.append(t)
        self.faces.append((R, r))
        self.surface.append(stage.surface.state(float(r[-1])))
        if isinstance(stage, Divided):
            self.front.append((y[-1], y[stage.core - 1]))
        else:
            self.front.append((np.nan, np.nan))

    def begin(self, R: NDArray, r: NDArray, phi: float) -> None:
        """The bead at t = 0, of which no stage is solved yet."""
        self.t, self.faces, self.surface = [0.0], [(R, r)], [phi]
        self.front = [(np.nan, np.nan)]

    def follow(self, stage: Whole | Divided, start: NDArray, tolerance: float):
        """March ``stage`` from its start until its margins end, or to the last time; R and r of
        all faces there, for the next stage.  CVODE looks at the margins after each of its steps."""
        from sksundae.cvode import CVODE

        # an error of the faces as large as a shell is thick would tangle them
        tolerance = min(tolerance, THINNEST_SHARE * float(np.diff(stage.faces(start)[1]).min()))

        def rate(t, y, dydt):
            dydt[:] = stage.rate(y)

        def jacobian(t, y, dydt, J):
            J[:] = stage.jacobian(y)

        def margin(t, y, events):
            events[0] = min(self.margins(stage, y).values())

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
        require_sound(self.energy, now, *stage.faces(start))
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

    def margins(self, stage: Whole | Divided, y: NDArray) -> dict[str, float]:
        """Positive each: the stage's own margins, and those of a state that a bead can be in."""
        return soundness(self.energy, *stage.faces(y)) | stage.margins(y)

    def ended(self, stage: Whole | Divided, t: float, y: NDArray) -> tuple[NDArray, NDArray]:
        """What the end of a stage's margins means, and the faces that the next one begins with."""
        margins = self.margins(stage, y)
        lost = min(margins, key=margins.get)
        if lost not in stage.margins(y):
            raise unsound(self.energy, t, *stage.faces(y))
        if lost == "bead":
            raise RuntimeError(f"at t = {t:.6g} the front comes back to the surface")
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
    that of ``gelpump.separation.observed``.  It ends early, and its attribute ``stopped`` says why,
    where the initial state is not stable, a front would be born at a critical point, no bead is in
    a state, or CVODE fails; else ``stopped`` is empty.

    Raises ValueError for times, cells, skin or phi_initial that no bead has.
    """
    times = np.asarray(times, dtype=float)
    if times.ndim != 1 or times.size < 2 or times[0] != 0 or not np.all(np.diff(times) > 0):
        raise ValueError(f"times = {times}: must increase from 0")
    if min(cells) < 4:
        raise ValueError(f"cells = {cells}: must be at least 4 of each")
    if not LEAST_SKIN <= skin <= MOST_SKIN:
        raise ValueError(f"skin = {skin}: must be {LEAST_SKIN} to {MOST_SKIN} of the dry radius")
    course = Course(energy, times)
    stopped = ""
    try:
        _through(course, phi_initial, cells, tolerance, skin)
    except (OnePhase, RuntimeError) as why:
        stopped = str(why)
        if not course.t:
            R = clustered_outside(sum(cells))
            course.begin(R, phi_initial ** (-1 / 3) * R, phi_initial)
    return course.dataset(phi_initial=phi_initial, tolerance=tolerance, skin=skin, stopped=stopped)


def _through(course: Course, phi_initial: float, cells: tuple[int, int], tolerance: float, skin):
    """Stage by stage to the last time; OnePhase or RuntimeError if one cannot be solved."""
    energy = course.energy
    start = float(phi_initial) ** (-1 / 3)
    phase = first_phase(energy, phi_initial)
    other = "dry" if phase == "swollen" else "swollen"
    high = BEYOND * max(
        start, energy.gel.equilibrium_polymer_fraction(energy.temperature) ** (-1 / 3)
    )
    bare = sum(cells)
    R = clustered_outside(bare)
    if surface_margin(energy, start, phase) > 0.0:
        whole = Whole(energy, Surface.between(energy, phase, 1.0, high, start), bare)
        R, r = course.follow(whole, start * R[1:], tolerance)
    else:
        # the surface has no state of the first phase from the first instant
        r = start * R
        course.begin(R, r, phi_initial)
        course.events = {"birth_t": 0.0, "birth_radius": float(r[-1])}
    if course.unfinished:
        surface = Surface.between(energy, other, 1.0, high, float(r[-1]))
        critical = critical_hoop_stretch(energy, 1.0, high)
        if r[-1] <= critical * (1 + MERGED) and critical > 1.0:
            raise OnePhase(
                f"at a = {r[-1]:.6g}, where the surface loses its state, the two sides of a front "
                f"are still one (they part above l_t = {critical:.6g}): the front would be born at "
                "the critical point, which is not solved"
            )
        sides = Coexistence.between(energy, 1.0, high)
        divided = Divided(energy, sides, surface, other == "dry", *cells)
        layer = divided.layer(float(r[-1]), float(polymer_fraction(R, r)[-1]), skin)
        divided.X = graded_core(cells[0], layer)
        R, r = course.follow(divided, divided.born(R, r, skin, layer), tolerance)
    if course.unfinished:
        whole = Whole(energy, surface, bare)
        course.follow(whole, whole.between(R, r), tolerance)


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
