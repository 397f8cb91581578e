# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the rooms of docs/architecture.md as docs/pictures/rooms.svg: a room sees rooms that lie below it.

python3 -m lab.pictures.rooms
"""

import html
import re
from pathlib import Path

DOCS = Path(__file__).resolve().parents[2] / "docs"
WIDE, HIGH, GAP, LEFT = 158, 68, 10, 150  # pixels; LEFT is what the names of bands take
COLUMNS = 6
HEAD = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {w} {h}" width="{w}" height="{h}"
     font-family="DejaVu Sans, Verdana, Arial, sans-serif" font-size="14">
  <title>The rooms of the project, from the user interface down to the vocabulary of the core</title>
  <style>
    .band {{ fill: #f4f4f2; stroke: #b8b8b2; }}
    .room {{ fill: #ffffff; stroke: #4a5a6a; stroke-width: 1.5; }}
    .name {{ font-weight: bold; fill: #1c2833; }}
    .what {{ font-size: 10px; fill: #3a4651; }}
    .side {{ font-size: 13px; fill: #5a5a55; }}
  </style>
  <rect width="{w}" height="{h}" fill="#ffffff"/>"""


def table(head: str) -> dict[str, tuple[str, list[str]]]:
    """Return {room: (what it does, rooms that it sees)} of a table of the page."""
    text = (DOCS / "architecture.md").read_text(encoding="utf-8")
    lines = text[text.index(head) :].partition("\n\n")[0].splitlines()[2:]
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    return {room.strip("`"): (what, re.findall(r"`([^`]+)`", sees)) for room, what, sees in cells}


def floors(rooms: dict[str, tuple[str, list[str]]]) -> list[list[str]]:
    """Return the rooms in floors from the top: each lies above all rooms that it sees."""

    def height(room: str) -> int:
        below = [r for r in rooms[room][1] if r in rooms and r != room]
        return 1 + max((height(r) for r in below), default=-1)

    heights = {room: height(room) for room in rooms}
    return [[r for r in rooms if heights[r] == h] for h in range(max(heights.values()), -1, -1)]


def words_of(what: str) -> list[str]:
    """Return the beginning of a description in at most three lines of a box."""
    plain = re.split(r"[;:]| \(", re.sub("[`*]", "", what))[0].split()
    lines = [""]
    for word in plain:
        if len(lines[-1]) + len(word) > 25:
            lines.append("")
        lines[-1] = f"{lines[-1]} {word}".strip()
    return lines if len(lines) <= 3 else [*lines[:2], f"{lines[2]} …"]


def band(side: str, rows: list[list[tuple[str, str]]], top: int) -> tuple[list[str], int]:
    """Return the drawing of a band of rows of boxes (name, what), and where the next band begins."""
    high = len(rows) * (HIGH + GAP) + GAP
    drawn = [
        f'  <rect class="band" x="10" y="{top}" width="{LEFT + COLUMNS * (WIDE + GAP)}" height="{high}" rx="8"/>',
        f'  <text class="side" x="22" y="{top + 24}">{side}</text>',
    ]
    for number, row in enumerate(rows):
        for column, (name, what) in enumerate(row):
            x = LEFT + column * (WIDE + GAP) + (COLUMNS - len(row)) * (WIDE + GAP) // 2
            y = top + GAP + number * (HIGH + GAP)
            lines = enumerate(words_of(what))
            drawn += [
                f'  <rect class="room" x="{x}" y="{y}" width="{WIDE}" height="{HIGH}" rx="5"/>',
                f'  <text class="name" x="{x + 8}" y="{y + 19}">{name}</text>',
                *(
                    f'  <text class="what" x="{x + 8}" y="{y + 34 + 13 * i}">{html.escape(line)}</text>'
                    for i, line in lines
                ),
            ]
    return drawn, top + high + GAP


def main() -> None:
    python, native = table("| room of Python |"), table("| room of the core |")
    core = {r.removeprefix("core/"): row for r, row in python.items() if r.startswith("core/")}
    boxes = lambda rooms, rows: [
        [(r, rooms[r][0]) for r in row] for row in rows
    ]  # a room and what it does

    def below(top: str) -> dict[str, tuple[str, list[str]]]:
        """Return the rooms of a folder; the files in it itself lie above its other rooms."""
        rooms = {room: row for room, row in python.items() if room.split("/")[0] == top}
        return {**rooms, top: (rooms[top][0], list(rooms))}

    bands = [
        *(
            (f"{top}/", boxes(below(top), floors(below(top))))
            for top in ("ui", "commands", "bridge")
        ),
        ("core/, no bpy", boxes(core, floors(core))),
        ("native/python/", [[("_medial", "pybind11 and nothing else")]]),
        ("native/medial/", boxes(native, floors(native))),
    ]
    drawn, top = [], GAP
    for side, rows in bands:
        more, top = band(side, rows, top)
        drawn += more
    head = HEAD.format(w=LEFT + COLUMNS * (WIDE + GAP) + 20, h=top)
    (DOCS / "pictures" / "rooms.svg").write_text(
        "\n".join([head, *drawn, "</svg>", ""]), encoding="utf-8"
    )


if __name__ == "__main__":
    main()
