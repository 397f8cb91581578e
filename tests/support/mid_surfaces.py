# SPDX-License-Identifier: GPL-3.0-or-later
"""Thin solids whose middle surfaces are known: rectangles, bent sheet metal, a shell with two holes, a leaf."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from . import thin_solids
from .meshes import Mesh, revolved
from .plates import prism
from .thick_meshes import lathe
from .thin_solids import union


@dataclass(frozen=True)
class Known:
    """A solid and its sheets.

    Parameters
    ----------
    mesh : Mesh
    t : float
    sheets : int
    betti : tuple of int
    rectangles : (k, 3, 3)
        A corner and two sides of each flat sheet; none where sheets are curved.
    """

    mesh: Mesh
    t: float
    sheets: int
    betti: tuple[int, int, int]
    rectangles: NDArray[np.float64]


def _known(mesh, t, betti, *rectangles, sheets=None):
    count = len(rectangles) if sheets is None else sheets
    return Known(mesh, t, count, betti, np.array(rectangles, float).reshape(-1, 3, 3))


def plate(t=0.02):
    return _known(thin_solids.plate(t).mesh, t, (1, 0, 0), ((0, 0, t / 2), (1, 0, 0), (0, 1, 0)))


def profile_t(t=0.02):
    return _known(
        thin_solids.profile_t(t).mesh,
        t,
        (1, 0, 0),
        ((0, 0, t / 2), (0.5, 0, 0), (0, 1, 0)),
        ((0.5, 0, t / 2), (0.5, 0, 0), (0, 1, 0)),
        ((0.5, 0, t / 2), (0, 0, 0.4 - t / 2), (0, 1, 0)),
    )


def cross(t=0.02):
    sides = ((0.5, 0, 0), (-0.5, 0, 0), (0, 0, 0.4), (0, 0, -0.4))
    return _known(
        thin_solids.cross(t).mesh, t, (1, 0, 0), *(((0.5, 0, 0), s, (0, 1, 0)) for s in sides)
    )


def profile_i(t=0.02):
    low, high = t / 2, 1 + t / 2
    return _known(
        thin_solids.profile_i(t).mesh,
        t,
        (1, 0, 0),
        *(((0.3, 0, z), (x, 0, 0), (0, 1, 0)) for z in (low, high) for x in (-0.3, 0.3)),
        ((0.3, 0, low), (0, 0, high - low), (0, 1, 0)),
    )


def profile_l(t=0.02):
    return _known(
        thin_solids.profile_l(t).mesh,
        t,
        (1, 0, 0),
        ((t / 2, 0, t / 2), (1 - t / 2, 0, 0), (0, 1, 0)),
        ((t / 2, 0, t / 2), (0, 0, 0.5 - t / 2), (0, 1, 0)),
    )


def box_section(t=0.02):
    a, b = 0.6, 0.4
    mesh = union(
        ((0, 0, 0), (a, 1, t)),
        ((0, 0, b - t), (a, 1, b)),
        ((0, 0, 0), (t, 1, b)),
        ((a - t, 0, 0), (a, 1, b)),
    )
    x, z, low = a - t, b - t, t / 2
    corners = ((low, 0, low), (low, 0, b - low), (low, 0, low), (a - low, 0, low))
    sides = ((x, 0, 0), (x, 0, 0), (0, 0, z), (0, 0, z))
    return _known(
        mesh, t, (1, 1, 0), *((c, s, (0, 1, 0)) for c, s in zip(corners, sides, strict=True))
    )


def tray(t=0.05):
    """A box without a lid, in whose corners three walls meet."""
    x, y, z = far = np.array((1.0, 0.7, 0.5))
    low, high = np.full(3, t / 2), far - (t / 2, t / 2, 0)
    walls = ((t, y, z), (x, t, z), (x, y, t))
    mesh = union(*(((0, 0, 0), wall) for wall in walls), ((x - t, 0, 0), far), ((0, y - t, 0), far))
    a, b, c = np.diag(high - low)
    sheets = ((low, a, b), (low, a, c), (low, b, c), (low + a, b, c), (low + b, a, c))
    return _known(mesh, t, (1, 0, 0), *sheets)


def stairs(t=0.02):
    """Treads of 0.4 and risers of 0.3, whose middles begin and end half a thickness beside the walls."""
    h, rectangles = t / 2, []
    for i in range(3):
        x, z = 0.4 * i, 0.3 * i
        start = x if i == 0 else x + h
        rectangles.append(((start, 0, z + h), (x + 0.4 + h - start, 0, 0), (0, 1, 0)))
        high = z + 0.3 + (t if i == 2 else h)
        rectangles.append(((x + 0.4 + h, 0, z + h), (0, 0, high - z - h), (0, 1, 0)))
    return _known(thin_solids.stairs(t).mesh, t, (1, 0, 0), *rectangles)


def ribbed_plate(t=0.02, ribs=3):
    """A plate of 1 by 1 with ribs of 0.2 on it."""
    at = np.arange(1, ribs + 1) / (ribs + 1)
    boxes = [((x - t / 2, 0, 0), (x + t / 2, 1, 0.2)) for x in at]
    low, wide = t / 2, 1 / (ribs + 1)
    fields = [((x, 0, low), (wide, 0, 0), (0, 1, 0)) for x in (0.0, *at)]
    fins = [((x, 0, low), (0, 0, 0.2 - low), (0, 1, 0)) for x in at]
    return _known(union(((0, 0, 0), (1, 1, t)), *boxes), t, (1, 0, 0), *fields, *fins)


def bent_sheet(t=0.02, radius=0.1, around=48):
    """An L of sheet metal: two flat sides of 0.5, and a quarter of a cylinder whose middle has a radius."""
    turn = np.linspace(0.0, np.pi / 2, around + 1)
    arc = np.column_stack((np.sin(turn), -np.cos(turn)))
    rings = []
    for r in (radius - t / 2, radius + t / 2):
        inner = np.concatenate(([[-0.5, -r]], r * arc, [[r, 0.5]]))
        rings.append(inner)
    outline = np.concatenate((rings[1], rings[0][::-1]))
    count, n = len(outline), around + 3
    points = np.concatenate(
        [np.column_stack((outline[:, 0], np.full(count, y), outline[:, 1])) for y in (0.0, 1.0)]
    )
    i = np.arange(count)
    j = (i + 1) % count
    k = np.arange(n - 1)
    far = count - 1 - k
    caps = np.concatenate(
        (np.column_stack((k, k + 1, far)), np.column_stack((k + 1, far - 1, far)))
    )
    sides = np.concatenate(
        (np.column_stack((i, count + i, count + j)), np.column_stack((i, count + j, j)))
    )
    triangles = np.concatenate((sides, caps, caps[:, ::-1] + count))
    return _known((points, triangles.astype(np.int32)), t, (1, 0, 0), sheets=1)


def round_plate(sides=12, t=0.005):
    """A regular polygon of radius 0.5 as a plate, whose walls all round are one smooth wall."""
    turn = 2 * np.pi * np.arange(sides) / sides + 0.1
    rim = 0.5 * np.column_stack((np.cos(turn), np.sin(turn)))
    return _known(fanned_plate(rim, t), t, (1, 0, 0), sheets=1)


def fanned_plate(rim, t):
    """A plate over a polygon round the origin, whose faces are fans of triangles round their middles."""
    points, walls = prism(rim, [], t)
    i, end = np.arange(len(rim)), 0 * np.arange(len(rim)) + len(points)
    j, top = np.roll(i, -1), i + len(rim)
    caps = (np.column_stack((j, i, end)), np.column_stack((top, np.roll(top, -1), end + 1)))
    triangles = np.concatenate((*caps, walls)).astype(np.int32)
    return np.concatenate((points, [(0, 0, 0), (0, 0, t)])), triangles


def holed_shell(t=0.05, around=96, rings=48):
    """A sphere of radius 1 in the middle of its wall, open at both poles."""
    turn = np.linspace(np.radians(25), np.radians(155), rings)
    arc = np.column_stack((np.sin(turn), np.cos(turn)))
    profile = np.concatenate(((1 + t / 2) * arc[::-1], (1 - t / 2) * arc))
    return _known(revolved(profile, around), t, (1, 1, 0), sheets=1)


def leaf(t=0.05, around=96, rings=24):
    """Two caps of spheres that meet in a sharp edge of radius 1; `t` is the thickness in the middle."""
    radius = (1 + (t / 2) ** 2) / t
    x = np.linspace(0.0, 1.0, rings + 1)
    height = np.sqrt(radius**2 - x**2) - (radius - t / 2)
    height[-1] = 0.0
    profile = [*zip(x, -height, strict=True), *zip(x[-2::-1], height[-2::-1], strict=True)]
    return _known(lathe(profile, around), t, (1, 0, 0), sheets=1)


ALL = {
    each.__name__: each
    for each in (
        plate,
        profile_t,
        cross,
        profile_i,
        profile_l,
        box_section,
        stairs,
        tray,
        ribbed_plate,
        bent_sheet,
        holed_shell,
        leaf,
        round_plate,
    )
}
FLAT = list(ALL)[:9]
