# SPDX-License-Identifier: GPL-3.0-or-later
"""This module collects the thickness of all shapes of a batch on one page, instead of a file for each."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from ..batch.batch import Item, begin, failure, make_folder, report_of, result_of
from ..machine.job import Outcome, Task
from ..machine.memory_limit import MemoryLimit
from ..thickness.parts_page import PartRow, export_page, row_of, row_without, verdict_of
from ..thickness.thin_parts import find_thin_parts
from .product import Product


class ThicknessPage:
    """One page for all items of a batch; it is made anew each time, because it needs every measurement."""

    def __init__(self, path: str, work: Product, unit: str) -> None:
        self._path, self._work, self._unit = Path(path), work, unit
        self._rows: list[PartRow] = []

    def measured(
        self, item: Item, limit: MemoryLimit, run: Callable[[Task], Outcome]
    ) -> dict[str, Any]:
        """Measure an item, give it a row, and return its report."""
        work = self._work
        begun = begin(replace(item, output=self._path), work, True, limit)
        found = result_of(begun, run(begun.task))
        report: dict[str, Any] = {**report_of(begun, found), "row": len(self._rows) + 1}
        parts = find_thin_parts(found, work.wanted.limit)
        self._rows.append(row_of(item.name, found, parts, self._unit, report["warnings"]))
        return report

    def failed(self, item: Item, error: BaseException) -> dict[str, Any]:
        """Give an item that could not be measured a row that says why, and return its report."""
        report = failure(replace(item, output=self._path), error)
        self._rows.append(row_without(item.name, report["error"]))
        return report

    def written(self) -> dict[str, Any]:
        """Write the page, and return its report, or that of the reason why it could not be written."""
        wanted = self._work.wanted
        verdict = verdict_of(self._rows, wanted.limit, self._unit, wanted.between)
        place = {"input": str(self._path), "object": None, "frame": None, "output": str(self._path)}
        try:
            make_folder(self._path)
            export_page(self._rows, self._path, verdict, wanted.between)
        except Exception as error:
            return {"status": "failed", **place, "kind": type(error).__name__, "error": str(error)}
        figures = {"rows": len(self._rows), "places": sum(row.places for row in self._rows)}
        return {"status": "done", **place, **figures, "verdict": verdict}
