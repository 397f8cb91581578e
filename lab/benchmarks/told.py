# SPDX-License-Identifier: GPL-3.0-or-later
"""Is every wrong Betti number of noisy points told, with its cause? A Markdown table.

    python3 lab/benchmarks/told.py [--output table.md] [--seeds 3] [--only scans ...]

shapes  ten exact shapes, as scans.py makes them, with noise of 0.1 to 2 spacings
shells  a shell whose walls are a few spacings apart, 12,000 samples
meshes  20,000 samples of closed meshes, as there; one seed
scans   virtual scans of the rocker arm, as scan_race.py makes them

Each is analysed with Prepare Off and Automatic. Wrong: the pieces, loops and cavities of Clean are not those of the
solid, or the program refused, which is always told. Named: a sentence of the result names noise, layers, outliers,
openings, or inside as a guess. Results that are wrong and not named are listed below the table with what was said.
"""

import sys
from collections.abc import Iterator

import _module
import numpy as np
import scan_race
import scans
from medial_axis.core.files.read_shape import read_shape
from medial_axis.core.settings import Prepare
from support.shapes import SHAPES
from virtual_scan import scan

NOISES = (0.1, 0.25, 0.5, 1.0, 2.0)
OF_SHELL, OF_SAMPLES = (0.1, 0.25, 0.5, 1.0), 12_000
WAYS = (Prepare.OFF, Prepare.AUTOMATIC)
HEADER = ["points", "noise or fault", "results", "wrong, off", "wrong, prepared", "not named"]
# A case: its name, the noise or fault, the points, and the right Betti numbers.
Case = tuple[str, str, np.ndarray, tuple[int, int, int]]


def shapes(seeds: int) -> Iterator[Case]:
    for noise in NOISES:
        for name, (shape, truth) in scans.SOLIDS.items():
            for seed in range(1, seeds + 1):
                yield name, f"{noise:g}", scans.noisy(shape, noise, seed)[0], truth


def shells(seeds: int) -> Iterator[Case]:
    for noise in OF_SHELL:
        for seed in range(1, seeds + 1):
            points = scans.noisy(SHAPES["shell"], noise, seed, OF_SAMPLES)[0]
            yield "shell", f"{noise:g}", points, (1, 0, 1)


def meshes(_: int) -> Iterator[Case]:
    for noise in (0.5, 1.0):
        for name in scans.MESHES:
            shape = scans.Meshed(name)
            points = scans.noisy(shape, noise, 1, scans.COUNT_OF_MESHES)[0]
            yield name, f"{noise:g}", points, shape.betti


def scanned(seeds: int) -> Iterator[Case]:
    shape = read_shape(_module.DATA / scan_race.MESH)[0]
    for name, faults in scan_race.SCANS.items():
        for seed in range(1, seeds + 1):
            points = scan(shape.points, shape.triangles, scan_race.PITCH, faults, seed)
            yield scan_race.MESH, name, points, (1, 1, 0)


GROUPS = {"shapes": shapes, "shells": shells, "meshes": meshes, "scans": scanned}


def judged(case: Case, prepare: Prepare) -> tuple[bool, str]:
    """Whether the result is wrong, and what was said if that names no cause."""
    found, text = scans.betti_of(case[2], prepare)
    if found is None:
        return True, ""
    wrong = found.axis.level.betti != case[3]
    if not wrong or any(cause in said for said in found.warnings for cause in scans.CAUSES):
        return wrong, ""
    return True, f"{text}: " + ("; ".join(found.warnings) or "nothing")


def main() -> None:
    parser = _module.parser(__doc__)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--only", nargs="+", choices=list(GROUPS), default=list(GROUPS))
    wanted = parser.parse_args()
    rows: dict[tuple[str, str], list[int]] = {}
    silent = []
    for group in wanted.only:
        for case in GROUPS[group](wanted.seeds):
            name = "ten shapes" if group == "shapes" else case[0]
            counts = rows.setdefault((name, case[1]), [0, 0, 0, 0])
            for column, prepare in enumerate(WAYS):
                wrong, said = judged(case, prepare)
                counts[0] += 1
                counts[1 + column] += wrong
                counts[3] += bool(said)
                if said:
                    silent.append(f"- {case[0]}, {case[1]}, {prepare.value}: {said}\n")
            print(case[0], case[1], *counts, file=sys.stderr, flush=True)
    table = _module.markdown(HEADER, [[*key, *map(str, row)] for key, row in rows.items()])
    _module.publish(table + "\n" + "".join(silent), wanted.output)


if __name__ == "__main__":
    main()
