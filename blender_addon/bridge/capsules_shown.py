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
    for part in (_spheres(tree, radius, level), _tubes(tree, radius, sides)):
        tree.group.links.new(part, whole.node.inputs[0])
    smooth = tree.node("GeometryNodeSetShadeSmooth", whole)
    return tree.output(
        tree.node("GeometryNodeSetMaterial", smooth, named={"Material": radius_material()})
    )


def _spheres(
    tree: Tree, radius: bpy.types.NodeSocket, level: bpy.types.NodeSocket
) -> bpy.types.NodeSocket:
    points = tree.node("GeometryNodeMeshToPoints", named={"Mesh": tree.geometry})
    sphere = tree.node("GeometryNodeMeshIcoSphere", 1.0, level)
    spheres = tree.node(
        "GeometryNodeInstanceOnPoints",
        named={"Points": points, "Instance": sphere, "Scale": radius},
    )
    return tree.node("GeometryNodeRealizeInstances", spheres)


def _tubes(
    tree: Tree, radius: bpy.types.NodeSocket, sides: bpy.types.NodeSocket
) -> bpy.types.NodeSocket:
    curves = tree.node("GeometryNodeMeshToCurve", tree.geometry)
    curves = tree.node("GeometryNodeSetCurveRadius", named={"Curve": curves, "Radius": radius})
    circle = tree.node(
        "GeometryNodeCurvePrimitiveCircle", named={"Resolution": sides, "Radius": 1.0}
    )
    tubes = tree.node("GeometryNodeCurveToMesh", named={"Curve": curves, "Profile Curve": circle})
    scale = tubes.node.inputs.get("Scale")  # where it exists, radii of curves have no effect
    if scale is not None:
        tree.group.links.new(radius, scale)
    return tubes
