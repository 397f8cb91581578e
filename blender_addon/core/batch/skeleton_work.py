# SPDX-License-Identifier: GPL-3.0-or-later
"""This module computes the skeleton of each shape of a batch."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..files.write_skeleton import export_skeleton, holds_branches
from ..machine.memory_limit import MemoryLimit
from ..machine.progress import Progress
from ..samples.shape import Shape
from ..settings import Settings, SkeletonSettings
from ..skeleton.branches import measure_branches
from ..skeleton.compute import Skeletonization, compute_skeleton
from ..small_matrices import times
from .option_words import as_words


@dataclass(frozen=True)
class SkeletonWork:
    """Computes skeletons with some settings, and writes them as files."""

    settings: Settings
    wanted: SkeletonSettings
    ends: tuple[tuple[float, float, float], ...] = ()  # in the space of the output

    def compute(
        self, shape: Shape, limit: MemoryLimit, progress: Progress | None
    ) -> Skeletonization:
        return compute_skeleton(
            shape, self.settings, self.wanted, progress, limit, self._ends(shape)
        )

    def _ends(self, shape: Shape) -> np.ndarray | None:
        """Return the ends in the space of the shape."""
        if not self.ends:
            return None
        ends = np.array(self.ends, np.float64)
        return times(ends - shape.frame[:3, 3], shape.frame[:3, :3].T)

    def check(self, found: Skeletonization) -> None:
        """Accept every result: a skeleton has at least one point."""

    def write(self, found: Skeletonization, path: Path, frame: np.ndarray) -> tuple[str, ...]:
        branches = measure_branches(found) if holds_branches(path) else None
        export_skeleton(found.skeleton.placed(frame), found.parts, path, branches)
        return ()

    def words(self) -> dict[str, Any]:
        """Return the settings as words of the command line."""
        words = {**as_words(self.settings), **as_words(self.wanted)}
        return {**words, "end": [list(end) for end in self.ends]} if self.ends else words

    def figures(self, found: Skeletonization) -> dict[str, Any]:
        skeleton = found.skeleton
        return {
            "points": found.points,
            "duplicates": found.duplicates,
            "branches": skeleton.count,
            "ends": skeleton.tips,
            "loops": skeleton.loops,
            "pieces": skeleton.pieces,
            "gaps_joined": skeleton.gaps.tolist(),
            "loops_cut": found.loops.cut,
            "loops_filled": found.loops.filled,
            "mirrored": found.mirrored,
            "length": skeleton.length,
            "radius": [float(skeleton.radius.min()), float(skeleton.radius.max())],
            "sampled": found.chosen.reason,
        }
