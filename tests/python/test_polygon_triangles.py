# SPDX-License-Identifier: GPL-3.0-or-later
"""Polygons of surfaces as triangles: always their boundary, and of those that bound a region, that region."""

from collections import Counter

import numpy as np
import pytest
from medial_axis.core.axis.polygon_triangles import polygon_triangles
from medial_axis.core.files.read_shape import read_shape
from medial_axis.core.machine import native
from support import topology

from tests.support.fuzz import repeats

pytestmark = pytest.mark.oracle

OUTLINES = {
    "L": [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)],
    "M": [(0, 0), (4, 0), (4, 4), (2, 1), (0, 4)],
    "straight": [(0, 0), (1, 0), (2, 0), (2, 2), (0, 2)],
    "dart": [(0, 0), (3, 0.1), (0, 0.2), (0.5, 0.1)],
    "dart at another corner": [(3, 0.1), (0, 0.2), (0.5, 0.1), (0, 0)],
    "spiral": [
        *[(0, 0), (6, 0), (6, 6), (0, 6), (0, 1), (1, 1), (1, 5), (5, 5), (5, 1), (0.5, 0.5)]
    ],
}


def triangles_of(points, ring):
    return polygon_triangles(points, np.array([0, len(ring)], np.int32), np.array(ring, np.int32))


def cut(points, ring=None):
    """The triangles of one polygon; its boundary is looked at, whatever it is."""
    ring = np.arange(len(points)) if ring is None else np.asarray(ring)
    triangles = triangles_of(points, ring)
    assert triangles.shape == (len(ring) - 2, 3) and triangles.dtype == np.int32
    # Corners with the same coordinates are one.
    place = np.unique(points, axis=0, return_inverse=True)[1].ravel()
    assert boundary(place[triangles]) == boundary(place[ring][None])
    return triangles


def boundary(polygons):
    """How often each edge is run along, less how often back."""
    runs = Counter()
    for a, b in zip(polygons.ravel(), np.roll(polygons, -1, axis=1).ravel(), strict=True):
        runs[min(a, b), max(a, b)] += int(a < b) - int(a > b)
    return {edge: count for edge, count in runs.items() if count}


def flat(outline, axes=(0, 1, 2)):
    """(n, 3) float64 in a plane normal to the last of the axes, turning the same way."""
    return np.column_stack([np.asarray(outline, float), np.zeros(len(outline))])[
        :, np.argsort(axes)
    ]


def signed_areas(points):
    """The areas of the triangles of a polygon, and the area of the polygon."""
    a, b, c = points[cut(points)].transpose(1, 2, 0)
    (ux, uy, _), (vx, vy, _), (x, y, _) = b - a, c - a, points.T
    whole = float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2)
    return (ux * vy - uy * vx) / 2, whole


def star_shaped(count, random):
    """A simple polygon with many corners that are not convex."""
    angles = 2 * np.pi * np.arange(count) / count
    return flat(np.stack([np.cos(angles), np.sin(angles)], 1) * random.uniform(0.2, 1, (count, 1)))


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("outline", OUTLINES.values(), ids=OUTLINES)
def test_concave_polygons_are_cut_inside(outline, turned):
    points = flat(outline)
    if turned:
        points = points[::-1].copy()
    areas, whole = signed_areas(points)
    assert np.sign(areas).tolist() == [np.sign(whole)] * (len(points) - 2)
    assert areas.sum() == pytest.approx(whole)


@pytest.mark.parametrize("axes", [(0, 1, 2), (1, 2, 0), (2, 0, 1)])
@pytest.mark.parametrize("scale", [1e-150, 1.0, 1e150])
def test_scale_and_plane_change_nothing(axes, scale):
    points = star_shaped(60, np.random.default_rng(1))
    expected = cut(points)
    np.testing.assert_array_equal(cut(scale * points[:, np.argsort(axes)]), expected)


def test_a_quad_is_cut_from_its_first_corner_where_it_is_convex():
    assert cut(flat([(0, 0), (1, 0), (1, 1), (0, 1)])).tolist() == [[0, 1, 2], [0, 2, 3]]
    bent = np.array([(0, 0, 0), (1, 0, 0.2), (1, 1, 0), (0, 1, 0.2)], float)
    assert cut(bent).tolist() == [[0, 1, 2], [0, 2, 3]]


def test_a_polygon_of_a_hundred_thousand_corners():
    """A star with as many spikes; the triangles have its area, none turns back."""
    areas, whole = signed_areas(star_shaped(100_000, np.random.default_rng(2)))
    assert areas.min() > 0
    assert areas.sum() == pytest.approx(whole, rel=1e-12)


