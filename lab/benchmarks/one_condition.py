# SPDX-License-Identifier: GPL-3.0-or-later
"""One condition alone (Figures 5 and 7 of the paper) and its Table 1, redone: Markdown tables, and two pictures.

    python3 lab/benchmarks/one_condition.py [--output tables.md] [--pictures docs/pictures]

It needs the folder of meshes that `support.data` names, and the program bare_triangulation. The paper's data are not
public; stand-ins are named. Spikes: selected inner facets whose smallest ball is smaller than twice the spacing of one
of their samples, that is, that come close to the surface. Holes: tunnels that the selected facets have more than the
solid.
"""

import struct
import subprocess
import sys
import tempfile
import time
import zlib
from pathlib import Path

import _module
import numpy as np

medial = _module.load()
sys.path.insert(0, str(_module.ROOT))

from medial_axis.core.files.read_shape import read_shape  # noqa: E402  (found through _module)
from support import measure  # noqa: E402
from support.shapes import SHAPES  # noqa: E402

from lab.race import betti, read_axis  # noqa: E402

TABLE_1 = {
    "3HOLE": (4000, 2.37, 0.82, "3holes.off"),
    "KNOT": (10001, 8.36, 2.66, "knot1.off"),
    "ENGINE": (11361, 37.0, 1.82, "engine_parts.ply"),
    "MANNEQUIN": (12773, 7.79, 2.28, "mannequin.off"),
    "FANDISK": (16475, 13.4, 3.0, "fandisk_large.off"),
    "CLUB": (16865, 18.81, 3.06, "club.off"),
    "FOOT": (20021, 13.24, 3.71, "foot.off"),
    "HAND": (25626, 51.14, 5.11, "hand_closed.obj"),
    "SCREWDRIVER": (27152, 51.87, 5.36, "screwdriver.off"),
    "DINOSAUR": (28098, 23.28, 5.8, "dilo.off"),
    "HEART": (37912, 32.49, 6.58, "liver.ply"),
    "ROCKER": (40177, 74.54, 8.25, "rocker-arm.off"),
    "FEMALE": (121723, 292.85, 24.95, "igea.ply"),
}
"""Object: points, seconds of the triangulation and of the filter, as the paper has them; what stands in for it."""
BARE = _module.ROOT / "build" / "release" / "lab" / "benchmarks" / "bare_triangulation"
ANGLES = (5.0, 10.0, 22.5, 40.0)
RATIOS = (3.0, 5.0, 8.0, 16.0)
DRAWN = {
    "5": ("3holes.off", "ANGLE", (5.0, 22.5, 40.0)),
    "7": ("foot.off", "RATIO", (3.0, 8.0, 16.0)),
}


def one_condition(criteria: str) -> str:
    """Facets, spikes, holes of stand-ins for each threshold."""
    values = ANGLES if criteria == "ANGLE" else RATIOS
    unit = "°" if criteria == "ANGLE" else ""
    rows = []
    for file in ("3holes.off", "knot1.off", "foot.off", "rocker-arm.off"):
        analysis, genus = analysed(file)
        cells = [counted(analysis, genus, criteria, value) for value in values]
        rows.append([file, *cells, counted(analysis, genus, "ANGLE_OR_RATIO", None)])
    name = "only Angle" if criteria == "ANGLE" else "only Ratio"
    header = [name, *(f"{value:g}{unit}" for value in values), "both, 22.5° and 8"]
    return "Facets; spikes; holes.\n\n" + _module.markdown(header, rows)


def analysed(file: str):
    shape, _ = read_shape(_module.DATA / file)
    tunnels = medial.solid_betti(shape.points, shape.triangles)
    analysis = medial.MedialAnalysis(shape.points, shape.triangles)
    return (analysis, shape.points), tunnels[1]


def selected(analysis, criteria: str, value: float | None):
    known = {"criteria": getattr(medial.Criteria, criteria), "side": medial.Side.INNER}
    if value is not None:
        known |= {"theta": np.radians(value)} if criteria == "ANGLE" else {"rho": value}
    return analysis.extract(**known)


