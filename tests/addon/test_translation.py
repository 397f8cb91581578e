# SPDX-License-Identifier: GPL-3.0-or-later
"""The user interface in German: entries are valid, and sentences find theirs; texts without an entry stay English."""

import bpy
import pytest
from installed import MODULE, addon
from scene import ellipsoid, link, press
from test_rows import Layout, seen


def entries():
    return addon("ui.base.translation").languages()["de_DE"]


def say(text):
    return addon("ui.base.translation").say(text)


def filled(text):
    return text.format(*"12345678")


@pytest.fixture
def german():
    """Blender speaks German."""
    view = bpy.context.preferences.view
    kept = view.language
    try:
        view.language = "de_DE"
    except TypeError:  # the bpy of some versions comes without Blender's own translations
        pytest.skip("this Blender speaks English only")
    yield
    view.language = kept


def test_translations_have_as_many_places_as_texts():
    for text, other in entries().items():
        assert text.count("{}") == other.count("{}"), text
        assert other and other == other.strip(), text
    file = addon("ui.base.translation")._FOLDER / "de_DE.po"
    assert file.read_text(encoding="utf-8").count('\nmsgid "') == len(entries()) + 1  # none twice


def test_english_is_left_as_it_is():
    for text in map(filled, entries()):
        assert say(text) == text


def test_english_sentences_are_not_looked_up(monkeypatch):
    module = addon("ui.base.translation")
    monkeypatch.setattr(module, "_said", lambda *words: pytest.fail("looked up"))
    assert say("1 of 2: Poles") == "1 of 2: Poles"


def test_every_language_says_the_probe_in_another_way():
    module = addon("ui.base.translation")
    said = [module.PROBE, *(texts[module.PROBE] for texts in module.languages().values())]
    assert len(set(said)) == len(said) >= 2


def test_properties_have_our_words_and_not_those_of_blender(german):
    """Blender itself says Punkte for Vertices, which we need for Points."""
    owners = (
        bpy.ops.object.medial_axis.get_rna_type(),
        bpy.context.scene.medial_axis.bl_rna,
        bpy.context.preferences.addons[MODULE].preferences.bl_rna,
    )
    context = addon("ui.base.translation").CONTEXT
    for name in ("sampling", "side", "smooth", "samples", "cache_size"):
        found = [owner.properties[name] for owner in owners if name in owner.properties]
        expected = context if addon("ui.base.translation").IN_CONTEXT else "*"
        assert found and {prop.translation_context for prop in found} == {expected}
    translated = bpy.app.translations.pgettext_iface("Vertices", context)
    assert translated == say("Vertices") == entries()["Vertices"] == "Ecken"


def test_operators_are_translated_in_their_own_context(german):
    name = bpy.app.translations.pgettext_iface("Compute Medial Axis", "Operator")
    assert name == "Mediale Achse berechnen"


def test_every_sentence_is_translated(german):
    for text, other in entries().items():
        assert text == "'{}': {}" or say(filled(text)) == filled(other)


@pytest.mark.parametrize(
    ("text", "other"),
    [
        ("'Cube': as chosen", "'Cube': wie gewählt"),
        (
            "'Surface': the faces are closed; 0.12 s",
            "'Surface': die Flächen sind geschlossen; 0.12 s",
        ),
        (
            "Inside from Surface: the mesh is open at 1,234 edges",
            "Innen nach Oberfläche: das Mesh ist an 1,234 Kanten offen",
        ),
        (
            "The 162 vertices, dense enough; Epsilon: median 0.40, 95 % below 0.44, 0 % above 0.25; "
            "with sharp edges 12 %",
            "Die 162 Ecken, dicht genug; Epsilon: Median 0.40, 95 % unter 0.44, 0 % über 0.25; "
            "mit scharfen Kanten 12 %",
        ),
        ("1 of 2: Poles", "1 von 2: Pole"),
        (
            "1,500 samples of the surface: the walls are thin: samples in pairs in 2 passes; "
            "the numbers of the faces are not reached within the budget",
            "1,500 Abtastpunkte der Oberfläche: die Wände sind dünn: Abtastpunkte in Paaren in 2 "
            "Durchgängen; die Zahlen der Flächen werden mit der Höchstzahl nicht erreicht",
        ),
        (
            "Minimum 0.2; 3.1 % of the area thinner than 0.25; all walls are good",
            "Minimum 0.2; 3.1 % der Oberfläche dünner als 0.25; all walls are good",
        ),
        (
            "The least thickness was 0.2 and is 0.3; 3.1 % of the area is still thinner than 0.4",
            "Die kleinste Dicke war 0.2 und ist 0.3; 3.1 % der Oberfläche sind noch dünner als 0.4",
        ),
        (
            "noise of about 0.5 spacings was found, too much for so many points: scan more finely, "
            "or fit the scans to each other",
            "Rauschen von etwa 0.5 Punktabständen wurde gefunden, zu viel für so viele Punkte: feiner "
            "abtasten, oder die Scans aufeinander ausrichten",
        ),
        (
            "3 sheets, 0.2 to 0.3 thick, with 98 % of the volume",
            "3 Blätter, 0.2 bis 0.3 dick, mit 98 % des Volumens",
        ),
        ("'x; y': no such text", "'x; y': no such text"),
        ("no such text", "no such text"),
    ],
)
def test_sentences_are_found_by_their_words(german, text, other):
    assert say(text) == other


def test_names_are_not_translated(german):
    thing = link("Surface", [(0, 0, 0)])
    text = f"Expected '{thing.name}' in object mode, found it in edit mode; leave that mode and "
    assert say(text + "compute again").startswith("Erwartet: 'Surface' im")


def test_panels_keep_english_and_show_german(german):
    ellipsoid()
    result = press("medial_axis", sampling="VERTICES")
    assert result["ma_inside"] == "Inside from Surface: the faces are closed"
    layout, words = Layout(), result["ma_inside"]
    addon("ui.base.wrapped_text").draw_wrapped(seen(width=2000), layout, words, "INFO")
    assert layout.rows == [["Innen nach Oberfläche: die Flächen sind geschlossen"]]


def test_translations_leave_with_the_addon(german):
    assert bpy.app.translations.pgettext_iface("Compute Medial Axis") == "Mediale Achse berechnen"
    bpy.ops.preferences.addon_disable(module=MODULE)
    assert bpy.app.translations.pgettext_iface("Compute Medial Axis") == "Compute Medial Axis"
    bpy.ops.preferences.addon_enable(module=MODULE)
    assert say("as chosen") == "wie gewählt"
