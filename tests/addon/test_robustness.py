# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of concurrent processes: Blender is killed while it writes, and two write the same file."""

import os
import signal
import subprocess
import time

import bpy
import pytest
from installed import MODULE, program
from scene import compute, export, torus

# Exports the active object to the file named after `--`, again and again.
EXPORT_FOREVER = f"""
import sys, bpy
bpy.ops.preferences.addon_enable(module={MODULE!r})
while True:
    assert bpy.ops.export_scene.medial_axis(filepath=sys.argv[-1]) == {{"FINISHED"}}
"""


@pytest.fixture
def axis():
    """A medial axis of some ten thousand facets: to write it takes a while."""
    torus().modifiers.new("Subdivision", "SUBSURF").levels = 2
    result = compute(side="BOTH", theta=0.0)
    assert len(result.data.polygons) > 10_000
    return result


@pytest.fixture
def exporter(tmp_path):
    """(name of a new file, target) -> another Blender that writes the target for ever; killed in the end."""
    started = []

    def start(name, target):
        blend = str(tmp_path / f"{name}.blend")
        bpy.ops.wm.save_as_mainfile(filepath=blend)
        command = [program(), "--background", "--factory-startup", blend]
        command += ["--python-exit-code", "1", "--python-expr", EXPORT_FOREVER, "--", target]
        log = open(tmp_path / f"{len(started)}.log", "wb")  # noqa: SIM115
        started.append(subprocess.Popen(list(map(str, command)), stdout=log, stderr=log))
        return started[-1]

    yield start
    for process in started:
        process.kill()
        process.wait()


def content_of(path):
    """The bytes of the file that the export of the active object writes."""
    export(path)
    return path.read_bytes()


def patience():
    """When to give up, on a machine that may be overloaded."""
    return time.monotonic() + 120 * max(1.0, os.getloadavg()[0])


def half_written(folder):
    """The files next to the target that are being written and are not empty."""
    found = []
    for path in folder.glob(".medial_axis_*.tmp"):
        try:
            found += [path] if path.stat().st_size else []
        except FileNotFoundError:
            continue  # it was finished
    return found


def stopped_while_writing(process, folder):
    """Stop the process at a moment when a file is half written."""
    end = patience()
    while time.monotonic() < end:
        assert process.poll() is None, "the other Blender ended by itself"
        if half_written(folder):
            process.send_signal(signal.SIGSTOP)
            os.waitid(os.P_PID, process.pid, os.WSTOPPED)
            if half_written(folder):
                return
            process.send_signal(signal.SIGCONT)
    pytest.fail("the other Blender was never seen writing")


def test_killed_while_writing_leaves_the_old_file(axis, exporter, tmp_path):
    """The Python tests kill writers of the other formats."""
    new = content_of(tmp_path / "new.ma")
    folder = tmp_path / "target"
    folder.mkdir()
    target = folder / "axis.ma"
    process = exporter("a", target)
    stopped_while_writing(process, folder)
    target.write_bytes(b"old")
    process.kill()
    process.wait()
    assert target.read_bytes() == b"old"
    (left,) = half_written(folder)
    assert len(left.read_bytes()) <= len(new)
    assert content_of(target) == new, "the next export must work"


def test_two_blenders_write_the_same_file(axis, exporter, tmp_path):
    """The last one wins; nobody ever reads a mixture."""
    target = tmp_path / "axis.ma"
    contents, processes = [], []
    for name in "ab":
        axis.location.x += 5.0
        contents.append(content_of(tmp_path / f"{name}.ma"))
        processes.append(exporter(name, target))
    assert contents[0] != contents[1]
    last, changes, end = -1, 0, patience()
    while changes < 10:
        assert time.monotonic() < end, f"the file changed {changes} times only"
        assert [process.poll() for process in processes] == [None, None]
        if target.exists():
            whose = contents.index(target.read_bytes())
            changes, last = changes + (whose != last), whose
