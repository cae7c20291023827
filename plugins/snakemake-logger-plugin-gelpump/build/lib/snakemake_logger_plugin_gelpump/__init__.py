"""What Snakemake says while it builds: what runs and what is left, or short lines in a log.

Switched on by ``logger: gelpump`` in profiles/default; ``--logger`` without a name, or another
profile, brings Snakemake's own messages back.  Errors are Snakemake's own words, whole, with the
log of the job that failed; everything that it says goes to the file in .snakemake/log as well.
"""

import os
import sys
from pathlib import Path

from snakemake_interface_logger_plugins.base import LogHandlerBase
from snakemake_interface_logger_plugins.common import LogEvent

# of what Snakemake says without an event, what says nothing of the build
NOISE = (
    "Building DAG of jobs",
    "Assuming unrestricted shared filesystem usage",
    "Using shell: ",
    "host: ",
    "Select jobs to execute",
    "Singularity containers: ignored",
    "Elapsed time: ",
)
SUCCESS_NOISE = ("Complete log(s): ",)
SILENT = {LogEvent.WORKFLOW_STARTED, LogEvent.JOB_STARTED, LogEvent.SHELLCMD}


class LogHandler(LogHandlerBase):
    """What Snakemake gives its records to, one after another, in a thread of its own."""

    writes_to_stream = True
    writes_to_file = False
    has_filter = False
    has_formatter = False
    needs_rulegraph = False

    def __post_init__(self) -> None:
        from snakemake.logging import ColorizingTextHandler

        from snakemake_logger_plugin_gelpump.build import Build

        settings = self.common_settings
        stream = sys.stdout if settings.stdout else sys.stderr
        self.plain = ColorizingTextHandler(settings.nocolor, stream)
        self.build = None if settings.dryrun else Build(Path("workflow/reference/seconds.json"))
        self.screen = None
        if self.build and stream.isatty() and not settings.quiet and watched():
            from snakemake_logger_plugin_gelpump.screen import Screen

            self.screen = Screen(self.build, stream)

    def emit(self, record) -> None:
        """Take in what a record says of the build, and say what a reader wants to know of it."""
        try:
            self._emit(record)
        except BrokenPipeError:
            raise
        except Exception:
            self.handleError(record)

    def _emit(self, record):
        event = getattr(record, "event", None)
        if self.build is None:  # a dry run is there to be read
            self._say(record)
        elif event == LogEvent.RUN_INFO:
            self.build.plan(record.stats)
        elif event == LogEvent.RESOURCES_INFO:
            self.build.cores = getattr(record, "cores", self.build.cores)
        elif event == LogEvent.JOB_INFO:
            job = self.build.begin(record)
            if self.screen:
                self.screen.begin(job)
        elif event == LogEvent.JOB_FINISHED:
            self._finished(self.build.end(record.job_id))
        elif event == LogEvent.PROGRESS:
            if record.done == record.total:
                self._line(self.build.summary())
        elif event in (LogEvent.JOB_ERROR, LogEvent.GROUP_ERROR):
            self.build.fail(getattr(record, "jobid", None))
            self._say(record)
        elif event not in SILENT and not self._noise(record, event):
            self._say(record)

    def _finished(self, job):
        if self.screen:
            self.screen.end(job)
        if job and job.told:
            self._line(self.build.line(job))

    def _noise(self, record, event):
        if event is not None or record.levelname != "INFO":
            return False
        noise = NOISE if self.build.failed else NOISE + SUCCESS_NOISE
        return str(record.msg).strip().startswith(noise)

    def _line(self, text):
        if self.screen:
            self.screen.print(text)
        else:
            self.plain.stream.write(f"{text}\n")
            self.plain.flush()

    def _say(self, record):
        """Snakemake's own words, above what is on the screen."""
        self.plain.setFormatter(self.formatter)
        if self.screen:
            with self.screen.aside():
                self.plain.emit(record)
        else:
            self.plain.emit(record)

    def close(self) -> None:
        """Leave the terminal as it was."""
        if self.screen:
            self.screen.close()
        super().close()


def watched() -> bool:
    """Whether someone looks on: no continuous integration, and a terminal that can move up."""
    return not os.environ.get("CI") and os.environ.get("TERM", "dumb") != "dumb"
