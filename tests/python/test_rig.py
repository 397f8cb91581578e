# SPDX-License-Identifier: GPL-3.0-or-later
"""Rigs: pelvis, sides, names, joints and roll, on figures whose plane and joints are known, and on real bodies."""

from itertools import pairwise

import numpy as np
import pytest
from medial_axis.core.files.read_shape import read_shape
from medial_axis.core.rig.bones import bones_of
from medial_axis.core.rig.names import limbs_of, names_of, target_of
from medial_axis.core.rig.rig import compute_rig
from medial_axis.core.rig.roll import flats_of
from medial_axis.core.settings import SamplingMode, Settings, SkeletonSettings
from medial_axis.core.shape.shape import Shape
from medial_axis.core.skeleton.parts import Places
from medial_axis.core.skeleton.skeleton import Skeleton, skeleton_of
from support.poses import swapped, turn

pytestmark = pytest.mark.oracle

FORK, CHEST = (0, 0, 1.0), (0, 0, 1.5)


def skeleton(*branches):
    """A skeleton of branches, each the corners of a polyline (x, y, z, radius); equal corners are one node."""
    rows, chains, row = [], [], {}
    for corners in branches:
        corners = np.asarray(corners, float)
        places = np.concatenate([np.linspace(a, b, 9)[:-1] for a, b in pairwise(corners)])
        chain = []
        for place in (*places, corners[-1]):
            key = tuple(place)
            row.setdefault(key, len(row))
            if row[key] == len(rows):
                rows.append(place)
            chain.append(row[key])
        chains.append(np.array(chain))
    rows = np.array(rows)
    return skeleton_of(rows[:, :3], rows[:, 3], chains, np.zeros(0, np.int64))


def pair(*corners):
    """A branch and its mirror image in X."""
    corners = np.array(corners, float)
    return corners, corners * (-1, 1, 1, 1)


def biped(fork=1.0, elbow=0.0):
    """A figure that stands on Z, looks to -Y, and has its hips at x = +-0.12, z = 0.9; elbows bend to the front."""
    above = ((0.002, 0, 1.0, 0.2),) if fork > 1.1 else ()
    hip, ankle, toes = (0.12, 0, 0.9, 0.1), (0.14, 0, 0.1, 0.06), (0.14, -0.2, 0.03, 0.04)
    leg = ((0, 0, fork, 0.2), *above, hip, ankle, toes)
    arm = ((0, 0, 1.5, 0.17), (0.2, 0, 1.5, 0.07), (0.55, elbow, 1.5, 0.05), (0.9, 0, 1.5, 0.04))
    spine, head = ((0, 0, fork, 0.2), (0, 0, 1.5, 0.17)), ((0, 0, 1.5, 0.17), (0, 0, 1.9, 0.1))
    return skeleton(spine, head, *pair(*leg), *pair(*arm))


def quadruped():
    """A figure along Y that looks to -Y: the hind part is thick, the tail is behind."""
    hind, fore = (0, 1.0, 1.0), (0, -1.0, 1.0)
    legs = [
        pair((*fork, r), (0.3, fork[1], 0.7, 0.12), (0.3, fork[1], 0, 0.1))
        for fork, r in ((hind, 0.3), (fore, 0.25))
    ]
    trunk, tail = ((*hind, 0.3), (*fore, 0.25)), ((*hind, 0.3), (0, 2.2, 1.0, 0.05))
    neck = ((*fore, 0.25), (0, -1.5, 1.6, 0.15), (0, -1.9, 1.6, 0.1))
    return skeleton(trunk, tail, neck, *legs[0], *legs[1])


def moved(thing, frame):
    matrix = np.eye(4)
    matrix[:3, :3] = frame
    return thing.placed(matrix)


def named(thing, per_limb=0):
    """{name: row}, and the bones."""
    bones, bodies = bones_of(thing, per_limb)
    names = names_of(bodies, bones.count)
    assert len(set(names)) == bones.count
    return {name: row for row, name in enumerate(names)}, bones, bodies


