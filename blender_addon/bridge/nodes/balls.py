# SPDX-License-Identifier: GPL-3.0-or-later
"""Medial Axis Balls: the balls whose union is the solid, as instances or as one mesh with colours."""

from __future__ import annotations

import bpy

from ..mesh.material import radius_material
from .radii import points_with_radii
from .tree import Tree

COLOURED = "Coloured"


def build(name: str) -> bpy.types.GeometryNodeTree:
    """The group: one sphere per vertex of the axis that is left."""
    tree = Tree(name)
    merge = tree.number(
        "Merge", 0.0, "Of vertices closer than this only one has a ball", "DISTANCE"
    )
    points, radius = points_with_radii(tree, merge)
    level = tree.input(
        "NodeSocketInt", "Subdivisions", 2, "Of each sphere", min_value=1, max_value=6
    )
    sphere = tree.node("GeometryNodeMeshIcoSphere", 1.0, level)
    round_one = tree.node("GeometryNodeSetShadeSmooth", sphere)
    balls = tree.node(
        "GeometryNodeInstanceOnPoints",
        named={"Points": points, "Instance": round_one, "Scale": radius},
    )
    coloured = tree.input(
        "NodeSocketBool",
        COLOURED,
        False,
        "One mesh with the colours of the vertices, which instances cannot show in Solid view",
    )
    mesh = tree.node(
        "GeometryNodeSetMaterial",
        tree.node("GeometryNodeRealizeInstances", balls),
        named={"Material": radius_material()},
    )
    return tree.output(
        tree.node("GeometryNodeSwitch", coloured, balls, mesh, input_type="GEOMETRY")
    )
