# SPDX-License-Identifier: GPL-3.0-or-later
"""Small pictures in the panel: the scale of colours as a legend, and a traffic light."""

import math

import bpy
import bpy.utils.previews

from ...core.axis.colours import colours
from ...core.axis.verdict import Light
from ...core.thickness.thickness_colours import STEPS, STEPS_BELOW

_STEPS = 6
_SIZE = 32
_LEVELS = 16  # heights of bars
_LIGHTS = {
    Light.GOOD.name: (0.15, 0.75, 0.25),
    Light.LOOK.name: (1.0, 0.75, 0.1),
    Light.WRONG.name: (0.95, 0.2, 0.15),
}
_icons = None


def draw_legend(layout, start, end, turned=False):
    """The scale of colours between two texts, from blue to yellow, or turned round."""
    ends = layout.split(factor=0.38)  # each text has room for "0.872 mm"
    ends.label(text=start, translate=False)
    rest = ends.split(factor=0.4)
    scale = rest.row(align=True)
    for step in range(_STEPS)[:: -1 if turned else 1]:
        scale.label(text="", icon_value=_icon(f"step {step}", step))
    end_of = rest.row()
    end_of.alignment = "RIGHT"
    end_of.label(text=end, translate=False)


def draw_thickness_legend(layout, scale, shares, texts):
    """Bars of how much of the surface has which colour, thin on the left, over the scale with an edge at the limit.

    `shares` has a number for each step of the scale; `texts` are what is said below the left end, the limit and the
    right end, "" for nothing.
    """
    column = layout.column(align=True)
    bars, steps = column.row(align=True), column.row(align=True)
    steps.scale_y = 0.7
    bounds = scale.bounds
    positions = scale.positions((bounds[:-1] + bounds[1:]) / 2)
    most = max(max(shares), 1e-12)
    for position, share in zip(positions.tolist(), shares, strict=True):
        level = math.ceil(_LEVELS * share / most)  # the least share is seen, too
        colour = tuple(colours([position], 0.0, 1.0)[0, :3].tolist())
        name = "thickness " + " ".join(f"{channel:.3f}" for channel in colour)
        bars.label(text="", icon_value=_icon(f"{name} {level}", (colour, level)))
        steps.label(text="", icon_value=_icon(name, (colour, _LEVELS)))
    _draw_ends(column, texts)


def _draw_ends(column, texts):
    left, middle, right = texts
    if middle:
        split = column.split(factor=STEPS_BELOW / STEPS)
        split.label(text=left, translate=False)
        column = split
        left = middle
    ends = column.row()
    ends.label(text=left, translate=False)
    end = ends.row()
    end.alignment = "RIGHT"
    end.label(text=right, translate=False)


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
        picture.icon_pixels_float = _pixels(what)
    return _icons[name].icon_id


def _pixels(what):
    """RGBA of a light by its name, of a step of the scale by its number, or of (linear colour, level) of a bar."""
    if what in _LIGHTS:
        return _disc(_LIGHTS[what])
    if isinstance(what, int):
        return _bar(tuple(colours([what], 0, _STEPS - 1)[0, :3].tolist()), _LEVELS)
    return _bar(*what)


def _bar(linear, level):
    """RGBA of a square whose lower part has a colour, as screens want it; the lowest row comes first."""
    filled = _SIZE * level // _LEVELS
    row = [*map(_encoded, linear), 1.0] * _SIZE
    return row * filled + [0.0] * (4 * _SIZE * (_SIZE - filled))


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


def unregister():
    global _icons
    if _icons is not None:
        bpy.utils.previews.remove(_icons)
        _icons = None
