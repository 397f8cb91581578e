# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads what programs call a medial axis: `.ma`, `.ply`, `.obj`, `.off`, of our own and of anybody else.

What is no polygon, edge or point is passed over. Nothing of the add-on is used.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


class UnreadableError(ValueError):
    """A file that is not what its extension says."""


@dataclass(frozen=True)
class Complex:
    """Polygons, edges that no polygon has, and points that neither has.

    Parameters
    ----------
    vertices : (v, 3) float64
        No two are equal.
    offsets : (f + 1,) int64
        Polygon i has the corners `corners[offsets[i] : offsets[i + 1]]`; no two have the same corners.
    corners : (c,) int64
    edges : (e, 2) int64
        Lower end first.
    points : (k,) int64
    """

    vertices: Array
    offsets: Ints
    corners: Ints
    edges: Ints
    points: Ints

    @property
    def faces(self) -> int:
        return len(self.offsets) - 1

    @property
    def corner_edges(self) -> Ints:
        """(c, 2) from each corner to the next of its polygon, lower end first."""
        following = np.roll(self.corners, -1)
        following[self.offsets[1:] - 1] = self.corners[self.offsets[:-1]]
        return np.sort(np.column_stack((self.corners, following)), axis=1)


def read(path: Path) -> Complex:
    if path.suffix not in READERS:
        raise UnreadableError(f"Expected .ma, .ply, .obj or .off, found {path.name}")
    try:
        return complex_of(*READERS[path.suffix](path))
    except (ValueError, IndexError, StopIteration) as error:
        raise UnreadableError(f"Expected an axis in {path.name}, found {error}") from error


def complex_of(vertices: Array, polygons: Iterable[Ints], edges: Ints) -> Complex:
    """Equal vertices are one; polygons of fewer than three corners become edges or points; what another polygon or
    edge has is left out. Vertices that nothing uses are points."""
    vertices = np.asarray(vertices, float).reshape(-1, 3)
    if not len(vertices) or not np.isfinite(vertices).all():
        raise UnreadableError("no vertices, or some that are not finite")
    distinct, place = np.unique(vertices, axis=0, return_inverse=True)
    place = place.reshape(-1)
    found: dict[tuple[int, ...], list[int]] = {}
    pairs = [place[np.asarray(edges, np.int64).reshape(-1, 2)]]
    for polygon in polygons:
        row = place[np.asarray(polygon, np.int64)].tolist()
        row = [v for i, v in enumerate(row) if v != row[i - 1] or len(row) == 1]
        key = tuple(sorted(set(row)))
        if len(key) >= 3:
            found.setdefault(key, row)
        elif len(key) == 2:
            pairs.append(np.array([key]))
    rows = list(found.values())
    offsets = np.cumsum([0, *map(len, rows)])
    corners = np.array([v for row in rows for v in row], np.int64)
    whole = Complex(distinct, offsets, corners, np.empty((0, 2), np.int64), np.empty(0, np.int64))
    return _completed(whole, np.concatenate(pairs))


def _completed(whole: Complex, pairs: Ints) -> Complex:
    pairs = np.unique(np.sort(pairs, axis=1), axis=0)
    pairs = pairs[pairs[:, 0] != pairs[:, 1]]
    width = len(whole.vertices)
    taken = whole.corner_edges @ [width, 1] if whole.faces else np.empty(0, np.int64)
    loose = pairs[~np.isin(pairs @ [width, 1], taken)]
    alone = np.ones(width, bool)
    alone[whole.corners] = False
    alone[loose] = False
    return Complex(whole.vertices, whole.offsets, whole.corners, loose, np.flatnonzero(alone))


# --- text


def _off(path: Path) -> tuple[Array, list[Ints], Ints]:
    lines = (line.split("#")[0].split() for line in path.read_text().splitlines())
    rows = iter([line for line in lines if line])
    first = next(rows)
    if not first[0].endswith("OFF"):
        raise ValueError("no line OFF")
    counts = first[1:] or next(rows)
    vertices = np.array([next(rows)[:3] for _ in range(int(counts[0]))], float)
    faces = [next(rows) for _ in range(int(counts[1]))]
    return vertices, [np.array(row[1 : 1 + int(row[0])], np.int64) for row in faces], _NO_EDGES


