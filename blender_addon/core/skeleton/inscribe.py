# SPDX-License-Identifier: GPL-3.0-or-later
"""This module centres the points of a net, so that the ball around each of them touches the surface all around.

A point moves within the plane across its branch to the place that is farthest from the surface. Each chain is then
smoothed a little and centred again. Tips stay: they are centres of balls that touch the end of a limb. Forks, and the
points in their balls, stay where their limbs meet.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from .net import Net

_FIRST = 0.25  # the first step, as a share of the radius; a point moves by at most its radius
_HALVED = 7  # so often the step is halved
_WAYS = 8  # directions of a step
_WINDOW = 0.5  # a branch goes from the point so many radii before to that so many radii after
_ROUNDS = 2  # centred and smoothed so often


def centre_points(net: Net, depth: Callable[[NDArray[np.float64]], NDArray[np.float64]]) -> None:
    """Move the points of a net to the middle of the solid; every radius becomes the distance to the surface."""
    rows, before, after = _between(net)
    start = net.points[rows].copy()
    for last in (False,) * (_ROUNDS - 1) + (True,):
        along = net.points[after] - net.points[before]
        _climb(net.points, rows, along, start, net.radius[rows], depth)
        if not last:
            net.points[rows] = (
                2.0 * net.points[rows] + net.points[before] + net.points[after]
            ) / 4.0
    inscribe(net, depth)


def inscribe(net: Net, depth: Callable[[NDArray[np.float64]], NDArray[np.float64]]) -> None:
    """Make every radius of a net the distance to the surface."""
    used = np.unique(np.concatenate([*net.branches.values(), list(net.at)]).astype(np.int64))
    net.radius[used] = depth(net.points[used])


def _between(net: Net) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Return the points of branches that may move, and the points before and after each."""
    found = []
    for chain in net.branches.values():
        rows = np.array(chain)
        free = np.ones(len(rows), bool)
        for node in {chain[0], chain[-1]}:
            if len(net.at[node]) > 2:
                away = np.linalg.norm(net.points[rows] - net.points[node], axis=1)
                free &= away > net.radius[node]
        inner = np.flatnonzero(free[1:-1]) + 1
        found.append(np.column_stack((rows[inner], *_aside(net, rows, inner))))
    rows, before, after = np.concatenate([*found, np.zeros((0, 3), np.int64)]).astype(np.int64).T
    return rows, before, after


def _aside(
    net: Net, rows: NDArray[np.int64], inner: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the points of a chain that are _WINDOW radii before and after some, or its ends; neighbours are too near."""
    steps = np.linalg.norm(np.diff(net.points[rows], axis=0), axis=1)
    marks = np.concatenate(([0.0], np.cumsum(steps)))
    apart = _WINDOW * net.radius[rows[inner]]
    before = np.searchsorted(marks, marks[inner] - apart, side="right") - 1
    after = np.searchsorted(marks, marks[inner] + apart, side="left")
    before = np.clip(before, 0, inner - 1)
    return rows[before], rows[np.clip(after, inner + 1, len(rows) - 1)]


def _climb(
    points: NDArray[np.float64],
    rows: NDArray[np.int64],
    along: NDArray[np.float64],
    start: NDArray[np.float64],
    radius: NDArray[np.float64],
    depth: Callable[[NDArray[np.float64]], NDArray[np.float64]],
) -> None:
    """Move points across their branches away from the surface, by shorter and shorter steps."""
    if not len(rows):
        return
    ways = _across(along)
    here, best = points[rows].copy(), depth(points[rows])
    step = _FIRST * radius
    for _ in range(2 * _HALVED):
        tried = here[:, None] + step[:, None, None] * ways
        found = depth(tried.reshape(-1, 3)).reshape(len(rows), _WAYS)
        far = np.linalg.norm(tried - start[:, None], axis=2) > radius[:, None]
        found[far] = -1.0
        which = found.argmax(axis=1)
        value = found[np.arange(len(rows)), which]
        better = value > best
        here[better] = tried[better, which[better]]
        best = np.where(better, value, best)
        step = np.where(better, step, step / 2.0)
    points[rows] = here


def _across(along: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return unit directions across some directions, (n, _WAYS, 3)."""
    length = np.linalg.norm(along, axis=1, keepdims=True)
    unit = along / np.where(length > 0.0, length, 1.0)
    axis = np.eye(3)[np.abs(unit).argmin(axis=1)]
    first = np.cross(unit, axis)
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    second = np.cross(unit, first)
    turn = 2.0 * np.pi * np.arange(_WAYS) / _WAYS
    return (
        np.cos(turn)[:, None] * first[:, None] + np.sin(turn)[:, None] * second[:, None]
    )
