# SPDX-License-Identifier: GPL-3.0-or-later
"""A solid as few balls of its medial axis: for collisions, physics, robots (docs/balls.md)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ..axis.levels import hierarchy_of
from ..machine import native
from ..machine.memory_limit import WHAT_IS_FREE, MemoryLimit
from ..samples.choose_samples import begin
from ..samples.chosen import ChosenSamples, OfChosenSamples
from ..samples.sampling_warnings import sampling_warnings
from ..settings import BallSettings, CoverMode, Settings, Side, SidesFrom

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..machine.progress import Progress
    from ..samples.shape import Shape

# The shares of the work before the axis begins, and before the balls are chosen.
_ANALYSIS, _AXIS = 0.5, 0.8


@dataclass(frozen=True, eq=False)
class Balls:
    """Some balls, and how well they stand for the solid.

    Parameters
    ----------
    centres : (n, 3) float64
    radii : (n,) float64
    mode : CoverMode
    covered : float
        Share of the volume of the solid that they hold: around, all that was looked at. This and the next two are
        NaN where nobody knows, for the balls were changed.
    outside : float
        No place in a ball is farther from the solid.
    farthest : float
        No place on the surface is farther from the balls.
    """

    centres: NDArray[np.float64]
    radii: NDArray[np.float64]
    mode: CoverMode
    covered: float
    outside: float
    farthest: float


@dataclass(frozen=True, eq=False)
class BallCover(OfChosenSamples):
    """Balls of a solid, and how they came about.

    Parameters
    ----------
    shape : Shape
    balls : Balls
        In the order in which they were chosen. Inside, the first n are what n balls would be; around, their centres.
    shares : (n,) float64
        Share of the volume that the first 1, 2, ... n balls hold, before they grow.
    places : int
        Of the lattice in the solid on which volumes were counted.
    chosen : ChosenSamples
        What was analysed, why, and how densely it lies.
    warnings : tuple of str
        What was assumed or looks wrong, a sentence each.
    seconds : float
    """

    shape: Shape
    balls: Balls
    shares: NDArray[np.float64]
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
    """Few balls of the axis of a shape, which is computed where it is not kept.

    Parameters
    ----------
    shape : Shape
    settings : Settings
        Of the axis. The side is always the inner one.
    wanted : BallSettings
    progress : Progress, optional
    limit : MemoryLimit

    Raises
    ------
    NativeModuleError, InvalidInputError, OutOfMemoryError, Cancelled
    DegenerateInputError
        The samples span no volume, or what they bound encloses none.
    """
    settings = replace(settings, side=Side.INNER)
    limit = limit.used(faces=len(shape.triangles) > 0, side=Side.INNER, levels=True)
    begun = begin(shape, settings, progress, limit, _ANALYSIS)
    chosen, progress = begun.chosen, begun.progress
    progress.until(_AXIS)
    hierarchy = hierarchy_of(chosen.samples, settings, progress.part())
    progress.until(1.0)
    points, triangles = _surface(shape, chosen)
    with native.own_errors() as module:
        found = module.cover_by_balls(
            hierarchy.vertices,
            hierarchy.radius,
            points,
            triangles,
            count=wanted.count,
            mode=getattr(module.CoverMode, wanted.mode.name),
            progress=progress.part(),
        )
    balls = Balls(
        centres=hierarchy.vertices[found.chosen],
        radii=found.radii,
        mode=wanted.mode,
        covered=1.0 if wanted.mode is CoverMode.AROUND else float(found.covered[-1]),
        outside=found.outside,
        farthest=found.farthest,
    )
    return BallCover(
        shape=shape,
        balls=balls,
        shares=found.covered,
        places=found.places,
        chosen=chosen,
        warnings=tuple(sampling_warnings(shape, chosen)),
        seconds=begun.seconds,
    )


def _surface(shape: Shape, chosen: ChosenSamples) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """What bounds the solid: the faces where these told inside from outside, else the boundary of the inner cells."""
    if chosen.sides.source is SidesFrom.SURFACE:
        return shape.points, shape.triangles
    with native.own_errors():
        return chosen.samples.points, chosen.samples.analysis.solid_triangles()
