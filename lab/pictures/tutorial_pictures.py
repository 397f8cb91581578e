#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the pictures of docs/tutorial.md, and those of the panel in other pages: plays scenes in Blender's window;
keeps what they see, small.

    python3 lab/pictures/tutorial_pictures.py [--blender blender] [--output docs/pictures]

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
# The screenshot of a scene -> the picture of the panel alone, and its place in the window.
PANELS = {
    "cancel_with_escape-running": ("progress", "192x240+836+84"),
    "missing_module-message": ("missing_module", "192x320+836+84"),
}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--blender", default="blender")
    parser.add_argument("--output", type=Path, default=ROOT / "docs" / "pictures")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        runner = [sys.executable, ROOT / "tests" / "addon" / "run.py", "--gui", "--keep", folder]
        scenes = ["tutorial", *(name.partition("-")[0] for name in PANELS)]
        subprocess.run([*runner, "--blender", arguments.blender, *scenes], check=True)
        for path in sorted(Path(folder).glob("tutorial-*.png")):
            make_small(path, arguments.output / path.name.replace("-", "_"), VIEWPORT, WIDTH)
        for seen, (name, place) in PANELS.items():
            make_small(Path(folder, f"{seen}.png"), arguments.output / f"{name}.png", place, 288)
    return 0


def make_small(path: Path, target: Path, place: str, width: int) -> None:
    """A part of the window, in few colours; without times, so that the same picture is the same file."""
    words = f"-crop {place} +repage -resize {width} +dither -colors {COLOURS} -strip".split()
    words += ["-define", "png:exclude-chunks=date,time", "-define", "png:compression-level=9"]
    subprocess.run(["convert", path, *words, target], check=True)


if __name__ == "__main__":
    sys.exit(main())
