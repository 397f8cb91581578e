# SPDX-License-Identifier: GPL-3.0-or-later
"""Plates that are cut out along outlines: two equal flat faces with upright ones between them.

The medial axis of a bridge between two holes that is no wider than the plate is thick lies upright, between the holes,
so no sheet of the axis stands for it. But the middle of such a plate is known without an axis: it is the flat face,
half a thickness farther down.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Floats, Longs
from ..shape.shape import Shape
from ..shape.triangles import unit_normals
from ..small_matrices import dot, length_of
from ..thickness.face_lengths import first_rows
from ..united import united
from .carried_sheets import CarriedSheets
from .sheet_faces import TRIFLE

_MOSTLY = 0.95  # of the volume has to be sheet, so that no more than bridges is missing; measured: lab/mid_surface.md
_ALONG = 0.999  # the cosine between normals that may be those of one flat face; chosen: unseen


def cut_out_plate(shape: Shape, sheets: CarriedSheets) -> CarriedSheets | None:
    """Return the middle of a plate that is cut out along outlines, given closed faces and the sheets that were found.

    None where the solid is no such plate, or more of it than bridges is missing in the sheets.
    """
    normals, doubled = unit_normals(sheets.vertices[sheets.triangles])
    volumes = 0.5 * doubled * sheets.at_corners.mean(axis=1)
    if not float(volumes.sum()) >= _MOSTLY * shape.volume > 0.0:
        return None
    largest = sheets.part == np.bincount(sheets.part, volumes).argmax()
    mean = (normals * doubled[:, None])[largest].sum(axis=0) / doubled[largest].sum()
    if (
        length_of(mean) < _ALONG
    ):  # a curved sheet, of which no plate has one; that of a pipe has no mean normal
        return None
    thickness = float(volumes[largest].sum() / (0.5 * doubled[largest].sum()))
    return _plate(shape, mean, thickness)


def _plate(shape: Shape, across: Floats, thickness: float) -> CarriedSheets | None:
    """The middle of a plate of about a thickness, whose flat faces look along a vector, about, and against it."""
    normals, doubled = unit_normals(shape.points[shape.triangles])
    turned = dot(normals, across[None])
    flat = np.where(np.abs(turned) > _ALONG, np.sign(turned), 0.0)
    across = _direction(normals, doubled * flat)
    heights = dot(shape.points, across[None])
    at = heights[shape.triangles]
    top, bottom = (at[flat == side] for side in (1.0, -1.0))
    if not len(top) or not len(bottom):
        return None
    high, low = float(top.mean()), float(bottom.mean())
    within = TRIFLE * (high - low)
    if not _MOSTLY * thickness <= high - low <= thickness / _MOSTLY:
        return None  # the sheets are walls that stand upright
    if max(np.ptp(top), np.ptp(bottom)) > within or not _is_plate(shape, across, flat, high - low):
        return None
    # Triangles without an area have no normal, and those in the flat face keep its others together.
    triangles = shape.triangles[(np.abs(at - high) <= within).all(axis=1)]
    middle = shape.points + across * (0.5 * (high + low) - heights)[:, None]
    return _sheets(middle, first_rows(shape.points)[triangles], high - low)


def _direction(normals: Floats, weights: Floats) -> Floats:
    """(3,) the mean of unit normals as a unit vector, or 0."""
    mean = (normals * weights[:, None]).sum(axis=0)
    return np.asarray(mean / (length_of(mean) or 1.0))


def _is_plate(shape: Shape, across: Floats, flat: Floats, thickness: float) -> bool:
    """Whether two flat faces, 1 and -1, are equal, all others are upright, and the volume is that of a plate."""
    normals, doubled = unit_normals(shape.points[shape.triangles])
    seen = 0.5 * doubled * np.abs(dot(normals, across[None]))
    top, bottom, others = (float(seen[flat == side].sum()) for side in (1.0, -1.0, 0.0))
    amiss = max(abs(top - bottom), others, abs(top - shape.volume / thickness))
    return amiss <= TRIFLE * top


def _sheets(vertices: Floats, triangles: Longs, thickness: float) -> CarriedSheets:
    label = united(len(vertices), np.concatenate((triangles[:, :2], triangles[:, 1:])))
    _, part = np.unique(label[triangles[:, 0]], return_inverse=True)
    return CarriedSheets(
        vertices,
        triangles.astype(np.int32),
        part.reshape(-1).astype(np.int32),
        np.full(triangles.shape, thickness),
    )
