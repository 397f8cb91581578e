# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of the race: results go between two marks in it, the text around them stays; long tables are CSV files."""

from __future__ import annotations

import csv
from collections.abc import Callable
from pathlib import Path

from . import compare, plot
from .compare import WORDS, Row
from .solids import SOLIDS

MARK = "<!-- Below this line stands what `python3 -m lab.race` measured. -->"
END = "<!-- Above this line stands what was measured. -->"
FULL = 8000
"""The size whose rows are written whole, and shown on the page."""


def write(rows: list[Row], skipped: dict[str, list[str]], path: Path) -> None:
    """The tables, into a page that has the marks, else into a new one; CSV files and plots next to it."""
    rows = sorted(rows, key=_order)
    text = path.read_text(encoding="utf-8") if path.exists() else f"# The race\n\n{MARK}\n{END}\n"
    above, mark, rest = text.partition(MARK)
    below = rest.partition(END)[2]
    if not mark:
        raise SystemExit(f"Expected the line '{MARK}' in {path}, found none; add it")
    pictures = path.parent.parent / "pictures"
    pictures.mkdir(exist_ok=True)
    plots = "\n".join(_plot(rows, measure, pictures) for measure in ("mean", "missed_mean"))
    parts = [_better(rows), plots, OVERVIEW]
    parts.append(_failures(rows, skipped))
    _save(path, "losses", [*LOST, "its price", "why"], _paid_rows(rows))
    _save(path, "accuracy", ACCURACY, _accuracy_rows(rows))
    _save(path, "measures", MEASURES, _measure_rows(rows))
    _save(path, "outer", ["solid", "program", *WORDS.values()], _outer_rows(rows))
    sizes = sorted({row["size"] for row in rows})
    _save(path, "cost", ["program", *map(str, sizes)], _cost_rows(rows, sizes))
    path.write_text(f"{above}{MARK}\n\n" + "\n".join(parts) + f"\n{END}{below}", encoding="utf-8")


def _save(page: Path, name: str, header: list[str], rows: list[list[str]]) -> None:
    """A CSV file next to the page, under the name to which the page links."""
    with page.with_name(f"benchmark_{name}.csv").open("w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([header, *rows])


def _order(row: Row) -> tuple:
    groups = ["ours", "rival", "peer"]
    return (
        row["size"],
        row["noisy"],
        list(SOLIDS).index(row["solid"]),
        groups.index(row["group"]),
        row["program"],
    )


# --- where somebody is better


def _better(rows: list[Row]) -> str:
    found = compare.losses(rows)
    plain = [loss for loss in found if not loss.pays]
    paid = [loss for loss in found if loss.pays]
    topology = _topology(rows)
    return "\n".join(
        [
            "## Where somebody is better\n",
            f"Of {_cells(rows)} places in the tables (a solid, a number of samples, clean or noisy, a measure) the "
            f"best of the others is more than a tenth better than our default in {len(plain)} and worse in no other "
            f"measure, and in {len(paid)} at a price. The reasons are [above](#why-they-are-better), the rows at a "
            "price in [`benchmark_losses.csv`](benchmark_losses.csv).\n",
            table([*LOST, "why"], [[*_loss(loss), reason(loss)] for loss in plain]),
            "Others have the topology of the solid where ours, clean, has not:\n"
            if topology
            else "",
            table(["solid", "samples", "theirs", "ours", "the solid"], topology)
            if topology
            else "",
        ]
    )


LOST = ["solid", "samples", "measure", "who", "theirs", "ours", "times"]


def _loss(loss: compare.Loss) -> list[str]:
    theirs, measure = loss.theirs, loss.measure
    return [
        _solid(theirs),
        _samples(theirs),
        WORDS[measure],
        theirs["program"],
        f"{theirs[measure]:.1e}",
        f"{loss.ours[measure]:.1e}",
        f"{loss.ratio:.1f}",
    ]


def _paid_rows(rows: list[Row]) -> list[list[str]]:
    return [[*_loss(x), x.pays, reason(x)] for x in compare.losses(rows) if x.pays]


def reason(loss: compare.Loss) -> str:
    """A letter of the list that people wrote on the page."""
    theirs, solid = loss.theirs, SOLIDS[loss.theirs["solid"]]
    if theirs["outer"]:
        return "g"
    if theirs["solid"] in ("shell", "eccentric shell"):
        return "a"
    if solid.parts == "sheets to sharp edges" or theirs["solid"] in ("cylinder", "cone"):
        return "b"
    if not solid.sheets:
        return "c" if loss.measure in compare.COVERAGE else "d"
    return "e" if loss.measure in compare.COVERAGE else "f"


def _cells(rows: list[Row]) -> int:
    return 5 * len({compare.key(row) for row in compare.scored(rows)})


def _topology(rows: list[Row]) -> list[list[str]]:
    scored = [row for row in compare.scored(rows) if not row["outer"]]
    clean = {compare.key(row): row for row in scored if row["program"] == "ours, clean"}
    found = []
    for place, own in clean.items():
        right = [
            row["program"]
            for row in scored
            if compare.key(row) == place and row["group"] != "ours" and compare.exact(row)
        ]
        if right and not compare.exact(own):
            truth = SOLIDS[own["solid"]].shape.betti
            found.append(
                [own["solid"], _samples(own), ", ".join(right), _betti(own), _numbers(truth)]
            )
    return found


# --- tables


def table(header: list[str], rows: list[list[str]]) -> str:
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(row) + " |" for row in lines) + "\n"


