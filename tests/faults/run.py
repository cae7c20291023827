"""Break builds on purpose, and see that the next one completes with the same bytes.

    python tests/faults/run.py --kills 20 --minutes 6

Each fault prints a line: held, BROKEN and how, or skipped and why.  Exit status 1 if one broke.
When the minutes are over no further build is killed and no further fault begun; what was left out
is printed as skipped.  With ``--record FILE`` the lines take their place in that file.
"""

import argparse
import hashlib
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from contextlib import contextmanager, suppress
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from clone import Clone
from recorded import record, table

TINY = Path(__file__).with_name("tiny.yaml")
DATASETS = (
    "materials_ANB",
    "materials_HHT",
    "bead_swelling_lens",
    "bead_swelling_nonlinear",
    "bead_separating_lens",
    "deswelling_map",
    "deswelling_curves",
)
TARGETS = (
    *(f"results/data/{name}.nc" for name in DATASETS),
    "fig03_swell_bead",
    "fig14_equilibrium",
    "table2_gel_parameters",
)
ONE = "results/data/deswelling_curves.nc"  # for faults that need one job only
KINDS = {".nc", ".png", ".pdf", ".svg", ".csv", ".md", ".tex"}
JOB_SECONDS, RUN_SECONDS = 60.0, 240.0


class Skipped(Exception):
    """This machine does not allow the fault."""


class Site(Clone):
    """A clone that builds the tiny paper."""

    def __init__(self, path: Path):
        super().__init__(path)
        shutil.copy2(TINY, path / "tiny.yaml")
        self.runs = 0

    @property
    def results(self) -> Path:
        return self.path / "results"

    def start(self, *arguments: str, **variables: str) -> subprocess.Popen:
        """Snakemake in a session of its own, so that all its jobs can be found.

        It speaks to a file: a pipe would be full one day, or closed while jobs go on.
        """
        self.runs += 1
        with self.said().open("w") as said:
            return subprocess.Popen(
                self.command(*arguments, config="tiny.yaml"),
                cwd=self.path,
                env=self.environment() | variables,
                stdout=said,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )

    def said(self, run: int = 0) -> Path:
        """What the latest run said, or an earlier one."""
        return self.path / f"said-{run or self.runs}.txt"

    def wait(self, process: subprocess.Popen) -> None:
        """To the end of a run; one that hangs is ended with its jobs."""
        try:
            process.wait(timeout=RUN_SECONDS)
        except subprocess.TimeoutExpired:
            for pid in session(process.pid):
                kill(pid)
            raise

    def build(self, *arguments: str, targets=TARGETS, **variables: str) -> tuple[int, str]:
        """Exit status and output of one run to its end."""
        process = self.start(*targets, *arguments, **variables)
        self.wait(process)
        return process.returncode, self.said().read_text()

    def complete(self, *arguments: str, targets=TARGETS, **variables: str) -> None:
        """A build that must succeed."""
        status, said = self.build(*arguments, targets=targets, **variables)
        require("profiles/default" in said, "the default profile was not loaded")
        require(status == 0, f"the build failed:\n{said[-3000:]}")

    def locked(self) -> bool:
        """Whether a killed scheduler has left its lock."""
        return any((self.path / ".snakemake/locks").glob("*"))

    def unlock(self) -> None:
        self.complete("--unlock")

    def digests(self) -> dict[str, str]:
        """Of every output that stands under its own name."""
        return {
            file.relative_to(self.results).as_posix(): hashlib.sha256(file.read_bytes()).hexdigest()
            for file in sorted(self.results.rglob("*"))
            if file.suffix in KINDS and not file.name.startswith(".")
        }

    def partials(self) -> list[str]:
        return [str(file) for file in self.results.rglob("*.partial")]


def require(condition: bool, otherwise: str) -> None:
    if not condition:
        raise AssertionError(otherwise)


def require_same(site: Site, reference: dict[str, str], whole: bool = True) -> None:
    """What is there has the reference's bytes; and, if ``whole``, all of it is there."""
    found = site.digests()
    wrong = [name for name, digest in found.items() if reference.get(name) != digest]
    require(not wrong, f"other bytes than an undisturbed build's: {wrong}")
    if whole:
        missing = set(reference) - set(found)
        require(not missing, f"missing: {missing}")
        require(not site.partials(), f"left behind: {site.partials()}")


