# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids far from the origin: every product is that of the same solid there, as far as their coordinates are known."""

import numpy as np
import pytest
from medial_axis import library
from medial_axis.core.batch.batch import Item, begin, finish
from medial_axis.core.errors import MedialAxisError
from medial_axis.core.files.read_shape import read_shape
from medial_axis.core.machine.job import run_task
from medial_axis.core.products.balls import Balls
from medial_axis.core.products.hollow import HollowSolid
from medial_axis.core.products.mid_surface import MiddleSurface
from medial_axis.core.products.skeleton import Skeletons
from medial_axis.core.products.thicken import ThickerWalls
from medial_axis.core.products.thickness import Thickness
from medial_axis.core.settings import (
    BallSettings,
    CoverShapes,
    Form,
    HollowSettings,
    MidSurfaceSettings,
    Settings,
    SidesFrom,
    SkeletonSettings,
    ThickenSettings,
    ThicknessSettings,
)
from medial_axis.core.shape.own_frame import in_own_frame, own_origin
from medial_axis.core.shape.shape import Shape
from support.distance import to_triangles
from support.meshes import box, flip, icosphere, join, shape_of
from support.poses import random_turn
from support.thick_meshes import block, lathe
from support.thin_solids import union

DIRECTION = np.array([1.0, -2.0, 3.0])


# Thin and thick solids of size 1, and their least walls.
SOLIDS = {
    "box": (block(1.0, 0.7, 0.5), 0.5),
    "plate": (block(1.0, 0.8, 0.04), 0.04),
    "tube": (lathe([(0.4, 0.0), (0.4, 0.8), (0.34, 0.8), (0.34, 0.0)], 24), 0.06),
    "turned": (lathe([(0.0, 0.0), (0.4, 0.0), (0.5, 0.3), (0.2, 0.6), (0.0, 0.6)], 32), 0.0),
    "profile": (union(((0, 0, 0), (1, 0.5, 0.1)), ((0, 0, 0), (0.1, 0.5, 0.6))), 0.1),
    "hollow box": (join(block(0.8, 0.6, 0.5), flip(block(0.6, 0.4, 0.3))), 0.1),
}


def placed(name, seed, sizes, single=False):
    """The solid in a random pose, so many sizes from the origin, and where it was moved to."""
    points, triangles = SOLIDS[name][0]
    offset = sizes * DIRECTION
    moved = np.asarray(points, float) @ random_turn(seed).T + offset
    return shape_of((moved.astype(np.float32) if single else moved, triangles)), offset


def run(work, shape, output):
    """The result and the report of an output, as a command makes them."""
    begun = begin(Item("shape", None, None, output, lambda: (shape, ())), work, force=True)
    outcome = run_task(begun.task)
    return outcome.value, finish(begun, outcome)


def near_and_far(work, name, seed, sizes, output, single=False):
    """(result, report, where the solid was moved to) at the origin and far from it."""
    for far in (0.0, sizes):
        shape, offset = placed(name, seed, far, single)
        yield *run(work, shape, output), offset


def assert_alike(one, other, names, within=1e-6):
    for name in names:
        assert other[name] == pytest.approx(one[name], rel=within, abs=within), name


def axis_of(shape, **settings):
    return library.compute(shape.points, shape.triangles, samples=1500, **settings)


far = pytest.mark.parametrize("sizes", [1e3, 1e5])
farthest = pytest.mark.parametrize("sizes", [1e5])
every = pytest.mark.parametrize("name", SOLIDS)


@far
@every
def test_axes_have_the_radii_of_the_faces(name, sizes):
    """A ball ends at the faces, but for few that end at samples."""
    shape = placed(name, 1, sizes)[0]
    found, there = (axis_of(some, smooth=False) for some in (shape, placed(name, 1, 0.0)[0]))
    axis = found.axis
    assert axis.level.betti == there.axis.level.betti and found.topology == there.topology
    assert found.warnings == there.warnings
    rows = np.flatnonzero(axis.level.is_crisp)[::7]
    away = np.abs(to_triangles(axis.vertices[rows], shape.points[shape.triangles]))
    assert np.abs(axis.radius[rows] - away).max() <= 1e-14 * sizes + 1e-9
    assert axis.level.refused <= 0.1 * len(axis.vertices)