def test_a_comb_of_a_hundred_thousand_corners():
    x = np.arange(50_000)
    teeth = np.column_stack([np.repeat(x, 2)[1:-1] / 50_000, np.tile([0, 0, 1, 1], 25_000)[1:-1]])
    areas, whole = signed_areas(flat([*teeth, (1, 2), (0, 2)]))
    assert areas.sum() == pytest.approx(whole, rel=1e-9)


@pytest.mark.parametrize("own_corners", [True, False], ids=["the same corners", "others there"])
@pytest.mark.parametrize("holes", [1, 5])
def test_holes_that_bridges_join_to_the_rim(holes, own_corners):
    """The outline runs along each bridge to the hole, round it, and back along the bridge."""
    rim = [(0, 0), (2 * holes, 0), (2 * holes, 3), (0, 3)]
    places, ring = list(rim), [0]
    for i in range(holes):
        first = len(places)
        places += [(2 * i + 0.5, 1), (2 * i + 0.5, 2), (2 * i + 1.5, 2), (2 * i + 1.5, 1)]
        ring += [first, first + 1, first + 2, first + 3, first, 0]
    ring += [1, 2, 3]
    points = flat(places)
    if not own_corners:
        points, ring = points[ring], np.arange(len(ring))
    areas = topology.vector_areas(points, triangles_of(points, ring))[:, 2]
    # The bridges from corner 0 to holes further on pass below the holes before them.
    assert len(areas) == len(ring) - 2 and areas.min() > 0
    assert areas.sum() == pytest.approx(6 * holes - holes)


def test_repeated_corners_and_spikes_leave_the_region_as_it_is():
    points = flat([(0, 0), (4, 0), (4, 0), (4, 4), (6, 4), (4, 4), (2, 1), (0, 4)])
    areas, _ = signed_areas(points)
    assert areas.min() >= 0 and areas.sum() == pytest.approx(10.0)


@pytest.mark.parametrize("start", range(6))
def test_a_dent_beside_a_repeated_corner(start):
    """The third corner lies on the last side; where the list of corners begins makes no difference."""
    outline = np.roll([(0, 0), (0, 0), (3, 1), (12, -2), (15, 1), (9, 3)], start, axis=0)
    assert_no_more_than_the_area(flat(outline))


def assert_no_more_than_the_area(points):
    areas, whole = signed_areas(points)
    assert np.abs(areas).sum() == abs(whole), points[:, :2].tolist()


TOUCHING = {
    "two spikes of a quad": [(0, 0), (2, 0), (0, 0), (1, 1)],
    "spike of a quad": [(0, 0), (2, 0), (1, 0), (1, 1)],
    "another corner first": [(1, 1), (0, 0), (2, 0), (1, 0)],
    "repeated": [(0, 0), (0, 0), (2, 0), (1, 1)],
    "straight": [(0, 0), (1, 0), (2, 0), (1, 1)],
    "touching": [(0, 0), (4, 0), (4, 4), (2, 0), (0, 4)],
    "folded side": [(0, 0), (8, 0), (4, 0), (6, 0), (8, 8), (2, 0), (0, 8)],
}


@pytest.mark.parametrize("name", TOUCHING)
@pytest.mark.parametrize("start", range(4))
def test_polygons_that_touch_themselves_have_no_more_than_their_area(name, start):
    assert_no_more_than_the_area(flat(np.roll(TOUCHING[name], start, axis=0)))


NO_REGION = {
    "crossing": [(0, 0), (2, 2), (2, 0), (0, 2), (-1, 1)],
    "one place": [(0, 0)] * 6,
    "one line": [(i, i) for i in range(7)],
    "too large": [(0, 0), (1e308, 0), (-1e308, 1), (0, 2), (-1, 1)],
}


@pytest.mark.parametrize("name", NO_REGION)
def test_what_bounds_no_region_still_has_its_boundary(name):
    cut(flat(NO_REGION[name]))


@pytest.mark.parametrize("column", [0, 1, 2])
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("corners", [3, 4, 5, 9])
def test_corners_that_are_no_numbers_are_refused(corners, value, column):
    points = star_shaped(corners + 1, np.random.default_rng(corners))
    ring, offsets = np.arange(corners, dtype=np.int32), np.array([0, corners], np.int32)
    points[corners, column] = value  # of no polygon
    module = native.load()
    assert module.polygon_triangles(points, offsets, ring).shape == (corners - 2, 3)
    points[1, column] = value
    with pytest.raises(module.InvalidInputError, match=r"^Expected finite .* in row 1; repair"):
        module.polygon_triangles(points, offsets, ring)


def test_random_polygons_cross_themselves_and_end_soon():
    random = np.random.default_rng(5)
    cut(flat(random.normal(size=(100_000, 2))))
    cut(flat(np.column_stack([np.arange(100_000), np.zeros(100_000)])))
    x = np.arange(50_000)
    back = np.column_stack([[*x, 1, 0], [*np.zeros(50_000), 0, 1]])  # back along all of them
    cut(flat(back))


