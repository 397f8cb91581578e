# SPDX-License-Identifier: GPL-3.0-or-later
"""The nodes that two groups share: a share of the scale of colours, stored as `ma_color`."""

from __future__ import annotations

import bpy

from ..mesh.colours import COLOUR
from ..mesh.material import fill_ramp
from .tree import Tree


def stored_colour(
    tree: Tree, geometry: bpy.types.NodeSocket, share: bpy.types.NodeSocket
) -> bpy.types.NodeSocket:
    """The geometry whose points have the colours of shares, from 0 at the first colour to 1 at the last."""
    ramp = tree.node("ShaderNodeValToRGB", share)
    fill_ramp(ramp.node.color_ramp.elements)
    return tree.node(
        "GeometryNodeStoreNamedAttribute",
        named={"Geometry": geometry, "Name": COLOUR, "Value": ramp},
        data_type="FLOAT_COLOR",
        domain="POINT",
    )
