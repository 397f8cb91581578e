# SPDX-License-Identifier: GPL-3.0-or-later
"""Bones are named by chain, from the root outwards, with .L or .R if a chain has a mirror image.

`limb.02.03.L` is the third bone of the second chain that ends in a tip, and `limb.02.03.R` is its mirror image in X;
chains between forks are called trunk. Left means positive X, as in Blender. No limb is guessed to be an arm or a leg.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..small_matrices import length_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .bones import Bones

SYMMETRIC = 0.02  # a mirror image may be off by this share of the size


def names_of(bones: Bones, centre: NDArray[np.float64]) -> list[str]:
    """Return a name for each bone.

    Parameters
    ----------
    bones : Bones
    centre : (3,) float64
        It lies on the mirror plane.
    """
    chains = [
        np.flatnonzero(bones.chain == chain) for chain in range(bones.chain.max(initial=-1) + 1)
    ]
    roots = [chain for chain in chains if bones.parent[chain[0]] < 0]
    names = [""] * bones.count
    for number, chain in enumerate(roots):
        names[chain[0]] = "root" if number == 0 else f"root.{number + 1:02d}"
    for word, to_tip in (("trunk", False), ("limb", True)):
        alike = [c for c in chains if bones.parent[c[0]] >= 0 and bones.to_tip[c[0]] == to_tip]
        for number, side, chain in _numbered(bones, alike, centre):
            for step, bone in enumerate(chain):
                names[bone] = f"{word}.{number:02d}.{step + 1:02d}{side}"
    return names


def _numbered(
    bones: Bones, chains: list[NDArray[np.intp]], centre: NDArray[np.float64]
) -> list[tuple[int, str, NDArray[np.intp]]]:
    """Return number, side and bones of each chain, sorted from top to bottom, then along Y.

    Mirror images have the same number.
    """
    ends = np.array([bones.tail[chain[-1]] for chain in chains]).reshape(-1, 3) - centre
    partner = _partners(bones, chains, centre)
    found, number = [], 0
    for index in np.lexsort((-ends[:, 0], ends[:, 1], -ends[:, 2])):
        other = partner[index]
        if other >= 0 and ends[index, 0] < 0.0:
            continue  # it is named together with its partner
        number += 1
        if other < 0:
            found.append((number, "", chains[index]))
        else:
            found += [(number, ".L", chains[index]), (number, ".R", chains[other])]
    return found


def _partners(
    bones: Bones, chains: list[NDArray[np.intp]], centre: NDArray[np.float64]
) -> NDArray[np.int64]:
    """Return the mirror image of each chain on the other side; it is -1 if there is none, or if there are several."""
    partner = np.full(len(chains), -1, np.int64)
    if not chains:
        return partner
    size = length_of(np.ptp(np.concatenate((bones.head, bones.tail)), axis=0))
    middles = np.array([_at_middle(bones, chain) for chain in chains]) - centre
    ends = np.array([bones.tail[chain[-1]] for chain in chains]) - centre
    mirror = np.array([-1.0, 1.0, 1.0])
    off = np.maximum(_distances(ends * mirror, ends), _distances(middles * mirror, middles))
    close = off <= SYMMETRIC * size
    aside = np.abs(ends[:, 0]) > SYMMETRIC * size
    for index in np.flatnonzero(aside):
        images = np.flatnonzero(close[index])
        if len(images) == 1 and close[:, index].sum() == 1 and close[images[0], index]:
            partner[index] = images[0]
    return partner


def _at_middle(bones: Bones, chain: NDArray[np.intp]) -> NDArray[np.float64]:
    """Return the point half-way along a chain."""
    joints = np.concatenate((bones.head[chain[:1]], bones.tail[chain]))
    marks = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(joints, axis=0), axis=1))))
    return np.array([np.interp(marks[-1] / 2, marks, joints[:, axis]) for axis in range(3)])


def _distances(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.linalg.norm(a[:, None] - b[None], axis=2)
