# SPDX-License-Identifier: GPL-3.0-or-later
"""Samples of the faces of a shape, without those at which the surface bounds nothing."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import DegenerateInputError
from ..machine import native
from .buried_samples import find_bare, on_flat_faces
from .sample_spacing import mean_spacing
from .walls import Places

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .shape import Shape

# The radius of a sample's disc, in spacings.
_DISC = 0.727


@dataclass(frozen=True, eq=False)
class FaceSamples:
    """Samples of faces before their analysis.

    Parameters
    ----------
    points : (n, 3) float64
    edges : (m, 3) float64
        The points on edges and corners of the solid, where the feature size is 0.
    normals : (n, 3) float64
        Outward.
    kinds : (n,) int32
        Values of `_medial.SampleKind`.
    faces : (n,) int32
        The triangle of the shape on which each sample lies; -1 for a sample that closes an opening.
    radius : (n,) float64
        The radius of the disc of each sample of a face; samples that close openings come last and have none.
    spacing : float
        The mean distance of neighbours.
    buried : int
        The number of samples that were left out because the surface there bounds nothing.
    closing : int
        The number of samples that close openings.
    places : Places
        The flat faces below the samples, where opposite walls are looked for.
    partners : (n,) int32
        The row of the sample on the opposite wall, or -1.
    """

    points: NDArray[np.float64]
    edges: NDArray[np.float64]
    normals: NDArray[np.float64]
    kinds: NDArray[np.int32]
    faces: NDArray[np.int32]
    radius: NDArray[np.float64]
    spacing: float
    buried: int
    closing: int
    places: Places
    partners: NDArray[np.int32]


def sample_faces(
    shape: Shape, options: dict[str, Any], gaps: int, closed: bool, progress: Any
) -> FaceSamples:
    """Sample the faces of a shape.

    Parameters
    ----------
    shape : Shape
    options : dict
        Arguments of `_medial.sample_surface`.
    gaps : int
        The number of edges at which the faces are open.
    closed : bool
        Samples will close these openings. Without them the samples at which an open surface bounds nothing cannot be
        determined, and none is left out.
    progress : _medial.Progress

    Raises
    ------
    InvalidInputError, OutOfMemoryError, Cancelled
    DegenerateInputError
        The surface bounds nothing.
    """
    rows = shape.unfolded if options["pairs"] else np.arange(len(shape.triangles))
    with native.own_errors() as module:
        found = module.sample_surface(
            shape.points,
            shape.triangles[rows],
            sharp_edges=shape.sharp_edges,
            progress=progress,
            **options,
        )
    spacing = mean_spacing(found.area, max(1, len(found.points)))
    faces = rows[found.triangle].astype(np.int32)
    feet, outward = on_flat_faces(shape, found, faces, spacing)
    every = gaps > 0 and not closed
    bare, buried = np.ones(len(feet), bool), 0
    if not every:
        bare, buried = find_bare(shape, feet, outward, spacing, options["pairs"])
    _check_some(bare)
    inside, radius = bare & _are_inside_faces(found.kind), found.radius
    return FaceSamples(
        points=found.points[bare],
        edges=found.points[bare & _are_on_edges(found.kind, gaps, closed)],
        normals=found.normals[bare],
        kinds=found.kind[bare],
        faces=faces[bare],
        radius=radius[bare],
        spacing=spacing,
        buried=buried,
        closing=0,
        places=Places(
            feet[inside],
            outward[inside],
            radius[inside] / _DISC,
            radius[inside] ** 2,
            faces[inside],
            found.bend[inside],
            are_paired(found.partner)[inside],
            np.linalg.norm(found.points - feet, axis=1)[inside],
        ),
        partners=_of_rows(found.partner, bare),
    )


def are_paired(partners: NDArray[np.int32]) -> NDArray[np.bool_]:
    """(n,) mark the samples that have a partner: of two partners one may name the other alone."""
    paired = partners >= 0
    paired[partners[paired]] = True
    return paired


def _of_rows(partners: NDArray[np.int32], kept: NDArray[np.bool_]) -> NDArray[np.int32]:
    """(k,) the partners of the kept samples, counted among these; -1 where a partner was not kept."""
    number = np.where(kept, np.cumsum(kept) - 1, -1).astype(np.int32)
    partners = partners[kept]
    return np.where(partners >= 0, number[partners], np.int32(-1))


def apart_of(samples: FaceSamples) -> NDArray[np.float64]:
    """(n,) the wanted distance of neighbours at each sample; where samples close openings, the mean one."""
    apart = np.full(len(samples.points), samples.spacing)
    apart[: len(samples.radius)] = samples.radius / _DISC
    return apart


def _are_inside_faces(kinds: NDArray[np.int32]) -> NDArray[np.bool_]:
    """(n,) mark the samples in the interior of faces, or all samples if those are a minority.

    On an edge, the opposite wall depends on which of its faces one looks from.
    """
    kind_of = native.load().SampleKind
    inside = (kinds == int(kind_of.SURFACE)) | (kinds == int(kind_of.VERTEX))
    return inside if 2 * np.count_nonzero(inside) > len(kinds) else np.ones(len(kinds), bool)


def _are_on_edges(kinds: NDArray[np.int32], gaps: int, closed: bool) -> NDArray[np.bool_]:
    """(n,) mark the samples of edges and corners of the solid, where the feature size is 0.

    Where an opening is closed its rim is an edge of the solid. Corners of a mesh that stays open do not count: they
    may belong to an opening, where the shape may be thick.
    """
    kind_of = native.load().SampleKind
    edge = kinds == int(kind_of.SHARP)
    if closed:
        edge |= kinds == int(kind_of.BOUNDARY)
    return edge if gaps and not closed else edge | (kinds == int(kind_of.CORNER))


def _check_some(bare: NDArray[np.bool_]) -> None:
    if not bare.any():
        raise DegenerateInputError(
            f"Expected a surface that bounds a solid, found that all {len(bare):,} samples of it "
            "bound nothing; remove doubled faces, or choose Sampling Vertices"
        )
