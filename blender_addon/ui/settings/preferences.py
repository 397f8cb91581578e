# SPDX-License-Identifier: GPL-3.0-or-later
"""Edit > Preferences > Add-ons > Medial Axis: what is installed, memory, a test of it, and the manual."""

import os

import bpy
from bpy.props import BoolProperty

from ... import __version__
from ...core.machine import native
from ...core.machine.cache import CACHE
from ...core.machine.memory_limit import LIMITS, OBJECT, MemoryLimit
from ...core.settings import CACHE_SIZE, MEGABYTE, AboveLimit
from ..base.manual import draw_manual
from ..base.plain_words import draw_told
from ..base.translation import say
from ..base.wrapped_text import draw_wrapped
from . import self_test_operator
from .asset_library import draw_library
from .properties import prop

ADDON = __package__.removesuffix(".ui.settings")


def memory_limit() -> MemoryLimit:
    """The memory that the user allows an analysis. This also sets the room of the cache, because saved preferences
    call no `update`."""
    addon = bpy.context.preferences.addons.get(ADDON)
    if addon is None:  # registered by a script, without preferences
        return MemoryLimit().used(output=OBJECT)
    _give_room(addon.preferences)
    limit = MemoryLimit(addon.preferences.memory_limit, AboveLimit[addon.preferences.above_limit])
    return limit.used(output=OBJECT)


def threads() -> int:
    """The number of threads of a computation."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _give_room(preferences, _context=None):
    CACHE.room = preferences.cache_size * MEGABYTE


class MedialAxisPreferences(bpy.types.AddonPreferences):
    bl_idname = ADDON

    cache_size: prop(CACHE_SIZE, _give_room)
    memory_limit: prop(LIMITS["memory_limit"])
    above_limit: prop(LIMITS["above_limit"])
    show_installed: BoolProperty(
        name="Installation", description="What is installed, what memory holds, and a test of it"
    )
    guided: BoolProperty(
        options={"HIDDEN"}
    )  # the tutorial was opened, its line dismissed, or an axis computed

    def draw(self, context):
        _draw_start(context, self.layout)
        _draw_memory(self.layout.box().column(), self)
        draw_library(self.layout.box().column())
        box = self.layout.box().column()
        arrow = "DISCLOSURE_TRI_DOWN" if self.show_installed else "DISCLOSURE_TRI_RIGHT"
        box.prop(self, "show_installed", icon=arrow, emboss=False)
        if self.show_installed:
            _draw_installed(box)
            _draw_kept(box)
            _draw_test(context, box)


def _draw_start(context, layout):
    """Draws the place of the panel, a problem of the compiled module, and links to the manual."""
    draw_wrapped(context, layout, "3D Viewport > Sidebar (N) > Medial Axis", "INFO")
    if problem := native.problem():
        draw_told(context, layout, problem, "ERROR")
    draw_manual(layout)


def _draw_installed(layout):
    file = native.file()
    table = {
        "Version": __version__,
        "Compiled For": native.expected_abi() if file else ", ".join(native.found_abis()),
        "Compiled Module": str(file or ""),
        "Threads": str(threads()),
    }
    for label, text in table.items():
        row = layout.split(factor=0.2)
        row.label(text=say(label), translate=False)
        row.label(text=text, translate=False)


def _draw_memory(layout, preferences):
    column = layout.column()
    column.use_property_split = True
    for name, option in (("cache_size", CACHE_SIZE), ("memory_limit", LIMITS["memory_limit"])):
        column.prop(preferences, name, text=f"{say(option.label)} ({option.unit})", translate=False)
    column.prop(preferences, "above_limit")


def _draw_kept(layout):
    row = layout.split(factor=0.7)
    kept = f"{len(CACHE)} analyses are kept, {CACHE.bytes / MEGABYTE:,.0f} MB"
    row.label(text=say(kept), translate=False)
    row.operator("wm.medial_axis_free_memory", icon="TRASH")


def _draw_test(context, layout):
    layout.operator("wm.medial_axis_self_test", icon="CHECKMARK")
    for check in self_test_operator.last():
        draw_wrapped(context, layout, check.found, "CHECKMARK" if check.passed else "ERROR")


class WM_OT_medial_axis_free_memory(bpy.types.Operator):
    bl_idname = "wm.medial_axis_free_memory"
    bl_label = "Free Memory"
    bl_description = (
        "Forget the kept analyses; medial axes stay, and other thresholds need another computation"
    )

    def execute(self, _context):
        size = CACHE.bytes
        CACHE.clear()
        self.report({"INFO"}, say(f"{size / MEGABYTE:,.0f} MB were freed"))
        return {"FINISHED"}
