# SPDX-License-Identifier: GPL-3.0-or-later
"""Texts in panels: sentences, which Blender's labels do not wrap, and rows of figures."""

import textwrap

from .translation import say

_CHARACTER = 7  # pixels of an average character; only decides where lines break


def draw_wrapped(context, layout, text, icon="NONE", icon_value=0, beside=0):
    """A sentence over as many lines as the region needs, with an icon by name or by number.

    `beside` is the number of pixels that are kept free next to it.
    """
    width = context.region.width / context.preferences.system.ui_scale - 60 - beside
    column = layout.column(align=True)
    lines = textwrap.wrap(say(text), max(20, int(width / _CHARACTER)))
    column.scale_y = 0.8 if len(lines) > 1 else 1.0  # one line is as high as any other row
    for number, line in enumerate(lines):
        if number or not icon_value:
            column.label(text=line, icon="BLANK1" if number else icon, translate=False)
        else:
            column.label(text=line, icon_value=icon_value, translate=False)


def draw_figures(layout, figures, share=0.45):
    """Rows of a label, which has a share of the width, and a text."""
    column = layout.column(align=True)
    for label, text in figures.items():
        row = column.split(factor=share)
        row.label(text=say(label), translate=False)
        row.label(text=say(text), translate=False)
