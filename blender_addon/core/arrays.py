# SPDX-License-Identifier: GPL-3.0-or-later
"""Names for the kinds of arrays that functions take and return; their docstrings have the shapes and the units."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]
Longs = NDArray[np.int64]
Flags = NDArray[np.bool_]
