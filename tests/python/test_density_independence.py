# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's headline: one theta and one rho serve every density; the axes agree within the coarser spacing."""

import numpy as np
import pytest
from support import alike, meshes, resampled, topology
from support.shape_meshes import MESHED

pytestmark = pytest.mark.oracle


def assert_alike(mesh, coarse, fine):
    axes = [resampled.of_surface(mesh, count).axis for count in (coarse, fine)]
    spacing = resampled.spacing(topology.area(*mesh), coarse)
    there, back = alike.mutual(*axes, lambda places: np.full(len(places), spacing))
    assert there <= 1.0 and back <= 1.0


@pytest.mark.parametrize("name", ["ellipsoid", "slab", "torus", "box", "cylinder"])
def test_the_axis_of_4000_samples_is_that_of_16000(name):
    assert_alike(MESHED[name][1], 4000, 16_000)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["ellipsoid", "slab", "torus", "box", "cylinder", "frustum"])
def test_the_axis_of_16000_samples_is_that_of_64000(name):
    assert_alike(MESHED[name][1], 16_000, 64_000)


@pytest.mark.slow
@pytest.mark.parametrize("file", ["rocker-arm.off", "hand_closed.obj"])
def test_real_meshes(data_file, file):
    assert_alike(meshes.read(data_file(file)), 4000, 16_000)


@pytest.mark.parametrize("name", ["ellipsoid", "box"])
def test_spacings_that_vary_by_ten_give_the_axis_of_even_ones(medial, name):
    _, mesh = MESHED[name]
    samples, axis = resampled.graded(medial, mesh, 16_000)
    even = resampled.of_surface(mesh, 16_000).axis
    local = alike.spacings(samples, medial, samples.points)
    assert np.quantile(local, 0.999) > 5 * np.quantile(local, 0.001)
    ours = resampled.spacing(topology.area(*mesh), 16_000)
    coarser = lambda places: np.maximum(alike.spacings(samples, medial, places), ours)
    there, back = alike.mutual(axis, even, coarser)
    assert there <= 1.0 and back <= 1.0
    assert len(axis.generators) > 0.3 * len(even.generators)
