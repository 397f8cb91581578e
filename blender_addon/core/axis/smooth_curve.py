# SPDX-License-Identifier: GPL-3.0-or-later
"""Wires of a curve as smooth lines between its tips and forks.

Wires follow Voronoi edges, and zigzag where the solid is thick. Each wire becomes a line in even steps without waves
that are short compared with the balls there. No place leaves its own ball, so the line stays in the solid and can be
drawn back to the wire within it: the topology is that of the wires.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ..curves.net import chains
from ..curves.smooth_line import Course, at_marks, marks_of, smooth_between
from ..small_matrices import dot
from .medial_axis import VORONOI
from .rows_of_axis import OF_VERTICES, with_rows

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from .medial_axis import MedialAxis

    Depth = Callable[[NDArray[np.float64]], NDArray[np.float64]]
    Inside = Callable[[NDArray[np.float64]], NDArray[np.bool_]]

_FARTHEST = 0.5  # a place moves by at most this share of the radius of its ball


@dataclass(frozen=True, eq=False)
class _Line:
    """A wire in even steps.

    Parameters
    ----------
    chain : list of int
        The vertices of the wire.
    at : (n,) float64
        The place of each new vertex on the chain: 2.25 is a quarter of the way from its vertex 2 to its vertex 3.
    points : (n, 3) float64
        The smooth places of the new vertices.
    closed : bool
        The wire has no ends; otherwise the new vertices at both ends are those of the wire.
    """

    chain: list[int]
    at: NDArray[np.float64]
    points: NDArray[np.float64]
    closed: bool

    @property
    def new(self) -> slice:
        """The new vertices: all but those that are vertices of the wire, and the second end of a closed line."""
        return slice(0 if self.closed else 1, -1)


def smooth_curve(axis: MedialAxis, depth: Depth, inside: Inside) -> MedialAxis:
    """Return a curve whose wires are smooth; tips, forks and facets stay.

    A wire whose line has a place outside stays as it is: it crosses a gap that is narrower than the spacing of the
    samples.

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
    if not lines:
        return axis
    table = np.concatenate([_along(axis, line) for line in lines])
    wanted = np.concatenate([line.points[line.new] for line in lines])
    places, radius = _moved(table[:, :3], table[:, 3], wanted, depth)
    counts = np.array([len(line.points[line.new]) for line in lines])
    fine = np.logical_and.reduceat(inside(places), np.cumsum(counts) - counts)
    lines = [line for line, is_fine in zip(lines, fine.tolist(), strict=True) if is_fine]
    kept = np.repeat(fine, counts)
    return _with_lines(axis, lines, places[kept], radius[kept]) if lines else axis


def _lines(axis: MedialAxis) -> list[_Line]:
    """Return the smooth lines of all wires of more than one edge that have a length."""
    held = set(axis.face_vertices.tolist())
    found, courses, sizes = [], [], []
    for chain in chains(axis.edges, len(axis.vertices), held):
        points = axis.vertices[chain] - axis.vertices[chain[0]]
        size = float(np.abs(points).max())
        if len(chain) > 2 and 0.0 < size < np.inf:
            closed = chain[0] == chain[-1] and _is_whole(axis, chain[0], held)
            # The squares of very small or large lengths are no numbers.
            courses.append(Course(points / size, axis.radius[chain] / size, closed))
            found.append(chain)
            sizes.append(size)
    smooth = smooth_between(courses)
    return [
        _line(chain, course, share, places * size + axis.vertices[chain[0]])
        for chain, course, size, (share, places) in zip(found, courses, sizes, smooth, strict=True)
    ]


def _line(
    chain: list[int], course: Course, share: NDArray[np.float64], places: NDArray[np.float64]
) -> _Line:
    marks = marks_of(course.points)
    at = np.interp(share * marks[-1], marks, np.arange(len(chain), dtype=np.float64))
    return _Line(chain, at, places, course.closed)


