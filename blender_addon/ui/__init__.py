"""Blender's user interface: properties, operators, panels, menus. No geometry."""

from __future__ import annotations

from types import ModuleType


def _modules() -> tuple[ModuleType, ...]:
    from . import (
        command,
        export,
        import_points,
        manual,
        menus,
        operators,
        panels,
        preferences,
        presets,
        properties,
        running,
        self_test,
        sequence,
        translation,
    )

    return (
        translation,
        properties,
        self_test,
        preferences,
        operators,
        export,
        import_points,
        presets,
        panels,
        sequence,
        menus,
        manual,
        running,
        command,
    )


def register() -> None:
    for module in _modules():
        module.register()


def unregister() -> None:
    for module in reversed(_modules()):
        module.unregister()
