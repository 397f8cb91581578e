# SPDX-License-Identifier: GPL-3.0-or-later
"""Keep what joins chosen ends: the branches that lie on ways between two of them that meet no point twice."""

from __future__ import annotations

from collections import Counter

import numpy as np

from ..arrays import Longs
from ..curves.ends import LAST
from ..curves.net import Net
from ..errors import InvalidInputError
from ..small_matrices import length_of


def join_ends(net: Net, rows: Longs) -> list[int]:
    """Remove all branches that do not join ends.

    Parameters
    ----------
    net : Net
    rows : (e,) int64
        The point of the net that owns the surface at each end; at least two.

    Returns
    -------
    tips : list of int
        Those of the ends that were tips before. Their limbs end where the surface does, the others where it was said.

    Raises
    ------
    InvalidInputError
        Ends are not those of different limbs.
    """
    found = [_end_at(net, row) for row in rows.tolist()]
    chosen = [node for node, _ in found]
    _check_different(chosen)
    net.kept.update(chosen)  # a fork may lose its limbs one after the other
    _remove_other_pieces(net, set(chosen))
    _drop_leaves(net, set(chosen))
    while (hanging := _hanging(net, set(chosen))) is not None:
        net.contract(*hanging)
    for number, node in enumerate(chosen):
        if len(net.at.get(node, ())) != 1:
            raise InvalidInputError(
                f"Expected ends of limbs, found that end {number + 1} lies between others or has no limb of its own; "
                "leave it out, choose a place nearer to the tip, or raise Detail"
            )
    return [node for node, was_tip in found if was_tip]


def _check_different(chosen: list[int]) -> None:
    number, count = Counter(chosen).most_common(1)[0]
    if count > 1:
        first, second = [n + 1 for n, node in enumerate(chosen) if node == number][:2]
        raise InvalidInputError(
            f"Expected ends of different limbs, found ends {first} and {second} at the same one; leave one out"
        )


def _end_at(net: Net, row: int) -> tuple[int, bool]:
    """Return the node for a row, made where the row lies within a branch, and whether it is a tip."""
    if row in net.at:
        return row, len(net.at[row]) == 1
    name = next(name for name, chain in net.branches.items() if row in chain)
    chain = net.branches[name]
    tips = [(_way(net, chain, row, tip), tip) for tip in net.ends_free(name)]
    if tips and min(tips)[0] <= LAST * net.radius[row]:
        return min(tips)[1], True
    net.split(name, chain.index(row))
    return row, False


def _way(net: Net, chain: list[int], row: int, tip: int) -> float:
    """Return the length of a branch from a row to its end."""
    at = chain.index(row)
    part = chain[at:] if chain[-1] == tip else chain[: at + 1]
    steps = np.diff(net.points[part], axis=0)
    return float(sum(length_of(step) for step in steps))


def _remove_other_pieces(net: Net, chosen: set[int]) -> None:
    """Remove connected parts without an end; one end alone joins nothing."""
    left = set(net.at)
    while left:
        piece = _reached(net, min(left), None)
        left -= piece
        if len(piece & chosen) == 1:
            raise InvalidInputError(
                "Expected at least two ends in each connected part, found one alone; add another one, or leave it out"
            )
        if not piece & chosen:
            net.remove(piece)


def _drop_leaves(net: Net, chosen: set[int]) -> None:
    """Remove limbs that end elsewhere, from their tips inwards."""
    left = [tip for tip in net.tips() if tip not in chosen]
    while left:
        tip = left.pop()
        (name,) = net.at[tip]
        chain = net.branches[name]
        node = chain[0] if chain[-1] == tip else chain[-1]
        net.contract([name], node)
        if node not in chosen and len(net.at.get(node, ())) == 1:
            left.append(node)


def _hanging(net: Net, chosen: set[int]) -> tuple[list[int], int] | None:
    """Return branches that hang on a node and lead to no end, and the node; or None."""
    for node in sorted(net.at):
        away = [name for name in net.at[node] if net.branches[name][0] == net.branches[name][-1]]
        if away:
            return sorted(set(away)), node
        for name in net.at[node]:
            chain = net.branches[name]
            beyond = _reached(net, chain[-1] if chain[0] == node else chain[0], node)
            if not beyond & chosen:
                return sorted({name for other in beyond for name in net.at[other]}), node
    return None


def _reached(net: Net, start: int, without: int | None) -> set[int]:
    """Return the nodes that are connected to a node, also where another one is taken away."""
    found, left = {start}, [start]
    while left:
        for name in net.at[left.pop()]:
            chain = net.branches[name]
            new = {chain[0], chain[-1]} - found - {without}
            found |= new
            left += new
    return found
