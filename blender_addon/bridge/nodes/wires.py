# SPDX-License-Identifier: GPL-3.0-or-later
"""Edges without a face and single points as tubes and balls: Blender draws them as hairlines, and renders none.

They are made by a modifier of Geometry Nodes, so the mesh itself, its counts and what is exported of it stay the axis.
No tube is thicker than a fifth of the ball of the axis there, and tubes end in balls of their own width. Single points
are that fifth, so that the axis of a sphere is seen; they are shown where the look asks for them, or where the axis is
nothing else; of a scan they are noise. The more of them there are, the fewer faces each has: Blender makes them anew in
its main thread after every change.
"""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
from bpy.types import NodeSocket

from ...core.axis.medial_axis import MedialAxis
from ...core.small_matrices import length_of
from ..mesh import stored
from ..mesh.attributes import RADIUS
from ..mesh.material import radius_material
from .inputs import has_inputs, input_of, row_of, set_inputs
from .shared import balls, tubes
from .tree import Tree

NAME = "Medial Axis Wires"
_WIDTH, _SIDES, _SUBDIVISIONS, _POINTS = "Width", "Sides", "Subdivisions", "Points"
_SHARE = 0.2  # of the ball of the axis: a single point, and the most that a tube may be thick
_MOST_SIDES = 12
_THIN = 0.004  # radius of a tube, as a share of the size of the axis
_MOST_FACES = 200_000  # of all tubes, and of all balls
_FACES_OF_BALLS = {3: 320, 2: 80, 1: 20}  # by Subdivisions


def show_wires(thing: bpy.types.Object, axis: MedialAxis, lone_points: bool = False) -> None:
    """Give an object tubes and balls where its axis has wires and single points, and take them away where not.

    Single points are shown where `lone_points` says so, or where there is nothing else. Where an artist removed the
    modifier from an object that had wires, it does not come back.
    """
    points, ends = _points_and_ends(axis)
    shown = lone_points or not (axis.facets or len(axis.edges))
    thing[stored.LONE_POINTS] = 0 if shown else points
    count, before = len(axis.edges) + points, thing.get(stored.WIRES, 0)
    thing[stored.WIRES] = count
    modifier = thing.modifiers.get(NAME)
    if count and not before and modifier is None:
        modifier = thing.modifiers.new(NAME, "NODES")
        modifier.node_group = wires_group()
        modifier.show_in_editmode = False
        modifier.show_expanded = False
        set_inputs(modifier, {_WIDTH: _THIN * _size(axis)})
        thing.pop(stored.WIRES_DETAIL, None)
    elif modifier is not None and not count:
        thing.modifiers.remove(modifier)
        return
    if modifier is not None:
        _set_detail(thing, modifier, detail_of(len(axis.edges), ends + points * shown))
        if has_inputs(modifier.node_group, _POINTS):
            set_inputs(modifier, {_POINTS: bool(shown)})


