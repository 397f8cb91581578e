# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects that are made of a source, and updated in place when the source is computed again.

They remember their source in a custom property, and are its children unless this is switched off; the source is not
changed. The functions `write_...(source, found, frame)` of the products make or update them, all or nothing; `frame`, a
(4, 4) rotation and translation, is where they lie in the world. They raise InvalidInputError where an object cannot be
changed now, or Blender cannot hold it.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import bpy
import numpy as np
from mathutils import Matrix
from numpy.typing import NDArray

from ... import __version__
from ...core.errors import InvalidInputError
from ..mesh import stored
from ..mesh.colours import coloured_mesh, remember_colours
from ..mesh.material import dress

KEPT_SCALE = "Medial Axis Scale"  # the constraint that keeps the scale of an output at 1

Build = Callable[[str | bpy.types.Mesh], bpy.types.Mesh]


def source_of(output: bpy.types.Object) -> bpy.types.Object | None:
    """The object that this was made of; None when it was not made of one, or its source is gone."""
    source = output.get(stored.SOURCE)
    return source if isinstance(source, bpy.types.Object) else None


def is_gone(thing: bpy.types.Object | None) -> bool:
    """Deleted: Blender keeps objects that a custom property points to, but in no collection."""
    return thing is None or not thing.users_collection


def first_of_family(thing: bpy.types.Object) -> bpy.types.Object:
    """The metaball that has the shape of its whole family; any other object is returned as it is.

    A family are the metaballs whose names differ only in a number at the end, and its first has none.
    """
    if thing.type != "META" or not thing.name[-1].isdigit():
        return thing
    first = bpy.data.objects.get(thing.name.rpartition(".")[0])
    return thing if is_gone(first) or first.type != "META" else first


def output_of(
    source: bpy.types.Object, is_kind: Callable[[bpy.types.Object], bool]
) -> bpy.types.Object | None:
    """The object of a kind that the next computation of this source, or of its family, updates."""
    source = first_of_family(source)
    found = [
        thing
        for thing in bpy.data.objects
        if thing.library is None
        and is_kind(thing)
        and not is_gone(thing)
        and source_of(thing) == source
    ]
    return min(found, key=lambda thing: thing.name, default=None)


@dataclass(frozen=True)
class Product:
    """One kind of object that is made of a source: how it is found, made and updated.

    An object is named like its source with the `suffix`. Objects of this kind, and no others, have Blender's `type` and
    all the custom properties `marks`. `part` is the connected part of a source of which they are made; it is empty for
    the whole. New objects get the material that `material` returns, with the flat colour of all products.
    """

    suffix: str
    marks: tuple[str, ...]
    type: str = "MESH"
    part: str = ""
    material: Callable[[], bpy.types.Material] | None = None

    def has(self, thing: bpy.types.Object) -> bool:
        """Return whether an object is of this kind."""
        return thing.type == self.type and all(mark in thing for mark in self.marks)

    def of(self, source: bpy.types.Object) -> bpy.types.Object | None:
        """The object of this kind that the next computation of a source updates."""
        return output_of(
            source, lambda thing: self.has(thing) and thing.get(stored.OF_PART, "") == self.part
        )

    def check_writable(self, source: bpy.types.Object) -> None:
        """Raise InvalidInputError when the object that was made of a source cannot be updated now."""
        check_mode(self.of(source))

    def write_mesh(
        self, source: bpy.types.Object, build: Build, between_steps: bool = False
    ) -> tuple[bpy.types.Object, bool]:
        """Make the object of a source or give it another mesh, all or nothing; and whether it is new.

        `build` and `between_steps` are as in `replace_mesh`.
        """
        thing = self.of(source)
        if thing is not None:
            replace_mesh(thing, build, between_steps)
            return thing, False
        thing = new_object(source, self.suffix, build(source.name + self.suffix))
        if self.material is not None:
            dress(thing, self.material())
        return thing, True

    def write_coloured(
        self,
        source: bpy.types.Object,
        build: Build,
        of: str,
        values: NDArray,
        start: float,
        end: float,
    ) -> tuple[bpy.types.Object, bool]:
        """As `write_mesh`, with colours of the vertices, whose range is remembered for the material and the legend.

        `of` is the name of the attribute that is shown, or "" for a mesh without colours; of its values at the vertices
        `start` is blue and `end` is yellow.
        """
        coloured = partial(coloured_mesh, build, values, start, end) if of else build
        thing, is_new = self.write_mesh(source, coloured)
        remember_colours(thing, of, start, end)
        return thing, is_new


