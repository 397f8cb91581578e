# SPDX-License-Identifier: GPL-3.0-or-later
"""Edges and vertices that stand by themselves as tubes and balls, for pictures: Blender renders neither."""

import bpy
import numpy as np

SIDES = 8


def thick_edges(result, thickness):
    """An object beside a medial axis, with its material; None where every edge has a face."""
    mesh = result.data
    where, radius = np.empty(3 * len(mesh.vertices)), np.empty(len(mesh.vertices))
    mesh.vertices.foreach_get("co", where)
    mesh.attributes["ma_radius"].data.foreach_get("value", radius)
    where, ends = where.reshape(-1, 3), _alone(mesh)
    used = {*ends.ravel().tolist(), *(v for p in mesh.polygons for v in p.vertices)}
    points = np.array(sorted(set(range(len(where))) - used), int)
    if not len(ends) + len(points):
        return None
    parts = [_tube(where[a], where[b], thickness, radius[[a, b]]) for a, b in ends]
    parts += [_tube(where[p], where[p], 3 * thickness, radius[[p, p]]) for p in points]
    made = _mesh("Edges", parts)
    made.materials.append(mesh.materials[0])
    thing = bpy.data.objects.new("Edges", made)
    thing.matrix_world = result.matrix_world
    for name in ("ma_radius_min", "ma_radius_max"):
        thing[name] = result[name]
    bpy.context.scene.collection.objects.link(thing)
    return thing


def _alone(mesh):
    """(w, 2) the ends of the edges without a face."""
    ends = np.empty(2 * len(mesh.edges), np.int32)
    mesh.edges.foreach_get("vertices", ends)
    of_faces = np.empty(len(mesh.loops), np.int32)
    mesh.loops.foreach_get("edge_index", of_faces)
    alone = np.ones(len(mesh.edges), bool)
    alone[of_faces] = False
    return ends.reshape(-1, 2)[alone]


def _tube(start, end, thickness, radius):
    """Rings round both ends and beyond them, closed by a vertex each: (v, 3), (v,) radius of the axis."""
    along = end - start
    length = np.linalg.norm(along)
    along = along / length if length > 0 else np.array([0.0, 0.0, 1.0])
    side = np.cross(along, np.eye(3)[np.argmin(np.abs(along))])
    side /= np.linalg.norm(side)
    turns = np.linspace(0, 2 * np.pi, SIDES, endpoint=False)[:, None]
    ring = np.cos(turns) * side + np.sin(turns) * np.cross(along, side)
    rings = [
        middle + thickness * (width * ring + shift * along)
        for middle, shift, width in (
            (start, -0.7, 0.7),
            (start, 0.0, 1.0),
            (end, 0.0, 1.0),
            (end, 0.7, 0.7),
        )
    ]
    tips = [[start - thickness * along], [end + thickness * along]]
    values = np.repeat(radius, 2 * SIDES)
    return np.concatenate([*rings, *tips]), np.concatenate([values, radius])


def _mesh(name, parts):
    count = len(parts[0][0])
    rows = [
        (
            SIDES * i + j,
            SIDES * i + (j + 1) % SIDES,
            SIDES * (i + 1) + (j + 1) % SIDES,
            SIDES * (i + 1) + j,
        )
        for i in range(3)
        for j in range(SIDES)
    ]
    caps = [
        *((count - 2, (j + 1) % SIDES, j) for j in range(SIDES)),
        *((count - 1, 3 * SIDES + j, 3 * SIDES + (j + 1) % SIDES) for j in range(SIDES)),
    ]
    mesh = bpy.data.meshes.new(name)
    faces = [
        tuple(count * k + v for v in face) for k in range(len(parts)) for face in (*rows, *caps)
    ]
    mesh.from_pydata(np.concatenate([p for p, _ in parts]).tolist(), [], faces)
    mesh.polygons.foreach_set("use_smooth", np.ones(len(faces), bool))
    values = mesh.attributes.new("ma_radius", "FLOAT", "POINT")
    values.data.foreach_set("value", np.concatenate([r for _, r in parts]).astype(np.float32))
    return mesh
