# SPDX-License-Identifier: GPL-3.0-or-later
"""This module has the graph of branches between tips and forks, from which branches are removed."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from ..arrays import Flags, Floats, Ints, Longs


class Net:
    """A net is a graph in space: its nodes are tips, forks and single points, its branches are chains of points.

    Parameters
    ----------
    points : (p, 3) float64
    radius : (p,) float64
        The radius of the ball around each point.
    wires : (w, 2) integers
        Edges, rows of `points`.
    singles : (s,) integers
        Points without an edge.
    load : (p,) float64
        The share of the surface that each point owns. A point that is removed leaves its load to the point that it
        was attached to.
    anchored : iterable of int
        Points that something else holds, such as facets. They are nodes, and no tips.

    Attributes
    ----------
    branches : dict of int to list of int
        Rows of `points` from node to node. A loop without a fork starts and ends at its first point.
    at : dict of int to list of int
        The branches that end at each node; a branch that starts and ends there is listed twice.
    moved : (p,) int64
        The point that has replaced each point; points that remain map to themselves.
    kept : set of int
        Nodes that stay nodes, also where only two branches meet.
    """

    def __init__(
        self,
        points: Floats,
        radius: Floats,
        wires: Ints,
        singles: Ints,
        load: Floats,
        anchored: Iterable[int] = (),
    ) -> None:
        self.points, self.radius, self.load = points.copy(), radius.copy(), load.copy()
        self.branches: dict[int, list[int]] = {}
        self.at: dict[int, list[int]] = {int(row): [] for row in singles}
        self.moved = np.arange(len(points))
        self.kept: set[int] = set()
        self.anchored = set(anchored)
        self._held: dict[int, list[int]] = {}
        self._next = 0
        for chain in chains(wires, len(points), self.anchored):
            self.add(chain)

    # --- queries

    def tips(self) -> list[int]:
        """Return the nodes at which exactly one branch ends."""
        return [node for node in self.at if self._is_tip(node)]

    def leaves(self) -> list[int]:
        """Return the branches from a fork to a tip."""
        return [name for name in self.branches if len(self.ends_free(name)) == 1]

    def ends_free(self, name: int) -> list[int]:
        """Return the ends of a branch that are tips."""
        chain = self.branches[name]
        return [node for node in (chain[0], chain[-1]) if self._is_tip(node)]

    def _is_tip(self, node: int) -> bool:
        return len(self.at[node]) == 1 and node not in self.anchored

    def pieces(self) -> dict[int, int]:
        """Return {node: the first node of its connected piece}."""
        found: dict[int, int] = {}
        for first in self.at:
            left = [first]
            while left:
                if (node := left.pop()) not in found:
                    found[node] = first
                    left += [end for name in self.at[node] for end in self._ends(name)]
        return found

    def loops(self) -> int:
        """Return the number of independent loops."""
        return len(self.branches) - len(self.at) + len(set(self.pieces().values()))

    def _ends(self, name: int) -> tuple[int, int]:
        chain = self.branches[name]
        return chain[0], chain[-1]

    def length(self, name: int) -> float:
        """Return the length of a branch."""
        steps = np.diff(self.points[self.branches[name]], axis=0)
        return float(np.linalg.norm(steps, axis=1).sum())

    def from_fork(self, name: int) -> list[int]:
        """Return the points of a leaf from its fork to its tip."""
        chain = self.branches[name]
        return chain[::-1] if self._is_tip(chain[0]) else chain

    def limb(self, tip: int) -> tuple[int, list[int]]:
        """Return the branch that ends at a tip, and its points, of which the tip is the last one."""
        (name,) = self.at[tip]
        chain = self.branches[name]
        return name, chain if chain[-1] == tip else chain[::-1]

    def carried(self, name: int) -> float:
        """Return the load of a leaf without its fork."""
        return float(self.load[self.from_fork(name)[1:]].sum())

    def stands_for(self) -> Longs:
        """Return the remaining point that has replaced each point, (p,)."""
        target = self.moved
        while not np.array_equal(target, target[target]):
            target = target[target]
        return target

    def held(self, rows: Iterable[int]) -> list[int]:
        """Return some points and all points that they have replaced."""
        found, left = [], list(rows)
        while left:
            row = left.pop()
            found.append(row)
            left += self._held.get(row, ())
        return found

    # --- changes

    def add(self, chain: list[int]) -> int:
        """Add a branch along points, and return its name."""
        name, self._next = self._next, self._next + 1
        self.branches[name] = chain
        for node in (chain[0], chain[-1]):
            self.at.setdefault(node, []).append(name)
        return name

    def drop_leaf(self, name: int) -> None:
        """Remove a branch from a fork to a tip."""
        chain = self.from_fork(name)
        self._take(name)
        self._give(chain[1:], chain[0])
        del self.at[chain[-1]]
        self._join(chain[0])

    def shorten(self, name: int, kept: list[int]) -> None:
        """Leave the first points of a branch to a tip; the last one becomes the tip, and takes over the others."""
        gone = [row for row in self.branches[name] if row not in kept]
        self._take(name)
        self._give(gone, kept[-1])
        for row in gone:
            self.at.pop(row, None)
        self.add(kept)

    def end_at(self, name: int, kept: list[int], tip: int) -> None:
        """Lead a branch from its `kept` points straight to its tip, which takes over the points in between."""
        chain = self.branches[name]
        self._give([row for row in chain if row != tip and row not in kept], tip)
        way = [*kept, tip]
        self.branches[name] = way if chain[0] == way[0] else way[::-1]

    def insert(self, name: int, at: int, place: Floats, radius: float) -> int:
        """Add a point to a branch before the one at position `at`, which is not its first, and return its row."""
        row = len(self.points)
        self.points = np.concatenate((self.points, place[None]))
        self.radius, self.load = np.append(self.radius, radius), np.append(self.load, 0.0)
        self.moved = np.append(self.moved, row)
        chain = self.branches[name]
        self.branches[name] = [*chain[:at], row, *chain[at:]]
        return row

    def split(self, name: int, at: int) -> None:
        """Make the point at a position within a branch a node."""
        chain = self.branches[name]
        self._take(name)
        self.add(chain[: at + 1])
        self.add(chain[at:])

    def connect(self, first: int, second: int) -> None:
        """Add a branch between two points, which may lie within branches of different pieces."""
        for row in (first, second):
            if row not in self.at:
                name = next(name for name, chain in self.branches.items() if row in chain)
                self.split(name, self.branches[name].index(row))
        self.add([first, second])
        for row in (first, second):
            self._join(row)

    def absorb(self, single: int, row: int) -> None:
        """Remove a point without a branch; another one takes over what it owned."""
        del self.at[single]
        self._give([single], row)

    def open(self, name: int, at: int) -> None:
        """Remove the edge after a position on a branch of a loop; both halves stay, and end there."""
        self._divide(name, at + 1, at + 1)

    def remove(self, nodes: Iterable[int]) -> None:
        """Remove all branches at some nodes, and the nodes; nothing takes over what they owned."""
        for node in nodes:
            for name in list(self.at[node]):
                if name in self.branches:
                    self._take(name)
        for node in nodes:
            del self.at[node]

    def cut(self, name: int, neck: range) -> None:
        """Remove the points at some positions on a branch of a loop; their load goes to the ends of what is left."""
        chain = self.branches[name]
        first, after = max(neck.start, 1), min(neck.stop, len(chain) - 1)
        middle = max((first + after) // 2, first)
        self._give(chain[first:middle], chain[first - 1])
        self._give(chain[middle:after], chain[after])
        self._divide(name, first, after)

    def _divide(self, name: int, first: int, after: int) -> None:
        """Replace a branch by what lies before one position and from another one on; single points go."""
        chain = self.branches[name]
        self._take(name)
        for half in (chain[:first], chain[after:]):
            if len(half) > 1:
                self.add(half)
        for node in {chain[0], chain[-1]}:
            self._join(node)

    def contract(self, names: Iterable[int], centre: int) -> None:
        """Contract branches of a loop to one of their points; branches attached to them lead straight to it."""
        gone: set[int] = set()
        for name in names:
            gone.update(self.branches[name])
            self._take(name)
        self.at.setdefault(centre, [])
        for node in sorted(gone - {centre}):
            for name in list(self.at.pop(node, [])):
                self._lead(name, node, centre)
        self._give(sorted(gone - {centre}), centre)
        self._join(centre)

    def _lead(self, name: int, node: int, centre: int) -> None:
        """Move one end of a branch from a node to another one."""
        chain = self.branches[name]
        chain = chain[::-1] if chain[0] == node else chain
        self.branches[name] = [*chain[:-1], centre]
        self.at[centre].append(name)

    def _take(self, name: int) -> None:
        chain = self.branches.pop(name)
        for node in (chain[0], chain[-1]):
            self.at[node].remove(name)

    def _give(self, rows: list[int], target: int) -> None:
        self.load[target] += self.load[rows].sum()
        self.load[rows] = 0.0
        self.moved[rows] = target
        self._held.setdefault(target, []).extend(rows)

    def _join(self, node: int) -> None:
        """Merge the two branches that meet at a node, if it is no longer a fork."""
        names = self.at[node]
        if len(names) != 2 or names[0] == names[1] or node in self.kept | self.anchored:
            return
        first, second = (self.branches[name] for name in names)
        first = first if first[-1] == node else first[::-1]
        second = second if second[0] == node else second[::-1]
        for name in list(names):
            self._take(name)
        del self.at[node]
        self.add([*first, *second[1:]])


def chains(wires: Ints, count: int, ends: Iterable[int] = ()) -> list[list[int]]:
    """Return edges as chains between vertices whose degree is not 2, then as loops; both ascend by their start.

    Chains also end at the vertices `ends`.
    """
    inner = np.bincount(wires.ravel(), minlength=count) == 2
    inner[list(ends)] = False
    edges_at: list[list[tuple[int, int]]] = [[] for _ in range(count)]
    for edge, (a, b) in enumerate(wires.tolist()):
        edges_at[a].append((edge, b))
        edges_at[b].append((edge, a))
    used = np.zeros(len(wires), bool)
    return [
        _walked(start, edge, edges_at, inner, used)
        for start in (*np.flatnonzero(~inner).tolist(), *np.flatnonzero(inner).tolist())
        for edge, _ in edges_at[start]
        if not used[edge]
    ]


def _walked(
    start: int, edge: int, edges_at: list[list[tuple[int, int]]], inner: Flags, used: Flags
) -> list[int]:
    """Return the vertices from a vertex through an edge to the next node, or around a loop."""
    chain = [start]
    while True:
        used[edge] = True
        chain.append(next(end for name, end in edges_at[chain[-1]] if name == edge))
        if not inner[chain[-1]] or chain[-1] == start:
            return chain
        edge = next(name for name, _ in edges_at[chain[-1]] if name != edge)
