"""What a check finds wrong."""

from typing import NamedTuple


class Problem(NamedTuple):
    """One thing that is wrong: with which file or number, in one word, and how."""

    where: str
    what: str
    why: str

    def __str__(self):
        return f"{self.what}: {self.where}: {self.why}"
