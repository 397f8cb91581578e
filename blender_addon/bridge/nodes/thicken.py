# SPDX-License-Identifier: GPL-3.0-or-later
"""Medial Axis Thicken: moves each vertex of a mesh by its vector `ma_thicken`, live."""

from __future__ import annotations

import bpy

from .tree import Tree

MOVES = "ma_thicken"


def build(name: str) -> bpy.types.GeometryNodeTree:
    """The group; 0 takes the walls back to where they were."""
    tree = Tree(name)
    factor = tree.number("Factor", 1.0, "How much of the missing thickness the walls get")
    moves = tree.node("GeometryNodeInputNamedAttribute", MOVES, data_type="FLOAT_VECTOR")
    offset = tree.node(
        "ShaderNodeVectorMath", named={"Vector": moves, "Scale": factor}, operation="SCALE"
    )
    return tree.output(
        tree.node("GeometryNodeSetPosition", named={"Geometry": tree.geometry, "Offset": offset})
    )
