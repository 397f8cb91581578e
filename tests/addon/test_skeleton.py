# SPDX-License-Identifier: GPL-3.0-or-later
"""Extract Skeleton and Make Armature: the objects that are made, and how a source follows its bones."""

import math

import bpy
import numpy as np
import pytest
from installed import addon
from mathutils import Euler, Matrix
from measure import attribute, evaluated, positions, result_of, world_positions
from scene import added, cells, compute, in_edit_mode, link, press, refuse, ring, select, torus
from support.meshes import capsule, join


def skeleton_of(source):
    return addon("bridge.skeleton.skeleton_object").skeleton_of(source)


def points_of(skeleton):
    """The points of a curve, one branch after the other."""
    return [point for spline in skeleton.data.splines for point in spline.points]


def armature_of(source):
    return addon("bridge.skeleton.armature_object").armature_of(source)


def cross(name="Cross"):
    """A voxel cross with four arms in the plane of X and Z, smoothed: symmetric in X."""
    made = cells(*((0, 0, z) for z in range(-3, 3)), *((x, 0, 0) for x in range(-3, 4) if x))
    made.name = name
    made.data.transform(Matrix.Translation((-0.5, -0.5, -0.5)))
    made.modifiers.new("Round", "SUBSURF").levels = 3
    bpy.context.view_layer.update()
    bpy.ops.object.modifier_apply(modifier="Round")
    return made


def extract(*source, **settings):
    return press("medial_axis_skeleton", *source, **settings)


def make_armature(*source, **settings):
    return press("medial_axis_armature", *source, **settings)


def weights_of(source):
    """(v, groups) float."""
    table = np.zeros((len(source.data.vertices), len(source.vertex_groups)))
    for vertex in source.data.vertices:
        for element in vertex.groups:
            table[vertex.index, element.group] = element.weight
    return table


def assert_weights_hold(source):
    table = weights_of(source)
    assert ((table > 0).sum(axis=1) <= 4).all()
    np.testing.assert_allclose(table.sum(axis=1), 1.0, atol=1e-5)


def test_skeleton_is_a_curve_with_radii():
    source = cross()
    thing = extract()
    assert (thing.name, thing.type, thing.data.dimensions) == ("Cross Skeleton", "CURVE", "3D")
    assert {spline.type for spline in thing.data.splines} == {"POLY"}
    assert (thing["ma_ends"], thing["ma_loops"]) == (4, 0)
    radii = [point.radius for point in points_of(thing)]
    assert min(radii) > 0.2 and max(radii) < 0.9
    assert bpy.context.selected_objects == [thing] == [skeleton_of(source)]


def test_a_bevel_of_one_shows_tubes_of_the_right_thickness():
    thing = extract(torus())
    (spline,) = thing.data.splines
    assert spline.use_cyclic_u and thing["ma_loops"] == 1 and thing["ma_ends"] == 0
    thing.data.bevel_depth = 1.0
    tube = tubes_of(thing)
    away = np.hypot(np.hypot(tube[:, 0], tube[:, 1]) - 1.0, tube[:, 2])
    np.testing.assert_allclose(away, 0.4, atol=0.02)


def tubes_of(skeleton):
    """(n, 3) the vertices of the mesh that a curve is seen as."""
    bpy.context.view_layer.update()
    seen = skeleton.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return positions(seen.to_mesh())


@pytest.mark.parametrize("scale", [1.0, 3.0])
def test_skeleton_lies_where_the_source_is(scale):
    source = cross()
    source.matrix_world = Matrix.LocRotScale((1, 2, 3), Euler((0.3, 0.2, 0.9)), (scale,) * 3)
    thing = extract(source)
    bpy.context.view_layer.update()
    assert thing.matrix_world.to_scale()[:] == pytest.approx((1, 1, 1), abs=1e-6)
    back = source.matrix_world.inverted() @ thing.matrix_world
    inside = np.array([back @ point.co.xyz for point in points_of(thing)])
    assert np.abs(inside[:, 1]).max() < 0.05 and np.abs(inside).max() < 3.5
    assert max(point.radius for point in points_of(thing)) < 0.9 * scale


