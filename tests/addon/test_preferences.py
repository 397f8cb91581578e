# SPDX-License-Identifier: GPL-3.0-or-later
"""The preferences page: what is installed, the self-test, and the manual."""

import os
from pathlib import Path
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from installed import MODULE, addon
from measure import contents, reports
from scene import refuse
from test_rows import Layout, seen

CHECKS = 8


class Page(Layout):
    """Names its properties, all of which there are, and knows no way to do anything slow."""

    def prop(self, owner, name, **_):
        assert name in owner.bl_rna.properties
        self._item(name)


def page(whole=True):
    """The rows of the preferences; with `whole` those of the part that is closed at first, too."""
    layout = Page()
    draw = addon("ui.settings.preferences").MedialAxisPreferences.draw
    known = bpy.context.preferences.addons[MODULE].preferences.bl_rna
    values = {**dict.fromkeys(known.properties.keys(), 0), "show_installed": whole}
    draw(SimpleNamespace(layout=layout, bl_rna=known, **values), seen(width=10_000))
    return [text for row in layout.rows for text in row]


@pytest.fixture(autouse=True)
def no_last_test():
    addon("ui.settings.self_test_operator")._last.clear()


def test_page_names_what_is_installed():
    drawn = page()
    native = addon("core.machine.native")
    assert native.file().parent == Path(addon().__file__).parent / "lib"
    for text in (addon().__version__, native.expected_abi(), str(native.file())):
        assert text in drawn
    has_affinity = hasattr(os, "sched_getaffinity")  # Windows has not
    assert str(len(os.sched_getaffinity(0)) if has_affinity else os.cpu_count()) in drawn
    assert {"cache_size", "memory_limit", "above_limit", "wm.medial_axis_self_test"} <= set(drawn)


def test_page_loads_and_computes_nothing(monkeypatch):
    load = lambda: pytest.fail("loaded")
    monkeypatch.setattr(addon("core.machine.native"), "load", load)
    assert "wm.medial_axis_free_memory" in page()


@pytest.fixture
def without_module(monkeypatch, tmp_path):
    native = addon("core.machine.native")
    monkeypatch.setattr(native, "LIB", tmp_path)
    monkeypatch.setattr(native, "_module", None)


def test_page_says_when_the_module_is_missing(without_module):
    assert any(text.startswith("This zip is for another Blender") for text in page())


def test_self_test_passes_and_says_so(capfd):
    before = contents()
    reports(capfd)
    assert bpy.ops.wm.medial_axis_self_test() == {"FINISHED"}
    said = reports(capfd)
    assert [kind for kind, _ in said] == ["Info"] * CHECKS
    assert all(text.startswith("Passed: ") for _, text in said)
    assert contents() == before
    assert [text.removeprefix("Passed: ") for _, text in said] == page()[-CHECKS:]


def test_self_test_fails_without_the_module(without_module):
    refuse("Failed: Expected the compiled module for", "wm.medial_axis_self_test")
    assert not addon("ui.settings.self_test_operator").last()[0].passed


def changed(axis, **fields):
    known = {name: getattr(axis, name) for name in axis.__dataclass_fields__}
    return type(axis)(**known | fields)


@pytest.mark.parametrize(
    ("change", "failed"),
    [
        (lambda axis: {"vertices": np.add(axis.vertices, (0.0, 0.0, 0.2))}, {1, 2}),
        (lambda axis: {"radius": 1.3 * axis.radius}, {2, 3}),
        (lambda axis: {"vertices": 0.7 * axis.vertices}, {1, 2}),
    ],
    ids=["moved", "radii", "shrunk"],
)
def test_self_test_notices(change, failed):
    core = addon("core.axis.known_box")
    box = core.compute_box()
    checks = core._of_shape(changed(box.axis, **change(box.axis)), box.chosen.samples.spacing)
    assert {number for number, check in enumerate(checks, 1) if not check.passed} >= failed
    assert all(check.passed for check in core._of_shape(box.axis, box.chosen.samples.spacing))


def test_self_test_notices_an_empty_axis():
    core = addon("core.axis.known_box")
    empty = changed(core.compute_box().axis, face_offsets=np.zeros(1, np.int32))
    assert [check.passed for check in core._of_shape(empty, 0.1)] == [False]


# --- the manual


def lookup(name):
    """Where Online Manual leads for a button."""
    return bpy.types.WM_OT_doc_view_manual._lookup_rna_url(f"bpy.{name}", verbose=False)


NAMES = """
ops.object.medial_axis ops.object.medial_axis_sampling_report ops.object.medial_axis_sequence
ops.object.tight_cocone_surface ops.export_scene.medial_axis ops.import_mesh.points_xyz
ops.import_mesh.points_off ops.import_scene.medial_axis_sequence ops.wm.medial_axis_self_test
types.MedialAxisPanelSettings.theta types.MedialAxisPreferences.cache_size types.Scene.medial_axis_folder
"""


@pytest.mark.parametrize("name", NAMES.split())
def test_online_manual_leads_to_the_manual_that_is_installed(name):
    page, _, place = lookup(name).partition("#")
    file = Path(addon().__file__).parent / "manual" / page.rpartition("/")[2]
    assert page == file.as_uri()
    assert f'id="{place}"' in file.read_text(encoding="utf-8")


def test_online_manual_of_blender_is_left_alone():
    assert lookup("ops.mesh.primitive_cube_add").startswith("https://docs.blender.org/")


def test_page_has_buttons_for_the_manual():
    first, *buttons = page(whole=False)[:5]
    assert first == "3D Viewport > Sidebar (N) > Medial Axis"
    assert buttons == ["Tutorial", "User Guide", "Troubleshooting", "Command Line"]


def test_page_begins_short():
    drawn = page(whole=False)
    assert str(addon("core.machine.native").file()) not in drawn and len(drawn) < 12
