# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of a solid that are not thin, and that join thin walls: where they are left out, the walls are in pieces."""

from __future__ import annotations

import numpy as np

from ..arrays import Flags, Floats, Ints, Longs
from ..axis.medial_axis import MedialAxis
from ..united import united
from .thin_sheets import ThinSheets

# So many times as large as that in the wall is a ball of what is not thin. Where walls cross, the ball touches their
# reflex edges and has 1.4 times the radius.
_THICK = 2.0  # derived: above sqrt(2)


def joined_by_thick_parts(axis: MedialAxis, thin: ThinSheets) -> int:
    """How many pieces fewer the thin sheets, chosen from an axis, would have if the thick parts that join them were not
    left out.
    """
    count = len(axis.vertices)
    sizes = np.diff(axis.face_offsets)
    kept = np.zeros(len(sizes), bool)
    kept[thin.facet] = True
    corner_kept = np.repeat(kept, sizes)
    pieces = united(count, _ends(axis, corner_kept))
    between = united(count, _ends(axis, ~corner_kept))
    in_wall, left = np.zeros((2, count), bool)
    in_wall[axis.face_vertices[corner_kept]] = left[axis.face_vertices[~corner_kept]] = True
    walls, both = np.flatnonzero(in_wall), np.flatnonzero(in_wall & left)
    thin_radius = _means(axis.radius, pieces, walls)[pieces]
    most, at_walls = np.zeros((2, count))
    np.maximum.at(most, between[left], axis.radius[left])
    np.maximum.at(at_walls, between[both], thin_radius[both])
    joint = both[(most >= _THICK * at_walls)[between[both]]]
    links = (np.column_stack((walls, pieces[walls])), np.column_stack((joint, between[joint])))
    joined = united(count, np.concatenate(links))
    return len(np.unique(pieces[walls])) - len(np.unique(joined[walls]))


def _ends(axis: MedialAxis, corners: Flags) -> Ints:
    """(k, 2) the first vertex of its facet and the vertex, at each of some corners."""
    first = np.repeat(axis.face_vertices[axis.face_offsets[:-1]], np.diff(axis.face_offsets))
    return np.column_stack((first, axis.face_vertices))[corners]


def _means(values: Floats, label: Longs, rows: Longs) -> Floats:
    """(n,) the mean over those rows that have each label."""
    total = np.bincount(label[rows], values[rows], len(values))
    return total / np.maximum(np.bincount(label[rows], minlength=len(values)), 1)
