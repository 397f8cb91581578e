# SPDX-License-Identifier: GPL-3.0-or-later
"""The four sliders of Form in the panel as shares of what can go, in percent: files and keyframes keep the length.

The lengths over which a slider acts differ from model to model, so each result comes with a range for each slider.
Without one, the slider is grey. Where the length is keyed or driven, the panel shows the length itself.
"""

import inspect

import bpy

from ...bridge.axis.slider_ranges import detail_is_dead, range_on
from ...bridge.mesh import stored
from ...core.settings import OPTIONS
from .tab import draw_setting
from .translation import IN_CONTEXT

_ABOUT = {
    "simplify": "The share of the sheets that is dropped, by area, the thinnest first; sheets go whole, and what joins "
    "the others stays as edges. Grey before the first click, and where there are no sheets",
    "erode": "The share of the sheets that recedes from the rims, by area. Grey before the first click, and where "
    "there are no sheets",
    "spike": "The share of the sheets that is dropped, by area, the narrowest parts first. Grey before the first "
    "click, and where there are no sheets",
    "limb": "The share of the branches of loose edges that is dropped, the shortest first; a long branch counts for "
    "many short ones. Grey before the first click, and where there are no branches",
}


def with_shares(shown_result):
    """A decorator that gives a class of settings a property for each share; `shown_result` finds the result."""

    def decorate(cls):
        added = {f"{name}_share": _share(name, shown_result) for name in stored.RANGES}
        cls.__annotations__ = inspect.get_annotations(cls) | added
        return cls

    return decorate


def draw_slider(context, row, name, result):
    """Draw a slider: its share, its length where that has keys, or the option itself where it has no shares."""
    panel = context.scene.medial_axis
    if name not in stored.RANGES or _is_animated(context.scene, name):
        row.active = name != "detail" or not detail_is_dead(result)
        draw_setting(row, panel, name, slider=True)
        return
    part = row.row(align=True)
    part.enabled = range_on(result, name) is not None
    draw_setting(part, panel, f"{name}_share", slider=True)


def _share(name, shown_result):
    def get(panel):
        found = range_on(shown_result(bpy.context), name)
        return 0.0 if found is None else 100.0 * found.share(getattr(panel, name))

    def set_(panel, share):
        found = range_on(shown_result(bpy.context), name)
        if found is not None:
            setattr(panel, name, min(found.length(share / 100.0), OPTIONS[name].maximum))

    return bpy.props.FloatProperty(
        name=OPTIONS[name].label,
        description=_ABOUT[name],
        subtype="PERCENTAGE",
        min=0.0,
        max=100.0,
        precision=1,
        options={"SKIP_SAVE"},
        get=get,
        set=set_,
        **IN_CONTEXT,
    )


def _is_animated(scene, name):
    """Whether the length has keyframes or a driver, which show and act on its own property only."""
    data = scene.animation_data
    if data is None:
        return False
    curves = [*data.drivers, *(_curves(data.action) if data.action else ())]
    return any(curve.data_path == f"medial_axis.{name}" for curve in curves)


def _curves(action):
    """All curves of an action; from 4.4 on they lie in layers."""
    if hasattr(action, "fcurves"):
        return list(action.fcurves)
    bags = (bag for layer in action.layers for strip in layer.strips for bag in strip.channelbags)
    return [curve for bag in bags for curve in bag.fcurves]
