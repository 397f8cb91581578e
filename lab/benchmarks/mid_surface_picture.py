# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the section of a T with its medial axis and with its middle surface, from the formulas of both.

python3 lab/benchmarks/mid_surface_picture.py [--output docs/pictures]
"""

import argparse
from pathlib import Path

import numpy as np
from _drawing import INK, RED, picture, stroke

BLUE, SOLID = "#2563a8", "#dfe6ee"
LONG, HIGH, WALL = 336.0, 192.0, 40.0  # of the whole section, and of both walls
MIDDLE, FOOT = LONG / 2, HIGH - WALL / 2  # of the walls
LEFT, RIGHT, TOP = 24.0, 400.0, 24.0  # of the two panels


def outline():
    """(8, 2) corners of the section."""
    near, far = MIDDLE - WALL / 2, MIDDLE + WALL / 2
    top = HIGH - WALL
    return np.array(
        [
            (0, HIGH),
            (LONG, HIGH),
            (LONG, top),
            (far, top),
            (far, 0),
            (near, 0),
            (near, top),
            (0, top),
        ]
    )


def medial_axis():
    """Lines (n, 2). A ball that touches the foot and the edge between two walls has its centre on a parabola."""
    along = np.linspace(0.0, WALL / 2, 21)
    half = np.stack([MIDDLE - WALL / 2 + along, FOOT - along**2 / (2 * WALL)], axis=1)
    half = np.vstack([[(WALL / 2, FOOT)], half])
    end = np.array([(0, HIGH), (WALL / 2, FOOT), (0, HIGH - WALL)])
    fork = np.array([(MIDDLE - WALL / 2, 0), (MIDDLE, WALL / 2), (MIDDLE + WALL / 2, 0)])
    return [half, mirrored(half), np.array([half[-1], fork[1]]), end, mirrored(end), fork]


def mirrored(line):
    return np.array([LONG, 0.0]) + line * (-1.0, 1.0)


def panel(left: float, colour: str, width: float, lines) -> list[str]:
    place = np.array([left, TOP])
    corners = " ".join(f"{x:.1f},{y:.1f}" for x, y in outline() + place)
    section = f'<polygon points="{corners}" fill="{SOLID}" stroke="{INK}" stroke-width="1"/>'
    return [section, *(stroke(line + place, colour, width) for line in lines)]


def mid_surface() -> str:
    sheets = [
        np.array([(0, FOOT), (LONG, FOOT)]),
        np.array([(MIDDLE, FOOT), (MIDDLE, 0)]),
    ]
    meeting = f'<circle cx="{RIGHT + MIDDLE:.1f}" cy="{TOP + FOOT:.1f}" r="5" fill="{BLUE}"/>'
    parts = [*panel(LEFT, RED, 2, medial_axis()), *panel(RIGHT, BLUE, 3, sheets), meeting]
    legend = [
        (RED, "medial axis: it bulges where the walls meet, and forks at their ends"),
        (BLUE, "middle surface: three sheets that meet in one line"),
    ]
    return picture("Medial axis and middle surface of a T", 284, parts, legend)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    default = Path(__file__).resolve().parents[2] / "docs" / "pictures"
    parser.add_argument("--output", type=Path, default=default)
    output = parser.parse_args().output
    (output / "mid_surface.svg").write_text(mid_surface(), encoding="utf-8")


if __name__ == "__main__":
    main()
