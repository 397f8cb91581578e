# SPDX-License-Identifier: GPL-3.0-or-later
"""Distances to exactly known medial axes, at 2000 samples over 5 seeds and at 8000; and the structure of the output.

The 8000-sample runs use 1 seed by default, all 5 with --slow.
"""

from functools import cache

import numpy as np
import pytest
from support import inputs, measure, meshes, reference, shapes
from support.accuracy import BARS
from support.shapes import SHAPES

pytestmark = pytest.mark.oracle

BETTI = {
    "ellipsoid": (1, 0, 0), "oblate": (1, 0, 0), "slab": (1, 0, 0), "shell": (1, 0, 1),
    "torus": (1, 1, 0), "knot": (1, 1, 0),
}  # fmt: skip


@pytest.fixture(scope="module")
def extracted(medial):
    """(shape, n, seed) -> mesh with the paper's thresholds, computed once."""
    return cache(lambda *key: medial.MedialAnalysis(SHAPES[key[0]].sample(*key[1:])).extract())


def assert_within_bars(mesh, name, n):
    pairs = [*zip(measure.errors(mesh, SHAPES[name]).row(), BARS[name][n])]
    assert all(a <= b for a, b in pairs), [f"{a:.2g} of {b:.2g}" for a, b in pairs]


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("name", BARS)
def test_distances_at_2000_samples(extracted, name, seed):
    assert_within_bars(extracted(name, 2000, seed), name, 2000)


@pytest.mark.parametrize(
    "seed", [0] + [pytest.param(seed, marks=pytest.mark.slow) for seed in range(1, 5)]
)
@pytest.mark.parametrize("name", BARS)
def test_distances_at_8000_samples(extracted, name, seed):
    assert_within_bars(extracted(name, 8000, seed), name, 8000)


@pytest.mark.parametrize("name", ["ellipsoid", "oblate", "slab", "shell"])
def test_sheets_converge_with_the_square_of_the_spacing(medial, extracted, name):
    """o->t mean falls by 16 when the number of samples does: order 2 in h, here at least 1.7."""
    coarse, fine = (measure.errors(extracted(name, n, 0), SHAPES[name]) for n in (2000, 8000))
    assert np.log(coarse.output_mean / fine.output_mean) / np.log(2.0) > 1.7
    assert fine.truth_mean < coarse.truth_mean and fine.truth_max < coarse.truth_max


def test_the_judge_of_topology_knows_surfaces():
    sphere = meshes.icosphere(1)
    for (_, triangles), betti in (
        (sphere, (1, 0, 1)),
        (meshes.torus(around=8, across=6), (1, 2, 1)),
        (meshes.join(sphere, meshes.box((2, 2, 2))), (2, 0, 2)),
        ((sphere[0], sphere[1][1:]), (1, 0, 0)),
        ((sphere[0], sphere[1][[0, 40, 41]]), (2, 0, 0)),
    ):
        count = len(np.unique(triangles))
        assert reference.betti_numbers(count, triangles.tolist()) == betti


@pytest.mark.parametrize("name", BETTI)
def test_topology_at_2000_samples(extracted, name):
    """Betti numbers of the closed inner complex, mod 2. Raw output may have an island at its rim for some seeds
    (algorithm: sect. 5 of the measurements), so most of the 5 seeds must be exactly right."""
    raw = [extracted(name, 2000, seed) for seed in range(5)]
    inner = [measure.keep(mesh, measure.inner_facets(mesh, SHAPES[name])) for mesh in raw]
    found = [
        reference.betti_numbers(len(np.unique(c)), [x.tolist() for x in np.split(c, ends[1:-1])])
        for ends, c in inner
    ]
    assert found.count(BETTI[name]) >= 3, found


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("name", ["ellipsoid", "oblate"])
def test_no_facet_of_an_ellipsoid_reaches_infinity(extracted, name, seed):
    assert extracted(name, 2000, seed).unbounded == 0


@pytest.mark.parametrize("turn", range(3))
def test_turned_grid_cube(medial, turn):
    """The same with rounding errors in every tie."""
    rotation = inputs.rotation(turn)
    mesh = medial.MedialAnalysis(shapes.grid_cube(8) @ rotation.T).extract()
    cube = shapes.Box(4.0, 4.0, 4.0)
    inside = cube.inside(mesh.vertices @ rotation)
    inner = np.logical_and.reduceat(inside[mesh.face_vertices], mesh.face_offsets[:-1])
    _, corners = measure.keep(mesh, inner)
    assert inner.sum() == 192
    assert cube.axis_distance(mesh.vertices[np.unique(corners)] @ rotation).max() <= 1e-6


def test_radius_is_the_distance_to_the_surface(extracted):
    """The closed form for the ellipsoid is r^2 = c^2 (1 - x^2/(a^2 - c^2) - y^2/(b^2 - c^2))."""
    mesh, ellipsoid = extracted("ellipsoid", 8000, 0), SHAPES["ellipsoid"]
    p, q = ellipsoid.axis_ellipse
    middle = (mesh.vertices[:, 0] / p) ** 2 + (mesh.vertices[:, 1] / q) ** 2 < 0.9
    assert middle.sum() > 1000
    assert np.abs(mesh.radius - ellipsoid.axis_radius(mesh.vertices))[middle].max() < 5e-3


def test_cavity_axis_of_the_shell(medial):
    """The outer axis inside the cavity is the inner axis of the middle surface."""
    shell = SHAPES["shell"]
    mesh = medial.MedialAnalysis(shell.sample(8000, 0)).extract()
    middle = shell.middle
    cavity = middle.inside(mesh.vertices) & ~shell.inside(mesh.vertices)
    facet = np.logical_and.reduceat(cavity[mesh.face_vertices], mesh.face_offsets[:-1])
    offsets, corners = measure.keep(mesh, facet)
    output = measure.fan_triangles(mesh.vertices, offsets, corners).mean(axis=1)
    assert facet.sum() > 1000
    assert middle.axis_distance(output).mean() < 2e-4
