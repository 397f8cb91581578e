# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects that nobody models on purpose, and options that nobody would choose: a number -> one of each.

The same number always gives the same, so a failure can be looked at alone.
"""

import itertools

import bpy
import numpy as np
from installed import addon
from measure import positions
from scene import added, link, new_object, select

NAMES = ("", "Ω≈ç√∫", "メダル", "a/b\\c:d*?", "{name} %s %(x)d", "new\nline")
NAMES += ("🦴" * 15, "x" * 63, ".. ", "0")
SIZES = (0.0, 1e-38, 1e-12, 1e-3, 1e3, 1e12, 1e30)
MODIFIERS = {
    "ARRAY": {"count": 3},
    "BEVEL": {"width": 0.4},
    "BUILD": {},
    "DECIMATE": {"ratio": 0.3},
    "DISPLACE": {"strength": 1e5},
    "EDGE_SPLIT": {"split_angle": 0.0},
    "MASK": {"vertex_group": "none"},
    "MIRROR": {"use_clip": True},
    "SCREW": {"steps": 4},
    "SKIN": {},
    "SOLIDIFY": {"thickness": 0.0},
    "SUBSURF": {"levels": 1},
    "TRIANGULATE": {},
    "WELD": {"merge_threshold": 0.5},
    "WIREFRAME": {},
}


def mutant(seed):
    """A new object, selected, that `seed` alone decides; returns it and the generator."""
    random = np.random.default_rng(seed)
    if random.random() < 0.15:
        thing = other_than_mesh(random)
    else:
        points, faces = (chosen(random, BASES))(random)
        for _ in range(random.integers(0, 4)):
            points, faces = chosen(random, CHANGES)(random, points, faces)
        thing = link("Mutant", points, faces, edges_of(random, points))
        thing.data.validate()
    select(thing)
    for _ in range(random.integers(0, 4)):
        chosen(random, TRICKS)(random, thing)
    return thing, random


def chosen(random, options):
    return options[random.integers(len(options))]


# --- points and faces


def grown(*names, **options):
    """A function that returns the points and faces of a primitive, which an operator of Blender adds."""

    def base(random):
        mesh = added(chosen(random, names), **options).data
        faces = [tuple(polygon.vertices) for polygon in mesh.polygons]
        points = positions(mesh)
        bpy.data.objects.remove(bpy.context.object)
        return points, faces

    return base


def few(random):
    """At most five points, and as many faces as there may be."""
    points = random.normal(size=(random.integers(6), 3))
    faces = [(0, i, i + 1) for i in range(1, len(points) - 1)]
    return points, faces[: random.integers(len(faces) + 1)]


def cloud(random):
    """Points alone, in a ball, on a sphere, a grid or a line."""
    points = random.normal(size=(random.integers(6, 400), 3))
    kind = random.integers(4)
    if kind == 1:
        points /= np.linalg.norm(points, axis=1)[:, None]
    elif kind == 2:
        points = np.rint(points)
    elif kind == 3:
        points[:, 1:] = 0.0
    return points, []


def soup(random):
    """Triangles that share nothing, and cross."""
    count = random.integers(1, 40)
    return random.normal(size=(3 * count, 3)), np.arange(3 * count).reshape(-1, 3).tolist()


def fan(random):
    """Many faces on one edge."""
    points = np.concatenate([[[0, 0, -1], [0, 0, 1]], random.normal(size=(9, 3))])
    return points, [(0, 1, i) for i in range(2, 11)]


def polygon(random):
    """One face with many corners, in no plane, and a tip over it."""
    angle = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    ring = np.column_stack([np.cos(angle), np.sin(angle), random.normal(scale=0.2, size=40)])
    sides = [(i, (i + 1) % 40, 40) for i in range(40)]
    return np.concatenate([ring, [[0, 0, 2]]]), [tuple(range(39, -1, -1)), *sides]


BASES = (
    grown("cube", "cone", "cylinder", "monkey"),
    grown("uv_sphere", segments=12, ring_count=8),
    grown("ico_sphere", subdivisions=2),
    grown("torus", major_segments=16, minor_segments=8),
    grown("plane", "grid", "circle"),
    few, cloud, soup, fan, polygon, lambda random: (np.zeros((0, 3)), []),
)  # fmt: skip


def rows(random, points):
    """Some rows, none when there are none."""
    return random.integers(len(points), size=random.integers(1, 9)) if len(points) else []


def poisoned(random, points, faces):
    points = points.copy()
    points[rows(random, points), random.integers(3)] = chosen(random, (np.nan, np.inf, -np.inf))
    return points, faces


def enormous(random, points, faces):
    """Some points lie near the largest numbers that Blender holds."""
    points = points.copy()
    points[rows(random, points)] *= 1e37
    return points, faces


def torn(random, points, faces):
    return points, [face for face in faces if random.random() < 0.7]


def turned_over(random, points, faces):
    return points, [face[:: chosen(random, (1, -1))] for face in faces]


def doubled_faces(random, points, faces):
    """Some faces once more, by points of their own, the same way round or the other."""
    again = [faces[i][:: chosen(random, (1, -1))] for i in rows(random, faces)]
    corners = [corner for face in again for corner in face]
    ends = np.cumsum([0, *map(len, again)]) + len(points)
    more = [tuple(range(start, end)) for start, end in itertools.pairwise(ends)]
    return np.concatenate([points, points[corners].reshape(-1, 3)]), [*faces, *more]


def flattened(random, points, faces):
    """Into a plane, a line or a point."""
    points = points.copy()
    points[:, : random.integers(1, 4)] = random.integers(2)
    return points, faces


def collapsed(random, points, faces):
    """Some points in one place: faces without area."""
    points = points.copy()
    points[rows(random, points)] = points[:1]
    return points, faces


def scaled(random, points, faces):
    """To any size, along one axis or all."""
    factor = np.full(3, chosen(random, SIZES))
    factor[: random.integers(3)] = 1.0
    with np.errstate(over="ignore"):
        return (points * factor).astype(np.float32).astype(np.float64), faces


def of_points(change):
    """A function that changes the points alone."""
    return lambda random, points, faces: (change(random, points), faces)


CHANGES = (
    poisoned,
    enormous,
    of_points(lambda random, points: np.concatenate([points, points[rows(random, points)]])),
    doubled_faces,
    flattened,
    collapsed,
    # Onto a coarse grid: everything coplanar, collinear and cospherical.
    of_points(lambda random, points: np.rint(points * 2)),
    torn,
    turned_over,
    of_points(lambda random, points: np.concatenate([points, random.normal(size=(5, 3)) * 3])),
    scaled,
    of_points(lambda random, points: points + 10.0 ** random.integers(2, 9)),
    of_points(lambda random, points: points + random.normal(scale=10.0 ** random.integers(-8, 1), size=points.shape)),
)  # fmt: skip


def edges_of(random, points):
    """Mostly none, or some that belong to no face."""
    if len(points) < 2 or random.random() < 0.8:
        return []
    pairs = random.integers(len(points), size=(4, 2)).tolist()
    return [pair for pair in pairs if pair[0] != pair[1]]


def other_than_mesh(random):
    """A curve, a text, a surface or a metaball."""
    kinds = ("curve.bezier_circle", "object.text", "surface.nurbs_surface_torus")
    thing = added(chosen(random, (*kinds, "object.metaball", "object.armature")))
    if hasattr(thing.data, "bevel_depth"):
        thing.data.bevel_depth = chosen(random, (0.0, 0.1, -3.0))
        thing.data.extrude = chosen(random, (0.0, 0.3))
    if hasattr(thing.data, "body"):
        thing.data.body = chosen(random, ("", " ", "Aé", "8\nB"))
    return thing


# --- what can be done to an object


def renamed(random, thing):
    thing.name = chosen(random, NAMES)


def moved(random, thing):
    thing.location = random.normal(size=3) * 10.0 ** random.integers(-3, 7)
    thing.rotation_euler = random.normal(size=3) * 9


def stretched(random, thing):
    thing.scale = random.choice([-1.0, 1.0, 0.0, 1e-6, 1e6, -3.0], size=3)


def sheared(random, thing):
    """A stretched parent shears the object; its scale is sometimes not finite."""
    parent = new_object("Parent")
    parent.scale = (1, 5, chosen(random, (1.0, -2.0, 0.0, np.nan, 1e20)))
    thing.parent = parent
    thing.rotation_euler = random.normal(size=3)


def modified(random, thing):
    kind = chosen(random, tuple(MODIFIERS))
    try:
        modifier = thing.modifiers.new("", kind)
    except (RuntimeError, TypeError):
        return  # not on this type of object
    for name, value in MODIFIERS[kind].items() if modifier else ():
        setattr(modifier, name, value)


def keyed(random, thing):
    """Shape keys, at values beyond their range."""
    if thing.type != "MESH" or not thing.data.vertices:
        return
    thing.shape_key_add(name="Basis")
    key = thing.shape_key_add(name=chosen(random, NAMES))
    key.slider_max = 10
    key.data[0].co = random.normal(size=3)
    key.value = 10 * random.random()
    thing.active_shape_key_index = 1


def oriented(random, thing):
    """Normals that may be wrong, NaN or nothing."""
    if thing.type != "MESH" or not thing.data.vertices or thing.mode != "OBJECT":
        return
    normals = random.normal(size=(len(thing.data.vertices), 3))
    normals[rows(random, normals)] = chosen(random, (np.nan, 0.0, np.inf, 1e30))
    addon("bridge.mesh.attributes").add_normals(thing.data.attributes, normals)


def attributed(random, thing):
    """Names that the add-on uses, on data that it did not make."""
    if thing.type == "MESH":
        domain = chosen(random, ("POINT", "EDGE", "FACE", "CORNER"))
        for name in ("normal", "ma_normal", "ma_radius", "ma_epsilon", "ma_side"):
            kind = chosen(random, ("FLOAT", "INT", "FLOAT_VECTOR"))
            thing.data.attributes.new(name, kind, domain)
    thing["ma_source"] = chosen(random, ("nonsense", 3, 0.5))


def out_of_sight(random, thing):
    """Hidden, not selected, or in a collection that may be excluded."""
    kind = random.integers(4)
    if thing.name not in bpy.context.view_layer.objects:
        return  # it is excluded already
    if kind == 0:
        thing.hide_set(True)
    elif kind == 1:
        thing.hide_viewport = True
    elif kind == 2:
        thing.select_set(False)
    else:
        scene = bpy.context.scene.collection
        collection = bpy.data.collections.new("Collection")
        scene.children.link(collection)
        collection.objects.link(thing)
        scene.objects.unlink(thing)
        layers = bpy.context.view_layer.layer_collection.children
        layers[collection.name].exclude = bool(random.integers(2))
    bpy.context.view_layer.update()


def shared(random, thing):
    """A second object of the same data, elsewhere."""
    other = new_object(thing.name, thing.data)
    other.location.x = 3
    if thing.name in bpy.context.view_layer.objects:
        select(thing, other)


def entered(random, thing):
    """Edit mode, with something hidden or selected, or another mode."""
    mode = chosen(random, ("EDIT", "EDIT", "SCULPT", "WEIGHT_PAINT", "VERTEX_PAINT"))
    if bpy.context.object == thing and bpy.ops.object.mode_set.poll():
        try:
            bpy.ops.object.mode_set(mode=mode)
        except (RuntimeError, TypeError):
            return  # not a mode of this type of object, or it is hidden
        if bpy.context.mode == "EDIT_MESH":
            bpy.ops.mesh.select_random(ratio=0.5, seed=int(random.integers(99)))
            chosen(random, (bpy.ops.mesh.hide, lambda: None))()


def sharpened(random, thing):
    """Edges marked sharp, faces shaded smooth."""
    if thing.type == "MESH":
        for edge in thing.data.edges[: len(thing.data.edges) // 3]:
            edge.use_edge_sharp = True
        thing.data.polygons.foreach_set("use_smooth", [True] * len(thing.data.polygons))


TRICKS = (
    renamed, moved, stretched, sheared, modified, modified, keyed, oriented, attributed, out_of_sight, shared, entered,
    sharpened,
)  # fmt: skip


# --- options


def options(random):
    """Any mixture of options, at their limits more often than not."""
    table = addon("core.settings").OPTIONS
    found = {}
    for name, option in table.items():
        if hasattr(option, "items"):
            found[name] = chosen(random, tuple(option.items)).name
        elif isinstance(option.default, bool):
            found[name] = bool(random.integers(2))
        else:
            found[name] = number(random, option)
    # Few samples, so that a thousand computations do not take too long.
    found["samples"] = int(random.integers(100, 800))
    found["budget"] = int(random.integers(100, 2000))
    found["spacing"] = chosen(random, (0.0, 3.0, 10.0))
    found["wrap_opening"] = chosen(random, (5.0, 50.0))
    kept = random.random(len(found)) >= 0.3
    always = ("samples", "budget", "wrap_opening")
    return {name: found[name] for name, keep in zip(found, kept) if keep or name in always}


def number(random, option):
    between = random.uniform(option.minimum, option.soft_maximum)
    limits = (option.minimum, min(option.maximum, 1e30), option.default)
    return type(option.default)(chosen(random, (*limits, between)))
