# SPDX-License-Identifier: GPL-3.0-or-later
"""Spheres, cylinders and capsules of links in files of robots, by Python's parser and the meaning of URDF and MJCF."""

import numpy as np
from scipy.spatial.transform import Rotation


def shapes_of(link):
    """Return (kind, ends (2, 3), radius) of each shape right in a link or body; of a sphere the ends are one place."""
    if link.tag == "body":
        return [_of_geom(geom) for geom in link.findall("geom")]
    return [_of_collision(item) for item in link.findall("collision")]


def _of_geom(geom):
    kind, size = geom.get("type"), float(geom.get("size"))
    place = geom.get("fromto") if kind == "capsule" else f"{geom.get('pos')} {geom.get('pos')}"
    return kind, _numbers(place).reshape(2, 3), size


def _of_collision(item):
    origin, shape = item.find("origin"), item.find("geometry")[0]
    middle = np.zeros(3) if origin is None else _numbers(origin.get("xyz"))
    turn = Rotation.identity() if origin is None else _turn(origin.get("rpy"))
    half = turn.apply([0.0, 0.0, float(shape.get("length", "0")) / 2])
    return shape.tag, np.array([middle - half, middle + half]), float(shape.get("radius"))


def _turn(rpy):
    return Rotation.from_euler("xyz", _numbers(rpy))


def _numbers(text):
    return np.array([float(word) for word in text.split()])


def away(link, places):
    """Return how far places are from the shapes of a link or body; negative inside."""
    least = np.full(len(places), np.inf)
    for kind, ends, radius in shapes_of(link):
        along = ends[1] - ends[0]
        share = (places - ends[0]) @ along / max(along @ along, 1e-300)
        line = 0.0 if kind == "sphere" else share if kind == "cylinder" else share.clip(0, 1)
        foot = ends[0] + np.multiply.outer(line + 0.0 * share, along)
        gap = np.linalg.norm(places - foot, axis=1) - radius
        if kind == "cylinder":
            gap = np.maximum(gap, (np.abs(share - 0.5) - 0.5) * np.linalg.norm(along))
        least = np.minimum(least, gap)
    return least
