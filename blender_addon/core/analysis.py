"""From points to a medial axis: `_medial.MedialAnalysis`, typed, with a memory of the last ones."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from . import native
from .cache import CACHE, key_of
from .settings import Settings, Side, SidesFrom
from .sides import Sides, cocone_warnings, look_inward, resolve_sides

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class MedialAxis:
    """The selected facets as convex planar polygons that share vertices, as `_medial.MedialMesh`.

    Parameters
    ----------
    vertices : (v, 3) float64
    radius : (v,) float64
        Of the empty ball round each vertex, in the unit of the input.
    face_offsets : (f + 1,) int32
    face_vertices : (c,) int32
    theta : (f,) float64, radians
    rho : (f,) float64
    side : (f,) int32
        0 not known, 1 inner, 2 outer, 3 crossing.
    generators : (f, 2) int32
        Rows of the two samples of each facet.
    unbounded, zero_area : int
        Selected facets that reach infinity, or that are a point or a segment; neither is here.
    """

    vertices: NDArray[np.float64]
    radius: NDArray[np.float64]
    face_offsets: NDArray[np.int32]
    face_vertices: NDArray[np.int32]
    theta: NDArray[np.float64]
    rho: NDArray[np.float64]
    side: NDArray[np.int32]
    generators: NDArray[np.int32]
    unbounded: int
    zero_area: int

    @property
    def facets(self) -> int:
        """Number of polygons."""
        return len(self.face_offsets) - 1


@dataclass(frozen=True, eq=False)
class Computation:
    """A medial axis and how it came about.

    Parameters
    ----------
    axis : MedialAxis
    settings : Settings
        `side` and `sides` are never AUTOMATIC here.
    sides : Sides
        What told inside from outside, and why.
    key : str
        Names the analysis for `refilter`.
    points, duplicates : int
        Rows of the input, and those of them merged into an earlier row with the same coordinates.
    warnings : tuple of str
        What was assumed or looks wrong, a sentence each.
    seconds : float
    """

    axis: MedialAxis
    settings: Settings
    sides: Sides
    key: str
    points: int
    duplicates: int
    warnings: tuple[str, ...]
    seconds: float


def compute(
    points: NDArray[np.float64],
    triangles: NDArray[np.int32],
    settings: Settings,
    progress: Any | None = None,
    normals: NDArray[np.float64] | None = None,
) -> Computation:
    """The medial axis of samples of a surface.

    Parameters
    ----------
    points : (n, 3) float64
    triangles : (m, 3) int32
        Outward faces of the surface as rows of `points`; (0, 3) for a cloud of points.
    settings : Settings
    progress : _medial.Progress, optional
    normals : (n, 3) float64, optional
        Outward, of any length; a zero normal says nothing.

    Raises
    ------
    NativeModuleError, InvalidInputError, DegenerateInputError, OutOfMemoryError, Cancelled
    """
    start = time.perf_counter()
    gaps = _open_edges(points, triangles)
    sides = resolve_sides(settings.sides, triangles, gaps, normals)
    side = Side.INNER if settings.side is Side.AUTOMATIC else settings.side
    chosen = replace(settings, side=side, sides=sides.source)
    shape = _Shape(
        points,
        triangles if sides.source is SidesFrom.SURFACE else None,
        normals if sides.source is SidesFrom.NORMALS else None,
    )
    key, analysis = _analyse(shape, chosen, progress)
    axis = _extract(analysis, chosen, progress)
    return Computation(
        axis=axis,
        settings=chosen,
        sides=sides,
        key=key,
        points=len(points),
        duplicates=analysis.duplicates,
        warnings=tuple(_warnings(shape, chosen, gaps, analysis, axis)),
        seconds=time.perf_counter() - start,
    )


def refilter(key: str, settings: Settings) -> MedialAxis | None:
    """The axis for other thresholds of a kept analysis; None when it is no longer kept."""
    analysis = CACHE.get(key)
    return None if analysis is None else _extract(analysis, settings, None)


@dataclass(frozen=True, eq=False)
class _Shape:
    """The samples, and what tells inside from outside: one of the others, or for Tight Cocone none."""

    points: NDArray[np.float64]
    triangles: NDArray[np.int32] | None
    normals: NDArray[np.float64] | None


# --- warnings


def _warnings(
    shape: _Shape, settings: Settings, gaps: int, analysis: Any, axis: MedialAxis
) -> Iterator[str]:
    if shape.triangles is not None and gaps and settings.side is not Side.BOTH:
        yield (
            f"the surface is open at {gaps:,} edges: inside was taken to be where the winding "
            "number of the open surface is above one half"
        )
    if settings.sides is SidesFrom.TIGHT_COCONE:
        yield from cocone_warnings(analysis.tight_cocone, shape.points)
    if shape.normals is not None and look_inward(shape.points, shape.normals):
        yield (
            "the normals point inward, so inside and outside are exchanged; turn them round, "
            "or choose Inside From Tight Cocone, and compute again"
        )
    elif axis.facets == 0:
        yield _why_empty(shape, settings, gaps)


def _why_empty(shape: _Shape, settings: Settings, gaps: int) -> str:
    closed = shape.triangles is not None and gaps == 0
    if closed and settings.side is Side.INNER and _volume(shape.points, shape.triangles) < 0:
        return (
            "no facet lies inside because the faces point inward; recalculate their normals "
            "(Mesh > Normals > Recalculate Outside) and compute again"
        )
    if settings.sides is SidesFrom.TIGHT_COCONE and settings.side is Side.INNER:
        return (
            "no facet lies inside the surface that Tight Cocone closed; the axis of an open scan "
            "may lie beyond the opening: choose side Both, or lower theta or rho"
        )
    return "no facet passes the conditions; lower theta or rho, or choose another side"


def _volume(points: NDArray[np.float64], triangles: NDArray[np.int32]) -> float:
    a, b, c = (points[triangles[:, corner]] - points[0] for corner in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6


# --- the compiled module


def _analyse(shape: _Shape, settings: Settings, progress: Any | None) -> tuple[str, Any]:
    sphere = settings.side is not Side.INNER
    key = key_of(sphere, settings.sides.name, shape.points, shape.triangles, shape.normals)
    analysis = CACHE.get(key)
    if analysis is None:
        with native.own_errors() as module:
            analysis = module.MedialAnalysis(
                shape.points,
                shape.triangles,
                normals=shape.normals,
                sides=getattr(module.SidesFrom, settings.sides.name),
                bounding_sphere=sphere,
                progress=progress,
            )
        CACHE.put(key, analysis, len(shape.points))
    return key, analysis


def _open_edges(points: NDArray[np.float64], triangles: NDArray[np.int32]) -> int:
    with native.own_errors() as module:
        return module.open_edges(points, triangles) if len(triangles) else 0


def _extract(analysis: Any, settings: Settings, progress: Any | None) -> MedialAxis:
    with native.own_errors() as module:
        mesh = analysis.extract(
            settings.theta,
            settings.rho,
            getattr(module.Side, settings.side.name),
            getattr(module.Rule, settings.rule.name),
            getattr(module.Criteria, settings.criteria.name),
            limit_set=settings.limit_set,
            progress=progress,
        )
    return MedialAxis(**{name: getattr(mesh, name) for name in MedialAxis.__dataclass_fields__})
