# SPDX-License-Identifier: GPL-3.0-or-later
"""The ranges of sliders on the object of a result: lengths and shares, so that files keep them; the gap that suggests a
value of Simplify; and what Detail can leave out."""

from __future__ import annotations

import bpy
import numpy as np

from ...core.axis.medial_axis import MedialAxis
from ...core.axis.slider_range import SliderRange
from ..mesh import stored


def remember_ranges(result: bpy.types.Object, axis: MedialAxis) -> None:
    """Keep the ranges of an axis on its object, or forget older ones."""
    ranges = {} if axis.level is None else axis.level.ranges
    for name, key in stored.RANGES.items():
        if found := ranges.get(name):
            result[key] = [*found.lengths, *found.shares]
        else:
            result.pop(key, None)
    for key, name in ((stored.SIMPLIFY_GAP, "gap"), (stored.REMOVALS, "removals")):
        value = getattr(axis.level, name, None)
        if value is None:
            result.pop(key, None)
        else:
            result[key] = value


def gap_on(result: bpy.types.Object | None) -> float | None:
    """The value of Simplify between thin sheets and others; None where they have no clear gap."""
    found = None if result is None else result.get(stored.SIMPLIFY_GAP)
    return found if isinstance(found, float) and 0.0 < found < 100.0 else None


def detail_is_dead(result: bpy.types.Object | None) -> bool:
    """Whether a curve has nothing that Detail could leave out."""
    return result is not None and result.get(stored.REMOVALS) == 0


def range_on(result: bpy.types.Object | None, name: str) -> SliderRange | None:
    """The range of a slider; None where the result has none, or someone changed it to what is none."""
    found = None if result is None else result.get(stored.RANGES[name])
    try:
        lengths, shares = np.array(found, np.float64).reshape(2, -1)
    except (TypeError, ValueError):
        return None
    rising = len(lengths) > 1 and (np.diff(lengths) > 0).all() and (np.diff(shares) > 0).all()
    return SliderRange(tuple(lengths), tuple(shares)) if rising else None
