# SPDX-License-Identifier: GPL-3.0-or-later
"""Sentences in panels: Blender's labels do not wrap."""

import textwrap

from .translation import say

_CHARACTER = 7  # pixels of an average character; only decides where lines break


def draw_wrapped(context, layout, text, icon):
    """A sentence over as many lines as the region needs."""
    width = context.region.width / context.preferences.system.ui_scale - 60
    column = layout.column(align=True)
    column.scale_y = 0.8
    for number, line in enumerate(textwrap.wrap(say(text), max(20, int(width / _CHARACTER)))):
        column.label(text=line, icon="BLANK1" if number else icon, translate=False)
