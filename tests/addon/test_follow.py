# SPDX-License-Identifier: GPL-3.0-or-later
"""Bones that follow an animated mesh: what moves it is known, so the keys are compared with that."""

import math

import bpy
import numpy as np
import pytest
from mathutils import Matrix
from scene import addon, ellipsoid, positions, refuse, reports, select
from test_rig import figure, make, own_armature

FRAMES = (1, 2, 3)


@pytest.fixture(autouse=True)
def three_frames():
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = FRAMES[0], FRAMES[-1]
    scene.frame_set(1)


def follow(source, **settings):
    select(source)
    assert bpy.ops.object.medial_axis_follow(**settings) == {"FINISHED"}
    return addon("bridge.armature_object").rig_of(source)


def at(frame):
    bpy.context.scene.frame_set(frame)
    return bpy.context.evaluated_depsgraph_get()


def tails(armature, frame):
    """{bone made here, by its first name: its tail in the world} at a frame."""
    now = armature.evaluated_get(at(frame))
    return {
        bone.bone["ma_bone"]: np.array(now.matrix_world @ bone.tail)
        for bone in now.pose.bones
        if "ma_bone" in bone.bone
    }


def seen(source, frame):
    """The vertices of a source in the world at a frame."""
    now = source.evaluated_get(at(frame))
    matrix = np.array(now.matrix_world)
    return positions(now.data) @ matrix[:3, :3].T + matrix[:3, 3]


def pose_bones(armature, seed=1, most=0.7):
    """Random keyed turns of all bones at frames 2 and 3, and a root that moves; frame 1 is at rest."""
    rng = np.random.default_rng(seed)
    for bone in armature.pose.bones:
        bone.rotation_mode = "XYZ"
        for frame in FRAMES:
            bone.rotation_euler = rng.uniform(-most, most, 3) * (frame > 1)
            bone.keyframe_insert("rotation_euler", frame=frame)
            if bone.parent is None:
                bone.location = rng.uniform(-0.5, 0.5, 3) * (frame > 1)
                bone.keyframe_insert("location", frame=frame)


def actor(**settings):
    """A figure that a keyed armature moves, and that armature, of which the add-on knows nothing."""
    source = figure("Actor")
    mover = make(source, **settings)
    world = source.matrix_world.copy()
    source.parent = None
    source.matrix_world = world
    mover.name = "Mover"
    for key in list(mover.keys()):
        del mover[key]
    pose_bones(mover)
    at(1)
    return source, mover


def curves(armature):
    return sorted(
        (c.data_path, c.array_index, len(c.keyframe_points))
        for found in addon("bridge.follow_mesh")._curves(armature.animation_data.action)
        for c in found
    )


def test_bones_do_what_the_bones_did_that_move_the_mesh(capfd):
    """Both armatures have the same joints and weights, so the pose is known."""
    source, mover = actor()
    thing = make(source)
    assert thing != mover and len(thing.pose.bones) == len(mover.pose.bones)
    reports(capfd)
    assert follow(source) == thing
    said = reports(capfd)
    assert any(kind == "Info" and "bones follow it in 3 frames" in text for kind, text in said)
    for frame in FRAMES:
        wanted, found = tails(mover, frame), tails(thing, frame)
        assert wanted.keys() == found.keys()
        for name, place in wanted.items():
            np.testing.assert_allclose(found[name], place, atol=0.005)
    moved = max(np.abs(tails(thing, 3)[n] - tails(thing, 1)[n]).max() for n in wanted)
    assert moved > 0.3


def test_the_bones_alone_move_the_mesh_as_it_moved():
    """With its own motion off and the modifier of the bones on, the mesh is where it was."""
    source, mover = actor()
    before = {frame: seen(source, frame) for frame in FRAMES}
    at(1)
    thing = follow(source) if make(source) else None
    modifiers = {m.object: m for m in source.modifiers}
    assert not modifiers[thing].show_viewport and not modifiers[thing].show_render
    for frame in FRAMES:
        np.testing.assert_allclose(seen(source, frame), before[frame], atol=1e-5)
    modifiers[mover].show_viewport, modifiers[thing].show_viewport = False, True
    for frame in FRAMES:
        np.testing.assert_allclose(seen(source, frame), before[frame], atol=0.01)


