"""The lines at the foot of a terminal that are drawn again and again while a build goes on."""

import time
from contextlib import contextmanager
from pathlib import Path

from rich.console import Console, Group
from rich.live import Live
from rich.progress_bar import ProgressBar
from rich.table import Table
from rich.text import Text

from snakemake_logger_plugin_gelpump.build import Build, Job, duration

REDRAWN = 4  # times a second
BAR = 16  # characters


class Screen:
    """A line for each job that runs, with where its solve is, and one on what is left."""

    def __init__(self, build: Build, stream):
        self.build = build
        self.console = Console(file=stream, highlight=False)
        self.live: Live | None = None
        self.speaking: set[str] = set()

    def begin(self, job: Job) -> None:
        """Show a job; if it writes to the terminal itself, leave that to it."""
        if job.speaks:
            self.speaking.add(job.name)
            self.close()
        elif self.live is None and not self.speaking and job.told:
            self.live = Live(
                console=self.console,
                get_renderable=self._drawn,
                refresh_per_second=REDRAWN,
                transient=True,
                redirect_stdout=False,
                redirect_stderr=False,
            )
            self.live.start()

    def end(self, job: Job | None) -> None:
        """A job is done."""
        if job and job.speaks:
            self.speaking.discard(job.name)

    def print(self, text: str) -> None:
        """A line that stays."""
        self.console.print(text, markup=False)

    @contextmanager
    def aside(self):
        """The terminal without the lines at its foot, for who writes to it directly."""
        running = self.live is not None
        self.close()
        yield
        if running and self.build.running:
            self.begin(next(iter(self.build.running.values())))

    def close(self) -> None:
        """Take the lines away."""
        if self.live:
            self.live.stop()
            self.live = None

    def _drawn(self):
        jobs = Table.grid(padding=(0, 2))
        now = time.monotonic()
        for job in list(self.build.running.values()):
            if job.told:
                jobs.add_row(Text(job.name, "bold"), duration(now - job.began), *_solve(job))
        return Group(jobs, self._foot())

    def _foot(self):
        build, bar = self.build, Table.grid(padding=(0, 1))
        remaining = build.remaining()
        waiting = build.total - build.done
        left = f"{build.done} of {build.total} done, {waiting} left"
        if build.failed:
            left += f", {build.failed} failed"
        if remaining is not None and waiting:
            left += f", about {duration(remaining)}" if remaining > 1 else ", soon ready"
        bar.add_row(_bar(build.done, max(build.total, 1), 2 * BAR), Text(left))
        return bar


def _bar(done, total, width):
    colours = {"complete_style": "cyan", "finished_style": "green"}
    return ProgressBar(total, done, width=width, **colours)


def _solve(job):
    """Where the solve is in its own time."""
    found = reached(job.log) if job.log else None
    if found is None:
        return "", ""
    return _bar(*found, BAR), Text("t = {:.3g} of {:.3g}".format(*found))


def reached(log: str | Path) -> tuple[float, float] | None:
    """How far the job with this log file is, and where it ends; None if it does not tell."""
    log = Path(log)
    try:
        text = log.with_name(f".{log.stem}.progress").read_text(encoding="ascii")
        now, end = map(float, text.split())
    except (OSError, ValueError):  # not there, or being written
        return None
    return now, end
