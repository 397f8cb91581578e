# SPDX-License-Identifier: GPL-3.0-or-later
"""Random commands on random names of files: no input is ever changed, and a refused command changes nothing.

Names are relative, absolute, links, hard links and detours; outputs are new files, existing ones, and inputs.
"""

import contextlib
import io
import os
import random

import numpy as np
import pytest
from medial_axis import cli
from support.meshes import box, write_obj, write_off

from tests.support.fuzz import repeats

KINDS = {
    "axis": ("ply", "obj", "off", "ma", "npz"),
    "thickness": ("ply", "csv", "json"),
    "skeleton": ("obj", "json", "swc", "csv", "vtp"),
    "balls": ("ma", "json"),
}
FEW = ["--sampling", "surface", "--samples", "100", "--quiet"]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Some meshes under several names, results of earlier runs, and a folder for outputs."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "sub").mkdir()
    (tmp_path / "out").mkdir()
    mesh = box((3, 3, 3), (0.5, 0.4, 0.3))
    write_off(tmp_path / "a.off", mesh)
    write_off(tmp_path / "sub" / "a.off", mesh)
    for name in ("b.obj", "with space.obj", "sub/b.obj"):
        write_obj(tmp_path / name, mesh)
    np.savez(tmp_path / "c.npz", points=mesh[0], triangles=mesh[1])
    os.link(tmp_path / "a.off", tmp_path / "hard.off")
    os.symlink("b.obj", tmp_path / "soft.obj")
    os.symlink("sub", tmp_path / "linked")
    (tmp_path / "old.ply").write_text("the result of an earlier run")
    (tmp_path / "out" / "a.ply").write_text("and another one")
    return tmp_path


INPUTS = (
    "a.off", "b.obj", "with space.obj", "sub/a.off", "sub/b.obj", "c.npz", "hard.off", "soft.obj",
)  # fmt: skip


def alias(rng, name, folder):
    """The same file, called differently."""
    ways = (name, f"./{name}", f"sub/../{name}", f"linked/../sub/../{name}", str(folder / name))
    return rng.choice(ways)


def words_of(rng, folder):
    command = rng.choice(list(KINDS))
    inputs = [alias(rng, name, folder) for name in rng.sample(INPUTS, rng.choice((1, 1, 2, 3)))]
    kind = rng.choice(KINDS[command])
    output = rng.choice(
        (
            "out/new." + kind, "old." + kind, alias(rng, rng.choice(INPUTS), folder),
            f"{{name}}.{kind}", f"sub/{{name}}.{kind}", f"linked/{{name}}.{kind}", ".", "out/",
            "sub/", str(folder),
        )
    )  # fmt: skip
    options = ["--format", kind] if output.rpartition(".")[2] not in KINDS[command] else []
    options += rng.choice(([], ["--json"]))
    words = [] if command == "axis" else [command]
    return [*words, *inputs, output, *options, *FEW], inputs


def contents(folder):
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and "linked" not in path.relative_to(folder).parts
    }


def run(words):
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        return cli.main(words)


@pytest.mark.parametrize("seed", repeats(60))
def test_fuzzed_outputs(folder, seed):
    rng = random.Random(seed)
    for _ in range(3):  # a later command may meet what an earlier one made
        words, inputs = words_of(rng, folder)
        before = contents(folder)
        read = {path: (folder / path).read_bytes() for path in inputs}
        code = run(words)
        after = contents(folder)
        for path, kept in read.items():
            assert (folder / path).read_bytes() == kept, (words, path)
        assert before.keys() <= after.keys(), words
        if code == cli.USAGE:
            assert after == before, words
        new = after.keys() - before.keys()
        assert not [name for name in new if name.endswith((".tmp", ".part", "~"))], (words, new)


def test_both_ends_are_met(folder):
    """Among the first commands some are refused and some are done; else the fuzz tells nothing."""
    codes = {run(words_of(random.Random(seed), folder)[0]) for seed in range(20)}
    assert {cli.USAGE, cli.DONE} <= codes
