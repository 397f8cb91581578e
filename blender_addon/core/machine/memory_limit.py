# SPDX-License-Identifier: GPL-3.0-or-later
"""How much memory an analysis needs, how much it may have, and that it does not begin when it needs more."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass

from ..errors import MemoryLimitError
from ..settings import LIMITS, MEGABYTE, AboveLimit, check_ranges
from . import native
from .cache import CACHE
from .free_memory import free_memory

_MOST = 1 << 28  # points that one analysis can have
# Binary digits that are kept of a number of points that follows from the free memory, so that a little more or less
# free memory gives the same points.
_DIGITS = 4


@dataclass(frozen=True)
class MemoryLimit:
    """What an analysis may need.

    Parameters
    ----------
    memory_limit : int
        Megabytes. 0 means what is free on this machine; analyses that the cache keeps are dropped to make room.
    above_limit : AboveLimit

    Raises
    ------
    InvalidInputError
        A number out of its range.
    """

    memory_limit: int = LIMITS["memory_limit"].default
    above_limit: AboveLimit = LIMITS["above_limit"].default

    def __post_init__(self) -> None:
        check_ranges(self, LIMITS)

    def check(self, points: int) -> None:
        """Check that so many points can be analysed; to be called before they are.

        Raises
        ------
        MemoryLimitError
        """
        room, needed = self._room(), memory_needed(points)
        if needed > room:
            raise MemoryLimitError(
                f"Expected points whose analysis fits into {self}, found {points:,}, which need about "
                f"{megabytes(needed)}; use fewer points or samples, or change Memory Limit or Above "
                "the Limit in the preferences",
                points,
            )
        if not self.memory_limit:
            CACHE.give_back(CACHE.bytes + needed - room)

    @property
    def points(self) -> int:
        """The largest number of points that can be analysed."""
        most = max(0, bisect_right(range(_MOST), self._room(), key=memory_needed) - 1)
        if self.memory_limit:
            return most
        spare = max(0, most.bit_length() - _DIGITS)
        return most >> spare << spare

    def __str__(self) -> str:
        room = megabytes(self._room())
        return f"the limit of {room}" if self.memory_limit else f"the free memory of {room}"

    def _room(self) -> int:
        """Bytes."""
        if self.memory_limit:
            return self.memory_limit * MEGABYTE
        free = free_memory()
        return memory_needed(_MOST) if free is None else free + CACHE.bytes


WHAT_IS_FREE = MemoryLimit()


def memory_needed(points: int) -> int:
    """About how many bytes the analysis of so many points needs at most."""
    with native.own_errors() as module:
        return module.memory_needed(points)


def megabytes(size: int) -> str:
    """'1,234 MB', rounded up."""
    return f"{-(-size // MEGABYTE):,} MB"
