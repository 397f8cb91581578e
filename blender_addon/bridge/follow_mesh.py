# SPDX-License-Identifier: GPL-3.0-or-later
"""Bones that follow a mesh through frames: reading the mesh, and the keys of the poses.

The mesh is read without the modifier that binds it to the bones, in the space of the armature. Nothing is written
before all frames are fitted.
"""

from __future__ import annotations

from contextlib import ExitStack
from itertools import pairwise
from typing import TYPE_CHECKING

import bpy
import numpy as np
from mathutils import Matrix, Vector
from mathutils.bvhtree import BVHTree

from ..core.errors import InvalidInputError
from ..core.skeleton.follow import Follower
from ..core.skeleton.followed import Followed
from ..core.small_matrices import placed
from .armature_object import MADE, in_rest, mark_of, rig_of
from .limb_controls import IK, controls_that_end_with
from .mesh_arrays import read_polygons, read_positions
from .source_state import state_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..core.skeleton.follow import Pose

FOLLOWS = "ma_follows"  # on an action: its keys were made here
_REST = "ma_rest"  # on an armature: the frame at which its bones were made
_REST_SHAPE = "ma_rest_shape"  # a hash of the source at that frame
_BASIS = ("location", "rotation", "scale")
_INHERITED = "ma_inherited"  # on a bone: how it inherited sizes before it was stretched


def remember_rest(armature: bpy.types.Object, source: bpy.types.Object) -> None:
    """Store at which frame the bones of a source were made, and what shape it had then."""
    mark = mark_of(armature, source) or ""
    with in_rest(source):
        state = state_of(source, bpy.context.evaluated_depsgraph_get())
    armature.pop(_REST_SHAPE + mark, None)
    if state is not None:
        armature[_REST + mark] = bpy.context.scene.frame_current_final
        armature[_REST_SHAPE + mark] = state[0]


def check_followable(source: bpy.types.Object) -> bpy.types.Object:
    """Return the armature with the bones of a source.

    Raises
    ------
    InvalidInputError
        There is none, or it cannot be keyed now.
    """
    armature = rig_of(source)
    if armature is None:
        raise InvalidInputError(
            f"Expected an armature of '{source.name}', found none; press Make Armature"
        )
    if armature.library is not None or armature.data.library is not None:
        raise InvalidInputError(
            f"Expected an armature of this file, found '{armature.name}', which is linked; make it local"
        )
    if source.type != "MESH":
        raise InvalidInputError(
            f"Expected a mesh, found '{source.name}' of type {source.type.capitalize()}; convert it to a mesh"
        )
    if bpy.context.mode != "OBJECT":
        raise InvalidInputError(
            f"Expected object mode, found '{bpy.context.object.name}' in another one; leave that mode"
        )
    if not 0.0 < abs(armature.matrix_world.determinant()) < float("inf"):
        raise InvalidInputError(
            f"Expected a scale that Blender can invert, found one too large or too small of '{armature.name}'; "
            "apply the scale"
        )
    return armature


