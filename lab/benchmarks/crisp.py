# SPDX-License-Identifier: GPL-3.0-or-later
"""Axes of solids whose faces are known exactly, measured to the last digit: a Markdown table.

    python3 lab/benchmarks/crisp.py [--output table.md] [--shapes box wedge] [--samples 4000 20000] [--seeds 0 1 2]
        [--form clean] [--float32] [--as-is] [--no-crisp | --shown]
    python3 lab/benchmarks/crisp.py --meshes fandisk_large.off [--samples 8000 20000] [--no-crisp]

Each mesh is turned at random by its seed, sampled as Sampling Surface does, and its axis computed with the default
settings. Rows: exact, the places of the Voronoi diagram; relaxed, what is shown without crisp places; crisp, what is
shown with them, where the product has them. docs/lab/crisp.md says what the columns are. Meshes are files of the data
folder; they are not turned, and what is known of their axes is measured only. Their bends are those of their sharp
convex edges round which the faces are convex, too: a reflex edge cut by a zigzag of triangles has others.
"""

import sys
import time

import _module
import numpy as np
from scipy.spatial import cKDTree

medial = _module.load()

import medial_axis  # noqa: E402  (found through _module)
from support import (  # noqa: E402
    crisp_measures,
    crisp_runs,
    crisp_solids,
    crossing_triangles,
    distance,
    meshes,
)

HEADER = ["shape", "samples", "seed", "places", "facets", "err mean/99/max", "r-d mean/max"]
HEADER += [
    "cov mean/99/max",
    "gap mean/max",
    "rim",
    "area - 1",
    "folds",
    "dents",
    "lines",
    "crossings",
    "pieces, Euler",
    "s",
]

MESH_HEADER = ["mesh", "samples", "facets", "r-d mean/99/max", "gap mean/95/max", "at bends"]
MESH_HEADER += ["turn mean/95", "folds", "crossings", "s"]
SHARP = 32.0  # degrees between the faces of an edge that has a gap
AROUND = 1.2, 3.0  # steps of the mesh to the faces that say whether it bends outwards at an edge


def rows(case: crisp_runs.Case, crisp: bool) -> list[list[str]]:
    start = time.perf_counter()
    made = case.made(crisp)
    seconds = time.perf_counter() - start
    kinds = {"crisp": False} if crisp else {"exact": True, "relaxed": False}
    found = []
    for places, exact in kinds.items():
        measures = cells(made.measured(exact))
        head = [case.name, str(made.samples), str(case.seed), places]
        found.append([*head, *measures, f"{seconds:.1f}"])
        print(" | ".join(found[-1]), file=sys.stderr, flush=True)
    return found


def cells(found: crisp_measures.Found) -> list[str]:
    return [
        str(found.facets),
        spread(found.err),
        f"{found.ball.mean:.1e} {found.ball.most:.1e}",
        spread(found.cov),
        "" if found.gap is None else f"{found.gap.mean:.2g} {found.gap.most:.2g}",
        f"{found.rim:.3f}",
        "" if found.area is None else f"{found.area:.1e}",
        str(found.folds),
        str(found.dents),
        str(found.lines),
        str(found.crossings),
        "{}, {}".format(*found.betti),
    ]


def spread(values: crisp_measures.Spread) -> str:
    return f"{values.mean:.1e} {values.p99:.1e} {values.most:.1e}"


