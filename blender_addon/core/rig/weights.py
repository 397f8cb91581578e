# SPDX-License-Identifier: GPL-3.0-or-later
"""Vertices get weights of the bones on the branch to which they belong.

A vertex follows the bone next to it. Near a joint within a chain the two bones share the vertices. At the rim of the
part of a limb and its descendants, vertices follow the parent bone of the limb: so the weights are continuous, and no
limb moves the skin of another one. Then they diffuse along the surface, as heat does, over half the radius of the limb.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Flags, Floats, Ints, Longs
from ..curves.spread import Graph, graph_of, spread
from ..skeleton.parts import Places
from .bones import Bones

MOST = 4  # a vertex follows at most this many bones
_DIFFUSED = 0.5  # weights diffuse so far, as a share of the radius of the limb; chosen: rig
_SHORT = 1e-6  # of the mean: the square of an edge counts as no less; derived: rounding
_CLOSE, _MOST_STEPS = 1e-3, 200  # weights are solved to this, in at most so many; chosen: rig


def axis_weights(
    bones: Bones, places: Places, vertices: Floats, edges: Ints
) -> tuple[Ints, Floats]:
    """Compute the (v, 4) bones and weights of (v, 3) vertices at places on branches, with (e, 2) edges between them.

    The weights of a vertex are not negative and add up to 1, and the largest is first. There is at least one bone.
    """
    weight = np.zeros((len(vertices), bones.count))
    chain = _along_branches(weight, bones, places)
    _to_nearest(weight, chain, bones, vertices)
    graph = graph_of(vertices, edges)
    _share_with_parents(weight, chain, bones, vertices, edges)
    _diffuse(weight, graph, bones)
    bone = np.argsort(-weight, axis=1, kind="stable")[:, :MOST]
    found = np.take_along_axis(weight, bone, axis=1)
    missing = MOST - bone.shape[1]
    if missing > 0:
        bone, found = (np.pad(x, ((0, 0), (0, missing))) for x in (bone, found))
    return bone.astype(np.int32), found / found.sum(axis=1, keepdims=True)


def _along_branches(weight: Floats, bones: Bones, places: Places) -> Longs:
    """Give each vertex the bone next to it, and return the chain of that bone, or -1 if there is none.

    A stub follows the bone at whose end it lies.
    """
    chain = np.full(len(weight), -1, np.int64)
    length = np.linalg.norm(bones.tail - bones.head, axis=1)
    for bone in np.flatnonzero(bones.branch >= 0):
        low, high = np.sort(bones.along[bone])
        closed = high == bones.along[bones.branch == bones.branch[bone]].max()
        here = (places.branch == bones.branch[bone]) & (places.along >= low)
        here &= (places.along <= high) if closed else (places.along < high)
        chain[here] = bones.chain[bone]
        weight[here, bone] = 1.0
    stubs = bones.stubs
    for branch, (low, high), bone in zip(stubs.branch, stubs.along, stubs.bone, strict=True):
        here = (places.branch == branch) & (places.along >= low) & (places.along <= high)
        chain[here] = bones.chain[bone]
        weight[here] = 0.0
        weight[here, bone] = 1.0
    for bone in np.flatnonzero(bones.parent >= 0):
        before = bones.parent[bone]
        if bones.chain[before] == bones.chain[bone]:
            _blend(weight, bones, places, before, bone, length)
    return chain


def _blend(
    weight: Floats, bones: Bones, places: Places, before: int, after: int, length: Floats
) -> None:
    """Blend two bones around their joint, up to the radius there and at most half of each bone."""
    sign = np.sign(bones.along[after, 1] - bones.along[after, 0])
    share = np.abs(np.diff(bones.along[[before, after]], axis=1)[:, 0])
    of_length = float(share.sum() / length[[before, after]].sum())
    reach = min(bones.head_radius[after] * of_length, *(share / 2))
    past = sign * (places.along - bones.along[after, 0]) / max(reach, np.finfo(float).tiny)
    here = (places.branch == bones.branch[after]) & (np.abs(past) < 1.0)
    follows = _smoothstep((past[here] + 1.0) / 2.0)
    weight[here, after], weight[here, before] = follows, 1.0 - follows


def _to_nearest(weight: Floats, chain: Longs, bones: Bones, vertices: Floats) -> None:
    """Let vertices of parts without a branch follow the bone whose middle is nearest."""
    middle = (bones.head + bones.tail) / 2
    for row in np.flatnonzero(chain < 0):
        bone = int(np.argmin(np.linalg.norm(middle - vertices[row], axis=1)))
        weight[row, bone], chain[row] = 1.0, bones.chain[bone]


def _share_with_parents(
    weight: Floats, chain: Longs, bones: Bones, vertices: Floats, edges: Ints
) -> None:
    """Fade out each chain and its descendants, towards the rim of their part, in favour of the parent bone.

    Descendants come first, so that the weight that they leave to a chain fades out with that chain.
    """
    first = _first_bones(bones)
    for name in range(len(first) - 1, -1, -1):  # a chain has a higher number than its parent
        hangs_on = bones.parent[first[name]]
        if hangs_on < 0:
            continue
        below = _all_below(name, bones, first)
        width = float(bones.head_radius[first[name]])
        rows, fades = _rim(below[chain], vertices, edges, width)
        mine = np.flatnonzero(below[bones.chain])
        block = weight[np.ix_(rows, mine)]
        left = block * fades[:, None]
        weight[np.ix_(rows, mine)] = left
        weight[rows, hangs_on] += (block - left).sum(axis=1)


def _rim(here: Flags, vertices: Floats, edges: Ints, width: float) -> tuple[Longs, Floats]:
    """Return the vertices of a part of the surface within a width of its rim, and the share that they keep.

    The width is at most half of the largest distance from the rim, so that some vertices of a short part keep all.
    """
    inside = here[edges]
    apart = inside[:, 0] != inside[:, 1]
    rim = np.unique(edges[apart][inside[apart]]).astype(np.int64)
    inner = graph_of(vertices, edges[inside.all(axis=1)])
    _, away = spread(inner, rim, np.zeros(len(rim), np.int64))
    width = min(width, float(away[np.isfinite(away)].max(initial=0.0)) / 2)
    rows = np.flatnonzero(here & (away < width))
    return rows, _smoothstep(away[rows] / width)


def _first_bones(bones: Bones) -> Longs:
    """Return the first bone of each chain, (chains,)."""
    first = np.zeros(bones.chain.max() + 1, np.int64)
    first[bones.chain[::-1]] = np.arange(bones.count)[::-1]
    return first


def _all_below(name: int, bones: Bones, first: Longs) -> Flags:
    """Return a mask, (chains,), of a chain and its descendants."""
    found = np.zeros(len(first), bool)
    found[name] = True
    for other in range(name + 1, len(first)):
        above = bones.parent[first[other]]
        found[other] = above >= 0 and found[bones.chain[above]]
    return found


def _diffuse(weight: Floats, graph: Graph, bones: Bones) -> None:
    """Let weights diffuse along the edges, in one implicit step of the heat equation; the sum of each vertex stays.

    They remain between 0 and 1, and a surface with twice as many vertices gets the same.
    """
    if not len(graph.to):
        return
    far = _DIFFUSED * (weight * ((bones.head_radius + bones.tail_radius) / 2)).sum(axis=1)
    square = np.maximum(graph.length**2, _SHORT * float((graph.length**2).mean()))
    kept = 1.0 / np.maximum(far**2, _SHORT * float(square.mean()))
    flow = _Flow(graph, 1.0 / square, kept)
    for bone in range(weight.shape[1]):
        if weight[:, bone].any():
            weight[:, bone] = np.clip(
                flow.solved(kept * weight[:, bone], weight[:, bone]), 0.0, 1.0
            )
    weight /= weight.sum(axis=1, keepdims=True)


class _Flow:
    """Solves (kept + Laplacian) x = right by conjugate gradients, each unknown scaled by its diagonal."""

    def __init__(self, graph: Graph, along: Floats, kept: Floats) -> None:
        self._to, self._along = graph.to, along
        self._joined = np.flatnonzero(np.diff(graph.first))
        self._first = graph.first[self._joined]
        self._diagonal = kept.copy()
        self._diagonal[self._joined] += np.add.reduceat(along, self._first)

    def _times(self, x: Floats) -> Floats:
        found = self._diagonal * x
        found[self._joined] -= np.add.reduceat(self._along * x[self._to], self._first)
        return found

    def solved(self, right: Floats, start: Floats) -> Floats:
        x = start.copy()
        rest = right - self._times(x)
        way = scaled = rest / self._diagonal
        size = float((rest * scaled).sum())
        for _ in range(_MOST_STEPS):
            if np.abs(scaled).max() <= _CLOSE:
                break
            across = self._times(way)
            step = size / float((way * across).sum())
            x += step * way
            rest = rest - step * across
            scaled = rest / self._diagonal
            before, size = size, float((rest * scaled).sum())
            way = scaled + (size / before) * way
        return x


def _smoothstep(x: Floats) -> Floats:
    x = np.clip(x, 0.0, 1.0)
    return x * x * (3.0 - 2.0 * x)
