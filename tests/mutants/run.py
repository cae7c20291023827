"""Deliberate bugs, one at a time in a copy of the project: each must make a test fail.

    python tests/mutants/run.py --minutes 8

Prints a table; exit status 1 if a mutant survives, or if a test fails without any mutant.  What the
minutes do not suffice for is printed as not tried, and is a failure too.  With ``--record FILE``
the table, with what the failing tests said, takes its place in that file.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from queue import SimpleQueue
from typing import NamedTuple

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from recorded import record, table

PROJECT = Path(__file__).resolve().parents[2]
PARTS = ("Snakefile", "config", "profiles", "workflow", "src", "tests", "pyproject.toml")
SECONDS = 120.0  # for the tests of one mutant: what hangs is caught, too


class Mutant(NamedTuple):
    """A bug: the only occurrence of ``text`` in ``file`` becomes ``wrong``; pytest's arguments."""

    bug: str
    file: str
    text: str
    wrong: str
    tests: str


GEL = "src/gelpump/materials/energy_based.py"
EXPLICIT = "src/gelpump/materials/explicit.py"
BLOCKS = "src/gelpump/materials/blocks.py"
FITTED = "src/gelpump/materials/fit_checks.py"
TABLE = "src/gelpump/materials/measurements.py"
LINEAR = "src/gelpump/materials/piecewise_linear.py"
LENS = "src/gelpump/bead/lens.py"
NONLINEAR = "src/gelpump/bead/nonlinear.py"
FAMILY = "src/gelpump/tube/moving_mesh.py"
CLOSURE = "src/gelpump/tube/closure.py"
PAPER = "config/config.yaml"
TEST_GEL = "tests/materials/test_energy_based.py"
TEST_LENS = (
    "tests/bead/test_lens.py"
    " -k swelling_ends_in_equilibrium|analytic_rate|separate_at_308|reaches_the_spinodal"
)
TEST_NONLINEAR = "tests/bead/test_nonlinear.py -k published_radii|tends_to"
TEST_SLENDER = "tests/tube/test_slender.py -k printed_equation|thin_wall|front_face"
TEST_NUMBERS = "tests/test_config.py -k papers_numbers"