def session(leader: int) -> list[int]:
    """Processes of a session."""
    found = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rpartition(")")[2].split()
        except OSError:  # it has ended
            continue
        if int(fields[3]) == leader and fields[0] != "Z":
            found.append(int(stat.parent.name))
    return found


def kill(pid: int) -> None:
    with suppress(ProcessLookupError):
        os.kill(pid, signal.SIGKILL)


class Fault:
    """What every fault is given: a folder, an undisturbed build's digests, time, and chance."""

    def __init__(self, folder: Path, reference: dict[str, str], arguments):
        self.folder, self.reference = folder, reference
        self.kills, self.deadline = arguments.kills, arguments.deadline
        self.chance = random.Random(arguments.seed)

    def site(self, name: str) -> Site:
        return Site(self.folder / name)


def killed(fault: Fault) -> str:
    """SIGKILL to the scheduler, to a job, or to all of them, again and again over the build.

    After each kill whatever stands under its own name is whole; a scheduler's orphans may go on.
    """
    site, builds, done = fault.site("killed"), 0, {"scheduler": 0, "job": 0, "everything": 0}
    while sum(done.values()) < fault.kills and time.monotonic() < fault.deadline:
        process = site.start(*TARGETS)
        moment = time.monotonic() + fault.chance.uniform(0.5, 7.0)
        while time.monotonic() < moment and process.poll() is None:
            time.sleep(0.02)
        if process.poll() is None:
            victim = fault.chance.choice(list(done))
            family = session(process.pid)
            jobs = [pid for pid in family if pid != process.pid]
            if victim == "job" and jobs:
                kill(fault.chance.choice(jobs))
            else:
                victim = "everything" if victim == "everything" else "scheduler"
                for pid in family if victim == "everything" else [process.pid]:
                    kill(pid)
            done[victim] += 1
        else:
            said = site.said().read_text()
            require(process.returncode == 0, f"the next run failed:\n{said[-3000:]}")
        site.wait(process)
        require_same(site, fault.reference, whole=False)
        if site.locked():
            site.unlock()
        if len(site.digests()) == len(fault.reference):  # and once more from nothing
            site.complete()
            require_same(site, fault.reference)
            shutil.rmtree(site.results)
            builds += 1
    site.complete()
    require_same(site, fault.reference)
    total = sum(done.values())
    require(total > 0, "no build was killed")
    told = ", ".join(f"{count} {victim}" for victim, count in done.items())
    return f"{total} kills ({told}), {builds + 1} builds completed"


def orphaned(fault: Fault) -> str:
    """A job must not outlive its killed scheduler, nor have the last word if it is slow."""
    site = fault.site("orphaned")
    rule = site.path / "workflow/scripts/deswelling_curves.py"
    script = rule.read_text()
    slow = "    import time\n\n    time.sleep(6.0)\n    netcdf.write("
    title = "uniform deswelling and reswelling of tubes"
    outdated = script.replace("    netcdf.write(", slow).replace(title, "outdated")
    require(outdated.count("outdated") == 1 and slow in outdated, "the script has changed")
    rule.write_text(outdated)
    process = site.start(ONE)
    log = site.results / "logs/deswelling_curves.log"
    end = time.monotonic() + JOB_SECONDS
    while not log.exists() and time.monotonic() < end:
        time.sleep(0.02)
    kill(process.pid)
    process.wait()
    rule.write_text(script)
    site.complete("--unlock", targets=(ONE,))
    site.complete(targets=(ONE,))
    while session(process.pid) and time.monotonic() < end:
        time.sleep(0.1)
    require(not session(process.pid), "the orphan does not end")
    require_same(site, fault.reference, whole=False)
    return "the outdated job ended with its scheduler"


