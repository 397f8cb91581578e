# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes as they are: those of Debian's packages, by the product's own command line (docs/lab/corpus.md).

    python3 -m lab.corpus

`packages` fetches and unpacks the packages of `packages.toml`, `meshes` finds the files, `run` runs one of them,
`table` writes and compares the rows, `picture` draws the contact sheet.
"""

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
