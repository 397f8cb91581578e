# SPDX-License-Identifier: GPL-3.0-or-later
"""Centre lines of a vessel tree and of a botanical tree beside those of other programs, judged by the known lines.

    python3 lab/benchmarks/vessels.py [--svv PYTHON] [--vmtk PYTHON] [--output table.md]

The vessels are those that svv (svVascularize, on PyPI) grows in a cube, with 25 ends and a root, in the Python that
--svv names, because it needs an older NumPy; no two runs of it grow the same, whatever seeds it is given. The botanical
tree is made here: each branch ends in two, whose squared radii add up to its own. Both become meshes as the neurons do,
in units in which the thinnest radius is 15. Programs, columns, and what is left out where it is absent are those of
neurons.py. VMTK runs in the Python that --vmtk names, for 300 s at most, and is told all ends. Without a Python for
them both are left out by name.
"""

from __future__ import annotations

import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path

import _module
import numpy as np

_module.load()

from medial_axis.core.shape.shape import Shape  # noqa: E402  (found through _module)
from neurons import HEADER, LEAST, Tree, failed, mesh_of, row, rows_of, volume_of  # noqa: E402
from scipy.spatial import cKDTree  # noqa: E402
from skeletons import Lines  # noqa: E402

SIZE, VESSELS, LEVELS, LIMIT = 1200.0, 24, 4, 300

IN_SVV = """
import sys
import numpy as np
import pyvista
from svv.domain.domain import Domain
from svv.tree.tree import Tree
np.random.seed(1)
domain = Domain(pyvista.Cube().triangulate().subdivide(2))
domain.create()
domain.solve()
domain.build()
tree = Tree()
tree.set_domain(domain)
tree.set_root()
tree.n_add(int(sys.argv[2]))
np.save(sys.argv[1], np.array(tree.data))
"""

IN_VMTK = """
import resource, sys
import numpy as np
import vtk
from vmtk import vmtkscripts
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
given = np.load(sys.argv[1])
surface, points, cells = vtk.vtkPolyData(), vtk.vtkPoints(), vtk.vtkCellArray()
points.SetData(numpy_to_vtk(given["points"], deep=1))
surface.SetPoints(points)
rows = np.column_stack((np.full(len(given["triangles"]), 3), given["triangles"])).astype(np.int64)
cells.SetCells(len(rows), numpy_to_vtkIdTypeArray(rows.ravel(), deep=1))
surface.SetPolys(cells)
lines = vmtkscripts.vmtkCenterlines()
lines.Surface, lines.SeedSelectorName = surface, "idlist"
lines.SourceIds, lines.TargetIds = given["seeds"][:1].tolist(), given["seeds"][1:].tolist()
lines.Execute()
out, edges = lines.Centerlines, []
for k in range(out.GetNumberOfCells()):
    ids = out.GetCell(k).GetPointIds()
    way = [ids.GetId(i) for i in range(ids.GetNumberOfIds())]
    edges += list(zip(way, way[1:]))
radius = vtk_to_numpy(out.GetPointData().GetArray("MaximumInscribedSphereRadius"))
np.savez(sys.argv[2], points=vtk_to_numpy(out.GetPoints().GetData()), radius=radius, edges=np.array(edges))
print("SECONDS", resource.getrusage(resource.RUSAGE_SELF).ru_utime)
"""


def vessels(python: str) -> Tree:
    """Return what svv grows; radii are scaled together, so what Murray's law says of them stays."""
    with tempfile.TemporaryDirectory() as folder:
        found = Path(folder, "found.npy")
        words = [python, "-c", IN_SVV, str(found), str(VESSELS)]
        subprocess.run(words, check=True, capture_output=True)
        return tree_of(np.load(found))


