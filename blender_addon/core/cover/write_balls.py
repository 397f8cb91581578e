# SPDX-License-Identifier: GPL-3.0-or-later
"""This module writes balls and capsules as `.ma`, `.json`, `.urdf` and MJCF files (docs/balls.md), each whole or not at
all."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any, BinaryIO

from ..arrays import Floats
from ..files.placing import is_identity, parts_of
from ..files.writing import extension_of, known, write_rows, write_whole
from ..small_matrices import times
from .ball_cover import Balls
from .robot_links import write_mjcf, write_urdf


def export_balls(balls: Balls, path: str | os.PathLike, transform: Floats | None = None) -> Path:
    """Write balls, and return the path of the file; the extension of `path` chooses the format.

    Parameters
    ----------
    balls : Balls
    path : path of the file; its folder must exist. A file of that name is replaced.
    transform : (3, 4) or (4, 4) float64, optional
        The world matrix of the balls. It may move, turn, mirror and scale evenly; all lengths are scaled with it.

    Raises
    ------
    ExportError
        The extension is unknown, the transform does not fit, the format has no place for such balls, or the system
        refused to write; an old file is then unchanged.
    """
    write = BALL_FORMATS[extension_of(path, BALL_FORMATS)]
    placed = balls if transform is None else _placed(balls, transform)
    name = Path(path).stem
    return write_whole(path, lambda stream: write(placed, name, stream))


def _placed(balls: Balls, transform: Floats) -> Balls:
    """Return the balls in world coordinates."""
    if is_identity(transform):
        return balls
    linear, offset, scale = parts_of(transform)
    return replace(
        balls,
        centres=times(balls.centres, linear) + offset,
        radii=scale * balls.radii,
        outside=scale * balls.outside,
        farthest=scale * balls.farthest,
    )


def _write_ma(balls: Balls, _name: str, stream: BinaryIO) -> None:
    """Write the balls as vertices of a medial axis without triangles, and capsules as its edges."""
    stream.write(b"%d %d 0\n" % (len(balls.radii), len(balls.edges)))
    write_rows(stream, "v %.17g %.17g %.17g %.17g\n", balls.centres, balls.radii)
    if len(balls.edges):
        write_rows(stream, "e %d %d\n", balls.edges)


def _write_json(balls: Balls, _name: str, stream: BinaryIO) -> None:
    """Write the balls, or capsules and the balls among them, and all figures; an unknown figure is null."""
    alone = balls.single
    rows = zip(balls.centres[alone].tolist(), balls.radii[alone].tolist(), strict=True)
    found: dict[str, Any] = {
        **as_figures(balls),
        "balls": [{"centre": centre, "radius": radius} for centre, radius in rows],
    }
    if len(balls.edges):
        ends, radii = balls.centres[balls.edges].tolist(), balls.radii[balls.edges].tolist()
        pairs = zip(ends, radii, strict=True)
        found["capsules"] = [{"ends": places, "radii": sizes} for places, sizes in pairs]
    stream.write(json.dumps(found, separators=(",", ":"), allow_nan=False).encode("ascii"))
    stream.write(b"\n")


def as_figures(balls: Balls) -> dict[str, str | float | None]:
    """Return figures for JSON of how well balls represent the solid; an unknown figure is None."""
    return {
        "mode": balls.mode.name.lower(),
        "covered": known(balls.covered),
        "outside": known(balls.outside),
        "farthest": known(balls.farthest),
    }


BALL_FORMATS: dict[str, Callable[[Balls, str, BinaryIO], None]] = {
    ".ma": _write_ma,
    ".json": _write_json,
    ".urdf": write_urdf,
    ".mjcf": write_mjcf,
    ".xml": write_mjcf,
}
