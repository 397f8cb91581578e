# SPDX-License-Identifier: GPL-3.0-or-later
"""Thickness of solids whose thickness is known: errors and processor time, beside MeshLib, a Markdown table.

    python3 lab/benchmarks/thickness_table.py [--solids plate tube ...] [--times 3] [--large]

The diameter of the largest ball inside that touches each vertex, with Edges: Ball, at the vertices of a dense mesh that
do not lie on sharp edges. All solids are turned and rounded to float32. Errors are in percent of the true diameter.
Seconds are the least processor time of several turns in one process: ours of the whole measurement, MeshLib's of the
call alone. The ratio is ours to MeshLib's. MeshLib is left out where the package meshlib is not installed. The solid
`none` is a sphere in which no wall is opposite another one. `--large` adds a tube of a million vertices.
"""

import sys
import time
from collections.abc import Callable
from dataclasses import dataclass

import _module
import numpy as np
from numpy.typing import NDArray

medial = _module.load()

from medial_axis.core.machine.cache import CACHE  # noqa: E402
from medial_axis.core.settings import Edges, SamplingMode, Settings, ThicknessSettings  # noqa: E402
from medial_axis.core.shape.shape import Shape  # noqa: E402
from medial_axis.core.thickness.fine_faces import coarse_faces, cut_faces  # noqa: E402
from medial_axis.core.thickness.thickness import measure_thickness  # noqa: E402
from support import distance, meshes, thick_meshes  # noqa: E402

try:
    from meshlib import mrmeshnumpy, mrmeshpy
except ImportError:
    mrmeshpy = None

Array = NDArray[np.float64]
Truth = Callable[[Array, Array], Array]  # of (n, 3) places and outward normals
HEADER = ["solid", "vertices", "mean, %", "max, %", "s"]
THEIRS = ["MeshLib: mean, %", "max, %", "s", "ratio"]
MOST = 1000  # vertices whose truth is computed


@dataclass(frozen=True)
class Solid:
    """A dense mesh, its true diameters, and the vertices of which these are known; None for all."""

    mesh: meshes.Mesh
    truth: Truth
    known: Callable[[Array], NDArray[np.bool_]] | None = None


def balls_between(triangles: Array) -> Truth:
    """The largest balls that hold no place of (k, 3, 3) flat triangles, by bisection."""

    def truth(points: Array, normals: Array) -> Array:
        low, high = np.zeros(len(points)), np.full(len(points), np.linalg.norm(np.ptp(triangles)))
        for _ in range(45):
            radius = 0.5 * (low + high)
            away = distance.to_triangles(points - radius[:, None] * normals, triangles)
            holds = away < (1 - 1e-9) * radius
            low, high = np.where(holds, low, radius), np.where(holds, radius, high)
        return low + high

    return truth


def flat(mesh: meshes.Mesh, longest: float) -> Solid:
    """A solid of flat faces, which are cut until their edges are short."""
    points, triangles = mesh
    none = np.empty((0, 2), np.int32), np.empty(0, np.int8)
    fine = cut_faces(coarse_faces(points, triangles.astype(np.int32), *none), longest)
    return Solid((fine.points, fine.triangles), balls_between(points[triangles]))


def prism(outline: list[tuple[float, float]], fan: int, height: float) -> meshes.Mesh:
    """A prism over a polygon all of which is seen from one of its corners."""
    count = len(outline)
    corners = [(*place, z) for z in (0.0, height) for place in outline]
    turns = [(i, (i + 1) % count) for i in range(count)]
    top = [(fan, i, j) for i, j in turns if fan not in (i, j)]
    sides = [((i, j, j + count), (i, j + count, i + count)) for i, j in turns]
    triangles = [(a, c, b) for a, b, c in top] + [tuple(i + count for i in t) for t in top]
    return np.array(corners), np.array(triangles + [t for pair in sides for t in pair], np.int32)


def ellipsoid(axes: tuple[float, float, float], subdivisions: int = 5) -> Solid:
    turn = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
    sphere = meshes.icosphere(7)[0] @ turn  # no place of it is a vertex of the mesh

    def truth(points: Array, _: Array) -> Array:
        normals = points / np.square(axes)
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        return thick_meshes.shrinking_ball(points, normals, sphere * axes)[0]

    return Solid(thick_meshes.ellipsoid(axes, subdivisions), truth)


def always(length: float) -> Truth:
    return lambda points, _: np.full(len(points), length)


def rounded_disc(thickness: float = 5.0, radius: float = 60.0, edge: float = 1.5) -> Solid:
    turn = np.linspace(0.0, np.pi / 2, 7)
    out, low = radius - edge + edge * np.sin(turn), edge - edge * np.cos(turn)
    rings = [(r, 0.0) for r in np.linspace(0.0, radius - edge, 60)[:-1]]
    lower = [*rings, *zip(out, low, strict=True)]
    upper = [(r, thickness - z) for r, z in lower[::-1]]
    mesh = meshes.lathe(np.array(lower + upper), 120)
    return Solid(mesh, always(thickness), lambda x: np.hypot(x[:, 0], x[:, 1]) < 0.95 * radius)


