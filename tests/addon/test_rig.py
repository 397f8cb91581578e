# SPDX-License-Identifier: GPL-3.0-or-later
"""Armatures as animators use them: Symmetrize, joints that bend in a plane, targets, and an armature that is there."""

import math

import bpy
import numpy as np
import pytest
from installed import addon
from mathutils import Matrix
from measure import contents, evaluated, positions, world_positions
from scene import added, link, refuse, select


def figure(name="Figure", tail=False):
    """A figure by Blender's Skin modifier, symmetric in X, that looks to -Y; its knees bend, its arms hang aslant."""
    joints = {
        "pelvis": (0, 0, 1.0, 0.2),
        "chest": (0, 0, 1.5, 0.16),
        "head": (0, 0, 2.0, 0.13),
        "hip": (0.18, 0, 0.85, 0.12),
        "knee": (0.2, -0.09, 0.4, 0.08),
        "ankle": (0.2, 0.0, -0.05, 0.06),
        "shoulder": (0.25, 0, 1.5, 0.08),
        "elbow": (0.5, 0.08, 1.2, 0.06),
        "hand": (0.75, 0.0, 0.9, 0.05),
    }
    bones = [
        ("pelvis", "chest"),
        ("chest", "head"),
        ("pelvis", "hip"),
        ("hip", "knee"),
        ("knee", "ankle"),
    ]
    bones += [("chest", "shoulder"), ("shoulder", "elbow"), ("elbow", "hand")]
    if tail:
        joints |= {"rump": (0, 0.35, 0.95, 0.09), "tail": (0, 0.9, 0.8, 0.05)}
        bones += [("pelvis", "rump"), ("rump", "tail")]
    rows, places, edges = {}, [], []
    for side in (1, -1):
        for joint, (x, *rest) in joints.items():
            key = (joint, side if x else 0)
            if key not in rows:
                rows[key] = len(places)
                places.append((side * x, *rest))
        edges += [tuple(rows[j, side if joints[j][0] else 0] for j in bone) for bone in bones]
    made = link(name, [place[:3] for place in places], [])
    made.data.edges.add(len(set(edges)))
    made.data.edges.foreach_set("vertices", np.ravel(sorted(set(edges))))
    made.modifiers.new("Skin", "SKIN")
    for vertex, place in zip(made.data.skin_vertices[0].data, places, strict=True):
        vertex.radius = place[3], place[3]
    made.data.skin_vertices[0].data[rows["pelvis", 0]].use_root = True
    made.modifiers.new("Round", "SUBSURF").levels = 3
    bpy.context.view_layer.update()
    bpy.ops.object.convert(target="MESH")
    return bpy.context.object


def make(source, **settings):
    select(source)
    assert bpy.ops.object.medial_axis_armature(**settings) == {"FINISHED"}
    return addon("bridge.skeleton.armature_object").rig_of(source)


def shown(source):
    return positions(evaluated(source))


def test_symmetrize_gives_the_same_bones_again():
    """Blender mirrors the left side, and its right side is ours, with the roll."""
    thing = make(figure(), bind="NONE")
    before = {
        b.name: (b.matrix_local.copy(), b.parent.name)
        for b in thing.data.bones
        if b.name.endswith(".R")
    }
    select(thing)
    bpy.ops.object.mode_set(mode="EDIT")
    bones = thing.data.edit_bones
    for bone in [bone for bone in bones if bone.name.endswith(".R")]:
        bones.remove(bone)
    for bone in bones:
        bone.select = bone.select_head = bone.select_tail = bone.name.endswith(".L")
    assert bpy.ops.armature.symmetrize(direction="POSITIVE_X") == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    assert before and {b.name for b in thing.data.bones if b.name.endswith(".R")} == set(before)
    for name, (matrix, parent) in before.items():
        assert thing.data.bones[name].parent.name == parent
        np.testing.assert_allclose(thing.data.bones[name].matrix_local, matrix, atol=2e-3)


