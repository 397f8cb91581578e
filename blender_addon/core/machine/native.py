# SPDX-License-Identifier: GPL-3.0-or-later
"""The compiled module `_medial` is loaded when it is first needed; `lib/` has one file per Python ABI.

Where it has none for this Python, the module of the library's wheel is taken, if that has the same version.
"""

from __future__ import annotations

import importlib
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.machinery import EXTENSION_SUFFIXES, ExtensionFileLoader
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

from ..errors import (
    Cancelled,
    DegenerateInputError,
    InvalidInputError,
    NativeModuleError,
    out_of_memory,
)

LIB = Path(__file__).resolve().parents[2] / "lib"
NAME = "_medial"

# If this is set, the module is loaded from a copy in memory. The user interface sets it if the add-on is no extension:
# Blender then updates it by overwriting its files, and overwriting a mapped file crashes Blender.
load_a_copy = False

_package = __package__.removesuffix(".core.machine")
_module: ModuleType | None = None
# This is the reason why the existing file does not load; it is kept because trying again would not help.
_failure: str = ""


def load() -> ModuleType:
    """Return the compiled module.

    Raises
    ------
    NativeModuleError
        There is no file for this Python, or it does not load.
    """
    global _module, _failure
    if _module is None:
        if reason := problem():
            raise NativeModuleError(reason)
        try:
            _module = _imported(f"{_package}.lib.{NAME}")
        except ImportError as error:
            if isinstance(error.__cause__, KeyboardInterrupt):  # the file is not broken
                raise error.__cause__ from None
            _failure = (
                f"Expected a compiled module for {expected_abi()} that loads, but the system says "
                f"'{error}'; install the add-on's zip made for this system"
            )
            raise NativeModuleError(_failure) from error
    return _module


def _imported(name: str) -> ModuleType:
    """Return the module from its file, or from a copy in memory if `load_a_copy` is set and the system allows it.

    Some systems refuse files in memory, or libraries in them. The module is then loaded from its file, with the same
    results.
    """
    original = file()
    if load_a_copy and original and name not in sys.modules and hasattr(os, "memfd_create"):
        try:
            return _imported_from_memory(name, original)
        except (OSError, ImportError):
            pass  # the import below reports an error of the file itself
    if original and original.parent != LIB:
        return _imported_from(name, str(original))
    return importlib.import_module(name)


def _imported_from_memory(name: str, original: Path) -> ModuleType:
    copy = os.memfd_create(NAME)
    try:
        with open(copy, "wb", closefd=False) as stream:
            stream.write(original.read_bytes())
        return _imported_from(name, f"/proc/self/fd/{copy}")
    finally:
        os.close(copy)


def _imported_from(name: str, path: str) -> ModuleType:
    loader = ExtensionFileLoader(name, path)
    spec = spec_from_file_location(name, path, loader=loader)
    assert spec is not None  # every loader has one
    module = module_from_spec(spec)
    loader.exec_module(module)
    sys.modules[name] = module
    return module


@contextmanager
def own_errors() -> Iterator[ModuleType]:
    """Give the compiled module, and translate its errors to the add-on's own, which exist without the module."""
    module = load()
    try:
        yield module
    except module.InvalidInputError as error:
        raise InvalidInputError(str(error)) from error
    except module.DegenerateInputError as error:
        raise DegenerateInputError(str(error)) from error
    except module.Cancelled as error:
        raise Cancelled(str(error)) from error
    except MemoryError as error:
        raise out_of_memory() from error


def problem() -> str:
    """Return why `load` would fail, in one sentence, or "". It loads nothing and is cheap enough for a panel."""
    if _module is not None or _failure:
        return _failure
    if file() is not None:
        return ""
    found = ", ".join(found_abis()) or "none"
    return (
        f"Expected the compiled module for {expected_abi()}, found {found}; "
        "install the add-on's zip made for this Blender and system"
    )


def file() -> Path | None:
    """Return the compiled module that `load` takes, or None."""
    return _file_in(LIB) or _file_in(_folder_of_wheel())


def _file_in(folder: Path | None) -> Path | None:
    files = (folder / f"{NAME}{suffix}" for suffix in EXTENSION_SUFFIXES) if folder else ()
    return next((file for file in files if file.is_file()), None)


def _folder_of_wheel() -> Path | None:
    """Return the folder of compiled modules in this library's wheel, from which Blender installs it for an extension.

    A wheel of another version is not taken, because its functions may be others.
    """
    from importlib import metadata  # loaded only where lib/ has no module

    try:
        wheel = metadata.distribution("medial-axis")
    except metadata.PackageNotFoundError:
        return None
    version = getattr(sys.modules[_package], "__version__", None)
    return Path(str(wheel.locate_file("medial_axis/lib"))) if wheel.version == version else None


def expected_abi() -> str:
    """Return the tag in the file name of modules for this Python, such as 'cpython-311-x86_64-linux-gnu'."""
    return _tag(EXTENSION_SUFFIXES[0])


def found_abis() -> list[str]:
    """Return the tags of the compiled modules that are installed."""
    files = [*LIB.glob(f"{NAME}.*.so"), *LIB.glob(f"{NAME}.*.pyd")]
    return sorted(_tag(file.name.removeprefix(NAME)) for file in files)


def _tag(suffix: str) -> str:
    return suffix.strip(".").rpartition(".")[0]
