# SPDX-License-Identifier: GPL-3.0-or-later
"""Thickness and gaps of solids whose thickness is known, from coarse meshes, clouds and noise, judged by exact figures,
by rays and by shrinking balls."""

import csv
import json
from dataclasses import replace

import numpy as np
import pytest
from medial_axis.core.errors import ExportError
from medial_axis.core.settings import (
    Between,
    Edges,
    Noise,
    Prepare,
    SamplingMode,
    Settings,
    ThicknessSettings,
)
from medial_axis.core.thickness.fine_faces import coarse_faces, cut_faces
from medial_axis.core.thickness.thickness import measure_thickness
from medial_axis.core.thickness.thin_parts import find_thin_parts
from medial_axis.core.thickness.write_thickness import export_thickness
from support import inputs, meshes, resampled, thin_solids, topology
from support.meshes import join, lattice, shape_of
from support.plates import prism
from support.thick_meshes import TETRAHEDRON, block, ellipsoid, lathe, rays, shell, shrinking_ball

pytestmark = pytest.mark.oracle

EVEN = Settings(sampling=SamplingMode.SURFACE)
BY_VERTICES = Settings(sampling=SamplingMode.VERTICES)
BOX = block(1.0, 0.7, 0.4)
STAIRS = thin_solids.union(*(((k, 0, 0), (k + 1, 1, 0.1 * (k + 1))) for k in range(3)))
GAP = join(block(1.0, 0.7, 0.4), block(1.0, 0.7, 0.4, (0.0, 0.0, 0.45)))


def measure(mesh, settings=EVEN, normals=None, **wanted):
    return measure_thickness(shape_of(mesh, normals), settings, ThicknessSettings(**wanted))


def errors(lengths, truth):
    """1st, 5th, 50th and 95th percentile of the relative error."""
    return np.percentile(lengths / truth - 1, [1, 5, 50, 95])


def assert_bars(lengths, truth):
    _, low, median, high = errors(lengths, truth)
    assert abs(median) < 0.005 and low > -0.03 and high < 0.03


def moved(mesh, scale, seed, mirror=False):
    vertices, triangles = mesh
    turn = inputs.rotation(seed) if seed else np.identity(3)
    vertices = scale * vertices @ turn.T
    return meshes.flip((vertices * (-1, 1, 1), triangles)) if mirror else (vertices, triangles)


def single(mesh, seed=0):
    """The mesh turned, with coordinates rounded as meshes store them."""
    vertices, triangles = moved(mesh, 1.0, seed)
    return vertices.astype(np.float32).astype(float), triangles


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=1)[:, None]


# --- exact shapes


@pytest.mark.parametrize("scale, seed, mirror", [(1, 0, 0), (1e-3, 1, 0), (1e3, 2, 1), (2, 0, 1)])
@pytest.mark.parametrize("thickness", [0.4, 0.05, 0.02])
def test_plates_from_eight_vertices(thickness, scale, seed, mirror):
    found = measure(moved(block(1.0, 0.7, thickness), scale, seed, mirror), Settings())
    assert_bars(found.lengths, thickness * scale)
    assert errors(found.lengths, thickness * scale)[0] > -0.05
    assert found.of_triangles.min() > 0.95 * thickness * scale


CYLINDER = lathe([(0, 0), (0.5, 0), (0.5, 2.0), (0, 2.0)])


@pytest.mark.parametrize("mesh, truth", [(shell(), 0.2), (CYLINDER, 1.0)])
def test_round_walls(mesh, truth):
    assert_bars(measure(mesh).lengths, truth)


def test_cone():
    """A ball inside a cone with half-angle a, that touches it at radius r, has the diameter 2 r / cos(a)."""
    angle, height = np.radians(20.0), 2.0
    rings = np.linspace(0.0, height, 41)[:-1]
    found = measure(
        lathe([(0, 0), *((np.tan(angle) * (height - z), z) for z in rings), (0, height)])
    )
    radius = np.hypot(found.points[:, 0], found.points[:, 1])
    truth = 2 * radius / np.cos(angle)
    z = found.points[:, 2]
    above = z - radius * np.tan(angle) - truth / 2 > 0.0  # the ball does not reach the base
    some = above & (z > 0.02) & (radius > 0.1) & ~found.at_edge
    assert some.sum() > 3000
    assert_bars(found.lengths[some], truth[some])


