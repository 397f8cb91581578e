# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours in Blender: `ma_color` on the points of a mesh, which Solid view shows with Color: Attribute, and the range
that they stand for, which an object remembers."""

from __future__ import annotations

from collections.abc import Callable

import bpy
from numpy.typing import NDArray

from ...core.axis.colours import colours, part_colours
from . import stored

COLOUR = "ma_color"


def colour_mesh(
    mesh: bpy.types.Mesh, values: NDArray, start: float, end: float, render: bool = True
) -> None:
    """Give a mesh in object mode `ma_color`, active in the viewport and, with `render`, in renders.

    An existing attribute of that name is replaced. Of the values at the vertices `start` is blue and `end` is yellow,
    whichever is larger; NaN is grey.
    """
    attribute = _attribute(mesh)
    attribute.data.foreach_set("color", colours(values, start, end).ravel())
    mesh.color_attributes.active_color = attribute
    if render:
        mesh.color_attributes.render_color_index = mesh.color_attributes.find(COLOUR)


def coloured_mesh(
    build: Callable[[str | bpy.types.Mesh], bpy.types.Mesh],
    values: NDArray,
    start: float,
    end: float,
    name: str | bpy.types.Mesh,
) -> bpy.types.Mesh:
    """A mesh that `build` makes from its name, with colours as `colour_mesh` gives them."""
    mesh = build(name)
    colour_mesh(mesh, values, start, end)
    return mesh


def colour_parts(mesh: bpy.types.Mesh, part: NDArray, sizes: NDArray) -> None:
    """Give a new mesh `ma_color` by the parts of its polygons, active in the viewport and in renders.

    Colours belong to corners, because a vertex of a seam lies on several parts. `part` and `sizes` have the part and
    the number of corners of each polygon.
    """
    attribute = mesh.color_attributes.new(COLOUR, "FLOAT_COLOR", "CORNER")
    attribute.data.foreach_set("color", part_colours(part).repeat(sizes, axis=0).ravel())
    mesh.color_attributes.active_color = attribute
    mesh.color_attributes.render_color_index = mesh.color_attributes.find(COLOUR)


def remember_colours(thing: bpy.types.Object, of: str, start: float, end: float) -> None:
    """Keep on an object which attribute `ma_color` shows, "" where there is none, and its range, for the legend and the
    materials; also on what shares its mesh and its colours: duplicates, and the solid that is rebuilt of it."""
    thing[stored.COLOUR_OF] = of
    for other in _coloured_like(thing):
        other[stored.COLOUR_OF] = of
        other[stored.COLOUR_START], other[stored.COLOUR_END] = float(start), float(end)
        other.update_tag()


def _coloured_like(thing: bpy.types.Object) -> list[bpy.types.Object]:
    if thing.data.users == 1:
        return [thing]
    return [
        other
        for other in bpy.data.objects
        if other.data == thing.data and stored.COLOUR_OF in other
    ]


def colour_range(thing: bpy.types.Object) -> tuple[str, float, float] | None:
    """Return (name of the attribute, start, end) of what an object is coloured by; None when it is not coloured."""
    if not thing.get(stored.COLOUR_OF):
        return None
    return thing[stored.COLOUR_OF], thing[stored.COLOUR_START], thing[stored.COLOUR_END]


def _attribute(mesh: bpy.types.Mesh) -> bpy.types.Attribute:
    """`ma_color` of a mesh, made where there is none of its kind."""
    found = mesh.attributes.get(COLOUR)
    if found is not None and (found.domain, found.data_type) == ("POINT", "FLOAT_COLOR"):
        return found
    if found is not None:
        mesh.attributes.remove(found)
    return mesh.color_attributes.new(COLOUR, "FLOAT_COLOR", "POINT")
