# SPDX-License-Identifier: GPL-3.0-or-later
"""The hierarchy of the inner axis: one ordered collapse, all of whose levels have the topology of the solid."""

import math

import numpy as np
import pytest
from medial_axis.core.axis.compute import compute_axis
from medial_axis.core.files.read_shape import read_shape
from medial_axis.core.settings import Settings
from scipy.spatial import cKDTree
from support import collapse_reference, measure, meshes
from support.accuracy import BARS
from support.levels import Levels, betti_of_mesh, facet_pieces
from support.shapes import SHAPES

pytestmark = pytest.mark.oracle

THRESHOLDS = [
    {}, {"spacings": 1.0}, {"spacings": 2.0, "limb": 0.0}, {"sheet": 0.01},
    {"sheet": 0.05, "limb": math.inf}, {"erosion": 0.002}, {"erosion": 0.02, "limb": 0.01},
    {"sheet": 0.02, "erosion": 0.01, "limb": 0.1}, {"spike": 0.005},
    {"spike": 0.03, "sheet": 0.01, "limb": 0.0}, {"spike": math.inf}, {"sheet": math.inf},
    {"sheet": math.inf, "limb": 0.0}, {"sheet": math.inf, "limb": math.inf},
]  # fmt: skip

KEYS = ("sheet", "spacings", "erosion", "spike")  # of facets


def rings(count, around, apart):
    """Samples of a tube of radius 1 along z, in rings one above the other."""
    angle = 2 * math.pi * np.arange(around) / around
    ring = np.column_stack((np.cos(angle), np.sin(angle), 0 * angle))
    return np.concatenate([ring + np.array([0, 0, apart * row]) for row in range(count)])


def random_points(seed, count=None):
    """Anything: volumes, shells, grids with many cospherical cells, lines with one point aside."""
    r = np.random.default_rng(seed)
    n = count or int(r.integers(5, 60))
    kind = seed % 6
    if kind == 0:
        return r.uniform(-1, 1, (n, 3))
    if kind == 1:
        p = r.normal(size=(n, 3))
        return p / np.linalg.norm(p, axis=1)[:, None] * [1, 0.7, 0.4]
    if kind == 2:
        return np.unique(r.integers(0, 4, (n, 3)), axis=0).astype(float)
    if kind == 3:
        return rings(2 + seed % 5, 8, 1.0)
    if kind == 4:
        p = r.normal(size=(n, 3))
        return p / np.linalg.norm(p, axis=1)[:, None]
    t = np.sort(r.uniform(0, 1, n))
    return np.column_stack((t, t**2, t**3))


def analysed(medial, points, seed=0):
    """Sides by normals that point outward from the middle for a while, so that anything can be inside."""
    normals = points - points.mean(axis=0)
    if seed % 2:
        normals = np.random.default_rng(seed).normal(size=points.shape)
    return medial.MedialAnalysis(points, normals=np.ascontiguousarray(normals))


def assert_levels_hold(hierarchy, analysis, thresholds=THRESHOLDS):
    levels = Levels(hierarchy, analysis)
    for chosen in thresholds:
        alive = levels.alive(**chosen)
        assert levels.is_closed(alive), chosen
        assert levels.betti(alive) == hierarchy.betti, chosen
        level = hierarchy.extract(**chosen)
        assert level.betti == hierarchy.betti, chosen
        if level.hidden == 0:
            pieces, euler = betti_of_mesh(level)
            b0, b1, b2 = hierarchy.betti
            assert (pieces, euler) == (b0, b0 - b1 + b2), chosen


def reference(study, points, analysis, hierarchy):
    cells = study.delaunay(points)[0]
    c = collapse_reference.inner_complex(
        points, cells, hierarchy.cells, hierarchy.vertices, hierarchy.generators, hierarchy.edges
    )
    row = {tuple(e): i for i, e in enumerate(analysis.edges.tolist())}
    own = [row[g] for g in c.generators]
    weight = np.maximum(analysis.theta / (math.pi / 8), analysis.rho / 8)[own]
    selected = np.isin(own, analysis.select())
    sample = {int(p): i for i, p in enumerate(analysis.samples)}
    spacing = [analysis.spacing[[sample[p], sample[q]]].sum() / 2 for p, q in c.generators]
    return c, collapse_reference.Collapse(c, weight, selected, points, hierarchy.diagonal), spacing


def same(found, expected):
    """Up to the rounding of float32, and of sums of doubles."""
    found, expected = np.asarray(found, float), np.asarray(expected, float)
    stays = np.isinf(expected)
    if not np.array_equal(stays, np.isinf(found)):
        return False
    found, expected = found[~stays], expected[~stays]
    return bool(np.all(np.abs(found - expected) < 2e-6 * (1 + expected)))


