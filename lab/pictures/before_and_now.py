# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on's results for models that once looked ugly, of two versions side by side.

    blender --background --factory-startup --python-exit-code 1 --python lab/pictures/before_and_now.py -- \\
        --zip older.zip --column before --folder pictures
    blender --background --factory-startup --python-exit-code 1 --python lab/pictures/before_and_now.py -- \\
        --zip dist/medial_axis-VERSION.zip --column now --folder pictures --output docs/pictures/before_and_now.png

With --output the pictures of both columns are put together. Meshes come from the folder in MEDIAL_AXIS_TEST_DATA.
"""

import argparse
import math
import sys
from pathlib import Path

import bpy
from mathutils import Matrix, Vector

sys.path.insert(0, str(Path(__file__).parent))
import contact_sheet
from contact_sheet import FILES, blender_demo, blender_scene, made

PIXELS = (300, 250)
SAMPLES = 96
COLUMNS = ("before", "now")
TURN = math.radians(75)  # of the posed woman, who is seen from her side
SIDE = Vector((math.cos(TURN), -math.sin(TURN), 0))  # her left


def main():
    arguments = parse()
    blender_demo.install(arguments.zip)
    arguments.folder.mkdir(parents=True, exist_ok=True)
    for name, show in ROWS.items():
        if not arguments.only or name in arguments.only:
            picture(arguments.folder / f"{name}, {arguments.column}.png", *scene_of(show))
    if arguments.output:
        names = [f"{name}, {column}" for name in ROWS for column in COLUMNS]
        contact_sheet.montage(arguments.folder, names, arguments.output, columns=4)


def parse():
    parser = argparse.ArgumentParser()
    parser.add_argument("--zip", required=True)
    parser.add_argument("--column", choices=COLUMNS, required=True)
    parser.add_argument("--folder", type=Path, required=True)
    parser.add_argument("--output", type=Path)
    parser.add_argument("--only", nargs="+", default=[])
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1 :])


def scene_of(show):
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    return show()


def picture(path, surface, result):
    """Render a result, in its surface if it has one."""
    blender_scene.PIXELS = PIXELS
    if surface is None:
        blender_scene.show_whole(result)
    else:
        blender_scene.arrange(surface, result)
    bpy.context.scene.cycles.samples = SAMPLES
    bpy.context.scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    print(path.stem, flush=True)


# --- the sources


def file(name):
    return lambda: made(name, FILES[name])


def suzanne():
    bpy.ops.mesh.primitive_monkey_add()
    source = bpy.context.object
    source.modifiers.new("Subdivision", "SUBSURF").levels = 2
    return source


def linked_tubes():
    """Two tori of six flat sides, one through the other."""
    for place, turn in (((0, 0, 0), 0), ((1, 0, 0), math.pi / 2)):
        bpy.ops.mesh.primitive_torus_add(
            location=place,
            rotation=(turn, 0, 0),
            major_segments=48,
            minor_segments=6,
            major_radius=1,
            minor_radius=0.25,
        )
    for thing in bpy.data.objects:
        thing.select_set(True)
    bpy.ops.object.join()
    return bpy.context.object


def cup():
    """A cup with walls of a fiftieth of its height."""
    bpy.ops.mesh.primitive_cone_add(radius1=0.03, radius2=0.04, depth=0.1, end_fill_type="NOTHING")
    source = bpy.context.object
    low = [vertex.index for vertex in source.data.vertices if vertex.co.z < 0]
    mesh = bpy.data.meshes.new("Cup")
    places = [tuple(vertex.co) for vertex in source.data.vertices]
    faces = [tuple(face.vertices) for face in source.data.polygons]
    mesh.from_pydata(places, [], [*faces, low])
    source.data = mesh
    source.modifiers.new("Solidify", "SOLIDIFY").thickness = 0.002
    return source


# --- what is shown of them


def axis_of(source, **settings):
    def show():
        surface = source()
        bpy.ops.object.medial_axis(**settings)
        return surface, bpy.context.object

    return show


def small_mesh():
    surface = suzanne()
    bpy.ops.object.medial_axis(form="CLEAN")
    bpy.ops.object.medial_axis_reduce(vertices=200)
    bpy.data.objects.remove(bpy.data.objects[f"{surface.name} Medial Axis"])
    return surface, bpy.context.object


def thickness():
    surface = cup()
    bpy.ops.object.medial_axis_thickness(limit=0.0025)
    (carrier,) = (thing for thing in bpy.data.objects if "Thickness" in thing.name)
    surface.hide_render = True
    return None, carrier


def posed():
    """The woman with a raised thigh, seen from her right."""
    surface = made("woman", FILES["woman"])
    surface.rotation_euler.z = -TURN
    bpy.context.view_layer.update()
    bpy.ops.object.medial_axis_armature()
    (armature,) = (thing for thing in bpy.data.objects if thing.type == "ARMATURE")
    raise_thigh(armature)
    surface.data.polygons.foreach_set("use_smooth", [True] * len(surface.data.polygons))
    return None, surface


def raise_thigh(armature):
    """Turn the longest bone of the lower half that points down and is nearest to the camera by 70 degrees."""
    place = armature.matrix_world
    bones = armature.pose.bones
    ends = {bone.name: (place @ bone.head, place @ bone.tail) for bone in bones}
    middle = sum((head + tail).z / 2 for head, tail in ends.values()) / len(ends)
    legs = [
        name
        for name, (head, tail) in ends.items()
        if head.dot(SIDE) > 0 and tail.z < min(head.z, middle) - abs(head.x - tail.x)
    ]
    thigh = max(legs, key=lambda name: bones[name].length)
    head = Matrix.Translation(ends[thigh][0])
    turn = head @ Matrix.Rotation(math.radians(-70), 4, SIDE) @ head.inverted()
    bones[thigh].matrix = place.inverted() @ turn @ place @ bones[thigh].matrix
    bpy.context.view_layer.update()


ROWS = {
    "woman": axis_of(file("woman"), form="CLEAN"),
    "woman, curve": axis_of(file("woman"), form="CURVE"),
    "dilo": axis_of(file("dilo"), form="CLEAN"),
    "dilo, as published": axis_of(file("dilo"), form="PUBLISHED"),
    "dilo, curve": axis_of(file("dilo"), form="CURVE"),
    "igea, curve": axis_of(file("igea"), form="CURVE"),
    "linked tubes": axis_of(linked_tubes, form="CLEAN"),
    "linked tubes, curve": axis_of(linked_tubes, form="CURVE"),
    "block with holes": axis_of(file("3holes"), form="CLEAN"),
    "Suzanne": axis_of(suzanne, form="CLEAN"),
    "Suzanne, outer": axis_of(suzanne, form="CLEAN", side="OUTER"),
    "cup, thickness": thickness,
    "small mesh": small_mesh,
    "posed": posed,
}


if __name__ == "__main__":
    main()
