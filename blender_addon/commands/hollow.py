# SPDX-License-Identifier: GPL-3.0-or-later
"""`medial_axis hollow`: solids with a cavity."""

from __future__ import annotations

import argparse

from ..core.batch.batch import Work
from ..core.batch.hollow_work import HollowWork
from ..core.batch.option_words import add_options, settings_from
from ..core.files.write_triangles import TRIANGLE_FORMATS
from ..core.settings import HollowSettings
from .words import add_files, command_parser

_HELP = """\
INPUT     as of medial_axis --help; the faces are closed.
OUTPUT    a file (.stl .ply .obj .off), or a folder; {name}, {file} and #### as there. It has the faces of
          the input, as triangles, and those of the cavity.

examples:
  medial_axis hollow figure.stl shell.stl --wall 2
  medial_axis hollow figures/*.stl shells/ --format stl --wall 2 --json

exit codes:
  0 all is there   1 something failed   2 wrong usage   3 an input cannot be used, or is nowhere so thick
  4 cancelled   141 nobody reads the results any more
"""


def parser() -> argparse.ArgumentParser:
    found = command_parser(
        "medial_axis hollow",
        "Solids with a cavity, so that a wall of one thickness is left.",
        _HELP,
    )
    add_options(found.add_argument_group("hollow"), HollowSettings)
    add_files(found, TRIANGLE_FORMATS, "stl", _work)
    return found


def _work(wanted: argparse.Namespace) -> Work:
    return HollowWork(settings_from(wanted, HollowSettings))
