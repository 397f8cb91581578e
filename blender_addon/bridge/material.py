# SPDX-License-Identifier: GPL-3.0-or-later
"""One material for all medial axes, colour by radius, and one for all reports, colour by epsilon.

The colours are those of `ma_color`, but made in the material: so an artist can change them. Their range comes from
properties of the object, so that every axis shows its whole range with the same material.
"""

from __future__ import annotations

import bpy

from ..core.axis.colours import SCALE
from .attributes import EPSILON, RADIUS
from .colours import END, START

NAME = "Medial Axis Radius"
RADIUS_MIN = "ma_radius_min"
RADIUS_MAX = "ma_radius_max"
THICKNESS = "ma_thickness"
EPSILON_NAME = "Medial Axis Epsilon"
THICKNESS_NAME = "Medial Axis Thickness"
LIMIT = "ma_epsilon_limit"
FLAT = (0.08, 0.42, 0.5, 1.0)  # of results without colours; orange is what Blender selects with


def radius_material() -> bpy.types.Material:
    """The material, made when it does not exist; changes that an artist made in it stay."""
    found = bpy.data.materials.get((NAME, None))
    return found or _new_material(NAME, RADIUS.name)


def epsilon_material() -> bpy.types.Material:
    """As `radius_material`, for reports."""
    found = bpy.data.materials.get((EPSILON_NAME, None))
    return found or _new_material(EPSILON_NAME, EPSILON.name)


def thickness_material() -> bpy.types.Material:
    """As `radius_material`, for sheets with the thickness of walls."""
    found = bpy.data.materials.get((THICKNESS_NAME, None))
    return found or _new_material(THICKNESS_NAME, THICKNESS)


def _new_material(name: str, value: str) -> bpy.types.Material:
    """Colour by an attribute, from the one property of the object to the other."""
    material = bpy.data.materials.new(name)
    material.diffuse_color = FLAT
    if not material.node_tree:
        material.use_nodes = True  # already on, and going away, in later versions
    nodes, links = material.node_tree.nodes, material.node_tree.links
    shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    spread = nodes.new("ShaderNodeMapRange")
    spread.location = (-650, 200)
    spread.clamp = False  # the ramp does that
    # By index: names of sockets differ between versions. Attribute has Color, Vector, Factor,
    # Alpha; Map Range has Value, From Min, From Max, To Min, To Max.
    kinds = ("GEOMETRY", "OBJECT", "OBJECT")
    for socket, (kind, attribute) in enumerate(zip(kinds, (value, START, END), strict=True)):
        node = _attribute(nodes, kind, attribute, (-900, 200 - 200 * socket))
        links.new(node.outputs[2], spread.inputs[socket])
    ramp = _ramp(nodes)
    links.new(spread.outputs[0], ramp.inputs[0])
    links.new(ramp.outputs[0], shader.inputs["Base Color"])
    return material


def _attribute(
    nodes: bpy.types.Nodes, kind: str, name: str, location: tuple[float, float]
) -> bpy.types.Node:
    node = nodes.new("ShaderNodeAttribute")
    node.attribute_type = kind
    node.attribute_name = name
    node.location = location
    return node


def _ramp(nodes: bpy.types.Nodes) -> bpy.types.Node:
    node = nodes.new("ShaderNodeValToRGB")
    node.location = (-400, 200)
    elements = node.color_ramp.elements
    elements.remove(elements[1])
    for number, (position, colour) in enumerate(SCALE):
        element = elements[0] if number == 0 else elements.new(position)
        element.position = position
        element.color = (*colour, 1.0)
    return node
