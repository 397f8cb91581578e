# SPDX-License-Identifier: GPL-3.0-or-later
"""The language of the user interface.

Blender translates labels and descriptions by itself. Sentences from below the user interface are English; `say`
recognises them by their words, whatever names and figures are between these.
"""

import ast
import re
from functools import cache, lru_cache
from pathlib import Path

import bpy

from ...core.files.names import shown

_ADDON = __package__.removesuffix(".ui.base")
_FOLDER = Path(__file__).resolve().parents[2] / "translations"
_ENTRY = re.compile(r"^msgid (\".+\")\nmsgstr (\".+\")$", re.MULTILINE)  # of a .po file
CONTEXT = (
    "Medial Axis"  # in this context our own words take precedence over Blender's for the same text
)
PROBE = "Compute Medial Axis"  # every language translates it differently
# For properties; Blender before 4.0 or so shows its own words for a few short labels.
IN_CONTEXT = (
    {"translation_context": CONTEXT}
    if "translation_context" in bpy.props.IntProperty.__doc__
    else {}
)
_CONTEXTS = ("*", "Operator", CONTEXT)


def say(text) -> str:
    """A sentence in the language of the user interface; parts without a translation stay English."""
    text = shown(str(text))  # Blender takes text only, and names of files are bytes
    language = _translated(PROBE)
    return text if language == PROBE else _said(text, language)


@lru_cache(maxsize=512)
def _said(text, language):
    """The translation of a sentence; `language` is only there to keep the cached ones of two languages apart."""
    templates = _templates()
    if text in templates:
        return _translated(text)
    for template, (begin, pattern, named) in templates.items():
        if text.startswith(begin) and (found := re.fullmatch(pattern, text, re.DOTALL)):
            parts = (
                part if name else _said(part, language)
                for part, name in zip(found.groups(), named, strict=True)
            )
            return _translated(template).format(*parts)
    if "; " in text:
        return "; ".join(_said(part, language) for part in text.split("; "))
    return text


def _translated(text):
    return bpy.app.translations.pgettext_iface(text, CONTEXT)


@cache
def languages():
    """{locale: {text: translation}}, one of each `.po` file; each text in one line there."""
    return {
        file.stem: {
            ast.literal_eval(text): ast.literal_eval(other)
            for text, other in _ENTRY.findall(file.read_text(encoding="utf-8"))
        }
        for file in sorted(_FOLDER.glob("*.po"))
    }


@cache
def _templates():
    """{template: (begin, pattern, whether each {} is a name in quotes)}, those with the most words first."""
    known = {template for texts in languages().values() for template in texts}
    found = {}
    for template in sorted(known, key=lambda text: (-len(text.replace("{}", "")), text)):
        pieces = template.split("{}")
        named = [piece.endswith("'") for piece in pieces[:-1]]
        # Only at the end, or as a name, can a part be several sentences.
        parts = ["(.+?)" if name else "((?:(?!; ).)+?)" for name in named]
        if not pieces[-1]:
            parts[-1] = "(.+)"
        pattern = re.escape(pieces[0]) + "".join(
            part + re.escape(piece) for part, piece in zip(parts, pieces[1:], strict=True)
        )
        found[template] = pieces[0], pattern, named
    return found


def register():
    translations = {
        locale: {(context, text): other for text, other in texts.items() for context in _CONTEXTS}
        for locale, texts in languages().items()
    }
    bpy.app.translations.register(_ADDON, translations)


def unregister():
    bpy.app.translations.unregister(_ADDON)
