# SPDX-License-Identifier: GPL-3.0-or-later
"""Calls libraries of others that have no command line, or another format: METHOD INPUT OUTPUT.off.

Nothing here is fetched; `recipes.toml` skips what is not installed.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np

CELLS = 96  # voxels along the longest side


def masbcpp(source: Path, target: Path) -> None:
    """`compute_ma` reads and writes arrays of NumPy; its inner balls are on the side against the normals."""
    rows = np.loadtxt(source)
    folder = target.parent / "arrays"
    folder.mkdir()
    np.save(folder / "coords.npy", rows[:, :3].astype(np.float32))
    np.save(folder / "normals.npy", rows[:, 3:6].astype(np.float32))
    subprocess.run(["compute_ma", folder, folder], check=True)
    write_segments(np.load(folder / "ma_coords_in.npy"), np.empty((0, 2), int), target)


def mean_curvature(source: Path, target: Path) -> None:
    from compas_cgal.skeletonization import mesh_skeleton

    segments = np.array(mesh_skeleton(read_mesh(source)))
    write_segments(segments.reshape(-1, 3), np.arange(2 * len(segments)).reshape(-1, 2), target)


def wavefront(source: Path, target: Path) -> None:
    import skeletor
    import trimesh

    mesh = trimesh.Trimesh(*read_mesh(source), process=False)
    table = skeletor.skeletonize.by_wavefront(mesh, waves=1, step_size=1, progress=False).swc
    row = {node: i for i, node in enumerate(table.node_id)}
    pairs = [
        (row[n], row[p]) for n, p in zip(table.node_id, table.parent_id, strict=True) if p >= 0
    ]
    write_segments(table[["x", "y", "z"]].to_numpy(), np.array(pairs), target)


def thinning(source: Path, target: Path) -> None:
    """Voxels whose centres are inside, thinned; neighbours among the 26 round a voxel are joined."""
    from scipy.spatial import cKDTree
    from skimage.morphology import skeletonize

    from . import product

    vertices, triangles = read_mesh(source)
    low = vertices.min(axis=0)
    size = np.ptp(vertices, axis=0).max() / CELLS
    shape = np.ceil(np.ptp(vertices, axis=0) / size).astype(int) + 2
    places = low + (np.indices(shape).reshape(3, -1).T - 0.5) * size
    inside = product.load().winding_number(places, vertices, triangles) > 0.5
    thin = np.argwhere(skeletonize(inside.reshape(shape)))
    write_segments(
        low + (thin - 0.5) * size, cKDTree(thin).query_pairs(1.8, output_type="ndarray"), target
    )


def read_mesh(path: Path) -> tuple[np.ndarray, np.ndarray]:
    words = path.read_text().split()
    v, f = int(words[1]), int(words[2])
    vertices = np.array(words[4 : 4 + 3 * v], float).reshape(-1, 3)
    triangles = np.array(words[4 + 3 * v : 4 + 3 * v + 4 * f], int).reshape(-1, 4)[:, 1:]
    return vertices, triangles.astype(np.int32)


def write_segments(points: np.ndarray, pairs: np.ndarray, path: Path) -> None:
    lines = ["OFF", f"{len(points)} {len(pairs)} 0"]
    lines += [f"{x:.17g} {y:.17g} {z:.17g}" for x, y, z in np.asarray(points, float).tolist()]
    lines += [f"2 {p} {q}" for p, q in np.asarray(pairs).tolist()]
    path.write_text("\n".join(lines) + "\n")


METHODS = {
    "masbcpp": masbcpp,
    "mean-curvature": mean_curvature,
    "thinning": thinning,
    "wavefront": wavefront,
}

if __name__ == "__main__":
    METHODS[sys.argv[1]](Path(sys.argv[2]), Path(sys.argv[3]))
