# SPDX-License-Identifier: GPL-3.0-or-later
"""Hides a medial axis with its source, for those who switch this on in the preferences.

Blender hides no children, so this needs handlers that run after every change of every scene. They are registered only
while the preference is on.
"""

import bpy
from bpy.app.handlers import persistent

from ..bridge.hidden_with_source import hide_with_sources
from .preferences import wants_hiding


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


def switch(on):
    """Register the handlers, or remove them."""
    for handlers, function in _handlers():
        if function in handlers:
            handlers.remove(function)
        if on:
            handlers.append(function)


def register():
    switch(wants_hiding())


def unregister():
    switch(False)
