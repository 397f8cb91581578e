# SPDX-License-Identifier: GPL-3.0-or-later
"""Vertices get weights of the bones on the branch to which they belong.

A vertex follows the bone next to it. Near a joint within a chain the two bones share the vertices. At the rim of the
part of a limb and its descendants, vertices follow the parent bone of the limb: so the weights are continuous, and no
limb moves the skin of another one.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .spread import Graph, graph_of, spread

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .bones import Bones
    from .parts import Places

MOST = 4  # a vertex follows at most so many bones
_SMOOTHED = 2  # the weights are averaged with those of the neighbours so many times


def axis_weights(
    bones: Bones, places: Places, vertices: NDArray[np.float64], edges: NDArray[np.int32]
) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
    """Compute the weights of vertices.

    Parameters
    ----------
    bones : Bones
        There is at least one.
    places : Places
        The places of the vertices on the branches.
    vertices : (v, 3) float64
    edges : (e, 2) int32
        The edges between the vertices.

    Returns
    -------
    bone : (v, 4) int32
    weight : (v, 4) float64
        The weights of a vertex are not negative and add up to 1, and the largest is first.
    """
    weight = np.zeros((len(vertices), bones.count))
    chain = _along_branches(weight, bones, places)
    _to_nearest(weight, chain, bones, vertices)
    graph = graph_of(vertices, edges)
    _share_with_parents(weight, chain, bones, vertices, edges)
    for _ in range(_SMOOTHED):
        _smooth(weight, graph)
    bone = np.argsort(-weight, axis=1, kind="stable")[:, :MOST]
    found = np.take_along_axis(weight, bone, axis=1)
    missing = MOST - bone.shape[1]
    if missing > 0:
        bone, found = (np.pad(x, ((0, 0), (0, missing))) for x in (bone, found))
    return bone.astype(np.int32), found / found.sum(axis=1, keepdims=True)


def edges_of(triangles: NDArray[np.int32]) -> NDArray[np.int32]:
    """Return the edges of triangles, each once, (e, 2)."""
    pairs = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    return np.unique(pairs, axis=0)


def _along_branches(weight: NDArray[np.float64], bones: Bones, places: Places) -> NDArray[np.int64]:
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
    weight: NDArray[np.float64],
    bones: Bones,
    places: Places,
    before: int,
    after: int,
    length: NDArray[np.float64],
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


def _to_nearest(
    weight: NDArray[np.float64],
    chain: NDArray[np.int64],
    bones: Bones,
    vertices: NDArray[np.float64],
) -> None:
    """Let vertices of parts without a branch follow the bone whose middle is nearest."""
    middle = (bones.head + bones.tail) / 2
    for row in np.flatnonzero(chain < 0):
        bone = int(np.argmin(np.linalg.norm(middle - vertices[row], axis=1)))
        weight[row, bone], chain[row] = 1.0, bones.chain[bone]


def _share_with_parents(
    weight: NDArray[np.float64],
    chain: NDArray[np.int64],
    bones: Bones,
    vertices: NDArray[np.float64],
    edges: NDArray[np.int32],
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


def _rim(
    here: NDArray[np.bool_], vertices: NDArray[np.float64], edges: NDArray[np.int32], width: float
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
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


def _first_bones(bones: Bones) -> NDArray[np.int64]:
    """Return the first bone of each chain, (chains,)."""
    first = np.zeros(bones.chain.max() + 1, np.int64)
    first[bones.chain[::-1]] = np.arange(bones.count)[::-1]
    return first


def _all_below(name: int, bones: Bones, first: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Return a mask, (chains,), of a chain and its descendants."""
    found = np.zeros(len(first), bool)
    found[name] = True
    for other in range(name + 1, len(first)):
        above = bones.parent[first[other]]
        found[other] = above >= 0 and found[bones.chain[above]]
    return found


def _smooth(weight: NDArray[np.float64], graph: Graph) -> None:
    """Replace each weight by half of itself plus half the mean of the neighbours; the sum of each vertex stays."""
    count = np.diff(graph.first)
    joined = np.flatnonzero(count)
    if not len(joined):
        return
    for bone in range(weight.shape[1]):
        column = weight[:, bone]
        if column.any():
            total = np.add.reduceat(column[graph.to], graph.first[joined])
            weight[joined, bone] = (column[joined] + total / count[joined]) / 2


def _smoothstep(x: NDArray[np.float64]) -> NDArray[np.float64]:
    x = np.clip(x, 0.0, 1.0)
    return x * x * (3.0 - 2.0 * x)
