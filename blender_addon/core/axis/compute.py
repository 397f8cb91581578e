"""From an object to its medial axis: what is analysed, what of it is selected, and what has to be said about it."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ..machine import native
from ..machine.cache import CACHE
from ..machine.memory_limit import WHAT_IS_FREE, MemoryLimit
from ..machine.progress import Progress
from ..settings import Sampling, Settings, Side, SidesFrom
from .sampling import Sampled, Samples, sample, sampling_warnings
from .shape import Shape
from .sides import cocone_warnings, look_inward

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .density import Density
    from .sides import Sides


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
        Rows of the two samples of each facet; where only some points of a cloud were analysed, rows of
        the whole cloud.
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
        `side`, `sides` and `sampling` are never AUTOMATIC here.
    sampled : Sampled
        What was analysed, why, and how densely it lies; what told inside from outside.
    warnings : tuple of str
        What was assumed or looks wrong, a sentence each.
    seconds : float
    """

    axis: MedialAxis
    settings: Settings
    sampled: Sampled
    warnings: tuple[str, ...]
    seconds: float

    @property
    def sides(self) -> Sides:
        return self.sampled.sides

    @property
    def density(self) -> Density:
        return self.sampled.samples.density

    @property
    def key(self) -> str:
        """Names the analysis for `refilter`."""
        return self.sampled.samples.key

    @property
    def points(self) -> int:
        """Rows that were analysed, duplicates included."""
        return len(self.sampled.samples.points)

    @property
    def duplicates(self) -> int:
        """Those of them that were merged into an earlier row with the same coordinates."""
        return self.sampled.samples.analysis.duplicates


def compute(
    points: NDArray[np.float64],
    triangles: NDArray[np.int32],
    settings: Settings,
    progress: Progress | None = None,
    normals: NDArray[np.float64] | None = None,
) -> Computation:
    """As `compute_axis`, of arrays."""
    return compute_axis(Shape(points, triangles, normals), settings, progress)


def compute_axis(
    shape: Shape,
    settings: Settings,
    progress: Progress | None = None,
    limit: MemoryLimit = WHAT_IS_FREE,
) -> Computation:
    """The medial axis of a shape, by its vertices or by samples of its faces.

    Parameters
    ----------
    shape : Shape
    settings : Settings
    progress : Progress, optional
    limit : MemoryLimit
        What the analysis may need, and what is done when it needs more.

    Raises
    ------
    NativeModuleError, InvalidInputError, DegenerateInputError, OutOfMemoryError, Cancelled
    """
    start = time.perf_counter()
    progress = progress or Progress()
    settings = settings.with_side()
    sampled = sample(shape, settings, progress, limit)
    settings = replace(settings, sides=sampled.sides.source, sampling=sampled.sampling)
    axis = _extract(sampled.samples, settings, progress.part())
    return Computation(
        axis=axis,
        settings=settings,
        sampled=sampled,
        warnings=tuple(_warnings(shape, settings, sampled, axis)),
        seconds=time.perf_counter() - start,
    )


def extract(computation: Computation, settings: Settings) -> MedialAxis:
    """The axis for other thresholds of a computation; the rest of the settings must be its own."""
    return _extract(computation.sampled.samples, settings, None)


def refilter(key: str, settings: Settings) -> MedialAxis | None:
    """The axis for other thresholds of a kept analysis; None when it is no longer kept."""
    samples = CACHE.get(key)
    return None if samples is None else _extract(samples, settings, None)


# --- warnings


def _warnings(
    shape: Shape, settings: Settings, sampled: Sampled, axis: MedialAxis
) -> Iterator[str]:
    yield from sampling_warnings(shape, sampled)
    samples, sides = sampled.samples, settings.sides
    if sides is SidesFrom.SURFACE and sampled.gaps and settings.side is not Side.BOTH:
        yield (
            f"the surface is open at {sampled.gaps:,} edges: inside was taken to be where the "
            "winding number of the open surface is above one half"
        )
    if sides is SidesFrom.NORMALS and sampled.sampling is not Sampling.VERTICES and sampled.gaps:
        yield (
            f"the surface is open at {sampled.gaps:,} edges: inside was taken to be behind its "
            "faces; do not trust the axis near the openings"
        )
    if sides is SidesFrom.TIGHT_COCONE:
        yield from cocone_warnings(samples.analysis.tight_cocone, samples.points)
    normals = samples.normals if sides is SidesFrom.NORMALS else None
    if normals is not None and look_inward(samples.points, normals):
        yield (
            "the normals point inward, so inside and outside are exchanged; turn them round, "
            "or choose Inside From Tight Cocone, and compute again"
        )
    elif axis.facets == 0:
        yield _why_empty(shape, settings, sampled, axis)


def _why_empty(shape: Shape, settings: Settings, sampled: Sampled, axis: MedialAxis) -> str:
    closed = settings.sides is SidesFrom.SURFACE and sampled.gaps == 0
    if axis.zero_area:
        return (
            f"all {axis.zero_area:,} facets that pass the conditions are points or lines, as in an "
            "exact ball; choose Sampling Surface to see where they are"
        )
    if closed and settings.side is Side.INNER and shape.volume < 0:
        return (
            "no facet lies inside because the faces point inward; recalculate their normals "
            "(Mesh > Normals > Recalculate Outside) and compute again"
        )
    if settings.sides is SidesFrom.TIGHT_COCONE and settings.side is Side.INNER:
        return (
            "no facet lies inside the surface that Tight Cocone closed; the axis of an open scan "
            "may lie beyond the opening: choose side Both, or lower theta or rho"
        )
    spacing = sampled.samples.spacing
    if closed and spacing > (thickness := 2.0 * shape.volume / shape.area):
        return (
            f"the shape is about {thickness:.2g} thick, less than its samples are apart ({spacing:.2g}); "
            "use more samples, or a smaller Spacing"
        )
    return "no facet passes the conditions; lower theta or rho, or choose another side"


# --- the compiled module


def _extract(samples: Samples, settings: Settings, progress: Any | None) -> MedialAxis:
    with native.own_errors() as module:
        mesh = samples.analysis.extract(
            settings.theta,
            settings.rho,
            getattr(module.Side, settings.side.name),
            getattr(module.Rule, settings.rule.name),
            getattr(module.Criteria, settings.criteria.name),
            limit_set=settings.limit_set,
            progress=progress,
        )
    axis = MedialAxis(**{name: getattr(mesh, name) for name in MedialAxis.__dataclass_fields__})
    if samples.rows is None:
        return axis
    return replace(axis, generators=samples.rows[axis.generators])
