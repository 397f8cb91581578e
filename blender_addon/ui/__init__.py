# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's user interface: properties, operators, panels, menus. No geometry."""

from __future__ import annotations

from types import ModuleType

from ..core.machine import native


def _modules() -> tuple[ModuleType, ...]:
    from . import (
        apply_later,
        asset_library,
        auto_update,
        balls,
        command,
        compute_sequence,
        convert_to_curve,
        current_job,
        export_axis,
        export_thickness,
        guide,
        hollow,
        import_points,
        inward_faces,
        legend,
        manual,
        menus,
        mid_surface,
        node_groups,
        operators,
        panels,
        parts,
        plain_words,
        preferences,
        presets,
        properties,
        rebuild,
        reduce,
        self_test_operator,
        settings_panels,
        show,
        simplify_to_gap,
        skeleton_operators,
        skeleton_panel,
        thicken,
        thickness_limits,
        thickness_operators,
        thickness_panel,
        thickness_properties,
        translation,
    )

    return (
        translation,
        apply_later,
        properties,
        thickness_properties,
        self_test_operator,
        asset_library,
        plain_words,
        preferences,
        operators,
        auto_update,
        skeleton_operators,
        thickness_limits,
        thickness_operators,
        thicken,
        hollow,
        export_axis,
        export_thickness,
        import_points,
        inward_faces,
        presets,
        legend,
        show,
        guide,
        panels,  # the panels in their order
        parts,
        skeleton_panel,
        thickness_panel,
        rebuild,
        balls,
        settings_panels,
        compute_sequence,
        reduce,
        mid_surface,
        convert_to_curve,
        simplify_to_gap,
        node_groups,
        menus,
        manual,
        current_job,
        command,
    )


def register() -> None:
    native.load_a_copy = not __package__.startswith(
        "bl_ext."
    )  # then the add-on is not an extension
    for module in _modules():
        module.register()


def unregister() -> None:
    for module in reversed(_modules()):
        module.unregister()
