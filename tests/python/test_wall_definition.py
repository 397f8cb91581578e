# SPDX-License-Identifier: GPL-3.0-or-later
"""Walls by their definition: random solids against it, and small ones that once were wrong."""

import json
from dataclasses import replace

import numpy as np
import pytest
from medial_axis import cli
from medial_axis.core.settings import Settings, ThickenSettings, ThicknessSettings
from medial_axis.core.thickness.thicken import thicken
from medial_axis.core.thickness.thickness import measure_thickness
from medial_axis.core.thickness.thin_parts import find_thin_parts
from support import topology
from support.distance import to_triangle
from support.meshes import join, shape_of, torus, write_off
from support.plates import prism, wedge
from support.thick_meshes import block, lathe, shell
from support.wall_truth import distances, slanted_plate, tube, turned, turned_part, walls

pytestmark = pytest.mark.oracle

AWAY = [0.0, 1e5]
FLAT = Settings(smooth=False)


def measure(mesh, settings=FLAT, single=False, **wanted):
    shape = replace(shape_of(mesh), single=single)
    return measure_thickness(shape, settings, ThicknessSettings(**wanted))


def places_of(found, count, rng):
    """Some places between walls inside of faces, the thinnest among them, and their faces."""
    normals = topology.vector_areas(found.shape.points, found.shape.triangles)
    face = found.surface.face_of_triangles
    inside = np.ones(len(found.points), bool)
    first = np.full(len(found.points), -1)
    for corner in found.triangles.T:
        first[corner] = face
    for corner in found.triangles.T:  # not on the edge between two faces
        turned = np.linalg.norm(np.cross(normals[face], normals[first[corner]]), axis=1)
        np.logical_and.at(inside, corner, turned < 1e-9 * (normals[face] ** 2).sum(axis=1))
    some = np.flatnonzero(found.measured & ~found.at_edge & inside)
    some = some[np.argsort(found.lengths[some], kind="stable")]
    rows = np.union1d(some[: count // 2], rng.choice(some, min(len(some), count // 2)))
    return rows, first[rows]


@pytest.mark.parametrize("away", AWAY)
@pytest.mark.parametrize("seed", range(3))
def test_turned_parts_have_walls_by_the_definition(seed, away):
    rng = np.random.default_rng(seed)
    mesh = turned(turned_part(rng), rng, away)
    found = measure(mesh)
    if not np.isfinite(found.surface.between_walls).any():
        return
    rows, faces = places_of(found, 40, rng)
    truth, between = walls(mesh, found.points[rows], faces)
    # Faces that turn by less than the sharp angle are one wall, which limits no ball at its own edges.
    off = found.lengths[rows] / truth - 1
    assert off.min() > -1e-6 and np.mean(off < 1e-6) > 0.9
    assert between[off < 1e-6].all()


@pytest.mark.parametrize("away", AWAY)
@pytest.mark.parametrize("seed", [11, 30, 72, 75])  # all bends are sharp, and none below 60 degrees
def test_smooth_turned_parts_are_no_thinner_than_round_ones(seed, away):
    """A part of four times as many flat sides stands for the round one."""
    rng = np.random.default_rng(seed)
    truth = measure(turned_part(np.random.default_rng(seed), 4)).minimum
    assert measure(turned(turned_part(rng), rng, away), Settings()).minimum > 0.98 * truth


@pytest.mark.parametrize("away", AWAY)
@pytest.mark.parametrize("seed", range(3))
def test_plates_with_slanted_rims_are_as_thick_as_they_are(seed, away):
    rng = np.random.default_rng(seed)
    mesh, thickness = slanted_plate(rng)
    for settings in (Settings(), FLAT):
        found = measure(turned(mesh, rng, away), settings)
        assert found.minimum == pytest.approx(thickness, rel=1e-8)
        assert found.between_parallel == pytest.approx(thickness, rel=1e-8)


@pytest.mark.parametrize("away", AWAY)
@pytest.mark.parametrize("seed", range(2))
def test_pipes_are_as_thick_as_their_walls(seed, away):
    rng = np.random.default_rng(seed)
    mesh, thickness = tube(rng)
    mesh = turned(mesh, rng, away)
    assert measure(mesh).minimum == pytest.approx(thickness, rel=1e-6)
    assert measure(mesh, Settings()).minimum > 0.98 * thickness


# A cube and a box at a slant that sticks out of its top, as one solid: at corners convex edges end where reflex ones
# begin, and faces 15 degrees apart are smooth.
SLANTED_BOXES = tuple(
    np.fromstring(rows, sep=" ").reshape(-1, 3)
    for rows in (
        """-.5 -.5 -.5  -.5 -.5 .5  -.5 .5 -.5  -.5 .5 .5  -.191832 .043307 .5  -.16403 .014524 .603759
        -.191832 .35389 .5  -.143933 .304302 .678759  .5 -.5 -.5  .5 -.5 .5  .5 .5 -.5  .223205 .014524 .5
        .325806 .11363 .5  .325806 .317992 .5  .33903 .304302 .54935  .5 .5 .5""",
        """0 8 1  0 2 8  0 1 3  1 4 6  1 9 4  0 3 2  1 6 3  2 3 15  3 6 15  8 10 9  1 8 9  9 11 4  9 12 11  9 13 12
        2 10 8  2 15 10  15 6 13  9 10 15  9 15 13  5 6 4  5 7 6  5 4 11  5 11 7  7 13 6  7 11 14  7 14 13  14 11 12
        14 12 13""",
    )
)


def test_the_corner_of_a_reflex_edge_is_no_wall_to_what_it_reaches_through():
    """The flat one has walls of 0.659, between a side of the cube and a reflex edge."""
    assert measure(SLANTED_BOXES, Settings()).minimum > 0.65


def diameters_by_halving(mesh, places, normals):
    """(n,) of balls, until no triangle is inside; those of the place's own plane count not."""
    own = topology.unit_normals(*mesh) @ normals.T > 0.999
    corners = np.tile(mesh[0][mesh[1]], (len(places), 1, 1))
    low, high = np.zeros(len(places)), np.full(len(places), 2.0)
    for _ in range(60):
        radius = (low + high) / 2
        centres = np.repeat(places - radius[:, None] * normals, len(mesh[1]), axis=0)
        away = to_triangle(centres, corners).reshape(len(places), -1)
        free = np.where(own.T, np.inf, away).min(axis=1) >= radius
        low, high = np.where(free, radius, low), np.where(free, high, radius)
    return 2 * low


L = [(0, 0), (1, 0), (1, 0.1), (0.1, 0.1), (0.1, 0.6), (0, 0.6)]
SOLIDS = {
    "plate": block(1, 0.7, 0.05),
    "box": block(1, 0.7, 0.4),
    "wedge": prism([(0, 0), (1, 0), (0.94, 0.34)], [(0, 1, 2)], 0.8),
    "L": prism(L, [(0, 1, 2), (0, 2, 3), (0, 3, 5), (3, 4, 5)], 0.8),
}


@pytest.mark.parametrize("name", SOLIDS)
def test_balls_are_those_of_all_triangles(medial, name):
    rng, (points, triangles) = np.random.default_rng(7), SOLIDS[name]
    face = rng.integers(len(triangles), size=300).astype(np.int32)
    places = np.einsum("ij,ijk->ik", rng.dirichlet((1, 1, 1), 300), points[triangles[face]])
    balls = medial.BallFaces(points, triangles, smooth=False)
    length, wall, _ = balls.inscribed_balls(places, face, np.full(300, 0.01))
    normals = topology.unit_normals(points, triangles)[face]
    truth = diameters_by_halving(SOLIDS[name], places, normals)
    np.testing.assert_allclose(length, truth, rtol=1e-6, atol=1e-7)
    assert (wall >= length).all()


@pytest.mark.parametrize("turn", [0.0, 0.5])
def test_balls_in_a_tube_have_a_wall_opposite_everywhere(medial, turn):
    """They touch faces all round, many of which are beside them and not opposite."""
    points, triangles = torus(1.0, 0.4, 300, 150, turn)
    face = np.arange(0, len(triangles), 37, dtype=np.int32)
    given = points[triangles[face, 0]], face, np.full(len(face), 0.03)
    found = medial.BallFaces(points, triangles, smooth=True).inscribed_balls(*given)
    np.testing.assert_allclose(found[:2], 0.8, atol=1e-3)
    nothing = medial.BallFaces(points, triangles[:1], smooth=True)
    assert np.isinf(nothing.inscribed_balls(*(x[:1] for x in given))[:2]).all()


def test_what_a_ball_touches_from_outside_is_no_wall(medial):
    """A pillar on edge in a cube: its lower face looks to the ball from the top, at 135 degrees."""
    half = np.sqrt(0.5)
    pillar, faces = block(0.1, 0.1, 0.4)
    turn = np.array([[half, -half, 0.0], [half, half, 0.0], [0.0, 0.0, 1.0]])
    points, triangles = join(block(1, 1, 1), (pillar @ turn.T + [0.318, 0.418, 0], faces))
    top = np.flatnonzero((points[triangles][:, :, 1] == 0.5).all(axis=1)).astype(np.int32)
    balls = medial.BallFaces(points, triangles, smooth=False)
    place = np.repeat([[0.0, 0.5, 0.0]], len(top), axis=0)
    length, wall, _ = balls.inscribed_balls(place, top, np.full(len(top), 1e-3))
    assert length == pytest.approx(0.798087, abs=1e-6)
    assert np.isinf(wall).all()


def test_a_place_that_its_bulge_moves_through_another_face_has_no_wall(medial):
    """A round bar of 14 sides rises out of a block at 13 degrees: its smooth side does so farther out."""
    points, faces = lathe([(0.0, -1.0), (0.4, -1.0), (0.4, 1.0), (0.0, 1.0)], 14)
    bar = np.column_stack((points[:, 1], points[:, 2], points[:, 0])), faces
    points, triangles = join(block(2, 3, 0.6, (0, 0, -0.68)), bar)
    x = np.linspace(0.02, 0.17, 16)
    places = np.column_stack((x, np.full(16, 0.1), x * np.tan(np.pi / 14) - 0.4))
    side = [distances(points[triangles], place).argmin() for place in places]
    balls = medial.BallFaces(points, triangles, smooth=True)
    ball, wall, _ = balls.inscribed_balls(places, np.array(side, np.int32), np.full(16, 1e-3))
    is_outside = places[:, 2] > -0.38
    assert ball[is_outside].min() < 0.01, "there the smooth side is inside the block"
    assert np.isinf(wall[is_outside]).all()


def frustum(around):
    return lathe([(0.0, 0.0), (1.0, 0.0), (0.5, 1.0), (0.0, 1.0)], around)


@pytest.mark.parametrize("around", [16, 24, 32, 64])
def test_a_rim_of_63_degrees_is_no_wall(around):
    found = measure(frustum(around), Settings())
    assert found.minimum > 0.83
    assert find_thin_parts(found, 0.25).share == 0.0


def test_a_lid_is_measured_where_it_is():
    """Places beside a rim of 55 degrees were moved towards it, as curved triangles are wider than flat ones."""
    found = measure(lathe([(0, 0.0), (0.601, 0.0), (0.852, 0.353), (0, 0.353)], 50), Settings())
    away = 0.852 - np.hypot(*found.points[:, :2].T)
    at = (found.points[:, 2] == 0.353) & ~found.at_edge & (away < 0.1) & (away > 0.01)
    truth = 2 * np.tan(np.arctan2(0.353, 0.251) / 2) * away[at]
    np.testing.assert_allclose(found.lengths[at], truth, rtol=0.02)


def test_thicken_leaves_a_frustum_alone():
    settings = ThickenSettings(limit=0.25, subdivide=True)
    done = thicken(shape_of(frustum(32)), Settings(), settings)
    assert not done.moves.any() and not done.left.patches


def test_a_pit_through_a_wall_is_its_minimum():
    points, triangles = shell(4)
    points = np.array(points, float)
    top = points[:, 2].argmax()
    points[top] *= 0.802 / np.linalg.norm(points[top])
    found = measure((points, triangles), Settings())
    assert found.minimum == pytest.approx(0.002, abs=1e-4)
    patch = find_thin_parts(found, 0.1).patches[0]
    assert patch.minimum == patch.lowest == found.minimum


def test_faces_that_cross_are_no_thin_wall():
    """Both planes are 0.05 apart where neither of them bounds the solid; the thinnest wall has 0.21."""
    mesh = join(block(1, 1, 0.6, (0.5, 0.5, 0.3)), block(0.55, 0.6, 0.8, (1.225, 1.2, 0.8)))
    found = measure(mesh, Settings(samples=4000))
    assert found.surface.between_walls is None and 0.15 < found.minimum < 0.22


def test_a_wall_ends_where_parts_cross():
    """The lower box ends at y = 0.16: balls below the other one touch that edge, and no plane beyond it."""
    low = block(0.54, 0.25, 0.24, (0.27, 0.125, 0.12))
    mesh = join(low, block(0.82, 0.88, 0.68, (0.68, 0.6, 0.42)))
    mesh = join(mesh, (np.identity(3), np.zeros((0, 3), int)))
    points, triangles = turned(mesh, np.random.default_rng(2), 0.0)
    x, y, z = points[-3:] @ (found := measure((points[:-3], triangles))).points.T
    under = found.measured & (abs(z - 0.08) < 1e-9) & (x > 0.3) & (x < 0.52) & (y < 0.3)
    assert (found.lengths[under] > 0.16 + (y[under] - 0.16) ** 2 / 0.16).all()


@pytest.mark.parametrize("wide", [0.02, 0.1])
def test_a_square_pin_is_seen(wide):
    found = measure(join(block(1, 1, 1), block(wide, wide, 0.5, (0.4, 0.4, 1.2))), Settings())
    assert found.minimum == pytest.approx(wide, rel=1e-6)


@pytest.mark.parametrize("angle", [20.0, 30.0, 45.0])
@pytest.mark.parametrize("seed", range(2))
def test_a_wedge_has_a_second_figure(angle, seed):
    """A web of 1.26 ends in a sharp edge, towards which the least thickness is none."""
    web, nose = 1.26, 1.26 / np.tan(np.radians(angle))
    outline = [(0, 0), (nose + 3, 0), (nose + 3, web), (nose, web)]
    mesh = prism(outline, [(0, 1, 2), (0, 2, 3)], 2.0)
    mesh = turned(mesh, np.random.default_rng(seed), 10.0)
    # By default a bend of 30 degrees or less is one of a smooth surface, which has other normals.
    for settings in (FLAT, Settings()) if angle > 31.0 else (FLAT,):
        found = measure(mesh, settings)
        assert found.minimum < 0.1
        assert found.between_parallel == pytest.approx(web, rel=1e-6)


def test_both_figures_are_reported(tmp_path, capsys):
    """A wedge with an edge of 30 degrees beside a plate: all of its faces meet at sharp edges."""
    path = write_off(tmp_path / "wedge.off", join(wedge(), block(4, 4, 1.26, (0, 8, 0))))
    out = tmp_path / "wedge.json"
    cli.main(["thickness", path, str(out), "--limit", "1"])
    report = json.loads(out.read_text())
    assert report["minimum"] < 0.1
    assert report["minimum_parallel"] == pytest.approx(1.26, rel=1e-6)
    assert "(1.26 between nearly parallel walls)" in capsys.readouterr().out


@pytest.mark.parametrize("offset", [0.0, 3e5, 1e6])
def test_the_gate_sees_far_from_the_origin(tmp_path, capsys, offset):
    points, triangles = block(1.0, 1.0, 0.02)
    path = write_off(tmp_path / "plate.off", (points + offset, triangles))
    for limit in ("0.1", "0.02"):
        code = cli.main(["thickness", path, str(tmp_path / f"{limit}.json"), "--limit", limit])
        report = json.loads((tmp_path / f"{limit}.json").read_text())
        assert (code == 5) == (report["minimum"] < report["limit"]) == bool(report["patches"])
    capsys.readouterr()
    assert json.loads((tmp_path / "0.1.json").read_text())["patches"]


def test_rounding_that_hides_a_limit_is_told():
    points, triangles = block(1.0, 1.0, 0.02)
    found = measure((points + 3e5, triangles), Settings(), single=True)
    parts = find_thin_parts(found, 0.1)
    assert parts.minimum >= parts.limit and not parts.patches
    assert any("rounded" in str(warning) for warning in found.warnings)


@pytest.mark.parametrize("seed", range(3))
def test_walls_at_exactly_120_degrees_do_not_depend_on_the_pose(seed):
    rng = np.random.default_rng(seed)
    angle = 2 * np.pi * np.arange(3) / 3
    mesh = prism(np.column_stack((np.cos(angle), np.sin(angle))), [(0, 1, 2)], 3.0)
    plain, posed = (
        find_thin_parts(measure(some), 0.3).share for some in (mesh, turned(mesh, rng, 0.0))
    )
    assert 0.2 < plain == pytest.approx(posed, rel=0.08)
