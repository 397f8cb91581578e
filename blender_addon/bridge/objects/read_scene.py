# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that Blender reads -> the shapes in them, for the command line. No user interface."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import bpy

from ...core.errors import InvalidInputError, ReadError
from ...core.shape.shape import Shape
from ..mesh import stored
from .read_object import SAMPLED_TYPES, SOURCE_TYPES, read_object

# Extension -> operators that import it, the first one that this Blender has.
_IMPORTERS = {
    ".abc": ("wm.alembic_import",),
    ".fbx": ("wm.fbx_import", "import_scene.fbx"),
    ".glb": ("import_scene.gltf",),
    ".gltf": ("import_scene.gltf",),
    ".usd": ("wm.usd_import",),
    ".usda": ("wm.usd_import",),
    ".usdc": ("wm.usd_import",),
    ".usdz": ("wm.usd_import",),
    ".x3d": ("import_scene.x3d",),
}


def open_file() -> str:
    """The path of the file that is open; "" when it was never saved."""
    return bpy.data.filepath


def load(path: str, allow_scripts: bool = False) -> None:
    """Open a .blend file, or import another one into an empty file; what was open is gone.

    With `allow_scripts` Python in a .blend file may run: registered text blocks, and drivers that are more than simple
    expressions. It is always said, so that no preference of the machine decides.
    """
    if not Path(path).is_file():
        raise ReadError(f"Expected a file, found none at '{path}'; choose another one")
    path = str(Path(path).resolve())
    try:
        if path.lower().endswith(".blend"):
            bpy.ops.wm.open_mainfile(filepath=path, load_ui=False, use_scripts=allow_scripts)
            return
        operator = _importer(path)
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        operator(filepath=path)
    except RuntimeError as error:
        said = _reason(str(error))
        raise ReadError(
            f"Expected to read '{path}', but Blender says '{said}'; choose another file"
        ) from error


def names(wanted: Sequence[str] | None) -> list[str]:
    """The objects that are wanted; without wishes all that are visible and were not made by this add-on.

    Raises InvalidInputError where there are none, or not all that are wanted.
    """
    there = bpy.context.view_layer.objects
    if wanted:
        missing = [name for name in wanted if name not in there]
        if missing:
            known = ", ".join(thing.name for thing in there if thing.type in SOURCE_TYPES)
            raise InvalidInputError(
                f"Expected an object '{missing[0]}', found {known or 'none'}; choose one of these"
            )
        return list(dict.fromkeys(wanted))
    found = [
        thing.name
        for thing in there
        if thing.type in SAMPLED_TYPES and thing.visible_get() and stored.VERSION not in thing
    ]
    if not found:
        raise InvalidInputError(
            "Expected a visible mesh or point cloud, found none; name an object with --object"
        )
    return found


def read(name: str, frame: int | None) -> tuple[Shape, tuple[str, ...]]:
    """An object as it is at a frame; None: at the one at which the file was saved."""
    scene = bpy.context.scene
    if frame is not None and scene.frame_current != frame:
        scene.frame_set(frame)
    thing = bpy.context.view_layer.objects.get(name)
    if thing is None:
        raise InvalidInputError(f"Expected the object '{name}', found it gone; start again")
    return read_object(thing, bpy.context.evaluated_depsgraph_get()), ()


def _reason(text: str) -> str:
    """Why an operator failed: its message, or the last line of a traceback."""
    lines = [line for line in text.strip().splitlines() if not line.startswith("Location:")]
    return lines[-1].removeprefix("Error: ") if lines else "nothing"


def _importer(path: str) -> object:
    suffix = Path(path).suffix.lower()
    for name in _IMPORTERS.get(suffix, ()):
        group, _, operator = name.partition(".")
        if operator in dir(getattr(bpy.ops, group)):
            return getattr(getattr(bpy.ops, group), operator)
    raise ReadError(
        f"Expected .blend, {', '.join(_IMPORTERS)} or a file of points, as far as this Blender "
        f"reads them, found '{Path(path).name}'; save it as .ply or .obj"
    )