def _obj(path: Path) -> tuple[Array, list[Ints], Ints]:
    vertices: list[list[float]] = []
    polygons: list[Ints] = []
    edges: list[tuple[int, int]] = []
    for line in path.read_text().splitlines():
        word, *values = line.split() or [""]
        if word == "v":
            vertices.append([float(x) for x in values[:3]])
        elif word in ("f", "l"):
            ids = [int(value.split("/")[0]) for value in values]
            ids = [i - 1 if i > 0 else len(vertices) + i for i in ids]
            if word == "f":
                polygons.append(np.array(ids))
            else:
                edges += pairwise(ids)
    return np.array(vertices), polygons, np.array(edges, np.int64).reshape(-1, 2)


def _ma(path: Path) -> tuple[Array, list[Ints], Ints]:
    """Centres and radii, edges, triangles; the first line counts them."""
    lines = path.read_text().splitlines()
    vertices, edges, faces = (
        [line.split()[1:] for line in lines if line.startswith(word)] for word in ("v ", "e ", "f ")
    )
    counts = [int(x) for x in lines[0].split()]
    if counts != [len(vertices), len(edges), len(faces)]:
        raise ValueError(f"{len(vertices)}, {len(edges)}, {len(faces)} rows for counts {counts}")
    pairs = np.array([row[:2] for row in edges], np.int64).reshape(-1, 2)
    triangles = np.array([row[:3] for row in faces], np.int64).reshape(-1, 3)
    return np.array([row[:3] for row in vertices], float), list(triangles), pairs


# --- .ply, in text or binary

_TYPES = {"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4"}
_TYPES |= {"float": "f4", "double": "f8", "int8": "i1", "uint8": "u1", "int16": "i2"}
_TYPES |= {"uint16": "u2", "int32": "i4", "uint32": "u4", "float32": "f4", "float64": "f8"}
_NO_EDGES = np.empty((0, 2), np.int64)


class _Values:
    """Takes the values of a .ply one after the other."""

    def __init__(self, kind: str, body: bytes) -> None:
        self._words = iter(body.split()) if kind == "ascii" else None
        self._body, self._at = body, 0
        self._order = ">" if "big" in kind else "<"

    def take(self, kind: str, count: int = 1) -> NDArray:
        dtype = np.dtype(self._order + _TYPES[kind])
        if self._words is not None:
            return np.array([float(next(self._words)) for _ in range(count)])
        found = np.frombuffer(self._body, dtype, count, self._at)
        self._at += count * dtype.itemsize
        return found

    def table(self, names: list[tuple[str, str]], count: int) -> dict[str, NDArray]:
        """An element without lists."""
        if self._words is not None:
            rows = [[float(next(self._words)) for _ in names] for _ in range(count)]
            columns = np.array(rows).reshape(count, len(names)).T
            return {name: column for (name, _), column in zip(names, columns, strict=True)}
        dtype = np.dtype([(name, self._order + _TYPES[kind]) for name, kind in names])
        found = np.frombuffer(self._body, dtype, count, self._at)
        self._at += count * dtype.itemsize
        return {name: found[name] for name, _ in names}


def _ply(path: Path) -> tuple[Array, list[Ints], Ints]:
    head, _, body = path.read_bytes().partition(b"end_header\n")
    header = [line.split() for line in head.decode("ascii", "replace").splitlines()]
    kind = next(row[1] for row in header if row and row[0] == "format")
    values = _Values(kind, body)
    vertices, polygons, edges = np.empty((0, 3)), [], _NO_EDGES
    for name, count, properties in _elements(header):
        if any(p[0] == "list" for p in properties):
            lists = [_row(values, properties) for _ in range(count)]
            polygons = lists if name == "face" else polygons
            continue
        table = values.table([(p[1], p[0]) for p in properties], count)
        if name == "vertex":
            vertices = np.column_stack([table[axis] for axis in "xyz"]).astype(float)
        elif name == "edge":
            edges = np.column_stack((table["vertex1"], table["vertex2"])).astype(np.int64)
    return vertices, polygons, edges


def _elements(header: list[list[str]]) -> list[tuple[str, int, list[list[str]]]]:
    elements: list[tuple[str, int, list[list[str]]]] = []
    for row in header:
        if row and row[0] == "element":
            elements.append((row[1], int(row[2]), []))
        elif row and row[0] == "property":
            elements[-1][2].append(row[1:])
    return elements


def _row(values: _Values, properties: list[list[str]]) -> Ints:
    """The corners of a face; its other values are passed over."""
    corners = np.empty(0, np.int64)
    for p in properties:
        if p[0] == "list":
            found = values.take(p[2], int(values.take(p[1])[0]))
            corners = found.astype(np.int64) if p[3].startswith("vert") else corners
        else:
            values.take(p[0])
    return corners


READERS = {".ma": _ma, ".obj": _obj, ".off": _off, ".ply": _ply}
