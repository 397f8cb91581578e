# SPDX-License-Identifier: GPL-3.0-or-later
"""Self-Test: a known medial axis is computed, and each check reports its result."""

import bpy

from ...bridge.self_test import self_test
from ..base.translation import say

_last = []  # the checks of the last test, for the preferences


def last():
    """The checks of the last test; none before the first."""
    return tuple(_last)


class WM_OT_medial_axis_self_test(bpy.types.Operator):
    bl_idname = "wm.medial_axis_self_test"
    bl_label = "Self-Test"
    bl_description = (
        "Compute the medial axis of a box and compare it with what is known of it; takes a second"
    )

    def execute(self, _context):
        _last[:] = self_test()
        for check in _last:
            if check.passed:
                self.report({"INFO"}, say(f"Passed: {check.found}"))
        failed = [say(f"Failed: {check.found}") for check in _last if not check.passed]
        if failed:
            self.report({"ERROR"}, "\n".join(failed))
            return {"CANCELLED"}
        return {"FINISHED"}
