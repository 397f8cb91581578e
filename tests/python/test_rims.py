# SPDX-License-Identifier: GPL-3.0-or-later
"""Rims of even meshes of points without faces: no saws, and balls that end at the points."""

import math

import numpy as np
import pytest

pytestmark = pytest.mark.oracle

CLEAN = {"spacings": 1.0}
# shape -> mean angle between rim edges in degrees; n = 8000, the worst measured times 1.5
TURN = {"oblate": 13.0, "ellipsoid": 14.0, "box": 43.0}
OBLATE_RIM = 2 * math.pi * 0.75


def rim_edges(level):
    """(r, 2) edges with exactly one polygon."""
    corners, offsets = level.face_vertices, level.face_offsets
    following = np.roll(corners, -1)
    following[offsets[1:] - 1] = corners[offsets[:-1]]
    pairs = np.sort(np.column_stack((corners, following)), axis=1)
    edges, times = np.unique(pairs, axis=0, return_counts=True)
    return edges[times == 1]


def mean_turn(places, edges):
    """In degrees, at vertices with two rim edges."""
    at = {}
    for a, b in edges.tolist():
        at.setdefault(a, []).append(b)
        at.setdefault(b, []).append(a)
    turns = []
    for v, others in at.items():
        if len(others) != 2:
            continue
        into, out = places[v] - places[others[0]], places[others[1]] - places[v]
        size = np.linalg.norm(into) * np.linalg.norm(out)
        if size > 0:
            turns.append(math.degrees(math.acos(np.clip(into @ out / size, -1, 1))))
    return np.mean(turns)


@pytest.mark.parametrize("name", TURN)
@pytest.mark.parametrize("seed", [0, 1])
def test_rims_are_no_saws(sampled, name, seed):
    _, _, hierarchy = sampled(name, 8000, seed)
    level = hierarchy.even(**CLEAN).extract(relaxed=True)
    facets = hierarchy.extract(**CLEAN)
    assert mean_turn(facets.vertices, rim_edges(facets)) > 45
    assert mean_turn(level.vertices, rim_edges(level)) < TURN[name]


@pytest.mark.parametrize("seed", [0, 1])
def test_rim_of_an_oblate_has_its_length(sampled, seed):
    _, _, hierarchy = sampled("oblate", 8000, seed)
    level = hierarchy.even(**CLEAN).extract(relaxed=True)
    a, b = rim_edges(level).T
    length = np.linalg.norm(level.vertices[a] - level.vertices[b], axis=1).sum()
    assert 0.98 < length / OBLATE_RIM < 1.05


def test_balls_of_moved_vertices_are_empty(sampled):
    shape, _, hierarchy = sampled("box", 2000)
    level = hierarchy.even(**CLEAN).extract(relaxed=True)
    points = shape.sample(2000, 0)
    nearest = np.linalg.norm(level.vertices[:, None] - points, axis=2).min(axis=1)
    assert level.radius == pytest.approx(nearest, rel=1e-9)
