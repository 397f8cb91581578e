# SPDX-License-Identifier: GPL-3.0-or-later
"""The contact sheet: each axis, coloured by radius, in the pale shadow of its surface; drawn point by point."""

from __future__ import annotations

import subprocess
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lab.race import product

PIXELS = (240, 200)
COLUMNS = 8
FONTS = ("/usr/share/fonts", "/usr/share/blender")
POINTS = 120_000  # drawn of the surface, and of the axis
SURFACE, WHITE = (0.86, 0.88, 0.9), 1.0
# Rows: to the right, up, and towards the eye, of an isometric view.
VIEW = np.array(
    [
        [np.sqrt(1 / 2), np.sqrt(1 / 2), 0.0],
        [-np.sqrt(1 / 6), np.sqrt(1 / 6), np.sqrt(2 / 3)],
        [np.sqrt(1 / 3), -np.sqrt(1 / 3), np.sqrt(1 / 3)],
    ]
)
Floats = NDArray[np.float64]


def draw(mesh: Path, axis: Path, picture: Path) -> None:
    """Draw a mesh and its axis, a .npz, as a picture."""
    product.load()  # it makes `medial_axis` importable
    from medial_axis import library
    from medial_axis.core.axis.colours import colours, radius_range

    shape, found = library.read(mesh), library.read_axis(axis)
    corners = shape.points[shape.triangles]
    pieces, rows = _pieces(found)
    image = np.full((PIXELS[1], PIXELS[0], 3), WHITE)
    middle, scale = _fit(shape.points)
    surface, places, radii = shape.points, found.vertices, found.radius
    if len(corners):
        surface, _ = _spread(corners, np.zeros(corners.shape[:2]))
    if len(pieces):
        places, radii = _spread(pieces, found.radius[rows])
    _splat(image, (surface - middle) * scale, np.tile(SURFACE, (len(surface), 1)))
    shades = colours(radii, *radius_range(found.radius))[:, :3].astype(float)
    _splat(image, (places - middle) * scale, shades ** (1 / 2.2))
    header = f"P6 {PIXELS[0]} {PIXELS[1]} 255\n".encode()
    picture.write_bytes(header + (255 * image).round().astype(np.uint8).tobytes())


def _pieces(axis) -> tuple[Floats, NDArray]:
    """Corners of triangles of the facets, and of edges as triangles without area; and their rows."""
    starts, sizes = axis.face_offsets[:-1], np.diff(axis.face_offsets)
    first = np.repeat(starts, sizes - 2)
    inner = np.arange(len(first)) - np.repeat(np.cumsum(sizes - 2) - (sizes - 2), sizes - 2)
    fans = axis.face_vertices[np.column_stack((first, first + inner + 1, first + inner + 2))]
    lines = np.asarray(axis.edges).reshape(-1, 2)[:, [0, 1, 1]]
    rows = np.concatenate((fans.reshape(-1, 3), lines))
    return axis.vertices[rows], rows


def _spread(corners: Floats, values: Floats) -> tuple[Floats, Floats]:
    """Points spread evenly over triangles, as many on a line as on a narrow triangle, with a value each."""
    sides = [corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]]
    area = np.linalg.norm(np.cross(*sides), axis=1)
    length = max(float(np.ptp(corners.reshape(-1, 3), axis=0).max()), np.finfo(float).tiny)
    weight = area / length**2 + np.linalg.norm(sides[1], axis=1) / length / max(PIXELS)
    random = np.random.default_rng(0)
    which = random.choice(len(corners), POINTS, p=weight / weight.sum())
    u, v = np.sqrt(random.random(POINTS)), random.random(POINTS)
    parts = np.column_stack((1 - u, u * (1 - v), u * v))
    points = np.einsum("ij,ijk->ik", parts, corners[which])
    return points, np.einsum("ij,ij->i", parts, values[which])


def _fit(points: Floats) -> tuple[Floats, float]:
    """The middle of points, and the factor by which they fill the picture."""
    across = (points @ VIEW.T)[:, :2]
    low, high = across.min(axis=0), across.max(axis=0)
    scale = 0.92 * min(np.array(PIXELS) / np.maximum(high - low, np.finfo(float).tiny))
    return VIEW[:2].T @ ((low + high) / 2), float(scale)


def _splat(image: Floats, points: Floats, shades: Floats) -> None:
    """Paint points over the image, the nearest one last; darker where it is farther."""
    x, y, near = (points @ VIEW.T).T
    order = np.argsort(near)
    column = np.clip(PIXELS[0] / 2 + x[order], 0, PIXELS[0] - 1).astype(int)
    line = np.clip(PIXELS[1] / 2 - y[order], 0, PIXELS[1] - 1).astype(int)
    depth = (near - near.min()) / max(float(np.ptp(near)), np.finfo(float).tiny)
    image[line, column] = (shades * (0.7 + 0.3 * depth[:, None]))[order]


def sheet(pictures: Sequence[tuple[str, Path]], path: Path) -> None:
    """Put pictures side by side by ImageMagick, each with its name below it where there is a font."""
    fonts = sorted(p for folder in FONTS for p in Path(folder).rglob("DejaVuSans.*"))
    font = ["-font", str(fonts[0]), "-pointsize", "11"] if fonts else []
    words = []
    for name, picture in pictures:
        words += ["-label", name, str(picture)] if font else [str(picture)]
    size = ["-tile", f"{COLUMNS}x", "-geometry", "+4+4"]
    subprocess.run(["montage", *font, *words, *size, str(path)], check=True)
