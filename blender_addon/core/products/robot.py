# SPDX-License-Identifier: GPL-3.0-or-later
"""The record of robots whose links get balls or capsules as their collision geometry."""

from __future__ import annotations

import argparse
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..batch.option_words import add_sampling, as_words, sampling_from
from ..errors import ExportError, InvalidInputError
from ..files.writing import listed, write_whole
from ..machine.memory_limit import MemoryLimit
from ..machine.progress import Progress
from ..robot.cover_robot import RobotCover, cover_robot
from ..robot.link_shapes import LinkSettings
from ..robot.robot_file import RobotFile, read_robot
from ..settings import BallSettings, CoverMode, CoverShapes
from .product import DONE, INPUT, Product

_MOST = 64  # shapes of a link where only a tolerance is given


@dataclass(frozen=True)
class Robot(Product):
    wanted: LinkSettings

    description = "Robots whose links collide as few balls or capsules that hold them."
    heading = "links"
    formats = (".urdf", ".xml", ".mjcf")
    usual = "urdf"
    codes = ((3, "an input, or a link of it, cannot be used"),)
    reads_shapes = False
    read = staticmethod(read_robot)
    help = """\
INPUT     .urdf or MuJoCo's .xml, with primitives and with meshes in .dae .stl .obj .ply .off
OUTPUT    the same format and bytes, but other collision geometry; links of spheres alone stay, and in .xml those
          of capsules. In .urdf a capsule is a cylinder and two spheres.

examples:
  medial_axis robot arm.urdf capsules.urdf
  medial_axis robot arm.urdf balls.urdf --balls 16
  medial_axis robot arm.xml close.xml --tolerance 0.005
"""

    @classmethod
    def add_words(cls, parser: argparse.ArgumentParser) -> None:
        links = parser.add_argument_group("links")
        kinds = links.add_mutually_exclusive_group()
        kinds.add_argument(
            "--capsules",
            type=int,
            metavar="N",
            help="at most N capsules for each link (default: 1)",
        )
        kinds.add_argument("--balls", type=int, metavar="N", help="at most N balls for each link")
        links.add_argument(
            "--tolerance",
            type=float,
            default=0.0,
            metavar="LENGTH",
            help="the first of 1, 2, 4, ... that reach out of the link by no more than this, or with --mode inside "
            f"leave no place farther away; at most N, or {_MOST} where N is not given (default: 0, N)",
        )
        links.add_argument(
            "--mode",
            choices=[mode.name.lower() for mode in CoverMode],
            default="around",
            help="around: they hold the link; inside: they stay inside (default: around)",
        )
        add_sampling(parser.add_argument_group("method"))

    @classmethod
    def from_words(cls, words: argparse.Namespace) -> Robot:
        if not 0.0 <= words.tolerance < math.inf:
            raise ValueError(
                f"Expected --tolerance as a finite length of at least 0, found {words.tolerance}"
            )
        given = words.capsules if words.balls is None else words.balls
        usual = _MOST if words.tolerance > 0.0 else 1
        balls = BallSettings(
            count=usual if given is None else given,
            shapes=CoverShapes.CAPSULES if words.balls is None else CoverShapes.BALLS,
            mode=CoverMode[words.mode.upper()],
        )
        return cls(sampling_from(words), LinkSettings(balls, words.tolerance))

    def compute(
        self, shape: RobotFile, limit: MemoryLimit, progress: Progress | None
    ) -> RobotCover:
        return cover_robot(shape, self.settings, self.wanted, progress or Progress(), limit)

    def check(self, found: RobotCover) -> None:
        """Raise InvalidInputError if no link could be used."""
        if all(cover.problem for cover in found.links):
            raise InvalidInputError(found.warnings[0])

    def write(self, found: RobotCover, path: Path, _frame: np.ndarray) -> tuple[str, ...]:
        if path.suffix.lower() not in found.robot.extensions:
            raise ExportError(
                f"Expected an output in the format of the input, {listed(found.robot.extensions)}, found "
                f"'{path.name}'; choose another name"
            )
        shapes = {row: cover.balls for row, cover in enumerate(found.links) if cover.balls}
        data = found.robot.with_shapes(shapes)
        write_whole(path, lambda stream: stream.write(data))
        return ()

    def words(self) -> dict[str, Any]:
        """Return the settings as words of the command line."""
        balls = as_words(self.wanted.balls)
        chosen = {name: balls[name] for name in ("count", "shapes", "mode")}
        return {**as_words(self.settings), **chosen, "tolerance": self.wanted.tolerance}

    def figures(self, found: RobotCover) -> dict[str, Any]:
        return {
            "links": [cover.figures for cover in found.links],
            "links_left": [cover.link.name for cover in found.links if cover.problem],
        }

    def exit_code(self, report: dict[str, Any]) -> int:
        return INPUT if report["links_left"] else DONE


RECORD = Robot
