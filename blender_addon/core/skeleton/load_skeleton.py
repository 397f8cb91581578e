# SPDX-License-Identifier: GPL-3.0-or-later
"""This module reads skeletons from `.json` files that the export wrote."""

from __future__ import annotations

import json
import os
from pathlib import Path

import numpy as np

from ..errors import ReadError
from .skeleton import Skeleton, skeleton_of


def load_skeleton(path: str | os.PathLike) -> Skeleton:
    """Read a skeleton back, exactly as it was written."""
    try:
        found = json.loads(Path(path).read_text("utf-8"))
        points = np.array([node["position"] for node in found["nodes"]], np.float64)
        radius = np.array([node["radius"] for node in found["nodes"]], np.float64)
        branches = [np.array(part["nodes"], np.int64) for part in found["parts"]]
        fit = _fit(points, radius, branches)
    except OSError as error:
        raise ReadError(
            f"Expected to read '{Path(path).name}', but the system says "
            f"'{error.strerror or error}'; choose another file"
        ) from error
    except (ValueError, TypeError, LookupError, OverflowError, RecursionError):
        fit = False
    if not fit:
        raise ReadError(
            f"Expected nodes and parts of a skeleton in '{Path(path).name}', found others; export it again"
        )
    singles = np.setdiff1d(np.arange(len(points)), np.concatenate([[], *branches]))
    return skeleton_of(points, radius, branches, singles.astype(np.int64))


def _fit(points: np.ndarray, radius: np.ndarray, branches: list[np.ndarray]) -> bool:
    """Return whether the arrays have matching shapes, and branches name existing points."""
    if points.ndim != 2 or points.shape[1] != 3 or radius.shape != points.shape[:1]:
        return False
    if not (np.isfinite(points).all() and np.isfinite(radius).all()):
        return False
    return all(
        rows.ndim == 1 and len(rows) > 1 and ((rows >= 0) & (rows < len(points))).all()
        for rows in branches
    )
