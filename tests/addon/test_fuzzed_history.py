# SPDX-License-Identifier: GPL-3.0-or-later
"""Random histories: whatever was clicked, edited, undone, saved and forgotten before, a result is the one that its
settings give for its source when they are reached directly, in a new scene and without a cache.
"""

import random

import bpy
import numpy as np
import pytest
from installed import addon
from measure import attribute, positions, result_of
from scene import ellipsoid, move_vertices, press, reopened, select
from support.fuzz import repeats

NAME = "Source"
SHAPES = ((1.0, 0.7, 0.5), (0.6, 1.0, 0.9), (1.2, 0.4, 0.5))
# Operators are given these values, and sliders of the panel are set to them.
CHOICES = {
    "form": ("CLEAN", "PUBLISHED", "CURVE"),
    "theta": (0.2, 0.4, 0.8),
    "rho": (2.0, 8.0, 20.0),
    "rule": ("EITHER", "BOTH"),
    "criteria": ("ANGLE_OR_RATIO", "ANGLE", "RATIO"),
    "simplify": (0.0, 2.0),
    "limb": (0.0, 4.0, 10.0),
    "detail": (0.0, 0.5, 1.0),
    "crisp": (True, False),
}
ANALYSED = {
    "sampling": ("VERTICES", "SURFACE", "SURFACE"),
    "samples": (400, 700),
    "side": ("INNER", "AUTOMATIC"),
    "sides": ("AUTOMATIC", "SURFACE", "TIGHT_COCONE"),
    "seed": (0, 3),
    "sharp_angle": (0.5, 2.0),
    "smooth": (True, False),
}
OTHERS = ("medial_axis_thickness", "medial_axis_skeleton", "medial_axis_sampling_report")


class History:
    """The scene of a history, and what is known of it: the shape now, and when its axis was computed."""

    def __init__(self, seed):
        self.rng = random.Random(seed)
        bpy.context.preferences.edit.use_global_undo = True
        reset_panel()
        new_source(SHAPES[0], False)
        self.known = {"shape": SHAPES[0], "modified": False, "analysed": None}
        self.undone = []
        self.push()

    def run(self, steps):
        actions = (self.compute, self.compute, self.slide, self.slide, self.edit, self.modify)
        actions += (self.other, self.undo, self.save, self.forget, self.move)
        for _ in range(steps):
            self.rng.choice(actions)()
        self.compute()
        for _ in range(self.rng.randrange(3)):
            self.rng.choice((self.slide, self.edit, self.other, self.forget))()

    def push(self):
        bpy.ops.ed.undo_push(message="step")
        self.undone.append(dict(self.known))

    def compute(self):
        select(source())
        values = {name: self.rng.choice(items) for name, items in (CHOICES | ANALYSED).items()}
        try:
            done = bpy.ops.object.medial_axis(within=0.0, select_result=False, **values)
        except RuntimeError as error:
            assert "Traceback" not in str(error), error
            return
        if done == {"FINISHED"}:
            self.known["analysed"] = (self.known["shape"], self.known["modified"])
        self.push()

    def slide(self):
        select(source())
        panel, name = bpy.context.scene.medial_axis, self.rng.choice(list(CHOICES))
        setattr(panel, name, self.rng.choice(CHOICES[name]))
        result = result_of(source())
        if result is not None and not panel.note:
            kept = addon("bridge.axis.axis_object").settings_of(result)
            wanted = addon("ui.settings.properties").settings_from(panel)
            assert getattr(kept, name) == getattr(wanted, name), name
        self.push()

    def edit(self):
        self.known["shape"] = self.rng.choice(SHAPES)
        shape_source(source(), self.known["shape"])
        self.push()

    def modify(self):
        self.known["modified"] = not self.known["modified"]
        modify_source(source(), self.known["modified"])
        self.push()

    def other(self):
        select(source())
        operator, samples = self.rng.choice(OTHERS), self.rng.choice((300, 500))
        few = {"sampling": "SURFACE", "samples": samples, "select_result": False}
        try:
            getattr(bpy.ops.object, operator)(**few)
        except RuntimeError as error:
            assert "Traceback" not in str(error), error
        self.push()

    def undo(self):
        if len(self.undone) > 1:
            self.undone.pop()
            self.known = dict(self.undone[-1])
            bpy.ops.ed.undo()

    def save(self):
        reopened(bpy.app.tempdir + "history.blend")
        self.undone = []
        self.push()

    def forget(self):
        addon("core.machine.cache").CACHE.clear()

    def move(self):
        source().location = [self.rng.choice((0.0, 2.0)) for _ in range(3)]
        bpy.context.view_layer.update()
        self.push()


def source():
    return bpy.data.objects[NAME]


def new_source(shape, modified):
    thing = ellipsoid(NAME, segments=3)
    shape_source(thing, shape)
    modify_source(thing, modified)
    bpy.context.view_layer.update()
    return thing


def shape_source(thing, shape):
    rng = np.random.default_rng(5)
    points = positions(thing.data)
    points = points / np.linalg.norm(points, axis=1)[:, None]
    if "start" not in thing:
        thing["start"] = points.ravel().tolist()
    points = np.array(thing["start"]).reshape(-1, 3) * shape
    move_vertices(thing, points + rng.normal(scale=2e-3, size=points.shape))


def modify_source(thing, modified):
    if modified:
        thing.modifiers.new("Push", "DISPLACE").strength = 0.03
    else:
        thing.modifiers.clear()


def reset_panel():
    panel = bpy.context.scene.medial_axis
    for name in (*CHOICES, *ANALYSED):
        panel.property_unset(name)


def figures(result):
    """All that a result has: its mesh, attributes and figures."""
    mesh = result.data
    arrays = {"co": positions(mesh).tobytes()}
    arrays["edges"] = sorted(tuple(edge.vertices) for edge in mesh.edges)
    arrays["faces"] = [tuple(face.vertices) for face in mesh.polygons]
    ours = [name for name in mesh.attributes.keys() if name.startswith("ma_")]  # noqa: SIM118
    arrays |= {name: attribute(mesh, name).tobytes() for name in ours}
    names = ("ma_topology", "ma_points", "ma_duplicates", "ma_warnings", "ma_verdict")
    return arrays | {name: result.get(name) for name in names}


def directly(shape, modified, settings):
    """The figures of the result that these settings give in a new scene."""
    bpy.ops.wm.read_homefile(use_empty=True)
    addon("core.machine.cache").CACHE.clear()
    reset_panel()
    select(new_source(shape, modified))
    chosen = {name: getattr(settings, name) for name in (*CHOICES, *ANALYSED)}
    values = {name: getattr(value, "name", value) for name, value in chosen.items()}
    return figures(press("medial_axis", within=0.0, **values))


@pytest.mark.parametrize("seed", repeats(10))
def test_fuzzed_history(seed):
    history = History(seed)
    history.run(8)
    result = result_of(source())
    if history.known["analysed"] is None:
        assert result is None
        return
    settings = addon("bridge.axis.axis_object").settings_of(result)
    found, wanted = figures(result), directly(*history.known["analysed"], settings)
    assert found.keys() == wanted.keys()
    assert [name for name in wanted if found[name] != wanted[name]] == []