def stems(names):
    """The names of chains, without the numbers of bones."""
    return {target_of(name) if name[-1] in "LR0123456789" else name for name in names}


def lengths(bones):
    return np.linalg.norm(bones.tail - bones.head, axis=1)


def test_a_figure_has_a_pelvis_a_spine_a_head_and_two_sides():
    names, bones, _ = named(biped())
    sided = {f"IK.{limb}.{side}" for limb in ("arm", "leg") for side in "LR"}
    assert stems(names) == {"pelvis", "IK.spine", "IK.head"} | sided
    for name, row in names.items():
        if name.endswith(".L"):
            assert bones.tail[row, 0] > 0.0
            np.testing.assert_allclose(
                bones.tail[names[swapped(name)]], bones.tail[row] * (-1, 1, 1), atol=1e-12
            )
    assert bones.tail[names["arm.01.L"], 2] > bones.tail[names["leg.01.L"], 2]  # arms first
    assert bones.parent[names["leg.01.L"]] == names["pelvis"] == 0
    assert bones.connected[names["spine.01"]] and not bones.connected[names["leg.01.L"]]


def test_the_names_of_an_animal_go_from_head_to_tail():
    names, bones, _ = named(quadruped())
    assert {"pelvis", "spine.01", "head.01", "tail.01"} <= set(names)
    assert bones.head[names["pelvis"], 1] > 0.7
    assert bones.tail[names["leg.01.01.L"], 1] < 0.0 < bones.tail[names["leg.02.01.L"], 1]
    assert not any(name.startswith(("arm", "limb")) for name in names)


def test_a_limb_has_three_bones_so_that_it_can_be_curled():
    finger = skeleton(
        ((0, 0, 0, 0.3), (0, 0, 1, 0.3)), *(((0, 0, 0, 0.3), (x, 0, -2, 0.1)) for x in (-1, 1))
    )
    _, _, bodies = named(finger)
    counts = [len(rows) for rows in limbs_of(bodies)]
    assert counts[-2:] == [3, 3]


@pytest.mark.parametrize("figure", [biped, quadruped])
def test_names_do_not_depend_on_how_a_figure_is_turned(figure):
    """Any turn keeps the middle and the pairs; up to 30 degrees left stays left, also of the mirror image."""
    usual, first, _ = named(figure())
    for seed in range(12):
        rng = np.random.default_rng(seed)
        frame = turn(rng.normal(size=3), np.radians(30) if seed < 6 else rng.uniform(0, np.pi))
        names, bones, _ = named(moved(figure(), frame))
        back = bones.tail @ frame
        assert set(names) == set(usual)
        for name, row in names.items():
            tails = [first.tail[usual[n]] for n in ((name,) if seed < 6 else (name, swapped(name)))]
            nearest = min(tails, key=lambda tail: np.linalg.norm(tail - back[row]))
            np.testing.assert_allclose(back[row], nearest, atol=1e-6)
    names, bones, _ = named(moved(figure(), np.diag((-1.0, 1.0, 1.0))))
    for name, row in names.items():
        np.testing.assert_allclose(bones.tail[row], first.tail[usual[name]], atol=1e-9)


@pytest.mark.parametrize("fork", [0.95, 1.05, 1.2])
def test_the_pelvis_is_between_the_hips_wherever_legs_fork(fork):
    """Nearly parallel legs may fork at any height; hips and pelvis move by a third of its radius at most."""
    names, bones, _ = named(biped(fork))
    usual, first, _ = named(biped())
    for name in ("pelvis", "leg.01.L"):
        off = bones.head[names[name]] - first.head[usual[name]]
        assert np.linalg.norm(off) < 0.07


