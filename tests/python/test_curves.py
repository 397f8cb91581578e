# SPDX-License-Identifier: GPL-3.0-or-later
"""Relaxed wires: smoothed, divided anew and fitted to the samples round them; and which of them run in round limbs."""

import math

import numpy as np
import pytest
from medial_axis.core.axis.compute import compute
from medial_axis.core.errors import DegenerateInputError
from medial_axis.core.settings import Form, SamplingMode, Settings, SkeletonSettings
from medial_axis.core.shape.shape import Shape
from medial_axis.core.skeleton.compute import compute_skeleton
from support import meshes, messy, resampled
from support.levels import betti_of_mesh, tips
from support.plates import prism
from support.shapes import SHAPES, Cyclide, RoundCone, frustum
from support.thick_meshes import block, pipe

pytestmark = pytest.mark.oracle

CLEAN = {"spacings": 1.0}
CURVE = {"sheet": math.inf}

# (shape, n, noise in spacings) -> distances of the vertices to the axis: mean, largest; of the middles of the wires:
# largest, None where not measured; how far the radius is off: largest
BARS = {
    ("torus", 2000, 0.0): (2.7e-5, 5.0e-5, 2.0e-4, 2.1e-5),
    ("torus", 8000, 0.0): (1.7e-6, 3.0e-6, 4.2e-5, 1.2e-6),
    ("torus", 20000, 0.0): (2.7e-6, 8.4e-6, 1.8e-5, 5.9e-6),
    ("torus", 8000, 0.1): (1.4e-3, 4.2e-3, 4.2e-3, 2.1e-3),
    ("torus", 2000, 0.1): (4.2e-3, 9.0e-3, None, 6.8e-3),
    ("capsule", 2000, 0.0): (3.3e-6, 1.4e-4, 1.4e-4, 3.9e-4),
    ("capsule", 8000, 0.0): (3.0e-7, 3.2e-5, 3.2e-5, 8.3e-5),
    ("capsule", 20000, 0.0): (6e-8, 6.5e-6, 6.5e-6, 2.9e-5),
    ("capsule", 8000, 0.1): (6.5e-4, 1.7e-3, None, 1.3e-3),
    ("capsule", 2000, 0.1): (1.5e-3, 3.6e-3, None, 3.2e-3),
    ("knot", 2000, 0.0): (5.3e-5, 2.4e-4, 9.2e-4, 1.3e-4),
    ("knot", 8000, 0.0): (3.6e-6, 1.8e-5, 1.1e-4, 9.0e-6),
    ("knot", 20000, 0.0): (3.5e-6, 2.3e-5, 3.5e-5, 1.3e-5),
    ("knot", 8000, 0.1): (2.3e-3, 6.6e-3, 6.6e-3, 4.2e-3),
    ("knot", 2000, 0.1): (7.4e-3, 2.6e-2, None, 4.4e-2),
}
SEEDS = {0.0: (0, 1, 2), 0.1: (0, 1)}
CASES = [
    pytest.param(*key, seed, marks=pytest.mark.slow if key[1] > 8000 else ())
    for key in BARS
    for seed in (SEEDS[key[2]] if key[1] <= 8000 else (0,))
]


def curve_of(hierarchy, name, **options):
    """Extracts the curve; for closed tubes only the closed curve, because noise gives spurs."""
    return hierarchy.extract(spacings=1.0, limb=0.04 if name == "capsule" else math.inf, **options)


def lengths(level, places):
    return np.linalg.norm(places[level.wires[:, 1]] - places[level.wires[:, 0]], axis=1)


@pytest.mark.parametrize("name, n, noise, seed", CASES)
def test_tubes_have_their_axes_and_radii(sampled, name, n, noise, seed):
    shape, _, hierarchy = sampled(name, n, seed, noise)
    level = curve_of(hierarchy, name, relaxed=True)
    assert len(level.generators) == 0 and level.betti == hierarchy.betti
    off = shape.axis_distance(level.vertices)
    middles = shape.axis_distance(level.vertices[level.wires].mean(axis=1))
    mean, largest, between, radius = BARS[name, n, noise]
    assert off.mean() < mean and off.max() < largest
    assert between is None or middles.max() < between
    true = shape.small if hasattr(shape, "small") else shape.radius
    assert np.abs(level.radius - true).max() < radius


