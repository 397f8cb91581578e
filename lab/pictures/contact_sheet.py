# SPDX-License-Identifier: GPL-3.0-or-later
"""Contact sheets: what one click makes of each primitive of Blender and of each mesh of the data folder.

    blender --background --factory-startup --python-exit-code 1 --python lab/pictures/contact_sheet.py -- \\
        --zip dist/medial_axis-VERSION.zip --output pictures [--only cube igea ...] [--forms published clean curve]
        [--spikes 0 0.5 1] [--wrap]

The surface is translucent, the axis coloured by radius; edges that stand by themselves are tubes. With
--forms there is a row per mesh and a column per form, with --spikes a column per value of Spikes, with --wrap a mesh as
it is and wrapped. Every picture is rendered by itself; ImageMagick's `montage` puts them side by side. What cannot be
computed is printed with what the add-on says. Files come from the folder in MEDIAL_AXIS_TEST_DATA, the bull from
Debian's `assimp-testmodels`; those that are not there are named and left out.
"""

import argparse
import math
import os
import subprocess
import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "demo"))
import blender_demo
import blender_scene

PIXELS = (360, 300)
SAMPLES = 64
COLUMNS = 5


def text():
    bpy.ops.object.text_add()
    bpy.context.object.data.body = "Axis"
    bpy.context.object.data.extrude = 0.15
    bpy.context.object.data.bevel_depth = 0.02


def bevelled_curve():
    bpy.ops.curve.primitive_bezier_circle_add()
    bpy.context.object.data.bevel_depth = 0.3
    bpy.context.object.data.bevel_resolution = 8


def metaballs():
    bpy.ops.object.metaball_add(type="BALL")
    second = bpy.context.object.data.elements.new()
    second.co = (1.6, 0.0, 0.4)
    bpy.context.object.data.resolution = 0.1


PRIMITIVES = {
    "cube": lambda: bpy.ops.mesh.primitive_cube_add(),
    "uv sphere": lambda: bpy.ops.mesh.primitive_uv_sphere_add(),
    "ico sphere": lambda: bpy.ops.mesh.primitive_ico_sphere_add(),
    "cylinder": lambda: bpy.ops.mesh.primitive_cylinder_add(),
    "cone": lambda: bpy.ops.mesh.primitive_cone_add(),
    "torus": lambda: bpy.ops.mesh.primitive_torus_add(),
    "suzanne": lambda: bpy.ops.mesh.primitive_monkey_add(),
    "grid": lambda: bpy.ops.mesh.primitive_grid_add(),
    "text": text,
    "curve": bevelled_curve,
    "metaballs": metaballs,
}
# Name: file, and the turn about X, in degrees, that shows it upright.
FILES = {
    "3holes": ("3holes.off", 60),
    "knot": ("knot1.off", 0),
    "engine parts": ("engine_parts.ply", 0),
    "mannequin": ("mannequin.off", 0),
    "fandisk": ("fandisk_large.off", 90),
    "club": ("club.off", 90),
    "foot": ("foot.off", 0),
    "hand": ("hand_closed.obj", 0),
    "screwdriver": ("screwdriver.off", 0),
    "dilo": ("dilo.off", -90),
    "liver": ("liver.ply", 0),
    "rocker arm": ("rocker-arm.off", 60),
    "igea": ("igea.ply", 90),
    "woman": ("human_woman.obj", 90),
    "bunny": ("stanford-bunny.obj", 90),
    "spot": ("spot_low.obj", 90),
    "elephant": ("elephant-with-holes.off", 90),
    "openscad": ("openscad-nonmanifold-crash.obj", 0),
    "engine skin": ("engine_skin_large.ply", 0),
    "cactus": ("cactus.xyz", 0),
    "distcap": ("distcap.xyz", 90),
    "lion": ("lion_scan.ply", 0),
    "bull": ("WusonOBJ.obj", 90),
}


