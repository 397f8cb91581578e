# SPDX-License-Identifier: GPL-3.0-or-later
"""Armatures as animators use them: Symmetrize, joints that bend in a plane, targets, and an armature that is there."""

import math

import bpy
import numpy as np
import pytest
from installed import addon
from mathutils import Matrix
from measure import evaluated, positions, world_positions
from scene import added, in_edit_mode, link, press, refuse, select

JOINTS = {  # the left half of a figure: a place, and how thick it is there
    "pelvis": (0, 0, 1.0, 0.2), "chest": (0, 0, 1.5, 0.16), "head": (0, 0, 2.0, 0.13),
    "hip": (0.18, 0, 0.85, 0.12), "knee": (0.2, -0.09, 0.4, 0.08), "ankle": (0.2, 0.0, -0.05, 0.06),
    "shoulder": (0.25, 0, 1.5, 0.08), "elbow": (0.5, 0.08, 1.2, 0.06), "hand": (0.75, 0.0, 0.9, 0.05),
}  # fmt: skip
BONES = [("pelvis", "chest"), ("chest", "head"), ("pelvis", "hip"), ("hip", "knee")]
BONES += [("knee", "ankle"), ("chest", "shoulder"), ("shoulder", "elbow"), ("elbow", "hand")]


def figure(name="Figure"):
    """A figure by Blender's Skin modifier, symmetric in X, that looks to -Y; its knees bend, its arms hang aslant."""
    rows, places, edges = {}, [], set()
    for side in (1, -1):
        for joint, (x, *rest) in JOINTS.items():
            key = (joint, side if x else 0)
            if key not in rows:
                rows[key] = len(places)
                places.append((side * x, *rest))
        edges |= {tuple(rows[j, side if JOINTS[j][0] else 0] for j in bone) for bone in BONES}
    made = link(name, [place[:3] for place in places], edges=sorted(edges))
    made.modifiers.new("Skin", "SKIN")
    skin = made.data.skin_vertices[0].data
    for vertex, place in zip(skin, places, strict=True):
        vertex.radius = place[3], place[3]
    skin[rows["pelvis", 0]].use_root = True
    made.modifiers.new("Round", "SUBSURF").levels = 3
    bpy.context.view_layer.update()
    bpy.ops.object.convert(target="MESH")
    return bpy.context.object


def make(source, **settings):
    press("medial_axis_armature", source, **settings)
    return addon("bridge.skeleton.armature_object").rig_of(source)


def assert_without_targets(thing):
    """No bone is a control, and none is bound by one."""
    assert not any(bone.name.startswith("IK") for bone in thing.data.bones)
    assert not any(len(bone.constraints) or bone.lock_ik_y for bone in thing.pose.bones)


def shown(source):
    return positions(evaluated(source))


def test_symmetrize_gives_the_same_bones_again():
    """Blender mirrors the left side, and its right side is ours, with the roll."""
    thing = make(figure(), bind="NONE")
    of_right = lambda: {bone.name: bone for bone in thing.data.bones if bone.name.endswith(".R")}
    before = {b.name: (b.matrix_local.copy(), b.parent.name) for b in of_right().values()}
    select(thing)
    with in_edit_mode():
        bones = thing.data.edit_bones
        for name in before:
            bones.remove(bones[name])
        for bone in bones:
            bone.select = bone.select_head = bone.select_tail = bone.name.endswith(".L")
        assert bpy.ops.armature.symmetrize(direction="POSITIVE_X") == {"FINISHED"}
    assert before and set(of_right()) == set(before)
    for name, (matrix, parent) in before.items():
        assert thing.data.bones[name].parent.name == parent
        np.testing.assert_allclose(thing.data.bones[name].matrix_local, matrix, atol=2e-3)