def analysed(medial, shape, n, noise, seed=0):
    """Noise along the normals, at most so many spacings sqrt(area / n) either way."""
    points = shape.sample(n, seed)
    way = np.random.default_rng(seed).uniform(-noise, noise, (len(points), 1))
    points = points + way * math.sqrt(shape.area / len(points)) * shape.normals(points)
    return medial.MedialAnalysis(points)


@pytest.mark.parametrize(
    "n, noise, mean, largest",
    [(2000, 0.0, 4.5e-5, 1.5e-4), (8000, 0.0, 1.5e-5, 3.0e-5), (8000, 0.1, 1e-3, 3e-3)],
)
def test_bent_tube_of_changing_radius_has_its_axis(medial, n, noise, mean, largest):
    """Sections across this curve touch balls farther along it: parallel sections would leave a mean of 2.4e-3."""
    shape = Cyclide()
    hierarchy = analysed(medial, shape, n, noise).hierarchy()
    level = hierarchy.extract(**CURVE, limb=math.inf, relaxed=True)
    assert hierarchy.betti == level.betti == (1, 1, 0) and len(level.generators) == 0
    off = shape.axis_distance(level.vertices)
    assert off.mean() < mean and off.max() < largest
    assert np.abs(level.radius - shape.axis_radius(level.vertices)).max() < 0.6 * largest


@pytest.mark.parametrize("n", [2000, 8000])
def test_a_steep_cone_keeps_its_curve_under_noise(medial, n):
    """Near the apex the radius changes by more than the band of samples that count, within one spacing."""
    shape = frustum(0.8, 0.0, 0.8)
    hierarchy = analysed(medial, shape, n, 0.25).hierarchy()
    level = hierarchy.extract(**CLEAN, limb=0.04, relaxed=True, round_limbs=True)
    assert len(level.wires) > 40
    assert np.linalg.norm(level.vertices - (0.0, 0.0, 0.8), axis=1).min() < 0.15


@pytest.mark.parametrize("noise", [0.0, 0.25])
@pytest.mark.parametrize("seed", range(2))
def test_a_limb_that_begins_with_a_turn_is_whole(medial, noise, seed):
    """Noise bends the first wires of the thick end back: by its tip alone the limb went, with half of the axis."""
    shape = RoundCone()
    hierarchy = analysed(medial, shape, 8000, noise, seed).hierarchy()
    level = hierarchy.extract(**CURVE, limb=0.04, relaxed=True)
    x = level.vertices[:, 0] / shape.length
    assert x.min() < -0.9 and x.max() > 0.9
    assert np.bincount(level.wires.ravel()).max() == 2


def test_steps_are_a_quarter_of_the_spacing(sampled):
    shape, _, hierarchy = sampled("torus", 8000)
    level = curve_of(hierarchy, "torus", relaxed=True)
    steps = lengths(level, level.vertices)
    assert steps.mean() == pytest.approx(math.sqrt(shape.area / 8000) / 4, rel=0.1)
    assert steps.max() < 1.5 * steps.mean()


# --- what stays exact


@pytest.mark.parametrize("name", ["torus", "capsule", "knot"])
def test_exact_places_are_vertices_of_the_hierarchy(sampled, name):
    shape, _, hierarchy = sampled(name, 2000)
    raw, level = curve_of(hierarchy, name), curve_of(hierarchy, name, relaxed=True)
    assert np.array_equal(level.exact, hierarchy.vertices[level.vertex_of])
    assert np.isin(level.vertex_of, raw.vertex_of).all()
    points = shape.sample(2000, 0)
    nearest = np.linalg.norm(level.exact[:, None] - points, axis=2).min(axis=1)
    assert level.exact_radius == pytest.approx(nearest, rel=1e-12)
    # The exact places follow the curve: each new wire represents a piece of the old wires.
    steps = lengths(level, level.exact)
    assert steps.sum() < 1.001 * lengths(raw, raw.vertices).sum()
    assert steps.sum() > 0.9 * lengths(level, level.vertices).sum()


def channel():
    """A bar with a narrow channel along it: its two walls are thin, and so is the air between them."""
    profile = [(0, 0), (0.25, 0), (0.25, 0.5), (0.15, 0.5), (0.15, 0.1), (0.1, 0.1), (0.1, 0.5), (0, 0.5)]  # fmt: skip
    caps = [(0, 5, 7), (7, 5, 6), (0, 1, 4), (0, 4, 5), (1, 2, 4), (2, 3, 4)]
    return prism(profile, caps, 0.3)


