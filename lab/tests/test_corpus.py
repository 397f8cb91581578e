# SPDX-License-Identifier: GPL-3.0-or-later
"""The corpus: a folder of two meshes gives a table and a picture; a second run says what changed."""

import csv
import shutil
import subprocess
import sys

import pytest
from support import crisp_solids
from support import meshes as made

from lab.corpus import __main__ as corpus
from lab.corpus import packages, run, table


@pytest.fixture
def folder(tmp_path):
    """A box, the same once more, and a file that is no mesh."""
    there = tmp_path / "there"
    (there / "usr" / "share").mkdir(parents=True)
    made.write_off(there / "usr" / "share" / "box.off", crisp_solids.solid("box").mesh)
    shutil.copy(there / "usr" / "share" / "box.off", there / "usr" / "share" / "same.off")
    (there / "torn.obj").write_text("v 0 0 zero\n")
    return there


def of(tmp_path, folder, *words):
    out = tmp_path / "out"
    assert corpus.main(["--folder", str(folder), "--output", str(out), *words]) == 0
    with open(out / "corpus.csv", newline="") as stream:
        return {row["mesh"]: row for row in csv.DictReader(stream)}


def test_a_folder_and_then_again(medial, tmp_path, folder):
    rows = of(tmp_path, folder, "--pictures")
    assert list(rows) == ["box.off", "torn.obj"]
    assert rows["box.off"]["betti"] == rows["box.off"]["by faces"] == "(1, 0, 0)"
    assert rows["box.off"]["said"] == "" and float(rows["box.off"]["seconds"]) > 0
    assert rows["torn.obj"]["exit"] == "3" and rows["torn.obj"]["said"].startswith("Expected")
    if shutil.which("montage"):
        assert (tmp_path / "out" / "corpus.png").read_bytes()[:4] == b"\x89PNG"
    (folder / "torn.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    rows = of(tmp_path, folder, "--only", "torn")
    assert rows["torn.obj"]["changed"].startswith("sha256 was")
    assert rows["box.off"]["changed"] == ""  # it did not run and keeps its row


@pytest.mark.parametrize(
    ("words", "end"),
    [
        ("while True: pass", "SIGXCPU"),
        ("bytearray(1 << 28)", "1"),
        ("import time; time.sleep(60)", "SIGKILL"),
    ],
)
def test_a_process_ends_at_its_limit(words, end):
    limits = run.Limits(seconds=1, megabytes=100)
    process = subprocess.Popen([sys.executable, "-S", "-c", words], preexec_fn=limits.set)
    assert table.exit_words(run.ended(process, 1 if "sleep" in words else 60)[0]) == end


def test_what_counts_as_a_change():
    rows = [{**dict.fromkeys(table.HEADER, ""), "mesh": name, "seconds": "2.0"} for name in "abcd"]
    before = [dict(row) for row in rows[:3]]
    before[0]["seconds"], before[1]["seconds"], before[2]["exit"] = "2.9", "3.1", "SIGKILL"
    changed = [row["changed"] for row in table.compared(rows, before)]
    assert changed == ["", "seconds were 3.1", "exit was SIGKILL", "new"]


def test_warnings_are_shortened():
    assert table.short("the surface is open at 3 edges: inside is so and so") == (
        "the surface is open at 3 edges"
    )
    assert len(table.short("word " * 40)) < 80 and table.short("word " * 40).endswith("word ...")


def test_packages_are_named_with_version_and_hash():
    for package in packages.listed():
        assert package.name and package.version and len(package.sha256) == 64
