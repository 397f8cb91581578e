# SPDX-License-Identifier: GPL-3.0-or-later
"""Doubts in acute corners, which smaller spacings do not resolve.

Where two faces meet at an acute angle, in a groove or at a knife edge, their distance goes to nothing, so Voronoi edges
meet both faces at every spacing. Rows of samples at the same places on both faces settle that. Small spacings at a few
places make these rows uneven, and there are more doubts than before.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..machine import native
from ..small_matrices import dot
from .nearness import nearest
from .triangles import unit_normals

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .analysed import AnalysedSamples
    from .shape import Shape

# Rows of samples are at most this number of spacings from their edge, and neighbours on it are closer than the second.
_ROWS, _ALONG = 2.0, 1.5
# A place is on the plane of a face up to this share of its distance from the edge, and a sample on its edge up to this
# share of the spacing: smooth surfaces leave both.
_ON_PLANE = 0.1
# The cosine between the normals of two faces at an acute angle, at most.
_ACUTE = -0.1
_SAME = 1e-6  # two ways along a Voronoi edge are one up to this share


@dataclass(frozen=True, eq=False)
class AcuteEdges:
    """Samples on sharp edges at which two faces meet at an acute angle.

    Parameters
    ----------
    points : (n, 3) float64
    apart : (n,) float64
        The distance of neighbouring samples.
    along : (n, 3) float64
        The unit vector along the edge.
    normals : (n, 2, 3) float64
        The unit normals of the two faces.
    """

    points: NDArray[np.float64]
    apart: NDArray[np.float64]
    along: NDArray[np.float64]
    normals: NDArray[np.float64]


def in_acute_corners(
    shape: Shape,
    samples: AnalysedSamples,
    places: NDArray[np.float64],
    gaps: NDArray[np.float64],
) -> NDArray[np.bool_]:
    """(k,) mark the doubts between two faces that meet at an acute angle beside them.

    Parameters
    ----------
    shape : Shape
    samples : AnalysedSamples
        Samples of faces.
    places : (k, 3) float64
    gaps : (k,) float64
        As `_medial.MedialAnalysis.doubts` returns them: places of one Voronoi edge follow each other.
    """
    edges = acute_edges(shape, samples)
    if not len(places) or not len(edges.points):
        return np.zeros(len(places), bool)
    which = nearest(places, edges.points)
    one, other = _beside(edges, which, places), _other_ends(places, gaps)
    two = _beside(edges, which, places[other]).on_face
    reached = (
        one.above <= gaps[:, None]
    )  # a gap that leads to samples may lead to those of the other face
    two = np.where((other >= 0)[:, None], two, reached)
    return (one.on_face & two[:, ::-1]).any(axis=1)


@dataclass(frozen=True, eq=False)
class Beside:
    """Places beside acute edges: (k, 2) whether they are on each face, and (k, 2) how far from its plane."""

    on_face: NDArray[np.bool_]
    above: NDArray[np.float64]


def _beside(edges: AcuteEdges, which: NDArray[np.int64], places: NDArray[np.float64]) -> Beside:
    away, apart = places - edges.points[which], edges.apart[which]
    along = dot(away, edges.along[which])
    distance = np.linalg.norm(away - along[:, None] * edges.along[which], axis=1)
    near = (distance <= _ROWS * apart) & (np.abs(along) <= _ALONG * apart)
    above = np.abs(dot(edges.normals[which], away[:, None]))
    return Beside(near[:, None] & (above <= _ON_PLANE * distance[:, None]), above)


def _other_ends(places: NDArray[np.float64], gaps: NDArray[np.float64]) -> NDArray[np.int64]:
    """(k,) the row of the place to which each gap leads, the next one or the one before; -1 if it leads to samples."""
    other = np.full(len(places), -1)
    if len(places) < 2:
        return other
    rows, ways = np.arange(len(places)), np.linalg.norm(np.diff(places, axis=0), axis=1)
    before = np.abs(ways - gaps[1:]) <= _SAME * ways
    after = np.abs(ways - gaps[:-1]) <= _SAME * ways
    other[1:][before] = rows[:-1][before]
    other[:-1][after] = rows[1:][after]
    return other


def acute_edges(shape: Shape, samples: AnalysedSamples) -> AcuteEdges:
    """Find the samples on edges at which the normals of two faces differ by clearly more than a right angle."""
    assert samples.kinds is not None and samples.faces is not None and samples.apart is not None
    rows = np.flatnonzero(samples.kinds == int(native.load().SampleKind.SHARP))
    points, apart, faces = samples.points[rows], samples.apart[rows], samples.faces[rows]
    corners = shape.points[shape.triangles[faces]]
    sides = np.roll(corners, -1, axis=1) - corners
    along = sides / np.maximum(np.linalg.norm(sides, axis=2), np.finfo(float).tiny)[..., None]
    across = np.cross(along, points[:, None] - corners)
    away = np.linalg.norm(across, axis=2)
    side, each = away.argmin(axis=1), np.arange(len(rows))
    opposite = shape.neighbours[faces, side]
    normals = np.stack(
        [unit_normals(shape.points[shape.triangles[some]])[0] for some in (faces, opposite)], axis=1
    )
    kept = (opposite >= 0) & (away[each, side] <= _ON_PLANE * apart)
    kept &= dot(normals[:, 0], normals[:, 1]) < _ACUTE
    return AcuteEdges(points[kept], apart[kept], along[each, side][kept], normals[kept])
