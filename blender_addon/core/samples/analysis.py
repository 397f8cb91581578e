# SPDX-License-Identifier: GPL-3.0-or-later
"""The analysis of points: the one place where a `_medial.MedialAnalysis` is made."""

from __future__ import annotations

from functools import partial
from typing import Any

from ..arrays import Floats, Ints
from ..machine import native
from ..machine.beside import Beside
from ..settings import SidesFrom
from ..shape.outward_faces import check_some_left
from ..shape.solid_faces import solid_faces
from .analysed import AnalysedSamples, Request, Sides
from .density import LOOKED_AT, estimate
from .patches import patches_of
from .surface_samples import FaceSamples, apart_of, are_paired
from .walls import Places, Walls, find_walls, middles_of_faces


def used_by_sides(
    source: SidesFrom, triangles: Ints, normals: Floats | None
) -> tuple[Ints | None, Floats | None]:
    """Return triangles and normals, each None unless it decides between inside and outside."""
    return (
        triangles if source is SidesFrom.SURFACE else None,
        normals if source is SidesFrom.NORMALS else None,
    )


def analyse_vertices(request: Request, sides: Sides, share: float) -> AnalysedSamples:
    """Analyse the vertices of the shape.

    Parameters
    ----------
    request : Request
    sides : Sides
    share : float
        The share of the remaining work that the analysis is.

    Raises
    ------
    InvalidInputError, DegenerateInputError, OutOfMemoryError, Cancelled
    """
    shape = request.shape
    points, no_edges = shape.points, shape.points[:0]
    with Beside(partial(_faces_of_vertices, request, sides)) as beside:
        analysis = _analysis(request, points, shape.normals, sides, request.progress.part(share))
        epsilon = request.settings.epsilon
        density = estimate(analysis, points, no_edges, 0.0, epsilon, most=LOOKED_AT)
    walls, by_faces = beside.result()
    by_surface = sides.source is SidesFrom.SURFACE
    return AnalysedSamples(
        points=points,
        kinds=None,
        normals=shape.normals,
        analysis=analysis,
        density=density,
        walls=walls,
        rows=shape.rows,
        by_faces=by_faces,
        solid=solid_faces(shape, sides.source),
        patches=patches_of(shape, request.settings) if by_surface else None,
        offset=shape.offset,
    )


def analyse_samples(
    request: Request, sides: Sides, samples: FaceSamples, first: float, share: float
) -> AnalysedSamples:
    """Analyse samples of the faces.

    Parameters
    ----------
    request : Request
    sides : Sides
    samples : FaceSamples
    first : float
        The spacing of the first pass.
    share : float
        The share of the remaining work that the analysis is.

    Raises
    ------
    InvalidInputError, DegenerateInputError, OutOfMemoryError, Cancelled
    """
    points, normals, part = samples.points, samples.normals, request.progress.part(share)
    with Beside(partial(_faces_of_samples, request, sides, samples.places)) as beside:
        analysis = _analysis(request, points, normals, sides, part)
        density = estimate(
            analysis,
            points,
            samples.edges,
            first,
            request.settings.epsilon,
            paired=are_paired(samples.partners),
        )
    walls, by_faces = beside.result()
    return AnalysedSamples(
        points=points,
        kinds=samples.kinds,
        normals=normals,
        analysis=analysis,
        density=density,
        spacing=first,
        buried=samples.buried,
        closing=samples.closing,
        walls=walls,
        by_faces=by_faces,
        faces=samples.faces,
        solid=solid_faces(
            request.shape, sides.source, samples.faces, flat=not request.settings.smooth
        ),
        patches=patches_of(request.shape, request.settings, samples),
        apart=apart_of(samples),
        partners=samples.partners if request.settings.pairs else None,
        offset=request.shape.offset,
    )


def _analysis(
    request: Request, points: Floats, normals: Floats | None, sides: Sides, progress: Any
) -> Any:
    """Return the `_medial.MedialAnalysis` of (n, 3) points; `progress` is a `_medial.Progress`."""
    shape = request.shape
    request.limit.check(len(points))
    triangles, normals = used_by_sides(sides.source, shape.triangles, normals)
    if triangles is not None:
        check_some_left(shape)
    separate = triangles is not None and points is not shape.points
    with native.own_errors() as module:
        return module.MedialAnalysis(
            points,
            triangles,
            vertices=shape.points if separate else None,
            normals=normals,
            sides=getattr(module.SidesFrom, sides.source.name),
            bounding_sphere=request.bounding_sphere,
            progress=progress,
        )


# --- walls and the topology of the solid, which follow from the faces alone; computed in parallel with the analysis


def _faces_of_vertices(
    request: Request, sides: Sides, progress: Any
) -> tuple[Walls | None, tuple[int, int, int] | None]:
    shape, walls = request.shape, None
    if sides.source is SidesFrom.SURFACE and shape.volume > 0:
        walls = find_walls(shape, middles_of_faces(shape), progress)
    return walls, _by_faces(request, sides)


def _faces_of_samples(
    request: Request, sides: Sides, places: Places, progress: Any
) -> tuple[Walls | None, tuple[int, int, int] | None]:
    walls = None
    if sides.source in (SidesFrom.SURFACE, SidesFrom.NORMALS) and request.shape.volume > 0:
        walls = find_walls(request.shape, places, progress)
    return walls, _by_faces(request, sides)


def _by_faces(request: Request, sides: Sides) -> tuple[int, int, int] | None:
    """Return `AnalysedSamples.by_faces`."""
    if sides.source is not SidesFrom.SURFACE or request.gaps:
        return None
    return request.shape.solid_betti
