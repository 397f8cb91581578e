# SPDX-License-Identifier: GPL-3.0-or-later
"""`medial_axis robot`: robots whose links collide as balls or capsules."""

from __future__ import annotations

import argparse
import math

from ..core.batch.batch import Work
from ..core.batch.option_words import add_sampling, sampling_from
from ..core.batch.robot_work import RobotWork
from ..core.files.robot_file import read_robot
from ..core.settings import BallSettings, CoverMode, CoverShapes
from ..core.solid.link_shapes import LinkSettings
from .words import add_files, command_parser

_MOST = 64  # shapes of a link where only a tolerance is given
_HELP = """\
INPUT     .urdf, with boxes, cylinders, spheres, and meshes in .stl .obj .ply .off
OUTPUT    .urdf: the same bytes, but other collision geometry; links of spheres alone stay. A capsule is a
          cylinder and two spheres.

examples:
  medial_axis robot arm.urdf capsules.urdf
  medial_axis robot arm.urdf balls.urdf --balls 16
  medial_axis robot arm.urdf close.urdf --tolerance 0.005

exit codes:
  0 all is there   1 something failed   2 wrong usage   3 an input, or a link of it, cannot be used
  4 cancelled   141 nobody reads the results any more
"""


def parser() -> argparse.ArgumentParser:
    found = command_parser(
        "medial_axis robot",
        "Robots whose links collide as few balls or capsules that hold them.",
        _HELP,
    )
    links = found.add_argument_group("links")
    kinds = links.add_mutually_exclusive_group()
    kinds.add_argument(
        "--capsules", type=int, metavar="N", help="at most N capsules for each link (default: 1)"
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
    add_sampling(found.add_argument_group("method"))
    add_files(found, (".urdf",), "urdf", _work, read_robot)
    return found


def _work(wanted: argparse.Namespace) -> Work:
    if not 0.0 <= wanted.tolerance < math.inf:
        raise ValueError(
            f"Expected --tolerance as a finite length of at least 0, found {wanted.tolerance}"
        )
    given = wanted.capsules if wanted.balls is None else wanted.balls
    usual = _MOST if wanted.tolerance > 0.0 else 1
    balls = BallSettings(
        count=usual if given is None else given,
        shapes=CoverShapes.CAPSULES if wanted.balls is None else CoverShapes.BALLS,
        mode=CoverMode[wanted.mode.upper()],
    )
    return RobotWork(sampling_from(wanted), LinkSettings(balls, wanted.tolerance))