def dense_ellipsoid(axes, count=300_000):
    return unit(np.random.default_rng(5).normal(size=(count, 3))) * axes


def test_ellipsoid_against_shrinking_balls():
    """Balls everywhere; walls where the two normals of the ball differ by 120 degrees or more."""
    axes = np.array([1.0, 0.7, 0.5])
    surface = dense_ellipsoid(axes)
    balls, walls = measure(ellipsoid(axes), edges=Edges.BALL), measure(ellipsoid(axes))
    some = np.random.default_rng(1).choice(len(balls.points), 400, replace=False)
    points = balls.points[some] / np.sqrt(((balls.points[some] / axes) ** 2).sum(axis=1))[:, None]
    normals = unit(points / axes**2)
    truth, touched = shrinking_ball(points, normals, surface)
    assert_bars(balls.lengths[some], truth)
    assert np.abs(balls.lengths[some] / truth - 1).mean() < 0.004
    wall = (normals * unit(surface[touched] / axes**2)).sum(axis=1) < -0.52
    assert wall.sum() > 100
    assert_bars(walls.lengths[some][wall], truth[wall])
    assert (walls.lengths[some] > 0.99 * truth).all(), "what is filled is no less than the ball"


WEDGE = prism([(0, 0), (1, 0), (0.94, 0.342)], [(0, 1, 2)], 0.7)


def widths_in_convex(points, faces, mesh):
    """(n,) the largest ball that touches a place of a face and no other plane, in closed form."""
    vertices, triangles = mesh
    normals = topology.unit_normals(vertices, triangles)
    apart = 1.0 - normals[faces] @ normals.T
    away = (normals * vertices[triangles[:, 0]]).sum(axis=1) - points @ normals.T
    with np.errstate(divide="ignore", invalid="ignore"):
        return 2 * np.where(apart > 1e-9, away / apart, np.inf).min(axis=1)


@pytest.mark.parametrize("mesh", [block(1, 0.7, 0.05), BOX, WEDGE], ids=["plate", "box", "wedge"])
def test_balls_between_flat_faces_are_exact_up_to_the_edges(mesh):
    mesh = single(mesh, 3)
    found = measure(mesh, edges=Edges.BALL)
    inside = ~found.at_edge
    truth = widths_in_convex(found.points[inside], found.surface.faces[inside], mesh)
    np.testing.assert_allclose(found.lengths[inside], truth, rtol=1e-4, atol=1e-6)
    walls = measure(mesh)
    assert (walls.lengths[inside] >= (1 - 1e-6) * found.lengths[inside]).all()


def test_a_narrow_lip_is_as_thick_as_the_ball_at_its_edge():
    """All corners of its triangles lie on edges, most of which have the thickness of the wall beside it."""
    outline = [(7, 0), (7, 8), (3.95, 8), (3.95, 7.8), (4, 7.8), (4, 0)]
    found = measure(meshes.revolved(outline, 48), Settings())
    middle = found.points[found.triangles].mean(axis=1)
    below = (np.hypot(*middle[:, :2].T) < 4.0) & (np.abs(middle[:, 2] - 7.8) < 1e-9)
    assert below.sum() > 100
    # The lip is narrower than high, so no ball at its lower face reaches the upper one. The least ball between walls
    # touches the upper face, the inner one and the edge below: (r - 0.05)^2 + (r - 0.2)^2 = r^2.
    least = 2 * (0.25 - np.sqrt(0.25**2 - 0.05**2 - 0.2**2))
    assert least <= found.minimum < 1.1 * least
    assert (found.of_triangles[below] >= least).all()


def rounded_disc(thickness=5.0, radius=60.0, edge=1.5):
    turn = np.linspace(0.0, np.pi / 2, 7)
    inner, low = radius - edge + edge * np.sin(turn), edge - edge * np.cos(turn)
    profile = [*zip(inner, low, strict=True), *zip(inner[::-1], thickness - low[::-1], strict=True)]
    return lathe([(0.0, 0.0), *profile, (0.0, thickness)])


def test_flat_faces_stay_flat_beside_bevels(medial):
    """In the thickness, and where the smooth surface is sampled."""
    mesh = rounded_disc()
    found = measure(mesh, Settings())
    flat = np.hypot(*found.points[:, :2].T) < 57.0
    assert flat.sum() > 1000 and found.lengths[flat] == pytest.approx(5.0, rel=1e-6)
    samples = medial.sample_surface(*mesh, count=4000, smooth=True)
    flat = np.hypot(*samples.points[:, :2].T) < 58.0
    assert np.abs(np.abs(samples.points[flat, 2] - 2.5) - 2.5).max() < 1e-9


