# SPDX-License-Identifier: GPL-3.0-or-later
"""The ranges of sliders: half of what can go goes at one half, and lengths and shares are one curve."""

from dataclasses import replace

import numpy as np
import pytest
from medial_axis.core.axis.compute import compute, extract_axis
from medial_axis.core.axis.directions import facet_areas
from medial_axis.core.axis.slider_range import slider_range
from medial_axis.core.settings import Criteria, Form, Mesh, Rule, SamplingMode, Settings, Side
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
    points, triangles = box()
    settings = Settings(sampling=SamplingMode.SURFACE, samples=2000, mesh=Mesh.VORONOI)
    computation = compute(points, triangles, settings)
    ranges = computation.axis.level.ranges
    whole = computation.axis.facets
    erode = ranges["erode"]
    half, none = (
        extract_axis(computation, Settings(**kept(erode=erode.length(share)), mesh=Mesh.VORONOI))
        for share in (0.5, 1.0)
    )
    assert 0.3 * whole < half.facets < 0.7 * whole and none.facets == 0
    bare = extract_axis(computation, Settings(**kept(simplify=ranges["simplify"].length(1.0))))
    assert bare.facets == 0
    curve = extract_axis(
        computation, Settings(**kept(form=Form.CURVE, limb=ranges["limb"].length(1.0)))
    )
    assert len(curve.edges) == 0 or np.isinf(curve.level.limb).all()


@pytest.mark.parametrize("rule", list(Rule))
@pytest.mark.parametrize("criteria", [Criteria.ANGLE_OR_RATIO, Criteria.RATIO])
@pytest.mark.parametrize("side", [Side.INNER, Side.OUTER, Side.BOTH])
def test_rho_runs_over_the_facets_that_theta_does_not_keep(rule, criteria, side):
    points, triangles = icosphere(4)
    wavy = np.asarray(points) * (1.0 + 0.2 * np.sin(4.0 * np.asarray(points)[:, :1]))
    settings = Settings(form=Form.PUBLISHED, rule=rule, criteria=criteria, side=side)
    computation = compute(wavy, triangles, settings)
    found = computation.axis.rho_range
    counts = [
        selected(computation, replace(settings, rho=rho))
        for rho in (0.0, *map(found.length, (0.25, 0.5, 1.0)))
    ]
    can_go = counts[0] - counts[3]
    assert can_go > 0.1 * counts[0]
    for share, count in zip((0.25, 0.5), counts[1:3], strict=True):
        assert counts[0] - count == pytest.approx(share * can_go, abs=0.01 * can_go + 1)
    assert counts[3] == selected(computation, replace(settings, rho=np.inf))


def selected(computation, settings):
    """The number of bounded facets that are selected."""
    axis = extract_axis(computation, settings)
    return axis.facets + axis.zero_area


def test_rho_of_a_level_runs_over_the_facets_of_its_hierarchy():
    """It leaves out facets without area, so the range is not quite that of the published form."""
    points, triangles = icosphere(4)
    wavy = np.asarray(points) * (1.0 + 0.2 * np.sin(4.0 * np.asarray(points)[:, :1]))
    settings = Settings(crisp=False)
    computation = compute(wavy, triangles, settings)
    level, published = (
        replace(computation.settings, form=form) for form in (Form.CLEAN, Form.PUBLISHED)
    )
    found = extract_axis(computation, level).rho_range
    same = extract_axis(computation, published).rho_range
    for share in (0.1, 0.5, 0.9):
        assert found.length(share) == pytest.approx(same.length(share), rel=0.1)


def test_rho_has_no_range_where_it_does_nothing():
    points, triangles = box()
    settings = Settings(criteria=Criteria.ANGLE, sampling=SamplingMode.SURFACE, samples=500)
    assert compute(points, triangles, settings).axis.rho_range is None


def kept(**changed):
    return {"sampling": SamplingMode.SURFACE, "samples": 2000, **changed}
