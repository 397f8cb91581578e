# SPDX-License-Identifier: GPL-3.0-or-later
"""Polygons in Blender: the same triangles as from a file, quads cut as Blender cuts them."""

import numpy as np
from installed import addon
from measure import positions, read, triangles_of
from scene import added, link


def star(count, z):
    angles = np.linspace(0, 2 * np.pi, count, endpoint=False)
    radius = np.where(np.arange(count) % 2, 1.0, 0.6)
    return np.stack([radius * np.cos(angles), radius * np.sin(angles), np.full(count, z)], 1)


def test_quads_are_cut_as_blender_cuts_them():
    dart = [(0, 0, 0), (3, 0.1, 0), (0, 0.2, 0), (0.5, 0.1, 0)]
    darts = [link("polygons", places, [(0, 1, 2, 3)]) for places in (dart, dart[1:] + dart[:1])]
    for thing in (*darts, added("torus", major_segments=40, minor_segments=16)):
        np.testing.assert_array_equal(read(thing).triangles, triangles_of(thing.data))


def test_caps_of_many_corners_have_the_triangles_of_a_file(tmp_path):
    count = 400
    points = np.concatenate([star(count, 0.0), star(count, 1.0)])
    after = np.roll(np.arange(count), -1)
    sides = [(i, int(after[i]), int(after[i]) + count, i + count) for i in range(count)]
    faces = [*sides, tuple(reversed(range(count))), tuple(range(count, 2 * count))]
    thing = link("polygons", points, faces)
    path = tmp_path / "a.obj"
    lines = ["v {!r} {!r} {!r}".format(*row) for row in positions(thing.data).tolist()]
    lines += ["f " + " ".join(str(i + 1) for i in face) for face in faces]
    path.write_text("\n".join(lines))
    shape, _ = addon("core.files.read_shape").read_shape(path)
    found = read(thing).triangles
    assert len(found) == 4 * count - 4
    np.testing.assert_array_equal(found, shape.triangles)


def test_edges_and_points_without_faces_do_not_matter():
    thing = link("polygons", [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [])
    assert read(thing).triangles.shape == (0, 3)