@pytest.mark.parametrize("figure, per_limb", [(biped, 0), (quadruped, 0), (biped, 100)])
def test_no_bone_is_shorter_than_the_balls_on_it(figure, per_limb):
    """A short limb has as many bones as there is room for."""
    _, bones, _ = named(figure(), per_limb)
    assert (lengths(bones) >= np.maximum(bones.head_radius, bones.tail_radius) * (1 - 1e-9)).all()


@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_limbs_have_as_many_bones_as_wanted(count):
    names, bones, _ = named(biped(), count)
    limbs = [row for name, row in names.items() if name[:7] in ("arm.01.", "leg.01.")]
    assert [int((bones.chain == bones.chain[row]).sum()) for row in limbs] == [count] * 4
    head = lengths(bones)[[row for name, row in names.items() if name.startswith("head")]]
    np.testing.assert_allclose(head, head.mean(), rtol=0.05)  # it is straight, and has room for two


def test_a_pose_keeps_the_pairs():
    """One arm up, one leg to the side: left and right are those of before."""
    arms = [
        ((0, 0, 1.5, 0.17), (0.2, 0, 1.5, 0.07), (0.9, 0, 1.5, 0.04)),
        ((0, 0, 1.5, 0.17), (-0.2, 0, 1.5, 0.07), (-0.3, -0.6, 1.8, 0.04)),
    ]
    legs = [
        ((*FORK, 0.2), (0.12, 0, 0.9, 0.1), (0.7, 0, 0.3, 0.05)),
        ((*FORK, 0.2), (-0.12, 0, 0.9, 0.1), (-0.14, -0.3, 0.05, 0.05)),
    ]
    names, bones, _ = named(
        skeleton(
            ((*FORK, 0.2), (*CHEST, 0.17)), ((*CHEST, 0.17), (0, 0.05, 1.9, 0.1)), *arms, *legs
        )
    )
    assert {"pelvis", "head.01", "arm.01.L", "arm.01.R", "leg.01.L", "leg.01.R"} <= set(names)
    for name, row in names.items():
        if name[-2:] in (".L", ".R"):
            assert (bones.tail[row, 0] > 0) == name.endswith(".L")


def test_a_shape_without_sides_has_none():
    """Branches of a plant, of different lengths."""
    ends = np.array([(1, 0.3, 1), (-2, 0.5, 2), (0.4, -3, 2.5), (-0.2, 1, -1.5)])
    ends *= np.array([1, 1.2, 2, 10])[:, None]
    names, _, bodies = named(skeleton(*(((0, 0, 0, 0.3), (*end, 0.1)) for end in ends)))
    assert not bodies[0].sides.found and "root" in names
    assert not any(name[-2:] in (".L", ".R") for name in names)


# --- roll


def hinges(bones):
    """(n, 3) the first axis of each bone."""
    return np.cross((bones.tail - bones.head) / lengths(bones)[:, None], bones.up)


def test_elbows_bend_in_their_plane_and_mirror_images_alike():
    names, bones, _ = named(biped(elbow=0.15), 2)
    along = bones.tail - bones.head
    np.testing.assert_allclose(np.linalg.norm(bones.up, axis=1), 1.0)
    np.testing.assert_allclose((bones.up * along).sum(axis=1), 0.0, atol=1e-12)
    for name, row in names.items():
        other = names[swapped(name)]
        np.testing.assert_allclose(bones.up[other] * (-1, 1, 1), bones.up[row], atol=1e-9)
        if name.startswith("arm"):
            np.testing.assert_allclose(np.abs(hinges(bones)[row]), (0, 0, 1), atol=1e-6)
        if name.startswith(("pelvis", "spine", "head")):
            np.testing.assert_allclose(hinges(bones)[row], (1, 0, 0), atol=1e-9)
    upper, lower = names["arm.01.L"], names["arm.02.L"]
    bent = turn(hinges(bones)[lower], 0.2) @ along[lower]
    assert bent @ along[upper] < along[lower] @ along[upper]  # a positive angle bends further


