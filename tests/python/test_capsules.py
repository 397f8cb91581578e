# SPDX-License-Identifier: GPL-3.0-or-later
"""Capsules of a solid: exact shapes, every place by NumPy, files, command. The ball nearest to a place is sought along
each segment, which shares nothing with the closed form of the program."""

import json
import math
from functools import cache
from xml.etree import ElementTree

import medial_axis
import numpy as np
import pytest
from support import meshes, swept
from support.distance import points_on_triangles
from support.robot_shapes import shapes_of

TORUS = meshes.torus(1.0, 0.4, 48, 24)


@cache
def ring_case():
    """A torus, and a polygon of 12 sides inscribed in its core."""
    angle = 2 * np.pi * np.arange(12) / 12
    ends = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(12)])
    segments = np.column_stack([np.arange(12), (np.arange(12) + 1) % 12]).astype(np.int32)
    return ends, segments, *TORUS


def cover(medial, case, mode="INSIDE", **options):
    return medial.cover_by_capsules(*case, mode=getattr(medial.CoverMode, mode), **options)


def balls_along(found, count=401):
    """(n * count, 3) and (n * count,) balls at places along each capsule."""
    share = np.linspace(0.0, 1.0, count)[:, None]
    ends, radii = found.ends.reshape(-1, 2, 3), found.radii.reshape(-1, 2)
    centres = [(1 - share) * a + share * b for a, b in ends]
    sizes = [((1 - share) * p + share * q)[:, 0] for p, q in radii]
    return np.concatenate(centres), np.concatenate(sizes)


