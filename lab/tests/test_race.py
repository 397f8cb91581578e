# SPDX-License-Identifier: GPL-3.0-or-later
"""The race's solids, judge and rivals against brute force, and what makes its page. No test looks at seconds."""

import math
import sys
from itertools import combinations

import numpy as np
import pytest

pytest.importorskip("tomllib", reason="Python has tomllib from 3.11 on")

import medial_axis

from lab.race import ROOT, betti, judge, product, read_axis, solids

NO_EDGES = np.empty((0, 2), int)


def complex_of(vertices, polygons=(), edges=NO_EDGES):
    return read_axis.complex_of(np.array(vertices, float), [np.array(p) for p in polygons], edges)


def test_a_package_that_is_known_stays():
    """Another one would leave the modules that are imported already without a parent."""
    product.load()
    assert sys.modules["medial_axis"] is medial_axis and hasattr(medial_axis, "core")


# --- the solids: brute force over dense random points of the surface


@pytest.fixture(scope="module")
def clouds():
    return {name: x.shape.random_sample(60_000, 5) for name, x in solids.SOLIDS.items()}


def nearest_two(points, cloud, apart):
    """Distance to the nearest of a cloud, and to the nearest one that is `apart` away from it."""
    from scipy.spatial import cKDTree

    tree = cKDTree(cloud)
    first, row = tree.query(points)
    second = np.empty(len(points))
    for i, p in enumerate(points):
        away = np.linalg.norm(cloud - p, axis=1)
        other = np.linalg.norm(cloud - cloud[row[i]], axis=1) > apart[i]
        second[i] = away[other].min()
    return first, second


@pytest.mark.parametrize("name", solids.SOLIDS)
def test_points_of_the_inner_axis_have_two_nearest_places_of_the_surface(name, clouds):
    solid = solids.SOLIDS[name]
    points = solid.shape.axis_points(25, 3)
    assert np.allclose(solid.shape.axis_distance(points), 0.0, atol=1e-6)
    assert solid.shape.inside(points).all()
    first, second = nearest_two(points, clouds[name], 0.2 * solid.shape.axis_radius(points))
    step = 2 * solid.spacing(60_000)
    exact = solid.shape.axis_radius(points)
    assert (np.abs(first - exact) < step).all()
    assert (
        second - first < step
    ).mean() > 0.9  # at rims and in sharp edges the two places come together


@pytest.mark.parametrize("name", solids.SOLIDS)
def test_points_off_the_inner_axis_have_one_nearest_place(name, clouds):
    """A ball round a point off the axis touches the surface in one place: what is as near lies round it."""
    solid, rng = solids.SOLIDS[name], np.random.default_rng(7)
    cloud = clouds[name]
    mixed = cloud[rng.integers(len(cloud), size=4000)] * rng.random((4000, 1)) ** 0.5
    mixed = mixed[solid.shape.inside(mixed)]
    step = solid.spacing(60_000)
    mixed = mixed[solid.shape.axis_distance(mixed) > 0.02][:40]
    assert len(mixed) == 40
    for p in mixed:
        away = np.linalg.norm(cloud - p, axis=1)
        near = cloud[away < away.min() + 0.3 * step]
        assert np.linalg.norm(near - near[0], axis=1).max() < 0.5


@pytest.mark.parametrize("name", ["torus", "holed plate", "cyclide", "shell", "eccentric shell"])
def test_points_of_the_outer_axis_have_two_nearest_places_of_the_surface(name, clouds):
    points = solids.outer_points(name, 15, 2)
    assert not solids.SOLIDS[name].shape.inside(points).any()
    assert np.allclose(solids.outer_distance(name, points), 0.0, atol=1e-6)
    first, _ = nearest_two(points, clouds[name], np.zeros(len(points)))
    _, second = nearest_two(points, clouds[name], 0.2 * first)
    assert (second - first < 2 * solids.SOLIDS[name].spacing(60_000)).mean() > 0.9


