# SPDX-License-Identifier: GPL-3.0-or-later
"""One material for all medial axes, colour by radius, and one for all reports, colour by epsilon.

The range of colours comes from properties of the object, so that every axis shows its whole range
with the same material, and every report turns red where its own limit is passed.
"""

from __future__ import annotations

import bpy

from .attributes import EPSILON, RADIUS

NAME = "Medial Axis Radius"
RADIUS_MIN = "ma_radius_min"
RADIUS_MAX = "ma_radius_max"
EPSILON_NAME = "Medial Axis Epsilon"
LIMIT = "ma_epsilon_limit"

# Position, linear RGB: thin is dark blue, thick is yellow, and brightness alone tells them apart.
_COLOURS = (
    (0.0, (0.05, 0.03, 0.25)),
    (0.35, (0.30, 0.03, 0.45)),
    (0.65, (0.85, 0.12, 0.15)),
    (0.85, (0.95, 0.45, 0.02)),
    (1.0, (0.95, 0.90, 0.20)),
)
# 0.5 is the limit: below it green, above it red.
_EPSILON_COLOURS = (
    (0.0, (0.02, 0.20, 0.05)),
    (0.45, (0.25, 0.75, 0.15)),
    (0.5, (0.90, 0.80, 0.10)),
    (0.55, (0.90, 0.12, 0.05)),
    (1.0, (0.30, 0.01, 0.03)),
)


def radius_material() -> bpy.types.Material:
    """The material, made when it does not exist; what an artist changed in it stays."""
    found = bpy.data.materials.get((NAME, None))
    ends = (RADIUS_MIN, RADIUS_MAX)
    return found or _new_material(NAME, RADIUS.name, ends, 1.0, _COLOURS)


def epsilon_material() -> bpy.types.Material:
    """As `radius_material`, for reports."""
    found = bpy.data.materials.get((EPSILON_NAME, None))
    return found or _new_material(EPSILON_NAME, EPSILON.name, (None, LIMIT), 0.5, _EPSILON_COLOURS)


def _new_material(
    name: str, value: str, ends: tuple[str | None, str], reach: float, colours: tuple
) -> bpy.types.Material:
    """Colour by an attribute: from 0, at the first of the properties in `ends`, to `reach` at the other."""
    material = bpy.data.materials.new(name)
    material.diffuse_color = (0.85, 0.35, 0.05, 1.0)
    if not material.node_tree:
        material.use_nodes = True  # already on, and going away, in later versions
    nodes, links = material.node_tree.nodes, material.node_tree.links
    shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    spread = nodes.new("ShaderNodeMapRange")
    spread.location = (-650, 200)
    spread.clamp = False  # the ramp does that
    spread.inputs[1].default_value = 0.0
    spread.inputs[4].default_value = reach
    # By index: names of sockets differ between versions. Attribute has Color, Vector, Factor,
    # Alpha; Map Range has Value, From Min, From Max, To Min, To Max.
    kinds = ("GEOMETRY", "OBJECT", "OBJECT")
    for socket, (kind, attribute) in enumerate(zip(kinds, (value, *ends), strict=True)):
        if attribute is not None:
            node = _attribute(nodes, kind, attribute, (-900, 200 - 200 * socket))
            links.new(node.outputs[2], spread.inputs[socket])
    ramp = _ramp(nodes, colours)
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


def _ramp(nodes: bpy.types.Nodes, colours: tuple) -> bpy.types.Node:
    node = nodes.new("ShaderNodeValToRGB")
    node.location = (-400, 200)
    elements = node.color_ramp.elements
    elements.remove(elements[1])
    for number, (position, colour) in enumerate(colours):
        element = elements[0] if number == 0 else elements.new(position)
        element.position = position
        element.color = (*colour, 1.0)
    return node
