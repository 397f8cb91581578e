# SPDX-License-Identifier: GPL-3.0-or-later
"""Small multiples as SVG: lines over logarithmic axes, one panel for each solid. Nothing but text is needed."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from xml.sax.saxutils import escape

Points = Sequence[tuple[float, float]]

COLOURS = {
    "ours, clean": "#0b57d0",
    "ours, as published": "#6fa8ff",
    "ours, curve": "#00a08a",
    "ours, clean, normals": "#122b5c",
    "poles alone": "#9a6700",
    "power shape": "#d1242f",
    "angle and length": "#8250df",
    "lambda": "#bf3989",
    "shrinking ball": "#57606a",
}
WIDTH, HEIGHT, GAP, COLUMNS = 190, 140, 46, 4


def panels(
    data: Mapping[str, Mapping[str, Points]], title: str, colours: Mapping[str, str] = COLOURS
) -> str:
    """Draws a panel for each name, from the points of its lines; x and y are positive. Lines have `colours` by name."""
    rows = math.ceil(len(data) / COLUMNS)
    wide, high = COLUMNS * (WIDTH + GAP) + 12, rows * (HEIGHT + GAP) + 78
    body = [f'<text x="12" y="22" font-size="15">{escape(title)}</text>', _legend(colours)]
    for i, (name, lines) in enumerate(data.items()):
        x = 42 + (i % COLUMNS) * (WIDTH + GAP)
        y = 84 + (i // COLUMNS) * (HEIGHT + GAP)
        body.append(f'<g transform="translate({x},{y})">{_panel(name, lines, colours)}</g>')
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {wide} {high}" '
        'font-family="sans-serif" font-size="11">\n'
        f'<rect width="{wide}" height="{high}" fill="white"/>\n' + "\n".join(body) + "\n</svg>\n"
    )


def _legend(colours: Mapping[str, str]) -> str:
    words, x, y = [], 12, 42
    for name, colour in colours.items():
        if x > 800:
            x, y = 12, y + 16
        words.append(f'<rect x="{x}" y="{y - 8}" width="14" height="4" fill="{colour}"/>')
        words.append(f'<text x="{x + 18}" y="{y - 2}">{escape(name)}</text>')
        x += 34 + 6 * len(name)
    return "".join(words)


def _panel(name: str, lines: Mapping[str, Points], colours: Mapping[str, str]) -> str:
    every = [point for line in lines.values() for point in line]
    parts = [f'<text x="0" y="-6">{escape(name)}</text>']
    parts.append(f'<rect width="{WIDTH}" height="{HEIGHT}" fill="none" stroke="#bbb"/>')
    if not every:
        return "".join(parts)
    across = _scale([x for x, _ in every], 0, WIDTH)
    up = _scale([y for _, y in every], HEIGHT, 0)
    for power in range(-9, 2):
        if 0 < up(10.0**power) < HEIGHT:
            y = up(10.0**power)
            parts.append(f'<path d="M0 {y:.1f}H{WIDTH}" stroke="#eee"/>')
            parts.append(f'<text x="-4" y="{y + 4:.1f}" text-anchor="end">1e{power}</text>')
    for x in sorted({x for x, _ in every}):
        parts.append(
            f'<text x="{across(x):.1f}" y="{HEIGHT + 14}" text-anchor="middle">{_round(x / 1000):g}k</text>'
        )
    return "".join(parts) + "".join(
        _line(points, colours.get(line, "#ccc"), across, up) for line, points in lines.items()
    )


def _line(points: Points, colour: str, across, up) -> str:
    places = [(across(x), up(y)) for x, y in sorted(points)]
    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
    dots = "".join(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2" fill="{colour}"/>' for x, y in places)
    return (
        f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="1.5"/>{dots}'
        if places
        else ""
    )


def _round(value: float) -> float:
    """Two digits, for the label of an axis."""
    return float(f"{value:.2g}")


def _scale(values: Sequence[float], start: float, end: float):
    """A logarithmic axis with a margin."""
    low, high = math.log(min(values)), math.log(max(values))
    room = 0.08 * max(high - low, 0.5)
    low, high = low - room, high + room
    return lambda value: start + (math.log(value) - low) / (high - low) * (end - start)
