# SPDX-License-Identifier: GPL-3.0-or-later
"""One material for each number that is shown: the radius of axes, the epsilon of reports, the thickness of sheets.

The colours are those of `ma_color`, but made in the material: so an artist can change them. Their range comes from
properties of the object, so that every axis shows its whole range with the same material.
"""

from __future__ import annotations

import bpy

from ...core.axis.colours import SCALE
from . import stored
from .attributes import EPSILON, RADIUS
from .colours import COLOUR

NAME = "Medial Axis Radius"
THICKNESS = "ma_thickness"
EPSILON_NAME = "Medial Axis Epsilon"
THICKNESS_NAME = "Medial Axis Thickness"
COLOUR_NAME = "Medial Axis Colour"
FLAT = (0.08, 0.42, 0.5, 1.0)  # of results without colours; orange is what Blender selects with


def radius_material() -> bpy.types.Material:
    """The material, made when it does not exist; changes that an artist made in it stay."""
    return _material(NAME, RADIUS.name)


def epsilon_material() -> bpy.types.Material:
    """As `radius_material`, for reports."""
    return _material(EPSILON_NAME, EPSILON.name)


def thickness_material() -> bpy.types.Material:
    """As `radius_material`, for sheets with the thickness of walls."""
    return _material(THICKNESS_NAME, THICKNESS)


def colour_material() -> bpy.types.Material:
    """The material of what has a scale of its own: it shows `ma_color` itself."""
    found = bpy.data.materials.get((COLOUR_NAME, None))
    if found is None:
        found, shader = _empty_material(COLOUR_NAME)
        colour = _attribute(found.node_tree.nodes, "GEOMETRY", COLOUR, (-300, 200))
        found.node_tree.links.new(colour.outputs[0], shader.inputs["Base Color"])
    return found


def dress(thing: bpy.types.Object, material: bpy.types.Material) -> None:
    """Give a new object the material that renders its colours, and the flat colour that views show without them."""
    thing.data.materials.append(material)
    thing.color = FLAT


def _material(name: str, value: str) -> bpy.types.Material:
    """Colour by an attribute, from the one property of the object to the other."""
    if found := bpy.data.materials.get((name, None)):
        return found
    material, shader = _empty_material(name)
    nodes, links = material.node_tree.nodes, material.node_tree.links
    spread = nodes.new("ShaderNodeMapRange")
    spread.location = (-650, 200)
    spread.clamp = False  # the ramp does that
    # By index: names of sockets differ between versions. Attribute has Color, Vector, Factor,
    # Alpha; Map Range has Value, From Min, From Max, To Min, To Max.
    kinds = ("GEOMETRY", "OBJECT", "OBJECT")
    for socket, (kind, attribute) in enumerate(
        zip(kinds, (value, stored.COLOUR_START, stored.COLOUR_END), strict=True)
    ):
        node = _attribute(nodes, kind, attribute, (-900, 200 - 200 * socket))
        links.new(node.outputs[2], spread.inputs[socket])
    ramp = nodes.new("ShaderNodeValToRGB")
    ramp.location = (-400, 200)
    fill_ramp(ramp.color_ramp.elements)
    links.new(spread.outputs[0], ramp.inputs[0])
    links.new(ramp.outputs[0], shader.inputs["Base Color"])
    return material


def _empty_material(name: str) -> tuple[bpy.types.Material, bpy.types.Node]:
    """A new material and its shader."""
    material = bpy.data.materials.new(name)
    material.diffuse_color = FLAT
    if not material.node_tree:
        material.use_nodes = True  # already on, and going away, in later versions
    nodes = material.node_tree.nodes
    return material, next(node for node in nodes if node.type == "BSDF_PRINCIPLED")


def _attribute(
    nodes: bpy.types.Nodes, kind: str, name: str, location: tuple[float, float]
) -> bpy.types.Node:
    node = nodes.new("ShaderNodeAttribute")
    node.attribute_type = kind
    node.attribute_name = name
    node.location = location
    return node


def fill_ramp(elements: bpy.types.ColorRampElements) -> None:
    """Give a new ramp the colours of all that is coloured here."""
    elements.remove(elements[1])
    for number, (position, colour) in enumerate(SCALE):
        element = elements[0] if number == 0 else elements.new(position)
        element.position, element.color = position, (*colour, 1.0)
