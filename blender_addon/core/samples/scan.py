# SPDX-License-Identifier: GPL-3.0-or-later
"""Points without faces are measured and prepared: outliers leave, noise is moved away (docs/stage_scan.md)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from ..arrays import Floats
from ..errors import Severe
from ..machine import native
from ..machine.progress import Progress
from ..settings import Prepare, Settings, SidesFrom
from ..shape.shape import Shape
from .density import percent

SOME = 0.1  # noise in spacings from which on the axis has flakes; chosen: unseen
_TOO_MUCH = 2.5  # noise in spacings beyond which too few points show the surface; chosen: unseen
_ALONE = (0.001, 0.1)  # the share of lone points that are outliers; fewer are the tips of a shape
_FEWEST = 4  # of them
_LAYERED = 2.3  # a smaller kurtosis is that of layers; errors have 2.6 or more; measured: lab/scans.md, kurtosis
_MATES = 1.4  # more pairs of one height: views do not fit; measured: lab/scans.md, pairs
_WALLS = (0.7, 1.7)  # more noise in spacings with a smaller kurtosis is two walls of a thin part
_ENDS = 0.02  # a larger share of points at which the surface ends is an opening, or a sheet; chosen: unseen
_THIN = 5.0  # walls of fewer standard deviations of the noise become one; chosen: axis


@dataclass(frozen=True, eq=False)
class Scan:
    """The figures of points without faces, measured, and what was done to them."""

    # The numbers of points before and after
    given: int
    kept: int
    spacing: float  # The distance of neighbours, as if the points were evenly spread
    # The standard deviation of a point from the surface, in spacings; 0.0 where none is seen
    noise: float
    # How the points spread over the noise: 3 as errors do, 1.8 evenly, 1 in two layers
    kurtosis: float
    # How many pairs of close points have the same height, in units of what errors have
    mates: float
    duplicates: int
    outliers: int
    border: float  # The share of the points at which the surface ends
    # (kept,) How far each point was moved; None where nothing was moved
    moved: Floats | None = None

    @property
    def has_walls(self) -> bool:
        """Whether the noise seems to be the two walls of a thin part, which lie in two layers."""
        return self.noise > _WALLS[0] and self.kurtosis < _WALLS[1]

    @property
    def does_not_fit(self) -> bool:
        """Whether the noise seems to be that of views each of which lies off as a whole."""
        return self.noise > SOME and self.mates > _MATES and not self.has_walls

    @property
    def figures(self) -> dict[str, Any]:
        """The figures for a report."""
        moved = None if self.moved is None else float(np.median(self.moved))
        return {**asdict(self), "moved": moved}


def prepared(
    shape: Shape, settings: Settings, progress: Progress | None = None
) -> tuple[Shape, Scan | None]:
    """Return a shape whose points lie on smooth surfaces, and the figures; the same shape where nothing is to be done.

    Faces say more than this measure, so a shape that has any is not measured.
    """
    if len(shape.triangles) or len(shape.points) == 0:
        return shape, None
    with native.own_errors() as module:
        measure = module.measure_scan(shape.points, progress=progress)
        scan = _scan(shape, measure)
        move, drop = _wanted(settings.prepare, scan)
        if not move and not drop:
            return shape, scan
        found = module.prepare_scan(shape.points, measure, move=move, progress=progress)
    rows = found.rows if shape.rows is None else shape.rows[found.rows]
    normals = None if shape.normals is None else shape.normals[found.rows]
    scan = replace(scan, kept=len(rows), moved=found.moved if move else None)
    return replace(shape, points=found.points, normals=normals, rows=rows), scan


def _scan(shape: Shape, measure: Any) -> Scan:
    """Return what was measured; a few lone points are no outliers."""
    given, lone = len(shape.points), len(measure.outliers)
    few, many = _ALONE
    outliers = lone if max(_FEWEST, few * given) <= lone <= many * given else 0
    noise = measure.noise / measure.spacing if measure.noise > 0.0 else 0.0
    return Scan(
        given=given,
        kept=given,
        spacing=measure.spacing,
        noise=noise,
        kurtosis=measure.kurtosis,
        mates=measure.mates,
        duplicates=measure.duplicates,
        outliers=outliers,
        border=measure.border,
    )


def _wanted(wanted: Prepare, scan: Scan) -> tuple[bool, bool]:
    """Return whether to move the points, and whether to leave outliers out."""
    if wanted is Prepare.OFF:
        return False, False
    enough = 0.0 if wanted is Prepare.ALWAYS else SOME
    return enough < scan.noise <= _TOO_MUCH and not scan.has_walls, scan.outliers > 0


def scan_warnings(scan: Scan | None, sides: SidesFrom) -> Iterator[str]:
    """Say what was found and done, a sentence each: noise, layers, outliers, openings; nothing without a scan."""
    if scan is None:
        return
    yield from _noise(scan)
    if scan.outliers and scan.kept < scan.given:
        yield f"{scan.outliers:,} of {scan.given:,} points stood alone and were left out"
    elif scan.outliers:
        yield f"{scan.outliers:,} of {scan.given:,} points stand alone: outliers, which Denoise Automatic leaves out"
    if scan.border > _ENDS and sides is SidesFrom.POLES:
        yield (
            f"the surface ends at {percent(scan.border)} of the points: openings, or a sheet as of a facade, "
            "a terrain or a single view, which bounds no solid; inside is a guess there, and side Both needs none"
        )
    guessed = scan.noise <= SOME or scan.moved is not None  # otherwise the noise is the cause
    if sides is SidesFrom.POLES and guessed and scan.border <= _ENDS:
        yield (
            "the points do not tell one solid, so inside is a guess of the poles: walls or gaps of a few spacings, "
            "parts that were never seen, or noise between close walls"
        )


def is_noisy(scan: Scan | None) -> bool:
    """Return whether the noise of points is worse than their distances, so that more of them would not help."""
    return scan is not None and scan.noise > SOME


def _noise(scan: Scan) -> Iterator[str]:
    size = f"noise of about {scan.noise:.2g} spacings"
    if scan.does_not_fit:
        yield (
            f"the scans do not fit each other: their points lie in layers, some {2 * scan.noise * scan.spacing:.2g} "
            "apart, so walls of about that thickness are lost or torn; fit the scans again"
        )
    if scan.has_walls:
        yield (
            f"the points lie in two layers, about {2 * scan.noise * scan.spacing:.2g} apart, which were taken for the "
            "walls of a thin part; if they are scans that do not fit each other, fit them again"
        )
        return
    if scan.noise > _TOO_MUCH:
        yield Severe(
            f"{size} was found, too much for so many points: scan more finely, or fit the scans to each other"
        )
    elif scan.moved is not None:
        lost = _THIN * scan.noise * scan.spacing
        yield (
            f"{size} was found: the points were moved by {np.median(scan.moved) / scan.spacing:.2g} spacings in "
            f"the median, and {scan.kept:,} of {scan.given:,} were kept; walls and details thinner than about "
            f"{lost:.2g} are lost, and Denoise Off analyses the points as they are"
        )
    elif scan.noise > SOME:
        yield f"{size} was found and left as it is, so the axis may have flakes; Denoise Automatic moves it away"
    if scan.noise > SOME and scan.kurtosis < _LAYERED and not scan.does_not_fit:
        yield (
            f"the points lie in layers, about {2 * scan.noise * scan.spacing:.2g} apart, and not as errors do: scans "
            "that do not fit each other, or rounded depths; fit the scans again if the axis looks wrong"
        )
