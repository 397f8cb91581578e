# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes and measuring sticks for the tests inside Blender."""

import ctypes
import importlib
import os
import re
import sys
from pathlib import Path

import bpy
import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from support.clouds import on_ellipsoid

MODULE = os.environ["MEDIAL_AXIS_MODULE"]


def program():
    """The Blender that runs this, to be started once more."""
    if not bpy.app.binary_path:
        pytest.skip("this is Blender as a module; it has no program")
    return bpy.app.binary_path


def addon(path=""):
    """A module of the installed add-on, such as addon('core.axis.compute')."""
    return importlib.import_module(f"{MODULE}.{path}" if path else MODULE)


def link(name, vertices, faces=(), edges=()):
    """A new mesh object, selected and active."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(
        [tuple(map(float, v)) for v in vertices], edges, [tuple(map(int, f)) for f in faces]
    )
    mesh.update()
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(thing)
    select(thing)
    return thing


def select(*things):
    """Select these objects and nothing else; the first is active."""
    bpy.context.view_layer.update()
    for other in bpy.context.view_layer.objects:
        other.select_set(other in things)
    bpy.context.view_layer.objects.active = things[0] if things else None


def exclude(thing):
    """Put an object into a collection that the view layer leaves out."""
    other = bpy.data.collections.new("Out")
    bpy.context.scene.collection.children.link(other)
    for collection in thing.users_collection:
        collection.objects.unlink(thing)
    other.objects.link(thing)
    bpy.context.view_layer.layer_collection.children["Out"].exclude = True


def suzanne(levels=1):
    """A monkey under a Subdivision Surface modifier: 507 points, 2,012 after one level."""
    bpy.ops.mesh.primitive_monkey_add()
    thing = bpy.context.object
    if levels:
        thing.modifiers.new("Subdivision", "SUBSURF").levels = levels
    return thing


def ellipsoid(name="Ellipsoid", axes=(1.0, 0.7, 0.5), segments=3):
    """A closed mesh without symmetry to speak of."""
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=segments)
    thing = bpy.context.object
    thing.name = name
    points = positions(thing.data) * axes
    points += np.random.default_rng(7).normal(scale=1e-3, size=points.shape)
    thing.data.vertices.foreach_set("co", points.astype(np.float32).ravel())
    thing.data.update()
    return thing


def torus(name="Torus"):
    """A closed mesh with inner and outer axis, and facets near every threshold."""
    bpy.ops.mesh.primitive_torus_add(
        major_segments=48, minor_segments=24, major_radius=1.0, minor_radius=0.4
    )
    thing = bpy.context.object
    thing.name = name
    points = positions(thing.data)
    points += np.random.default_rng(7).normal(scale=5e-3, size=points.shape)
    thing.data.vertices.foreach_set("co", points.astype(np.float32).ravel())
    thing.data.update()
    return thing


def scan(name="Scan", points=None, normals=None):
    """A mesh of vertices alone, as a scan is imported; a clean ellipsoid if nothing else is said."""
    thing = link(name, on_ellipsoid()[0] if points is None else points)
    if normals is not None:
        addon("bridge.mesh.attributes").add_normals(thing.data.attributes, normals)
    return thing


def opened(name="Open", faces=40):
    """An ellipsoid that lacks its first faces."""
    source = ellipsoid()
    kept = [list(polygon.vertices) for polygon in source.data.polygons][faces:]
    return link(name, positions(source.data), kept)


def positions(mesh):
    """(n, 3) the vertices of a mesh."""
    values = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", values)
    return values.reshape(-1, 3).astype(np.float64)


def world_positions(thing):
    """(n, 3) the vertices of an object in the world."""
    bpy.context.view_layer.update()
    matrix = np.array(thing.matrix_world)
    return positions(thing.data) @ matrix[:3, :3].T + matrix[:3, 3]


def radii_are_sound(mesh):
    """Radii are positive, and 0 only on the rims of crisp sheets that end on sharp edges and corners."""
    radius = attribute(mesh, "ma_radius")
    ends = radius == 0
    return (radius >= 0).all() and (
        not ends.any() or (attribute(mesh, "ma_place")[ends] >= 3).all()
    )


def sound(result):
    """The result is a valid mesh of finite numbers."""
    mesh = result.data
    assert len(mesh.vertices) > 0 and mesh.validate() is False
    assert np.isfinite(positions(mesh)).all()
    for name in ("ma_radius", "ma_theta", "ma_rho"):
        assert np.isfinite(attribute(mesh, name)).all()
    assert radii_are_sound(mesh)


def attribute(mesh, name):
    """The values of an attribute, (n,) or (n, 2)."""
    found = mesh.attributes[name]
    width = 2 if found.data_type == "INT32_2D" else 1
    dtype = np.float32 if found.data_type == "FLOAT" else np.int32
    values = np.empty(width * len(found.data), dtype)
    found.data.foreach_get("value", values)
    return values.reshape(-1, 2) if width == 2 else values


def result_of(source):
    """The result object of a source, or None."""
    return addon("bridge.axis.axis_object").result_of(source)


def analyses():
    """How many analyses were computed since Blender started."""
    return addon("core.machine.cache").CACHE.analyses


def compute(*sources, **settings):
    """Run the operator on these objects, or on the selection; it must succeed. Returns the active one's result.

    If nothing else is said, it takes the vertices as samples, and keeps the axis as published.
    """
    if sources:
        select(*sources)
    active = bpy.context.object
    assert compute_or_not(**settings) == {"FINISHED"}
    return active if active in medial_objects() else result_of(active)


def compute_or_not(**settings):
    """The operator's result for the selection; by default it samples vertices and keeps the whole axis as published."""
    usual = {"sampling": "VERTICES", "form": "PUBLISHED", "within": 0.0}
    return bpy.ops.object.medial_axis(**usual | settings)


