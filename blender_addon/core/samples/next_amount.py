# SPDX-License-Identifier: GPL-3.0-or-later
"""The amount of the next pass: smaller spacings where the density, the walls or doubts of the topology want them."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from ..arrays import Floats
from ..settings import OPTIONS
from ..shape.nearness import near, nearest
from ..shape.solid_faces import sharp_angle_of
from .analysed import Analysed
from .decide import Plan
from .doubts import Topology
from .sample_spacing import Amount

# The spacing at a doubt is half of its gap, but not more than half of the spacing there, and not less than this share.
_HALF, _FINEST = 0.5, 0.25  # chosen: unseen
# Where a Voronoi edge passes the faces in a gap below this share of the way to its samples, it may touch a bulge.
_WIDE = 0.2  # chosen: unseen
# Walls that are missed on more than this share of the area are missed as a whole.
_AS_A_WHOLE = 0.2  # chosen: unseen
# Edges that bend so many times less than those of the faces that a smooth surface leaves are no edges of the solid.
_AS_BENT = 3.0  # chosen: unseen

# Edges of close walls that bend more than this have places on one side whose partners lie beyond the opposite edge, by
# more than the share of the distance of walls by which partners may be moved (`kMoved`, paired_samples.cpp).
CROSSED = 0.278  # radians; derived: twice the angle with the tangent 0.14, from a wall to the plane halfway


def next_amount(plan: Plan, samples: Analysed, budget: int) -> Amount:
    """Return the amount of the next pass: the spacings that the density of this one requires.

    Where walls are so close that the axis between them is missing, the feature size means nothing. There the walls
    determine the spacing.
    """
    density, walls = samples.density, samples.walls_to_show
    least = np.where(density.at_edge, density.finest, plan.effort.elsewhere * samples.spacing)
    spacings = np.clip(density.limit * density.feature_size, least, samples.spacing)
    if density.paired is not None:
        spacings[density.paired] = samples.spacing
    sites = density.points
    if walls is not None and walls.are_missed:
        between, wanted = walls.wanted(plan.effort.walls * samples.spacing)
        # Sites next to walls that require no finer spacing, as on a sharp edge, would keep the walls coarse.
        left = (spacings < samples.spacing) | ~near(sites, between, samples.spacing)
        sites = np.concatenate((sites[left], between))
        spacings = np.concatenate((spacings[left], np.minimum(wanted, samples.spacing)))
    return Amount(budget, samples.spacing, sizing=(sites, spacings))


def finer_in_pairs(
    plan: Plan, samples: Analysed, topology: Topology, number: int, budget: int
) -> Amount:
    """Return the amount of the pass after a `number` of passes: spacings as they are, or smaller ones at doubts.

    The first time they follow the density and the walls, as without pairs, where walls are missed or no doubt says
    where. Elsewhere that makes more loops than it closes.
    """
    assert samples.apart is not None
    where = bool(len(topology.gaps) and topology.betti != samples.by_faces)
    sites, spacings = samples.points, samples.apart
    if number == 1 and (samples.walls_are_close or not where):
        wanted = next_amount(plan, samples, budget)
        assert wanted.sizing is not None
        sites, spacings = wanted.sizing
    if where and not (number == 1 and _are_missed_as_a_whole(samples)):
        places, apart = _wanted(samples, topology)
        sites = np.concatenate((sites, places))
        spacings = np.concatenate((spacings, apart))
    return Amount(budget, plan.first.spacing, sizing=(sites, spacings), pairs=True)


def sharp_at_doubts(plan: Plan, samples: Analysed, topology: Topology) -> float:
    """Return from which angle edges are sharp if samples on the flat faces help against doubts, and 0 otherwise.

    Pairs cross beside edges that are rounded and bend much. On the flat faces such an edge has samples and partners of
    its own. Elsewhere, facets between curved walls may lie outside these faces.
    """
    walls = samples.walls
    if walls is None or walls.rows is None:
        return 0.0
    bends = plan.given.shape.smooth_bends(plan.given.sharp)[walls.faces]
    doubted = np.isin(walls.rows, nearest(topology.places, samples.points))
    if (doubted & walls.are_of_sheets & (bends > CROSSED)).any():
        return CROSSED
    return sharp_on_flat(plan, samples) if (doubted & walls.bulges).any() else 0.0


def _are_missed_as_a_whole(samples: Analysed) -> bool:
    """Whether so many walls are missed that doubts are everywhere and say nothing."""
    return samples.walls is not None and samples.walls.missed > _AS_A_WHOLE


def _wanted(samples: Analysed, topology: Topology) -> tuple[Floats, Floats]:
    """(k, 3) places of doubt, and (k,) the spacings there; first those where the gap is no mere touch."""
    assert samples.apart is not None
    places, gaps = topology.places, topology.gaps
    rows = nearest(places, samples.points)
    own, away = samples.apart[rows], np.linalg.norm(places - samples.points[rows], axis=1)
    wide = gaps > _WIDE * away
    if not wide.any():
        wide[:] = True
    wanted = np.clip(_HALF * gaps, _FINEST * own, _HALF * own)
    return places[wide], wanted[wide]


def sharp_on_flat(plan: Plan, samples: Analysed) -> float:
    """Return from which angle edges are sharp if samples belong on the flat faces, and 0 on the smooth surface.

    They belong there where the smooth surface is flat everywhere, or leaves close walls. Edges of the faces that it
    leaves are then edges of the solid: samples that miss them tear the sheet between close walls.
    """
    walls = samples.walls
    if walls is None or not (walls.are_bulging or walls.are_flat):
        return 0.0
    shape = plan.given.shape
    bent = shape.smooth_bends(plan.given.sharp)[walls.faces[walls.bulges]]
    least = max(
        float(bent[bent > 0.0].min(initial=math.inf)) / _AS_BENT, OPTIONS["sharp_angle"].minimum
    )
    settings = plan.given.settings
    settings = replace(settings, sharp_angle=min(settings.sharp_angle, least))
    return sharp_angle_of(shape, settings)
