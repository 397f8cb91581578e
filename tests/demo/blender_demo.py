# SPDX-License-Identifier: GPL-3.0-or-later
"""One model of the demo, inside Blender: install the zip, compute, export, render, report.

    blender --background --factory-startup --python-exit-code 1 --python tests/demo/blender_demo.py -- \\
        --zip dist/medial_axis-VERSION.zip --model suzanne --subdivide 3 --output demo_output --report report.json
"""

import argparse
import atexit
import importlib
import json
import math
import os
import shutil
import sys
import tempfile
import time
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
import blender_scene

DELAUNAY = "triangulation"  # its stage in `MedialAnalysis.timings`


def main():
    arguments = parse()
    package = install(arguments.zip)
    source = load(arguments.model, arguments.subdivide, arguments.y_up)
    if arguments.flat:
        source.data.polygons.foreach_set("use_smooth", np.zeros(len(source.data.polygons), bool))
    result = compute(source)
    arguments.output.mkdir(parents=True, exist_ok=True)
    files = write(result, arguments.output, source.name)
    blender_scene.arrange(source, result, shine=not arguments.flat)
    files += [save(arguments.output, source.name), render(arguments.output, source.name)]
    report = {**figures(package, result), "files": ", ".join(path.name for path in files)}
    arguments.report.write_text(json.dumps(report), encoding="utf-8")


def parse():
    parser = argparse.ArgumentParser()
    parser.add_argument("--zip", required=True)
    models = "'suzanne', 'bracket', or a .ply, .obj, .stl or .off file"
    parser.add_argument("--model", required=True, help=models)
    levels = "levels of a Subdivision Surface modifier"
    parser.add_argument("--subdivide", type=int, default=0, help=levels)
    parser.add_argument("--y-up", action="store_true", help="the file's Y axis points up")
    parser.add_argument("--flat", action="store_true", help="shade it flat, as a part with edges")
    parser.add_argument("--output", type=Path, required=True)
    parser.add_argument("--report", type=Path, required=True)
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1 :])


def install(archive):
    """Install and enable the add-on as a person would, for this run alone; returns the name of its package."""
    leave_profile()
    if bpy.app.version < (4, 2, 0):
        bpy.ops.preferences.addon_install(filepath=archive, overwrite=True)
        bpy.ops.preferences.addon_enable(module="medial_axis")
        return "medial_axis"
    bpy.ops.extensions.package_install_files(
        filepath=archive, repo="user_default", enable_on_install=True
    )
    return "bl_ext.user_default.medial_axis"


