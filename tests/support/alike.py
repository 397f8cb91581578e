# SPDX-License-Identifier: GPL-3.0-or-later
"""How alike two axes of one shape are, in spacings of the sparser of the two samples."""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from . import distance, measure

Array = NDArray[np.float64]

DISC = 0.727  # radius of a sample's disc in spacings


def spacings(samples: Any, medial: Any, places: Array) -> Array:
    """(n,) spacing of samples of a surface where the places are nearest to it."""
    discs = samples.kind == int(medial.SampleKind.SURFACE)
    _, nearest = cKDTree(samples.points[discs]).query(places)
    return samples.radius[discs][nearest] / DISC


def one_way(axis: Any, other: Any, points: int = 2000, seed: int = 0) -> tuple[Array, Array]:
    """Area-weighted points of an axis and their distances to another."""
    ours, theirs = (
        measure.fan_triangles(x.vertices, x.face_offsets, x.face_vertices) for x in (axis, other)
    )
    places = distance.points_on_triangles(ours, points, np.random.default_rng(seed))
    return places, distance.to_triangles(places, theirs)


def mutual(axis: Any, other: Any, coarser: Any) -> tuple[float, float]:
    """p95 of the distances both ways, relative to `coarser(places)`, the spacing of the sparser samples there."""
    found = []
    for a, b in ((axis, other), (other, axis)):
        places, away = one_way(a, b)
        found.append(float(np.quantile(away / coarser(places), 0.95)))
    return found[0], found[1]
