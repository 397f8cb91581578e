# SPDX-License-Identifier: GPL-3.0-or-later
"""File > Import > Points: `.xyz`, `.xyzn` and `.off` files as mesh objects."""

import bpy
from bpy.props import CollectionProperty, FloatProperty, StringProperty
from bpy_extras.io_utils import ImportHelper, axis_conversion, orientation_helper

from ...bridge.objects.points_object import new_points
from ...core.errors import MedialAxisError
from ...core.files.read import import_points
from ..base.paths import RELATIVE, chosen_files
from ..base.plain_words import told
from ..base.select_made import select_made
from ..base.translation import say


class ImportPoints(ImportHelper):
    """The base of the operators; `import_mesh.xyz` itself belongs to an add-on that comes with Blender."""

    bl_options = {"UNDO", "PRESET"}

    files: CollectionProperty(
        type=bpy.types.OperatorFileListElement, options={"HIDDEN", "SKIP_SAVE"}
    )
    filepath: StringProperty(name="File Path", subtype="FILE_PATH", options=RELATIVE)
    directory: StringProperty(subtype="DIR_PATH", options={"HIDDEN", "SKIP_SAVE", *RELATIVE})
    global_scale: FloatProperty(
        name="Scale",
        description="Factor of all coordinates",
        default=1.0,
        min=1e-6,
        max=1e6,
        soft_min=0.001,
        soft_max=1000.0,
    )

    def invoke(self, context, event):
        """Ask for the files; for files that were dropped, which are known, only for the options."""
        popup = getattr(self, "invoke_popup", None)  # Blender's, where it has handlers of files
        return popup(context) if popup else super().invoke(context, event)

    def draw(self, _context):
        self.layout.use_property_split = True
        for name in ("global_scale", "axis_forward", "axis_up"):
            self.layout.prop(self, name)

    def execute(self, context):
        # Blender itself moves one of the two axes when both are set to the same
        turn = axis_conversion(from_forward=self.axis_forward, from_up=self.axis_up)
        made = [thing for path in chosen_files(self) if (thing := self._import(path, turn))]
        if made and bpy.ops.object.mode_set.poll():
            bpy.ops.object.mode_set(mode="OBJECT")
        select_made(context, made[::-1])  # the last is active, as in Blender's importers
        return {"FINISHED"} if made else {"CANCELLED"}

    def _import(self, path, turn):
        """The new object of a file; None where it is not one, which is reported."""
        try:
            found = import_points(path)
            name = bpy.path.display_name_from_filepath(path)
            thing, warnings = new_points(found, name, turn, self.global_scale)
        except MedialAxisError as error:
            self.report({"ERROR"}, told(error))
            return None
        for warning in warnings:
            self.report({"WARNING"}, say(f"'{thing.name}': {warning}"))
        normals = ", with normals" if found.normals is not None else ""
        counts = f"{len(thing.data.vertices):,} points, {len(thing.data.polygons):,} faces"
        self.report({"INFO"}, say(f"'{thing.name}': {counts}{normals}"))
        return thing


@orientation_helper(axis_forward="Y", axis_up="Z")
class IMPORT_MESH_OT_points_xyz(ImportPoints, bpy.types.Operator):
    bl_idname = "import_mesh.points_xyz"
    bl_label = "Import XYZ Points"
    bl_description = "Read points, one x y z per line, with normals where the file has them"

    filename_ext = ".xyz"
    filter_glob: StringProperty(default="*.xyz;*.xyzn", options={"HIDDEN"})


@orientation_helper(axis_forward="Y", axis_up="Z")
class IMPORT_MESH_OT_points_off(ImportPoints, bpy.types.Operator):
    bl_idname = "import_mesh.points_off"
    bl_label = "Import OFF"
    bl_description = "Read points and polygons from an OFF file"

    filename_ext = ".off"
    filter_glob: StringProperty(default="*.off", options={"HIDDEN"})


def menu_func_import(self: bpy.types.Menu, context: bpy.types.Context) -> None:
    self.layout.operator(IMPORT_MESH_OT_points_xyz.bl_idname, text="Points (.xyz/.xyzn)")
    self.layout.operator(IMPORT_MESH_OT_points_off.bl_idname, text="Object File Format (.off)")


def drop_handler(base: type, operator: type) -> type:
    """The class that lets files be dropped on Blender's window; `base` is Blender's, from 4.1."""
    patterns = operator.__annotations__["filter_glob"].keywords["default"]
    name = operator.__name__.replace("IMPORT_MESH_OT", "MEDIAL_AXIS_FH")
    fields = {
        "bl_idname": name,
        "bl_label": operator.bl_label,
        "bl_import_operator": operator.bl_idname,
        "bl_file_extensions": patterns.replace("*", ""),
        "poll_drop": classmethod(_takes_drops),
    }
    return type(name, (base,), fields)


def _takes_drops(_cls: type, context: bpy.types.Context) -> bool:
    return context.area is not None and context.area.type in {"VIEW_3D", "OUTLINER"}


OPERATORS = (IMPORT_MESH_OT_points_xyz, IMPORT_MESH_OT_points_off)
HANDLERS = (
    tuple(drop_handler(bpy.types.FileHandler, operator) for operator in OPERATORS)
    if hasattr(bpy.types, "FileHandler")
    else ()
)


ENTRIES = {bpy.types.TOPBAR_MT_file_import: menu_func_import}

register, unregister = bpy.utils.register_classes_factory(HANDLERS)
