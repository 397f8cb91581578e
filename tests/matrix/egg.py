# SPDX-License-Identifier: GPL-3.0-or-later
"""The mesh that every Blender and the command line without one get: what they make of it must be the same bytes."""

import hashlib
import itertools

import numpy as np


def egg(steps=12):
    """Vertices and triangles of a closed surface: an octahedron's grid pushed outwards, by +, *, / and
    sqrt alone, which round alike everywhere, and a little uneven."""
    number, vertices, triangles = {}, [], []

    def vertex(*place):
        if place not in number:
            number[place] = len(vertices)
            unevenness = ((len(vertices) * 7919) % 1009 - 504) / 504000
            x, y, z = place
            size = (x * x + y * y + z * z) ** 0.5 * (1 + unevenness)
            vertices.append((x / size, 0.7 * y / size, 0.4 * z / size))
        return number[place]

    grid = [(a, b) for a in range(steps) for b in range(steps - a)]
    cells = [((a, b), (a + 1, b), (a, b + 1)) for a, b in grid]
    cells += [((a + 1, b), (a + 1, b + 1), (a, b + 1)) for a, b in grid if a + b < steps - 1]
    for sx, sy, sz in itertools.product((1, -1), repeat=3):
        for cell in cells:
            corners = [vertex(sx * a, sy * b, sz * (steps - a - b)) for a, b in cell]
            triangles.append(corners[:: sx * sy * sz])  # outward after a mirror, too
    return vertices, triangles


def write_egg(path):
    """Writes the egg as an OFF file with the coordinates of Blender's mesh."""
    vertices, triangles = egg()
    rows = np.array(vertices, np.float32).tolist()
    lines = ["OFF", f"{len(vertices)} {len(triangles)} 0", *(" ".join(map(repr, r)) for r in rows)]
    lines += [f"3 {a} {b} {c}" for a, b, c in triangles]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def command_line(main, folder):
    """SHA-256 of the .ma file that the command line makes of it; `main` is that of medial_axis.cli."""
    write_egg(folder / "egg.off")
    files = [str(folder / name) for name in ("egg.off", "egg.ma")]
    assert main([*files, "--side", "inner", "--quiet"]) == 0
    return digest(folder / "egg.ma")


def digest(path):
    content = path.read_bytes()
    assert len(content) > 10_000
    return hashlib.sha256(content).hexdigest()
