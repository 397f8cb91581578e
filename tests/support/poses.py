# SPDX-License-Identifier: GPL-3.0-or-later
"""Rotations, and linear blend skinning, as any program does it."""

import numpy as np


def swapped(name):
    """The name of the mirror image of a bone."""
    return name[:-1] + {"L": "R", "R": "L"}[name[-1]] if name[-2:] in (".L", ".R") else name


def turn(axis, angle):
    """(3, 3) a rotation, by Rodrigues."""
    x, y, z = np.asarray(axis) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def random_turn(seed):
    """(3, 3) a rotation by any angle."""
    frame = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0]
    return frame * np.sign(np.linalg.det(frame))


def random_turns(bones, seed, most=0.6):
    """A rotation by up to so many radians for each bone but the roots."""
    rng = np.random.default_rng(seed)
    return {
        bone: turn(rng.normal(size=3), rng.uniform(-most, most))
        for bone in np.flatnonzero(bones.parent >= 0)
    }


def posed(rig, points, turns):
    """Where the points go when some bones turn about their heads, and what hangs on them with them."""
    bones, frames = rig.bones, []
    for bone in range(bones.count):
        own = np.eye(4)
        if bone in turns:
            own[:3, :3] = turns[bone]
            own[:3, 3] = bones.head[bone] - turns[bone] @ bones.head[bone]
        frames.append(own if bones.parent[bone] < 0 else frames[bones.parent[bone]] @ own)
    frames = np.array(frames)[rig.bone][:, :, :3]
    homogeneous = np.column_stack((points, np.ones(len(points))))
    return np.einsum("vk,vkij,vj->vi", rig.weight, frames, homogeneous)
