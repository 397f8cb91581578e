# SPDX-License-Identifier: GPL-3.0-or-later
"""Measuring sticks for the tests inside Blender: of meshes, of results, of the file, of what was reported."""

import ctypes
import re
import sys
import time
from collections import Counter
from types import SimpleNamespace

import bmesh
import bpy
import numpy as np
from installed import addon


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


KINDS = {
    "FLOAT": (1, np.float32, "value"),
    "INT": (1, np.int32, "value"),
    "BOOLEAN": (1, np.bool_, "value"),
    "INT32_2D": (2, np.int32, "value"),
    "FLOAT_VECTOR": (3, np.float32, "vector"),
    "FLOAT_COLOR": (4, np.float32, "color"),
}


def attribute(mesh, name):
    """The values of an attribute, (n,) or (n, width)."""
    found = mesh.attributes[name]
    width, dtype, key = KINDS[found.data_type]
    values = np.empty(width * len(found.data), dtype)
    found.data.foreach_get(key, values)
    return values.reshape(-1, width) if width > 1 else values


def generators(mesh):
    """(f, 2) the samples of each facet of a medial axis."""
    if "ma_generators" in mesh.attributes:
        return attribute(mesh, "ma_generators")
    return np.column_stack([attribute(mesh, f"ma_generator_{end}") for end in "ab"])


def loose_edges(mesh):
    """(w, 2) the ends of the edges without a face."""
    of_faces = {key for polygon in mesh.polygons for key in polygon.edge_keys}
    return np.array([e.key for e in mesh.edges if e.key not in of_faces], int).reshape(-1, 2)


def triangles_of(mesh):
    """(m, 3) the loop triangles of a mesh."""
    mesh.calc_loop_triangles()
    values = np.empty(3 * len(mesh.loop_triangles), np.int32)
    mesh.loop_triangles.foreach_get("vertices", values)
    return values.reshape(-1, 3)


def evaluated(thing):
    """The mesh that an object is after its modifiers."""
    bpy.context.view_layer.update()
    return thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).data


def instances(thing):
    """(n, 3) the scales of what an object instances."""
    bpy.context.view_layer.update()
    return [
        one.matrix_world.to_scale()[:]
        for one in bpy.context.evaluated_depsgraph_get().object_instances
        if one.is_instance and one.parent.original == thing
    ]


def read(source):
    """The shape of an object, as the add-on reads it."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    return addon("bridge.objects.read_object").read_object(source, depsgraph)


def volume(mesh):
    """The volume within a closed mesh, whose faces may look inward."""
    solid = bmesh.new()
    solid.from_mesh(mesh)
    found = abs(solid.calc_volume())
    solid.free()
    return found


def open_edges(mesh):
    """How many edges do not have two faces."""
    faces = Counter(key for polygon in mesh.polygons for key in polygon.edge_keys)
    return sum(faces[edge.key] != 2 for edge in mesh.edges)


def direct(points, triangles=None, sphere=False, **settings):
    """The compiled module's answer without the add-on: a MedialMesh."""
    module = addon("core.machine.native").load()
    return module.MedialAnalysis(points, triangles, bounding_sphere=sphere).extract(**settings)


def result_of(source):
    """The result object of a source, or None."""
    return addon("bridge.axis.axis_object").result_of(source)


def medial_objects():
    """All result objects in the file."""
    return [*filter(addon("bridge.axis.axis_object").is_result, bpy.data.objects)]


def analyses():
    """How many analyses were computed since Blender started."""
    return addon("core.machine.cache").CACHE.analyses


def contents():
    """The names of what is in the file, kind by kind: objects, meshes, materials and others."""
    data = bpy.data
    first = (data.objects, data.meshes, data.materials, data.collections)
    others = (data.curves, data.armatures, data.actions)
    return [sorted(thing.name for thing in kind) for kind in (*first, *others)]


def watched(job):
    """Wait for a job, whose fraction never falls; what it said meanwhile: [(stage, text), ...]."""
    seen, fractions = [], []
    while not job.done:
        fractions.append(job.fraction)
        seen.append((job.stage, job.text))
        time.sleep(0.002)
    assert fractions == sorted(fractions) and fractions[0] >= 0 and fractions[-1] <= 1
    return seen


def entries_of(draw, menu):
    """The entries that a function draws in a menu of Blender: {operator: text, ...}."""
    assert draw in menu._dyn_ui_initialize()
    shown = {}
    layout = SimpleNamespace(operator=lambda name, text: shown.update({name: text}))
    draw(SimpleNamespace(layout=layout), bpy.context)
    return shown


def flush():
    ctypes.CDLL("ucrtbase" if sys.platform == "win32" else None).fflush(None)


def reports(capfd):
    """The reports of operators since the last call: [('Info', text), ...]."""
    flush()
    return re.findall(r"^(Info|Warning|Error): (.*)$", capfd.readouterr().out, re.MULTILINE)
