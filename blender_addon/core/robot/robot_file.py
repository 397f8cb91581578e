# SPDX-License-Identifier: GPL-3.0-or-later
"""A robot: the collision geometry of each link as one mesh, and the file with other geometry in its place."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import NamedTuple
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints
from ..cover.ball_cover import Balls
from ..cover.robot_links import write_collisions, write_geoms
from ..errors import MedialAxisError, ReadError
from ..files.text import open_file
from ..machine.memory_limit import MemoryLimit
from .mjcf import Mjcf
from .urdf import Urdf
from .xml_spans import Element, elements_of, replaced

_FORMATS: dict[str, type[Urdf] | type[Mjcf]] = {"robot": Urdf, "mujoco": Mjcf}


class LinkGeometry(NamedTuple):
    """The collision geometry of a link, in the link's frame."""

    name: str
    points: Floats  # (n, 3)
    triangles: Ints  # (m, 3)
    # The first byte of each element that it comes from, and the one behind its last
    spans: tuple[tuple[int, int], ...]
    # The shapes that it consists of, such as "sphere", in the order of the alphabet
    kinds: tuple[str, ...] = ()
    # The attributes of elements in their place: the name is that of the first, the mass that of all
    kept: tuple[tuple[str, str], ...] = ()
    problem: str = ""  # Why it cannot be read, "" where it can


@dataclass(frozen=True, eq=False)
class RobotFile:
    """A robot that was read; `data` are the bytes of its file, `links` those that have collision geometry."""

    data: NDArray[np.uint8]
    links: tuple[LinkGeometry, ...]
    tag: str
    extensions: tuple[str, ...]

    frame = np.identity(4)  # links have frames of their own

    def with_shapes(self, shapes: Mapping[int, Balls]) -> bytes:
        """Return the file with balls and capsules as the collision geometry of some links, named by their rows."""
        links = [(self.links[row], balls) for row, balls in shapes.items()]
        edits = [(link.spans, _lines_of(self.tag, dict(link.kept), balls)) for link, balls in links]
        return replaced(self.data.tobytes(), edits)


def read_robot(
    path: str | os.PathLike, limit: MemoryLimit | None = None
) -> tuple[RobotFile, tuple[str, ...]]:
    """Read a URDF or MJCF with the meshes that it names, and warnings."""
    with open_file(path) as stream:
        data = stream.read()
    root = elements_of(data)
    if root.tag not in _FORMATS:
        raise ReadError(
            f"Expected a URDF or MJCF, whose root is robot or mujoco, found <{root.tag}>; convert it"
        )
    form = _FORMATS[root.tag](root, Path(path).parent)
    links = tuple(_geometry_of(form, *link, limit) for link in form.links() if link[1])
    if not links:
        raise ReadError(f"Expected {form.wanted}, found none; give them collision geometry")
    return RobotFile(np.frombuffer(data, np.uint8), links, form.tag, form.extensions), form.warnings


def _geometry_of(
    form: Urdf | Mjcf, name: str, elements: list[Element], limit: MemoryLimit | None
) -> LinkGeometry:
    kinds, meshes, kept, problem = set(), [], {}, ""
    try:
        kept = form.kept(elements)
        for element in elements:
            kind, mesh = form.mesh_of(element, limit)
            kinds.add(kind)
            meshes.append(mesh)
    except MedialAxisError as error:
        meshes, problem = [], str(error)
    starts = np.cumsum([0, *(len(points) for points, _ in meshes)])
    points = np.concatenate([points for points, _ in meshes] or [np.empty((0, 3))])
    corners = [mesh[1] + start for mesh, start in zip(meshes, starts, strict=False)]
    triangles = np.concatenate(corners or [np.empty((0, 3))]).astype(np.int32)
    spans = tuple((element.start, element.end) for element in elements)
    return LinkGeometry(
        name, points, triangles, spans, tuple(sorted(kinds)), tuple(kept.items()), problem
    )


def _lines_of(tag: str, kept: dict[str, str], balls: Balls) -> list[str]:
    """Return an element for each shape with attributes that it has not; the first has the name, all share the mass."""
    stream = BytesIO()
    (write_geoms if tag == "geom" else write_collisions)(balls, stream)
    lines = [line.strip() for line in stream.getvalue().decode("ascii").splitlines()]
    if "mass" in kept:
        kept["mass"] = repr(float(kept["mass"]) / len(lines))
    return [
        line.replace(f"<{tag}", f"<{tag}{_words(kept, line, first=row == 0)}", 1)
        for row, line in enumerate(lines)
    ]


def _words(kept: dict[str, str], line: str, first: bool) -> str:
    return "".join(
        f" {name}={quoteattr(text)}"
        for name, text in kept.items()
        if f" {name}=" not in line and (first or name != "name")
    )
