# SPDX-License-Identifier: GPL-3.0-or-later
"""The value of Simplify that the sheets of a model suggest: in the gap between thin ones, as of noise, and others."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..arrays import Flags, Floats
from ..shape.triangles import FEW

_CLEAR = 3.0  # a clear gap: what stays is so many times as thick as what goes; chosen: unseen
_HALF = 0.5  # the largest share of the area that goes; derived: most of it stays


def gap_of(hierarchy: Any, area: Floats) -> float | None:
    """Return the length of `length_in_gap` of the sheets of a hierarchy, in percent of the diagonal.

    Parameters
    ----------
    hierarchy : _medial.Hierarchy
    area : (f,) float64
        As of `slider_range.shown_areas`.
    """
    offsets, corners = hierarchy.facet_offsets, hierarchy.facet_vertices
    is_meant = np.zeros(len(area), np.bool_)
    if len(hierarchy.on_crease) and len(area):
        is_meant = np.logical_or.reduceat(hierarchy.on_crease[corners], offsets[:-1])
    return length_in_gap(100 * hierarchy.facet_sheet.astype(np.float64), area, is_meant)


def length_in_gap(values: Floats, weights: Floats, is_meant: Flags) -> float | None:
    """Return the middle, by ratio, of the widest gap between small values and others; None where no gap is clear.

    At a clear gap no value lies within a factor of three. What is below weighs enough to be seen and no more than half,
    and nothing of it is meant.

    Parameters
    ----------
    values : (n,) float64
        Values that are 0 or infinite do not count.
    weights : (n,) float64
    is_meant : (n,) bool
        Whether a value is no noise, however small it is, as of sheets that lead into sharp edges of the faces.
    """
    goes = (values > 0.0) & np.isfinite(values) & (weights > 0.0)
    found, which = np.unique(values[goes], return_inverse=True)
    if len(found) < 2:
        return None
    gone = np.cumsum(np.bincount(which.ravel(), weights[goes]))[:-1]
    share = gone / weights[goes].sum()
    may_go = found[:-1] < values[goes & is_meant].min(initial=math.inf)
    ratio = found[1:] / found[:-1]
    ratio[~may_go | (share < FEW) | (share > _HALF)] = 0.0
    below = int(ratio.argmax())
    return math.sqrt(found[below] * found[below + 1]) if ratio[below] >= _CLEAR else None
