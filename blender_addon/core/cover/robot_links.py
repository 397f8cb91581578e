# SPDX-License-Identifier: GPL-3.0-or-later
"""Balls and capsules as the collision shapes of one link, in the files that simulators of robots read: URDF and
MuJoCo's MJCF."""

from __future__ import annotations

from typing import BinaryIO
from xml.sax.saxutils import quoteattr

import numpy as np

from ..arrays import Floats
from ..errors import ExportError
from ..files.writing import write_rows
from ..portable_angle import angle_of
from .ball_cover import Balls


def write_urdf(balls: Balls, name: str, stream: BinaryIO) -> None:
    """Write a robot of one link, with a collision sphere for each ball; URDF measures in metres."""
    quoted = _quoted(name)
    _write(stream, f'<?xml version="1.0"?>\n<robot name={quoted}>\n  <link name={quoted}>\n')
    write_collisions(balls, stream)
    _write(stream, "  </link>\n</robot>\n")


def write_collisions(balls: Balls, stream: BinaryIO) -> None:
    """Write a line for each ball, and one for the cylinder of each capsule, because URDF has no capsules."""
    _check(balls)
    sphere = (
        '    <collision><origin xyz="%.17g %.17g %.17g" rpy="0 0 0"/>'
        '<geometry><sphere radius="%.17g"/></geometry></collision>\n'
    )
    write_rows(stream, sphere, balls.centres, balls.radii)
    cylinder = (
        '    <collision><origin xyz="%.17g %.17g %.17g" rpy="0 %.17g %.17g"/>'
        '<geometry><cylinder length="%.17g" radius="%.17g"/></geometry></collision>\n'
    )
    ends, radii = _capsules(balls)
    write_rows(stream, cylinder, *_cylinders(ends), radii)


def write_mjcf(balls: Balls, name: str, stream: BinaryIO) -> None:
    """Write a model of one body that is fixed to the world, with a sphere for each ball, a capsule for each edge."""
    quoted = _quoted(name)
    _write(stream, f"<mujoco model={quoted}>\n  <worldbody>\n    <body name={quoted}>\n")
    write_geoms(balls, stream)
    _write(stream, "    </body>\n  </worldbody>\n</mujoco>\n")


def write_geoms(balls: Balls, stream: BinaryIO) -> None:
    """Write a line for each ball that is alone, and one for each capsule."""
    _check(balls)
    alone, (ends, radii) = balls.single, _capsules(balls)
    sphere = '      <geom type="sphere" pos="%.17g %.17g %.17g" size="%.17g"/>\n'
    write_rows(stream, sphere, balls.centres[alone], balls.radii[alone])
    numbers = " ".join(["%.17g"] * 6)
    capsule = f'      <geom type="capsule" fromto="{numbers}" size="%.17g"/>\n'
    write_rows(stream, capsule, ends.reshape(-1, 6), radii)


def _check(balls: Balls) -> None:
    """Refuse what parsers of such files refuse, or read as something else."""
    if balls.is_tapered:
        raise ExportError(
            "Expected balls or capsules of one radius for a file of a robot, found tapered capsules; "
            "set Shapes to Capsules"
        )
    ends = balls.centres[balls.edges]
    if (ends[:, 0] == ends[:, 1]).all(axis=1).any():
        raise ExportError(
            "Expected two places as the ends of each capsule for a file of a robot, found one that has no length; "
            "delete such capsules"
        )
    least = float(balls.radii.min())
    if not least > 0.0:
        raise ExportError(
            f"Expected radii above 0 for a file of a robot, found {least:.6g}; delete such balls"
        )


def _capsules(balls: Balls) -> tuple[Floats, Floats]:
    """Return (m, 2, 3) ends of the capsules and (m,) radii."""
    return balls.centres[balls.edges], balls.radii[balls.edges[:, 0]]


def _cylinders(ends: Floats) -> tuple[Floats, ...]:
    """Return middles, two angles and lengths of the cylinders between pairs of places.

    The axis of a cylinder is Z, which turns about Y by the first angle, then about Z by the second one.
    """
    along = ends[:, 1] - ends[:, 0]
    largest = np.abs(along).max(axis=1, initial=0.0)
    x, y, z = (along / largest[:, None]).T
    flat = np.sqrt(x * x + y * y)
    lengths = largest * np.sqrt(x * x + y * y + z * z)
    return ends[:, 0] + along / 2, angle_of(z, flat), angle_of(x, y), lengths


def _quoted(name: str) -> str:
    """Return a name as an XML attribute; XML has no place for control characters and halves of surrogate pairs."""
    return quoteattr("".join(c if c.isprintable() else "_" for c in name))


def _write(stream: BinaryIO, text: str) -> None:
    stream.write(text.encode("ascii", "xmlcharrefreplace"))
