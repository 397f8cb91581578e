# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes as they are, by the product's own command line: a table, compared with that of the last run.

    python3 -m lab.corpus [--only WORD ...] [--folder FOLDER] [--pictures] [--against old.csv]

The meshes are those of the packages of `packages.toml`, fetched and unpacked below `--cache`, or of a folder. Each runs
at the defaults in a process of its own. `--output` gets corpus.csv, corpus.md and, with `--pictures`, corpus.png. Rows
that differ from corpus.csv as it was there, or from another table, are marked. Meshes that did not run keep their rows.
"""

from __future__ import annotations

import argparse
import signal
import sys
import tempfile
from pathlib import Path

from . import ROOT, packages, picture, table
from .meshes import Mesh, meshes
from .run import Limits, run

CACHE = ROOT / "build" / "corpus" / "packages"


def main(words: list[str] | None = None) -> int:
    options = parse(words)
    options.output.mkdir(parents=True, exist_ok=True)
    csv = options.output / "corpus.csv"
    last = table.read_csv(csv) if csv.exists() else []
    before = table.read_csv(options.against) if options.against else last
    found = wanted(options)
    ran: list[table.Row] = []
    try:
        run_all(found, options, ran)
    finally:  # a run that is stopped keeps what it has
        ran = table.compared(ran, before)
        is_whole = len(ran) == len(found) and not options.only
        rows = ran if is_whole else table.merged(ran, last)
        table.write_csv(rows, csv)
        (options.output / "corpus.md").write_text(table.page(rows), encoding="utf-8")
        print(table.summary(ran))
    return 0


def parse(words: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python3 -m lab.corpus",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--only", nargs="+", default=[], help="words in the names of the meshes")
    parser.add_argument("--folder", type=Path, help="meshes of this folder, not of the packages")
    parser.add_argument("--cache", type=Path, default=CACHE, help="where the packages are")
    parser.add_argument("--output", type=Path, default=CACHE.parent)
    parser.add_argument("--against", type=Path, help="an earlier table to compare with")
    parser.add_argument("--pictures", action="store_true")
    parser.add_argument("--seconds", type=int, default=120, help="processor time of a mesh")
    parser.add_argument("--megabytes", type=int, default=4096, help="memory of a mesh")
    parser.add_argument("--nice", type=int, default=0)
    return parser.parse_args(words)


def wanted(options: argparse.Namespace) -> list[Mesh]:
    if options.folder:
        return meshes(options.folder.name, options.folder, options.only)
    found = []
    for package in packages.listed():
        folder = packages.unpacked(package, options.cache)
        found += meshes(str(package), folder, options.only)
    return found


def run_all(found: list[Mesh], options: argparse.Namespace, rows: list[table.Row]) -> None:
    """Add a row of each mesh, and make the contact sheet where it is wanted."""
    pictures = []
    limits = Limits(options.seconds, options.megabytes)
    with tempfile.TemporaryDirectory(prefix="corpus_") as folder:
        for number, mesh in enumerate(found):
            axis = Path(folder, "axis.npz")
            axis.unlink(missing_ok=True)
            rows.append(table.row(mesh, run(mesh, axis, limits, options.nice)))
            print(*rows[-1].values(), sep=" | ", file=sys.stderr, flush=True)
            if options.pictures and axis.exists():
                drawn = Path(folder, f"{number}.ppm")
                picture.draw(mesh.path, axis, drawn)
                pictures.append((f"{mesh.path.stem}\n{rows[-1]['betti']}", drawn))
        if pictures:
            picture.sheet(pictures, options.output / "corpus.png")


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    sys.exit(main())
