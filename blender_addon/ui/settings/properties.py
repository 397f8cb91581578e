# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of core.settings as Blender properties, and those of the panel."""

import ctypes
import inspect
import math
from dataclasses import replace
from functools import partial

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty

from ...bridge.axis.axis_object import (
    asked_of,
    asked_on,
    box_on,
    is_result,
    result_of,
    settings_of,
    update_result,
)
from ...bridge.axis.report_object import has_report, report_of
from ...bridge.axis.shown_axis import shown_axis
from ...bridge.mesh import stored
from ...bridge.nodes.wires import wires_group
from ...bridge.objects.output_object import is_gone, is_torn, source_of
from ...bridge.objects.read_object import SOURCE_TYPES
from ...bridge.surface_object import is_surface, surface_of
from ...bridge.thickness.heat_map import show_axis, shown_heat
from ...core.axis.compute import refilter, refiltered_topology
from ...core.errors import MedialAxisError
from ...core.options import Choice, Integer, Number, Switch, options_of
from ...core.settings import (
    ANALYSED,
    DIVISION,
    LOOKS,
    OPTIONS,
    SAMPLING_OPTIONS,
    Form,
    Look,
    Prepare,
    SamplingMode,
    Settings,
    SidesFrom,
    applies,
)
from ..base import current_job
from ..base.ranged_sliders import with_shares
from ..base.tab import draw_setting
from ..base.translation import IN_CONTEXT
from . import apply_later

# These words of a FloatProperty follow from the unit of its option.
_OF_UNIT = {
    "rad": {"subtype": "ANGLE", "step": 100, "precision": 3},
    "%": {"subtype": "PERCENTAGE", "precision": 2},
    "length": {"subtype": "DISTANCE", "precision": 4},
}


def prop(option, update=None):
    """The property for an option."""
    words = {"name": option.label, "description": option.description, "update": update}
    words |= {"default": option.default, **IN_CONTEXT}
    if isinstance(option, Switch):
        return BoolProperty(**words)
    if isinstance(option, Choice):
        items = [(member.name, *texts) for member, texts in option.items.items()]
        return EnumProperty(**{**words, "default": option.default.name, "items": items})
    words |= {"min": option.minimum, "soft_max": option.soft_maximum}
    if math.isfinite(option.maximum):
        words["max"] = option.maximum
    if isinstance(option, Integer):
        return IntProperty(**words, soft_min=option.soft_minimum)
    is_share = not option.unit and (option.minimum, option.maximum) == (0.0, 1.0)
    return FloatProperty(
        **words, **({"subtype": "FACTOR"} if is_share else _OF_UNIT.get(option.unit, {}))
    )


def with_options(options, update=None):
    """A decorator that gives a class a property for each of these options."""

    def decorate(cls):
        added = {name: prop(option, update) for name, option in options.items()}
        cls.__annotations__ = inspect.get_annotations(cls) | added
        return cls

    return decorate


@with_options({name: OPTIONS[name] for name in ("sampling", *SAMPLING_OPTIONS)})
class SamplingProperties:
    """The options of the sampling, which all operators have that compute from a surface."""


def draw_sampling(layout, properties, of_faces=(), names=SAMPLING_OPTIONS):
    """Draw the options of the sampling that matter for the chosen Sampling.

    `of_faces` are the options that matter for Vertices, too.
    """
    chosen = SamplingMode[properties.sampling]
    for name in names:
        if name == "wrap_opening" and properties.sides != SidesFrom.WRAP.name:
            continue
        if name == "prepare" and not (_is_of_points() or _is_of_noisy_faces(properties)):
            continue
        if applies(name, chosen, properties.spacing, of_faces):
            draw_setting(layout, properties, name)


def _is_of_points():
    """Whether the active object, or the source of the active result, has no faces."""
    thing = bpy.context.object
    thing = thing and (source_of(thing) or thing)
    is_mesh = thing is not None and thing.type in ("MESH", "POINTCLOUD")
    return is_mesh and not len(getattr(thing.data, "polygons", ()))


def _is_of_noisy_faces(properties):
    """Whether noise was found in the faces of the active result, or the option was changed; few faces have any."""
    said = (bpy.context.object and bpy.context.object.get(stored.WARNINGS, "")) or ""
    is_told = all(word in said for word in ("noise", "steps", "faces"))
    return is_told or properties.prepare != Prepare.AUTOMATIC.name


def settings_from(properties, kind=Settings):
    """Properties of an operator or of a panel as settings of a kind; an option that has no property has its default."""
    return kind(
        **{
            name: _value(option, getattr(properties, name))
            for name, option in options_of(kind).items()
            if hasattr(properties, name)
        }
    )


def copy_settings(source, target, options=OPTIONS | LOOKS | DIVISION) -> None:
    """Set the properties of an operator button to those of a panel."""
    for name in options:
        if hasattr(target, name):
            setattr(target, name, getattr(source, name))


def look_from(properties) -> Look:
    """The look of a panel or of an operator; an axis as published is shown as it is, with its crumbs."""
    look = settings_from(properties, Look)
    return replace(look, crumbs=0.0) if properties.form == Form.PUBLISHED.name else look


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
    """The medial axis that the panel describes: the active object, or the medial axis that was made of it."""
    return _shown(context, is_result, result_of)


def shown_surface(context):
    """The surface that the panel describes: the active object, or the surface that was made of it."""
    return _shown(context, is_surface, surface_of)


def shown_report(context):
    """The report that the panel describes: the active object, or the report that was made of it."""
    return _shown(context, has_report, report_of)


