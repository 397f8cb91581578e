# SPDX-License-Identifier: GPL-3.0-or-later
"""Capsules that hold a solid have nearly the least volume: formulas, arrangements by hand, and random places."""

import medial_axis
import numpy as np
import pytest
from support import meshes
from support.distance import to_segment
from support.inputs import rotation

SIZE = np.array([0.4, 0.06, 0.05])


def box(size, low=(0.0, 0.0, 0.0)):
    vertices, triangles = meshes.box(half=np.array(size) / 2)
    return vertices + np.array(size) / 2 + low, triangles


def away(places, ends, radii):
    """(n,) distances of places from capsules of one radius each, negative inside."""
    gaps = [to_segment(places, a, b) - r for (a, b), r in zip(ends, radii, strict=True)]
    return np.min(gaps, axis=0)


def union(ends, radii):
    """The volume by random places."""
    low = (ends.min(axis=1) - radii[:, None]).min(axis=0)
    high = (ends.max(axis=1) + radii[:, None]).max(axis=0)
    places = np.random.default_rng(7).uniform(low, high, (100_000, 3))
    return np.prod(high - low) * (away(places, ends, radii) <= 0.0).mean()


def along_box(size):
    """The ends and the radius of the least capsule round a box along its first side."""
    half = np.hypot(size[1], size[2]) / 2
    radius = half * np.linspace(1.0, 1.5, 2001)
    length = np.maximum(size[0] - 2 * np.sqrt(radius**2 - half**2), 0.0)
    best = (np.pi * radius**2 * length + 4 / 3 * np.pi * radius**3).argmin()
    by = np.array([length[best] / 2, 0.0, 0.0])
    return np.stack([size / 2 - by, size / 2 + by]), radius[best]


def by_hand(across, up):
    """Capsules side by side along the box, so many across and up."""
    part = SIZE / (1, across, up)
    ends, radius = along_box(part)
    found = [ends + part * (0, i, j) for i in range(across) for j in range(up)]
    return np.array(found), np.full(len(found), radius)


def capsules(mesh, count):
    balls = medial_axis.cover_by_balls(*mesh, count=count, mode="around", shapes="capsules").balls
    pairs = np.concatenate([balls.edges, np.repeat(balls.single[:, None], 2, axis=1)])
    assert 1 <= len(pairs) <= count and balls.farthest == 0.0
    return balls.centres[pairs], balls.radii[pairs[:, 0]]


@pytest.mark.parametrize("seed", [None, 1])
def test_one_capsule_round_a_link_is_the_least(seed):
    """It had 3.6 times the volume: its ends stayed where balls fit inside."""
    vertices, triangles = box(SIZE)
    turn = np.eye(3) if seed is None else rotation(seed)
    found = union(*capsules((vertices @ turn.T, triangles), 1))
    ends, radius = along_box(SIZE)
    assert found < 1.05 * union(ends[None], np.array([radius]))


@pytest.mark.parametrize("count", [2, 4, 8])
def test_more_capsules_round_a_link_are_as_tight_as_by_hand(count):
    mesh = box(SIZE)
    ends, radii = capsules(mesh, count)
    places = np.random.default_rng(3).uniform(0.0, SIZE, (5_000, 3))
    assert away(places, ends, radii).max() < 1e-12
    grids = [(i, j) for i in range(1, count + 1) for j in range(1, count // i + 1)]
    assert union(ends, radii) < 1.2 * min(union(*by_hand(*grid)) for grid in grids)


def test_an_arm_of_two_links_has_a_capsule_for_each():
    mesh = meshes.join(box((1.0, 0.1, 0.1)), box((0.1, 1.0, 0.1), (1.0, 0.0, 0.0)))
    ends, radii = capsules(mesh, 2)
    best, radius = along_box(np.array((1.0, 0.1, 0.1)))
    assert union(ends, radii) < 1.2 * 2 * union(best[None], np.array([radius]))


@pytest.mark.parametrize("tapered", [False, True])
def test_places_of_each_group_are_held(medial, tapered):
    places = np.random.default_rng(0).normal(size=(3000, 3)) * (3.0, 1.0, 0.5)
    group = (places[:, 0] > 0.5).astype(np.int32)
    ends, radii = medial.least_capsules(places, group, count=3, tapered=tapered)
    assert ends.shape == (6, 3) and radii.shape == (6,) and (radii[4:] == 0.0).all()
    for row in (0, 1):
        (a, b), (p, q) = ends[2 * row : 2 * row + 2], radii[2 * row : 2 * row + 2]
        share = np.linspace(0.0, 1.0, 2001)[:, None]
        balls = np.linalg.norm(places[group == row][:, None] - (a + share * (b - a)), axis=2)
        assert (balls - (p + share * (q - p))[:, 0]).min(axis=1).max() < 1e-3
        assert tapered or p == q


def test_a_tapered_capsule_of_a_cone_is_smaller(medial):
    random = np.random.default_rng(1)
    height, angle = random.uniform(0.0, 4.0, 2000), random.uniform(0.0, 2 * np.pi, 2000)
    radius = 0.2 + 0.2 * height
    places = np.column_stack([radius * np.cos(angle), radius * np.sin(angle), height])
    group = np.zeros(len(places), np.int32)
    straight = medial.least_capsules(places, group, count=1)[1]
    sloping = medial.least_capsules(places, group, count=1, tapered=True)[1]
    assert sloping.min() < 0.6 * straight.min() and sloping.max() < 1.05 * straight.max()


@pytest.mark.parametrize(
    ("group", "words"),
    [
        (np.array([0, 2], np.int32), "Expected groups from 0 to 1, found 2"),
        (np.zeros(1, np.int32), "Expected a group for each of 2 places, found 1"),
    ],
)
def test_wrong_groups_are_refused(medial, group, words):
    with pytest.raises(medial.InvalidInputError, match=words):
        medial.least_capsules(np.eye(3)[:2], group, count=2)


def test_radii_to_begin_with_are_two_for_each_segment(medial):
    mesh = meshes.torus(1.0, 0.4, 16, 8)
    ends, segments = np.array([(-1.0, 0, 0), (1.0, 0, 0)]), np.array([(0, 1)], np.int32)
    with pytest.raises(medial.InvalidInputError, match="Expected two radii for each of 1 segments"):
        medial.cover_by_capsules(ends, segments, *mesh, radii=np.zeros(1))
    options = {"mode": medial.CoverMode.AROUND, "tapered": False, "places": 2000}
    found = medial.cover_by_capsules(ends, segments, *mesh, radii=np.ones(2), **options)
    assert np.array_equal(found.ends, ends)  # the segment leaves the solid, and stays
    assert np.allclose(found.radii, 1.4, rtol=0.01) and found.farthest == 0.0
