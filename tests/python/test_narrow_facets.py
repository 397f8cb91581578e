# SPDX-License-Identifier: GPL-3.0-or-later
"""Facets of some width are never dropped, however narrow they are relative to the balls at their vertices."""

import numpy as np
import pytest
from support import inputs, meshes, reference

from tests.support.fuzz import repeats

pytestmark = pytest.mark.oracle

# A share of the largest radius; a facet narrower than 2^-40 may be a point or a segment.
NARROWEST = 2.0**-39


def grid_of_a_box(size, steps):
    """Samples on the faces of a box: a lattice without its inside."""
    return inputs.hollow(tuple(np.add(steps, 1))) / np.array(steps) * np.array(size)


def turned(points, seed):
    """Turned in space, with coordinates rounded as meshes store them."""
    quaternion = np.random.default_rng(seed).integers(1, 30, 4).tolist()
    return inputs.turned(points, *quaternion).astype(np.float32).astype(np.float64)


CASES = {
    **{f"box {seed}": turned(grid_of_a_box((1, 1, 1), (5, 5, 5)), seed) for seed in range(4)},
    "long box": turned(grid_of_a_box((3, 1, 1), (8, 3, 3)), 7),
    "slab": turned(grid_of_a_box((1, 1, 1e-6), (8, 8, 1)), 8),
    "torus": meshes.torus(1.0, 0.4, 24, 8)[0].astype(np.float32).astype(np.float64),
}


@pytest.mark.parametrize("seed", repeats(4))
def test_fuzzed_boxes(study, seed):
    """The boxes have any size and aspect, are rotated and rounded to float32."""
    random = np.random.default_rng([seed, 13])
    steps = random.integers(1, 6, 3).tolist()
    size = 10.0 ** random.uniform(-3, 1, 3)
    assert_all_with_a_width(study, turned(grid_of_a_box(size, steps), seed))


@pytest.mark.parametrize("name", CASES)
def test_what_has_a_width_is_there(study, name):
    assert_all_with_a_width(study, CASES[name])


def assert_all_with_a_width(study, points):
    """Judged by exact centres; the reference shares no code with the product."""
    cells = study.delaunay(points)[0]
    cells = reference.sort_cells(cells[(cells >= 0).all(axis=1)])
    expected = reference.Voronoi(points, cells)
    analysis = study.MedialAnalysis(points, sides=study.SidesFrom.NONE)
    mesh, chosen = analysis.extract(0.0, 0.0), analysis.select(0.0, 0.0)
    there = set(map(tuple, mesh.generators.tolist()))
    bounded = chosen[expected.bounded[chosen]]
    missing = [edge for edge in bounded if tuple(expected.edges[edge].tolist()) not in there]
    assert len(missing) == mesh.zero_area
    widths = [width(expected, edge) for edge in missing]
    assert max(widths, default=0.0) < NARROWEST, sorted(widths)[-5:]


def width(expected, edge):
    """Second largest extent of a facet, over its largest radius."""
    facet, radius = expected.facet(edge), expected.radius[expected.rings[edge]].max()
    if len(facet) < 3:
        return 0.0
    return np.linalg.svd(facet - facet.mean(axis=0), compute_uv=False)[1] / radius


@pytest.mark.parametrize("name", CASES)
def test_the_others_have_corners_apart(medial, name):
    mesh = medial.MedialAnalysis(CASES[name], sides=medial.SidesFrom.NONE).extract(0.0, 0.0)
    assert len(np.unique(mesh.vertices, axis=0)) == len(mesh.vertices)
    assert np.diff(mesh.face_offsets).min() >= 3