@pytest.mark.parametrize("seed", [s for s in range(36) if s % 6 in (0, 1, 5)])
def test_values_are_those_of_the_definition(study, seed):
    points = random_points(seed)
    analysis = analysed(study, points, seed)
    hierarchy = analysis.hierarchy()
    c, collapse, spacing = reference(study, points, analysis, hierarchy)
    assert hierarchy.betti == collapse_reference.betti(c)
    assert sorted(hierarchy.bubbles) == sorted(c.bubbles)
    values = {
        "erosion": collapse.erosion(),
        "sheet": collapse.sheet([hierarchy.diagonal] * len(spacing)),
        "spacings": collapse.sheet(spacing),
    }
    for name, expected in values.items():
        kinds = zip(("facet", "edge", "vertex"), collapse.by_cell(expected), strict=True)
        for kind, of_kind in kinds:
            assert same(getattr(hierarchy, f"{kind}_{name}"), of_kind), (kind, name)
    _, edge, vertex = collapse.by_cell(collapse.limb())
    assert same(hierarchy.edge_limb, edge)
    assert same(hierarchy.vertex_limb, vertex)


def test_all_levels_of_random_and_degenerate_inputs_have_the_topology_of_the_complex(medial):
    met = 0
    for seed in range(120):
        try:
            analysis = analysed(medial, random_points(seed), seed)
        except medial.DegenerateInputError:
            continue
        hierarchy = analysis.hierarchy()
        met += hierarchy.betti != (1, 0, 0)
        assert_levels_hold(hierarchy, analysis)
    assert met > 8


# --- shapes with a known axis

# Facets of MEDIAL on clean samples that may be added as bridges.
MOST_ADDED = 3
# shape -> n -> distances of the vertices of the clean level to the axis, the other way round: largest
CURVES = {
    "torus": {2000: (4.4e-3, 3.3e-3), 8000: (1.1e-3, 8.1e-4)},
    "knot": {2000: (1.3e-2, 9.8e-3), 8000: (3.0e-3, 1.8e-3)},
    "capsule": {2000: (3.5e-3, 4.2e-2), 8000: (5.6e-4, 2.3e-2)},
}
# n -> how far the slope of the erosion thickness over the distance to the rim may be from 1; how far it may scatter
SLAB_EROSION = {2000: (3.1e-3, 2.9e-3), 8000: (1.2e-3, 8e-4)}


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("seed, noise", [(0, 0.0), (1, 0.0), (2, 0.0), (0, 0.1), (0, 0.25)])
def test_topology_of_known_solids(sampled, name, seed, noise):
    """The normals are those of the clean surface; noise of the spacing may tear thin solids, and the levels are like
    their complex."""
    _, analysis, hierarchy = sampled(name, 2000, seed, noise)
    assert noise or hierarchy.betti == SHAPES[name].betti
    assert_levels_hold(hierarchy, analysis)


@pytest.mark.parametrize(
    "name, noise", [("slab", 0.25), ("torus", 0.1), ("capsule", 0.0), ("box", 0.0)]
)
def test_levels_are_what_lies_above_their_thresholds(sampled, name, noise):
    """The values determine the drawn cells of a level, and a stricter level is part of a looser one."""
    _, analysis, hierarchy = sampled(name, 2000, 0, noise)
    levels = Levels(hierarchy, analysis)
    for chosen in THRESHOLDS:
        level, alive = hierarchy.extract(**chosen), levels.alive(**chosen)
        facets, wires, vertices = levels.drawn(alive)
        assert np.array_equal(np.sort(level.facet_of), facets), chosen
        assert np.array_equal(np.sort(level.edge_of), wires), chosen
        assert np.array_equal(np.sort(level.vertex_of), vertices), chosen
        for stricter in (*({key: 0.02} for key in KEYS), {"spacings": 3.0}, {"limb": 0.2}):
            both = {key: max(chosen.get(key, 0.0), stricter.get(key, 0.0)) for key in KEYS}
            both["limb"] = max(chosen.get("limb", 0.04), stricter.get("limb", 0.0))
            inner = hierarchy.extract(**both)
            assert np.isin(inner.facet_of, level.facet_of).all(), (chosen, stricter)
            assert np.isin(inner.vertex_of, level.vertex_of).all(), (chosen, stricter)


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("n", [2000, 8000, pytest.param(20000, marks=pytest.mark.slow)])
def test_level_zero_is_what_medial_selects_and_bridges(medial, sampled, name, n):
    """`extract` cannot draw the selected facets without area, of which tubes have hundreds. The sixteen levels above
    it are correct, too."""
    _, analysis, hierarchy = sampled(name, n)
    assert hierarchy.betti == SHAPES[name].betti and not Levels(hierarchy, analysis).wrong()
    level = {tuple(g) for g in hierarchy.extract(limb=0.0).generators.tolist()}
    drawn = {tuple(g) for g in analysis.extract(side=medial.Side.INNER).generators.tolist()}
    selected = {tuple(g) for g in analysis.edges[analysis.select()].tolist()}
    assert not drawn - level
    assert len(level - selected) <= MOST_ADDED


