# SPDX-License-Identifier: GPL-3.0-or-later
"""The record of solids with thicker walls."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..files.write_triangles import TRIANGLE_FORMATS, export_triangles
from ..files.writing import known
from ..machine.memory_limit import MemoryLimit
from ..machine.progress import Progress
from ..settings import ThickenSettings
from ..shape.shape import Shape
from ..thickness.thicken import Thickened, thicken
from .product import DONE, THIN, Product


@dataclass(frozen=True)
class ThickerWalls(Product):
    wanted: ThickenSettings

    description = "Solids whose walls are moved apart where they are thinner than a limit."
    heading = "walls"
    kind = ThickenSettings
    formats = TRIANGLE_FORMATS
    usual = "stl"
    hidden = ("moving",)
    codes = ((0, "all walls have the limit"), (5, "something is still thinner than the limit"))
    help = """\
INPUT     as of medial_axis --help; the faces are closed.
OUTPUT    a file (.stl .ply .obj .off), or a folder; {name}, {file} and #### as there. It has the faces of
          the input, as triangles.

examples:
  medial_axis thicken bracket.stl thicker.stl --limit 1.2
  medial_axis thicken parts/*.stl thicker/ --format stl --limit 1.2 --subdivide --json
"""

    def compute(self, shape: Shape, limit: MemoryLimit, progress: Progress | None) -> Thickened:
        return thicken(shape, self.settings, self.wanted, None, progress, limit)

    def write(self, found: Thickened, path: Path, frame: np.ndarray) -> tuple[str, ...]:
        shape = found.after.shape
        export_triangles(shape.points, shape.triangles, path, frame, self.wanted.limit)
        return ()

    def figures(self, found: Thickened) -> dict[str, Any]:
        """Return figures; None means that there is no such length."""
        return {
            "points": len(found.moves),
            "faces": len(found.after.shape.triangles),
            "farthest_move": float(np.linalg.norm(found.moves, axis=1).max(initial=0.0)),
            "minimum_before": known(found.before.minimum),
            "minimum": known(found.after.minimum),
            "narrowest_gap": known(found.gap),
            "share_below": found.left.share,
            "patches": len(found.left.patches),
        }

    def exit_code(self, report: dict[str, Any]) -> int:
        return THIN if report["patches"] else DONE


RECORD = ThickerWalls
