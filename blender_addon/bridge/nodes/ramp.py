# SPDX-License-Identifier: GPL-3.0-or-later
"""The nodes that two groups share: a share of the scale of colours, stored as `ma_color`."""

from __future__ import annotations

import bpy

from ...core.axis.colours import SCALE
from ..mesh.colours import COLOUR
from .tree import Tree


def stored_colour(
    tree: Tree, geometry: bpy.types.NodeSocket, share: bpy.types.NodeSocket
) -> bpy.types.NodeSocket:
    """The geometry whose points have the colours of shares, from 0 at the first colour to 1 at the last."""
    ramp = tree.node("ShaderNodeValToRGB", share)
    _fill(ramp.node.color_ramp.elements)
    return tree.node(
        "GeometryNodeStoreNamedAttribute",
        named={"Geometry": geometry, "Name": COLOUR, "Value": ramp},
        data_type="FLOAT_COLOR",
        domain="POINT",
    )


def _fill(elements: bpy.types.ColorRampElements) -> None:
    """The colours of all that is coloured here."""
    elements.remove(elements[1])
    for number, (position, colour) in enumerate(SCALE):
        element = elements[0] if number == 0 else elements.new(position)
        element.position, element.color = position, (*colour, 1.0)
