# SPDX-License-Identifier: GPL-3.0-or-later
"""A batch never ends early: names that are no text, closed streams, unexpected exceptions, signals."""

import json
import os
import signal
import subprocess
import sys
import time
import weakref
from pathlib import Path

import numpy as np
import pytest
from medial_axis import cli
from medial_axis.core.files import read as read_module
from medial_axis.core.machine import job as job_module
from medial_axis.core.machine import native
from medial_axis.core.products import axis as axis_work
from test_cli import egg, files, here, program, run, write_egg  # noqa: F401 - fixtures

from tests.support.fuzz import repeats

pytestmark = pytest.mark.skipif(os.name == "nt", reason="names are bytes where files are POSIX's")
BAD = os.fsdecode(b"caf\xe9")


@pytest.fixture
def folder(here):  # noqa: F811
    """With two good inputs round one that is to fail, or has a bad name."""
    write_egg(here / "last.xyz")
    return here


def outputs(folder):
    return sorted(path.name for path in (folder / "out").iterdir() if path.suffix == ".ma")


# --- names


def test_a_name_that_is_no_text(folder, program):  # noqa: F811
    os.rename("egg.xyz", f"{BAD}.xyz")
    done = program(f"{BAD}.xyz", "last.xyz", "out/", text=False)
    assert (done.returncode, done.stderr) == (0, b"")
    assert done.stdout.splitlines()[0].startswith(rb"out/caf\udce9.ma: ")
    assert outputs(folder) == ["caf\udce9.ma", "last.ma"]
    report = (folder / "out" / f"{BAD}.ma.json").read_bytes()
    assert b'"output": "out/caf\xe9.ma"' in report
    again = program(f"{BAD}.xyz", "last.xyz", "out/", "--json", text=False)
    assert [json.loads(line)["status"] for line in again.stdout.splitlines()] == ["kept"] * 2
    assert os.fsencode(json.loads(again.stdout.splitlines()[0])["input"]) == b"caf\xe9.xyz"


@pytest.mark.oracle
@pytest.mark.parametrize(
    ("name", "encoding"),
    [("café", "ascii"), ("café", "cp1252"), ("骨", "cp1252"), (BAD, "ascii"), (BAD, "utf-8")],
)
def test_a_terminal_that_cannot_show_a_name(folder, program, name, encoding):  # noqa: F811
    os.rename("egg.xyz", f"{name}.xyz")
    environment = {**program.environment, "PYTHONIOENCODING": encoding}
    words = (f"{name}.xyz", "absent.xyz", "last.xyz", "out/")
    done = program(*words, env=environment, text=False)
    assert done.returncode == cli.INPUT and b"Traceback" not in done.stderr
    assert outputs(folder) == sorted([f"{name}.ma", "last.ma"])
    as_json = program(*words, "--json", env=environment, text=False)
    reports = [json.loads(line.decode(encoding)) for line in as_json.stdout.splitlines()]
    assert [report["status"] for report in reports] == ["kept", "failed", "kept"]
    assert reports[0]["input"] == f"{name}.xyz"


@pytest.mark.parametrize("length", [248, 249, 252, 253])
def test_a_name_whose_report_does_not_fit(folder, run, length):  # noqa: F811
    name = length * "x"
    os.rename("egg.xyz", "y.xyz")
    code, _, said = run("y.xyz", f"{name[:-3]}.ma")
    if length + len(".json") <= 255:
        assert code == cli.DONE
    else:
        assert code == cli.INPUT and "Expected the name of an output" in said
        assert files(folder) == ["last.xyz", "y.xyz"]


@pytest.mark.parametrize(
    "name", ["x" * 300 + ".ma", "y/" * 3000 + "a.ma", "absent/" + "z" * 300 + "/"]
)
def test_an_output_that_no_file_system_takes(folder, run, name):  # noqa: F811
    code, (report,), _ = run("egg.xyz", name)
    assert code in (cli.FAILED, cli.INPUT) and report["error"].startswith("Expected ")
    assert files(folder) == ["egg.xyz", "last.xyz"] or (folder / "absent").is_dir()


