# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the picture of Report Sampling in the user guide: Suzanne, subdivided twice, coloured by epsilon.

    blender --background --factory-startup --python-exit-code 1 --python lab/pictures/sampling_picture.py -- \\
        --zip dist/medial_axis-VERSION.zip [--output docs/pictures/sampling_report.png]
"""

import argparse
import subprocess
import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "demo"))
import blender_demo
import blender_scene

PICTURE = Path(__file__).resolve().parents[2] / "docs" / "pictures" / "sampling_report.png"
PIXELS = (600, 500)
COLOURS = 200


def main():
    arguments = parse()
    blender_demo.install(arguments.zip)
    bpy.data.batch_remove(bpy.data.objects)
    source = suzanne()
    bpy.ops.object.medial_axis_sampling_report(sampling="VERTICES", target="COPY")
    report = bpy.context.object
    print(f"{len(report.data.vertices):,} vertices, {report['ma_density']}")
    source.hide_render = True
    render(report, str(arguments.output))
    make_small(arguments.output)


def parse():
    parser = argparse.ArgumentParser()
    parser.add_argument("--zip", required=True)
    parser.add_argument("--output", type=Path, default=PICTURE)
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1 :])


def suzanne():
    bpy.ops.mesh.primitive_monkey_add()
    source = bpy.context.object
    source.modifiers.new("Subdivision", "SUBSURF").levels = 2
    bpy.ops.object.shade_smooth()
    return source


def render(report, path):
    report.data.polygons.foreach_set("use_smooth", [True] * len(report.data.polygons))
    blender_scene.PIXELS = PIXELS
    centre, radius = blender_scene.bounding_ball(blender_scene.world_points(report))
    blender_scene.look_at(centre, radius, blender_scene.world_points(report))
    blender_scene.light()
    blender_scene.use_cycles()
    bpy.context.scene.render.filepath = path
    bpy.ops.render.render(write_still=True)


def make_small(path):
    """In few colours, without times, so that the same picture is the same file."""
    words = f"+dither -colors {COLOURS} -strip -define png:exclude-chunks=date,time".split()
    subprocess.run(["mogrify", *words, str(path)], check=True)


if __name__ == "__main__":
    main()