@far
@every
def test_thickness(name, sizes, tmp_path):
    work = Thickness(Settings(smooth=False, samples=1500), ThicknessSettings(limit=0.08))
    reports = [row[1] for row in near_and_far(work, name, 3, sizes, tmp_path / "t.json")]
    assert_alike(*reports, ["minimum", "area_below", "share_below"], 1e-14 * sizes + 1e-6)
    assert [len(report["patches"]) for report in reports] == [len(reports[0]["patches"])] * 2
    assert reports[0]["warnings"] == reports[1]["warnings"]
    for patch in reports[1]["patches"]:
        assert np.abs(patch["place"] - sizes * DIRECTION).max() <= 1.0


@farthest
@pytest.mark.parametrize("name", ["plate", "tube"])
def test_thicken(name, sizes, tmp_path):
    work = ThickerWalls(
        Settings(smooth=False, samples=1500), ThickenSettings(limit=0.1, subdivide=True)
    )
    reports, places = [], []
    for _, report, offset in near_and_far(work, name, 4, sizes, tmp_path / "thick.off"):
        reports.append(report)
        places.append(read_shape(tmp_path / "thick.off")[0].points - offset)
    one, other = reports
    assert_alike(one, other, ["minimum", "minimum_before"], 1e-5)
    # Which of two walls as near as each other fills in a place depends on the last bit.
    assert_alike(one, other, ["share_below"], 1e-4)
    # Each place has one of the other places beside it.
    away = np.linalg.norm(places[0][:, None] - places[1], axis=2)
    assert max(away.min(axis=0).max(), away.min(axis=1).max()) <= 1e-5


@farthest
@pytest.mark.parametrize("name", ["plate", "profile"])
def test_middle_surfaces(name, sizes, tmp_path):
    work = MiddleSurface(Settings(samples=3000), MidSurfaceSettings())
    reports = [row[1] for row in near_and_far(work, name, 5, sizes, tmp_path / "mid.obj")]
    names = ["sheets", "least_thickness", "largest_thickness", "share_of_volume"]
    assert_alike(*reports, names, 0.01)


@farthest
@pytest.mark.parametrize("name", ["box", "profile"])
def test_hollow(name, sizes, tmp_path):
    work = HollowSolid(Settings(), HollowSettings(wall=0.2 * SOLIDS[name][1], voxel_size=0.02))
    one, other = (row[1] for row in near_and_far(work, name, 6, sizes, tmp_path / "hollow.off"))
    assert_alike(one, other, ["wall", "least_wall", "deepest", "volume", "cavities"], 1e-3)
    assert one["warnings"] == other["warnings"]


@farthest
@pytest.mark.parametrize("name", ["tube", "profile"])
def test_skeletons(name, sizes, tmp_path):
    work = Skeletons(Settings(samples=1500), SkeletonSettings())
    reports = []
    for found, report, _ in near_and_far(work, name, 7, sizes, tmp_path / "s.swc"):
        reports.append(report)
        away = to_triangles(found.skeleton.points, found.shape.points[found.shape.triangles])
        assert (np.abs(away) >= 0.9 * found.skeleton.radius).all()
    assert_alike(*reports, ["loops", "pieces"])
    assert reports[0]["warnings"] == reports[1]["warnings"]


@farthest
@pytest.mark.parametrize("name", ["box", "profile"])
@pytest.mark.parametrize("shapes", [CoverShapes.BALLS, CoverShapes.CAPSULES])
def test_balls(name, sizes, shapes, tmp_path):
    work = Balls(Settings(samples=1500), BallSettings(count=12, shapes=shapes))
    reports = [row[1] for row in near_and_far(work, name, 8, sizes, tmp_path / "b.json")]
    assert_alike(*reports, ["covered"], 0.05)
    assert_alike(*reports, ["outside"], 1e-3)


