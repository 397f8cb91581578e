#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints a hash of everything that a compiled module returns, input by input: equal before and after a change that
must not change any result.

    python3 lab/benchmarks/output_hashes.py OLD.so > old
    python3 lab/benchmarks/output_hashes.py NEW.so | diff old -
    python3 lab/benchmarks/output_hashes.py NEW.so sphere torus         only jobs with these words

The inputs are random, degenerate, meshes and scans (of MEDIAL_AXIS_TEST_DATA, skipped by name where absent); each is
analysed on one, two and three threads, with every source of sides, and extracted with every side, rule and criterion.
Jobs that end with ": wrap" depend on the version of CGAL, all others on the sources alone.
"""

import hashlib
import importlib.util
import itertools
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests"))

from support.data import DATA  # noqa: E402 - found through the line above

THREADS = (1, 2, 3)
FILES = ("3holes.off", "spot_low.obj", "knot1.off", "rocker-arm.off", "liver.ply", "club.off")
SCANS = ("cactus.xyz", "distcap.xyz")


def load(path: str):
    spec = importlib.util.spec_from_file_location("_medial", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def box(n: int):
    """A cube whose faces are grids of n x n squares: cospherical and coplanar samples."""
    steps = np.arange(n + 1)
    grid = np.array([p for p in itertools.product(steps, repeat=3) if {0, n} & set(p)], float)
    return grid / n


def ellipsoid(n: int, noise: float = 0.0):
    rng = np.random.default_rng(n)
    x = rng.normal(size=(n, 3))
    x /= np.linalg.norm(x, axis=1)[:, None]
    return x * (1.0, 0.7, 0.5) + noise * rng.normal(size=(n, 3))


def torus(n: int):
    u, v = np.random.default_rng(7).uniform(0, 2 * np.pi, (2, n))
    r = 1 + 0.3 * np.cos(v)
    return np.column_stack((r * np.cos(u), r * np.sin(u), 0.3 * np.sin(v)))


def tube(sides: int, rings: int):
    """Rings of samples, a regular polygon each: Voronoi facets without area."""
    a = 2 * np.pi * np.arange(sides) / sides
    ring = np.column_stack((np.cos(a), np.sin(a)))
    return np.concatenate([np.column_stack((ring, np.full(sides, 0.3 * z))) for z in range(rings)])


def clouds() -> Iterator[tuple[str, np.ndarray]]:
    rng = np.random.default_rng(1)
    yield "ball", rng.normal(size=(2000, 3))
    yield "ellipsoid", ellipsoid(20000)
    yield "noisy ellipsoid", ellipsoid(8000, 0.003)
    yield "torus", torus(8000)
    yield "grid cube", box(12)
    yield "solid grid", np.array(list(itertools.product(range(8), repeat=3)), float)
    yield "tube", tube(16, 20)
    yield "doubled", np.repeat(ellipsoid(1000), 2, axis=0)
    yield "thin plate", ellipsoid(3000) * (1, 1, 1e-4)
    yield "four", np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], float)
    yield "far away", ellipsoid(2000) + 1e6
    yield "tiny", ellipsoid(2000) * 1e-12
    for name in SCANS:
        if (DATA / name).is_file():
            yield name, np.loadtxt(DATA / name, usecols=(0, 1, 2))
        else:
            print(f"skipped: {name}, which is not in {DATA}", file=sys.stderr)


def read_mesh(path: Path):
    """Vertices and triangles; enough of each format for the files above."""
    if path.suffix == ".ply":
        return read_ply(path)
    rows = [line.split() for line in path.read_text().splitlines()]
    if path.suffix == ".obj":
        vertices = [row[1:4] for row in rows if row and row[0] == "v"]
        faces = [
            [int(w.split("/")[0]) - 1 for w in row[1:]] for row in rows if row and row[0] == "f"
        ]
    else:
        rows = [row for row in rows if row and not row[0].startswith("#")][1:]
        n, f = int(rows[0][0]), int(rows[0][1])
        vertices = [row[:3] for row in rows[1 : n + 1]]
        faces = [[int(w) for w in row[1 : int(row[0]) + 1]] for row in rows[n + 1 : n + f + 1]]
    fans = [(face[0], face[i], face[i + 1]) for face in faces for i in range(1, len(face) - 1)]
    return np.array(vertices, float), np.array(fans, np.int32)


def read_ply(path: Path):
    data = path.read_bytes()
    head, _, body = data.partition(b"end_header\n")
    lines = head.decode().splitlines()
    n, f = (int(line.split()[2]) for line in lines if line.startswith("element"))
    if any(line.startswith("format ascii") for line in lines):
        rows = [row.split() for row in body.decode().splitlines()]
        vertices = np.array([row[:3] for row in rows[:n]], float)
        return vertices, np.array([row[1:4] for row in rows[n : n + f]], np.int32)
    width = sum(line.startswith("property float") for line in lines)
    vertices = np.frombuffer(body, "<f4", n * width).reshape(n, width)[:, :3].astype(float)
    faces = np.frombuffer(body[n * width * 4 :], [("n", "u1"), ("v", "<i4", 3)], f)
    return vertices, faces["v"].astype(np.int32)


def meshes() -> Iterator[tuple[str, np.ndarray, np.ndarray]]:
    sys.path.insert(0, str(ROOT))
    sys.path.insert(0, str(ROOT / "tests"))
    from support.meshes import icosphere, uv_sphere

    yield "icosphere", *icosphere(3)
    yield "uv sphere", *uv_sphere(24, 12)
    vertices, triangles = icosphere(3)
    yield "open icosphere", vertices, triangles[20:]
    for name in FILES:
        if (DATA / name).is_file():
            yield name, *read_mesh(DATA / name)
        else:
            print(f"skipped: {name}, which is not in {DATA}", file=sys.stderr)


class Digest:
    def __init__(self) -> None:
        self._digest = hashlib.blake2b(digest_size=12)

    def add(self, *values) -> None:
        for value in values:
            array = (
                value
                if isinstance(value, np.ndarray)
                else np.frombuffer(repr(value).encode(), "u1")
            )
            self._digest.update(repr((array.shape, array.dtype.str)).encode() + array.tobytes())

    def __str__(self) -> str:
        return self._digest.hexdigest()


def add_analysis(digest: Digest, m, points, sides, threads, **more) -> None:
    try:
        a = m.MedialAnalysis(points, sides=sides, threads=threads, **more)
    except (m.InvalidInputError, m.DegenerateInputError) as error:
        digest.add(str(error))
        return
    for name in ("samples", "edges", "theta", "rho", "theta_both", "rho_both", "side", "bounded"):
        digest.add(getattr(a, name))
    digest.add(a.duplicates, a.closed, a.boundary_edges, a.cells, a.spacing, a.feature_size())
    wanted = ["BOTH"] if sides == m.SidesFrom.NONE else ["BOTH", "INNER", "OUTER"]
    for side, rule, criteria, limit in itertools.product(
        wanted, ("EITHER", "BOTH"), ("ANGLE_OR_RATIO", "ANGLE", "RATIO"), (False, True)
    ):
        options = (getattr(m.Side, side), getattr(m.Rule, rule), getattr(m.Criteria, criteria))
        try:
            add_axis(digest, a.extract(0.4, 6.0, *options, limit_set=limit))
            digest.add(a.select(0.2, 4.0, *options, limit_set=limit))
        except m.DegenerateInputError as error:
            digest.add(str(error))
    if sides != m.SidesFrom.NONE:
        digest.add(a.solid_triangles())


def add_axis(digest: Digest, axis) -> None:
    digest.add(axis.vertices, axis.radius, axis.face_offsets, axis.face_vertices, axis.theta)
    digest.add(axis.rho, axis.side, axis.generators, axis.unbounded, axis.zero_area)


def add_samples(digest: Digest, m, vertices, triangles, threads, **options) -> None:
    s = m.sample_surface(vertices, triangles, threads=threads, **options)
    digest.add(
        s.points, s.normals, s.triangle, s.barycentric, s.kind, s.radius, s.sharp_edges, s.area
    )


def add_all(digest: Digest, thing) -> None:
    """Everything that an object of the module holds, but its memory and timings."""
    for name in dir(thing):
        value = getattr(thing, name)
        if not name.startswith("_") and name not in {"bytes", "timings"} and not callable(value):
            digest.add(value)


def add_solid(digest: Digest, m, vertices, triangles, threads) -> None:
    """Levels of the hierarchy of a solid, few spheres, few balls, thickness, sides of its faces."""
    same = {"threads": threads}
    samples = m.sample_surface(vertices, triangles, count=2000, seed=3, **same)
    points, on = samples.points, samples.triangle
    analysis = m.MedialAnalysis(points, triangles, vertices=vertices, **same)
    hierarchy = analysis.hierarchy(faces=m.Faces(vertices, triangles, on))
    add_all(digest, hierarchy)
    for options in ({}, {"crisp": True}, {"relaxed": True}, {"sheet": np.inf, "relaxed": True}):
        level = hierarchy.extract(spacings=1.0, **options)
        add_all(digest, level)
    axis = analysis.extract(0.4, 6.0, m.Side.INNER)
    fans = m.polygon_triangles(axis.vertices, axis.face_offsets, axis.face_vertices)
    edges = np.zeros((0, 2), np.int32)
    digest.add(*m.reduce_sphere_mesh(axis.vertices, axis.radius, fans, edges, 40, **same))
    solid, size = (vertices, triangles), float(np.ptp(vertices, axis=0).max())
    few = {"count": 16, "places": 20_000, **same}
    add_all(digest, m.cover_by_balls(axis.vertices, axis.radius, *solid, **few))
    everywhere = np.full(len(points), size)
    digest.add(m.wall_distances(points, samples.normals, everywhere, *solid, **same))
    balls = m.BallFaces(*solid, **same)
    digest.add(*balls.inscribed_balls(points, on, everywhere / 50, **same))
    digest.add(m.winding_number(1.01 * points, *solid), *m.outward_faces(*solid, **same))


def add_wrap(digest: Digest, m, vertices, triangles) -> None:
    """A wrap, whose vertices are choices of CGAL: versions of it differ."""
    size = float(np.ptp(vertices, axis=0).max())
    digest.add(*m.wrap(vertices, triangles, size / 10, size / 100))


def add_scan(digest: Digest, m, points, threads) -> None:
    measure = m.measure_scan(points, threads=threads)
    add_all(digest, measure)
    add_all(digest, m.prepare_scan(points, measure, threads=threads))
    normals = points - points.mean(axis=0)
    noise = m.surface_noise(points, normals, threads=threads)
    add_all(digest, noise)
    digest.add(m.smooth_vertices(points, normals, noise, threads=threads))


def add_polygons(digest: Digest, m) -> None:
    """Regular polygons, all of whose corners are on one circle."""
    for corners in range(3, 70):
        turn = 2 * np.pi * np.arange(corners) / corners
        flat = in_float32(np.column_stack((np.cos(turn), np.sin(turn), 0 * turn)))
        offsets, rows = np.array([0, corners], np.int32), np.arange(corners, dtype=np.int32)
        digest.add(m.polygon_triangles(flat, offsets, rows))


def in_float32(points: np.ndarray) -> np.ndarray:
    """Without the last bits, in which NumPy's own sines differ from processor to processor."""
    return points.astype(np.float32).astype(np.float64)


