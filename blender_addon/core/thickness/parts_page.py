# SPDX-License-Identifier: GPL-3.0-or-later
"""The thickness of several parts on one page of HTML: a row for each, also for those that could not be measured."""

from __future__ import annotations

import html
import math
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..axis.colours import colours
from ..counted import counted
from ..files.writing import write_whole
from ..samples.density import share_text
from ..settings import Between
from ..small_matrices import placed
from .measurement import Measurement
from .picture import picture_of
from .thickness_colours import scale_of
from .thickness_page import STYLE, bars_of, figure_of, length_text
from .thin_parts import ThinParts

_EYE, _SIZE = (0.62, -1.0, 0.42), (280, 210)
_HEADS = (
    "Part",
    "Least length",
    "Between nearly parallel walls",
    "At (x, y, z)",
    "Thin places",
    "Thin share",
    "How much of the surface is how thick",
    "Remarks",
)
_PAGE = """<!doctype html>
<html lang="en"><meta charset="utf-8"><title>Thickness of {parts}</title>
<style>{style}
table {{ border-collapse: collapse }} tr {{ border-top: 1px solid #ccc; vertical-align: top }}
td svg {{ width: 18em; height: auto }} .thin {{ color: #b00; font-weight: bold }}
</style>
<h1>Thickness of {parts}</h1>
<p>{verdict}</p>
<table><tr>{heads}</tr>
{rows}
</table>
</html>
"""


@dataclass(frozen=True)
class PartRow:
    """A part on the page."""

    cells: str  # Its row in HTML
    places: int = 0  # How many patches are thinner than the limit; 0 where it was not measured
    measured: bool = True


def row_of(
    name: str, found: Measurement, parts: ThinParts, unit: str, warnings: Sequence[str]
) -> PartRow:
    """Return the row of a part that was measured; `unit` is that of lengths, "" if it is unknown."""
    scale, places = scale_of(found, parts.limit), len(parts.patches)
    shown, bars = html.escape(name), ""
    if len(found.triangles):
        points = placed(found.points, found.shape.frame)
        rgb = colours(scale.positions(found.lengths), 0.0, 1.0)[:, :3].astype(np.float64)
        shown = figure_of(picture_of(points, found.triangles, rgb, np.array(_EYE), *_SIZE), name)
        bars = bars_of(found, scale, unit)
    thin = ' class="thin"' if places else ""
    text = "".join(f"<td{thin}>{html.escape(cell)}</td>" for cell in _cells(found, parts, unit))
    said = "".join(f"<p>{html.escape(str(warning))}</p>" for warning in warnings)
    return PartRow(f"<tr><td>{shown}</td>{text}<td>{bars}</td><td>{said}</td></tr>", places)


def _cells(found: Measurement, parts: ThinParts, unit: str) -> tuple[str, ...]:
    """Return the cells between the picture and the histogram."""
    nothing = "none" if found.settings.between is Between.GAP else "unknown"
    lengths = [
        length_text(length, unit) if math.isfinite(length) else nothing
        for length in (parts.minimum, found.between_parallel)
        if length is not None
    ]
    at = ""
    if math.isfinite(parts.minimum):
        place = parts.patches[0].place if parts.patches else found.thinnest_place
        at = ", ".join(f"{x:.4g}" for x in placed(np.array([place]), found.shape.frame)[0])
    limited = (
        (f"{len(parts.patches):,}", share_text(parts.share)) if parts.limit > 0.0 else ("",) * 2
    )
    return (*lengths, *[""] * (2 - len(lengths)), at, *limited)


def row_without(name: str, reason: str) -> PartRow:
    """Return the row of a part that could not be measured, with the sentence that says why."""
    empty = len(_HEADS) - 1
    return PartRow(
        f'<tr><td>{html.escape(name)}</td><td colspan="{empty}">{html.escape(reason)}</td></tr>',
        measured=False,
    )


def verdict_of(rows: Sequence[PartRow], limit: float, unit: str, between: Between) -> str:
    """Return the result of all parts in one or two sentences."""
    thin, places = sum(row.places > 0 for row in rows), sum(row.places for row in rows)
    said = ""
    if limit > 0.0:
        what = "narrower" if between is Between.GAP else "thinner"
        at = counted(places, "place") if places else "no place"
        of = f"{thin:,} of {counted(len(rows), 'part')}" if places else counted(len(rows), "part")
        said = f"{what.capitalize()} than {length_text(limit, unit)} at {at} of {of}."
    if lost := sum(not row.measured for row in rows):
        said += f" {counted(lost, 'part')} could not be measured."
    return said.strip() or f"{counted(len(rows), 'part')} measured."


def export_page(
    rows: Sequence[PartRow], path: str | os.PathLike, verdict: str, between: Between
) -> Path:
    """Write the page; an old one is replaced whole, or stays as it is where the system refuses."""
    heads = list(_HEADS)
    heads[1] = "Least gap" if between is Between.GAP else "Least wall"
    page = _PAGE.format(
        parts=counted(len(rows), "part"),
        style=STYLE,
        verdict=html.escape(verdict),
        heads="".join(f"<th>{head}</th>" for head in heads),
        rows="\n".join(row.cells for row in rows),
    )
    data = page.encode("utf-8", "backslashreplace")  # names of files are bytes
    return write_whole(path, lambda stream: stream.write(data))
