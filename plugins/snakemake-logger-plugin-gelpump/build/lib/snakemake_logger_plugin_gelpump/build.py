"""The state of a build, as Snakemake's records tell it, and how long the rest will take."""

import json
import re
import time
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

UNKNOWN = 2.5  # s, of a rule that was never measured
ENOUGH = 3.0  # s of finished jobs before their pace is trusted


@dataclass
class Job:
    """A job that runs; ``log`` names it, ``outputs`` say whether it makes anything."""

    rule: str
    wildcards: Mapping[str, str]
    log: str | None
    outputs: list[str]
    began: float = field(default_factory=time.monotonic)
    took: float = 0.0

    @property
    def name(self) -> str:
        """Its rule, and what tells it from others of that rule."""
        return " ".join([self.rule, *map(str, self.wildcards.values())])

    @property
    def told(self) -> bool:
        """Whether it does anything: `all` only asks for others."""
        return self.log is not None or bool(self.outputs)

    @property
    def speaks(self) -> bool:
        """Whether it writes to the terminal itself, as those do that make nothing."""
        return self.log is not None and not self.outputs


class Build:
    """What runs, what is done and what is left."""

    def __init__(self, seconds: Path):
        try:
            self.seconds = json.loads(seconds.read_text(encoding="utf-8"))
        except (OSError, ValueError):  # another project's directory: no estimates
            self.seconds = {}
        self.began = time.monotonic()
        self.cores = 1
        self.total = self.done = self.failed = 0
        self.running: dict[int, Job] = {}
        self.left: Counter[str] = Counter()  # jobs that have not begun, by rule
        self.expected = self.took = 0.0  # of the jobs that are done
        self.made_report = False

    def plan(self, stats: Mapping[str, Any]) -> None:
        """Take the numbers of jobs by rule."""
        self.left = Counter({rule: int(n) for rule, n in stats.items() if rule != "total"})
        del self.left["all"]
        self.total = self.left.total()

    def begin(self, record) -> Job:
        """A job was given to its executor."""
        log = next(iter(record.log), None)
        job = Job(record.rule_name, record.wildcards or {}, log, list(record.output))
        self.running[record.jobid] = job
        self.left[job.rule] -= 1
        return job

    def end(self, jobid: int) -> Job | None:
        """A job is done."""
        job = self.running.pop(jobid, None)
        if job and job.told:
            self.done += 1
            job.took = time.monotonic() - job.began
            self.took += job.took
            self.expected += self.usual(job.rule, job.log)
            self.made_report |= "results/report.html" in job.outputs
        return job

    def fail(self, jobid: int | None) -> None:
        """A job failed."""
        self.failed += 1
        self.running.pop(jobid, None)

    def usual(self, rule: str, log: str | None = None) -> float:
        """The seconds that a job of a rule was measured to take, by the name of its log or rule."""
        stem = Path(log).stem if log else rule
        if stem in self.seconds:
            return self.seconds[stem]
        alike = re.compile("(_.*)?_".join(map(re.escape, rule.split("_"))) + "(_.*)?")
        found = [each for name, each in self.seconds.items() if alike.fullmatch(name)]
        return sum(found) / len(found) if found else UNKNOWN

    def remaining(self) -> float | None:
        """Seconds that the build will go on for; None if nothing is known of them."""
        if not self.seconds:
            return None
        now = time.monotonic()
        pace = self.took / self.expected if self.expected > ENOUGH else 1.0
        running = [
            max(pace * self.usual(job.rule, job.log) - (now - job.began), 0.0)
            for job in list(self.running.values())
        ]
        waiting = sum(pace * self.usual(rule) * n for rule, n in list(self.left.items()) if n > 0)
        return max([(sum(running) + waiting) / max(self.cores, 1), *running])

    def line(self, job: Job) -> str:
        """One line on a job that is done."""
        total = f"/{self.total}" if self.total else ""
        return f"[{self.done:>{len(str(self.total))}}{total}] {job.name}, {duration(job.took)}"

    def summary(self) -> str:
        """One line on the whole."""
        jobs = f"{self.done} job" + ("" if self.done == 1 else "s")
        end = "; read results/report.html" if self.made_report else ""
        return f"{jobs} in {duration(time.monotonic() - self.began)}{end}"


def duration(seconds: float) -> str:
    """A time for people: 0.4 s, 12 s, 3 min 20 s, 2 h 5 min."""
    if seconds < 9.95:
        return f"{seconds:.1f} s"
    seconds = round(seconds)
    if seconds < 100:
        return f"{seconds} s"
    if seconds < 6000:
        return f"{seconds // 60} min {seconds % 60} s"
    return f"{seconds // 3600} h {seconds % 3600 // 60} min"
