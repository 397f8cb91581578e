# SPDX-License-Identifier: GPL-3.0-or-later
"""Trials with processes of their own: kills, pipes, names, several at once, batches with bad items."""

import json
import os
import signal
import subprocess
import sys
import time
from functools import cache
from pathlib import Path
from tempfile import mkdtemp

import numpy as np

from .inside import GOOD, Random, mutated, read_shape

ROOT = Path(__file__).resolve().parents[2]
SUFFIXES = (".ma", ".ply", ".obj", ".off", ".npz")
LIMIT_SECONDS = 200


@cache
def environment() -> dict[str, str]:
    """In which `python3 -m medial_axis` is the add-on's folder."""
    folder = Path(mkdtemp(prefix="breaking_package_"))
    (folder / "medial_axis").symlink_to(ROOT / "blender_addon", target_is_directory=True)
    return {**os.environ, "PYTHONPATH": str(folder), "PYTHONDONTWRITEBYTECODE": "1"}


def _start(folder: Path, *words: object, **options) -> subprocess.Popen:
    command = [sys.executable, "-m", "medial_axis", *words]
    options = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "cwd": folder, **options}
    return subprocess.Popen(command, env=environment(), **options)


def _run(folder: Path, *words: object, **options) -> tuple[int, bytes, bytes]:
    process = _start(folder, *words, **options)
    try:
        out, err = process.communicate(timeout=LIMIT_SECONDS)
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()
        raise AssertionError(f"no end in {LIMIT_SECONDS} s: {words}") from None
    return process.returncode, out or b"", err or b""


def _shapes(folder: Path, random: Random, count: int, points: int = 2000) -> list[str]:
    """Names of clouds, each of another ellipsoid."""
    names = [f"shape{i}.npy" for i in range(count)]
    for name in names:
        rows = random.normal(size=(points, 3))
        rows /= np.linalg.norm(rows, axis=1)[:, None]
        np.save(folder / name, rows * random.choice([(1, 1, 1), (1, 0.8, 0.6), (1, 1, 0.2)]))
    return names


def _is_whole(path: Path) -> None:
    """An output can be read to its end."""
    if path.suffix == ".ma":
        lines = path.read_text().splitlines()
        assert len(lines) - 1 == sum(map(int, lines[0].split()[:3])), f"half of {path.name}"
    elif path.suffix == ".npz":
        with np.load(path) as arrays:
            assert all(len(np.atleast_1d(arrays[name])) >= 0 for name in arrays)
    elif path.stat().st_size and b"0 0 0" not in path.read_bytes()[:40]:
        read_shape(path)


def _no_traceback(err: bytes) -> None:
    assert b"Traceback" not in err, err.decode(errors="replace")[-600:]


def killed(random: Random, folder: Path) -> None:
    """Every file there is whole; resuming leaves the same files as an undisturbed run."""
    names, suffix = _shapes(folder, random, 3), str(random.choice(SUFFIXES))
    words = (*names, "out/{name}" + suffix)
    process = _start(folder, *words)
    time.sleep(float(random.uniform(0.2, 2.5)))
    process.send_signal(signal.SIGKILL)
    process.communicate()
    for path in (folder / "out").glob(f"*{suffix}"):
        _is_whole(path)
    for path in (folder / "out").glob("*.json"):
        json.loads(path.read_bytes())
    code, _, err = _run(folder, *words)
    _no_traceback(err)
    assert code == 0, err
    expected = {f"{Path(name).stem}{suffix}" for name in names}
    found = {path.name for path in (folder / "out").iterdir()}
    assert found >= expected | {f"{name}.json" for name in expected}, found


def closed_pipes(random: Random, folder: Path) -> None:
    """The reader of the output closes the pipe after some bytes."""
    names = _shapes(folder, random, 4, 300)
    process = _start(folder, *names, "out/", *(["--json"] if random.random() < 0.5 else []))
    process.stdout.read(int(random.integers(0, 400)))
    process.stdout.close()
    err = process.stderr.read()
    code = process.wait(LIMIT_SECONDS)
    _no_traceback(err)
    assert code in (0, 141), (code, err)
    for path in (folder / "out").glob("*.ma"):
        _is_whole(path)


def odd_names(random: Random, folder: Path) -> None:
    """Bytes of any value but those that no name holds; a good input behind it is done in any case."""
    _shapes(folder, random, 2, 300)
    length = int(random.choice([1, 3, 9, 120, 240, 247, 251]))
    alphabet = [*range(1, 47), *range(48, 256)]
    if random.random() < 0.5:
        alphabet = list(b"-#{}%~$*?'\"\\ \n\t.:;&|<>()[]ae\xc3\xa9\xff")
    name = bytes(random.choice(alphabet, length).astype(np.uint8).tolist()) + b".npy"
    os.rename(os.fsencode(folder / "shape0.npy"), os.fsencode(folder) + b"/" + name)
    suffix = str(random.choice(SUFFIXES))
    code, _, err = _run(folder, "--", os.fsdecode(name), "shape1.npy", "out/{name}" + suffix)
    _no_traceback(err)
    assert code in (0, 1, 2, 3), (name, code, err)
    assert code != 2 or err, name
    assert code == 2 or (folder / "out" / f"shape1{suffix}").exists(), (name, code, err)


def at_once(random: Random, folder: Path) -> None:
    """Several into one folder: each ends well, and the bytes are those of one alone."""
    names, suffix = _shapes(folder, random, 3, 400), str(random.choice(SUFFIXES))
    together = [_start(folder, *random.permutation(names), "out/{name}" + suffix) for _ in range(4)]
    for process in together:
        _, err = process.communicate(timeout=LIMIT_SECONDS)
        _no_traceback(err)
        assert process.returncode == 0, err
    assert _run(folder, *names, "alone/{name}" + suffix)[0] == 0
    for name in names:
        one, other = (folder / room / f"{Path(name).stem}{suffix}" for room in ("out", "alone"))
        assert one.read_bytes() == other.read_bytes(), name
    assert len(list((folder / "out").iterdir())) == 6, sorted(
        x.name for x in (folder / "out").iterdir()
    )


def bad_items(random: Random, folder: Path) -> None:
    """Mutated files among good ones: as many reports as items, every good one done."""
    good = _shapes(folder, random, 2, 300)
    bad = []
    for i in range(int(random.integers(1, 5))):
        name = str(random.choice(sorted(GOOD)))
        bad.append(f"bad{i}{Path(name).suffix}")
        (folder / bad[-1]).write_bytes(mutated(GOOD[name], random))
    names = [str(name) for name in random.permutation([*good, *bad, "absent.off"])]
    code, out, err = _run(folder, *names, "out/", "--json", "--samples", "300")
    _no_traceback(err)
    reports = [json.loads(line) for line in out.splitlines()]
    assert [report["input"] for report in reports] == names, err
    states = {report["input"]: report["status"] for report in reports}
    assert all(states[name] == "done" for name in good) and states["absent.off"] == "failed"
    assert code in (1, 3), code
