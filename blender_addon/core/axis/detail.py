# SPDX-License-Identifier: GPL-3.0-or-later
"""A curve with less detail: without loops and short branches that come from the sampling, as a skeleton is.

The rules of the skeleton take one loop or branch after the other away. Detail is the share of these removals that is
not done, so a curve with less detail has only loops and branches of one with more.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Flags, Ints
from ..curves.loaded_net import LoadedNet, genuine_loops, loaded_net
from ..curves.removals import Removals, removals_of, take_apart
from ..curves.rules import Loops
from ..samples.analysed import Analysed
from ..settings import SkeletonSettings
from ..united import united
from .medial_axis import MedialAxis
from .rows_of_axis import with_rows

_SHARE = SkeletonSettings().share


def with_detail(
    axis: MedialAxis, level: Any, hierarchy: Any, samples: Analysed, detail: float
) -> MedialAxis:
    """Return a curve without some of its loops and branches, which knows how many could go.

    The axis is the `_medial.Level` in the form CURVE; facets of closed sheets, and what they hold, stay. Detail goes
    from 0, what a skeleton has, to 1, everything.
    """
    assert axis.level is not None
    if not len(level.vertices):
        return axis
    removals = _removals(level, hierarchy, samples)
    axis = replace(axis, level=replace(axis.level, removals=removals.count))
    done = _done(removals, detail)
    return _with_edges(axis, removals.after(done).astype(np.int32)) if done else axis


def net_with_detail(
    level: Any, hierarchy: Any, samples: Analysed, detail: float
) -> tuple[LoadedNet, Loops]:
    """Return the net of a curve with some detail, and how many of its loops were cut and filled.

    It has the branches that `with_detail` shows; the parameters are the same.
    """
    done = _done(_removals(level, hierarchy, samples), detail)
    loaded = _loaded(level, hierarchy, samples)
    return loaded, take_apart(loaded, genuine_loops(samples), _SHARE, done)


def _done(removals: Removals, detail: float) -> int:
    return round((1.0 - detail) * removals.count)


def _removals(level: Any, hierarchy: Any, samples: Analysed) -> Removals:
    """Return the removals, which are kept as long as the level has the same wires."""
    kept = samples.kept.levels.kept("removals", hierarchy, lambda _: {})
    wires = level.wires.tobytes()
    found: Removals | None = kept.get(wires)
    if found is None:
        loaded = _loaded(level, hierarchy, samples)
        found = removals_of(loaded, genuine_loops(samples), _SHARE)
        kept.clear()
        kept[wires] = found
    return found


def _loaded(level: Any, hierarchy: Any, samples: Analysed) -> LoadedNet:
    return loaded_net(samples, hierarchy, level, np.unique(level.face_vertices).tolist())


def _with_edges(axis: MedialAxis, edges: Ints) -> MedialAxis:
    """Return a curve with other edges, of which each piece has some or one vertex."""
    values = axis.level
    assert values is not None
    keep = np.zeros(len(axis.vertices), np.bool_)
    keep[edges.ravel()] = True
    keep[axis.face_vertices] = True
    keep |= _alone(axis, keep)
    fewer = with_rows(axis, keep, edges, _limbs(axis, edges))
    pieces, loops, cavities = values.betti
    # No piece is lost or divided, so the number of loops follows from the numbers of cells.
    lost = len(axis.edges) - len(edges) - (len(axis.vertices) - len(fewer.vertices))
    assert fewer.level is not None
    betti = pieces, loops - lost, cavities
    return replace(fewer, level=replace(fewer.level, betti=betti, loops_left_out=lost))


def _alone(axis: MedialAxis, keep: Flags) -> Flags:
    """Return the largest ball of each piece of wires of which nothing else is kept, and single points, (v,)."""
    piece = united(len(keep), axis.edges)
    order = np.lexsort((np.arange(len(keep)), -axis.radius, piece))
    first = np.ones(len(order), np.bool_)
    first[1:] = piece[order][1:] != piece[order][:-1]
    largest = order[first]
    some = np.zeros(len(keep), np.bool_)
    some[piece[keep]] = True
    alone = np.zeros(len(keep), np.bool_)
    alone[largest] = ~some[piece[largest]]
    return alone


def _limbs(axis: MedialAxis, edges: Ints) -> NDArray[np.float32]:
    """Return the values of edges; a new one has the smaller of the largest values at its ends."""
    values = axis.level
    assert values is not None
    old = np.sort(axis.edges, axis=1).astype(np.int64)
    new = edges.astype(np.int64)
    count = len(axis.vertices)
    key = old[:, 0] * count + old[:, 1]
    order = np.argsort(key, kind="stable")
    wanted = new[:, 0] * count + new[:, 1]
    at = np.minimum(np.searchsorted(key, wanted, sorter=order), len(order) - 1)
    row = order[at]
    largest = np.zeros(count, np.float32)
    np.maximum.at(largest, old.ravel(), np.repeat(values.limb, 2))
    return np.where(key[row] == wanted, values.limb[row], largest[new].min(axis=1, initial=np.inf))
