# SPDX-License-Identifier: GPL-3.0-or-later
"""Items that pairs connect."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .arrays import Longs


def united(count: int, pairs: NDArray[np.integer]) -> Longs:
    """Return the smallest item that (p, 2) pairs connect each item with, (count,), maybe by way of others.

    Each item that stands for others goes to a smaller one, if a pair leads there; pairs shrink to those between such
    items, so few rounds suffice also along chains.
    """
    label = np.arange(count)
    while len(pairs):
        np.minimum.at(label, pairs.max(axis=1), pairs.min(axis=1))
        while not np.array_equal(further := label[label], label):
            label = further
        pairs = label[pairs]
        pairs = pairs[pairs[:, 0] != pairs[:, 1]]
    return label
