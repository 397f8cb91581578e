# SPDX-License-Identifier: GPL-3.0-or-later
"""The geoms of MuJoCo: their meshes, and the frames of these in the body."""

from __future__ import annotations

import numpy as np

from ..arrays import Floats
from ..errors import ReadError
from ..portable_angle import turn_about
from ..small_matrices import dot, length_of
from .element_numbers import numbers_of, turn_of
from .primitive_meshes import Mesh, ball_mesh, box_mesh, cylinder_mesh
from .xml_spans import Element

SIZES = {"sphere": 1, "capsule": 2, "cylinder": 2, "ellipsoid": 3, "box": 3}  # by type
TURNS = {"axisangle", "xyaxes", "zaxis", "euler"}  # attributes; each counts more than quat
# The attributes that a geom in the place of another does not take over.
SHAPE = {*TURNS, "quat", "pos", "fromto", "type", "size", "mesh", "fitscale", "mass"}


def primitive_of(kind: str, geom: Element) -> Mesh:
    """Return the mesh of a geom that is no mesh, in its own frame."""
    between = "fromto" in geom.attributes
    words = geom.attributes.get("size", "").split()[: 1 if between else SIZES[kind]]
    given = Element("geom", {"size": " ".join(words)}, geom.start)
    sizes = numbers_of(given, "size", 1 if between else SIZES[kind])
    if between:
        half = length_of(np.subtract(*_ends(geom))) / 2
        sizes = np.array([*np.repeat(sizes, SIZES[kind] - 1), half])
    if kind == "box":
        return box_mesh(2 * sizes)
    if kind == "cylinder":
        return cylinder_mesh(float(sizes[0]), 2 * float(sizes[1]))
    if kind == "ellipsoid":
        points, triangles = ball_mesh(1.0)
        return points * sizes, triangles
    return ball_mesh(*sizes.tolist())


def frame_of(geom: Element, unit: float, order: str) -> tuple[Floats, Floats]:
    """Return the turn of a geom, (3, 3), and its place, by angles in a unit of radians and the order of euler."""
    if "fromto" in geom.attributes:
        ends = _ends(geom)
        return _turn_to(ends[0] - ends[1], geom), ends.mean(axis=0)
    return _turn_of(geom, unit, order), numbers_of(geom, "pos", 3, "0 0 0", signed=True)


def matrix_of(quaternion: Floats, element: Element) -> Floats:
    """Return the turn that a quaternion of any length means."""
    w, *axis = _unit(quaternion, element)
    along = np.array(axis)
    across = np.cross(along, np.identity(3)).T
    return (2 * w * w - 1) * np.identity(3) + 2 * np.outer(along, along) + 2 * w * across


def _turn_of(geom: Element, unit: float, order: str) -> Floats:
    given = geom.attributes
    if "euler" in given:
        return turn_of(unit * numbers_of(geom, "euler", 3, signed=True), order)
    if "zaxis" in given:
        return _turn_to(numbers_of(geom, "zaxis", 3, signed=True), geom)
    if "xyaxes" in given:
        along, beside = numbers_of(geom, "xyaxes", 6, signed=True).reshape(2, 3)
        x = _unit(along, geom)
        y = _unit(beside - x * dot(x, beside), geom)
        return np.column_stack([x, y, np.cross(x, y)])
    if "axisangle" in given:
        *axis, angle = numbers_of(geom, "axisangle", 4, signed=True).tolist()
        return turn_about(_unit(np.array(axis), geom), unit * angle)
    return matrix_of(numbers_of(geom, "quat", 4, "1 0 0 0", signed=True), geom)


def _turn_to(direction: Floats, geom: Element) -> Floats:
    """Return the shortest turn that takes Z to a direction."""
    x, y, z = _unit(direction, geom).tolist()
    flipped = z == -1.0  # every half turn about a level axis is as short
    return matrix_of(np.array([0.0, 1.0, 0.0, 0.0] if flipped else [1.0 + z, -y, x, 0.0]), geom)


def _ends(geom: Element) -> Floats:
    return numbers_of(geom, "fromto", 6, signed=True).reshape(2, 3)


def _unit(vector: Floats, element: Element) -> Floats:
    length = length_of(vector)
    if not length > 0.0:
        raise ReadError(
            f"Expected directions and ends of <{element.tag}> that tell a turn, found a length of 0; correct them"
        )
    return vector / length
