"""How far a solve is in its own time, for who waits for it.

A solver says where it is, which costs it an assignment a step; a watcher in the same process writes
that down from time to time, and what shows the progress of a build reads it from there.
"""

from pathlib import Path
from typing import NamedTuple


class Reached(NamedTuple):
    """A time that a solve has reached, and the one at which it ends."""

    t: float
    end: float


_reached: Reached | None = None


def at(t: float, end: float) -> None:
    """Say that a solve is at ``t`` of ``end``, in whatever units."""
    global _reached
    _reached = Reached(t, end)


def file_of(log: str | Path) -> Path:
    """Where the progress of the job with this log file is written down."""
    log = Path(log)
    return log.with_name(f".{log.stem}.progress")


class Watch:
    """Writes down how far the solves of this process are; ``end`` removes it."""

    def __init__(self, log: str | Path):
        self.file = file_of(log)
        self.written: Reached | None = None
        self.ended = False

    def write(self) -> None:
        """Write where the solve is, if that is not what was written last."""
        now = _reached
        if now is not None and now is not self.written and not self.ended:
            self.written = now
            self.file.write_text(f"{now.t!r} {now.end!r}\n", encoding="ascii")

    def end(self) -> None:
        """Leave nothing behind."""
        self.ended = True
        self.file.unlink(missing_ok=True)


def read(log: str | Path) -> Reached | None:
    """What was written last for the job with this log file; None if nothing was."""
    try:
        t, end = map(float, file_of(log).read_text(encoding="ascii").split())
    except (OSError, ValueError):  # not there, or being written
        return None
    return Reached(t, end)
