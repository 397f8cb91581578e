"""Edit > Preferences > Add-ons > Medial Axis: memory."""

import bpy

from ..core.cache import CACHE
from ..core.memory import MemoryLimit
from ..core.settings import CACHE_SIZE, LIMITS, MEGABYTE, AboveLimit
from .properties import choice_of, integer_of

ADDON = __package__.rpartition(".")[0]


def memory_limit() -> MemoryLimit:
    """What the user allows an analysis; and the cache is told its room, for saved preferences call no `update`."""
    addon = bpy.context.preferences.addons.get(ADDON)
    if addon is None:  # registered by a script, without preferences
        return MemoryLimit()
    _give_room(addon.preferences)
    return MemoryLimit(addon.preferences.memory_limit, AboveLimit[addon.preferences.above_limit])


def _give_room(preferences, _context=None):
    CACHE.room = preferences.cache_size * MEGABYTE


class MedialAxisPreferences(bpy.types.AddonPreferences):
    bl_idname = ADDON

    cache_size: integer_of(CACHE_SIZE, _give_room)
    memory_limit: integer_of(LIMITS["memory_limit"])
    above_limit: choice_of(LIMITS["above_limit"])

    def draw(self, _context):
        column = self.layout.column()
        column.use_property_split = True
        for name in ("cache_size", "memory_limit", "above_limit"):
            column.prop(self, name)
        row = column.row()
        row.label(text=f"{len(CACHE)} analyses are kept, {CACHE.bytes / MEGABYTE:,.0f} MB")
        row.operator("wm.medial_axis_free_memory", icon="TRASH")


class WM_OT_medial_axis_free_memory(bpy.types.Operator):
    bl_idname = "wm.medial_axis_free_memory"
    bl_label = "Free Memory"
    bl_description = "Forget the kept analyses; the medial axes stay, and other thresholds need another computation"

    def execute(self, _context):
        size = CACHE.bytes
        CACHE.clear()
        self.report({"INFO"}, f"{size / MEGABYTE:,.0f} MB were freed")
        return {"FINISHED"}


CLASSES = (MedialAxisPreferences, WM_OT_medial_axis_free_memory)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
