# SPDX-License-Identifier: GPL-3.0-or-later
"""Compute the skeleton of a shape, and the branch to which each vertex and face belongs."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..arrays import Floats, Longs
from ..axis.compute import ANALYSIS
from ..axis.detail import net_with_detail
from ..axis.levels import hierarchy_of
from ..axis.solid_warnings import solid_warnings
from ..curves.depth import Depth
from ..curves.ends import end_limbs
from ..curves.loaded_net import LoadedNet, genuine_loops, loaded_net
from ..curves.net import Net
from ..curves.rules import Loops, clear_loops, join_forks, join_tips, open_loops, prune
from ..errors import DegenerateInputError, InvalidInputError
from ..machine import native
from ..machine.memory_limit import WHAT_IS_FREE, MemoryLimit
from ..machine.progress import Progress
from ..samples.analysed import Analysed
from ..samples.choose_samples import begin
from ..samples.chosen import ChosenSamples, OfChosenSamples
from ..settings import Fill, KeptLoops, Settings, Side, SidesFrom, SkeletonSettings
from ..shape.nearness import nearest
from ..shape.shape import Shape
from ..shape.solid_faces import sharp_angle_of
from .chords import keep_inside, kept_inside, kept_points
from .chosen_ends import join_ends
from .fill import Filled, end_at_lids, filled
from .forks import draw_forks
from .join_pieces import join_pieces, no_joins
from .middle import inscribe, lead_through_middle
from .mirror import make_symmetric
from .parts import Parts, parts_of, places
from .skeleton import Skeleton, centre_of_mass, skeleton_of
from .warnings import fill_warnings, skeleton_warnings


@dataclass(frozen=True, eq=False)
class Skeletonization(OfChosenSamples):
    """A skeletonization holds a skeleton and how it was computed."""

    shape: Shape
    skeleton: Skeleton  # It has as few points as the settings allow
    curve: Skeleton  # The same branches with all points
    parts: Parts  # They assign the surface to the branches
    loops: Loops  # They count the small loops that were cut and filled
    mirrored: bool  # Both halves were replaced by their mean
    outside: int  # This many edges of the skeleton leave the solid
    chosen: ChosenSamples  # The samples that were analysed, the reason for them, and their density
    warnings: tuple[str, ...]  # Each assumption and each suspicion is one sentence
    seconds: float


def compute_skeleton(
    shape: Shape,
    settings: Settings,
    wanted: SkeletonSettings,
    progress: Progress | None = None,
    limit: MemoryLimit = WHAT_IS_FREE,
    ends: Floats | None = None,
    shown: Settings | None = None,
) -> Skeletonization:
    """Return the skeleton of a solid.

    Parameters
    ----------
    shape : Shape
    settings : Settings
        They control the analysis. The side is always the inner one.
    wanted : SkeletonSettings
    progress : Progress, optional
    limit : MemoryLimit
    ends : (e, 3) float64, optional
        Places on or near the surface. The skeleton keeps only what joins these ends; limbs that carry
        little stay, too, but those that are shorter than `detail` says are not there to be joined.
    shown : Settings, optional
        The skeleton keeps the loops and branches that the form CURVE has with these settings: their `limb`, `detail`
        and `crisp` count, and not `wanted.detail`. With `ends`, it is ignored.

    Raises
    ------
    NativeModuleError, InvalidInputError, OutOfMemoryError, Cancelled
    DegenerateInputError
        The samples span no volume, enclose nothing, or enclose a solid without a curve.
    """
    _check_ends(ends)
    full = None if wanted.fill is Fill.OFF else filled(shape, sharp_angle_of(shape, settings))
    begun = begin(
        full.shape if full else shape,
        replace(settings, side=Side.INNER),
        progress,
        limit,
        ANALYSIS,
        levels=True,
    )
    chosen = begun.chosen
    if shown is None or ends is not None:
        net, owner, level, loops = _net(chosen, settings, wanted, begun.progress, ends)
    else:
        net, owner, level, loops = _net_of_curve(chosen, shown, wanted, begun.progress)
    wraps = settings.sides is SidesFrom.WRAP
    decided = SidesFrom.WRAP if wraps else chosen.sides.source
    by_faces = chosen.sides.source is SidesFrom.SURFACE
    depth = Depth(chosen.samples, begun.shape if by_faces else None)
    joined, joins = join_pieces(net, depth, begun.shape) if by_faces else (0, no_joins())
    lead_through_middle(net, depth)
    if full is not None:
        end_at_lids(net, full)
    names = sorted(net.branches)
    plane = float(centre_of_mass(_whole(net, names))[0])
    mirrored = wanted.mirror and make_symmetric(net, plane)
    if mirrored:
        inscribe(net, depth, plane)
    outside = keep_inside(net, depth)
    place = places(net, names).of(net.stands_for()[owner])
    sample = _samples_of_vertices(shape, chosen, full is None or full.shape is shape)
    if full is not None and wanted.fill is Fill.INSIDE:
        _shrink(net, shape, full)
    curve = _whole(net, names)
    return Skeletonization(
        shape=shape,
        skeleton=_thinned(net, names, wanted.simplify, depth, joins),
        curve=curve,
        parts=parts_of(place.of(sample), shape.triangles),
        loops=loops,
        mirrored=mirrored,
        outside=outside,
        chosen=chosen,
        warnings=(
            *solid_warnings(begun.shape, Side.INNER, decided, chosen, level.betti),
            *skeleton_warnings(loops, len(level.generators), outside, joined),
            *fill_warnings(full),
        ),
        seconds=begun.seconds,
    )


def _check_ends(ends: Floats | None) -> None:
    if ends is not None and not (
        ends.ndim == 2 and ends.shape[1] == 3 and len(ends) > 1 and np.isfinite(ends).all()
    ):
        raise InvalidInputError(
            f"Expected two or more ends of three finite coordinates, found an array of shape {ends.shape}; "
            "choose more places on the surface"
        )


def _net(
    chosen: ChosenSamples,
    settings: Settings,
    wanted: SkeletonSettings,
    progress: Progress,
    ends: Floats | None,
) -> tuple[Net, Longs, Any, Loops]:
    """Return the net of limbs, the owner of each sample, the level that they are of, and cleared loops."""
    samples = chosen.samples
    # Curves are fitted to samples, so no place is crisp.
    level, hierarchy = _curve(samples, replace(settings, crisp=False), wanted.limb, progress)
    loaded = loaded_net(samples, hierarchy, level)
    net, owner = loaded.net, loaded.owner
    loops = Loops(0, 0)
    if wanted.loops is not KeptLoops.KEEP:
        loops = clear_loops(net, loaded.spacing, genuine_loops(samples))
    tips = None
    if ends is None:
        prune(net, wanted.share, loaded.balls)
    else:
        tips = join_ends(net, net.stands_for()[owner[nearest(ends, samples.points)]])
    owner = _drawn(loaded, wanted, samples, tips)
    return net, owner, level, loops


def _net_of_curve(
    chosen: ChosenSamples, shown: Settings, wanted: SkeletonSettings, progress: Progress
) -> tuple[Net, Longs, Any, Loops]:
    """Return what `_net` does, with the loops and branches of a curve with some detail."""
    samples = chosen.samples
    level, hierarchy = _curve(samples, shown, shown.limb / 100, progress)
    loaded, loops = net_with_detail(level, hierarchy, samples, shown.detail)
    owner = _drawn(loaded, wanted, samples, None)
    return loaded.net, owner, level, loops


def _drawn(
    loaded: LoadedNet, wanted: SkeletonSettings, samples: Analysed, tips: list[int] | None
) -> Longs:
    """Give the remaining branches of a net their ends and forks; returns the new owner of each sample."""
    net = loaded.net
    join_forks(net)
    owner = end_limbs(net, loaded.owner, loaded.balls, tips)
    if tips is None:
        join_tips(net)
    if wanted.loops is KeptLoops.OPEN:
        open_loops(net)
    draw_forks(net, samples.points)
    return owner


def _curve(
    samples: Analysed, settings: Settings, limb: float, progress: Progress
) -> tuple[Any, Any]:
    """Return the level without sheets and without limbs shorter than a share of the diagonal, and its hierarchy."""
    hierarchy = hierarchy_of(samples, settings, progress.part(0.9))
    with native.own_errors():
        level = hierarchy.extract(
            sheet=math.inf, limb=limb, crisp=settings.crisp, relaxed=True, progress=progress.part()
        )
    if not len(level.vertices):
        raise DegenerateInputError("Expected a ball between samples, found none; use more samples")
    if not len(level.wires) and not len(level.points):
        raise DegenerateInputError(
            f"Expected a solid with a curve skeleton, found {len(level.generators):,} facets of closed "
            "sheets, as of a hollow ball; fill its cavities"
        )
    return level, hierarchy


def _whole(net: Net, names: list[int]) -> Skeleton:
    """Return the branches with all points."""
    singles = np.array([node for node, found in net.at.items() if not found], np.int64)
    branches = [np.array(net.branches[name]) for name in names]
    return skeleton_of(net.points, net.radius, branches, singles)


def _thinned(net: Net, names: list[int], simplify: float, depth: Depth, joins: Longs) -> Skeleton:
    """Return the branches with fewer points; places and radii deviate by no more than `simplify` times the radius.

    The ends of joins stay.
    """
    if simplify > 0.0:
        for name in names:
            chain = np.array(net.branches[name])
            points, radius = net.points[chain], net.radius[chain]
            kept = kept_points(np.column_stack((points, radius)), simplify * radius)
            kept = np.union1d(kept, np.flatnonzero(np.isin(chain, joins)))
            net.branches[name] = chain[kept_inside(points, radius, kept, depth)].tolist()
    found = _whole(net, names)
    rows = nearest(net.points[joins.ravel()], found.points).reshape(-1, 2)
    return replace(found, joins=rows.astype(np.int32))


def _shrink(net: Net, shape: Shape, full: Filled) -> None:
    """Give the balls of a net the radius of the bore, where they reach farther."""
    if len(full.inner):
        with native.own_errors() as module:
            room = module.TriangleTree(shape.points, full.inner).distances(net.points)
        np.minimum(net.radius, room, out=net.radius)


def _samples_of_vertices(shape: Shape, chosen: ChosenSamples, own: bool = True) -> Longs:
    """Return the sample nearest to each vertex of the shape, (v,); `own` says whether samples may be its vertices."""
    samples = chosen.samples
    distinct = samples.analysis.samples
    if (
        own and samples.kinds is None and len(distinct) == len(shape.points)
    ):  # they are the vertices
        return np.arange(len(distinct))
    return distinct[nearest(shape.points, samples.points[distinct])]
