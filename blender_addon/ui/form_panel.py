# SPDX-License-Identifier: GPL-3.0-or-later
"""The rows of the panel that choose the form of the axis."""

from ..core.settings import Form, applies_to_form


def draw_form(layout, panel):
    """Form, and the sliders that matter for it."""
    layout.prop(panel, "form")
    for name in ("simplify", "erode", "limb"):
        if applies_to_form(name, Form[panel.form]):
            layout.prop(panel, name, slider=True)