def test_knees_and_elbows_bend_in_their_plane():
    """The knee looks to the front and the elbow to the back, so their first axis is across; more is a sharper bend."""
    thing = make(figure(), per_limb=2)
    for limb, axis in (("leg", (0.95, 0.3, 0)), ("arm", (0.7, 0, 0.7))):
        upper, lower = (thing.data.bones[f"{limb}.0{step}.L"] for step in (1, 2))
        assert abs(np.array(lower.matrix_local.to_3x3().col[0]) @ axis) > 0.85
        pose = thing.pose.bones[lower.name]
        straight = np.array(pose.vector) @ np.array(thing.pose.bones[upper.name].vector)
        pose.rotation_mode = "XYZ"
        pose.rotation_euler = (math.radians(30), 0, 0)
        bpy.context.view_layer.update()
        assert np.array(pose.vector) @ np.array(thing.pose.bones[upper.name].vector) < straight


def test_limbs_reach_for_their_targets():
    source = figure()
    thing = make(source, per_limb=2, ik="TARGET")
    target, foot = thing.pose.bones["IK.leg.L"], thing.pose.bones["leg.02.L"]
    assert not target.bone.use_deform and "IK.leg.L" not in source.vertex_groups
    rest = shown(source)
    np.testing.assert_allclose(rest, positions(source.data), atol=2e-3)  # nothing moves yet
    target.location = target.bone.matrix_local.to_3x3().inverted() @ (
        thing.data.bones["pelvis"].vector.normalized() * 0.25
    )
    bpy.context.view_layer.update()
    assert (foot.tail - target.head).length < 0.02
    knee = thing.pose.bones["leg.01.L"].tail
    assert knee.y < thing.data.bones["leg.01.L"].tail_local.y - 0.03  # to the front
    moved = np.linalg.norm(shown(source) - rest, axis=1)
    assert moved.max() > 0.2 and moved[rest[:, 0] < -0.15].max() < 0.01
    make(source, per_limb=2)
    assert not any(bone.name.startswith("IK") for bone in thing.data.bones)
    assert not any(len(bone.constraints) or bone.lock_ik_y for bone in thing.pose.bones)


def own_armature():
    """An artist's armature with one bone that is turned, itself moved and scaled."""
    thing = added("object.armature", location=(3, 0, 0))
    thing.name, thing.scale = "Cast", (2, 2, 2)
    bone = thing.pose.bones[0]
    bone.name, bone.rotation_mode, bone.rotation_euler = "cape", "XYZ", (0.4, 0, 0)
    bpy.context.view_layer.update()
    return thing


def lines_of(thing):
    return [o for o in bpy.data.objects if o.type == "CURVE" and o.parent == thing]


def test_limbs_lie_along_lines_through_their_controls():
    """At rest nothing moves; a moved end and a moved middle draw the limb along, and a body takes its limbs along."""
    source = figure()
    thing = make(source, per_limb=4, ik="SPLINE")
    assert {f"IK.leg.0{k}.L" for k in range(1, 6)} <= set(thing.data.bones.keys())
    assert not any("IK" in group.name for group in source.vertex_groups)
    rest = shown(source)
    np.testing.assert_allclose(rest, positions(source.data), atol=3e-4)
    end, chain = (
        thing.pose.bones["IK.arm.05.L"],
        [thing.pose.bones[f"arm.0{k}.L"] for k in range(1, 5)],
    )
    start = chain[0].head.copy()
    end.location = (0.15, 0.0, 0.1)
    thing.pose.bones["IK.arm.03.L"].location = (0.0, 0.0, 0.2)
    bpy.context.view_layer.update()
    assert (chain[-1].tail - end.head).length < 0.01 and (chain[0].head - start).length < 1e-4
    assert (end.head - end.bone.head_local).length > 0.15
    middle = thing.pose.bones["IK.arm.03.L"]
    assert (chain[1].tail - middle.head).length < 0.1
    assert (middle.head - middle.bone.head_local).length > 0.15
    moved = np.linalg.norm(shown(source) - rest, axis=1)
    assert moved.max() > 0.12 and moved[rest[:, 0] < -0.15].max() < 1e-3
    for name in ("IK.arm.05.L", "IK.arm.03.L"):
        thing.pose.bones[name].location = (0, 0, 0)
    root = thing.pose.bones["pelvis"]
    root.rotation_mode, root.rotation_euler, root.location = "XYZ", (0.2, 0.3, 0.4), (0.3, 0.1, 0)
    bpy.context.view_layer.update()
    motion = np.array(root.matrix @ root.bone.matrix_local.inverted())
    np.testing.assert_allclose(shown(source), rest @ motion[:3, :3].T + motion[:3, 3], atol=1e-3)


