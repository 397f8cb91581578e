# SPDX-License-Identifier: GPL-3.0-or-later
"""Centre lines of pieces of real neurons beside those of other programs, judged by the lines that made the mesh.

    python3 lab/benchmarks/neurons.py navis-1.12.0-py3-none-any.whl [--neurons 3] [--output table.md]

The wheel of navis, on PyPI, has five neurons as `.swc` files. Of each, the piece of the tree in a cube of 600 units
with the most nodes is made thick: the union of cones between its nodes, whose radii are smoothed, and 15 at least. The
mesh is its surface by marching cubes. kimimaro gets the same solid as voxels, of a third of the least radius, and the
options of its page (a unit is 8 nm). Needs scikit-image; kimimaro, compas_cgal, and skeletor with trimesh, all from
PyPI, are left out by name where they are absent. A program that fails has a row that says so.

ends: of the lines that a program found; right: ends of the tree within 3 radii of one of these, each one counted once;
off: distance of places on its lines from the lines of the tree, mean and 95th percentile, in radii there; bare: the
share of the lines of the tree that is farther than a radius from its lines; radius: how far the radius that is said is
off, median and 95th percentile, in percent; s: of the processor, without the mesh and the voxels.
"""

from __future__ import annotations

import argparse
import importlib.util
import io
import sys
import time
import zipfile
from dataclasses import dataclass
from pathlib import Path

import _module
import numpy as np

medial = _module.load()

from medial_axis.core.settings import Settings, SkeletonSettings  # noqa: E402
from medial_axis.core.shape.shape import Shape  # noqa: E402  (found through _module)
from medial_axis.core.skeleton.compute import compute_skeleton  # noqa: E402
from scipy.spatial import cKDTree  # noqa: E402
from skeletons import Lines, cgal, wavefront  # noqa: E402

CUBE, LEAST = 600.0, 15.0
VOXEL = LEAST / 3
HEADER = ["neuron", "program", "ends", "right", "loops", "off", "bare", "radius", "s"]


@dataclass(frozen=True)
class Tree:
    """A piece of a neuron: (n, 3) places, (n,) radii, (n,) parents, -1 for the root."""

    places: np.ndarray
    radius: np.ndarray
    parent: np.ndarray

    @property
    def edges(self) -> np.ndarray:
        below = np.flatnonzero(self.parent >= 0)
        return np.column_stack((self.parent[below], below))

    @property
    def tips(self) -> np.ndarray:
        return np.flatnonzero(np.bincount(self.edges.ravel(), minlength=len(self.places)) == 1)


# --- the trees


def trees_of(wheel: Path, count: int):
    """Names and pieces of the first neurons in the wheel of navis."""
    with zipfile.ZipFile(wheel) as archive:
        names = sorted(name for name in archive.namelist() if name.endswith(".swc"))[:count]
        for name in names:
            rows = np.loadtxt(io.BytesIO(archive.read(name)))
            row = {int(number): i for i, number in enumerate(rows[:, 0])}
            parent = np.array([row.get(int(above), -1) for above in rows[:, 6]])
            yield Path(name).stem, piece_of(rows[:, 2:5], rows[:, 5], parent)


