# SPDX-License-Identifier: GPL-3.0-or-later
"""Few balls of a solid: exact shapes, every place counted by NumPy, the greedy choice by trying all, files, command."""

import json
from dataclasses import replace
from functools import cache

import medial_axis
import numpy as np
import pytest
from medial_axis.core.errors import DegenerateInputError, ExportError, InvalidInputError
from support import meshes, swept
from support.distance import points_on_triangles

SHIFT = np.array([0.4142, 0.5303, 0.4641])
BALL = meshes.icosphere(4)
TORUS = meshes.torus(1.0, 0.4, 48, 24)


def lattice(vertices, step):
    """(k, 3) all places of the lattice in the box of a solid, as its header says where they lie."""
    low, extent = vertices.min(axis=0), np.ptp(vertices, axis=0)
    size = np.floor(extent / step).astype(int) + 1
    first = low + (extent - step * size) / 2 + SHIFT * step
    axes = [first[k] + step * np.arange(size[k]) for k in range(3)]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)


def distances(places, balls):
    """(k, n) from places to the surfaces of balls, negative within."""
    centres, radii = balls
    return np.linalg.norm(places[:, None] - centres[None], axis=2) - radii


def on_surface(mesh, count=20_000):
    """(count, 3) random points of the surface."""
    return points_on_triangles(mesh[0][mesh[1]], count, np.random.default_rng(0))


@cache
def torus_case():
    """A torus and 300 random balls round its core, some of which reach out of it."""
    random = np.random.default_rng(4)
    angle, r = random.uniform(0, 2 * np.pi, 300), random.uniform(0.85, 1.15, 300)
    z = random.uniform(-0.1, 0.1, 300)
    centres = np.column_stack([r * np.cos(angle), r * np.sin(angle), z])
    return TORUS, centres, random.uniform(0.05, 0.5, 300)


def cover(medial, case, count, mode="INSIDE", **options):
    mesh, centres, radii = case
    mode = getattr(medial.CoverMode, mode)
    return medial.cover_by_balls(centres, radii, *mesh, count=count, mode=mode, **options)


def inner(medial, case):
    """The candidates inside the solid, by functions that are tested elsewhere."""
    mesh, centres, radii = case
    depth = medial.TriangleTree(*mesh).distances(centres)
    inside = medial.winding_number(centres, *mesh) > 0.5
    return centres, np.where(inside, np.minimum(radii, depth), 0.0), np.where(inside, depth, -depth)


def places_of(medial, case, step):
    found = lattice(case[0][0], step)
    return found[medial.winding_number(found, *case[0]) > 0.5]


# --- against trying all


def test_inside_is_the_greedy_choice(medial):
    case = torus_case()
    found = cover(medial, case, 12, places=3000, refine=False)
    centres, radii, _ = inner(medial, case)
    places = places_of(medial, case, found.step)
    assert found.places == len(places) >= 1500
    held = distances(places, (centres, radii)) <= 0
    left, chosen, shares = np.ones(len(places), bool), [], []
    for _ in range(12):
        best = int(held[left].sum(axis=0).argmax())  # of equal ones the first
        left &= ~held[:, best]
        chosen.append(best)
        shares.append(1 - left.mean())
    assert found.chosen.tolist() == chosen
    assert np.allclose(found.covered, shares, rtol=0, atol=1e-12)
    assert np.allclose(found.radii, radii[chosen], rtol=1e-14)


def test_around_follows_the_farthest_place(medial):
    case = torus_case()
    found = cover(medial, case, 12, "AROUND", places=3000, refine=False)
    centres, radii, _ = inner(medial, case)
    places = places_of(medial, case, found.step)
    places = places[np.lexsort(places.T[[0, 1, 2]])]  # rows along x, then those along y
    gaps = distances(places, (centres, radii))
    held = (gaps <= 0) & (radii > 0)
    left, away = np.ones(len(places), bool), np.full(len(places), np.inf)
    near, chosen = np.flatnonzero(radii > 0), []
    for _ in range(12):
        best = int(near[held[left][:, near].sum(axis=0).argmax()])
        chosen.append(best)
        left &= ~held[:, best]
        away = np.minimum(away, gaps[:, best])
        worst = int(away.argmax())
        of_worst = np.where(radii > 0, gaps[worst], np.inf)
        near = np.flatnonzero(of_worst <= max(0.25 * away[worst], of_worst.min()))
    assert found.chosen.tolist() == chosen


