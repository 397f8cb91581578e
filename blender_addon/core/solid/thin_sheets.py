# SPDX-License-Identifier: GPL-3.0-or-later
"""The sheets of a medial axis that lie between walls that face each other, as triangles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

import numpy as np

from ..axis.directions import facet_areas, facet_normals
from ..axis.facet_triangles import triangulate_facets
from ..axis.turning import with_facets_turned
from ..machine.native import own_errors

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..axis.medial_axis import MedialAxis
    from ..axis.structure import Structure

# Both feet of a ball are seen at 120 degrees or more from its centre: then its radius changes by at most this share of
# the way along the sheet.
_FACING = 0.5


@dataclass(frozen=True, eq=False)
class ThinSheets:
    """Triangles of the sheets that are walls; the vertices are those of the axis.

    Parameters
    ----------
    vertices : (v, 3) float64
    radius : (v,) float64
    triangles : (t, 3) int32
        Those of a sheet turn the same way.
    part : (t,) int32
        The sheet of each triangle, 0 to `parts` - 1.
    normals : (t, 3) float64
        Unit normals of the facets that the triangles are of.
    slopes : (t, 3) float64
        How the radius changes along those facets.
    parts : int
    """

    vertices: NDArray[np.float64]
    radius: NDArray[np.float64]
    triangles: NDArray[np.int32]
    part: NDArray[np.int32]
    normals: NDArray[np.float64]
    slopes: NDArray[np.float64]
    parts: int


def thin_sheets(axis: MedialAxis, least_width: float) -> ThinSheets:
    """Choose the sheets whose walls face each other, and which are much wider than they are thick.

    Parameters
    ----------
    axis : MedialAxis
        A clean axis of the inside with its structure.
    least_width : float
        So many times as wide as its thickness a wall is at least.
    """
    structure = cast("Structure", axis.structure)
    turned = with_facets_turned(axis, structure.turned)
    polygons = turned.face_offsets, turned.face_vertices
    areas = facet_areas(turned.vertices, *polygons)
    normals = facet_normals(turned.vertices, *polygons)
    slopes = _slopes(turned, areas, normals)
    facing = np.linalg.norm(slopes, axis=1) < _FACING
    chosen = _walls(turned, structure, areas, facing, least_width)
    kept = _without_frayed(turned, chosen[structure.part], facing)
    facets = np.repeat(np.arange(len(areas)), np.diff(turned.face_offsets) - 2)
    rows = np.flatnonzero(kept[facets])
    facets = facets[rows]
    number = np.cumsum(chosen) - 1
    return ThinSheets(
        vertices=turned.vertices,
        radius=turned.radius,
        triangles=triangulate_facets(turned.vertices, *polygons)[rows],
        part=number[structure.part[facets]].astype(np.int32),
        normals=normals[facets],
        slopes=slopes[facets],
        parts=int(chosen.sum()),
    )


def _slopes(
    axis: MedialAxis, areas: NDArray[np.float64], normals: NDArray[np.float64]
) -> NDArray[np.float64]:
    """(f, 3) the mean gradient of the radius over each facet, from the radii along its border."""
    corner = np.arange(len(axis.face_vertices))
    after = corner + 1
    after[axis.face_offsets[1:] - 1] = axis.face_offsets[:-1]
    here, there = axis.face_vertices, axis.face_vertices[after]
    facet = np.repeat(np.arange(len(areas)), np.diff(axis.face_offsets))
    out = np.cross(axis.vertices[there] - axis.vertices[here], normals[facet])
    flux = 0.5 * (axis.radius[here] + axis.radius[there])[:, None] * out
    total = np.add.reduceat(flux, axis.face_offsets[:-1], axis=0)
    return total / np.where(areas > 0.0, areas, np.inf)[:, None]


def _walls(
    axis: MedialAxis,
    structure: Structure,
    areas: NDArray[np.float64],
    facing: NDArray[np.bool_],
    least_width: float,
) -> NDArray[np.bool_]:
    """(p,) which sheets are walls: most of their area lies between walls that face each other, and they are wide."""
    parts, part = structure.parts, structure.part
    whole = np.bincount(part, areas, parts)
    between = np.bincount(part, areas * facing, parts)
    width = 2.0 * whole / np.maximum(_borders(axis, part, parts), np.finfo(float).tiny)
    thickness = 2.0 * structure.part_mean_radius
    # The sheet ends half a thickness before the walls at its rims.
    return (between > 0.5 * whole) & (width + thickness >= least_width * thickness)


def _borders(axis: MedialAxis, part: NDArray[np.int32], parts: int) -> NDArray[np.float64]:
    """(p,) the length of the border of each sheet."""
    edges, of_corner = _edges(axis)
    owner = np.repeat(part, np.diff(axis.face_offsets)).astype(np.int64)
    pairs, uses = np.unique(of_corner * np.int64(parts) + owner, return_counts=True)
    edge, owner = np.divmod(pairs[uses == 1], parts)
    ends = axis.vertices[edges[edge]]
    return np.bincount(owner, np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1), parts)


def _edges(axis: MedialAxis) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    with own_errors() as module:
        return cast(
            "tuple[NDArray[np.int32], NDArray[np.int32]]",
            module.polygon_edges(axis.face_offsets, axis.face_vertices, len(axis.vertices)),
        )


def _without_frayed(
    axis: MedialAxis, kept: NDArray[np.bool_], facing: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """(f,) the facets without those whose walls do not face each other, as far as they can be taken off from a border.

    A facet goes with an edge that no other facet has, so the topology stays.
    """
    _, of_corner = _edges(axis)
    kept = kept.copy()
    facet = np.repeat(np.arange(len(kept)), np.diff(axis.face_offsets))
    mine = kept[facet]
    count = int(of_corner.max(initial=-1)) + 1
    uses = np.bincount(of_corner[mine], minlength=count)
    owners = np.zeros(count, np.int64)  # the sum of the facets at each edge: of a border, its facet
    np.add.at(owners, of_corner[mine], facet[mine])
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
