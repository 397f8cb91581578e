# SPDX-License-Identifier: GPL-3.0-or-later
"""Medial Axis Filter: fewer facets of a medial axis, live."""

from __future__ import annotations

import bpy
from bpy.types import NodeSocket

from .tree import Tree

_ALONE = "ma_alone"  # marks edges without facets while the others lose theirs


def build(name: str) -> bpy.types.GeometryNodeTree:
    """The group; it can only take away what the axis has."""
    tree = Tree(name)
    stays = _stays(tree)
    limb = tree.number("Limb", 0.0, "Edges without facets of limbs shorter than this go; percent")
    alone = tree.compare("EQUAL", tree.node("GeometryNodeInputMeshEdgeNeighbors"), 0.0)
    marked = tree.stored(tree.geometry, _ALONE, alone, "BOOLEAN", "EDGE")
    facets = tree.node(
        "GeometryNodeDeleteGeometry",
        marked,
        tree.logic("NOT", stays),
        domain="FACE",
        mode="ONLY_FACE",
    )
    # Only now: what was between two facets may have lost both.
    neighbours = tree.node("GeometryNodeInputMeshEdgeNeighbors")
    was_alone = tree.node("GeometryNodeInputNamedAttribute", _ALONE, data_type="BOOLEAN")
    short = tree.compare("LESS_THAN", tree.attribute("ma_limb"), limb)
    lost = tree.logic("OR", tree.logic("NOT", was_alone), short)
    lost = tree.logic("AND", tree.compare("EQUAL", neighbours, 0.0), lost)
    edges = tree.node("GeometryNodeDeleteGeometry", facets, lost, domain="EDGE", mode="ALL")
    return tree.output(tree.node("GeometryNodeRemoveAttribute", edges, named={"Name": _ALONE}))


def _stays(tree: Tree) -> NodeSocket:
    """Keeps the facets that pass theta or rho, where these are above 0, and everything that is no facet."""
    theta = tree.number(
        "Theta",
        0.0,
        "Facets with a larger angle stay, or, where Rho is set too, with a larger ratio; 0: not asked",
        "ANGLE",
    )
    rho = tree.number("Rho", 0.0, "Facets with a larger ratio stay; 0: not asked")
    asked = [
        tree.logic(
            "AND",
            tree.compare("GREATER_THAN", limit, 0.0),
            tree.compare("GREATER_THAN", tree.attribute(attribute), limit),
        )
        for attribute, limit in (("ma_theta", theta), ("ma_rho", rho))
    ]
    neither = tree.compare("LESS_EQUAL", tree.math("ADD", theta, rho), 0.0)
    stays = tree.logic("OR", neither, tree.logic("OR", *asked))
    for label, attribute, subtype, about in _FLOORS:
        limit = tree.number(label, 0.0, about, subtype)
        large = tree.compare("GREATER_EQUAL", tree.attribute(attribute), limit)
        stays = tree.logic("AND", stays, large)
    return stays


_FLOORS = (
    ("Radius", "ma_radius", "DISTANCE", "Facets with a smaller mean radius go"),
    (
        "Sheet",
        "ma_sheet",
        "NONE",
        "Facets of sheets that are thinner go, as by Simplify; percent of the diagonal, of the form Clean",
    ),
    (
        "Erosion",
        "ma_erosion",
        "NONE",
        "Rims recede, as by Trim Rims; percent of the diagonal, of the form Clean",
    ),
)
