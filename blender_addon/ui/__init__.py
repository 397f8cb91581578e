# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's user interface: properties, operators, panels, menus. No geometry.

Each module here may have classes of Blender, all of which are registered; PROPERTIES of Blender's own types and ENTRIES
of its menus; and `register` and `unregister` for the rest, such as handlers.
"""

from __future__ import annotations

from importlib import import_module
from types import ModuleType

import bpy

from .. import cli
from ..core.machine import native

# In the order of registration, which is that of the panels.
# fmt: off
_MODULES = (
    "base.translation", "settings.apply_later", "settings.properties", "thickness.thickness_properties",
    "settings.self_test_operator", "settings.asset_library", "base.plain_words", "settings.preferences",
    "axis.operators", "axis.auto_update", "skeleton.skeleton_operators", "thickness.thickness_limits",
    "thickness.thickness_operators", "thickness.thicken", "hollow", "solidify", "axis.export_axis",
    "thickness.export_thickness", "axis.import_points", "axis.inward_faces", "settings.presets", "base.legend",
    "base.show", "settings.guide", "panels.panels", "axis.parts", "skeleton.skeleton_panel",
    "thickness.thickness_panel", "rebuild", "balls", "panels.settings_panels", "axis.compute_sequence", "reduce",
    "mid_surface", "axis.convert_to_curve", "panels.form_panel", "axis.node_groups", "panels.menus",
    "base.manual", "base.current_job",
)
# fmt: on
_commands: list[object] = []  # of Blender's command line


def register() -> None:
    native.load_a_copy = not __package__.startswith("bl_ext.")  # then it is no extension
    for module in map(_module, _MODULES):
        for cls in _classes(module):
            bpy.utils.register_class(cls)
        for (owner, name), value in getattr(module, "PROPERTIES", {}).items():
            setattr(owner, name, value)
        for menu, entry in getattr(module, "ENTRIES", {}).items():
            menu.append(entry)
        if hasattr(module, "register"):
            module.register()
    if hasattr(bpy.utils, "register_cli_command"):  # from 4.2: `blender --command medial_axis`
        _commands.append(bpy.utils.register_cli_command("medial_axis", cli.main))


def unregister() -> None:
    while _commands:
        bpy.utils.unregister_cli_command(_commands.pop())
    for module in map(_module, reversed(_MODULES)):
        if hasattr(module, "unregister"):
            module.unregister()
        for menu, entry in getattr(module, "ENTRIES", {}).items():
            menu.remove(entry)
        for owner, name in getattr(module, "PROPERTIES", {}):
            delattr(owner, name)
        for cls in reversed(_classes(module)):
            bpy.utils.unregister_class(cls)


def _module(name: str) -> ModuleType:
    return import_module(f".{name}", __package__)


def _classes(module: ModuleType) -> list[type]:
    """The classes that a module defines of Blender's kinds, in their order; bases of several are of none."""
    return [
        value
        for value in vars(module).values()
        if isinstance(value, type)
        and issubclass(value, bpy.types.bpy_struct)
        and value.__module__ == module.__name__
    ]
