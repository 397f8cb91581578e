# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed triangle meshes of the shapes with exactly known axes: 2,000 to 6,000 triangles, a box 12.

Every vertex lies on the shape; between the vertices the mesh is flat, as an artist's is.
"""

import numpy as np
from numpy.typing import NDArray

from .meshes import Mesh, box, flip, icosphere, join, lathe, lattice, rectangle, torus, weld
from .shapes import MORE_SHAPES, SHAPES, Capsule, Ellipsoid, Lathe, Shape, Shell, Slab

Array = NDArray[np.float64]


def of_ellipsoid(shape: Ellipsoid, subdivisions: int = 4) -> Mesh:
    vertices, triangles = icosphere(subdivisions)
    return vertices * shape.semi_axes, triangles


def of_shell(shape: Shell, subdivisions: int = 3) -> Mesh:
    vertices, triangles = of_ellipsoid(shape.middle, subdivisions)
    offset = shape.middle.normals(vertices) * shape.wall / 2
    return join((vertices + offset, triangles), flip((vertices - offset, triangles)))


def of_lathe(shape: Lathe, spacing: float = 0.12, around: int = 96) -> Mesh:
    """Rings about `spacing` apart; nothing but the n-gon round the axis is approximated."""
    profile = [shape.edges[0, :1]]
    for start, end in shape.edges:
        steps = int(np.ceil(np.linalg.norm(end - start) / spacing))
        profile.append(np.linspace(start, end, steps + 1)[1:])
    return lathe(np.concatenate(profile), around)


def of_capsule(shape: Capsule, steps: int = 12, rings: int = 16, around: int = 64) -> Mesh:
    polar = np.linspace(0.0, np.pi / 2, steps + 1)
    cap = shape.radius * np.column_stack((np.sin(polar), -np.cos(polar)))
    side = np.column_stack(
        (np.full(rings - 1, shape.radius), np.linspace(-1, 1, rings + 1)[1:-1] * shape.length)
    )
    low, high = cap - (0.0, shape.length), cap[::-1] * (1, -1) + (0.0, shape.length)
    vertices, triangles = lathe(np.concatenate((low, side, high)), around)
    return np.roll(vertices, 1, axis=1), triangles  # from the z axis to the x axis


def of_slab(shape: Slab, turn: int = 8, along: int = 14, across: int = 10) -> Mesh:
    """Rings of rounded rectangles from the top face to the bottom face, and those two."""
    core, direction = _rounded_rectangle(shape, turn, along, across)
    polar = np.linspace(0.0, np.pi, 2 * turn + 1)
    rings = core + shape.radius * np.sin(polar)[:, None, None] * direction
    rings = np.concatenate((rings, np.zeros((*rings.shape[:2], 1))), axis=2)
    rings[:, :, 2] = shape.radius * np.cos(polar)[:, None]
    face, cells = rectangle(along, across)
    top = np.column_stack((face * (shape.width, shape.depth), np.full(len(face), shape.radius)))
    return weld(join(_tube(rings), (top, cells), flip((top * (1, 1, -1), cells))))


def _rounded_rectangle(shape: Slab, turn: int, along: int, across: int) -> tuple[Array, Array]:
    """(k, 2) points of the rectangle's border and outward directions, counter-clockwise."""
    corners = np.array([(1, 1), (-1, 1), (-1, -1), (1, -1)]) * (shape.width, shape.depth)
    core, direction = [], []
    for quarter, corner in enumerate(corners):
        angle = (quarter + np.linspace(0.0, 1.0, turn + 1)) * np.pi / 2
        steps = along if quarter % 2 == 0 else across
        t = (np.arange(1, steps) / steps)[:, None]
        core += [np.repeat(corner[None], turn + 1, axis=0)]
        core += [corner + t * (corners[(quarter + 1) % 4] - corner)]
        arc = np.column_stack((np.cos(angle), np.sin(angle)))
        direction += [arc, np.repeat(arc[-1:], steps - 1, axis=0)]
    return np.concatenate(core), np.concatenate(direction)


def _tube(rings: Array) -> Mesh:
    """Quads between (k, m, 3) closed rings, each counter-clockwise from above and each below the one before."""
    ids = np.arange(rings[..., 0].size).reshape(rings.shape[:2])
    return rings.reshape(-1, 3), lattice(np.pad(ids, ((0, 0), (0, 1)), "wrap"))


MESHED: dict[str, tuple[Shape, Mesh]] = {
    "ellipsoid": (SHAPES["ellipsoid"], of_ellipsoid(SHAPES["ellipsoid"])),
    "oblate": (SHAPES["oblate"], of_ellipsoid(SHAPES["oblate"])),
    "prolate": (MORE_SHAPES["prolate"], of_ellipsoid(MORE_SHAPES["prolate"])),
    "slab": (SHAPES["slab"], of_slab(SHAPES["slab"])),
    "shell": (SHAPES["shell"], of_shell(SHAPES["shell"])),
    "spherical shell": (MORE_SHAPES["spherical shell"], of_shell(MORE_SHAPES["spherical shell"])),
    "torus": (SHAPES["torus"], torus(1.0, 0.4, 72, 32)),
    "capsule": (SHAPES["capsule"], of_capsule(SHAPES["capsule"])),
    "box": (SHAPES["box"], box((1, 1, 1))),
    "cylinder": (MORE_SHAPES["cylinder"], of_lathe(MORE_SHAPES["cylinder"])),
    "flat cylinder": (MORE_SHAPES["flat cylinder"], of_lathe(MORE_SHAPES["flat cylinder"])),
    "frustum": (MORE_SHAPES["frustum"], of_lathe(MORE_SHAPES["frustum"])),
    "flat frustum": (MORE_SHAPES["flat frustum"], of_lathe(MORE_SHAPES["flat frustum"])),
    "cone": (MORE_SHAPES["cone"], of_lathe(MORE_SHAPES["cone"])),
}
SHARP = ("box", "cylinder", "flat cylinder", "frustum", "flat frustum", "cone")
"""Those with sharp edges."""
