# SPDX-License-Identifier: GPL-3.0-or-later
"""This module computes the medial axis of each shape of a batch."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..axis.compute import Computation, compute_axis
from ..axis.structure_table import summary_of
from ..errors import MedialAxisError
from ..files.write import export_axis, left_out
from ..machine.memory_limit import MemoryLimit
from ..machine.progress import Progress
from ..samples.shape import Shape
from ..settings import Settings
from ..solid.reduce import reduced
from .option_words import as_words


@dataclass(frozen=True)
class AxisWork:
    """Computes medial axes with some settings, and writes them as files.

    Parameters
    ----------
    settings : Settings
    triangles : bool
        Write triangles in text.
    vertices : int
        An axis is reduced to at most this many vertices; 0 keeps all.
    """

    settings: Settings
    triangles: bool = False
    vertices: int = 0

    def compute(self, shape: Shape, limit: MemoryLimit, progress: Progress | None) -> Computation:
        found = compute_axis(shape, self.settings, progress, limit)
        return reduced(found, self.vertices, progress) if self._reduces(found) else found

    def _reduces(self, found: Computation) -> bool:
        return self.vertices > 0 and not found.axis.is_empty

    def check(self, found: Computation) -> None:
        """Raise MedialAxisError if there is nothing to write."""
        if found.axis.is_empty:
            raise MedialAxisError(found.warnings[-1])

    def write(self, found: Computation, path: Path, frame: np.ndarray) -> tuple[str, ...]:
        """Write the file, and return warnings about the parts that it does not hold."""
        export_axis(found.axis, path, frame, self.triangles)
        left = left_out(found.axis, path, self.triangles)
        return (left,) if left else ()

    def words(self) -> dict[str, Any]:
        """Return the settings as words of the command line."""
        words = as_words(self.settings)
        return {**words, "vertices": self.vertices} if self.vertices else words

    def figures(self, found: Computation) -> dict[str, Any]:
        axis, by_faces = found.axis, found.chosen.samples.by_faces
        return {
            "points": found.points,
            "duplicates": found.duplicates,
            "form": as_words(found.settings)["form"],
            "topology": found.topology,
            "betti": None if axis.level is None else list(axis.level.betti),
            "betti_by_faces": None if by_faces is None else list(by_faces),
            "places": None if axis.level is None else axis.level.places,
            "refused": None if axis.level is None else axis.level.refused,
            "structure": None if axis.structure is None else summary_of(axis.structure),
            "facets": axis.facets,
            "edges": len(axis.edges),
            "vertices": len(axis.vertices),
            "unbounded": axis.unbounded,
            "zero_area": axis.zero_area,
            "radius": [float(axis.radius.min()), float(axis.radius.max())],
            "sampled": found.chosen.reason,
            "density": str(found.density),
            "missed": found.missed,
            "inside": str(found.sides),
            "turned_faces": found.turned,
            "scan": None if found.chosen.scan is None else found.chosen.scan.figures,
            "mesh": None if found.mesh is None else asdict(found.mesh),
        }