def off(places, found):
    """(k,) distances of places from the capsules, negative inside; too large by what lies between two balls."""
    centres, radii = balls_along(found)
    return np.concatenate(
        [
            (np.linalg.norm(part[:, None] - centres, axis=2) - radii).min(axis=1)
            for part in np.array_split(places, max(1, len(places) // 100))
        ]
    )


def reach_out(medial, found, mesh):
    """How far balls along the capsules reach out of a solid, by their radii and depths."""
    centres, radii = balls_along(found, 201)
    depth = medial.TriangleTree(*mesh).distances(centres)
    inside = medial.winding_number(centres, *mesh) > 0.5
    return (radii - np.where(inside, depth, -depth)).max()


@pytest.mark.parametrize("tapered", [True, False])
def test_a_capsule_is_one_capsule(medial, tapered):
    ends = np.array([(0.0, 0, 0), (0, 0, 4.0)])
    case = ends, np.array([(0, 1)], np.int32), *swept.capsule(4.0, 0.3, 64)
    found = cover(medial, case, tapered=tapered, places=20_000)
    assert np.array_equal(found.ends, ends)
    assert np.allclose(found.radii, 0.3, rtol=0.006) and (found.radii < 0.3).all()
    assert found.held > 0.98 and found.outside == 0.0 and found.farthest < 0.02
    around = cover(medial, case, "AROUND", tapered=tapered, places=20_000)
    assert np.allclose(around.radii, 0.3, rtol=0.006) and around.farthest == 0.0


def test_a_tapered_capsule_has_two_radii(medial):
    """The surface round two balls of radii 0.5 and 0.2, 3 apart."""
    lean = math.asin((0.5 - 0.2) / 3.0)
    low, high = np.linspace(-math.pi / 2, lean, 65), np.linspace(lean, math.pi / 2, 65)
    profile = [(0.5 * math.cos(a), 0.5 * math.sin(a)) for a in low]
    profile += [(0.2 * math.cos(a), 3 + 0.2 * math.sin(a)) for a in high]
    mesh = meshes.lathe(np.array(profile), 64)
    case = np.array([(0.0, 0, 0), (0, 0, 3.0)]), np.array([(0, 1)], np.int32), *mesh
    for mode in ("INSIDE", "AROUND"):
        found = cover(medial, case, mode, places=20_000)
        assert np.allclose(found.radii, (0.5, 0.2), rtol=0.01), mode
    straight = cover(medial, case, tapered=False)  # a ball holds more than a capsule of radius 0.2
    assert np.allclose(straight.radii, 0.5, rtol=0.01) and (straight.ends == 0.0).all()


@pytest.mark.parametrize("mode", ["INSIDE", "AROUND"])
@pytest.mark.parametrize("tapered", [True, False])
def test_promises_hold(medial, mode, tapered):
    found = cover(medial, ring_case(), mode, tapered=tapered, places=20_000)
    assert len(found.radii) == 24 and (tapered or (found.radii[::2] == found.radii[1::2]).all())
    assert reach_out(medial, found, TORUS) <= found.outside + 1e-12
    away = off(points_on_triangles(TORUS[0][TORUS[1]], 1500, np.random.default_rng(5)), found).max()
    assert away <= found.farthest + 1e-5
    if mode == "INSIDE":
        assert found.outside == 0.0 and found.farthest < away + 2 * found.step
        sizes = np.linalg.norm(np.diff(found.ends.reshape(-1, 2, 3), axis=1)[:, 0], axis=1)
        assert (sizes > 0).all() and (found.radii > 0.3).all()
    else:
        assert found.farthest == 0.0
        assert found.outside < reach_out(medial, found, TORUS) + 0.01


def test_the_volume_is_that_of_random_places(medial):
    found = cover(medial, ring_case(), places=50_000)
    places = np.random.default_rng(3).uniform((-1.4, -1.4, -0.4), (1.4, 1.4, 0.4), (6_000, 3))
    solid = places[medial.winding_number(places, *TORUS) > 0.5]
    assert (off(solid, found) <= 0).mean() == pytest.approx(found.held, abs=0.02)


def test_tolerance_lies_between_inside_and_around(medial):
    inside = cover(medial, ring_case(), places=20_000)
    before = inside.farthest
    for part in (0.3, 0.6):
        found = cover(medial, ring_case(), places=20_000, tolerance=part * inside.farthest)
        assert 0 < found.outside <= part * inside.farthest * 1.02
        assert reach_out(medial, found, TORUS) <= part * inside.farthest * (1 + 1e-9)
        assert found.farthest < before and found.held > inside.held
        before = found.farthest


def test_a_segment_that_leaves_the_solid_is_a_ball_at_one_end(medial):
    ends = np.array([(1.0, 0, 0), (-1.0, 0, 0)])
    found = cover(medial, (ends, np.array([(0, 1)], np.int32), *TORUS))
    assert np.array_equal(found.ends[0], found.ends[1]) and found.radii[0] == found.radii[1]
    assert found.radii[0] == pytest.approx(0.4, abs=0.02) and found.outside == 0.0


def test_a_radius_between_two_places_is_looked_at(medial):
    """A dent that is narrower than the places with which the search begins."""
    vertices, triangles = meshes.icosphere(5)
    near = np.linalg.norm(vertices - (0, 0.9995, 0.03), axis=1) < 0.05
    dented = vertices * np.where(near, 0.2, 1.0)[:, None]
    ends = np.array([(0.0, 0, -0.7), (0, 0, 0.7)])
    found = cover(medial, (ends, np.array([(0, 1)], np.int32), dented, triangles))
    assert reach_out(medial, found, (dented, triangles)) <= 1e-12


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"count": 0}, "Expected at least one capsule and one place, found 0"),
        ({"tolerance": -1.0}, "Expected a finite tolerance of 0 or more, found -1"),
        ({"segments": np.array([(0, 12)], np.int32)}, "Expected rows from 0 to 11"),
        ({"ends": np.full((12, 3), np.nan)}, "end of a segment"),
    ],
)
def test_what_cannot_be_is_refused(medial, change, words):
    given = dict(zip(("ends", "segments", "vertices", "triangles"), ring_case(), strict=True))
    with pytest.raises(medial.InvalidInputError, match=words):
        medial.cover_by_capsules(**(given | change))
    far = given | {"ends": given["ends"] + 9.0}
    with pytest.raises(medial.DegenerateInputError, match="Expected segments in the solid"):
        medial.cover_by_capsules(**far)


# --- through the front door


@cache
def covered(shapes="capsules", **options):
    found = medial_axis.cover_by_balls(*TORUS, sampling="vertices", shapes=shapes, **options)
    return found.balls