def test_knees_and_elbows_bend_in_their_plane():
    """The knee looks to the front and the elbow to the back, so their first axis is across; more is a sharper bend."""
    thing = make(figure(), per_limb=2)
    for limb, axis in (("leg", (0.95, 0.3, 0)), ("arm", (0.7, 0, 0.7))):
        upper, lower = (thing.data.bones[f"{limb}.0{step}.L"] for step in (1, 2))
        assert abs(np.array(lower.matrix_local.to_3x3().col[0]) @ axis) > 0.85
        pose, other = thing.pose.bones[lower.name], thing.pose.bones[upper.name]
        straight = pose.vector @ other.vector
        pose.rotation_mode, pose.rotation_euler = "XYZ", (math.radians(30), 0, 0)
        bpy.context.view_layer.update()
        assert pose.vector @ other.vector < straight


def test_limbs_reach_for_their_targets():
    source = figure()
    thing = make(source, per_limb=2, ik="TARGET")
    target, foot = thing.pose.bones["IK.leg.L"], thing.pose.bones["leg.02.L"]
    assert not target.bone.use_deform and "IK.leg.L" not in source.vertex_groups
    rest = shown(source)
    np.testing.assert_allclose(rest, positions(source.data), atol=2e-3)  # nothing moves yet
    up = thing.data.bones["pelvis"].vector.normalized() * 0.25
    target.location = target.bone.matrix_local.to_3x3().inverted() @ up
    bpy.context.view_layer.update()
    assert (foot.tail - target.head).length < 0.02
    knee = thing.pose.bones["leg.01.L"].tail
    assert knee.y < thing.data.bones["leg.01.L"].tail_local.y - 0.03  # to the front
    moved = np.linalg.norm(shown(source) - rest, axis=1)
    assert moved.max() > 0.2 and moved[rest[:, 0] < -0.15].max() < 0.01
    make(source, per_limb=2)
    assert_without_targets(thing)


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
    end, middle = (thing.pose.bones[f"IK.arm.0{k}.L"] for k in (5, 3))
    chain = [thing.pose.bones[f"arm.0{k}.L"] for k in range(1, 5)]
    start = chain[0].head.copy()
    end.location, middle.location = (0.15, 0.0, 0.1), (0.0, 0.0, 0.2)
    bpy.context.view_layer.update()
    assert (chain[-1].tail - end.head).length < 0.01 and (chain[0].head - start).length < 1e-4
    assert (chain[1].tail - middle.head).length < 0.1
    for control in (end, middle):
        assert (control.head - control.bone.head_local).length > 0.15
    moved = np.linalg.norm(shown(source) - rest, axis=1)
    assert moved.max() > 0.12 and moved[rest[:, 0] < -0.15].max() < 1e-3
    end.location = middle.location = (0, 0, 0)
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
    assert_without_targets(cast)


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
    bone = cast.pose.bones[name]
    bone.rotation_mode, bone.rotation_euler = "XYZ", (1.0, 0, 0)
    moved = [np.abs(shown(s) - positions(s.data)).max() for s in (first, second)]
    assert max(moved) > 0.1 and min(moved) < 1e-3


def test_armatures_that_cannot_take_bones_are_refused():
    source = figure()
    cast = own_armature()
    select(source)

    def refuse_bones(words, armature="Cast"):
        refuse(words, operator="medial_axis_armature", armature=armature)

    refuse_bones("which is none; choose one", "nobody")
    refuse_bones("which is none; choose one", source.name)
    cast.hide_set(True)
    refuse_bones("show it, or make it local")
    cast.hide_set(False)
    cast.scale = (0, 0, 0)
    bpy.context.view_layer.update()
    refuse_bones("apply the scale")
    cast.scale = (1, 1, 1)
    make(source)
    refuse_bones("two would move it twice")


def test_a_turned_figure_is_symmetric_in_its_armature():
    source = figure()
    source.data.transform(Matrix.Rotation(math.radians(25), 4, "Z"))
    source.data.update()
    before = world_positions(source)
    thing = make(source)
    np.testing.assert_allclose(world_positions(source), before, atol=1e-5)
    for bone in thing.data.bones:
        if bone.name.endswith(".L"):
            mirrored = np.array(thing.data.bones[bone.name[:-1] + "R"].tail_local) * (-1, 1, 1)
            np.testing.assert_allclose(mirrored, bone.tail_local, atol=0.1)
            assert (thing.matrix_world @ bone.tail_local).x > 0.0