class MeshFollower:
    """The bones of a source, and their poses at the frames that were added; bones keep their sizes, or stretch.

    The modifier that binds the source is off until `close`; `bake` leaves it off, because the mesh has its motion
    already.

    Raises
    ------
    InvalidInputError
        There are no such bones, the source is not as it was when they were made, or has no weights.
    """

    def __init__(self, source: bpy.types.Object, stretch: bool = False) -> None:
        self._stretch = stretch
        self.source, self.armature = source, check_followable(source)
        self._mark = mark_of(self.armature, source) or ""
        self._scene = bpy.context.scene
        self._shown = self._scene.frame_current_final
        self._poses: list[tuple[int, dict[str, Matrix], dict[str, Matrix]]] = []
        self._moves = False
        self._open = ExitStack()
        self._open.callback(self._set_frame, self._shown)
        self._open.enter_context(in_rest(source))
        try:
            self._read_rest()
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Show the frame and the modifiers that were shown before; a second time it does nothing."""
        self._open.close()

    def add(self, frame: int) -> None:
        """Fit the pose at a frame.

        Raises
        ------
        InvalidInputError
            The mesh has no faces there, or numbers that are not finite.
        """
        self._set_frame(frame)
        places = self._places(f"at frame {frame}")
        same = self._has_faces_of_rest()
        if same:
            pose = self._follower.pose(places)
            self.found.add(frame, self._follower, pose, places)
        else:
            pose, places = self._follow_nearest(frame, places)
        self._pose = pose
        self._moves = self._moves or not np.allclose(
            places, self._rest_places, rtol=0.0, atol=1e-6 * self._follower.size
        )
        self._keep(frame, pose)

    def check_motion(self) -> None:
        """Raise InvalidInputError when the mesh moves at none of the frames that were added."""
        if not self._moves:
            raise InvalidInputError(
                "Expected a mesh that moves at these frames by other things than its bones, found it still; animate "
                "it, or choose other frames"
            )

    def bake(self) -> None:
        """Key the poses that were added, and turn the modifier that binds the source off."""
        self.close()
        bound = [m for m in self.source.modifiers if m.type == "ARMATURE"]
        bound = [m for m in bound if m.object == self.armature]
        self.was_bound = any(m.show_viewport or m.show_render for m in bound)
        for modifier in bound:
            modifier.show_viewport = modifier.show_render = False
        for name in self._names:  # a solver of IK would bend limbs anew
            for constraint in self.armature.pose.bones[name].constraints:
                constraint.mute |= constraint.name == IK
        for name in self._poses[0][1]:
            _inherit_sizes(self.armature.data.bones[name], not self._stretch)
        keyed = self._keys()
        _start_action(self.armature, set(keyed))
        for name, keys in keyed.items():
            _key(self.armature.pose.bones[name], keys, self._stretch and name in self._names)
        self._set_frame(self._shown)

    @property
    def warnings(self) -> list[str]:
        """Return a sentence about each thing that may not be as expected."""
        found = self.found.warnings
        bones = (self.armature.pose.bones[name] for name in self._names)
        own = sum(any(c.name != IK and not c.mute for c in bone.constraints) for bone in bones)
        if own:
            found.append(f"{own} bones have constraints of their own, which act after the keys")
        return found

    @property
    def count(self) -> int:
        return len(self._names)

    # --- at rest

    def _read_rest(self) -> None:
        frame, shape = (self.armature.get(key + self._mark) for key in (_REST, _REST_SHAPE))
        if shape is None:
            raise InvalidInputError(
                f"Expected bones that know at which frame they were made, found that '{self.armature.name}' does "
                "not; press Make Armature again"
            )
        self._set_frame(frame)
        state = state_of(self.source, bpy.context.evaluated_depsgraph_get())
        if state is None or state[0] != shape:
            raise InvalidInputError(
                f"Expected '{self.source.name}' at frame {frame:g} as it was when its bones were made, found it "
                "hidden or changed; show it, or press Make Armature again"
            )
        self._faces = read_polygons(self._mesh())
        self._rest_places = self._places(f"at frame {frame:g}")
        vertex, group, weight = self._weights()
        bones = self.armature.data.bones
        self._names = _parents_first(bones, set(group), MADE + self._mark)
        row = {name: number for number, name in enumerate(self._names)}
        above = [_above(bones[name], row) for name in self._names]
        for name, parent in zip(self._names, above, strict=True):
            if not parent and bones[name].use_connect:
                raise InvalidInputError(
                    f"Expected bones that may move, found '{name}' connected to '{bones[name].parent.name}', which "
                    "has no weights; turn Connected off"
                )
        head, tail = (
            np.array([getattr(bones[name], end) for name in self._names], np.float64)
            for end in ("head_local", "tail_local")
        )
        length = np.sqrt(((tail - head) ** 2).sum(axis=1))
        self._follower = Follower(
            head,
            np.array([row.get(name, -1) for name in above], np.int32),
            self._rest_places,
            vertex,
            np.array([row[name] for name in group], np.int64),
            weight,
            (tail - head) / length[:, None] if self._stretch else None,
        )
        self.found = Followed(self._names, self._follower.thickness(head, tail), self._stretch)
        self._pose = self._follower.at_rest()

    def _weights(self) -> tuple[NDArray[np.int64], list[str], NDArray[np.float64]]:
        """The vertex, the bone and the weight of each weight of the evaluated mesh."""
        bones = self.armature.data.bones
        names = {group.index: group.name for group in self.source.vertex_groups}
        names = {n: name for n, name in names.items() if name in bones and bones[name].use_deform}
        found = [
            (vertex.index, names[element.group], element.weight)
            for vertex in self._mesh().vertices
            for element in vertex.groups
            if element.group in names and element.weight > 0.0
        ]
        if not found:
            raise InvalidInputError(
                f"Expected weights of '{self.source.name}', found none for the bones of '{self.armature.name}'; "
                "press Make Armature with Bind: Axis"
            )
        vertex, bone, weight = zip(*found, strict=True)
        return np.array(vertex, np.int64), list(bone), np.array(weight, np.float64)

    # --- at a frame

    def _set_frame(self, frame: float) -> None:
        whole = int(np.floor(frame))
        self._scene.frame_set(whole, subframe=frame - whole)

    def _mesh(self) -> bpy.types.Mesh:
        return self.source.evaluated_get(bpy.context.evaluated_depsgraph_get()).data

    def _places(self, when: str) -> NDArray[np.float64]:
        """(v, 3) the vertices in the space of the armature."""
        places = read_positions(self._mesh())
        depsgraph = bpy.context.evaluated_depsgraph_get()
        worlds = (
            np.array(thing.evaluated_get(depsgraph).matrix_world, np.float64)
            for thing in (self.armature, self.source)
        )
        armature, source = worlds
        found = placed(places, np.linalg.inv(armature) @ source)
        if not np.isfinite(found).all():
            raise InvalidInputError(
                f"Expected finite coordinates, found others of '{self.source.name}' {when}; repair the mesh"
            )
        return found

    def _has_faces_of_rest(self) -> bool:
        mesh = self._mesh()
        same = (np.array_equal(a, b) for a, b in zip(read_polygons(mesh), self._faces, strict=True))
        return len(mesh.vertices) == len(self._rest_places) and all(same)

    def _follow_nearest(
        self, frame: int, own: NDArray[np.float64]
    ) -> tuple[Pose, NDArray[np.float64]]:
        """Fit the pose to a mesh with other vertices, `own`: the pose, and the nearest place of each vertex at rest."""
        polygons = read_polygons(self._mesh())
        if len(polygons[0]) < 2:
            raise InvalidInputError(
                f"Expected faces at every frame, found none of '{self.source.name}' at frame {frame}; choose frames "
                "without that one"
            )
        tree = _tree(own, polygons)
        pose, places = self._follower.pose_near(self._pose, lambda at: _nearest(tree, at)[0])
        self.found.add(frame, self._follower, pose, places)
        posed = self._follower.skinned(pose)
        found, faces = _nearest(_tree(posed, self._faces), own)
        corner = self._faces[1][self._faces[0][faces]]
        back = np.sqrt(((found - own) ** 2).sum(axis=1))
        self.found.add_back(frame, back, self._follower.main_bone()[corner], self._follower.size)
        return pose, places

    def _keep(self, frame: int, pose: Pose) -> None:
        """Remember where a pose puts bones and their controls, and how all others are posed at this frame."""
        moved = {
            name: Matrix(np.vstack((move, (0.0, 0.0, 0.0, 1.0))).tolist())
            for name, move in zip(self._names, pose.matrices, strict=True)
        }
        moved |= {
            control: moved[limb]
            for name in self._names
            for control, limb in controls_that_end_with(self.armature.pose.bones[name])
            if limb in moved
        }
        others = {
            bone.name: bone.matrix_basis.copy()
            for bone in self.armature.pose.bones
            if bone.name not in moved
        }
        self._poses.append((frame, moved, others))

    def _keys(self) -> dict[str, list[tuple[int, Matrix]]]:
        """The transforms of each bone against its parent, as Blender keys them for the poses."""
        found: dict[str, list[tuple[int, Matrix]]] = {}
        bones = sorted(self.armature.data.bones, key=lambda bone: len(bone.parent_recursive))
        for frame, moved, others in self._poses:
            poses: dict[str, Matrix] = {}
            for bone in bones:
                parent = {}
                if bone.parent is not None:
                    parent["parent_matrix"] = poses[bone.parent.name]
                    parent["parent_matrix_local"] = bone.parent.matrix_local
                if bone.name in moved:
                    poses[bone.name] = moved[bone.name] @ bone.matrix_local
                    basis = bone.convert_local_to_pose(
                        poses[bone.name], bone.matrix_local, invert=True, **parent
                    )
                    found.setdefault(bone.name, []).append((frame, basis))
                else:
                    poses[bone.name] = bone.convert_local_to_pose(
                        others[bone.name], bone.matrix_local, **parent
                    )
        return found


def _tree(places: NDArray[np.float64], faces: tuple[NDArray[np.int32], ...]) -> BVHTree:
    """A tree of polygons, by the offsets and the corners of each."""
    offsets, corners = faces
    rows = [corners[a:b].tolist() for a, b in pairwise(offsets)]
    return BVHTree.FromPolygons(places.tolist(), rows)


def _nearest(
    tree: BVHTree, places: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """The nearest place on the polygons, (v, 3), and its polygon, (v,)."""
    found = [tree.find_nearest(place) for place in places.tolist()]
    return np.array([place for place, *_ in found]), np.array([face for _, _, face, _ in found])


def _parents_first(
    bones: bpy.types.bpy_prop_collection, weighted: set[str], made: str
) -> list[str]:
    """The bones with weights and those that were made for the source, by name."""
    chosen = [bone for bone in bones if bone.use_deform and (bone.name in weighted or made in bone)]
    return [bone.name for bone in sorted(chosen, key=lambda bone: len(bone.parent_recursive))]


def _above(bone: bpy.types.Bone, row: dict[str, int]) -> str:
    """The nearest bone above another one that has a row; an empty name where there is none."""
    return next((above.name for above in bone.parent_recursive if above.name in row), "")


def _start_action(armature: bpy.types.Object, names: set[str]) -> None:
    """Give an armature an action without keys of some bones; an artist's action stays in the file as it is."""
    data = armature.animation_data or armature.animation_data_create()
    action = data.action
    if action is None:
        action = bpy.data.actions.new(f"{armature.name} Follow")
    elif FOLLOWS not in action:
        action.use_fake_user = True
        action = action.copy()
        action.use_fake_user = False
        action.name = f"{armature.name} Follow"
    action[FOLLOWS] = True
    data.action = action
    starts = tuple(f'pose.bones["{bpy.utils.escape_identifier(name)}"].' for name in names)
    for curves in _curves(action):
        for curve in [c for c in curves if c.data_path.startswith(starts)]:
            if curve.data_path.rpartition(".")[2].startswith(_BASIS):
                curves.remove(curve)