def test_capsules_of_a_torus_go_round_it():
    fine = meshes.torus(1.0, 0.4, 64, 32)
    found = medial_axis.cover_by_balls(*fine, sampling="vertices", shapes="tapered", count=14)
    balls = found.balls
    assert 6 <= balls.count <= 14 and balls.covered > 0.75 and balls.outside == 0.0
    assert balls.words == f"{balls.count} capsules" and len(balls.edges) >= 6
    middles = balls.centres[balls.edges].mean(axis=1)
    assert (np.linalg.norm(middles[:, :2], axis=1) > 0.7).all()


def test_fewer_capsules_than_the_topology_needs():
    """A ring needs three edges; the largest one is kept, and how much is bare is told."""
    balls = covered("capsules", count=1)
    assert balls.count == 1 and balls.outside == 0.0 and balls.farthest > 0.5


# --- files


def test_files_say_the_same(tmp_path):
    balls = covered("tapered", count=9)
    text = medial_axis.write_balls(balls, tmp_path / "a.ma").read_text().split("\n")
    assert text[0] == f"{len(balls.radii)} {len(balls.edges)} 0"
    assert text[-2] == "e {} {}".format(*balls.edges[-1])
    read = medial_axis.read_axis(tmp_path / "a.ma")
    assert np.array_equal(read.vertices, balls.centres) and np.array_equal(read.edges, balls.edges)
    known = json.loads(medial_axis.write_balls(balls, tmp_path / "a.json").read_text())
    assert known["covered"] == balls.covered and len(known["balls"]) == len(balls.single)
    assert [one["ends"] for one in known["capsules"]] == balls.centres[balls.edges].tolist()
    assert [one["radii"] for one in known["capsules"]] == balls.radii[balls.edges].tolist()


@pytest.mark.parametrize("shapes", ["capsules", "balls"])
@pytest.mark.parametrize("suffix", [".xml", ".urdf"])
def test_mujoco_reads_them(tmp_path, shapes, suffix):
    mujoco = pytest.importorskip("mujoco")
    path = medial_axis.write_balls(covered(shapes, count=9), tmp_path / ("arm" + suffix))
    model = mujoco.MjModel.from_xml_path(str(path))
    link = next(each for each in ElementTree.parse(path).iter() if each.tag in ("link", "body"))
    for row, (kind, ends, radius) in enumerate(shapes_of(link)):
        assert model.geom_type[row] == getattr(mujoco.mjtGeom, f"mjGEOM_{kind.upper()}")
        assert model.geom_size[row, 0] == pytest.approx(radius)
        assert np.allclose(model.geom_pos[row], ends.mean(axis=0))
        matrix = np.empty(9)
        mujoco.mju_quat2Mat(matrix, model.geom_quat[row])
        along = 0.0 if kind == "sphere" else 2 * model.geom_size[row, 1]
        assert abs(matrix[2::3] @ (ends[1] - ends[0])) == pytest.approx(along, rel=1e-9)
        assert np.linalg.norm(ends[1] - ends[0]) == pytest.approx(along, rel=1e-9)
    assert model.ngeom == row + 1


@pytest.mark.parametrize("shapes", ["capsules", "balls"])
@pytest.mark.parametrize("parser", ["yourdfpy", "urchin"])
def test_parsers_of_urdf_read_them(tmp_path, shapes, parser):
    module = pytest.importorskip(parser)
    path = medial_axis.write_balls(covered(shapes, count=9), tmp_path / "arm.urdf")
    robot = module.URDF.load(str(path))
    (link,) = robot.links if parser == "urchin" else robot.robot.links
    expected = shapes_of(ElementTree.parse(path).find("link"))
    for item, (_, ends, radius) in zip(link.collisions, expected, strict=True):
        shape = item.geometry.sphere or item.geometry.cylinder
        half = getattr(shape, "length", 0.0) / 2 * item.origin[:3, 2]
        assert np.allclose([item.origin[:3, 3] - half, item.origin[:3, 3] + half], ends)
        assert shape.radius == pytest.approx(radius)
