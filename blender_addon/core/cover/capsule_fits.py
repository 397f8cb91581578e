# SPDX-License-Identifier: GPL-3.0-or-later
"""Radii of capsules round segments in a solid, as `capsule_fit.cpp` will find them, for many segments at once."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..arrays import Flags, Floats
from ..machine.native import own_errors
from ..small_matrices import dot, length_of

_STEPS = 32  # between places of a segment whose depths are looked at
_SMALLER = 1 / 256  # of the larger radius: a capsule may be drawn in so far; derived: kOfRadius
_LARGER = 1.05  # than a ball at its end: as large, it may become that ball; chosen: unseen
_MANY = 4096  # segments at once


def gaps(places: Floats, ends: Floats, radii: Floats) -> Floats:
    """Return the distances of (n, 3) places from one capsule, (2, 3) and (2,), negative in it."""
    along, rise = ends[1] - ends[0], radii[1] - radii[0]
    length, away = length_of(along), places - ends[0]
    if length <= abs(rise):
        thick = int(rise > 0.0)
        from_ball = places - ends[thick]
        return np.asarray(np.sqrt(dot(from_ball, from_ball)) - radii[thick])
    at = dot(away, along) / length
    aside = np.sqrt(np.maximum(dot(away, away) - at * at, 0.0))
    slope = rise / length
    share = np.clip((at + slope * aside / np.sqrt(1.0 - slope * slope)) / length, 0.0, 1.0)
    off = away - share[:, None] * along
    return np.asarray(np.sqrt(dot(off, off)) - (radii[0] + share * rise))


def fitting_radii(
    ends: Floats, surface: Any, tapered: bool, progress: Any | None = None
) -> tuple[Floats, Flags]:
    """Return radii of capsules in a solid, (n, 2), and whether each is worth more than the balls at its ends, (n,).

    The segments are (n, 2, 3), in the solid, whose boundary is a `TriangleTree`. Tapered ones may have two radii.
    """
    parts = np.array_split(ends, max(1, -(-len(ends) // _MANY)))
    found = [_fitting(_depths(part, surface, progress), part, tapered) for part in parts]
    radii, fits = zip(*found, strict=True)
    return np.concatenate(radii), np.concatenate(fits)


def _depths(ends: Floats, surface: Any, progress: Any | None) -> Floats:
    """Return the distances from the surface at even places of each segment, (n, 33)."""
    share = np.linspace(0.0, 1.0, _STEPS + 1)[:, None]
    places = (1.0 - share) * ends[:, 0, None] + share * ends[:, 1, None]
    with own_errors():
        away = surface.distances(places.reshape(-1, 3), progress=progress)
    return np.asarray(away).reshape(len(ends), -1)


def _fitting(depths: Floats, ends: Floats, tapered: bool) -> tuple[Floats, Flags]:
    """Return what `fitting_radii` does.

    A place where a segment crosses the surface is nearer than half a step to one that is looked at. A radius of more
    than that shows that it crosses none.
    """
    along = ends[:, 1] - ends[:, 0]
    length = np.sqrt(dot(along, along))
    least = depths.min(axis=1)
    radii = np.column_stack([least, least])
    if tapered:
        lines = _highest_below(depths)
        larger = (lines >= 0.0).all(axis=1) & (_volume(length, lines) > _volume(length, radii))
        radii[larger] = lines[larger]
    radii = radii - _SMALLER * radii.max(axis=1)[:, None]
    thick = np.maximum(depths[:, 0], depths[:, -1])
    ball = _volume(np.zeros(len(thick)), np.column_stack([thick, thick]))
    whole = (least > length / (2 * _STEPS)) & (radii >= 0.0).all(axis=1)
    return radii, whole & (_volume(length, radii) > _LARGER * ball)


def _highest_below(depths: Floats) -> Floats:
    """Return the values at both ends, (n, 2), of the lines below all depths that are highest in the middle.

    Such a line touches the chord between a place before the middle and one after it that is lowest there.
    """
    half = _STEPS // 2
    share = np.linspace(0.0, 1.0, _STEPS + 1)
    first, second = share[:half, None], share[None, half + 1 :]
    part = (0.5 - first) / (second - first)
    middle = (1.0 - part) * depths[:, :half, None] + part * depths[:, None, half + 1 :]
    lowest = middle.reshape(len(depths), -1).argmin(axis=1)
    i, j = lowest // half, half + 1 + lowest % half
    row = np.arange(len(depths))
    slope = (depths[row, j] - depths[row, i]) / (share[j] - share[i])
    line = depths[row, i] - slope * share[i]
    above = (line[:, None] + slope[:, None] * share - depths).max(axis=1)  # the depth in the middle
    line -= np.maximum(above, 0.0)
    return np.column_stack([line, line + slope])


def _volume(length: Floats, radii: Floats) -> Floats:
    """Return volumes as `Capsule::volume` has them, over pi / 3."""
    p, q = radii.T
    thick = np.maximum(p, q)
    between = length * (p * p + p * q + q * q) + 2.0 * (p * p * p + q * q * q)
    return np.where(np.abs(p - q) < length, between, 4.0 * thick * thick * thick)