def detail_of(edges: int, points: int) -> tuple[int, int]:
    """(sides of each tube, subdivisions of each ball) for these numbers of them; 0 where there are too many to show."""
    sides = min(_MOST_SIDES, _MOST_FACES // max(edges, 1))
    fitting = (n for n, faces in _FACES_OF_BALLS.items() if points * faces <= _MOST_FACES)
    return (sides if sides >= 3 else 0), next(fitting, 0)


def wires_of(thing: bpy.types.Object) -> bpy.types.Modifier | None:
    """The modifier that shows the wires of an object; None where there is none."""
    modifier = thing.modifiers.get(NAME)
    return modifier if modifier is not None and modifier.type == "NODES" else None


def width_of(modifier: bpy.types.Modifier) -> tuple[Any, str] | None:
    """Return (owner, path) of the width of the tubes, as `layout.prop` wants them; None where the input is gone."""
    return row_of(modifier, _WIDTH) if has_inputs(modifier.node_group, _WIDTH) else None


def _set_detail(
    thing: bpy.types.Object, modifier: bpy.types.Modifier, detail: tuple[int, int]
) -> None:
    """Set the numbers of faces that fit the number of wires, unless an artist has chosen others."""
    names = (_SIDES, _SUBDIVISIONS)
    if not has_inputs(modifier.node_group, *names):  # of an older version
        return
    kept = thing.get(stored.WIRES_DETAIL)
    if kept is None or [input_of(modifier, name) for name in names] == list(kept):
        set_inputs(modifier, dict(zip(names, detail, strict=True)))
        thing[stored.WIRES_DETAIL] = detail


def _points_and_ends(axis: MedialAxis) -> tuple[int, int]:
    """The numbers of vertices without a facet and an edge, and of those where wires alone end or fork."""
    wires = np.bincount(axis.edges.ravel(), minlength=len(axis.vertices))
    bare = np.ones(len(axis.vertices), np.bool_)
    bare[axis.face_vertices] = False
    return tuple(
        int(np.count_nonzero(bare & of)) for of in (wires == 0, (wires == 1) | (wires > 2))
    )


def _size(axis: MedialAxis) -> float:
    """Diagonal of the axis with its balls: a single point has a size, too."""
    return length_of(np.ptp(axis.vertices, axis=0)) + 2.0 * float(axis.radius.max())


def wires_group() -> bpy.types.NodeTree:
    """The node group, made where the file has none with these inputs; other changes that an artist made in it stay."""
    inputs = (_WIDTH, _SIDES, _SUBDIVISIONS, _POINTS)
    for found in bpy.data.node_groups:
        if found.library is None and found.name.startswith(NAME) and has_inputs(found, *inputs):
            return found
    return _new_group()


def _new_group() -> bpy.types.NodeTree:
    tree = Tree(NAME)
    width = tree.number(
        _WIDTH, 0.01, "The radius of tubes, at most a fifth of that of the ball there", "DISTANCE"
    )
    sides = tree.input(
        "NodeSocketInt",
        _SIDES,
        _MOST_SIDES,
        "Of each tube; below 3 there are none",
        min_value=0,
        max_value=64,
    )
    level = tree.input(
        "NodeSocketInt",
        _SUBDIVISIONS,
        3,
        "Of each ball; below 1 there are none",
        min_value=0,
        max_value=6,
    )
    points = tree.input("NodeSocketBool", _POINTS, False, "Single points are shown as balls, too")
    radius = tree.attribute(RADIUS.name)
    thick = tree.math("MULTIPLY", radius, _SHARE)
    thin = tree.math("MINIMUM", width, thick)
    neighbours = tree.node("GeometryNodeInputMeshVertexNeighbors").node.outputs
    edges, faces = neighbours["Vertex Count"], neighbours["Face Count"]
    bare = tree.compare("LESS_THAN", faces, 0.5)
    lone = tree.compare("LESS_THAN", edges, 0.5)
    # A wire continues where it has two neighbours; elsewhere it ends or forks.
    ends = tree.logic("AND", bare, tree.compare("GREATER_THAN", _away_from_two(tree, edges), 0.5))
    has_tubes = tree.compare("GREATER_THAN", sides, 2.5)
    ends = tree.logic("AND", tree.logic("AND", ends, tree.logic("NOT", lone)), has_tubes)
    parts = (
        _tubes(tree, thin, sides),
        _balls(tree, thin, level, ends),
        _balls(tree, thick, level, tree.logic("AND", lone, points)),
    )
    painted = tree.node(
        "GeometryNodeSetMaterial",
        _joined(tree, *parts),
        named={"Material": radius_material()},
    )
    return tree.output(_joined(tree, _without_hairlines(tree, has_tubes), painted))


def _without_hairlines(tree: Tree, has_tubes: NodeSocket) -> NodeSocket:
    """The axis without the edges for which tubes stand, or which are too many for tubes beside sheets:
    newer Blenders draw them black."""
    size = tree.node("GeometryNodeAttributeDomainSize", tree.geometry).node.outputs
    sheets = tree.compare("GREATER_THAN", size["Face Count"], 0.5)
    alone = tree.logic("NOT", tree.node("GeometryNodeInputMeshEdgeNeighbors"))
    gone = tree.logic("AND", alone, tree.logic("OR", has_tubes, sheets))
    return tree.node(
        "GeometryNodeDeleteGeometry", tree.geometry, gone, domain="EDGE", mode="EDGE_FACE"
    )


def _joined(tree: Tree, *parts: NodeSocket) -> NodeSocket:
    """The parts as one geometry, the first of them first."""
    whole = tree.node("GeometryNodeJoinGeometry")
    for part in reversed(parts):  # the last to be linked comes first
        tree.group.links.new(part, whole.node.inputs[0])
    return whole


def _away_from_two(tree: Tree, count: NodeSocket) -> NodeSocket:
    return tree.math("ABSOLUTE", tree.math("SUBTRACT", count, 2.0))


def _tubes(tree: Tree, radius: NodeSocket, sides: NodeSocket) -> NodeSocket:
    """Tubes along the edges that have no face."""
    shown = tree.compare("GREATER_THAN", sides, 2.5)
    alone = tree.logic("NOT", tree.node("GeometryNodeInputMeshEdgeNeighbors"))
    curves = tree.node("GeometryNodeMeshToCurve", tree.geometry, tree.logic("AND", alone, shown))
    return tubes(tree, curves, radius, tree.math("MAXIMUM", sides, 3.0), caps=True)


def _balls(tree: Tree, radius: NodeSocket, level: NodeSocket, where: NodeSocket) -> NodeSocket:
    """Balls at some of the vertices."""
    shown = tree.logic("AND", where, tree.compare("GREATER_THAN", level, 0.5))
    points = tree.node(
        "GeometryNodeMeshToPoints", named={"Mesh": tree.geometry, "Selection": shown}
    )
    some = balls(tree, points, radius, tree.math("MAXIMUM", level, 1.0))
    return tree.node("GeometryNodeRealizeInstances", some)
