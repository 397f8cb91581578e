"""The attributes of a medial axis in Blender: one table from name to domain, type and dtype."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import bpy
import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..core.analysis import MedialAxis


@dataclass(frozen=True)
class Attribute:
    """One attribute of the result mesh.

    Parameters
    ----------
    name : str
        In Blender.
    field, column : str, int or None
        Of `MedialAxis`; `column` picks one where Blender has no type for pairs.
    domain, type : str
        Blender's identifiers.
    dtype : type
        What Blender stores, so that it is copied without conversion.
    """

    name: str
    field: str
    domain: str
    type: str
    dtype: type
    column: int | None = None

    def values(self, axis: MedialAxis) -> NDArray:
        """The flat array that `foreach_set("value", ...)` wants."""
        array = getattr(axis, self.field)
        if self.column is not None:
            array = array[:, self.column]
        return np.ascontiguousarray(array, self.dtype).ravel()


RADIUS = Attribute("ma_radius", "radius", "POINT", "FLOAT", np.float32)
_FACE = (
    Attribute("ma_theta", "theta", "FACE", "FLOAT", np.float32),
    Attribute("ma_rho", "rho", "FACE", "FLOAT", np.float32),
    Attribute("ma_side", "side", "FACE", "INT", np.int32),
)
_PAIR = (Attribute("ma_generators", "generators", "FACE", "INT32_2D", np.int32),)
_TWO_INTS = (
    Attribute("ma_generator_a", "generators", "FACE", "INT", np.int32, column=0),
    Attribute("ma_generator_b", "generators", "FACE", "INT", np.int32, column=1),
)


def attributes() -> tuple[Attribute, ...]:
    """All attributes, as this Blender can hold them."""
    types = bpy.types.Attribute.bl_rna.properties["data_type"].enum_items
    return (RADIUS, *_FACE, *(_PAIR if "INT32_2D" in types else _TWO_INTS))
