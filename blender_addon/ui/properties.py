# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of core.settings as Blender properties, and those of the panel."""

import ctypes
import math
from dataclasses import replace

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty

from ..bridge.axis_object import (
    ANALYSIS,
    is_result,
    result_of,
    settings_of,
    update_result,
)
from ..bridge.output_object import is_gone, source_of
from ..bridge.read_object import SOURCE_TYPES
from ..bridge.report_object import has_report, report_of
from ..bridge.surface_object import is_surface, surface_of
from ..core.axis.compute import refilter, refiltered_topology
from ..core.errors import MedialAxisError
from ..core.settings import (
    ANALYSED,
    LOOKS,
    OPTIONS,
    SAMPLING_OPTIONS,
    Choice,
    Look,
    Number,
    SamplingMode,
    Settings,
    applies,
)
from . import current_job
from .translation import IN_CONTEXT


def number(name, update=None, of=OPTIONS):
    """A FloatProperty for an option."""
    option = of[name]
    limits = {"min": option.minimum, "soft_max": option.soft_maximum}
    if math.isfinite(option.maximum):
        limits["max"] = option.maximum
    if option.unit == "rad":
        limits |= {"subtype": "ANGLE", "step": 100, "precision": 3}
    if option.unit == "%":
        limits |= {"subtype": "PERCENTAGE", "precision": 2}
    if option.unit == "length":
        limits |= {"subtype": "DISTANCE", "precision": 4}
    return FloatProperty(
        name=option.label,
        description=option.description,
        default=option.default,
        update=update,
        **IN_CONTEXT,
        **limits,
    )


def integer(name):
    """An IntProperty for an option."""
    return integer_of(OPTIONS[name])


def integer_of(option, update=None):
    return IntProperty(
        name=option.label,
        description=option.description,
        default=option.default,
        min=option.minimum,
        max=option.maximum,
        soft_min=option.soft_minimum,
        soft_max=option.soft_maximum,
        update=update,
        **IN_CONTEXT,
    )


def choice(name, update=None):
    """An EnumProperty for an option."""
    return choice_of(OPTIONS[name], update)


def choice_of(option, update=None):
    return EnumProperty(
        name=option.label,
        description=option.description,
        items=[(member.name, *words) for member, words in option.items.items()],
        default=option.default.name,
        update=update,
        **IN_CONTEXT,
    )


def switch(name, update=None, of=OPTIONS):
    """A BoolProperty for an option."""
    option = of[name]
    return BoolProperty(
        name=option.label,
        description=option.description,
        default=option.default,
        update=update,
        **IN_CONTEXT,
    )


class SamplingProperties:
    """The options of the sampling, which all that computes from a surface has."""

    sampling: choice("sampling")
    samples: integer("samples")
    spacing: number("spacing")
    epsilon: number("epsilon")
    budget: integer("budget")
    sharp_angle: number("sharp_angle")
    smooth: switch("smooth")
    keep_vertices: switch("keep_vertices")
    seed: integer("seed")


class LookProperties:
    """How results look."""

    colours: switch("colours", of=LOOKS)
    parent: switch("parent", of=LOOKS)
    within: number("within", of=LOOKS)
    smallest_island: number("smallest_island", of=LOOKS)


def look_from(properties) -> Look:
    """Properties of an operator or of the panel -> Look."""
    return Look(
        **{name: _value(option, getattr(properties, name)) for name, option in LOOKS.items()}
    )


def draw_sampling(layout, properties):
    """Draw the options of the sampling; those that do not matter for the chosen Sampling are grey."""
    chosen = SamplingMode[properties.sampling]
    for name in SAMPLING_OPTIONS:
        row = layout.row()
        row.active = applies(name, chosen, properties.spacing)
        row.prop(properties, name)


def settings_from(properties) -> Settings:
    """Properties of an operator or of the panel -> Settings, raising InvalidInputError; what an operator does not
    have is the default."""
    return Settings(
        **{
            name: _value(option, getattr(properties, name))
            for name, option in OPTIONS.items()
            if hasattr(properties, name)
        }
    )


def copy_settings(source, target) -> None:
    """Set the properties of an operator button to those of the panel."""
    for name in (*OPTIONS, *LOOKS):
        if hasattr(target, name):
            setattr(target, name, getattr(source, name))


