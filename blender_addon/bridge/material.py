"""One material for all medial axes: colour by radius.

The range of colours comes from the object's own `ma_radius_min` and `ma_radius_max`, so that every
axis shows its whole range with the same material.
"""

from __future__ import annotations

import bpy

from .attributes import RADIUS

NAME = "Medial Axis Radius"
RADIUS_MIN = "ma_radius_min"
RADIUS_MAX = "ma_radius_max"

# Position, linear RGB: thin is dark blue, thick is yellow, and brightness alone tells them apart.
_COLOURS = (
    (0.0, (0.05, 0.03, 0.25)),
    (0.35, (0.30, 0.03, 0.45)),
    (0.65, (0.85, 0.12, 0.15)),
    (0.85, (0.95, 0.45, 0.02)),
    (1.0, (0.95, 0.90, 0.20)),
)


def radius_material() -> bpy.types.Material:
    """The material, made when it does not exist; what an artist changed in it stays."""
    material = bpy.data.materials.get((NAME, None))
    return _new_material() if material is None else material


def _new_material() -> bpy.types.Material:
    material = bpy.data.materials.new(NAME)
    material.diffuse_color = (0.85, 0.35, 0.05, 1.0)
    if not material.node_tree:
        material.use_nodes = True  # already on, and going away, in later versions
    nodes, links = material.node_tree.nodes, material.node_tree.links
    shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    radius = _attribute(nodes, "GEOMETRY", RADIUS.name, (-900, 200))
    smallest = _attribute(nodes, "OBJECT", RADIUS_MIN, (-900, 0))
    largest = _attribute(nodes, "OBJECT", RADIUS_MAX, (-900, -200))
    spread = nodes.new("ShaderNodeMapRange")
    spread.location = (-650, 200)
    ramp = _ramp(nodes)
    # By index: names of sockets differ between versions. Attribute has Color, Vector, Factor,
    # Alpha; Map Range has Value, From Min, From Max.
    for socket, attribute in enumerate((radius, smallest, largest)):
        links.new(attribute.outputs[2], spread.inputs[socket])
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
    for number, (position, colour) in enumerate(_COLOURS):
        element = elements[0] if number == 0 else elements.new(position)
        element.position = position
        element.color = (*colour, 1.0)
    return node