def piece_of(places: np.ndarray, radius: np.ndarray, parent: np.ndarray) -> Tree:
    """The connected piece with the most nodes in a cube round a fork."""
    forks = np.flatnonzero(np.bincount(parent[parent >= 0], minlength=len(places)) > 1)
    pieces = (connected(places, parent, fork) for fork in forks[:: max(1, len(forks) // 100)])
    used = max(pieces, key=len)
    row = np.full(len(places), -1)
    row[used] = np.arange(len(used))
    above = np.where(parent[used] >= 0, row[parent[used]], -1)
    tree = Tree(places[used], smoothed(radius[used], above), above)
    return without_stubs(tree)


def connected(places: np.ndarray, parent: np.ndarray, start: int) -> np.ndarray:
    """The nodes that are joined to one of them within the cube round it."""
    near = (np.abs(places - places[start]) < CUBE / 2).all(axis=1)
    label = np.arange(len(places))
    joined = np.flatnonzero((parent >= 0) & near & near[parent])
    while True:
        least = np.minimum(label[joined], label[parent[joined]])
        before = label.copy()
        np.minimum.at(label, joined, least)
        np.minimum.at(label, parent[joined], least)
        if (label == before).all():
            return np.flatnonzero(label == label[start])


def smoothed(radius: np.ndarray, parent: np.ndarray) -> np.ndarray:
    below = np.flatnonzero(parent >= 0)
    for _ in range(5):
        total, count = radius.copy(), np.ones(len(radius))
        for a, b in ((below, parent[below]), (parent[below], below)):
            np.add.at(total, a, radius[b])
            np.add.at(count, a, 1.0)
        radius = total / count
    return np.maximum(radius, LEAST)


def without_stubs(tree: Tree) -> Tree:
    """Without branches that reach less than a radius out of the ball at their fork, the shortest first."""
    while True:
        stubs = []
        degree = np.bincount(tree.edges.ravel(), minlength=len(tree.places))
        for tip in np.flatnonzero((degree == 1) & (tree.parent >= 0)):
            way = [tip]
            while degree[tree.parent[way[-1]]] == 2 and tree.parent[tree.parent[way[-1]]] >= 0:
                way.append(tree.parent[way[-1]])
            fork = tree.parent[way[-1]]
            away = np.linalg.norm(tree.places[tip] - tree.places[fork]) + tree.radius[tip]
            if degree[fork] > 2 and away < 2.0 * tree.radius[fork]:
                stubs.append((away, way))
        if not stubs:
            return tree
        left = np.setdiff1d(np.arange(len(tree.places)), min(stubs)[1])
        row = np.full(len(tree.places) + 1, -1)
        row[left] = np.arange(len(left))
        tree = Tree(tree.places[left], tree.radius[left], row[tree.parent[left]])


def volume_of(tree: Tree) -> tuple[np.ndarray, np.ndarray]:
    """How far places of a lattice are outside of the union of cones, negative inside, and the first place."""
    first = tree.places.min(axis=0) - tree.radius.max() - 3 * VOXEL
    size = np.ceil((tree.places.max(axis=0) + tree.radius.max() + 3 * VOXEL - first) / VOXEL)
    found = np.full(size.astype(int), 2.0 * VOXEL, np.float32)
    for a, b in tree.edges:
        ends, radii = tree.places[[a, b]], tree.radius[[a, b]]
        margin = radii.max() + 2 * VOXEL
        low = np.maximum(((ends.min(axis=0) - margin - first) / VOXEL).astype(int), 0)
        high = ((ends.max(axis=0) + margin - first) / VOXEL).astype(int) + 2
        window = tuple(slice(i, j) for i, j in zip(low, high, strict=True))
        axes = [first[k] + VOXEL * np.arange(low[k], min(high[k], size[k])) for k in range(3)]
        at = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
        way = ends[1] - ends[0]
        share = np.clip(((at - ends[0]) @ way) / max(way @ way, 1e-30), 0.0, 1.0)
        away = np.linalg.norm(at - ends[0] - share[..., None] * way, axis=-1)
        away -= radii[0] + share * (radii[1] - radii[0])
        found[window] = np.minimum(found[window], away)
    return found, first


def mesh_of(volume: np.ndarray, first: np.ndarray) -> Shape:
    from skimage.measure import marching_cubes

    points, triangles, *_ = marching_cubes(volume, 0.0, gradient_direction="descent")
    return Shape(first + VOXEL * points.astype(np.float64), triangles.astype(np.int32))


# --- the programs


def ours(shape: Shape, detail: float) -> Lines:
    found = compute_skeleton(shape, Settings(), SkeletonSettings(detail=detail)).skeleton
    return Lines(found.points, found.edges, found.radius)


def kimimaro(volume: np.ndarray, first: np.ndarray) -> Lines:
    import kimimaro as program

    labels = np.asfortranarray((volume < 0.0).astype(np.uint8))
    params = {"scale": 1.5, "const": 37.5, "soma_detection_threshold": 1e9}
    made = program.skeletonize(
        labels, params, dust_threshold=0, anisotropy=(VOXEL,) * 3, progress=False, parallel=1
    )
    (found,) = made.values()
    return Lines(first + found.vertices.astype(np.float64), found.edges, found.radii)


# --- how good they are


def row(name: str, program: str, lines: Lines, tree: Tree, seconds: float) -> list[str]:
    graph = lines.graph()
    ends = lines.points[graph.degree == 1]
    along, radius, said = spread(lines.points, lines.edges, lines.radius)
    truth, thick, _ = spread(tree.places, tree.edges, tree.radius)
    away, nearest = cKDTree(truth).query(along)
    off = away / thick[nearest]
    bare = cKDTree(along).query(truth)[0] > thick
    tips = tree.tips
    wrong = "none said"
    if said:
        wrong = 100.0 * np.abs(radius / thick[nearest] - 1.0)
        wrong = f"{np.median(wrong):.1f}, {np.percentile(wrong, 95):.0f}"
    return [name, program, str(len(ends)), f"{matched(tree, ends)} of {len(tips)}", str(graph.loops),
            f"{off.mean():.2f}, {np.percentile(off, 95):.2f}", f"{100 * bare.mean():.1f} %", wrong,
            f"{seconds:.1f}"]  # fmt: skip


def spread(points: np.ndarray, edges: np.ndarray, radius: np.ndarray | None):
    """Places along edges, a fifth of the least radius apart, with radii, and whether these are known."""
    known = radius is not None
    radius = radius if known else np.zeros(len(points))
    a, b = edges.T
    length = np.linalg.norm(points[b] - points[a], axis=1)
    count = np.maximum(np.ceil(length / (LEAST / 5)).astype(int), 1)
    edge = np.repeat(np.arange(len(edges)), count)
    step = np.arange(len(edge)) - np.repeat(np.cumsum(count) - count, count)
    share = (step + 0.5) / count[edge]
    places = (1 - share)[:, None] * points[a[edge]] + share[:, None] * points[b[edge]]
    return places, (1 - share) * radius[a[edge]] + share * radius[b[edge]], known


def matched(tree: Tree, ends: np.ndarray) -> int:
    """How many ends of the tree have an end of their own within three radii."""
    if not len(ends):
        return 0
    from scipy.sparse import csr_array
    from scipy.sparse.csgraph import maximum_bipartite_matching

    tips = tree.tips
    away = np.linalg.norm(tree.places[tips, None] - ends[None], axis=2)
    near = csr_array(away < 3.0 * tree.radius[tips, None])
    return int((maximum_bipartite_matching(near) >= 0).sum())


def rows_of(name: str, tree: Tree):
    volume, first = volume_of(tree)
    shape = mesh_of(volume, first)
    sizes = f"{name}, {len(shape.points):,} vertices"
    runs = {
        "Extract Skeleton": ((), lambda: ours(shape, 0.5)),
        "Extract Skeleton, Detail 1": ((), lambda: ours(shape, 1.0)),
        "kimimaro": (("kimimaro",), lambda: kimimaro(volume, first)),
        "CGAL, mean curvature": (("compas_cgal",), lambda: cgal(shape)),
        "skeletor, wavefront": (("skeletor", "trimesh"), lambda: wavefront(shape)),
    }
    for program, (needed, run) in runs.items():
        missing = [module for module in needed if importlib.util.find_spec(module) is None]
        if missing:
            yield [sizes, program, f"left out: no {missing[0]}", *[""] * 6]
            continue
        start = time.process_time()
        try:
            lines = run()
        except Exception as error:  # of any kind: a program that fails ends its row, not the table
            yield failed(sizes, program, error)
            continue
        yield row(sizes, program, lines, tree, time.process_time() - start)


def failed(name: str, program: str, error: Exception) -> list[str]:
    """The row of a program that gave no lines, with the kind of its error; what it says goes to the log."""
    print(f"{name}, {program}: {error}", file=sys.stderr)
    return [name, program, f"failed: {type(error).__name__}", *[""] * 6]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("wheel", type=Path)
    parser.add_argument("--neurons", type=int, default=3)
    parser.add_argument("--output", type=Path)
    words = parser.parse_args()
    trees = trees_of(words.wheel, words.neurons)
    _module.tell(HEADER, (row for tree in trees for row in rows_of(*tree)), words.output)


if __name__ == "__main__":
    main()
