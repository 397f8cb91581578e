# SPDX-License-Identifier: GPL-3.0-or-later
"""One solid and what each program of the race on meshes made of it, side by side.

    python3 -m lab.race.meshes --shapes box --keep found
    blender --background --factory-startup --python-exit-code 1 --python lab/pictures/beside_others.py -- \\
        --found found --shape box --output docs/pictures/beside_box.png

All are drawn in one colour and with flat shading, so that a plane is seen as one; edges are thin tubes, points small
octahedra. Every picture is rendered by itself; ImageMagick's `montage` puts them side by side.
"""

import argparse
import sys
import tempfile
from itertools import pairwise
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
import contact_sheet
from contact_sheet import blender_scene

PIXELS = (420, 330)
SAMPLES = 64
WIDTH = 0.003  # of tubes and octahedra, as a share of the diagonal
OCTAHEDRON = np.array([(1, 0, 0), (0, 1, 0), (0, 0, 1), (-1, 0, 0), (0, -1, 0), (0, 0, -1)], float)
SIDES = np.array(
    [(0, 1, 2), (1, 3, 2), (3, 4, 2), (4, 0, 2), (1, 0, 5), (3, 1, 5), (4, 3, 5), (0, 4, 5)]
)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--found", type=Path, required=True)
    parser.add_argument("--shape", default="box")
    parser.add_argument("--programs", nargs="+", help="in this order; default: all, by name")
    parser.add_argument("--output", type=Path, required=True)
    arguments = parser.parse_args(sys.argv[sys.argv.index("--") + 1 :])
    start = f"{arguments.shape} "
    names = arguments.programs or sorted(
        path.stem.removeprefix(start) for path in arguments.found.glob(f"{start}*.npz")
    )
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            show(np.load(arguments.found / f"{start}{name}.npz"), Path(folder, f"{name}.png"))
        contact_sheet.montage(Path(folder), names, arguments.output, columns=4)


def show(found, path):
    """Render a solid like glass and what was found in it."""
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    solid = object_of(found["solid"], "Solid")
    width = WIDTH * np.linalg.norm(np.ptp(found["solid"].reshape(-1, 3), axis=0))
    parts = [found["triangles"], octahedra(found["points"], width), tubes(found["edges"], width)]
    result = object_of(np.concatenate(parts), "Axis")
    result.data.materials.append(paint((0.9, 0.45, 0.1)))
    blender_scene.PIXELS = PIXELS
    blender_scene.arrange(solid, result)
    bpy.context.scene.cycles.samples = SAMPLES
    bpy.context.scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)


def object_of(triangles, name):
    mesh = bpy.data.meshes.new(name)
    faces = np.arange(3 * len(triangles)).reshape(-1, 3)
    mesh.from_pydata(triangles.reshape(-1, 3).tolist(), [], faces.tolist())
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def octahedra(points, width):
    """(8 p, 3, 3) triangles."""
    return (points[:, None, None, :] + 2 * width * OCTAHEDRON[SIDES]).reshape(-1, 3, 3)


def tubes(edges, width):
    """(6 e, 3, 3) triangles of prisms along edges (e, 2, 3)."""
    along = edges[:, 1] - edges[:, 0]
    other = np.eye(3)[np.abs(along).argmin(axis=1)]
    right = np.cross(along, other)
    right /= np.maximum(np.linalg.norm(right, axis=1, keepdims=True), 1e-300)
    up = np.cross(along, right)
    up /= np.maximum(np.linalg.norm(up, axis=1, keepdims=True), 1e-300)
    made = []
    angles = 2 * np.pi * np.arange(4) / 3
    ring = [width * (np.cos(a) * right + np.sin(a) * up) for a in angles]
    for here, there in pairwise(ring):
        low, high = edges[:, 0], edges[:, 1]
        made.append(np.stack((low + here, low + there, high + there), axis=1))
        made.append(np.stack((low + here, high + there, high + here), axis=1))
    return np.concatenate(made)


def paint(colour):
    """A dull material of that red, green and blue."""
    material = bpy.data.materials.new("Axis")
    material.use_nodes = True
    bsdf = material.node_tree.nodes["Principled BSDF"]
    bsdf.inputs["Base Color"].default_value = (*colour, 1.0)
    bsdf.inputs["Roughness"].default_value = 0.7
    return material


if __name__ == "__main__":
    main()
