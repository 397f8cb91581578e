# SPDX-License-Identifier: GPL-3.0-or-later
"""Samples of the faces of a shape, without those at which the surface bounds nothing, and of its openings."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from ..arrays import Flags, Ints, Longs
from ..errors import DegenerateInputError
from ..machine import native
from ..shape.shape import Shape
from ..shape.triangles import unit_normals
from .analysed import Samples
from .buried_samples import find_bare, on_flat_faces
from .decide import Plan
from .sample_spacing import mean_spacing
from .walls import Places

# The radius of a sample's disc, in spacings.
_DISC = 0.727  # derived: sqrt(kPacking * sqrt(3) / 2)
# A cell of four samples may have its centre outside of them; a dozen on a closed surface have a cell with its centre
# inside.
_OF_SHELL = 12
_FINEST = 1e-6  # of the extent: the least spacing that the grid of the sampler can hold; derived: 20 of 21 bits


def sample_faces(plan: Plan, options: dict[str, Any], progress: Any) -> Samples:
    """Sample the faces of a shape.

    Without samples that close openings, those at which an open surface bounds nothing cannot be determined, and none is
    left out.

    Parameters
    ----------
    plan : Plan
    options : dict
        Arguments of `_medial.sample_surface`.
    progress : _medial.Progress

    Raises
    ------
    DegenerateInputError
        The surface bounds nothing.
    """
    shape, closed = plan.given.shape, plan.closes_openings
    all_rows = np.arange(len(shape.triangles), dtype=np.int64)
    rows = shape.unfolded if options["pairs"] else all_rows
    found = _sampled(shape, rows, options, progress)
    more = _of_small_shells(shape, rows, found, options)
    if more is not None:
        found = _sampled(shape, rows, more, progress)
    spacing = mean_spacing(found.area, max(1, len(found.points)))
    faces = rows[found.triangle].astype(np.int32)
    feet, outward = on_flat_faces(shape, found, faces, spacing)
    is_open = shape.open_edges > 0
    bare, buried = np.ones(len(feet), bool), 0
    if closed or not is_open:
        bare, buried = find_bare(shape, feet, outward, spacing, options["pairs"])
    _check_some(bare)
    inside, radius = bare & _are_inside_faces(found.kind), found.radius
    return Samples(
        points=found.points[bare],
        edges=found.points[bare & _are_on_edges(found.kind, is_open, closed)],
        normals=found.normals[bare],
        kinds=found.kind[bare],
        faces=faces[bare],
        radius=radius[bare],
        apart=radius[bare] / _DISC,
        spacing=spacing,
        buried=buried,
        places=Places(
            feet[inside],
            outward[inside],
            radius[inside] / _DISC,
            radius[inside] ** 2,
            faces[inside],
            found.bend[inside],
            are_paired(found.partner)[inside],
            np.linalg.norm(found.points - feet, axis=1)[inside],
            np.flatnonzero(inside[bare]),
        ),
        partners=_of_rows(found.partner, bare) if options["pairs"] else None,
        offset=shape.offset,
    )


def close_openings(plan: Plan, samples: Samples, progress: Any) -> Samples:
    """Append samples of the openings of a surface, where the winding number of its faces is one half."""
    shape, partners = plan.given.shape, samples.partners
    with native.own_errors() as module:
        more, outward, _ = module.closing_samples(
            samples.points,
            samples.normals,
            samples.radius,
            shape.points,
            shape.triangles,
            seed=plan.given.settings.seed,
            progress=progress,
        )
        opening = np.full(len(more), int(module.SampleKind.OPENING), np.int32)
    assert samples.normals is not None and samples.kinds is not None
    assert samples.faces is not None and samples.apart is not None
    none = np.full(len(more), -1, np.int32)
    return replace(
        samples,
        points=np.concatenate((samples.points, more)),
        normals=np.concatenate((samples.normals, outward)),
        kinds=np.concatenate((samples.kinds, opening)),
        faces=np.concatenate((samples.faces, none)),
        apart=np.concatenate((samples.apart, np.full(len(more), samples.spacing))),
        partners=None if partners is None else np.concatenate((partners, none)),
        closing=len(more),
    )


def _sampled(shape: Shape, rows: Longs, options: dict[str, Any], progress: Any) -> Any:
    with native.own_errors() as module:
        return module.sample_surface(
            shape.points,
            shape.triangles[rows],
            sharp_edges=shape.sharp_edges,
            progress=progress,
            **options,
        )


def _of_small_shells(
    shape: Shape, rows: Longs, found: Any, options: dict[str, Any]
) -> dict[str, Any] | None:
    """Return the options with which no shell has less than `_OF_SHELL` samples; None where none has, or too many have.

    Fewer samples may show no cell on the other side of a shell, so a small cavity would be lost.
    """
    part, is_open = shape.connected
    part, count = part[rows], len(is_open)
    few = np.bincount(part[found.triangle], minlength=count) < _OF_SHELL
    if not few.any() or _OF_SHELL * np.count_nonzero(few) > len(found.points):
        return None
    small = np.flatnonzero(few[part] & (part >= 0))
    corners = shape.points[shape.triangles[rows[small]]]
    area = np.bincount(part[small], unit_normals(corners)[1] / 2.0, count)
    spacing = mean_spacing(found.area, max(1, len(found.points)))
    wanted = np.array([mean_spacing(area[shell], _OF_SHELL) for shell in part[small]])
    seen = wanted > _FINEST * np.max(np.ptp(shape.points, axis=0))
    if not seen.any():
        return None
    wanted, corners = wanted[seen], corners[seen]
    sites, spacings = options.get("sizing", (found.points, np.full(len(found.points), spacing)))
    sizing = (
        np.concatenate((sites, corners.mean(axis=1))),
        np.concatenate((spacings, np.minimum(spacing, wanted))),
    )
    left = () if "sizing" in options else ("count", "spacing")
    return {**{name: options[name] for name in options if name not in left}, "sizing": sizing}


def are_paired(partners: Ints) -> Flags:
    """Mark the samples that have a partner, (n,): of two partners one may name the other alone."""
    paired = partners >= 0
    paired[partners[paired]] = True
    return paired


def _of_rows(partners: Ints, kept: Flags) -> Ints:
    """Return the partners of the kept samples, (k,), counted among these; -1 where a partner was not kept."""
    number = np.where(kept, np.cumsum(kept) - 1, -1).astype(np.int32)
    partners = partners[kept]
    return np.where(partners >= 0, number[partners], np.int32(-1))


def _are_inside_faces(kinds: Ints) -> Flags:
    """Mark the samples in the interior of faces, (n,), or all samples if those are a minority.

    On an edge, the opposite wall depends on which of its faces one looks from.
    """
    kind_of = native.load().SampleKind
    inside = (kinds == int(kind_of.SURFACE)) | (kinds == int(kind_of.VERTEX))
    return inside if 2 * np.count_nonzero(inside) > len(kinds) else np.ones(len(kinds), bool)


def _are_on_edges(kinds: Ints, is_open: bool, closed: bool) -> Flags:
    """Mark the samples of edges and corners of the solid, (n,), where the feature size is 0.

    Where an opening is closed its rim is an edge of the solid. Corners of a mesh that stays open do not count: they
    may belong to an opening, where the shape may be thick.
    """
    kind_of = native.load().SampleKind
    edge = kinds == int(kind_of.SHARP)
    if closed:
        edge |= kinds == int(kind_of.BOUNDARY)
    return edge if is_open and not closed else edge | (kinds == int(kind_of.CORNER))


def _check_some(bare: Flags) -> None:
    if not bare.any():
        raise DegenerateInputError(
            f"Expected a surface that bounds a solid, found that all {len(bare):,} samples of it "
            "bound nothing; remove doubled faces, or choose Sampling Vertices"
        )
