# SPDX-License-Identifier: GPL-3.0-or-later
"""Polygons of sheets whose borders cross themselves, and where they do."""

from __future__ import annotations

import numpy as np

from ..arrays import Flags, Floats, Ints
from ..shape.triangles import unit_normals
from ..small_matrices import dot, length_of, summed
from .sheet_faces import TRIFLE, SheetFaces

_NOTHING = 1e-9  # of all area: so small a polygon has none; derived: rounding
_TOUCHES = 2.0**-16  # of the extent: corners are so far from their plane; derived: kNoDistance


def crossings(faces: SheetFaces) -> tuple[Floats, Ints]:
    """Find where the borders of polygons cross themselves.

    Returns
    -------
    places : (k, 3) float64
        Where the triangles of a polygon overlap although its sides do not cross, also those where its sides touch, or
        else all of its corners.
    part : (k,) int32
        The sheet of each.
    """
    normals, doubled = unit_normals(faces.vertices[faces.triangles])
    overlap = _overlap(faces, normals, doubled)
    across = summed(faces.of, np.abs(normals) * doubled[:, None], len(faces.part))
    step = _TOUCHES * length_of(np.ptp(faces.vertices, axis=0))
    places, part = [np.zeros((0, 3))], [np.zeros(0, np.int32)]
    for face in np.flatnonzero(np.diff(faces.offsets) > 3):
        ring = faces.ring(face)
        flat = np.delete(ring - ring[0], across[face].argmax(), axis=1)
        found = _crossings_of(ring, flat, step, touching=False)
        if overlap[face] and not len(found):
            found = _crossings_of(ring, flat, step, touching=True)
            found = found if len(found) else ring
        places.append(found)
        part.append(np.full(len(found), faces.part[face]))
    return np.concatenate(places), np.concatenate(part)


def _overlap(faces: SheetFaces, normals: Floats, doubled: Floats) -> Flags:
    """(f,) the polygons whose triangles overlap: they have more area than they enclose."""
    enclosed = summed(faces.of, normals * doubled[:, None], len(faces.part))
    whole = np.bincount(faces.of, doubled, len(faces.part))
    beyond = whole - np.linalg.norm(enclosed, axis=1)
    return np.asarray((beyond > TRIFLE * whole) & (whole > _NOTHING * whole.sum()))


def _crossings_of(ring: Floats, flat: Floats, step: float, touching: bool) -> Floats:
    """(k, 3) where sides of a polygon cross or touch, given its (n, 3) corners and the same in a plane, (n, 2)."""
    count, ends = len(flat), np.roll(flat, -1, axis=0)
    low, high = np.minimum(flat, ends) - step, np.maximum(flat, ends) + step
    found = []
    for side in range(count - 2):
        rows = np.arange(side + 2, count - (side == 0))
        rows = rows[((low[rows] <= high[side]) & (high[rows] >= low[side])).all(axis=1)]
        one, two = (_beside(flat[rows], ends[rows], each[side], step) for each in (flat, ends))
        three, four = (_beside(flat[side], ends[side], each[rows], step) for each in (flat, ends))
        most = 0.0 if touching else -step * step
        cross = (one * two <= most) & (three * four <= most)
        apart = np.abs(one) + np.abs(two)
        share = (np.abs(one) / np.where(apart > 0.0, apart, 1.0))[cross]
        found.append(ring[side] + share[:, None] * (ring[(side + 1) % count] - ring[side]))
    return np.concatenate(found)


def _beside(start: Floats, end: Floats, place: Floats, step: float) -> Floats:
    """How far places lie beside lines, positive to the left; 0 where that is less than a step."""
    along, to = end - start, place - start
    length = np.sqrt(dot(along, along))
    away = along[..., 0] * to[..., 1] - along[..., 1] * to[..., 0]
    away /= np.where(length > 0.0, length, 1.0)
    return np.where(np.abs(away) < step, 0.0, away)
