# SPDX-License-Identifier: GPL-3.0-or-later
"""Would a Poisson surface, or the winding number of points, tell inside from outside better? Markdown tables.

    python3 lab/benchmarks/poisson_sides.py [--output tables.md] [--shapes torus ...] [--noise 0 0.25 ...]
        [--holes 0 0.15 ...] [--seeds 1] [--faces]

Ten exact shapes, as scans.py makes them, but with 4,000 samples, are prepared. A hole leaves out the points within so
many diagonals of the highest one. The same Clean axis is then extracted with the inside from

Normals      the exact normals, as Inside Decided By: Normals does
winding      the exact normals, by the winding number of points with the area of their neighbours, without lids
Poisson      the exact normals, by the winding number of Open3D's Poisson surface of depth 7
bare         points alone, as Inside Decided By: Automatic does
guessed      normals that Open3D guesses and turns along its spanning tree, as Inside Decided By: Normals does
P. guessed   the same normals, by the Poisson surface

and with --faces also from the Poisson surface instead of the points, with exact normals before Prepare.

The first table has a row per case, the second the means over the shapes. Jaccard: of the facets that are selected as
inner, against those whose vertices all lie in the exact solid. o->t and t->o: mean distance of the vertices of the axis
to the exact one, and of points of that to the axis, in percent of the diagonal. Betti numbers are bold where they are
wrong; the winding number has none, for nothing extracts an axis by it.
"""

import sys
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from itertools import groupby, product

import _module
import numpy as np
import scan_race
import scans
from medial_axis.core.samples.scan import prepared
from medial_axis.core.settings import Prepare, Settings
from medial_axis.core.shape.shape import Shape
from scipy.spatial import cKDTree
from scipy.spatial.distance import cdist
from support.measure import inner_facets

from lab.race.judge import distance_to
from lab.race.read_axis import Complex

MEDIAL = _module.load()
SIDES = MEDIAL.SidesFrom
COUNT, NEIGHBOURS, DEPTH, CHUNK = 4000, 16, 7, 500
HEADER = ["shape", "hole", "noise", "seed", "way", "Jaccard", "Betti", "o->t mean %", "t->o mean %"]
MEANS = ["hole", "noise", "way", "Jaccard", "least", "right", "of", "o->t mean %", "t->o mean %"]


@dataclass(frozen=True)
class Case:
    """Prepared points of a shape with exact and guessed normals, and the raw ones."""

    name: str
    hole: float
    noise: float
    seed: int
    raw: tuple[np.ndarray, np.ndarray]
    points: np.ndarray
    normals: np.ndarray

    @property
    def cells(self) -> list[str]:
        return [self.name, f"{self.hole:g}", f"{self.noise:g}", str(self.seed)]


@cache
def samples(name: str, seed: int) -> tuple[np.ndarray, float, np.ndarray]:
    """Clean samples, their spacing, and the exact normals."""
    shape = scans.SOLIDS[name][0]
    points, spacing = scans.noisy(shape, 0.0, seed, COUNT)
    return points, spacing, shape.normals(points)


def case_of(name: str, hole: float, noise: float, seed: int) -> Case:
    clean, spacing, normals = samples(name, seed)
    highest = clean[np.argmax(clean[:, 2] + 0.3 * clean[:, 0])]
    away = np.linalg.norm(clean - highest, axis=1) >= hole * scan_race.diagonal_of(clean)
    errors = np.random.default_rng((seed, 1)).normal(size=clean.shape)
    points, normals = (clean + errors * noise * spacing)[away], normals[away].copy()
    found = prepared(Shape(points, scans.NO_FACES, normals), Settings())[0]
    return Case(name, hole, noise, seed, (points, normals), found.points, found.normals)


def guessed(points: np.ndarray) -> np.ndarray:
    import open3d

    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(points.copy()))
    cloud.estimate_normals(open3d.geometry.KDTreeSearchParamKNN(NEIGHBOURS))
    cloud.orient_normals_consistent_tangent_plane(NEIGHBOURS)
    found = np.asarray(cloud.normals).copy()
    low, high = points.argmin(axis=0), points.argmax(axis=0)
    outward = found[high, range(3)].sum() >= found[low, range(3)].sum()
    return found if outward else -found


def poisson(points: np.ndarray, normals: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    import open3d

    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(points.copy()))
    cloud.normals = open3d.utility.Vector3dVector(normals.copy())
    mesh = open3d.geometry.TriangleMesh.create_from_point_cloud_poisson(cloud, depth=DEPTH)[0]
    faces = np.ascontiguousarray(np.asarray(mesh.triangles, np.int32))
    return np.asarray(mesh.vertices).copy(), faces


def winding(points: np.ndarray, normals: np.ndarray, places: np.ndarray) -> np.ndarray:
    """The winding number of points whose discs reach half of their seven nearest."""
    area = np.pi * cKDTree(points).query(points, 7)[0][:, 6] ** 2 / 6.5
    found, along = np.empty(len(places)), (points * normals).sum(axis=1)
    for start in range(0, len(places), CHUNK):
        at = places[start : start + CHUNK]
        height, away = along - at @ normals.T, cdist(at, points)
        found[start : start + CHUNK] = (height * area / away**3).sum(axis=1)
    return found / (4.0 * np.pi)


