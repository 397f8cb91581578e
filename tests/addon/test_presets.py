# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets of the panel: those that come with the add-on, and the user's own."""

import math
from pathlib import Path

import bpy
import pytest
from installed import addon

FOLDER = Path(addon().__file__).parent / "presets" / "medial_axis"
# The settings in which each preset differs from the defaults.
SHIPPED = {
    "As_in_the_Paper": {"form": "PUBLISHED", "sampling": "VERTICES"},
    "Curve": {"form": "CURVE"},
    "Defaults": {},
    "Low_Poly": {"sharp_angle": math.pi / 3},
    "Noisy_Scan": {"rule": "BOTH"},
    "Thin_Parts": {"sampling": "ADAPTIVE"},
    "Tubes_and_Fingers": {"form": "PUBLISHED", "rho": 16.0, "limit_set": True},
}
OTHERS = {"theta": 0.1, "side": "OUTER", "samples": 777, "smooth": False, "seed": 5}


def execute(path):
    menu = "VIEW3D_PT_medial_axis_presets"
    done = bpy.ops.script.execute_preset(filepath=str(path), menu_idname=menu)
    assert done == {"FINISHED"}


def set_all(values):
    for name, value in values.items():
        setattr(bpy.context.scene.medial_axis, name, value)


def expected(changes):
    settings = addon("core.settings")
    kinds = {name: type(settings.OPTIONS[name].default) for name in changes}
    values = {name: kinds[name][v] if isinstance(v, str) else v for name, v in changes.items()}
    return settings.Settings(**values)


def shown():
    return addon("ui.settings.properties").settings_from(bpy.context.scene.medial_axis)


def drawn(monkeypatch):
    """Names and files that the menu of presets shows."""
    files = {}

    def record(_self, paths, operator, **_options):
        assert operator == "script.execute_preset"
        for folder in map(Path, paths):
            files.update((file.stem, file) for file in folder.glob("*.py"))

    panel = addon("ui.settings.presets").VIEW3D_PT_medial_axis_presets
    names = ("preset_subdir", "preset_operator", "path_menu")
    menu = type("Menu", (), {name: getattr(panel, name) for name in names})
    monkeypatch.setattr(bpy.types.Menu, "path_menu", record)
    bpy.types.Menu.draw_preset(menu(), bpy.context)
    return files


def test_shipped_presets_are_these():
    assert sorted(file.stem for file in FOLDER.iterdir() if file.suffix == ".py") == sorted(SHIPPED)


@pytest.mark.parametrize("name", SHIPPED)
def test_shipped_presets_say_every_setting(name):
    set_all(OTHERS)
    execute(FOLDER / f"{name}.py")
    settings, wanted = shown(), expected(SHIPPED[name])
    for option in addon("core.settings").OPTIONS:
        value = getattr(wanted, option)
        same = pytest.approx(value, rel=1e-6) if isinstance(value, float) else value
        assert getattr(settings, option) == same


def test_menu_shows_what_is_shipped_and_what_was_added(monkeypatch):
    assert {name: FOLDER / f"{name}.py" for name in SHIPPED} == drawn(monkeypatch)
    set_all(OTHERS)
    assert bpy.ops.scene.medial_axis_preset_add(name="My Own") == {"FINISHED"}
    mine = drawn(monkeypatch)["My_Own"]
    assert mine.is_relative_to(bpy.utils.user_resource("SCRIPTS"))
    kept = shown()
    execute(FOLDER / "Defaults.py")
    assert shown() != kept
    execute(mine)
    assert shown() == kept
    bpy.ops.scene.medial_axis_preset_add(name="My_Own", remove_name=True)
    assert not mine.exists() and set(drawn(monkeypatch)) == set(SHIPPED)


def test_operators_have_presets_of_their_own():
    for name in ("OBJECT_OT_medial_axis", "EXPORT_SCENE_OT_medial_axis"):
        assert "PRESET" in getattr(bpy.types, name).bl_options