@pytest.mark.parametrize("name", CURVES)
@pytest.mark.parametrize("n", [2000, 8000])
def test_tubes_are_curves_on_their_axes(sampled, name, n):
    shape, _, hierarchy = sampled(name, n)
    curve = hierarchy.extract(spacings=1.0)
    assert len(curve.generators) == 0 and len(curve.wires) > 50
    there, back = CURVES[name][n]
    assert shape.axis_distance(curve.vertices).max() < there
    ends = curve.vertices[curve.wires]
    start, end = ends[:, None, 0], ends[:, None, 1]
    dense = (start + np.linspace(0, 1, 9)[:, None] * (end - start)).reshape(-1, 3)
    assert cKDTree(dense).query(shape.axis_points(2000, 1))[0].max() < back


def centroids(level):
    """(f, 3) of the area of each polygon."""
    sizes = np.diff(level.face_offsets)
    fans = measure.fan_triangles(level.vertices, level.face_offsets, level.face_vertices)
    area = np.linalg.norm(np.cross(fans[:, 1] - fans[:, 0], fans[:, 2] - fans[:, 0]), axis=1)
    of = np.repeat(np.arange(len(sizes)), sizes - 2)
    moments = fans.mean(axis=1) * area[:, None]
    total = np.bincount(of, area)
    return np.column_stack([np.bincount(of, moments[:, k]) / total for k in range(3)])


@pytest.mark.parametrize("n", SLAB_EROSION)
def test_erosion_of_a_slab_is_the_distance_to_its_rim(sampled, n):
    shape, _, hierarchy = sampled("slab", n)
    level = hierarchy.extract(limb=0.0)
    middle = centroids(level)
    to_rim = np.minimum(shape.width - np.abs(middle[:, 0]), shape.depth - np.abs(middle[:, 1]))
    thickness = hierarchy.facet_erosion[level.facet_of] * hierarchy.diagonal
    inner = to_rim > 0.1
    slope, offset = np.polyfit(to_rim[inner], thickness[inner], 1)
    scatter = np.std(thickness[inner] - slope * to_rim[inner] - offset)
    most, widest = SLAB_EROSION[n]
    assert abs(slope - 1) < most and scatter < widest


def test_limb_of_a_capsule_is_half_its_axis(sampled):
    shape, _, hierarchy = sampled("capsule", 8000)
    limb = hierarchy.vertex_limb[np.isfinite(hierarchy.vertex_limb)]
    assert limb.max() * hierarchy.diagonal == pytest.approx(shape.length, rel=0.03)


# (noise, shape) -> 99th percentile of the distances of the clean level's area to the axis; of curves the largest
NOISY = {
    (0.1, "oblate"): 1.1e-2, (0.1, "slab"): 3.2e-2, (0.1, "box"): 1.1e-2, (0.1, "torus"): 1.2e-2,
    (0.1, "knot"): 1.8e-2, (0.25, "oblate"): 4.1e-2, (0.25, "slab"): 5.0e-2,
    (0.25, "box"): 2.3e-2,
}  # fmt: skip


@pytest.mark.parametrize("noise, name", NOISY)
def test_clean_levels_of_noisy_solids(sampled, noise, name):
    shape, _, hierarchy = sampled(name, 8000, 0, noise)
    clean = hierarchy.extract(spacings=1.0, round_limbs=True, relaxed=True)
    if len(clean.generators):
        found = measure.errors(clean, shape).output_p99
    else:
        found = shape.axis_distance(clean.vertices).max()
    assert found < NOISY[noise, name]


SHEETS = ("ellipsoid", "oblate", "slab", "shell", "box")


@pytest.mark.parametrize("name", SHEETS)
@pytest.mark.parametrize("n", [2000, 8000])
def test_clean_sheets_are_as_good_as_published_ones(medial, sampled, name, n):
    """Exact places in every column, but for where random points of the output fall; shown ones within the bars."""
    shape, analysis, hierarchy = sampled(name, n)
    clean = {"spacings": 1.0, "round_limbs": True}
    published = measure.errors(analysis.extract(side=medial.Side.INNER), shape).row()
    exact = measure.errors(hierarchy.extract(**clean), shape).row()
    shown = measure.errors(hierarchy.extract(**clean, relaxed=True), shape).row()
    assert np.all(np.array(exact) < 1.05 * np.array(published))
    assert np.all(np.array(shown) < BARS[name][n])


# --- what is a point or a line