def test_a_folder_whose_permission_the_system_denies(folder, run, monkeypatch):  # noqa: F811
    """This happens to every user but root."""

    def denied(self, *rest, **options):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "is_dir", denied)
    monkeypatch.setattr(Path, "exists", denied)
    code, (report,), _ = run("egg.xyz", "locked/a.ma")
    assert code == cli.FAILED and "Permission denied" in report["error"]


def test_dashes_and_empty_words(folder):
    os.rename("egg.xyz", "-a.xyz")
    code = cli.main(["--theta", "30", "--", "-a.xyz", "last.xyz", "out/"])
    assert code == cli.DONE and outputs(folder) == ["-a.ma", "last.ma"]
    assert cli.main(["last.xyz", ""]) == cli.USAGE and cli.main(["", "a.ma"]) == cli.USAGE


# --- faults


@pytest.mark.parametrize(
    "kind", [RuntimeError, OverflowError, MemoryError, RecursionError, OSError]
)
def test_a_fault_that_nobody_foresaw(folder, run, monkeypatch, kind):  # noqa: F811
    def broken(path):
        raise kind("what is this?")

    monkeypatch.setitem(read_module.READERS, ".off", broken)
    Path("broken.off").write_text("OFF")
    code, reports, said = run("egg.xyz", "broken.off", "last.xyz", "out/")
    assert code == cli.FAILED and [r["status"] for r in reports] == ["done", "failed", "done"]
    assert reports[1]["error"].startswith("Expected ") and "\n" not in reports[1]["error"]
    assert "Traceback" not in said and outputs(folder) == ["egg.ma", "last.ma"]


def test_a_fault_while_it_is_computed(folder, run, monkeypatch):  # noqa: F811
    compute_axis, shapes = axis_work.compute_axis, []

    def broken(shape, *rest, **options):
        shapes.append(shape)
        if len(shapes) == 2:
            raise np.core._exceptions._ArrayMemoryError((10**9, 3), np.dtype(float))
        return compute_axis(shape, *rest, **options)

    monkeypatch.setattr(axis_work, "compute_axis", broken)
    write_egg(folder / "middle.xyz", 1.1)
    code, reports, said = run("egg.xyz", "middle.xyz", "last.xyz", "out/")
    assert code == cli.FAILED and [r["status"] for r in reports] == ["done", "failed", "done"]
    assert reports[1]["kind"] == "OutOfMemoryError" and "Traceback" not in said


def test_a_corner_that_no_number_holds(folder, run):  # noqa: F811
    Path("huge.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 99999999999999999999 1 2\n")
    code, reports, _ = run("huge.obj", "last.xyz", "out/")
    assert code == cli.INPUT and [r["status"] for r in reports] == ["failed", "done"]
    assert "after 'f' in line 4 of 'huge.obj', found '999999" in reports[0]["error"]


def test_a_report_that_cannot_be_written(folder, run):  # noqa: F811
    (folder / "out" / "egg.ma.json").mkdir(parents=True)
    code, reports, _ = run("egg.xyz", "last.xyz", "out/")
    assert code == cli.FAILED and [r["status"] for r in reports] == ["failed", "done"]
    assert "which is written" in reports[0]["error"]


def test_a_system_without_threads(folder, run, monkeypatch):  # noqa: F811
    def none(self):
        raise RuntimeError("can't start new thread")

    monkeypatch.setattr(job_module.threading.Thread, "start", none)
    code, reports, said = run("egg.xyz", "last.xyz", "out/")
    assert (code, said) == (cli.DONE, "") and [r["status"] for r in reports] == ["done", "done"]


# --- streams


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full")
def test_standard_output_is_full(folder, program):  # noqa: F811
    with open("/dev/full", "wb") as full:
        done = program("egg.xyz", "last.xyz", "out/", stdout=full)
    assert done.returncode == cli.FAILED and outputs(folder) == ["egg.ma", "last.ma"]
    assert done.stderr.count("\n") == 1 and "No space left" in done.stderr


