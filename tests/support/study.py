# SPDX-License-Identifier: GPL-3.0-or-later
"""The compiled module _medial_study, which is not shipped: the stages by themselves, and the methods of others.

It lies in build/release, or in the folder that MEDIAL_AXIS_STUDY names. Its objects are none of those of `_medial`.
"""

import importlib.util
import os
from functools import cache
from importlib.machinery import EXTENSION_SUFFIXES
from pathlib import Path
from types import ModuleType

NAME = "_medial_study"
FOLDER = Path(__file__).resolve().parents[2] / "build" / "release"


@cache
def load() -> ModuleType:
    path = Path(os.environ.get("MEDIAL_AXIS_STUDY", FOLDER)) / (NAME + EXTENSION_SUFFIXES[0])
    if not path.is_file():
        raise FileNotFoundError(f"Expected {path}, found none; build with -DMEDIAL_TESTS=ON")
    spec = importlib.util.spec_from_file_location(NAME, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
