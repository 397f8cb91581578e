# SPDX-License-Identifier: GPL-3.0-or-later
"""The record of hollow solids."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..files.write_triangles import TRIANGLE_FORMATS, export_triangles
from ..hollow.hollow import Hollow, hollow
from ..machine.memory_limit import MemoryLimit
from ..machine.progress import Progress
from ..settings import HollowSettings
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
    samples = False
    codes = ((3, "an input cannot be used, or is nowhere so thick"),)
    help = """\
INPUT     as of medial_axis --help; the faces are closed.
OUTPUT    a file (.stl .ply .obj .off), or a folder; {name}, {file} and #### as there. It has the faces of
          the input, as triangles, and those of the cavity.

examples:
  medial_axis hollow figure.stl shell.stl --wall 2
  medial_axis hollow figures/*.stl shells/ --format stl --wall 2 --json
"""

    def compute(self, shape: Shape, _limit: MemoryLimit, progress: Progress | None) -> Hollow:
        return hollow(shape, self.wanted, progress)

    def write(self, found: Hollow, path: Path, frame: np.ndarray) -> tuple[str, ...]:
        export_triangles(found.vertices, found.triangles, path, frame, found.step)
        return ()

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
