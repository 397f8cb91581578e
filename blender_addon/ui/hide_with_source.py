# SPDX-License-Identifier: GPL-3.0-or-later
"""Watches whether a source is hidden or shown, by whatever means, and lets its medial axis follow."""

import bpy
from bpy.app.handlers import persistent

from ..bridge.hidden_with_source import hide_with_sources


@persistent
def _after_update(_scene, depsgraph):
    """Hiding, of whatever kind, tags the scene; moves and edits, which come many in a second, do not."""
    if depsgraph.id_type_updated("SCENE"):
        _follow(depsgraph)


@persistent
def _after_frame(_scene, depsgraph):
    """Keyed hiding tags no scene."""
    _follow(depsgraph)


def _follow(depsgraph):
    if depsgraph.mode == "VIEWPORT":  # a render runs beside the window, and may change nothing
        hide_with_sources(depsgraph.scene, depsgraph.view_layer)


def _handlers():
    handlers = bpy.app.handlers
    return (
        (handlers.depsgraph_update_post, _after_update),
        (handlers.frame_change_post, _after_frame),
    )


def register():
    for handlers, function in _handlers():
        handlers.append(function)


def unregister():
    for handlers, function in _handlers():
        handlers.remove(function)