def test_a_skeleton_is_seen_in_renders_as_tubes_of_a_fifth_of_the_balls():
    thing = extract(added("cylinder", vertices=64, radius=0.1, depth=4.0), sampling="SURFACE")
    away = np.linalg.norm(tubes_of(thing)[:, :2], axis=1).max()
    mesh = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    assert len(mesh.polygons) and away == pytest.approx(0.2 * 0.1, rel=0.1)


def test_running_again_updates_the_same_curve_and_keeps_its_bevel():
    source = cross()
    thing = extract()
    thing.data.bevel_depth = 0.5
    extract(detail=0.4)
    assert skeleton_of(source) == thing and thing.data.bevel_depth == 0.5
    assert len([t for t in bpy.data.objects if "ma_ends" in t]) == 1


def test_skeleton_and_bones_start_from_the_curve_that_is_seen():
    """Two arms a tenth of a radius apart, which the samples join by rungs: some are seen, so some are kept."""
    arms = capsule((0, 0, 0), (4, 0, 0), 0.3), capsule((0, 0.63, 0), (4, 0.63, 0), 0.3)
    vertices, faces = join(*arms, capsule((0, 0, 0), (0, 0.63, 0), 0.3))
    source = link("Tongs", np.asarray(vertices).tolist(), np.asarray(faces).tolist())
    sampling = {"sampling": "SURFACE", "samples": 1_200}
    compute(form="CURVE", detail=0.5, **sampling)
    loops = result_of(source)["ma_betti"][1]
    assert loops > 0
    extract(source, **sampling)
    assert skeleton_of(source)["ma_loops"] == loops
    make_armature(bind="NONE", **sampling)
    assert len(armature_of(source).data.bones) > loops
    extract(as_shown=False, **sampling)
    assert skeleton_of(source)["ma_loops"] == 0


def choose(source, chosen, mode="OBJECT"):
    """Vertices are selected, and no faces or edges beyond theirs; the object comes into a mode."""
    with in_edit_mode():
        bpy.ops.mesh.select_mode(type="VERT")
        bpy.ops.mesh.select_all(action="DESELECT")
    source.data.vertices.foreach_set("select", chosen)
    bpy.ops.object.mode_set(mode=mode)


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
@pytest.mark.parametrize("modifier", ["", "SUBSURF"])
def test_selected_ends_and_no_others(mode, modifier):
    """Two of the four arms of a cross, of which one has a few selected vertices: one branch joins them."""
    source = cross()
    if modifier:
        source.modifiers.new("Finer", modifier)
    points = positions(source.data)
    chosen = points[:, 2] < points[:, 2].min() + 0.3
    chosen[np.argmax(points[:, 0])] = True
    choose(source, np.zeros(len(points), bool))
    refuse("found 0 connected groups", operator="medial_axis_skeleton", selected_ends=True)
    choose(source, chosen, mode)
    extract(selected_ends=True)
    bpy.ops.object.mode_set(mode="OBJECT")
    made = skeleton_of(source)
    assert (made["ma_branches"], made["ma_ends"], made["ma_loops"]) == (1, 2, 0)
    ends = np.array([made.data.splines[0].points[row].co[:3] for row in (0, -1)])
    ends = ends[np.argsort(ends[:, 0])]
    assert ends[1, 0] > 0.8 * points[:, 0].max() and ends[0, 2] < 0.8 * points[:, 2].min()


