# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's user interface: properties, operators, panels, menus. No geometry."""

from __future__ import annotations

from types import ModuleType

from ..core.machine import native


def _modules() -> tuple[ModuleType, ...]:
    from . import balls, hollow, mid_surface, rebuild, reduce
    from .axis import (
        auto_update,
        compute_sequence,
        convert_to_curve,
        export_axis,
        import_points,
        inward_faces,
        node_groups,
        operators,
        parts,
        simplify_to_gap,
    )
    from .base import command, current_job, legend, manual, plain_words, show, translation
    from .panels import menus, panels, settings_panels
    from .settings import (
        apply_later,
        asset_library,
        guide,
        preferences,
        presets,
        properties,
        self_test_operator,
    )
    from .skeleton import skeleton_operators, skeleton_panel
    from .thickness import (
        export_thickness,
        thicken,
        thickness_limits,
        thickness_operators,
        thickness_panel,
        thickness_properties,
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
