# SPDX-License-Identifier: GPL-3.0-or-later
"""The thread that computes: watched, cancelled, and never left behind."""

import threading
import time
from functools import partial

import bpy
import numpy as np
import pytest
from installed import MODULE, addon
from measure import analyses, medial_objects, watched
from scene import compute, ellipsoid, refuse


def task(count=60_000, name="Cloud"):
    """A task of about a second."""
    points = np.random.default_rng(9).normal(size=(count, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    return task_of(name, points * (1.0, 0.8, 0.6))


def task_of(name, points):
    """The task that the operator makes for a cloud of points."""
    none, settings = np.zeros((0, 3), np.int32), addon("core.settings").Settings()
    work = partial(addon("core.axis.compute").compute, points, none, settings)
    return addon("core.machine.job").Task(name, work)


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
    one, jobs = task(3_000), addon("core.machine.job")
    mine = jobs.Job([one]).outcomes()[0].value.axis
    addon("core.machine.cache").CACHE.clear()
    other = jobs.run_task(one).value.axis
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
    jobs = addon("core.machine.job")
    with pytest.raises(TypeError):
        jobs.Job([jobs.Task("Wrong", None)]).outcomes()


def test_second_run_is_refused_while_one_runs():
    ellipsoid()
    job = start()
    refuse("A medial axis is being computed", "object.medial_axis")
    assert bpy.context.window_manager.medial_axis_progress.percentage >= 0
    bpy.ops.object.medial_axis_cancel()
    wait(job)
    addon("ui.base.current_job").stop()
    compute()
    refuse("Nothing is being computed", "medial_axis_cancel")


def start():
    """A job that takes long, as a click begins it."""
    return addon("ui.base.current_job").start([task(300_000)], "medial axis")


def test_sliders_rest_while_a_job_runs():
    result = compute(ellipsoid())
    count = len(result.data.polygons)
    start()
    bpy.context.scene.medial_axis.theta = 1.2
    assert len(result.data.polygons) == count
    addon("ui.base.current_job").stop()


def test_loading_a_file_stops_the_job_and_forgets_analyses():
    compute(ellipsoid())
    cache = addon("core.machine.cache").CACHE
    assert len(cache) == 1
    start()
    assert threads()
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    assert threads() == [] and addon("ui.base.current_job").job() is None
    assert len(cache) == 0 and medial_objects() == []


def test_disabling_the_addon_stops_the_job():
    start()
    bpy.ops.preferences.addon_disable(module=MODULE)
    assert threads() == []
    bpy.ops.preferences.addon_enable(module=MODULE)


def test_source_deleted_before_the_result_is_written():
    source = ellipsoid()
    uid = getattr(source, "session_uid", None)
    found = addon("ui.axis.selected_sources").Source(source.name, uid, None, None)
    assert found.find() == source
    bpy.data.objects.remove(source)
    assert found.find() is None


def test_messages_of_a_missing_compiled_module(monkeypatch, tmp_path):
    native = addon("core.machine.native")
    found = "cpython-399-x86_64-linux-gnu"
    sentence = f"Expected the compiled module for {native.expected_abi()}, found {found}; install"
    (tmp_path / f"_medial.{found}.so").write_bytes(b"")
    monkeypatch.setattr(native, "_module", None)
    monkeypatch.setattr(native, "LIB", tmp_path)
    with pytest.raises(addon("core.errors").NativeModuleError, match=sentence):
        native.load()
    ellipsoid()
    refuse(sentence, "object.medial_axis")
    monkeypatch.setattr(native, "LIB", tmp_path / "nowhere")
    assert "found none" in native.problem()