def test_other_joints_than_those_that_move_the_mesh():
    """A limb of one bone more or less: tips are within 3 % of the diagonal, and joints stay connected."""
    source, mover = actor(per_limb=2)
    thing = follow(source) if make(source, per_limb=3) else None
    size = np.linalg.norm(np.ptp(positions(source.data), axis=0))
    for frame in FRAMES:
        wanted, found = tails(mover, frame), tails(thing, frame)
        for name in ("limb.01", "limb.02"):
            for side in "LR":
                apart = wanted[f"{name}.02.{side}"] - found[f"{name}.03.{side}"]
                assert np.linalg.norm(apart) < 0.03 * size
        for bone in thing.evaluated_get(at(frame)).pose.bones:
            if bone.parent and bone.bone.use_connect:
                assert (bone.head - bone.parent.tail).length < 1e-5
            assert bone.length == pytest.approx(bone.bone.length, rel=1e-4)


def test_a_mesh_that_only_moves_is_followed_exactly():
    source = figure()
    thing = make(source)
    rest = tails(thing, 1)
    first = source.matrix_world.copy()
    for frame in FRAMES:
        source.location = (0.7 * (frame - 1), -0.2, 0.1)
        source.rotation_euler = (0.0, 0.4 * (frame - 1), 1.1 * (frame - 1))
        for path in ("location", "rotation_euler"):
            source.keyframe_insert(path, frame=frame)
    at(1)
    source.location, source.rotation_euler = (0, 0, 0), (0, 0, 0)
    for path in ("location", "rotation_euler"):
        source.keyframe_insert(path, frame=1)
    follow(source)
    for frame in FRAMES:
        at(frame)
        motion = np.array(source.matrix_world @ first.inverted())
        for name, place in tails(thing, frame).items():
            wanted = motion[:3, :3] @ rest[name] + motion[:3, 3]
            np.testing.assert_allclose(place, wanted, atol=2e-5)


def test_a_mesh_that_shape_keys_bend():
    """A key turns a forearm about the elbow by 50 degrees, by the bend of a joint: the bone beyond turns as much."""
    source = figure()
    thing = make(source, per_limb=2)
    bone = thing.data.bones["limb.01.02.L"]
    rest = {bone.name: bone.matrix_local.to_3x3() for bone in thing.data.bones}
    head, (axis, way, _) = np.array(bone.head_local), np.array(bone.matrix_local.to_3x3()).T
    points = positions(source.data)
    along = (points - head) @ way
    arm = points[:, 0] > 0.3
    share = np.clip(along / 0.06 * 0.5 + 0.5, 0.0, 1.0) * arm
    for name, size in (("Basis", 0.0), ("Bend", math.radians(50))):
        key = source.shape_key_add(name=name)
        for vertex, (place, part) in enumerate(zip(points, share, strict=True)):
            turn = np.array(Matrix.Rotation(size * part, 3, axis.tolist()))
            key.data[vertex].co = head + turn @ (place - head)
    for frame in FRAMES:
        key.value = (frame - 1) / 2
        key.keyframe_insert("value", frame=frame)
    at(1)
    make(source, per_limb=2)  # the mesh has shape keys now, and the same shape at frame 1
    follow(source)
    now = thing.evaluated_get(at(3)).pose.bones
    angle = {
        name: math.degrees((now[name].matrix.to_3x3() @ turn.inverted()).to_quaternion().angle)
        for name, turn in rest.items()
    }
    assert angle["limb.01.02.L"] == pytest.approx(50, abs=10)
    assert max(angle[name] for name in ("pelvis", "limb.01.02.R", "limb.02.02.L")) < 2.0


