# SPDX-License-Identifier: GPL-3.0-or-later
"""The record of hollow solids."""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..batch.option_words import add_options, as_words, settings_from
from ..files.write_triangles import TRIANGLE_FORMATS, export_triangles
from ..hollow.hollow import Hollow, hollow
from ..machine.memory_limit import MemoryLimit
from ..machine.progress import Progress
from ..settings import HollowSettings, Settings
from ..shape.shape import Shape
from .product import Product


@dataclass(frozen=True)
class HollowSolid(Product):
    wanted: HollowSettings

    description = "Solids with a cavity, so that a wall of one thickness is left."
    heading = "hollow"
    kind = HollowSettings
    formats = TRIANGLE_FORMATS
    usual = "stl"
    codes = ((3, "an input cannot be used, or is nowhere so thick"),)
    help = """\
INPUT     as of medial_axis --help; the faces are closed.
OUTPUT    a file (.stl .ply .obj .off), or a folder; {name}, {file} and #### as there. It has the faces of
          the input, as triangles, and those of the cavity.

examples:
  medial_axis hollow figure.stl shell.stl --wall 2
  medial_axis hollow figures/*.stl shells/ --format stl --wall 2 --json
"""

    @classmethod
    def add_words(cls, parser: argparse.ArgumentParser) -> None:
        add_options(parser.add_argument_group(cls.heading), cls.kind)

    @classmethod
    def from_words(cls, words: argparse.Namespace) -> HollowSolid:
        return cls(Settings(), settings_from(words, cls.kind))

    def compute(self, shape: Shape, _limit: MemoryLimit, progress: Progress | None) -> Hollow:
        return hollow(shape, self.wanted, progress)

    def write(self, found: Hollow, path: Path, frame: np.ndarray) -> tuple[str, ...]:
        export_triangles(found.vertices, found.triangles, path, frame, found.step)
        return ()

    def words(self) -> dict[str, Any]:
        """Return the settings as words of the command line."""
        return as_words(self.wanted)  # the method has no part in it

    def figures(self, found: Hollow) -> dict[str, Any]:
        return {
            "points": found.points,
            "faces": len(found.triangles),
            "wall": found.wall,
            "least_wall": found.least,
            "deepest": found.deepest,
            "volume": found.volume,
            "volume_of_solid": found.solid_volume,
            "cavities": found.cavities,
        }


RECORD = HollowSolid
