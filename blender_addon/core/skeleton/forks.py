# SPDX-License-Identifier: GPL-3.0-or-later
"""Where forks lie. Inside the ball at a fork the axis says little of where the limbs come from; what it says outside does."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .net import Net


def draw_forks(net: Net, samples: NDArray[np.float64]) -> None:
    pass
