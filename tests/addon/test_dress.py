# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects that are made of a source have a material that renders their colours, and the range of these."""

import bpy
import numpy as np
import pytest
from installed import addon, renders
from mathutils import Matrix, Vector
from measure import evaluated, positions, result_of
from scene import added, compute, ellipsoid, new_object, press, torus

EVEN = {"form": "CLEAN", "sampling": "SURFACE", "samples": 1_500}


def rendered(thing, folder):
    """(n, 3) sRGB of the pixels that an object fills in a small render of it alone, in white light from all sides."""
    scene = bpy.context.scene
    for other in bpy.context.view_layer.objects:
        other.hide_render = other != thing
    world = scene.world = bpy.data.worlds.new("White")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs[0].default_value = (1.0, 1.0, 1.0, 1.0)
    look = scene.camera = new_object("Look", bpy.data.cameras.new("Look"))
    look.data.type, look.data.ortho_scale = "ORTHO", 4.0
    look.location = thing.matrix_world.translation + Vector((0.0, 0.0, 10.0))
    render = scene.render
    render.engine, scene.cycles.samples, scene.cycles.device = "CYCLES", 4, "CPU"
    render.film_transparent, scene.cycles.use_denoising = True, False
    scene.view_settings.view_transform = "Standard"
    render.resolution_x = render.resolution_y = 24
    render.resolution_percentage, render.filepath = 100, str(folder / "render.png")
    bpy.ops.render.render(write_still=True)
    pixels = np.array(bpy.data.images.load(render.filepath).pixels[:]).reshape(-1, 4)
    return pixels[pixels[:, 3] > 0.9, :3]


def assert_coloured(pixels):
    """The pixels are no grey: the largest channel is far above the smallest."""
    assert len(pixels) > 10
    assert np.median(np.ptp(pixels, axis=1)) > 0.25, pixels.mean(axis=0)


@renders
def test_the_whole_ramp_is_rendered_from_thin_to_thick(tmp_path):
    """One colour would mean that the radius does not reach the shader."""
    pixels = rendered(compute(ellipsoid(axes=(1.0, 0.7, 0.3))), tmp_path)
    assert len(pixels) > 20 and np.ptp(pixels[:, 0] - pixels[:, 2]) > 0.2


def rebuilt(source):
    press("medial_axis_rebuild", source)
    return addon("bridge.rebuilt_object").rebuilt_of(result_of(source))


def balls(source):
    press("medial_axis_balls", source, count=8)
    return addon("bridge.balls_object").balls_of(source)


def many_balls(source):
    made = result_of(source)
    addon("bridge.nodes.groups").add_few_balls(made)
    return made


@renders
@pytest.mark.parametrize("make", [result_of, rebuilt, balls])
def test_colours_are_rendered(make, tmp_path):
    source = ellipsoid()
    compute(**EVEN)
    assert_coloured(rendered(make(source), tmp_path))


@renders
def test_the_copy_with_the_thickness_renders_its_colours(tmp_path):
    source = added("cube", size=2)
    press("medial_axis_thickness", limit=0.3)
    made = addon("bridge.thickness.thickness_object").carrier_of(source)
    assert made != source
    assert_coloured(rendered(made, tmp_path))


@renders
def test_parts_as_objects_render_the_colours_of_their_axis(tmp_path):
    source = added("cube", size=2)
    source.scale.z = 0.2
    axis = compute(**EVEN)
    press("medial_axis_separate_parts", axis)
    parts = addon("bridge.axis.parts_objects").parts_of(axis)
    flat = max(parts, key=lambda part: np.ptp(positions(part.data), axis=0)[:2].min())
    assert_coloured(rendered(flat, tmp_path))


def test_a_rebuilt_solid_keeps_the_range_of_its_axis():
    source = torus()
    axis = compute(**EVEN)
    made, duplicate = rebuilt(source), axis.copy()
    bpy.context.scene.collection.objects.link(duplicate)
    colour_range = addon("bridge.mesh.colours").colour_range
    before = colour_range(made)
    assert before == colour_range(axis) == colour_range(duplicate)
    source.data.transform(Matrix.Scale(2.0, 4))
    compute(source, **EVEN)
    after = colour_range(made)
    assert after == colour_range(axis) == colour_range(duplicate)
    assert after[1:] == pytest.approx([2 * end for end in before[1:]], rel=0.05)


@renders
@pytest.mark.parametrize(
    ("key", "name", "make"), [("REBUILD", "Material", rebuilt), ("BALLS", "Coloured", many_balls)]
)
def test_a_file_with_the_group_of_an_older_version_gets_a_new_one(key, name, make, tmp_path):
    """The older group has no such input. It stays, and what is made now renders its colours."""
    older = addon("bridge.nodes.groups").group(key)
    if hasattr(older, "interface"):
        older.interface.remove(older.interface.items_tree[name])
    else:
        older.inputs.remove(older.inputs[name])
    source = ellipsoid()
    compute(**EVEN)
    made = make(source)
    assert_coloured(rendered(made, tmp_path))
    groups = [modifier.node_group for modifier in made.modifiers if modifier.type == "NODES"]
    assert older.name in bpy.data.node_groups and older not in groups


def test_the_material_of_a_rebuilt_solid_is_an_input():
    source = ellipsoid()
    axis = compute(**EVEN)
    made, mine = rebuilt(source), bpy.data.materials.new("Mine")
    modifier = addon("bridge.rebuilt_object").modifier_of(made)
    inputs = addon("bridge.nodes.inputs")

    def materials():  # of the faces; Blender 5.2 puts an empty slot before theirs
        seen = evaluated(made)
        return [seen.materials[index].name for index in {f.material_index for f in seen.polygons}]

    assert materials() == ["Medial Axis Radius"]
    inputs.set_inputs(modifier, {"Material": mine})
    assert materials() == ["Mine"]
    assert [m.name for m in axis.data.materials] == ["Medial Axis Radius"]
