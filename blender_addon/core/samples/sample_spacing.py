# SPDX-License-Identifier: GPL-3.0-or-later
"""How many samples of the faces a pass takes, and how far apart they lie."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ..settings import SamplingMode, Settings
from .nearness import near

if TYPE_CHECKING:
    from .analysis import AnalysedSamples
    from .shape import Shape


_MANY = 2**53  # samples, more than any memory holds


def mean_spacing(area: float, count: int) -> float:
    """The distance of neighbours when `count` points form a hexagonal lattice on a surface of this area."""
    return math.sqrt(2.0 * area / (math.sqrt(3.0) * count))


def first_amount(shape: Shape, settings: Settings) -> dict[str, Any]:
    """How many samples the first pass takes, as arguments of `_medial.sample_surface`: a count, or a spacing.

    Automatic takes no fewer samples than the faces have vertices, within the budget.
    """
    corners = shape.points[np.unique(shape.triangles)]
    if settings.spacing == 0.0:
        count = settings.samples
        if settings.sampling is SamplingMode.AUTOMATIC:
            count = max(count, min(len(corners), settings.budget))
        return {"count": count}
    diagonal = float(np.linalg.norm(np.ptp(corners, axis=0)))
    return {"spacing": settings.spacing / 100.0 * diagonal}


def first_spacing(shape: Shape, settings: Settings) -> float:
    """The distance of neighbours in the first pass."""
    amount = first_amount(shape, settings)
    if "spacing" in amount:
        return float(amount["spacing"])
    return mean_spacing(shape.area, amount["count"])


def first_count(shape: Shape, settings: Settings) -> int:
    """About how many samples the first pass takes; vertices that Keep Vertices adds are not counted."""
    amount = first_amount(shape, settings)
    if "count" in amount:
        return amount["count"]
    square = amount["spacing"] ** 2  # of tiny ones 0
    return (
        round(min(2.0 * shape.area / math.sqrt(3.0), _MANY * square) / square) if square else _MANY
    )


def next_amount(
    samples: AnalysedSamples, finest: float, finest_walls: float, budget: int
) -> dict[str, Any]:
    """Arguments of `_medial.sample_surface` for the next pass: spacings that the density of this one asks for.

    Where walls are so close that the axis between them is missing, its feature size says nothing, and the walls ask.

    Parameters
    ----------
    samples : AnalysedSamples
    finest : float
        The smallest spacing away from sharp edges, as a share of the first one, which is the largest anywhere.
    finest_walls : float
        The same for close walls.
    budget : int
    """
    density, walls = samples.density, samples.walls_to_show
    least = np.where(density.at_edge, density.finest, finest * samples.spacing)
    spacings = np.clip(density.limit * density.feature_size, least, samples.spacing)
    sites = density.points
    if walls is not None and walls.are_missed:
        between, wanted = walls.wanted(finest_walls * samples.spacing)
        # What asks for nothing beside them, as a sharp edge does, would keep its surroundings coarse.
        left = (spacings < samples.spacing) | ~near(sites, between, samples.spacing)
        sites = np.concatenate((sites[left], between))
        spacings = np.concatenate((spacings[left], np.minimum(wanted, samples.spacing)))
    return {"sizing": (sites, spacings), "count": budget}
