# SPDX-License-Identifier: GPL-3.0-or-later
"""Ours as a program of the race.

    python3 -m lab.race.ours INPUT OUTPUT [setting=value ...]

INPUT is any file that the add-on reads, OUTPUT any that it writes; settings are those of `medial_axis.compute`.
"""

import sys

from . import product  # noqa: F401  (makes `medial_axis` known)

import medial_axis  # isort: skip


def _value(text: str) -> str | float | bool:
    """A number, true or false, or the name of a choice."""
    if text in ("true", "false"):
        return text == "true"
    try:
        return float(text)
    except ValueError:
        return text


def main() -> None:
    source, target, *words = sys.argv[1:]
    settings = {name: _value(text) for name, text in (word.split("=", 1) for word in words)}
    given = medial_axis.read(source)
    triangles = given.triangles if len(given.triangles) else None
    medial_axis.write(
        medial_axis.compute(given.points, triangles, given.normals, **settings), target
    )


if __name__ == "__main__":
    main()
