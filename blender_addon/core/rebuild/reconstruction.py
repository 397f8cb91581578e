# SPDX-License-Identifier: GPL-3.0-or-later
"""The watertight surface through points: `_medial.TightCocone`, ready for Blender."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, Ints
from ..axis.solid_warnings import cocone_warnings
from ..errors import DegenerateInputError, MemoryLimitError
from ..machine import native
from ..machine.memory_limit import WHAT_IS_FREE, MemoryLimit
from ..machine.progress import Progress
from ..samples.thinning import thinned_rows
from ..shape.triangle_faces import TriangleFaces


@dataclass(frozen=True, eq=False)
class Reconstruction(TriangleFaces):
    """A closed surface of triangles whose vertices are samples, and its origin.

    Parameters
    ----------
    vertices : (v, 3) float64
        The samples that a triangle uses.
    triangles : (f, 3) int32
        Counter-clockwise as seen from outside; every edge belongs to an even number of them.
    points, duplicates : int
        The number of rows of the input, and of rows that were merged into an earlier row with the same coordinates.
    off_surface : int
        The number of distinct points that no triangle uses.
    nonmanifold_edges, nonmanifold_vertices, cavities : int
        As in `_medial.TightCocone`.
    warnings : tuple of str
        A sentence for each suspicious result.
    seconds : float
    """

    vertices: Floats
    triangles: Ints
    points: int
    duplicates: int
    off_surface: int
    nonmanifold_edges: int
    nonmanifold_vertices: int
    cavities: int
    warnings: tuple[str, ...]
    seconds: float


def reconstruct(
    points: Floats, progress: Progress | None = None, limit: MemoryLimit = WHAT_IS_FREE
) -> Reconstruction:
    """Compute the watertight surface through samples (Dey & Goswami 2003).

    Parameters
    ----------
    points : (n, 3) float64
    progress : Progress, optional
    limit : MemoryLimit
        The surface alone needs no more memory than an analysis.

    Raises
    ------
    NativeModuleError, InvalidInputError, OutOfMemoryError, Cancelled
    DegenerateInputError
        The points span no volume, or enclose nothing.
    """
    start = time.perf_counter()
    points, thinned = _within(points, limit)
    with native.own_errors() as module:
        part = None if progress is None else progress.part()
        found = module.TightCocone(points, progress=part)
    if not found.encloses:
        raise DegenerateInputError(
            "Expected points that lie densely on a closed surface, found nothing enclosed by "
            "them; use more points, or fewer that lie inside"
        )
    rows, triangles = np.unique(found.triangles, return_inverse=True)
    return Reconstruction(
        vertices=points[rows],
        triangles=triangles.reshape(-1, 3).astype(np.int32),
        points=len(points),
        duplicates=found.duplicates,
        off_surface=len(found.samples) - len(rows),
        nonmanifold_edges=found.nonmanifold_edges,
        nonmanifold_vertices=found.nonmanifold_vertices,
        cavities=found.cavities,
        warnings=(*thinned, *cocone_warnings(found, points)),
        seconds=time.perf_counter() - start,
    )


def _within(points: Floats, limit: MemoryLimit) -> tuple[Floats, tuple[str, ...]]:
    """Return the points that the limit allows, and a warning if these are fewer."""
    try:
        limit.check(len(points))
    except MemoryLimitError as error:
        rows, sentence = thinned_rows(points, limit, error)
        return points[rows], (sentence,)
    return points, ()
