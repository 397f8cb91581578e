# SPDX-License-Identifier: GPL-3.0-or-later
"""The judge of inside and outside, against the sum of solid angles."""

import numpy as np
import pytest
from support import crossings, distance, meshes, messy, reference
from support.shape_meshes import MESHED

CASES = {
    "box": meshes.box((1, 1, 1)),
    "nested shell": meshes.nested_shell(2),
    "overlapping balls": meshes.join(
        meshes.icosphere(2), meshes.icosphere(2, 0.8, (0.9, 0.1, 0.05))
    ),
    "inside out": meshes.flip(meshes.icosphere(1)),
    "torus": MESHED["torus"][1],
    "cone": MESHED["cone"][1],
    "soup": messy.soup(meshes.uv_sphere(12, 6)),
}


@pytest.mark.parametrize("name", CASES)
def test_crossings_are_the_sum_of_solid_angles(name):
    vertices, triangles = CASES[name]
    rng = np.random.default_rng(1)
    near = vertices[rng.integers(0, len(vertices), 200)] * (1 + 1e-3 * rng.normal(size=(200, 1)))
    queries = np.concatenate((rng.uniform(-1.5, 1.5, (600, 3)), near))
    wanted = reference.winding_number(queries, vertices, triangles)
    assert np.abs(wanted - np.round(wanted)).max() < 1e-6 and len(np.unique(np.round(wanted))) > 1
    assert np.array_equal(crossings.winding(queries, vertices, triangles), np.round(wanted))


def test_no_ray_slips_between_triangles():
    """Rays straight through vertices and edges: queries below them along the very direction."""
    vertices, triangles = meshes.uv_sphere(16, 8)
    frame, _ = np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))
    edges = vertices[triangles].mean(axis=1)
    middles = 0.5 * (vertices[triangles[:, 0]] + vertices[triangles[:, 1]])
    targets = np.concatenate((vertices, middles, edges))
    far = targets - 5.0 * frame[:, 2]
    assert not crossings.winding(far, vertices, triangles).any()


def test_openscad(data_file):
    vertices, triangles = meshes.read(data_file("openscad-nonmanifold-crash.obj"))
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    queries = np.random.default_rng(2).uniform(low, high, (500, 3))
    found = crossings.winding(queries, vertices, triangles)
    wanted = np.round(reference.winding_number(queries, vertices, triangles))
    off = found != wanted
    assert distance.to_triangles(queries, vertices[triangles])[off].sum() < 1e-6 * np.ptp(vertices)
    assert (found > 0).any()
