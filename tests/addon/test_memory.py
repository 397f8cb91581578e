# SPDX-License-Identifier: GPL-3.0-or-later
"""Memory in Blender: what is kept, how it is freed, and the limit of an analysis, with and without faces."""

import bpy
import pytest
from installed import MODULE, addon
from measure import analyses, reports
from scene import compute, ellipsoid, press, refuse, scan
from support.clouds import on_ellipsoid
from test_registration import assert_shows

MEGABYTE = 1 << 20


def preferences():
    return bpy.context.preferences.addons[MODULE].preferences


def cache():
    return addon("core.machine.cache").CACHE


@pytest.fixture(autouse=True)
def defaults():
    """The preferences as they were, and their room for the cache."""
    yield
    for name in ("cache_size", "memory_limit", "above_limit"):
        preferences().property_unset(name)
    cache().room = preferences().cache_size * MEGABYTE


@pytest.fixture
def tight(monkeypatch):
    """A machine on which the analysis of 1,500 points just fits."""
    memory = addon("core.machine.memory_limit")
    monkeypatch.setattr(memory, "free_memory", lambda: memory.memory_needed(1500) - cache().bytes)


# --- what is kept


def test_preferences_are_what_settings_say():
    size, limits = addon("core.settings").CACHE_SIZE, addon("core.machine.memory_limit").LIMITS
    for name, option in {"cache_size": size, **limits}.items():
        assert_shows(preferences().bl_rna.properties[name], option)
    assert cache().room == size.default * MEGABYTE


def test_smaller_cache_forgets_at_once():
    compute(ellipsoid())
    assert cache().bytes > 0
    preferences().cache_size = 0
    assert cache().bytes == len(cache()) == 0
    compute()
    assert len(cache()) == 0
    bpy.context.scene.medial_axis.theta = 1.2
    assert "no longer in memory" in bpy.context.scene.medial_axis.note


def test_saved_preferences_hold_from_the_first_computation():
    """Blender sets saved values without calling `update`."""
    preferences().cache_size = 0
    cache().room = MEGABYTE << 10
    compute(ellipsoid())
    assert cache().room == 0 and len(cache()) == 0


def test_kept_analyses_are_freed_on_demand(capfd):
    result = compute(ellipsoid(segments=5))
    size, count = cache().bytes, len(result.data.polygons)
    assert size > MEGABYTE / 2
    reports(capfd)
    assert bpy.ops.wm.medial_axis_free_memory() == {"FINISHED"}
    assert reports(capfd) == [("Info", f"{size / MEGABYTE:,.0f} MB were freed")]
    assert cache().bytes == 0 and len(result.data.polygons) == count


def test_kept_analyses_are_freed_with_the_addon():
    compute(ellipsoid())
    old = cache()
    bpy.ops.preferences.addon_disable(module=MODULE)
    assert len(old) == 0
    bpy.ops.preferences.addon_enable(module=MODULE)


# --- the limit


@pytest.mark.parametrize("operator", ["medial_axis", "tight_cocone_surface"])
def test_too_many_points_are_refused(tight, operator):
    scan()
    before = analyses()
    said = refuse(r"fits into the free memory of .* MB, found 2,000, which need about", operator)
    assert analyses() == before and "Memory Limit" in said


def test_limit_of_the_preferences_refuses():
    scan(points=on_ellipsoid(20_000)[0])
    preferences().memory_limit = 1
    refuse("fits into the limit of 1 MB, found 20,000, which need about")
    preferences().memory_limit = 10_000
    compute()


@pytest.mark.parametrize("operator", ["medial_axis", "tight_cocone_surface"])
def test_clouds_are_thinned(tight, capfd, operator):
    scan()
    preferences().above_limit = "THIN"
    reports(capfd)
    made = press(operator)
    assert 500 < made["ma_points"] <= 1500
    kept = f"{made['ma_points']:,} of the 2,000 points, evenly spread, were kept"
    assert kept in made["ma_warnings"]
    assert [text for kind, text in reports(capfd) if kind == "Warning" and kept in text]


def test_reports_of_the_sampling_have_the_limit(tight):
    ellipsoid(segments=5)
    refuse("fits into the free memory", "medial_axis_sampling_report", sampling="SURFACE")
    preferences().above_limit = "THIN"
    press("medial_axis_sampling_report", sampling="SURFACE")


def test_sequences_have_the_limit(tight, tmp_path):
    scan()
    operator, options = "medial_axis_sequence", {"directory": str(tmp_path), "frames": "1"}
    refuse("Expected results of 1 frames, found none", operator, **options)
    preferences().above_limit = "THIN"
    press(operator, **options)
    assert len(list(tmp_path.glob("*.npz"))) == 1


def test_other_thresholds_of_what_was_thinned_are_found_in_the_cache(tight):
    source, panel = scan(), bpy.context.scene.medial_axis
    preferences().above_limit = "THIN"
    compute()
    before = analyses()
    panel.rho = 4.0
    assert panel.note == ""
    compute(source, rho=3.0)
    assert analyses() == before
