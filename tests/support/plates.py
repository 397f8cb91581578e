# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids whose sheets, seams, junctions and corners can be counted by hand."""

import numpy as np


def prism(outline, caps, height):
    """A straight prism over a polygon; `caps` are triangles of its corners, counter-clockwise."""
    count = len(outline)
    flat = np.array(outline, float)
    points = np.concatenate(
        [np.column_stack([flat, np.full(count, z)]) for z in (0.0, float(height))]
    )
    triangles = []
    for i in range(count):
        j = (i + 1) % count
        triangles += [(i, j, count + j), (i, count + j, count + i)]
    for cap in caps:
        triangles += [cap[::-1], tuple(count + corner for corner in cap)]
    return points, np.array(triangles, np.int32)


def box(sizes=(3.0, 2.0, 1.0)):
    x, y, z = sizes
    return prism([(0, 0), (x, 0), (x, y), (0, y)], [(0, 1, 2), (0, 2, 3)], z)


def wedge(degrees=30.0):
    angle = np.radians(degrees)
    return prism([(0, 0), (3, 0), (3 * np.cos(angle), 3 * np.sin(angle))], [(0, 1, 2)], 2.0)


def bracket():
    """An L with one reflex edge, of arms of different widths and heights."""
    outline = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 2.5), (0, 2.5)]
    return prism(outline, [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5)], 0.6)


def t_plate():
    """A T with two reflex edges."""
    outline = [(-2, 0), (2, 0), (2, 0.4), (0.3, 0.4), (0.3, 2), (-0.3, 2), (-0.3, 0.4), (-2, 0.4)]
    caps = [(0, 1, 2), (0, 2, 3), (0, 3, 6), (0, 6, 7), (3, 4, 5), (3, 5, 6)]
    return prism(outline, caps, 1.5)


def holed_plate(sides=96, half=2.0, radius=0.6, height=0.5):
    """A square plate with a round hole."""
    angle = 2 * np.pi * np.arange(sides) / sides
    round_ = np.column_stack([np.cos(angle), np.sin(angle)])
    square = half * round_ / np.abs(round_).max(axis=1, keepdims=True)
    rings = [(radius * round_, z) for z in (0.0, height)] + [(square, z) for z in (0.0, height)]
    points = np.concatenate([np.column_stack([ring, np.full(sides, z)]) for ring, z in rings])
    triangles = []
    for i in range(sides):
        j = (i + 1) % sides
        in_low, in_high, out_low, out_high = (np.array((i, j)) + k * sides for k in range(4))
        for a, b in (
            (out_low, out_high),
            (in_low[::-1], in_high[::-1]),
            (in_high[::-1], out_high[::-1]),
            (out_low[::-1], in_low[::-1]),
        ):
            triangles += [(a[0], a[1], b[1]), (a[0], b[1], b[0])]
    return points, np.array(triangles, np.int32)