@pytest.mark.parametrize("name", ["round cone", "eccentric shell", "cyclide", "holed plate"])
def test_areas_normals_and_insides_of_the_new_solids(name, clouds):
    """By counting: the share of random places that are inside one step under the surface and outside one above it, and
    the volume by the divergence theorem and by counting."""
    shape, cloud = solids.SOLIDS[name].shape, clouds[name]
    normals = shape.normals(cloud)
    assert np.allclose(np.linalg.norm(normals, axis=1), 1.0)
    assert shape.inside(cloud - 1e-4 * normals).all()
    assert not shape.inside(cloud + 1e-4 * normals).any()
    flux = shape.area * np.einsum("ij,ij->i", cloud, normals).mean() / 3
    low, high = cloud.min(axis=0), cloud.max(axis=0)
    thrown = np.random.default_rng(1).uniform(low, high, (400_000, 3))
    counted = shape.inside(thrown).mean() * np.prod(high - low)
    assert flux == pytest.approx(counted, rel=0.02)


def test_measures_of_axes():
    """Areas and lengths by other ways: uniform points in a known rectangle, circles and segments."""
    plate = solids.SOLIDS["holed plate"]
    flat = np.random.default_rng(0).uniform((-1.2, -0.7), (1.2, 0.7), (200_000, 2))
    on = plate.shape.axis_distance(np.column_stack((flat, np.zeros(len(flat))))) == 0.0
    assert plate.area == pytest.approx(on.mean() * 2.4 * 1.4, rel=0.01)
    assert solids.SOLIDS["box"].area == pytest.approx(_area_by_projection(), rel=0.01)
    assert solids.SOLIDS["cylinder"].length == pytest.approx(1.0)
    assert solids.SOLIDS["cylinder"].area == pytest.approx(2 * math.pi * 0.5**2 * math.sqrt(2))
    assert solids.SOLIDS["torus"].length == pytest.approx(2 * math.pi)


def _area_by_projection():
    """The box's axis: the middle rectangle, and parts of planes at 45 degrees over what they project to."""
    x, y, z = 1.0, 0.7, 0.4
    middle = 4 * (x - z) * (y - z)
    along = 8 * math.sqrt(2) * z * ((x - z) + (y - z))
    corners = 12 * math.sqrt(2) * z * z
    return middle + along + corners


# --- the judge


def test_distances_are_those_of_a_loop():
    rng = np.random.default_rng(2)
    found = complex_of(
        rng.random((60, 3)),
        [rng.choice(50, 3, replace=False) for _ in range(40)],
        rng.integers(0, 60, (15, 2)),
    )
    points = rng.random((50, 3)) * 2 - 0.5
    exact = [min(_to_simplex(p, s) for s in judge.simplices_of(found)) for p in points]
    assert np.allclose(judge.distance_to(points, found), exact)


def _to_simplex(p, corners):
    """Least squares on every face of the simplex whose solution lies in it."""
    best = np.inf
    for size in (1, 2, 3):
        for rows in combinations(range(3), size):
            a, spans = corners[rows[0]], corners[list(rows[1:])] - corners[rows[0]]
            share = np.linalg.lstsq(spans.T, p - a, rcond=None)[0] if size > 1 else np.empty(0)
            if (share >= 0).all() and share.sum() <= 1:
                best = min(best, np.linalg.norm(a + share @ spans - p))
    return best


def test_betti_numbers_are_those_of_dense_elimination():
    rng = np.random.default_rng(3)
    for _ in range(40):
        found = complex_of(
            rng.random((9, 3)),
            [rng.choice(9, 3, replace=False) for _ in range(rng.integers(0, 40))],
            rng.integers(0, 9, (4, 2)),
        )
        assert betti.betti(found) == _by_elimination(found)