@contextmanager
def mounted(folder: Path, size: str):
    """A small disk of its own at ``folder``; what it holds is not kept."""
    folder.mkdir(parents=True, exist_ok=True)
    options = ["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", str(folder)]
    try:
        refused = subprocess.run(options, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        raise Skipped("there is no mount") from None
    if refused.returncode:
        raise Skipped(f"mounting is not allowed: {refused.stderr.strip()}")
    try:
        yield
    finally:
        subprocess.run(["umount", "-l", str(folder)], check=True)


def disk_full(fault: Fault) -> str:
    """No space left at different stages of a dataset and of a figure."""
    site, refusals = fault.site("full"), 0
    with mounted(site.results, "2m"):
        ballast = site.results / "ballast"
        for free in (6, 40):  # kB
            fill(ballast, free)
            status, said = site.build("--keep-going", targets=(ONE, "fig14_equilibrium"))
            require(status != 0, f"{free} kB were enough")
            require_same(site, fault.reference, whole=False)
            refusals += "was not written" in said or "No space left" in said
            require(refusals > 0, f"the reason is not told:\n{said[-2000:]}")
            ballast.unlink()
            site.unlock()
        site.complete(targets=(ONE, "fig14_equilibrium"))
        require_same(site, fault.reference, whole=False)
        require(not site.partials(), f"left behind: {site.partials()}")
    return f"{refusals} clear refusals, then complete"


def fill(ballast: Path, free: int) -> None:
    """Leave ``free`` kB of the disk."""
    room = shutil.disk_usage(ballast.parent).free - 1024 * free
    ballast.write_bytes(bytes(max(room, 0)))


def read_only(fault: Fault) -> str:
    """Results that cannot be written to, by a mount: permissions do not bind root."""
    site = fault.site("read-only")
    with mounted(site.results, "16m"):
        site.complete(targets=(ONE,))
        remount(site.results, "ro")
        status, said = site.build(targets=("fig14_equilibrium",))
        require(status != 0 and "Read-only file system" in said, f"not told:\n{said[-2000:]}")
        require_same(site, fault.reference, whole=False)
        remount(site.results, "rw")
        site.unlock()
        site.complete(targets=(ONE, "fig14_equilibrium"))
        require_same(site, fault.reference, whole=False)
    return "a clear refusal, then complete"


def remount(folder: Path, mode: str) -> None:
    subprocess.run(["mount", "-o", f"remount,{mode}", str(folder)], check=True)


def two_at_once(fault: Fault) -> str:
    """The second snakemake is refused by the lock, and the first completes."""
    site = fault.site("two")
    first = site.start(*TARGETS)
    locks = site.path / ".snakemake/locks"
    end = time.monotonic() + JOB_SECONDS
    while not (locks.exists() and any(locks.iterdir())) and time.monotonic() < end:
        time.sleep(0.02)
    status, said = site.build()
    require(status != 0 and "locked" in said.lower(), f"the second was let in:\n{said[-2000:]}")
    site.wait(first)
    require(first.returncode == 0, f"the first failed:\n{site.said(1).read_text()[-2000:]}")
    require_same(site, fault.reference)
    return "the second was refused"


def clock_jump(fault: Fault) -> str:
    """Outputs from the future, sources from the past and the future, one changed in between."""
    site = fault.site("clock")
    site.complete()
    now, years = time.time(), 10 * 365 * 86400.0
    files = [*site.results.rglob("*.nc"), *site.results.rglob("*.p*")]
    files += [*site.path.glob("src/gelpump/**/*.py"), *site.path.glob("workflow/scripts/*.py")]
    for file in files:
        then = now + fault.chance.choice([-years, -1.0, 0.0, 3600.0, years])
        os.utime(file, (then, then))
    status, said = site.build()
    if status:  # Snakemake refuses sources from the future: they would be newer than any output
        require("clock skew" in said, f"the reason is not told:\n{said[-2000:]}")
        require_same(site, fault.reference, whole=False)
        for file in files:
            if file.exists():
                os.utime(file, (now, now))
        site.complete()
    require_same(site, fault.reference)
    edited = site.path / "src/gelpump/tube/uniform.py"
    original = edited.read_text()
    edited.write_text(original + "\n# edited\n")
    os.utime(edited, (now - years, now - years))  # older than what was made from it
    status, said = site.build("--dry-run", targets=(ONE,))
    seen = status == 0 and "rule deswelling_curves" in said
    edited.write_text(original)  # datasets record the digest of their code
    (site.path / ONE).unlink()
    site.complete()
    require_same(site, fault.reference)
    note = "noticed" if seen else "not noticed, as Snakemake goes by time first"
    return f"same bytes; an edit dated before its output was {note}"


def locales(fault: Fault) -> str:
    """Another language, and none, with Python's UTF-8 mode off."""
    folder = fault.folder / "locales"
    folder.mkdir()
    made = []
    for name in ("tr_TR", "de_DE"):
        command = ["localedef", "-i", name, "-f", "UTF-8", str(folder / f"{name}.UTF-8")]
        if (
            shutil.which("localedef")
            and not subprocess.run(command, capture_output=True, check=False).returncode
        ):
            made.append(f"{name}.UTF-8")
    for name in ("C", *made):
        site = fault.site(f"locale-{name}")
        site.complete(
            LC_ALL=name,
            LANG=name,
            LOCPATH=str(folder),
            PYTHONUTF8="0",
            PYTHONCOERCECLOCALE="0",
        )
        require_same(site, fault.reference)
    return f"same bytes in C{''.join(', ' + name for name in made)}"


def strange_path(fault: Fault) -> str:
    """A folder with spaces, quotes and what a shell would expand; Python stands elsewhere."""
    site = fault.site("tübe & 'bead' 水 $HOME #1")
    site.complete()
    require_same(site, fault.reference)
    return f"same bytes in {site.path.name!r}"


def no_network(fault: Fault) -> str:
    """A build in a network of its own, which has nobody else in it."""
    if not shutil.which("unshare"):
        raise Skipped("there is no unshare")
    alone = ["unshare", "--net"]
    if subprocess.run([*alone, "true"], capture_output=True, check=False).returncode:
        alone.insert(1, "--map-root-user")
        if subprocess.run([*alone, "true"], capture_output=True, check=False).returncode:
            raise Skipped("unshare --net is not allowed")
    site = fault.site("alone")
    command = [*alone, *site.command(*TARGETS, config="tiny.yaml")]
    result = subprocess.run(
        command,
        cwd=site.path,
        env=site.environment(),
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    require(result.returncode == 0, (result.stdout + result.stderr)[-3000:])
    require_same(site, fault.reference)
    return "same bytes"


FAULTS: dict[str, Callable[[Fault], str]] = {
    "orphan": orphaned,
    "disk-full": disk_full,
    "read-only": read_only,
    "two-at-once": two_at_once,
    "no-network": no_network,
    "path": strange_path,
    "clock": clock_jump,
    "locale": locales,
    "kill": killed,
}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--minutes", type=float, default=6.0)
    parser.add_argument("--record", type=Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("faults", nargs="*", metavar="FAULT", help=f"of {', '.join(FAULTS)}")
    arguments = parser.parse_args()
    unknown = set(arguments.faults) - set(FAULTS)
    if unknown:
        parser.error(f"no such fault: {', '.join(sorted(unknown))}")
    arguments.deadline = time.monotonic() + 60.0 * arguments.minutes
    broken, rows = 0, []
    with tempfile.TemporaryDirectory(prefix="faults-") as scratch:
        folder = Path(scratch)
        undisturbed = Site(folder / "undisturbed")
        started = time.monotonic()
        undisturbed.complete()
        reference = undisturbed.digests()
        print(f"undisturbed build: {len(reference)} files, {time.monotonic() - started:.0f} s")
        for name in arguments.faults or FAULTS:
            started = time.monotonic()
            try:
                if started > arguments.deadline:
                    raise Skipped("the minutes are over")
                outcome = f"held     {FAULTS[name](Fault(folder, reference, arguments))}"
            except Skipped as reason:
                outcome = f"skipped  {reason}"
            except (AssertionError, subprocess.TimeoutExpired) as problem:
                outcome = f"BROKEN   {problem}"
                broken += 1
            print(f"{name:12s} {time.monotonic() - started:4.0f} s  {outcome}", flush=True)
            did = (FAULTS[name].__doc__ or "").partition("\n\n")[0]
            rows.append([name, did, *outcome.split(maxsplit=1)])
    if arguments.record:
        held = sum(row[2] == "held" for row in rows)
        counted = f"After {held} of {len(rows)} faults the next build had the same bytes."
        heads = ["fault", "what was done", "outcome", "what was seen"]
        record(arguments.record, "faults", counted, table(heads, rows))
    return int(broken > 0)


if __name__ == "__main__":
    sys.exit(main())
