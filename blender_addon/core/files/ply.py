# SPDX-License-Identifier: GPL-3.0-or-later
"""This module reads `.ply` files: points and polygons, as text or binary (docs/formats.md)."""

from __future__ import annotations

import io
import os
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats
from ..errors import ReadError
from .imported_points import ImportedPoints, checked
from .text import Lines, Rows, open_file, skip_mark

_TYPES = {
    **dict.fromkeys(("char", "int8"), "i1"),
    **dict.fromkeys(("uchar", "uint8"), "u1"),
    **dict.fromkeys(("short", "int16"), "i2"),
    **dict.fromkeys(("ushort", "uint16"), "u2"),
    **dict.fromkeys(("int", "int32"), "i4"),
    **dict.fromkeys(("uint", "uint32"), "u4"),
    **dict.fromkeys(("float", "float32"), "f4"),
    **dict.fromkeys(("double", "float64"), "f8"),
}
_ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
_POSITION, _NORMAL = ("x", "y", "z"), ("nx", "ny", "nz")
_CORNERS = ("vertex_indices", "vertex_index")
_LONGEST = 1 << 16  # bytes of a line of the header that are read; other files may have no lines
_MOST_ROWS = 10**18  # no file holds as many, and larger counts do not fit into 64 bits


@dataclass
class _Property:
    name: str
    type: str  # it is a type of NumPy without byte order
    count: str = ""  # it is the type of the length of a list; "" means a single number


@dataclass
class _Element:
    name: str
    rows: int
    properties: list[_Property] = field(default_factory=list)

    @property
    def lists(self) -> list[_Property]:
        return [entry for entry in self.properties if entry.count]


@dataclass
class _Table:
    """A table has the rows of an element: columns of single numbers, and one list of corners for each row."""

    columns: dict[str, NDArray]
    sizes: NDArray
    corners: NDArray


def read_ply(path: str | os.PathLike) -> ImportedPoints:
    """Read positions, normals and faces; everything else is ignored."""
    name = Path(path).name
    with open_file(path) as stream:
        skip_mark(stream)
        order, elements, lines = _read_header(stream, name)
        body: _Binary | _Text = (
            _Binary(stream.read(), order, name) if order else _Text(stream, lines, name)
        )
        tables: dict[str, _Table] = {}
        for element in elements:
            if element.name == "vertex" and element.lists:
                raise ReadError(
                    f"Expected no lists among the properties of 'vertex' in '{name}', found one; "
                    "save it without"
                )
            tables[element.name] = body.read(element)
            if {"vertex", "face"} <= tables.keys():
                break
    return _found(tables, name)


def _found(tables: dict[str, _Table], name: str) -> ImportedPoints:
    vertex, face = tables.get("vertex"), tables.get("face")
    if vertex is None or not set(_POSITION) <= vertex.columns.keys():
        raise ReadError(
            f"Expected an element 'vertex' with x, y and z in '{name}', found none; "
            "choose another file"
        )
    points = _columns(vertex, _POSITION)
    normals = _columns(vertex, _NORMAL) if set(_NORMAL) <= vertex.columns.keys() else None
    sizes, corners = (None, None) if face is None else (face.sizes, face.corners)
    single = all(vertex.columns[axis].dtype.itemsize <= 4 for axis in _POSITION)
    return replace(checked(name, points, normals, sizes, corners), single=single)


def _columns(table: _Table, names: tuple[str, ...]) -> Floats:
    return np.column_stack([table.columns[name] for name in names]).astype(np.float64)


# --- header


def _read_header(stream: BinaryIO, name: str) -> tuple[str, list[_Element], int]:
    """Return the byte order ("" for text), the elements, and the number of lines of the header."""
    if stream.readline(_LONGEST).strip() != b"ply":
        raise ReadError(f"Expected 'ply' as the first line of '{name}', found none; check the file")
    order: str | None = None
    elements: list[_Element] = []
    lines = 1
    while True:
        line = stream.readline(_LONGEST)
        words = line.decode("latin-1").split()
        lines += 1
        try:
            if words[:1] == ["end_header"]:
                break
            if words and words[0] not in ("comment", "obj_info"):
                order = _take(words, order, elements)
        except (KeyError, IndexError, ValueError):
            words = []
        if not line or not words:
            raise ReadError(
                f"Expected a header of PLY in line {lines} of '{name}', found "
                f"{line[:24].decode('latin-1')!a}; take the file from its source again"
            )
    if order is None:
        raise ReadError(f"Expected a line 'format' in the header of '{name}', found none; add it")
    for element in elements:
        if element.rows and not element.properties:
            raise ReadError(
                f"Expected properties of the element '{element.name}' in the header of '{name}', found "
                "none; take the file from its source again"
            )
    return order, elements, lines


