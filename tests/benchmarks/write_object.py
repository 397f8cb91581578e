"""How long Blender takes to hold a medial axis: seconds per million facets, and beside the
triangulation of the same points.

    blender --background --factory-startup --python-exit-code 1 \
        --python tests/benchmarks/write_object.py -- [--points 250000] [--repeats 5]
"""

import argparse
import statistics
import sys
import time
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
import _module


def ellipsoid(count: int) -> np.ndarray:
    """(count, 3) random points of an ellipsoid."""
    points = np.random.default_rng(0).normal(size=(count, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    return points * (1.0, 0.75, 0.4)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--points", type=int, default=250_000)
    parser.add_argument("--repeats", type=int, default=5)
    options = parser.parse_args(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else [])
    medial = _module.load()
    from medial_axis.bridge.attributes import attributes
    from medial_axis.bridge.write_object import new_mesh
    from medial_axis.core.analysis import MedialAxis

    analysis = medial.MedialAnalysis(ellipsoid(options.points))
    mesh = analysis.extract()
    axis = MedialAxis(**{name: getattr(mesh, name) for name in MedialAxis.__dataclass_fields__})
    seconds = []
    for _ in range(options.repeats):
        start = time.perf_counter()
        written = new_mesh(axis, "Benchmark", attributes())
        seconds.append(time.perf_counter() - start)
        bpy.data.meshes.remove(written)
    facets, median = axis.facets, statistics.median(seconds)
    triangulation = analysis.timings["triangulation"]
    header = ["points", "facets", "write s", "s per million facets", "write / triangulation"]
    row = [options.points, facets, f"{median:.3f}", f"{1e6 * median / facets:.2f}"]
    print(_module.markdown(header, [[str(x) for x in [*row, f"{median / triangulation:.2f}"]]]))


main()
