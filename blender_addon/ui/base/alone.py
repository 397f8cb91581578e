# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators whose product fills the place of what it is made of: it is seen alone."""

import bpy


class Alone:
    """An operator that hides what its product takes the place of; a button does so when the product is new."""

    alone: bpy.props.BoolProperty(
        name="Alone",
        description="Hide what fills the same place, and select what was made",
        default=False,
        options={"SKIP_SAVE"},
    )
