# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of the corpus as they are, and repaired by hand in Blender: the pieces, loops and cavities of both axes.

    blender --background --factory-startup --python-exit-code 1 --python lab/corpus/repaired.py -- \\
        --zip dist/medial_axis-VERSION.zip --cache build/corpus/packages

The packages are those that `python3 -m lab.corpus` has unpacked. By hand means what a modeller does: Merge by Distance,
Delete Loose and Recalculate Outside, and then Fill Holes, too. The rows are printed as Markdown.
"""

import argparse
import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "demo"))
import blender_demo

MODELS = {
    "spider, OBJ": "assimp/models/OBJ/spider.obj",
    "spider, STL": "assimp/models/STL/Spider_binary.stl",
    "spider, FBX": "assimp/models/FBX/spider.fbx",
    "teapots": "assimp/models/Collada/teapot_instancenodes.DAE",
    "bull, outward": "assimp/models/OBJ/WusonOBJ.obj",
    "bull, inward": "assimp/models/OFF/Wuson.off",
    "plate *twotrees*": "cura/resources/meshes/twotrees235x235_generic.stl",
    "box with a face inward": "assimp/models/OBJ/box_longline.obj",
}
MERGED = 1e-6  # of the diagonal: vertices that are closer are one


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--zip", required=True)
    parser.add_argument("--cache", type=Path, required=True)
    arguments = parser.parse_args(sys.argv[sys.argv.index("--") + 1 :])
    blender_demo.install(arguments.zip)
    print("| model | faces | as it is | merged, outward | open edges | holes filled | open edges |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for name, file in MODELS.items():
        cells = (name, *compared(next(arguments.cache.glob(f"*/usr/share/{file}"))))
        print("| " + " | ".join(cells) + " |", flush=True)


def compared(path):
    """The cells of one model's row."""
    thing = imported(path)
    cells = [f"{len(thing.data.polygons):,}", axis_of(thing)]
    for fills in (False, True):
        repair(thing, fills)
        cells += [axis_of(thing), str(count_open(thing.data))]
    return cells


def imported(path):
    """The meshes of a file as the only object, with its transform applied."""
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    kind = path.suffix.lower()
    if kind == ".fbx":
        bpy.ops.import_scene.fbx(filepath=str(path))
    elif kind == ".dae":
        bpy.ops.wm.collada_import(filepath=str(path))
    else:
        blender_demo.import_file(path)
    thing = blender_demo.join_meshes()
    bpy.ops.object.transform_apply()
    return thing


def axis_of(thing):
    """The Betti numbers of the axis, or what the add-on says instead."""
    bpy.context.view_layer.objects.active = thing
    thing.select_set(True)
    try:
        bpy.ops.object.medial_axis()
    except RuntimeError as refusal:
        return str(refusal).removeprefix("Error: ").partition(";")[0].strip()
    axis = bpy.context.object
    numbers = str(tuple(axis["ma_betti"]))
    bpy.data.objects.remove(axis)
    return numbers


def repair(thing, fills):
    """Repair a mesh as a modeller does, who may fill its holes."""
    bpy.context.view_layer.objects.active = thing
    diagonal = sum(size**2 for size in thing.dimensions) ** 0.5
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.remove_doubles(threshold=MERGED * diagonal)
    bpy.ops.mesh.delete_loose()
    bpy.ops.mesh.select_all(action="SELECT")
    if fills:
        bpy.ops.mesh.fill_holes(sides=0)
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.normals_make_consistent(inside=False)
    bpy.ops.object.mode_set(mode="OBJECT")


def count_open(mesh):
    """The number of edges with one face."""
    uses = {}
    for polygon in mesh.polygons:
        for key in polygon.edge_keys:
            uses[key] = uses.get(key, 0) + 1
    return sum(count == 1 for count in uses.values())


if __name__ == "__main__":
    main()
