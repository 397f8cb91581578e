# SPDX-License-Identifier: GPL-3.0-or-later
"""The order in which loops and leaves of a net go that come from the sampling, kept as arrays over its edges."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import chain as joined
from itertools import islice, pairwise

import numpy as np

from ..arrays import Longs
from .loaded_net import LoadedNet
from .net import Net
from .rules import Loops, cut_loops, drop_leaves, fill_loops


@dataclass(frozen=True, eq=False)
class Removals:
    """The edges of a net while it loses one loop or leaf after the other."""

    edges: Longs  # (e, 2) Points of the net, the lower one first
    # (e,) Each edge is there after at least `born` and less than `gone` removals. Edges are born
    # where a loop is filled, because what was attached to the loop leads to its centre.
    born: Longs
    gone: Longs
    count: int  # The number of removals

    def after(self, number: int) -> Longs:
        """Return the edges after a number of removals, (w, 2)."""
        return self.edges[(self.born <= number) & (number < self.gone)]


def removals_of(loaded: LoadedNet, genuine: int, share: float) -> Removals:
    """Take a net apart as far as a skeleton needs it: limbs that touch, pinholes, then leaves that are no limbs.

    The net is changed; `genuine` and `share` are as in `clear_loops` and `drop_leaves`.
    """
    return recorded(loaded.net, joined.from_iterable(_steps(loaded, genuine, share)))


def take_apart(loaded: LoadedNet, genuine: int, share: float, number: int) -> Loops:
    """Do the first removals, as many as `number`, of those that `removals_of` records from the other parameters."""
    done: list[int] = []
    for steps in _steps(loaded, genuine, share):
        done.append(sum(1 for _ in islice(steps, number - sum(done))))
    cut, filled, _ = done
    return Loops(cut, filled)


def _steps(loaded: LoadedNet, genuine: int, share: float) -> Iterable[Iterator[None]]:
    net, spacing = loaded.net, loaded.spacing
    return (
        cut_loops(net, spacing, genuine),
        fill_loops(net, spacing, genuine),
        drop_leaves(net, share, loaded.balls),
    )


def recorded(net: Net, steps: Iterable[None]) -> Removals:
    """Record the edges of a net while steps change it."""
    there = dict.fromkeys(_pairs(net.branches.values()), 0)
    past: list[tuple[tuple[int, int], int, int]] = []
    before, count = dict(net.branches), 0
    for count, _ in enumerate(steps, 1):
        after = net.branches
        old = set(_pairs(c for name, c in before.items() if after.get(name) is not c))
        new = set(_pairs(c for name, c in after.items() if before.get(name) is not c))
        past += [(pair, there.pop(pair), count) for pair in sorted(old - new)]
        for pair in sorted(new - old):
            there.setdefault(pair, count)
        before = dict(after)
    past += [(pair, born, count + 1) for pair, born in there.items()]
    edges = np.array([pair for pair, _, _ in past], np.int64).reshape(-1, 2)
    born, gone = np.array([times for _, *times in past], np.int64).reshape(-1, 2).T
    return Removals(edges, born, gone, count)


def _pairs(chains: Iterable[list[int]]) -> Iterator[tuple[int, int]]:
    for chain in chains:
        yield from ((min(a, b), max(a, b)) for a, b in pairwise(chain) if a != b)
