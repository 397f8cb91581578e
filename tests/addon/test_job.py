# SPDX-License-Identifier: GPL-3.0-or-later
"""The thread that computes: watched, cancelled, and never left behind."""

import threading
import time
from functools import partial
from importlib.machinery import EXTENSION_SUFFIXES

import bpy
import numpy as np
import pytest
from installed import MODULE, addon
from measure import analyses, medial_objects, watched
from scene import compute, ellipsoid, refuse, select


def task(count=60_000, name="Cloud"):
    """A task of about a second."""
    points = np.random.default_rng(9).normal(size=(count, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    return task_of(name, points * (1.0, 0.8, 0.6))


def task_of(name, points):
    """The task that the operator makes for a cloud of points."""
    none, settings = np.zeros((0, 3), np.int32), addon("core.settings").Settings()
    return addon("core.machine.job").Task(
        name, partial(addon("core.axis.compute").compute, points, none, settings)
    )


def threads():
    return [thread for thread in threading.enumerate() if thread.name == "medial axis"]


def wait(job, seconds=120):
    end = time.monotonic() + seconds
    while not job.done and time.monotonic() < end:
        time.sleep(0.01)
    assert job.done


def test_job_reports_stages_and_a_fraction_that_never_falls():
    job = addon("core.machine.job").Job([task(name="One"), task(20_000, name="Two")])
    seen = watched(job)
    assert any(text.startswith("One, 1 of 2: Delaunay triangulation, ") for _, text in seen)
    assert any(text.startswith("Two, 2 of 2: ") for _, text in seen)
    assert len({text.split(", ")[1] for _, text in seen}) > 3, seen
    assert [outcome.value.points for outcome in job.outcomes()] == [60_000, 20_000]
    assert threads() == []


def test_a_draft_comes_first_and_the_stages_have_four_words():
    core, doing = addon("core.machine.job"), addon("ui.base.plain_words").doing
    tasks = [core.Task("One", task().work, lambda _: "quick"), task(20_000, name="Two")]
    job = core.Job(tasks)
    words = {doing(stage).rpartition(" of 2: ")[2] for stage, _ in watched(job)}
    assert words <= {"Sampling", "Building", "Cleaning", "Drawing"} and len(words) > 1
    assert [outcome.value for outcome in job.drafts] == ["quick"]
    assert [outcome.value.points for outcome in job.outcomes()] == [60_000, 20_000]


def test_job_gives_what_the_script_way_gives():
    one = task(3_000)
    job = addon("core.machine.job").Job([one])
    mine = job.outcomes()[0].value.axis
    addon("core.machine.cache").CACHE.clear()
    other = addon("core.machine.job").run_task(one).value.axis
    names = ("vertices", "radius", "face_offsets", "face_vertices")
    for name in (*names, "theta", "rho", "side", "generators"):
        assert getattr(mine, name).tobytes() == getattr(other, name).tobytes()


@pytest.mark.parametrize("delay", [0.0, 0.2])
def test_cancel_ends_the_job_soon_and_keeps_nothing(delay):
    before = analyses()
    job = addon("core.machine.job").Job([task(300_000)])
    time.sleep(delay)
    assert not job.done
    job.cancel()
    wait(job)
    assert job.fraction < 1.0
    with pytest.raises(addon("core.errors").Cancelled):
        job.outcomes()
    assert analyses() == before and threads() == []


def test_an_error_belongs_to_its_task():
    flat = task_of("Flat", np.zeros((9, 3)))
    bad, good = addon("core.machine.job").Job([flat, task(1000)]).outcomes()
    assert isinstance(bad.error, addon("core.errors").DegenerateInputError) and bad.value is None
    assert good.error is None and good.value.axis.facets > 0


def test_an_unforeseen_failure_is_raised_where_the_outcomes_are_asked_for():
    wrong = addon("core.machine.job").Task("Wrong", None)
    with pytest.raises(TypeError):
        addon("core.machine.job").Job([wrong]).outcomes()


def test_second_run_is_refused_while_one_runs():
    ellipsoid()
    running = addon("ui.base.current_job")
    job = running.start([task(300_000)], "medial axis")
    refuse("A medial axis is being computed", "object.medial_axis")
    assert bpy.context.window_manager.medial_axis_progress.percentage >= 0
    bpy.ops.object.medial_axis_cancel()
    wait(job)
    running.stop()
    compute()
    refuse("Nothing is being computed", "medial_axis_cancel")


def test_sliders_rest_while_a_job_runs():
    result = compute(ellipsoid())
    count = len(result.data.polygons)
    addon("ui.base.current_job").start([task(300_000)], "medial axis")
    bpy.context.scene.medial_axis.theta = 1.2
    assert len(result.data.polygons) == count
    addon("ui.base.current_job").stop()


def test_loading_a_file_stops_the_job_and_forgets_analyses():
    ellipsoid()
    compute()
    assert len(addon("core.machine.cache").CACHE) == 1
    addon("ui.base.current_job").start([task(300_000)], "medial axis")
    assert threads()
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    assert threads() == [] and addon("ui.base.current_job").job() is None
    assert len(addon("core.machine.cache").CACHE) == 0 and medial_objects() == []


def test_disabling_the_addon_stops_the_job():
    addon("ui.base.current_job").start([task(300_000)], "medial axis")
    bpy.ops.preferences.addon_disable(module=MODULE)
    assert threads() == []
    bpy.ops.preferences.addon_enable(module=MODULE)


def test_source_deleted_before_the_result_is_written(capfd):
    source = ellipsoid()
    found = addon("ui.axis.selected_sources").Source(
        source.name, getattr(source, "session_uid", None), None, None
    )
    assert found.find() == source
    bpy.data.objects.remove(source)
    assert found.find() is None


def test_messages_of_a_missing_compiled_module(monkeypatch, tmp_path):
    native = addon("core.machine.native")
    expected = native.expected_abi()
    (tmp_path / "_medial.cpython-399-x86_64-linux-gnu.so").write_bytes(b"")
    monkeypatch.setattr(native, "_module", None)
    monkeypatch.setattr(native, "LIB", tmp_path)
    sentence = (
        f"Expected the compiled module for {expected}, found cpython-399-x86_64-linux-gnu; install"
    )
    with pytest.raises(addon("core.errors").NativeModuleError, match=sentence):
        native.load()
    select(ellipsoid())
    refuse(sentence, "object.medial_axis")
    monkeypatch.setattr(native, "LIB", tmp_path / "nowhere")
    assert "found none" in native.problem()


def test_message_of_a_compiled_module_that_does_not_load(monkeypatch, tmp_path):
    native = addon("core.machine.native")
    monkeypatch.setattr(native, "_module", None)
    monkeypatch.setattr(native, "_failure", "")
    monkeypatch.setattr(native, "NAME", "_absent")
    monkeypatch.setattr(native, "LIB", tmp_path)
    (tmp_path / f"_absent{EXTENSION_SUFFIXES[0]}").write_bytes(b"not a library")
    with pytest.raises(
        addon("core.errors").NativeModuleError, match=r"Expected .* that loads, but the system says"
    ):
        native.load()
    assert "that loads" in native.problem(), "the panel must not try again at every draw"
