# SPDX-License-Identifier: GPL-3.0-or-later
"""The density of samples: epsilon, the size of the hole round a sample as a share of the feature size there.

Dey & Zhao's theorem holds for epsilon-samples: every point of the surface has a sample within epsilon times
its distance to the medial axis. Here this distance is measured to the computed axis, so epsilon is an estimate.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Flags, Floats
from ..settings import Settings
from ..shape.nearness import near
from ..small_matrices import length_of

# No new pass is needed while at most this share of the samples is too sparse for the theorem.
_DENSE_ENOUGH = 0.1  # chosen: midsurface
# Where only shares matter, this number of samples is measured. It determines shares to a percent, and costs half as
# much as all samples of a cloud of a million.
LOOKED_AT = 20_000
HOLE = 0.85  # spacings: the radius of the largest holes between even samples; measured: stage_sampling.md
REACH = 1.5  # spacings: no place of a surface is farther from its samples; chosen: unseen
_PLACES = 5  # the number of worst places that are reported
_APART = 0.05  # the smallest distance between them, as a share of the diagonal; chosen: unseen


@dataclass(frozen=True, eq=False)
class Density:
    """Estimates for each of the samples that were measured, in the order of `_medial.MedialAnalysis.samples`."""

    points: Floats  # (k, 3)
    spacing: Floats  # (k,) The radius of the hole round the sample
    feature_size: Floats  # (k,) The distance to the medial axis; infinite where none was found
    edges: Floats  # (m, 3) The samples of sharp edges
    finest: float  # The smallest spacing at sharp edges, where the feature size is 0
    limit: float  # The largest epsilon that is dense enough
    # (k,) Samples with a partner on the opposite wall, or of a plate, between which the axis is right whatever the
    # spacing. Their epsilon counts as 0.
    paired: Flags | None = None

    def with_plates(self, plates: Flags) -> Density:
        """The density where samples of plates, (k,), count as those with partners."""
        return replace(self, paired=plates if self.paired is None else plates | self.paired)

    @cached_property
    def at_edge(self) -> Flags:
        """(k,) bool: samples so close to a sharp edge that the finest spacing is not dense enough there."""
        return near(self.points, self.edges, self.finest / self.limit)

    @cached_property
    def epsilon(self) -> Floats:
        """(k,) float64: infinite where there is no axis to compare with, or where the hole has no end, 0 at pairs."""
        known = np.isfinite(self.feature_size) & (self.feature_size > 0.0)
        unknown = np.full(len(self.spacing), np.inf)
        epsilon = np.divide(self.spacing, self.feature_size, out=unknown, where=known)
        if self.paired is not None:
            epsilon[self.paired] = 0.0
        return epsilon

    @cached_property
    def share(self) -> float:
        """The share of the counted samples whose epsilon is above the limit."""
        return _mean(self._counted > self.limit)

    @cached_property
    def share_of_all(self) -> float:
        """The share of all samples whose epsilon is above the limit, sharp edges included."""
        return _mean(self.epsilon > self.limit)

    @cached_property
    def median(self) -> float:
        return self._quantile(0.5)

    @cached_property
    def p95(self) -> float:
        """The epsilon that 95 percent of the counted samples stay below."""
        return self._quantile(0.95)

    @cached_property
    def dense_enough(self) -> bool:
        """Whether another pass would change little, as it does at sharp edges."""
        return bool(self.at_edge.all()) or self.share <= _DENSE_ENOUGH

    def is_improved_by(self, spacing: float) -> bool:
        """Return whether even samples with this spacing are denser where it matters; in noise they are not."""
        area = np.minimum(self.spacing, float(np.ptp(self.points, axis=0).max())) ** 2
        too_wide = (self.epsilon > self.limit) & (self.spacing > HOLE * spacing)
        return area[too_wide].sum() > _DENSE_ENOUGH * area.sum()

    @cached_property
    def worst(self) -> list[tuple[tuple[float, ...], float]]:
        """The positions with the largest epsilon, and epsilon there; apart from each other, and not at sharp edges."""
        apart = _APART * length_of(np.ptp(self.points, axis=0))
        left = np.flatnonzero(~self.at_edge)
        left = left[np.argsort(-self.epsilon[left], kind="stable")]
        found: list[tuple[tuple[float, ...], float]] = []
        while len(left) and len(found) < _PLACES:
            place = self.points[left[0]]
            found.append((tuple(place.tolist()), float(self.epsilon[left[0]])))
            left = left[np.linalg.norm(self.points[left] - place, axis=1) > apart]
        return found

    def __str__(self) -> str:
        text = (
            f"Epsilon: median {_figure(self.median)}, 95 % below {_figure(self.p95)}, "
            f"{percent(self.share)} above {self.limit:g}"
        )
        if self.at_edge.any() and not self.at_edge.all():
            text += f"; with sharp edges {percent(self.share_of_all)}"
        return text

    @property
    def _counted(self) -> Floats:
        """The epsilon of the samples that count for shares and medians: those not at a sharp edge, if there are any."""
        return self.epsilon if self.at_edge.all() else self.epsilon[~self.at_edge]

    def _quantile(self, share: float) -> float:
        counted = self._counted
        rank = math.ceil(
            share * (len(counted) - 1)
        )  # not a mean of two values, as some are infinite
        return float(np.partition(counted, rank)[rank])


def estimate(
    analysis: Any,
    points: Floats,
    edges: Floats,
    finest: float,
    limit: float,
    most: int | None = None,
    paired: Flags | None = None,
) -> Density:
    """Estimate the density of an analysis from the facets that the published thresholds select, whatever is shown.

    Parameters
    ----------
    analysis : _medial.MedialAnalysis
    points : (n, 3) float64
        The points that were analysed.
    edges : (m, 3) float64
    finest, limit : float
    most : int, optional
        The number of samples to measure; default all.
    paired : (n,) bool, optional
        The points that have a partner on the opposite wall.
    """
    published, rows = Settings(), analysis.samples
    some = _spread(len(rows), most) if most and most < len(rows) else slice(None)
    return Density(
        points=points[rows[some]],
        spacing=analysis.spacing[some],
        feature_size=analysis.feature_size(published.theta, published.rho, rows=rows[some]),
        edges=edges,
        finest=finest,
        limit=limit,
        paired=None if paired is None else paired[rows[some]],
    )


def _spread(count: int, most: int) -> NDArray[np.intp]:
    """(k,) at most `most` numbers below `count`, spread evenly but without a period: multiples of the golden ratio."""
    return np.unique(
        (np.arange(most) * ((math.sqrt(5.0) - 1.0) / 2.0) % 1.0 * count).astype(np.intp)
    )


def percent(share: float) -> str:
    """Format a share as '0 %', '0.3 %' or '12 %'."""
    places = 0 if share == 0.0 or share >= 0.095 else 1
    return f"{100 * share:.{places}f} %"


def share_text(share: float) -> str:
    """Format a share with two digits, as '0.004 %', '7.1 %' or '100 %'."""
    return percent(share) if share >= 0.095 else f"{100 * share:.2g} %"


def _figure(value: float) -> str:
    return f"{value:.2f}" if np.isfinite(value) else "unknown"


def _mean(flags: Flags) -> float:
    return float(flags.mean()) if len(flags) else 0.0