def refuse(match, operator="medial_axis", **settings):
    """The operator raises one sentence and leaves the file as it was."""
    before = contents()
    with pytest.raises(RuntimeError, match=match) as caught:
        if operator == "medial_axis":
            compute_or_not(**settings)
        else:
            getattr(bpy.ops.object, operator)(**settings)
    assert "Traceback" not in str(caught.value)
    assert contents() == before
    return str(caught.value)


def contents():
    """The names of the objects, meshes and materials in the file."""
    return [
        sorted(thing.name for thing in kind)
        for kind in (bpy.data.objects, bpy.data.meshes, bpy.data.materials)
    ]


def direct(points, triangles=None, sphere=False, **settings):
    """The compiled module's answer without the add-on: a MedialMesh."""
    module = addon("core.machine.native").load()
    return module.MedialAnalysis(points, triangles, bounding_sphere=sphere).extract(**settings)


def triangles_of(mesh):
    """(m, 3) the loop triangles of a mesh."""
    mesh.calc_loop_triangles()
    values = np.empty(3 * len(mesh.loop_triangles), np.int32)
    mesh.loop_triangles.foreach_get("vertices", values)
    return values.reshape(-1, 3)


def in_wine():
    """Whether this is no real Windows."""
    return sys.platform == "win32" and hasattr(ctypes.windll.ntdll, "wine_get_version")


renders = pytest.mark.skipif(in_wine(), reason="Blender does not render in Wine")


def flush():
    """Flushes the buffer of Blender's output."""
    ctypes.CDLL("ucrtbase" if sys.platform == "win32" else None).fflush(None)


def reports(capfd):
    """The reports of operators since the last call: [('Info', text), ...]."""
    flush()
    return re.findall(r"^(Info|Warning|Error): (.*)$", capfd.readouterr().out, re.MULTILINE)


def medial_objects():
    """All result objects in the file."""
    return [
        thing for thing in bpy.data.objects if addon("bridge.axis.axis_object").is_result(thing)
    ]
