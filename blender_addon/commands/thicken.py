# SPDX-License-Identifier: GPL-3.0-or-later
"""`medial_axis thicken`: thin walls moved apart."""

from __future__ import annotations

import argparse

from ..core.batch.batch import Work
from ..core.batch.option_words import add_options, add_sampling, sampling_from, settings_from
from ..core.batch.thicken_work import ThickenWork
from ..core.files.write_triangles import TRIANGLE_FORMATS
from ..core.settings import ThickenSettings
from .words import add_files, command_parser

_HELP = """\
INPUT     as of medial_axis --help; the faces are closed.
OUTPUT    a file (.stl .ply .obj .off), or a folder; {name}, {file} and #### as there. It has the faces of
          the input, as triangles.

examples:
  medial_axis thicken bracket.stl thicker.stl --limit 1.2
  medial_axis thicken parts/*.stl thicker/ --format stl --limit 1.2 --subdivide --json

exit codes:
  0 all walls have the limit   1 something failed   2 wrong usage   3 an input cannot be used
  4 cancelled   5 something is still thinner than the limit   141 nobody reads the results any more
"""


def parser() -> argparse.ArgumentParser:
    found = command_parser(
        "medial_axis thicken",
        "Solids whose walls are moved apart where they are thinner than a limit.",
        _HELP,
    )
    # Faces are selected in Blender only.
    add_options(found.add_argument_group("walls"), ThickenSettings, without=("moving",))
    add_sampling(found.add_argument_group("method"))
    add_files(found, TRIANGLE_FORMATS, "stl", _work)
    return found


def _work(wanted: argparse.Namespace) -> Work:
    return ThickenWork(sampling_from(wanted), settings_from(wanted, ThickenSettings))
