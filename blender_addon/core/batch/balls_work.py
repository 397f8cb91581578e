# SPDX-License-Identifier: GPL-3.0-or-later
"""This module represents each solid of a batch by few balls."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..cover.ball_cover import BallCover, cover_by_balls
from ..cover.write_balls import as_figures, export_balls
from ..machine.memory_limit import MemoryLimit
from ..machine.progress import Progress
from ..settings import BallSettings, Settings
from ..shape.shape import Shape
from .option_words import as_words


@dataclass(frozen=True)
class BallsWork:
    """Computes balls with some settings, and writes them as files."""

    settings: Settings
    wanted: BallSettings

    def compute(self, shape: Shape, limit: MemoryLimit, progress: Progress | None) -> BallCover:
        return cover_by_balls(shape, self.settings, self.wanted, progress, limit)

    def check(self, found: BallCover) -> None:
        """Accept every result: a solid has at least one ball, or computing it fails."""

    def write(self, found: BallCover, path: Path, frame: np.ndarray) -> tuple[str, ...]:
        export_balls(found.balls, path, frame)
        return ()

    def words(self) -> dict[str, Any]:
        """Return the settings as words of the command line."""
        return {**as_words(self.settings), **as_words(self.wanted)}

    def figures(self, found: BallCover) -> dict[str, Any]:
        return {
            "points": found.points,
            "count": found.balls.count,
            **as_figures(found.balls),
            "sampled": found.chosen.reason,
            "density": str(found.chosen.samples.density),
            "inside": str(found.chosen.sides),
        }
