# SPDX-License-Identifier: GPL-3.0-or-later
"""How thick a shape is at every sample of its surface, or how wide the gaps between its walls are."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import astuple, dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ..machine import native
from ..machine.cache import CACHE, key_of
from ..machine.memory_limit import WHAT_IS_FREE, MemoryLimit
from ..machine.progress import Progress
from ..samples.choose_samples import ChosenSamples, choose_samples
from ..samples.density import percent
from ..samples.nearness import same_place
from ..samples.noise import noise_of
from ..samples.sampling_warnings import sampling_warnings
from ..samples.surface_normals import SurfaceNormals, cross, measured_surface, surface_normals, unit
from ..settings import Between, Edges, Noise, Settings, ThicknessSettings
from .thin_faces import sample_triangle_of_faces

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..samples.shape import Shape

# From so much noise on, in spacings: Clean reads too thin; nothing reads right.
_SOME, _TOO_MUCH = 0.05, 0.18
# Of coordinates that were once float32, as all of Blender are: lengths that differ by less are equal.
_ROUNDING = 4 * float(np.finfo(np.float32).eps)


@dataclass(frozen=True, eq=False)
class Measurement:
    """A measured shape; which limit makes it thin is asked later.

    Parameters
    ----------
    shape : Shape
    chosen : ChosenSamples
    settings : ThicknessSettings
        What was measured; its limit is not used here.
    triangles : (f, 3) int32
        The measured surface, rows of the samples.
    lengths : (n,) float64
        At each sample; infinite where there is no wall.
    measured : (n,) bool
        At the sample itself; else filled from the nearest, or infinite.
    at_edge : (n,) bool
        On a sharp edge.
    normals : str
        Where the normals come from, a sentence.
    noise : float
        Standard deviation of the samples in spacings, 0 to 0.25.
    warnings : tuple of str
    seconds : float
    key : str
        Names the measurement for `kept_measurement`.
    """

    shape: Shape
    chosen: ChosenSamples
    settings: ThicknessSettings
    triangles: NDArray[np.int32]
    lengths: NDArray[np.float64]
    measured: NDArray[np.bool_]
    at_edge: NDArray[np.bool_]
    normals: str
    noise: float
    warnings: tuple[str, ...]
    seconds: float
    key: str = ""

    @property
    def points(self) -> NDArray[np.float64]:
        """(n, 3) the samples."""
        return self.chosen.samples.points

    @cached_property
    def of_triangles(self) -> NDArray[np.float64]:
        """(f,) the median of the corners, so that no single sample decides; and no less than the others where one or
        two of them are on an edge, which belongs to two sides."""
        values, on_edge = self.lengths[self.triangles].T, self.at_edge[self.triangles].T
        a, b, c = values
        median = np.maximum(np.minimum(a, b), np.minimum(np.maximum(a, b), c))
        mixed = on_edge.any(axis=0)
        others = np.where(on_edge[:, mixed], -np.inf, values[:, mixed]).max(axis=0)
        median[mixed] = np.maximum(median[mixed], others)
        if self.settings.between is Between.GAP:  # the corner of a solid is in front of nothing
            median[on_edge.all(axis=0)] = np.inf
        return median

    @cached_property
    def areas(self) -> NDArray[np.float64]:
        """(f,) of the triangles."""
        a, b, c = (self.points[self.triangles[:, corner]] for corner in range(3))
        return np.linalg.norm(cross(b - a, c - a), axis=1) / 2

    @cached_property
    def minimum(self) -> float:
        """The least of all triangles; infinite where there is nothing."""
        return float(self.of_triangles.min(initial=np.inf))

    @cached_property
    def slack(self) -> float:
        """How much a length has to lie below a limit to be shorter: the rounding of the coordinates."""
        return _ROUNDING * float(np.abs(self.points).max(initial=0.0))

    @cached_property
    def of_vertices(self) -> NDArray[np.float64]:
        """(v,) at each vertex of the shape: that of the nearest sample."""
        if len(self.points) == len(self.shape.points) and self.chosen.samples.kinds is None:
            return self.lengths
        with native.own_errors() as module:
            return self.lengths[module.nearest(self.points, self.shape.points)]

    @cached_property
    def triangle_of_faces(self) -> NDArray[np.int32]:
        """(m,) the triangle that speaks for each face of the shape, the thinnest in it; -1: none."""
        return sample_triangle_of_faces(self)

    @property
    def bytes(self) -> int:
        arrays: tuple[NDArray, ...] = (
            self.triangles,
            self.lengths,
            self.measured,
            self.points,
            self.shape.points,
        )
        return sum(x.nbytes for x in arrays) + 40 * len(self.triangles)


def measure_thickness(
    shape: Shape,
    settings: Settings,
    wanted: ThicknessSettings,
    progress: Progress | None = None,
    limit: MemoryLimit = WHAT_IS_FREE,
) -> Measurement:
    """Measure a shape by its axis, which is computed where it is not kept.

    Parameters
    ----------
    shape : Shape
    settings : Settings
        How it is sampled, and what tells inside from outside; the side follows from `wanted`.
    wanted : ThicknessSettings
    progress : Progress, optional
    limit : MemoryLimit

    Raises
    ------
    NativeModuleError, InvalidInputError, DegenerateInputError, OutOfMemoryError, Cancelled
    """
    start = time.perf_counter()
    progress = progress or Progress()
    settings = replace(settings, side=wanted.side)
    chosen = choose_samples(shape, settings, progress, limit)
    surface = measured_surface(shape, chosen)
    known = surface_normals(shape, chosen, surface, settings.sharp_angle)
    lengths, measured = _lengths(chosen, known, wanted, progress)
    found = Measurement(
        shape=shape,
        chosen=chosen,
        settings=wanted,
        triangles=surface,
        lengths=lengths,
        measured=measured,
        at_edge=known.at_edge,
        normals=known.source,
        noise=noise_of(chosen.samples.points, surface, unit(known.normals)),
        warnings=(),
        seconds=time.perf_counter() - start,
        key=key_of(
            "thickness", chosen.samples.key, astuple(settings), astuple(replace(wanted, limit=0.0))
        ),
    )
    found = replace(found, warnings=(*sampling_warnings(shape, chosen), *_warnings(found)))
    CACHE.put(found.key, found, found.bytes)
    return found


def kept_measurement(key: str) -> Measurement | None:
    """A measurement that is still in memory; None when it is not."""
    found = CACHE.get(key)
    return found if isinstance(found, Measurement) else None


def _lengths(
    chosen: ChosenSamples, known: SurfaceNormals, wanted: ThicknessSettings, progress: Progress
) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """(n,) lengths and whether they were measured, of every row."""
    analysis = chosen.samples.analysis
    scan = wanted.noise is Noise.SCAN
    with native.own_errors() as module:
        mode = "SCAN" if scan else "BALL" if wanted.edges is Edges.BALL else "WALL"
        found = analysis.thickness(
            None if scan else known.normals,
            edges=known.at_edge,
            mode=getattr(module.ThicknessMode, mode),
            side=getattr(module.Side, wanted.side.name),
            progress=progress.part(),
        )
    values, measured = found.values, found.measured
    if wanted.edges is Edges.GREY and not scan:
        values = np.where(measured, values, np.inf)
    rows = _sample_of_row(chosen.samples.points, analysis.samples)
    return values[rows], measured[rows]


def _sample_of_row(points: NDArray[np.float64], samples: NDArray[np.int32]) -> Any:
    """Which of the samples, the distinct rows, each row is."""
    if len(samples) == len(points):
        return slice(None)
    which = same_place(points)
    place = np.empty(which.max() + 1, np.int64)
    place[which[samples]] = np.arange(len(samples))
    return place[which]


def _warnings(found: Measurement) -> Iterator[str]:
    if found.noise >= _TOO_MUCH:
        yield (
            "the points scatter by a fifth of their spacing or more: no figure is honest; smooth them "
            "first, or scan more finely"
        )
    elif not np.isfinite(found.lengths).any():
        yield _nothing(found)
    if _SOME < found.noise < _TOO_MUCH and found.settings.noise is Noise.CLEAN:
        yield (
            f"the points scatter by {percent(found.noise)} of their spacing, so that single figures are "
            "too small; choose Noise Scan"
        )


def _nothing(found: Measurement) -> str:
    if found.settings.between is Between.GAP:
        return "no two walls face each other across a gap"
    return "no ball is clear of the noise; choose Noise Clean, or scan more finely"