@pytest.mark.parametrize("refine", [True, False])
@pytest.mark.parametrize("mode", ["INSIDE", "AROUND"])
def test_figures_bound_what_is_measured(medial, mode, refine):
    case = torus_case()
    found = cover(medial, case, 10, mode, places=5000, refine=refine)
    balls = case[1][found.chosen], found.radii
    off = distances(on_surface(TORUS), balls).min(axis=1).max()
    assert off <= found.farthest + 1e-12
    assert found.farthest <= max(off, 0) + found.step
    outside = np.random.default_rng(1).normal(size=(10, 2000, 3))
    outside *= (found.radii / np.linalg.norm(outside, axis=2).T).T[:, :, None]
    rim = (balls[0][:, None] + outside).reshape(-1, 3)
    beyond = medial.winding_number(rim, *TORUS) < 0.5
    reach = medial.TriangleTree(*TORUS).distances(rim)[beyond].max(initial=0.0)
    assert reach <= found.outside + 1e-12
    if mode == "INSIDE":
        assert found.outside == 0.0 and reach <= 1e-12
    else:
        assert found.farthest == 0.0 and reach > 0.8 * found.outside
        assert (distances(places_of(medial, case, found.step), balls).min(axis=1) <= 1e-12).all()


# --- the refined choice


@cache
def rod_case():
    """A capsule of radius 0.3, 4 long between the centres of its ends, and 401 balls along it."""
    centres = np.column_stack([np.zeros((401, 2)), np.linspace(0.0, 4.0, 401)])
    return swept.capsule(4.0, 0.3, 96), centres, np.full(401, 0.3)


def least_reach(count):
    """How far the tips and the creases between `count` balls along the rod are from the balls, if all are as far: the
    best that is possible."""
    low, high = 0.0, 2.0
    for _ in range(60):
        reach = (low + high) / 2
        # Two balls that leave a crease so far away.
        between = 2 * np.sqrt((0.3 + reach) ** 2 - 0.3**2)
        low, high = (reach, high) if 2 * reach + (count - 1) * between < 4.0 else (low, reach)
    return high


@pytest.mark.parametrize("count", [4, 7, 16])
def test_around_a_rod_nearly_as_close_as_possible(medial, count):
    """16 balls that follow the farthest place reach out 1.5 to 2 times as far."""
    found = cover(medial, rod_case(), count, "AROUND", places=200_000)
    least = least_reach(count)
    assert 0.97 * least < found.outside < 1.15 * least + found.step


@cache
def hedgehog_case():
    """A ball with three thin spines, and balls along all of them."""
    parts, centres, radii = [meshes.icosphere(3)], [np.zeros((1, 3))], [np.ones(1)]
    for axis in range(3):
        spine = swept.capsule(2.0, 0.1)
        parts.append((np.roll(spine[0] + (0, 0, 1.05), axis + 1, axis=1), spine[1]))
        along = np.zeros((80, 3))
        along[:, axis] = np.linspace(1.05, 3.05, 80)
        centres.append(along)
        radii.append(np.full(80, 0.1))
    return meshes.join(*parts), np.concatenate(centres), np.concatenate(radii)


def test_no_thin_end_is_left_out(medial):
    """The first balls of the greedy choice are too few for all spines."""
    greedy, refined = (cover(medial, hedgehog_case(), 8, refine=x) for x in (False, True))
    assert refined.farthest < 0.6 * greedy.farthest and refined.outside == 0.0
    assert refined.held > 0.97 * greedy.held


