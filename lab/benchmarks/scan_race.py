# SPDX-License-Identifier: GPL-3.0-or-later
"""Noisy points, prepared by us and by others: two Markdown tables.

    python3 lab/benchmarks/scan_race.py [--output tables.md] [--ways raw prepared ...] [--shapes torus ...]
        [--noise 0.25 0.5 1] [--scans "0.25 pitch" ...] [--jet PROGRAM]

The first table has ten exact shapes, as scans.py makes them, the second virtual scans of the rocker arm: 14 views
through pixels whose distance, the pitch, is 1.2 % of the diagonal.

raw          the points as they are: Prepare Off
prepared     Prepare Automatic
jet K        CGAL's jet_smooth_point_set over K neighbours, then as raw; its program is built from jet_smooth.cpp
Poisson      Open3D's normals, turned along its spanning tree, and its Poisson surface of depth 7; then its faces
Power Crust  the program of the race; its medial axis is read as the race does

What is not installed is skipped by name. Betti numbers are bold where they are wrong. o->t and t->o: mean distance of
the vertices of the axis to the true one, and of points of that to the axis, in percent of the diagonal; the true axis
of the rocker arm is that of its faces. Seconds are those of the processor, for everything from the points to the axis.
For wrong numbers of ours the warnings are printed below the table.
"""

import importlib.util
import resource
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import _module
import numpy as np
import scans
from medial_axis.core.axis.compute import compute
from medial_axis.core.errors import MedialAxisError
from medial_axis.core.files.read_shape import read_shape
from medial_axis.core.settings import Prepare, Settings
from virtual_scan import Faults, scan

from lab.race import read_axis
from lab.race.betti import betti
from lab.race.judge import distance_to, points_of
from lab.race.read_axis import Complex

JET = _module.ROOT / "build/release/lab/benchmarks/jet_smooth"
MESH, PITCH, DEPTH = "rocker-arm.off", 0.012, 7
TRUTH, MOST = (
    1500,
    3000,
)  # points of the true axis, and vertices of one, whose distances are measured
SCANS = {
    "clean": Faults(),
    "0.25 pitch": Faults(noise=0.25),
    "rounded to 1 pitch": Faults(step=1.0),
    "0.25 pitch, 1 % outliers": Faults(noise=0.25, outliers=0.01),
    "0.25 pitch, 5 % outliers": Faults(noise=0.25, outliers=0.05),
    "1 pitch, shifted by 0.5": Faults(noise=1.0, shift=0.5),
    "shifted by 2": Faults(shift=2.0),
    "0.25 pitch, nothing from below": Faults(noise=0.25, views=5),
}
HEADER = ["points", "way", "Betti", "o->t mean %", "t->o mean %", "seconds"]


@dataclass
class Found:
    """An axis, its Betti numbers, and what was said of it."""

    shape: Complex
    betti: tuple[int, int, int]
    warnings: list[str] = field(default_factory=list)


def axis_of(points: np.ndarray, triangles: np.ndarray, prepare: Prepare) -> Found:
    found = compute(points, triangles, Settings(prepare=prepare))
    axis = found.axis
    polygons = axis.face_offsets.astype(np.int64), axis.face_vertices.astype(np.int64)
    alone = np.setdiff1d(np.arange(len(axis.vertices)), np.append(polygons[1], axis.edges))
    shape = Complex(axis.vertices, *polygons, axis.edges.astype(np.int64), alone)
    return Found(shape, tuple(axis.level.betti), list(found.warnings))


def jet(program: Path, count: int) -> Callable[[np.ndarray], Found]:
    def way(points: np.ndarray) -> Found:
        with tempfile.TemporaryDirectory() as folder:
            given, made = Path(folder) / "given", Path(folder) / "made"
            points.tofile(given)
            subprocess.run([program, given, str(count), made], check=True)
            smooth = np.fromfile(made).reshape(-1, 3)
        return axis_of(smooth, scans.NO_FACES, Prepare.OFF)

    return way


def poisson(points: np.ndarray) -> Found:
    import open3d

    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(points))
    cloud.estimate_normals(open3d.geometry.KDTreeSearchParamKNN(30))
    cloud.orient_normals_consistent_tangent_plane(30)
    mesh = open3d.geometry.TriangleMesh.create_from_point_cloud_poisson(cloud, depth=DEPTH)[0]
    vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.triangles, np.int32)
    return axis_of(vertices, np.ascontiguousarray(faces), Prepare.OFF)


def power_crust(points: np.ndarray) -> Found:
    with tempfile.TemporaryDirectory() as folder:
        np.savetxt(Path(folder) / "points.xyz", points)
        command = ["powercrust", "-m", "1000000", "-i", "points.xyz"]
        subprocess.run(command, cwd=folder, check=True, capture_output=True)
        found = read_axis.read(Path(folder) / "axis.off")
    return Found(found, betti(found))