def jobs(m) -> Iterator[tuple[str, Callable]]:
    sides = m.SidesFrom
    for name, exact in clouds():
        points = in_float32(exact)
        normals = points - points.mean(axis=0)
        yield (
            f"{name}: tight cocone",
            lambda d, t, p=points: add_analysis(d, m, p, sides.TIGHT_COCONE, t),
        )
        yield f"{name}: none", lambda d, t, p=points: add_analysis(d, m, p, sides.NONE, t)
        yield (
            f"{name}: bounding sphere",
            lambda d, t, p=points: add_analysis(
                d, m, p, sides.TIGHT_COCONE, t, bounding_sphere=True
            ),
        )
        yield (
            f"{name}: normals",
            lambda d, t, p=points, n=normals: add_analysis(d, m, p, sides.NORMALS, t, normals=n),
        )
        if len(points) > 1000:
            yield f"{name}: scan", lambda d, t, p=points: add_scan(d, m, p, t)
    yield "polygons", lambda d, t: add_polygons(d, m)
    for name, exact, triangles in meshes():
        vertices = in_float32(exact)
        yield (
            f"{name}: surface",
            lambda d, t, v=vertices, f=triangles: add_analysis(
                d, m, v, sides.SURFACE, t, triangles=f
            ),
        )
        if not m.open_edges(vertices, triangles):
            yield (
                f"{name}: solid",
                lambda d, t, v=vertices, f=triangles: add_solid(d, m, v, f, t),
            )
            yield f"{name}: wrap", lambda d, t, v=vertices, f=triangles: add_wrap(d, m, v, f)
        for smooth in (False, True):
            yield (
                f"{name}: samples, {'smooth' if smooth else 'flat'}",
                lambda d, t, v=vertices, f=triangles, s=smooth: add_samples(
                    d, m, v, f, t, count=4000, smooth=s, seed=3
                ),
            )
        sizes = 0.05 * np.ptp(vertices, axis=0).max() * (1 + np.arange(len(vertices)) % 3)
        yield (
            f"{name}: graded samples",
            lambda d, t, v=vertices, f=triangles, s=sizes: add_samples(
                d, m, v, f, t, sizing=(v, s)
            ),
        )


def main() -> None:
    m = load(sys.argv[1])
    words = sys.argv[2:]
    for name, add in jobs(m):
        if words and not any(word in name for word in words):
            continue
        hashes = []
        for threads in THREADS:
            digest = Digest()
            add(digest, threads)
            hashes.append(str(digest))
        print(
            f"{hashes[0]}  {name}" + ("" if len(set(hashes)) == 1 else "  DIFFERS BY THREADS"),
            flush=True,
        )


if __name__ == "__main__":
    main()
