# SPDX-License-Identifier: GPL-3.0-or-later
"""Report Sampling: the samples and their epsilon, as an object or on the source."""

import bpy
import numpy as np
import pytest
from installed import addon
from measure import attribute, contents, positions, result_of, triangles_of
from scene import added, ellipsoid, link, press, refuse, select

REPORT = "medial_axis_sampling_report"
EVEN = {"sampling": "SURFACE", "samples": 1_500}


def report(source, **settings):
    """Run the operator on a source; the report, which must be there."""
    press(REPORT, source, **{"target": "COPY"} | settings)
    return addon("bridge.axis.report_object").report_of(source)


@pytest.fixture
def cylinder():
    return added("cylinder")


def nearest(places, to):
    """(n,) the row of the place that is nearest to each of others."""
    return np.linalg.norm(np.asarray(to)[:, None] - places, axis=2).argmin(axis=1)


def test_report_is_the_samples_with_their_attributes(cylinder):
    found = report(cylinder, **EVEN)
    mesh = found.data
    assert found.name == "Cylinder Sampling" and found["ma_source"] == cylinder
    assert len(mesh.vertices) == found["ma_points"] == pytest.approx(1_500, rel=0.1)
    assert [material.name for material in mesh.materials] == ["Medial Axis Epsilon"]
    names = ("ma_epsilon", "ma_spacing", "ma_feature_size")
    epsilon, spacing, size = (attribute(mesh, name).astype(float) for name in names)
    known = np.isfinite(size)
    assert known.mean() > 0.95 and (spacing > 0).all() and (size > 0).all()
    np.testing.assert_allclose(epsilon[known], spacing[known] / size[known], rtol=1e-5)
    # a cylinder of radius 1 and height 2: nowhere is the axis farther than 1 away
    assert size[known].max() < 1.1


def test_faces_of_a_report_are_the_surface_that_samples_see():
    mesh = report(ellipsoid(), **EVEN).data
    assert mesh.validate() is False
    winding, corners = addon("core.machine.native").load().winding_number, triangles_of(mesh)
    inside = winding(np.array([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]), positions(mesh), corners)
    np.testing.assert_allclose(inside, [1.0, 0.0], atol=1e-6)
    assert len(np.unique(corners)) > 0.99 * len(mesh.vertices)


def test_figures_are_those_of_the_attribute():
    found = report(ellipsoid(), **EVEN)
    epsilon = attribute(found.data, "ma_epsilon")
    assert found["ma_epsilon_limit"] == 0.25
    assert found["ma_epsilon_median"] == pytest.approx(np.median(epsilon), rel=1e-2)
    assert found["ma_epsilon_share"] == pytest.approx(np.mean(epsilon > 0.25))
    assert found["ma_epsilon_worst"][0] == pytest.approx(epsilon.max(), rel=1e-5)
    worst = np.reshape(found["ma_epsilon_worst_places"], (-1, 3))
    (row,) = nearest(positions(found.data), worst[:1])
    assert epsilon[row] == pytest.approx(epsilon.max(), rel=1e-5)
    assert len(worst) == len(found["ma_epsilon_worst"]) > 1
    assert found["ma_density"].startswith(f"Epsilon: median {np.median(epsilon):.2f}, ")


def test_report_is_updated_in_place_and_keeps_the_artists_choices(cylinder):
    found = report(cylinder, **EVEN)
    other = found.data.materials[0] = bpy.data.materials.new("Mine")
    found.name = "Check"
    before = contents()
    assert report(cylinder, sampling="SURFACE", samples=700) == found and contents() == before
    assert found.data.materials[0] == other and len(found.data.vertices) < 1_000


def test_report_of_vertices_has_one_row_per_vertex_also_of_doubled_ones():
    source = ellipsoid()
    points, triangles = positions(source.data), triangles_of(source.data)
    soup = link("Soup", points[triangles.ravel()], np.arange(triangles.size).reshape(-1, 3))
    found = report(soup, sampling="VERTICES")
    np.testing.assert_array_equal(positions(found.data), positions(soup.data))
    epsilon = attribute(found.data, "ma_epsilon")
    whole = attribute(report(source, sampling="VERTICES").data, "ma_epsilon")
    np.testing.assert_allclose(epsilon, whole[triangles.ravel()], rtol=1e-5)
    assert found["ma_duplicates"] == len(soup.data.vertices) - len(points)


def test_selected_report_stands_for_its_source(cylinder):
    found = report(cylinder, **EVEN)
    assert bpy.context.selected_objects == [found]
    press("medial_axis", **EVEN)
    assert result_of(cylinder) is not None and result_of(found) is None
    bpy.data.objects.remove(cylinder)
    select(found)
    refuse("is a report whose source is gone", operator=REPORT)


# --- on the source


def test_epsilon_on_the_source():
    source = ellipsoid(segments=3)
    press(REPORT, source, target="SOURCE", **EVEN)
    assert addon("bridge.axis.report_object").report_of(source) is None
    values, vertices = attribute(source.data, "ma_epsilon"), positions(source.data)
    found = report(source, **EVEN)
    samples, epsilon = positions(found.data), attribute(found.data, "ma_epsilon")
    own, closest = nearest(vertices, samples), epsilon[nearest(samples, vertices)]
    for row, value in enumerate(values):
        mine = epsilon[own == row]
        assert value == pytest.approx(mine.max() if len(mine) else closest[row], rel=1e-5)
    press(REPORT, source, target="SOURCE", **EVEN | {"samples": 300})
    assert (attribute(source.data, "ma_epsilon") != values).any()
    assert [a.name for a in source.data.attributes].count("ma_epsilon") == 1


# --- what is said


def test_panel_speaks_of_the_report(cylinder):
    found = report(cylinder, **EVEN)
    shown = addon("ui.settings.properties").shown_report
    assert shown(bpy.context) == found
    select(cylinder)
    assert shown(bpy.context) == found
