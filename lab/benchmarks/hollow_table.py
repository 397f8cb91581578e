# SPDX-License-Identifier: GPL-3.0-or-later
"""Hollow solids by our command, by Blender's modifiers and by MeshLib: how good their walls are, a Markdown table.

    python3 lab/benchmarks/hollow_table.py spot_low.obj fandisk_large.off --wall 2

Files are those of the folder MEDIAL_AXIS_TEST_DATA; the wall is in percent of the diagonal. Judged are the cavities
alone: pairs of their triangles that cross, the distance of random places on them from the faces of the solid, in
percent of the wall, and how many of these places lie outside of the solid. Blender's ways are a Solidify modifier with
even thickness, voxels (Remesh) whose vertices are displaced inward, and a Boolean modifier with the exact solver that
subtracts a scaled copy, or the inside of that Solidify modifier. They are left out where Blender is not installed, and
MeshLib where the package meshlib is not.
"""

import _module
import numpy as np
from numpy.typing import NDArray

medial = _module.load()

from medial_axis.core.files.read_shape import read_shape  # noqa: E402
from medial_axis.core.hollow.hollow import hollow  # noqa: E402
from medial_axis.core.settings import HollowSettings  # noqa: E402
from medial_axis.core.shape.shape import Shape  # noqa: E402
from support.crossing_triangles import crossing_pairs  # noqa: E402

try:
    from meshlib import mrmeshnumpy, mrmeshpy
except ImportError:
    mrmeshpy = None

Mesh = tuple[NDArray[np.float64], NDArray[np.int32]]
PLACES = 20_000
NAMES = {
    "solidify": "Solidify, even thickness",
    "remesh": "Remesh and Displace",
    "scaled": "Boolean of a scaled copy",
    "offset": "Boolean of Solidify's inside",
}
HEADER = [
    "solid",
    "way",
    "triangles",
    "crossing pairs",
    "least wall, %",
    "mean wall, %",
    "outside, %",
]


def ours(shape: Shape, wall: float) -> Mesh:
    found = hollow(shape, HollowSettings(wall=wall))
    return found.vertices, found.triangles[found.outer :]


def by_blender(shape: Shape, wall: float) -> dict[str, Mesh]:
    given = {"points": shape.points, "triangles": shape.triangles, "wall": wall}
    return _module.in_blender("offsets_in_blender.py", NAMES, **given)


def by_meshlib(shape: Shape, wall: float) -> dict[str, Mesh]:
    if mrmeshpy is None:
        print("MeshLib is left out: the package meshlib is not installed")
        return {}
    mesh = mrmeshnumpy.meshFromFacesVerts(shape.triangles, shape.points)
    options = mrmeshpy.OffsetParameters()
    options.voxelSize = wall / 4
    found = mrmeshpy.offsetMesh(mrmeshpy.MeshPart(mesh), -wall, options)
    return {
        "MeshLib's offset": (
            np.asarray(mrmeshnumpy.getNumpyVerts(found), float),
            np.asarray(mrmeshnumpy.getNumpyFaces(found.topology), np.int32),
        )
    }


def places_on(mesh: Mesh) -> NDArray[np.float64]:
    """Random places, evenly by area."""
    a, b, c = mesh[0][mesh[1]].transpose(1, 0, 2)
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    random = np.random.default_rng(1)
    rows = random.choice(len(areas), PLACES, p=areas / areas.sum())
    u, v = random.random((2, PLACES, 1))
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    return a[rows] + u * (b - a)[rows] + v * (c - a)[rows]


def judged(name: str, way: str, mesh: Mesh, shape: Shape, wall: float) -> list[str]:
    places = np.ascontiguousarray(places_on(mesh))
    walls = 100 * medial.TriangleTree(shape.points, shape.triangles).distances(places) / wall
    outside = medial.winding_number(places, shape.points, shape.triangles) < 0.5
    crossings = len(crossing_pairs(*mesh))
    return [
        name,
        way,
        f"{len(mesh[1]):,}",
        f"{crossings:,}",
        f"{walls.min():.1f}",
        f"{walls.mean():.1f}",
        f"{100 * outside.mean():.2f}",
    ]


def main() -> None:
    parser = _module.parser(__doc__)
    parser.add_argument("files", nargs="+")
    parser.add_argument("--wall", type=float, default=2.0, help="percent of the diagonal")
    wanted = parser.parse_args()
    rows = []
    for name in wanted.files:
        shape, _ = read_shape(_module.DATA / name)
        wall = wanted.wall / 100 * float(np.linalg.norm(np.ptp(shape.points, axis=0)))
        cavities = {"ours": ours(shape, wall), **by_blender(shape, wall), **by_meshlib(shape, wall)}
        rows += [judged(name, way, mesh, shape, wall) for way, mesh in cavities.items()]
    _module.publish(_module.markdown(HEADER, rows), wanted.output)


if __name__ == "__main__":
    main()