def test_axis_of_a_ball_is_one_point_with_its_radius(medial):
    vertices, triangles = meshes.icosphere(3, radius=2.0, centre=(1.0, 2.0, 3.0))
    level = medial.MedialAnalysis(vertices, triangles).hierarchy().extract()
    assert (len(level.generators), len(level.wires), level.points.tolist()) == (0, 0, [0])
    assert level.vertices == pytest.approx(np.array([[1.0, 2.0, 3.0]]), abs=1e-9)
    assert level.radius == pytest.approx([2.0], rel=1e-9)
    assert level.betti == (1, 0, 0)


def test_axis_of_a_tube_of_rings_is_a_line(medial):
    """Their facets have no area: extract has nothing to show for them."""
    points = rings(40, 16, 0.5)
    normals = np.ascontiguousarray(points * (1, 1, 0))
    analysis = medial.MedialAnalysis(points, normals=normals)
    assert len(analysis.extract(side=medial.Side.INNER).generators) == 0
    level = analysis.hierarchy().extract()
    assert len(level.generators) == 0 and len(level.wires) >= 30
    assert np.abs(level.vertices[:, :2]).max() < 1e-9
    assert np.ptp(level.vertices[:, 2]) > 17
    assert level.betti == (1, 0, 0)


# --- what it is asked


def test_level_zero_by_other_conditions(medial):
    """Thresholds of the hierarchy are those of extract."""
    analysis = medial.MedialAnalysis(SHAPES["oblate"].random_sample(3000, 0))
    inner = {"side": medial.Side.INNER}
    for chosen in (
        {"theta": 0.6, "rho": 4.0},
        {"rule": medial.Rule.BOTH},
        {"criteria": medial.Criteria.ANGLE},
        {"criteria": medial.Criteria.RATIO},
    ):
        selected = {tuple(g) for g in analysis.extract(**chosen, **inner).generators.tolist()}
        level = analysis.hierarchy(**chosen).extract(limb=0.0)
        assert selected and selected <= {tuple(g) for g in level.generators.tolist()}
        assert level.betti == (1, 0, 0)


def test_polygons_are_those_of_extract(medial):
    points = SHAPES["slab"].random_sample(2000, 0)
    analysis = medial.MedialAnalysis(points)
    mesh, level = analysis.extract(side=medial.Side.INNER), analysis.hierarchy().extract(limb=0.0)
    row = dict(zip(map(tuple, level.generators.tolist()), measure.polygons(level), strict=True))
    for g, corners in zip(mesh.generators.tolist(), measure.polygons(mesh), strict=True):
        own = [mesh.vertices[corners], level.vertices[row[tuple(g)]]]
        start = [np.lexsort(polygon.T)[0] for polygon in own]
        assert np.array_equal(*(np.roll(p, -s, axis=0) for p, s in zip(own, start, strict=True)))


def test_what_it_refuses(medial):
    points = SHAPES["slab"].random_sample(500, 0)
    analysis = medial.MedialAnalysis(points)
    for side in (medial.Side.OUTER, medial.Side.BOTH, medial.Side.CROSSING):
        with pytest.raises(medial.InvalidInputError, match="INNER"):
            analysis.hierarchy(side=side)
    with pytest.raises(medial.InvalidInputError, match="theta"):
        analysis.hierarchy(theta=-1.0)
    with pytest.raises(medial.InvalidInputError, match="NONE"):
        medial.MedialAnalysis(points, sides=medial.SidesFrom.NONE).hierarchy()
    hierarchy = analysis.hierarchy()
    for name in ("sheet", "spacings", "erosion", "limb"):
        for value in (-0.1, math.nan):
            with pytest.raises(medial.InvalidInputError, match=name):
                hierarchy.extract(**{name: value})


# --- real meshes, as one click samples them

MESHES = {
    "3holes.off": (1, 3, 0), "rocker-arm.off": (1, 1, 0), "knot1.off": (1, 1, 0),
    "hand_closed.obj": (1, 0, 0), "spot_low.obj": (1, 0, 0), "mannequin.off": (1, 0, 0),
    "fandisk_large.off": (1, 0, 0), "dilo.off": (1, 0, 0), "liver.ply": (1, 0, 0),
    "igea.ply": (1, 0, 0),
}  # fmt: skip
LARGE = ("liver.ply", "igea.ply")


@pytest.mark.parametrize(
    "name", [pytest.param(n, marks=pytest.mark.slow if n in LARGE else ()) for n in MESHES]
)
def test_real_meshes_have_their_topology_and_one_sheet_of_two_spacings(data_file, name):
    samples = compute_axis(read_shape(data_file(name))[0], Settings()).chosen.samples
    hierarchy = samples.analysis.hierarchy()
    assert tuple(hierarchy.betti) == MESHES[name]
    assert_levels_hold(hierarchy, samples.analysis, THRESHOLDS[1:9:3])
    assert facet_pieces(hierarchy.extract(spacings=2.0)) <= 1
