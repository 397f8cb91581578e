# SPDX-License-Identifier: GPL-3.0-or-later
"""A contact sheet of virtual scans: the axis of the points as they are above, of the prepared points below.

    python3 lab/pictures/scan_sheet.py OUTPUT.png [--only hand ...]

The scanner is that of lab/benchmarks/virtual_scan.py. Points are grey dots, facets are dark blue where the shape is
thin and yellow where it is thick, and edges that stand by themselves are ribbons. The Betti numbers and the warnings
are printed. Files come from the folder in MEDIAL_AXIS_TEST_DATA; those that are not there are named and left out.
"""

import argparse
import math
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "benchmarks"))
import _module

MEDIAL = _module.load()

from medial_axis.core.axis.compute import compute  # noqa: E402
from medial_axis.core.files.read_shape import read_shape  # noqa: E402
from medial_axis.core.settings import Prepare, Settings  # noqa: E402
from medial_axis.core.thickness.picture import picture_of, png  # noqa: E402
from virtual_scan import Faults, scan  # noqa: E402

NOISY = Faults(noise=0.25)
# Name: file, the turn about X in degrees that shows it upright, the pitch in shares of the diagonal, and the faults.
SCANS = {
    "rocker arm": ("rocker-arm.off", 60, 0.012, NOISY),
    "rocker arm, 5 % outliers": ("rocker-arm.off", 60, 0.012, Faults(noise=0.25, outliers=0.05)),
    "rocker arm, rounded depths": ("rocker-arm.off", 60, 0.012, Faults(step=1.0)),
    "rocker arm, shifted views": ("rocker-arm.off", 60, 0.012, Faults(noise=1.0, shift=0.5)),
    "hand": ("hand_closed.obj", 0, 0.01, NOISY),
    "mannequin": ("mannequin.off", 0, 0.012, NOISY),
    "cow": ("spot_low.obj", 90, 0.012, NOISY),
    "three holes": ("3holes.off", 60, 0.012, NOISY),
    "knot": ("knot1.off", 0, 0.012, NOISY),
    "dinosaur": ("dilo.off", -90, 0.006, NOISY),
}
TILE, IN_LINE, EYE = (230, 230), 5, np.array([0.45, -1.0, 0.35])
GREY, DOT, RIBBON = 0.6, 0.0035, 0.004  # of points; the sizes in shares of the diagonal
LADDER = np.array([(0.01, 0.01, 0.12), (0.02, 0.16, 0.35), (0.1, 0.4, 0.25), (0.9, 0.75, 0.05)])


def read(name: str) -> np.ndarray | None:
    """The points of a scan, upright; None where its file is absent."""
    file, turn, pitch, faults = SCANS[name]
    path = _module.DATA / file
    if not path.is_file():
        print(f"left out: no file {file} in the folder of MEDIAL_AXIS_TEST_DATA")
        return None
    shape = read_shape(path)[0]
    cos, sin = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    turned = shape.points @ np.array([[1, 0, 0], [0, cos, sin], [0, -sin, cos]])
    return scan(turned, shape.triangles, pitch, faults)


def drawn(points: np.ndarray, prepare: Prepare, name: str) -> np.ndarray:
    """(h, w, 3) uint8: the axis, and behind it the points."""
    found = compute(points, np.zeros((0, 3), np.int32), Settings(prepare=prepare))
    print(
        f"{name}, {prepare.value}: {len(points):,} points, {found.axis.level.betti}",
        *found.warnings,
        sep="\n  ",
        flush=True,
    )
    return before(points, found.axis)


def drawn_faces(points: np.ndarray, triangles: np.ndarray, prepare: Prepare) -> np.ndarray:
    """(h, w, 3) uint8: the axis of faces, and behind it their vertices."""
    return before(points, compute(points, triangles, Settings(prepare=prepare)).axis)


def before(points: np.ndarray, shown) -> np.ndarray:
    """(h, w, 3) uint8: an axis before points."""
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    seen = points @ (ways := np.stack(across())).T
    focus = (
        (seen.min(axis=0) + seen.max(axis=0)) / 2 @ ways,
        0.54 * float(np.ptp(seen, axis=0).max()),
    )
    axis = pictured(*soup(shown, size), focus)
    behind = pictured(*dots(points, DOT * size), focus)
    return np.where((axis == 255).all(axis=2, keepdims=True), behind, axis)


def pictured(corners: np.ndarray, colours: np.ndarray, focus) -> np.ndarray:
    """Triangles as (t, 3, 3) corners and (t, 3, 3) colours."""
    triangles = np.arange(3 * len(corners), dtype=np.int32).reshape(-1, 3)
    return picture_of(corners.reshape(-1, 3), triangles, colours.reshape(-1, 3), EYE, *TILE, focus)


def dots(points: np.ndarray, size: float) -> tuple[np.ndarray, np.ndarray]:
    """A triangle that looks at the eye for each point."""
    right, up = across()
    around = np.array([(math.cos(t), math.sin(t)) for t in (0.0, 2.1, 4.2)]) * size
    corners = points[:, None] + around @ np.stack((right, up))
    return corners, np.full(corners.shape, GREY)


def soup(axis, size: float) -> tuple[np.ndarray, np.ndarray]:
    """Triangles of facets and ribbons of edges, with colours by radius."""
    widest = np.quantile(axis.radius, 0.98)
    colours = shade(axis.radius / widest)
    facets = np.asarray(
        MEDIAL.polygon_triangles(axis.vertices, axis.face_offsets, axis.face_vertices)
    )
    a, b = axis.vertices[axis.edges].transpose(1, 0, 2)
    along = np.cross(b - a, EYE)
    along *= RIBBON * size / np.maximum(np.linalg.norm(along, axis=1), 1e-300)[:, None]
    first, last = colours[axis.edges].transpose(1, 0, 2)
    ribbons = np.concatenate(
        (
            np.stack((a - along, b - along, b + along), 1),
            np.stack((a - along, b + along, a + along), 1),
        )
    )
    tones = np.concatenate((np.stack((first, last, last), 1), np.stack((first, last, first), 1)))
    return np.concatenate((axis.vertices[facets], ribbons)), np.concatenate(
        (colours[facets], tones)
    )


def shade(share: np.ndarray) -> np.ndarray:
    """(n, 3) linear colours of numbers between 0 and 1."""
    places = np.linspace(0.0, 1.0, len(LADDER))
    return np.column_stack([np.interp(share, places, channel) for channel in LADDER.T])


def across() -> tuple[np.ndarray, np.ndarray]:
    """The unit vectors to the right and upwards, as the eye sees them."""
    right = np.cross((0.0, 0.0, 1.0), EYE)
    up = np.cross(EYE, right)
    return right / np.linalg.norm(right), up / np.linalg.norm(up)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("output", type=Path)
    parser.add_argument("--only", nargs="+", choices=list(SCANS), default=list(SCANS))
    wanted = parser.parse_args()
    columns = []
    for name in wanted.only:
        points = read(name)
        if points is not None:
            pair = [drawn(points, prepare, name) for prepare in (Prepare.OFF, Prepare.AUTOMATIC)]
            columns.append(np.concatenate(pair))
    lines = [columns[k : k + IN_LINE] for k in range(0, len(columns), IN_LINE)]
    blank = np.full_like(columns[0], 255)
    lines[-1] += [blank] * (len(lines[0]) - len(lines[-1]))
    page = np.concatenate([np.concatenate(line, axis=1) for line in lines])
    wanted.output.write_bytes(png(page))


if __name__ == "__main__":
    main()
