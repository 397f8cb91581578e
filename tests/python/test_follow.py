# SPDX-License-Identifier: GPL-3.0-or-later
"""Bones that follow a mesh: the pose that skinned it is known, and is found again."""

import numpy as np
import pytest
from medial_axis.core.skeleton.follow import Follower
from medial_axis.core.skeleton.followed import Followed
from medial_axis.core.small_matrices import closest_turns
from scipy.spatial import cKDTree
from support.poses import turn

BONES, ROUND, LENGTH = 4, 12, 24


def tube(long=4.0, radius=0.3, around=ROUND, rings=LENGTH):
    """A tube along X with four bones of length 1, and weights that fade over half a radius at the joints."""
    angle = 2 * np.pi * np.arange(around) / around
    along = np.repeat(np.linspace(0.0, long, rings), around)
    circle = np.tile(np.column_stack((np.cos(angle), np.sin(angle))), (rings, 1))
    points = np.column_stack((along, radius * circle * (1.0, 0.7)))
    head = np.column_stack((np.arange(BONES), np.zeros((BONES, 2)))).astype(float)
    after = np.clip((along[:, None] - head[:, 0] + 0.15) / 0.3, 0.0, 1.0)
    after[:, 0] = 1.0
    weight = after - np.column_stack((after[:, 1:], np.zeros(len(points))))
    return points, head, np.arange(BONES, dtype=np.int32) - 1, weight


def follower(points, head, parent, weight, along=None):
    vertex, bone = np.nonzero(weight > 0)
    return Follower(head, parent, points, vertex, bone, weight[vertex, bone], along)


def pose_of(head, parent, turns, shift, sizes=None):
    """Transforms (b, 3, 4) of bones that turn about their heads, one after the other.

    Those along X have sizes (b, 2) along and across, which the next ones do not inherit.
    """
    whole, moves = [], []
    for bone, own in enumerate(turns):
        above = parent[bone]
        whole.append(own if above < 0 else whole[above] @ own)
        at = head[bone] + shift if above < 0 else moves[above] @ (*head[bone], 1.0)
        along, across = (1.0, 1.0) if sizes is None else sizes[bone]
        linear = whole[bone] @ np.diag((along, across, across))
        moves.append(np.column_stack((linear, at - linear @ head[bone])))
    return np.array(moves)


def skinned(points, weight, moves):
    homogeneous = np.column_stack((points, np.ones(len(points))))
    return np.einsum("vb,bij,vj->vi", weight, moves, homogeneous)


def random_pose(seed, head, parent, most):
    rng = np.random.default_rng(seed)
    turns = [turn(rng.normal(size=3), rng.uniform(-most, most)) for _ in head]
    return pose_of(head, parent, turns, rng.normal(size=3))


@pytest.mark.parametrize("seed", range(8))
def test_a_known_pose_is_found(seed):
    """Turns by up to 70 degrees at every joint, and any motion of the root."""
    points, head, parent, weight = tube()
    moves = random_pose(seed, head, parent, np.radians(70))
    moved = skinned(points, weight, moves)
    bones = follower(points, head, parent, weight)
    pose = bones.pose(moved)
    np.testing.assert_allclose(pose.matrices, moves, atol=1e-6)
    assert bones.off(pose, moved).max() < 1e-7


@pytest.mark.parametrize("seed", range(8))
def test_bones_that_stretch_have_the_sizes_of_the_mesh(seed):
    """Turns by up to 60 degrees; sizes along and across between a half and the double, each by itself."""
    points, head, parent, weight = tube()
    rng = np.random.default_rng(seed)
    turns = [turn(rng.normal(size=3), rng.uniform(-1, 1) * np.radians(60)) for _ in head]
    sizes = 2.0 ** rng.uniform(-1.0, 1.0, (BONES, 2))
    moves = pose_of(head, parent, turns, rng.normal(size=3), sizes)
    moved = skinned(points, weight, moves)
    along = np.tile((1.0, 0.0, 0.0), (BONES, 1))
    bones = follower(points, head, parent, weight, along)
    pose = bones.pose(moved)
    np.testing.assert_allclose(pose.matrices, moves, atol=1e-6)
    assert bones.off(pose, moved).max() < 1e-7
    rigid = follower(points, head, parent, weight)
    assert rigid.off(rigid.pose(moved), moved).max() > 0.05


def test_a_mesh_that_only_grows_is_followed_by_stretching():
    points, head, parent, weight = tube()
    along = np.tile((1.0, 0.0, 0.0), (BONES, 1))
    pose = follower(points, head, parent, weight, along).pose(3.0 * points)
    np.testing.assert_allclose(pose.stretch, np.tile(3.0 * np.eye(3), (BONES, 1, 1)), atol=1e-6)


