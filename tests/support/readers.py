# SPDX-License-Identifier: GPL-3.0-or-later
"""Readers of meshes that others wrote, those that are installed: {name: path -> (vertices, faces, area)}.

They come from PyPI for this check alone; `READERS` has those that are there. Plain .ma is read here.
"""

import importlib.util
from pathlib import Path

import numpy as np


def area_of(points, faces):
    """The area of polygons by their area vectors, so that it does not depend on how they are triangulated."""
    points = np.asarray(points, np.float64)
    areas = []
    for face in faces:
        corners = points[np.asarray(face)] - points[face[0]]
        areas.append(np.linalg.norm(np.cross(corners[1:-1], corners[2:]).sum(axis=0)) / 2)
    return float(np.sum(areas))


def found(points, faces):
    return len(points), len(faces), area_of(points, faces)


def read_ma(path):
    """(v, 4) centres and radii, (e, 2) edges, (f, 3) triangles of a plain .ma file."""
    tokens = Path(path).read_bytes().split()
    counts, rest = [int(token) for token in tokens[:3]], tokens[3:]
    sections = []
    for letter, width, count, kind in zip((b"v", b"e", b"f"), (4, 2, 3), counts, (float, int, int)):
        rows = [rest[at : at + width + 1] for at in range(0, count * (width + 1), width + 1)]
        rest = rest[count * (width + 1) :]
        assert all(row[0] == letter for row in rows)
        numbers = [[kind(x) for x in row[1:]] for row in rows]
        sections.append(np.array(numbers, kind).reshape(count, width))
    assert rest == []
    return sections


def by_trimesh(path):
    import trimesh

    mesh = trimesh.load(path, process=False)
    return found(mesh.vertices, mesh.faces.tolist())


def by_meshio(path):
    import meshio

    mesh = meshio.read(path)
    return found(mesh.points, [row for block in mesh.cells for row in block.data.tolist()])


def by_plyfile(path):
    from plyfile import PlyData

    data = PlyData.read(path)
    points = np.column_stack([data["vertex"][axis] for axis in "xyz"])
    return found(points, [list(row) for row in data["face"]["vertex_indices"]])


def by_open3d(path):
    import open3d

    mesh = open3d.io.read_triangle_mesh(str(path))
    return found(np.asarray(mesh.vertices), np.asarray(mesh.triangles).tolist())


def by_meshlab(path):
    import pymeshlab

    meshes = pymeshlab.MeshSet(verbose=False)
    meshes.load_new_mesh(str(path))
    mesh = meshes.current_mesh()
    return found(mesh.vertex_matrix(), mesh.face_matrix().tolist())


_MODULES = {
    "trimesh": by_trimesh,
    "meshio": by_meshio,
    "plyfile": by_plyfile,
    "open3d": by_open3d,
    "pymeshlab": by_meshlab,
}
NAMES = tuple(_MODULES)
READERS = {name: read for name, read in _MODULES.items() if importlib.util.find_spec(name)}
