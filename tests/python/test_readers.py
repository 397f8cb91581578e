# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles in text, which the usual readers of meshes read alike; one that is absent is skipped by its name."""

import medial_axis
import numpy as np
import pytest
from medial_axis.core.files.read_shape import read_shape

from tests.readers import example, verdict
from tests.support.readers import NAMES, READERS, area_of


@pytest.fixture(scope="module")
def axis():
    return example()


def polygons(axis):
    return [row.tolist() for row in np.split(axis.face_vertices, axis.face_offsets[1:-1])]


@pytest.mark.parametrize("suffix", [".ply", ".obj", ".off"])
@pytest.mark.parametrize("reader", NAMES)
def test_others_read_triangles(axis, reader, suffix, tmp_path):
    if reader not in READERS:
        pytest.skip(f"{reader} is not installed")
    if (reader, suffix) in {("plyfile", ".obj"), ("plyfile", ".off")}:
        pytest.skip("plyfile reads PLY alone")
    path = medial_axis.write(axis, tmp_path / f"a{suffix}", triangles=True)
    area = area_of(axis.vertices, polygons(axis))
    assert verdict(reader, path, len(axis.vertices), area) == "whole"


@pytest.mark.parametrize("suffix", [".ply", ".obj", ".off"])
def test_triangles_are_those_of_the_polygons(axis, suffix, tmp_path):
    path = medial_axis.write(axis, tmp_path / f"a{suffix}", triangles=True)
    shape, warnings = read_shape(path)
    np.testing.assert_array_equal(shape.points, axis.vertices)
    assert len(shape.triangles) == len(axis.face_vertices) - 2 * axis.facets and warnings == ()
    found = area_of(shape.points, shape.triangles.tolist())
    assert found == pytest.approx(area_of(axis.vertices, polygons(axis)))


def test_each_triangle_of_a_ply_has_the_values_of_its_facet(axis, tmp_path):
    path = medial_axis.write(axis, tmp_path / "a.ply", triangles=True)
    head, body = path.read_text("ascii").split("end_header\n")
    rows = np.array([line.split() for line in body.splitlines()[len(axis.vertices) :]], float)
    facet = rows[:, 9].astype(int)
    assert (
        "property int facet" in head
        and (np.bincount(facet) == np.diff(axis.face_offsets) - 2).all()
    )
    np.testing.assert_array_equal(rows[:, 4], axis.theta[facet])
    np.testing.assert_array_equal(rows[:, 5], axis.rho[facet])
    np.testing.assert_array_equal(rows[:, 6], axis.side[facet])
    np.testing.assert_array_equal(rows[:, 7:9], axis.generators[facet])
    radius = np.array([line.split()[3] for line in body.splitlines()[: len(axis.vertices)]], float)
    np.testing.assert_array_equal(radius, axis.radius)


@pytest.mark.parametrize("suffix", [".ma", ".npz"])
def test_the_other_formats_are_as_ever(axis, suffix, tmp_path):
    ever = medial_axis.write(axis, tmp_path / f"a{suffix}").read_bytes()
    assert medial_axis.write(axis, tmp_path / f"b{suffix}", triangles=True).read_bytes() == ever
