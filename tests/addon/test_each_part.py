# SPDX-License-Identifier: GPL-3.0-or-later
"""Each Part by Itself: an axis of each connected part in one collection, as one step, or nothing."""

import bpy
import numpy as np
import pytest
from installed import addon
from measure import medial_objects, positions
from scene import added, compute, link

EACH = {"form": "CLEAN", "sampling": "SURFACE", "samples": 800, "each_part": True}


def boxes(count=5, sheet=True):
    """Boxes in a row, the first two overlapping, and a flat sheet behind them."""
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    places = [0.5, 0.0, 3.0, 6.0, 9.0, 12.0][:count]
    points = np.concatenate([corners + np.array((place, 0.1 * place, 0)) for place in places])
    faces = np.concatenate([np.array(quads) + 8 * i for i in range(count)]).tolist()
    if sheet:
        faces.append([len(points) + i for i in (0, 1, 3, 2)])
        points = np.concatenate((points, corners[:4] @ np.diag((1, 2, 2)) + (0, 5, 0)))
    return link("Boxes", points, faces)


def axes(source):
    return sorted((t for t in medial_objects() if t["ma_source"] == source), key=lambda t: t.name)


def test_five_boxes_give_five_axes_in_one_collection():
    source = boxes()
    compute(**EACH)
    found = axes(source)
    assert [thing.name for thing in found] == [f"Boxes Medial Axis {n}" for n in range(1, 6)]
    (collection,) = {c for thing in found for c in thing.users_collection}
    assert collection.name == "Boxes Medial Axes" and len(collection.objects) == 5
    assert all(thing.parent == source and thing["ma_pieces"] == 1 for thing in found)
    assert "1 of 6 connected parts are sheets" in bpy.context.scene.medial_axis.note
    assert addon("bridge.axis.axis_object").result_of(source) is None


def test_the_whole_and_its_parts_are_updated_by_themselves():
    source = boxes(3, sheet=False)
    whole = compute(**EACH | {"each_part": False})
    assert whole["ma_pieces"] == 2  # two overlap
    parts = "3 connected parts; 2 of them overlapping others; 1 of them apart from all others"
    assert whole["ma_source_mesh"] == parts
    compute(source, **EACH)
    first = axes(source)
    compute(first[-1], **EACH)
    assert axes(source) == first and len(first) == 4
    box = [tuple(polygon.vertices) for polygon in source.data.polygons[:6]]
    one = link("One", positions(source.data)[:8], box)
    source.data = one.data
    bpy.data.objects.remove(one)
    compute(source, **EACH)
    assert [thing.name for thing in axes(source)] == ["Boxes Medial Axis", "Boxes Medial Axis 1"]


def test_a_refusal_and_a_cancelled_job_leave_nothing(monkeypatch):
    added("plane")
    with pytest.raises(RuntimeError, match="found 1 without"):
        compute(**EACH)
    boxes(2)
    with monkeypatch.context() as few:
        few.setattr(addon("ui.axis.operators"), "MOST", 1)
        with pytest.raises(RuntimeError, match="at most 1 connected parts, found 2"):
            compute(**EACH)

    def cancelled(_task):
        raise addon("core.errors").Cancelled("cancelled")

    monkeypatch.setattr(addon("ui.axis.compute_operator"), "run_task", cancelled)
    with pytest.raises(RuntimeError):
        compute(**EACH)
    assert not medial_objects()
    assert not [c for c in bpy.data.collections if c.name.endswith("Medial Axes")]
