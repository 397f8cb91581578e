# SPDX-License-Identifier: GPL-3.0-or-later
"""This module writes lines with arrays as VTK's PolyData in XML, `.vtp`.

Numbers are in base64, not in words: VTK's reader of words does not know nan.
"""

from __future__ import annotations

import base64
from collections.abc import Mapping
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints

_TYPES = {"<f8": "Float64", "<i4": "Int32"}


def write_vtp(
    stream: BinaryIO,
    points: Floats,
    singles: Ints,
    lines: list[Ints],
    of_points: Mapping[str, NDArray[Any]],
    of_cells: Mapping[str, NDArray[Any]],
) -> None:
    """Write single points and lines, rows of the (p, 3) points; each is a cell, the (s,) single points first.

    Arrays of points are (p,), those of cells (s + lines,), by their names.
    """
    piece = f'<Piece NumberOfPoints="{len(points)}" NumberOfVerts="{len(singles)}" '
    piece += f'NumberOfLines="{len(lines)}" NumberOfStrips="0" NumberOfPolys="0">'
    rows = [
        '<?xml version="1.0"?>',
        '<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">',
        "<PolyData>",
        piece,
        *_element("PointData", of_points),
        *_element("CellData", of_cells),
        *_element("Points", {"Points": points}),
        *_cells("Verts", [singles[i : i + 1] for i in range(len(singles))]),
        *_cells("Lines", lines),
        "</Piece>",
        "</PolyData>",
        "</VTKFile>",
    ]
    stream.write(("\n".join(rows) + "\n").encode("ascii"))


def _cells(name: str, cells: list[Ints]) -> list[str]:
    rows = np.concatenate([*cells, np.zeros(0, np.int32)])
    offsets = np.cumsum([len(cell) for cell in cells], dtype=np.int64)
    return _element(name, {"connectivity": rows, "offsets": offsets})


def _element(name: str, arrays: Mapping[str, NDArray[Any]]) -> list[str]:
    found = [f"<{name}>"]
    for label, array in arrays.items():
        values = array.astype("<f8" if array.dtype.kind == "f" else "<i4")
        size = "" if values.ndim == 1 else f' NumberOfComponents="{values.shape[1]}"'
        data = np.uint64(values.nbytes).astype("<u8").tobytes() + values.tobytes()
        found += [
            f'<DataArray type="{_TYPES[values.dtype.str]}" Name="{label}"{size} format="binary">',
            base64.b64encode(data).decode("ascii"),
            "</DataArray>",
        ]
    return [*found, f"</{name}>"]
