# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes for the tests inside Blender: objects, and what is done with them."""

import contextlib

import bpy
import numpy as np
import pytest
from installed import addon
from mathutils import Matrix
from measure import contents, medial_objects, positions, result_of
from support.clouds import on_ellipsoid


def link(name, vertices, faces=(), edges=()):
    """A new mesh object, selected and active."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(
        [tuple(map(float, v)) for v in vertices], edges, [tuple(map(int, f)) for f in faces]
    )
    mesh.update()
    thing = new_object(name, mesh)
    select(thing)
    return thing


def new_object(name, data=None):
    """A new object of this data, or an empty one, in the scene."""
    thing = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def move_vertices(thing, points):
    """The vertices of a mesh object come to these places."""
    thing.data.vertices.foreach_set("co", np.asarray(points, np.float32).ravel())
    thing.data.update()


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


def added(kind, **options):
    """A new object of Blender's: added("cube", size=2), added("curve.bezier_circle"), added("object.text")."""
    group, _, name = kind.rpartition(".")
    name = f"{name}_add" if group == "object" else f"primitive_{name}_add"
    getattr(getattr(bpy.ops, group or "mesh"), name)(**options)
    return bpy.context.object


def ring(**options):
    """A circle that a bevel makes a tube of 0.2."""
    thing = added("curve.bezier_circle", **options)
    thing.data.bevel_depth = 0.2
    return thing


def plate(thickness):
    """A plate of 2 by 2."""
    return box(2.0, 2.0, thickness)


def box(*size):
    """A box about the origin, whose eight vertices lie where these sizes say."""
    thing = added("cube", size=1.0)
    thing.data.transform(Matrix.Diagonal((*size, 1.0)))
    return thing


def suzanne(levels=1):
    """A monkey under a Subdivision Surface modifier: 507 points, 2,012 after one level."""
    thing = added("monkey")
    if levels:
        thing.modifiers.new("Subdivision", "SUBSURF").levels = levels
    return thing


def ellipsoid(name="Ellipsoid", axes=(1.0, 0.7, 0.5), segments=3):
    """A closed mesh without symmetry to speak of."""
    thing = added("ico_sphere", subdivisions=segments)
    return shaken(thing, name, positions(thing.data) * axes, 1e-3)


def torus(name="Torus"):
    """A closed mesh with inner and outer axis, and facets near every threshold."""
    thing = tube_ring(48, 24, 0.4)
    return shaken(thing, name, positions(thing.data), 5e-3)


def shaken(thing, name, points, by):
    """The object by another name, with its vertices not far from these places."""
    thing.name = name
    noise = np.random.default_rng(7).normal(scale=by, size=points.shape)
    move_vertices(thing, points + noise)
    return thing


def tube_ring(around, across, radius):
    """A torus of radius 1, whose tube has this radius, of so many segments."""
    segments = {"major_segments": around, "minor_segments": across}
    return added("torus", major_radius=1.0, minor_radius=radius, **segments)


def scan(name="Scan", points=None, normals=None):
    """A mesh of vertices alone, as a scan is imported; a clean ellipsoid if nothing else is said."""
    thing = link(name, on_ellipsoid()[0] if points is None else points)
    if normals is not None:
        addon("bridge.mesh.attributes").add_normals(thing.data.attributes, normals)
    return thing


def with_radii(thing, radii):
    """The object, whose vertices are centres of balls from now on."""
    values = thing.data.attributes.new("ma_radius", "FLOAT", "POINT").data
    values.foreach_set("value", np.asarray(radii, np.float32))
    return thing


def opened(name="Open", faces=40):
    """An ellipsoid that lacks its first faces."""
    source = ellipsoid()
    kept = [list(polygon.vertices) for polygon in source.data.polygons][faces:]
    return link(name, positions(source.data), kept)


def cells(*places):
    """A mesh of unit cubes that are glued together, by their lowest corners."""
    corners, faces = {}, []
    for place in places:
        for axis in range(3):
            for side in (0, 1):
                beside = np.array(place)
                beside[axis] += 2 * side - 1
                if tuple(beside.tolist()) in places:
                    continue
                u, v = np.roll(np.eye(3, dtype=int), 1 - axis, axis=0)[[2, 0]]
                low = np.array(place) + side * np.eye(3, dtype=int)[axis]
                ring = [low, low + u, low + u + v, low + v][:: 2 * side - 1]
                faces.append([corners.setdefault(tuple(c.tolist()), len(corners)) for c in ring])
    return link("Cells", list(corners), faces)


def reopened(path):
    """Save the file, and open it again."""
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    bpy.ops.wm.open_mainfile(filepath=str(path))


def export(path, **options):
    """Write the active object's axis or balls to a file."""
    assert bpy.ops.export_scene.medial_axis(filepath=str(path), **options) == {"FINISHED"}


def refuse_export(match, path, **options):
    """The same raises one sentence, and leaves the folder as it was."""
    before = sorted(path.parent.iterdir())
    refuse(match, "export_scene.medial_axis", filepath=str(path), **options)
    assert sorted(path.parent.iterdir()) == before


@contextlib.contextmanager
def in_edit_mode():
    """The active object is in edit mode meanwhile."""
    bpy.ops.object.mode_set(mode="EDIT")
    try:
        yield
    finally:
        bpy.ops.object.mode_set(mode="OBJECT")


def press(operator, *things, **options):
    """Run an operator of objects on these, or on the selection; it must succeed. Returns the active object."""
    if things:
        select(*things)
    assert getattr(bpy.ops.object, operator)(**options) == {"FINISHED"}
    return bpy.context.object


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
    """The operator raises one sentence and leaves the file as it was.

    "medial_axis" is called as by `compute`; others by their names, such as "wm.medial_axis_self_test", as they are.
    """
    before = contents()
    with pytest.raises(RuntimeError, match=match) as caught:
        if operator == "medial_axis":
            compute_or_not(**settings)
        else:
            group, _, name = operator.rpartition(".")
            getattr(getattr(bpy.ops, group or "object"), name)(**settings)
    said = str(caught.value)
    assert "Traceback" not in said and len(said.strip().splitlines()) == 1, said
    assert contents() == before
    return said