def bent_bar(segments, thickness=0.02, width=0.04, fillet=0.002):
    """A flat bar with rounded edges, bent about an axis at a distance of 1."""
    turn = np.linspace(0.0, np.pi / 2, 4)
    across = width / 2 - fillet + fillet * np.sin(turn)
    right = np.column_stack((across, thickness / 2 - fillet * (1 - np.cos(turn))))
    right = np.concatenate((right, right[::-1] * (1, -1)))
    z, off = np.concatenate((right, -right)).T
    rings = [
        np.column_stack(((1 + off) * np.sin(a), (1 + off) * np.cos(a), z))
        for a in np.linspace(-0.5, 0.5, segments + 1)
    ]
    a = np.arange(len(rings) * len(z)).reshape(len(rings), -1)
    walls = lattice(np.pad(a, ((0, 0), (0, 1)), "wrap").T)
    fan = np.array([(0, k, k + 1) for k in range(1, len(z) - 1)])
    return np.concatenate(rings), np.concatenate((walls, fan[:, ::-1], fan + a[-1, 0]))


@pytest.mark.parametrize("segments", [16, 40])
def test_flat_faces_stay_flat_where_a_bar_with_bevels_is_bent(segments):
    """Two large faces meet at each vertex, beside small ones."""
    found = measure(bent_bar(segments), Settings())
    x, y, z = found.points.T
    middle = (np.abs(z) < 0.014) & (np.abs(np.arctan2(x, y)) < 0.4) & ~found.at_edge
    assert middle.sum() > 5000
    assert np.abs(found.lengths[middle] / 0.02 - 1).max() < 1e-3


@pytest.mark.parametrize("around, across, turn", [(100, 16, 0.5), (250, 60, 0.5), (4400, 14, 0.0)])
def test_rows_of_a_ring_are_no_walls(around, across, turn):
    """Rows on top of it are flat, or so long that each of their triangles lies in the next one's plane."""
    mesh = single(meshes.torus(1.0, 0.2, around, across, turn), 3)
    found = measure(mesh, BY_VERTICES, edges=Edges.BALL)
    assert errors(found.lengths, 0.4)[0] > -0.03
    assert np.mean(np.abs(found.lengths / 0.4 - 1)) < 0.015


def sphere_of_rows(rows, around, axes=(1.0, 1.0, 1.0)):
    latitudes = np.concatenate(([0.0], np.cumsum(rows))) * np.pi / np.sum(rows)
    vertices, triangles = lathe([(np.sin(x), -np.cos(x)) for x in latitudes], around)
    return vertices * axes, triangles


def capsule_of_rows(rows=16, around=48):
    turn = np.pi / 2 * np.minimum(1.0, np.append(0.0, (np.arange(rows) + 0.5) / (rows - 0.5)))
    low = [(np.sin(x), -1.0 - np.cos(x)) for x in turn]
    return lathe([*low, *((r, -z) for r, z in low[::-1])], around)


def torus_of_rows(around=60, across=24, jitter=0.25):
    """A tube of radius 0.2 with random rows, bent to a ring of radius 1."""
    random = np.random.default_rng(4)
    u, v = (
        2 * np.pi * (np.arange(n) + random.uniform(-jitter, jitter, n)) / n
        for n in (around, across)
    )
    triangles = meshes.torus(1.0, 0.2, around, across)[1]
    u, v = (x.ravel() for x in np.meshgrid(u, v, indexing="ij"))
    far = 1.0 + 0.2 * np.cos(v)
    return np.column_stack((far * np.cos(u), far * np.sin(u), 0.2 * np.sin(v))), triangles