def _is_whole(axis: MedialAxis, vertex: int, held: set[int]) -> bool:
    """Whether a wire that ends where it starts has no fork there, and no facet."""
    return vertex not in held and np.count_nonzero(axis.edges == vertex) == 2


def _with_lines(
    axis: MedialAxis, lines: list[_Line], places: NDArray[np.float64], radius: NDArray[np.float64]
) -> MedialAxis:
    """Return a level with lines in place of their wires; places and radii are those of all new vertices."""
    keep = np.ones(len(axis.vertices), np.bool_)
    for line in lines:
        keep[line.chain[line.new]] = False
    edges, limb = _edges_of(axis, lines, keep)
    longer = _with_vertices(axis, lines, places, radius)
    return with_rows(longer, np.concatenate((keep, np.ones(len(places), np.bool_))), edges, limb)


def _with_vertices(
    axis: MedialAxis, lines: list[_Line], places: NDArray[np.float64], radius: NDArray[np.float64]
) -> MedialAxis:
    """Return a level with the new vertices of lines behind its own; no edge has them yet."""
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
    return replace(
        axis,
        vertices=np.concatenate((axis.vertices, places)),
        radius=np.concatenate((axis.radius, radius)),
        structure=structure,
        level=replace(values, **added),
    )


def _along(axis: MedialAxis, line: _Line) -> NDArray[np.float64]:
    """Return places and radii of a wire at the new vertices of its line, (n, 4)."""
    table = np.column_stack((axis.vertices[line.chain], axis.radius[line.chain]))
    return at_marks(line.at[line.new], np.arange(len(table), dtype=np.float64), table)


def _nearest(line: _Line) -> NDArray[np.int64]:
    """Return the vertex of the wire that is nearest along it to each new vertex of its line, (n,)."""
    return np.array(line.chain)[np.rint(line.at[line.new]).astype(np.int64)]


def _moved(
    places: NDArray[np.float64],
    radius: NDArray[np.float64],
    wanted: NDArray[np.float64],
    depth: Depth,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return places, moved as far towards the wanted ones as their balls allow, and the radii there.

    A radius changes by as much as the distance from the surface does, so it stays that of the ball at the faces or at
    the samples, whichever it was.
    """
    before = depth(places)
    ball = np.minimum(before, radius)
    way = (wanted - places) / np.where(ball > 0.0, ball, np.inf)[:, None]
    far = np.sqrt(dot(way, way))
    share = ball * _FARTHEST / np.maximum(far, _FARTHEST)
    moved = places + share[:, None] * way
    return moved, np.maximum(radius + depth(moved) - before, 0.0)


def _edges_of(
    axis: MedialAxis, lines: list[_Line], keep: NDArray[np.bool_]
) -> tuple[NDArray[np.int32], NDArray[np.float32]]:
    """Return the edges with the lines in place of their wires, and their values; new vertices follow the old ones."""
    assert axis.level is not None
    row_of = {(min(a, b), max(a, b)): row for row, (a, b) in enumerate(axis.edges.tolist())}
    other = keep[axis.edges].all(axis=1)
    pieces, rows, next_row = [], [], len(keep)
    for line in lines:
        way = np.array([line.chain[0], *[0] * (len(line.at) - 2), line.chain[-1]])
        count = len(way[line.new])
        way[line.new] = np.arange(next_row, next_row + count)
        if line.closed:
            way[-1] = way[0]
        next_row += count
        pieces.append(np.column_stack((way[:-1], way[1:])))
        steps = np.floor(0.5 * (line.at[:-1] + line.at[1:])).astype(np.int64)
        pairs = zip(line.chain[:-1], line.chain[1:], strict=True)
        wires = np.array([row_of[min(a, b), max(a, b)] for a, b in pairs])
        rows.append(wires[np.minimum(steps, len(wires) - 1)])
    edges = np.concatenate((axis.edges[other], *pieces)).astype(np.int32)
    limb = axis.level.limb
    return edges, np.concatenate((limb[other], limb[np.concatenate(rows)]))