def jaccard(case: Case, chosen: set, all_of_it) -> str:
    exact = edges_of(all_of_it, inner_facets(all_of_it, scans.SOLIDS[case.name][0]))
    return f"{len(chosen & exact) / max(len(chosen | exact), 1):.4f}"


def edges_of(mesh, facets: np.ndarray) -> set:
    return set(map(tuple, mesh.generators[facets].tolist()))


def analysis_cells(case: Case, all_of_it, analysis) -> list[str]:
    chosen = analysis.edges[analysis.select(side=MEDIAL.Side.INNER)]
    cells = [jaccard(case, set(map(tuple, chosen.tolist())), all_of_it)]
    hierarchy = analysis.hierarchy()
    axis = hierarchy.extract(spacings=1.0, round_limbs=True, relaxed=True)
    polygons = axis.face_offsets.astype(np.int64), axis.face_vertices.astype(np.int64)
    alone = np.setdiff1d(np.arange(len(axis.vertices)), np.append(polygons[1], axis.wires))
    found = Complex(axis.vertices, *polygons, axis.wires.astype(np.int64), alone)
    return [*cells, *axis_cells(case, found, tuple(axis.betti))]


def axis_cells(case: Case, found: Complex, betti: tuple[int, int, int]) -> list[str]:
    shape, truth = scans.SOLIDS[case.name]
    size = scan_race.diagonal_of(samples(case.name, case.seed)[0]) / 100.0
    text = str(betti) if betti == truth else f"**{betti}**"
    there = shape.axis_distance(scan_race.some(found.vertices)).mean() / size
    back = distance_to(shape.axis_points(scan_race.TRUTH), found).mean() / size
    return [text, f"{there:.2f}", f"{back:.2f}"]


def rows_of(case: Case, faces: bool) -> Iterator[list[str]]:
    all_of_it = MEDIAL.MedialAnalysis(case.points, sides=SIDES.NONE).extract()
    guess = guessed(case.points)
    ways = {
        "Normals": {"normals": case.normals, "sides": SIDES.NORMALS},
        "Poisson": by_surface(poisson(case.points, case.normals)),
        "bare": {"sides": SIDES.AUTOMATIC},
        "guessed": {"normals": guess, "sides": SIDES.NORMALS},
        "P. guessed": by_surface(poisson(case.points, guess)),
    }
    for name, options in ways.items():
        yield [*case.cells, name, *cells_or_error(case, all_of_it, options)]
    inside = winding(case.points, case.normals, all_of_it.vertices) > 0.5
    facets = np.logical_and.reduceat(inside[all_of_it.face_vertices], all_of_it.face_offsets[:-1])
    share = jaccard(case, edges_of(all_of_it, facets), all_of_it)
    yield [*case.cells, "winding", share, "", "", ""]
    if faces:
        found = scan_race.axis_of(*poisson(*case.raw), Prepare.OFF)
        yield [*case.cells, "Poisson's faces", "", *axis_cells(case, found.shape, found.betti)]


def by_surface(surface: tuple[np.ndarray, np.ndarray]) -> dict:
    return {"vertices": surface[0], "triangles": surface[1], "sides": SIDES.SURFACE}


def cells_or_error(case: Case, all_of_it, options: dict) -> list[str]:
    try:
        return analysis_cells(case, all_of_it, MEDIAL.MedialAnalysis(case.points, **options))
    except MEDIAL.DegenerateInputError:
        return ["0.0000", "**nothing**", "", ""]


def means(rows: list[list[str]]) -> list[list[str]]:
    """One row for all shapes and seeds of a hole, a noise and a way."""
    keyed = sorted(rows, key=lambda row: (float(row[1]), float(row[2]), row[4]))
    found = []
    for key, group in groupby(keyed, lambda row: (row[1], row[2], row[4])):
        group = list(group)
        shares, there, back = ([float(row[k]) for row in group if row[k]] for k in (5, 7, 8))
        right = sum(bool(row[6]) and "**" not in row[6] for row in group) if there else ""
        least = f"{min(shares):.4f}" if shares else ""
        numbers = [mean(shares, 4), least, str(right), str(len(group)), mean(there), mean(back)]
        found.append([*key, *numbers])
    return found


def mean(numbers: list[float], digits: int = 2) -> str:
    return f"{np.mean(numbers):.{digits}f}" if numbers else ""


def main() -> None:
    parser = _module.parser(__doc__)
    parser.add_argument("--shapes", nargs="+", choices=list(scans.SOLIDS), default=scans.SOLIDS)
    parser.add_argument("--noise", nargs="+", type=float, default=[0.0, 0.25, 0.5, 1.0])
    parser.add_argument("--holes", nargs="+", type=float, default=[0.0, 0.15])
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--faces", action="store_true")
    wanted = parser.parse_args()
    seeds, rows = range(1, wanted.seeds + 1), []
    for name, hole, noise, seed in product(wanted.shapes, wanted.holes, wanted.noise, seeds):
        for cells in rows_of(case_of(name, hole, noise, seed), wanted.faces):
            print(*cells, sep=" | ", file=sys.stderr, flush=True)
            rows.append(cells)
    text = _module.markdown(HEADER, rows) + "\n" + _module.markdown(MEANS, means(rows))
    _module.publish(text, wanted.output)


if __name__ == "__main__":
    main()
