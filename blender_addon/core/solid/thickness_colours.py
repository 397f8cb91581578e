# SPDX-License-Identifier: GPL-3.0-or-later
"""The colours of thickness: red at the limit, towards yellow below it, blue from three times the limit on.

Places without a length are grey.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .measurement import Measurement

BLUE = 3.0  # the multiple of the limit from which on colours are blue


def colour_limits(found: Measurement, limit: float) -> tuple[float, float]:
    """Return (start, end) for `colours`, which is red half-way; without a limit the minimum replaces it."""
    red = limit if limit > 0.0 else found.minimum
    if not np.isfinite(red):
        red = 1.0  # no place has a length, so all places are grey
    return limits_of(red)


def limits_of(red: float) -> tuple[float, float]:
    """Return (start, end) for the length that is red."""
    return BLUE * red, (2.0 - BLUE) * red


def coloured(lengths: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return lengths as `colours` takes them: NaN where there is none."""
    return np.where(np.isfinite(lengths), lengths, np.nan)
