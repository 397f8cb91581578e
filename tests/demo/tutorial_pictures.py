#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the pictures of docs/tutorial.md: plays the scene `tutorial` in Blender's window; keeps what it sees, small.

    python3 tests/demo/tutorial_pictures.py [--blender blender] [--output docs/pictures]

Needs what the tests of the window need: Xvfb, xdotool and ImageMagick.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
VIEWPORT = "1056x636+0+22"  # of the window: without the editors on the right and below
WIDTH, COLOURS = 880, 128


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--blender", default="blender")
    parser.add_argument("--output", type=Path, default=ROOT / "docs" / "pictures")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        runner = [sys.executable, ROOT / "tests" / "addon" / "run.py", "--gui", "--keep", folder]
        subprocess.run([*runner, "--blender", arguments.blender, "tutorial"], check=True)
        for path in sorted(Path(folder).glob("tutorial-*.png")):
            make_small(path, arguments.output / path.name.replace("-", "_"))
    return 0


def make_small(path: Path, target: Path) -> None:
    """The viewport alone, in few colours; without times, so that the same picture is the same file."""
    words = f"-crop {VIEWPORT} +repage -resize {WIDTH} +dither -colors {COLOURS} -strip".split()
    words += ["-define", "png:exclude-chunks=date,time", "-define", "png:compression-level=9"]
    subprocess.run(["convert", path, *words, target], check=True)


if __name__ == "__main__":
    sys.exit(main())