def _take(words: list[str], order: str | None, elements: list[_Element]) -> str | None:
    """Read one line of the header into `elements`; return the byte order, or None if it is not known yet."""
    if words[0] == "format":
        return _ORDERS[words[1]]
    if words[0] == "element":
        if words[1] in ("vertex", "face") and any(x.name == words[1] for x in elements):
            raise ReadError(f"Expected one element '{words[1]}' in a PLY file, found two; split it")
        elements.append(_Element(words[1], int(words[2])))
        if not 0 <= elements[-1].rows < _MOST_ROWS:
            raise ValueError
    elif words[:2] == ["property", "list"]:
        entry = _Property(words[4], _TYPES[words[3]], _TYPES[words[2]])
        if entry.count.startswith("f"):
            raise ValueError
        elements[-1].properties.append(entry)
    elif words[0] == "property":
        elements[-1].properties.append(_Property(words[2], _TYPES[words[1]]))
    else:
        raise ValueError
    return order


# --- text


class _Text:
    """Reads the elements of a text file, which has one row on each line."""

    def __init__(self, stream: BinaryIO, header: int, name: str) -> None:
        text = io.TextIOWrapper(stream, encoding="latin-1")
        lines = Lines(text, name)
        lines.number += header
        self._rows, self._next, self._name = lines.rows(finite=False), 0, name
        text.detach()

    def read(self, element: _Element) -> _Table:
        rows = self._rows.part(self._next, self._next + element.rows)
        self._next += element.rows
        if len(rows) != element.rows:
            raise _too_short(self._name, element)
        if len(rows) == 0:
            return _Table({}, np.zeros(0, np.int64), np.zeros(0))
        if not element.lists:
            table = rows.table(len(element.properties), f"{len(element.properties)} numbers")
            self._check_finite(element, rows, table)
            columns = {entry.name: table[:, i] for i, entry in enumerate(element.properties)}
            return _Table(columns, np.zeros(0, np.int64), np.zeros(0))
        return self._read_lists(element, rows)

    def _check_finite(self, element: _Element, rows: Rows, table: Floats) -> None:
        """Check the columns that are read; the others may hold anything."""
        names = [entry.name for entry in element.properties]
        used = [i for i, name in enumerate(names) if name in _POSITION + _NORMAL]
        bad = np.argwhere(~np.isfinite(table[:, used]))
        if len(bad):
            row, column = bad[0]
            raise ReadError(
                f"Expected finite numbers in {rows.place(row)}, found '{table[row, used[column]]:g}'; "
                "mend or remove that line"
            )

    def _read_lists(self, element: _Element, rows: Rows) -> _Table:
        """Return the corners of each row; numbers after them are ignored."""
        sizes, corners = rows.lists(_numbers_before_corners(element, self._name))
        bad = np.flatnonzero(corners != np.floor(corners))
        if len(bad):
            raise ReadError(
                f"Expected whole numbers as corners in '{self._name}', found "
                f"{corners[bad[0]]:.17g}; take the file from its source again"
            )
        return _Table({}, sizes, corners)


def _numbers_before_corners(element: _Element, name: str) -> int:
    if element.name != "face":
        return 0  # its lists are not used
    for before, entry in enumerate(element.properties):
        if entry.count and entry.name in _CORNERS:
            return before
        if entry.count:
            break
    raise ReadError(
        f"Expected the list {_CORNERS[0]} before other lists of the faces of '{name}', found "
        f"'{element.properties[0].name}'; save it with the corners first"
    )


