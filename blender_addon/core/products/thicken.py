# SPDX-License-Identifier: GPL-3.0-or-later
"""The record of solids with thicker walls."""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..batch.option_words import add_options, add_sampling
from ..files.json_figures import known
from ..files.write_triangles import TRIANGLE_FORMATS, export_triangles
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
    codes = ((0, "all walls have the limit"), (5, "something is still thinner than the limit"))
    help = """\
INPUT     as of medial_axis --help; the faces are closed.
OUTPUT    a file (.stl .ply .obj .off), or a folder; {name}, {file} and #### as there. It has the faces of
          the input, as triangles.

examples:
  medial_axis thicken bracket.stl thicker.stl --limit 1.2
  medial_axis thicken parts/*.stl thicker/ --format stl --limit 1.2 --subdivide --json
"""

    @classmethod
    def add_words(cls, parser: argparse.ArgumentParser) -> None:
        group = parser.add_argument_group(cls.heading)
        add_options(group, cls.kind, without=("moving",))  # faces are selected in Blender only
        add_sampling(parser.add_argument_group("method"))

    def compute(self, shape: Shape, limit: MemoryLimit, progress: Progress | None) -> Thickened:
        return thicken(shape, self.settings, self.wanted, None, progress, limit)

    def write(self, found: Thickened, path: Path, frame: np.ndarray) -> tuple[str, ...]:
        shape = found.after.shape
        export_triangles(shape.points, shape.triangles, path, frame, self.wanted.limit)
        return ()

    def words(self) -> dict[str, Any]:
        """Return the settings as words of the command line."""
        words = super().words()
        del words["moving"]
        return words

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
