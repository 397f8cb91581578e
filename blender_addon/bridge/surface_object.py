# SPDX-License-Identifier: GPL-3.0-or-later
"""Surface objects that Tight Cocone made: how they are found, made, updated, and what they remember."""

from __future__ import annotations

from functools import partial

import bpy
import numpy as np

from ..core.rebuild.reconstruction import Reconstruction
from .mesh import stored
from .mesh.write_mesh import new_mesh
from .objects.output_object import Product, place, remember

SURFACE = Product(" Surface", (stored.OFF_SURFACE,))
is_surface, surface_of, check_surface_writable = SURFACE.has, SURFACE.of, SURFACE.check_writable


def write_surface(
    source: bpy.types.Object, found: Reconstruction, frame: np.ndarray
) -> bpy.types.Object:
    """Make the surface of a source, or update the existing one."""
    surface, _ = SURFACE.write_mesh(source, partial(new_mesh, found))
    place(surface, frame)
    remember(surface, source, found.points, found.duplicates, found.warnings)
    surface[stored.OFF_SURFACE] = found.off_surface
    surface[stored.NONMANIFOLD_EDGES] = found.nonmanifold_edges
    surface[stored.NONMANIFOLD_VERTICES] = found.nonmanifold_vertices
    surface[stored.CAVITIES] = found.cavities
    return surface
