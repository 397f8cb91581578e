# SPDX-License-Identifier: GPL-3.0-or-later
"""The sheets of a medial axis that lie between walls that face each other, as triangles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import cast

import numpy as np

from ..arrays import Flags, Floats, Ints, Longs
from ..axis.directions import corners_after, facet_areas, facet_normals
from ..axis.medial_axis import ON_CREASE, LevelValues, MedialAxis
from ..axis.polygon_triangles import triangulate_facets
from ..axis.structure import Structure
from ..axis.turning import with_facets_turned
from ..machine.native import own_errors
from ..shape.triangles import equal_pairs
from ..united import united
from .sheet_faces import TRIFLE

# Both feet of a ball are seen at 120 degrees or more from its centre: then its radius changes by at most this share of
# the way along the sheet.
_FACING = 0.5  # derived: kOpposite
_TAPER = 0.2  # the same at a sharp edge; steeper facets there are those of a rim; chosen: unseen
_NOTHING = 0.02  # of the median radius: a vertex with less is at an edge, too; chosen: unseen
_EVEN = 0.15  # of its size: radii of a facet that differ more do not tell how its sheet goes on; chosen: midsurface
_SLIVER = 0.02  # a facet with less area of a disc of its perimeter has no slope; chosen: unseen


@dataclass(frozen=True, eq=False)
class ThinSheets:
    """Triangles of the sheets that are walls; the vertices are those of the axis."""

    vertices: Floats  # (v, 3)
    radius: Floats  # (v,)
    at_edge: Flags  # (v,) On a sharp convex edge of the solid
    triangles: Ints  # (t, 3) Those of a sheet turn the same way
    part: Ints  # (t,) The sheet of each triangle, 0 to `parts` - 1
    facet: Longs  # (t,) The facet of the axis that each triangle is a part of
    # (t,) Whether the walls face each other there; no others tell where their sheet goes on
    facing: Flags
    sliver: Flags  # (t,) The facet is hardly more than a line, and tells nothing
    normals: Floats  # (t, 3) Unit normals of the facets that the triangles are of
    slopes: Floats  # (t, 3) How the radius changes along those facets
    parts: int


def thin_sheets(axis: MedialAxis, patches: Ints | None, least_width: float) -> ThinSheets:
    """Choose the sheets whose walls face each other, and which are much wider than they are thick.

    Parameters
    ----------
    axis : MedialAxis
        A clean axis of the inside with its structure.
    patches : (n, 2) int32 or None
        The patches of the samples, as of `Analysed`.
    least_width : float
        So many times as wide as its thickness a wall is at least.
    """
    structure = cast("Structure", axis.structure)
    turned = with_facets_turned(axis, structure.turned)
    polygons = turned.face_offsets, turned.face_vertices
    areas = facet_areas(turned.vertices, *polygons)
    normals = facet_normals(turned.vertices, *polygons)
    slopes = _slopes(turned, areas, normals)
    at_edge = cast("LevelValues", axis.level).place >= ON_CREASE
    at_edge |= turned.radius < _NOTHING * float(np.median(turned.radius))
    steep = np.linalg.norm(slopes, axis=1)
    to_edge = np.logical_or.reduceat(at_edge[turned.face_vertices], turned.face_offsets[:-1])
    slivers = _slivers(turned, areas)
    facing = (steep < np.where(to_edge, _TAPER, _FACING)) | (slivers & ~to_edge)
    chosen = _walls(turned, structure, areas, facing, least_width)
    part, between = structure.part, facing
    if patches is not None:
        part, own = _own_parts(turned, structure, patches)
        pairs = structure.part_patches[part]
        told = (pairs[:, 0] >= 0) & (pairs[:, 0] != pairs[:, 1])  # the patches tell rims from walls
        between, facing = np.where(told, own, facing & own), facing & own
    between |= _strips(turned, areas, chosen[part] & facing)
    kept = _without_frayed(turned, chosen[part], between)
    kept &= _in_wide_pieces(turned, kept, areas, at_edge, least_width)
    left = np.bincount(part[kept], minlength=structure.parts) > 0
    facets = np.repeat(np.arange(len(areas)), np.diff(turned.face_offsets) - 2)
    triangles = triangulate_facets(turned.vertices, *polygons)
    rows = np.flatnonzero(kept[facets])
    rows = rows[_are_single(triangles[rows])]
    facets = facets[rows]
    number = np.cumsum(left) - 1
    return ThinSheets(
        vertices=turned.vertices,
        radius=turned.radius,
        at_edge=at_edge,
        facet=facets,
        facing=(facing & _even(turned))[facets],
        sliver=slivers[facets],
        triangles=triangles[rows],
        part=number[part[facets]].astype(np.int32),
        normals=normals[facets],
        slopes=slopes[facets],
        parts=int(left.sum()),
    )


def _are_single(triangles: Ints) -> Flags:
    """(t,) the triangles that no other one lies on.

    Two facets with two edges in common, one behind the other, are cut along one diagonal: what both cut off is twice
    the same triangle, between which there is nothing.
    """
    _, of, uses = np.unique(
        np.sort(triangles, axis=1), axis=0, return_inverse=True, return_counts=True
    )
    return np.asarray(uses[of.reshape(-1)] == 1)


def _slopes(axis: MedialAxis, areas: Floats, normals: Floats) -> Floats:
    """(f, 3) the mean gradient of the radius over each facet, from the radii along its border."""
    here, there = axis.face_vertices, axis.face_vertices[corners_after(axis.face_offsets)]
    facet = np.repeat(np.arange(len(areas)), np.diff(axis.face_offsets))
    out = np.cross(axis.vertices[there] - axis.vertices[here], normals[facet])
    flux = 0.5 * (axis.radius[here] + axis.radius[there])[:, None] * out
    total = np.add.reduceat(flux, axis.face_offsets[:-1], axis=0)
    return total / np.where(areas > 0.0, areas, np.inf)[:, None]


def _even(axis: MedialAxis) -> Flags:
    """(f,) the facets whose radii hardly differ: others are at rims or where sheets meet."""
    starts, corners = axis.face_offsets[:-1], axis.face_vertices
    radii, places = axis.radius[corners], axis.vertices[corners]
    most, least = np.maximum.reduceat(radii, starts), np.minimum.reduceat(radii, starts)
    size = np.maximum.reduceat(places, starts) - np.minimum.reduceat(places, starts)
    return np.asarray(most - least <= _EVEN * np.linalg.norm(size, axis=1))


def _own_parts(axis: MedialAxis, structure: Structure, patches: Ints) -> tuple[Ints, Flags]:
    """(f,) the sheet of each facet, and (f,) whether the facet lies between the patches of that sheet.

    The structure gives small sheets to a neighbour; their facets go back to a neighbour between the same patches as
    they, where there is one.
    """

    def between(facets: Longs, parts: Ints) -> Flags:
        first, second = (patches[axis.generators[facets, end]] for end in range(2))
        low, high = (structure.part_patches[parts, end, None] for end in range(2))
        straight = (first == low).any(axis=1) & (second == high).any(axis=1)
        crossed = (first == high).any(axis=1) & (second == low).any(axis=1)
        return np.asarray(straight | crossed | (low < 0).any(axis=1))

    part = structure.part.copy()
    own = between(np.arange(len(part)), part)
    _, of_corner = _edges(axis)
    facet = np.repeat(np.arange(len(part)), np.diff(axis.face_offsets))
    beside = facet[np.column_stack(equal_pairs(of_corner))]
    beside = np.concatenate((beside, beside[:, ::-1]))
    while True:
        pairs = beside[~own[beside[:, 0]] & own[beside[:, 1]]]
        pairs = pairs[between(pairs[:, 0], part[pairs[:, 1]])]
        if not len(pairs):
            return part, own
        part[pairs[::-1, 0]] = part[pairs[::-1, 1]]
        own[pairs[:, 0]] = True


def _slivers(axis: MedialAxis, areas: Floats) -> Flags:
    """(f,) the facets that are hardly more than a line."""
    return np.asarray(4.0 * np.pi * areas < _SLIVER * _around(axis) ** 2)


def _strips(axis: MedialAxis, areas: Floats, walls: Flags) -> Flags:
    """(f,) the facets without a width between those of walls: four sheets that meet in one line are joined in pairs."""
    starts, corners = axis.face_offsets[:-1], axis.face_vertices
    sizes = np.diff(axis.face_offsets)
    radius = np.add.reduceat(axis.radius[corners], starts) / sizes
    narrow = 2.0 * areas <= TRIFLE * radius * _around(axis)
    at_wall = np.zeros(len(axis.vertices), bool)
    at_wall[corners[np.repeat(walls & ~narrow, sizes)]] = True
    return np.asarray(narrow & np.logical_and.reduceat(at_wall[corners], starts))


def _around(axis: MedialAxis) -> Floats:
    """(f,) the length of the border of each facet."""
    here, there = axis.face_vertices, axis.face_vertices[corners_after(axis.face_offsets)]
    ends = axis.vertices[there] - axis.vertices[here]
    return np.asarray(np.add.reduceat(np.linalg.norm(ends, axis=1), axis.face_offsets[:-1]))


def _walls(
    axis: MedialAxis, structure: Structure, areas: Floats, facing: Flags, least_width: float
) -> Flags:
    """(p,) which sheets are walls: most of their area lies between walls that face each other, and they are wide."""
    parts, part = structure.parts, structure.part
    whole = np.bincount(part, areas, parts)
    between = np.bincount(part, areas * facing, parts)
    width = 2.0 * whole / np.maximum(_borders(axis, part, parts), np.finfo(float).tiny)
    thickness = 2.0 * structure.part_mean_radius
    # The sheet ends half a thickness before the walls at its rims.
    return (between > 0.5 * whole) & (width + thickness >= least_width * thickness)


def _in_wide_pieces(
    axis: MedialAxis, kept: Flags, areas: Floats, at_edge: Flags, least_width: float
) -> Flags:
    """(f,) the facets of pieces of the kept ones that are as wide as walls are at least.

    Where frayed facets were taken off, crumbs of a sheet may be left beside it, within the wall at its rim.
    """
    count = len(kept)
    _, of_corner = _edges(axis)
    facet = np.repeat(np.arange(count), np.diff(axis.face_offsets))
    rows = np.flatnonzero(kept[facet])
    piece = united(count, facet[rows[np.column_stack(equal_pairs(of_corner[rows]))]])
    radii = np.add.reduceat(axis.radius[axis.face_vertices], axis.face_offsets[:-1])
    volume = np.bincount(piece, 2.0 * areas * radii / np.diff(axis.face_offsets), count)
    area = np.bincount(piece, areas, count)
    thickness = volume / np.where(area > 0.0, area, np.inf)
    border = _borders(axis, piece, count)
    width = np.where(border > 0.0, 2.0 * area / np.where(border > 0.0, border, 1.0), np.inf)
    thick = np.zeros(count, bool)
    thick[piece[facet[~at_edge[axis.face_vertices]]]] = True
    wide = thick & (area > 0.0) & (width + thickness >= least_width * thickness)
    return np.asarray(wide[piece])


def _borders(axis: MedialAxis, part: Ints | Longs, parts: int) -> Floats:
    """(p,) the length of the border of each sheet."""
    edges, of_corner = _edges(axis)
    owner = np.repeat(part, np.diff(axis.face_offsets)).astype(np.int64)
    pairs, uses = np.unique(of_corner.astype(np.int64) * parts + owner, return_counts=True)
    edge, owner = np.divmod(pairs[uses == 1], parts)
    ends = axis.vertices[edges[edge]]
    lengths = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
    return np.asarray(np.bincount(owner, lengths, parts), np.float64)


def _edges(axis: MedialAxis) -> tuple[Ints, Ints]:
    with own_errors() as module:
        return cast(
            "tuple[Ints, Ints]",
            module.polygon_edges(axis.face_offsets, axis.face_vertices, len(axis.vertices)),
        )


def _without_frayed(axis: MedialAxis, kept: Flags, facing: Flags) -> Flags:
    """(f,) the facets without those whose walls do not face each other, as far as they can be taken off from a border.

    A facet goes with an edge that no other facet has, so the topology stays.
    """
    _, of_corner = _edges(axis)
    kept = kept.copy()
    facet = np.repeat(np.arange(len(kept)), np.diff(axis.face_offsets))
    mine = kept[facet]
    count = int(of_corner.max(initial=-1)) + 1
    uses = np.bincount(of_corner[mine], minlength=count)
    # the sum of the facets at each edge: of a border, its facet
    owners = np.bincount(of_corner[mine], facet[mine], count).astype(np.int64)
    waiting = list(np.flatnonzero(uses == 1))
    while waiting:
        edge = waiting.pop()
        at = owners[edge]
        if uses[edge] != 1 or facing[at]:
            continue
        kept[at] = False
        for other in of_corner[axis.face_offsets[at] : axis.face_offsets[at + 1]]:
            uses[other] -= 1
            owners[other] -= at
            if uses[other] == 1:
                waiting.append(other)
    return kept