@pytest.mark.parametrize("turned", [0, 3])
@pytest.mark.parametrize(
    "mesh, truth, bar",
    [
        (sphere_of_rows([1.0] * 12, 24), 2.0, 0.01),
        (sphere_of_rows([0.5, *[1.0] * 12, 0.5], 24), 2.0, 0.01),
        (sphere_of_rows([*[1.0] * 5, *[0.1] * 5] * 4, 48), 2.0, 0.001),
        (meshes.icosphere(3), 2.0, 0.001),
        (capsule_of_rows(), 2.0, 0.03),
        (meshes.torus(1.0, 0.2, 48, 20), 0.4, 0.012),
        (torus_of_rows(), 0.4, 0.04),
    ],
    ids=["even", "half caps", "graded", "icosphere", "capsule", "tube", "uneven tube"],
)
def test_rows_of_uneven_width_read_as_thick_as_they_are(mesh, truth, bar, turned):
    found = measure(single(mesh, turned), BY_VERTICES, edges=Edges.BALL)
    assert not found.at_edge.any()
    np.testing.assert_allclose(found.lengths, truth, rtol=bar)


@pytest.mark.parametrize("deep", [0.6, 0.85, 0.92])
def test_no_small_cavity_is_overlooked_in_a_ball(deep):
    """From the centre of the sphere all of its faces are as far away."""
    outer, cavity = meshes.icosphere(4), meshes.icosphere(2)
    places, radius = deep * np.array([(0.6, 0.64, 0.48), (-0.48, 0.6, -0.64)]), 0.03
    voids = [(radius * cavity[0] + place, cavity[1][:, ::-1]) for place in places]
    found = measure(join(outer, *voids), BY_VERTICES, edges=Edges.BALL)
    away = outer[0][:, None] - places
    square, height = (away**2).sum(axis=2), (away * outer[0][:, None]).sum(axis=2)
    with np.errstate(divide="ignore"):
        balls = np.where(height > -radius, (square - radius**2) / (height + radius), np.inf)
    truth = np.minimum(2.0, balls.min(axis=1))
    assert (truth < 1.5).sum() > 100
    np.testing.assert_allclose(found.lengths[: len(truth)], truth, rtol=0.06)


def test_ellipsoids_of_any_rows_against_shrinking_balls():
    axes = np.array([1.0, 0.7, 0.5])
    surface = dense_ellipsoid(axes, 60_000)
    for mesh in (ellipsoid(axes, 4), sphere_of_rows([0.5, *[1.0] * 40, 0.5], 60, axes)):
        found = measure(mesh, BY_VERTICES, edges=Edges.BALL)
        some = np.random.default_rng(1).choice(len(mesh[0]), 200, replace=False)
        points = mesh[0][some]
        off = found.lengths[some] / shrinking_ball(points, unit(points / axes**2), surface)[0] - 1
        assert np.abs(off).mean() < 0.0025 and off.min() > -0.01 and off.max() < 0.05


def test_faces_are_cut_alike_on_both_sides_of_every_edge():
    sharp = np.array([(0, 1), (0, 2), (0, 4)], np.int32)
    fine = cut_faces(coarse_faces(*BOX, sharp, np.array([1, 2, 2], np.int8)), 0.06)
    corners = fine.points[fine.triangles]
    lengths = np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2)
    assert lengths.max() <= 0.06
    areas = np.linalg.norm(topology.vector_areas(fine.points, fine.triangles), axis=1)
    assert areas.min() > 0 and areas.sum() == pytest.approx(2.76)
    assert len(fine.edges()) == 3 * len(fine.triangles) / 2
    assert lengths[fine.kinds == 1].sum() == pytest.approx(2 * 0.4)
    assert lengths[fine.kinds == 2].sum() == pytest.approx(2 * 1.7)


def test_stairs_against_rays():
    found = measure(STAIRS, Settings())
    assert found.chosen.gaps == 0 and found.shape.volume == pytest.approx(0.6)
    x, z = found.points[:, 0], found.points[:, 2]
    flat = (np.abs(x - np.round(x)) > 0.3) & (z < 1e-9)  # the middle of each step, from below
    down = np.tile([0.0, 0.0, -1.0], (int(flat.sum()), 1))
    truth = rays(found.points[flat], down, STAIRS)
    assert set(np.round(truth, 6)) == {0.1, 0.2, 0.3}
    assert_bars(found.lengths[flat], truth)
    # top and bottom of the steps, and what of their sides is near
    for limit, least, most in ((0.15, 2.0, 2.5), (0.25, 4.0, 5.2)):
        parts = find_thin_parts(found, limit)
        assert parts.patches[0].minimum == pytest.approx(0.1, rel=0.01)
        assert least * 0.97 < parts.area < most
    # Areas grow with the limit; what is thin at a limit is so at a larger one.
    parts = [find_thin_parts(found, limit) for limit in (0.05, 0.15, 0.25, 0.35)]
    assert np.all(np.diff([p.area for p in parts]) > 0)
    assert parts[-1].share == pytest.approx(1.0, abs=1e-3)