def _by_elimination(found):
    pairs = found.corner_edges.tolist() if found.faces else []
    edges = sorted({tuple(pair) for pair in pairs} | {tuple(pair) for pair in found.edges.tolist()})
    face = np.repeat(np.arange(found.faces), np.diff(found.offsets))
    second = np.zeros((len(edges), found.faces), int)
    for f, pair in zip(face, pairs, strict=True):
        second[edges.index(tuple(pair)), f] ^= 1
    first = np.zeros((len(found.vertices), len(edges)), int)
    for e, (p, q) in enumerate(edges):
        first[p, e] = first[q, e] = 1
    one, two = _dense_rank(first), _dense_rank(second)
    return len(found.vertices) - one, len(edges) - one - two, found.faces - two


def _dense_rank(matrix):
    matrix, rank = matrix.copy(), 0
    for column in range(matrix.shape[1]):
        rows = np.flatnonzero(matrix[rank:, column]) + rank
        if len(rows):
            matrix[[rank, rows[0]]] = matrix[[rows[0], rank]]
            others = np.flatnonzero(matrix[:, column])
            matrix[others[others != rank]] ^= matrix[rank]
            rank += 1
    return rank


def test_betti_numbers_of_known_surfaces():
    cube = [(0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5)]
    corners = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    assert betti.betti(complex_of(corners, cube)) == (1, 0, 1)
    assert betti.betti(complex_of(corners, cube[1:])) == (1, 0, 0)
    assert betti.betti(complex_of(corners, cube[2:])) == (1, 1, 0)
    assert betti.betti(complex_of(corners, [], np.array([(0, 1), (1, 2), (2, 0)]))) == (6, 1, 0)


def test_points_fall_by_area_and_strips(clouds):
    """A unit square, an edge of length 1 and a point far from each other, and a width of 1/2."""
    square = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    found = complex_of(
        [*square, (5, 0, 0), (6, 0, 0), (9, 0, 0)], [(0, 1, 2, 3)], np.array([(4, 5)])
    )
    points = judge.points_of(found, 0.5, 40_000)
    shares = [
        np.mean((points[:, 0] >= a) & (points[:, 0] <= b)) for a, b in ((0, 1), (5, 6), (9, 9))
    ]
    assert shares == pytest.approx(np.array([1.0, 0.5, 0.25]) / 1.75, abs=0.01)
    on_edge = points[(points[:, 0] >= 5) & (points[:, 0] <= 6), 0] - 5
    assert on_edge.mean() == pytest.approx(0.5, abs=0.01) and on_edge.std() == pytest.approx(
        12**-0.5, abs=0.01
    )


def test_exact_axes_have_no_error():
    """The core circle as edges; the rectangle as two triangles, and half of it."""
    turn = np.arange(20_000) * 2 * math.pi / 20_000
    circle = np.column_stack((np.cos(turn), np.sin(turn), 0 * turn))
    rows = np.arange(len(turn))
    score = judge.judge(
        "torus", complex_of(circle, [], np.column_stack((rows, np.roll(rows, -1)))), 2000
    )
    assert score.largest < 1e-6 and score.missed_largest < 1e-6 and score.betti == (1, 1, 0)
    assert score.length == pytest.approx(solids.SOLIDS["torus"].length, rel=1e-6)
    corners = np.array([(-1, -0.7, 0), (1, -0.7, 0), (1, 0.7, 0), (-1, 0.7, 0)])
    whole = judge.judge("slab", complex_of(corners, [(0, 1, 2, 3)]), 2000)
    assert whole.largest < 1e-12 and whole.missed_largest < 1e-12
    assert whole.area == pytest.approx(solids.SOLIDS["slab"].area)
    half = judge.judge(
        "slab", complex_of(corners * (0.5, 1, 1) - (0.5, 0, 0), [(0, 1, 2, 3)]), 2000
    )
    assert half.largest < 1e-12 and half.missed_largest == pytest.approx(1.0, abs=0.01)
    assert half.missed_mean == pytest.approx(0.25, abs=0.02)
    lifted = judge.judge("slab", complex_of(np.add(corners, (0, 0, 0.1)), [(0, 1, 2, 3)]), 2000)
    assert lifted.mean == pytest.approx(0.1) and lifted.largest == pytest.approx(0.1)


