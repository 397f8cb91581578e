# SPDX-License-Identifier: GPL-3.0-or-later
"""The parts of a measured shape that are thinner than a limit: patches with their place, area and minimum."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Flags, Floats, Ints
from ..machine import native
from .measurement import Measurement


@dataclass(frozen=True)
class Patch:
    """A connected thin part of the surface."""

    # The middle of its thinnest triangle, in the frame of the shape
    place: tuple[float, float, float]
    area: float
    minimum: float  # The length of its thinnest triangle
    # The smallest length of its samples; by the faces, where none is left out, the minimum
    lowest: float


@dataclass(frozen=True, eq=False)
class ThinParts:
    """The thin parts of a measurement."""

    limit: float
    minimum: float  # The smallest length of all: never below the limit without a patch that says so
    patches: tuple[Patch, ...]  # The thinnest first
    # (f,) The patch of each triangle of the measured surface, also where it is filled in; -1 where
    # there is none
    patch_of_triangles: Ints
    # (m,) The patch of each face of the shape: that of the triangle that represents it
    patch_of_faces: Ints
    area: float  # The area of all patches
    share: float  # Their share of the surface

    @property
    def told(self) -> bool:
        """Whether people are told: not of less than 0.1 % of the surface, which is that of slivers."""
        return self.share >= 1e-3


def find_thin_parts(
    found: Measurement, limit: float, minimum_patch: float | None = None
) -> ThinParts:
    """Find the patches that are strictly thinner than a limit.

    Parameters
    ----------
    found : Measurement
    limit : float
    minimum_patch : float, optional
        The smallest patch that counts, in percent of the area; by default that of the measurement. Patches of walls
        that only rays found count whatever their size.
    """
    least = found.settings.minimum_patch if minimum_patch is None else minimum_patch
    thin = found.of_triangles < limit - found.slack
    with native.own_errors() as module:
        drawn = found.drawn < limit - found.slack
        numbers = module.patches(found.triangles, drawn, len(found.points))
    count = int(numbers.max(initial=-1)) + 1
    below = found.areas_below(limit)[drawn]
    all_areas = np.bincount(numbers[drawn], below, count).astype(np.float64)
    total = float(found.areas.sum())
    large = all_areas >= least / 100.0 * total
    large &= np.bincount(numbers[thin], minlength=count) > 0
    large[numbers[thin & (found.surface.at_most < limit - found.slack)]] = True
    numbers, areas = _kept(numbers, all_areas, large)
    numbers, patches = _described(found, numbers, areas)
    faces = found.triangle_of_faces
    of_faces = np.where(faces >= 0, numbers[faces], -1).astype(np.int32) if len(numbers) else faces
    area = float(areas.sum())
    share = min(1.0, area / total) if total > 0.0 else 0.0
    counted = ~thin | (numbers >= 0)
    minimum = float(found.of_triangles[counted].min(initial=np.inf))
    if not patches:
        minimum = max(minimum, limit)  # less by rounding only
    return ThinParts(limit, minimum, patches, numbers, of_faces, area, share)


def _kept(numbers: Ints, areas: Floats, large: Flags) -> tuple[Ints, Floats]:
    """Drop the patches that are not large."""
    renumbered = np.append(np.where(large, np.cumsum(large) - 1, -1), -1)
    return renumbered[numbers].astype(np.int32), areas[large]


def _described(found: Measurement, numbers: Ints, areas: Floats) -> tuple[Ints, tuple[Patch, ...]]:
    """Return the new numbers of the patches, and the patches, the thinnest first."""
    inside = np.flatnonzero(numbers >= 0)
    by_value = inside[np.lexsort((inside, found.of_triangles[inside]))]
    order, first = np.unique(numbers[by_value], return_index=True)
    thinnest = by_value[first]  # the thinnest triangle of each patch
    rank = np.argsort(first, kind="stable")  # patches by their thinnest triangle
    new = np.full(len(areas) + 1, -1, np.int32)
    new[order[rank]] = np.arange(len(rank))
    lowest = found.of_triangles[thinnest]
    if found.surface.between_walls is None:
        lengths = found.lengths[found.triangles[inside]].min(axis=1)
        np.minimum.at(lowest, numbers[inside], lengths)
    places = found.points[found.triangles[thinnest]].mean(axis=1).tolist()
    patches = tuple(
        Patch(
            place=(places[i][0], places[i][1], places[i][2]),
            area=float(areas[i]),
            minimum=float(found.of_triangles[thinnest[i]]),
            lowest=float(lowest[i]),
        )
        for i in rank
    )
    return new[numbers], patches
