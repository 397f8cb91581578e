# SPDX-License-Identifier: GPL-3.0-or-later
"""Items that pairs connect."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


def united(count: int, pairs: NDArray[np.integer]) -> NDArray[np.int64]:
    """(count,) the smallest item that (p, 2) pairs connect each item with, maybe by way of others."""
    label = np.arange(count)
    while True:
        found = label.copy()
        lowest = label[pairs].min(axis=1, initial=count)
        for end in pairs.T:
            np.minimum.at(found, end, lowest)
        found = found[found]
        if np.array_equal(found, label):
            return label
        label = found
