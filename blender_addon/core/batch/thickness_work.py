# SPDX-License-Identifier: GPL-3.0-or-later
"""This module measures the thickness of each shape of a batch."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..machine.memory_limit import MemoryLimit
from ..machine.progress import Progress
from ..settings import Settings, ThicknessSettings
from ..shape.shape import Shape
from ..thickness.measurement import Measurement
from ..thickness.thickness import measure_thickness
from ..thickness.thin_parts import find_thin_parts
from ..thickness.write_thickness import export_thickness, summary_of
from .option_words import as_words


@dataclass(frozen=True)
class ThicknessWork:
    """Measures thickness with some settings, and writes it as files; lengths are in `unit`."""

    settings: Settings
    wanted: ThicknessSettings
    unit: str = ""

    def compute(self, shape: Shape, limit: MemoryLimit, progress: Progress | None) -> Measurement:
        return measure_thickness(shape, self.settings, self.wanted, progress, limit)

    def check(self, found: Measurement) -> None:
        """Accept every result: a shape without walls is a result, too."""

    def write(self, found: Measurement, path: Path, _frame: np.ndarray) -> tuple[str, ...]:
        export_thickness(found, find_thin_parts(found, self.wanted.limit), path, self.unit)
        return ()

    def words(self) -> dict[str, Any]:
        """Return the settings as words of the command line."""
        return {**as_words(self.settings), **as_words(self.wanted)}

    def figures(self, found: Measurement) -> dict[str, Any]:
        summary = summary_of(found, find_thin_parts(found, self.wanted.limit), self.unit)
        del summary["warnings"]  # every report has them
        return summary
