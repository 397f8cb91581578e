# SPDX-License-Identifier: GPL-3.0-or-later
"""The distance between opposite walls compared with the samples; it is measured from the faces, not from the axis.

Between walls that are closer than the samples are apart the axis may be missing altogether. No measurement against the
axis can then show that it is missing.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ..arrays import Flags, Floats, Ints, Longs
from ..machine import native
from ..shape.shape import Shape
from ..shape.triangles import FEW, some_of, unit_normals

# Walls closer than this number of spacings get finer samples, until the walls are this number of spacings apart.
_WANTED = 2.0  # chosen: axis
# Between walls closer than this number of spacings the axis is missing or torn: 94 % of the sheet in a plate is found
# at a thickness of one spacing, 93 % at 0.78, 59 % at 0.63, 16 % at 0.49, 2 % at 0.29. Between others it is there.
_MISSED = 0.8  # measured: stage_sampling.md
# Pairs of samples follow curved walls while the square of the spacing, times the curvature, is below this share of
# their distance; finer samples get this share.
_FOLLOWED, _FINER = 0.4, 0.25  # chosen: axis
# A sample is on its flat face up to this share of the spacing.
_FLAT = 1e-3  # derived: rounding
# The feature size as a share of the distance of walls that differ by 30 degrees, as far as they are looked for, where
# the axis is the middle sheet between them. Parallel walls have 0.5.
_MIDDLE = 0.464  # derived: c / (1 + c), c the cosine
# Walls that stay closer than this number of spacings within the budget do not justify another pass.
_HOPELESS = 0.5  # chosen: unseen


@dataclass(frozen=True, eq=False)
class Places:
    """Places on the flat faces, where the opposite wall is looked for."""

    # (n, 3) The normals are the unit normals of the faces
    points: Floats
    normals: Floats
    spacing: Floats  # (n,) The distance of neighbouring samples there
    area: Floats  # (n,) The area that each place represents; only ratios matter
    faces: Ints  # (n,) The triangle of the shape on which each place lies
    bend: Floats | None = None  # (n,) The curvature of the surface there
    paired: Flags | None = None  # (n,) Whether the sample there has a partner on the opposite wall
    bulge: Floats | None = None  # (n,) The distance of the sample from the flat face
    rows: Longs | None = None  # (n,) The sample that each place is; None where they are no samples


@dataclass(frozen=True, eq=False, kw_only=True)
class Walls(Places):
    """Places on the faces with the distance to the opposite wall.

    Between walls whose samples are `paired` the axis is missing only where the walls bend away between the samples.
    """

    distance: Floats  # (n,) Infinite where there is no wall within reach

    @cached_property
    def missed(self) -> float:
        """The share of the area behind which the axis is missing or torn."""
        return float(self.area[self._are_missed].sum() / self.area.sum()) if len(self.area) else 0.0

    @cached_property
    def are_missed(self) -> bool:
        return self.missed > FEW

    @property
    def bulges(self) -> Flags:
        """(n,) where facets between curved walls lie outside the flat faces, or samples leave these by half a spacing.

        The middle of the walls leaves that of the faces by their bulge, and corners of facets leave it by half the
        square of the spacing, times the curvature, in samples as fine as they will be.
        """
        if self.bulge is None:
            return np.zeros(len(self.area), bool)
        bent = np.zeros(len(self.area)) if self.bend is None else self.spacing**2 * self.bend
        corners = np.minimum(bent, _FINER * self.distance)
        return np.asarray(self.bulge + corners / 2 > np.minimum(self.distance, self.spacing) / 2)

    @property
    def are_bulging(self) -> bool:
        return float(self.area[self.bulges].sum()) > FEW * float(self.area.sum())

    @property
    def are_flat(self) -> bool:
        """Whether no sample leaves its flat face by a length that matters."""
        return self.bulge is not None and bool((self.bulge <= _FLAT * self.spacing).all())

    @cached_property
    def thickness(self) -> float:
        """The median distance of the walls that are missed."""
        return float(np.median(self.distance[self._are_missed]))

    @property
    def are_of_sheets(self) -> Flags:
        """(n,) the samples with partners where walls bend at most half as much as the balls between them."""
        assert self.bend is not None and self.paired is not None
        known = self.paired & np.isfinite(self.distance)
        return np.asarray(known & (np.where(known, self.distance, 0.0) * self.bend <= 1.0))

    def plates(self, feature_size: Floats) -> Longs:
        """(k,) the samples at which the axis is halfway between walls, and right whatever the spacing.

        The feature size is that at each place, (n,).
        """
        assert self.rows is not None
        wide = np.isfinite(self.distance) & (self.distance >= _MISSED * self.spacing)
        return self.rows[wide & (feature_size >= _MIDDLE * self.distance)]

    def wanted(self, finest: float) -> tuple[Floats, Floats]:
        """Return (k, 3) places between close walls, and (k,) the spacings that would show the axis there.

        Walls that would need spacings far below `finest` are left out.
        """
        close = self.distance < _WANTED * self.spacing
        wanted = self.distance / _WANTED
        if self.bend is not None and self.paired is not None:
            bent = self.paired & (self.bend > 0.0) & close
            wanted[self.paired] = np.inf
            wanted[bent] = np.sqrt(_FINER * self.distance[bent] / self.bend[bent])
            close &= wanted < self.spacing
        close &= wanted >= _HOPELESS / _WANTED * finest
        return self.points[close], np.maximum(wanted[close], finest)

    def are_reached_by(self, budget: int, area: float) -> bool:
        """Return whether a budget of samples, all of them spent on missed walls, would show most of these.

        The area is that of all faces.
        """
        spacing = math.sqrt(2.0 / math.sqrt(3.0) * area * self.missed / budget)
        needed = self.distance / _HOPELESS
        if self.bend is not None and self.paired is not None:
            bent = self.paired & self._are_missed
            needed[bent] = np.sqrt(_FOLLOWED * self.distance[bent] / self.bend[bent])
        return spacing < float(np.median(needed[self._are_missed]))

    @cached_property
    def _are_missed(self) -> Flags:
        missed = self.distance < _MISSED * self.spacing
        if self.bend is None or self.paired is None:
            return missed
        close = np.where(missed, self.distance, np.inf)
        away = self.spacing**2 * self.bend > _FOLLOWED * close
        return np.where(self.paired, away, missed)


def middles_of_faces(shape: Shape) -> Places:
    """The middles of the faces, with the spacing of their corners; of many faces an even selection."""
    rows = some_of(len(shape.triangles))
    corners = shape.points[shape.triangles[rows]]
    normals, doubled = unit_normals(corners)
    wide, spacing = doubled > 0.0, np.sqrt(2.0 / math.sqrt(3.0) * doubled)
    faces = rows[wide].astype(np.int32)
    return Places(corners.mean(axis=1)[wide], normals[wide], spacing[wide], doubled[wide], faces)


def find_walls(shape: Shape, places: Places, reach: float, progress: Any) -> Walls:
    """Measure the distance to the opposite wall, up to a number of spacings."""
    with native.own_errors() as module:
        distance = module.wall_distances(
            places.points,
            places.normals,
            max(_WANTED, reach) * places.spacing,
            shape.points,
            shape.triangles,
            progress=progress,
        )
    return Walls(**vars(places), distance=distance)