def counted(found, genus: int, criteria: str, value: float | None) -> str:
    analysis, _ = found
    mesh = selected(analysis, criteria, value)
    if len(mesh.generators) == 0:
        return "none"
    place = np.searchsorted(analysis.samples, mesh.generators)
    near = analysis.spacing[place].max(axis=1)
    least = np.minimum.reduceat(mesh.radius[mesh.face_vertices], mesh.face_offsets[:-1])
    polygons = measure.polygons(mesh)
    whole = read_axis.complex_of(mesh.vertices, polygons, np.empty((0, 2), int))
    holes = betti.betti(whole)[1] - genus
    return f"{len(mesh.generators)}; {int((least < 2 * near).sum())}; {holes}"


def on_exact_shapes() -> str:
    """How far off 99 % of the output is, and how much is missed, of an ellipsoid and a knot at three densities."""
    rows = []
    for name in ("ellipsoid", "knot"):
        for size in (2000, 8000, 20_000):
            analysis = medial.MedialAnalysis(SHAPES[name].sample(size, 0))
            cells = []
            for criteria, value in CHOSEN:
                known = {"criteria": getattr(medial.Criteria, criteria)}
                if value is not None:
                    known |= {"theta": np.radians(value)} if criteria == "ANGLE" else {"rho": value}
                cells.append(exactly(analysis.extract(**known), SHAPES[name]))
            rows.append([name, f"{size:,}", *cells])
    header = [
        f"Angle {v:g}°" if c == "ANGLE" else f"Ratio {v:g}" if v else "both" for c, v in CHOSEN
    ]
    return _module.markdown(["shape", "samples", *header], rows)


def exactly(mesh, shape) -> str:
    if len(mesh.generators) == 0 or not measure.inner_facets(mesh, shape).any():
        return "none"
    found = measure.errors(mesh, shape, 8000, 1500)
    return f"{found.output_p99:.0e} / {found.truth_mean:.0e}"


CHOSEN = [*(("ANGLE", v) for v in (10.0, 22.5, 40.0)), *(("RATIO", v) for v in (4.0, 8.0, 16.0))]
CHOSEN.append(("ANGLE_OR_RATIO", None))


def table_1() -> str:
    """Seconds of the processor, one thread, best of three; filter: all but CGAL's triangulation, and the facets."""
    rows = []
    for name, (points, delaunay, filtering, file) in TABLE_1.items():
        here, _ = read_shape(_module.DATA / file)
        bare = min(_bare_seconds(here.points) for _ in range(3))
        whole = min(_own_seconds(here.points) for _ in range(3))
        theirs = [name, f"{points:,}", f"{delaunay}", f"{filtering}"]
        ours = [file, f"{len(here.points):,}", f"{bare:.3f}", f"{max(whole - bare, 0.0):.3f}"]
        rows.append([*theirs, *ours])
        print(*rows[-1], file=sys.stderr, flush=True)
    theirs = ["object", "points", "Delaunay s", "filter s"]
    return _module.markdown([*theirs, "here", "points", "Delaunay s", "filter s"], rows)


def _bare_seconds(points: np.ndarray) -> float:
    """Seconds of CGAL's triangulation alone."""
    with tempfile.NamedTemporaryFile() as file:
        np.ascontiguousarray(points).tofile(file.name)
        told = subprocess.run([BARE, file.name], check=True, capture_output=True, text=True).stdout
    return float(told.split()[1])


def _own_seconds(points: np.ndarray) -> float:
    start = time.process_time()
    medial.MedialAnalysis(points, sides=medial.SidesFrom.NONE, threads=1).extract()
    return time.process_time() - start


# --- pictures


