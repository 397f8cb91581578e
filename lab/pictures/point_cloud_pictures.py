# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of what artists get from points alone: the watertight surface left, the inner axis in it right.

    blender --background --factory-startup --python-exit-code 1 --python lab/pictures/point_cloud_pictures.py -- \\
        --zip dist/medial_axis-VERSION.zip --output pictures [--only cactus lion ...]

Every data set becomes an object of vertices without faces, from which both operators work; their reports are printed.
Back sides of the surface are red: none should show. Where the file has faces, facets that only the points give are
green, and those that only the faces give are light blue. Files come from the folder in MEDIAL_AXIS_TEST_DATA; those
that are not there are named and left out.
"""

import argparse
import math
import os
import sys
from pathlib import Path

import bmesh
import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests"))
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "demo"))
import blender_demo
import blender_scene

# Name of the picture: file, and the turns about X, Y and Z, in degrees, that show it upright and from the front.
SETS = {
    "cactus": ("cactus.xyz", (0, 0, 0)),
    "distcap": ("distcap.xyz", (90, 0, 0)),
    "lion": ("lion_scan.ply", (0, 0, 0)),
    "mannequin": ("mannequin.off", (0, 0, 0)),
    "dilo": ("dilo.off", (-90, 0, 0)),
    "igea": ("igea.ply", (90, 0, 0)),
    "foot": ("foot.off", (0, 0, 60)),
    "club": ("club.off", (90, 0, 0)),
    "fandisk": ("fandisk_large.off", (90, 0, 0)),
    "torus": (None, (0, 0, 0)),
}
PANEL = (490, 490)  # pixels; a picture has two
SAMPLES = 64
EXTRA = (0.05, 0.9, 0.1, 1.0)
MISSING = (0.1, 0.8, 1.0, 1.0)


def main():
    arguments = parse()
    blender_demo.install(arguments.zip)
    arguments.output.mkdir(parents=True, exist_ok=True)
    for name in arguments.only:
        shape = read(SETS[name][0])
        if shape is not None:
            show(name, *shape, arguments.output / f"tight_cocone_{name}.png")


def parse():
    parser = argparse.ArgumentParser()
    parser.add_argument("--zip", required=True)
    parser.add_argument("--output", type=Path, required=True)
    parser.add_argument("--only", nargs="+", choices=SETS, default=SETS)
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1 :])


# --- points


def read(file):
    """(points, faces) of a file, by the importer that a person would use; None where it is absent."""
    if file is None:
        return noisy_torus(), []
    path = Path(os.environ.get("MEDIAL_AXIS_TEST_DATA", ""), file)
    if not path.is_file():
        print(f"left out: no file {file} in the folder of MEDIAL_AXIS_TEST_DATA")
        return None
    empty()
    own = {".xyz": bpy.ops.import_mesh.points_xyz, ".off": bpy.ops.import_mesh.points_off}
    if path.suffix in own:
        own[path.suffix](filepath=str(path))
    else:
        blender_demo.import_file(path)
    mesh = bpy.context.object.data
    points = [tuple(vertex.co) for vertex in mesh.vertices]
    return points, [tuple(polygon.vertices) for polygon in mesh.polygons]


def noisy_torus():
    """Points with a noise of a third of the spacing in every coordinate."""
    from scipy.spatial import cKDTree  # here, as Blender's own Python has no SciPy
    from support.shapes import Torus

    points = Torus().sample(8000)
    spacing = np.median(cKDTree(points).query(points, 2)[0][:, 1])
    noise = np.random.default_rng(1).normal(size=points.shape) * spacing / 3
    return (points + noise).tolist()


def empty():
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)


# --- one picture


def show(name, points, faces, path):
    empty()
    turn = [math.radians(angle) for angle in SETS[name][1]]
    source = new_object(name, turn, points, [])
    # Facets of the same two samples are compared, which only the diagram has.
    mesh = {"mesh": "VORONOI"} if faces else {}
    surface, axis = made(source, "tight_cocone_surface"), made(source, "medial_axis", **mesh)
    if faces:
        truth = new_object(f"{name} with faces", turn, points, faces)
        by_faces = {"sides": "SURFACE", "sampling": "VERTICES", **mesh}
        mark_differences(axis, made(truth, "medial_axis", **by_faces))
        truth.hide_render = True  # its axis stays: the facets that are missing
    picture(surface, axis, path)


def new_object(name, turn, points, faces):
    blender_demo.link(name, points, faces)
    thing = bpy.data.objects[name]
    thing.rotation_euler = turn
    return thing


def made(source, operator, **options):
    """The object that an operator of the add-on makes from another."""
    bpy.ops.object.select_all(action="DESELECT")
    source.select_set(True)
    bpy.context.view_layer.objects.active = source
    getattr(bpy.ops.object, operator)(**options)
    return bpy.context.object


def picture(surface, axis, path):
    """Both panels, each rendered by itself, side by side in one file."""
    blender_scene.PIXELS = PANEL
    blender_scene.arrange(surface, axis)
    bpy.context.scene.cycles.samples = SAMPLES
    right = render(path)
    surface.data.materials[0] = clay()
    for thing in bpy.context.scene.objects:
        thing.hide_render = thing.type == "MESH" and thing != surface
    save(np.hstack((render(path), right)), path)


def mark_differences(axis, truth):
    """Colour what only the axis has; leave of the axis from the faces what only that has."""
    ours, theirs = generators(axis), generators(truth)
    extra, common = ~np.isin(ours, theirs), np.isin(theirs, ours)
    print(f"{axis.name}: {extra.sum()} extra, {(~common).sum()} missing of {len(theirs)} facets")
    axis.data.materials.append(glow(EXTRA))
    axis.data.polygons.foreach_set("material_index", extra.astype(np.int32))
    remove_faces(truth.data, common)
    truth.data.materials[0] = glow(MISSING)


def remove_faces(mesh, mask):
    shape = bmesh.new()
    shape.from_mesh(mesh)
    unwanted = [face for face, marked in zip(shape.faces, mask) if marked]
    bmesh.ops.delete(shape, geom=unwanted, context="FACES")
    shape.to_mesh(mesh)
    shape.free()


def generators(axis):
    """(f,) the pair of samples of each facet as one number."""
    found = [each.data for each in axis.data.attributes if each.name.startswith("ma_generator")]
    values = np.empty((len(found), 2 // len(found) * len(axis.data.polygons)), np.int32)
    for data, row in zip(found, values):
        data.foreach_get("value", row)
    pairs = values if len(found) == 2 else values.reshape(-1, 2).T
    a, b = np.sort(pairs, axis=0)  # a facet that was turned round has them the other way
    return a.astype(np.int64) << 32 | b


def glow(colour):
    material = bpy.data.materials.new("Difference")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    light = nodes.new("ShaderNodeEmission")
    light.inputs[0].default_value = colour
    links.new(light.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs[0])
    return material


def clay():
    """Matt and opaque, with a red back side."""
    material = bpy.data.materials.new("Clay")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    new, link = tree.nodes.new, tree.links.new
    front, back = new("ShaderNodeBsdfDiffuse"), new("ShaderNodeEmission")
    front.inputs[0].default_value = (0.45, 0.52, 0.62, 1.0)
    back.inputs[0].default_value = (0.8, 0.0, 0.0, 1.0)
    side = new("ShaderNodeNewGeometry").outputs["Backfacing"]
    both = blender_scene.mix(new, link, side, front.outputs[0], back.outputs[0])
    link(both, new("ShaderNodeOutputMaterial").inputs[0])
    return material


def render(path):
    """(height, width, 4) the scene, seen by its camera."""
    bpy.context.scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(str(path))
    pixels = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(pixels)
    width, height = image.size
    bpy.data.images.remove(image)
    return pixels.reshape(height, width, 4)


def save(pixels, path):
    height, width, _ = pixels.shape
    image = bpy.data.images.new(path.stem, width, height)
    image.pixels.foreach_set(np.ascontiguousarray(pixels).ravel())
    image.file_format = "PNG"
    image.filepath_raw = str(path)
    image.save()
    bpy.data.images.remove(image)


if __name__ == "__main__":
    main()
