# SPDX-License-Identifier: GPL-3.0-or-later
"""Classes with an entry in Blender's menus of objects; being there is also what lets F3 find an operator."""

import bpy


def object_menus():
    return (bpy.types.VIEW3D_MT_object, bpy.types.VIEW3D_MT_object_context_menu)


def register_with_entry(classes, entry):
    for cls in classes:
        bpy.utils.register_class(cls)
    for menu in object_menus():
        menu.append(entry)


def unregister_with_entry(classes, entry):
    for menu in object_menus():
        menu.remove(entry)
    for cls in reversed(classes):
        bpy.utils.unregister_class(cls)
