# SPDX-License-Identifier: GPL-3.0-or-later
"""Wires of a curve as smooth lines between its tips, and through its forks.

Wires follow Voronoi edges, and zigzag where the solid is thick. Each wire becomes a line in even steps without waves
that are short compared with the balls there. Where two wires go nearly straight through a fork they are one line, and
the fork moves onto it; other wires follow with their ends. No place leaves its own ball, so lines stay in the solid
and can be drawn back to the wires within it: the topology is that of the wires.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Flags, Floats, Ints, Longs
from ..curves.net import chains
from ..curves.smooth_line import Course, at_marks, marks_of, smooth_between
from ..curves.through_forks import Way, ways_through
from ..small_matrices import dot
from .medial_axis import VORONOI, MedialAxis
from .rows_of_axis import OF_VERTICES, with_rows

Depth = Callable[[Floats], Floats]
Inside = Callable[[Floats], Flags]

FARTHEST = 0.5  # of its radius: a place stays in its ball; chosen: axis
_NEAR = 0.25  # this many steps before and after a fork there is no place; chosen: axis
_FEWEST = 3  # a wire with a vertex between its ends has this many places there, so no two lines share their ends only
_FOLLOWS = 2.0  # within this many radii of a fork a line follows it when it moves; chosen: axis


@dataclass(frozen=True, eq=False)
class _Line:
    """A wire in even steps."""

    chain: list[int]  # The vertices of the wire
    # (n,) The place of each new vertex on the chain: 2.25 is a quarter of the way from its vertex 2 to its vertex 3
    at: Floats
    # (n + 2,) The length of the wire before its start, 0, before each new vertex, and before its end
    along: Floats
    points: Floats  # (n + 2, 3) The smooth places of the start, the new vertices and the end
    # (2,) Whether the line continues beyond the start and the end, which are then at the smooth place
    through: tuple[bool, bool]

    @property
    def ends(self) -> list[int]:
        """The two vertices at the ends of the wire."""
        return [self.chain[0], self.chain[-1]]


@dataclass(frozen=True, eq=False)
class _Places:
    """Places and radii of new vertices of all lines that are drawn, and of all vertices of the axis."""

    lines: list[_Line]
    new: Floats  # (n, 4) Places and radii of the new vertices, line after line
    # (v, 4) Places and radii of the vertices of the axis, of which forks may have moved
    old: Floats


def smooth_curve(axis: MedialAxis, depth: Depth, inside: Inside) -> MedialAxis:
    """Return a curve whose wires are smooth, also where two of them go straight through a fork; tips and facets stay.

    A wire whose line has a place outside stays as it is, and so do its ends: it crosses a gap that is narrower than
    the spacing of the samples.

    Parameters
    ----------
    axis : MedialAxis
        A level in the form CURVE.
    depth : function
        It returns the distances of (n, 3) places from the surface, (n,).
    inside : function
        It returns whether (n, 3) places are in the solid, (n,).
    """
    lines = _lines(axis)
    return _with_lines(axis, _places(axis, lines, depth, inside)) if lines else axis


def _lines(axis: MedialAxis) -> list[_Line]:
    """Return the smooth lines of all wires that have a length, but for single edges by themselves."""
    held = set(axis.face_vertices.tolist())
    wires = chains(axis.edges, len(axis.vertices), held)
    ways, rows, courses, sizes = [], [], [], []
    for way in ways_through(wires, axis.vertices, axis.radius, held):
        row = _rows(way, wires)
        points = axis.vertices[row] - axis.vertices[row[0]]
        size = float(np.abs(points).max())
        if len(row) > 2 and 0.0 < size < np.inf:
            # The squares of very small or large lengths are no numbers.
            courses.append(Course(points / size, axis.radius[row] / size, way.closed))
            ways.append(way)
            rows.append(row)
            sizes.append(size)
    found = []
    smooth = smooth_between(courses)
    for way, row, course, size, (share, places) in zip(
        ways, rows, courses, sizes, smooth, strict=True
    ):
        marks = marks_of(course.points)
        table = np.column_stack((share * (marks[-1] * size), places * size + axis.vertices[row[0]]))
        found += _pieces(way, wires, row, marks * size, table)
    return found


def _rows(way: Way, wires: list[list[int]]) -> list[int]:
    """Return the vertices of a way; the last one of a closed way is its first."""
    rows = [wires[way.wires[0][0]][-1 if way.wires[0][1] else 0]]
    for number, backwards in way.wires:
        rows += wires[number][-2::-1] if backwards else wires[number][1:]
    return rows


def _pieces(
    way: Way, wires: list[list[int]], row: list[int], marks: Floats, table: Floats
) -> list[_Line]:
    """Return the lines of the wires of a way, of the lengths before its vertices and before its smooth places."""
    found, first, last = [], 0, len(way.wires) - 1
    for i, (number, _) in enumerate(way.wires):
        end = first + len(wires[number]) - 1
        through = (i > 0 or way.closed, i < last or way.closed)
        if marks[end] > marks[first]:
            chain = row[first : end + 1]
            found.append(_line(chain, marks[first : end + 1], table, through))
        first = end
    return found


def _line(chain: list[int], marks: Floats, table: Floats, through: tuple[bool, bool]) -> _Line:
    start, end = marks[[0, -1]].tolist()
    even = table[:, 0]
    apart = _NEAR * (even[1] - even[0])
    new = even[(even > start + apart) & (even < end - apart)]
    if len(chain) == 2:
        new = even[:0]
    elif len(new) < _FEWEST:
        new = np.linspace(start, end, _FEWEST + 2)[1:-1]
    at = np.interp(new, marks, np.arange(len(chain), dtype=np.float64))
    along = np.concatenate(([start], new, [end]))
    return _Line(chain, at, along - start, at_marks(along, even, table[:, 1:]), through)


def _places(axis: MedialAxis, lines: list[_Line], depth: Depth, inside: Inside) -> _Places:
    """Return the places of lines; those that leave the solid are left out, and hold their ends."""
    before = np.column_stack((axis.vertices, axis.radius))
    old = _with_forks(before, lines, depth, inside)
    drawn: dict[int, Floats] = {}
    left = [number for number, line in enumerate(lines) if len(line.at)]
    while left:
        tables = _drawn([lines[number] for number in left], old, before, depth)
        fine = _all_inside(tables, inside)
        held: set[int] = set()
        for number, table, is_fine in zip(left, tables, fine, strict=True):
            drawn[number] = table
            if not is_fine:
                del drawn[number]
                held.update(row for row in lines[number].ends if (old[row] != before[row]).any())
        rows = sorted(held)
        old[rows] = before[rows]
        left = [number for number in drawn if not held.isdisjoint(lines[number].ends)]
    kept = sorted(drawn)
    new = np.concatenate([np.zeros((0, 4)), *(drawn[number] for number in kept)])
    return _Places([lines[number] for number in kept], new, old)


def _all_inside(tables: list[Floats], inside: Inside) -> list[bool]:
    """Return for each table whether all of its places are in the solid; no table is empty."""
    firsts = np.cumsum([0, *(len(table) for table in tables[:-1])])
    found = inside(np.concatenate(tables)[:, :3])
    return np.logical_and.reduceat(found, firsts).tolist()


def _with_forks(before: Floats, lines: list[_Line], depth: Depth, inside: Inside) -> Floats:
    """Return places and radii of vertices, (v, 4), with those through which lines go on these lines."""
    wanted = {}
    for line in lines:
        for end, row in enumerate(line.ends):
            if line.through[end]:
                wanted[row] = line.points[-end]
    if not wanted:
        return before.copy()
    rows = np.array(list(wanted))
    moved = _moved(before[rows], np.stack(list(wanted.values())), depth)
    fine = inside(moved[:, :3])
    after = before.copy()
    after[rows[fine]] = moved[fine]
    return after


def _drawn(lines: list[_Line], old: Floats, before: Floats, depth: Depth) -> list[Floats]:
    """Return places and radii of the new vertices of each line, (n, 4), whose ends are where vertices are now."""
    table = np.concatenate([_along(before, line) for line in lines])
    wanted = np.concatenate([_followed(line, old) for line in lines])
    moved = _moved(table, wanted, depth)
    return np.split(moved, np.cumsum([len(line.at) for line in lines])[:-1])


def _followed(line: _Line, old: Floats) -> Floats:
    """Return the smooth places of new vertices, (n, 3), moved near the ends as far as these are from their places."""
    places = line.points[1:-1]
    length = line.along[-1]
    for end, row in enumerate(line.ends):
        shift = old[row, :3] - line.points[-end]
        reach = min(_FOLLOWS * old[row, 3], length)
        if reach > 0.0 and shift.any():
            away = length - line.along if end else line.along
            near = np.maximum(1.0 - away[1:-1] / reach, 0.0)
            places = places + (near * near * (3.0 - 2.0 * near))[:, None] * shift
    return places


def _with_lines(axis: MedialAxis, places: _Places) -> MedialAxis:
    """Return a level with lines in place of their wires."""
    lines = places.lines
    if not lines:
        return axis
    keep = np.ones(len(axis.vertices), np.bool_)
    for line in lines:
        keep[line.chain[1:-1]] = False
    edges, limb = _edges_of(axis, lines, keep)
    longer = _with_vertices(axis, places)
    added = np.ones(len(places.new), np.bool_)
    return with_rows(longer, np.concatenate((keep, added)), edges, limb)


def _with_vertices(axis: MedialAxis, places: _Places) -> MedialAxis:
    """Return a level with its vertices moved and the new ones of lines behind them; no edge has these yet."""
    lines = places.lines
    values, structure = axis.level, axis.structure
    assert values is not None
    near = np.concatenate([_nearest(line) for line in lines])
    # The second vertex of a wire is on no facet and no fork.
    like = np.concatenate([np.full(len(_nearest(line)), line.chain[1]) for line in lines])
    new: dict[str, Any] = {
        "exact": values.exact[near],
        "exact_radius": values.exact_radius[near],
        "place": np.full(len(near), VORONOI, np.int32),
        "crumb": None if values.crumb is None else values.crumb[like],
    }
    assert set(new) == set(OF_VERTICES)
    added = {n: np.concatenate((getattr(values, n), v)) for n, v in new.items() if v is not None}
    if structure is not None:
        kind = np.concatenate((structure.kind, structure.kind[like]))
        structure = replace(structure, kind=kind)
    table = np.concatenate((places.old, places.new))
    return replace(
        axis,
        vertices=table[:, :3].copy(),
        radius=table[:, 3].copy(),
        structure=structure,
        level=replace(values, **added),
    )


def _along(table: Floats, line: _Line) -> Floats:
    """Return places and radii of a wire at the new vertices of its line, (n, 4), of those of all vertices."""
    return at_marks(line.at, np.arange(len(line.chain), dtype=np.float64), table[line.chain])


def _nearest(line: _Line) -> Longs:
    """Return the vertex of the wire that is nearest along it to each new vertex of its line, (n,)."""
    return np.array(line.chain)[np.rint(line.at).astype(np.int64)]


def _moved(table: Floats, wanted: Floats, depth: Depth) -> Floats:
    """Return places and radii, (n, 4), moved as far towards the wanted places as their balls allow.

    A radius changes by as much as the distance from the surface does, so it stays that of the ball at the faces or at
    the samples, whichever it was.
    """
    places, radius = table[:, :3], table[:, 3]
    before = depth(places)
    ball = np.minimum(before, radius)
    way = (wanted - places) / np.where(ball > 0.0, ball, np.inf)[:, None]
    far = np.sqrt(dot(way, way))
    share = ball * FARTHEST / np.maximum(far, FARTHEST)
    moved = places + share[:, None] * way
    return np.column_stack((moved, np.maximum(radius + depth(moved) - before, 0.0)))


def _edges_of(
    axis: MedialAxis, lines: list[_Line], keep: Flags
) -> tuple[Ints, NDArray[np.float32]]:
    """Return the edges with the lines in place of their wires, and their values; new vertices follow the old ones."""
    assert axis.level is not None
    row_of = {(min(a, b), max(a, b)): row for row, (a, b) in enumerate(axis.edges.tolist())}
    other = keep[axis.edges].all(axis=1)
    pieces, rows, next_row = [], [], len(keep)
    for line in lines:
        count = len(line.at)
        way = np.array([line.chain[0], *range(next_row, next_row + count), line.chain[-1]])
        next_row += count
        pieces.append(np.column_stack((way[:-1], way[1:])))
        at = np.concatenate((np.zeros(1), line.at, np.full(1, len(line.chain) - 1.0)))
        steps = np.floor(0.5 * (at[:-1] + at[1:])).astype(np.int64)
        pairs = zip(line.chain[:-1], line.chain[1:], strict=True)
        wires = np.array([row_of[min(a, b), max(a, b)] for a, b in pairs])
        rows.append(wires[np.minimum(steps, len(wires) - 1)])
    edges = np.concatenate((axis.edges[other], *pieces)).astype(np.int32)
    limb = axis.level.limb
    return edges, np.concatenate((limb[other], limb[np.concatenate(rows)]))
