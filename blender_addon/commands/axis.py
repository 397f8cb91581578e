# SPDX-License-Identifier: GPL-3.0-or-later
"""`medial_axis`: medial axes."""

from __future__ import annotations

import argparse

from ..core.batch.axis_work import AxisWork
from ..core.batch.batch import Work
from ..core.batch.option_words import add_options, settings_from
from ..core.files.write import FORMATS
from ..core.settings import Settings, Side
from .words import add_files, command_parser

_HELP = """\
INPUT     .off .obj .ply .stl .xyz .xyzn .npy .npz; inside Blender also .blend and what Blender imports.
          Without INPUT, inside Blender: the file that is open.
OUTPUT    a file (.ma .ply .obj .off .npz, or .csv for a table of the sheets), or a folder; {name} is
          the object or the file, {file} the file, #### the frame.

Other results: medial_axis thickness --help, medial_axis skeleton --help, medial_axis balls --help,
medial_axis midsurface --help, medial_axis hollow --help, medial_axis robot --help

examples:
  medial_axis bunny.ply bunny.ma
  medial_axis bunny.ply hand.obj axes/ --format ply --theta 30 --side both
  medial_axis cloth_####.obj axes/cloth_####.npz --frames 1-250
  medial_axis walk.blend axes/{name}_####.npz --frames 1-250 --object Body --json
  medial_axis hand.obj hand.ma --vertices 200
  medial_axis skeleton neuron.ply neuron.swc
  medial_axis balls robot.stl robot.json --count 64 --mode around
  medial_axis midsurface part.stl part.inp
  medial_axis hollow figure.stl shell.stl --wall 2

exit codes:
  0 all is there   1 something failed   2 wrong usage   3 an input cannot be used   4 cancelled
  141 nobody reads the results any more
"""


def parser() -> argparse.ArgumentParser:
    found = command_parser(
        "medial_axis", "The medial axis of meshes and point clouds, with radii.", _HELP
    )
    add_options(found.add_argument_group("method"), Settings)
    found.add_argument_group("small medial mesh").add_argument(
        "--vertices",
        type=int,
        default=0,
        metavar="N",
        help="reduce the axis to at most N vertices of the same topology (default: 0, all)",
    )
    files = add_files(found, FORMATS, "ma", _work)
    files.add_argument(
        "--triangles",
        action="store_true",
        help="write .ply, .obj and .off as triangles in text, which more programs read",
    )
    return found


def _work(wanted: argparse.Namespace) -> Work:
    settings = settings_from(wanted, Settings)
    _check_vertices(wanted.vertices, settings)
    return AxisWork(settings, wanted.triangles, wanted.vertices)


def _check_vertices(vertices: int, settings: Settings) -> None:
    if vertices < 0:
        raise ValueError(f"Expected --vertices of 0 or more, found {vertices}; 0 keeps all")
    if vertices and settings.with_side().side is not Side.INNER:
        raise ValueError("Expected --side inner with --vertices, found another; leave out one")