def test_a_place_far_from_every_ball_does_not_loosen_the_others(medial):
    """One of the spines has no balls that could be chosen: the others are served as before."""
    solid, centres, radii = hedgehog_case()
    spine = swept.capsule(2.0, 0.1)
    more = meshes.join(solid, (spine[0] * (1, 1, -1) - (0, 0, 1.05), spine[1][:, ::-1]))
    alone = cover(medial, (solid, centres, radii), 10)
    found = cover(medial, (more, centres, radii), 10)
    assert found.farthest > 1.5  # from the tip of that spine
    off = [
        distances(on_surface(solid), (centres[one.chosen], one.radii)).min(axis=1).max()
        for one in (alone, found)
    ]
    assert off[1] < 1.25 * off[0]


def test_no_exchange_of_one_ball_holds_more(medial):
    """Every ball beside every other, counted by NumPy: one that holds more leaves some place farther away."""
    case = hedgehog_case()
    found = cover(medial, case, 8, places=3000)
    centres, radii, _ = inner(medial, case)
    held = distances(places_of(medial, case, found.step), (centres, radii)) <= 0
    away = distances(on_surface(case[0], 5000), (centres, radii))
    chosen = found.chosen.tolist()
    bound = away[:, chosen].min(axis=1).max()
    assert found.held == pytest.approx(held[:, chosen].any(axis=1).mean(), abs=1e-12)
    for slot in range(8):
        others = chosen[:slot] + chosen[slot + 1 :]
        more = (held | held[:, others].any(axis=1)[:, None]).mean(axis=0) > found.held + 1e-12
        far = np.minimum(away, away[:, others].min(axis=1)[:, None]).max(axis=0)
        assert (far[more] > bound - found.step).all()


# --- between inside and around


def test_tolerance_lies_between_inside_and_around(medial):
    case = torus_case()
    inside = cover(medial, case, 10, places=5000)
    before = inside.farthest
    assert before > 0.02
    for part in (0.25, 0.5, 0.75):
        found = cover(medial, case, 10, places=5000, tolerance=part * inside.farthest)
        assert found.chosen.tolist() == inside.chosen.tolist()
        assert 0 < found.outside <= part * inside.farthest * (1 + 1e-12)
        off = distances(on_surface(TORUS), (case[1][found.chosen], found.radii)).min(axis=1).max()
        assert off <= found.farthest + 1e-12 < before
        assert found.held > inside.held
        before = found.farthest
    far = cover(medial, case, 10, places=5000, tolerance=10.0)
    assert far.farthest == 0.0 and far.held == 1.0
    assert (far.radii >= inside.radii).all() and far.outside < 10.0


# --- orders, threads, scales


@pytest.mark.parametrize("mode", ["INSIDE", "AROUND"])
def test_the_first_balls_of_many_are_the_few(medial, mode):
    case = torus_case()
    many = cover(medial, case, 30, mode, places=5000, refine=False)
    assert (np.diff(many.covered) >= 0).all()
    before = np.full(30, np.inf)
    for count in (1, 2, 7, 20, 30):
        few = cover(medial, case, count, mode, places=5000, refine=False)
        assert few.chosen.tolist() == many.chosen[:count].tolist()
        assert few.covered.tolist() == many.covered[:count].tolist()
        if mode == "INSIDE":
            assert few.radii.tolist() == many.radii[:count].tolist()
        else:  # what a ball has to hold becomes less
            assert (few.radii <= before[:count]).all()
            before[:count] = few.radii


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"count": 0}, "Expected at least one ball and one place, found 0"),
        ({"tolerance": -1.0}, "Expected a finite tolerance of 0 or more, found -1"),
        ({"tolerance": np.nan}, "Expected a finite tolerance of 0 or more, found nan"),
        ({"radii": np.ones(2)}, "Expected one radius per centre, found 2 for 300"),
        ({"radii": np.full(300, np.nan)}, "Expected finite radii of 0 or more, found nan"),
        ({"centres": np.full((300, 3), np.inf)}, "centre"),
        ({"triangles": np.array([(0, 1, 9999)], np.int32)}, "9999"),
    ],
)
def test_what_cannot_be_is_refused(medial, change, words):
    mesh, *balls = torus_case()
    given = dict(zip(("centres", "radii", "vertices", "triangles"), (*balls, *mesh), strict=True))
    with pytest.raises(medial.InvalidInputError, match=words):
        medial.cover_by_balls(**(given | change))


