# SPDX-License-Identifier: GPL-3.0-or-later
"""The number of samples that a pass takes from the faces, and the distance between them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..settings import SamplingMode, Settings
from ..shape.nearness import near
from ..shape.shape import Shape
from ..small_matrices import length_of
from .analysed import AnalysedSamples

_MANY = 2**53  # samples; more than any memory holds


def mean_spacing(area: float, count: int) -> float:
    """The distance of neighbours when `count` points form a hexagonal lattice on a surface of this area."""
    return math.sqrt(2.0 * area / (math.sqrt(3.0) * count))


@dataclass(frozen=True)
class FirstPass:
    """The size of the first pass.

    Parameters
    ----------
    amount : dict
        The `count` or the `spacing`, as an argument of `_medial.sample_surface`.
    spacing : float
        The distance of neighbours.
    area : float
        The area of the faces.
    """

    amount: dict[str, Any]
    spacing: float
    area: float

    @property
    def count(self) -> int:
        """The approximate number of samples; vertices that Keep Vertices adds do not count."""
        if "count" in self.amount:
            return int(self.amount["count"])
        square = self.spacing**2  # 0 for tiny spacings
        if not square:
            return _MANY
        return round(min(2.0 * self.area / math.sqrt(3.0), _MANY * square) / square)


def first_pass(shape: Shape, settings: Settings) -> FirstPass:
    """Plan the first pass.

    Automatic takes no fewer samples than the faces have vertices, within the budget.
    """
    corners = shape.points[np.unique(shape.triangles)]
    if settings.spacing == 0.0:
        count = settings.samples
        if settings.sampling is SamplingMode.AUTOMATIC:
            count = max(count, min(len(corners), settings.budget))
        return FirstPass({"count": count}, mean_spacing(shape.area, count), shape.area)
    spacing = settings.spacing / 100.0 * length_of(np.ptp(corners, axis=0))
    return FirstPass({"spacing": spacing}, spacing, shape.area)


def next_amount(
    samples: AnalysedSamples, finest: float, finest_walls: float, budget: int
) -> dict[str, Any]:
    """Arguments of `_medial.sample_surface` for the next pass: the spacings that the density of this one requires.

    Where walls are so close that the axis between them is missing, the feature size means nothing. There the walls
    determine the spacing.

    Parameters
    ----------
    samples : AnalysedSamples
    finest : float
        The smallest spacing away from sharp edges, as a share of the first pass's, which is the largest anywhere.
    finest_walls : float
        The same share for close walls.
    budget : int
    """
    density, walls = samples.density, samples.walls_to_show
    least = np.where(density.at_edge, density.finest, finest * samples.spacing)
    spacings = np.clip(density.limit * density.feature_size, least, samples.spacing)
    if density.paired is not None:
        spacings[density.paired] = samples.spacing
    sites = density.points
    if walls is not None and walls.are_missed:
        between, wanted = walls.wanted(finest_walls * samples.spacing)
        # Sites next to walls that require no finer spacing, as on a sharp edge, would keep the walls coarse.
        left = (spacings < samples.spacing) | ~near(sites, between, samples.spacing)
        sites = np.concatenate((sites[left], between))
        spacings = np.concatenate((spacings[left], np.minimum(wanted, samples.spacing)))
    return {"sizing": (sites, spacings), "count": budget}