def test_a_polygon_that_winds_twice_round_a_part_keeps_its_boundary():
    """The polygon has as many faces in its plane as one without crossings; two of them count twice."""
    points = np.array([(0, 4, 1), (4, 0, 3), (4, 2, 4), (4, 0, 4), (3, 3, 4), (0, 4, 4)], float)
    for turn in (np.eye(3), np.array([(0.6, 0.8, 0.0), (-0.8, 0.6, 0.0), (0.0, 0.0, 1.0)])):
        cut(points @ turn, [0, 1, 2, 3, 4, 1, 3, 5])


@pytest.mark.parametrize("seed", repeats(60))
def test_fuzzed_polygons(seed):
    """On few places, so that corners repeat, edges overlap and touch; turned in space; each with its boundary."""
    random = np.random.default_rng([seed, 15])
    for _ in range(100):
        count, grid = random.integers(3, 40), random.choice([2, 3, 5, 1000])
        points = random.integers(0, grid, (count, 3)).astype(float)
        points[:, 2] *= random.choice([0, 0, 1])
        if random.random() < 0.5:
            points = points @ np.linalg.qr(random.normal(size=(3, 3)))[0]
        cut(points * 10.0 ** random.integers(-80, 80), random.integers(0, count, count))


@pytest.mark.parametrize("seed", repeats(20))
def test_fuzzed_simple_polygons(seed):
    random = np.random.default_rng([seed, 16])
    areas, whole = signed_areas(star_shaped(int(random.integers(5, 3000)), random))
    assert areas.min() > 0
    assert areas.sum() == pytest.approx(whole)


STEP = 32


def degenerate(random):
    """(n, 2) whole numbers: an outline that was repeatedly given another corner without any area.

    Such a corner repeats its neighbour, lies on a side, or is the tip of a spike: one that leads out of a corner, lies
    in the side before it, or goes beyond the end of that side. The outlines are wide enough for all of them.
    """
    ring = [STEP * np.array(p) for p in OUTLINES[random.choice(["L", "M", "straight", "spiral"])]]
    ring = np.roll(ring, random.integers(len(ring)), axis=0)[:: random.choice([1, -1])]
    for _ in range(random.integers(1, 9)):
        i = int(random.integers(len(ring)))
        here, after = ring[i], ring[(i + 1) % len(ring)]
        share = random.integers(1, 4)
        between = here + share * ((after - here) // 4)
        beyond = after + np.sign(after - here) * ((abs(after - here) > 0).sum() == 1)
        tips = [
            [here],
            [between] if ((after - here) % 4 == 0).all() else [here],
            [here + random.integers(-1, 2, 2), here],
            [between, here] if ((after - here) % 4 == 0).all() else [here],
            [beyond],
        ]
        ring = np.insert(ring, i + 1, tips[random.integers(len(tips))], axis=0)
    return np.roll(ring, random.integers(len(ring)), axis=0).astype(float)


@pytest.mark.parametrize("seed", repeats(20))
def test_fuzzed_polygons_without_crossings_have_no_more_than_their_area(seed):
    random = np.random.default_rng([seed, 17])
    for _ in range(50):
        assert_no_more_than_the_area(flat(degenerate(random)))


@pytest.mark.parametrize("seed", repeats(20))
def test_rounding_of_turned_polygons_adds_no_area(seed):
    """Corners without area lie off their sides by rounding, so that the polygon crosses itself by as little."""
    random = np.random.default_rng([seed, 18])
    for _ in range(50):
        outline = flat(degenerate(random))
        _, whole = signed_areas(outline)
        points = outline @ np.linalg.qr(random.normal(size=(3, 3)))[0] + random.normal(size=3)
        area = topology.area(points, triangles_of(points, np.arange(len(points))))
        assert area == pytest.approx(abs(whole), rel=1e-9), outline[:, :2].tolist()


def test_an_obj_cylinder_with_caps_of_many_corners(tmp_path):
    count = 20_000
    angles = np.linspace(0, 2 * np.pi, count, endpoint=False)
    lines = [f"v {np.cos(a):.9g} {np.sin(a):.9g} {z}" for a in angles for z in (0, 1)]
    low = 2 * np.arange(count) + 1
    after = np.roll(low, -1)
    faces = [*np.column_stack((low, after, after + 1, low + 1)), low[::-1], low + 1]
    lines += ["f " + " ".join(map(str, face)) for face in faces]
    (tmp_path / "a.obj").write_text("\n".join(lines))
    shape, _ = read_shape(tmp_path / "a.obj")
    assert len(shape.triangles) == 2 * count + 2 * (count - 2)
    assert topology.volume(shape.points, shape.triangles) == pytest.approx(np.pi, rel=1e-6)