@far
def test_reconstructions_and_small_meshes(sizes):
    points = icosphere(4)[0] * (0.5, 0.4, 0.3)
    offset = sizes * DIRECTION
    near, there = library.reconstruct(points), library.reconstruct(points + offset)
    np.testing.assert_allclose(there.vertices, near.vertices + offset, rtol=0, atol=1e-14 * sizes)
    shape, _ = placed("profile", 9, sizes)
    found = axis_of(shape)
    small = library.reduce(found, 20)
    away = np.abs(to_triangles(small.vertices, shape.points[shape.triangles]))
    assert np.abs(small.radius - away).max() <= 0.03
    again = library.extract(found, simplify=1.0)
    assert (np.abs(again.vertices - offset) < 2.0).all()


def test_points_alone():
    """Clouds, whose inside the poles or Tight Cocone tell."""
    points = icosphere(4)[0] * (0.5, 0.4, 0.3)
    for sides in (SidesFrom.POLES, SidesFrom.TIGHT_COCONE):
        near, there = (
            library.compute(points @ random_turn(2).T + far, sides=sides, form=Form.CLEAN)
            for far in (0.0, 1e5 * DIRECTION)
        )
        assert near.axis.level.betti == there.axis.level.betti
        assert near.axis.radius.max() == pytest.approx(there.axis.radius.max(), rel=0.01)


@pytest.mark.parametrize("name", ["plate", "profile"])
def test_single_coordinates_at_a_thousand_sizes(name, tmp_path):
    """Their noise is 10^-4 sizes there: the products are those at the origin up to a few times that."""
    work = Thickness(Settings(), ThicknessSettings(limit=0.08))
    pair = near_and_far(work, name, 3, 1e3, tmp_path / "t.json", single=True)
    reports = [row[1] for row in pair]
    assert bool(reports[1]["patches"]) == (SOLIDS[name][1] < 0.08)
    if SOLIDS[name][1]:
        assert_alike(*reports, ["minimum"], 2e-3)
    found, there = (axis_of(placed(name, 3, *how)[0]) for how in ((1e3, True), (0.0, False)))
    assert found.axis.level.betti == there.axis.level.betti


@pytest.mark.parametrize("name", ["box", "profile"])
def test_single_coordinates_at_a_hundred_thousand_sizes_are_told(name):
    """A hundredth of the size is lost there: a result has a warning, or there is none."""
    shape, _ = placed(name, 3, 1e5, single=True)
    try:
        found = axis_of(shape)
    except MedialAxisError:
        return
    assert any("known to about" in warning for warning in found.warnings)


@pytest.mark.parametrize("seed", range(8))
def test_moving_is_exact(seed):
    random = np.random.default_rng(seed)
    points = random.normal(size=(50, 3)) * 10.0 ** random.integers(-6, 6)
    points += random.normal(size=3) * 10.0 ** random.integers(-3, 9)
    shape, origin = in_own_frame(Shape(points, np.zeros((0, 3), np.int32)))
    np.testing.assert_array_equal(shape.points + origin, points)
    np.testing.assert_array_equal(shape.frame[:3, 3], origin)
    assert (np.abs(shape.points).max(axis=0) <= 2.0 * np.ptp(points, axis=0)).all()


def test_coordinates_of_32_bits_are_told_by_their_numbers(medial):
    grid = np.array(box()[0], float) * 100.0 + 300_000.0
    assert not medial.are_single(grid) and own_origin(grid).any()
    noisy = (grid + np.random.default_rng(1).normal(size=grid.shape)).astype(np.float32)
    assert medial.are_single(noisy.astype(float)) and not own_origin(noisy.astype(float)).any()
    assert medial.rounding_of(noisy.astype(float)) == pytest.approx(4.8e-7 * 3e5, rel=0.02)
    assert medial.rounding_of(grid) <= 4.8e-7 * 100.0
    assert medial.rounding_of(np.empty((0, 3))) == 0.0
