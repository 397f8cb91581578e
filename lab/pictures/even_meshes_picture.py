# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of even meshes: the sheets of Suzanne and two bodies as facets of the Voronoi diagram, and even below.

    blender --background --factory-startup --python-exit-code 1 --python lab/pictures/even_meshes_picture.py -- \\
        dist/medial_axis-VERSION.zip docs/pictures/even_meshes.png

Meshes come from the folder in MEDIAL_AXIS_TEST_DATA; ImageMagick's `montage` puts the panes side by side.
"""

import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).parent))
from contact_sheet import FILES, made
from small_mesh_picture import arrange, dye, edges_of, publish, render

BODIES = ("suzanne", "hand", "3holes")


def panes_of(body, folder):
    """The pictures of the facets and of the even mesh of a body."""
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    source = shape_of(body)
    panes = []
    for mesh in ("VORONOI", "EVEN"):
        bpy.context.view_layer.objects.active = source
        source.select_set(True)
        bpy.ops.object.medial_axis(mesh=mesh)
        axis = bpy.context.object
        if not panes:
            arrange(axis)
        lines = edges_of(axis, 0.0006 * max(axis.dimensions))
        dye(axis, (0.4, 0.22, 0.06))
        dye(lines, (0.01, 0.01, 0.01))
        panes.append(render(folder / f"{body}_{mesh}.png", (axis, lines)))
        bpy.data.objects.remove(lines)
    return panes


def shape_of(body):
    if body != "suzanne":
        return made(body, FILES[body])
    bpy.ops.mesh.primitive_monkey_add()
    bpy.context.object.modifiers.new("Subdivision", "SUBSURF").levels = 3
    return bpy.context.object


if __name__ == "__main__":
    publish(BODIES, panes_of)
