# SPDX-License-Identifier: GPL-3.0-or-later
"""Balls and capsules as elements that take the place of others in the file of a robot."""

from __future__ import annotations

from io import BytesIO
from xml.sax.saxutils import quoteattr

from ..cover.ball_cover import Balls
from ..cover.robot_links import write_collisions, write_geoms
from ..cover.write_balls import check_robot


def lines_of(tag: str, kept: dict[str, str], balls: Balls) -> list[str]:
    """Return an element for each shape with attributes that it has not; the first has the name, all share the mass."""
    check_robot(balls)
    stream = BytesIO()
    (write_geoms if tag == "geom" else write_collisions)(balls, stream)
    lines = [line.strip() for line in stream.getvalue().decode("ascii").splitlines()]
    if "mass" in kept:
        kept["mass"] = repr(float(kept["mass"]) / len(lines))
    return [
        line.replace(f"<{tag}", f"<{tag}{_words(kept, line, first=row == 0)}", 1)
        for row, line in enumerate(lines)
    ]


def _words(kept: dict[str, str], line: str, first: bool) -> str:
    return "".join(
        f" {name}={quoteattr(text)}"
        for name, text in kept.items()
        if f" {name}=" not in line and (first or name != "name")
    )
