# SPDX-License-Identifier: GPL-3.0-or-later
"""The rows of the corpus, as CSV and Markdown, and how they differ from those of an earlier run."""

from __future__ import annotations

import csv
import re
import signal
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path

from .meshes import Mesh
from .run import Run

Row = dict[str, str]
HEADER = ["changed", "mesh", "source", "sha256", "exit", "seconds", "faces", "parts", "samples"]
HEADER += ["inside", "betti", "by faces", "said"]
SHOWN = ["changed", "mesh", "exit", "seconds", "faces", "parts", "samples", "inside", "betti"]
SHOWN += ["by faces", "said"]
COMPARED = ("sha256", "exit", "parts", "inside", "betti", "by faces")
SLOWER, LEAST = (
    1.5,
    1.0,
)  # seconds are another result where they differ by this factor, and by so many
_LONGEST = 70  # of a warning in the table


def row(mesh: Mesh, run: Run) -> Row:
    """The result of one mesh."""
    report, faces = run.report, run.report.get("mesh") or {}
    parts = [f"{faces.get('parts', '')}"]
    parts += [f"{faces[kind]} {kind}" for kind in ("open", "sheets", "turned") if faces.get(kind)]
    return {
        "changed": "",
        "mesh": mesh.name,
        "source": mesh.source,
        "sha256": mesh.sha256[:16],
        "exit": exit_words(run.exit),
        "seconds": f"{run.seconds:.1f}",
        "faces": str(faces.get("faces", "")),
        "parts": ", ".join(filter(None, parts)),
        "samples": str(report.get("points", "")),
        "inside": str(report.get("inside", "")).removeprefix("Inside from ").partition(":")[0],
        "betti": _numbers(report.get("betti")),
        "by faces": _numbers(report.get("betti_by_faces")),
        "said": "; ".join(map(short, _sentences(run))),
    }


def exit_words(code: int) -> str:
    """An exit code, or the name of the signal that ended the process."""
    return str(code) if code >= 0 else signal.Signals(-code).name


def _numbers(betti: Sequence[int] | None) -> str:
    return "" if betti is None else f"({', '.join(map(str, betti))})"


def _sentences(run: Run) -> list[str]:
    """The warnings and why the faces have other Betti numbers, or the error, or the last line of a traceback."""
    report = run.report
    if not report:
        return run.error.strip().splitlines()[-1:]
    _, differs, why = report.get("topology", "").partition(" by its faces ")
    reasons = [why.rpartition(": ")[2]] if differs else []
    return [*report.get("warnings", []), *reasons] or [report.get("error", "")]


def short(sentence: str) -> str:
    """The beginning of a sentence, up to its first reason or advice."""
    words = re.split(r"[:;]| so |, which ", sentence, maxsplit=1)[0]
    return words if len(words) <= _LONGEST else f"{words[:_LONGEST].rsplit(' ', 1)[0]} ..."


def compared(rows: Iterable[Row], before: Iterable[Row]) -> list[Row]:
    """The rows with what changed in each; a mesh that was not there before is new."""
    old = {row["mesh"]: row for row in before}
    return [{**row, "changed": _difference(row, old)} for row in rows]


def merged(rows: Iterable[Row], before: Iterable[Row]) -> list[Row]:
    """The rows with those of meshes that did not run now, in order."""
    now = {row["mesh"]: row for row in rows}
    kept = {row["mesh"]: {**row, "changed": ""} for row in before}
    return sorted((kept | now).values(), key=lambda row: (row["source"], row["mesh"]))


def _difference(row: Row, old: dict[str, Row]) -> str:
    if not old:
        return ""
    if (last := old.get(row["mesh"])) is None:
        return "new"
    names = [name for name in COMPARED if row[name] != last.get(name, "")]
    said = [f"{name} was {last.get(name) or 'nothing'}" for name in names]
    less, more = sorted((float(row["seconds"]), float(last["seconds"])))
    if more > SLOWER * less and more - less > LEAST:
        said.append(f"seconds were {last['seconds']}")
    return "; ".join(said)


def read_csv(path: Path) -> list[Row]:
    with open(path, newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def write_csv(rows: Iterable[Row], path: Path) -> None:
    with open(path, "w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, HEADER, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def markdown(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    lines = [header, ["---"] * len(header), *rows]
    return "".join(f"| {' | '.join(c.replace('|', '/') for c in line)} |\n" for line in lines)


def page(rows: Sequence[Row]) -> str:
    """A summary for each source, and all rows."""
    all_rows = markdown(SHOWN, [[_marked(row, name) for name in SHOWN] for row in rows])
    return f"{summary(rows)}\n{all_rows}"


def _marked(row: Row, name: str) -> str:
    """A cell; Betti numbers that are not those of the faces are bold."""
    differs = name == "betti" and row["by faces"] not in ("", row["betti"])
    return f"**{row[name]}**" if differs else row[name]


def summary(rows: Sequence[Row]) -> str:
    """How many meshes of each source ended how."""
    header = ["source", "meshes", "done", "refused", "failed", "closed, Betti as the faces"]
    header += ["closed, other Betti", "nothing said", "changed", "seconds"]
    sources = sorted({row["source"] for row in rows})
    lines = [_counts(source, [r for r in rows if r["source"] == source]) for source in sources]
    return markdown(header, lines)


def _counts(source: str, rows: Sequence[Row]) -> list[str]:
    exits = Counter(row["exit"] for row in rows)
    closed = [row for row in rows if row["by faces"] and row["betti"]]
    right = sum(row["by faces"] == row["betti"] for row in closed)
    numbers = [len(rows), exits["0"], exits["3"], len(rows) - exits["0"] - exits["3"], right]
    numbers += [len(closed) - right, sum(row["exit"] == "0" and not row["said"] for row in rows)]
    numbers.append(sum(bool(row["changed"]) for row in rows))
    seconds = sum(float(row["seconds"]) for row in rows)
    return [source, *(f"{number:,}" for number in numbers), f"{seconds:,.0f}"]