def _too_short(name: str, element: _Element) -> ReadError:
    return ReadError(
        f"Expected {element.rows:,} rows of '{element.name}' in '{name}', as its header says, "
        "found the end of the file; take it from its source again"
    )


# --- binary


class _Binary:
    """Reads the elements of a binary file, one after the other."""

    def __init__(self, data: bytes, order: str, name: str) -> None:
        self._data, self._order, self._name = data, order, name
        self._at = 0

    def read(self, element: _Element) -> _Table:
        """Read an element; rows of equal length are read at once, others row by row."""
        if not element.lists:
            rows = self._take(element, self._row_type(element, ()))
            columns = {entry.name: rows[str(i)] for i, entry in enumerate(element.properties)}
            return _Table(columns, np.zeros(0, np.int64), np.zeros(0))
        place = self._place_of_corners(element)
        return self._read_even(element, place) or self._read_uneven(element, place)

    def _row_type(self, element: _Element, lengths: tuple[int, ...]) -> np.dtype:
        """Return the layout of a row whose lists have these lengths; property i is field 'i', and 'ni' is its count."""
        left = list(lengths)
        fields: list[tuple[Any, ...]] = []
        for i, entry in enumerate(element.properties):
            kind = self._order + entry.type
            if entry.count:
                fields.append((f"n{i}", self._order + entry.count))
                fields.append((f"{i}", kind, (left.pop(0),)))
            else:
                fields.append((f"{i}", kind))
        return np.dtype(fields)

    def _take(self, element: _Element, row: np.dtype) -> NDArray:
        if self._at + element.rows * row.itemsize > len(self._data):
            raise _too_short(self._name, element)
        rows = np.frombuffer(self._data, row, element.rows, self._at)
        self._at += rows.nbytes
        return rows

    def _place_of_corners(self, element: _Element) -> int:
        """Return the index of the property with the corners; elements other than faces return any list, unused."""
        for i, entry in enumerate(element.properties):
            if entry.count and (entry.name in _CORNERS or element.name != "face"):
                return i
        raise ReadError(
            f"Expected the list {_CORNERS[0]} of the faces of '{self._name}', found none; "
            "choose another file"
        )

    def _read_even(self, element: _Element, place: int) -> _Table | None:
        """Read all rows at once if their lists are as long as those of the first row, otherwise return None."""
        if element.rows == 0:
            return _Table({}, np.zeros(0, np.int64), np.zeros(0))
        lengths = tuple(len(part) for part in self._lists(element))
        row, start = self._row_type(element, lengths), self._at
        if start + element.rows * row.itemsize > len(self._data):
            return None
        rows = self._take(element, row)
        counts = [f"n{i}" for i, entry in enumerate(element.properties) if entry.count]
        if any((rows[n] != length).any() for n, length in zip(counts, lengths, strict=True)):
            self._at = start
            return None
        corners = rows[str(place)]
        return _Table({}, np.full(len(rows), corners.shape[1]), corners.ravel())

    def _read_uneven(self, element: _Element, place: int) -> _Table:
        which = [i for i, entry in enumerate(element.properties) if entry.count].index(place)
        found = []
        for _ in range(element.rows):
            found.append(self._lists(element, keep=True)[which])
        sizes = np.fromiter(map(len, found), np.int64, len(found))
        return _Table({}, sizes, np.concatenate(found))

    def _lists(self, element: _Element, keep: bool = False) -> list[NDArray]:
        """Return the lists of the next row; with `keep` the reader advances past it."""
        at, lists = self._at, []
        try:
            for entry in element.properties:
                length = 1
                if entry.count:
                    count = np.frombuffer(self._data, self._order + entry.count, 1, at)
                    length, at = int(count[0]), at + count.nbytes
                    if length < 0:
                        raise ReadError(
                            f"Expected a number of corners in each row of '{element.name}' in "
                            f"'{self._name}', found {length}; take the file from its source again"
                        )
                values = np.frombuffer(self._data, self._order + entry.type, max(length, 0), at)
                at += values.nbytes
                if entry.count:
                    lists.append(values)
        except ValueError:
            raise _too_short(self._name, element) from None
        if keep:
            self._at = at
        return lists