def _curves(action: bpy.types.Action) -> list[bpy.types.bpy_prop_collection]:
    """The collections of curves of an action: one, or from 5.0 one for each slot of each strip."""
    if hasattr(action, "fcurves"):
        return [action.fcurves]
    strips = (strip for layer in action.layers for strip in layer.strips)
    return [bag.fcurves for strip in strips for bag in strip.channelbags]


def _inherit_sizes(bone: bpy.types.Bone, wanted: bool) -> None:
    """Let a bone not inherit the sizes of its parent, or inherit them as it did before."""
    if not wanted and _INHERITED not in bone:
        bone[_INHERITED], bone.inherit_scale = bone.inherit_scale, "NONE"
    elif wanted and _INHERITED in bone:
        bone.inherit_scale = bone[_INHERITED]
        del bone[_INHERITED]


def _key(bone: bpy.types.PoseBone, keys: list[tuple[int, Matrix]], stretch: bool) -> None:
    """Key the rotation of a bone in its own mode, its location where its parent's joint moves otherwise, and sizes."""
    quaternions = bone.rotation_mode == "QUATERNION"
    mode = bone.rotation_mode
    places = [matrix.to_translation() for _, matrix in keys]
    moves = max(place.length for place in places) > 1e-5 * bone.bone.length
    bone.scale = (1.0, 1.0, 1.0)
    if not moves:
        bone.location = (0.0, 0.0, 0.0)
    before = None
    for (frame, matrix), place in zip(keys, places, strict=True):
        turn = matrix.to_quaternion()
        if moves:
            bone.location = place
            bone.keyframe_insert("location", frame=frame, group=bone.name)
        if stretch:
            bone.scale = matrix.to_scale()
            bone.keyframe_insert("scale", frame=frame, group=bone.name)
        if quaternions:
            if before is not None:
                turn.make_compatible(before)
            bone.rotation_quaternion = before = turn
            path = "rotation_quaternion"
        elif mode == "AXIS_ANGLE":
            axis, angle = turn.to_axis_angle()
            if before is not None and axis.dot(before) < 0.0:
                axis, angle = -axis, -angle
            bone.rotation_axis_angle = (angle, *axis)
            before, path = Vector(axis), "rotation_axis_angle"
        else:
            angles = turn.to_euler(mode, before) if before is not None else turn.to_euler(mode)
            bone.rotation_euler = before = angles
            path = "rotation_euler"
        bone.keyframe_insert(path, frame=frame, group=bone.name)