@pytest.mark.parametrize("closed", [">&-", "2>&-", ">&- 2>&-"])
def test_standard_streams_that_are_closed(folder, program, closed):  # noqa: F811
    done, wrong = (
        subprocess.run(
            ["sh", "-c", f"{sys.executable} -m medial_axis {words} {closed}"],
            env=program.environment,
            capture_output=True,
        )
        for words in ("egg.xyz absent.xyz last.xyz out/", "egg.xyz")
    )
    assert done.returncode == cli.INPUT and outputs(folder) == ["egg.ma", "last.ma"]
    assert b"Traceback" not in done.stdout + done.stderr
    assert wrong.returncode == cli.USAGE


# --- signals


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_while_a_weak_reference_dies(folder, monkeypatch, capsys, number):
    """Python prints and drops an exception that a weak reference's callback raises; the signal is raised again."""

    class Thing:
        pass

    def finish(*rest):
        thing = Thing()
        reference = weakref.ref(thing, lambda _: os.kill(os.getpid(), number))
        del thing
        time.sleep(5)
        pytest.fail(f"{reference} was in vain")

    monkeypatch.setattr(cli, "finish", finish)
    assert cli.main(["egg.xyz", "egg.ma"]) == cli.CANCELLED
    assert "Exception ignored" not in capsys.readouterr().err


def test_ctrl_c_while_the_compiled_module_is_loaded(folder, monkeypatch, capsys):
    """It comes out of there as an ImportError; nothing says then that the file were wrong, now or later."""

    def interrupted(name):
        raise ImportError("initialization failed") from KeyboardInterrupt()

    with monkeypatch.context() as patch:
        patch.setattr(native, "_module", None)
        patch.setattr(native, "_imported", interrupted)
        assert cli.main(["egg.xyz", "egg.ma"]) == cli.CANCELLED
        assert native._failure == "" and "Expected" not in capsys.readouterr().err
    assert cli.main(["egg.xyz", "egg.ma"]) == cli.DONE


def test_the_package_loads_nothing_before_signals_are_ours(program):  # noqa: F811
    """Ctrl-C prints a traceback during imports that come before the handler is set."""
    code = (
        "import _signal, runpy, sys; known = {*sys.modules}\n"
        "_signal.signal = lambda *_: sys.exit(' '.join({*sys.modules} - known))\n"
        "runpy.run_module('medial_axis', run_name='__main__', alter_sys=True)\n"
    )
    said = subprocess.run(
        [sys.executable, "-c", code], env=program.environment, capture_output=True
    )
    assert said.stderr == b"medial_axis\n"


@pytest.mark.oracle
@pytest.mark.parametrize("seed", repeats(6))
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_fuzzed_signals_from_the_first_instant(folder, program, number, seed):  # noqa: F811
    """Wherever it is hit: cancelled, or all is done; never a traceback, also where a second signal follows."""
    random = np.random.default_rng([seed, number])
    np.save("many.npy", np.random.default_rng(1).normal(size=(20_000, 3)))
    process = program("many.npy", "many.ma", "--side", "both", popen=True)
    time.sleep(0.05 + float(random.uniform(0, 1.0)))
    process.send_signal(number)
    time.sleep(float(random.uniform(0, 0.2)))
    process.send_signal(number)
    _, said = process.communicate()
    # Before it comes to us, Python itself says what it likes.
    if "Traceback" in said or process.returncode not in (cli.CANCELLED, cli.DONE, -number):
        assert "medial_axis" not in said, said
    if process.returncode != cli.DONE and Path("many.ma.json").exists():
        # Between the last byte and the end: what is there is whole, and kept.
        again = program("many.npy", "many.ma", "--side", "both", "--json")
        assert json.loads(again.stdout)["status"] == "kept"
