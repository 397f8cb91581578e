# SPDX-License-Identifier: GPL-3.0-or-later
"""The rows that the tab has before the first click and after it."""

import re
from types import SimpleNamespace

import bpy
import pytest
from installed import MODULE, addon
from scene import added, press, suzanne

MAIN = "VIEW3D_PT_medial_axis"


class Layout:
    """Counts the rows that are drawn, a line of text, a button or a field each; those in a row are one."""

    def __init__(self, rows=None, inside=False):
        self.rows, self._inside, self._counted = [] if rows is None else rows, inside, False

    def column(self, **_):
        return type(self)(self.rows, self._inside)

    box = column

    def row(self, **_):
        if not self._inside:
            self.rows.append([])
        return type(self)(self.rows, inside=True)

    split = row

    def _item(self, *words, text=None, **_):
        if not self._inside:
            self.rows.append([])
        self.rows[-1].append(text or words[-1] if words else text)
        return SimpleNamespace()

    label = prop = operator = menu = _item
    operator_menu_enum = lambda self, name, _property, **words: self._item(name, **words)

    def separator(self):
        """It is no row."""


class Names(Layout):
    """Keeps the names that are drawn, each with what it stands for: a property, an operator, or itself."""

    def _item(self, *words, text=None, translate=True, **_):
        *owners, thing = words or [text]
        if text is None:
            group, _, word = thing.partition(".")
            known = getattr(getattr(bpy.ops, group), word).get_rna_type() if word else None
            text = (known or owners[0].bl_rna.properties[thing]).name
        if text and translate:  # neither figures, nor names of objects, nor sentences
            self.rows.append((text, thing))
        return SimpleNamespace()

    label = prop = operator = menu = _item


def seen(is_colour=False, width=400):
    """A viewport with a sidebar, as panels ask for it."""
    shading = SimpleNamespace(type="SOLID", color_type="VERTEX" if is_colour else "MATERIAL")
    words = ["scene", "object", "view_layer", "selected_objects"]
    return SimpleNamespace(
        space_data=SimpleNamespace(shading=shading, as_pointer=lambda: 0),
        region=SimpleNamespace(width=width, as_pointer=lambda: 0),
        preferences=SimpleNamespace(
            system=SimpleNamespace(ui_scale=1.0),  # without a window it is 0
            ui_styles=bpy.context.preferences.ui_styles,
            addons=bpy.context.preferences.addons,
        ),
        objects_in_mode=None,
        **{word: getattr(bpy.context, word, None) for word in words},
    )


def panels(context):
    """The panels of the tab that are there, without those of an add-on that was disabled."""
    ours = (c for c in bpy.types.Panel.__subclasses__() if c.__module__.startswith(MODULE))
    ours = [c for c in ours if c.is_registered and getattr(c, "bl_category", "") == "Medial Axis"]
    return [cls for cls in ours if not hasattr(cls, "poll") or cls.poll(context)]


def rows(context):
    """The rows of the tab as it is at first: headers of panels, and what is in those that are open."""
    found = Layout()
    for cls in panels(context):
        if is_inside := getattr(cls, "bl_parent_id", "") == MAIN:
            found.label(text=cls.bl_label)
        is_open = "DEFAULT_CLOSED" not in getattr(cls, "bl_options", ())
        if is_open and (is_inside or cls.__name__ == MAIN):
            cls.draw(SimpleNamespace(layout=found), context)
    return found.rows


@pytest.fixture
def newcomer():
    preferences = bpy.context.preferences.addons[MODULE].preferences
    preferences.property_unset("guided")
    yield preferences
    preferences.property_unset("guided")


def test_few_rows_and_names_of_one_thing_each_before_the_first_click_and_after_it(newcomer):
    suzanne(levels=0)
    assert len(rows(seen())) <= 9, rows(seen())
    press("medial_axis", select_result=False)
    assert newcomer.guided, "who has computed an axis is no longer new"
    assert len(rows(seen())) <= 18, rows(seen())
    assert len(rows(seen(is_colour=True))) <= 18
    found = Names()
    for cls in panels(seen()):
        found.label(text=cls.bl_label)
        cls.draw(SimpleNamespace(layout=found), seen())
    names = sorted(text for text, _ in set(filter(None, found.rows)))
    assert len(set(names)) == len(names) <= 66 and max(map(len, names)) <= 25, names


def drawn(panel):
    found = Layout()
    panel.draw(SimpleNamespace(layout=found), seen())
    return found.rows


def test_hollow_and_unsolidify_need_no_measurement_and_have_room_for_their_words():
    suzanne(levels=0)
    found = drawn(bpy.types.VIEW3D_PT_medial_axis_thickness)
    assert ["object.medial_axis_unsolidify"] in found and ["object.medial_axis_hollow"] in found


def test_rig_tells_of_the_skeleton_that_was_made():
    suzanne(levels=0)
    skeleton = press("medial_axis_skeleton")
    found = drawn(bpy.types.VIEW3D_PT_medial_axis_skeleton)
    assert any(re.fullmatch(r"\d+ ends, \d+ branches", row[0]) for row in found)
    skeleton["ma_frame"] = 1  # as one of a sequence
    assert rows(seen())
    assert press("medial_axis_armature").type == "ARMATURE" and rows(seen())


def test_no_two_stored_properties_have_one_name():
    names = [n for n in vars(addon("bridge.mesh.stored")).values() if isinstance(n, str)]
    ours = [name for name in names if name.startswith("ma_")]
    assert len(ours) == len(set(ours)) > 60


def test_hollow_without_a_wall_takes_a_share_of_the_diagonal():
    added("cube", size=2)
    press("medial_axis_hollow")
    least = bpy.data.objects["Cube Hollow"]["ma_hollow_least"]
    assert least == pytest.approx(0.06 * 3**0.5, rel=0.02)
