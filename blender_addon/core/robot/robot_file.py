# SPDX-License-Identifier: GPL-3.0-or-later
"""A robot as URDF: the collision geometry of each link as one mesh, and the file with other geometry in its place."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from io import BytesIO
from pathlib import Path
from typing import NamedTuple
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints
from ..cover.ball_cover import Balls
from ..cover.robot_links import write_collisions
from ..cover.write_balls import check_robot
from ..errors import MedialAxisError, ReadError
from ..files.read_shape import read_shape
from ..machine.memory_limit import MemoryLimit
from ..portable_cosine import cosine
from ..small_matrices import times
from .primitive_meshes import Mesh, ball_mesh, box_mesh, cylinder_mesh
from .xml_spans import Element, elements_of, replaced


class LinkGeometry(NamedTuple):
    """The collision geometry of a link, in the link's frame.

    Parameters
    ----------
    name : str
    points : (n, 3) float64
    triangles : (m, 3) int32
    pieces : int
        How many elements it comes from.
    balls_only : bool
        It consists of spheres, which need no others.
    problem : str
        Why it cannot be read, "" where it can.
    """

    name: str
    points: Floats
    triangles: Ints
    pieces: int
    balls_only: bool = False
    problem: str = ""


@dataclass(frozen=True, eq=False)
class RobotFile:
    """A robot that was read; `data` are the bytes of its file, `links` those that have collision geometry."""

    data: NDArray[np.uint8]
    links: tuple[LinkGeometry, ...]

    @cached_property
    def frame(self) -> Floats:
        """Return the identity: links have frames of their own."""
        return np.identity(4)

    def with_shapes(self, shapes: Mapping[int, Balls]) -> bytes:
        """Return the file with balls and capsules as the collision geometry of some links, named by their rows."""
        data = self.data.tobytes()
        links = _links(elements_of(data))
        return replaced(
            data,
            [(links[row].all("collision"), _lines(links[row], shapes[row])) for row in shapes],
        )


def read_robot(
    path: str | os.PathLike, limit: MemoryLimit | None = None
) -> tuple[RobotFile, tuple[str, ...]]:
    """Read a URDF with the meshes that it names, and warnings."""
    try:
        data = Path(path).read_bytes()
    except OSError as error:
        raise ReadError(
            f"Expected a file, found none at '{path}' ('{error.strerror or error}'); choose another one"
        ) from error
    root = elements_of(data)
    if root.tag != "robot":
        raise ReadError(f"Expected a URDF, whose root is robot, found <{root.tag}>; convert it")
    if any(element.tag.startswith("xacro:") for element in root.walk()):
        raise ReadError("Expected a URDF, found macros of xacro; expand them with xacro first")
    links = tuple(_geometry_of(link, Path(path).parent, limit) for link in _links(root))
    if not links:
        raise ReadError("Expected links with <collision>, found none; give them collision geometry")
    return RobotFile(np.frombuffer(data, np.uint8), links), ()


def _links(root: Element) -> list[Element]:
    """Return the links that have collision geometry."""
    return [link for link in root.all("link") if link.all("collision")]


def _geometry_of(link: Element, folder: Path, limit: MemoryLimit | None) -> LinkGeometry:
    name, elements = link.attributes.get("name", ""), link.all("collision")
    kinds, meshes, problem = [], [], ""
    try:
        for element in elements:
            kind, mesh = _mesh_of(element, folder, limit)
            kinds.append(kind)
            meshes.append(_placed(mesh, element.first("origin")))
    except MedialAxisError as error:
        meshes, problem = [], str(error)
    starts = np.cumsum([0, *(len(points) for points, _ in meshes)])
    points = [points for points, _ in meshes] or [np.empty((0, 3))]
    corners = [mesh[1] + start for mesh, start in zip(meshes, starts, strict=False)]
    triangles = np.concatenate(corners or [np.empty((0, 3))]).astype(np.int32)
    balls_only = not problem and set(kinds) == {"sphere"}
    return LinkGeometry(name, np.concatenate(points), triangles, len(elements), balls_only, problem)


def _mesh_of(element: Element, folder: Path, limit: MemoryLimit | None) -> tuple[str, Mesh]:
    """Return the kind of a collision geometry, and its mesh."""
    geometry = element.first("geometry")
    shape = geometry.children[0] if geometry is not None and geometry.children else None
    if shape is None:
        raise ReadError(
            "Expected a shape in <geometry>, found none; add one, or delete <collision>"
        )
    if shape.tag == "box":
        return "box", box_mesh(_numbers(shape, "size", 3))
    if shape.tag == "sphere":
        return "sphere", ball_mesh(*_numbers(shape, "radius", 1).tolist())
    if shape.tag == "cylinder":
        sizes = (_numbers(shape, name, 1)[0] for name in ("radius", "length"))
        return "cylinder", cylinder_mesh(*map(float, sizes))
    if shape.tag != "mesh":
        raise ReadError(
            f"Expected a box, cylinder, sphere or mesh, found <{shape.tag}>; use one of these"
        )
    found, _ = read_shape(_path_of(shape.attributes.get("filename", ""), folder), limit)
    scale = _numbers(shape, "scale", 3, "1 1 1", signed=True)
    triangles = found.triangles if scale.prod() > 0.0 else found.triangles[:, ::-1]
    return "mesh", (found.points * scale, np.ascontiguousarray(triangles))


def _placed(mesh: Mesh, origin: Element | None) -> Mesh:
    """Return a mesh in the frame of its link: turned about X, Y and Z in this order, then moved."""
    if origin is None:
        return mesh
    offset = _numbers(origin, "xyz", 3, "0 0 0", signed=True)
    turn = np.identity(3)
    for axis, angle in enumerate(_numbers(origin, "rpy", 3, "0 0 0", signed=True).tolist()):
        cos, sin = cosine(angle), cosine(angle - math.pi / 2)
        i, j = (axis + 1) % 3, (axis + 2) % 3
        about = np.identity(3)
        about[i, i] = about[j, j] = cos
        about[i, j], about[j, i] = -sin, sin
        turn = times(about, turn.T)  # `about @ turn`
    return times(mesh[0], turn) + offset, mesh[1]


def _numbers(
    element: Element, name: str, count: int, usual: str = "", signed: bool = False
) -> Floats:
    """Return the numbers of an attribute: `count` finite ones, above 0 unless signed."""
    text = element.attributes.get(name, usual)
    try:
        numbers = np.array([float(word) for word in text.split()])
    except ValueError:
        numbers = np.empty(0)
    if (
        len(numbers) != count
        or not np.isfinite(numbers).all()
        or not (signed or (numbers > 0).all())
    ):
        what = "number" if count == 1 else "numbers"
        above = "" if signed else " above 0"
        raise ReadError(
            f"Expected {count} {what}{above} as {name} of <{element.tag}>, found '{text}'; correct it"
        )
    return numbers


def _path_of(name: str, folder: Path) -> Path:
    """Return the file that a URDF names: package:// is a folder of that name round the URDF, or beside such a one."""
    if name.startswith("package://"):
        package, _, rest = name.removeprefix("package://").partition("/")
        around = [folder.resolve(), *folder.resolve().parents]
        places = [parent / package / rest for parent in around]
        places += [parent / rest for parent in around if parent.name == package]
        for place in places:
            if place.is_file():
                return place
        raise ReadError(
            f"Expected the file of '{name}' in a folder '{package}' round the URDF, found none; "
            "put it there, or write its path"
        )
    return folder / name.removeprefix("file://")


def _lines(link: Element, balls: Balls) -> list[str]:
    """Return a collision element for each ball and cylinder; the first one keeps the name of the link's first one."""
    check_robot(balls)
    stream = BytesIO()
    write_collisions(balls, stream)
    lines = [line.strip() for line in stream.getvalue().decode("ascii").splitlines()]
    name = link.all("collision")[0].attributes.get("name")
    if name is not None:
        lines[0] = lines[0].replace("<collision>", f"<collision name={quoteattr(name)}>", 1)
    return lines
