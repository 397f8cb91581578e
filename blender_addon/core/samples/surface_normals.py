# SPDX-License-Identifier: GPL-3.0-or-later
"""Outward normals of analysed samples, their source, and the samples that lie on sharp edges."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Flags, Floats, Ints
from ..machine import native
from ..portable_angle import cosine
from ..settings import SamplingMode, SidesFrom
from ..shape.shape import Shape
from ..shape.triangles import area_vectors, unit_vectors
from ..small_matrices import dot
from .chosen import ChosenSamples


@dataclass(frozen=True, eq=False)
class SurfaceNormals:
    """Normals of the surface at each sample."""

    normals: Floats  # (n, 3) Outward; zero where there is no normal
    # (n,) The sample lies on a sharp edge, where the normal is the mean of several faces
    at_edge: Flags
    source: str  # A sentence about the source of the normals


def measured_surface(shape: Shape, chosen: ChosenSamples) -> Ints:
    """(f, 3) the triangles to measure: the faces themselves where the samples are their corners, else the boundary of
    the inner cells, whose corners are samples."""
    if _are_corners(shape, chosen):
        return shape.triangles
    return chosen.samples.analysis.solid_triangles()


def surface_normals(
    shape: Shape, chosen: ChosenSamples, surface: Ints, sharp_angle: float
) -> SurfaceNormals:
    """Determine the normals of the samples from the best available source.

    Parameters
    ----------
    shape : Shape
    chosen : ChosenSamples
    surface : (f, 3) int32
        As `measured_surface` returns it.
    sharp_angle : float
        There is an edge where faces differ by more than this from their mean; radians.
    """
    samples = chosen.samples
    given = samples.normals
    if chosen.sides.source in (SidesFrom.TIGHT_COCONE, SidesFrom.POLES):
        return _of_triangles(samples.points, surface, sharp_angle, "the reconstructed surface")
    if samples.kinds is not None and given is not None:
        kinds = native.load().SampleKind
        # An opening has no wall, so samples that close it have no normal: no ball between walls touches them.
        normals = np.where(samples.kinds[:, None] == int(kinds.OPENING), 0.0, given)
        at_edge = samples.kinds <= int(kinds.SHARP)
        return SurfaceNormals(normals, at_edge, _sentence("the samples of the faces"))
    if chosen.sides.source is SidesFrom.NORMALS and given is not None:
        nowhere = np.zeros(len(samples.points), bool)
        return SurfaceNormals(given, nowhere, _sentence("the points"))
    return _of_triangles(samples.points, surface, sharp_angle, "the faces")


def _are_corners(shape: Shape, chosen: ChosenSamples) -> bool:
    of_faces = chosen.sides.source is SidesFrom.SURFACE
    all_faces = not shape.left_out.any()
    return (
        chosen.sampling is SamplingMode.VERTICES and of_faces and all_faces and shape.rows is None
    )


def _of_triangles(
    points: Floats, triangles: Ints, sharp_angle: float, source: str
) -> SurfaceNormals:
    """Take the mean normals of the triangles at each point."""
    faces, normals = (unit_vectors(some)[0] for some in area_vectors(points, triangles))
    at_edge = np.zeros(len(points), bool)
    for corner in triangles.T:
        turned = dot(normals[corner], faces) < cosine(sharp_angle)
        at_edge[corner[turned]] = True
    return SurfaceNormals(normals, at_edge, _sentence(source))


def _sentence(source: str) -> str:
    return f"The normals are those of {source}"
