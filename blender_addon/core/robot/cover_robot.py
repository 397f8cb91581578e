# SPDX-License-Identifier: GPL-3.0-or-later
"""The collision geometry of each link of a robot becomes few balls or capsules."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from ..cover.ball_cover import Balls
from ..errors import Cancelled, MedialAxisError, OutOfMemoryError
from ..machine.memory_limit import MemoryLimit
from ..machine.progress import Progress
from ..settings import Settings
from ..shape.own_frame import in_own_frame
from ..shape.shape import Shape
from .link_shapes import LinkSettings, cover_link, error_of, volume_of
from .robot_file import LinkGeometry, RobotFile


@dataclass(frozen=True)
class LinkCover:
    """A link and its new shapes; None where it stays as it was, with the reason if that is a problem."""

    link: LinkGeometry
    balls: Balls | None
    problem: str = ""
    seconds: float = 0.0
    warnings: tuple[str, ...] = ()  # About its geometry

    @property
    def figures(self) -> dict[str, Any]:
        """The figures of the link, for the report."""
        balls = self.balls
        return {
            "name": self.link.name,
            "collisions": len(self.link.spans),
            "count": 0 if balls is None else balls.count,
            "shapes": "" if balls is None else "capsules" if len(balls.edges) else "balls",
            "volume": None if balls is None else volume_of(balls),
            "farthest": None if balls is None else error_of(balls),
            "problem": self.problem,
            "seconds": round(self.seconds, 3),
        }


@dataclass(frozen=True)
class RobotCover:
    """A robot with new shapes. `chosen` is None, because each link has samples of its own."""

    robot: RobotFile
    links: tuple[LinkCover, ...]
    warnings: tuple[str, ...]
    seconds: float
    chosen: None = None


def cover_robot(
    robot: RobotFile,
    settings: Settings,
    wanted: LinkSettings,
    progress: Progress,
    limit: MemoryLimit,
) -> RobotCover:
    """Cover the links one after the other; one that cannot be used stays as it was, with a warning.

    Wheels and motors are often the same, and are covered once.
    """
    start, covers = time.perf_counter(), []
    known: dict[tuple[object, ...], LinkCover] = {}
    for row, link in enumerate(robot.links):
        progress.begin_section(row / len(robot.links), (row + 1) / len(robot.links))
        same = link.points.tobytes(), link.triangles.tobytes(), link.kinds, link.problem
        if same in known:
            covers.append(replace(known[same], link=link, seconds=0.0))
            continue
        known[same] = _cover(link, settings, wanted, progress, limit)
        covers.append(known[same])
    warnings = [text for cover in covers for text in _warnings(cover, wanted.tolerance)]
    return RobotCover(robot, tuple(covers), tuple(warnings), time.perf_counter() - start)


def _cover(
    link: LinkGeometry,
    settings: Settings,
    wanted: LinkSettings,
    progress: Progress,
    limit: MemoryLimit,
) -> LinkCover:
    if link.problem or set(link.kinds) <= {"sphere", wanted.balls.shapes.name.lower()[:-1]}:
        return LinkCover(link, None, link.problem)
    start = time.perf_counter()
    shape, _ = in_own_frame(Shape(link.points, link.triangles))
    try:
        found = cover_link(shape, settings, wanted, progress, limit)
    except (Cancelled, OutOfMemoryError):
        raise
    except MedialAxisError as error:
        return LinkCover(link, None, str(error))
    balls = found.balls.moved(shape.frame[:3, 3])
    return LinkCover(link, balls, "", time.perf_counter() - start, found.warnings)


def _warnings(cover: LinkCover, most: float) -> Iterator[str]:
    name = cover.link.name
    yield from (f"the link '{name}': {text}" for text in cover.warnings)
    if cover.problem:
        yield f"the link '{name}' stays as it was: {cover.problem}"
    elif cover.balls is not None and 0.0 < most < error_of(cover.balls):
        yield (
            f"the link '{name}' keeps within {error_of(cover.balls):.4g} only, with "
            f"{cover.balls.words}; allow more of them"
        )
