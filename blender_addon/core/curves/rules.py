# SPDX-License-Identifier: GPL-3.0-or-later
"""These rules remove loops and branches that come from the sampling and not from the solid.

There are two rules for loops and one for branches:

- A loop is *cut* at its thinnest branch if that is thinner than two sample spacings: two limbs touch there. Only the
  thin part of the branch goes where limbs end at it.
- A loop is *filled*, that is contracted to its largest ball, if it lies within one spacing of that ball: it goes around
  a pinhole.

  Closed faces say how many loops the solid has; as many are kept, however thin they are.
- A leaf is removed, the lightest first, if it hardly reaches out of the ball at its fork, or owns too small a share of
  the surface: it is a ridge of a plate or a terrace, and not a limb. The farther a leaf reaches, the less surface it
  needs.
"""

from __future__ import annotations

import heapq
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..arrays import Floats
from ..small_matrices import length_of
from .bridges import on_loops
from .ends import Balls, reach_of
from .net import Net

THIN = 2.0  # a loop is cut if it is thinner than this many spacings; chosen: unseen
REACH = 1.6  # radii of the ball at its fork: a limb reaches so far from its centre; measured: lab/quality_skeleton.md


@dataclass(frozen=True)
class Loops:
    """These are the numbers of small loops that were cut and filled."""

    cut: int
    filled: int


def clear_loops(net: Net, spacing: Floats, genuine: int = 0) -> Loops:
    """Cut and fill the small loops, the thinnest first.

    The (p,) spacing is that of the samples around each point. At least `genuine` loops are kept.
    """
    cut = sum(1 for _ in cut_loops(net, spacing, genuine))
    return Loops(cut, sum(1 for _ in fill_loops(net, spacing, genuine)))


def cut_loops(net: Net, spacing: Floats, genuine: int) -> Iterator[None]:
    """Cut a loop of limbs that touch at each step, the thinnest first; the arguments are those of `clear_loops`."""
    while net.loops() > genuine and (name := _thinnest_of_loops(net, spacing)) is not None:
        net.cut(name, _neck(net, name, spacing))
        yield


def _neck(net: Net, name: int, spacing: Floats) -> range:
    """Return the positions on a branch that go: those around its thinnest one that are thinner than THIN.

    What is left of the branch goes as well where it hardly leaves the ball at its node, as half a rung does.
    """
    rows = net.branches[name]
    thickness = net.radius[rows] / spacing[rows]
    thick = np.flatnonzero(thickness >= THIN)
    place = int(np.searchsorted(thick, int(thickness.argmin())))
    before, after = thick[:place].tolist()[-1:], thick[place:].tolist()[:1]
    return range(
        next((at + 1 for at in before if _leaves_ball(net, rows[0], rows[at])), 0),
        next((at for at in after if _leaves_ball(net, rows[-1], rows[at])), len(rows)),
    )


def _leaves_ball(net: Net, node: int, tip: int) -> bool:
    """Return whether the ball of a tip reaches as far from a node as that of a limb."""
    reach = length_of(net.points[tip] - net.points[node]) + net.radius[tip]
    return bool(reach >= REACH * net.radius[node])


def fill_loops(net: Net, spacing: Floats, genuine: int) -> Iterator[None]:
    """Fill a pinhole at each step; the arguments are those of `clear_loops`."""
    while net.loops() > genuine and (found := _pinhole(net, spacing)) is not None:
        net.contract(*found)
        yield


def open_loops(net: Net) -> None:
    """Open each loop where it is thinnest; both ends stay."""
    while names := _on_loops(net):
        net.open(*min(_thinnest_edge(net, name) for name in names)[1:])


def _thinnest_edge(net: Net, name: int) -> tuple[float, int, int]:
    """Return the radius at the thinnest edge of a branch, the branch, and the position before the edge.

    Edges at its ends count only where it has no others, because an end of a single point is none.
    """
    radius = net.radius[net.branches[name]]
    mean = (radius[:-1] + radius[1:]) / 2.0
    inner = mean[1:-1] if len(mean) > 2 else mean
    at = int(np.argmin(inner)) + (len(mean) > 2)
    return float(mean[at]), name, at


def prune(net: Net, share: float, balls: Balls) -> None:
    """Remove the leaves that are not limbs, the lightest first; the arguments are those of `drop_leaves`."""
    for _ in drop_leaves(net, share, balls):
        pass