def test_bones_of_selected_ends():
    source = cross()
    points = positions(source.data)
    chosen = np.zeros(len(points), bool)
    chosen[[np.argmax(points[:, 0]), np.argmin(points[:, 0]), np.argmax(points[:, 2])]] = True
    choose(source, chosen)
    make_armature(source, selected_ends=True)
    low = min(bone.tail_local.z for bone in armature_of(source).data.bones)
    assert low > 0.5 * points[:, 2].min()  # no bone goes down the fourth arm


def test_parts_on_the_faces_of_the_source():
    source = cross()
    extract(parts=True)
    part = attribute(source.data, "ma_part")
    assert len(np.unique(part)) == 4 and len(part) == len(source.data.polygons)
    centres = np.array([polygon.center for polygon in source.data.polygons])
    for number in np.unique(part):
        here = centres[part == number]
        tip = here[np.abs(here).max(axis=1).argmax()]
        assert (part[np.abs(centres - tip).max(axis=1) < 0.7] == number).all()


def test_armature_of_few_connected_bones():
    source = cross()
    thing = make_armature(bind="NONE")
    bones = thing.data.bones
    assert len(bones) <= 3 * 4 + 20 and [b.name for b in bones if b.parent is None] == ["pelvis"]
    assert all(b.use_connect or b.head != b.parent.tail for b in bones if b.parent)
    assert all(b.head_radius > 0.1 and b.tail_radius > 0.1 for b in bones)
    assert source.parent is None and not source.vertex_groups
    assert any(bone.name.endswith(".L") and bone.tail_local.x > 0.1 for bone in bones)


@pytest.mark.parametrize("bind", ["AXIS", "AUTOMATIC"])
def test_bound_source_follows_its_bones(bind):
    source = cross()
    before = world_positions(source)
    thing = make_armature(bind=bind)
    assert source.parent == thing and [m.type for m in source.modifiers] == ["ARMATURE"]
    np.testing.assert_allclose(world_positions(source), before, atol=1e-5)
    name = max(b.name for b in thing.data.bones if b.name.endswith(".L"))
    if bind == "AXIS":
        assert_weights_hold(source)
    bone = thing.pose.bones[name]
    bone.rotation_mode = "XYZ"
    bone.rotation_euler = (math.radians(60), 0, 0)
    moved = np.linalg.norm(places(source) - positions(source.data), axis=1)
    assert moved.max() > 0.5 and (moved[positions(source.data)[:, 0] < -1.0] < 0.02).all()


def test_binding_again_leaves_one_modifier_and_no_old_groups():
    source = cross()
    make_armature(bind="AXIS")
    thing = make_armature(bind="AXIS", detail=0.3)
    assert len(source.modifiers) == 1 == len([o for o in bpy.data.objects if o.type == "ARMATURE"])
    assert {group.name for group in source.vertex_groups} == set(thing.data.bones.keys())
    assert_weights_hold(source)


def test_refusals_leave_nothing_behind():
    added("ico_sphere", subdivisions=4)
    refuse("its skeleton is a point", operator="medial_axis_armature")
    with in_edit_mode():
        refuse("leave that mode", operator="medial_axis_armature")
    ring()
    refuse("choose Weights None", operator="medial_axis_armature")


def test_where_heat_fails_the_axis_steps_in(capfd, monkeypatch):
    """Two boxes that lie in each other: heat finds no way through the inner one."""
    source = cross()
    points, faces = positions(source.data), [list(p.vertices) for p in source.data.polygons]
    inner = [[i + len(points) for i in face] for face in faces]
    bpy.data.objects.remove(source)
    twice = link("Twice", np.concatenate([points, 0.3 * points]), [*faces, *inner])
    operators = addon("ui.skeleton.skeleton_operators")
    monkeypatch.setattr(operators, "bind_by_heat", lambda *_: False)
    make_armature(bind="AUTOMATIC")
    assert "the weights of the axis were taken" in capfd.readouterr().out
    assert_weights_hold(twice)
    assert "weights of the axis" in armature_of(twice)["ma_warnings"]


# --- other programs: Blender's own exporters and importers


