# SPDX-License-Identifier: GPL-3.0-or-later
"""Convert a medial axis to the named arrays of an `.npz` file, and back.

Files of arrays are for computing, so `vertices` and `radius` are the Voronoi vertices and their balls there; the
displayed places and radii are stored separately as `shown` and `shown_radius`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats
from ..axis.medial_axis import AS_PUBLISHED, LevelValues, MedialAxis, no_edges
from ..axis.structure import FIELDS, Structure

# Every axis has the arrays in NAMES; only clean forms and curves have those in LEVEL_NAMES.
NAMES = AS_PUBLISHED
LEVEL_NAMES = ("shown", "shown_radius", "sheet", "erosion", "limb", "betti", "place")
# Only axes whose structure is known have these.
STRUCTURE_NAMES = FIELDS


def exact_balls(axis: MedialAxis) -> tuple[Floats, Floats]:
    """Return balls of the axis that end at the faces where these are known, else at the samples: (v, 3) and (v,)."""
    if (level := axis.level) is None:
        return axis.vertices, axis.radius
    crisp = level.is_crisp
    return (
        np.where(crisp[:, None], axis.vertices, level.exact),
        np.where(crisp, axis.radius, level.exact_radius),
    )


def as_arrays(axis: MedialAxis) -> dict[str, NDArray]:
    arrays = {name: np.asarray(getattr(axis, name)) for name in NAMES}
    if (level := axis.level) is not None:
        arrays["vertices"], arrays["radius"] = level.exact, level.exact_radius
        arrays |= {"shown": axis.vertices, "shown_radius": axis.radius}
        arrays |= {name: np.asarray(getattr(level, name)) for name in LEVEL_NAMES[2:]}
    if (structure := axis.structure) is not None:
        arrays |= {name: np.asarray(getattr(structure, name)) for name in STRUCTURE_NAMES}
    return arrays


def from_arrays(arrays: Mapping[str, NDArray]) -> MedialAxis:
    """Return the axis from the arrays of `as_arrays`; files of earlier versions have no `edges` and no `place`."""
    fields: dict[str, Any] = {name: arrays[name] for name in NAMES if name != "edges"}
    fields |= {name: int(arrays[name]) for name in ("unbounded", "zero_area")}
    fields["edges"] = arrays.get("edges", no_edges())
    if "shown" not in arrays:
        return MedialAxis(**fields)
    pieces, loops, cavities = arrays["betti"].tolist()
    level = LevelValues(
        exact=arrays["vertices"],
        exact_radius=arrays["radius"],
        betti=(pieces, loops, cavities),
        place=arrays.get("place", np.zeros(len(arrays["radius"]), np.int32)),
        sheet=arrays["sheet"],
        erosion=arrays["erosion"],
        limb=arrays["limb"],
    )
    fields |= {"vertices": arrays["shown"], "radius": arrays["shown_radius"], "level": level}
    if "part" in arrays:
        fields["structure"] = Structure(**{name: arrays[name] for name in STRUCTURE_NAMES})
    return MedialAxis(**fields)