def _solid(row: Row) -> str:
    return row["solid"] + (", outside" if row["outer"] else "")


def _samples(row: Row) -> str:
    return f"{row['size']:,}{', noisy' if row['noisy'] else ''}"


def _numbers(betti: tuple | list) -> str:
    return ", ".join(map(str, betti))


def _betti(row: Row) -> str:
    if row["betti"] is None or row["faces"] + row["edges"] == 0:
        return "points"
    return _numbers(row["betti"])


ACCURACY = ["samples", "noise", "program", "solid", "off, mean", "missed, mean"]


def _accuracy_rows(rows: list[Row]) -> list[list[str]]:
    """Mean accuracy and coverage of every program at every size."""
    return [
        [str(row["size"]), _noise(row), row["program"], row["solid"], *_means(row)]
        for row in compare.scored(rows)
        if not row["outer"]
    ]


def _noise(row: Row) -> str:
    return "noisy" if row["noisy"] else "clean"


def _means(row: Row) -> list[str]:
    return [f"{row['mean']:.0e}", f"{row['missed_mean']:.0e}"]


OVERVIEW = (
    "## Accuracy and coverage\n\n"
    "Mean distances off the exact axis and of the exact axis missed, of every program at every size, are in "
    f"[`benchmark_accuracy.csv`](benchmark_accuracy.csv); every measure at {FULL:,} samples, with topology, size, "
    "time and memory, is in [`benchmark_measures.csv`](benchmark_measures.csv). Outer axes, in the box of the surface, "
    "are in [`benchmark_outer.csv`](benchmark_outer.csv); convex solids have none, that of the knot is not known. "
    "Processor time and memory of the whole process, the median over the solids, are in "
    "[`benchmark_cost.csv`](benchmark_cost.csv).\n"
)


def _rank(rows: list[Row]) -> Callable[[str], tuple]:
    groups = {row["program"]: ["ours", "rival", "peer"].index(row["group"]) for row in rows}
    return lambda name: (groups[name], name)


MEASURES = ["solid", "noise", "program", *WORDS.values(), "Betti", "area", "length", "CPU s", "MB"]
MEASURES += ["axis: Betti", "axis: area", "axis: length"]


