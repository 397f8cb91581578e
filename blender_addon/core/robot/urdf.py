# SPDX-License-Identifier: GPL-3.0-or-later
"""The collision geometry of the links of a URDF."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from ..errors import ReadError
from ..machine.memory_limit import MemoryLimit
from ..small_matrices import times
from .element_numbers import numbers_of, turn_of
from .primitive_meshes import Mesh, ball_mesh, box_mesh, cylinder_mesh, mesh_of_file
from .xml_spans import Element


class Urdf:
    """A URDF: each collision element is a piece of its link."""

    tag = "collision"
    extensions = (".urdf",)
    wanted = "links with <collision>"

    def __init__(self, root: Element, folder: Path) -> None:
        if any(element.tag.startswith("xacro:") for element in root.walk()):
            raise ReadError("Expected a URDF, found macros of xacro; expand them with xacro first")
        self._root, self._folder, self.warnings = root, folder, ()

    def links(self) -> Iterator[tuple[str, list[Element]]]:
        """Yield the name of each link with its collision elements."""
        for link in self._root.all("link"):
            yield link.attributes.get("name", ""), link.all("collision")

    def kept(self, elements: list[Element]) -> dict[str, str]:
        """Return the name that elements in the place of others take over."""
        return dict(elements[0].attributes)

    def mesh_of(self, element: Element, limit: MemoryLimit | None) -> tuple[str, Mesh]:
        """Return the kind of a collision element, and its mesh in the frame of the link."""
        kind, (points, triangles) = self._shape_of(element, limit)
        origin = element.first("origin")
        if origin is None:
            return kind, (points, triangles)
        turn = turn_of(numbers_of(origin, "rpy", 3, "0 0 0", signed=True), "XYZ")
        offset = numbers_of(origin, "xyz", 3, "0 0 0", signed=True)
        return kind, (times(points, turn) + offset, triangles)

    def _shape_of(self, element: Element, limit: MemoryLimit | None) -> tuple[str, Mesh]:
        geometry = element.first("geometry")
        shape = geometry.children[0] if geometry is not None and geometry.children else None
        if shape is None:
            raise ReadError(
                "Expected a shape in <geometry>, found none; add one, or delete <collision>"
            )
        if shape.tag == "box":
            return "box", box_mesh(numbers_of(shape, "size", 3))
        if shape.tag == "sphere":
            return "sphere", ball_mesh(*numbers_of(shape, "radius", 1).tolist())
        if shape.tag == "cylinder":
            sizes = (numbers_of(shape, name, 1)[0] for name in ("radius", "length"))
            return "cylinder", cylinder_mesh(*map(float, sizes))
        if shape.tag != "mesh":
            raise ReadError(
                f"Expected a box, cylinder, sphere or mesh, found <{shape.tag}>; use one of these"
            )
        scale = numbers_of(shape, "scale", 3, "1 1 1", signed=True)
        path = _path_of(shape.attributes.get("filename", ""), self._folder)
        return "mesh", mesh_of_file(path, scale, limit)


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
