# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces that look inward are selected or turned in the mesh; a computation reads them outward and changes nothing."""

import bpy
import numpy as np
import pytest
from installed import addon
from measure import positions, result_of
from scene import added, compute, ellipsoid, select

ROWS = (3, 10, 11, 40)


@pytest.fixture
def source():
    thing = ellipsoid()
    for row in ROWS:
        thing.data.polygons[row].flip()
    thing.data.update()
    select(thing)
    return thing


def normals(mesh):
    return np.array([polygon.normal for polygon in mesh.polygons])


def inward(action):
    return bpy.ops.object.medial_axis_inward_faces(action=action)


def selected(mesh):
    return tuple(polygon.index for polygon in mesh.polygons if polygon.select)


def done_in(mode, source, action):
    """Run the operator in a mode, in which the object stays; then it is in object mode."""
    bpy.ops.object.mode_set(mode=mode)
    assert inward(action) == {"FINISHED"} and source.mode == mode
    bpy.ops.object.mode_set(mode="OBJECT")


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_select(source, mode):
    done_in(mode, source, "SELECT")
    assert selected(source.data) == ROWS


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_turn(source, mode):
    before, looked = positions(source.data), normals(source.data)
    done_in(mode, source, "TURN")
    assert np.array_equal(positions(source.data), before)
    looked[list(ROWS)] *= -1
    assert np.allclose(normals(source.data), looked, atol=1e-6)
    assert inward("SELECT") == {"FINISHED"} and selected(source.data) == ()


def test_a_computation_changes_nothing_and_says_what_it_read(source):
    before = normals(source.data)
    result = compute()
    assert np.array_equal(normals(source.data), before)
    assert result["ma_turned"] == len(ROWS) and "looked inward" in result["ma_warnings"]
    select(result)
    assert inward("TURN") == {"FINISHED"}  # of the source
    compute(source)
    assert result_of(source)["ma_turned"] == 0
    assert "looked inward" not in result_of(source)["ma_warnings"]


def test_quads_and_open_meshes():
    cube = added("cube")
    cube.data.polygons[2].flip()
    assert inward("SELECT") == {"FINISHED"} and selected(cube.data) == (2,)
    assert addon("bridge.thickness.inward_faces").inward_polygons(cube.data).sum() == 1


def test_without_a_mesh():
    bpy.ops.object.light_add()
    assert not bpy.ops.object.medial_axis_inward_faces.poll()
