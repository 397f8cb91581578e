# SPDX-License-Identifier: GPL-3.0-or-later
"""Facets of a curved sheet that lie turned over beside a rim, as where walls are thinner than samples are apart."""

import numpy as np
from medial_axis.core.mid_surface.carried_sheets import carried
from medial_axis.core.mid_surface.sheet_walls import Walls
from medial_axis.core.mid_surface.thin_sheets import ThinSheets
from medial_axis.core.shape.triangles import unit_normals
from support.thick_meshes import pipe

AROUND, ROWS, WALL = 24, 12, 0.1


def sheet():
    """The middle of a pipe of radius 1 and height 2; three rows of facets at each rim tell nothing."""
    angle = 2.0 * np.pi * np.arange(AROUND) / AROUND
    ring = (1.0 - WALL / 2) * np.column_stack((np.cos(angle), np.sin(angle), 0.0 * angle))
    vertices = np.concatenate([ring + np.array((0, 0, z)) for z in np.linspace(0.05, 1.95, ROWS)])
    row, place = np.divmod(np.arange(AROUND * (ROWS - 1)), AROUND)
    a, b = AROUND * row + place, AROUND * row + (place + 1) % AROUND
    squares = np.column_stack((a, b, b + AROUND, a, b + AROUND, a + AROUND))
    triangles = squares.reshape(-1, 3).astype(np.int32)
    normals, _ = unit_normals(vertices[triangles])
    facet = np.arange(len(triangles)) // 2
    facing = np.repeat((row >= 3) & (row < ROWS - 4), 2)
    return vertices, triangles, normals, facet, facing


def test_facets_that_are_turned_over_tell_no_plane():
    vertices, triangles, normals, facet, facing = sheet()
    turned = facet == AROUND + 5  # in the second row
    normals[turned] *= -1.0
    count = len(triangles)
    of_vertices = np.full(len(vertices), WALL / 2), np.zeros(len(vertices), bool)
    of_triangles = triangles, np.zeros(count, np.int32), facet, facing | turned
    of_triangles += np.zeros(count, bool), normals, np.zeros_like(normals)
    made = ThinSheets(vertices, *of_vertices, *of_triangles, 1)
    found = carried(made, Walls(*pipe(AROUND, 1.0, 1.0, WALL, 2.0), np.zeros((0, 2), np.int32)))
    moves = found.vertices - vertices
    np.testing.assert_allclose(moves[:AROUND, 2], -0.05, atol=1e-9)
    np.testing.assert_allclose(moves[-AROUND:, 2], 0.05, atol=1e-9)
    assert np.linalg.norm(moves[AROUND:-AROUND], axis=1).max() < 0.01 * WALL