def test_bones_stretch_as_the_bones_did_that_move_the_mesh():
    """Both armatures have the same joints and weights; bones have sizes of their own, along and across."""
    source, mover = actor()
    rng = np.random.default_rng(4)
    for bone in mover.data.bones:
        bone.inherit_scale = "NONE"
    for bone in mover.pose.bones:
        for frame in FRAMES:
            along, across = 2.0 ** (rng.uniform(-0.5, 0.5, 2) * (frame > 1))
            bone.scale = across, along, across
            bone.keyframe_insert("scale", frame=frame)
    at(1)
    before = {frame: seen(source, frame) for frame in FRAMES}
    at(1)
    make(source)
    thing = follow(source, stretch=True)
    for frame in FRAMES:
        wanted, found = tails(mover, frame), tails(thing, frame)
        for name, place in wanted.items():
            np.testing.assert_allclose(found[name], place, atol=0.005)
    modifiers = {m.object: m for m in source.modifiers}
    modifiers[mover].show_viewport, modifiers[thing].show_viewport = False, True
    for frame in FRAMES:
        np.testing.assert_allclose(seen(source, frame), before[frame], atol=0.01)


def grown_figure():
    """A figure whose arms shape keys make 1.5 times as long from the shoulder on."""
    source = figure()
    points = positions(source.data)
    grown = points.copy()
    arm = np.abs(points[:, 0]) > 0.3
    start, way = np.array((0.3, 0.0, 1.45)), np.array((0.64, 0.0, -0.77))
    for side in (1, -1):
        here = arm & (side * points[:, 0] > 0)
        joint, along = start * (side, 1, 1), way * (side, 1, 1)
        share = np.maximum((points[here] - joint) @ along, 0.0)
        grown[here] += 0.5 * share[:, None] * along
    for name, places in (("Basis", points), ("Grown", grown)):
        key = source.shape_key_add(name=name)
        key.data.foreach_set("co", places.ravel())
    for frame in FRAMES:
        key.value = (frame - 1) / 2
        key.keyframe_insert("value", frame=frame)
    at(1)
    return source


def test_bones_that_stretch_follow_limbs_that_grow(capfd):
    """The mesh that the stretched bones move is four times closer than with bones that keep their lengths."""
    source = grown_figure()
    before = {frame: seen(source, frame) for frame in FRAMES}
    at(1)
    thing = make(source, per_limb=2)
    inherits = {bone.name: bone.inherit_scale for bone in thing.data.bones}
    off = {}
    for stretch in (False, True, False):
        reports(capfd)
        follow(source, stretch=stretch)
        said = [text for _, text in reports(capfd)]
        assert any("which bones keep without Stretch" in text for text in said) != stretch
        (own,) = (m for m in source.modifiers if m.type == "ARMATURE")
        key = source.data.shape_keys.key_blocks["Grown"]
        key.mute, own.show_viewport = True, True
        off[stretch] = max(np.abs(seen(source, f) - before[f]).max() for f in FRAMES)
        key.mute, own.show_viewport = False, False
        assert (inherits == {b.name: b.inherit_scale for b in thing.data.bones}) != stretch
        scaled = [path for path, *_ in curves(thing) if path.endswith("scale")]
        assert bool(scaled) == stretch
        if stretch:
            for bone in thing.evaluated_get(at(3)).pose.bones:
                if bone.parent and bone.bone.use_connect:
                    assert (bone.head - bone.parent.tail).length < 1e-4
            hand = thing.evaluated_get(at(3)).pose.bones["limb.01.02.L"]
            assert hand.length > 1.3 * hand.bone.length
    assert 4 * off[True] < off[False] and off[True] < 0.06, off


def state():
    return (
        [[m.show_viewport for m in thing.modifiers] for thing in bpy.data.objects],
        [thing.animation_data and thing.animation_data.action for thing in bpy.data.objects],
        len(bpy.data.actions),
        bpy.context.scene.frame_current,
    )