def ways(program: Path) -> dict[str, Callable[[np.ndarray], Found]]:
    """The ways whose programs and modules are there."""
    found = {
        "raw": lambda points: axis_of(points, scans.NO_FACES, Prepare.OFF),
        "prepared": lambda points: axis_of(points, scans.NO_FACES, Prepare.AUTOMATIC),
    }
    if program.is_file():
        found |= {f"jet {count}": jet(program, count) for count in (24, 80)}
    else:
        print(f"skipped: jet, no {program}", file=sys.stderr)
    if importlib.util.find_spec("open3d"):
        found["Poisson"] = poisson
    else:
        print("skipped: Poisson, no module open3d", file=sys.stderr)
    if shutil.which("powercrust"):
        found["Power Crust"] = power_crust
    else:
        print("skipped: Power Crust, no program powercrust", file=sys.stderr)
    return found


def seconds() -> float:
    """Seconds of the processor, by this process and those that it waited for."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(one.ru_utime + one.ru_stime for one in used)


@dataclass(frozen=True)
class Case:
    """Points, and the truth: the solid's diagonal and Betti numbers, distances to the true axis, and points on it."""

    name: str
    points: np.ndarray
    diagonal: float
    betti: tuple[int, int, int]
    away: Callable[[np.ndarray], np.ndarray]
    truth: np.ndarray


def shapes(names: list[str], noises: list[float]):
    for name in names:
        shape, truth = scans.SOLIDS[name]
        for noise in noises:
            points, on_axis = scans.noisy(shape, noise, 1)[0], shape.axis_points(TRUTH)
            size = diagonal_of(shape.sample(scans.COUNT, 1))
            yield Case(f"{name}, {noise:g}", points, size, truth, shape.axis_distance, on_axis)


def virtual_scans(names: list[str]):
    shape = read_shape(_module.DATA / MESH)[0]
    truth = axis_of(shape.points, shape.triangles, Prepare.OFF)
    size, on_axis = diagonal_of(shape.points), points_of(truth.shape, 0.0, TRUTH)
    for name in names:
        points = scan(shape.points, shape.triangles, PITCH, SCANS[name])
        yield Case(name, points, size, truth.betti, lambda x: distance_to(x, truth.shape), on_axis)


def diagonal_of(points: np.ndarray) -> float:
    return float(np.linalg.norm(np.ptp(points, axis=0)))


def some(vertices: np.ndarray) -> np.ndarray:
    """At most a few thousand, drawn at random."""
    return vertices[np.random.default_rng(0).permutation(len(vertices))[:MOST]]


def row(case: Case, name: str, way: Callable[[np.ndarray], Found]) -> tuple[list[str], list[str]]:
    """The cells, and what the product says where its numbers are wrong."""
    start = seconds()
    try:
        found = way(case.points)
    except MedialAxisError as error:
        return [case.name, name, f"**{error}**", "", "", f"{seconds() - start:.1f}"], []
    used = seconds() - start
    there = case.away(some(found.shape.vertices)).mean() / case.diagonal
    back = distance_to(case.truth, found.shape).mean() / case.diagonal
    right = found.betti == case.betti
    text = str(found.betti) if right else f"**{found.betti}**"
    said = [] if right or name != "prepared" else found.warnings or ["nothing"]
    return [case.name, name, text, f"{100 * there:.2f}", f"{100 * back:.2f}", f"{used:.1f}"], said


def table(cases, chosen: dict[str, Callable[[np.ndarray], Found]]) -> str:
    rows, notes = [], []
    for case in cases:
        for name, way in chosen.items():
            cells, said = row(case, name, way)
            print(*cells, file=sys.stderr, flush=True)
            rows.append(cells)
            notes += [f"- {case.name}: {sentence}\n" for sentence in said]
    return _module.markdown(HEADER, rows) + "\n" + "".join(notes)


def main() -> None:
    parser = _module.parser(__doc__)
    parser.add_argument("--ways", nargs="+")
    parser.add_argument("--shapes", nargs="*", choices=list(scans.SOLIDS), default=scans.SOLIDS)
    parser.add_argument("--noise", nargs="+", type=float, default=[0.25, 0.5, 1.0])
    parser.add_argument("--scans", nargs="*", choices=list(SCANS), default=SCANS)
    parser.add_argument("--jet", type=Path, default=JET)
    wanted = parser.parse_args()
    there = ways(wanted.jet)
    chosen = {name: there[name] for name in wanted.ways or there if name in there}
    text = table(shapes(wanted.shapes, wanted.noise), chosen)
    text += "\n" + table(virtual_scans(wanted.scans), chosen)
    _module.publish(text, wanted.output)


if __name__ == "__main__":
    main()
