# SPDX-License-Identifier: GPL-3.0-or-later
"""This module reads polygons from COLLADA's `.dae` files, which robots often have as meshes (docs/formats.md).

As in RViz and Gazebo, the unit of the file makes lengths metres, and `up_axis` turns nothing. Meshes of robots are made
for these two programs, and many of them state an axis that their robot contradicts.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Longs
from ..portable_angle import turn_about
from ..small_matrices import determinant, length_of, placed
from .imported_points import ImportedPoints, checked
from .numpy_arrays import refusing
from .text import open_file

_Piece = tuple[Floats, Longs, Longs]  # Points, the number of corners of each face, and the corners
_NONE = np.zeros(0, np.int64)
_MOVES = ("matrix", "translate", "rotate", "scale", "skew", "lookat")


def read_dae(path: str | os.PathLike) -> ImportedPoints:
    """Read the polygons in the scene of a file, with the points that they use."""
    name = Path(path).name
    with open_file(path) as stream, refusing(name, "COLLADA meshes"), np.errstate(all="ignore"):
        return checked(name, *_Document(ElementTree.fromstring(stream.read())).content())


class _Document:
    """A file whose elements are known by their ids."""

    def __init__(self, root: Element) -> None:
        self._root = root
        self._named = {f"#{element.get('id')}": element for element in root.iter()}
        self._mesh = cache(self._mesh_of)  # of a geometry, which may have many instances

    def content(self) -> tuple[Floats, None, Longs, Longs]:
        """Return the points, no normals, the number of corners of each polygon, and the corners."""
        scene = self._target(_one(self._root, "scene/{*}instance_visual_scene"))
        unit = self._root.find("{*}asset/{*}unit[@meter]")
        metres = 1.0 if unit is None else float(unit.get("meter", ""))
        pieces = [piece for piece in self._placed(scene) if len(piece[1])]
        if not pieces or not metres > 0.0:
            raise ValueError(f"{len(pieces)} meshes with polygons, in a unit of {metres:g} metres")
        points, sizes, corners = zip(*pieces, strict=True)
        starts = np.cumsum([0, *map(len, points)])[:-1]
        rows = [part + start for part, start in zip(corners, starts, strict=True)]
        places = metres * np.concatenate(points)
        return places, None, np.concatenate(sizes), np.concatenate(rows)

    def _placed(self, node: Element) -> Iterator[_Piece]:
        """Yield the meshes in a node in the frame around it; faces of mirrored ones are turned."""
        moves = [child for child in node if _tag(child) in _MOVES][::-1]
        for child in node:
            if (tag := _tag(child)) == "instance_controller":
                raise ValueError("a mesh with bones, <instance_controller>")
            if tag not in ("node", "instance_node", "instance_geometry"):
                continue
            inner = child if tag == "node" else self._target(child)
            found = [self._mesh(inner)] if tag == "instance_geometry" else self._placed(inner)
            for points, sizes, corners in found:
                for frame in map(_frame, moves):
                    points = placed(points, frame)
                    if determinant(frame[:, :3]) < 0.0:
                        sizes, corners = sizes[::-1], corners[::-1]
                yield points, sizes, corners

    def _mesh_of(self, geometry: Element) -> _Piece:
        """Return the polygons of a geometry."""
        mesh = _one(geometry, "mesh")
        source = self._target(_one(mesh, "vertices/{*}input[@semantic='POSITION']"), "source")
        accessor = _one(source, "technique_common/{*}accessor")
        start, count, stride = (int(accessor.get(x, "0")) for x in ("offset", "count", "stride"))
        numbers = _numbers(self._target(accessor, "source"))
        points = numbers[start : start + count * stride].reshape(count, stride)[:, [0, 1, 2]]
        groups = [child for child in mesh if _tag(child).startswith(("tri", "poly"))]
        parts = [(_NONE, _NONE), *map(_polygons, groups)]
        sizes, corners = (np.concatenate(part) for part in zip(*parts, strict=True))
        if len(bad := corners[(corners < 0) | (corners >= len(points))]):
            raise ValueError(f"the corner {bad[0]} of {len(points)} points")
        used, rows = np.unique(corners, return_inverse=True)
        return points[used], sizes, rows

    def _target(self, element: Element, attribute: str = "url") -> Element:
        if (found := self._named.get(name := element.get(attribute, ""))) is None:
            raise ValueError(f"{attribute}={name!a} in <{_tag(element)}>, which names nothing")
        return found


def _frame(move: Element) -> Floats:
    """Return the transform that an element of a node states, (3, 4)."""
    tag, numbers = _tag(move), _numbers(move)
    if tag == "matrix":
        return numbers.reshape(4, 4)[:3]
    linear, offset = np.identity(3), np.zeros(3)
    if tag == "translate":
        offset = numbers
    elif tag == "scale":
        linear = np.diag(numbers)
    elif tag != "rotate":
        raise ValueError(f"<{tag}> around a mesh")
    elif (length := length_of(numbers[:3])) > 0.0:
        linear = turn_about(numbers[:3] / length, math.radians(numbers[3]))
    return np.column_stack([linear, offset])


def _polygons(group: Element) -> tuple[Longs, Longs]:
    """Return the number of corners of each polygon in a group, and the corners."""
    tag = _tag(group)
    if tag not in ("triangles", "polylist", "polygons") or group.find("{*}ph") is not None:
        raise ValueError(f"<{tag}> that are strips, fans or have holes")
    first = int(_one(group, "input[@semantic='VERTEX']").get("offset", "0"))
    width = 1 + max(int(item.get("offset", "0")) for item in group.iterfind("{*}input"))
    rows, counts = ([_numbers(x, int) for x in group.iterfind("{*}" + y)] for y in ("p", "vcount"))
    words = np.concatenate([_NONE, *rows])
    if tag == "polylist":
        sizes = np.concatenate([_NONE, *counts])
    elif tag == "polygons":
        sizes = np.array([len(row) // width for row in rows], np.int64)
    else:
        sizes = np.full(len(words) // (3 * width), 3)
    if sizes.sum() * width != len(words):
        raise ValueError(f"{len(words)} numbers of {sizes.sum()} corners in <{tag}>")
    return sizes, words[first::width]


def _numbers(element: Element, kind: type = float) -> NDArray[Any]:
    words = (element.text or "").split()
    return np.array([kind(word) for word in words], np.int64 if kind is int else np.float64)


def _one(parent: Element, path: str) -> Element:
    if (found := parent.find("{*}" + path)) is None:
        raise ValueError(f"no <{path.replace('{*}', '')}> in <{_tag(parent)}>")
    return found


def _tag(element: Element) -> str:
    return element.tag.rpartition("}")[2]
