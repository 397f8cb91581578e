# SPDX-License-Identifier: GPL-3.0-or-later
"""Export Thickness: what was measured as a page for people, or as a file for programs."""

import bpy
from bpy.props import BoolProperty, EnumProperty, StringProperty

from ...bridge.mesh import stored
from ...bridge.objects.output_object import is_gone, source_of
from ...bridge.thickness import thickness_object as of
from ...core.errors import InvalidInputError, MedialAxisError
from ...core.thickness.parts_page import export_page, row_of, row_without, verdict_of
from ...core.thickness.thickness import kept_measurement
from ...core.thickness.thin_parts import find_thin_parts
from ...core.thickness.write_thickness import THICKNESS_FORMATS, export_thickness
from ..axis.selected_sources import sources
from ..base.export_file import ExportFile
from ..base.plain_words import Needing, Telling, told
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
    one_page: BoolProperty(
        name="Selected Objects",
        description="A page has a row for each selected object, where several are selected",
        default=True,
    )

    needs = "Select an object whose thickness was measured before"
    find = staticmethod(shown_thickness)

    @property
    def extensions(self):
        return _EXTENSIONS

    def default_name(self, context):
        return f"{_measured(context).name} Thickness"

    def run(self, context):
        chosen = list(sources(context))
        paged = self.one_page and len(chosen) > 1 and self.chosen_path.lower().endswith(".html")
        written = self._write_page(context, chosen) if paged else self._write_active(context)
        return f"Wrote the thickness to '{written.name}'"

    def _write_active(self, context):
        found, parts = _kept(context, shown_thickness(context))
        name = _measured(context).name
        return export_thickness(found, parts, self.chosen_path, _unit(context), name)

    def _write_page(self, context, chosen):
        """One page of several objects; those that were not measured have a row that says so."""
        found, parts = _kept(context, shown_thickness(context))
        unit, between = _unit(context), found.settings.between
        rows = [_row(context, thing, unit) for thing in chosen]
        verdict = verdict_of(rows, parts.limit, unit, between)
        return export_page(rows, self.chosen_path, verdict, between)


def _row(context, thing, unit):
    carrier = of.carrier_of(thing)
    try:
        if carrier is None:
            raise InvalidInputError(
                f"Expected a measurement of '{thing.name}', found none; press Measure Thickness"
            )
        found, parts = _kept(context, carrier)
    except MedialAxisError as error:
        return row_without(thing.name, told(error))
    return row_of(thing.name, found, parts, unit, found.warnings)


def _kept(context, carrier):
    """The measurement that a carrier shows, and its thin parts."""
    found = kept_measurement(carrier[stored.THICKNESS_KEY])
    if found is None:
        raise InvalidInputError(
            f"Expected the measurement of '{carrier.name}' in memory, found it dropped; "
            "press Measure Thickness again"
        )
    least = context.scene.medial_axis_thickness.minimum_patch
    return found, find_thin_parts(found, carrier[stored.THICKNESS_LIMIT], least)


def _measured(context):
    """The object whose thickness the carrier shows."""
    carrier = shown_thickness(context)
    source = source_of(carrier) if of.is_copy(carrier) else carrier
    return carrier if is_gone(source) else source


def _unit(context):
    """The unit of Blender's coordinates, "" where the scene has none."""
    units = context.scene.unit_settings
    return _METRIC.get(round(units.scale_length, 9), "") if units.system == "METRIC" else ""