# --- files of anybody

VERTICES = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 5\n"
FILES = {
    "a.off": f"OFF\n5 2 0\n{VERTICES}4 0 1 2 3 255 0 0\n2 0 4\n",
    "b.off": f"COFF # coloured\n# text\n5 2 0\n{VERTICES}4 0 1 2 3\n2 4 0\n",
    "c.obj": "".join(f"v {row}\n" for row in VERTICES.splitlines())
    + "vn 0 0 1\nf 1//1 2//1 3//1 4//1\nl -5 -1\n",
    "d.ma": "5 2 2\n"
    + "".join(f"v {row} 0.5\n" for row in VERTICES.splitlines())
    + "e 0 1\ne 0 4\nf 0 1 2\nf 0 2 3\n",
    "e.ply": "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nproperty uchar red\n"
    f"element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n{VERTICES}"
    "4 0 1 2 3 200\n0 4\n",
}


@pytest.mark.parametrize("name", FILES)
def test_files_of_anybody_are_read(name, tmp_path):
    path = tmp_path / name
    path.write_text(FILES[name])
    found = read_axis.read(path)
    assert judge.areas(judge.triangles_of(found)).sum() == pytest.approx(1.0)
    assert found.vertices[found.edges[:, 0]].tolist() == [[0, 0, 0]]
    assert found.vertices[found.edges[:, 1]].tolist() == [[0, 0, 5]]
    assert len(found.points) == 0 and betti.betti(found) == (1, 0, 0)


@pytest.mark.parametrize("suffix", [".ma", ".ply", ".obj", ".off"])
@pytest.mark.parametrize("form", ["clean", "published"])
def test_our_files_are_read(suffix, form, tmp_path):
    import medial_axis

    points = solids.SOLIDS["cylinder"].shape.random_sample(600, 1)
    axis = medial_axis.compute(points, form=form).axis
    found = read_axis.read(medial_axis.write(axis, tmp_path / f"a{suffix}"))
    first = read_axis.read(medial_axis.write(axis, tmp_path / "b.obj"))
    places = [judge.areas(judge.triangles_of(x)).sum() for x in (found, first)]
    assert places[0] == pytest.approx(places[1], rel=0.2 if suffix == ".ma" else 1e-9)
    assert len(found.edges) == len(first.edges)
    assert betti.betti(found)[0] == betti.betti(first)[0]


@pytest.mark.parametrize("text", ["", "OFF\n3 1 0\n0 0 0\n", "OFF\n1 0 0\nnan 0 0\n"])
def test_what_is_no_axis_is_refused(text, tmp_path):
    (tmp_path / "a.off").write_text(text)
    with pytest.raises(read_axis.UnreadableError):
        read_axis.read(tmp_path / "a.off")


# --- the rivals, against brute force


@pytest.fixture(scope="module")
def rivals(study):
    from lab.race import rivals

    return rivals


@pytest.fixture(scope="module")
def torus(rivals):
    shape = solids.SOLIDS["torus"].shape
    points = np.ascontiguousarray(shape.random_sample(300, 4))
    return rivals.Samples(points, shape.normals(points))


def test_poles_are_the_farthest_voronoi_vertices(rivals, torus):
    """By Qhull's Voronoi diagram: the farthest vertex of each bounded cell, and the farthest against it."""
    from scipy.spatial import Voronoi

    found = torus.cells[1][rivals.pole_cells(torus)]
    diagram = Voronoi(torus.points)
    for i, p in enumerate(torus.points):
        region = diagram.regions[diagram.point_region[i]]
        if -1 in region:
            continue
        spans = diagram.vertices[region] - p
        first = spans[np.linalg.norm(spans, axis=1).argmax()]
        against = spans[spans @ first < 0]
        second = against[np.linalg.norm(against, axis=1).argmax()]
        for pole in (first, second):
            assert np.linalg.norm(found - p - pole, axis=1).min() < 1e-6


