# SPDX-License-Identifier: GPL-3.0-or-later
"""Medial Axis Balls: instances of the balls whose union is the solid."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .radii import points_with_radii
from .tree import Tree

if TYPE_CHECKING:
    import bpy


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
    return tree.output(balls)
