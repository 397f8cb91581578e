# SPDX-License-Identifier: GPL-3.0-or-later
"""This module moves the thin walls of each solid of a batch apart."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..files.json_figures import known
from ..files.write_triangles import export_triangles
from ..machine.memory_limit import MemoryLimit
from ..machine.progress import Progress
from ..settings import Settings, ThickenSettings
from ..shape.shape import Shape
from ..thickness.thicken import Thickened, thicken
from .option_words import as_words


@dataclass(frozen=True)
class ThickenWork:
    """Moves thin walls apart to a limit, and writes the solids as files."""

    settings: Settings
    wanted: ThickenSettings

    def compute(self, shape: Shape, limit: MemoryLimit, progress: Progress | None) -> Thickened:
        return thicken(shape, self.settings, self.wanted, None, progress, limit)

    def check(self, found: Thickened) -> None:
        """Accept every result: a solid whose walls have the limit is a result, too."""

    def write(self, found: Thickened, path: Path, frame: np.ndarray) -> tuple[str, ...]:
        shape = found.after.shape
        export_triangles(shape.points, shape.triangles, path, frame, self.wanted.limit)
        return ()

    def words(self) -> dict[str, Any]:
        """Return the settings as words of the command line."""
        words = {**as_words(self.settings), **as_words(self.wanted)}
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
