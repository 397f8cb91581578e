# SPDX-License-Identifier: GPL-3.0-or-later
"""The one colour scale of all results.

It goes from blue over red to yellow. Its brightness rises all the way, so the order is visible without colour vision.
Both ends differ from the greys of Blender's dark and light viewports.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arrays import Floats
from ..portable_angle import cosine

# Positions and linear RGB; colours in between are interpolated, as in a colour ramp of Blender.
SCALE = (
    (0.0, (0.05, 0.15, 1.0)),
    (0.25, (0.36, 0.11, 0.91)),
    (0.5, (0.87, 0.09, 0.26)),
    (0.75, (1.0, 0.3, 0.05)),
    (1.0, (1.0, 0.81, 0.07)),
)
_GOLDEN = (5**0.5 - 1.0) / 2.0  # multiples are spread evenly over a circle; work: shown
UNKNOWN = (0.25, 0.25, 0.25)  # the colour of NaN


def colours(values: ArrayLike, start: float, end: float) -> NDArray[np.float32]:
    """Return linear RGBA of (n,) numbers, (n, 4): blue at `start`, yellow at `end`, and the nearer of both outside.

    `start` may be the larger one. Where both are equal, every number gets the colour of the start. NaN is grey.
    """
    share = _shares(np.asarray(values, np.float64), start, end)
    positions = [position for position, _ in SCALE]
    result = np.ones((len(share), 4), np.float32)
    for channel in range(3):
        result[:, channel] = np.interp(share, positions, [rgb[channel] for _, rgb in SCALE])
    result[np.isnan(share), :3] = UNKNOWN
    return result


def part_colours(parts: ArrayLike) -> NDArray[np.float32]:
    """Return colours for numbers of parts, (n, 4) linear RGBA: numbers next to each other differ much."""
    hue = np.asarray(parts, np.float64)[:, None] * _GOLDEN + np.array([0.0, 2.0, 1.0]) / 3.0
    shade = 1.0 - 0.25 * (np.asarray(parts) % 3)[:, None]
    result = np.ones((len(hue), 4), np.float32)
    result[:, :3] = shade * (0.08 + 0.82 * (0.5 + 0.5 * cosine(2.0 * np.pi * hue)) ** 2)
    return result


def radius_range(radii: Sequence[float] | NDArray) -> tuple[float, float]:
    """Return (start, end) of the colour scale for radii: all of them, but at least half of the largest radius.

    So an axis whose radii hardly differ, as in a tube, has one colour and does not show the noise of its samples. It
    starts at the largest, because thin places are warm here as in pictures of thickness.
    """
    largest = float(np.max(radii))
    return largest, min(float(np.min(radii)), largest / 2)


def _shares(values: Floats, start: float, end: float) -> Floats:
    """Return the positions of numbers between start (0) and end (1), (n,); 0 or 1 outside."""
    if start == end:
        return np.where(np.isnan(values), np.nan, 0.0)
    with np.errstate(over="ignore"):
        return np.clip((values - start) / (end - start), 0.0, 1.0)
