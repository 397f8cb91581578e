# SPDX-License-Identifier: GPL-3.0-or-later
"""Texts in panels: sentences, which Blender's labels do not wrap, and figures."""

import blf

from .translation import say

_ONE = {"branches": "branch", "cavities": "cavity", "vertices": "vertex"}
_MARGINS = 82  # pixels of the sidebar beside a text: its tabs, the borders of a panel, and an icon


def draw_wrapped(context, layout, text, icon="NONE", icon_value=0, beside=0):
    """A sentence over as many lines as the region needs, with an icon by name or by number.

    `beside` is the number of pixels that are kept free next to it.
    """
    scale = context.preferences.system.ui_scale
    blf.size(0, scale * context.preferences.ui_styles[0].widget.points)
    lines = _lines(say(text), context.region.width - scale * (_MARGINS + beside))
    column = layout.column(align=True)
    column.scale_y = 0.8 if len(lines) > 1 else 1.0  # one line is as high as any other row
    for number, line in enumerate(lines):
        if number or not icon_value:
            column.label(text=line, icon="BLANK1" if number else icon, translate=False)
        else:
            column.label(text=line, icon_value=icon_value, translate=False)


def _lines(text, room):
    """The words of a text in lines that are at most as wide as the room, in pixels, unless a single word is wider."""
    lines = []
    for word in text.split():
        if lines and blf.dimensions(0, f"{lines[-1]} {word}")[0] <= room:
            lines[-1] += f" {word}"
        else:
            lines.append(word)
    return lines


def counted(numbers):
    """The numbers of things, of which there are any, in a sentence, as "1 loop, 20 branches"."""
    there = {name: number for name, number in numbers.items() if number}
    one = {name: _ONE.get(name, name.removesuffix("s")) for name in there}
    return ", ".join(f"{n:,} {say(one[name] if n == 1 else name)}" for name, n in there.items())
