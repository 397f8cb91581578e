# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside Blender: the cavities that its own modifiers leave in a solid, for `hollow_table.py`.

    blender --background --factory-startup --python-exit-code 1 \
        --python lab/benchmarks/offsets_in_blender.py -- SOLID.npz ANSWER.npz

The solid has `points`, `triangles` and `wall`. The answer has vertices and triangles of each cavity, outward.
"""

import sys
from pathlib import Path

import bpy
import numpy as np


def main() -> None:
    solid, answer = sys.argv[sys.argv.index("--") + 1 :]
    given = np.load(solid)
    points, triangles, wall = given["points"], given["triangles"], float(given["wall"])
    found = {
        "solidify": solidified(points, triangles, wall),
        "remesh": remeshed(points, triangles, wall),
        "scaled": subtracted(points, triangles, scaled(points, wall), triangles),
        "offset": subtracted(points, triangles, *solidified(points, triangles, wall)),
    }
    np.savez(
        Path(answer),
        **{f"{name}_points": mesh[0] for name, mesh in found.items()},
        **{f"{name}_triangles": mesh[1] for name, mesh in found.items()},
    )


def made(points: np.ndarray, triangles: np.ndarray) -> bpy.types.Object:
    mesh = bpy.data.meshes.new("Solid")
    mesh.from_pydata(points.tolist(), [], triangles.tolist())
    thing = bpy.data.objects.new("Solid", mesh)
    bpy.context.collection.objects.link(thing)
    return thing


def shown(thing: bpy.types.Object) -> tuple[np.ndarray, np.ndarray]:
    """The vertices and triangles that its modifiers make."""
    evaluated = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    mesh.calc_loop_triangles()
    points = np.array([vertex.co[:] for vertex in mesh.vertices], float).reshape(-1, 3)
    triangles = np.array([t.vertices[:] for t in mesh.loop_triangles], np.int32).reshape(-1, 3)
    evaluated.to_mesh_clear()
    return points, triangles


def solidified(points, triangles, wall):
    """The new half of what a Solidify modifier with even thickness makes."""
    thing = made(points, triangles)
    modifier = thing.modifiers.new("Solidify", "SOLIDIFY")
    modifier.thickness, modifier.offset, modifier.use_even_offset = wall, -1.0, True
    places, faces = shown(thing)
    inner = np.arange(len(places)) >= len(points)
    return places, faces[inner[faces].all(axis=1)][:, ::-1]


def remeshed(points, triangles, wall):
    """The solid by voxels of a quarter of the wall, its vertices moved inward by the wall."""
    thing = made(points, triangles)
    remesh = thing.modifiers.new("Remesh", "REMESH")
    remesh.mode, remesh.voxel_size = "VOXEL", wall / 4
    displace = thing.modifiers.new("Displace", "DISPLACE")
    displace.strength, displace.mid_level = -wall, 0.0
    return shown(thing)


def scaled(points, wall):
    """The vertices of a copy scaled about the middle of its box, which loses the wall on each side."""
    low, high = points.min(axis=0), points.max(axis=0)
    middle = 0.5 * (low + high)
    return middle + (points - middle) * (1.0 - 2.0 * wall / (high - low))


def subtracted(points, triangles, inner, faces):
    """The faces that a Boolean modifier with the exact solver leaves of an inner solid that it cuts out."""
    thing, tool = made(points, triangles), made(inner, faces)
    for mesh, value in ((thing.data, 0), (tool.data, 1)):
        mesh.attributes.new("of_tool", "INT", "FACE").data.foreach_set(
            "value", [value] * len(mesh.polygons)
        )
    modifier = thing.modifiers.new("Boolean", "BOOLEAN")
    modifier.operation, modifier.solver, modifier.object = "DIFFERENCE", "EXACT", tool
    modifier.use_self = True
    evaluated = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    of_tool = np.array([one.value for one in evaluated.attributes["of_tool"].data], bool)
    evaluated.calc_loop_triangles()
    polygon = np.array([t.polygon_index for t in evaluated.loop_triangles], np.intp)
    places, pieces = shown(thing)
    return places, pieces[of_tool[polygon]][:, ::-1]


if __name__ == "__main__":
    main()
