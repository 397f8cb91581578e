# SPDX-License-Identifier: GPL-3.0-or-later
"""This module forecasts the memory of an analysis, and refuses an analysis that would exceed the limit."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass, field, replace

from ..errors import MemoryLimitError
from ..options import Options, choice, integer, options_of
from ..settings import MEGABYTE, AboveLimit, Side
from . import native
from .cache import CACHE
from .free_memory import free_memory

OBJECT = "object"  # the output is an object in Blender and not a file
CURVE = "curve"  # the output is the curve of a level, which is small in every format
_MOST = 1 << 28  # one analysis can have at most this many points
# A number of points that follows from the free memory keeps this many binary digits, so that small changes of the free
# memory give the same points.
_DIGITS = 4


@dataclass(frozen=True, kw_only=True)
class Use:
    """A use describes what an analysis is for; its peak of memory depends on that."""

    faces: bool = True  # The surface has faces, so that Tight Cocone is not needed
    side: Side = Side.INNER  # The side of the facets that are wanted; AUTOMATIC counts as INNER
    # A level of the hierarchy is wanted, not the facets of the published method
    levels: bool = False
    output: str = ""  # The extension of the file that is written, OBJECT in Blender, CURVE, or ""
    triangles: int = 0  # The triangles of the faces that give crisp places; 0 without crisp places


@dataclass(frozen=True)
class MemoryLimit(Options):
    """This limits the memory that an analysis may need.

    A limit of 0 means the free memory of the machine, including the analyses in the cache, which are dropped to make
    room. `use` is the further use of the analysis, or None if there is none.
    """

    memory_limit: int = integer(
        "Memory Limit",
        "Memory that an analysis may need, in MB; 0: what is free when it starts",
        default=0,
        limits=(0, 1 << 24),
        soft_limits=(0, 1 << 16),
        unit="MB",
    )
    above_limit: AboveLimit = choice(
        "If Memory Is Short",
        "What is done when an analysis would need more memory than the limit",
        default=AboveLimit.REFUSE,
        items={
            AboveLimit.REFUSE: ("Refuse", "Nothing is computed; a message says what it would need"),
            AboveLimit.THIN: (
                "Fewer Samples",
                "As many samples of the faces, or evenly spread points of a cloud, as fit",
            ),
        },
    )
    use: Use | None = field(default=None, repr=False, compare=False)

    def used(self, **parts: object) -> MemoryLimit:
        """Return the same limit with more fields of its use set; `parts` are fields of Use."""
        return replace(self, use=replace(self.use or Use(), **parts))

    def needed(self, points: int) -> int:
        """Return roughly how many bytes this many points need at the peak."""
        return memory_needed(points, self.use)

    def check(self, points: int) -> None:
        """Check that this many points can be analysed; call it before the analysis."""
        room, needed = self._room(), self.needed(points)
        if needed > room:
            raise MemoryLimitError(
                f"Expected points whose analysis fits into {self}, found {points:,}, which need about "
                f"{megabytes(needed)}; use fewer points or samples, raise Memory Limit, or set If Memory "
                "Is Short to Fewer Samples",
                points,
            )
        if not self.memory_limit:
            CACHE.give_back(CACHE.bytes + needed - room)

    @property
    def points(self) -> int:
        """Return the largest number of points that can be analysed."""
        most = max(0, bisect_right(range(_MOST), self._room(), key=self.needed) - 1)
        if self.memory_limit:
            return most
        spare = max(0, most.bit_length() - _DIGITS)
        return most >> spare << spare

    def __str__(self) -> str:
        room = megabytes(self._room())
        return f"the limit of {room}" if self.memory_limit else f"the free memory of {room}"

    def _room(self) -> int:
        """Return the bytes that an analysis may have."""
        if self.memory_limit:
            return self.memory_limit * MEGABYTE
        free = free_memory()
        return self.needed(_MOST) if free is None else free + CACHE.bytes


LIMITS = options_of(MemoryLimit)
WHAT_IS_FREE = MemoryLimit()


# These are measured bytes per point at the peak of the process (docs/lab/performance.md). Levels use the inner side.
# A solid has outer facets only at its hollows; the figures are those of a solid with many.
_OF_LEVELS = {  # {faces: {output: bytes}}
    False: {"": 3000, CURVE: 2640, OBJECT: 3570},
    True: {"": 3100, CURVE: 2900, OBJECT: 3740},
}
_OF_CRISP, _OF_TRIANGLE = 150, 410  # crisp places, per point and per triangle, in addition
_AT_PEAK = {  # {faces: {side: {output: bytes}}}
    False: {
        Side.INNER: {"": 1930, ".ply": 2100, ".ma": 2800, OBJECT: 2330},
        Side.OUTER: {"": 1940, ".ply": 2020, ".ma": 2640, OBJECT: 2650},
        Side.BOTH: {"": 2090, ".ply": 2440, ".ma": 3660, OBJECT: 3730},
    },
    True: {
        Side.INNER: {"": 2720, ".ma": 2850, OBJECT: 2250},
        Side.OUTER: {"": 2700, ".ma": 2500, OBJECT: 2470},
        Side.BOTH: {"": 2880, ".ma": 3750, OBJECT: 3500},
    },
}


def memory_needed(points: int, use: Use | None = None) -> int:
    """Return roughly how many bytes this many points need at the peak of their analysis and its use."""
    if use is not None:
        peaks = _peaks(use)
        crisp = points * _OF_CRISP + use.triangles * _OF_TRIANGLE if use.triangles else 0
        return points * peaks.get(use.output, peaks[""]) + crisp
    with native.own_errors() as module:
        return module.memory_needed(points)


def _peaks(use: Use) -> dict[str, int]:
    if use.levels:
        return _OF_LEVELS[use.faces]
    return _AT_PEAK[use.faces][Side.INNER if use.side is Side.AUTOMATIC else use.side]


def megabytes(size: int) -> str:
    """Return a size in megabytes, rounded up, such as '1,234 MB'."""
    return f"{-(-size // MEGABYTE):,} MB"
