# SPDX-License-Identifier: GPL-3.0-or-later
"""The meshes of clean forms, as facets of the Voronoi diagram and even: a Markdown table.

    python3 lab/benchmarks/even_meshes.py [--output table.md] [--meshes spot_low.obj ...]

The default settings of the add-on. Faces; the least angle of each triangle, mean and 5 %; edges inside sheets at which
these turn by more than 120 degrees, per thousand; pairs of triangles that cross; by how many degrees rims turn at
places 0.5 % of the diagonal apart, mean and 95 %; the share of vertices whose balls touch the faces; pieces less loops
plus cavities as counted on the mesh and on the level; seconds of the processor to make the mesh. Meshes are files of
the data folder.
"""

import time
from collections.abc import Callable
from dataclasses import replace

import _module
import numpy as np

medial = _module.load()

import medial_axis  # noqa: E402  (found through _module)
from medial_axis.core.axis.levels import hierarchy_of  # noqa: E402
from support import crisp_measures, crossing_triangles, meshes  # noqa: E402

MESHES = ["hand_closed.obj", "spot_low.obj", "human_woman.obj", "stanford-bunny.obj"]
MESHES += ["fandisk_large.off", "rocker-arm.off", "3holes.off", "mannequin.off", "foot.off"]
MESHES += ["dilo.off", "club.off", "igea.ply"]
HEADER = ["mesh", "samples", "faces", "least angle", "turns", "crossings", "rim", "touch", "Euler"]
HEADER += ["mesh s"]
APART = 0.005  # of the diagonal, between the places at which the turn of a rim is measured


def rows(name: str) -> list[list[str]]:
    made = medial_axis.compute(*meshes.read(_module.DATA / name))
    count = f"{len(made.chosen.samples.points):,}"
    found = []
    for mesh in ("even", "voronoi"):
        axis = medial_axis.extract(made, mesh=mesh)
        output = crisp_measures.output_of(replace(made, axis=axis), np.eye(3))
        cost = f"{seconds(made):.2f}" if mesh == "even" else ""
        found.append([f"{name.rpartition('.')[0]} {mesh}", count, *cells(axis, output), cost])
    return found


def seconds(made: medial_axis.Computation) -> float:
    """Seconds of the processor to make the even mesh."""
    hierarchy = hierarchy_of(made.chosen.samples, made.settings, None)
    start = time.process_time()
    hierarchy.even(spacings=1.0, round_limbs=True, crisp=True)
    return time.process_time() - start


def cells(axis, output) -> list[str]:
    triangles, places = output.triangles, output.vertices
    angles = least_angles(places[triangles])
    turns = sheet_turns(places, triangles)
    diagonal = float(np.linalg.norm(np.ptp(places, axis=0)))
    rims = rim_turns(places, crisp_measures.rim_edges(output), APART * diagonal)
    pieces, loops, cavities = axis.level.betti
    edges = {tuple(sorted(pair)) for row in triangles for pair in zip(row, np.roll(row, 1))}
    used = len(np.unique(triangles)) - len(edges) + len(triangles)
    lone = len(places) - len(np.unique(triangles)) - len(axis.edges)
    return [
        f"{axis.facets:,}",
        f"{angles.mean():.0f} {np.quantile(angles, 0.05):.0f}",
        f"{1000 * np.mean(turns > 120.0):.1f}",
        f"{len(crossing_triangles.crossing_pairs(places, triangles)):,}",
        f"{rims.mean():.1f} {np.quantile(rims, 0.95):.0f}" if len(rims) else "",
        f"{np.mean(axis.level.is_crisp):.0%}",
        f"{used + lone}, {pieces - loops + cavities}",
    ]


def least_angles(corners):
    """(m,) degrees"""
    ways = np.roll(corners, -1, axis=1) - corners
    back = np.roll(ways, 1, axis=1)
    sizes = np.linalg.norm(ways, axis=2) * np.linalg.norm(back, axis=2)
    cosine = -np.einsum("mij,mij->mi", ways, back) / np.maximum(sizes, 1e-300)
    return np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))).min(axis=1)


def sheet_turns(places, triangles):
    """Degrees by which sheets turn at the edges of exactly two triangles."""
    normals = np.cross(*(places[triangles[:, i]] - places[triangles[:, 0]] for i in (1, 2)))
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
    ends = np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)])
    forth = np.where(ends[:, 0] < ends[:, 1], 1.0, -1.0)
    order = np.lexsort(np.sort(ends, axis=1).T[::-1])
    _, first, uses = np.unique(
        np.sort(ends, axis=1)[order], axis=0, return_index=True, return_counts=True
    )
    one, two = order[first[uses == 2]], order[first[uses == 2] + 1]
    rows = len(triangles)
    cosine = np.einsum("ei,ei->e", normals[one % rows], normals[two % rows])
    return np.degrees(np.arccos(np.clip(-cosine * forth[one] * forth[two], -1.0, 1.0)))


def rim_turns(places, edges, apart: float):
    """Degrees by which rims turn at places that are so far apart along them."""
    found = [np.zeros(0)]
    for path in paths(edges):
        line = places[path]
        along = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))))
        steps = int(along[-1] / apart)
        if steps < 3:
            continue
        at = np.linspace(0.0, along[-1], steps + 1)
        ways = np.diff(
            np.column_stack([np.interp(at, along, line[:, i]) for i in range(3)]), axis=0
        )
        ways /= np.maximum(np.linalg.norm(ways, axis=1), 1e-300)[:, None]
        cosine = np.einsum("si,si->s", ways[1:], ways[:-1])
        found.append(np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))))
    return np.concatenate(found)


def paths(edges) -> list[list[int]]:
    """The lines of some edges, from one vertex that has not two of them to the next; then the closed ones."""
    beside: dict[int, list[int]] = {}
    for a, b in edges.tolist():
        beside.setdefault(a, []).append(b)
        beside.setdefault(b, []).append(a)
    left, found = {tuple(pair) for pair in edges.tolist()}, []
    for start in sorted(beside, key=lambda v: (len(beside[v]) == 2, v)):
        for step in beside[start]:
            path = [start]
            while (pair := tuple(sorted((path[-1], step)))) in left:
                left.remove(pair)
                path.append(step)
                if len(beside[step]) != 2:
                    break
                step = next(v for v in (*beside[step], step) if v != path[-2])
            if len(path) > 1:
                found.append(path)
    return found


def main(page: str | None, header: list[str], rows: Callable[[str], list[list[str]]]) -> None:
    """Make a table with these rows for each mesh; `page` is the text of the help."""
    parser = _module.parser(page)
    present = [name for name in MESHES if (_module.DATA / name).is_file()]
    parser.add_argument("--meshes", nargs="+", default=present)
    options = parser.parse_args()
    _module.tell(header, (row for name in options.meshes for row in rows(name)), options.output)


if __name__ == "__main__":
    main(__doc__, HEADER, rows)
