# SPDX-License-Identifier: GPL-3.0-or-later
"""The structure of a medial axis as a table, for reports and spreadsheets (docs/parts.md)."""

from __future__ import annotations

from typing import Any

from .structure import CORNER, CREASE, CURVE_NAMES, JUNCTION, NODE_NAMES, RIM, SEAM, Structure

COLUMNS = (
    *("part", "patch_a", "patch_b", "area", "mean_radius", "least_radius", "neighbours"),
    *("seams", "rims", "creases"),
)


def counts_of(structure: Structure) -> dict[str, int]:
    """Return the numbers of sheets, seams, rims, creases, junctions and corners."""
    return {
        "sheets": structure.parts,
        "seams": structure.count(SEAM),
        "rims": structure.count(RIM),
        "creases": structure.count(CREASE),
        "junctions": structure.count_nodes(JUNCTION),
        "corners": structure.count_nodes(CORNER),
    }


def rows_of(structure: Structure) -> list[dict[str, Any]]:
    """Return a row with `COLUMNS` for each part; neighbours and curves are lists of numbers."""
    rows: list[dict[str, Any]] = []
    for part, (low, high) in enumerate(structure.part_patches.tolist()):
        row: dict[str, Any] = {
            "part": part,
            "patch_a": low,
            "patch_b": high,
            "area": float(structure.part_area[part]),
            "mean_radius": float(structure.part_mean_radius[part]),
            "least_radius": float(structure.part_least_radius[part]),
            "neighbours": [],
        }
        rows.append({**row, "seams": [], "rims": [], "creases": []})
    for curve, kind in enumerate(structure.curve_kind.tolist()):
        parts = structure.parts_at(curve).tolist()
        for part in parts:
            rows[part][f"{CURVE_NAMES[kind]}s"].append(curve)
            if kind == SEAM:
                rows[part]["neighbours"] += [other for other in parts if other != part]
    for row in rows:
        row["neighbours"] = sorted(set(row["neighbours"]))
    return rows


def summary_of(structure: Structure) -> dict[str, Any]:
    """Return the structure for JSON: counts, parts, curves, and nodes with the rows of their vertices."""
    curves = [
        {
            "curve": curve,
            "kind": CURVE_NAMES[kind],
            "parts": structure.parts_at(curve).tolist(),
            "length": float(structure.curve_length[curve]),
            "mean_radius": float(structure.curve_mean_radius[curve]),
            "least_radius": float(structure.curve_least_radius[curve]),
        }
        for curve, kind in enumerate(structure.curve_kind.tolist())
    ]
    nodes = [
        {
            "kind": NODE_NAMES[kind],
            "vertex": int(structure.node_vertex[node]),
            "curves": structure.curves_at(node).tolist(),
        }
        for node, kind in enumerate(structure.node_kind.tolist())
    ]
    return {**counts_of(structure), "parts": rows_of(structure), "curves": curves, "nodes": nodes}
