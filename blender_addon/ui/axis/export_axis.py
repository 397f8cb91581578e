# SPDX-License-Identifier: GPL-3.0-or-later
"""File > Export > Medial Axis: the active object's medial axis as a file."""

import bpy
from bpy.props import EnumProperty, StringProperty

from ...bridge.axis.axis_object import settings_of
from ...bridge.axis.read_axis import find_axis, read_axis, world_matrix
from ...bridge.balls_object import is_balls, read_balls
from ...bridge.objects.output_object import is_gone, source_of
from ...bridge.objects.read_object import read_object
from ...core.axis.medial_axis import MedialAxis
from ...core.cover.ball_cover import cover_by_balls
from ...core.cover.write_balls import export_balls
from ...core.errors import InvalidInputError
from ...core.files.write import FORMATS, export_axis
from ...core.settings import BALL_OPTIONS, BallSettings, CoverMode, CoverShapes
from ..base.export_file import ExportFile
from ..base.plain_words import Needing, Telling
from ..settings.preferences import memory_limit
from ..settings.properties import prop

_LABELS = {suffix: known.label for suffix, known in FORMATS.items()} | {
    ".json": "JSON, balls or capsules and their figures",
    ".urdf": "URDF, balls or capsules as a link of a robot",
    ".mjcf": "MJCF, balls or capsules as a body of MuJoCo",
}
_EXTENSIONS = {suffix[1:].upper(): suffix for suffix in _LABELS}


class EXPORT_SCENE_OT_medial_axis(Needing, Telling, ExportFile, bpy.types.Operator):
    bl_idname = "export_scene.medial_axis"
    bl_label = "Export Medial Axis"
    bl_description = (
        "Write the medial axis of the active object, with its radii, in world coordinates"
    )
    bl_options = {"PRESET"}

    filter_glob: StringProperty(
        default=";".join(f"*{suffix}" for suffix in _LABELS), options={"HIDDEN"}
    )
    file_format: EnumProperty(
        name="Format",
        description="Kind of file, where the file name does not say it",
        items=[(name, suffix, _LABELS[suffix]) for name, suffix in _EXTENSIONS.items()],
        default="MA",
    )
    balls: bpy.props.IntProperty(
        name="Balls",
        description="At most so many balls or capsules instead of the axis, as .ma, .json, .urdf or .mjcf; 0: the axis",
        default=0,
        min=0,
        soft_max=BALL_OPTIONS["count"].soft_maximum,
        max=BALL_OPTIONS["count"].maximum,
    )
    shapes: prop(BALL_OPTIONS["shapes"])
    mode: prop(BALL_OPTIONS["mode"])
    tolerance: prop(BALL_OPTIONS["tolerance"])
    refine: prop(BALL_OPTIONS["refine"])

    @classmethod
    def find(cls, context: bpy.types.Context) -> bpy.types.Object | None:
        return _thing(context)

    @property
    def extensions(self) -> dict[str, str]:
        return _EXTENSIONS

    def default_name(self, context: bpy.types.Context) -> str:
        return _thing(context).name

    def run(self, context: bpy.types.Context) -> str:
        context.view_layer.update()  # scripts may have moved the object
        size, written = self._write(context, _thing(context), self.chosen_path)
        return f"Wrote {size} to '{written.name}'"

    def _write(self, context, thing, path):
        """A sentence for people: how much was written, and to which file."""
        if is_balls(thing):
            balls, world = read_balls(thing), world_matrix(thing)
        elif self.balls:
            balls, world = self._cover(context, thing)
        else:
            axis = read_axis(thing)
            return _size(axis), export_axis(axis, path, world_matrix(thing))
        return balls.words, export_balls(balls, path, world)

    def _cover(self, context, result):
        """Balls of what an axis was computed of, with its settings, and where they lie in the world."""
        source = source_of(result)
        if is_gone(source):
            raise InvalidInputError(
                f"Expected the object that '{result.name}' was computed of, found that it is gone; set Balls to 0"
            )
        shape = read_object(source, context.evaluated_depsgraph_get())
        wanted = BallSettings(
            count=self.balls,
            shapes=CoverShapes[self.shapes],
            mode=CoverMode[self.mode],
            tolerance=self.tolerance,
            refine=self.refine,
        )
        found = cover_by_balls(shape, settings_of(result), wanted, limit=memory_limit())
        return found.balls, shape.frame


def _thing(context: bpy.types.Context) -> bpy.types.Object | None:
    """The object that is written: the active object's medial axis, or balls if that is the active object."""
    active = context.object
    return active if not is_gone(active) and is_balls(active) else find_axis(active)


def _size(axis: MedialAxis) -> str:
    if not len(axis.edges):
        return f"{axis.facets:,} facets"
    return f"{axis.facets:,} facets and {len(axis.edges):,} edges"


def menu_func_export(self: bpy.types.Menu, context: bpy.types.Context) -> None:
    suffixes = "/".join(FORMATS)
    self.layout.operator(EXPORT_SCENE_OT_medial_axis.bl_idname, text=f"Medial Axis ({suffixes})")


ENTRIES = {bpy.types.TOPBAR_MT_file_export: menu_func_export}