def picture(file: str, criteria: str, values: tuple[float, ...], path: Path) -> None:
    (analysis, points), _ = analysed(file)
    frame = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)[2]
    panels = [drawn(selected(analysis, criteria, value), points, frame) for value in values]
    whole = np.concatenate(panels, axis=1)
    inked = np.flatnonzero((whole < 255).any(axis=1))
    write_png(whole[max(inked[0] - 12, 0) : inked[-1] + 13], path)


def drawn(
    mesh, points: np.ndarray, frame: np.ndarray, size: int = 300, fine: int = 2
) -> np.ndarray:
    """(size, size) grey: the facets from the side from which the points look widest, nearest in front."""
    pixels = size * fine
    middle = points.mean(axis=0)
    flat = (points - middle) @ frame.T
    scale = 0.94 * pixels / np.ptp(flat[:, :2], axis=0).max()
    centre = (flat.max(axis=0) + flat.min(axis=0)) / 2
    seen = ((mesh.vertices - middle) @ frame.T - centre) * scale + pixels / 2
    shade, depth = np.full((pixels, pixels), 255.0), np.full((pixels, pixels), -np.inf)
    for polygon in measure.polygons(mesh):
        corners = seen[polygon]
        for i in range(1, len(corners) - 1):
            _fill(corners[[0, i, i + 1]], shade, depth)
    small = shade.reshape(size, fine, size, fine).mean(axis=(1, 3))
    return small[::-1].astype(np.uint8)


def _fill(triangle: np.ndarray, shade: np.ndarray, depth: np.ndarray) -> None:
    """A triangle into the pictures of brightness and height."""
    normal = np.cross(triangle[1] - triangle[0], triangle[2] - triangle[0])
    if abs(normal[2]) < 1e-12 * np.linalg.norm(normal) or not normal.any():
        return
    low = np.maximum(np.floor(triangle[:, :2].min(axis=0)).astype(int), 0)
    high = np.minimum(np.ceil(triangle[:, :2].max(axis=0)).astype(int) + 1, len(shade))
    x, y = np.meshgrid(np.arange(low[0], high[0]), np.arange(low[1], high[1]))
    inside = np.ones(x.shape, bool)
    for a, b in ((0, 1), (1, 2), (2, 0)):
        p, q = triangle[a], triangle[b]
        side = (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])
        inside &= side * np.sign(normal[2]) >= -0.5 * np.hypot(*(q - p)[:2])
    z = (
        triangle[0, 2]
        - (normal[0] * (x - triangle[0, 0]) + normal[1] * (y - triangle[0, 1])) / normal[2]
    )
    window = (slice(low[1], high[1]), slice(low[0], high[0]))
    front = inside & (z > depth[window])
    shade[window][front] = 40 + 170 * abs(normal[2]) / np.linalg.norm(normal)
    depth[window][front] = z[front]


def write_png(grey: np.ndarray, path: Path) -> None:
    """8 bits of grey."""
    height, width = grey.shape
    rows = b"".join(b"\0" + row.tobytes() for row in grey)
    chunks = [(b"IHDR", struct.pack(">2I5B", width, height, 8, 0, 0, 0, 0))]
    chunks += [(b"IDAT", zlib.compress(rows, 9)), (b"IEND", b"")]
    with path.open("wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        for name, body in chunks:
            file.write(struct.pack(">I", len(body)) + name + body)
            file.write(struct.pack(">I", zlib.crc32(name + body)))


PARTS = {
    "angle": lambda: one_condition("ANGLE"),
    "ratio": lambda: one_condition("RATIO"),
    "exact": on_exact_shapes,
    "table1": table_1,
}


def main() -> None:
    parser = _module.parser(__doc__)
    parser.add_argument("--only", nargs="*", choices=list(PARTS), default=list(PARTS))
    parser.add_argument("--pictures", type=Path, help="also draw both figures into this folder")
    options = parser.parse_args()
    _module.publish("\n".join(PARTS[name]() for name in options.only), options.output)
    if options.pictures:
        for figure, (file, criteria, values) in DRAWN.items():
            picture(file, criteria, values, options.pictures / f"figure_{figure}.png")


if __name__ == "__main__":
    main()
