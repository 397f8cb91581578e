# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether two medial axes are the same to the last bit."""

from typing import Any

import numpy as np


def same_axis(a: Any, b: Any) -> bool:
    """Whether two `MedialAxis` have equal arrays, also in their levels and structures.

    What only the window shows, crumbs and ranges of sliders, is in no file and does not count.
    """
    if (a.level is None) != (b.level is None):
        return False
    if (a.structure is None) != (b.structure is None):
        return False
    parts = [(a, b), (a.level, b.level), (a.structure, b.structure)]
    pairs = [(one, other) for one, other in parts if one is not None]
    return all(
        np.array_equal(getattr(one, name), getattr(other, name))
        for one, other in pairs
        for name in one.__dataclass_fields__
        if name not in ("level", "structure", "crumb", "ranges")
    )
