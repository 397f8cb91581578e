# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the presets of the panel, as Blender writes such files itself: every setting, one a line.

    python3 tools/packaging/presets.py FOLDER

Needs Python 3.10, because it reads the defaults from the add-on's settings.
"""

from __future__ import annotations

import dataclasses
import math
import sys
from enum import Enum
from pathlib import Path

# Each preset lists the settings that differ from the defaults.
PRESETS: dict[str, dict[str, object]] = {
    "As_in_the_Paper": {"form": "PUBLISHED", "sampling": "VERTICES"},
    "Curve": {"form": "CURVE"},
    "Defaults": {},
    "Low_Poly": {"sharp_angle": math.pi / 3},
    "Noisy_Scan": {"rule": "BOTH"},
    "Thin_Parts": {"sampling": "ADAPTIVE"},
    "Tubes_and_Fingers": {"form": "PUBLISHED", "rho": 16.0, "limit_set": True},
}


def write_presets(folder: Path, defaults: dict[str, object]) -> None:
    """One file per preset; `defaults` has every setting, by name."""
    folder.mkdir(parents=True)
    for name, changes in PRESETS.items():
        if unknown := set(changes) - set(defaults):
            raise KeyError(f"preset {name}: no setting is called {', '.join(sorted(unknown))}")
        (folder / f"{name}.py").write_text(preset({**defaults, **changes}), encoding="utf-8")


def preset(values: dict[str, object]) -> str:
    lines = [f"settings.{name} = {written(value)}" for name, value in values.items()]
    head = ["import bpy", "", "settings = bpy.context.scene.medial_axis", ""]
    return "\n".join([*head, *lines, ""])


def written(value: object) -> str:
    """A value as Python reads it; strings in double quotes, as the rest of the sources has them."""
    return f'"{value}"' if isinstance(value, str) else repr(value)


def defaults() -> dict[str, object]:
    """The default of every setting, from their one home."""
    sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
    from blender_addon.core.settings import Settings

    values = {field.name: getattr(Settings(), field.name) for field in dataclasses.fields(Settings)}
    return {
        name: value.name if isinstance(value, Enum) else value for name, value in values.items()
    }


if __name__ == "__main__":
    sys.dont_write_bytecode = True
    write_presets(Path(sys.argv[1]), defaults())
