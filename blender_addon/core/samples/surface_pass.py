# SPDX-License-Identifier: GPL-3.0-or-later
"""One pass: the faces of a shape are sampled, and the samples are analysed and judged."""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import DegenerateInputError
from ..machine import native
from ..machine.beside import Beside
from ..settings import SidesFrom
from .analysis import AnalysedSamples, Request, analyse, betti_by_faces, kept_or_made
from .buried_samples import find_bare, on_flat_faces
from .closing_samples import closed_by_samples
from .density import estimate
from .sample_spacing import first_count, mean_spacing
from .walls import Walls, find_walls

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .shape import Shape
    from .sides import Sides

# Edges are sharp from so much above the angle: tubes of twelve sides are round, and bent ones have 30.1 degrees.
_CLEARLY = 1.01
# The radius of a sample's disc, in spacings.
_DISC = 0.727


def surface_pass(
    request: Request, sides: Sides, amount: dict[str, Any], share: float, first: float = 0.0
) -> AnalysedSamples:
    """Samples of the faces and their analysis, from the cache where they are there.

    Parameters
    ----------
    request : Request
    sides : Sides
    amount : dict
        Arguments of `_medial.sample_surface` that say how many samples, and how far apart.
    share : float
        The share of the work that is left which this pass is.
    first : float
        The spacing of the first pass; 0.0 in the first pass itself.

    Raises
    ------
    InvalidInputError, OutOfMemoryError, Cancelled
    DegenerateInputError
        The surface bounds nothing, or the samples span no volume.
    """
    shape, options = request.shape, _options(request)
    parts = (shape.points, shape.triangles, shape.sharp_edges, *options.values())
    amounts = (word for pair in amount.items() for word in pair)
    return kept_or_made(
        request,
        (sides.source.name, *parts, *amounts, first),
        lambda: _sampled(request, sides, {**options, **amount}, share, first),
    )


def _options(request: Request) -> dict[str, Any]:
    """Arguments of `_medial.sample_surface` that are the same in every pass."""
    names = ("sharp_angle", "smooth", "keep_vertices", "seed")
    options = {name: getattr(request.settings, name) for name in names}
    wider = 2.0 if request.shape.shaded_smooth else _CLEARLY
    options["sharp_angle"] = min(wider * request.settings.sharp_angle, math.pi)
    return options


def _sampled(
    request: Request, sides: Sides, options: dict[str, Any], share: float, first: float
) -> AnalysedSamples:
    shape, settings = request.shape, request.settings
    if not first:
        request.limit.check(first_count(shape, settings))
    found = _sample_surface(shape, options, request.progress.part(0.2 * share))
    spacing = mean_spacing(found.area, len(found.points))
    closing = request.gaps > 0 and sides.source is SidesFrom.SURFACE
    bare = np.ones(len(found.points), bool)
    feet, outward = on_flat_faces(shape, found, spacing)
    if closing or not request.gaps:
        bare = find_bare(shape, feet, outward, spacing)
    _check_some(bare)
    points, normals, kinds = (x[bare] for x in (found.points, found.normals, found.kind))
    if closing:
        radius, progress = found.radius[bare], request.progress.part(0.1 * share)
        points, normals, kinds = closed_by_samples(
            request, points, normals, kinds, radius, progress
        )
    first = first or spacing
    chosen = bare & _are_inside_faces(found.kind)
    with Beside(partial(_of_faces, request, sides, found, chosen, feet, outward)) as beside:
        analysis = analyse(request, points, normals, sides, request.progress.part(share))
        on_edges = points[_are_on_edges(kinds, request.gaps, closing)]
        density = estimate(analysis, points, on_edges, first, settings.epsilon)
    walls, by_faces = beside.result()
    buried = int(np.count_nonzero(~bare))
    more = len(points) - int(np.count_nonzero(bare))
    return AnalysedSamples(
        points,
        kinds,
        normals,
        analysis,
        density,
        first,
        buried,
        closing=more,
        walls=walls,
        by_faces=by_faces,
        faces=np.concatenate((found.triangle[bare], np.full(more, -1, np.int32))),
    )


def _of_faces(
    request: Request,
    sides: Sides,
    found: Any,
    chosen: NDArray[np.bool_],
    feet: NDArray[np.float64],
    normals: NDArray[np.float64],
    progress: Any,
) -> tuple[Walls | None, tuple[int, int, int] | None]:
    """What the faces tell without an analysis: `AnalysedSamples.walls`, at chosen samples, and `by_faces`."""
    walls, radius = None, found.radius[chosen]
    if sides.source in (SidesFrom.SURFACE, SidesFrom.NORMALS) and request.shape.volume > 0:
        walls = find_walls(
            request.shape, feet[chosen], normals[chosen], radius / _DISC, radius**2, progress
        )
    return walls, betti_by_faces(request, sides)


def _are_inside_faces(kinds: NDArray[np.int32]) -> NDArray[np.bool_]:
    """(n,) True for samples that lie inside faces, where these are most; else for all.

    What is behind a place on an edge depends on which of its faces one asks.
    """
    kind_of = native.load().SampleKind
    inside = (kinds == int(kind_of.SURFACE)) | (kinds == int(kind_of.VERTEX))
    return inside if 2 * np.count_nonzero(inside) > len(kinds) else np.ones(len(kinds), bool)


def _sample_surface(shape: Shape, options: dict[str, Any], progress: Any) -> Any:
    with native.own_errors() as module:
        return module.sample_surface(
            shape.points,
            shape.triangles,
            sharp_edges=shape.sharp_edges,
            progress=progress,
            **options,
        )


def _check_some(bare: NDArray[np.bool_]) -> None:
    if not bare.any():
        raise DegenerateInputError(
            f"Expected a surface that bounds a solid, found that all {len(bare):,} samples of it "
            "bound nothing; remove doubled faces, or choose Sampling Vertices"
        )


def _are_on_edges(kinds: NDArray[np.int32], gaps: int, closing: bool) -> NDArray[np.bool_]:
    """(n,) True for samples of edges of the solid and of its corners, where the feature size is 0.

    Where an opening is closed its rim is an edge of the solid. Corners of a mesh that stays open are
    not counted: they may be those of an opening, where the shape may be thick.
    """
    kind_of = native.load().SampleKind
    edge = kinds == int(kind_of.SHARP)
    if closing:
        edge |= kinds == int(kind_of.BOUNDARY)
    return edge if gaps and not closing else edge | (kinds == int(kind_of.CORNER))
