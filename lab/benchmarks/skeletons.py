# SPDX-License-Identifier: GPL-3.0-or-later
"""Skeletons beside those of other programs: ends, loops, how centred they are, their radii, seconds. A Markdown table.

    python3 lab/benchmarks/skeletons.py [--output table.md] [--files spot_low.obj ...] [--blender blender]

compas_cgal (CGAL's mean curvature skeleton) and skeletor with trimesh, both from PyPI, are left out by name where they
are absent, and so is Blender. Blender makes no skeleton of a surface: its Skin modifier takes edges that somebody drew;
here it gets ours, with our radii, makes its armature of them, and automatic weights bind the mesh to that.

ends, loops, pieces: of the graph. outside: the share of places along it that lie outside of the surface. off-centre: at
places inside, away from ends and forks, 24 rays go out across the line; how far the mean of what they hit is from the
line, in mean lengths of a ray; median and 95th percentile. radius: median at these of the distance to the nearest
sample of the surface over the radius that is said. Seconds are of the processor. skeletor's clusters are
as wide as 2 % of the diagonal. Needs the optional data folder (MEDIAL_AXIS_TEST_DATA).
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import shutil
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import _module
import numpy as np

medial = _module.load()

from medial_axis.core.files.read_shape import read_shape  # noqa: E402
from medial_axis.core.machine.memory_limit import WHAT_IS_FREE  # noqa: E402
from medial_axis.core.machine.progress import Progress  # noqa: E402
from medial_axis.core.samples.choose_samples import begin  # noqa: E402  (found through _module)
from medial_axis.core.settings import SamplingMode, Settings, SkeletonSettings  # noqa: E402
from medial_axis.core.shape.nearness import nearest  # noqa: E402
from medial_axis.core.shape.shape import Shape  # noqa: E402
from medial_axis.core.skeleton.compute import compute_skeleton  # noqa: E402
from medial_axis.core.skeleton.skeleton import Skeleton, skeleton_of  # noqa: E402

FILES = ("hand_closed.obj", "spot_low.obj", "human_woman.obj", "dilo.off", "knot1.off")
HEADER = ["mesh", "program", "ends", "loops", "pieces", "outside", "off-centre", "radius", "s"]
PLACES, RAYS = 60, 24


@dataclass(frozen=True)
class Lines:
    """A graph in space: (n, 3) points, (e, 2) edges, (n,) radii or None where a program says none."""

    points: np.ndarray
    edges: np.ndarray
    radius: np.ndarray | None

    def graph(self) -> Skeleton:
        """Each edge a branch, which is enough to count."""
        radius = np.ones(len(self.points)) if self.radius is None else self.radius
        used = np.unique(self.edges)
        return skeleton_of(self.points, radius, list(self.edges), np.setdiff1d(used, used))


# --- the programs


def ours(shape: Shape) -> Lines:
    found = compute_skeleton(shape, Settings(), SkeletonSettings()).skeleton
    return Lines(found.points, found.edges, found.radius)


def cgal(shape: Shape) -> Lines:
    from compas_cgal.skeletonization import mesh_skeleton

    ends = np.array(mesh_skeleton((shape.points, shape.triangles))).reshape(-1, 3)
    points, row = np.unique(ends, axis=0, return_inverse=True)
    return Lines(points, row.reshape(-1, 2), None)


def _skeletor(shape: Shape, make: Callable) -> Lines:
    import skeletor
    import trimesh

    mesh = trimesh.Trimesh(shape.points, shape.triangles, process=False)
    found = make(skeletor, mesh)
    table = found.swc
    row = {node: i for i, node in enumerate(table.node_id)}
    edges = [(row[a], row[b]) for a, b in zip(table.node_id, table.parent_id) if b in row]
    radius = table.radius.to_numpy() if "radius" in table else None
    return Lines(table[["x", "y", "z"]].to_numpy(), np.array(edges), radius)


def wavefront(shape: Shape) -> Lines:
    return _skeletor(
        shape,
        lambda s, mesh: s.skeletonize.by_wavefront(s.pre.fix_mesh(mesh), progress=False),
    )


def contraction(shape: Shape) -> Lines:
    def make(s, mesh):
        mesh = s.pre.fix_mesh(mesh)
        thin = s.pre.contract(mesh, epsilon=0.1, time_lim=60, progress=False, validate=False)
        distance = 0.02 * float(np.linalg.norm(np.ptp(mesh.vertices, axis=0)))
        found = s.skeletonize.by_vertex_clusters(thin, distance, progress=False)
        s.post.radii(found, mesh, method="knn")
        return found

    return _skeletor(shape, make)


PROGRAMS = {
    "Extract Skeleton": (ours, ()),
    "CGAL, mean curvature": (cgal, ("compas_cgal",)),
    "skeletor, wavefront": (wavefront, ("skeletor", "trimesh")),
    "skeletor, contraction": (contraction, ("skeletor", "trimesh")),
}


# --- how good they are


def row(name: str, program: str, lines: Lines, seconds: float, truth: Truth) -> list[str]:
    graph = lines.graph()
    places, along, radii = places_of(lines)
    inside = truth.inside(places)
    used = np.flatnonzero(inside & truth.away_from_nodes(places, graph))
    used = used[np.linspace(0, len(used) - 1, min(PLACES, len(used))).astype(int)]
    off = [truth.off_centre(places[i], along[i]) for i in used]
    centred = f"{np.median(off):.3f}, {np.percentile(off, 95):.2f}" if off else "no place"
    said = "none said" if radii is None else "no place"
    if radii is not None and off:
        said = f"{np.median(truth.away(places[used]) / radii[used]):.2f}"
    counts = (graph.tips, graph.loops, graph.pieces)
    outside = f"{1.0 - inside.mean():.1%}"
    return [name, program, *map(str, counts), outside, centred, said, f"{seconds:.2f}"]


def places_of(lines: Lines) -> tuple[np.ndarray, np.ndarray, np.ndarray | None]:
    """Evenly spread places on the edges, their directions, and the radii that are said there."""
    a, b = (lines.points[column] for column in lines.edges.T)
    length = np.linalg.norm(b - a, axis=1)
    marks = np.concatenate(([0.0], np.cumsum(length)))
    wanted = np.linspace(0.0, marks[-1], 4 * PLACES + 2)[1:-1]
    edge = np.clip(np.searchsorted(marks, wanted) - 1, 0, len(length) - 1)
    tiny = float(np.finfo(float).tiny)
    share = (wanted - marks[edge]) / np.maximum(length[edge], tiny)
    places = (1 - share)[:, None] * a[edge] + share[:, None] * b[edge]
    along = ((b - a) / np.maximum(length, tiny)[:, None])[edge]
    if lines.radius is None:
        return places, along, None
    ends = lines.radius[lines.edges[edge]]
    return places, along, (1 - share) * ends[:, 0] + share * ends[:, 1]


class Truth:
    """Queries of the surface itself: distances to samples of it, and where rays meet its triangles."""

    def __init__(self, shape: Shape) -> None:
        settings = Settings(sampling=SamplingMode.SURFACE, samples=100_000)
        self._samples = begin(shape, settings, Progress(), WHAT_IS_FREE).chosen.samples.points
        a, b, c = (shape.points[column] for column in shape.triangles.T)
        self._a, self._u, self._v = a, b - a, c - a

    def away(self, points: np.ndarray) -> np.ndarray:
        return np.linalg.norm(points - self._samples[nearest(points, self._samples)], axis=1)

    def away_from_nodes(self, places: np.ndarray, graph: Skeleton) -> np.ndarray:
        """Which places are outside of the balls at ends and forks, made half as large again."""
        nodes = graph.points[graph.degree != 2]
        if not len(nodes):
            return np.ones(len(places), bool)
        gaps = np.linalg.norm(places[:, None] - nodes[None], axis=2)
        return (gaps > 1.5 * self.away(nodes)).all(axis=1)

    def inside(self, points: np.ndarray) -> np.ndarray:
        """Whether points are inside, by the parity of the hits of a slanted ray."""
        way = np.array([0.5377, 0.2391, 0.8085])
        return np.array([np.isfinite(self._hits(p, way)).sum() % 2 == 1 for p in points])

    def off_centre(self, place: np.ndarray, along: np.ndarray) -> float:
        """The distance of an inner place from the mean of the hits of rays across the line, in mean ray lengths."""
        across = np.linalg.svd(along[None])[2][1:]
        turn = np.linspace(0.0, 2 * np.pi, RAYS, endpoint=False)
        rays = np.column_stack((np.cos(turn), np.sin(turn))) @ across
        length = np.array([self._hits(place, ray).min() for ray in rays])
        mean = (length[:, None] * rays).mean(axis=0)
        return float(np.linalg.norm(mean) / length.mean())

    def _hits(self, start: np.ndarray, way: np.ndarray) -> np.ndarray:
        """(m,) how far along a ray each triangle is met, infinite where it is not (Moeller and Trumbore, 1997)."""
        p = np.cross(way, self._v)
        det = np.einsum("ij,ij->i", self._u, p)
        with np.errstate(divide="ignore", invalid="ignore"):
            s = start - self._a
            u = np.einsum("ij,ij->i", s, p) / det
            q = np.cross(s, self._u)
            v, far = q @ way / det, np.einsum("ij,ij->i", self._v, q) / det
            met = (u >= 0) & (v >= 0) & (u + v <= 1) & (far > 0)
        return np.where(met, far, np.inf)


# --- Blender


IN_BLENDER = """
import json, sys, time
import bpy
found = json.load(open(sys.argv[-1]))
bpy.ops.wm.read_factory_settings(use_empty=True)
def link(name, vertices, edges, faces):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, edges, faces)
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(thing)
    return thing