def _value(option, value):
    if isinstance(option, Choice):
        return type(option.default)[value]
    if isinstance(option, Number):
        return _exact(option, value)
    return value


def _exact(option: Number, value: float) -> float:
    """Blender keeps float32: a rounded default or limit means that number itself."""
    for meant in (option.default, option.minimum, option.maximum):
        if ctypes.c_float(meant).value == value:
            return meant
    return value


def shown_result(context):
    """The medial axis that the panel speaks of: the active object, or that of the active object."""
    return _shown(context, is_result, result_of)


def shown_surface(context):
    """The surface that the panel speaks of: the active object, or that of the active object."""
    return _shown(context, is_surface, surface_of)


def shown_report(context):
    """The report that the panel speaks of: the active object, or that of the active object."""
    return _shown(context, has_report, report_of)


def _shown(context, is_kind, of_source):
    """The active object, what was made of it, or what was made of that of which it was made."""
    active = getattr(context, "object", None)
    if active is None or active.type not in SOURCE_TYPES:
        return None
    if is_kind(active):
        return active
    source = source_of(active)
    return of_source(active) or (
        None if is_gone(source) else _of_source(source, is_kind, of_source)
    )


def _of_source(source, is_kind, of_source):
    return source if is_kind(source) else of_source(source)


def _refilter(panel, context):
    """Apply new thresholds to the shown result at once, as long as its analysis is kept."""
    panel.note = ""
    result = shown_result(context)
    if result is None or is_gone(result) or current_job.job() is not None:
        return
    try:
        panel.note = _refilter_result(result, panel)
    except MedialAxisError as error:
        panel.note = str(error)


def _refilter_result(result, panel) -> str:
    kept = settings_of(result)
    wanted = settings_from(panel)
    analysed = {name: getattr(kept, name) for name in (*ANALYSED, *SAMPLING_OPTIONS)}
    wanted = replace(wanted, **analysed)  # others need another analysis
    axis = refilter(result[ANALYSIS], wanted)
    if axis is None:
        return "Press Compute Medial Axis to apply this: the analysis is no longer in memory"
    if axis.is_empty:
        return "No facet passes these conditions; the medial axis was left as it was"
    topology = refiltered_topology(result[ANALYSIS], axis, wanted.form)
    settings = replace(wanted, form=wanted.form_of_side)
    update_result(result, axis, settings, topology, look_from(panel))
    return ""


class MedialAxisPanelSettings(SamplingProperties, bpy.types.PropertyGroup):
    """What the sidebar panel shows; the form, its sliders, theta, rho, rule, criteria and the look act on the result at
    once."""

    form: choice("form", _refilter)
    simplify: number("simplify", _refilter)
    erode: number("erode", _refilter)
    limb: number("limb", _refilter)
    theta: number("theta", _refilter)
    rho: number("rho", _refilter)
    side: choice("side")
    sides: choice("sides")
    rule: choice("rule", _refilter)
    criteria: choice("criteria", _refilter)
    limit_set: switch("limit_set", _refilter)
    colours: switch("colours", _refilter, of=LOOKS)
    parent: switch("parent", of=LOOKS)
    within: number("within", _refilter, of=LOOKS)
    smallest_island: number("smallest_island", _refilter, of=LOOKS)
    note: bpy.props.StringProperty(options={"HIDDEN", "SKIP_SAVE"})


def _percentage(_):
    job = current_job.job()
    return 0.0 if job is None else 100 * job.fraction


class MedialAxisProgress(bpy.types.PropertyGroup):
    """The progress bar of the panel."""

    percentage: FloatProperty(
        name="Progress",
        description="Share of the computation that is done",
        subtype="PERCENTAGE",
        min=0.0,
        max=100.0,
        precision=0,
        get=_percentage,
    )


CLASSES = (MedialAxisPanelSettings, MedialAxisProgress)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Scene.medial_axis = PointerProperty(type=MedialAxisPanelSettings)
    bpy.types.WindowManager.medial_axis_progress = PointerProperty(type=MedialAxisProgress)


def unregister():
    del bpy.types.WindowManager.medial_axis_progress
    del bpy.types.Scene.medial_axis
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
