"""What a jump of temperature takes a gel through: the polymer fractions at which D < 0.

A gel in equilibrium at T_before, phi_0(T_before), ends at phi_0(T_after), on the branch that it is
on: the swollen one when it is heated, the dry one when it is cooled; the other way round for a gel
that swells when it is heated. On the way every polymer
fraction between the two is met at T_after; between neighbouring roots of D(phi, T_after) = 0
(`spinodal_polymer_fractions`) the sign of D is that at their middle, and where D < 0 phases
separate (section 2.1.1).
"""

from typing import NamedTuple

import numpy as np


class Jump(NamedTuple):
    """Temperatures in K, polymer fractions, and the stretches with D < 0 as they are met.

    Each of ``unstable`` is (where it is entered, where it is left): rising when the gel shrinks.
    """

    before: float
    after: float
    start: float
    end: float
    unstable: tuple[tuple[float, float], ...]

    def __str__(self) -> str:
        """The jump in words."""
        way = (
            f"a jump from {self.before:g} K to {self.after:g} K takes phi from {self.start:.3g} "
            f"to {self.end:.3g}"
        )
        if not self.unstable:
            return f"{way}, with D > 0 all along"
        stretches = " and ".join(
            ("from the start, phi = " if first == self.start else "from phi = ")
            + f"{first:.3g} to {'the end, ' if last == self.end else ''}{last:.3g}"
            for first, last in self.unstable
        )
        return f"{way}, with D < 0 {stretches}: phases separate"


def jump(gel, T_before: float, T_after: float) -> Jump:
    """The jump of ``gel`` between two temperatures in K.

    ValueError, from the gel, where it has no stable state at one of them.
    """
    heated = T_after > T_before
    branch = "swollen" if heated == gel.collapses_when_heated else "dry"
    start, end = (gel.equilibrium_polymer_fraction(T, branch) for T in (T_before, T_after))
    low, high = min(start, end), max(start, end)
    roots = gel.spinodal_polymer_fractions(T_after)
    ends = np.array([low, *roots[(low < roots) & (roots < high)], high])
    negative = gel.diffusivity((ends[:-1] + ends[1:]) / 2, T_after) < 0
    found = [
        (float(a), float(b)) for a, b, bad in zip(ends, ends[1:], negative, strict=False) if bad
    ]
    joined: list[tuple[float, float]] = []
    for first, last in found:  # a root that D only touches parts nothing
        if joined and joined[-1][1] == first:
            first, _ = joined.pop()
        joined.append((first, last))
    if start > end:
        joined = [(last, first) for first, last in reversed(joined)]
    return Jump(float(T_before), float(T_after), start, end, tuple(joined))
