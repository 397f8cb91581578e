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
from ..settings import OPTIONS, AboveLimit, SamplingMode, Settings
from ..shape.shape import Shape
from .prepare import Input
from .sample_spacing import first_pass

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
    return rows, (
        f"{error.points:,} points need about {_needed(limit, error)}, more than {limit}: {len(rows):,} of "
        f"the {len(points):,} points, evenly spread, were kept"
    )


def thinned(given: Input, limit: MemoryLimit, error: MemoryLimitError) -> Input:
    """Return an input whose samples can be analysed within a limit; raise the error again where that is not allowed."""
    shape = given.shape
    if len(shape.triangles):
        settings, sentence = fewer_samples(shape, given.settings, given.first.count, limit, error)
        first = first_pass(shape, settings)
        return replace(given, settings=settings, first=first, thinned=sentence)
    rows, sentence = thinned_rows(shape.points, limit, error)
    normals = None if shape.normals is None else shape.normals[rows]
    of_caller = rows if shape.rows is None else shape.rows[rows]
    shape = replace(shape, points=shape.points[rows], normals=normals, rows=of_caller)
    return replace(given, shape=shape, thinned=sentence)


def fewer_samples(
    shape: Shape, settings: Settings, first: int, limit: MemoryLimit, error: MemoryLimitError
) -> tuple[Settings, str]:
    """Change settings so that the samples of the faces can be analysed within a limit, and report it in a sentence.

    Parameters
    ----------
    shape : Shape
    settings : Settings
    first : int
        The number of samples that the first pass would have.
    limit, error
        As for `thinned_rows`.
    """
    most, vertices = min(_most(limit, error), OPTIONS["samples"].maximum), len(shape.points)
    sentence = (
        f"{error.points:,} points need about {_needed(limit, error)}, more than {limit}: at most {most:,} "
        "samples of the surface were taken"
    )
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
    if not np.isfinite(points).all():
        raise InvalidInputError(
            "Expected finite coordinates, found NaN or infinity; repair or remove these points"
        )
    low, extent = points.min(axis=0), float(np.ptp(points, axis=0).max()) or 1.0

    def rows(step: int) -> NDArray[np.intp]:
        cells = int(2 ** (step / _PER_OCTAVE))
        x, y, z = np.minimum((points - low) * (cells / extent), cells - 1).astype(np.int64).T
        return np.unique((x * cells + y) * cells + z, return_index=True)[1]

    steps = range(_PER_OCTAVE * _OCTAVES)
    finest = bisect_right(steps, most, key=lambda step: len(rows(step))) - 1
    return np.sort(rows(finest)).astype(np.int32)


def _most(limit: MemoryLimit, error: MemoryLimitError) -> int:
    """Return the number of points to keep; raise the error again where thinning is not allowed or leaves too few."""
    most = int(_KEPT * limit.points)
    if limit.above_limit is not AboveLimit.THIN or most < OPTIONS["samples"].minimum:
        raise error
    return most


def _needed(limit: MemoryLimit, error: MemoryLimitError) -> str:
    return megabytes(limit.needed(error.points))