# How they are written and read; other shading stumbles over np.bool in Blender 3.4 with NumPy 1.24.
FORMATS = {
    "gltf": (".glb", {"use_selection": True}, {"import_shading": "FLAT"}),
    "fbx": (".fbx", {"use_selection": True, "add_leaf_bones": False}, {}),
}


@pytest.mark.parametrize("form", FORMATS)
def test_armatures_go_through_the_files_of_others(form, tmp_path):
    """Bones, weights, and where vertices go when a bone turns, are those of before in an empty scene."""
    suffix, export, read = FORMATS[form]
    source = cross()
    thing = make_armature(bind="AXIS")
    name = max(bone.name for bone in thing.data.bones if bone.name.endswith(".L"))
    parents = {bone.name: bone.parent and bone.parent.name for bone in thing.data.bones}
    heads = {bone.name: np.array(thing.matrix_world @ bone.head_local) for bone in thing.data.bones}
    rest, weights = world_positions(source), named_weights(source)
    moved = turned(source, thing, name, heads[name])
    assert np.linalg.norm(moved - rest, axis=1).max() > 0.5
    path = str(tmp_path / f"cross{suffix}")
    select(source, thing)
    getattr(bpy.ops.export_scene, form)(filepath=path, **export)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    getattr(bpy.ops.import_scene, form)(filepath=path, **read)
    (thing,) = [o for o in bpy.data.objects if o.type == "ARMATURE"]
    (source,) = [o for o in bpy.data.objects if o.type == "MESH" and o.vertex_groups]
    assert {b.name: b.parent and b.parent.name for b in thing.data.bones} == parents
    for bone in thing.data.bones:
        head = np.array(thing.matrix_world @ bone.head_local)
        np.testing.assert_allclose(head, heads[bone.name], atol=1e-4)
    now = world_positions(source)
    row = addon("core.shape.nearness").nearest(now, rest)  # corners may have become vertices
    np.testing.assert_allclose(now, rest[row], atol=1e-4)
    found = named_weights(source)
    assert set(found) <= set(weights)
    for group, values in weights.items():
        np.testing.assert_allclose(found.get(group, np.zeros(len(row))), values[row], atol=1e-3)
    np.testing.assert_allclose(turned(source, thing, name, heads[name]), moved[row], atol=2e-3)


def named_weights(source):
    """{group: (v,) weight} of the groups that weigh anything."""
    table = weights_of(source)
    return {g.name: table[:, g.index] for g in source.vertex_groups if table[:, g.index].any()}


def turned(source, thing, name, head):
    """(v, 3) where vertices are in the world when a bone turns by 50 degrees about its head; then it turns back."""
    about = Matrix.Translation(head)
    turn = about @ Matrix.Rotation(math.radians(50), 4, (0.0, 1.0, 0.2)) @ about.inverted()
    bone, world = thing.pose.bones[name], thing.matrix_world
    bpy.context.view_layer.update()
    bone.matrix = world.inverted() @ turn @ world @ bone.matrix
    bpy.context.view_layer.update()
    shown = source.evaluated_get(bpy.context.evaluated_depsgraph_get())
    places = positions(shown.to_mesh())
    matrix = np.array(shown.matrix_world)
    bone.matrix_basis = Matrix.Identity(4)
    bpy.context.view_layer.update()
    return places @ matrix[:3, :3].T + matrix[:3, 3]


# --- an armature that someone works with is made again


def posed_cross():
    """A bound cross whose first bones are turned."""
    source = cross()
    thing = make_armature(bind="AXIS")
    for bone in thing.pose.bones:
        bone.rotation_mode = "XYZ"
        bone.rotation_euler = (0.3, 0.1, 0.0)
    bpy.context.view_layer.update()
    select(source)
    return source, thing


def places(thing):
    return positions(evaluated(thing))


def heads(thing):
    return {bone.name: np.array(bone.head_local) for bone in thing.data.bones}


