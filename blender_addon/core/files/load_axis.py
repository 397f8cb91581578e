# SPDX-License-Identifier: GPL-3.0-or-later
"""`.npz` files that the export wrote -> medial axes."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np

from ..axis.medial_axis import MedialAxis
from ..errors import ReadError
from .numpy_arrays import read_arrays

_FIELDS = tuple(MedialAxis.__dataclass_fields__)


def load_axis(path: str | os.PathLike) -> MedialAxis:
    """Read a medial axis back, exactly as it was written.

    Raises
    ------
    ReadError
    """
    arrays = read_arrays(path, _FIELDS)
    missing = [name for name in _FIELDS if name not in arrays]
    if missing or not _fit(arrays):
        raise ReadError(
            f"Expected the arrays of a medial axis in '{Path(path).name}', found "
            f"{'no ' + missing[0] if missing else 'arrays that contradict each other'}; "
            "export it again"
        )
    fields: dict[str, Any] = {**arrays}
    fields |= {name: int(arrays[name]) for name in ("unbounded", "zero_area")}
    return MedialAxis(**fields)


def _fit(arrays: dict[str, np.ndarray]) -> bool:
    """Whether the arrays agree: their lengths, and the corners of the polygons."""
    points, faces = len(arrays["radius"]), len(arrays["side"])
    shapes = {"vertices": (points, 3), "generators": (faces, 2), "face_offsets": (faces + 1,)}
    shapes |= dict.fromkeys(("theta", "rho", "side"), (faces,))
    shapes |= dict.fromkeys(("unbounded", "zero_area"), ())
    if faces == 0 or any(arrays[name].shape != shape for name, shape in shapes.items()):
        return False
    offsets, corners = arrays["face_offsets"], arrays["face_vertices"]
    whole = offsets[0] == 0 and offsets[-1] == len(corners) and (np.diff(offsets) >= 3).all()
    inside = ((corners >= 0) & (corners < points)).all()
    return bool(whole and inside and np.isfinite(arrays["vertices"]).all())
