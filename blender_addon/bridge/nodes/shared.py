# SPDX-License-Identifier: GPL-3.0-or-later
"""The parts that groups share: vertices of an axis with radii that an artist may change, balls, tubes and colours."""

from __future__ import annotations

from bpy.types import NodeSocket

from ..mesh.attributes import RADIUS
from ..mesh.colours import COLOUR
from ..mesh.material import fill_ramp
from .tree import Tree


def balls(tree: Tree, points: NodeSocket, radius: NodeSocket, level: NodeSocket) -> NodeSocket:
    """Return smooth spheres of these subdivisions at points, as instances."""
    sphere = tree.node("GeometryNodeMeshIcoSphere", 1.0, level)
    round_one = tree.node("GeometryNodeSetShadeSmooth", sphere)
    return tree.node(
        "GeometryNodeInstanceOnPoints",
        named={"Points": points, "Instance": round_one, "Scale": radius},
    )


def tubes(
    tree: Tree,
    curves: NodeSocket,
    radius: NodeSocket,
    sides: NodeSocket,
    caps: bool = False,
) -> NodeSocket:
    """Return tubes along curves, a radius at each of their points, open or with caps at their ends."""
    curves = tree.node("GeometryNodeSetCurveRadius", named={"Curve": curves, "Radius": radius})
    circle = tree.node(
        "GeometryNodeCurvePrimitiveCircle", named={"Resolution": sides, "Radius": 1.0}
    )
    named = {"Curve": curves, "Profile Curve": circle, "Fill Caps": caps}
    made = tree.node("GeometryNodeCurveToMesh", named=named)
    scale = made.node.inputs.get("Scale")  # where it exists, radii of curves have no effect
    if scale is not None:
        tree.group.links.new(radius, scale)
    return made


def points_with_radii(
    tree: Tree, merge: NodeSocket, axis: NodeSocket | None = None
) -> tuple[NodeSocket, NodeSocket]:
    """Return (the points of the axis, their radii), with the inputs *Factor*, *Offset* and *Min Radius*.

    Of vertices closer than `merge` one stays. A radius times the factor plus the offset is a thicker or thinner solid;
    where that is nothing, there is no ball. `axis` is the mesh if that is not the geometry of the group.
    """
    factor = tree.number("Factor", 1.0, "Radii are multiplied by this")
    offset = tree.number(
        "Offset", 0.0, "Radii grow by this; negative: they shrink", "DISTANCE", least=-1e30
    )
    least = tree.number("Min Radius", 0.0, "Without balls that were smaller than this", "DISTANCE")
    original = tree.attribute(RADIUS.name)
    radius = tree.math("MULTIPLY_ADD", original, factor, offset)
    small = tree.compare("LESS_THAN", original, least)
    nothing = tree.compare("LESS_EQUAL", radius, 0.0)
    kept = tree.node(
        "GeometryNodeDeleteGeometry",
        tree.geometry if axis is None else axis,
        tree.logic("OR", small, nothing),
        domain="POINT",
        mode="ALL",
    )
    points = tree.node("GeometryNodeMeshToPoints", named={"Mesh": kept})
    return tree.node(
        "GeometryNodeMergeByDistance", named={"Geometry": points, "Distance": merge}
    ), radius


def stored_colour(tree: Tree, geometry: NodeSocket, share: NodeSocket) -> NodeSocket:
    """The geometry whose points have the colours of shares, from 0 at the first colour to 1 at the last."""
    ramp = tree.node("ShaderNodeValToRGB", share)
    fill_ramp(ramp.node.color_ramp.elements)
    return tree.stored(geometry, COLOUR, ramp, "FLOAT_COLOR")