def check_mode(output: bpy.types.Object | None) -> None:
    """Raise InvalidInputError when an object that was made before cannot be updated now."""
    if output is not None and output.mode != "OBJECT":
        raise InvalidInputError(
            f"Expected '{output.name}' in object mode, found it in {output.mode.lower()} mode; "
            "leave that mode and compute again"
        )


def new_object(source: bpy.types.Object, suffix: str, mesh: bpy.types.Mesh) -> bpy.types.Object:
    """An object named after its source, in the collections of the source."""
    output = bpy.data.objects.new(source.name + suffix, mesh)
    editable = [collection for collection in source.users_collection if collection.library is None]
    for collection in editable or [bpy.context.scene.collection]:
        collection.objects.link(output)
    return output


def replace_mesh(output: bpy.types.Object, build: Build, between_steps: bool = False) -> None:
    """Swap in a new mesh, also for linked duplicates; materials and the name stay.

    `build` makes a mesh from its name, or fills the mesh that it is given. With `between_steps` no step of undo
    follows, so the mesh that there is is filled again: Blender keeps an object that two steps have alike as it is now,
    and from 5.0 on it ends where such an object has a mesh that neither step has. What was written so is marked on
    both, for undo may bring back one of the two (`is_torn`).
    """
    check_mode(output)
    old = output.data
    output.pop(stored.WRITTEN, None)
    if between_steps and old.shape_keys is None:  # keys of an artist fit one number of vertices
        build(old)
        output[stored.WRITTEN] = old[stored.WRITTEN] = str(time.time_ns())
        return
    mesh = build(old.name)
    for material in old.materials:
        mesh.materials.append(material)
    old.user_remap(mesh)
    name = old.name
    bpy.data.meshes.remove(old)
    mesh.name = name


def is_torn(output: bpy.types.Object) -> bool:
    """Return whether an object and its mesh were not written together: undo has brought back one of them."""
    return output.get(stored.WRITTEN) != output.data.get(stored.WRITTEN)


def place(output: bpy.types.Object, frame: np.ndarray) -> None:
    """Give an object the place `frame`, a (4, 4) rotation and translation."""
    output.matrix_world = Matrix(frame.tolist())
    if output.parent is None:
        output.scale = (1.0, 1.0, 1.0)  # exactly, not to the last bit of a decomposed matrix


def follow(output: bpy.types.Object, source: bpy.types.Object, world: Matrix, wanted: bool) -> None:
    """Make an object that has just been placed a child of its source, or its own master again.

    A parent that an artist chose stays. A source that is scaled flat cannot be a parent; a curve whose path is animated
    would carry its children along that path. `world` is the matrix of the source when it was read.
    """
    frame = output.matrix_world.copy()
    if output.parent == source and not wanted:
        output.parent = None
        _forget_scale(output)
    elif wanted and output.parent in (None, source) and _can_carry(source, world):
        output.parent = source
        output.matrix_parent_inverse = inverse_of(world)
    else:
        return
    output.matrix_basis = frame
    output.scale = (1.0, 1.0, 1.0)
    if output.parent is not None:
        _keep_scale(output)
        if source.type == "CURVE":
            _undo_path(output, frame, world)


