# SPDX-License-Identifier: GPL-3.0-or-later
"""Medial Axis Balls: the balls whose union is the solid, as instances or as one mesh with colours."""

from __future__ import annotations

import bpy

from ..mesh.material import radius_material
from .shared import balls, points_with_radii
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
    instances = balls(tree, points, radius, level)
    coloured = tree.input(
        "NodeSocketBool",
        COLOURED,
        False,
        "One mesh with the colours of the vertices, which instances cannot show in Solid view",
    )
    mesh = tree.node(
        "GeometryNodeSetMaterial",
        tree.node("GeometryNodeRealizeInstances", instances),
        named={"Material": radius_material()},
    )
    return tree.output(
        tree.node("GeometryNodeSwitch", coloured, instances, mesh, input_type="GEOMETRY")
    )
