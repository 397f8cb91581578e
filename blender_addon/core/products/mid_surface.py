# SPDX-License-Identifier: GPL-3.0-or-later
"""The record of middle surfaces."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..machine.memory_limit import MemoryLimit
from ..machine.progress import Progress
from ..mid_surface.mid_surface import MidSurface, mid_surface
from ..mid_surface.write_mid_surface import MID_SURFACE_FORMATS, export_mid_surface, thick_path
from ..settings import MidSurfaceSettings
from ..shape.shape import Shape
from .product import Product


@dataclass(frozen=True)
class MiddleSurface(Product):
    wanted: MidSurfaceSettings

    description = "Thin solids as sheets with thickness, for shell elements and for modelling."
    heading = "sheets"
    kind = MidSurfaceSettings
    formats = MID_SURFACE_FORMATS
    usual = "inp"
    codes = ((3, "an input cannot be used, or has no thin wall"),)
    help = """\
INPUT     as of medial_axis --help.
OUTPUT    a file, or a folder; {name}, {file} and #### as there.
          .inp   shell elements S6, or S8R of quads, with their thickness, for CalculiX
          .obj   polygons, a group for each sheet
          .ply   triangles, with the thickness of each vertex and face
          .stl   triangles; a .csv beside it has the thickness of each
          With --keep-thick a file beside it ends with _thick.stl and has the faces of parts that are not thin.

examples:
  medial_axis midsurface part.stl part.inp --size 2
  medial_axis midsurface part.stl part.inp --size 2 --quads
  medial_axis midsurface parts/*.stl sheets/ --format obj
"""

    def compute(self, shape: Shape, limit: MemoryLimit, progress: Progress | None) -> MidSurface:
        return mid_surface(shape, self.settings, self.wanted, progress, limit)

    def write(self, found: MidSurface, path: Path, frame: np.ndarray) -> tuple[str, ...]:
        export_mid_surface(found, path, frame)
        return ()

    def beside(self, output: Path) -> tuple[Path, ...]:
        """Return the table of an .stl file, and the faces that no sheet stands for."""
        table = (output.with_suffix(".csv"),) if output.suffix.lower() == ".stl" else ()
        return (*table, thick_path(output)) if self.wanted.keep_thick else table

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


RECORD = MiddleSurface
