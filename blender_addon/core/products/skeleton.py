# SPDX-License-Identifier: GPL-3.0-or-later
"""The record of curve skeletons."""

from __future__ import annotations

import argparse
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..batch.option_words import add_options, add_sampling, sampling_from, settings_from
from ..machine.memory_limit import MemoryLimit
from ..machine.progress import Progress
from ..settings import SkeletonSettings
from ..shape.shape import Shape
from ..skeleton.branches import measure_branches
from ..skeleton.compute import Skeletonization, compute_skeleton
from ..skeleton.write_skeleton import SKELETON_FORMATS, export_skeleton, holds_branches
from ..small_matrices import times
from .product import Product


@dataclass(frozen=True)
class Skeletons(Product):
    """Curve skeletons; `ends` are places on the surface, in the space of the output."""

    wanted: SkeletonSettings
    ends: tuple[tuple[float, float, float], ...] = ()

    description = "The curve skeletons of meshes and point clouds, with radii."
    heading = "skeleton"
    kind = SkeletonSettings
    formats = SKELETON_FORMATS
    usual = "json"
    help = """\
INPUT     as of medial_axis --help.
OUTPUT    a file, or a folder; {name}, {file} and #### as there.
          .swc   points with type, radius and parent; trees only, comments name edges that close loops
          .obj   a line for each branch
          .json  nodes with radii, edges, and the faces and measures of each branch
          .csv   a row for each branch: length, radii, curvature, torsion, cross-sections, ends
          .vtp   lines with the same measures, and those along each branch, for VTK and ParaView

examples:
  medial_axis skeleton neuron.ply neuron.swc --detail 0.7
  medial_axis skeleton vessel.stl vessel.csv
  medial_axis skeleton trees/*.obj lines/ --format obj
  medial_axis skeleton walk.blend lines/{name}_####.json --frames 1-250 --object Body
"""

    @classmethod
    def add_words(cls, parser: argparse.ArgumentParser) -> None:
        group = parser.add_argument_group(cls.heading)
        add_options(group, cls.kind)
        group.add_argument(
            "--end",
            action="append",
            default=[],
            type=_place,
            metavar="X,Y,Z",
            help="a place on the surface at the end of a limb; given two or more times, the skeleton keeps only what "
            "joins these ends (--end=-1,2,3 where a minus comes first)",
        )
        add_sampling(parser.add_argument_group("method"))

    @classmethod
    def from_words(cls, words: argparse.Namespace) -> Skeletons:
        settings = settings_from(words, cls.kind)
        return cls(sampling_from(words), settings, tuple(words.end))

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

    def write(self, found: Skeletonization, path: Path, frame: np.ndarray) -> tuple[str, ...]:
        branches = measure_branches(found) if holds_branches(path) else None
        export_skeleton(found.skeleton.placed(frame), found.parts, path, branches)
        return ()

    def words(self) -> dict[str, Any]:
        """Return the settings as words of the command line."""
        words = super().words()
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


def _place(text: str) -> tuple[float, ...]:
    """Return three finite numbers with commas between them."""
    try:
        numbers = tuple(float(word) for word in text.split(","))
        if len(numbers) == 3 and all(map(math.isfinite, numbers)):
            return numbers
    except ValueError:
        pass
    raise argparse.ArgumentTypeError(f"Expected X,Y,Z, three finite numbers, found '{text}'")


RECORD = Skeletons
