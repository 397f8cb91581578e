# SPDX-License-Identifier: GPL-3.0-or-later
"""The four sliders of Form, and Rho, in the panel as shares of what can go: files and keyframes keep the length.

The lengths over which a slider acts differ from model to model, so each result comes with a range for each slider.
Without a result, or where the length is keyed or driven, the panel shows the length itself.
"""

import inspect

import bpy

from ..bridge.slider_ranges import RANGES, range_on
from ..core.settings import OPTIONS
from .translation import IN_CONTEXT

_ABOUT = {
    "simplify": "The share of the sheets that is dropped, by area, the thinnest first: 0 drops none, 1 all that can "
    "go; sheets go whole, and what joins the others stays as edges",
    "erode": "The share of the sheets that recedes from the rims, by area: at 0 nothing does, at 1 all that can go",
    "spike": "The share of the sheets that is dropped, by area, the narrowest parts first: 0 drops none, "
    "1 all that can go",
    "limb": "The share of the branches of loose edges that is dropped, by length, the shortest first: 0 drops none, "
    "1 all that can go",
    "rho": "The share of the facets that goes, of those that Theta does not keep, the lowest ratios first: 0 drops "
    "none, 1 all of them",
}


def with_shares(shown_result):
    """A decorator that gives a class of settings a property for each share; `shown_result` finds the result."""

    def decorate(cls):
        added = {f"{name}_share": _share(name, shown_result) for name in RANGES}
        cls.__annotations__ = inspect.get_annotations(cls) | added
        return cls

    return decorate


def row_of_slider(context, name, result):
    """The property to draw for a slider: its share, or its length."""
    if name not in RANGES or range_on(result, name) is None or _is_animated(context.scene, name):
        return name
    return f"{name}_share"


def _share(name, shown_result):
    def get(panel):
        found = range_on(shown_result(bpy.context), name)
        return 0.0 if found is None else found.share(getattr(panel, name))

    def set_(panel, share):
        found = range_on(shown_result(bpy.context), name)
        if found is not None:
            setattr(panel, name, min(found.length(share), OPTIONS[name].maximum))

    return bpy.props.FloatProperty(
        name=OPTIONS[name].label,
        description=_ABOUT[name],
        subtype="FACTOR",
        min=0.0,
        max=1.0,
        precision=3,
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
