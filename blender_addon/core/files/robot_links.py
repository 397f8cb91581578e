# SPDX-License-Identifier: GPL-3.0-or-later
"""Balls as the collision shapes of one link, in the files that simulators of robots read: URDF and MuJoCo's MJCF."""

from __future__ import annotations

from typing import TYPE_CHECKING, BinaryIO
from xml.sax.saxutils import quoteattr

from .rows_of_text import write_rows

if TYPE_CHECKING:
    from ..solid.ball_cover import Balls


def write_urdf(balls: Balls, name: str, stream: BinaryIO) -> None:
    """Write a robot of one link, with a collision sphere for each ball; URDF measures in metres."""
    quoted = _quoted(name)
    _write(stream, f'<?xml version="1.0"?>\n<robot name={quoted}>\n  <link name={quoted}>\n')
    row = (
        '    <collision><origin xyz="%.17g %.17g %.17g" rpy="0 0 0"/>'
        '<geometry><sphere radius="%.17g"/></geometry></collision>\n'
    )
    write_rows(stream, row, balls.centres, balls.radii)
    _write(stream, "  </link>\n</robot>\n")


def write_mjcf(balls: Balls, name: str, stream: BinaryIO) -> None:
    """Write a model of one body that is fixed to the world, with a sphere for each ball."""
    quoted = _quoted(name)
    _write(stream, f"<mujoco model={quoted}>\n  <worldbody>\n    <body name={quoted}>\n")
    row = '      <geom type="sphere" pos="%.17g %.17g %.17g" size="%.17g"/>\n'
    write_rows(stream, row, balls.centres, balls.radii)
    _write(stream, "    </body>\n  </worldbody>\n</mujoco>\n")


def _quoted(name: str) -> str:
    """Return a name as an XML attribute; XML has no place for control characters and halves of surrogate pairs."""
    return quoteattr("".join(c if c.isprintable() else "_" for c in name))


def _write(stream: BinaryIO, text: str) -> None:
    stream.write(text.encode("ascii", "xmlcharrefreplace"))