def thrown(points, triangles, count, seed):
    rng = np.random.default_rng(seed)
    a, b, c = points[triangles].transpose(1, 0, 2)
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    row = rng.choice(len(triangles), count, p=areas / areas.sum())
    u, v = np.sort(rng.random((2, count)), axis=0)
    return (u * a[row].T + (v - u) * b[row].T + (1 - v) * c[row].T).T


@pytest.mark.parametrize("count", [100, 300])
@pytest.mark.parametrize("seed", range(3))
def test_exact_places_lie_inside(medial, count, seed):
    """Few samples: Voronoi edges between both walls of a channel pass through the air between them."""
    points, triangles = channel()
    samples = np.concatenate([points, thrown(points, triangles, count, seed)])
    hierarchy = medial.MedialAnalysis(samples, triangles, vertices=points).hierarchy()
    for limb in (0.0, 0.04):
        raw, level = (hierarchy.extract(**CURVE, limb=limb, relaxed=r) for r in (False, True))
        middles = raw.vertices[raw.wires].mean(axis=1)
        assert limb or (medial.winding_number(middles, points, triangles) < 0.5).any()
        assert (medial.winding_number(level.exact, points, triangles) > 0.5).all()


def test_values_of_new_wires_are_those_of_the_edges_they_stand_for(sampled):
    _, _, hierarchy = sampled("capsule", 2000)
    for chosen in (CLEAN, {"spacings": 1.0, "limb": 0.0}, CURVE):
        level = hierarchy.extract(relaxed=True, **chosen)
        assert np.array_equal(level.limb, hierarchy.edge_limb[level.edge_of])
        ends = hierarchy.edges[level.edge_of]
        middle = hierarchy.vertices[ends].mean(axis=1)
        shown = level.exact[level.wires].mean(axis=1)
        assert np.linalg.norm(middle - shown, axis=1).max() < 0.1
        assert np.linalg.norm(hierarchy.vertices[level.vertex_of] - level.exact, axis=1).max() < 0.1


def test_a_level_that_is_not_relaxed_is_exact(sampled):
    _, _, hierarchy = sampled("box", 2000)
    level = hierarchy.extract()
    assert np.array_equal(level.exact, level.vertices)
    assert np.array_equal(level.exact_radius, level.radius)
    assert np.array_equal(level.sheet, hierarchy.facet_sheet[level.facet_of])
    assert np.array_equal(level.erosion, hierarchy.facet_erosion[level.facet_of])
    assert np.array_equal(level.limb, hierarchy.edge_limb[level.edge_of])


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("noise", [0.0, 0.25])
@pytest.mark.parametrize("round_limbs", [False, True])
def test_topology_stays(sampled, name, noise, round_limbs):
    """The library counts on the level, and the test counts on the mesh."""
    _, _, hierarchy = sampled(name, 2000, 0, noise)
    b0, b1, b2 = hierarchy.betti
    for chosen in ({}, CLEAN, {"sheet": 0.02}, {"erosion": 0.01, "limb": 0.01}, CURVE,
                   {"sheet": math.inf, "limb": 0.0}, {"sheet": math.inf, "limb": math.inf}):  # fmt: skip
        level = hierarchy.extract(relaxed=True, round_limbs=round_limbs, **chosen)
        assert level.betti == hierarchy.betti, chosen
        assert level.hidden == 0
        assert betti_of_mesh(level) == (b0, b0 - b1 + b2), chosen
        used = np.concatenate((level.face_vertices, level.wires.ravel(), level.points))
        assert np.array_equal(np.unique(used), np.arange(len(level.vertices))), chosen
        assert np.isfinite(level.vertices).all() and (level.radius > 0).all()


def test_ends_at_facets_and_junctions_stay(sampled):
    _, _, hierarchy = sampled("slab", 2000)
    level = hierarchy.extract(relaxed=True, **CURVE)
    raw = hierarchy.extract(**CURVE)
    degree = np.bincount(level.wires.ravel(), minlength=len(level.vertices))
    joints = np.flatnonzero(degree > 2)
    assert len(joints)
    known = {tuple(v) for v in raw.vertices.tolist()}
    assert {tuple(v) for v in level.exact[joints].tolist()} <= known
    assert np.array_equal(level.vertices[joints], level.exact[joints])


