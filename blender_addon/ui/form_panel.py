# SPDX-License-Identifier: GPL-3.0-or-later
"""The rows of the panel that choose the form of the axis."""

from ..core.settings import Form, applies_to_form
from .properties import settings_from

_SLIDERS = ("simplify", "erode", "spike", "limb")


def draw_form(layout, panel):
    """Form, and the slider that matters most for it."""
    layout.prop(panel, "form")
    for name in _that_apply(panel)[:1]:
        layout.prop(panel, name, slider=True)


def draw_more_of_form(layout, panel):
    """The other sliders of the form, and whether its places are crisp."""
    for name in _that_apply(panel)[1:]:
        layout.prop(panel, name, slider=True)
    row = layout.row()
    row.active = settings_from(panel).crisp_is_possible
    row.prop(panel, "crisp")


def _that_apply(panel):
    return [name for name in _SLIDERS if applies_to_form(name, Form[panel.form])]
