# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids of sheets by our command, by Blender's Solidify modifier and by MeshLib, a Markdown table.

    python3 lab/benchmarks/solidify_table.py

The faces lie in the middle of each solid. Judged are pairs of triangles that cross, and at 20,000 random places on the
sheet, half a wall or more from its rims, twice the distance from the solid's faces, in percent of the wall. There is
room where a ball of half a wall touches the sheet from both sides. Of 1,000 places on the solid's faces some lie inside
of it: there parts of it overlap. Nine sheets are made here, the last one is of the
folder MEDIAL_AXIS_TEST_DATA. Blender's modifier is left out where Blender is not installed, and MeshLib where the
package meshlib is not.
"""

import time

import _module
import numpy as np
from numpy.typing import NDArray

medial = _module.load()

from medial_axis.core.files.read_shape import read_shape  # noqa: E402
from medial_axis.core.settings import SolidifySettings  # noqa: E402
from medial_axis.core.shape.shape import Shape  # noqa: E402
from medial_axis.core.shape.triangles import unit_normals  # noqa: E402
from medial_axis.core.solidify.sheet import rim_sides, sheet_of  # noqa: E402
from medial_axis.core.solidify.solidify import solidify  # noqa: E402

try:
    from meshlib import mrmeshnumpy, mrmeshpy
except ImportError:
    mrmeshpy = None

Floats = NDArray[np.float64]
Mesh = tuple[Floats, NDArray[np.int32]]
PLACES = 20_000
OPEN = "stanford-bunny.obj"
NAMES = {"simple": "Solidify, Simple, Even", "complex": "Solidify, Complex"}
HEADER = ["sheet", "way", "triangles", "crossing pairs", "inside, %", "even, %", "least wall, %"]
HEADER += ["least without room, %", "seconds"]
INSIDE = 1000  # places on the faces of a solid


def patch(place, steps: tuple[int, int]) -> Mesh:
    """The sheet of places (u, v), both from 0 to 1."""
    (m, n), count = steps, steps[1] + 1
    u, v = np.meshgrid(np.linspace(0, 1, m + 1), np.linspace(0, 1, count), indexing="ij")
    a = (np.arange(m)[:, None] * count + np.arange(n)).ravel()
    faces = (a, a + count, a + count + 1), (a, a + count + 1, a + 1)
    points = np.stack(np.broadcast_arrays(*place(u, v)), axis=-1).reshape(-1, 3)
    return points.astype(float), np.concatenate([np.column_stack(f) for f in faces]).astype(
        np.int32
    )


def strip(profile: Floats, width: float, steps: int) -> Mesh:
    """A sheet along a line of (x, z)."""
    last = len(profile) - 1

    def place(u, v):
        x, z = profile[np.rint(u * last).astype(int)].transpose(2, 0, 1)
        return x, width * v, z

    return patch(place, (last, steps))


def fold(degrees: float) -> Mesh:
    along, half = np.linspace(-4, 4, 81), np.radians(degrees) / 2
    return strip(np.column_stack((np.abs(along) * np.cos(half), along * np.sin(half))), 2.0, 10)


def spiral() -> Mesh:
    turn = np.linspace(np.pi, 6 * np.pi, 241)
    return strip(turn[:, None] / 24 * np.column_stack((np.cos(turn), np.sin(turn))), 1.0, 8)


def hairpin(gap: float) -> Mesh:
    turn, back = np.linspace(-np.pi / 2, np.pi / 2, 13), np.linspace(-3, -0.1, 30)
    ends = [np.column_stack((x, 0 * x + z)) for x, z in ((back, -gap / 2), (back[::-1], gap / 2))]
    bend = gap / 2 * np.column_stack((np.cos(turn), np.sin(turn)))
    return strip(np.concatenate((ends[0], bend, ends[1])), 1.5, 10)


def half_sphere(steps: int = 16) -> Mesh:
    """Half of an octahedron, raised onto the sphere."""
    i, j = np.indices((2 * steps, 2 * steps)).reshape(2, -1) - steps
    corners = [np.stack((i + x, j + y), axis=1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
    even = (2 * i + 1) * (2 * j + 1) > 0  # the diagonals run along the rim
    halves = ((0, 1, 3), (1, 2, 3)), ((0, 1, 2), (0, 2, 3))
    faces = [
        np.stack([corners[k][even == is_even] for k in half], axis=1)
        for is_even, two in zip((True, False), halves, strict=True)
        for half in two
    ]
    places = np.concatenate(faces)
    places = places[(np.abs(places).sum(axis=2) <= steps).all(axis=1)]
    flat, rows = np.unique(places.reshape(-1, 2), axis=0, return_inverse=True)
    points = np.column_stack((flat, steps - np.abs(flat).sum(axis=1))).astype(float)
    points /= np.linalg.norm(points, axis=1)[:, None]
    return points, rows.reshape(-1, 3).astype(np.int32)


def cloth() -> Mesh:
    def place(u, v):
        waves = np.sin(9 * u + 2 * v) * np.cos(7 * v) / 4 + np.sin(23 * u * v) / 10
        return 4 * u, 4 * v, waves

    return patch(place, (70, 70))


def sheet_with_hole() -> Mesh:
    points, triangles = patch(lambda u, v: (4 * u - 2, 4 * v - 2, np.sin(4 * u) / 6), (32, 32))
    away = np.linalg.norm(points[triangles].mean(axis=1)[:, :2], axis=1)
    return points, triangles[away > 0.8]


def l_shape() -> Mesh:
    side = np.linspace(0, 2, 21)
    ends = np.column_stack((0 * side, side[::-1])), np.column_stack((side[1:], 0 * side[1:]))
    return strip(np.concatenate(ends), 2.0, 20)


SHEETS = {
    "flat": (lambda: patch(lambda u, v: (4 * u, 4 * v, 0 * u), (20, 20)), 0.2),
    "saddle": (
        lambda: patch(lambda u, v: (4 * u, 4 * v, 3 * (u - u * u - v + v * v)), (40, 40)),
        0.2,
    ),
    "fold of 20 degrees": (lambda: fold(20), 0.15),
    "spiral": (spiral, 0.3),
    "strip near itself": (lambda: hairpin(0.15), 0.2),
    "half sphere": (half_sphere, 0.2),
    "wavy cloth": (cloth, 0.4),
    "L": (l_shape, 0.3),
    "sheet with a hole": (sheet_with_hole, 0.2),
    OPEN: (None, 0.01),  # of its diagonal
}


def ours(shape: Shape, wall: float) -> Mesh:
    found = solidify(shape, SolidifySettings(thickness=wall))
    return found.vertices, found.triangles


def by_blender(shape: Shape, wall: float) -> dict[str, Mesh]:
    given = {"points": shape.points, "triangles": shape.triangles, "wall": wall}
    return _module.in_blender("solids_in_blender.py", NAMES, **given)


def by_meshlib(shape: Shape, wall: float) -> dict[str, Mesh]:
    """Its offset to both sides: what its `thickenMesh` makes of open meshes is open."""
    if mrmeshpy is None:
        print("MeshLib is left out: the package meshlib is not installed")
        return {}
    mesh = mrmeshnumpy.meshFromFacesVerts(shape.triangles, shape.points)
    options = mrmeshpy.OffsetParameters()
    options.voxelSize = wall / 8
    options.signDetectionMode = mrmeshpy.SignDetectionMode.Unsigned
    found = mrmeshpy.offsetMesh(mrmeshpy.MeshPart(mesh), wall / 2, options)
    points = np.asarray(mrmeshnumpy.getNumpyVerts(found), float)
    return {"MeshLib": (points, np.asarray(mrmeshnumpy.getNumpyFaces(found.topology), np.int32))}


def places_on(shape: Shape, wall: float) -> tuple[Floats, NDArray[np.bool_]]:
    """Random places far from rims, and whether there is room on both sides."""
    sheet = sheet_of(shape)
    corners = sheet.points[sheet.triangles]
    normals, doubled = unit_normals(corners)
    random = np.random.default_rng(1)
    rows = random.choice(len(corners), PLACES, p=doubled / doubled.sum())
    weights = random.dirichlet((1, 1, 1), PLACES)
    places = (weights[:, :, None] * corners[rows]).sum(axis=1)
    sides = np.ascontiguousarray(rim_sides(sheet.triangles)[:, [0, 1, 1]].astype(np.int32))
    inner = medial.TriangleTree(sheet.points, sides).distances(places) >= 0.5 * wall
    places, away = places[inner], 0.5 * wall * normals[rows[inner]]
    room = np.ones(len(places), bool)
    for centre in (places + away, places - away):
        free = medial.TriangleTree(sheet.points, sheet.triangles).distances(centre)
        room &= free >= 0.495 * wall
    return places, room


def inside(mesh: Mesh, wall: float) -> float:
    """The share of the faces before which the solid goes on."""
    normals, doubled = unit_normals(mesh[0][mesh[1]])
    random = np.random.default_rng(2)
    rows = random.choice(len(normals), INSIDE, p=doubled / doubled.sum())
    before = mesh[0][mesh[1][rows]].mean(axis=1) + 1e-3 * wall * normals[rows]
    return float((medial.winding_number(before, *mesh) > 0.5).mean())


def judged(name: str, way: str, mesh: Mesh, at: tuple, wall: float, seconds: float) -> list[str]:
    places, room = at
    walls = 200 * medial.TriangleTree(mesh[0], mesh[1]).distances(places) / wall
    crossings = len(medial.crossing_faces(mesh[0], mesh[1]))
    even = np.abs(walls[room] - 100) <= 2
    least = f"{walls[~room].min():.1f}" if (~room).any() else ""
    return [
        name,
        way,
        f"{len(mesh[1]):,}",
        f"{crossings:,}",
        f"{100 * inside(mesh, wall):.1f}",
        f"{100 * even.mean():.1f}" if room.any() else "",
        f"{walls[room].min():.1f}" if room.any() else "",
        least,
        f"{seconds:.1f}",
    ]


def rows_of(name: str):
    made, wall = SHEETS[name]
    if made is None:
        shape, _ = read_shape(_module.DATA / name)
        wall *= float(np.linalg.norm(np.ptp(shape.points, axis=0)))
    else:
        shape = Shape(*made())
    at = places_on(shape, wall)
    for found in (lambda *given: {"ours": ours(*given)}, by_blender, by_meshlib):
        start = time.perf_counter()
        solids = found(shape, wall)
        seconds = (time.perf_counter() - start) / max(len(solids), 1)
        for way, mesh in solids.items():
            yield judged(name, way, mesh, at, wall, seconds)


def main() -> None:
    parser = _module.parser(__doc__)
    parser.add_argument("sheets", nargs="*", help="names of some sheets; all if there are none")
    wanted = parser.parse_args()
    names = wanted.sheets or SHEETS
    _module.tell(HEADER, (row for name in names for row in rows_of(name)), wanted.output)


if __name__ == "__main__":
    main()
