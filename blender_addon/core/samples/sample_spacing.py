# SPDX-License-Identifier: GPL-3.0-or-later
"""The number of samples that a pass takes from the faces, and the distance between them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..arrays import Floats
from ..settings import SamplingMode, Settings
from ..shape.shape import Shape
from ..small_matrices import length_of

_LATER = 0.6  # the share of the work left that a pass after the first one is; work: progress
_MANY = 2**53  # samples; more than any memory holds


def mean_spacing(area: float, count: int) -> float:
    """The distance of neighbours when `count` points form a hexagonal lattice on a surface of this area."""
    return math.sqrt(2.0 * area / (math.sqrt(3.0) * count))


@dataclass(frozen=True, eq=False)
class Amount:
    """How many samples a pass takes from the faces, where, and whether in pairs."""

    # About how many samples a first pass takes, where vertices that Keep Vertices adds do not count; else the most
    count: int
    spacing: float  # The distance of neighbours in a first pass
    share: float = _LATER  # The share of the work left that the pass is
    by_spacing: bool = False  # The spacing was chosen, and the number follows from it
    # (k, 3) sites and (k,) the spacings there; None in a first pass
    sizing: tuple[Floats, Floats] | None = None
    pairs: bool = False  # In pairs, whatever the settings say
    # The samples lie on the flat faces, with edges that are sharp from this angle on; 0.0: as the settings say
    flat: float = 0.0


def first_pass(shape: Shape, settings: Settings) -> Amount:
    """Return the amount of the first pass.

    Automatic takes no fewer samples than the faces have vertices, within the budget.
    """
    corners = shape.points[np.unique(shape.triangles)]
    if settings.spacing == 0.0:
        count = settings.samples
        if settings.sampling is SamplingMode.AUTOMATIC:
            count = max(count, min(len(corners), settings.budget))
        return Amount(count, mean_spacing(shape.area, count))
    spacing = settings.spacing / 100.0 * length_of(np.ptp(corners, axis=0))
    return Amount(_count_of(spacing, shape.area), spacing, by_spacing=True)


def _count_of(spacing: float, area: float) -> int:
    """Return about how many samples with this spacing an area takes."""
    square = spacing**2  # 0 for tiny spacings
    if not square:
        return _MANY
    return round(min(2.0 * area / math.sqrt(3.0), _MANY * square) / square)
