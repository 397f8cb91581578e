# SPDX-License-Identifier: GPL-3.0-or-later
"""The record of few balls or capsules that cover a solid."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..cover.ball_cover import BallCover, cover_by_balls
from ..cover.write_balls import BALL_FORMATS, as_figures, export_balls
from ..machine.memory_limit import MemoryLimit
from ..machine.progress import Progress
from ..settings import BallSettings
from ..shape.shape import Shape
from .product import Product


@dataclass(frozen=True)
class Balls(Product):
    wanted: BallSettings

    description = "Solids as few balls of their medial axes, for collisions, physics and robots."
    heading = "balls"
    kind = BallSettings
    formats = BALL_FORMATS
    usual = "json"
    help = """\
INPUT     as of medial_axis --help.
OUTPUT    a file, or a folder; {name}, {file} and #### as there.
          .ma    a vertex with its radius for each ball
          .json  centres, radii, the covered volume, how far balls reach out
          .urdf  a robot of one link with a collision sphere for each ball
          .mjcf .xml  a body of MuJoCo with a sphere for each ball

examples:
  medial_axis balls robot.stl robot.json --count 64 --mode around
  medial_axis balls robot.stl robot.urdf --count 100 --tolerance 1
  medial_axis balls parts/*.stl balls/ --format ma
  medial_axis balls walk.blend balls/{name}_####.json --frames 1-250 --object Body
"""

    def compute(self, shape: Shape, limit: MemoryLimit, progress: Progress | None) -> BallCover:
        return cover_by_balls(shape, self.settings, self.wanted, progress, limit)

    def write(self, found: BallCover, path: Path, frame: np.ndarray) -> tuple[str, ...]:
        export_balls(found.balls, path, frame)
        return ()

    def figures(self, found: BallCover) -> dict[str, Any]:
        return {
            "points": found.points,
            "count": found.balls.count,
            **as_figures(found.balls),
            "sampled": found.chosen.reason,
            "density": str(found.chosen.samples.density),
            "inside": str(found.chosen.sides),
        }


RECORD = Balls
