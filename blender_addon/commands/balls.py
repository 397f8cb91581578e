# SPDX-License-Identifier: GPL-3.0-or-later
"""`medial_axis balls`: few balls or capsules."""

from __future__ import annotations

import argparse

from ..core.batch.balls_work import BallsWork
from ..core.batch.batch import Work
from ..core.batch.option_words import add_options, add_sampling, sampling_from, settings_from
from ..core.cover.write_balls import BALL_FORMATS
from ..core.settings import BallSettings
from .words import add_files, command_parser

_HELP = """\
INPUT     as of medial_axis --help.
OUTPUT    a file, or a folder; {name}, {file} and #### as there.
          .ma    a vertex with its radius for each ball
          .json  centres, radii, the covered volume, how far balls reach out
          .urdf  a robot of one link with a collision sphere for each ball
          .mjcf .xml  a body of MuJoCo with a sphere for each ball

examples:
  medial_axis balls robot.stl robot.json --count 64 --mode around
  medial_axis balls robot.stl robot.urdf --count 100 --tolerance 1
  medial_axis balls parts/*.stl balls/ --format ma
  medial_axis balls walk.blend balls/{name}_####.json --frames 1-250 --object Body

exit codes:
  0 all is there   1 something failed   2 wrong usage   3 an input cannot be used   4 cancelled
  141 nobody reads the results any more
"""


def parser() -> argparse.ArgumentParser:
    found = command_parser(
        "medial_axis balls",
        "Solids as few balls of their medial axes, for collisions, physics and robots.",
        _HELP,
    )
    add_options(found.add_argument_group("balls"), BallSettings)
    add_sampling(found.add_argument_group("method"))
    add_files(found, BALL_FORMATS, "json", _work)
    return found


def _work(wanted: argparse.Namespace) -> Work:
    return BallsWork(sampling_from(wanted), settings_from(wanted, BallSettings))
