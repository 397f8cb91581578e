# SPDX-License-Identifier: GPL-3.0-or-later
"""A group of Geometry Nodes while it is built, alike in every Blender.

Names and numbers of sockets differ between versions, so those that a node does not use now are passed over, and what
was a property of a node and became a socket is set either way.
"""

from __future__ import annotations

from typing import Any

import bpy
from bpy.types import NodeSocket

COLUMN, ROW = 200, 160  # how far nodes lie apart

# Blender's names of the subtypes of floats up to 3.6, where each is a type of its own.
_EARLIER = {"ANGLE": "NodeSocketFloatAngle", "DISTANCE": "NodeSocketFloatDistance"}


class Tree:
    """A new group with the input *Geometry*; `geometry` is its socket."""

    def __init__(self, name: str) -> None:
        self.group = bpy.data.node_groups.new(name, "GeometryNodeTree")
        if hasattr(self.group, "is_modifier"):  # from 4.0, or the menus of modifiers do not show it
            self.group.is_modifier = True
        self._columns = 0
        self._input = self._add("NodeGroupInput")
        self.geometry = self.input("NodeSocketGeometry", "Geometry")

    def input(
        self, kind: str, name: str, default: Any = None, about: str = "", **settings: Any
    ) -> NodeSocket:
        """A new input of the group; `settings` are those of its socket, such as `min_value` or `subtype`."""
        subtype = settings.pop("subtype", None)
        socket = self._declare("INPUT", kind, name, subtype)
        if default is not None:
            socket.default_value = default
        if about:
            socket.description = about
        for key, value in settings.items():
            setattr(socket, key, value)
        return self._input.outputs[name]

    def number(
        self, name: str, default: float, about: str, subtype: str = "NONE", least: float = 0.0
    ) -> NodeSocket:
        """An input that is a float, not below `least`."""
        return self.input("NodeSocketFloat", name, default, about, subtype=subtype, min_value=least)

    def node(self, kind: str, *values: Any, named: dict[str, Any] | None = None, **settings: Any):
        """A new node, by Blender's identifier; returns its first output.

        `values`, sockets or plain ones, are those of its inputs in order, and None leaves an input as it is; `named`
        has the same by the name of the input. `settings` are properties of the node.
        """
        node = self._add(kind)
        for name, value in settings.items():
            _set(node, name, value)
        used = [socket for socket in node.inputs if socket.enabled]
        for socket, value in zip(used, values):  # noqa: B905 - the rest stay as they are
            self._connect(value, socket)
        for name, value in (named or {}).items():
            self._connect(value, next(socket for socket in used if socket.name == name))
        return next(socket for socket in node.outputs if socket.enabled)

    def math(self, operation: str, *values: Any) -> NodeSocket:
        return self.node("ShaderNodeMath", *values, operation=operation)

    def logic(self, operation: str, *values: Any) -> NodeSocket:
        return self.node("FunctionNodeBooleanMath", *values, operation=operation)

    def compare(self, operation: str, a: Any, b: Any) -> NodeSocket:
        """A mathematical operation on two floats."""
        return self.node("FunctionNodeCompare", a, b, data_type="FLOAT", operation=operation)

    def choose(self, condition: Any, no: Any, yes: Any) -> NodeSocket:
        """One of two floats."""
        return self.node("GeometryNodeSwitch", condition, no, yes, input_type="FLOAT")

    def attribute(self, name: Any) -> NodeSocket:
        """A float of the geometry; 0 where it has no such attribute."""
        return self.node("GeometryNodeInputNamedAttribute", name, data_type="FLOAT")

    def ends(self, value: NodeSocket) -> list[NodeSocket]:
        """The smallest and the largest of a float over the points of the geometry."""
        named = {"Geometry": self.geometry, "Attribute": value}
        kind = "GeometryNodeAttributeStatistic"
        found = self.node(kind, named=named, data_type="FLOAT", domain="POINT").node.outputs
        return [next(s for s in found if s.enabled and s.name == name) for name in ("Min", "Max")]

    def stored(
        self,
        geometry: NodeSocket,
        name: str,
        value: NodeSocket,
        kind: str = "FLOAT",
        domain: str = "POINT",
    ) -> NodeSocket:
        """A geometry with an attribute of this kind."""
        named = {"Geometry": geometry, "Name": name, "Value": value}
        return self.node(
            "GeometryNodeStoreNamedAttribute", named=named, data_type=kind, domain=domain
        )

    def output(self, geometry: NodeSocket) -> bpy.types.GeometryNodeTree:
        """Ends the group; returns it."""
        self._declare("OUTPUT", "NodeSocketGeometry", "Geometry", None)
        self.group.links.new(geometry, self._add("NodeGroupOutput").inputs[0])
        return self.group

    def _add(self, kind: str) -> bpy.types.Node:
        node = self.group.nodes.new(kind)
        node.location = (COLUMN * (self._columns // 3), -ROW * (self._columns % 3))
        self._columns += 1
        return node

    def _declare(self, way: str, kind: str, name: str, subtype: str | None) -> Any:
        """The socket of the group's interface."""
        if not hasattr(self.group, "interface"):  # before 4.0
            sockets = self.group.inputs if way == "INPUT" else self.group.outputs
            return sockets.new(_EARLIER.get(subtype, kind), name)
        socket = self.group.interface.new_socket(name, in_out=way, socket_type=kind)
        if subtype is not None:
            socket.subtype = subtype
        return socket

    def _connect(self, value: Any, socket: NodeSocket) -> None:
        if isinstance(value, NodeSocket):
            self.group.links.new(value, socket)
        elif value is not None:
            socket.default_value = value


def _set(node: bpy.types.Node, name: str, value: Any) -> None:
    """Set a choice of a node: a property, or in later versions a socket with the words that people read."""
    if name in node.bl_rna.properties:
        setattr(node, name, value)
        return
    words = name.replace("_", " ").title()
    menu = next(socket for socket in node.inputs if socket.name == words)
    menu.default_value = {"VOXEL_SIZE": "Size"}.get(value, value.title())
