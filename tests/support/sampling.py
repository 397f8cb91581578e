# SPDX-License-Identifier: GPL-3.0-or-later
"""Seeded maximal Poisson-disc samples: no two samples closer than a radius, no room for another one.

Greedy dart throwing in random order, restated as rounds over a neighbour graph so that NumPy can run it:
a dart is taken when it is the first, in random order, among its undecided neighbours.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

Array = NDArray[np.float64]
Candidates = Callable[[int, np.random.Generator], Array]

JAMMED = (
    0.68  # samples x radius^2 / area after 60 darts per sample (a saturated packing has 0.6965)
)


def poisson_disc(
    candidates: Candidates, area: float, n: int, seed: int, tolerance: float = 0.01
) -> Array:
    """About `n` samples (within `tolerance`) of the surface whose area-uniform points `candidates` throws."""
    radius = np.sqrt(JAMMED * area / n)
    for attempt in range(8):
        points = saturate(candidates, n, radius, np.random.default_rng((seed, attempt)))
        if abs(len(points) - n) <= tolerance * n:
            break
        radius *= np.sqrt(len(points) / n)
    return points


def saturate(
    candidates: Candidates,
    n: int,
    radius: float,
    rng: np.random.Generator,
    shares: tuple[int, ...] = (4, 8, 16, 30),
) -> Array:
    """60 n darts: then a hole, if any is left, is too small to matter (covering radius about 1.1 x radius at most).

    `shares` are the rounds of darts after the first 2 n, in n each.
    """
    points = thin(candidates(2 * n, rng), radius)
    for share in shares:
        batch = candidates(share * n, rng)
        gap, _ = cKDTree(points).query(batch, distance_upper_bound=radius)
        points = np.concatenate((points, thin(batch[np.isinf(gap)], radius)))
    return points


def thin(points: Array, radius: float) -> Array:
    """The greedy subset of points, first come first served, with pairwise distances >= radius."""
    pairs = cKDTree(points).query_pairs(radius, output_type="ndarray")
    taken = np.zeros(len(points), dtype=bool)
    waiting = np.ones(len(points), dtype=bool)
    while waiting.any():
        first = waiting.copy()
        first[pairs.max(axis=1)] = False  # somebody earlier is still undecided
        taken |= first
        waiting &= ~first
        a, b = pairs[:, 0], pairs[:, 1]
        waiting[b[taken[a]]] = False
        waiting[a[taken[b]]] = False
        pairs = pairs[waiting[a] & waiting[b]]
    return points[taken]
