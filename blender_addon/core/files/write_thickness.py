# SPDX-License-Identifier: GPL-3.0-or-later
"""This module writes thickness as `.csv`, `.json` and `.ply` files (docs/formats.md).

A file appears whole or not at all. Numbers in text have 17 significant digits; a missing length is infinite in .csv
and .ply, and null in .json.
"""

from __future__ import annotations

import json
import math
import os
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np

from ..axis.colours import colours
from ..solid.measurement import Measurement
from ..solid.thickness_colours import colour_limits, coloured
from ..solid.thin_parts import ThinParts
from .extensions import extension_of
from .whole_file import write_whole

if TYPE_CHECKING:
    from numpy.typing import NDArray

_CHUNK = 1 << 16  # so many rows are formatted at once


def export_thickness(
    found: Measurement, parts: ThinParts, path: str | os.PathLike, unit: str = ""
) -> Path:
    """Write a measurement in world coordinates; the extension of `path` chooses the format.

    Parameters
    ----------
    found : Measurement
    parts : ThinParts
        The thin parts of the measurement.
    path : path of the file; its folder must exist. A file of that name is replaced.
    unit : str
        The unit of lengths, which .json states; "" if it is unknown.

    Returns
    -------
    path : Path
        The file that was written, with links resolved.

    Raises
    ------
    ExportError
        The extension is unknown, or the system refused to write; an old file is then unchanged.
    """
    write = THICKNESS_FORMATS[extension_of(path, THICKNESS_FORMATS)]
    return write_whole(path, lambda stream: write(found, parts, unit, stream))


def summary_of(found: Measurement, parts: ThinParts, unit: str = "") -> dict[str, Any]:
    """Return the content of `.json`: lengths are in `unit`, areas in its square; None means that there is no length."""
    place = _mover(found)
    return {
        "minimum": _number(found.minimum),
        "limit": parts.limit,
        "unit": unit or None,
        "area_below": parts.area,
        "share_below": parts.share,
        "share_unmeasured": found.unmeasured,
        "between": found.settings.between.name.lower(),
        "patches": [
            {
                "place": place(np.array([patch.place]))[0].tolist(),
                "area": patch.area,
                "minimum": _number(patch.minimum),
                "lowest": _number(patch.lowest),
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


def _number(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _mover(found: Measurement) -> Callable[[NDArray[np.float64]], NDArray[np.float64]]:
    """Return the function that moves points of the shape to their places in the world."""
    frame = found.shape.frame
    if np.array_equal(frame, np.identity(4)):
        return lambda points: points
    return lambda points: points @ frame[:3, :3].T + frame[:3, 3]


def _write_csv(found: Measurement, _parts: ThinParts, _unit: str, stream: BinaryIO) -> None:
    stream.write(b"vertex,x,y,z,thickness\n")
    points, lengths = _mover(found)(found.shape.points), found.of_vertices
    for start in range(0, len(points), _CHUNK):
        end = min(start + _CHUNK, len(points))
        rows = np.column_stack([points[start:end], lengths[start:end]]).tolist()
        text = "".join(
            f"{start + i},{x:.17g},{y:.17g},{z:.17g},{length:.17g}\n"
            for i, (x, y, z, length) in enumerate(rows)
        )
        stream.write(text.encode("ascii"))


def _write_json(found: Measurement, parts: ThinParts, unit: str, stream: BinaryIO) -> None:
    text = json.dumps(summary_of(found, parts, unit), indent=1, ensure_ascii=False) + "\n"
    stream.write(text.encode("utf-8"))


def _write_ply(found: Measurement, parts: ThinParts, _unit: str, stream: BinaryIO) -> None:
    """Write the measured surface: its samples and triangles, with lengths, colours and patches."""
    header = f"""ply
format binary_little_endian 1.0
comment thickness: length at each vertex, inf where there is none; patch of each face, -1 where it is not thin
element vertex {len(found.points)}
property double x
property double y
property double z
property double thickness
property uchar red
property uchar green
property uchar blue
element face {len(found.triangles)}
property list uchar int vertex_indices
property int patch
end_header
"""
    stream.write(header.encode("ascii"))
    vertices = np.empty(
        len(found.points), [("place", "<f8", 3), ("thickness", "<f8"), ("colour", "u1", 3)]
    )
    vertices["place"], vertices["thickness"] = _mover(found)(found.points), found.lengths
    vertices["colour"] = _bytes_of(coloured(found.lengths), *colour_limits(found, parts.limit))
    stream.write(vertices.tobytes())
    faces = np.empty(len(found.triangles), [("n", "u1"), ("corners", "<i4", 3), ("patch", "<i4")])
    faces["n"], faces["corners"], faces["patch"] = 3, found.triangles, parts.patch_of_triangles
    stream.write(faces.tobytes())


def _bytes_of(values: NDArray[np.float64], start: float, end: float) -> NDArray[np.uint8]:
    """Return the colours of values on the scale, (n, 3), as sRGB bytes."""
    linear = colours(values, start, end)[:, :3].astype(np.float64)
    encoded = np.where(
        linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 0.0) ** (1 / 2.4) - 0.055
    )
    return np.round(255.0 * encoded).astype(np.uint8)


THICKNESS_FORMATS: dict[str, Callable[[Measurement, ThinParts, str, BinaryIO], None]] = {
    ".csv": _write_csv,
    ".json": _write_json,
    ".ply": _write_ply,
}
