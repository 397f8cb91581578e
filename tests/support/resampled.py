# SPDX-License-Identifier: GPL-3.0-or-later
"""From a mesh to a medial axis by way of samples of its surface, as the add-on and as the bare module do it."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import distance, topology
from .meshes import Mesh

Array = NDArray[np.float64]


def by_the_addon(mesh: Mesh, **options: Any) -> Any:
    """A `Computation` of the add-on, without Blender. Options are those of its settings, else as published and the
    defaults."""
    from medial_axis.core.axis.compute import compute
    from medial_axis.core.settings import Form, Settings

    return compute(*mesh, Settings(**{"form": Form.PUBLISHED} | options))


def of_surface(mesh: Mesh, count: int, **options: Any) -> Any:
    """The same with so many samples of the surface, whatever its vertices are like."""
    from medial_axis.core.settings import SamplingMode

    return by_the_addon(mesh, sampling=SamplingMode.SURFACE, samples=count, **options)


def graded(medial: Any, mesh: Mesh, count: int, ratio: float = 10.0) -> tuple[Any, Any]:
    """Samples whose spacings grow by `ratio` along x, and their inner axis, by the bare module."""
    vertices, triangles = mesh
    sites = distance.points_on_triangles(vertices[triangles], 5000, np.random.default_rng(0))
    along = (sites[:, 0] - sites[:, 0].min()) / np.ptp(sites[:, 0])
    wanted = ratio**along
    wanted *= np.sqrt(topology.area(*mesh) / count * np.mean(2 / (np.sqrt(3) * wanted**2)))
    samples = medial.sample_surface(
        vertices, triangles, sizing=(sites, wanted), count=count, smooth=True
    )
    analysis = medial.MedialAnalysis(samples.points, triangles, vertices=vertices)
    return samples, analysis.extract(side=medial.Side.INNER)


def spacing(area: float, count: int) -> float:
    """Distance of neighbours in a hexagonal lattice of so many points."""
    return float(np.sqrt(2 * area / (np.sqrt(3) * count)))


def diagonal(vertices: Array) -> float:
    return float(np.linalg.norm(np.ptp(vertices, axis=0)))


def turned(mesh: Mesh, frame: Array) -> Mesh:
    """Rotated and rounded to float32, as Blender keeps it."""
    return (mesh[0] @ frame.T).astype(np.float32).astype(float), mesh[1]
