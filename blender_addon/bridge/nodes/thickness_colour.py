# SPDX-License-Identifier: GPL-3.0-or-later
"""Medial Axis Thickness Colour: a number of each vertex as a colour, live."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...core.axis.colours import SCALE
from ..attributes import RADIUS
from ..colours import COLOUR
from .tree import Tree

if TYPE_CHECKING:
    import bpy


def build(name: str) -> bpy.types.GeometryNodeTree:
    """The group: writes the colour attribute `ma_color`, which Solid view shows with Color: Attribute."""
    tree = Tree(name)
    attribute = tree.attribute(
        tree.input("NodeSocketString", "Attribute", RADIUS.name, "Which number is shown")
    )
    start = tree.number("Start", 0.0, "The number of the first colour", least=-1e30)
    end = tree.number(
        "End",
        0.0,
        "The number of the last colour; where it is that of the first: all there are",
        least=-1e30,
    )
    found = tree.node(
        "GeometryNodeAttributeStatistic",
        named={"Geometry": tree.geometry, "Attribute": attribute},
        data_type="FLOAT",
        domain="POINT",
    ).node
    ends = [next(s for s in found.outputs if s.enabled and s.name == n) for n in ("Min", "Max")]
    all_of_them = tree.compare("EQUAL", start, end)
    low = tree.choose(all_of_them, start, ends[0])
    high = tree.choose(all_of_them, end, ends[1])
    share = tree.math(
        "DIVIDE", tree.math("SUBTRACT", attribute, low), tree.math("SUBTRACT", high, low)
    )
    ramp = tree.node("ShaderNodeValToRGB", share)
    _fill(ramp.node.color_ramp.elements)
    return tree.output(
        tree.node(
            "GeometryNodeStoreNamedAttribute",
            named={"Geometry": tree.geometry, "Name": COLOUR, "Value": ramp},
            data_type="FLOAT_COLOR",
            domain="POINT",
        )
    )


def _fill(elements: bpy.types.ColorRampElements) -> None:
    """The colours of all that is coloured here."""
    elements.remove(elements[1])
    for number, (position, colour) in enumerate(SCALE):
        element = elements[0] if number == 0 else elements.new(position)
        element.position, element.color = position, (*colour, 1.0)
