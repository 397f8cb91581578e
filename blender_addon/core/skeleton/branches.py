# SPDX-License-Identifier: GPL-3.0-or-later
"""This module measures the branches of a skeleton: lengths, radii, bends and cross-sections."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Flags, Floats, Ints, Longs
from ..curves.bridges import on_loops
from ..curves.smooth_line import (
    SmoothLine,
    at_marks,
    even_places,
    marks_of,
    mean_along,
    smooth_line,
)
from ..settings import SidesFrom
from ..small_matrices import length_of
from .compute import Skeletonization
from .sections import Faces, section
from .skeleton import Skeleton

_APART = 4  # one of this many places of the smooth line has a cross-section: every half radius
_MOST_SECTIONS = 64  # of a branch
_BENT = 0.05  # where a line bends by less than this many radians within a radius, torsion is noise; chosen: unseen
_ROOM = 4.0  # faces nearer to a branch than this many radii are cut first; work: time
MEASURES = ("curvature", "torsion", "area", "perimeter")


@dataclass(frozen=True, eq=False)
class Profile:
    """A profile has the measures at places of one branch."""

    share: Floats  # (n,) The share of the length before each place, ascending
    values: Floats  # (n, 4) MEASURES; nan where they are unknown

    def at(self, share: Floats) -> Floats:
        """Return the measures at other shares, (k, 4); they are nan before the first place and after the last."""
        if not len(self.share):
            return np.full((len(share), len(MEASURES)), np.nan)
        found = at_marks(share, self.share, self.values)
        found[(share < self.share[0]) | (share > self.share[-1])] = np.nan
        return found


@dataclass(frozen=True, eq=False)
class Branches:
    """Branches have a row each, in the order of the skeleton; nan is an unknown number.

    Bends and cross-sections are measured outside of the balls at both ends.
    """

    # (b,) Rows of the points of the skeleton
    start: Ints
    end: Ints
    # (b,) This many branches end there: 1 at a tip, 3 or more at a fork, 2 where a loop without a fork closes
    start_degree: Ints
    end_degree: Ints
    on_loop: Flags  # (b,) A way leads from the start to the end without the branch
    # (b,) The length of the smooth line and of the ways to its ends, in the unit of the input, as all lengths
    length: Floats
    distance: Floats  # (b,) The distance between both ends
    tortuosity: Floats  # (b,) The length over the distance; nan where a branch ends where it starts
    # (b,) The mean is along the length
    radius_mean: Floats
    radius_least: Floats
    radius_largest: Floats
    # (b,) In the inverse of the unit
    curvature_mean: Floats
    curvature_largest: Floats
    # (b,) The mean weighted by the square of the curvature, as torsion has no meaning where a line is straight;
    # positive where the line turns like the thread of a usual screw; nan if the line is straight everywhere
    torsion_mean: Floats
    sections: Ints  # (b,) The number of cross-sections that were measured
    area_mean: Floats  # (b,)
    area_least: Floats  # (b,)
    area_largest: Floats  # (b,)
    perimeter_mean: Floats  # (b,)
    perimeter_least: Floats  # (b,)
    perimeter_largest: Floats  # (b,)
    profiles: list[Profile]  # The measures along each branch

    @property
    def columns(self) -> dict[str, NDArray[Any]]:
        """Return all but the profiles by name, in order."""
        return {field.name: getattr(self, field.name) for field in fields(self)[:-1]}


def measure_branches(found: Skeletonization) -> Branches:
    """Measure the branches of a computed skeleton, by all points of its curve, and by its faces if these bound it."""
    by_faces = found.chosen.sides.source is SidesFrom.SURFACE and len(found.shape.triangles)
    faces = Faces(found.shape.points, found.shape.triangles) if by_faces else None
    return branches_of(found.skeleton, found.curve, faces)


def branches_of(
    skeleton: Skeleton, curve: Skeleton | None = None, faces: Faces | None = None
) -> Branches:
    """Measure the branches of a skeleton.

    The skeleton names the ends of branches; a curve has the same branches with more points, which are measured. Without
    faces cross-sections are unknown.
    """
    curve = curve or skeleton
    degree = skeleton.degree
    rows, profiles = [], []
    for name, chain in enumerate(curve.branches):
        ends = skeleton.branch_points[skeleton.branch_offsets[name : name + 2] - (0, 1)]
        closed = bool(ends[0] == ends[1] and degree[ends[0]] == 2)
        line = _line_of(curve.points[chain], curve.radius[chain], closed)
        bent, profile = _measure_bends(line, curve, name, closed, faces)
        simple = _line_figures(curve.points[chain], curve.radius[chain], line, closed)
        rows.append({"start": ends[0], "end": ends[1], **simple, **bent})
        profiles.append(profile)
    return _table(rows, profiles, degree, skeleton)


def _table(
    rows: list[dict[str, Any]], profiles: list[Profile], degree: Longs, skeleton: Skeleton
) -> Branches:
    loops = set(_on_loops(skeleton))
    types = {"sections": np.int32, "start": np.int32, "end": np.int32}
    names = [field.name for field in fields(Branches)]
    columns = {
        name: np.array([row[name] for row in rows], types.get(name, np.float64))
        for name in names
        if not name.endswith(("_degree", "on_loop", "profiles"))
    }
    return Branches(
        **columns,
        start_degree=degree[columns["start"]].astype(np.int32),
        end_degree=degree[columns["end"]].astype(np.int32),
        on_loop=np.array([name in loops for name in range(skeleton.count)], bool),
        profiles=profiles,
    )


def _on_loops(skeleton: Skeleton) -> list[int]:
    at: dict[int, list[int]] = {}
    ends = {}
    for name, chain in enumerate(skeleton.branches):
        ends[name] = int(chain[0]), int(chain[-1])
        for node in ends[name]:
            at.setdefault(node, []).append(name)
    return on_loops(ends, at)


def _line_of(points: Floats, radius: Floats, closed: bool) -> SmoothLine | None:
    """Return the smooth line of a branch outside of the balls at its ends; None if it is shorter than a mean radius.

    The rules for ends and forks have moved the points inside of these balls. The shares are those of the whole branch.
    """
    if closed:
        return smooth_line(points, radius, closed)
    marks = marks_of(points)
    length = float(marks[-1])
    if not 0.0 < length < np.inf:
        return None
    share, places = even_places(marks, points, radius)
    begin, end = (
        np.linalg.norm(places[:, :3] - points[row], axis=1) > radius[row] for row in (0, -1)
    )
    first, last = int(np.argmax(begin)), len(end) - 1 - int(np.argmax(end[::-1]))
    free = (share[last] - share[first]) * length
    if not (begin.any() and end.any() and free >= mean_along(marks, radius)) or last <= first:
        return None
    rows = slice(first, last + 1)
    line = smooth_line(places[rows, :3], places[rows, 3], closed)
    if line is None:
        return None
    return replace(line, share=share[first] + (share[last] - share[first]) * line.share)


def _line_figures(
    points: Floats, radius: Floats, line: SmoothLine | None, closed: bool
) -> dict[str, float]:
    """Return the measures that the points of a branch and its smooth line give."""
    marks = marks_of(points)
    distance = length_of(points[-1] - points[0])
    length = float(marks[-1])
    if line:
        length = line.length
        if not closed:
            length += sum(length_of(line.points[row] - points[row]) for row in (0, -1))
    return {
        "length": length,
        "distance": distance,
        "tortuosity": length / distance if distance > 0.0 else np.nan,
        "radius_mean": mean_along(marks, radius) if length > 0.0 else float(radius.mean()),
        "radius_least": float(radius.min()),
        "radius_largest": float(radius.max()),
    }


def _measure_bends(
    line: SmoothLine | None, curve: Skeleton, name: int, closed: bool, faces: Faces | None
) -> tuple[dict[str, float], Profile]:
    """Return the measures that the smooth line of a branch and the faces give, and the profile."""
    if line is None:
        blank = Profile(np.zeros(0), np.zeros((0, len(MEASURES))))
        return {**_bend_figures(np.zeros((0, 3))), **_section_figures(np.zeros((0, 2)))}, blank
    bent = np.where(line.curvature * line.radius >= _BENT, line.torsion, np.nan)
    bends = np.column_stack((line.curvature, bent, line.curvature * line.curvature))
    count = min(_MOST_SECTIONS, 1 + (len(bends) - 1) // _APART)
    rows = np.linspace(0, len(bends) - 1, count + closed).astype(np.int64)
    cuts = np.full((len(rows), 2), np.nan)
    if faces is not None:
        cuts = np.array(list(_sections(line, rows, curve, name, faces)))
    profile = Profile(line.share[rows], np.column_stack((bends[rows, :2], cuts)))
    once = slice(0, -1) if closed else slice(None)  # the last place of a closed line is its first
    return {**_bend_figures(bends[once]), **_section_figures(cuts[once])}, profile


def _bend_figures(bends: Floats) -> dict[str, float]:
    """Return the figures of rows of curvature, torsion and weight."""
    known = bends[~np.isnan(bends[:, 1])]
    weight = known[:, 2].sum()
    return {
        "curvature_mean": float(bends[:, 0].mean()) if len(bends) else np.nan,
        "curvature_largest": float(bends[:, 0].max()) if len(bends) else np.nan,
        "torsion_mean": float((known[:, 1] * known[:, 2]).sum() / weight) if weight > 0 else np.nan,
    }


def _section_figures(cuts: Floats) -> dict[str, float]:
    """Return the figures of rows of area and perimeter."""
    known = cuts[~np.isnan(cuts[:, 0])]
    found: dict[str, float] = {"sections": len(known)}
    for name, values in zip(("area", "perimeter"), known.T, strict=True):
        found[f"{name}_mean"] = float(values.mean()) if len(known) else np.nan
        found[f"{name}_least"] = float(values.min(initial=np.inf)) if len(known) else np.nan
        found[f"{name}_largest"] = float(values.max(initial=0.0)) if len(known) else np.nan
    return found


def _sections(
    line: SmoothLine, rows: Longs, curve: Skeleton, name: int, faces: Faces
) -> Iterator[tuple[float, float]]:
    """Yield the area and the perimeter of the cross-section at each of some places of a branch."""
    room = _ROOM * float(line.radius.max())
    places = line.points[rows]
    triangles = faces.near(places.min(axis=0) - room, places.max(axis=0) + room)
    others = curve.points[curve.edges[_edge_names(curve) != name]]
    for place, normal in zip(places, line.tangent[rows], strict=True):
        found = section(place, normal, faces.points, triangles, others)
        if found is None and len(triangles) < len(faces.triangles):
            triangles = (
                faces.triangles
            )  # this limb is wide: the next cross-sections need these, too
            found = section(place, normal, faces.points, triangles, others)
        yield found or (np.nan, np.nan)


def _edge_names(skeleton: Skeleton) -> Longs:
    """Return the branch of each edge, (e,)."""
    return np.repeat(np.arange(skeleton.count), np.diff(skeleton.branch_offsets) - 1)