def test_bones_that_stretch_may_have_no_vertices():
    """And a branch may shrink to nothing: sizes stay positive."""
    points, head, parent, weight = tube()
    along = np.tile((1.0, 0.0, 0.0), (BONES, 1))
    for empty in ([1], [3], [0], [1, 2]):
        left = weight.copy()
        left[:, empty] = 0.0
        pose = follower(points, head, parent, left, along).pose(1.5 * points)
        assert np.isfinite(pose.matrices).all()
    gone = points.copy()
    gone[points[:, 0] > 2.0] = (2.0, 0.0, 0.0)
    pose = follower(points, head, parent, weight, along).pose(gone)
    assert (np.linalg.det(pose.linear) > 0.0).all()
    at = (pose.linear * head[:, None]).sum(2) + pose.shift
    before = (pose.linear[:-1] * head[1:, None]).sum(2) + pose.shift[:-1]
    np.testing.assert_allclose(at[1:], before, atol=1e-9)


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_the_unit_and_the_place_of_the_mesh_do_not_matter(scale):
    points, head, parent, weight = tube()
    far = np.array([3.0, -2.0, 5.0])
    moves = random_pose(3, head, parent, 1.0)
    moved = skinned(points, weight, moves)
    whole = turn((1.0, 2.0, 0.5), 2.5)
    pose = follower(scale * (points + far), scale * (head + far), parent, weight).pose(
        scale * (moved @ whole.T)
    )
    np.testing.assert_allclose(pose.turn, whole @ moves[:, :, :3], atol=1e-6)


def test_a_mesh_that_only_moves_is_followed_exactly():
    points, head, parent, weight = tube()
    whole = turn((0.3, 1.0, -0.2), 3.0)
    pose = follower(points, head, parent, weight).pose(points @ whole.T + (1.0, 2.0, 3.0))
    np.testing.assert_allclose(pose.turn, np.tile(whole, (BONES, 1, 1)), atol=1e-9)
    np.testing.assert_allclose(pose.shift, np.tile((1.0, 2.0, 3.0), (BONES, 1)), atol=1e-8)


def test_joints_stay_connected_whatever_the_mesh_does():
    """Noise, growth, and vertices of one bone that fly away."""
    points, head, parent, weight = tube()
    rng = np.random.default_rng(0)
    bones = follower(points, head, parent, weight)
    away = points + (weight[:, 2:3] > 0.5) * (0.0, 5.0, 1.0)
    for moved in (points + rng.normal(scale=0.2, size=points.shape), 3.0 * points, away):
        pose = bones.pose(moved)
        at = (pose.turn * head[:, None]).sum(2) + pose.shift
        before = (pose.turn[:-1] * head[1:, None]).sum(2) + pose.shift[:-1]
        np.testing.assert_allclose(at[1:], before, atol=1e-9)
        np.testing.assert_allclose(np.linalg.det(pose.turn), 1.0, atol=1e-9)


def test_bones_without_vertices_move_with_others():
    """The middle bone, the last one, and a root alone have none; and a bone of two vertices cannot tell its roll."""
    points, head, parent, weight = tube()
    moved = skinned(points, weight, pose_of(head, parent, [turn((0, 1, 0), 0.4)] * 4, np.zeros(3)))
    for empty in ([1], [3], [0], [1, 2]):
        left = weight.copy()
        left[:, empty] = 0.0
        held = left.sum(axis=1) > 0
        pose = follower(points, head, parent, left).pose(moved)
        assert np.isfinite(pose.matrices).all()
        assert np.isfinite(pose.shift).all() and held.any()
        np.testing.assert_allclose(np.linalg.det(pose.turn), 1.0, atol=1e-9)
    two = np.array([[0.0, 0, 0], [1.0, 0, 0]])
    pose = follower(two, head[:1], parent[:1], np.ones((2, 1))).pose(two[:, [1, 0, 2]] + 1.0)
    np.testing.assert_allclose(
        (pose.turn[0] * two[:, None]).sum(2) + pose.shift, [[1, 1, 1], [1, 2, 1]], atol=1e-6
    )


def test_vertices_without_weights_are_not_looked_at():
    points, head, parent, weight = tube()
    moved = skinned(points, weight, random_pose(1, head, parent, 0.8))
    usual = follower(points, head, parent, weight).pose(moved)
    more = np.concatenate((points, [[9.0, 9, 9]]))
    bones = follower(more, head, parent, np.concatenate((weight, np.zeros((1, BONES)))))
    gone = np.concatenate((moved, [[-50.0, 0, 0]]))
    np.testing.assert_allclose(bones.pose(gone).matrices, usual.matrices, atol=1e-9)
    assert bones.off(usual, gone)[-1] == 0.0


