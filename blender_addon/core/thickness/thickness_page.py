# SPDX-License-Identifier: GPL-3.0-or-later
"""The report of thickness as one page of HTML with its pictures inside, for people without this program."""

from __future__ import annotations

import base64
import html
import math
import sys

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats
from ..axis.colours import colours
from ..counted import counted
from ..samples.density import share_text
from ..shape.triangles import cross
from ..small_matrices import length_of
from .measurement import Measurement
from .picture import encoded, picture_of, png
from .thickness_colours import STEPS, ThicknessScale, histogram, scale_of
from .thin_parts import Patch, ThinParts

_VIEWS = {  # from the shape to the eye
    "from the front and above": (0.62, -1.0, 0.42),
    "from behind and below": (-0.62, 1.0, -0.42),
}
_CLOSE = 6  # patches that are shown close up
_SIZE, _SMALL = (560, 420), (270, 200)
_AROUND = 4.0  # what is seen round a patch, in its size; work: shown
STYLE = """
body { font: 16px/1.5 sans-serif; max-width: 72em; margin: 2em auto; padding: 0 1em; color: #222 }
figure { display: inline-block; margin: 0 1em 1em 0; vertical-align: top }
figcaption, small { color: #555 }
td, th { padding: 0.2em 1.5em 0.2em 0; text-align: left }"""
_PAGE = """<!doctype html>
<html lang="en"><meta charset="utf-8"><title>Thickness of {title}</title>
<style>{style}
</style>
<h1>Thickness of {title}</h1>
<table>{rows}</table>
<h2>How much of the surface is how thick</h2>
{bars}
<h2>Pictures</h2>
{views}
{patches}
{warnings}
</html>
"""


def page_of(found: Measurement, parts: ThinParts, title: str, unit: str, points: Floats) -> str:
    """Return the page about what has a title; `points` are those of the measured surface in the world, (n, 3).

    The unit of lengths is "" if it is unknown.
    """
    scale = scale_of(found, parts.limit)
    rgb = colours(scale.positions(found.lengths), 0.0, 1.0)[:, :3].astype(np.float64)
    views = [
        figure_of(picture_of(points, found.triangles, rgb, np.array(eye), *_SIZE), name)
        for name, eye in _VIEWS.items()
        if len(points)
    ]
    return _PAGE.format(
        style=STYLE,
        title=html.escape(title),
        rows=_rows(found, parts, unit),
        bars=bars_of(found, scale, unit),
        views="\n".join(views),
        patches=_patches(found, parts, unit, points, rgb),
        warnings="".join(f"<p>{html.escape(str(warning))}</p>\n" for warning in found.warnings),
    )


def _rows(found: Measurement, parts: ThinParts, unit: str) -> str:
    cells = {"Minimum": length_text(found.minimum, unit)}
    if found.between_parallel is not None:
        cells["Between nearly parallel walls"] = length_text(found.between_parallel, unit)
    if parts.limit > 0.0:
        cells["Limit"] = length_text(parts.limit, unit)
        cells["Thinner than the limit"] = (
            f"{share_text(parts.share)} of the surface, {counted(len(parts.patches), 'patch', 'patches')}"
        )
    if found.unmeasured > 0.0:
        cells["Unknown"] = f"{share_text(found.unmeasured)} of the surface"
    cells["Sampling"] = f"{found.samples:,} samples; {found.chosen.reason}"
    return "".join(
        f"<tr><th>{name}</th><td>{html.escape(text)}</td></tr>" for name, text in cells.items()
    )


def bars_of(found: Measurement, scale: ThicknessScale, unit: str) -> str:
    """Return the histogram as SVG, which a style may scale; the limit is a line."""
    shares, bounds = histogram(found, scale), scale.bounds
    middle = (bounds[:-1] + bounds[1:]) / 2
    fills = [_web(rgb) for rgb in colours(scale.positions(middle), 0.0, 1.0)[:, :3]]
    most, wide, high = max(float(shares.max()), 1e-12), 48, 160
    made = []
    for step, (share, fill) in enumerate(zip(shares, fills, strict=True)):
        tall = high * float(share) / most
        text = f"{length_text(bounds[step], unit)} to {length_text(bounds[step + 1], unit)}: {share_text(share)}"
        made.append(
            f'<rect x="{wide * step}" y="{high - tall:.1f}" width="{wide - 3}" height="{tall:.1f}" '
            f'fill="{fill}"><title>{html.escape(text)}</title></rect>'
        )
    ticks = {0: scale.low, STEPS: scale.high}
    if scale.limit > scale.low:
        at = int(np.searchsorted(bounds, scale.limit))
        ticks[at] = scale.limit
        made.append(
            f'<line x1="{wide * at - 1.5}" x2="{wide * at - 1.5}" y1="0" y2="{high}" stroke="#222"/>'
        )
    anchor = {0: "start", STEPS: "end"}
    made += [
        f'<text x="{wide * at}" y="{high + 20}" text-anchor="{anchor.get(at, "middle")}">'
        f"{length_text(value, unit)}</text>"
        for at, value in ticks.items()
    ]
    size = f'width="{wide * STEPS}" height="{high + 30}" viewBox="0 0 {wide * STEPS} {high + 30}"'
    return (
        f'<svg {size} role="img" aria-label="Shares of the area by thickness">{"".join(made)}</svg>'
    )


def _patches(found: Measurement, parts: ThinParts, unit: str, points: Floats, rgb: Floats) -> str:
    if not parts.patches:
        return ""
    shown = [
        _close_up(found, parts, number, patch, unit, points, rgb)
        for number, patch in enumerate(parts.patches[:_CLOSE])
    ]
    return "<h2>The thinnest patches</h2>\n" + "\n".join(shown)


def _close_up(
    found: Measurement,
    parts: ThinParts,
    number: int,
    patch: Patch,
    unit: str,
    points: Floats,
    rgb: Floats,
) -> str:
    """Return a patch as it is seen along the normal of its thinnest triangle, and a little from the side."""
    rows = np.flatnonzero(parts.patch_of_triangles == number)
    row = rows[found.of_triangles[rows].argmin()]
    a, b, c = points[found.triangles[row]]
    normal = cross((b - a)[None], (c - a)[None])[0]
    normal /= max(length_of(normal), sys.float_info.min)
    size = _AROUND * max(math.sqrt(patch.area) / 2, patch.minimum)
    eye = normal + np.array([0.25, -0.25, 0.35])
    picture = picture_of(points, found.triangles, rgb, eye, *_SMALL, focus=((a + b + c) / 3, size))
    place = ", ".join(f"{x:.4g}" for x in (a + b + c) / 3)
    return figure_of(picture, f"{number + 1}: {length_text(patch.minimum, unit)} at ({place})")


def figure_of(pixels: NDArray[np.uint8], text: str) -> str:
    """Return a picture with its text below it."""
    data = base64.b64encode(png(pixels)).decode("ascii")
    return (
        f'<figure><img src="data:image/png;base64,{data}" alt="{html.escape(text)}">'
        f"<figcaption>{html.escape(text)}</figcaption></figure>"
    )


def length_text(value: float, unit: str) -> str:
    """Return a length with its unit."""
    return "unknown" if not math.isfinite(value) else f"{value:.4g} {unit}".strip()


def _web(linear: NDArray[np.float32]) -> str:
    return "#" + "".join(f"{round(255 * x):02x}" for x in encoded(linear.astype(np.float64)))