def test_smallest_balls_of_triangles(rivals):
    """By the Delaunay triangulation's own rule: half the longest side, or the circumradius by coordinates."""
    rng = np.random.default_rng(0)
    corners = rng.random((200, 3, 3))
    sides = np.sort(
        [
            np.linalg.norm(corners[:, i] - corners[:, j], axis=1)
            for i, j in ((0, 1), (0, 2), (1, 2))
        ],
        axis=0,
    )
    for triangle, ball in zip(corners, rivals._smallest_ball(sides.T), strict=True):
        best = np.inf
        for a, b in combinations(triangle, 2):
            middle = (a + b) / 2
            if np.linalg.norm(triangle - middle, axis=1).max() <= np.linalg.norm(a - middle) * (
                1 + 1e-9
            ):
                best = min(best, np.linalg.norm(a - middle))
        spans = triangle[1:] - triangle[0]
        share = np.linalg.solve(2 * spans @ spans.T, (spans**2).sum(axis=1))
        best = min(best, np.linalg.norm(share @ spans))
        assert ball == pytest.approx(best)


def test_lambda_keeps_what_its_samples_are_wide_enough_for(rivals, torus):
    """Every facet and edge by the samples that are nearest to the middle of it."""
    from scipy.spatial import cKDTree

    found = rivals.lambda_axis(torus, 0.1)
    wanted, tree = 0.1 * torus.diagonal, cKDTree(torus.points)
    assert len(found.edges) > 0 and len(found.offsets) > 1
    for a, b in found.vertices[found.edges]:
        three = torus.points[tree.query((a + b) / 2, k=3)[1]]
        sides = sorted(np.linalg.norm(p - q) for p, q in combinations(three, 2))
        assert rivals._smallest_ball(np.array([sides]))[0] >= wanted * (1 - 1e-9)
    for corners in np.split(found.corners, found.offsets[1:-1]):
        p, q = torus.points[tree.query(found.vertices[corners].mean(axis=0), k=2)[1]]
        assert np.linalg.norm(p - q) >= 2 * wanted * (1 - 1e-9)


def test_angle_and_length_hold_at_every_corner(rivals, torus):
    found = rivals.angle_length(torus, 60.0, 0.1)
    from scipy.spatial import cKDTree

    tree = cKDTree(torus.points)
    assert len(found.offsets) > 1
    for corners in np.split(found.corners, found.offsets[1:-1]):
        places = found.vertices[corners]
        p, q = torus.points[tree.query(places.mean(axis=0), k=2)[1]]
        assert np.linalg.norm(p - q) >= 0.1 * torus.diagonal * (1 - 1e-9)
        a, b = p - places, q - places
        angle = np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), (a * b).sum(axis=1))
        assert angle.min() >= math.radians(60.0) * (1 - 1e-9)


def test_tangent_polygons_reach_to_where_voronoi_edges_cross_them(rivals, torus, study):
    """Corners of the polygon are as far from p as from two other samples, and from no sample less."""
    vectors, _ = study.poles(torus.points)
    reach = rivals.polygon_reach(torus.points, vectors)
    for i in range(0, 300, 25):
        p, normal = torus.points[i], vectors[i] / np.linalg.norm(vectors[i])
        u = np.linalg.svd(normal[None])[2][1:]
        turn = np.arange(20_000) * 2 * math.pi / 20_000
        rays = np.column_stack((np.cos(turn), np.sin(turn))) @ u
        others = np.delete(torus.points, i, axis=0) - p
        along = rays @ others.T
        with np.errstate(divide="ignore"):
            ends = np.where(along > 0, (others**2).sum(axis=1) / (2 * along), np.inf)
        assert ends.min(axis=1).max() == pytest.approx(reach[i], rel=1e-2)


def test_shrunken_balls_are_empty_and_tangent(rivals, torus):
    found = rivals.shrinking_ball(torus)
    away = np.linalg.norm(found.vertices[:, None] - torus.points[None], axis=2)
    own = np.diagonal(away)
    assert (away.min(axis=1) >= own * (1 - 1e-6)).all()
    lines = (found.vertices - torus.points) / own[:, None]
    assert np.allclose(lines, -torus.normals)