def follow_like(output: bpy.types.Object, other: bpy.types.Object) -> None:
    """Place an output as another output of the same source, as a child of the same parent.

    A parent that an artist chose stays.
    """
    if output.parent not in (None, other.parent):
        output.matrix_world = other.matrix_world
        return
    output.parent = other.parent
    if other.parent is not None:
        output.parent_type, output.parent_bone = other.parent_type, other.parent_bone
        _keep_scale(output)
    output.matrix_parent_inverse = other.matrix_parent_inverse.copy()
    output.matrix_basis = other.matrix_basis.copy()


def _keep_scale(output: bpy.types.Object) -> None:
    """Radii are lengths of the world, so a source that is scaled later must not stretch what was made of it.

    The locks show an artist that scaling the output by hand does nothing, either.
    """
    if _scale_of(output) is None:
        output.lock_scale = (True, True, True)
        limit = output.constraints.new("LIMIT_SCALE")
        limit.name, limit.owner_space = KEPT_SCALE, "WORLD"
        for axis in "xyz":
            for end in ("min", "max"):
                setattr(limit, f"use_{end}_{axis}", True)
                setattr(limit, f"{end}_{axis}", 1.0)


def _forget_scale(output: bpy.types.Object) -> None:
    if limit := _scale_of(output):
        output.constraints.remove(limit)
        output.lock_scale = (False, False, False)


def _scale_of(output: bpy.types.Object) -> bpy.types.Constraint | None:
    found = (c for c in output.constraints if c.type == "LIMIT_SCALE" and c.name == KEPT_SCALE)
    return next(found, None)


def _can_carry(source: bpy.types.Object, world: Matrix) -> bool:
    animated = source.type == "CURVE" and source.data.use_path and source.data.animation_data
    return _has_inverse(world) and not animated


def inverse_of(matrix: Matrix) -> Matrix:
    """The inverse, computed in float64: of large scales the determinant overflows in float32, and Blender's is NaN."""
    return Matrix(np.linalg.inv(np.array(matrix, np.float64)).tolist())


def _has_inverse(matrix: Matrix) -> bool:
    return bool(np.linalg.det(np.array(matrix, np.float64)) != 0.0)


def _undo_path(output: bpy.types.Object, frame: Matrix, world: Matrix) -> None:
    """Blender carries the children of a curve to the start of its path; take that back."""
    bpy.context.view_layer.update()
    carried = output.matrix_world @ frame.inverted() @ world
    if _has_inverse(carried):
        output.matrix_parent_inverse = inverse_of(carried)


def remember(
    output: bpy.types.Object,
    source: bpy.types.Object,
    points: int,
    duplicates: int,
    warnings: tuple[str, ...],
) -> None:
    """Store what every kind of output keeps: its source, and what was computed of it."""
    output[stored.SOURCE] = source
    output[stored.VERSION] = __version__
    output[stored.POINTS] = points
    output[stored.DUPLICATES] = duplicates
    output[stored.WARNINGS] = "\n".join(warnings)


def remove_object(thing: bpy.types.Object) -> None:
    """Remove an object, and its mesh unless something else shows it."""
    mesh = thing.data
    bpy.data.objects.remove(thing)
    if not mesh.users:
        bpy.data.meshes.remove(mesh)


def collection_of(
    marks: dict[str, Any],
    name: str,
    beside: bpy.types.Object | None = None,
    earlier: dict[str, Any] | None = None,
) -> bpy.types.Collection:
    """Return the collection with these properties, made next to an object, or in the scene, where there is none.

    `earlier` has the values of properties that earlier versions did not set.
    """
    unset = earlier or {}
    for found in bpy.data.collections:
        is_it = all(found.get(key, unset.get(key)) == value for key, value in marks.items())
        if is_it and found.library is None:
            return found
    made = bpy.data.collections.new(name)
    for key, value in marks.items():
        made[key] = value
    near = () if beside is None else beside.users_collection
    above = next((c for c in near if c.library is None), bpy.context.scene.collection)
    above.children.link(made)
    return made
