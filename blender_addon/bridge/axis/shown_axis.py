# SPDX-License-Identifier: GPL-3.0-or-later
"""The part of an axis that a look shows, with all of its mesh that can be computed without Blender, in any thread."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...core.axis.clip import within_box
from ...core.axis.compute import Computation, compute_axis
from ...core.axis.crumbs import crumbs_below, without_crumbs
from ...core.axis.cut import pieces, without_shards, without_small_pieces
from ...core.axis.medial_axis import MedialAxis
from ...core.machine.memory_limit import MemoryLimit
from ...core.machine.progress import Progress
from ...core.samples.thinning import coarse
from ...core.settings import Look, Settings
from ...core.shape.shape import Shape
from ..mesh.axis_arrays import AxisArrays, arrays_of


@dataclass(frozen=True, eq=False)
class ShownAxis:
    """The part of an axis that is shown, and its arrays.

    `pieces` counts its connected pieces; `hidden` and `crumbs` count the facets and the crumbs that are left out.
    """

    axis: MedialAxis
    arrays: AxisArrays
    pieces: int
    hidden: int
    crumbs: int


def shown_axis(whole: MedialAxis, box: Sequence[float] | None, look: Look) -> ShownAxis:
    """Find the part of an axis that a look shows; `box` is that of the samples, as from `box_of`."""
    axis = _left(whole, box, look)
    return ShownAxis(
        axis,
        arrays_of(axis),
        len(np.unique(pieces(axis))) if axis.level is None else axis.level.betti[0],
        whole.facets - axis.facets,
        crumbs_below(whole, look.crumbs) if axis is not whole else 0,
    )


@dataclass(frozen=True, eq=False)
class Computed:
    """A computation, and what a look shows of its axis: None where that is empty."""

    computation: Computation
    shown: ShownAxis | None

    @property
    def seconds(self) -> float:
        return self.computation.seconds

    @property
    def warnings(self) -> tuple[str, ...]:
        return self.computation.warnings


def compute_shown(
    shape: Shape,
    settings: Settings,
    look: Look,
    limit: MemoryLimit,
    progress: Progress | None = None,
) -> Computed:
    """Compute the axis of a shape, and what the look shows of it; as `compute_axis`."""
    found = compute_axis(shape, settings, progress, limit)
    if found.axis.is_empty:
        return Computed(found, None)
    box = box_of(found.chosen.samples.points)
    return Computed(found, shown_axis(found.axis, box, look))


def compute_draft(shape: Shape, settings: Settings, *more: Any) -> Computed:
    """Compute the axis of few points or samples of a shape, as `compute_shown`."""
    return compute_shown(*coarse(shape, settings), *more)


def box_of(points: np.ndarray) -> list[float]:
    """The three lowest and the three highest coordinates of (n, 3) points."""
    return [*points.min(axis=0).tolist(), *points.max(axis=0).tolist()]


def _left(axis: MedialAxis, box: Sequence[float] | None, look: Look) -> MedialAxis:
    """The part of an axis that the look leaves; the whole axis where nothing would be left."""
    if axis.level is not None:
        return without_crumbs(axis, look.crumbs)
    if box is not None and len(box) == 6:
        low, high = np.reshape(box, (2, 3))
        near = within_box(axis, low, high, look.within)
        axis = near if near.facets else axis
    axis = without_shards(axis, look.crumbs)
    return without_small_pieces(axis, look.smallest_island / 100)