def test_variants_with_nothing_replaced_are_the_method(rivals, torus, medial):
    mesh = medial.MedialAnalysis(torus.points).extract(side=medial.Side.INNER)
    assert len(rivals.variant(torus, False, False).offsets) == len(mesh.face_offsets)


def test_power_shape_is_dual_to_cells_that_meet(rivals, torus, tmp_path):
    """Every triangle has a point as far, by power, from its three balls, and from no other ball less."""
    few = rivals.Samples(np.ascontiguousarray(torus.points[::3]))
    rivals.write_off(rivals.power_shape(few), tmp_path / "a.off")
    found = read_axis.read(tmp_path / "a.off")
    balls = rivals.polar_balls(few)
    centres, weights, inner = balls[:, :3], balls[:, 3] ** 2, balls[:, 4] == 1
    assert found.faces > 0
    for corners in np.split(found.corners, found.offsets[1:-1]):
        rows = [np.linalg.norm(centres - c, axis=1).argmin() for c in found.vertices[corners]]
        assert inner[rows].all()
        assert _meet(centres, weights, rows)


def _meet(centres, weights, rows):
    """Along the line of equal powers of three balls: is a piece left that no other ball is nearer to?"""
    a, rest = centres[rows[0]], centres[rows[1:]] - centres[rows[0]]
    heights = ((rest**2).sum(axis=1) - weights[rows[1:]] + weights[rows[0]]) / 2
    start = np.linalg.lstsq(rest, heights, rcond=None)[0]
    way = np.cross(*rest)
    way /= np.linalg.norm(way)
    others = np.delete(centres, rows, axis=0) - a
    limit = (
        (others**2).sum(axis=1) - np.delete(weights, rows) + weights[rows[0]]
    ) / 2 - others @ start
    slope = others @ way
    with np.errstate(divide="ignore", invalid="ignore"):
        steps = limit / slope
    low, high = steps[slope < 0].max(initial=-np.inf), steps[slope > 0].min(initial=np.inf)
    return low <= high + 1e-7 and (limit[slope == 0] >= 0).all()


# --- recipes, runs and the page


def test_recipes_are_whole():
    from lab.race import recipes

    rows = recipes.read()
    assert len({row.name for row in rows}) == len(rows)
    assert {row.group for row in rows} == set(recipes.GROUPS)
    files = {name: ROOT / name for name in ("points", "oriented", "mesh", "output")}
    for row in rows:
        assert all("{" not in word for word in row.words(files, outer=True))
    absent = recipes.Recipe(
        "x", "peer", "points", ("no_such_program",), "a.off", needs=("no_such_program",)
    )
    assert absent.missing() == ["no_such_program"]
    with pytest.raises(ValueError, match="Expected a group"):
        recipes.Recipe("x", "mine", "points", (), "a.off")


SCRIPT = "import sys, pathlib; {body}; pathlib.Path(sys.argv[1]).write_text({text!r})"
SEGMENT = "OFF\n2 1 0\n-1 0 0\n1 0 0\n2 0 1\n"


def program(body="pass", text=SEGMENT, name="x", group="peer"):
    from lab.race import recipes

    words = (
        "{python}",
        "-c",
        SCRIPT.format(body=body, text=text).replace("{", "{{").replace("}", "}}"),
    )
    return recipes.Recipe(name, group, "points", (*words, "{output}"), "a.off")


def test_anybodys_program_is_run_and_judged(tmp_path):
    from lab.race import run

    inputs, case = run.Inputs(tmp_path), run.Case("capsule", 200, True)
    row = run.run(program("x = bytearray(100_000_000)"), case, inputs)
    assert row["largest"] < 1e-12 and row["missed_largest"] < 1e-12 and row["betti"] == (1, 0, 0)
    assert row["bytes"] > 100e6 and row["cpu"] > 0
    assert run.run(program(), case, inputs)["bytes"] < 60e6  # not what this process holds
    points = np.loadtxt(inputs.files(case, mesh=False)["oriented"])
    assert abs(len(points) - 200) <= 10 and points.shape[1] == 6
    off = np.abs(solids.SOLIDS["capsule"].shape.field(points[:, :3]))
    assert off.std() > 0.01 * solids.SOLIDS["capsule"].spacing(200)