def test_gap_between_two_boxes():
    found = measure(GAP, between=Between.GAP)
    facing = np.abs(np.abs(found.points[:, 2] - 0.225) - 0.025) < 1e-9
    assert np.percentile(np.abs(found.lengths[facing] / 0.05 - 1), 99) < 0.01
    parts = find_thin_parts(found, 0.06)
    assert parts.area == pytest.approx(2 * 0.7, rel=0.01)
    assert [p.minimum for p in parts.patches] == pytest.approx([0.05] * 2, rel=0.01)
    assert np.isinf(found.lengths[np.abs(found.points[:, 2] - 0.65) < 1e-9]).mean() > 0.9
    up = np.round(topology.vector_areas(*GAP)[:, 2], 9)
    middle = GAP[0][GAP[1]].mean(axis=1)[:, 2]
    facing = (np.abs(middle - np.where(up > 0, 0.2, 0.25)) < 1e-9) & (up != 0)
    assert facing.sum() == 4
    np.testing.assert_array_equal(parts.patch_of_faces >= 0, facing)


def test_a_solid_that_faces_nothing_has_no_gap():
    found = measure(BOX, between=Between.GAP)
    assert found.minimum == np.inf and any("across a gap" in w for w in found.warnings)
    assert find_thin_parts(found, 1e9).patches == ()


def test_what_has_no_walls_is_as_thick_as_its_largest_ball():
    """No two places of a tetrahedron face each other, and of a cube only the middles of its faces do."""
    found = measure(TETRAHEDRON)
    # The corner that is opposite to the face of the largest ball is out of its reach.
    assert np.median(found.lengths) == pytest.approx(2 / np.sqrt(3), rel=0.02)
    cube = measure(block(1, 1, 1))
    assert np.median(cube.lengths) == pytest.approx(1.0, rel=0.01)
    assert np.percentile(cube.lengths, 1) > 0.95
    assert measure(TETRAHEDRON, edges=Edges.BALL).minimum < 0.5


def disc(sides, height):
    """A plate over a polygon, whose flat faces are fans of needles."""
    turns = 2 * np.pi * np.arange(sides) / sides
    outline = 7.5 * np.column_stack((np.cos(turns), np.sin(turns)))
    return single(prism(outline, [(0, k, k + 1) for k in range(1, sides - 1)], height))


@pytest.mark.parametrize("height", [0.1, 0.5, 1.0])
@pytest.mark.parametrize("sides", [24, 187, 400])
def test_no_place_of_a_plate_with_a_round_rim_is_thinner_than_the_plate(sides, height):
    """Values reach all needles at the rim, and a bulge of the rim over the straight edges is no wall."""
    found = measure(disc(sides, height), Settings())
    assert found.minimum == pytest.approx(height, rel=1e-5)
    flat = np.ptp(found.points[found.triangles][:, :, 2], axis=1) == 0.0
    walls = flat & np.isfinite(found.of_triangles)
    # A ball beside the rim touches the other face as far aside as the rim bulges.
    bulge = 7.5 * (1.0 - np.cos(np.pi / sides))
    assert found.of_triangles[walls].max() < 1.01 * (height + bulge**2 / height)
    assert np.isfinite(found.lengths).all()


def test_a_thin_plate_flush_with_a_block_leaves_the_block_thick():
    """The strip along the edge of the block is near no other wall, and its balls are small."""
    profile = [(0, 0), (2, 0), (2, 0.05), (1, 0.05), (1, 1), (0, 1)]
    caps = [(0, 1, 3), (1, 2, 3), (0, 3, 4), (0, 4, 5)]
    found = measure(prism(profile, caps, 1.0), Settings())
    assert found.minimum == pytest.approx(0.05, rel=1e-5)
    middle = found.points[found.triangles].mean(axis=1)
    far = middle[:, 0] < 0.6  # the plate is 0.05 thick, and the strip no wider than its half
    assert found.of_triangles[far].min() > 0.5


# --- limits and patches


