# SPDX-License-Identifier: GPL-3.0-or-later
"""Medial Axis Rebuild: the solid of an axis and its radii, as a mesh."""

from __future__ import annotations

import bpy
from bpy.types import NodeSocket

from ..mesh.attributes import RADIUS
from ..mesh.material import radius_material
from .shared import points_with_radii, stored_colour
from .tree import Tree

# Grids of distances came with 4.x, behind an experimental option, and are there for all from 5.0.
HAS_DISTANCE_GRIDS = bpy.app.version >= (5, 0, 0)
MATERIAL = "Material"
_VOXEL = 2.0**-7  # the size at which the solid is made
_EDGES = 90_000.0  # about as many as those of the facets of an axis of 40,000 samples
_MEANS = 4  # of radii over the faces around a vertex


def build(name: str) -> bpy.types.GeometryNodeTree:
    """The group. Where this Blender has grids of signed distances, the surface is smooth; else it is that of a fog of
    voxels, which has terraces, of which one pass of smoothing takes the edges."""
    tree = Tree(name)
    voxel = _voxel(tree)
    merge = tree.number("Merge", 1.0, "Of vertices closer than this only one counts; voxels")
    merged = tree.math("MULTIPLY", voxel, merge)
    points, radius = points_with_radii(tree, merged, _divided(tree))
    # OpenVDB ends Blender for voxels whose volume is next to nothing. So the solid is made of voxels of one size,
    # and scaled back.
    growth = tree.math("DIVIDE", _VOXEL, voxel)
    surface = _from_distances if HAS_DISTANCE_GRIDS else _from_fog
    mesh = surface(
        tree, _scaled(tree, points, growth), tree.math("MULTIPLY", radius, growth), _VOXEL
    )
    mesh = _scaled(tree, mesh, tree.math("DIVIDE", voxel, _VOXEL))
    mesh = _coloured(tree, mesh, points)
    about = "Of the solid; the usual one has the colours of radii"
    material = tree.input("NodeSocketMaterial", MATERIAL, radius_material(), about)
    mesh = tree.node("GeometryNodeSetMaterial", mesh, named={"Material": material})
    return tree.output(tree.node("GeometryNodeSetShadeSmooth", mesh))


def _divided(tree: Tree) -> NodeSocket:
    """The axis, divided until it has nearly as many edges as balls make a smooth solid: radii between are linear."""
    # The outputs are numbers of points, edges, faces and others.
    size = tree.node("GeometryNodeAttributeDomainSize", tree.geometry, component="MESH").node
    more = tree.math("DIVIDE", _EDGES, size.outputs[1])
    level = tree.math("FLOOR", tree.math("MAXIMUM", tree.math("LOGARITHM", more, 4.0), 0.0))
    return tree.node(
        "GeometryNodeSubdivideMesh",
        named={"Mesh": tree.geometry, "Level": level},
    )


def _coloured(tree: Tree, mesh: NodeSocket, points: NodeSocket) -> NodeSocket:
    """The solid with the radius of the balls near each vertex, and with the colours of the axis for it.

    That of the nearest one alone would jump from ball to ball, in teeth as wide as voxels. So it is the mean over the
    faces around, several times.
    """
    row = tree.node("GeometryNodeSampleNearest", points, domain="POINT")
    radius = tree.node(
        "GeometryNodeSampleIndex",
        named={"Geometry": points, "Value": tree.attribute(RADIUS.name), "Index": row},
        data_type="FLOAT",
        domain="POINT",
    )
    mesh = tree.stored(mesh, RADIUS.name, radius)
    mean = tree.attribute(RADIUS.name)
    for domain in ("FACE", "POINT") * _MEANS:
        mean = tree.node("GeometryNodeFieldOnDomain", mean, data_type="FLOAT", domain=domain)
    mesh = tree.stored(mesh, RADIUS.name, mean)
    least, most = tree.ends(tree.attribute(RADIUS.name))
    end = tree.math("MINIMUM", least, tree.math("MULTIPLY", most, 0.5))  # as in `radius_range`
    below = tree.math("SUBTRACT", most, tree.attribute(RADIUS.name))
    return stored_colour(tree, mesh, tree.math("DIVIDE", below, tree.math("SUBTRACT", most, end)))


def _scaled(tree: Tree, geometry: NodeSocket, factor: NodeSocket) -> NodeSocket:
    """The geometry with its positions multiplied by a factor."""
    place = tree.node(
        "ShaderNodeVectorMath",
        named={"Vector": tree.node("GeometryNodeInputPosition"), "Scale": factor},
        operation="SCALE",
    )
    return tree.node("GeometryNodeSetPosition", named={"Geometry": geometry, "Position": place})


def _voxel(tree: Tree) -> NodeSocket:
    """The size of voxels: the wanted one, or 1/128 of the diagonal of the axis and its largest ball.

    Without the ball a solid that is one, whose axis is a point, would get as many voxels as memory holds.
    """
    asked = tree.number(
        "Voxel", 0.0, "Size of voxels; 0: a 128th of the diagonal of the solid", "DISTANCE"
    )
    box = tree.node("GeometryNodeBoundBox", tree.geometry).node
    across = tree.node(
        "ShaderNodeVectorMath", box.outputs["Max"], box.outputs["Min"], operation="SUBTRACT"
    )
    length = tree.node("ShaderNodeVectorMath", across, operation="LENGTH")
    _, largest = tree.ends(tree.attribute(RADIUS.name))
    whole = tree.math("MULTIPLY_ADD", largest, 2.0, length)
    return tree.choose(
        tree.compare("GREATER_THAN", asked, 0.0), tree.math("DIVIDE", whole, 128.0), asked
    )


def _from_distances(tree: Tree, points: NodeSocket, radius: NodeSocket, voxel: float) -> NodeSocket:
    grid = tree.node(
        "GeometryNodePointsToSDFGrid",
        named={"Points": points, "Radius": radius, "Voxel Size": voxel},
    )
    return tree.node("GeometryNodeGridToMesh", named={"Grid": grid, "Threshold": 0.0})


def _from_fog(tree: Tree, points: NodeSocket, radius: NodeSocket, voxel: float) -> NodeSocket:
    fog = tree.node(
        "GeometryNodePointsToVolume",
        named={"Points": points, "Radius": radius, "Voxel Size": voxel, "Density": 1.0},
        resolution_mode="VOXEL_SIZE",
    )
    mesh = tree.node("GeometryNodeVolumeToMesh", named={"Volume": fog})
    # The dual of the dual has the same faces, and each vertex is the mean of what is round it.
    return tree.node("GeometryNodeDualMesh", tree.node("GeometryNodeDualMesh", mesh))
