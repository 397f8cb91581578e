# SPDX-License-Identifier: GPL-3.0-or-later
"""The object that the panels of the result and of its look describe."""

from ...bridge.skeleton.sequence_objects import FRAME
from ..settings.properties import shown_report, shown_result


def shown_frame(context):
    """The active object, where it is a frame of a sequence."""
    active = context.object
    return active if active is not None and FRAME in active else None


def shown_thing(context):
    """A frame of a sequence, a medial axis, or a report."""
    return shown_frame(context) or shown_result(context) or shown_report(context)
