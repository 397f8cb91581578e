# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of coloured triangles without a graphics card, for pages that are written where there is none."""

from __future__ import annotations

import struct
import sys
import zlib
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints, Longs
from ..shape.triangles import cross
from ..small_matrices import length_of, times

_FINE = 2  # pixels are computed that much finer in both directions, and averaged
_STEP = 0.7  # between drawn points of a triangle, in fine pixels; work: shown
_CHUNK = 1 << 21  # points that are drawn at once
_AMBIENT = 0.35  # work: shown
_WHITE = 255


def picture_of(
    points: Floats,
    triangles: Ints,
    colours: Floats,
    direction: Floats,
    width: int,
    height: int,
    focus: tuple[Floats, float] | None = None,
) -> NDArray[np.uint8]:
    """Draw triangles on white, in parallel projection.

    Parameters
    ----------
    points : (n, 3) float64
    triangles : (f, 3) int32
    colours : (n, 3) float64
        Linear RGB.
    direction : (3,) float64
        From the shape to the eye; Z is up.
    width, height : int
    focus : ((3,) float64, float), optional
        What is in the middle, and how far from it the nearer border is; by default all points are seen.

    Returns
    -------
    pixels : (height, width, 3) uint8
        sRGB, the upper row first.
    """
    axes = _axes(direction)
    flat, size = times(points, axes), np.array([width, height]) * _FINE
    middle, scale = _view(flat, size, None if focus is None else (times(focus[0], axes), focus[1]))
    flat = (flat - middle) * (scale, -scale, scale) + (size[0] / 2, size[1] / 2, 0.0)
    image = np.ones((size[1] * size[0], 3))
    depth = np.full(size[1] * size[0], -np.inf)
    for corners, rgb, weights in _chunks(flat, triangles, colours):
        _draw(corners, rgb, weights, size, image, depth)
    fine = image.reshape(height, _FINE, width, _FINE, 3).mean(axis=(1, 3))
    return np.round(_WHITE * encoded(fine)).astype(np.uint8)


def png(pixels: NDArray[np.uint8]) -> bytes:
    """Return a PNG file of (height, width, 3) sRGB pixels."""
    height, width, _ = pixels.shape
    rows = np.zeros(
        (height, 1 + 3 * width), np.uint8
    )  # a byte before each row says that it is not filtered
    rows[:, 1:] = pixels.reshape(height, -1)
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    parts = ((b"IHDR", header), (b"IDAT", zlib.compress(rows.tobytes(), 9)), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(_part(name, data) for name, data in parts)


def encoded(linear: Floats) -> Floats:
    """Return linear colours between 0 and 1 as sRGB."""
    power = 1.055 * np.maximum(linear, 0.0) ** (1 / 2.4) - 0.055
    return np.where(linear <= 0.0031308, 12.92 * linear, power)


def _part(name: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def _axes(direction: Floats) -> Floats:
    """Return the directions to the right, (3, 3), upwards and to the eye."""
    eye = direction / length_of(direction)
    up = np.array([0.0, 1.0, 0.0]) if abs(eye[2]) > 0.999 else np.array([0.0, 0.0, 1.0])
    right = np.cross(up, eye)
    right /= length_of(right)
    return np.stack((right, np.cross(eye, right), eye))


def _view(flat: Floats, size: Longs, focus: tuple[Floats, float] | None) -> tuple[Floats, float]:
    """Return what is in the middle, and how many fine pixels a length of 1 has."""
    if focus is not None:
        return focus[0], float(size.min()) / (2 * focus[1])
    low, high = flat.min(axis=0), flat.max(axis=0)
    room = np.maximum(high - low, sys.float_info.min)[:2]
    return (low + high) / 2, float(0.94 * (size / room).min())


def _chunks(
    flat: Floats, triangles: Ints, colours: Floats
) -> Iterator[tuple[Floats, Floats, Floats]]:
    """Yield (m, 3, 3) corners, (m, 3, 3) shaded colours and (k, 3) weights of the points that are drawn of each."""
    corners = flat[triangles]
    normal = cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.maximum(np.linalg.norm(normal, axis=1), sys.float_info.min)
    shade = _AMBIENT + (1.0 - _AMBIENT) * np.abs(normal[:, 2]) / length
    edges = np.linalg.norm(corners[:, :, :2] - np.roll(corners[:, :, :2], 1, axis=1), axis=2)
    level = np.ceil(np.log2(np.maximum(edges.max(axis=1) / _STEP, 1.0))).astype(int)
    for each in np.unique(level):
        weights = _weights(1 << each)
        rows = np.flatnonzero(level == each)
        for part in np.array_split(rows, -(-len(rows) * len(weights) // _CHUNK)):
            yield corners[part], colours[triangles[part]] * shade[part, None, None], weights


def _weights(count: int) -> Floats:
    """Return barycentric coordinates of a grid with `count` steps along each edge, (k, 3)."""
    i, j = np.mgrid[: count + 1, : count + 1]
    inside = i + j <= count
    i, j = i[inside], j[inside]
    return np.column_stack((i, j, count - i - j)) / count


def _draw(
    corners: Floats, colours: Floats, weights: Floats, size: Longs, image: Floats, depth: Floats
) -> None:
    """Draw points into an image; of those in one pixel the nearest stays."""
    places = np.einsum("kc,mcx->mkx", weights, corners).reshape(-1, 3)
    column, row = np.floor(places[:, 0]).astype(int), np.floor(places[:, 1]).astype(int)
    seen = (column >= 0) & (column < size[0]) & (row >= 0) & (row < size[1])
    pixel, near = (row * size[0] + column)[seen], places[seen, 2]
    order = np.lexsort((near, pixel))
    last = np.append(pixel[order][1:] != pixel[order][:-1], True)[: len(order)]
    order = order[last]
    order = order[near[order] > depth[pixel[order]]]
    depth[pixel[order]] = near[order]
    which = np.flatnonzero(seen)[order]
    triangle, weight = np.divmod(which, len(weights))
    image[pixel[order]] = np.einsum("nc,ncx->nx", weights[weight], colours[triangle])
