# SPDX-License-Identifier: GPL-3.0-or-later
"""The wires of a medial axis as a curve object of their own, with the radii of the axis."""

from __future__ import annotations

import bpy
import numpy as np

from ...core.axis.medial_axis import MedialAxis
from ...core.curves.net import chains
from ...core.errors import InvalidInputError
from ...core.skeleton.skeleton import Skeleton
from ..axis.read_axis import read_axis
from ..objects.output_object import follow_like, new_object
from .skeleton_object import check_size, fill_curve, new_curve

SUFFIX = " Curve"


def write_curve(result: bpy.types.Object) -> bpy.types.Object:
    """Make a curve object of the wires of a medial axis, in its place; the axis is not changed.

    Raises InvalidInputError where there is no wire, or Blender cannot hold the curve.
    """
    skeleton = _wires_as_skeleton(read_axis(result))
    if not skeleton.count:
        raise InvalidInputError(
            f"Expected edges without faces on '{result.name}', found none; choose Form Curve first"
        )
    check_size(skeleton)
    thing = new_object(result, SUFFIX, new_curve(result.name + SUFFIX))
    fill_curve(thing.data, skeleton)
    for material in result.data.materials:
        thing.data.materials.append(material)
    thing.show_in_front = result.show_in_front
    follow_like(thing, result)
    return thing


def _wires_as_skeleton(axis: MedialAxis) -> Skeleton:
    found = chains(axis.edges, len(axis.vertices))
    offsets = np.cumsum([0, *map(len, found)]).astype(np.int32)
    rows = np.array([row for chain in found for row in chain], np.int32)
    used, points = np.unique(rows, return_inverse=True)  # vertices of sheets are no points of it
    points = points.ravel().astype(np.int32)
    ends = points[np.concatenate([offsets[:-1], offsets[1:] - 1])]
    return Skeleton(
        points=axis.vertices[used],
        radius=axis.radius[used],
        branch_offsets=offsets,
        branch_points=points,
        nodes=np.unique(ends),
    )
