# SPDX-License-Identifier: GPL-3.0-or-later
"""This module writes middle surfaces as `.inp` for CalculiX, and as `.obj`, `.ply` and `.stl`
(docs/formats.md).

`.stl` has no place for thickness, so a `.csv` of the same name lies next to it. A file appears whole or not at all.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import BinaryIO

import numpy as np

from ..arrays import Floats, Ints, Longs
from ..files.rounding import check_stl
from ..files.write_triangles import write_stl
from ..files.writing import Columns, extension_of, ply_places, write_ply, write_rows, write_whole
from ..small_matrices import placed
from .mid_surface import MidSurface
from .quad_pairs import least_sines
from .thick_faces import ThickFaces

_DIGITS = 6  # thicknesses that agree in this many digits are one section
_PER_LINE = 8
_LEAST_SINE = 0.2  # at the corners of an element with four; else triangles; chosen: unseen


def export_mid_surface(
    found: MidSurface, path: str | os.PathLike[str], frame: Floats | None = None
) -> Path:
    """Write a middle surface, and return the path of the file; the extension of `path` chooses the format.

    Parameters
    ----------
    found : MidSurface
    path : path of the file; its folder must exist. A file of that name is replaced.
        Faces that no sheet stands for, if they were kept, go to a file next to it whose name ends with `_thick.stl`.
    frame : (4, 4) float64, optional
        From the vertices to the world.

    Raises
    ------
    ExportError
        The extension is unknown, `.stl` is too coarse so far from the origin, or the system refused to write; an old
        file is then unchanged.
    """
    suffix = extension_of(path, MID_SURFACE_FORMATS)
    write = MID_SURFACE_FORMATS[suffix]
    points = found.vertices if frame is None else placed(found.vertices, frame)
    thick = found.thick if found.thick is not None and len(found.thick.triangles) else None
    if thick is not None or suffix == ".stl":
        check_stl(points, frame, float(np.median(found.thickness)))
    written = write_whole(path, lambda stream: write(found, points, stream))
    if written.suffix.lower() == ".stl":
        write_whole(written.with_suffix(".csv"), lambda stream: _write_csv(found, points, stream))
    if thick is not None:
        _write_thick(thick, thick_path(written), frame)
    return written


def _write_thick(thick: ThickFaces, path: Path, frame: Floats | None) -> None:
    points = thick.vertices if frame is None else placed(thick.vertices, frame)
    write_whole(path, lambda stream: write_stl(points, thick.triangles, stream))


def thick_path(path: Path) -> Path:
    """Return the file next to a middle surface for the faces that no sheet stands for."""
    return path.with_name(f"{path.stem}_thick.stl")


def _write_inp(found: MidSurface, points: Floats, stream: BinaryIO) -> None:
    """Shell elements with a set for each sheet and a section for each thickness.

    Faces with four corners have eight nodes, S8R, and the triangles of all others six, S6.
    """
    quads, of_quads, triangles, of_triangles = _elements(found)
    of = np.concatenate((of_quads, of_triangles))
    nodes, middles = _with_middles(points, (quads, triangles))
    lines = [
        "** A middle surface: sheets of shell elements with their thickness.",
        "** Replace the material, and add boundary conditions and a step.",
        "** Abaqus calls S6 STRI65.",
        "*NODE, NSET=NALL",
        *(f"{i + 1}, {x:.12g}, {y:.12g}, {z:.12g}" for i, (x, y, z) in enumerate(nodes.tolist())),
    ]
    first = 1
    for name, corners, between in zip(("S8R", "S6"), (quads, triangles), middles, strict=True):
        if len(corners):
            lines.append(f"*ELEMENT, TYPE={name}, ELSET=EALL")
        for row in (np.hstack((corners, between)) + 1).tolist():
            lines.append(f"{first}, " + ", ".join(map(str, row)))
            first += 1
    for sheet in range(found.sheets):
        lines += _set_of(f"SHEET{sheet + 1}", np.flatnonzero(found.part[of] == sheet))
    lines += ["*MATERIAL, NAME=MATERIAL", "*ELASTIC", "210000., 0.3"]
    texts = np.array([f"{length:.{_DIGITS}g}" for length in found.thickness])
    for number, text in enumerate(np.unique(texts), start=1):
        lines += _set_of(f"THICKNESS{number}", np.flatnonzero((texts == text)[of]))
        lines += [f"*SHELL SECTION, ELSET=THICKNESS{number}, MATERIAL=MATERIAL", str(text)]
    stream.write(("\n".join(lines) + "\n").encode("ascii"))


def _elements(found: MidSurface) -> tuple[Ints, Longs, Ints, Longs]:
    """(q, 4) faces that are good quadrilaterals and (q,) their rows, (t, 3) triangles of all others and (t,) theirs."""
    four = np.flatnonzero(np.diff(found.face_offsets) == 4)
    quads = found.face_vertices[found.face_offsets[four, None] + np.arange(4)]
    good = least_sines(found.vertices[quads]) >= _LEAST_SINE
    triangles, of = found.triangles, found.face_of_triangles
    others = ~np.isin(of, four[good])
    return quads[good], four[good], triangles[others], of[others]


def _set_of(name: str, rows: Longs) -> list[str]:
    numbers = [str(row + 1) for row in rows.tolist()]
    starts = range(0, len(numbers), _PER_LINE)
    return [f"*ELSET, ELSET={name}", *(", ".join(numbers[i : i + _PER_LINE]) for i in starts)]


def _with_middles(points: Floats, faces: tuple[Ints, ...]) -> tuple[Floats, list[Longs]]:
    """The points and the middles of edges, and the rows of the middles after each corner of faces of some kinds."""
    ends = [np.stack((each, np.roll(each, -1, axis=1)), axis=2).reshape(-1, 2) for each in faces]
    edges, edge = np.unique(np.sort(np.concatenate(ends), axis=1), axis=0, return_inverse=True)
    rows = len(points) + edge.reshape(-1)
    at = np.cumsum([each.size for each in faces])[:-1]
    split = [part.reshape(each.shape) for part, each in zip(np.split(rows, at), faces, strict=True)]
    return np.concatenate((points, points[edges].mean(axis=1))), split


def _write_obj(found: MidSurface, points: Floats, stream: BinaryIO) -> None:
    """Polygons in a group for each sheet; the thickness of each face is in a comment before it, where it changes."""
    lines = [f"v {x:.12g} {y:.12g} {z:.12g}" for x, y, z in points.tolist()]
    corners = found.face_vertices + 1
    sheet, last = -1, ""
    for face in np.argsort(found.part, kind="stable").tolist():
        if found.part[face] != sheet:
            sheet = int(found.part[face])
            lines.append(f"g sheet{sheet + 1}")
        text = f"# thickness {found.thickness[face]:.{_DIGITS}g}"
        if text != last:
            lines.append(text)
            last = text
        row = corners[found.face_offsets[face] : found.face_offsets[face + 1]]
        lines.append("f " + " ".join(map(str, row.tolist())))
    stream.write(("\n".join(lines) + "\n").encode("ascii"))


def _write_ply(found: MidSurface, points: Floats, stream: BinaryIO) -> None:
    of = found.face_of_triangles
    vertices: Columns = {**ply_places(points), "thickness": ("<f8", found.of_vertices)}
    of_faces: Columns = {"thickness": ("<f8", found.thickness[of]), "part": ("<i4", found.part[of])}
    comment = (
        "comment thickness of the wall at each vertex and face; part: the sheet of each face\n"
    )
    write_ply(stream, vertices, found.triangles, of_faces, comment)


def _write_stl(found: MidSurface, points: Floats, stream: BinaryIO) -> None:
    write_stl(points, found.triangles, stream)


def _write_csv(found: MidSurface, points: Floats, stream: BinaryIO) -> None:
    """A row for each triangle of the `.stl`, in its order."""
    middles, of = points[found.triangles].mean(axis=1), found.face_of_triangles
    stream.write(b"triangle,x,y,z,sheet,thickness\n")
    columns = np.arange(len(of)), middles, found.part[of] + 1, found.thickness[of]
    write_rows(stream, "%d,%.17g,%.17g,%.17g,%d,%.17g\n", *columns)


MID_SURFACE_FORMATS: dict[str, Callable[[MidSurface, Floats, BinaryIO], None]] = {
    ".inp": _write_inp,
    ".obj": _write_obj,
    ".ply": _write_ply,
    ".stl": _write_stl,
}
