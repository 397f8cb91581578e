# SPDX-License-Identifier: GPL-3.0-or-later
"""The lengths over which sliders act, and the share of what can go that each of them takes away.

Simplify drops whole sheets, Trim Rims and Remove Spikes facets, and Shortest Limb edges, each at its own length. On
one model all of them go below 3 % of the diagonal, on another nothing does. A slider that runs over shares acts from
end to end on both.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Flags, Floats
from ..shape.triangles import FEW
from .directions import facet_areas

_BEYOND = 1.02  # this multiple of the largest length takes away everything; work: shown
_STEPS = 256  # the number of parts into which a share is divided
_CLEAR = 3.0  # a clear gap: what stays is so many times as thick as what goes; chosen: unseen
_HALF = 0.5  # the largest share of the area that goes; derived: most of it stays


@dataclass(frozen=True)
class SliderRange:
    """A rising curve from (0, 0) to (a length beyond the largest one, 1).

    At a length at which a part of the whole goes at once, such as a large sheet, the share is in the middle of the two
    that are possible, so that a slider between them shows the nearer one.
    """

    # Both rise; the lengths are in percent of the diagonal
    lengths: tuple[float, ...]
    shares: tuple[float, ...]

    def share(self, length: float) -> float:
        """Return the share at a length."""
        return float(np.interp(length, self.lengths, self.shares))

    def length(self, share: float) -> float:
        """Return the length at a share; it is the other direction of `share`."""
        return float(np.interp(share, self.shares, self.lengths))


def slider_range(values: NDArray, weights: NDArray) -> SliderRange | None:
    """Make the range of things that go at given lengths; None where nothing can go.

    Parameters
    ----------
    values : (n,) float
        The largest length at which each thing stays. Things of length 0 are never there, and infinite ones never go.
    weights : (n,) float
        How much each thing counts.
    """
    goes = (values > 0.0) & np.isfinite(values) & (weights > 0.0)
    if not goes.any():
        return None
    found, which = np.unique(values[goes].astype(np.float64), return_inverse=True)
    gone = np.cumsum(np.bincount(which.ravel(), weights[goes]))
    gone = gone / gone[-1]
    middle = 0.5 * (gone + np.concatenate([[0.0], gone[:-1]]))
    bins = np.floor(_STEPS * middle)
    differs = np.diff(bins) > 0
    kept = np.concatenate([[True], differs]) | np.concatenate([differs, [True]])
    return SliderRange(
        (0.0, *found[kept].tolist(), float(_BEYOND * found[-1])),
        (0.0, *middle[kept].tolist(), 1.0),
    )


def shown_areas(hierarchy: Any) -> Floats:
    """Return the areas of the facets of a hierarchy, (f,).

    Those that are never shown, because they are no thicker than the spacing of the samples, have none.
    """
    area = facet_areas(hierarchy.vertices, hierarchy.facet_offsets, hierarchy.facet_vertices)
    return area * (hierarchy.facet_spacings > 1.0)


def ranges_of(hierarchy: Any, area: Floats) -> dict[str, SliderRange]:
    """Return the ranges of the four sliders, by the names of the settings; what takes nothing away has none.

    Sheets and their facets count by their area. A branch of wires counts by its length squared, for there are many more
    bristles than limbs; and on the level without sheets, so that no slider changes the range of another one.

    The areas are those of `shown_areas`.
    """
    vertices, limb = hierarchy.vertices, hierarchy.edge_limb
    alone = np.flatnonzero((limb > 0.0) & np.isfinite(limb))
    ends = vertices[hierarchy.edges[alone]]
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    found = {
        "simplify": slider_range(100 * hierarchy.facet_sheet, area),
        "erode": slider_range(100 * hierarchy.facet_erosion, area),
        "spike": slider_range(100 * hierarchy.facet_spike, area),
        "limb": slider_range(100 * limb[alone], length * limb[alone]),
    }
    return {name: one for name, one in found.items() if one is not None}


def gap_of(hierarchy: Any, area: Floats) -> float | None:
    """Return the value of Simplify that sheets suggest, in percent of the diagonal; `area` is of `shown_areas`."""
    offsets, corners = hierarchy.facet_offsets, hierarchy.facet_vertices
    is_meant = np.zeros(len(area), np.bool_)
    if len(hierarchy.on_crease) and len(area):
        is_meant = np.logical_or.reduceat(hierarchy.on_crease[corners], offsets[:-1])
    return length_in_gap(100 * hierarchy.facet_sheet.astype(np.float64), area, is_meant)


def length_in_gap(values: Floats, weights: Floats, is_meant: Flags) -> float | None:
    """Return the middle, by ratio, of the widest gap between small values and others; None where no gap is clear.

    At a clear gap no value lies within a factor of three. What is below weighs enough to be seen and no more than half,
    and nothing of it is meant.

    Values that are 0 or infinite do not count. Those that are meant are no noise, however small they are, as of sheets
    that lead into sharp edges of the faces. All arrays are (n,).
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
