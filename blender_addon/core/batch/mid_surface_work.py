# SPDX-License-Identifier: GPL-3.0-or-later
"""This module turns each thin solid of a batch into sheets with thickness."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..machine.memory_limit import MemoryLimit
from ..machine.progress import Progress
from ..mid_surface.mid_surface import MidSurface, mid_surface
from ..mid_surface.write_mid_surface import export_mid_surface
from ..settings import MidSurfaceSettings, Settings
from ..shape.shape import Shape
from .option_words import as_words


@dataclass(frozen=True)
class MidSurfaceWork:
    """Computes middle surfaces with some settings, and writes them as files."""

    settings: Settings
    wanted: MidSurfaceSettings

    def compute(self, shape: Shape, limit: MemoryLimit, progress: Progress | None) -> MidSurface:
        return mid_surface(shape, self.settings, self.wanted, progress, limit)

    def check(self, found: MidSurface) -> None:
        """Accept every result: where there is no thin wall, computing it fails."""

    def write(self, found: MidSurface, path: Path, frame: np.ndarray) -> tuple[str, ...]:
        export_mid_surface(found, path, frame)
        return ()

    def words(self) -> dict[str, Any]:
        """Return the settings as words of the command line."""
        return {**as_words(self.settings), **as_words(self.wanted)}

    def figures(self, found: MidSurface) -> dict[str, Any]:
        return {
            "points": found.points,
            "sheets": found.sheets,
            "faces": len(found.part),
            "least_thickness": float(found.thickness.min()),
            "largest_thickness": float(found.thickness.max()),
            "share_of_volume": found.share,
            "sampled": found.chosen.reason,
            "inside": str(found.chosen.sides),
        }
