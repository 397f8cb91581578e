# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors and warnings in the words of the window: a line that begins with what to do or what was found.

The library's sentences say what was expected, what was found and what to do, for whoever reads a log. Here they are
behind the question mark, and scripts get them whole.
"""

import re
import textwrap

import bpy

from ...core.axis.verdict import in_short
from ...core.errors import MedialAxisError
from .translation import say
from .wrapped_text import draw_wrapped

_KINDS = {"FONT": "text", "META": "metaball"}  # the others are called as Blender calls them
_DEPTH = {"FONT": "give it Extrude", "CURVE": "give it Bevel", "SURFACE": "give it Solidify"}
# The line for a sentence with these words; {kind} is what the object is, and {depth} what makes it a solid.
_LINES = {
    "in one plane": "This {kind} is flat: {depth}",
    "on one line": "This {kind} is a line: {depth}",
    "found only lines": "This {kind} has no faces: {depth}",
    "found an open sheet": "This {kind} is open: add Solidify, or choose Side: Both",
    "the compiled module for": "This zip is for another Blender: install the one for yours",
}
# The stages of a computation that are not building, by what they do; there are some forty of them.
_STAGES = {
    "Sampling": (
        "Preparing",
        "Samples",
        "Sampling",
        "Sharp edges",
        "Walls",
        "Buried surface",
        "Openings",
    ),
    "Cleaning": ("Fire", "Fringe", "Values", "Limbs", "Level", "Topology", "Collapse of edges"),
    "Drawing": ("Wires", "Curves", "Surface", "Surface of the balls", "Faces"),
}
_SENTENCE = re.compile(r"Expected (.+?), (?:found|but) .+?(?:; (.+))?", re.DOTALL)
_NAMED = re.compile(r"('[^']+'): (.+)", re.DOTALL)


def in_one_line(sentence, kind="MESH"):
    """The words of the window for a sentence of the library; `kind` is the type of the object that it is about."""
    if named := _NAMED.fullmatch(sentence):
        thing = bpy.data.objects.get(named[1].strip("'"))
        line = in_one_line(named[2], kind if thing is None else thing.type)
        return line if line.startswith("This ") else f"{named[1]}: {line}"
    for part, line in _LINES.items():
        if part in sentence:
            depth = _DEPTH.get(kind, "add Solidify")
            return line.format(kind=_KINDS.get(kind, kind.lower()), depth=depth) + "."
    if found := _SENTENCE.fullmatch(sentence):
        wanted, remedy = found.groups()
        return _capital(_first(remedy)) if remedy else f"This needs {wanted}."
    return sentence


def warned(warning):
    """The words of the window for a warning: what was found."""
    return in_short(_capital(warning))


def draw_told(context, layout, sentence, icon, plain=in_one_line):
    """A sentence in one line of plain words, and a question mark beside it that has the rest, if there is any."""
    line = plain(sentence)
    row = layout.row(align=True)
    draw_wrapped(context, row, line, icon, beside=20)
    if line.rstrip(".") != sentence.rstrip("."):
        more = row.operator("wm.medial_axis_more", text="", icon="QUESTION", emboss=False)
        more.text = say(sentence)


def told(sentence):
    """A sentence as operators report it: its one line in a window, and all of it to scripts."""
    return say(sentence if bpy.app.background else in_one_line(str(sentence)))


class Needing:
    """An operator that needs what its `find(context)` finds; where that is None, it says what to select."""

    needs = "Select a medial axis, or an object whose medial axis was computed before"

    @classmethod
    def poll(cls, context):
        found = cls.find(context)
        if found is None:
            cls.poll_message_set(say(cls.needs))
        return found is not None


class Telling:
    """An operator whose `run(context)` returns a sentence, or nothing; errors are told, and end it."""

    def execute(self, context):
        try:
            sentence = self.run(context)
        except MedialAxisError as error:
            self.report({"ERROR"}, told(error))
            return {"CANCELLED"}
        if sentence:
            self.report({"INFO"}, say(sentence))
        return {"FINISHED"}


def doing(stage):
    """A word for what a computation does in a stage; before it, which of several objects it is."""
    which, found, name = stage.rpartition(": ")
    word = next((word for word, names in _STAGES.items() if name in names), "Building")
    return f"{which}{found}{say(word)}" if " of " in which else say(word)


def _first(remedy):
    """The first of the things that can be done, without what is in brackets."""
    plain = re.sub(r" \([^)]*\)", "", remedy)
    return re.split(r",? or |[,;] ", plain)[0]


def _capital(text):
    return text[:1].upper() + text[1:].rstrip(".") + "."


class WM_OT_medial_axis_more(bpy.types.Operator):
    bl_idname = "wm.medial_axis_more"
    bl_label = "More"
    bl_description = "The whole sentence"
    bl_options = {"INTERNAL"}

    text: bpy.props.StringProperty(options={"HIDDEN", "SKIP_SAVE"})

    def execute(self, _context):
        return {"FINISHED"}

    def invoke(self, context, _event):
        return context.window_manager.invoke_popup(self, width=_PIXELS)

    def draw(self, _context):
        column = self.layout.column(align=True)
        for line in textwrap.wrap(self.text, _WIDTH):
            column.label(text=line, translate=False)


_WIDTH, _PIXELS = 65, 450  # letters and pixels of the window that the question mark opens
