# SPDX-License-Identifier: GPL-3.0-or-later
"""Ways are wires that follow each other straight through forks.

A curve has no kink at a fork where two of its wires are one line. Of the wires that meet at a fork the two that go
straightest through it are joined; a third one meets their line.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Floats
from ..small_matrices import dot, times
from .smooth_line import at_marks, marks_of

_STRAIGHT = 0.6  # cosine of a line's largest turn; three equal angles are none; chosen: axis


@dataclass(frozen=True)
class Way:
    """A way from node to node."""

    # The number of each wire, and whether the way leads along it from its end to its start
    wires: list[tuple[int, bool]]
    closed: bool  # The last wire leads back to where the first one starts, without a kink


def ways_through(
    wires: list[list[int]], points: Floats, radius: Floats, held: set[int]
) -> list[Way]:
    """Return ways that have each wire once, in the order of their first wires.

    Wires are rows of the (n, 3) points from node to node, of which only `held` ones may have exactly two wires of
    different numbers; there every way ends. The directions of wires at a fork are those after a way as long as its
    radius.
    """
    ends: dict[int, list[int]] = {}  # the start of wire 3 is end 6, its end is end 7
    for number, wire in enumerate(wires):
        ends.setdefault(wire[0], []).append(2 * number)
        ends.setdefault(wire[-1], []).append(2 * number + 1)
    partner: dict[int, int] = {}
    for node, here in ends.items():
        if node not in held and len(here) > 1:
            away = np.stack([_direction(wires, end, points, float(radius[node])) for end in here])
            partner.update(_partners(here, away))
    return _walked(len(wires), partner)


def _partners(ends: list[int], away: Floats) -> dict[int, int]:
    """Return the two ends that are one line at a node; none if there are none. A loop without a fork always is."""
    turns = times(away, away)
    first, last = divmod(int(np.argmin(turns)), len(ends))
    if first == last or (len(ends) > 2 and turns[first, last] > -_STRAIGHT):
        return {} if len(ends) > 2 else {ends[0]: ends[1], ends[1]: ends[0]}
    return {ends[first]: ends[last], ends[last]: ends[first]}


def _direction(wires: list[list[int]], end: int, points: Floats, reach: float) -> Floats:
    """Return the unit direction of a wire from one of its ends, (3,); without a length it is 0."""
    wire = wires[end // 2][:: -1 if end % 2 else 1]
    table = points[wire] - points[wire[0]]
    largest = float(np.abs(table).max())
    if not 0.0 < largest < np.inf:
        return np.zeros(3)
    table /= largest  # no square is too small or too large for a number
    marks = marks_of(table)
    found = at_marks(np.array([min(reach / largest, float(marks[-1]))]), marks, table)[0]
    length = float(np.sqrt(dot(found, found)))
    return found / length if length > 0.0 else np.zeros(3)


def _walked(count: int, partner: dict[int, int]) -> list[Way]:
    """Return the ways of a number of wires, of which some ends are joined to others."""
    used = [False] * count
    open_ends = [end for end in range(2 * count) if end not in partner]
    found = []
    for start in (*open_ends, *range(0, 2 * count, 2)):
        if used[start // 2]:
            continue
        way, end = [], start
        while not used[end // 2]:
            used[end // 2] = True
            way.append((end // 2, end % 2 == 1))
            end = partner.get(end ^ 1, start)
        found.append(Way(way, start in partner))
    return sorted(found, key=lambda way: min(number for number, _ in way.wires))
