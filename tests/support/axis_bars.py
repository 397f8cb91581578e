# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures, with their bars, of the axis of a mesh of a shape whose axis is known exactly."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from . import crossings, measure, resampled
from .levels import facet_pieces
from .meshes import Mesh
from .shape_meshes import SHARP
from .shapes import Shape

Array = NDArray[np.float64]

SMOOTH_BARS = {"output_mean": 0.1, "output_p99": 0.5, "truth_mean": 0.1, "outside": 0}
SHARP_BARS = {"output_p99": 0.5, "truth_mean": 0.2, "outside": 0}


def bars(name: str) -> dict[str, float]:
    return SHARP_BARS if name in SHARP else SMOOTH_BARS


@dataclass(frozen=True)
class Found:
    """Distances in percent of the bounding box' diagonal, as in `measure.Errors`."""

    samples: int
    facets: int
    output_mean: float
    output_p99: float
    output_max: float
    truth_mean: float
    truth_max: float
    outside: int  # vertices of the axis outside the mesh
    components: int
    spike: float  # longest distance of a vertex to the exact axis, relative to the exact radius there or the spacing

    def missed(self, name: str) -> list[str]:
        return [key for key, bar in bars(name).items() if getattr(self, key) > bar]


def measured(shape: Shape, mesh: Mesh, frame: Array, axis: Any, samples: int) -> Found:
    """The measures of an axis of `mesh`, which is a mesh of the shape rotated by `frame`."""
    vertices = axis.vertices @ frame
    scale = 100.0 / resampled.diagonal(mesh[0] @ frame)
    triangles = measure.fan_triangles(vertices, axis.face_offsets, axis.face_vertices)
    distances = measure.errors_of(triangles, shape)
    return Found(
        samples,
        len(axis.generators),
        *(scale * x for x in distances.row()),
        outside=int(np.sum(~crossings.inside(axis.vertices, *mesh))),
        components=facet_pieces(axis),
        spike=float(off_axis(shape, vertices, resampled.spacing(shape.area, samples)).max()),
    )


def off_axis(shape: Shape, vertices: Array, spacing: float) -> Array:
    """(v,) distance to the exact axis relative to the radius there, or to the spacing where that is larger."""
    truth = np.concatenate((shape.axis_points(20_000, 1), shape.rim_points(400)))
    _, nearest = cKDTree(truth).query(vertices)
    radius = shape.axis_radius(truth)[nearest]
    return shape.axis_distance(vertices) / np.maximum(radius, spacing)
