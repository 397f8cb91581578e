# SPDX-License-Identifier: GPL-3.0-or-later
"""Edges without a face and single points as tubes and balls: Blender draws them as hairlines, and renders none.

They are made by a modifier of Geometry Nodes, so the mesh itself, its counts and what is exported of it stay the axis.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import bpy
import numpy as np

from .material import radius_material

if TYPE_CHECKING:
    from ..core.axis.medial_axis import MedialAxis

NAME = "Medial Axis Wires"
WIRES = "ma_wires"  # how many edges without a face and single points a result has
_WIDTH = "Width"
_THIN = 0.004  # radius of a tube, as a share of the size of the axis
_THICKER = 2.0  # balls than tubes


def show_wires(thing: bpy.types.Object, axis: MedialAxis) -> None:
    """Give an object tubes and balls where its axis has wires and single points, and take them away where not.

    Where an artist removed the modifier from an object that had wires, it does not come back.
    """
    count, before = _loose(axis), thing.get(WIRES, 0)
    thing[WIRES] = count
    modifier = thing.modifiers.get(NAME)
    if count and not before and modifier is None:
        modifier = thing.modifiers.new(NAME, "NODES")
        modifier.node_group = _group()
        modifier.show_in_editmode = False
        modifier.show_expanded = False
        width = width_of(modifier)
        if width is not None:
            _set(*width, _THIN * _size(axis))
    elif modifier is not None and not count:
        thing.modifiers.remove(modifier)


def wires_of(thing: bpy.types.Object) -> bpy.types.Modifier | None:
    """The modifier that shows the wires of an object; None where there is none."""
    modifier = thing.modifiers.get(NAME)
    return modifier if modifier is not None and modifier.type == "NODES" else None


def width_of(modifier: bpy.types.Modifier) -> tuple[Any, str] | None:
    """(owner, path) of the width of the tubes, as `layout.prop` wants them; None where the input is gone."""
    sockets = _width_sockets(modifier.node_group)
    if not sockets:
        return None
    identifier = sockets[0].identifier
    if hasattr(modifier, "properties"):  # from 5.2
        return getattr(modifier.properties.inputs, identifier), "value"
    return modifier, f'["{identifier}"]'


def _width_sockets(tree: bpy.types.NodeTree | None) -> list[Any]:
    if tree is None:
        return []
    sockets = tree.interface.items_tree if hasattr(tree, "interface") else tree.inputs  # from 4.0
    return [socket for socket in sockets if socket.name == _WIDTH]


def _set(owner: Any, path: str, value: float) -> None:
    if path == "value":
        owner.value = value
    else:
        owner[path[2:-2]] = value


def _loose(axis: MedialAxis) -> int:
    """The number of edges without a facet, and of vertices without a facet and an edge."""
    used = np.zeros(len(axis.vertices), np.bool_)
    used[axis.face_vertices] = True
    used[axis.edges.ravel()] = True
    return len(axis.edges) + int(np.count_nonzero(~used))


def _size(axis: MedialAxis) -> float:
    """Diagonal of the axis with its balls: a single point has a size, too."""
    return float(np.linalg.norm(np.ptp(axis.vertices, axis=0))) + 2.0 * float(axis.radius.max())


def _group() -> bpy.types.NodeTree:
    """The node group, made where the file has none with a width; other changes that an artist made in it stay."""
    found = bpy.data.node_groups.get((NAME, None))
    return found if _width_sockets(found) else _new_group()


def _new_group() -> bpy.types.NodeTree:
    tree = bpy.data.node_groups.new(NAME, "GeometryNodeTree")
    _add_sockets(tree)
    node = _Nodes(tree)
    given, result = node("NodeGroupInput"), node("NodeGroupOutput")
    tubes, balls = _tubes(node, given), _balls(node, given)
    round_parts, whole = node("GeometryNodeJoinGeometry"), node("GeometryNodeJoinGeometry")
    painted = node("GeometryNodeSetMaterial")
    painted.inputs[2].default_value = radius_material()
    node.link(balls, round_parts.inputs[0])
    node.link(tubes, round_parts.inputs[0])
    node.link(round_parts.outputs[0], painted.inputs[0])
    for geometry in (painted.outputs[0], given.outputs[0]):  # the last to be linked comes first
        node.link(geometry, whole.inputs[0])
    node.link(whole.outputs[0], result.inputs[0])
    return tree


class _Nodes:
    """Makes nodes of a tree from left to right. Sockets go by number, for their names differ between versions."""

    def __init__(self, tree: bpy.types.NodeTree) -> None:
        self.tree = tree
        self.link = tree.links.new

    def __call__(self, kind: str) -> Any:
        node = self.tree.nodes.new(kind)
        number = len(self.tree.nodes)
        node.location = (200 * (number % 8), -200 * (number // 8))
        return node

    def without(self, kind: str) -> Any:
        """True where an element has no neighbours, as an input node counts them."""
        no = self("FunctionNodeBooleanMath")
        no.operation = "NOT"
        self.link(self(kind).outputs[0], no.inputs[0])
        return no.outputs[0]


def _add_sockets(tree: bpy.types.NodeTree) -> None:
    if hasattr(tree, "interface"):  # from 4.0
        new = tree.interface.new_socket
        new("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
        width = new(_WIDTH, in_out="INPUT", socket_type="NodeSocketFloat")
        new("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
        tree.is_modifier = True
    else:
        tree.inputs.new("NodeSocketGeometry", "Geometry")
        width = tree.inputs.new("NodeSocketFloatDistance", _WIDTH)
        tree.outputs.new("NodeSocketGeometry", "Geometry")
    width.min_value = 0.0
    width.default_value = 0.01
    if hasattr(width, "subtype"):
        width.subtype = "DISTANCE"


def _tubes(node: _Nodes, given: Any) -> Any:
    """Tubes along the edges that have no face."""
    curves, mesh = node("GeometryNodeMeshToCurve"), node("GeometryNodeCurveToMesh")
    circle = node("GeometryNodeCurvePrimitiveCircle")
    circle.inputs[0].default_value = 8
    node.link(given.outputs[1], circle.inputs[4])
    node.link(given.outputs[0], curves.inputs[0])
    node.link(node.without("GeometryNodeInputMeshEdgeNeighbors"), curves.inputs[1])
    node.link(curves.outputs[0], mesh.inputs[0])
    node.link(circle.outputs[0], mesh.inputs[1])
    next(s for s in mesh.inputs if s.name == "Fill Caps").default_value = True
    return mesh.outputs[0]


def _balls(node: _Nodes, given: Any) -> Any:
    """Balls at the vertices that have no edge."""
    points, balls = node("GeometryNodeMeshToPoints"), node("GeometryNodeInstanceOnPoints")
    ball, real = node("GeometryNodeMeshIcoSphere"), node("GeometryNodeRealizeInstances")
    ball.inputs[1].default_value = 3
    thicker = node("ShaderNodeMath")
    thicker.operation = "MULTIPLY"
    thicker.inputs[1].default_value = _THICKER
    node.link(given.outputs[1], thicker.inputs[0])
    node.link(thicker.outputs[0], ball.inputs[0])
    node.link(given.outputs[0], points.inputs[0])
    node.link(node.without("GeometryNodeInputMeshVertexNeighbors"), points.inputs[1])
    node.link(points.outputs[0], balls.inputs[0])
    node.link(ball.outputs[0], balls.inputs[2])
    node.link(balls.outputs[0], real.inputs[0])
    return real.outputs[0]
