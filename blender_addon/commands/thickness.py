# SPDX-License-Identifier: GPL-3.0-or-later
"""`medial_axis thickness`: how thick solids are."""

from __future__ import annotations

import argparse

from ..core.batch.batch import Work
from ..core.batch.option_words import add_sampling, add_thickness, settings_from
from ..core.batch.thickness_work import ThicknessWork
from ..core.files.write_thickness import THICKNESS_FORMATS
from ..core.settings import Settings, ThicknessSettings
from .words import add_files, command_parser

_HELP = """\
INPUT     as of medial_axis --help.
OUTPUT    a file, or a folder; {name}, {file} and #### as there.
          .csv   thickness at every vertex of the input and every other measured point
          .json  minimum, area and share below the limit, patches with place, area and minimum
          .ply   the measured surface, coloured: red at the limit, blue from three times the limit
          With --page FILE.html there is no OUTPUT: the page has a row for each INPUT.

examples:
  medial_axis thickness bracket.stl bracket.json --limit 1.2 --unit mm
  medial_axis thickness parts/*.stl reports/ --format csv --limit 1.2
  medial_axis thickness hinge.stl gaps.ply --limit 0.4 --gap
  medial_axis thickness parts/*.stl --limit 0.8 --unit mm --page report.html

exit codes:
  0 nothing is thinner than the limit   1 something failed   2 wrong usage   3 an input cannot be used
  4 cancelled   5 something is thinner than the limit   6 something could not be measured
  141 nobody reads the results any more
"""


def parser() -> argparse.ArgumentParser:
    found = command_parser(
        "medial_axis thickness",
        "How thick meshes and point clouds are, and where they are too thin.",
        _HELP,
    )
    lengths = found.add_argument_group("lengths")
    add_thickness(lengths)
    lengths.add_argument(
        "--unit", default="", metavar="NAME", help="what lengths are in, for the report; mm, say"
    )
    add_sampling(found.add_argument_group("method"))
    add_files(found, THICKNESS_FORMATS, "json", _work).add_argument(
        "--page",
        metavar="FILE",
        help="one page of .html with a row for each INPUT, instead of OUTPUT",
    )
    return found


def _work(wanted: argparse.Namespace) -> Work:
    return ThicknessWork(
        settings_from(wanted, Settings), settings_from(wanted, ThicknessSettings), wanted.unit
    )