def mesh_row(name: str, count: int, crisp: bool) -> list[str]:
    points, triangles = meshes.read(_module.DATA / name)
    start = time.perf_counter()
    made = medial_axis.compute(points, triangles, sampling="surface", samples=count, crisp=crisp)
    seconds = time.perf_counter() - start
    output = crisp_measures.output_of(made, np.eye(3))
    samples = len(made.chosen.samples.points)
    corners = points[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    spacing = np.sqrt(np.linalg.norm(normals, axis=1).sum() / (np.sqrt(3.0) * samples))
    sharp, faces = sharp_edges(points, triangles, normals)
    share = np.linspace(0.0, 1.0, 4)[:, None]
    places = points[sharp][:, :1] * (1.0 - share) + points[sharp][:, 1:] * share
    gap = distance.to_triangles(places.reshape(-1, 3), output.cells()).reshape(-1, 4) / spacing
    bends = bend_outwards(points, triangles, normals, sharp, faces)
    off = np.abs(output.radius - distance.to_triangles(output.vertices, corners))
    turns = crisp_measures.rim_turns(output)
    return [
        name,
        str(samples),
        str(len(output.across)),
        spread(crisp_measures.Spread.of(off / np.linalg.norm(np.ptp(points, axis=0)))),
        spread_of_gap(gap),
        spread_of_gap(gap[bends]),
        f"{turns.mean():.1f} {np.quantile(turns, 0.95):.0f}" if len(turns) else "",
        str(int(output.rings().folded().sum())),
        str(len(crossing_triangles.crossing_pairs(output.vertices, output.triangles))),
        f"{seconds:.1f}",
    ]


def spread_of_gap(gap) -> str:
    if not len(gap):
        return ""
    return f"{gap.mean():.2f} {np.quantile(gap, 0.95):.2f} {gap.max():.1f}"


def sharp_edges(points, triangles, normals):
    """(e, 2) ends and (e, 2) faces of the convex edges whose faces differ by more than `SHARP`."""
    normals = normals / np.linalg.norm(normals, axis=1)[:, None]
    sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    order = np.lexsort(sides.T[::-1])
    pair = np.flatnonzero((sides[order[1:]] == sides[order[:-1]]).all(axis=1))
    first, second = order[pair] // 3, order[pair + 1] // 3
    edges = sides[order[pair]]
    beyond = points[triangles[second]].mean(axis=1) - points[edges[:, 0]]
    sharp = np.einsum("ei,ei->e", normals[first], normals[second]) < np.cos(np.radians(SHARP))
    sharp &= np.einsum("ei,ei->e", normals[first], beyond) < 0.0
    return edges[sharp], np.column_stack((first, second))[sharp]


def bend_outwards(points, triangles, normals, edges, faces):
    """(e,) whether the faces `AROUND` an edge fall off to its two sides, as they do beside a convex edge.

    `normals` are as long as twice the area; the two sides are the faces whose normals are nearest to those of either
    face of the edge.
    """
    step = np.median(np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1))
    centres, middles = points[triangles].mean(axis=1), points[edges].mean(axis=1)
    tree = cKDTree(centres)
    outwards = np.zeros(len(edges), bool)
    for row, near in enumerate(tree.query_ball_point(middles, AROUND[1] * step)):
        near = np.array(near)
        away = np.linalg.norm(centres[near] - middles[row], axis=1) > AROUND[0] * step
        sides = _two_sides(normals[near[away]], normals[faces[row]])
        if sides is not None:
            size = np.linalg.norm(normals[near[away]], axis=1)
            low, high = (np.average(centres[near[away]][s], axis=0, weights=size[s]) for s in sides)
            outwards[row] = normals[near[away]][sides[0]].sum(axis=0) @ (high - low) < 0.0
    return outwards


def _two_sides(normals, seeds):
    """Two masks of normals, each nearer to its mean than to the other one; None if one is empty."""
    for _ in range(5):
        seeds = seeds / np.linalg.norm(seeds, axis=1)[:, None]
        first = normals @ seeds[0] > normals @ seeds[1]
        if first.all() or not first.any():
            return None
        seeds = np.array([normals[first].sum(axis=0), normals[~first].sum(axis=0)])
    return first, ~first


def main() -> None:
    parser = _module.parser(__doc__)
    names = crisp_solids.NAMES
    parser.add_argument("--shapes", nargs="+", default=list(names), choices=names)
    parser.add_argument("--meshes", nargs="+", help="files of the data folder, instead of shapes")
    parser.add_argument("--samples", nargs="+", type=int, default=[4_000, 20_000])
    parser.add_argument("--seeds", nargs="+", type=int, default=[0])
    parser.add_argument("--form", default="clean", choices=("clean", "curve"))
    parser.add_argument("--float32", action="store_true", help="round the vertices to float32")
    parser.add_argument("--as-is", action="store_true", help="do not turn the meshes")
    parser.add_argument("--no-crisp", action="store_true", help="leave crisp places out")
    parser.add_argument("--shown", action="store_true", help="only what is shown by default")
    options = parser.parse_args()
    if options.meshes:
        table = [
            mesh_row(name, count, not options.no_crisp)
            for name in options.meshes
            for count in options.samples
        ]
        _module.publish(_module.markdown(MESH_HEADER, table), options.output)
        return
    wanted = [False] if options.no_crisp else [False, True]
    wanted = wanted[-1:] if options.shown else wanted
    table = [
        row
        for name in options.shapes
        for count in options.samples
        for seed in options.seeds
        for crisp in wanted
        for row in rows(case_of(name, count, seed, options), crisp)
    ]
    _module.publish(_module.markdown(HEADER, table), options.output)


def case_of(name: str, count: int, seed: int, options) -> crisp_runs.Case:
    return crisp_runs.Case(
        name, count, seed, options.float32, as_is=options.as_is, form=options.form
    )


if __name__ == "__main__":
    main()
