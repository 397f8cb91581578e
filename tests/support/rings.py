# SPDX-License-Identifier: GPL-3.0-or-later
"""From a truth value per Delaunay cell to one per facet: a facet is dual to an edge and has the cells round it."""

from itertools import combinations

import numpy as np
from numpy.typing import NDArray


def facet_sides(
    cells: NDArray[np.int32], inside: NDArray[np.bool_]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """(e, 2) Delaunay edges in lexicographic order and (e,) 1: every cell round it is inside; 2: none; 3: some."""
    pairs = [np.sort(cells[:, [i, j]], axis=1) for i, j in combinations(range(4), 2)]
    ends, inner = np.concatenate(pairs).astype(np.int64), np.tile(inside, 6)
    finite = ends[:, 0] >= 0
    edges, row, count = np.unique(ends[finite], axis=0, return_inverse=True, return_counts=True)
    found = np.bincount(row, inner[finite])
    return edges, np.where(found == count, 1, np.where(found == 0, 2, 3))
