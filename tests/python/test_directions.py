# SPDX-License-Identifier: GPL-3.0-or-later
"""Normals of sheets and tangents of curves at vertices, on shapes whose directions are known."""

import numpy as np
from medial_axis.core.axis.directions import corners_after, curve_tangents, sheet_normals


def quads(across, round_):
    """(offsets, corners) of a strip: vertex 2 i + s lies at place i, on side s; `round_` are its last two corners."""
    first = 2 * np.arange(across)
    rows = np.column_stack([first, first + 1, first + 3, first + 2]).astype(np.int32)
    rows[-1, 2:] = round_
    return np.arange(0, 4 * across + 1, 4, dtype=np.int32), rows.ravel()


def test_areas_keep_the_bits_that_numpy_gives(medial):
    """NumPy sums eight terms at once from eight on, and halves from 129 on."""
    rng = np.random.default_rng(3)
    sizes = rng.permutation([*range(3, 40), 128, 129, 130, 131, 137, 138, 300, 1000])
    offsets = np.concatenate([[0], np.cumsum(sizes)]).astype(np.int32)
    vertices = rng.normal(size=(500, 3))
    corners = rng.integers(500, size=offsets[-1]).astype(np.int32)
    starts = offsets[:-1]
    away = vertices[corners] - np.repeat(vertices[corners[starts]], sizes, axis=0)
    after = away[corners_after(offsets)]
    wanted = np.add.reduceat(np.cross(away, after), starts, axis=0)
    np.testing.assert_array_equal(medial.polygon_areas(vertices, offsets, corners), wanted)


def test_a_moebius_strip_has_normals_all_round():
    angle = np.linspace(0.0, 2.0 * np.pi, 60, endpoint=False)[:, None]
    out = np.hstack([np.cos(angle), np.sin(angle), 0.0 * angle])
    side = np.cos(angle / 2) * out + np.sin(angle / 2) * [0.0, 0.0, 1.0]
    vertices = np.stack([out - 0.2 * side, out + 0.2 * side], axis=1).reshape(-1, 3)
    offsets, corners = quads(60, (0, 1))  # the two sides are exchanged
    found = sheet_normals(vertices, offsets, corners, np.zeros(60, np.int32))
    np.testing.assert_allclose(np.linalg.norm(found, axis=1), 1.0, rtol=1e-12)
    along = np.cross([0.0, 0.0, 1.0], out)
    exact = np.cross(side, along).repeat(2, axis=0)
    assert np.abs(np.sum(found * exact, axis=1)).min() > 0.97


def test_a_seam_has_the_normal_of_the_larger_part():
    flat, upright = [[0, 0, 0], [0, 1, 0], [3, 1, 0], [3, 0, 0]], [[0, 1, 1], [0, 0, 1]]
    vertices = np.array([*flat, *upright, [9, 9, 9]], float)
    corners = np.array([0, 3, 2, 1, 0, 1, 4, 5], np.int32)
    offsets = np.array([0, 4, 8], np.int32)
    for part in ([0, 1], [7, 2]):
        found = sheet_normals(vertices * 1e300, offsets, corners, np.array(part, np.int32))
        np.testing.assert_array_equal(found[:4], np.tile([0.0, 0.0, 1.0], (4, 1)))
        np.testing.assert_array_equal(np.abs(found[4:6]), np.tile([1.0, 0.0, 0.0], (2, 1)))
        np.testing.assert_array_equal(found[6], np.zeros(3))


def test_tangents_go_straight_through_a_fork():
    bar = [[-2, 0, 0], [-1, 0, 0], [0, 0, 0], [1, 0.1, 0]]
    vertices = np.array([*bar, [0, 1, 0], [5, 5, 5]], float)
    wires = np.array([[0, 1], [1, 2], [2, 3], [4, 2]], np.int32)
    found = curve_tangents(vertices, wires)
    np.testing.assert_allclose(found[:2], np.tile([1.0, 0.0, 0.0], (2, 1)))
    assert found[2] @ [1.0, 0.0, 0.0] > 0.998
    np.testing.assert_allclose(found[4:], [[0.0, -1.0, 0.0], [0.0, 0.0, 0.0]], atol=1e-15)
