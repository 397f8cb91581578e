# SPDX-License-Identifier: GPL-3.0-or-later
"""This module writes thickness as `.csv`, `.html`, `.json` and `.ply` files (docs/formats.md).

A file appears whole or not at all. Numbers in text have 17 significant digits; a missing length is infinite in .csv
and .ply, and null in .json.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from ..arrays import Flags, Floats
from ..axis.colours import colours
from ..files.writing import extension_of, known, ply_places, write_ply, write_rows, write_whole
from ..shape.nearness import same_place
from ..small_matrices import placed
from .measurement import Measurement
from .picture import encoded
from .thickness_colours import scale_of
from .thickness_page import page_of
from .thin_parts import ThinParts


def export_thickness(
    found: Measurement, parts: ThinParts, path: str | os.PathLike, unit: str = "", title: str = ""
) -> Path:
    """Write a measurement in world coordinates, and return the path of the file; its extension chooses the format.

    Parameters
    ----------
    found : Measurement
    parts : ThinParts
        The thin parts of the measurement.
    path : path of the file; its folder must exist. A file of that name is replaced.
    unit : str
        The unit of lengths, which .json and .html state; "" if it is unknown.
    title : str
        The name of what was measured, for .html; by default that of the file.

    Raises
    ------
    ExportError
        The extension is unknown, or the system refused to write; an old file is then unchanged.
    """
    write = THICKNESS_FORMATS[extension_of(path, THICKNESS_FORMATS)]
    labels = _Labels(unit, title or Path(path).stem)
    return write_whole(path, lambda stream: write(found, parts, labels, stream))


@dataclass(frozen=True)
class _Labels:
    unit: str
    title: str


def summary_of(found: Measurement, parts: ThinParts, unit: str = "") -> dict[str, Any]:
    """Return the content of `.json`: lengths are in `unit`, areas in its square; None means that there is no length."""
    place = _mover(found)
    return {
        "minimum": known(parts.minimum),
        "minimum_parallel": known(found.between_parallel),
        "limit": parts.limit,
        "unit": unit or None,
        "area_below": parts.area,
        "share_below": parts.share,
        "share_of": "surface",
        "share_unmeasured": found.unmeasured,
        "between": found.settings.between.name.lower(),
        "patches": [
            {
                "place": place(np.array([patch.place]))[0].tolist(),
                "area": patch.area,
                "minimum": known(patch.minimum),
                "lowest": known(patch.lowest),
            }
            for patch in parts.patches
        ],
        "samples": found.samples,
        "sampled": found.chosen.reason,
        "inside": str(found.chosen.sides),
        "normals": found.normals,
        "noise": found.noise,
        "warnings": [str(warning) for warning in found.warnings],
    }


def _mover(found: Measurement) -> Callable[[Floats], Floats]:
    """Return the function that moves points of the shape to their places in the world."""
    frame = found.shape.frame
    if np.array_equal(frame, np.identity(4)):
        return lambda points: points
    return lambda points: placed(points, frame)


def _write_csv(found: Measurement, _parts: ThinParts, _labels: _Labels, stream: BinaryIO) -> None:
    stream.write(b"vertex,x,y,z,thickness,filled\n")
    beside = _beside_vertices(found)
    points = _mover(found)(np.concatenate((found.shape.points, found.points[beside])))
    lengths = np.concatenate((found.of_vertices, found.lengths[beside]))
    filled = np.append(found.are_filled[found.row_of_vertices], found.are_filled[beside])
    vertices = np.arange(len(points))
    vertices[len(found.shape.points) :] = -1
    write_rows(stream, "%d,%.17g,%.17g,%.17g,%.17g,%.0f\n", vertices, points, lengths, filled)


def _beside_vertices(found: Measurement) -> Flags:
    """Return whether each point of the measured surface is no vertex of the shape, (n,)."""
    count = len(found.shape.points)
    place = same_place(np.concatenate((found.shape.points, found.points)))
    return ~np.isin(place[count:], place[:count])


def _write_json(found: Measurement, parts: ThinParts, labels: _Labels, stream: BinaryIO) -> None:
    text = json.dumps(summary_of(found, parts, labels.unit), indent=1, ensure_ascii=False) + "\n"
    stream.write(text.encode("utf-8"))


def _write_ply(found: Measurement, parts: ThinParts, _labels: _Labels, stream: BinaryIO) -> None:
    """Write the measured surface: its samples and triangles, with lengths, colours and patches."""
    positions = scale_of(found, parts.limit).positions(found.lengths)
    linear = colours(positions, 0.0, 1.0)[:, :3].astype(np.float64)
    rgb = np.round(255.0 * encoded(linear)).astype(np.uint8).T
    vertices = {
        **ply_places(_mover(found)(found.points)),
        "thickness": ("<f8", found.lengths),
        **{name: ("u1", one) for name, one in zip(("red", "green", "blue"), rgb, strict=True)},
    }
    of_faces = {"patch": ("<i4", parts.patch_of_triangles)}
    comment = (
        "comment thickness: length at each vertex, inf where there is none; patch of each face, -1 where it is not "
        "thin\n"
    )
    write_ply(stream, vertices, found.triangles, of_faces, comment)


def _write_html(found: Measurement, parts: ThinParts, labels: _Labels, stream: BinaryIO) -> None:
    points = _mover(found)(found.points)
    stream.write(page_of(found, parts, labels.title, labels.unit, points).encode("utf-8"))


THICKNESS_FORMATS: dict[str, Callable[[Measurement, ThinParts, _Labels, BinaryIO], None]] = {
    ".csv": _write_csv,
    ".html": _write_html,
    ".json": _write_json,
    ".ply": _write_ply,
}
