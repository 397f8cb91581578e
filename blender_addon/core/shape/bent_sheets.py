# SPDX-License-Identifier: GPL-3.0-or-later
"""Open parts of faces that are a sheet, however little it is bent: closing them takes a second sheet of the same size.

Every surface with the same openings has the same sum of area vectors, so lids are at least as large as its length. A
flat sheet needs its own area, a half ball half of it, a box without a wall a fifth, and a closed part nothing.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Flags, Ints
from ..machine import native
from ..small_matrices import summed
from .shape import Shape

# A part is a sheet where its lids need at least this share of its own area: an arch of up to a seventh of its width.
_LIDS = 0.95  # chosen: unseen
# On a part that bounds a solid together with others, the winding number is one half; a sheet by itself stays below
# this, as an arch of a seventh does (0.1).
_ALONE = 0.25  # measured: 0.1 and 0.5
_OFF = 1e-6  # of a face's size: from its two sides the winding number is asked; derived: rounding


def bent_sheets(shape: Shape, part: Ints, count: int) -> Flags:
    """Mark the parts that are sheets and bound nothing together with others, (count,).

    The (m,) part of each face is -1 for none; the faces of a part look to one side.
    """
    corners = shape.points[shape.triangles]
    vectors = 0.5 * np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(vectors, axis=1)
    known = part >= 0
    lids = np.linalg.norm(summed(part[known], vectors[known], count), axis=1)
    whole = summed(part[known], areas[known], count)
    found = (lids > 0.0) & (lids >= _LIDS * whole)
    faces = np.flatnonzero(found[part] & known & (areas > 0.0))
    if not len(faces):
        return found
    middle = corners[faces].mean(axis=1)
    step = _OFF * vectors[faces] / np.sqrt(areas[faces])[:, None]
    with native.own_errors() as module:
        sides = (
            module.winding_number(middle + way * step, shape.points, shape.triangles)
            for way in (1, -1)
        )
        winding = 0.5 * sum(sides)
    mean = summed(part[faces], areas[faces] * winding, count)
    return found & (np.abs(mean) < _ALONE * whole)
