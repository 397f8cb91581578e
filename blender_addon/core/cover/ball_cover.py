# SPDX-License-Identifier: GPL-3.0-or-later
"""A solid as few balls of its medial axis, or as capsules, for collisions, physics and robots (docs/balls.md)."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints
from ..axis.levels import hierarchy_of
from ..axis.medial_axis import no_edges
from ..axis.solid_warnings import solid_warnings
from ..counted import counted
from ..machine import native
from ..machine.memory_limit import WHAT_IS_FREE, MemoryLimit
from ..machine.progress import Progress
from ..samples.choose_samples import begin
from ..samples.chosen import ChosenSamples, OfChosenSamples
from ..settings import (
    MOST_REFINED,
    BallSettings,
    CoverMode,
    CoverShapes,
    Form,
    Settings,
    Side,
    SidesFrom,
)
from ..shape.shape import Shape
from ..small_matrices import length_of
from .capsule_segments import evenly, places_inside, segments_of
from .tight_capsules import Capsules, tight_capsules

# The shares of the work that are done before the hierarchy begins, before the balls are chosen, and before the segments
# have capsules.
_ANALYSIS, _AXIS, _MANY, _SEGMENTS = 0.5, 0.8, 0.85, 0.95  # work: progress
# Capsules begin as so many times as many more balls, at most so many more.
_TIMES, _MOST_MORE = 3, 768
_BOUND = 1.5  # of what these leave bare: no place on the surface shall be farther from the capsules; chosen: balls
_INSIDE, _ON_SURFACE = 20_000, 20_000  # places that tell what a merge loses


@dataclass(frozen=True, eq=False)
class Balls:
    """Balls, or capsules between two of them, and how well they represent the solid.

    A capsule is the union of the balls round the places of an edge, with linear radii. Each has two ends of its own.

    Parameters
    ----------
    centres : (n, 3) float64
    radii : (n,) float64
    mode : CoverMode
    covered : float
        The share of the volume of the solid that they hold; 1 for AROUND. This and the next two values are NaN where
        they are unknown because the balls were changed.
    outside : float
        The largest distance of a place in a ball from the solid.
    farthest : float
        The largest distance of a place on the surface from the balls.
    edges : (m, 2) int32
        The balls that are the ends of capsules; none for balls alone.
    """

    centres: Floats
    radii: Floats
    mode: CoverMode
    covered: float
    outside: float
    farthest: float
    edges: Ints = field(default_factory=no_edges)

    def moved(self, by: Floats) -> Balls:
        """The balls, moved."""
        return replace(self, centres=self.centres + by) if by.any() else self

    @property
    def single(self) -> Ints:
        """The rows of balls that are no end of a capsule, ascending."""
        alone = np.ones(len(self.radii), np.bool_)
        alone[self.edges.ravel()] = False
        return np.flatnonzero(alone).astype(np.int32)

    @property
    def count(self) -> int:
        """The number of balls and capsules."""
        return len(self.edges) + len(self.single)

    @property
    def words(self) -> str:
        """How many there are, for people."""
        return counted(self.count, "capsule" if len(self.edges) else "ball")

    @property
    def is_tapered(self) -> bool:
        """Whether some capsule has two radii."""
        ends = self.radii[self.edges]
        return bool((ends[:, 0] != ends[:, 1]).any())


@dataclass(frozen=True, eq=False)
class BallCover(OfChosenSamples):
    """Balls of a solid, and their origin.

    Parameters
    ----------
    shape : Shape
    balls : Balls
        In the order of the volume that each adds. Without `refine` they are in the order in which they were chosen:
        for INSIDE the first n are the result for n balls; for AROUND this holds for their centres only. Capsules are
        in the order of their volume, before they grow.
    shares : (n,) float64
        The shares of the volume that the first 1, 2, ... n balls hold, before they grow. For capsules there are none.
    places : int
        The number of places of the lattice in the solid on which volumes were counted.
    chosen : ChosenSamples
        The analysed samples, the reasons for them, and their density.
    warnings : tuple of str
        A sentence for each assumption and each suspicious result.
    seconds : float
    """

    shape: Shape
    balls: Balls
    shares: Floats
    places: int
    chosen: ChosenSamples
    warnings: tuple[str, ...]
    seconds: float


def cover_by_balls(
    shape: Shape,
    settings: Settings,
    wanted: BallSettings,
    progress: Progress | None = None,
    limit: MemoryLimit = WHAT_IS_FREE,
) -> BallCover:
    """Choose few balls of the axis of a shape, or make capsules; the axis is computed unless the cache has it.

    Parameters
    ----------
    shape : Shape
    settings : Settings
        The settings of the axis. The side is always the inner one.
    wanted : BallSettings
    progress : Progress, optional
    limit : MemoryLimit

    Raises
    ------
    NativeModuleError, InvalidInputError, OutOfMemoryError, Cancelled
    DegenerateInputError
        The samples span no volume, or enclose none.
    """
    settings = replace(settings, side=Side.INNER)
    crisp = replace(settings, form=Form.CLEAN).has_crisp_places
    limit = limit.used(
        faces=len(shape.triangles) > 0,
        side=Side.INNER,
        levels=True,
        triangles=len(shape.triangles) if crisp else 0,
    )
    begun = begin(shape, settings, progress, limit, _ANALYSIS, levels=True)
    shape, chosen, progress = begun.shape, begun.chosen, begun.progress
    progress.until(_AXIS)
    tolerance = wanted.tolerance / 100 * length_of(np.ptp(shape.points, axis=0))
    make = _balls_of if wanted.shapes is CoverShapes.BALLS else _capsules_of
    balls, shares, places = make(shape, chosen, settings, wanted, tolerance, progress)
    return BallCover(
        shape=shape,
        balls=balls,
        shares=shares,
        places=places,
        chosen=chosen,
        warnings=tuple(solid_warnings(shape, Side.INNER, chosen.sides.source, chosen)),
        seconds=begun.seconds,
    )


def _balls_of(
    shape: Shape,
    chosen: ChosenSamples,
    settings: Settings,
    wanted: BallSettings,
    tolerance: float,
    progress: Progress,
) -> tuple[Balls, Floats, int]:
    """Return balls, the shares that the first ones hold, and the number of places."""
    hierarchy = hierarchy_of(chosen.samples, settings, progress.part(), places=True)
    progress.until(1.0)
    centres, radii = _balls(hierarchy)
    surface = _surface(shape, chosen)
    found = _closest_cover((centres, radii, *surface), wanted, tolerance, progress)
    balls = Balls(centres[found.chosen], found.radii, wanted.mode, *_figures_of(found, wanted.mode))
    return balls, found.covered, found.places


def _capsules_of(
    shape: Shape,
    chosen: ChosenSamples,
    settings: Settings,
    wanted: BallSettings,
    tolerance: float,
    progress: Progress,
) -> tuple[Balls, Floats, int]:
    """Return capsules that began as more balls, no shares, and the number of places."""
    hierarchy = hierarchy_of(chosen.samples, settings, progress.part(), places=True)
    progress.until(_MANY)
    surface = _surface(shape, chosen)
    inner, tight = _segments(_balls(hierarchy), surface, chosen, wanted, progress)
    progress.until(1.0)
    covers = [_cover_round(inner, None, surface, wanted, tolerance, progress)]
    covers += [
        _cover_round(one.ends, one.radii, surface, wanted, tolerance, progress) for one in tight
    ]
    found = min(covers, key=_volume_of)
    ends = found.ends.reshape(-1, 2, 3)
    is_ball = (ends[:, 0] == ends[:, 1]).all(axis=1)
    kept = np.column_stack([np.ones(len(ends), np.bool_), ~is_ball])  # a ball is kept once
    row = np.cumsum(kept.ravel()).reshape(-1, 2) - 1
    balls = Balls(
        ends[kept],
        found.radii.reshape(-1, 2)[kept],
        wanted.mode,
        *_figures_of(found, wanted.mode),
        edges=np.ascontiguousarray(row[~is_ball], np.int32),
    )
    return balls, np.empty(0), found.places


def _cover_round(
    ends: Floats,
    radii: Floats | None,
    surface: tuple[Floats, Ints],
    wanted: BallSettings,
    tolerance: float,
    progress: Progress,
) -> Any:
    """Return a `_medial.CapsuleCover` round segments, (n, 2, 3), which may begin with given radii."""
    with native.own_errors() as module:
        return module.cover_by_capsules(
            ends.reshape(-1, 3),
            np.arange(2 * len(ends), dtype=np.int32).reshape(-1, 2),
            *surface,
            count=wanted.count,
            mode=getattr(module.CoverMode, wanted.mode.name),
            tapered=wanted.shapes is CoverShapes.TAPERED,
            tolerance=tolerance,
            radii=None if radii is None else radii.ravel(),
            progress=progress.part(),
        )


def _volume_of(cover: Any) -> float:
    """Return the volume of the capsules of a `_medial.CapsuleCover`."""
    return Capsules(cover.ends.reshape(-1, 2, 3), cover.radii.reshape(-1, 2)).volume()


def _segments(
    candidates: tuple[Floats, Floats],
    surface: tuple[Floats, Ints],
    chosen: ChosenSamples,
    wanted: BallSettings,
    progress: Progress,
) -> tuple[Floats, list[Capsules]]:
    """Return segments for capsules, (n, 2, 3): those of more balls INSIDE than are wanted, which are merged.

    AROUND, there are also capsules that hold the samples, the vertices, and places inside.
    """
    count, tapered = wanted.count, wanted.shapes is CoverShapes.TAPERED
    more = count + min(_TIMES * count, _MOST_MORE)
    with native.own_errors() as module:
        found = module.cover_by_balls(
            *candidates,
            *surface,
            count=more,
            mode=module.CoverMode.INSIDE,
            refine=more <= MOST_REFINED,
            progress=progress.part(),
        )
    progress.until(_SEGMENTS)
    places = places_inside(*surface, _INSIDE), evenly(chosen.samples.points, _ON_SURFACE)
    balls = candidates[0][found.chosen], found.radii
    inner = segments_of(*balls, count, surface, places, _BOUND * found.farthest, tapered, progress)
    if wanted.mode is CoverMode.INSIDE:
        return inner[0], []
    held = np.concatenate([*places, evenly(surface[0], _ON_SURFACE)])
    return inner[0], tight_capsules(held, count, tapered, inner)


def _figures_of(found: Any, mode: CoverMode) -> tuple[float, float, float]:
    """Return the figures `covered`, `outside` and `farthest`."""
    held = 1.0 if mode is CoverMode.AROUND else found.held
    return held, found.outside, found.farthest


def _closest_cover(
    given: tuple[NDArray, ...], wanted: BallSettings, tolerance: float, progress: Progress
) -> Any:
    """Return a `_medial.BallCover`: AROUND, of the refined and the greedy choice the one that reaches out less."""
    refine = wanted.refine and wanted.count <= MOST_REFINED
    choices = (True, False) if refine and wanted.mode is CoverMode.AROUND else (refine,)
    with native.own_errors() as module:
        covers = [
            module.cover_by_balls(
                *given,
                count=wanted.count,
                mode=getattr(module.CoverMode, wanted.mode.name),
                refine=choice,
                tolerance=tolerance,
                progress=progress.part(1 / (len(choices) - made)),
            )
            for made, choice in enumerate(choices)
        ]
    return min(covers, key=lambda cover: cover.outside)


def _balls(hierarchy: Any) -> tuple[Floats, Floats]:
    """Return the balls of a `_medial.Hierarchy`: those that end at the faces, if it has any."""
    if len(hierarchy.place):
        return hierarchy.crisp_vertices, hierarchy.crisp_radius
    return hierarchy.vertices, hierarchy.radius


def _surface(shape: Shape, chosen: ChosenSamples) -> tuple[Floats, Ints]:
    """Return the boundary of the solid: the faces if they decide what is inside, else that of the inner cells."""
    if chosen.sides.source is SidesFrom.SURFACE:
        return shape.points, shape.triangles
    with native.own_errors():
        return chosen.samples.points, chosen.samples.analysis.solid_triangles()