def shown_frame(context):
    """The active object, where it is a frame of a sequence of medial axes."""
    active = context.object
    marks = {stored.SEQUENCE_FRAME, stored.RADIUS_MIN}
    return active if active is not None and marks <= set(active.keys()) else None


def shown_thing(context):
    """A frame of a sequence, a medial axis, or a report."""
    return shown_frame(context) or shown_result(context) or shown_report(context)


def _shown(context, is_kind, of_source):
    """The active object if it is of the kind, else the object of the kind that was made of it or of its source."""
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


def note_of(context) -> list:
    """The lines of the note that concern the active object: it was active when they were told, or they name it."""
    panel, name = context.scene.medial_axis, _name_of_active(context)
    lines = panel.note.splitlines()
    return lines if panel.whose == name else [line for line in lines if f"'{name}'" in line]


def _remember_whose(panel, context):
    panel.whose = _name_of_active(context)


def _name_of_active(context):
    active = getattr(context, "object", None)
    return active.name if active is not None else ""


def _refilter(panel, context):
    """Apply new thresholds to the shown result at once, as long as its analysis is kept."""
    panel.note = ""
    result = shown_result(context)
    if result is None or is_gone(result):
        return
    if current_job.job() is not None and not apply_later.runs():
        return
    try:
        panel.note = _refilter_result(result, panel)
    except MedialAxisError as error:
        panel.note = str(error)


def _wanted(kept, panel):
    """The settings of the panel but for those that need another analysis."""
    return replace(settings_from(panel), **{name: getattr(kept, name) for name in ANALYSED})


def _after_undo(_scene, _depsgraph=None):
    """The update of the thread is in no undo step, so the object, or its mesh, may not be that of this step."""
    panel, result = bpy.context.scene.medial_axis, shown_result(bpy.context)
    if result is None or is_gone(result):
        return
    kept = settings_of(result)
    wanted = _wanted(kept, panel)
    agrees = kept == replace(wanted, form=wanted.form_of_side)
    by_thread = any(apply_later.was_applied(result, settings) for settings in (kept, wanted))
    if is_torn(result) or (by_thread and not agrees):
        _refilter(panel, bpy.context)


def _watch_undo():
    """Handlers that no file has which needs no thread; Blender removes them when another file is opened."""
    for handlers in (bpy.app.handlers.undo_post, bpy.app.handlers.redo_post):
        if _after_undo not in handlers:
            handlers.append(_after_undo)


def _refilter_result(result, panel) -> str:
    kept = settings_of(result)
    wanted = _wanted(kept, panel)
    look = look_from(panel)
    work = partial(_refiltered, result[stored.ANALYSIS], box_on(result), wanted, look)
    show = partial(_show_refiltered, look)
    if apply_later.needs_thread(result, _levels_stay(kept, wanted)):
        _watch_undo()
        wires_group()  # the thread's update is no step of undo, and may only use what a step has
        apply_later.request(result, wanted, work, partial(show, between_steps=True))
        return ""
    return show(result, wanted, work(None))


def _refiltered(key, box, wanted, look, progress):
    """(axis, what is shown of it): None where the analysis is gone, and nothing is shown of an empty axis."""
    axis = refilter(key, wanted, progress)
    is_there = axis is not None and not axis.is_empty
    return axis, shown_axis(axis, box, look) if is_there else None


def _show_refiltered(look, result, wanted, found, between_steps=False) -> str:
    axis, shown = found
    if axis is None:
        return "Press Compute Medial Axis to apply this: the analysis is no longer in memory"
    if shown is None:
        return "No facet passes these conditions; the medial axis was left as it was"
    topology = refiltered_topology(result[stored.ANALYSIS], axis, wanted.form)
    settings = replace(wanted, form=wanted.form_of_side)
    update_result(result, shown, settings, topology, look, between_steps)
    if shown_heat(result) is not None:
        show_axis(result)
    axis = shown.axis
    is_seen = axis.facets or len(axis.edges)
    return "" if is_seen else "Only the largest balls are left, points that views do not show"


def _levels_stay(kept, wanted) -> bool:
    """Whether two settings choose among the levels of the same hierarchy."""
    names = ("theta", "rho", "rule", "criteria", "crisp", "mesh")
    return all(getattr(kept, name) == getattr(wanted, name) for name in names)


def needs_analysis(result, panel) -> bool:
    """Whether the panel asks for another analysis than a result was asked for, whatever Automatic then chose."""
    asked = asked_on(result)
    return asked is not None and asked != asked_of(settings_from(panel))


_ANALYSED = {name: OPTIONS[name] for name in ANALYSED}
_LIVE = {name: option for name, option in OPTIONS.items() if name not in _ANALYSED} | LOOKS


@with_options(_ANALYSED | DIVISION)
@with_options(_LIVE, _refilter)
@with_shares(shown_result)
class MedialAxisPanelSettings(bpy.types.PropertyGroup):
    """The settings of the sidebar panel; those that need no other analysis act on the result at once."""

    note: bpy.props.StringProperty(options={"HIDDEN", "SKIP_SAVE"}, update=_remember_whose)
    whose: bpy.props.StringProperty(options={"HIDDEN", "SKIP_SAVE"})


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


PROPERTIES = {
    (bpy.types.Scene, "medial_axis"): PointerProperty(type=MedialAxisPanelSettings),
    (bpy.types.WindowManager, "medial_axis_progress"): PointerProperty(type=MedialAxisProgress),
}


def unregister():
    for handlers in (bpy.app.handlers.undo_post, bpy.app.handlers.redo_post):
        if _after_undo in handlers:
            handlers.remove(_after_undo)