@pytest.mark.parametrize(
    ("body", "text", "why"),
    [
        ("sys.exit(3)", SEGMENT, "exit code 3"),
        ("pass", "nothing", "Expected an axis"),
        ("import time; time.sleep(60)", SEGMENT, "took too long"),
    ],
)
def test_programs_that_fail_are_said(body, text, why, tmp_path):
    from lab.race import run

    row = run.run(program(body, text), run.Case("capsule", 200, False), run.Inputs(tmp_path), 2)
    assert why in row["failed"]


def rows_of(**others):
    """Ours, and one rival with other values."""
    own = {
        **{
            "solid": "slab",
            "size": 8000,
            "noisy": False,
            "outer": False,
            "program": "ours, clean",
            "group": "ours",
        },
        **{"mean": 1e-3, "p99": 4e-3, "largest": 1e-2, "missed_mean": 1e-3, "missed_largest": 1e-2},
        **{"betti": (1, 0, 0), "area": 2.8, "length": 0.0, "faces": 9, "edges": 0, "points": 0},
        **{"cpu": 0.2, "bytes": 4e7},
    }
    return [own, {**own, "program": "x", "group": "rival", **others}]


@pytest.mark.parametrize(
    ("others", "found"),
    [
        ({}, []),
        ({"mean": 9.5e-4}, []),
        ({"mean": 5e-4}, [("mean", "")]),
        ({"mean": 5e-4, "missed_mean": 2e-3}, [("mean", "missed, mean: 2.0e-03, ours 1.0e-03")]),
        ({"missed_mean": 5e-4, "betti": (1, 0, 9)}, [("missed_mean", "wrong topology")]),
        ({"mean": 5e-4, "area": 9.0}, [("mean", "3.2 times the area")]),
        ({"mean": 5e-4, "faces": 0}, [("mean", "loose points")]),
    ],
)
def test_who_is_better_and_at_what_price(others, found):
    from lab.race import compare

    assert [(x.measure, x.pays) for x in compare.losses(rows_of(**others))] == found


def test_the_page_keeps_what_people_wrote_and_shows_losses_first(tmp_path):
    import csv
    from xml.etree import ElementTree

    from lab.race import page

    path = tmp_path / "lab" / "page.md"
    path.parent.mkdir()
    path.write_text(f"words\n\n{page.MARK}\nold\n{page.END}\nmore words\n")
    failed = {**rows_of()[0], "program": "y", "group": "peer", "failed": "exit code 3"}
    page.write([*rows_of(mean=1e-4), failed], {"z": ["zz"]}, path)
    text = path.read_text()
    assert text.startswith(f"words\n\n{page.MARK}\n\n## Where somebody is better")
    assert (
        "old" not in text and "| slab | 8,000 | off, mean | x | 1.0e-04 | 1.0e-03 | 10.0 |" in text
    )
    assert "| y | exit code 3 | slab (8,000) |" in text and "z was skipped: `zz`" in text
    for name in ("race_mean.svg", "race_missed_mean.svg"):
        ElementTree.parse(tmp_path / "pictures" / name)
    files = {
        name: path.with_name(f"benchmark_{name}.csv").read_text() for name in ("losses", "accuracy")
    }
    assert files["losses"].count("\n") == 1  # nothing is at a price here
    assert "8000,clean,x,slab,1e-04,1e-03\n" in files["accuracy"]
    measures = path.with_name("benchmark_measures.csv").read_text().splitlines()
    assert len(measures) == 3 and len({len(row) for row in csv.reader(measures)}) == 1