def test_again_in_a_pose_changes_nothing():
    """It once read the posed mesh, put the bones there, and kept the pose on top of it."""
    source, thing = posed_cross()
    before, bones = places(source), heads(thing)
    make_armature(bind="AXIS")
    after = heads(armature_of(source))
    assert armature_of(source) == thing and set(after) == set(bones)
    assert all(np.allclose(after[name], bones[name], atol=1e-5) for name in bones)
    assert np.allclose(places(source), before, atol=1e-4)
    assert all(tuple(b.rotation_euler) != (0, 0, 0) for b in thing.pose.bones)


def test_own_bones_constraints_and_names_stay():
    source, thing = posed_cross()
    first, last = thing.data.bones[0].name, thing.data.bones[-1].name
    bpy.context.view_layer.objects.active = thing
    with in_edit_mode():
        own = thing.data.edit_bones.new("IK")
        own.head, own.tail = (0, 1, 0), (0, 2, 0)
        own.parent = thing.data.edit_bones[first]
    constraint = thing.pose.bones[last].constraints.new("IK")
    constraint.target, constraint.subtarget = thing, "IK"
    thing.data.bones[first].name = "hips"
    make_armature(source, bind="AXIS")
    assert thing.data.bones["IK"].parent.name == "hips" and first not in thing.data.bones
    assert np.allclose(thing.data.bones["IK"].head_local, (0, 1, 0), atol=1e-5)
    assert [c.type for c in thing.pose.bones[last].constraints] == ["IK"]
    assert "hips" in source.vertex_groups and "IK" not in source.vertex_groups
    assert_weights_hold(source)


def test_groups_of_the_artist_stay_also_with_names_of_bones():
    source = cross()
    make_armature(bind="AXIS")
    name = armature_of(source).data.bones[0].name
    bpy.data.objects.remove(armature_of(source))
    source.vertex_groups.clear()
    source.modifiers.clear()
    source.vertex_groups.new(name=name).add(range(5), 0.25, "REPLACE")
    for _ in range(2):
        make_armature(source, bind="AXIS")
        bones = armature_of(source).data.bones
        assert [source.vertex_groups[name].weight(row) for row in range(5)] == [0.25] * 5
        assert name not in bones and f"{name}.001" in bones
        assert {g.name for g in source.vertex_groups} == {*bones.keys(), name}


def test_painted_weights_are_replaced_only_when_asked_to():
    source, _ = posed_cross()
    group = source.vertex_groups[0]
    group.add([0], 0.123, "REPLACE")
    refuse("found some painted since", operator="medial_axis_armature", bind="AXIS")
    assert group.weight(0) == pytest.approx(0.123)
    make_armature(bind="NONE")
    assert group.weight(0) == pytest.approx(0.123)
    make_armature(source, bind="AXIS", replace_weights=True)
    make_armature(source, bind="AXIS")
    assert_weights_hold(source)


@pytest.mark.parametrize("bind", ["AXIS", "AUTOMATIC"])
def test_a_parent_of_the_artist_stays(bind):
    source = cross()
    rig = source.parent = added("object.empty", location=(1, 2, 3))
    before = world_positions(source)
    make_armature(source, bind=bind)
    assert source.parent == rig == armature_of(source).parent
    for _ in range(2):
        assert np.allclose(world_positions(source), before, atol=1e-5)
        assert np.allclose(places(source), positions(source.data), atol=1e-5)
        rig.location.x += 1.0
        before += (1, 0, 0)


def test_a_modifier_with_our_name_is_no_reason_to_fail():
    source = cross()
    source.modifiers.new("Medial Axis Armature", "SMOOTH").iterations = 0
    make_armature(bind="AXIS")
    assert [m.type for m in source.modifiers] == ["SMOOTH", "ARMATURE"]
    assert source.modifiers[1].object == armature_of(source)
