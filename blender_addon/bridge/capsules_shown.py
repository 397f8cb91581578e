# SPDX-License-Identifier: GPL-3.0-or-later
"""Capsules of a mesh whose edges are their axes: spheres at the vertices and tubes between them, by Geometry Nodes.

The mesh itself, its counts and what is exported of it stay the edges. A tube goes from the widest circle of one sphere
to that of the other, so between spheres of different sizes it is a little thinner than the capsule.
"""

from __future__ import annotations

import bpy

from .mesh import stored
from .mesh.attributes import RADIUS
from .mesh.material import radius_material
from .nodes.inputs import has_inputs
from .nodes.shared import balls, tubes
from .nodes.tree import Tree

NAME = "Medial Axis Capsules"
_SUBDIVISIONS, _SIDES = "Subdivisions", "Sides"


def add_capsules(thing: bpy.types.Object) -> bpy.types.NodesModifier:
    """The modifier with the group, built where the file has none."""
    modifier = thing.modifiers.new(NAME, "NODES")
    modifier.node_group = _group()
    return modifier


def is_capsules(group: bpy.types.NodeTree | None) -> bool:
    """Return whether this is our group, by whatever name."""
    return group is not None and bool(group.get(stored.CAPSULES))


def _group() -> bpy.types.NodeTree:
    for found in bpy.data.node_groups:
        if found.library is None and is_capsules(found) and has_inputs(found, _SIDES):
            return found
    made = _new_group()
    made[stored.CAPSULES] = True
    return made


def _new_group() -> bpy.types.NodeTree:
    tree = Tree(NAME)
    level = tree.input(
        "NodeSocketInt", _SUBDIVISIONS, 3, "Of each sphere", min_value=1, max_value=6
    )
    sides = tree.input("NodeSocketInt", _SIDES, 32, "Of each tube", min_value=3, max_value=256)
    radius = tree.attribute(RADIUS.name)
    whole = tree.node("GeometryNodeJoinGeometry")
    points = tree.node("GeometryNodeMeshToPoints", named={"Mesh": tree.geometry})
    spheres = tree.node("GeometryNodeRealizeInstances", balls(tree, points, radius, level))
    lines = tree.node("GeometryNodeMeshToCurve", tree.geometry)
    for part in (spheres, tubes(tree, lines, radius, sides)):
        tree.group.links.new(part, whole.node.inputs[0])
    smooth = tree.node("GeometryNodeSetShadeSmooth", whole)
    return tree.output(
        tree.node("GeometryNodeSetMaterial", smooth, named={"Material": radius_material()})
    )