body = link("Body", found["vertices"], [], found["faces"])
lines = link("Lines", found["points"], found["edges"], [])
bpy.context.view_layer.objects.active = lines
lines.select_set(True)
start = time.process_time()
lines.modifiers.new("Skin", "SKIN")
for data, radius in zip(lines.data.skin_vertices[0].data, found["radius"]):
    data.radius = (radius, radius)
lines.data.skin_vertices[0].data[found["root"]].use_root = True
bpy.ops.object.skin_armature_create(modifier="Skin")
rig = bpy.context.object
skin = time.process_time() - start
start = time.process_time()
bpy.ops.object.select_all(action="DESELECT")
body.select_set(True)
rig.select_set(True)
bpy.context.view_layer.objects.active = rig
bpy.ops.object.parent_set(type="ARMATURE_AUTO")
weights = time.process_time() - start
bare = sum(1 for v in body.data.vertices if not v.groups)
most = max(len(v.groups) for v in body.data.vertices)
print("FOUND " + json.dumps([len(rig.data.bones), skin, weights, bare, most]))
"""


def skin_modifier(blender: str, shape: Shape, lines: Lines) -> str:
    """Reports, in words, what Blender's Skin modifier and automatic weights make of a skeleton."""
    with tempfile.TemporaryDirectory() as folder:
        given, script = Path(folder, "given.json"), Path(folder, "script.py")
        script.write_text(IN_BLENDER)
        root = int(np.argmax(lines.radius))
        arrays = (shape.points, shape.triangles, lines.points, lines.edges, lines.radius)
        names = ("vertices", "faces", "points", "edges", "radius")
        values = {name: array.tolist() for name, array in zip(names, arrays, strict=True)}
        given.write_text(json.dumps({**values, "root": root}))
        options = ["--background", "--factory-startup", "--python-exit-code", "1"]
        words = [blender, *options, "--python", str(script), "--", str(given)]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
    said = [line for line in done.stdout.splitlines() if line.startswith("FOUND ")]
    if not said:
        return "failed"
    bones, skin, weights, bare, most = json.loads(said[0][6:])
    return f"{bones} bones in {skin:.2f} s; weights in {weights:.2f} s, {bare:,} vertices bare, at most {most} bones"


# --- the table


def table(files: list[str], blender: str | None) -> Iterator[list[str]]:
    for file in files:
        shape, _ = read_shape(_module.DATA / file)
        truth, first = Truth(shape), None
        for program, (run, needed) in PROGRAMS.items():
            missing = [name for name in needed if importlib.util.find_spec(name) is None]
            if missing:
                yield [file, program, f"left out: no {missing[0]}", *[""] * 6]
                continue
            start = time.process_time()
            try:
                lines = run(shape)
            except Exception as error:  # of other programs
                yield [file, program, f"failed: {type(error).__name__}", *[""] * 6]
                continue
            yield row(file, program, lines, time.process_time() - start, truth)
            first = first or lines
        if blender is None:
            yield [file, "Blender's Skin modifier", "left out: no Blender", *[""] * 6]
        else:
            yield [file, "Blender's Skin modifier", skin_modifier(blender, shape, first), *[""] * 6]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--output", type=Path)
    parser.add_argument("--files", nargs="+", default=FILES)
    parser.add_argument("--blender", default=shutil.which("blender"))
    words = parser.parse_args()
    _module.tell(HEADER, table(words.files, words.blender), words.output)


if __name__ == "__main__":
    main()