def test_a_tube_of_few_samples_and_one_point_of_all(medial):
    """Too few samples determine no canal: the wires are smoothed only; a point stays a point."""
    angle = 2 * math.pi * np.arange(5) / 5
    ring = np.column_stack((np.cos(angle), np.sin(angle), 0 * angle))
    points = np.concatenate([ring + np.array([0, 0, 3.0 * z]) for z in range(4)])
    analysis = medial.MedialAnalysis(points, normals=np.ascontiguousarray(points * (1, 1, 0)))
    level = analysis.hierarchy().extract(relaxed=True, round_limbs=True, limb=0.0)
    assert np.abs(level.vertices[:, :2]).max() < 1e-9
    ball = SHAPES["ellipsoid"].random_sample(500, 0)
    one = medial.MedialAnalysis(ball).hierarchy()
    point = one.extract(**CURVE, limb=math.inf, relaxed=True, round_limbs=True)
    assert (len(point.wires), point.points.tolist()) == (0, [0])


# --- round limbs


def test_a_capsule_is_a_round_limb(sampled):
    _, _, hierarchy = sampled("capsule", 2000)
    assert tips(hierarchy.extract(relaxed=True, round_limbs=True, **CLEAN)) == 2


def test_the_curve_of_a_plate_is_no_round_limb(sampled):
    """Nothing joins, nothing is round: a point is left."""
    _, _, hierarchy = sampled("slab", 2000)
    assert tips(hierarchy.extract(**CURVE)) > 1
    level = hierarchy.extract(round_limbs=True, **CURVE)
    assert len(level.wires) == 0 and len(level.points) == 1


def test_round_limbs_are_part_of_all(sampled):
    """The option removes wires only: no facet is missing."""
    shed = 0
    for name, noise in (("oblate", 0.25), ("slab", 0.0), ("capsule", 0.0)):
        _, _, hierarchy = sampled(name, 2000, 0, noise)
        for chosen in ({}, {"limb": 0.0}, {**CLEAN, "limb": 0.0}, {**CURVE, "limb": 0.01}):
            every, some = hierarchy.extract(**chosen), hierarchy.extract(round_limbs=True, **chosen)
            assert np.array_equal(every.facet_of, some.facet_of)
            assert set(some.edge_of) <= set(every.edge_of)
            assert set(some.vertex_of) <= set(every.vertex_of)
            shed += len(every.wires) - len(some.wires)
    assert shed > 100


def of_mesh(data_file, name):
    mesh = messy.load(name, data_file)
    return resampled.by_the_addon(mesh).chosen.samples.analysis.hierarchy()


# Dangling wires of the clean form: cactus' arms are round, its like there is none on these scans but ridges.
@pytest.mark.parametrize("name", ["liver.ply", "hand_closed.obj", "fandisk_large.off"])
def test_ridges_grow_no_hair(data_file, name):
    hierarchy = of_mesh(data_file, name)
    level = hierarchy.extract(relaxed=True, round_limbs=True, **CLEAN)
    assert tips(level) == 0
    assert level.betti == hierarchy.betti


def test_round_arms_stay(data_file):
    hierarchy = of_mesh(data_file, "cactus.xyz")
    assert tips(hierarchy.extract(round_limbs=True, **CLEAN)) == 4


def four_legged():
    """A body, four legs, a tail and a neck, which pass through each other; where the six limbs end."""
    ends = [(0.9 * x, 0.3 * y, -1.2) for x in (-1, 1) for y in (-1, 1)]
    legs = [meshes.capsule((x, y / 1.2, 0.0), (x, y, z), 0.13) for x, y, z in ends]
    tail, neck = (-2.2, 0.0, 0.6), (1.7, 0.0, 0.9)
    body = meshes.capsule((-1, 0, 0), (1, 0, 0), 0.4), *legs
    rest = ((-1.0, 0.0, 0.1), tail, 0.1), ((1.0, 0.0, 0.1), neck, 0.2)
    mesh = meshes.join(*body, *(meshes.capsule(*one) for one in rest))
    return mesh, np.array([*ends, tail, neck])


