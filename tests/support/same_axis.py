# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether two medial axes are the same to the last bit."""

from typing import Any

import numpy as np


def same_axis(a: Any, b: Any) -> bool:
    """Whether two `MedialAxis` have equal arrays, also in their levels."""
    if (a.level is None) != (b.level is None):
        return False
    pairs = [(a, b)] if a.level is None else [(a, b), (a.level, b.level)]
    return all(
        np.array_equal(getattr(one, name), getattr(other, name))
        for one, other in pairs
        for name in one.__dataclass_fields__
        if name != "level"
    )
