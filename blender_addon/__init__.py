"""The medial axis of meshes and point clouds inside Blender, computed by a compiled core.

Importing this package needs no Blender; `bpy` is first touched by `register`.
"""

bl_info = {
    "name": "Medial Axis",
    "author": "Medial Axis contributors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D Viewport > Sidebar > Medial Axis, and Object > Compute Medial Axis",
    "description": "Compute the medial axis of meshes and point clouds, with radii",
    "category": "Object",
}

__version__ = ".".join(str(part) for part in bl_info["version"])


def register() -> None:
    from . import ui

    ui.register()


def unregister() -> None:
    from . import ui

    ui.unregister()
    _forget_modules()


def _forget_modules() -> None:
    """Let the next `register` import an update; only the compiled module cannot be replaced."""
    import sys

    compiled = f"{__package__}.lib"
    for name in [name for name in sys.modules if name.startswith(f"{__package__}.")]:
        if name != compiled and not name.startswith(f"{compiled}."):
            del sys.modules[name]
            globals().pop(name.removeprefix(f"{__package__}."), None)