@pytest.mark.parametrize("seed", [0, 4])
def test_strictly_below_the_limit(seed):
    """0.80 is not below 0.8, also as float32 and turned."""
    found = measure(single(block(3.0, 2.0, 0.8), seed))
    assert find_thin_parts(found, 0.8).patches == ()
    assert find_thin_parts(found, 0.8001).share == pytest.approx(1.0, abs=1e-3)


def test_the_minimum_is_of_a_patch_and_not_of_a_point():
    found = measure(BOX)
    lengths = found.lengths.copy()
    lengths[5000] = 0.001
    spoiled = replace(found, surface=replace(found.surface, lengths=lengths))
    assert spoiled.minimum >= 0.35 and find_thin_parts(spoiled, 0.3).patches == ()


def test_patches_come_thinnest_first_and_small_ones_can_be_left_out():
    small = block(0.5, 0.5, 0.05, (3, 0, 0)), block(0.2, 0.2, 0.03, (5, 0, 0))
    found = measure(join(block(1, 1, 0.2), *small), Settings(samples=60_000))
    parts = find_thin_parts(found, 0.1)
    assert [p.minimum for p in parts.patches] == pytest.approx([0.03, 0.05], rel=0.02)
    assert [p.area for p in parts.patches] == pytest.approx([0.104, 0.6], rel=0.05)
    assert parts.patches[0].place[0] > 4.8
    assert parts.area == pytest.approx(sum(p.area for p in parts.patches))
    few = find_thin_parts(found, 0.1, minimum_patch=10.0)
    assert [p.minimum for p in few.patches] == pytest.approx([0.05], rel=0.02)
    assert (few.patch_of_triangles >= 0).sum() < (parts.patch_of_triangles >= 0).sum()


def test_grey_leaves_out_what_no_wall_faces():
    found = measure(BOX, edges=Edges.GREY)
    assert np.isfinite(found.lengths).mean() < 0.2
    np.testing.assert_allclose(found.lengths[np.isfinite(found.lengths)], 0.4, rtol=0.01)


# --- clouds, noise, open meshes


NO_FACES = np.empty((0, 3), np.int32)


@pytest.fixture
def cloud(medial):
    """Samples of the box, with their normals."""
    return medial.sample_surface(*BOX, count=8000)


@pytest.mark.parametrize("given", [False, True])
def test_points_without_faces(cloud, given):
    found = measure((cloud.points, NO_FACES), Settings(), cloud.normals if given else None)
    assert ("the points" in found.normals) == given
    assert_bars(found.lengths, 0.4)
    parts = find_thin_parts(found, 0.41)
    assert parts.area == pytest.approx(2.76, rel=0.01) and len(parts.patch_of_faces) == 0


AS_THEY_ARE = Settings(prepare=Prepare.OFF)
NOISY = {"box": (BOX, 0.4), "plate": (block(1.0, 0.7, 0.05), 0.05), "shell": (shell(), 0.2)}


@pytest.mark.parametrize("name", NOISY)
def test_scan_with_noise_of_a_tenth_of_the_spacing(medial, name):
    mesh, truth = NOISY[name]
    count = 30_000 if name == "plate" else 16_000
    samples = medial.sample_surface(*mesh, count=count, smooth=name == "shell")
    points = scattered(samples, 0.1)
    found = measure((points, NO_FACES), AS_THEY_ARE, samples.normals, noise=Noise.SCAN)
    assert found.noise == pytest.approx(0.1, abs=0.015)
    _, low, median, high = errors(found.lengths, truth)
    assert abs(median) < 0.05 and low > -0.15 and high < 0.15
    clean = measure((points, NO_FACES), AS_THEY_ARE, samples.normals)
    assert any("choose Noise Scan" in warning for warning in clean.warnings)
    prepared = measure((points, NO_FACES), Settings(), samples.normals)
    assert prepared.noise < 0.01 and np.abs(errors(prepared.lengths, truth)).max() < 0.05


def scattered(samples, noise):
    """Places of samples with errors of so many spacings."""
    spacing = resampled.spacing(samples.area, len(samples.points))
    return samples.points + noise * spacing * np.random.default_rng(3).normal(
        size=samples.points.shape
    )


@pytest.mark.parametrize("given", [False, True])
def test_in_too_much_noise_no_figure_is_called_honest(cloud, given):
    wild, normals = scattered(cloud, 0.26), cloud.normals if given else None
    found = measure((wild, NO_FACES), AS_THEY_ARE, normals, noise=Noise.SCAN)
    assert any("no figure is honest" in warning for warning in found.warnings)


