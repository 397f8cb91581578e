# SPDX-License-Identifier: GPL-3.0-or-later
"""The record of medial axes, which the command line writes unless it is asked for another product."""

from __future__ import annotations

import argparse
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..axis.compute import Computation, compute_axis
from ..axis.structure_table import summary_of
from ..batch.option_words import add_options, as_words, settings_from
from ..errors import MedialAxisError
from ..files.write import FORMATS, export_axis, left_out
from ..machine.memory_limit import MemoryLimit
from ..machine.progress import Progress
from ..rebuild.reduce import reduced
from ..settings import Settings, Side
from ..shape.shape import Shape
from .product import Product


@dataclass(frozen=True)
class Axis(Product):
    """Medial axes."""

    triangles: bool = False  # Write triangles in text
    vertices: int = 0  # An axis is reduced to at most this many vertices; 0 keeps all

    description = "The medial axis of meshes and point clouds, with radii."
    heading = "method"
    kind = Settings
    formats = FORMATS
    usual = "ma"
    help = """\
INPUT     .off .obj .ply .stl .dae .xyz .xyzn .npy .npz; inside Blender also .blend and what Blender imports.
          Without INPUT, inside Blender: the file that is open.
OUTPUT    a file (.ma .ply .obj .off .npz, or .csv for a table of the sheets), or a folder; {name} is
          the object or the file, {file} the file, #### the frame.

examples:
  medial_axis bunny.ply bunny.ma
  medial_axis bunny.ply hand.obj axes/ --format ply --theta 30 --side both
  medial_axis cloth_####.obj axes/cloth_####.npz --frames 1-250
  medial_axis walk.blend axes/{name}_####.npz --frames 1-250 --object Body --json
  medial_axis hand.obj hand.ma --vertices 200
  medial_axis skeleton neuron.ply neuron.swc
  medial_axis balls robot.stl robot.json --count 64 --mode around
  medial_axis midsurface part.stl part.inp
  medial_axis hollow figure.stl shell.stl --wall 2
"""

    @classmethod
    def add_words(cls, parser: argparse.ArgumentParser) -> None:
        add_options(parser.add_argument_group(cls.heading), cls.kind)
        parser.add_argument_group("small medial mesh").add_argument(
            "--vertices",
            type=int,
            default=0,
            metavar="N",
            help="reduce the axis to at most N vertices of the same topology (default: 0, all)",
        )
        parser.add_argument(
            "--triangles",
            action="store_true",
            help="write .ply, .obj and .off as triangles in text, which more programs read",
        )

    @classmethod
    def from_words(cls, words: argparse.Namespace) -> Axis:
        settings = settings_from(words, Settings)
        if words.vertices < 0:
            raise ValueError(
                f"Expected --vertices of 0 or more, found {words.vertices}; 0 keeps all"
            )
        if words.vertices and settings.with_side().side is not Side.INNER:
            raise ValueError("Expected --side inner with --vertices, found another; leave out one")
        return cls(settings, triangles=words.triangles, vertices=words.vertices)

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
        words = super().words()
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


RECORD = Axis
