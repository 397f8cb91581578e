# SPDX-License-Identifier: GPL-3.0-or-later
"""Writing a mesh: exact in float32, and all or nothing."""

from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from installed import addon
from measure import attribute, positions
from scene import added, compute, ellipsoid, press


def honeycomb(rows, columns):
    """A MedialAxis of rows x columns hexagons that share their vertices."""
    width = 2 * columns + 2
    first = (np.arange(rows)[:, None] * width + 2 * np.arange(columns)).ravel()
    corners = first[:, None] + np.array([0, 1, 2, width + 2, width + 1, width])
    count, facets = (rows + 1) * width + 2, rows * columns
    random = np.random.default_rng(0)
    return addon("core.axis.medial_axis").MedialAxis(
        vertices=random.normal(size=(count, 3)),
        radius=random.random(count),
        face_offsets=np.arange(0, 6 * facets + 1, 6, dtype=np.int32),
        face_vertices=corners.astype(np.int32).ravel(),
        theta=random.random(facets),
        rho=random.random(facets) * 50,
        side=random.integers(0, 4, facets).astype(np.int32),
        generators=random.integers(0, 99, (facets, 2)).astype(np.int32),
        unbounded=0,
        zero_area=0,
    )


def changed(axis, **fields):
    known = {name: getattr(axis, name) for name in axis.__dataclass_fields__}
    return type(axis)(**known | fields)


def written(axis, name):
    attributes = addon("bridge.mesh.attributes").attributes()
    return addon("bridge.mesh.write_mesh").new_mesh(axis, name, attributes)


def test_arrays_arrive():
    axis = honeycomb(4, 5)
    mesh = written(axis, "Honeycomb")
    np.testing.assert_array_equal(positions(mesh), axis.vertices.astype(np.float32))
    corners = [list(p.vertices) for p in mesh.polygons]
    np.testing.assert_array_equal(corners, axis.face_vertices.reshape(20, 6))
    for entry in addon("bridge.mesh.attributes").attributes():
        found = mesh.attributes[entry.name]
        assert (found.domain, found.data_type) == (entry.domain, entry.type)
        np.testing.assert_array_equal(attribute(mesh, entry.name).ravel(), entry.values(axis))
    assert not any(p.use_smooth for p in mesh.polygons)
    if "sharp_face" in mesh.attributes or bpy.app.version >= (4, 1):
        assert all(d.value for d in mesh.attributes["sharp_face"].data)
    assert len(mesh.edges) > 0 and mesh.validate() is False


def test_numbers_beyond_float32_become_its_largest():
    """Infinity would spoil colours and averages."""
    table = addon("bridge.mesh.attributes")
    found = table.EPSILON.values(SimpleNamespace(epsilon=np.array([0.5, 1e39, np.inf])))
    largest = np.finfo(np.float32).max
    assert found.dtype == np.float32 and found.tolist() == [0.5, largest, largest]


def test_polygons_of_different_sizes():
    offsets, corners = np.array([0, 3, 7], np.int32), np.array([0, 1, 2, 4, 3, 2, 1], np.int32)
    axis = changed(honeycomb(1, 2), face_offsets=offsets, face_vertices=corners)
    mesh = written(axis, "Mixed")
    assert [list(p.vertices) for p in mesh.polygons] == [[0, 1, 2], [4, 3, 2, 1]]


BROKEN = {
    "too large": ({"vertices": np.full((20, 3), 1e39)}, "InvalidInputError"),
    "index too large": ({"face_vertices": np.full(12, 10**6, np.int32)}, AssertionError),
    "negative index": ({"face_vertices": np.full(12, -1, np.int32)}, AssertionError),
    "polygon of one corner": ({"face_offsets": np.array([0, 1, 12], np.int32)}, AssertionError),
    "short attribute": ({"theta": np.zeros(1)}, Exception),
}


@pytest.mark.parametrize(("fields", "error"), BROKEN.values(), ids=BROKEN)
def test_nothing_is_left_of_a_mesh_that_cannot_be_made(fields, error):
    if isinstance(error, str):
        error = getattr(addon("core.errors"), error)
    with pytest.raises(error):
        written(changed(honeycomb(1, 2), **fields), "Broken")
    assert len(bpy.data.meshes) == 0


def test_what_needs_no_blender_is_computed_before_an_axis_is_written(monkeypatch):
    """In a window that is done in a thread; Blender draws nothing while an axis is written."""

    def not_now(*_):
        raise AssertionError("this stops the window")

    ellipsoid()
    monkeypatch.setattr(addon("bridge.axis.axis_object"), "shown_axis", not_now)
    for name in ("arrays_of", "edges_of"):
        monkeypatch.setattr(addon("bridge.mesh.write_mesh"), name, not_now)
    for form in ("CLEAN", "PUBLISHED", "CURVE"):
        compute(form=form)
    panel = bpy.context.scene.medial_axis
    panel.form, panel.simplify = "CLEAN", 1.0


@pytest.mark.parametrize("kind", ["monkey", "object.text"])
def test_no_corner_of_a_sheet_is_shaded_from_behind(kind):
    """Renders draw such corners black."""
    source = added(kind)
    if source.type == "FONT":
        source.data.body, source.data.extrude = "Medial", 0.1
    mesh = press("medial_axis").data
    found = addon("bridge.mesh.write_mesh")._corner_normals(mesh).reshape(len(mesh.polygons), -1, 3)
    own = np.array([polygon.normal for polygon in mesh.polygons])
    assert (np.einsum("ijk,ik->ij", found, own) >= 0.0).all()  # without area there is no side
