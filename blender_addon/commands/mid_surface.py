# SPDX-License-Identifier: GPL-3.0-or-later
"""`medial_axis midsurface`: thin solids as sheets."""

from __future__ import annotations

import argparse

from ..core.batch.batch import Work
from ..core.batch.mid_surface_work import MidSurfaceWork
from ..core.batch.option_words import add_options, add_sampling, sampling_from, settings_from
from ..core.mid_surface.write_mid_surface import MID_SURFACE_FORMATS
from ..core.settings import MidSurfaceSettings
from .words import add_files, command_parser

_HELP = """\
INPUT     as of medial_axis --help.
OUTPUT    a file, or a folder; {name}, {file} and #### as there.
          .inp   shell elements S6, or S8R of quads, with their thickness, for CalculiX
          .obj   polygons, a group for each sheet
          .ply   triangles, with the thickness of each vertex and face
          .stl   triangles; a .csv beside it has the thickness of each
          With --keep-thick a file beside it ends with _thick.stl and has the faces of parts that are not thin.

examples:
  medial_axis midsurface part.stl part.inp --size 2
  medial_axis midsurface part.stl part.inp --size 2 --quads
  medial_axis midsurface parts/*.stl sheets/ --format obj

exit codes:
  0 all is there   1 something failed   2 wrong usage   3 an input cannot be used, or has no thin wall
  4 cancelled   141 nobody reads the results any more
"""


def parser() -> argparse.ArgumentParser:
    found = command_parser(
        "medial_axis midsurface",
        "Thin solids as sheets with thickness, for shell elements and for modelling.",
        _HELP,
    )
    add_options(found.add_argument_group("sheets"), MidSurfaceSettings)
    add_sampling(found.add_argument_group("method"))
    add_files(found, MID_SURFACE_FORMATS, "inp", _work)
    return found


def _work(wanted: argparse.Namespace) -> Work:
    return MidSurfaceWork(sampling_from(wanted), settings_from(wanted, MidSurfaceSettings))