def test_clean_samples_have_no_noise():
    for mesh in (BOX, shell(), CYLINDER):
        found = measure(mesh)
        assert found.noise < 0.02 and not any("scatter" in warning for warning in found.warnings)


@pytest.mark.parametrize("bend", [0.0, 60.0])
@pytest.mark.parametrize(("radius", "around"), [(5.0, 24), (3.0, 16)])
def test_an_open_tube_is_as_thick_as_a_closed_one(radius, around, bend):
    """Balls that touched the lids of its openings once passed for walls of a hundredth of that."""
    along, turn = np.meshgrid(
        np.linspace(0.0, 40.0, 20), 2 * np.pi * np.arange(around) / around, indexing="ij"
    )
    x, y = radius * np.cos(turn), radius * np.sin(turn)
    if bend:
        x, along = (bend + x) * np.cos(along / bend), (bend + x) * np.sin(along / bend)
    mesh = (
        np.stack((x, y, along), axis=-1).reshape(-1, 3),
        lattice(np.pad(np.arange(20 * around).reshape(20, -1), ((0, 0), (0, 1)), "wrap").T),
    )
    found = measure(mesh if topology.volume(*mesh) > 0 else meshes.flip(mesh), Settings())
    assert 0.98 * np.cos(np.pi / around) < found.minimum / (2 * radius) < 1.01
    assert not find_thin_parts(found, 0.5 * radius).patches


def test_vertices_of_a_dense_mesh_are_measured_as_they_are():
    vertices, triangles = ellipsoid(subdivisions=5)
    found = measure((vertices, triangles), Settings(), edges=Edges.BALL)
    assert found.triangles is found.shape.triangles and found.normals.endswith("the faces")
    assert len(found.of_vertices) == len(vertices)
    thin = find_thin_parts(found, 0.9)
    np.testing.assert_array_equal(thin.patch_of_faces, thin.patch_of_triangles)


# --- native arguments


def test_arguments_are_checked(medial):
    vertices = ellipsoid(subdivisions=3)[0]
    analysis = medial.MedialAnalysis(vertices, sides=medial.SidesFrom.TIGHT_COCONE)
    for bad in ({}, {"normals": vertices[:5]}, {"normals": vertices, "edges": np.zeros(3, bool)}):
        with pytest.raises(medial.InvalidInputError):
            analysis.thickness(**bad)
    with pytest.raises(medial.InvalidInputError, match="INNER"):
        analysis.thickness(vertices, side=medial.Side.BOTH)
    with pytest.raises(medial.InvalidInputError):
        medial.MedialAnalysis(vertices, sides=medial.SidesFrom.NONE).thickness(vertices)
    found = analysis.thickness(vertices)
    assert len(found.values) == len(found.measured) == len(analysis.samples)
    assert found.measured.dtype == bool and not found.values.flags.writeable
    # The length of normals does not matter.
    assert found.values.tobytes() == analysis.thickness(1024.0 * vertices).values.tobytes()


def test_nearest_and_patches(medial):
    rng = np.random.default_rng(0)
    sites, queries = rng.random((50, 3)), rng.random((20, 3))
    wanted = np.linalg.norm(queries[:, None] - sites, axis=2).argmin(axis=1)
    np.testing.assert_array_equal(medial.nearest(sites, queries), wanted)
    assert (medial.nearest(np.empty((0, 3)), queries) == -1).all()
    triangles = np.array([(0, 1, 2), (5, 6, 7), (2, 3, 4)], np.int32)
    flags = np.ones(3, bool)
    assert medial.patches(triangles, flags, 8).tolist() == [0, 1, 0]
    assert medial.patches(triangles, flags & [False, True, True], 8).tolist() == [-1, 0, 1]
    for bad in ((triangles, flags[:2], 8), (triangles, flags, 7)):
        with pytest.raises(medial.InvalidInputError):
            medial.patches(*bad)


# --- files


