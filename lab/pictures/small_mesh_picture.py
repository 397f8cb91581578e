# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of small medial meshes: a column per body with its surface, its small mesh, and the solid rebuilt of it.

    blender --background --factory-startup --python-exit-code 1 --python lab/pictures/small_mesh_picture.py -- \\
        dist/medial_axis-VERSION.zip docs/pictures/small_mesh.png

Meshes come from the folder in MEDIAL_AXIS_TEST_DATA; ImageMagick's `montage` puts the panes side by side.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
from beside_others import object_of, paint, tubes
from contact_sheet import FILES, blender_demo, blender_scene, made

BODIES = ("hand", "dilo", "3holes")
PIXELS = (420, 330)
SAMPLES = 64
VERTICES = 200


def main():
    publish(BODIES, panes_of)


def publish(bodies, panes_of):
    """Write the picture with a column per body, whose panes are made in a folder."""
    archive, picture = sys.argv[sys.argv.index("--") + 1 :]
    blender_demo.install(archive)
    with tempfile.TemporaryDirectory() as folder:
        rows = zip(*(panes_of(body, Path(folder)) for body in bodies), strict=True)
        panes = [str(pane) for row in rows for pane in row]
        tiles = ["-tile", f"{len(bodies)}x", "-geometry", "+0+0", "-background", "white"]
        subprocess.run(["montage", *panes, *tiles, "PNG8:" + picture], check=True)


def panes_of(body, folder):
    """The pictures of the surface, the small mesh and the rebuilt solid of a body."""
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    surface = made(body, FILES[body])
    bpy.ops.object.medial_axis(form="CLEAN")
    bpy.ops.object.medial_axis_reduce(vertices=VERTICES)
    small = bpy.context.object
    bpy.ops.object.medial_axis_rebuild()
    solid = next(thing for thing in bpy.data.objects if thing.name.endswith("Rebuilt"))
    arrange(surface)
    lines = edges_of(small, 0.002 * max(surface.dimensions))
    for thing, colour in (
        (surface, (0.25, 0.25, 0.26)),
        (solid, (0.1, 0.2, 0.4)),
        (small, (0.4, 0.22, 0.06)),
        (lines, (0.01, 0.01, 0.01)),
    ):
        dye(thing, colour)
    return [
        render(folder / f"{body}{number}.png", shown)
        for number, shown in enumerate(((surface,), (small, lines), (solid,)))
    ]


def arrange(surface):
    blender_scene.PIXELS = PIXELS
    blender_scene.show_whole(surface)
    bpy.context.scene.cycles.samples = SAMPLES
    bpy.context.scene.render.film_transparent = True


def edges_of(thing, width):
    """An object of tubes along the edges of a mesh."""
    corners = np.array([thing.matrix_world @ vertex.co for vertex in thing.data.vertices])
    ends = np.array([edge.vertices[:] for edge in thing.data.edges])
    return object_of(tubes(corners[ends], width), "Edges")


def dye(thing, colour):
    material = paint(colour)
    if not thing.material_slots:
        thing.data.materials.append(None)
    for slot in thing.material_slots:  # the rebuilt solid shares the mesh of the small one
        slot.link = "OBJECT"
        slot.material = material


def render(path, shown):
    for thing in bpy.data.objects:
        if thing.type == "MESH":
            thing.hide_render = thing not in shown
    bpy.context.scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    return path


if __name__ == "__main__":
    main()