def shell(thickness: float = 0.2) -> Solid:
    return Solid(thick_meshes.shell(1.0, 1.0 - thickness, 5), always(thickness))


def tube(around: int = 250, across: int = 60) -> Solid:
    return Solid(meshes.torus(1.0, 0.2, around, across), always(0.4))


L_SHAPE = [(0.0, 0.0), (1.0, 0.0), (1.0, 0.3), (0.3, 0.3), (0.3, 1.0), (0.0, 1.0)]
WEDGE = [(0.0, 0.0), (1.0, 0.0), (0.94, 0.342)]
SOLIDS: dict[str, Callable[[], Solid]] = {
    "plate": lambda: flat(thick_meshes.block(1, 0.7, 0.05), 0.02),
    "plate:1e-4": lambda: flat(thick_meshes.block(1, 0.7, 1e-4), 0.02),
    "box": lambda: flat(thick_meshes.block(1, 0.7, 0.4), 0.025),
    "wedge": lambda: flat(prism(WEDGE, 0, 0.7), 0.02),
    "L": lambda: flat(prism(L_SHAPE, 3, 0.5), 0.02),
    "disc": rounded_disc,
    "shell": shell,
    "tube": tube,
    "ellipsoid": lambda: ellipsoid((1.0, 0.7, 0.4)),
    "none": lambda: ellipsoid((1.0, 1.0, 1.0)),
}
LARGE = {"tube:large": lambda: tube(2000, 500)}


def turned(mesh: meshes.Mesh) -> meshes.Mesh:
    turn = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    return (mesh[0] @ turn.T).astype(np.float32).astype(float), mesh[1]


def least(times: int, work: Callable[[], object]) -> tuple[object, float]:
    """The last result, and the least processor time of several turns."""
    spent = []
    for _ in range(times):
        CACHE.clear()
        start = time.process_time()
        found = work()
        spent.append(time.process_time() - start)
    return found, min(spent)


def errors(lengths: Array, truth: Array) -> list[str]:
    off = 100 * np.abs(lengths / truth - 1)
    return [f"{off.mean():.3f}", f"{off.max():.3f}"]


def theirs(mesh: meshes.Mesh, times: int) -> tuple[Array, float]:
    """The diameters at all vertices by MeshLib, exact as its options allow."""
    solid = mrmeshnumpy.meshFromFacesVerts(mesh[1], mesh[0])
    options = mrmeshpy.InSphereSearchSettings()
    options.insideAndOutside = False
    options.maxRadius = float(np.linalg.norm(np.ptp(mesh[0], axis=0)))
    options.maxIters, options.minShrinkage = 16, 0.99999
    measure = lambda: mrmeshpy.computeInSphereThicknessAtVertices(solid, options)
    found, seconds = least(times, measure)
    return np.array(found.vec), seconds


def row(name: str, solid: Solid, times: int) -> list[str]:
    mesh = turned(solid.mesh)
    settings = Settings(sampling=SamplingMode.VERTICES)
    wanted = ThicknessSettings(edges=Edges.BALL)
    found, seconds = least(times, lambda: measure_thickness(Shape(*mesh), settings, wanted))
    plain = solid.mesh[0]
    inside = ~found.at_edge
    if solid.known is not None:
        inside &= solid.known(plain)
    some = np.flatnonzero(inside)
    some = np.random.default_rng(0).permutation(some)[:MOST]
    normals = corner_normals(solid.mesh)[some]
    truth = solid.truth(plain[some], normals)
    cells = [name, f"{len(plain):,}", *errors(found.lengths[some], truth), f"{seconds:.2f}"]
    if mrmeshpy is not None:
        lengths, other = theirs(mesh, times)
        cells += [*errors(lengths[some], truth), f"{other:.2f}", f"{seconds / other:.2f}"]
    print(*cells, file=sys.stderr, flush=True)
    return cells


def corner_normals(mesh: meshes.Mesh) -> Array:
    """(n, 3) the normal of a triangle at each vertex."""
    points, triangles = mesh
    a, b, c = (points[triangles[:, k]] for k in range(3))
    normals = np.empty_like(points)
    normals[triangles] = np.cross(b - a, c - a)[:, None]
    return normals / np.linalg.norm(normals, axis=1)[:, None]


def main() -> None:
    parser = _module.parser(__doc__)
    parser.add_argument("--solids", nargs="+", default=[*SOLIDS])
    parser.add_argument("--times", type=int, default=3)
    parser.add_argument("--large", action="store_true")
    wanted = parser.parse_args()
    known = SOLIDS | LARGE
    names = wanted.solids + ([*LARGE] if wanted.large else [])
    if mrmeshpy is None:
        print("MeshLib is left out: the package meshlib is not installed")
    rows = [row(name, known[name](), wanted.times) for name in names]
    header = HEADER + (THEIRS if mrmeshpy is not None else [])
    _module.publish(_module.markdown(header, rows), wanted.output)


if __name__ == "__main__":
    main()
