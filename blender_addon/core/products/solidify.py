# SPDX-License-Identifier: GPL-3.0-or-later
"""The record of solids that are made of sheets."""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..batch.option_words import add_options, as_words, settings_from
from ..files.write_triangles import TRIANGLE_FORMATS, export_triangles
from ..machine.memory_limit import MemoryLimit
from ..machine.progress import Progress
from ..settings import Settings, SolidifySettings
from ..shape.shape import Shape
from ..solidify.solidify import Solidified, solidify
from .product import DONE, THIN, Product


@dataclass(frozen=True)
class SolidOfSheet(Product):
    wanted: SolidifySettings

    description = (
        "Closed solids of an even wall that are made of sheets, and do not cross themselves."
    )
    heading = "solid"
    kind = SolidifySettings
    formats = TRIANGLE_FORMATS
    usual = "stl"
    codes = ((0, "the wall is even"), (5, "somewhere there is no room for the wall"))
    help = """\
INPUT     as of medial_axis --help; faces whose front is the side to which they look.
OUTPUT    a file (.stl .ply .obj .off), or a folder; {name}, {file} and #### as there. It has the front,
          the back and the strips between their rims, as triangles.

examples:
  medial_axis solidify cloth.stl solid.stl --thickness 0.8
  medial_axis solidify sheets/*.ply solids/ --format stl --thickness 0.8 --offset -1 --json
"""

    @classmethod
    def add_words(cls, parser: argparse.ArgumentParser) -> None:
        group = parser.add_argument_group(cls.heading)
        add_options(
            group, cls.kind, without=("only_selected",)
        )  # faces are selected in Blender only

    @classmethod
    def from_words(cls, words: argparse.Namespace) -> SolidOfSheet:
        return cls(Settings(), settings_from(words, cls.kind))

    def compute(self, shape: Shape, _limit: MemoryLimit, progress: Progress | None) -> Solidified:
        return solidify(shape, self.wanted, None, progress)

    def write(self, found: Solidified, path: Path, frame: np.ndarray) -> tuple[str, ...]:
        export_triangles(found.vertices, found.triangles, path, frame, found.wall)
        return ()

    def words(self) -> dict[str, Any]:
        """Return the settings as words of the command line."""
        words = as_words(self.wanted)  # the method has no part in it
        del words["only_selected"]
        return words

    def figures(self, found: Solidified) -> dict[str, Any]:
        return {
            "points": found.points,
            "faces": len(found.triangles),
            "wall": found.wall,
            "least_wall": found.least,
            "share_without_room": found.without_room,
            "crossings": found.crossings,
            "volume": found.volume,
        }

    def exit_code(self, report: dict[str, Any]) -> int:
        return THIN if report["share_without_room"] > 0.0 else DONE


RECORD = SolidOfSheet
