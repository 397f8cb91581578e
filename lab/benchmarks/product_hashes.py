#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints a hash of each file that the command line writes: every product x inputs x formats, for changes that may not
change a result.

    python3 lab/benchmarks/product_hashes.py > old
    python3 lab/benchmarks/product_hashes.py | diff old -
    python3 lab/benchmarks/product_hashes.py --checkout PATH cup thickness     another checkout; jobs with these words

A job that is refused has its message in place of a hash. Reports are hashed without their seconds, paths and
stamp, which holds the version. `output_hashes.py` does the same for the compiled module alone.
"""

import argparse
import concurrent.futures
import hashlib
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests"))

from support.data import DATA  # noqa: E402 - found through the line above

PRODUCTS = {
    "axis": (["ply", "ma", "obj", "off", "npz", "csv"], []),
    "axis curve": (["npz"], ["--form", "curve"]),
    "axis published": (["npz"], ["--form", "published"]),
    "axis voronoi": (["npz"], ["--mesh", "voronoi"]),
    "axis levels": (["npz"], ["--simplify", "3", "--erode", "2", "--spike", "2"]),
    "axis both": (["npz"], ["--side", "both"]),
    "skeleton": (["swc", "obj", "json", "csv", "vtp"], []),
    "thickness": (["csv", "ply"], ["--limit", "0.3"]),
    "thicken": (["stl"], ["--limit", "0.3"]),
    "midsurface": (["obj", "inp"], []),
    "hollow": (["stl"], []),
    "solidify": (["stl"], []),
    "balls": (["ma", "urdf", "xml"], ["--count", "16"]),
    "balls capsules": (["json"], ["--shapes", "capsules", "--count", "4"]),
}
_OF_THE_RUN = ("stamp", "version", "input", "output")
FILES = ("3holes.off", "spot_low.obj", "knot1.off", "club.off", "cactus.xyz")


def off(points, faces) -> str:
    rows = [f"{x!r} {y!r} {z!r}" for x, y, z in np.asarray(points, float).tolist()]
    rows += [" ".join(map(str, (len(f), *f))) for f in faces]
    return "\n".join(["OFF", f"{len(points)} {len(faces)} 0", *rows, ""])


def prism(profile, height: float) -> str:
    """A solid with the ring `profile` of (x, y) as its floor and its lid."""
    n = len(profile)
    points = [(x, y, z) for z in (0.0, height) for x, y in profile]
    sides = [(i, (i + 1) % n, n + (i + 1) % n, n + i) for i in range(n)]
    return off(points, [tuple(reversed(range(n))), tuple(range(n, 2 * n)), *sides])


def turned(profile, sides: int) -> str:
    """A solid turned round z from the closed ring `profile` of (radius, z)."""
    a = 2 * np.pi * np.arange(sides) / sides
    points = [(r * np.cos(t), r * np.sin(t), z) for t in a for r, z in profile]
    n, m = len(profile), len(points)
    corner = lambda i, j: (i * n + j % n) % m
    ring = [(i, j) for i in range(sides) for j in range(n)]
    return off(
        points,
        [(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)) for i, j in ring],
    )


def shapes() -> dict[str, str]:
    """Name -> text of an .off file of a small solid."""
    hexagon = [(np.cos(t), np.sin(t)) for t in np.arange(6) * np.pi / 3]
    angle = [(0, 0), (4, 0), (4, 0.2), (0.2, 0.2), (0.2, 3), (0, 3)]
    circle = [(2 + 0.5 * np.cos(t), 0.5 * np.sin(t)) for t in np.arange(12) * np.pi / 6]
    return {
        "box": prism([(0, 0), (3, 0), (3, 2), (0, 2)], 1.0),
        "plate": prism([(0, 0), (5, 0), (5, 3), (0, 3)], 0.2),
        "hexagon": prism(hexagon, 2.0),
        "angle": prism(angle, 3.0),
        "pipe": turned([(0.9, 0.0), (1.0, 0.0), (1.0, 4.0), (0.9, 4.0)], 24),
        "ring": turned(circle, 24),
        "cup": turned(
            [(1e-3, 0.0), (1.0, 0.0), (1.2, 2.0), (1.1, 2.0), (0.9, 0.1), (1e-3, 0.1)], 16
        ),
        "far away": prism([(1e4, 0), (1e4 + 3, 0), (1e4 + 3, 2), (1e4, 2)], 1.0),
        "flat": "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n",
    }


def write_inputs(folder: Path) -> list[Path]:
    for name, text in shapes().items():
        (folder / f"{name}.off").write_text(text, encoding="ascii")
    return [
        *sorted(folder.glob("*.off")),
        *(DATA / f for f in FILES if DATA and (DATA / f).exists()),
    ]


def without_seconds(value):
    """A report without what differs from run to run, and from version to version."""
    if isinstance(value, dict):
        return {
            k: without_seconds(v)
            for k, v in value.items()
            if "seconds" not in k and k not in _OF_THE_RUN
        }
    return [without_seconds(v) for v in value] if isinstance(value, list) else value


def hash_of(path: Path) -> str:
    data = path.read_bytes()
    if path.name.endswith(".json"):
        data = json.dumps(without_seconds(json.loads(data)), sort_keys=True).encode()
    return hashlib.sha256(data).hexdigest()[:16]


def run(checkout: Path, product: str, source: Path, extension: str) -> list[str]:
    """Rows of one job: "product, input, file, hash or message"."""
    command, options = product.split()[0], PRODUCTS[product][1]
    with tempfile.TemporaryDirectory() as folder:
        words = [
            *([] if command == "axis" else [command]),
            str(source),
            f"{folder}/out.{extension}",
            *options,
        ]
        done = subprocess.run(
            [sys.executable, "-m", "blender_addon", *words],
            cwd=checkout,
            env={**os.environ, "OMP_NUM_THREADS": "1"},
            capture_output=True,
            text=True,
            check=False,
        )
        files = sorted(p for p in Path(folder).iterdir() if p.is_file())
        found = {p.name: hash_of(p) for p in files} or {"": done.stderr.strip().splitlines()[-1:]}
    return [
        f"{product}, {source.stem}, {name or extension}, {what}" for name, what in found.items()
    ]


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "words", nargs="*", help="only jobs with one of these words in their product or input"
    )
    parser.add_argument("--checkout", type=Path, default=ROOT)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(2) as pool:
        sources = write_inputs(Path(folder))
        jobs = [
            (p, s, e)
            for p, (extensions, _) in PRODUCTS.items()
            for s in sources
            for e in extensions
        ]
        jobs = [
            j
            for j in jobs
            if not options.words or any(w in f"{j[0]} {j[1].stem}" for w in options.words)
        ]
        for rows in pool.map(lambda job: run(options.checkout, *job), jobs):
            print(*rows, sep="\n", flush=True)


if __name__ == "__main__":
    main()
