# SPDX-License-Identifier: GPL-3.0-or-later
"""Inputs of modifiers with a group of nodes: three versions of Blender keep them in three places."""

from __future__ import annotations

from typing import Any

import bpy


def set_inputs(modifier: bpy.types.NodesModifier, values: dict[str, Any]) -> None:
    """Give a modifier values of inputs, by their names."""
    for name, value in values.items():
        _write(modifier, _identifier(modifier.node_group, name), value)
    modifier.id_data.update_tag()


def has_inputs(tree: bpy.types.NodeTree | None, *names: str) -> bool:
    """Return whether a group has these inputs; one that an older version made may lack some."""
    if tree is None:
        return False
    sockets = tree.interface.items_tree if hasattr(tree, "interface") else tree.inputs  # from 4.0
    return set(names) <= {socket.name for socket in sockets}


def input_of(modifier: bpy.types.NodesModifier, name: str) -> Any:
    """The value of an input."""
    identifier = _identifier(modifier.node_group, name)
    if _in_properties(modifier):
        return getattr(modifier.properties.inputs, identifier).value
    return modifier[identifier]


def row_of(modifier: bpy.types.NodesModifier, name: str) -> tuple[Any, str]:
    """Return (owner, property) for a row of a panel."""
    identifier = _identifier(modifier.node_group, name)
    if _in_properties(modifier):
        return getattr(modifier.properties.inputs, identifier), "value"
    return modifier, f'["{identifier}"]'


def _write(modifier: bpy.types.NodesModifier, identifier: str, value: Any) -> None:
    if _in_properties(modifier):
        getattr(modifier.properties.inputs, identifier).value = value
    else:
        modifier[identifier] = value


def _in_properties(modifier: bpy.types.NodesModifier) -> bool:
    """From 5.2 on, where a modifier has no custom properties."""
    return hasattr(getattr(modifier, "properties", None), "inputs")


def _identifier(group: bpy.types.GeometryNodeTree, name: str) -> str:
    sockets = (
        group.interface.items_tree if hasattr(group, "interface") else group.inputs
    )  # from 4.0
    return next(
        socket.identifier
        for socket in sockets
        if socket.name == name and getattr(socket, "in_out", "INPUT") == "INPUT"
    )