def curve_tips(hierarchy, **options):
    """(t, 3) where a curve skeleton has its loose ends."""
    level = hierarchy.extract(**CURVE, **options)
    return level.vertices[np.bincount(level.wires.ravel()) == 1]


@pytest.mark.parametrize("count", [8000, 16000])
def test_a_four_legged_animal_with_a_tail_has_six_tips(count):
    """From 4 to 8 % of the diagonal, each where the axis of its limb ends; at 2 % there are a few where limbs join."""
    mesh, ends = four_legged()
    hierarchy = resampled.of_surface(mesh, count).chosen.samples.analysis.hierarchy()
    assert hierarchy.betti == (1, 0, 0)
    for limb, most in ((0.02, 12), (0.04, 6), (0.06, 6), (0.08, 6)):
        for relaxed in (False, True):
            found = curve_tips(hierarchy, limb=limb, relaxed=relaxed)
            assert 6 <= len(found) <= most, limb
            away = np.linalg.norm(found[:, None] - ends, axis=2)
            assert away.min(axis=0).max() < 0.05, limb


def test_each_leg_of_spot_has_its_tip(data_file):
    """Ears, horns, muzzle and tail are shorter: with them there are 11 to 6 tips from 4 to 8 %."""
    hierarchy = of_mesh(data_file, "spot_low.obj")
    feet = np.array([(x, -0.5, z) for x in (-0.2, 0.2) for z in (0.06, 0.78)])
    for limb, most in ((0.02, 40), (0.04, 12), (0.06, 8), (0.08, 7)):
        found = curve_tips(hierarchy, limb=limb, relaxed=True)
        assert 6 <= len(found) <= most, limb
        nearest = np.linalg.norm(found[:, None] - feet, axis=2).min(axis=0)
        assert (nearest < 0.15).all(), limb


@pytest.mark.parametrize("seed", range(4))
def test_wires_far_from_samples_that_nearly_coincide_are_not_divided_without_end(seed):
    """Triangles at random that pass through each other: where samples nearly coincide, their spacing is next to
    nothing, and the wires next to them are long."""
    vertices = np.random.default_rng(seed).normal(size=(54, 3))
    triangles = np.arange(54, dtype=np.int32).reshape(-1, 3)
    settings = Settings(samples=253, budget=1394, keep_vertices=True)
    axis = compute(vertices, triangles, settings).axis
    assert np.isfinite(axis.vertices).all() and len(axis.vertices) < 100_000


def test_a_solid_without_a_ball_has_an_empty_curve():
    """The only ball through the corners of a flat tetrahedron has its centre outside: there is no wire to cut."""
    points = np.array([(0.0, 0, 0), (1, 0, 0), (0, 1, 0), (0.3, 0.3, 0.05)])
    triangles = np.array([(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])
    wanted = Settings(form=Form.CURVE, sampling=SamplingMode.VERTICES)
    found = compute(points, triangles, wanted)
    assert len(found.axis.vertices) == 0 and "no facet passes" in found.warnings[-1]
    with pytest.raises(DegenerateInputError, match="found none"):
        compute_skeleton(Shape(points, triangles), wanted, SkeletonSettings())


@pytest.mark.parametrize("wall", [0.25, 0.1])
def test_the_curve_of_a_pipe_is_one_ring(wall):
    """Its walls are 3.5 and 1.4 spacings apart: Voronoi edges zigzag by more than the ball between them is wide."""
    settings = Settings(form=Form.CURVE, samples=4000, sampling=SamplingMode.SURFACE)
    axis = compute(*pipe(30, 0.5, 0.5, wall, 3.0), settings).axis
    ends = axis.vertices[axis.edges]
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum()
    assert length == pytest.approx(2 * math.pi * (0.5 - wall / 2), rel=0.02)
    assert np.bincount(axis.edges.ravel()).max() == 2


def test_the_skeleton_of_a_plate_has_five_branches():
    """A ridge in its middle, and a branch to each corner."""
    settings = Settings(samples=4000, sampling=SamplingMode.SURFACE)
    plate = Shape(*block(3.0, 2.0, 0.12))
    skeleton = compute_skeleton(plate, settings, SkeletonSettings()).skeleton
    assert (len(skeleton.branch_offsets) - 1, skeleton.tips, skeleton.loops) == (5, 4, 0)
