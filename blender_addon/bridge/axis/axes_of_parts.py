# SPDX-License-Identifier: GPL-3.0-or-later
"""The medial axes of the connected parts of an object: one object each, in a collection of their own."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

import bpy
import numpy as np

from ...core.axis.compute import Computation
from ...core.settings import Look
from ..mesh import stored
from ..objects.output_object import collection_of, remove_object, source_of
from .axis_object import RESULT, SUFFIX, write_result
from .shown_axis import ShownAxis


def write_result_of_part(
    source: bpy.types.Object,
    part: str,
    computation: Computation,
    frame: np.ndarray,
    look: Look,
    shown: ShownAxis,
) -> bpy.types.Object:
    """Make the result of a part of a source, or update the existing one, as `write_result` does."""
    product = replace(RESULT, suffix=f"{SUFFIX} {part}", part=part)
    is_new = product.of(source) is None
    result = write_result(source, computation, frame, look, product, shown=shown)
    if is_new:
        result[stored.OF_PART] = part
        for collection in result.users_collection:
            collection.objects.unlink(result)
        marks = {stored.SOURCE: source, stored.OF_PART: ""}
        collection_of(marks, f"{source.name} Medial Axes", source).objects.link(result)
    return result


def remove_other_parts(made: Collection[bpy.types.Object]) -> None:
    """Remove earlier results of parts of the same sources."""
    sources = {source_of(thing) for thing in made}
    parts = [
        t for t in bpy.data.objects if t.library is None and stored.OF_PART in t and RESULT.has(t)
    ]
    for thing in parts:
        if thing not in made and source_of(thing) in sources:
            remove_object(thing)
