# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces with noise or steps, as they are and prepared: a Markdown table, or a picture of one of them.

    python3 lab/benchmarks/rough_faces.py [--output table.md] [--only "torus, voxels" ...] [--picture hand.png]

Meshes of the shared set have Gaussian errors in all coordinates of their vertices, in units of the median edge; the
liver has steps as it is. Exact shapes are cut into voxels, 70 along the diagonal, and closed by faces between the
middles of what these cross. Betti: pieces, loops and cavities of Clean with Prepare Off and Automatic, bold where they
are not those of the faces. o->t and t->o: mean distance of the vertices of the axis to the exact one, and back, in
percent of the diagonal. The picture shows the axes of the first mesh: left as it is, right prepared.
"""

import sys
import time
from pathlib import Path

import _module
import numpy as np
import scans
from medial_axis.core.axis.compute import compute
from medial_axis.core.files.read_shape import read_shape
from medial_axis.core.settings import Prepare, Settings
from scipy.spatial import cKDTree

VOXELS = 70
MESHES = {
    "hand, 0.25": ("hand_closed.obj", 0.25),
    "hand, 0.5": ("hand_closed.obj", 0.5),
    "rocker arm, 0.25": ("rocker-arm.off", 0.25),
    "liver": ("liver.ply", 0.0),
}
CUT = {f"{name}, voxels": name for name in ("torus", "slab", "ellipsoid", "box")}
HEADER = ["faces", "way", "Betti", "facets", "edges", "o->t mean %", "t->o mean %", "seconds"]


def noisy_mesh(file: str, noise: float) -> tuple[np.ndarray, np.ndarray]:
    shape = read_shape(_module.DATA / file)[0]
    a, b = shape.points[shape.triangles[:, :2]].transpose(1, 0, 2)
    edge = np.median(np.linalg.norm(b - a, axis=1))
    errors = np.random.default_rng(0).normal(size=shape.points.shape)
    return shape.points + noise * edge * errors, shape.triangles


def voxel_faces(shape) -> tuple[np.ndarray, np.ndarray]:
    """A vertex in each cube of eight voxels of which some are inside, and two triangles between two unlike voxels."""
    points = shape.sample(4000, 1)
    low, high = points.min(axis=0), points.max(axis=0)
    step = np.linalg.norm(high - low) / VOXELS
    count = np.ceil((high - low) / step).astype(int) + 4
    grid = [low[i] + (np.arange(count[i]) - 1.5) * step for i in range(3)]
    inside = shape.inside(np.stack(np.meshgrid(*grid, indexing="ij"), -1).reshape(-1, 3))
    inside = inside.reshape(count)
    sums, many, quads = np.zeros((*(count - 1), 3)), np.zeros(count - 1), []
    for along in range(3):
        first, last = np.moveaxis(inside, along, 0)[:-1], np.moveaxis(inside, along, 0)[1:]
        place = np.argwhere(np.moveaxis(first != last, 0, along))
        middle = np.column_stack([grid[i][place[:, i]] for i in range(3)])
        middle[:, along] += step / 2
        second, third = (along + 1) % 3, (along + 2) % 3
        cubes = []
        for one, other in ((-1, -1), (0, -1), (0, 0), (-1, 0)):
            cube = place.copy()
            cube[:, second] += one
            cube[:, third] += other
            cubes.append(np.ravel_multi_index(tuple(cube.T), count - 1))
            np.add.at(sums, tuple(cube.T), middle)
            np.add.at(many, tuple(cube.T), 1)
        quad = np.column_stack(cubes)
        outward = inside[tuple(place.T)]
        quads.append(np.where(outward[:, None], quad, quad[:, ::-1]))
    used, row = np.unique(np.concatenate(quads), return_inverse=True)
    row = row.reshape(-1, 4)
    triangles = np.concatenate([row[:, [0, 1, 2]], row[:, [0, 2, 3]]]).astype(np.int32)
    return sums.reshape(-1, 3)[used] / many.reshape(-1)[used][:, None], triangles


def rows_of(name: str) -> list[list[str]]:
    shape = scans.SOLIDS[CUT[name]][0] if name in CUT else None
    points, triangles = voxel_faces(shape) if shape else noisy_mesh(*MESHES[name])
    truth, rows = scans.MEDIAL.solid_betti(points, triangles), []
    for prepare in (Prepare.OFF, Prepare.AUTOMATIC):
        start = time.process_time()
        found = compute(points, triangles, Settings(prepare=prepare))
        used, axis = time.process_time() - start, found.axis
        away = distances(axis.vertices, shape, points) if shape else ("", "")
        counts = f"{axis.facets:,}", f"{len(axis.edges):,}"
        betti = scans.bold(str(axis.level.betti), found, truth)
        rows.append([name, prepare.value, betti, *counts, *away, f"{used:.1f}"])
        print(*rows[-1], *found.warnings, sep=" | ", file=sys.stderr, flush=True)
    return rows


def distances(vertices: np.ndarray, shape, points: np.ndarray) -> tuple[str, str]:
    diagonal = np.linalg.norm(np.ptp(points, axis=0)) / 100
    back = cKDTree(vertices).query(shape.axis_points(3000))[0].mean() / diagonal
    return f"{shape.axis_distance(vertices).mean() / diagonal:.2f}", f"{back:.2f}"


def draw(path: Path, name: str) -> None:
    sys.path.insert(0, str(_module.ROOT / "lab/pictures"))
    from scan_sheet import drawn_faces, png

    mesh = noisy_mesh(*MESHES[name])
    both = [drawn_faces(*mesh, prepare) for prepare in (Prepare.OFF, Prepare.AUTOMATIC)]
    path.write_bytes(png(np.concatenate(both, axis=1)))


def main() -> None:
    parser = _module.parser(__doc__)
    parser.add_argument("--only", nargs="+", choices=[*MESHES, *CUT], default=[*MESHES, *CUT])
    parser.add_argument("--picture", type=Path)
    wanted = parser.parse_args()
    if wanted.picture:
        draw(wanted.picture, wanted.only[0])
        return
    table = _module.markdown(HEADER, [row for name in wanted.only for row in rows_of(name)])
    _module.publish(table, wanted.output)


if __name__ == "__main__":
    main()
