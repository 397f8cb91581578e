# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces with noise or steps, as of reconstructions and voxels: their vertices are moved onto smooth surfaces first."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from ..arrays import Floats
from ..machine import native
from ..settings import Prepare, Settings, SidesFrom
from ..shape.shape import Shape
from ..shape.triangles import area_vectors, unit_vectors
from ..small_matrices import dot
from .scan import SOME

SMOOTHING = 0.02  # of the whole work, as few faces are noisy; work: progress
# In spacings: with more noise faces fold over each other, and their normals say nothing.
_TOO_MUCH = 1.0  # chosen: unseen
# With fewer triangles, details of a shape that was modelled coarse look like noise.
_LEAST = 5_000
# Sides of triangles that were measured or computed are about equally long: 95 of 100 are no longer than this many times
# the median, which is at most 2.6 on scans, voxels and noisy meshes. Of designed plates with letters it is 25.
_UNEVEN = 4.0  # measured: 2.6 and 25
_OF_CUBES = (
    "the faces are sides of cubes and were left as they are; if they are the steps of a scan, which are noise, "
    "Denoise Always moves the vertices"
)
# In radians: rounding to float32 turns a side far less, and noise most sides more.
_TURNED = 0.01  # chosen: unseen
# A share of the area: the rest may be grass and the like. Surfaces that programs make of voxels have at most 0.65,
# unless the shape is a box, which has no noise.
_NEARLY_ALL = 0.98  # measured: 0.65 and 1
_TRIED = 8  # triangles for the first direction: any of them may be grass


def smooth_faces(
    shape: Shape, settings: Settings, progress: Any | None = None
) -> tuple[Shape, str]:
    """Return a shape whose vertices lie on smooth surfaces, and a sentence; the same shape and "" where no noise is.

    A shape without faces, and the samples of curves and texts, are returned as they are, and so is one whose settings
    want a wrap, which has its own faces.
    """
    if not len(shape.triangles) or not shape.of_samples or settings.sides is SidesFrom.WRAP:
        return shape, ""
    if settings.prepare is not Prepare.ALWAYS and len(shape.triangles) < _LEAST:
        return shape, ""
    if shape.triangles.min() < 0 or shape.triangles.max() >= len(shape.points):
        return shape, ""  # the sampling refuses such faces, in a sentence
    if settings.prepare is not Prepare.ALWAYS and not _are_even(shape):
        return shape, ""
    faces, normals = area_vectors(_of_size_one(shape.points), shape.triangles)
    with native.own_errors() as module:
        measure = module.surface_noise(shape.points, normals, progress=progress)
        noise = measure.noise / measure.spacing if measure.noise > 0.0 else 0.0
        enough = 0.0 if settings.prepare is Prepare.ALWAYS else SOME
        if noise <= enough:
            return shape, ""
        if settings.prepare is not Prepare.ALWAYS and are_cubes(faces):
            return shape, _OF_CUBES if settings.prepare is Prepare.AUTOMATIC else ""
        if settings.prepare is Prepare.OFF or noise > _TOO_MUCH:
            return shape, _left(noise, settings.prepare)
        points = module.smooth_vertices(shape.points, normals, measure, progress=progress)
    away = points - shape.points
    moved = float(np.median(np.sqrt(dot(away, away)))) / measure.spacing
    return replace(shape, points=points), (
        f"noise or steps of about {noise:.2g} spacings were found in the faces: their vertices were moved by "
        f"{moved:.2g} spacings in the median, so edges and details of that size are rounded, and Denoise Off takes the "
        "faces as they are"
    )


def _are_even(shape: Shape) -> bool:
    """Return whether the sides of the triangles are about equally long."""
    corners = shape.points[shape.triangles]
    ways = corners - np.roll(corners, 1, axis=1)
    middle, long = np.quantile(np.sqrt(dot(ways, ways)), (0.5, 0.95))
    return bool(long <= _UNEVEN * middle)


def _left(noise: float, prepare: Prepare) -> str:
    """The sentence about noise that stays."""
    if prepare is Prepare.OFF:
        return (
            f"noise or steps of about {noise:.2g} spacings were found in the faces and left as they are, so the axis "
            "may have flakes; Denoise Automatic moves the vertices"
        )
    return (
        f"noise or steps of about {noise:.2g} spacings were found in the faces, too much to move the vertices, so the "
        "axis may have flakes; smooth the faces first"
    )


def _of_size_one(points: Floats) -> Floats:
    """The points in a unit, a power of two, in which no coordinate is above 1."""
    return np.ldexp(points, -int(np.frexp(np.abs(points).max())[1]))


def are_cubes(faces: Floats) -> bool:
    """Return whether nearly all of the area looks along three directions that are perpendicular to each other.

    Such are meshes of cubes, as of voxel art: their steps are meant. The (f, 3) normals of faces, at least one, are as
    long as their areas are large, in a unit in which squares of areas are finite.
    """
    normals, area = unit_vectors(faces)
    tried = np.linspace(0, len(normals) - 1, _TRIED).astype(np.int64)
    most = max(_area_along(normals, area, normals[one]) for one in tried)
    return bool(most >= _NEARLY_ALL * area.sum())


def _area_along(normals: Floats, area: Floats, first: Floats) -> float:
    """The area that looks along a direction, or along that of the largest triangle across, or across both."""
    across = np.abs(dot(normals, first)) < _TURNED
    second = normals[np.where(across, area, 0.0).argmax()]
    along = np.zeros(len(area), bool)
    for direction in (first, second, np.cross(first, second)):
        along |= np.abs(dot(normals, direction)) > 1.0 - _TURNED**2 / 2.0
    return float(area[along].sum())