def test_lines_of_limbs_are_made_anew_and_go():
    """Pressed again, also in a pose and within an artist's armature, no line is left over."""
    cast = own_armature()
    source = figure()
    rest = shown(source)
    for _ in range(2):
        assert make(source, per_limb=3, ik="SPLINE", armature="Cast") == cast
        np.testing.assert_allclose(shown(source), rest, atol=3e-4)
        assert len(lines_of(cast)) == 5
    end = cast.pose.bones["IK.leg.04.L"]
    end.location = (0.1, 0.0, 0.1)
    bpy.context.view_layer.update()
    posed = shown(source)
    assert np.abs(posed - rest).max() > 0.05
    make(source, per_limb=3, ik="SPLINE", armature="Cast")
    np.testing.assert_allclose(shown(source), posed, atol=3e-4)
    make(source, per_limb=3, ik="TARGET", armature="Cast")
    assert not lines_of(cast) and not bpy.data.curves
    make(source, per_limb=3, armature="Cast")
    assert not any(len(bone.constraints) or bone.lock_ik_y for bone in cast.pose.bones)
    assert not any(bone.name.startswith("IK") for bone in cast.data.bones)


@pytest.mark.parametrize("bind", ["AXIS", "AUTOMATIC"])
def test_bones_are_added_to_an_armature_that_is_there(bind):
    """Two figures in one armature: each follows its own bones, and again changes nothing."""
    cast = own_armature()
    first, second = figure("First"), figure("Second")
    second.location.x = -4.0
    bpy.context.view_layer.update()
    places = [world_positions(source) for source in (first, second)]
    for _ in range(2):
        for source in (first, second):
            assert make(source, bind=bind, armature="Cast") == cast
        names = set(cast.data.bones.keys())
    assert names == set(cast.data.bones.keys()) and len(bpy.data.armatures) == 1
    assert cast.pose.bones["cape"].rotation_euler[0] == pytest.approx(0.4)
    assert tuple(cast.scale) == (2, 2, 2) and cast.location.x == 3.0
    assert "pelvis" in names and "pelvis.001" in names and "cape" not in first.vertex_groups
    for source, before in zip((first, second), places, strict=True):
        np.testing.assert_allclose(world_positions(source), before, atol=1e-4)
        assert [m.object for m in source.modifiers] == [cast]
    name = next(b.name for b in cast.data.bones if b.name.startswith("arm.01.L"))
    cast.pose.bones[name].rotation_mode = "XYZ"
    cast.pose.bones[name].rotation_euler = (1.0, 0, 0)
    moved = [np.abs(shown(s) - positions(s.data)).max() for s in (first, second)]
    assert max(moved) > 0.1 and min(moved) < 1e-3


def test_armatures_that_cannot_take_bones_are_refused():
    source = figure()
    cast = own_armature()
    select(source)
    before = contents()
    refuse("which is none; choose one", operator="medial_axis_armature", armature="nobody")
    refuse("which is none; choose one", operator="medial_axis_armature", armature=source.name)
    cast.hide_set(True)
    refuse("show it, or make it local", operator="medial_axis_armature", armature="Cast")
    cast.hide_set(False)
    cast.scale = (0, 0, 0)
    bpy.context.view_layer.update()
    refuse("apply the scale", operator="medial_axis_armature", armature="Cast")
    assert contents() == before
    cast.scale = (1, 1, 1)
    make(source)
    refuse("two would move it twice", operator="medial_axis_armature", armature="Cast")


def test_a_turned_figure_is_symmetric_in_its_armature():
    source = figure()
    source.data.transform(Matrix.Rotation(math.radians(25), 4, "Z"))
    source.data.update()
    before = world_positions(source)
    thing = make(source)
    np.testing.assert_allclose(world_positions(source), before, atol=1e-5)
    for bone in thing.data.bones:
        if bone.name.endswith(".L"):
            other = thing.data.bones[bone.name[:-1] + "R"]
            np.testing.assert_allclose(
                np.array(other.tail_local) * (-1, 1, 1), bone.tail_local, atol=0.1
            )
            assert (thing.matrix_world @ bone.tail_local).x > 0.0
