# SPDX-License-Identifier: GPL-3.0-or-later
"""Export Thickness: what was measured as a page for people, or as a file for programs."""

import bpy
from bpy.props import EnumProperty, StringProperty

from ..bridge import thickness_object as of
from ..bridge.output_object import is_gone, source_of
from ..core.errors import InvalidInputError
from ..core.files.write_thickness import THICKNESS_FORMATS, export_thickness
from ..core.solid.thickness import kept_measurement
from ..core.solid.thin_parts import find_thin_parts
from .export_file import ExportFile
from .plain_words import Needing, Telling
from .thickness_properties import shown_thickness

_LABELS = {
    "HTML": "Page with pictures, a histogram and the thinnest places",
    "CSV": "Table of the thickness at each vertex",
    "JSON": "Figures and thin patches",
    "PLY": "The measured surface in colours",
}
_EXTENSIONS = {name: f".{name.lower()}" for name in _LABELS}
assert set(_EXTENSIONS.values()) == set(THICKNESS_FORMATS)
_METRIC = {1.0: "m", 0.1: "dm", 0.01: "cm", 0.001: "mm"}


class EXPORT_SCENE_OT_medial_axis_thickness(Needing, Telling, ExportFile, bpy.types.Operator):
    bl_idname = "export_scene.medial_axis_thickness"
    bl_label = "Export Thickness"
    bl_description = "Write the measured thickness of the active object, in world coordinates"

    filter_glob: StringProperty(
        default=";".join(f"*{suffix}" for suffix in THICKNESS_FORMATS), options={"HIDDEN"}
    )
    file_format: EnumProperty(
        name="Format",
        description="Kind of file, where the file name does not say it",
        items=[(name, _EXTENSIONS[name], label) for name, label in _LABELS.items()],
        default="HTML",
    )

    needs = "Select an object whose thickness was measured before"
    find = staticmethod(shown_thickness)

    @property
    def extensions(self):
        return _EXTENSIONS

    def default_name(self, context):
        return f"{_measured(context).name} Thickness"

    def run(self, context):
        carrier = shown_thickness(context)
        found = kept_measurement(carrier[of.KEY])
        if found is None:
            raise InvalidInputError(
                f"Expected the measurement of '{carrier.name}' in memory, found it dropped; "
                "press Measure Thickness again"
            )
        least = context.scene.medial_axis_thickness.minimum_patch
        parts = find_thin_parts(found, carrier[of.LIMIT], least)
        name = _measured(context).name
        written = export_thickness(found, parts, self.chosen_path, _unit(context), name)
        return f"Wrote the thickness to '{written.name}'"


def _measured(context):
    """The object whose thickness the carrier shows."""
    carrier = shown_thickness(context)
    source = source_of(carrier) if of.is_copy(carrier) else carrier
    return carrier if is_gone(source) else source


def _unit(context):
    """The unit of Blender's coordinates, "" where the scene has none."""
    units = context.scene.unit_settings
    return _METRIC.get(round(units.scale_length, 9), "") if units.system == "METRIC" else ""
