# SPDX-License-Identifier: GPL-3.0-or-later
"""Fewer points for less memory: fewer samples of the faces, or a selection of the points of a cloud."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints
from ..errors import InvalidInputError, MemoryLimitError
from ..machine.memory_limit import MemoryLimit, megabytes
from ..settings import COARSE, OPTIONS, AboveLimit, SamplingMode, Settings
from ..shape.shape import Shape
from .prepare import Input

# The share of the possible number that is requested, because sampling meets a number within a few percent only.
_KEPT = 0.95  # chosen: unseen
_PER_OCTAVE = 8  # the number of grids that are tried for each doubling of the resolution
_OCTAVES = 20  # the number of doublings of the resolution


def thinned_rows(points: Floats, limit: MemoryLimit, error: MemoryLimitError) -> tuple[Ints, str]:
    """Select (k,) ascending rows of a cloud that can be analysed within a limit, and report it in a sentence.

    Parameters
    ----------
    points : (n, 3) float64
    limit : MemoryLimit
    error : MemoryLimitError
        The error of an analysis of all points; it is raised again when nothing may be thinned.

    Raises
    ------
    MemoryLimitError
    InvalidInputError
        A coordinate is not finite.
    """
    rows = spread_rows(points, _most(limit, error))
    kept = f"{len(rows):,} of the {len(points):,} points, evenly spread, were kept"
    return rows, f"{_too_many(limit, error)}: {kept}"


def thinned(given: Input, limit: MemoryLimit, error: MemoryLimitError) -> Input:
    """Return an input whose samples can be analysed within a limit; raise the error again where that is not allowed."""
    shape = given.shape
    if len(shape.triangles):
        settings, sentence = fewer_samples(shape, given.settings, given.first.count, limit, error)
        return replace(given, settings=settings, thinned=sentence)
    rows, sentence = thinned_rows(shape.points, limit, error)
    return replace(given, shape=_at_rows(shape, rows), thinned=sentence)


def _at_rows(cloud: Shape, rows: Ints) -> Shape:
    normals = None if cloud.normals is None else cloud.normals[rows]
    of_caller = rows if cloud.rows is None else cloud.rows[rows]
    return replace(cloud, points=cloud.points[rows], normals=normals, rows=of_caller)


def fewer_samples(
    shape: Shape, settings: Settings, first: int, limit: MemoryLimit, error: MemoryLimitError
) -> tuple[Settings, str]:
    """Change settings so that the samples of the faces can be analysed within a limit, and report it in a sentence.

    The first pass would have `first` samples; limit and error are as for `thinned_rows`.
    """
    most, vertices = min(_most(limit, error), OPTIONS["samples"].maximum), len(shape.points)
    sentence = f"{_too_many(limit, error)}: at most {most:,} samples of the surface were taken"
    if settings.sampling is SamplingMode.VERTICES or error.points == vertices > most:
        settings, first = replace(settings, sampling=SamplingMode.SURFACE), vertices
    if first > most:
        settings = replace(settings, samples=most, spacing=0.0)
    keep_vertices = settings.keep_vertices and vertices < most
    budget = min(settings.budget, most)
    return replace(settings, budget=budget, keep_vertices=keep_vertices), sentence


def spread_rows(points: Floats, most: int) -> Ints:
    """Return ascending rows, (k,): the first point in each cell of the finest grid that leaves at most `most` points.

    Every point is nearer to one of them than the diagonal of a cell.
    """
    return np.sort(np.unique(_cells(points, most), return_index=True)[1]).astype(np.int32)


def _cells(points: Floats, most: int) -> NDArray[np.int64]:
    """Return the number of the cell that each point is in, (n,), of the finest grid with points in at most so many."""
    if not np.isfinite(points).all():
        raise InvalidInputError(
            "Expected finite coordinates, found NaN or infinity; repair or remove these points"
        )
    low, extent = points.min(axis=0), float(np.ptp(points, axis=0).max()) or 1.0

    def cells(step: int) -> NDArray[np.int64]:
        count = int(2 ** (step / _PER_OCTAVE))
        x, y, z = np.minimum((points - low) * (count / extent), count - 1).astype(np.int64).T
        return (x * count + y) * count + z

    steps = range(_PER_OCTAVE * _OCTAVES)
    return cells(bisect_right(steps, most, key=lambda step: len(np.unique(cells(step)))) - 1)


def is_coarse(shape: Shape, settings: Settings) -> bool:
    """Return whether an analysis takes few points anyway: those of the object."""
    by_faces = len(shape.triangles) > 0 and settings.sampling is not SamplingMode.VERTICES
    return not by_faces and len(shape.points) <= COARSE


def coarse(shape: Shape, settings: Settings) -> tuple[Shape, Settings]:
    """Return a shape and settings with few samples, for a quick answer; the points in each cell of a grid become one.

    Faces that were closed stay so, as a sum of faces, and decide what is inside as before.
    """
    if len(shape.triangles):
        count = min(settings.samples, COARSE)
        settings = replace(settings, sampling=SamplingMode.SURFACE, samples=count, spacing=0.0)
    settings = replace(settings, crisp=False, pairs=False)
    if len(shape.points) <= COARSE:
        return shape, settings
    _, rows, cell = np.unique(_cells(shape.points, COARSE), return_index=True, return_inverse=True)
    corners = cell[shape.triangles].astype(np.int32)
    faces = corners[(corners != np.roll(corners, 1, axis=1)).all(axis=1)]
    few = _at_rows(shape, rows.astype(np.int32))
    return replace(few, triangles=faces, sharp_edges=None), settings


def _most(limit: MemoryLimit, error: MemoryLimitError) -> int:
    """Return the number of points to keep; raise the error again where thinning is not allowed or leaves too few."""
    most = int(_KEPT * limit.points)
    if limit.above_limit is not AboveLimit.THIN or most < OPTIONS["samples"].minimum:
        raise error
    return most


def _too_many(limit: MemoryLimit, error: MemoryLimitError) -> str:
    return f"{error.points:,} points need about {megabytes(limit.needed(error.points))}, more than {limit}"
