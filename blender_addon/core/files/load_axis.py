# SPDX-License-Identifier: GPL-3.0-or-later
"""This module reads medial axes from `.npz` files that the export wrote."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np

from ..axis.medial_axis import MedialAxis, no_edges
from ..errors import ReadError
from .axis_arrays import LEVEL_NAMES, NAMES, STRUCTURE_NAMES, from_arrays
from .numpy_arrays import read_arrays


def load_axis(path: str | os.PathLike) -> MedialAxis:
    """Read a medial axis back, exactly as it was written."""
    arrays = read_arrays(path, (*NAMES, *LEVEL_NAMES, *STRUCTURE_NAMES))
    wanted = set(NAMES) - {"edges"}  # files of earlier versions have none, and no `place`
    if "shown" in arrays:
        wanted |= set(LEVEL_NAMES) - {"place"}
    if "part" in arrays:
        wanted |= set(STRUCTURE_NAMES)
    missing = sorted(wanted - set(arrays))
    if missing or not _fit(arrays):
        raise ReadError(
            f"Expected the arrays of a medial axis in '{Path(path).name}', found "
            f"{'no ' + missing[0] if missing else 'arrays that contradict each other'}; "
            "export it again"
        )
    return from_arrays(arrays)


def _shapes_of_structure(
    arrays: dict[str, np.ndarray], points: int, faces: int
) -> dict[str, tuple[int, ...]]:
    """Return the shapes of the arrays of a structure; those of lists follow from their offsets."""
    edges, parts, curves, nodes = (
        len(arrays[name]) for name in ("seam", "part_area", "curve_kind", "node_kind")
    )
    shapes: dict[str, tuple[int, ...]] = {"kind": (points,), "facet_edges": (edges, 2)}
    shapes |= dict.fromkeys(("part", "turned"), (faces,))
    shapes |= {"curve": (edges,), "part_patches": (parts, 2), "node_vertex": (nodes,)}
    shapes |= dict.fromkeys(("part_mean_radius", "part_least_radius"), (parts,))
    shapes |= dict.fromkeys(("curve_length", "curve_mean_radius", "curve_least_radius"), (curves,))
    shapes |= {"curve_part_offsets": (curves + 1,), "node_curve_offsets": (nodes + 1,)}
    return shapes


def _fit(arrays: dict[str, np.ndarray]) -> bool:
    """Return whether the arrays have matching shapes, and polygons and edges name existing vertices."""
    points, faces = len(arrays["radius"]), len(arrays["side"])
    edges = arrays.get("edges", no_edges())
    shapes = {"vertices": (points, 3), "generators": (faces, 2), "face_offsets": (faces + 1,)}
    shapes |= dict.fromkeys(("theta", "rho", "side"), (faces,))
    shapes |= dict.fromkeys(("unbounded", "zero_area"), ())
    if "shown" in arrays:
        shapes |= {"shown": (points, 3), "shown_radius": (points,), "limb": (len(edges),)}
        shapes |= {"sheet": (faces,), "erosion": (faces,), "betti": (3,)}
        shapes |= {"place": (points,)} if "place" in arrays else {}
    if "part" in arrays:
        shapes |= _shapes_of_structure(arrays, points, faces)
    if points == 0 or any(arrays[name].shape != shape for name, shape in shapes.items()):
        return False
    offsets, corners = arrays["face_offsets"], arrays["face_vertices"]
    whole = offsets[0] == 0 and offsets[-1] == len(corners) and (np.diff(offsets) >= 3).all()
    pairs = edges.ndim == 2 and edges.shape[1] == 2
    inside = all(((ids >= 0) & (ids < points)).all() for ids in (corners, edges))
    places = (arrays["vertices"], arrays.get("shown", arrays["vertices"]))
    return bool(whole and pairs and inside and all(np.isfinite(x).all() for x in places))
