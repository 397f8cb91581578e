# SPDX-License-Identifier: GPL-3.0-or-later
"""The ranges of sliders: half of what can go goes at one half, and lengths and shares are one curve."""

from dataclasses import replace

import numpy as np
import pytest
from medial_axis.core.axis.compute import compute, extract_axis
from medial_axis.core.axis.directions import facet_areas
from medial_axis.core.axis.slider_range import slider_range
from medial_axis.core.settings import Form, Mesh, SamplingMode, Settings
from support.meshes import box, icosphere


def test_lengths_and_shares_are_one_curve():
    rng = np.random.default_rng(5)
    found = slider_range(rng.lognormal(size=20_000), rng.random(20_000))
    assert len(found.lengths) < 600
    assert (np.diff(found.lengths) > 0).all() and (np.diff(found.shares) > 0).all()
    for share in (0.0, 0.01, 0.3, 0.5, 0.98, 1.0):
        assert found.share(found.length(share)) == pytest.approx(share, abs=1e-12)


def test_half_means_half():
    rng = np.random.default_rng(6)
    values, weights = rng.lognormal(sigma=2.0, size=5000), rng.random(5000)
    found = slider_range(values, weights)
    for share in (0.0, 0.1, 0.5, 0.9, 1.0):
        gone = weights[values <= found.length(share)].sum() / weights.sum()
        assert gone == pytest.approx(share, abs=0.005)


def test_one_large_sheet_goes_in_the_middle_of_its_share():
    found = slider_range(np.array([1.0, 2.0, 3.0]), np.array([1.0, 8.0, 1.0]))
    assert found.length(0.49) < 2.0 < found.length(0.51)
    assert found.length(1.0) > 3.0


def test_what_cannot_go_has_no_range():
    assert slider_range(np.array([np.inf, 0.0]), np.ones(2)) is None
    assert slider_range(np.zeros(0), np.zeros(0)) is None


def test_areas_are_those_of_polygons():
    angles = np.linspace(0.0, 2.0 * np.pi, 6, endpoint=False)
    hexagon = np.column_stack([np.cos(angles), np.sin(angles), np.full(6, 3.0)])
    triangle = np.array([[0.0, 0, 0], [0, 2, 0], [0, 0, 2]])
    vertices, corners = np.concatenate([triangle, hexagon]), np.arange(9, dtype=np.int32)
    found = facet_areas(vertices, np.array([0, 3, 9], np.int32), corners)
    assert found == pytest.approx([2.0, 1.5 * np.sqrt(3.0)])


def test_sliders_of_a_box_act_from_end_to_end():
    settings = Settings(sampling=SamplingMode.SURFACE, samples=2000)
    computation = compute(*box(), replace(settings, mesh=Mesh.VORONOI))
    ranges, whole = computation.axis.level.ranges, computation.axis.facets

    def moved(slider, share, **changed):
        changed[slider] = ranges[slider].length(share)
        return extract_axis(computation, replace(settings, **changed))

    assert 0.3 * whole < moved("erode", 0.5, mesh=Mesh.VORONOI).facets < 0.7 * whole
    assert moved("erode", 1.0, mesh=Mesh.VORONOI).facets == 0
    assert moved("simplify", 1.0).facets == 0
    curve = moved("limb", 1.0, form=Form.CURVE)
    assert len(curve.edges) == 0 or np.isinf(curve.level.limb).all()


def test_a_branch_counts_by_its_length_squared():
    """Many bristles beside few limbs would else fill the whole slider."""
    points, triangles = icosphere(4)
    points = points * (1.0 + 0.02 * np.random.default_rng(2).normal(size=(len(points), 1)))
    points[:, 0] *= 3.0
    found = compute(points, triangles, Settings(form=Form.CURVE)).axis.level.ranges["limb"]
    assert found.share(0.05 * found.lengths[-1]) < 0.5
