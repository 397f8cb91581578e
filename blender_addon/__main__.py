# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the command line: `python3 -m medial_axis ...`, `python3 FOLDER ...`, and inside any Blender
`blender --background [FILE] --python FOLDER/__main__.py -- ...`, where FOLDER is this package's.
"""

import os
import sys


def _cancel(_number: int, _frame: object) -> None:
    """Nothing is half made before the command line has begun, and nothing is left to do when it has ended."""
    os.write(2, b"medial_axis: cancelled\n")
    os._exit(4)


if __name__ == "__main__" and "bpy" not in sys.modules:
    # Ctrl-C and a polite kill from the first instant: to load NumPy takes a while, and so does `signal`, whose names
    # are made while it is loaded; what it wraps is part of Python itself.
    import _signal  # type: ignore[import-not-found,unused-ignore]

    for _number in (_signal.SIGINT, _signal.SIGTERM):
        _signal.signal(_number, _cancel)

import importlib  # noqa: E402
import importlib.util  # noqa: E402
import signal  # noqa: E402
from pathlib import Path  # noqa: E402

FOLDER = Path(__file__).resolve().parent


def package() -> str:
    """The name under which this folder is loaded; it is loaded where it is not.

    Never twice under two names, for the compiled module can be loaded only once.
    """
    if __package__:
        return __package__
    front = str(FOLDER / "__init__.py")
    for name, module in list(sys.modules.items()):
        if str(getattr(module, "__file__", "")) == front:
            return name
    name = "medial_axis"
    spec = importlib.util.spec_from_file_location(
        name, front, submodule_search_locations=[str(FOLDER)]
    )
    assert spec is not None and spec.loader is not None, "of a file of Python"
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return name


def main() -> int:
    try:
        cli = importlib.import_module(f"{package()}.cli")
    except ModuleNotFoundError as error:
        if error.name != "numpy":
            raise
        print(
            f"medial_axis: Expected NumPy for {sys.executable}, found none; install it",
            file=sys.stderr,
        )
        return 1
    if cli.inside_blender():
        return cli.run()
    code: int = cli.main(sys.argv[1:])
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_IGN)  # what is done is done
    return code


if __name__ == "__main__":
    sys.exit(main())
