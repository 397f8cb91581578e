# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes with everything that goes wrong with meshes: files of the optional data folder, damaged ones, made ones."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from . import meshes
from .meshes import Mesh

Find = Callable[[str], Path]

CLOSED = (
    "3holes.off",
    "knot1.off",
    "engine_parts.ply",
    "mannequin.off",
    "fandisk_large.off",
    "foot.off",
    "hand_closed.obj",
    "screwdriver.off",
    "dilo.off",
    "liver.ply",
    "rocker-arm.off",
    "igea.ply",
    "human_woman.obj",
    "spot_low.obj",
    "openscad-nonmanifold-crash.obj",
    "engine_skin_large.ply",
)
OPEN = ("club.off", "stanford-bunny.obj", "elephant-with-holes.off")
CLOUDS = ("distcap.xyz", "cactus.xyz", "lion_scan.ply")
LARGE = ("igea.ply", "engine_skin_large.ply", "lion_scan.ply")


def with_holes(mesh: Mesh, holes: int = 6, share: float = 0.002, seed: int = 0) -> Mesh:
    """Round holes of about that share of the triangles each; their vertices stay."""
    vertices, triangles = mesh
    middle = vertices[triangles].mean(axis=1)
    rng, keep = np.random.default_rng(seed), np.ones(len(triangles), dtype=bool)
    for centre in middle[rng.choice(len(triangles), holes, replace=False)]:
        away = np.linalg.norm(middle - centre, axis=1)
        keep[np.argsort(away)[: int(share * len(triangles))]] = False
    return vertices, np.ascontiguousarray(triangles[keep])


def thin_sheet(gap: float = 1e-3, cells: int = 20) -> Mesh:
    """A closed plate with walls much nearer than samples will be."""
    return meshes.box((cells, cells, 1), (1.0, 1.0, gap / 2))


def two_grids(gap: float = 1e-3, cells: int = 20) -> Mesh:
    """The same without its rim: two parallel sheets that face away from each other."""
    face, triangles = meshes.rectangle(cells, cells)
    top = np.column_stack((face, np.full(len(face), gap / 2)))
    return meshes.join((top, triangles), meshes.flip((top * (1, 1, -1), triangles)))


def doubled_faces(mesh: Mesh) -> Mesh:
    """Every face twice, the same way round."""
    return mesh[0], np.concatenate((mesh[1], mesh[1]))


def back_to_back(mesh: Mesh) -> Mesh:
    """Every face from both sides: a closed sheet without thickness."""
    return mesh[0], np.concatenate((mesh[1], mesh[1][:, ::-1]))


def some_flipped(mesh: Mesh, share: float = 0.05, seed: int = 0) -> Mesh:
    triangles = mesh[1].copy()
    rows = np.random.default_rng(seed).random(len(triangles)) < share
    triangles[rows] = triangles[rows][:, ::-1]
    return mesh[0], triangles


def soup(mesh: Mesh) -> Mesh:
    """No vertex in common."""
    vertices, triangles = mesh
    return vertices[triangles].reshape(-1, 3), np.arange(triangles.size, dtype=np.int32).reshape(
        -1, 3
    )


def crossing_boxes() -> Mesh:
    """Three bars through each other, eight vertices each."""
    bars = [meshes.box((1, 1, 1), tuple(np.roll((1.0, 0.2, 0.25), k))) for k in range(3)]
    return meshes.join(*bars)


def crossing_plates(count: int = 25, seed: int = 3) -> Mesh:
    """Thin boxes that cross each other, every second one without two of its sides."""
    rng = np.random.default_rng(seed)
    vertices, triangles = meshes.box((1, 1, 1), (1.0, 1.0, 1.0))
    parts = []
    for number in range(count):
        turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
        size = (*(0.5 * rng.random(2) + 0.05), 0.01 + 0.02 * rng.random())
        kept = triangles[: 8 if number % 2 else 12]
        parts.append((vertices * size @ turn.T + 3 * rng.random(3), kept))
    return meshes.join(*parts)


def open_box() -> Mesh:
    """A box without its lid."""
    vertices, triangles = meshes.box((6, 5, 4))
    lid = vertices[triangles][:, :, 2].min(axis=1) > 0.39
    return vertices, np.ascontiguousarray(triangles[~lid])


MADE: dict[str, Callable[[], Mesh]] = {
    "thin sheet": thin_sheet,
    "two grids": two_grids,
    "doubled faces": lambda: doubled_faces(meshes.box((4, 3, 2))),
    "soup of a torus": lambda: soup(meshes.torus()),
    "crossing boxes": crossing_boxes,
    "overlapping balls": lambda: meshes.join(
        meshes.icosphere(3), meshes.icosphere(3, 0.8, (0.9, 0.1, 0.05))
    ),
    "ball on a ball": lambda: meshes.join(meshes.icosphere(3), meshes.icosphere(3)),
    "box in a box": lambda: meshes.join(
        meshes.box((1, 1, 1)), meshes.box((1, 1, 1), (0.5, 0.3, 0.2))
    ),
    "nested shell": lambda: meshes.nested_shell(2),
    "open box": open_box,
    "some flipped": lambda: some_flipped(meshes.torus()),
    "inside out": lambda: meshes.flip(meshes.torus()),
    "sheet from both sides": lambda: back_to_back(
        (np.pad(meshes.rectangle(8, 8)[0], ((0, 0), (0, 1))), meshes.rectangle(8, 8)[1])
    ),
    "one triangle": lambda: (np.eye(3), np.array([[0, 1, 2]], dtype=np.int32)),
}
DAMAGED: dict[str, tuple[str, Callable[[Mesh], Mesh]]] = {
    "mannequin with holes": ("mannequin.off", with_holes),
    "mannequin without a third": ("mannequin.off", lambda mesh: with_holes(mesh, 1, 0.33)),
    "rocker arm, every face alone": ("rocker-arm.off", soup),
    "spot, faces doubled": ("spot_low.obj", doubled_faces),
}


def load(name: str, find: Find) -> Mesh:
    """Loads a mesh by its name; `find` gives the path of a file of the data folder."""
    if name in MADE:
        return MADE[name]()
    file, damage = DAMAGED.get(name, (name, lambda mesh: mesh))
    return damage(meshes.read(find(file)))
