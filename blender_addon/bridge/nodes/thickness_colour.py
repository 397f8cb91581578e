# SPDX-License-Identifier: GPL-3.0-or-later
"""Medial Axis Thickness Colour: a number of each vertex as a colour, live."""

from __future__ import annotations

import bpy

from ..mesh.attributes import RADIUS
from .shared import stored_colour
from .tree import Tree


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
    ends = tree.ends(attribute)
    all_of_them = tree.compare("EQUAL", start, end)
    low = tree.choose(all_of_them, start, ends[0])
    high = tree.choose(all_of_them, end, ends[1])
    share = tree.math(
        "DIVIDE", tree.math("SUBTRACT", attribute, low), tree.math("SUBTRACT", high, low)
    )
    return tree.output(stored_colour(tree, tree.geometry, share))
