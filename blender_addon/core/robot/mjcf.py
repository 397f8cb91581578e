# SPDX-License-Identifier: GPL-3.0-or-later
"""The collision geometry of the bodies of a MuJoCo model, as MJCF means it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

from ..errors import ReadError
from ..machine.memory_limit import MemoryLimit
from ..small_matrices import times
from .element_numbers import numbers_of
from .geom import SHAPE, SIZES, TURNS, frame_of, matrix_of, primitive_of
from .primitive_meshes import Mesh, mesh_of_file
from .xml_spans import Element

Attributes = dict[str, str]
_MACROS = {"include", "frame", "replicate", "attach", "composite"}
# The attributes that may name a geom, with those that tell whether they do.
_NAMING = {"geom": "", "geom1": "", "geom2": "", "objname": "objtype", "refname": "reftype"}
# Written over what a class tells of places and shapes.
_UNSET = {"pos": "0 0 0", "mesh": "", "fromto": ""}
_FILTER = ("contype", "conaffinity")


class Mjcf:
    """A model of MuJoCo: each geom that may collide is a piece of its body."""

    tag = "geom"
    extensions = (".xml", ".mjcf")
    wanted = "bodies with geoms that collide"

    def __init__(self, root: Element, folder: Path) -> None:
        every = list(root.walk())
        for macro in (element.tag for element in every if element.tag in _MACROS):
            raise ReadError(
                f"Expected a model without <{macro}>, found one; save it from MuJoCo, which writes it out"
            )
        options = [part.attributes for part in root.all("compiler")]
        self._compiler = {name: text for part in options for name, text in part.items()}
        self._unit = 1.0 if self._compiler.get("angle") == "radian" else math.pi / 180.0
        self._order = self._compiler.get("eulerseq", "xyz")
        if len(self._order) != 3 or not set(self._order.lower()) <= set("xyz"):
            raise ReadError(
                f"Expected three of x, y and z as eulerseq, found '{self._order}'; correct it"
            )
        folders = (self._compiler.get(name) for name in ("meshdir", "assetdir"))
        self._folder = folder / (next(filter(None, folders), ""))
        self._usual: dict[str, dict[str, Attributes]] = {"main": {"geom": {}, "mesh": {}}}
        for default in root.all("default"):
            self._add_class(default, self._usual["main"], "main")
        self._kept: dict[int, Attributes] = {}  # what others in the place of a geom take over
        assets = [mesh for part in root.all("asset") for mesh in part.all("mesh")]
        self._meshes = {_name_of(mesh): self._complete(mesh, "main") for mesh in assets}
        self._named = {
            each.attributes[name]: each.tag
            for each in every
            for name, kind in _NAMING.items()
            if name in each.attributes and each.attributes.get(kind, "geom") == "geom"
        }
        self._bodies = [body for part in root.all("worldbody") for body in self._in(part, "main")]
        self.warnings = tuple(self._warnings())

    def links(self) -> Iterator[tuple[str, list[Element]]]:
        """Yield the name of each body with its geoms that may collide, with the attributes of their classes."""
        for body, geoms in self._bodies:
            yield body.attributes.get("name", ""), geoms

    def kept(self, geoms: list[Element]) -> Attributes:
        """Return the attributes of geoms in the place of others, with the mass of all where each one tells its own.

        Raises
        ------
        ReadError
            No others can take their place.
        """
        for name in (geom.attributes.get("name", "") for geom in geoms):
            if name in self._named:
                raise ReadError(
                    f"Expected geoms that nothing names, found '{name}' in <{self._named[name]}>; name its body there"
                )
        if any("fromto" in self._kept[geom.start] for geom in geoms):
            raise ReadError(
                "Expected fromto of single geoms, found one of a class; write it to each geom"
            )
        if len({tuple(geom.attributes.get(name, "1") for name in _FILTER) for geom in geoms}) > 1:
            raise ReadError(
                "Expected geoms of one contype and conaffinity, found several; make a body of each"
            )
        kept = dict(self._kept[geoms[0].start])
        if all("mass" in geom.attributes for geom in geoms):
            mass = sum(float(numbers_of(geom, "mass", 1, signed=True)[0]) for geom in geoms)
            kept["mass"] = repr(mass)
        return kept

    def mesh_of(self, geom: Element, limit: MemoryLimit | None) -> tuple[str, Mesh]:
        """Return the type of a geom, and its mesh in the frame of the body."""
        kind = geom.attributes.get("type", "sphere")
        if kind not in {"mesh", *SIZES} or (kind != "mesh" and "mesh" in geom.attributes):
            raise ReadError(
                f"Expected a box, sphere, capsule, cylinder, ellipsoid or mesh, found '{kind}'"
                f"{' round a mesh' if kind in SIZES else ''}; use one of these"
            )
        mesh = primitive_of(kind, geom) if kind in SIZES else self._asset(geom, limit)
        turn, offset = frame_of(geom, self._unit, self._order)
        return kind, (times(mesh[0], turn) + offset, mesh[1])

    def _add_class(self, default: Element, above: dict[str, Attributes], name: str) -> None:
        """Add the attributes of a class, which has those of the class above it, and of the classes in it."""
        own = dict(above)
        for child in default.children:
            if child.tag in own:
                own[child.tag] = _over(own[child.tag], child.attributes)
        self._usual[default.attributes.get("class", name)] = own
        for inner in default.all("default"):
            self._add_class(inner, own, "")

    def _complete(self, element: Element, usual: str) -> Element:
        """Return an element with the attributes of its class."""
        name = element.attributes.get("class", usual)
        if name not in self._usual:
            raise ReadError(f"Expected a default of the class '{name}', found none; add it")
        given = self._usual[name][element.tag]
        own = {key: text for key, text in element.attributes.items() if key not in SHAPE}
        instead = {key: text for key, text in _UNSET.items() if key in given}
        self._kept[element.start] = {**own, **instead}
        return Element(element.tag, _over(given, element.attributes), element.start, element.end)

    def _in(self, parent: Element, usual: str) -> Iterator[tuple[Element, list[Element]]]:
        """Yield each body below an element, with its geoms that may collide."""
        for body in parent.all("body"):
            own = body.attributes.get("childclass", usual)
            geoms = [self._complete(geom, own) for geom in body.all("geom")]
            yield (
                body,
                [g for g in geoms if any(g.attributes.get(key, "1") != "0" for key in _FILTER)],
            )
            yield from self._in(body, own)

    def _warnings(self) -> Iterator[str]:
        source = self._compiler.get("inertiafromgeom", "auto")
        names = [
            f"'{body.attributes.get('name', '')}'"
            for body, geoms in self._bodies
            if source == "true" or (source == "auto" and body.first("inertial") is None)
            if any(g.attributes.get("mass", g.attributes.get("density", "1")) != "0" for g in geoms)
        ]
        if names:
            yield (
                f"the inertia of {', '.join(names)} comes from the geoms, so others change it; "
                "give these bodies an <inertial>"
            )

    def _asset(self, geom: Element, limit: MemoryLimit | None) -> Mesh:
        """Return the mesh that a geom names."""
        name = geom.attributes.get("mesh", "")
        asset = self._meshes.get(name)
        if asset is None or "file" not in asset.attributes:
            raise ReadError(f"Expected a file of the mesh '{name}', found none; add it")
        offset = numbers_of(asset, "refpos", 3, "0 0 0", signed=True)
        turn = matrix_of(numbers_of(asset, "refquat", 4, "1 0 0 0", signed=True), asset)
        scale = numbers_of(asset, "scale", 3, "1 1 1", signed=True)
        path = self._folder / asset.attributes["file"]
        return mesh_of_file(path, scale, limit, lambda points: times(points - offset, turn.T))


def _name_of(mesh: Element) -> str:
    return mesh.attributes.get("name") or Path(mesh.attributes.get("file", "")).stem


def _over(usual: Attributes, own: Attributes) -> Attributes:
    """Return attributes over usual ones; one way to tell a turn replaces the others."""
    gone = TURNS if TURNS & set(own) else set()
    return {**{name: text for name, text in usual.items() if name not in gone}, **own}