def main():
    arguments = parse()
    blender_demo.install(arguments.zip)
    if arguments.forms:
        columns(arguments, "forms", {form: {"form": form.upper()} for form in arguments.forms})
        return
    if arguments.spikes:
        columns(arguments, "spikes", {f"{value:g}": {"spike": value} for value in arguments.spikes})
        return
    if arguments.wrap:
        columns(arguments, "wrap", {"as it is": {}, "wrapped": {"sides": "WRAP"}})
        return
    for sheet, made in (("primitives", PRIMITIVES), ("meshes", FILES)):
        folder = arguments.output / sheet
        folder.mkdir(parents=True, exist_ok=True)
        shown = [name for name in made if not arguments.only or name in arguments.only]
        pictures = [name for name in shown if show(name, made[name], folder / f"{name}.png")]
        if pictures:
            montage(folder, pictures, arguments.output / f"sheet_{sheet}.png")


def columns(arguments, sheet, settings):
    """A row per mesh, a column per settings, by their names."""
    folder = arguments.output / sheet
    folder.mkdir(parents=True, exist_ok=True)
    known = {**PRIMITIVES, **FILES}
    pictures = []
    for name in arguments.only or FILES:
        for column, chosen in settings.items():
            picture = f"{name} {column}"
            if show(name, known[name], folder / f"{picture}.png", **chosen):
                pictures.append(picture)
    montage(folder, pictures, arguments.output / f"sheet_{sheet}.png", len(settings))


def parse():
    parser = argparse.ArgumentParser()
    parser.add_argument("--zip", required=True)
    parser.add_argument("--output", type=Path, required=True)
    parser.add_argument("--only", nargs="+", default=[])
    parser.add_argument("--forms", nargs="+", choices=["clean", "published", "curve"])
    parser.add_argument("--spikes", nargs="+", type=float)
    parser.add_argument("--wrap", action="store_true")
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1 :])


def show(name, make, path, **settings):
    """Render the axis of one object; False when there is none."""
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    source = made(name, make)
    if source is None:
        return False
    try:
        bpy.ops.object.medial_axis(**settings)
    except RuntimeError as refusal:
        print(f"{name}: {refusal}")
        return False
    result = bpy.context.object
    print(
        f"{path.stem}: {len(result.data.polygons):,} facets, {result.get('ma_topology', '')}; "
        f"{result.get('ma_sampled', '')}; valid {not result.data.validate()}",
        flush=True,
    )
    surface = as_mesh(source)
    blender_scene.PIXELS = PIXELS
    blender_scene.arrange(surface, result)
    bpy.context.scene.cycles.samples = SAMPLES
    bpy.context.scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    return True


def made(name, make):
    """The object, selected, active and upright; None when its file is absent."""
    if callable(make):
        make()
        return bpy.context.object
    file, turn = make
    path = Path(os.environ.get("MEDIAL_AXIS_TEST_DATA", ""), file)
    if not path.is_file():
        print(f"left out: no file {file} in the folder of MEDIAL_AXIS_TEST_DATA")
        return None
    own = {".xyz": bpy.ops.import_mesh.points_xyz, ".off": bpy.ops.import_mesh.points_off}
    if path.suffix in own:
        own[path.suffix](filepath=str(path))
    else:
        blender_demo.import_file(path)
    thing = blender_demo.join_meshes()
    thing.rotation_euler = (math.radians(turn), 0.0, 0.0)
    bpy.context.view_layer.update()
    return thing


def as_mesh(source):
    """The mesh to draw for the source: itself, or the mesh of a text, curve or metaball."""
    if source.type == "MESH":
        return source
    graph = bpy.context.evaluated_depsgraph_get()
    mesh = bpy.data.meshes.new_from_object(source.evaluated_get(graph))
    thing = bpy.data.objects.new("Surface", mesh)
    thing.matrix_world = source.matrix_world
    bpy.context.scene.collection.objects.link(thing)
    source.hide_render = True
    return thing


def montage(folder, names, path, columns=COLUMNS):
    pictures = [word for name in names for word in ("-label", name, str(folder / f"{name}.png"))]
    command = ["montage", "-font", font(), *pictures, "-tile", f"{columns}x", "-geometry", "+4+4"]
    subprocess.run([*command, str(path)], check=True)


def font():
    """One of Blender's own: a bare Debian has none."""
    fonts = Path(bpy.utils.system_resource("DATAFILES", path="fonts"))
    return str(sorted(fonts.glob("DejaVuSans*"))[0])


if __name__ == "__main__":
    main()
