# SPDX-License-Identifier: GPL-3.0-or-later
"""`medial_axis skeleton`: curve skeletons."""

from __future__ import annotations

import argparse
import math

from ..core.batch.batch import Work
from ..core.batch.option_words import add_options, add_sampling, sampling_from, settings_from
from ..core.batch.skeleton_work import SkeletonWork
from ..core.settings import SkeletonSettings
from ..core.skeleton.write_skeleton import SKELETON_FORMATS
from .words import add_files, command_parser

_HELP = """\
INPUT     as of medial_axis --help.
OUTPUT    a file, or a folder; {name}, {file} and #### as there.
          .swc   points with type, radius and parent; trees only, comments name edges that close loops
          .obj   a line for each branch
          .json  nodes with radii, edges, and the faces and measures of each branch
          .csv   a row for each branch: length, radii, curvature, torsion, cross-sections, ends
          .vtp   lines with the same measures, and those along each branch, for VTK and ParaView

examples:
  medial_axis skeleton neuron.ply neuron.swc --detail 0.7
  medial_axis skeleton vessel.stl vessel.csv
  medial_axis skeleton trees/*.obj lines/ --format obj
  medial_axis skeleton walk.blend lines/{name}_####.json --frames 1-250 --object Body

exit codes:
  0 all is there   1 something failed   2 wrong usage   3 an input cannot be used   4 cancelled
  141 nobody reads the results any more
"""


def parser() -> argparse.ArgumentParser:
    found = command_parser(
        "medial_axis skeleton",
        "The curve skeletons of meshes and point clouds, with radii.",
        _HELP,
    )
    group = found.add_argument_group("skeleton")
    add_options(group, SkeletonSettings)
    group.add_argument(
        "--end",
        action="append",
        default=[],
        type=_place,
        metavar="X,Y,Z",
        help="a place on the surface at the end of a limb; given two or more times, the skeleton keeps only what "
        "joins these ends (--end=-1,2,3 where a minus comes first)",
    )
    add_sampling(found.add_argument_group("method"))
    add_files(found, SKELETON_FORMATS, "json", _work)
    return found


def _work(wanted: argparse.Namespace) -> Work:
    return SkeletonWork(
        sampling_from(wanted), settings_from(wanted, SkeletonSettings), tuple(wanted.end)
    )


def _place(text: str) -> tuple[float, ...]:
    """Three finite numbers with commas between them."""
    try:
        numbers = tuple(float(word) for word in text.split(","))
        if len(numbers) == 3 and all(map(math.isfinite, numbers)):
            return numbers
    except ValueError:
        pass
    raise argparse.ArgumentTypeError(f"Expected X,Y,Z, three finite numbers, found '{text}'")