def decimated(source, ratios):
    """A modifier that leaves a share of the faces of a source at each frame."""
    cut = source.modifiers.new("Cut", "DECIMATE")
    for frame, ratio in ratios.items():
        cut.ratio = ratio
        cut.keyframe_insert("ratio", frame=frame)
    cut_curves = addon("bridge.follow_mesh")._curves(source.animation_data.action)
    for curve in (c for found in cut_curves for c in found):
        for point in curve.keyframe_points:
            point.interpolation = "CONSTANT"


def test_other_faces_at_a_frame_are_followed_by_the_nearest_places(capfd):
    """Half of the faces at frame 3: tips are within 4 % of the diagonal of where they are with all faces."""
    source, mover = actor()
    rng = np.random.default_rng(2)
    for bone in mover.pose.bones:  # little happens between the last two frames
        bone.rotation_euler = rng.uniform(-0.4, 0.4, 3)
        bone.keyframe_insert("rotation_euler", frame=2)
        bone.rotation_euler = np.array(bone.rotation_euler) + rng.uniform(-0.03, 0.03, 3)
        bone.keyframe_insert("rotation_euler", frame=3)
        if bone.parent is None:
            bone.location = 0.1, -0.2, 0.05
            bone.keyframe_insert("location", frame=2)
            bone.keyframe_insert("location", frame=3)
    at(1)
    make(source)
    size = np.linalg.norm(np.ptp(positions(source.data), axis=0))
    decimated(source, {1: 1.0, 2: 1.0, 3: 0.5})
    at(1)
    reports(capfd)
    thing = follow(source)
    said = [text for _, text in reports(capfd)]
    assert any("other vertices or faces in 1 frames, from 3 to 3" in text for text in said)
    for frame, most in ((2, 0.005), (3, 0.04)):
        wanted, found = tails(mover, frame), tails(thing, frame)
        for name, place in wanted.items():
            assert np.linalg.norm(found[name] - place) < most * size, (frame, name)


def test_a_jump_to_other_faces_is_told(capfd):
    """The nearest places are others where a mesh moves by more than it is thick between two frames."""
    source, _ = actor()
    make(source)
    decimated(source, {1: 1.0, 2: 1.0, 3: 0.5})
    at(1)
    reports(capfd)
    follow(source)
    said = [text for kind, text in reports(capfd) if kind == "Warning"]
    assert any("of its size off at frame 3" in text for text in said)
    assert any("The surface leaves" in text for text in said)


def test_a_frame_without_faces_is_told_and_leaves_nothing():
    source, _ = actor()
    make(source)
    gone = source.modifiers.new("Gone", "MASK")  # of a group that has no vertex
    gone.vertex_group = source.vertex_groups.new(name="none").name
    for frame in FRAMES:
        gone.show_viewport = frame == 3
        gone.keyframe_insert("show_viewport", frame=frame)
    at(2)
    select(source)
    before = state()
    refuse("found none of 'Actor' at frame 3; choose frames", operator="medial_axis_follow")
    assert state() == before
    assert follow(source, frames="1-2").animation_data.action is not None


def test_what_cannot_be_followed_is_refused():
    source = figure()
    select(source)
    assert not bpy.ops.object.medial_axis_follow.poll()
    thing = make(source)
    select(source)
    before = state()
    refuse("found it still; animate it", operator="medial_axis_follow")
    refuse("Expected frames such as", operator="medial_axis_follow", frames="x")
    assert state() == before
    source.data.vertices[0].co.x += 0.01
    source.data.update()
    refuse("hidden or changed", operator="medial_axis_follow")
    source.data.vertices[0].co.x -= 0.01
    source.data.update()
    for group in list(source.vertex_groups):
        source.vertex_groups.remove(group)
    refuse("press Make Armature with Bind: Axis", operator="medial_axis_follow")
    del thing["ma_rest_shape"]
    refuse("press Make Armature again", operator="medial_axis_follow")
    assert state()[1:] == before[1:]


