# SPDX-License-Identifier: GPL-3.0-or-later
"""The medial axis of meshes and point clouds: an add-on of Blender, and a package that needs no Blender.

    import medial_axis
    found = medial_axis.compute(points, triangles)

Importing this package is cheap: NumPy and the compiled module are first touched by the first name that needs them
(library.py), `bpy` by `register`.
"""

# The constant of `typing`, which type checkers recognise by its name. Loading `typing` itself takes time in which
# Ctrl-C would still print Python's traceback.
TYPE_CHECKING = False

bl_info = {
    "name": "Medial Axis",
    "author": "Medial Axis contributors",
    "version": (0, 3, 0),
    "blender": (3, 4, 0),
    "location": "3D Viewport > Sidebar > Medial Axis, and Object > Compute Medial Axis",
    "description": "Compute the medial axis of meshes and point clouds, with radii",
    "category": "Object",
}

COMMIT = ""  # tools/packaging fills it in for a development build
__version__ = ".".join(str(part) for part in bl_info["version"]) + (COMMIT and f"+{COMMIT}")

# The public names of library.py, known without loading it.
__all__ = [
    "BallCover",
    "Balls",
    "Cancelled",
    "Computation",
    "CoverMode",
    "CoverShapes",
    "Criteria",
    "DegenerateInputError",
    "EachPart",
    "ExportError",
    "Form",
    "InvalidInputError",
    "MedialAxis",
    "MedialAxisError",
    "NativeModuleError",
    "OutOfMemoryError",
    "Progress",
    "ReadError",
    "Reconstruction",
    "Rule",
    "SamplingMode",
    "Settings",
    "Shape",
    "Side",
    "SidesFrom",
    "compute",
    "compute_each_part",
    "cover_by_balls",
    "extract",
    "read",
    "read_axis",
    "reconstruct",
    "reduce",
    "write",
    "write_balls",
]

if TYPE_CHECKING:
    from .library import *  # noqa: F403
else:  # type checkers would let every name pass

    def __getattr__(name: str) -> object:
        """The names of the library, imported when one is first used."""
        if name not in __all__:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        from . import library

        return getattr(library, name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


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
