# SPDX-License-Identifier: GPL-3.0-or-later
"""The colours of thickness, with a hard edge at the limit, and how much of the surface has which colour.

Below the limit they go from yellow to red, above it from violet to blue, which is what most of the surface reaches.
Places without a length are grey.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass

import numpy as np

from ..arrays import Floats
from .measurement import Measurement

STEPS_BELOW, STEPS_ABOVE = 4, 8  # of the legend and of the histogram, below and above the limit
STEPS = STEPS_BELOW + STEPS_ABOVE
_RED, _VIOLET = 0.58, 0.3  # positions on the scale, below and at the limit; work: shown
_MOST = 0.95  # of the area is thinner than where the colours end; work: shown
_WIDEST = 1.5  # multiples of the limit to which the colours reach at least; work: shown


@dataclass(frozen=True)
class ThicknessScale:
    """The lengths that the colours of thickness stand for."""

    # The lengths that are yellow and blue
    low: float
    # The length at which red ends and violet begins; `low` where there is no limit, so that nothing
    # is red
    limit: float
    high: float

    def positions(self, lengths: Floats) -> Floats:
        """(n,) positions of lengths on the scale of `colours` between 0 and 1; NaN where there is no length."""
        above = _VIOLET * (1.0 - _share(lengths, self.limit, self.high))
        below = 1.0 - (1.0 - _RED) * _share(lengths, self.low, self.limit)
        found = np.where(lengths < self.limit, below, above)
        if self.limit == self.low:
            found = 1.0 - _share(lengths, self.low, self.high)
        return np.where(np.isfinite(lengths), found, np.nan)

    @property
    def bounds(self) -> Floats:
        """(STEPS + 1,) the lengths between the steps of the legend and of the histogram."""
        if self.limit == self.low:
            return np.linspace(self.low, self.high, STEPS + 1)
        below = np.linspace(self.low, self.limit, STEPS_BELOW, endpoint=False)
        return np.append(below, np.linspace(self.limit, self.high, STEPS_ABOVE + 1))


def scale_of(found: Measurement, limit: float) -> ThicknessScale:
    """Return the scale of a measurement; what differs from the limit by rounding only is not below it."""
    most = _length_of_share(found, _MOST)
    if limit > 0.0:
        limit -= found.slack
        return ThicknessScale(0.0, limit, max(most, _WIDEST * limit))
    low = found.minimum if np.isfinite(found.minimum) else 0.0
    return ThicknessScale(low, low, max(most, low))


def histogram(found: Measurement, scale: ThicknessScale) -> Floats:
    """(STEPS,) the shares of the area with each colour; the last step has all that is thicker."""
    known = np.isfinite(found.drawn)
    step = np.searchsorted(scale.bounds[1:-1], found.drawn[known], side="right")
    areas = np.bincount(step, found.areas[known], STEPS)
    return areas / max(float(found.areas.sum()), sys.float_info.min)


def _length_of_share(found: Measurement, share: float) -> float:
    """Return the length that a share of the area does not exceed; 0 where nothing has a length."""
    known = np.isfinite(found.drawn)
    if not known.any():
        return 0.0
    order = np.argsort(found.drawn[known], kind="stable")
    areas = np.cumsum(found.areas[known][order])
    row = min(int(np.searchsorted(areas, share * areas[-1])), len(order) - 1)
    return float(found.drawn[known][order[row]])


def _share(lengths: Floats, start: float, end: float) -> Floats:
    """(n,) positions between start (0) and end (1); 0 or 1 outside."""
    if not end > start:
        return (lengths > start).astype(np.float64)
    return np.clip((lengths - start) / (end - start), 0.0, 1.0)