def test_again_replaces_the_keys_and_nothing_of_an_artist():
    source, _ = actor()
    cast = own_armature()
    cape = cast.pose.bones["cape"]
    cape.keyframe_insert("rotation_euler", frame=2)
    mine = cast.animation_data.action
    make(source, armature="Cast")
    follow(source)
    action = cast.animation_data.action
    assert action != mine and mine.use_fake_user and len(curves(cast)) > 3
    once = curves(cast)
    assert ('pose.bones["cape"].rotation_euler', 0, 1) in once
    follow(source)
    assert curves(cast) == once and cast.animation_data.action == action
    follow(source, frames="1-2")
    assert {count for path, _, count in curves(cast) if "cape" not in path} == {2}


@pytest.mark.parametrize("ik", ["TARGET", "SPLINE"])
def test_controls_of_limbs_follow_too(ik):
    last = {"TARGET": "IK.limb.02", "SPLINE": "IK.limb.02.03"}[ik]
    source, _ = actor(per_limb=2)
    before = {frame: seen(source, frame) for frame in FRAMES}
    at(1)
    thing = make(source, per_limb=2, ik=ik)
    follow(source)
    for frame in FRAMES:
        pose = {b.bone["ma_bone"]: b for b in thing.evaluated_get(at(frame)).pose.bones}
        for side in "LR":
            foot, target = pose[f"limb.02.02.{side}"], pose[f"{last}.{side}"]
            assert (foot.tail - target.head).length < 1e-3
    assert all(c.mute for b in thing.pose.bones for c in b.constraints)
    mover, own = (m for m in source.modifiers if m.type == "ARMATURE")
    mover.show_viewport, own.show_viewport = False, True
    for frame in FRAMES:
        assert np.abs(seen(source, frame) - before[frame]).max() < 0.02
    for bone in thing.pose.bones:
        for constraint in bone.constraints:
            constraint.mute = False
    if ik == "SPLINE":  # a target bends a limb in its plane, these turns do not
        for frame in FRAMES:
            assert np.abs(seen(source, frame) - before[frame]).max() < 0.05


def test_a_limb_that_shrinks_into_the_body_is_told(capfd):
    """At frame 3 an arm is drawn into the shoulder."""
    source = figure()
    points = positions(source.data)
    shoulder = np.array((0.3, 0.0, 1.5))
    arm = np.clip((points[:, 0] - shoulder[0]) / 0.1, 0.0, 1.0)[:, None]
    for name, share in (("Basis", 0.0), ("Gone", 0.95)):
        key = source.shape_key_add(name=name)
        key.data.foreach_set("co", (points + share * arm * (shoulder - points)).ravel())
    for frame in FRAMES:
        key.value = float(frame == 3)
        key.keyframe_insert("value", frame=frame)
    at(1)
    make(source)
    reports(capfd)
    follow(source)
    said = [text for kind, text in reports(capfd)]
    assert any(
        "The surface leaves" in text and "'limb.01.0" in text and "from 3 to 3" in text
        for text in said
    )


def test_bones_turned_by_other_angles_keep_their_mode():
    """Rotations are keyed in the mode that each bone has."""
    source, mover = actor()
    thing = make(source)
    for bone, mode in zip(thing.pose.bones, ("ZYX", "AXIS_ANGLE", "QUATERNION") * 9, strict=False):
        bone.rotation_mode = mode
    follow(source)
    assert {bone.rotation_mode for bone in thing.pose.bones} >= {"ZYX", "AXIS_ANGLE"}
    for name, place in tails(mover, 3).items():
        np.testing.assert_allclose(tails(thing, 3)[name], place, atol=0.005)


def test_a_limbless_body_has_no_bones_to_follow():
    source = ellipsoid()
    select(source)
    assert not bpy.ops.object.medial_axis_follow.poll()
