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


class Watch:
    """Writes how far the solves of this process are beside their log; ``end`` removes it."""

    def __init__(self, log: str | Path):
        self.file = Path(log).with_name(f".{Path(log).stem}.progress")
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