def leave_profile():
    """From here on this Blender has a profile in a temporary folder, and the person's own keeps its add-ons.

    Blender looks these variables up whenever it asks for a folder.
    """
    folder = Path(tempfile.mkdtemp(prefix="medial_axis_profile_"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    for part in ("RESOURCES", "CONFIG", "SCRIPTS", "DATAFILES", "EXTENSIONS"):
        path = folder / part.lower()
        path.mkdir()
        os.environ[f"BLENDER_USER_{part}"] = str(path)


# --- models


def load(model, levels, y_up):
    """The only object of a new scene, smooth, upright and with the modifier."""
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    path = Path(model)
    if model == "suzanne":
        bpy.ops.mesh.primitive_monkey_add()
        bpy.context.object.name = "Suzanne"
    elif model == "bracket":
        add_bracket()
    else:
        import_file(path)
    source = join_meshes()
    if path.suffix.lower() == ".off":
        source.name = path.stem.capitalize()
    if model != "bracket":  # which has flat faces
        source.data.polygons.foreach_set("use_smooth", np.ones(len(source.data.polygons), bool))
    if y_up:
        source.rotation_euler.x += math.pi / 2
    if levels:
        modifier = source.modifiers.new("Subdivision", "SUBSURF")
        modifier.levels = modifier.render_levels = levels
    print(f"{source.name}: {len(source.data.vertices):,} vertices, subdivision level {levels}")
    return source


def add_bracket():
    """A machine part with sharp edges: two legs that a fillet joins, with a hole through each."""
    x, z = 1.5, 1.5  # the centre of the arc of the fillet
    turns = [math.radians(degrees) for degrees in range(180, 271, 10)]
    arc = [(x + 1.0 * math.cos(turn), z + 1.0 * math.sin(turn)) for turn in reversed(turns)]
    profile = [(0, 0), (3.2, 0), (3.2, 0.5), *arc, (0.5, 2.6), (0, 2.6)]
    count = len(profile)
    corners = [(x, y, z) for y in (-1.0, 1.0) for x, z in profile]
    sides = [(i, (i + 1) % count, count + (i + 1) % count, count + i) for i in range(count)]
    ends = [tuple(reversed(range(count))), tuple(range(count, 2 * count))]
    link("Bracket", corners, [tuple(reversed(side)) for side in [*sides, *ends]])
    part = bpy.data.objects["Bracket"]
    drill(part, (2.35, 0, 0.25), (0, 0, 0), 0.5)
    drill(part, (0.25, 0, 1.9), (0, math.pi / 2, 0), 0.4)


def drill(part, place, turn, radius):
    options = {"vertices": 64, "depth": 2, "location": place, "rotation": turn}
    bpy.ops.mesh.primitive_cylinder_add(radius=radius, **options)
    tool = bpy.context.object
    modifier = part.modifiers.new("Hole", "BOOLEAN")
    modifier.object = tool
    bpy.context.view_layer.objects.active = part
    bpy.ops.object.modifier_apply(modifier=modifier.name)
    bpy.data.objects.remove(tool)


def import_file(path):
    kind = path.suffix.lower()
    new = bpy.app.version >= (4, 0, 0)
    importers = {
        ".ply": bpy.ops.wm.ply_import if new else bpy.ops.import_mesh.ply,
        ".stl": bpy.ops.wm.stl_import if new else bpy.ops.import_mesh.stl,
        ".obj": bpy.ops.wm.obj_import,
        ".off": bpy.ops.import_mesh.points_off,
    }
    if kind not in importers:
        expected = "Expected a .ply, .obj, .stl or .off file"
        raise SystemExit(f"{expected}, found '{path.name}'; convert it first")
    importers[kind](filepath=str(path))


def join_meshes():
    """All imported meshes as one object, selected and active."""
    meshes = [thing for thing in bpy.context.scene.objects if thing.type == "MESH"]
    if not meshes:
        raise SystemExit("Expected a file with a mesh, found none; choose another file")
    for thing in bpy.context.scene.objects:
        thing.select_set(thing in meshes)
    bpy.context.view_layer.objects.active = meshes[0]
    if len(meshes) > 1:
        bpy.ops.object.join()
    return bpy.context.object


def link(name, vertices, faces):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], faces)
    bpy.context.scene.collection.objects.link(bpy.data.objects.new(name, mesh))


# --- the add-on at work


def compute(source):
    start = time.perf_counter()
    bpy.ops.object.medial_axis()
    result = bpy.context.view_layer.objects.active
    seconds = time.perf_counter() - start
    print(f"{result.name}: {len(result.data.polygons):,} facets after {seconds:.2f} s")
    return result


def write(result, folder, name):
    bpy.context.view_layer.objects.active = result
    files = [folder / f"{name}{suffix}" for suffix in (".ply", ".ma")]
    for path in files:
        bpy.ops.export_scene.medial_axis(filepath=str(path))
    return files


def figures(package, result):
    """One row of the table: what was computed, and how long it took."""
    results = importlib.import_module(package + ".bridge.axis.axis_object")
    analysis = importlib.import_module(package + ".core.axis.compute")
    key = result[importlib.import_module(package + ".bridge.mesh.stored").ANALYSIS]
    start = time.perf_counter()
    analysis.refilter(key, results.settings_of(result))
    seconds = dict(analysis.CACHE.get(key).analysis.timings)
    delaunay = seconds.pop(DELAUNAY)
    filter_seconds = sum(seconds.values()) + time.perf_counter() - start
    return {
        "model": result.name.removesuffix(results.SUFFIX),
        "points": f"{result['ma_points']:,}",
        "Delaunay s": f"{delaunay:.2f}",
        "filter s": f"{filter_seconds:.2f}",
        "facets": f"{len(result.data.polygons):,}",
        "components": result["ma_pieces"],
    }


def save(folder, name):
    path = folder / f"{name}.blend"
    bpy.context.preferences.filepaths.save_version = 0
    bpy.ops.wm.save_as_mainfile(filepath=str(path), compress=True)
    return path


def render(folder, name):
    path, start = folder / f"{name}.png", time.perf_counter()
    blender_scene.render(path)
    print(f"{path.name}: rendered in {time.perf_counter() - start:.1f} s")
    return path


if __name__ == "__main__":
    main()