def test_csv_has_a_row_per_vertex_then_one_per_other_point(tmp_path):
    found = measure(BOX)
    path = export_thickness(found, find_thin_parts(found, 0.41), tmp_path / "box.csv")
    with open(path, newline="") as stream:
        rows = [[float(x) for x in row.values()] for row in csv.DictReader(stream)]
    assert [row[0] for row in rows[:8]] == list(range(8))
    assert {row[0] for row in rows[8:]} == {-1} and len(rows) > 1000
    np.testing.assert_array_equal([row[1:4] for row in rows[:8]], BOX[0])
    assert [row[4] for row in rows[:8]] == pytest.approx([0.4] * 8, rel=0.01)
    assert sorted(row[1:5] for row in rows) == sorted(
        [*point, length] for point, length in zip(found.points.tolist(), found.lengths, strict=True)
    )
    assert sum(row[5] for row in rows) == np.count_nonzero(~found.measured)
    with pytest.raises(ExportError, match=r"\.csv, \.html, \.json or \.ply"):
        export_thickness(found, find_thin_parts(found, 0.1), tmp_path / "box.obj")


def test_json_says_where(tmp_path):
    frame = np.identity(4)
    frame[:3, 3] = 10, 0, 0
    shape = replace(shape_of(GAP), frame=frame)
    found = measure_thickness(shape, EVEN, ThicknessSettings(between=Between.GAP))
    path = export_thickness(found, find_thin_parts(found, 0.06), tmp_path / "gap.json", "mm")
    said = json.loads(path.read_text())
    assert said["unit"] == "mm" and said["limit"] == 0.06 and said["between"] == "gap"
    assert said["minimum"] == pytest.approx(0.05, rel=0.01)
    assert said["area_below"] == pytest.approx(1.4, rel=0.01)
    assert said["share_below"] == pytest.approx(1.4 / 5.52, rel=0.01)
    for patch in said["patches"]:
        assert set(patch) == {"place", "area", "minimum", "lowest"}
        x, _, z = patch["place"]
        assert 9.5 <= x <= 10.5 and z == pytest.approx(0.225, abs=0.03)


def test_json_has_null_where_there_is_no_length(tmp_path):
    found = measure(BOX, between=Between.GAP)
    path = export_thickness(found, find_thin_parts(found, 1.0), tmp_path / "none.json")
    assert json.loads(path.read_text())["minimum"] is None


def test_ply_is_the_measured_surface(tmp_path):
    found = measure(GAP, between=Between.GAP)
    parts = find_thin_parts(found, 0.06)
    data = export_thickness(found, parts, tmp_path / "gap.ply").read_bytes()
    head, _, body = data.partition(b"end_header\n")
    assert f"element vertex {len(found.points)}\n".encode() in head
    kind = np.dtype([("place", "<f8", 3), ("thickness", "<f8"), ("colour", "u1", 3)])
    vertices = np.frombuffer(body, kind, len(found.points))
    np.testing.assert_array_equal(vertices["place"], found.points)
    np.testing.assert_array_equal(vertices["thickness"], found.lengths)
    kind = [("n", "u1"), ("corners", "<i4", 3), ("patch", "<i4")]
    faces = np.frombuffer(body[vertices.nbytes :], kind)
    np.testing.assert_array_equal(faces["corners"], found.triangles)
    np.testing.assert_array_equal(faces["patch"], parts.patch_of_triangles)
    thin, colour = np.isfinite(found.lengths), vertices["colour"]
    assert (colour[thin, 0] > 200).all() and len(np.unique(colour[~thin], axis=0)) == 1


def test_the_length_of_a_triangle_is_the_least_wall_at_its_corners():
    found = measure(ellipsoid(np.array([1.0, 0.7, 0.5])))
    walls = np.where(found.measured, found.lengths, np.inf)[found.triangles].min(axis=1)
    known = np.isfinite(walls)
    np.testing.assert_array_equal(found.of_triangles[known], walls[known])
    assert np.isinf(found.of_triangles[~known]).all() and known.mean() > 0.2
    assert np.isfinite(found.lengths).all()


@pytest.mark.parametrize("height, walls", [(1.5, False), (4.0, True)])
def test_the_largest_ball_between_lids_of_openings_is_told(height, walls):
    """A ring without lids that is lower than wide has no two walls whose balls reach each other."""
    points, triangles = lathe([(0, 0), (1, 0), (1, height), (0, height)], 24)
    side = np.ptp(points[triangles][:, :, 2], axis=1) > 0
    used, rows = np.unique(triangles[side], return_inverse=True)
    found = measure((points[used], rows.reshape(-1, 3)), Settings(samples=2000))
    told = " ".join(found.warnings)
    assert "the surface is open at 48 edges" in told
    assert found.measured.any() == walls == ("the largest ball" not in told)