MUTANTS = (
    Mutant(
        "wrong factor in the osmotic pressure",
        GEL,
        "phi**2 * (a - b + 2 * phi * b)",
        "phi**2 * (a - b + 3 * phi * b)",
        TEST_GEL,
    ),
    Mutant(
        "wrong exponent of the shear modulus",
        GEL,
        "return float(np.cbrt(phi_00)) / self.Omega",
        "return float(np.sqrt(phi_00)) / self.Omega",
        TEST_GEL,
    ),
    Mutant(
        "shear left out of the diffusivity",
        GEL,
        "elastic = (phi + np.cbrt(phi)) / self.Omega",
        "elastic = (phi - np.cbrt(phi) / 3) / self.Omega",
        TEST_GEL,
    ),
    Mutant(
        "wrong exponent of the asymptote",
        GEL,
        "np.abs(excess) ** -0.6",
        "np.abs(excess) ** -0.5",
        TEST_GEL,
    ),
    Mutant(
        "swollen and dry branch swapped",
        EXPLICIT,
        '[0 if branch == "swollen" else -1]',
        '[-1 if branch == "swollen" else 0]',
        TEST_GEL,
    ),
    Mutant(
        "an extremum of T forgotten",
        EXPLICIT,
        "[[_SEARCH[0], _SEARCH[-1]], extrema, poles]",
        "[[_SEARCH[0], _SEARCH[-1]], poles]",
        "tests/materials/test_flory_rehner.py -k missed",
    ),
    Mutant(
        "chi of the energy taken for that of the pressure",
        BLOCKS,
        "[0, 2, -2], [0, 0, 3.0]",
        "[0, 2, -1], [0, 0, 3.0]",
        "tests/materials/test_flory_rehner.py -k slope_of_the_energy",
    ),
    Mutant(
        "a reference state half forgotten",
        BLOCKS,
        "LOGARITHM[kind] * phi_ref ** (-2 / 3)",
        "LOGARITHM[kind] * phi_ref ** (-1 / 3)",
        "tests/materials/test_flory_rehner.py -k slope_of_the_energy",
    ),
    Mutant(
        "points may lie on the unstable branch",
        FITTED,
        "if nearest > FAR and not",
        "if nearest > 1e9 and not",
        "tests/materials/test_measured.py -k unstable_branch",
    ),
    Mutant(
        "thousands read as decimals",
        TABLE,
        "if all(THOUSANDS.fullmatch(cell) for cell in commas):",
        "if False:",
        "tests/materials/test_measurements.py -k refused_in_words",
    ),
    Mutant(
        "wrong factor of M in D",
        LINEAR,
        "self._stiffness(theta) * Phi + 4 / 3 * self.M",
        "self._stiffness(theta) * Phi + 2 / 3 * self.M",
        "tests/materials/test_piecewise_linear.py",
    ),
    Mutant(
        "hot gel also at the transition itself",
        LINEAR,
        "np.where(np.asarray(theta) > 0, self.Phi_inf, 1.0)",
        "np.where(np.asarray(theta) >= 0, self.Phi_inf, 1.0)",
        "tests/materials/test_piecewise_linear.py",
    ),
    Mutant(
        "wrong boundary condition of the LENS bead",
        LENS,
        "self.temperature) / mu + 4.0 * np.cbrt(phi)",
        "self.temperature) / mu + 2.0 * np.cbrt(phi)",
        TEST_LENS,
    ),
    Mutant(
        "LENS bead twice too fast",
        LENS,
        "geometry = shells.R * shells.gap / (6.0 *",
        "geometry = shells.R * shells.gap / (12.0 *",
        TEST_LENS,
    ),
    Mutant(
        "shells' mean square radius off",
        LENS,
        "mean_square = [0.6 * np.diff(R**5)",
        "mean_square = [0.5 * np.diff(R**5)",
        TEST_LENS,
    ),
    Mutant(
        "D < 0 overlooked",
        LENS,
        "outside = (phi <= self.surface.lower) | (phi >= self.surface.upper)",
        "outside = phi >= 1.0",
        TEST_LENS,
    ),
    Mutant(
        "a face too few in the LENS mesh",
        LENS,
        "np.linspace(0.0, 1.0, n + 1)) for n in cells]",
        "np.linspace(0.0, 1.0 - 0.5 / n, n + 1)) for n in cells]",
        TEST_LENS,
    ),
    Mutant(
        "sign of the hoop stress",
        NONLINEAR,
        "return gradient + 2 / r *",
        "return gradient - 2 / r *",
        TEST_NONLINEAR,
    ),
    Mutant(
        "wrong exponent of the stretch",
        "src/gelpump/bead/stress_free.py",
        "return -osmotic + 1 / (f * l_t**4)",
        "return -osmotic + 1 / (f * l_t**2)",
        TEST_NONLINEAR,
    ),
    Mutant(
        "surface not free of stress",
        NONLINEAR,
        "stress, square, face = np.zeros(cells + 1)",
        "stress, square, face = np.full(cells + 1, 0.1)",
        TEST_NONLINEAR,
    ),
    Mutant(
        "parameter's change halved",
        "src/gelpump/bead/sensitivity.py",
        "changes.append((runs[0] - runs[1]) / (2.0 * SHARE))",
        "changes.append((runs[0] - runs[1]) / (4.0 * SHARE))",
        "tests/bead/test_production.py",
    ),
    Mutant(
        "published times not among the output",
        "src/gelpump/bead/production.py",
        '*case["published_times"], ',
        "",
        "tests/bead/test_production.py",
    ),
    Mutant(
        "uncertainty ten times too small",
        "src/gelpump/uncertainty.py",
        "SAFETY = 1.25",
        "SAFETY = 0.125",
        "tests/bead/test_production.py",
    ),
    Mutant(
        "wrong factor in the tube's source",
        CLOSURE,
        "resistance = s / stretch + 4 * M / 3 * stretch",
        "resistance = s / stretch + 2 * M / 3 * stretch",
        TEST_SLENDER,
    ),
    Mutant(
        "the tube's integral skipped",
        FAMILY,
        "shift = (Z_C - (stretch * V)",
        "shift = (Z_C - V",
        TEST_SLENDER,
    ),
    Mutant(
        "wrong exponent in the tube's Jacobian",
        CLOSURE,
        "return s * stretch**-5.0 +",
        "return s * stretch**-4.0 +",
        "tests/tube/test_slender.py -k slopes",
    ),
    Mutant(
        "wrong exponent of the tube's flux",
        CLOSURE,
        "return -s / 4 * stretch**-4.0 -",
        "return -s / 4 * stretch**-3.0 -",
        "tests/tube/test_slender.py -k slopes",
    ),
    Mutant(
        "a wall that leaks through its slopes",
        CLOSURE,
        "return -1.5 * s / stretch**2 + 4 * M * np.log(stretch)",
        "return -1.5 * s / stretch**2 + 3 * M * np.log(stretch)",
        "tests/tube/test_closure.py -k slopes",
    ),
    Mutant(
        "a surface that bears a force",
        CLOSURE,
        "4 * M * (x - 1 / stretch)",
        "3 * M * (x - 1 / stretch)",
        "tests/tube/test_closure.py -k force",
    ),
    Mutant(
        "books that miss what the front sweeps",
        "src/gelpump/tube/ledger.py",
        "velocity[:, family.behind] * (1 - at_front**3)",
        "velocity[:, family.behind] * (1 - at_front**2)",
        "tests/tube/test_closure.py -k conserved_over",
    ),
    Mutant(
        "front at the wrong temperature",
        "src/gelpump/tube/heat.py",
        "FRONT_CONSTANT = 2 * erfcinv(0.5)",
        "FRONT_CONSTANT = 2 * erfcinv(0.25)",
        "tests/tube/test_heat.py",
    ),
    Mutant(
        "a collapse that gives off its latent heat",
        "src/gelpump/tube/heated_family.py",
        "residual = residual - self.wall * L * water",
        "residual = residual + self.wall * L * water",
        "tests/tube/test_heated.py -k second_solver",
    ),
    Mutant(
        "a bath that feels the whole of its tube",
        "src/gelpump/tube/stefan.py",
        'return np.where(self.kind == "bath", 0.0, f)',
        "return f",
        "tests/tube/test_stefan.py -k roots",
    ),
    Mutant(
        "walls half as thick",
        "src/gelpump/tube/tubes.py",
        "return self.eps * (1 - self.ell) / 4",
        "return self.eps * (1 - self.ell) / 8",
        "tests/tube/test_deswelling.py",
    ),
    Mutant(
        "wrong exponent in the deswelling time",
        "src/gelpump/tube/deswelling.py",
        "stiffness = s * Phi ** (2 / 3)",
        "stiffness = s * Phi ** (1 / 3)",
        "tests/tube/test_deswelling.py",
    ),
    Mutant(
        "sign of the power law",
        "src/gelpump/tube/front.py",
        "x = -np.log(1 - np.asarray(ell))",
        "x = np.log(1 - np.asarray(ell))",
        "tests/tube/test_front.py -k power_law",
    ),
    Mutant(
        "unweighted cells in the fit",
        "src/gelpump/tube/front.py",
        "inside = np.diff(np.clip(faces, -half, half), axis=-1)",
        "inside = np.diff(np.clip(faces, -half, half), axis=-1) ** 0",
        "tests/tube/test_front.py -k fit_does_not_depend",
    ),
    Mutant(
        "lumen and outside swapped",
        "src/gelpump/tube/wall_flow.py",
        "return (1 / np.log(1 / ell) - 2 * ell**2 / (1 - ell**2)) / 2",
        "return 1 - (1 / np.log(1 / ell) - 2 * ell**2 / (1 - ell**2)) / 2",
        "tests/tube/test_wall_flow.py -k lumen_share",
    ),
    Mutant(
        "polymer moves too fast",
        "src/gelpump/tube/wall_flow.py",
        "return -(self.integral(self.F / self.Phi1) + self.axial_velocity_face) / 3",
        "return -(self.integral(self.F / self.Phi1) + self.axial_velocity_face) / 2",
        "tests/tube/test_wall_flow.py -k polymer_moves",
    ),
    Mutant(
        "wrong prefactor of the lumen's velocity",
        "src/gelpump/tube/lumen.py",
        "return 8 / (eps * one_minus_ell) ** 2",
        "return 16 / (eps * one_minus_ell) ** 2",
        "tests/tube/test_lumen.py -k written_out",
    ),
    Mutant(
        "wrong derivative weights",
        "src/gelpump/bdf.py",
        "barycentric[1:] / barycentric[0] / (t[0] - t[1:])",
        "barycentric[1:] / barycentric[0] / (t[1:] - t[0])",
        "tests/test_bdf.py",
    ),
    Mutant(
        "error estimate for the wrong order",
        "src/gelpump/bdf.py",
        "share = step / (t - times[points - 1]) if",
        "share = 1e-3 if",
        "tests/test_bdf.py -k error_falls",
    ),
    Mutant(
        "sign of the residual",
        "src/gelpump/finite_volume.py",
        "== flow - self.G",
        "== flow + self.G",
        "tests/test_finite_volume.py",
    ),
    Mutant(
        "status always reproduced",
        "src/gelpump/statements/statement.py",
        'if agree else "deviates"',
        'if agree else "reproduced"',
        "tests/statements/test_statement.py",
    ),
    Mutant(
        "any of several values is enough",
        "src/gelpump/statements/statement.py",
        "return bool(np.all(np.abs(np.subtract(found.value, value)) <= allowed))",
        "return bool(np.any(np.abs(np.subtract(found.value, value)) <= allowed))",
        "tests/statements/test_statement.py",
    ),
    Mutant(
        "doubt counts as proof",
        "src/gelpump/statements/statement.py",
        "return bool(margin > uncertainty)",
        "return bool(margin > -uncertainty)",
        "tests/statements/test_statement.py",
    ),
    Mutant(
        "digits swapped in table 2",
        PAPER,
        "B0: 0.20470",
        "B0: 0.20740",
        TEST_NUMBERS,
    ),
    Mutant(
        "another gel swells",
        PAPER,
        "swelling: # section 2.1, figure 3\n    gel: HHT",
        "swelling: # section 2.1, figure 3\n    gel: ANB",
        TEST_NUMBERS,
    ),
    Mutant(
        "wrong published value",
        PAPER,
        "front-position: {value: 0.9539,",
        "front-position: {value: 0.9593,",
        TEST_NUMBERS,
    ),
    Mutant(
        "NaN written to a dataset",
        "src/gelpump/netcdf.py",
        "    _require_finite(dataset, title, flag)\n",
        "",
        "tests/test_netcdf.py",
    ),
    Mutant(
        "a file that appears before it is whole",
        "src/gelpump/files.py",
        "        yield partial\n",
        "        path.touch()\n        yield partial\n",
        "tests/test_netcdf.py",
    ),
    Mutant(
        "a key that is given twice",
        "src/gelpump/config.py",
        "elif name.value in seen:",
        "elif name.value in ():",
        "tests/hostile/test_hostile_config.py -m evidence -k seem",
    ),
    Mutant(
        "code in a template",
        "src/gelpump/config.py",
        'elif name.value == "__use_yte__":',
        'elif name.value == "__use_jinja__":',
        "tests/test_config.py -k command_line",
    ),
    Mutant(
        "the older of two records counts",
        "src/gelpump/integrity/manifest.py",
        "for record in records for path",
        "for record in reversed(records) for path",
        "tests/integrity/test_manifest.py",
    ),
    Mutant(
        "an altered output is taken for a newer one",
        "src/gelpump/integrity/alterations.py",
        'made[path]["outputs"][path]["sha256"] == found[path]',
        'made[path]["outputs"][path]["sha256"] != found[path]',
        "tests/integrity/test_manifest.py",
    ),
    Mutant(
        "the convergence index is too small",
        "src/gelpump/uncertainty.py",
        "return SAFETY * after * ratio / (ratio - 1.0)",
        "return SAFETY * after / (ratio - 1.0)",
        "tests/test_uncertainty.py",
    ),
    Mutant(
        "a quadrature without its error",
        "src/gelpump/uncertainty.py",
        "np.abs(value - formula(fewer))",
        "np.abs(value - formula(nodes))",
        "tests/test_uncertainty.py",
    ),
    Mutant(
        "the front's jump in the radial flow is left out",
        "src/gelpump/tube/wall_flow.py",
        "np.max([speed.max(axis=-1), *sides], axis=0)",
        "np.max([speed.max(axis=-1)], axis=0)",
        "tests/tube/test_wall_flow.py -k fastest",
    ),
)


