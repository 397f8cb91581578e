# SPDX-License-Identifier: GPL-3.0-or-later
"""Work in parallel with other work: its value, its error, its end, and the add-on's uses of it."""

import threading

import numpy as np
import pytest
from medial_axis.core.axis.compute import compute
from medial_axis.core.errors import InvalidInputError
from medial_axis.core.machine import beside, native
from medial_axis.core.machine.beside import Beside
from medial_axis.core.machine.cache import CACHE
from medial_axis.core.settings import SamplingMode, Settings
from support import meshes


def test_it_runs_while_the_body_does(medial):
    met = threading.Barrier(2)  # which neither passes alone
    with Beside(lambda _progress: met.wait(60)) as work:
        met.wait(60)
    assert work.result() in (0, 1)


def test_what_it_raises_is_raised_where_its_result_is_asked_for(medial):
    def fails(_progress):
        raise InvalidInputError("no")

    with Beside(fails) as work:
        pass
    with pytest.raises(InvalidInputError, match="no"):
        work.result()


def test_it_is_cancelled_and_over_when_the_body_fails(medial):
    points = np.random.default_rng(0).normal(size=(200_000, 3))
    outcome = []

    def long(progress):
        try:
            medial.MedialAnalysis(points, progress=progress)
        except medial.Cancelled:
            outcome.append("cancelled")

    with pytest.raises(KeyError), Beside(long):
        raise KeyError
    assert outcome == ["cancelled"]
    assert not any("beside" in thread.name for thread in threading.enumerate())


def test_without_a_thread_it_is_done_before_the_body(medial, monkeypatch):
    def no_thread(self):
        raise RuntimeError("can't start new thread")

    monkeypatch.setattr(beside.threading.Thread, "start", no_thread)
    done = []
    with Beside(lambda _progress: done.append("work")) as work:
        done.append("body")
    assert done == ["work", "body"] and work.result() is None


def test_the_topology_of_the_faces_is_counted_once_for_all_passes(medial, monkeypatch):
    calls, count = [], medial.solid_betti

    class Counting:
        def __getattr__(self, name):
            return getattr(medial, name)

        def solid_betti(self, *mesh):
            calls.append(len(mesh[1]))
            return count(*mesh)

    monkeypatch.setattr(native, "_module", Counting())
    CACHE.clear()
    points, triangles = meshes.torus(around=24, across=8)
    settings = Settings(sampling=SamplingMode.ADAPTIVE, samples=800, budget=3000)
    found = compute(points, triangles, settings)
    assert "passes" in found.chosen.reason
    assert calls == [len(triangles)]
    assert found.chosen.samples.by_faces == (1, 1, 0)
    assert found.chosen.samples.walls is not None
