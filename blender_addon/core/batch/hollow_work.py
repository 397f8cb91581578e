# SPDX-License-Identifier: GPL-3.0-or-later
"""This module hollows each solid of a batch."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..files.write_triangles import export_triangles
from ..hollow.hollow import Hollow, hollow
from ..machine.memory_limit import MemoryLimit
from ..machine.progress import Progress
from ..settings import HollowSettings
from ..shape.shape import Shape
from .option_words import as_words


@dataclass(frozen=True)
class HollowWork:
    """Hollows solids to a wall, and writes them as files."""

    wanted: HollowSettings

    def compute(self, shape: Shape, _limit: MemoryLimit, progress: Progress | None) -> Hollow:
        return hollow(shape, self.wanted, progress)

    def check(self, found: Hollow) -> None:
        """Accept every result: where nothing can be hollow, computing it fails."""

    def write(self, found: Hollow, path: Path, frame: np.ndarray) -> tuple[str, ...]:
        export_triangles(found.vertices, found.triangles, path, frame, found.step)
        return ()

    def words(self) -> dict[str, Any]:
        """Return the settings as words of the command line."""
        return as_words(self.wanted)

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
