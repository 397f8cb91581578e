# SPDX-License-Identifier: GPL-3.0-or-later
"""The colours of thickness: red at the limit, towards yellow below it, blue from three times the limit, grey where
there is no length."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .measurement import Measurement

BLUE = 3.0  # times the limit


def colour_limits(found: Measurement, limit: float) -> tuple[float, float]:
    """(start, end) for `colours`, which is red half-way; without a limit the minimum stands for it."""
    red = limit if limit > 0.0 else found.minimum
    if not np.isfinite(red):
        red = 1.0  # nothing has a length, so every place is grey
    return limits_of(red)


def limits_of(red: float) -> tuple[float, float]:
    """The same, where it is known what is red."""
    return BLUE * red, (2.0 - BLUE) * red


def coloured(lengths: NDArray[np.float64]) -> NDArray[np.float64]:
    """Lengths as `colours` takes them: NaN where there is none."""
    return np.where(np.isfinite(lengths), lengths, np.nan)
