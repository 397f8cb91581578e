# SPDX-License-Identifier: GPL-3.0-or-later
"""Small pictures in the panel: the scale of colours as a legend, and a traffic light."""

import bpy
import bpy.utils.previews

from ..core.axis.colours import colours
from ..core.axis.verdict import Light

_STEPS = 12
_SIZE = 32
_LIGHTS = {
    Light.GOOD.name: (0.15, 0.75, 0.25),
    Light.LOOK.name: (1.0, 0.75, 0.1),
    Light.WRONG.name: (0.95, 0.2, 0.15),
}
_icons = None


def draw_legend(layout, start, end):
    """The scale of colours over two texts, what is blue and what is yellow."""
    column = layout.column(align=True)
    scale = column.row(align=True)
    scale.scale_y = 0.7
    for step in range(_STEPS):
        scale.label(text="", icon_value=_icon(f"step {step}", step))
    ends = column.row()
    ends.label(text=start, translate=False)
    right = ends.row()
    right.alignment = "RIGHT"
    right.label(text=end, translate=False)


def light(name):
    """The icon of a traffic light that shows a `Light`, by its name."""
    return _icon(name, name)


def _icon(name, what):
    global _icons
    if _icons is None:
        _icons = bpy.utils.previews.new()
    if name not in _icons:
        picture = _icons.new(name)
        picture.icon_size = (_SIZE, _SIZE)
        picture.icon_pixels_float = _disc(_LIGHTS[what]) if what in _LIGHTS else _square(what)
    return _icons[name].icon_id


def _square(step):
    """RGBA of a square of one colour of the scale, as screens want it."""
    linear = colours([step], 0, _STEPS - 1)[0]
    return [*map(_encoded, linear[:3].tolist()), 1.0] * (_SIZE * _SIZE)


def _disc(colour):
    """RGBA of a disc with a soft rim; colours are multiplied by alpha, as Blender mixes icons."""
    pixels, middle, radius = [], (_SIZE - 1) / 2, 0.36 * _SIZE
    for place in range(_SIZE * _SIZE):
        away = ((place % _SIZE - middle) ** 2 + (place // _SIZE - middle) ** 2) ** 0.5
        alpha = min(1.0, max(0.0, radius - away + 0.5))
        pixels += [*(alpha * channel for channel in colour), alpha]
    return pixels


def _encoded(linear):
    return 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055


def register():
    pass


def unregister():
    global _icons
    if _icons is not None:
        bpy.utils.previews.remove(_icons)
        _icons = None
