# SPDX-License-Identifier: GPL-3.0-or-later
"""Bridges of a graph are the branches on no loop (Tarjan 1974)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping


def on_loops(ends: Mapping[int, tuple[int, int]], at: Mapping[int, Iterable[int]]) -> list[int]:
    """Return the branches on loops, in order: all but the bridges.

    Parameters
    ----------
    ends : {branch: its two nodes}
    at : {node: the branches that end there}
        A branch that starts and ends there is listed twice.
    """
    depth: dict[int, int] = {}
    lowest: dict[int, int] = {}
    bridges: set[int] = set()
    for root in at:
        if root not in depth:
            _search(ends, at, root, depth, lowest, bridges)
    return [name for name in ends if name not in bridges]


def _search(
    ends: Mapping[int, tuple[int, int]],
    at: Mapping[int, Iterable[int]],
    root: int,
    depth: dict[int, int],
    lowest: dict[int, int],
    bridges: set[int],
) -> None:
    """Search depth-first for bridges: no branch beyond a bridge leads back to its start or above."""
    depth[root] = lowest[root] = 0
    stack = [(root, -1, iter(at[root]))]
    while stack:
        node, through, names = stack[-1]
        name = next(names, None)
        if name is None:
            stack.pop()
            if stack:
                above = stack[-1][0]
                lowest[above] = min(lowest[above], lowest[node])
                if lowest[node] > depth[above]:
                    bridges.add(through)
        elif name != through:
            first, last = ends[name]
            other = last if first == node else first
            if other in depth:
                lowest[node] = min(lowest[node], depth[other])
            else:
                depth[other] = lowest[other] = depth[node] + 1
                stack.append((other, name, iter(at[other])))