def test_the_pose_is_the_best_one():
    """No small turn of any joint, and no shift, brings the vertices closer."""
    points, head, parent, weight = tube()
    rng = np.random.default_rng(5)
    moved = skinned(points, weight, random_pose(2, head, parent, 0.9))
    moved = moved + rng.normal(scale=0.05, size=moved.shape)
    pose = follower(points, head, parent, weight).pose(moved)
    own = [pose.turn[0], *(pose.turn[b - 1].T @ pose.turn[b] for b in range(1, BONES))]
    shift = pose.turn[0] @ head[0] + pose.shift[0] - head[0]

    def error(turns, by):
        return ((skinned(points, weight, pose_of(head, parent, turns, by)) - moved) ** 2).sum()

    least = error(own, shift)
    for bone in range(BONES):
        for axis in np.eye(3):
            for angle in (-1e-3, 1e-3):
                tried = list(own)
                tried[bone] = own[bone] @ turn(axis, angle)
                assert error(tried, shift) > least
    for step in (*np.eye(3), *-np.eye(3)):
        assert error(own, shift + 1e-3 * step) > least


def nearest_of(places):
    tree = cKDTree(places)
    return lambda at: places[tree.query(at)[1]]


@pytest.mark.parametrize("seed", range(3))
def test_a_mesh_with_other_vertices_is_followed_by_the_nearest_ones(seed):
    """Ten times as many vertices at every frame; six frames turn each joint by up to 50 degrees."""
    points, head, parent, weight = tube()
    bones = follower(points, head, parent, weight)
    dense, _, _, own = tube(around=40, rings=73)
    rng = np.random.default_rng(seed)
    goal = [(rng.normal(size=3), rng.uniform(-1, 1) * np.radians(50)) for _ in head]
    pose = bones.at_rest()
    np.testing.assert_allclose(bones.skinned(pose), points, atol=1e-12)
    for part in np.arange(1, 7) / 6:
        moves = pose_of(
            head, parent, [turn(axis, part * angle) for axis, angle in goal], 0.3 * part
        )
        moved = skinned(dense, own, moves)
        pose, places = bones.pose_near(pose, nearest_of(moved))
        assert bones.off(pose, places).max() < 0.06
    tail = head + np.array((1.0, 0.0, 0.0))
    ends = np.column_stack((tail, np.ones(BONES)))
    found = (pose.matrices * ends[:, None]).sum(axis=2)
    np.testing.assert_allclose(found, (moves * ends[:, None]).sum(axis=2), atol=0.08)


def test_a_branch_that_is_born_is_told():
    """Vertices that no bone owns lie far from the posed mesh."""
    points, head, parent, weight = tube()
    bones = follower(points, head, parent, weight)
    thickness = bones.thickness(head, head + np.array((1.0, 0.0, 0.0)))
    found = Followed(["a", "b", "c", "d"], thickness)
    found.add(3, bones, bones.at_rest(), points)
    owner = np.repeat(bones.main_bone(), 2)
    found.add_back(3, np.where(owner == 2, 0.5, 0.0), owner, bones.size)
    others, left = found.warnings
    assert "other vertices or faces in 1 frames, from 3 to 3" in others
    assert "'c'" in left and "'a'" not in left and found.worst[1] > 0.01
    np.testing.assert_array_equal(bones.main_bone(), weight.argmax(axis=1))


def test_what_was_not_followed_is_told():
    """A bone whose vertices shrink into its head is left; a bent tube is not."""
    points, head, parent, weight = tube()
    bones = follower(points, head, parent, weight)
    tail = head + np.array((1.0, 0.0, 0.0))
    thickness = bones.thickness(head, tail)
    assert (np.abs(thickness - 0.26) < 0.02).all()  # of an ellipse with half axes of 0.3 and 0.21
    found = Followed(["a", "b", "c", "d"], thickness)
    bent = skinned(points, weight, random_pose(4, head, parent, 0.9))
    found.add(1, bones, bones.pose(bent), bent)
    assert found.warnings == [] and found.worst[0] == 1 and found.worst[1] < 1e-6
    gone = points.copy()
    gone[points[:, 0] > 2.0, 0] = 2.0
    found.add(2, bones, bones.pose(gone), gone)
    (warning,) = found.warnings
    assert "'d'" in warning and "in 1 frames, from 2 to 2" in warning
    assert found.worst[0] == 2 and found.worst[1] > 0.05


@pytest.mark.parametrize("seed", range(4))
def test_turns_are_those_of_singular_values(seed):
    """Kabsch's rotation by LAPACK, also of flat matrices and of mirrors; a line tells no turn."""
    rng = np.random.default_rng(seed)
    matrices = rng.normal(size=(20, 3, 3))
    matrices[5:10, :, 2] = 0.0
    found, known = closest_turns(matrices)
    u, _, v = np.linalg.svd(matrices)
    flip = np.ones((20, 3))
    flip[:, 2] = np.linalg.det(u) * np.linalg.det(v)
    assert known.all()
    np.testing.assert_allclose(found, (u * flip[:, None]) @ v, atol=1e-6)
    line, nothing = np.outer(rng.normal(size=3), rng.normal(size=3)), np.zeros((3, 3))
    found, known = closest_turns(np.array([line, nothing]))
    assert not known.any() and (found == np.eye(3)).all()