def drop_leaves(net: Net, share: float, balls: Balls) -> Iterator[None]:
    """Remove a leaf that is not a limb at each step, the lightest first.

    A limb that just reaches out owns at least this share of the surface; the farther a limb reaches, the less. The
    balls are those of the samples, by the points that own them.
    """
    queue = [(net.carried(name), name) for name in net.leaves()]
    heapq.heapify(queue)
    while queue:
        load, name = heapq.heappop(queue)
        if name not in net.branches or len(net.ends_free(name)) != 1:
            continue
        if net.carried(name) > load:  # the leaf has grown since
            heapq.heappush(queue, (net.carried(name), name))
        elif not is_limb(net, name, share, balls):
            before = set(net.branches)
            net.drop_leaf(name)
            for new in net.branches.keys() - before:
                if len(net.ends_free(new)) == 1:
                    heapq.heappush(queue, (net.carried(new), new))
            yield


def join_tips(net: Net) -> None:
    """Remove the lighter one of two limbs from one fork whose ends lie in each other's balls: nothing parts them."""
    for name in sorted(net.leaves(), key=net.carried):
        if name in net.branches and _has_twin(net, name):
            net.drop_leaf(name)


def _has_twin(net: Net, name: int) -> bool:
    fork, *_, tip = net.from_fork(name)
    others = [other for other in net.at[fork] if other != name and len(net.ends_free(other)) == 1]
    ends = np.array([net.from_fork(other)[-1] for other in others], np.int64)
    away = np.linalg.norm(net.points[ends] - net.points[tip], axis=1)
    return bool((away < np.minimum(net.radius[ends], net.radius[tip])).any())


def join_forks(net: Net) -> None:
    """Merge two forks if the branch between them is shorter than half the radius of the smaller of their balls."""
    while (name := _shortest_between_forks(net)) is not None:
        chain = net.branches[name]
        net.contract([name], max(chain, key=lambda row: (net.radius[row], -row)))


def _shortest_between_forks(net: Net) -> int | None:
    found = []
    for name, chain in net.branches.items():
        between = [other for other in net.at[chain[0]] if other in net.at[chain[-1]]]
        if (
            between == [name]
            and not net.ends_free(name)
            and net.length(name) < min(net.radius[chain[0]], net.radius[chain[-1]]) / 2
        ):
            found.append((net.length(name), name))
    return min(found)[1] if found else None


def is_limb(net: Net, name: int, share: float, balls: Balls) -> bool:
    """Return whether a leaf reaches out of the ball at its fork, and owns enough of the surface for its reach."""
    reach = reach_of(net, name, balls)
    needed = REACH * net.radius[net.from_fork(name)[0]]
    return bool(reach >= needed and net.carried(name) * reach >= share * needed)


# --- loops


def _thinnest_of_loops(net: Net, spacing: Floats) -> int | None:
    """Return the branch of a loop with the thinnest neck in spacings, or None if no neck is thinner than THIN."""
    necks = []
    for name in _on_loops(net):
        rows = net.branches[name]
        neck = float((net.radius[rows] / spacing[rows]).min())
        if neck < THIN:
            necks.append((neck, name))
    return min(necks)[1] if necks else None


def _pinhole(net: Net, spacing: Floats) -> tuple[list[int], int] | None:
    """Return the branches of a loop within one spacing of its largest ball, and the point of that ball; or None."""
    for name in _on_loops(net):
        loop = _shortest_loop(net, name)
        rows = np.unique(np.concatenate([net.branches[branch] for branch in loop]))
        centre = int(rows[np.argmax(net.radius[rows])])
        reach = np.linalg.norm(net.points[rows] - net.points[centre], axis=1)
        if (
            net.anchored.isdisjoint(rows.tolist())
            and (reach <= net.radius[centre] + spacing[centre]).all()
        ):
            return loop, centre
    return None


def _on_loops(net: Net) -> list[int]:
    ends = {name: (chain[0], chain[-1]) for name, chain in net.branches.items()}
    return on_loops(ends, net.at)


def _shortest_loop(net: Net, name: int) -> list[int]:
    """Return the branches of the shortest loop through the named branch, which comes first."""
    start, goal = net.branches[name][0], net.branches[name][-1]
    came: dict[int, tuple[int, int]] = {}
    done: set[int] = set()
    queue = [(0.0, start, -1, -1)]
    while queue:
        so_far, node, before, through = heapq.heappop(queue)
        if node in done:
            continue
        done.add(node)
        came[node] = (before, through)
        if node == goal:
            break
        for other in net.at[node]:
            if other != name:
                chain = net.branches[other]
                end = chain[-1] if chain[0] == node else chain[0]
                heapq.heappush(queue, (so_far + net.length(other), end, node, other))
    loop, node = [name], goal
    while node != start:
        node, through = came[node]
        loop.append(through)
    return loop