@pytest.mark.parametrize("seed", range(3))
def test_a_straight_flat_limb_bends_towards_its_flat_side(seed):
    """A tube of an elliptic section, three times as wide as thick."""
    frame = turn(np.random.default_rng(seed).normal(size=3), 1.0 + seed)
    t, z = np.meshgrid(2 * np.pi * np.arange(24) / 24, np.linspace(0.02, 0.98, 40))
    t, z = t.ravel(), z.ravel()
    vertices = np.column_stack((0.3 * np.cos(t), 0.1 * np.sin(t), 4 * z)) @ frame.T
    line = moved(skeleton(((0, 0, 0, 0.1), (0, 0, 4.0, 0.1))), frame)
    flats = flats_of(line, Places(np.zeros(len(z), np.int32), z), vertices)
    assert abs(flats[0] @ frame[:, 1]) > 0.999
    bones, _ = bones_of(line, 2, flats)
    np.testing.assert_allclose(np.abs(bones.up @ frame[:, 1]), 1.0, atol=1e-3)


def test_parts_that_are_apart_have_their_own_roots():
    far = biped().placed(np.diag((0.5, 0.5, 0.5, 1.0)) + np.eye(4, k=3) * 5.0)
    both = biped()
    rows = [*both.branches, *(rows + len(both.points) for rows in far.branches)]
    found = skeleton_of(
        np.concatenate((both.points, far.points)),
        np.concatenate((both.radius, far.radius / 2)),
        rows,
        np.zeros(0, np.int64),
    )
    names, bones, bodies = named(found)
    assert len(bodies) == 2 and {"pelvis", "02.pelvis"} <= set(names)
    assert (bones.parent < 0).sum() == 2


def test_a_rod_and_a_ring_have_bones():
    rod, _, _ = named(skeleton(((0, 0, 0, 0.1), (0, 0, 3.0, 0.1))))
    assert "root" in rod and len(rod) > 2
    angle = np.linspace(0, 2 * np.pi, 25)[:-1]
    points = np.column_stack((np.cos(angle), np.sin(angle), 0 * angle))
    ring = Skeleton(
        points,
        np.full(24, 0.1),
        np.array([0, 25], np.int32),
        np.array([*range(24), 0], np.int32),
        np.array([0], np.int32),
    )
    _, bones, _ = named(ring)
    assert np.isfinite(bones.up).all() and (bones.parent < 0).sum() == 1


@pytest.mark.parametrize(
    ("name", "stable", "turned"),
    [
        ("spot_low.obj", {"pelvis", "IK.spine"}, False),
        pytest.param(
            "human_woman.obj",
            {"pelvis", "IK.head", "IK.arm.L", "IK.leg.R"},
            True,
            marks=pytest.mark.slow,
        ),
    ],
)
def test_real_bodies_have_the_same_pelvis_at_every_density(data_file, name, stable, turned):
    shape, _ = read_shape(data_file(name))
    first = None
    for samples in (16_000, 32_000):
        settings = Settings(sampling=SamplingMode.SURFACE, samples=samples)
        frame = turn((0.3, 0.2, 1.0), np.radians(20)) if turned and first is not None else np.eye(3)
        rig = compute_rig(
            Shape(shape.points @ frame.T, shape.triangles), settings, SkeletonSettings()
        )
        assert stable <= stems(rig.names)
        pelvis = rig.bones.head[rig.names.index("pelvis")] @ frame
        first = pelvis if first is None else first
        assert np.linalg.norm(pelvis - first) < rig.bones.head_radius[rig.names.index("pelvis")]
        side = rig.bones.tail @ frame
        left = [row for row, bone in enumerate(rig.names) if bone.endswith(".L")]
        assert left and (side[left, 0] > pelvis[0]).all()
        in_frame = (pelvis @ frame.T - rig.frame[:3, 3]) @ rig.frame[:3, :3]
        assert abs(in_frame[0]) < 0.05 * rig.bones.head_radius[0]
