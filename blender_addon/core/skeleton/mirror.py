# SPDX-License-Identifier: GPL-3.0-or-later
"""If a skeleton is symmetric in X up to the noise of its samples, both halves are replaced by their mean.

The plane goes through the centre of mass. Nodes and branches must have mirror images, and no point may be farther than
2 % of the size from the mirror image of another one; otherwise nothing changes.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Floats
from ..curves.net import Net
from ..curves.smooth_line import at_marks
from ..shape.nearness import near, nearest
from ..small_matrices import length_of

SYMMETRIC = 0.02  # a mirror image may be off by this share of the size; chosen: rig


def make_symmetric(net: Net, plane: float) -> bool:
    """Average both halves of a net on the two sides of an X; return False where it is not symmetric."""
    rows = np.unique(np.concatenate([*net.branches.values(), list(net.at)]).astype(np.int64))
    points = net.points[rows]
    allowed = SYMMETRIC * length_of(np.ptp(points, axis=0))
    if not near(_image(points, plane), points, allowed).all():
        return False
    nodes = _images_of_nodes(net, plane, allowed)
    branches = None if nodes is None else _images_of_branches(net, nodes, plane, allowed)
    if nodes is None or branches is None:
        return False
    for name, (other, way) in branches.items():
        if name <= other:
            _average(net, name, other, way, plane)
    old = net.points.copy(), net.radius.copy()
    for node, other in nodes.items():
        net.points[node] = (old[0][node] + _image(old[0][other], plane)) / 2
        net.radius[node] = (old[1][node] + old[1][other]) / 2
    return True


def _image(points: Floats, plane: float) -> Floats:
    image = points.copy()
    image[..., 0] = 2.0 * plane - image[..., 0]
    return image


def _images_of_nodes(net: Net, plane: float, allowed: float) -> dict[int, int] | None:
    """Return {node: its mirror image}, or None if one has none. It may be off by `allowed` or its radius."""
    nodes = np.array(sorted(net.at))
    found = nodes[nearest(_image(net.points[nodes], plane), net.points[nodes])]
    away = np.linalg.norm(_image(net.points[nodes], plane) - net.points[found], axis=1)
    image = dict(zip(nodes.tolist(), found.tolist(), strict=True))
    if (away > np.maximum(allowed, net.radius[nodes])).any():
        return None
    return image if all(image[image[node]] == node for node in image) else None


def _images_of_branches(
    net: Net, nodes: dict[int, int], plane: float, allowed: float
) -> dict[int, tuple[int, list[int]]] | None:
    """Return {branch: (its mirror image, the points of that from the image of its start)}, or None if one has none."""
    image = {}
    for name, chain in net.branches.items():
        start, end = nodes[chain[0]], nodes[chain[-1]]
        middle = _image(_at(net, chain, np.array([0.5]))[0][0], plane)
        found = []
        for other in net.at[start]:
            way = net.branches[other]
            for rows in (way, way[::-1]):
                if (rows[0], rows[-1]) == (start, end):
                    away = _at(net, rows, np.array([0.3, 0.7]))[0]
                    away -= _image(_at(net, chain, np.array([0.3, 0.7]))[0], plane)
                    found.append((length_of(away), other, rows))
        if not found:
            return None
        _, other, rows = min(found, key=lambda item: item[:2])
        if length_of(_at(net, rows, np.array([0.5]))[0][0] - middle) > 2.0 * allowed:
            return None
        image[name] = other, rows
    return image if all(image[image[name][0]][0] == name for name in image) else None


def _average(net: Net, name: int, other: int, way: list[int], plane: float) -> None:
    """Make two branches, or the two halves of one, mirror images of each other with equally many points."""
    chain = net.branches[name]
    if name == other:
        _average_with_itself(net, chain, chain[0] != way[0], plane)
        return
    short, long = (chain, way) if len(chain) <= len(way) else (way, chain)
    kept = np.round(np.linspace(0, len(long) - 1, len(short))).astype(np.int64)
    share = _shares(net.points[short])
    (places, radii), (others, others_radii) = (_at(net, rows, share) for rows in (short, long))
    mean, radius = (places + _image(others, plane)) / 2, (radii + others_radii) / 2
    inner = slice(1, -1)  # nodes belong to several branches and are averaged later
    left = [long[i] for i in kept]
    net.points[short[inner]], net.radius[short[inner]] = mean[inner], radius[inner]
    net.points[left[inner]], net.radius[left[inner]] = _image(mean, plane)[inner], radius[inner]
    dropped = np.setdiff1d(np.arange(len(long)), kept)
    near = (
        kept[np.abs(dropped[:, None] - kept[None, inner]).argmin(axis=1) + 1]
        if len(kept) > 2
        else kept[:1]
    )
    net.moved[np.array(long)[dropped]] = np.array(long)[near]
    net.branches[name], net.branches[other] = (short, left) if short is chain else (left, short)


def _average_with_itself(net: Net, chain: list[int], along: bool, plane: float) -> None:
    """Average a branch with its own image: it lies in the plane, or crosses it in its middle (`along`)."""
    share = np.linspace(0.0, 1.0, len(chain)) if along else _shares(net.points[chain])
    places, radii = _at(net, chain, share)
    others, others_radii = (places[::-1], radii[::-1]) if along else (places, radii)
    net.points[chain[1:-1]] = ((places + _image(others, plane)) / 2)[1:-1]
    net.radius[chain[1:-1]] = ((radii + others_radii) / 2)[1:-1]


def _shares(points: Floats) -> Floats:
    """Return the share of the length of a chain before each of its points, (n,), from 0 to 1."""
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    return np.concatenate(([0.0], np.cumsum(steps))) / max(steps.sum(), np.finfo(float).tiny)


def _at(net: Net, rows: list[int], share: Floats) -> tuple[Floats, Floats]:
    """Return the points at some shares of the length of a chain, and the radii there."""
    points = net.points[rows]
    found = at_marks(share, _shares(points), np.column_stack((points, net.radius[rows])))
    return found[:, :3].copy(), found[:, 3].copy()