class Copies:
    """Copies of the project, one for each test run that goes on at the same time."""

    def __init__(self, folder: Path, count: int):
        self.free = SimpleQueue()
        for i in range(count):
            copy = folder / str(i)
            copy.mkdir()
            for part in PARTS:
                if (PROJECT / part).is_dir():
                    ignored = shutil.ignore_patterns("__pycache__", "*.egg-info")
                    shutil.copytree(PROJECT / part, copy / part, ignore=ignored)
                else:
                    shutil.copy2(PROJECT / part, copy / part)
            self.free.put(copy)

    def caught(self, mutant: Mutant | None, tests: str) -> str:
        """What a test says that fails, or that none ends in time, with this bug; else nothing."""
        copy = self.free.get()
        file = copy / mutant.file if mutant else None
        original = file.read_text() if file else ""
        try:
            if mutant:
                if original.count(mutant.text) != 1:
                    raise LookupError(f"{mutant.bug}: its text is not once in {mutant.file}")
                file.write_text(original.replace(mutant.text, mutant.wrong))
            return self.fails(copy, tests)
        finally:
            if file:
                file.write_text(original)
            self.free.put(copy)

    @staticmethod
    def fails(copy: Path, tests: str) -> str:
        files, _, chosen = tests.partition(" -k ")
        command = [sys.executable, "-B", "-m", "pytest", "-x", "-q", "-n", "0", *files.split()]
        command += ["-p", "no:cacheprovider", "--color=no"]
        if chosen:
            command += ["-k", chosen.replace("|", " or ")]
        try:
            result = subprocess.run(
                command,
                cwd=copy,
                env=os.environ | {"PYTHONPATH": str(copy / "src"), "OMP_NUM_THREADS": "1"},
                capture_output=True,
                text=True,
                timeout=SECONDS,
                check=False,
            )
        except subprocess.TimeoutExpired:
            return f"no end after {SECONDS:.0f} s"
        if result.returncode not in (0, 1):  # neither passed nor failed: nothing was tested
            raise RuntimeError(f"pytest {tests}:\n{result.stdout[-2000:]}{result.stderr[-500:]}")
        if result.returncode == 0:
            return ""
        lines = [line for line in result.stdout.splitlines() if line.startswith("FAILED ")]
        _, _, failed = lines[0].partition("::") if lines else ("", "", "a test")
        reasons = [line[1:].strip() for line in result.stdout.splitlines() if line[:2] == "E "]
        return f"{failed.partition(' - ')[0]}: {' '.join(filter(None, reasons[:4])) or 'fails'}"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--minutes", type=float, default=8.0)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--record", type=Path)
    parser.add_argument("words", nargs="*", help="try only bugs with one of these in their name")
    arguments = parser.parse_args()
    words = arguments.words or [""]
    mutants = [mutant for mutant in MUTANTS if any(word in mutant.bug for word in words)]
    deadline = time.monotonic() + 60.0 * arguments.minutes

    def verdict(mutant: Mutant) -> tuple[str, str]:
        if time.monotonic() > deadline:
            return "not tried", ""
        try:
            said = copies.caught(mutant, mutant.tests)
        except (LookupError, RuntimeError) as problem:
            return "ERROR", str(problem)
        return ("caught" if said else "SURVIVED"), said

    with (
        tempfile.TemporaryDirectory(prefix="mutants-") as folder,
        ThreadPoolExecutor(arguments.jobs) as pool,
    ):
        copies = Copies(Path(folder), arguments.jobs)
        selections = sorted({mutant.tests for mutant in mutants})
        failing = [
            tests
            for tests, fails in zip(
                selections, pool.map(lambda t: copies.caught(None, t), selections), strict=True
            )
            if fails
        ]
        for tests in failing:
            print(f"fails without any bug: pytest {tests}")
        verdicts, rows = [], []
        for mutant, (found, said) in zip(mutants, pool.map(verdict, mutants), strict=True):
            verdicts.append(found)
            file = mutant.file.removeprefix("src/gelpump/")
            print(f"{found:9s} {mutant.bug:42s} {file:30s} {said[:160]}", flush=True)
            change = f"`{' '.join(mutant.text.split())}` to `{' '.join(mutant.wrong.split())}`"
            rows.append([mutant.bug, file, change, found, said])
    caught = verdicts.count("caught")
    print(f"{caught} of {len(mutants)} mutants caught")
    if arguments.record:
        heads = ["deliberate bug", "file", "changed", "verdict", "what the test said"]
        counted = f"{caught} of {len(mutants)} deliberate bugs were caught."
        record(arguments.record, "mutants", counted, table(heads, rows))
    return int(bool(failing) or caught < len(mutants))


if __name__ == "__main__":
    sys.exit(main())
