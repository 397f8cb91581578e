# SPDX-License-Identifier: GPL-3.0-or-later
"""Reduce to Few Vertices: a small medial mesh next to the axis, which can be rebuilt, exported and undone."""

import re

import bpy
import numpy as np
import pytest
from installed import addon
from measure import attribute, contents, evaluated, positions, read, reports, result_of, volume
from scene import box, compute, ellipsoid, export, press, refuse, select


def reduced_of(source):
    return addon("bridge.axis.reduced_object").reduced_of(source)


def reduce(source, vertices, **options):
    press("medial_axis_reduce", source, vertices=vertices, **options)
    return reduced_of(source)


def test_a_small_mesh_with_radii_beside_its_axis(capfd):
    source = ellipsoid(segments=4)
    source.location, source.rotation_euler = (3, 1, 2), (0.3, 0.2, 0.1)
    compute(form="CLEAN", side="INNER")
    reports(capfd)
    made = reduce(source, 40)
    mean, largest = (float(x) for x in re.findall(r"([\d.]+) %", reports(capfd)[-1][1]))
    assert mean < 0.3 and largest < 2
    assert len(made.data.vertices) == 40
    assert {len(polygon.vertices) for polygon in made.data.polygons} == {3}
    radius = attribute(made.data, "ma_radius")
    assert radius.min() > 0 and radius.max() == pytest.approx(0.5, abs=0.01)
    assert np.allclose(made.matrix_world, result_of(source).matrix_world)


def test_by_a_button_it_takes_the_place_of_its_axis():
    """Both lie in front, in the same place."""
    source = ellipsoid()
    axis = compute(form="CLEAN", side="INNER")
    made = reduce(source, 40)
    assert axis.visible_get(), "a script hides nothing"
    bpy.data.objects.remove(made)
    made = reduce(source, 40, alone=True)
    assert not axis.visible_get() and source.visible_get()
    assert made.visible_get() and made.select_get() and bpy.context.object == made
    axis.hide_set(False)
    press("medial_axis_reduce", vertices=30, alone=True)
    assert axis.visible_get(), "it steps back once"


def test_it_is_made_once_and_again_for_another_number():
    source = ellipsoid()
    compute(side="INNER")
    made = reduce(source, 30)
    before = contents()
    press("medial_axis_reduce", made, vertices=12)
    assert reduced_of(source) == made and contents() == before and len(made.data.vertices) == 12


def test_the_solid_of_a_small_mesh_is_rebuilt():
    source = ellipsoid(segments=4)
    compute(form="CLEAN", side="INNER")
    made = reduce(source, 40)
    press("medial_axis_rebuild", made)
    solid = addon("bridge.rebuilt_object").rebuilt_of(made)
    assert volume(evaluated(solid)) / volume(source.data) == pytest.approx(1, abs=0.03)
    assert solid["ma_rebuilt_mean"] < 0.005


def test_it_is_exported_and_computing_from_it_computes_its_source(tmp_path):
    source = ellipsoid()
    compute(side="INNER")
    made = reduce(source, 20)
    select(made)
    before, path = contents(), tmp_path / "small.ma"
    export(path)
    vertices = addon("core.files.read_ma").read_ma(path).vertices
    assert np.allclose(vertices, positions(made.data), atol=1e-6)
    compute(side="INNER")
    assert contents() == before


def test_without_an_axis_it_says_so():
    select(ellipsoid())
    assert not bpy.ops.object.medial_axis_reduce.poll()
    refuse("Select a medial axis", "medial_axis_reduce")


def test_a_box_is_thirteen_polygons_as_the_library_makes_them():
    source, library = box(2.0, 1.4, 0.8), addon("library")
    compute(form="CLEAN", side="INNER", sampling="SURFACE", samples=3000)
    made = reduce(source, 100).data
    assert (len(made.vertices), len(made.polygons)) == (12, 13)
    assert not made.validate(verbose=True)
    shape = read(source)
    found = library.compute(shape.points, shape.triangles, sampling="surface", samples=3000)
    small = library.reduce(found, 100)
    assert np.array_equal(positions(made), small.vertices.astype(np.float32))
    assert np.array_equal(attribute(made, "ma_radius"), small.radius.astype(np.float32))
    corners = np.split(small.face_vertices, small.face_offsets[1:-1])
    assert [tuple(face.vertices) for face in made.polygons] == [tuple(c.tolist()) for c in corners]