def _measure_rows(rows: list[Row]) -> list[list[str]]:
    """Every measure at one size, and the exact numbers of each solid's axis."""
    return [
        [row["solid"], _noise(row), *_whole(row), *_truth(row["solid"])]
        for row in compare.scored(rows)
        if row["size"] == FULL and not row["outer"]
    ]


def _truth(name: str) -> list[str]:
    solid = SOLIDS[name]
    return [_numbers(solid.shape.betti), f"{solid.area:.3f}", f"{solid.length:.3f}"]


def _whole(row: Row) -> list[str]:
    sizes = [f"{row['area']:.3f}", f"{row['length']:.3f}", f"{row['cpu']:.2f}"]
    sizes.append(f"{row['bytes'] / 1e6:.0f}")
    return [row["program"], *(f"{row[m]:.1e}" for m in WORDS), _betti(row), *sizes]


def _outer_rows(rows: list[Row]) -> list[list[str]]:
    """Outer axes in the box of the surface; convex solids have none, that of the knot is not known."""
    chosen = [row for row in compare.scored(rows) if row["outer"]]
    return [
        [row["solid"], row["program"], *(_number(row[m]) for m in WORDS)]
        for row in sorted(chosen, key=lambda r: list(SOLIDS).index(r["solid"]))
    ]


def _number(value: float) -> str:
    return "—" if value != value else f"{value:.1e}"


def _cost_rows(rows: list[Row], sizes: list[int]) -> list[list[str]]:
    """Processor time and memory of the whole process: the median over the solids, clean."""
    chosen = [row for row in compare.scored(rows) if not row["outer"] and not row["noisy"]]
    programs = list(dict.fromkeys(sorted((r["program"] for r in chosen), key=_rank(chosen))))
    body = []
    for name in programs:
        cells = [name]
        for size in sizes:
            found = [r for r in chosen if r["program"] == name and r["size"] == size]
            cells.append(_middle(found))
        body.append(cells)
    return body


def _middle(rows: list[Row]) -> str:
    if not rows:
        return "—"
    cpu, memory = (sorted(row[what] for row in rows)[len(rows) // 2] for what in ("cpu", "bytes"))
    return f"{cpu:.2f} s, {memory / 1e6:.0f} MB"


def _failures(rows: list[Row], skipped: dict[str, list[str]]) -> str:
    """A line for each program and reason, with the solids at which it failed."""
    where: dict[tuple[str, str], list[str]] = {}
    for row in rows:
        if "failed" in row:
            place = f"{_solid(row)} ({_samples(row)})"
            where.setdefault((row["program"], row["failed"]), []).append(place)
    failed = [[program, reason, "; ".join(places)] for (program, reason), places in where.items()]
    parts = ["## Without a result\n"]
    parts.append(table(["program", "what happened", "where"], failed) if failed else "None.\n")
    for name, missing in skipped.items():
        parts.append(f"- {name} was skipped: `{', '.join(missing)}` is not on the machine.")
    return "\n".join(parts) + "\n"


# --- plots


def _plot(rows: list[Row], measure: str, folder: Path) -> str:
    """Plots a measure over the number of samples, for samples without noise."""
    data: dict[str, dict[str, list[tuple[float, float]]]] = {}
    for row in compare.scored(rows):
        if row["noisy"] or row["outer"] or row["program"] not in plot.COLOURS:
            continue
        lines = data.setdefault(row["solid"], {})
        place = (float(row["size"]), max(row[measure], compare.FLOOR))
        lines.setdefault(row["program"], []).append(place)
    name = f"race_{measure}.svg"
    title = {
        "mean": "Mean distance of the output from the exact axis",
        "missed_mean": "Mean distance of the exact axis from the output",
    }[measure]
    ordered = {solid: data[solid] for solid in SOLIDS if solid in data}
    (folder / name).write_text(plot.panels(ordered, title), encoding="utf-8")
    return f"![{title}, over the number of samples, a panel for each solid](../pictures/{name})\n"