def tree_of(table: np.ndarray) -> Tree:
    """The tree of a table of svv: three columns for the start of each vessel, three for its end, and its radius."""
    start, end, radius = SIZE * table[:, :3], SIZE * table[:, 3:6], table[:, 21]
    above = [row_of(end, place) for place in start]
    places = np.concatenate((start[:1], end))
    radius = np.concatenate((radius[:1], radius)) * (LEAST / radius.min())
    return Tree(places, radius, np.array([-1, *(1 + k for k in above)]))


def row_of(places: np.ndarray, place: np.ndarray) -> int:
    """The row of a place, or -1."""
    away = np.linalg.norm(places - place, axis=1)
    return int(away.argmin()) if away.min() < 1e-6 * SIZE else -1


def botanical() -> Tree:
    """A trunk, and branches that end in two, as thick as Leonardo da Vinci says, at angles that a seed turns."""
    rng = np.random.default_rng(3)
    places, parent, radius = [np.zeros(3)], [-1], [LEAST * 2 ** (LEVELS / 2)]
    ways = [(0, np.array([0.0, 0.0, 1.0]), 0)]
    while ways:
        above, way, level = ways.pop(0)
        thick = LEAST * 2 ** ((LEVELS - level) / 2)
        parent.append(above)
        places.append(places[above] + 9.0 * thick * rng.uniform(0.9, 1.2) * way)
        radius.append(thick)
        if level < LEVELS:
            across = np.cross(way, rng.normal(size=3))
            across /= np.linalg.norm(across)
            for side in (-1, 1):
                turned = way + side * rng.uniform(0.5, 0.8) * across
                ways.append((len(places) - 1, turned / np.linalg.norm(turned), level + 1))
    return Tree(np.array(places), np.array(radius), np.array(parent))


def of_vmtk(python: str | None, name: str, shape: Shape, tree: Tree) -> list[str]:
    """The row of VMTK, from one end to all others."""
    if python is None:
        return [name, "VMTK, told the ends", "left out: no --vmtk", *[""] * 6]
    seeds = np.unique(cKDTree(shape.points).query(tree.places[tree.tips])[1])
    with tempfile.TemporaryDirectory() as folder:
        given, found = Path(folder, "given.npz"), Path(folder, "found.npz")
        np.savez(given, points=shape.points, triangles=shape.triangles, seeds=seeds)
        words = [python, "-c", IN_VMTK, str(given), str(found)]
        try:
            done = subprocess.run(words, capture_output=True, text=True, check=True, timeout=LIMIT)
        except subprocess.TimeoutExpired:
            return [name, "VMTK, told the ends", f"no lines in {LIMIT} s", *[""] * 6]
        except (subprocess.CalledProcessError, OSError) as error:
            return failed(name, "VMTK, told the ends", error)
        read = np.load(found)
        lines = Lines(read["points"], read["edges"], read["radius"])
        return row(name, "VMTK, told the ends", lines, tree, float(done.stdout.split("SECONDS")[1]))


def rows(svv: str | None, vmtk: str | None) -> Iterator[list[str]]:
    yield from rows_of_tree("tree", botanical(), vmtk)
    if svv is None:
        yield ["vessels", "left out: no --svv", *[""] * 7]
    else:
        try:
            tree = vessels(svv)
        except (subprocess.CalledProcessError, OSError) as error:
            yield failed("vessels", "svv", error)
            return
        yield from rows_of_tree("vessels", tree, vmtk)


def rows_of_tree(name: str, tree: Tree, vmtk: str | None) -> Iterator[list[str]]:
    yield from rows_of(name, tree)
    shape = mesh_of(*volume_of(tree))
    yield of_vmtk(vmtk, f"{name}, {len(shape.points):,} vertices", shape, tree)


def main() -> None:
    parser = _module.parser(__doc__)
    parser.add_argument("--svv", help="a Python that has svv")
    parser.add_argument("--vmtk", help="a Python that has VMTK")
    words = parser.parse_args()
    _module.tell(HEADER, rows(words.svv, words.vmtk), words.output)


if __name__ == "__main__":
    main()