def test_the_page_of_the_docs_explains_every_letter():
    from lab.race import compare, page

    text = (ROOT / "docs" / "lab" / "benchmark.md").read_text(encoding="utf-8")
    above, _, below = text.partition(page.MARK)
    assert below
    letters = {
        page.reason(compare.Loss({**row, "outer": outer}, row, measure, ""))
        for solid in solids.SOLIDS
        for outer in (False, True)
        for measure in (*compare.ACCURACY, *compare.COVERAGE)
        for row in [{**rows_of()[0], "solid": solid}]
    }
    for letter in letters:
        assert f"\n- **{letter}**" in above


def test_outer_axes_are_judged_in_the_box():
    """The line through the torus, far beyond it, and a huge sheet far away that does not count."""
    sheet = [(x, y, 50.0) for x in (-90, 90) for y in (-90, 90)]
    steps = np.linspace(-0.9, 0.9, 40)
    line = [(0.1, 0.0, z) for z in steps]
    rows = np.arange(4, 43)
    found = complex_of([*sheet, *line], [(0, 1, 3, 2)], np.column_stack((rows, rows + 1)))
    score = judge.judge("torus", found, 2000, outer=True)
    assert [score.mean, score.largest, score.missed_largest] == pytest.approx([0.1, 0.1, 0.1])
    assert score.betti is None


def test_the_commands_of_the_page(tmp_path):
    """The race itself, small; then the judge and a rival on what it made."""
    import json
    import subprocess

    def python(*words):
        command = [sys.executable, "-m", *map(str, words)]
        return subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout

    few = (
        "--sizes",
        200,
        "--solids",
        "torus",
        "--clean",
        "--programs",
        "ours, clean",
        "poles alone",
    )
    where = ("--folder", tmp_path, "--page", tmp_path / "page.md")
    python("lab.race", *few, *where)
    assert "\npoles alone," in (tmp_path / "benchmark_cost.csv").read_text()
    assert len((tmp_path / "rows.jsonl").read_text().splitlines()) == 2
    assert python("lab.race", *few, *where) == ""  # nothing is run again
    samples, axis = tmp_path / "inputs" / "torus_200.xyz", tmp_path / "axis.off"
    python("lab.race.rivals", "lambda", samples, axis, "radius=0.05")
    told = json.loads(python("lab.race.judge", "torus", axis, "--samples", 200))
    assert told["faces"] > 0 and 0 < told["mean"] < 0.4


# --- meshes


def test_the_exact_axis_of_a_box_scores_nothing():
    """Its sheets as triangles, with the rounding by which their common corners differ rounded off."""
    from lab.race import meshes

    solid = meshes.crisp_solids.solid("box")
    triangles = np.round(solids.SOLIDS["box"].shape.axis_triangles(), 14)
    found = complex_of(triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3))
    inputs = meshes.Inputs.__new__(meshes.Inputs)
    inputs.solid, inputs.frame, inputs.samples = solid, np.eye(3), 4000
    score = meshes.score(inputs, found)
    assert max(*score["off"], *score["missed"], score["gap"]) < 1e-12
    assert score["area"] == pytest.approx(1.0) and score["betti"] == (1, 0, 0)


def test_the_race_on_meshes(tmp_path):
    import subprocess

    words = [
        "--shapes",
        "box",
        "--samples",
        "400",
        "--programs",
        "ours, clean, faces",
        "poles alone",
    ]
    page = tmp_path / "page.md"
    command = [sys.executable, "-m", "lab.race.meshes", *words, "--page", str(page)]
    subprocess.run(command, cwd=ROOT, check=True, capture_output=True)
    rows = [line.split("|") for line in page.read_text().splitlines() if line.startswith("| ")]
    assert [row[1].strip() for row in rows[2:]] == ["ours, clean, faces", "poles alone"]
    assert 0 < float(rows[2][2].split(",")[0]) < 0.01 and "failed" not in page.read_text()
    written = page.with_suffix(".csv").read_text().splitlines()
    assert len(written) == 3 and written[2].startswith("box,poles alone,points,")
