# SPDX-License-Identifier: GPL-3.0-or-later
"""The arrays of the mesh of an axis in Blender, besides those of the axis.

They are computed in the thread of a job where there is one, because Blender draws nothing while its main thread works.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...core.arrays import Ints
from ...core.axis.directions import curve_tangents, sheet_normals
from ...core.axis.medial_axis import MedialAxis
from ...core.axis.turning import with_facets_turned
from ...core.machine.native import own_errors


@dataclass(frozen=True, eq=False)
class AxisArrays:
    """The arrays of an axis.

    In `turned` the facets of a sheet turn the same way. `edges`, (e, 2) int32, are those of the facets, and not the
    edges alone; `corner_edges`, (c,) int32, has the edge after each corner. `normals` and `tangents`, (v, 3), are the
    directions of the sheet and of the curve at each vertex; None where there are no sheets, or no curves.
    """

    turned: MedialAxis
    edges: Ints
    corner_edges: Ints
    normals: NDArray[np.float32] | None
    tangents: NDArray[np.float32] | None


def arrays_of(axis: MedialAxis) -> AxisArrays:
    """The arrays of an axis; this may run in any thread."""
    structure = axis.structure
    turned = axis if structure is None else with_facets_turned(axis, structure.turned)
    edges, corner_edges = edges_of(turned.face_offsets, turned.face_vertices, len(turned.vertices))
    normals = tangents = None
    if structure is not None:
        corners = turned.face_offsets, turned.face_vertices
        normals = sheet_normals(turned.vertices, *corners, structure.part).astype(np.float32)
    if len(turned.edges):
        tangents = curve_tangents(turned.vertices, turned.edges).astype(np.float32)
    return AxisArrays(turned, edges, corner_edges, normals, tangents)


def edges_of(offsets: Ints, corners: Ints, vertices: int) -> tuple[Ints, Ints]:
    """The edges of polygons, and the edge after each corner, as in `AxisArrays`."""
    with own_errors() as module:
        return module.polygon_edges(offsets, corners, vertices)
