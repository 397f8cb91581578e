# SPDX-License-Identifier: GPL-3.0-or-later
"""The race in one command; rows that are there already are not run again.

python3 -m lab.race                       2,000 to 20,000 samples, clean and noisy; the page and plots
python3 -m lab.race --sizes 100000 --solids ellipsoid torus
python3 -m lab.race --programs "Power Crust" --page table.md
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path

from . import ROOT, page, recipes
from .run import Case, Inputs, Row, run
from .solids import SOLIDS, outer_points

KEYS = ("solid", "size", "noisy", "outer", "program")
OUTER_SIZE = 8000
"""Outer axes are judged at this size, clean."""
Turn = tuple[recipes.Recipe, bool]
"""A program, and whether it is asked for the outer axis."""


def main() -> None:
    options = _options()
    rows = _read(options.folder / "rows.jsonl")
    there = {tuple(row[key] for key in KEYS) for row in rows}
    wanted, skipped = _wanted(options.programs)
    inputs = Inputs(options.folder / "inputs")
    with (
        (options.folder / "rows.jsonl").open("a", encoding="utf-8") as file,
        ProcessPoolExecutor(options.workers) as pool,
    ):
        waiting = [
            pool.submit(_one_case, case, turns, inputs, options.limit)
            for case, turns in _cases(options, wanted, there)
        ]
        for done in as_completed(waiting):
            rows += done.result()
            file.writelines(json.dumps(row) + "\n" for row in done.result())
            file.flush()
    page.write(rows, skipped, options.page)


def _one_case(case: Case, turns: list[Turn], inputs: Inputs, limit: int) -> list[Row]:
    """In a process of its own, so that the judge has a core; no other one makes the same inputs."""
    rows = []
    for recipe, outer in turns:
        rows.append(run(recipe, case, inputs, limit, outer))
        found = rows[-1].get("failed") or "{mean:.1e} {missed_mean:.1e}".format_map(rows[-1])
        print(f"{case}{' outside' if outer else ''}, {recipe.name}: {found}", flush=True)
    return rows


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--sizes", type=int, nargs="+", default=[2000, 8000, 20_000])
    parser.add_argument("--solids", nargs="+", default=list(SOLIDS), choices=list(SOLIDS))
    parser.add_argument("--programs", nargs="+", help="names of recipes.toml; default: all")
    parser.add_argument("--clean", action="store_true", help="no noisy samples")
    parser.add_argument("--limit", type=int, default=300, help="seconds that a program may take")
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--folder", type=Path, default=ROOT / "build" / "race")
    parser.add_argument("--page", type=Path, default=ROOT / "docs" / "lab" / "benchmark.md")
    return parser.parse_args()


def _wanted(names: list[str] | None) -> tuple[list[recipes.Recipe], dict[str, list[str]]]:
    """Programs that can run, and what those lack that cannot."""
    chosen = [r for r in recipes.read() if names is None or r.name in names]
    skipped = {r.name: r.missing() for r in chosen if r.missing()}
    for name, missing in skipped.items():
        print(f"skipped: {name}, without {', '.join(missing)}", file=sys.stderr)
    return [r for r in chosen if r.name not in skipped], skipped


def _cases(
    options: argparse.Namespace, wanted: list[recipes.Recipe], there: set[tuple]
) -> Iterator[tuple[Case, list[Turn]]]:
    """Small sizes first; of each case the programs that have not had it."""
    for size in options.sizes:
        for noisy in (False,) if options.clean else (False, True):
            for solid in options.solids:
                outside = not noisy and size == OUTER_SIZE and len(outer_points(solid, 9)) > 0
                turns = [
                    (recipe, outer)
                    for recipe in wanted
                    for outer in (False, True)
                    if size <= recipe.largest
                    and (not outer or (outside and recipe.outer))
                    and (solid, size, noisy, outer, recipe.name) not in there
                ]
                if turns:
                    yield Case(solid, size, noisy), turns


def _read(path: Path) -> list[Row]:
    path.parent.mkdir(parents=True, exist_ok=True)
    return [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []


if __name__ == "__main__":
    main()
