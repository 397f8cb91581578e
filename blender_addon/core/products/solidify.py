# SPDX-License-Identifier: GPL-3.0-or-later
"""The record of solids that are made of sheets."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..files.write_triangles import TRIANGLE_FORMATS, export_triangles
from ..machine.memory_limit import MemoryLimit
from ..machine.progress import Progress
from ..settings import SolidifySettings
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
    samples = False
    hidden = ("only_selected",)
    codes = ((0, "the wall is even"), (5, "somewhere there is no room for the wall"))
    help = """\
INPUT     as of medial_axis --help; faces whose front is the side to which they look.
OUTPUT    a file (.stl .ply .obj .off), or a folder; {name}, {file} and #### as there. It has the front,
          the back and the strips between their rims, as triangles.

examples:
  medial_axis solidify cloth.stl solid.stl --thickness 0.8
  medial_axis solidify sheets/*.ply solids/ --format stl --thickness 0.8 --offset -1 --json
"""

    def compute(self, shape: Shape, _limit: MemoryLimit, progress: Progress | None) -> Solidified:
        return solidify(shape, self.wanted, None, progress)

    def write(self, found: Solidified, path: Path, frame: np.ndarray) -> tuple[str, ...]:
        export_triangles(found.vertices, found.triangles, path, frame, found.wall)
        return ()

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