def test_what_encloses_nothing_is_refused(medial):
    flat, nothing = meshes.moved(BALL, scale=(1.0, 1.0, 0.0)), (BALL[0], BALL[1][:0])
    for surface, place, words in (
        (flat, 0.0, "faces that enclose a volume"),
        (meshes.flip(BALL), 0.0, "faces that enclose a volume"),
        (nothing, 0.0, "faces that enclose a volume"),
        (BALL, 9.0, "balls in the solid"),
    ):
        with pytest.raises(medial.DegenerateInputError, match=f"Expected {words}"):
            cover(medial, (surface, np.full((1, 3), place), np.ones(1)), 3)


# --- through the front door


def covered(mesh, **options):
    return medial_axis.cover_by_balls(*mesh, **options)


def test_a_cloud_of_points_has_balls():
    points = np.random.default_rng(2).normal(size=(3000, 3))
    points *= (1.0, 0.7, 0.5) / np.linalg.norm(points, axis=1)[:, None]
    balls = covered((points,), count=8, sides="tight_cocone").balls
    assert balls.covered > 0.6 and balls.outside == 0.0


def test_an_open_surface_has_balls():
    vertices, triangles = meshes.icosphere(3)
    found = covered((vertices, triangles[8:]), count=4, sampling="vertices")
    assert found.balls.covered > 0.9


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"count": 0}, "Expected count from 1"),
        ({"count": "many"}, "Expected count as int, found 'many'"),
        ({"mode": "outside"}, "Expected mode as one of 'inside', 'around'"),
        ({"tolerance": 101.0}, "Expected tolerance from 0"),
        ({"refine": 2}, "Expected refine as bool, found 2"),
        ({"colour": 1}, "Expected settings among"),
    ],
)
def test_options_are_checked(options, words):
    with pytest.raises(InvalidInputError, match=words):
        covered(BALL, **options)


@pytest.mark.parametrize("shapes", ["balls", "capsules"])
def test_flat_points_are_refused(shapes):
    with pytest.raises(DegenerateInputError):
        covered((np.random.default_rng(1).random((50, 3)) * (1, 1, 0),), shapes=shapes)


# --- files


def test_files_say_the_same(tmp_path):
    found = covered(TORUS, count=9, sampling="vertices")
    balls = found.balls
    text = medial_axis.write_balls(found, tmp_path / "a.ma").read_text().split("\n")
    assert text[0] == "9 0 0" and text[-1] == ""
    rows = np.array([[float(word) for word in line.split()[1:]] for line in text[1:-1]])
    assert np.array_equal(rows, np.column_stack([balls.centres, balls.radii]))
    known = json.loads(medial_axis.write_balls(balls, tmp_path / "a.json").read_text())
    assert known["mode"] == "inside" and known["covered"] == balls.covered
    assert known["outside"] == 0.0 and known["farthest"] == balls.farthest
    assert [ball["radius"] for ball in known["balls"]] == balls.radii.tolist()
    assert [ball["centre"] for ball in known["balls"]] == balls.centres.tolist()
    words = r"ends in .ma, .json, .urdf, .mjcf or .xml, found 'a.ply'"
    with pytest.raises(ExportError, match=words):
        medial_axis.write_balls(balls, tmp_path / "a.ply")
    assert not (tmp_path / "a.ply").exists()


# --- files of robots


@cache
def few():
    return covered(TORUS, count=5, sampling="vertices").balls


@pytest.mark.parametrize("suffix", [".urdf", ".mjcf"])
def test_files_of_robots_refuse_what_they_cannot_hold(tmp_path, suffix):
    none = replace(few(), radii=np.where(np.arange(5) == 2, 0.0, few().radii))
    tapered = covered(TORUS, count=9, sampling="vertices", shapes="tapered").balls
    for balls, words in (
        (none, "Expected radii above 0 for a file of a robot, found 0"),
        (tapered, "found tapered capsules; set Shapes to Capsules"),
    ):
        with pytest.raises(ExportError, match=words):
            medial_axis.write_balls(balls, tmp_path / ("arm" + suffix))
    assert not list(tmp_path.iterdir())
