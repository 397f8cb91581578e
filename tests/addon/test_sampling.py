# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever an artist has, one click: samples of the faces, the axis in the solid, or one clear sentence."""

import math
import time
from functools import partial

import bpy
import numpy as np
import pytest
from scene import (
    addon,
    analyses,
    attribute,
    contents,
    ellipsoid,
    link,
    medial_objects,
    on_ellipsoid,
    opened,
    positions,
    radii_are_sound,
    reports,
    result_of,
    scan,
    select,
    suzanne,
    torus,
    triangles_of,
)


def click(**settings):
    """One click on the button with the defaults of the add-on: the result, or None when there is none."""
    source = bpy.context.object
    answer = bpy.ops.object.medial_axis(**settings)
    result = result_of(source)
    assert answer == ({"CANCELLED"} if result is None else {"FINISHED"})
    return result


def refused(match, **settings):
    """The sentence with which a click is refused; nothing changed."""
    before = contents()
    with pytest.raises(RuntimeError, match=match) as caught:
        bpy.ops.object.medial_axis(**settings)
    assert contents() == before and "Traceback" not in str(caught.value)
    assert len([line for line in str(caught.value).splitlines() if line.strip()]) == 1
    return str(caught.value)


def sound(result):
    """The result is a valid mesh of finite numbers."""
    mesh = result.data
    assert len(mesh.vertices) > 0 and mesh.validate() is False
    assert np.isfinite(positions(mesh)).all()
    for name in ("ma_radius", "ma_theta", "ma_rho"):
        assert np.isfinite(attribute(mesh, name)).all()
    assert radii_are_sound(mesh)


def winding(points, mesh):
    return (
        addon("core.machine.native")
        .load()
        .winding_number(points, positions(mesh), triangles_of(mesh))
    )


# --- the shapes people try first: distance into the solid (negative outside), largest radius


def in_box(p):
    return 1.0 - np.abs(p).max(axis=1)


def in_ball(p):
    return 1.0 - np.linalg.norm(p, axis=1)


def in_cylinder(p):
    return np.minimum(1.0 - np.hypot(p[:, 0], p[:, 1]), 1.0 - np.abs(p[:, 2]))


def in_cone(p):
    side = (1.0 - p[:, 2] - 2.0 * np.hypot(p[:, 0], p[:, 1])) / math.sqrt(5.0)
    return np.minimum(side, 1.0 + p[:, 2])


def in_torus(p):
    return 0.25 - np.hypot(np.hypot(p[:, 0], p[:, 1]) - 1.0, p[:, 2])


SOLIDS = {  # the last: how much the rounding of few flat faces changes, as a share of the radius
    "cube": (in_box, 1.0, 0.05),
    "uv_sphere": (in_ball, 1.0, 0.03),
    "ico_sphere": (in_ball, 1.0, 0.06),
    "cylinder": (in_cylinder, 1.0, 0.05),
    "cone": (in_cone, 2.0 / (1.0 + math.sqrt(5.0)), 0.06),
    "torus": (in_torus, 0.25, 0.05),
}


@pytest.mark.parametrize("kind", SOLIDS)
def test_factory_solids(kind):
    depth, largest, rounding = SOLIDS[kind]
    getattr(bpy.ops.mesh, f"primitive_{kind}_add")()
    result = click()
    sound(result)
    if kind != "uv_sphere":  # whose vertices are dense enough for it
        assert result["ma_sampling"] != "VERTICES"
        assert "samples of the surface" in result["ma_sampled"]
    radius = attribute(result.data, "ma_radius")
    assert radius.max() == pytest.approx(largest, rel=rounding)
    inside = depth(positions(result.data))
    assert inside.min() > -1e-6 * largest  # sheets end on the edges
    # A ball round a point of the axis touches the surface: its radius is the depth.
    assert np.abs(inside - radius).max() < rounding * largest
    assert set(attribute(result.data, "ma_side")) <= {1}
    assert tuple(result["ma_betti"]) == (1, int(kind == "torus"), 0)
    assert "as the solid" in result["ma_topology"] and "by its faces" not in result["ma_topology"]


@pytest.mark.parametrize("turn", [(0.3, 0.7, -1.1), (1.2, -0.4, 2.5)], ids=str)
def test_box_turned_in_float32(turn):
    bpy.ops.mesh.primitive_cube_add()
    box = bpy.context.object
    box.rotation_euler = turn
    bpy.context.view_layer.update()
    back = np.linalg.inv(np.array(box.matrix_world)[:3, :3])
    bpy.ops.object.transform_apply()
    result = click()
    sound(result)
    assert in_box(positions(result.data) @ back.T).min() > -1e-6


def test_axis_of_a_torus_is_its_circle():
    bpy.ops.mesh.primitive_torus_add(minor_segments=24)
    where = positions(click().data)
    assert np.hypot(np.hypot(where[:, 0], where[:, 1]) - 1.0, where[:, 2]).max() < 0.03


def test_axis_of_a_ball_is_its_centre():
    bpy.ops.mesh.primitive_uv_sphere_add()
    assert np.linalg.norm(positions(click().data), axis=1).max() < 0.05


def test_suzanne_as_she_is():
    bpy.ops.mesh.primitive_monkey_add()
    monkey = bpy.context.object
    result = click()
    sound(result)
    assert result["ma_sampling"] != "VERTICES"
    assert "the surface is open at 42 edges" in result["ma_warnings"]
    corners, where = positions(monkey.data), positions(result.data)
    low, high = corners.min(axis=0) - 1e-6, corners.max(axis=0) + 1e-6  # sheets end on sharp edges
    assert (where > low).all() and (where < high).all()
    assert 0.4 < attribute(result.data, "ma_radius").max() < 0.8


@pytest.mark.parametrize("kind", ["plane", "grid", "circle"])
def test_flat_meshes_are_one_sentence(kind):
    getattr(bpy.ops.mesh, f"primitive_{kind}_add")()
    refused("plane")


@pytest.mark.parametrize("turn", [(0.3, 0.7, -1.1), (1.2, -0.4, 2.5)], ids=str)
def test_plane_turned_in_float32_is_flat(turn):
    bpy.ops.mesh.primitive_grid_add(location=(3.0, -7.0, 2.0))
    bpy.context.object.rotation_euler = turn
    bpy.ops.object.transform_apply()
    refused("plane")


# --- curves, texts, surfaces, metaballs


def test_text_with_a_depth():
    bpy.ops.object.text_add()
    text = bpy.context.object
    text.data.extrude = 0.1
    result = click()
    sound(result)
    assert result["ma_sampling"] != "VERTICES" and result["ma_source"] == text
    assert "left out" not in result["ma_warnings"]  # sharp as the tips of letters may be
    assert np.abs(positions(result.data)[:, 2]).max() < 0.1 + 1e-6  # sheets end on the edges
    assert attribute(result.data, "ma_radius").max() < 0.1


def test_flat_text_is_one_sentence():
    bpy.ops.object.text_add()
    refused("'Text': .*one plane; give them thickness")


def test_curve_with_a_bevel():
    bpy.ops.curve.primitive_bezier_circle_add()
    bpy.context.object.data.bevel_depth = 0.2
    result = click()
    sound(result)
    assert attribute(result.data, "ma_radius").max() == pytest.approx(0.2, rel=0.05)


def test_curve_without_a_surface_is_one_sentence():
    bpy.ops.curve.primitive_bezier_circle_add()
    refused("'B.zierCircle': Expected faces, found only lines; give the object a surface")


def test_nurbs_surface():
    bpy.ops.surface.primitive_nurbs_surface_torus_add()
    sound(click())


def test_metaballs_together():
    bpy.ops.object.metaball_add(location=(0, 0, 0))
    ball = bpy.context.object
    other = ball.data.elements.new()
    other.co = (1.5, 0, 0)
    result = click()
    sound(result)
    where = positions(result.data)
    assert where[:, 0].min() < 0.3 and where[:, 0].max() > 1.2  # from one to the other
    assert attribute(result.data, "ma_radius").max() > 0.8
    bpy.ops.object.metaball_add(location=(-1.5, 0, 0))
    part = bpy.context.object  # of the same surface, which belongs to the first
    assert bpy.ops.object.medial_axis() == {"FINISHED"}
    assert result_of(part) == result_of(ball)
    assert addon("ui.properties").shown_thing(bpy.context) == result_of(ball)
    assert positions(result_of(ball).data)[:, 0].min() < -1.2


def test_vertices_of_a_curve_when_they_are_asked_for():
    bpy.ops.curve.primitive_bezier_circle_add()
    curve = bpy.context.object
    curve.data.bevel_depth, curve.data.bevel_resolution = 0.2, 8
    result = click(sampling="VERTICES")
    assert result["ma_sampling"] == "VERTICES" and result["ma_points"] < 3_000


# --- the choices


def test_dense_vertices_are_taken_and_sparse_ones_are_not():
    source = ellipsoid(segments=5)
    dense = click()
    assert dense["ma_sampling"] == "VERTICES"
    assert dense["ma_points"] == len(source.data.vertices)
    assert dense["ma_sampled"] == f"The {len(source.data.vertices):,} vertices, dense enough"
    sparse = ellipsoid("Coarse", segments=2)
    select(sparse)
    result = click()
    assert result["ma_sampling"] != "VERTICES"
    assert "the vertices are too sparse, epsilon above 0.25 at" in result["ma_sampled"]


def test_points_without_faces_are_taken_as_they_are():
    source = scan()
    result = click()
    assert result["ma_points"] == len(source.data.vertices)
    assert result["ma_sampled"].endswith("vertices, there are no faces")


@pytest.mark.parametrize("sampling", ["SURFACE", "ADAPTIVE"])
def test_points_without_faces_cannot_be_sampled(sampling):
    scan()
    refused(f"Expected faces for Sampling {sampling.capitalize()}, found points", sampling=sampling)


@pytest.mark.parametrize("count", [1_000, 4_000, 16_000])
def test_as_many_samples_as_asked_for(count):
    torus()
    assert click(sampling="SURFACE", samples=count)["ma_points"] == pytest.approx(count, rel=0.1)


def test_spacing_is_a_share_of_the_diagonal():
    source = torus()
    diagonal = np.linalg.norm(np.ptp(positions(source.data), axis=0))
    result = click(sampling="SURFACE", spacing=2.0)
    area = sum(polygon.area for polygon in source.data.polygons)
    count = 2 * area / (math.sqrt(3) * (0.02 * diagonal) ** 2)
    assert result["ma_points"] == pytest.approx(count, rel=0.1)
    bigger = source.copy()
    bpy.context.scene.collection.objects.link(bigger)
    bigger.scale = (7, 7, 7)
    select(bigger)
    assert click(sampling="SURFACE", spacing=2.0)["ma_points"] == result["ma_points"]


def thin_and_thick():
    """A closed ball that goes over into thin rods."""
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=5)
    source = bpy.context.object
    points = positions(source.data)
    points[:, 1:] *= 0.15 + 0.85 * np.exp(-((2.2 * points[:, :1]) ** 2))
    points[:, 0] *= 3.0
    source.data.vertices.foreach_set("co", points.astype(np.float32).ravel())
    source.data.update()
    return source


def test_adaptive_is_dense_where_the_shape_is_thin():
    source = thin_and_thick()
    even = click(sampling="SURFACE", samples=1_500)
    few, first = even["ma_points"], even["ma_density"]
    select(source)
    fine = click(sampling="ADAPTIVE", samples=1_500, budget=60_000)
    assert fine["ma_points"] > few and fine["ma_sampling"] == "ADAPTIVE"
    assert above(fine["ma_density"]) < above(first)
    assert "closer together where it is thin, in" in fine["ma_sampled"]


def above(density):
    """The percentage above epsilon that the sentence of a density says."""
    return float(density.partition("below ")[2].split(", ")[1].split(" %")[0])


def test_budget_is_kept_and_said():
    thin_and_thick()
    result = click(sampling="ADAPTIVE", samples=1_000, budget=1_500, epsilon=0.05)
    assert result["ma_points"] <= 1_500
    assert "until the budget of 1,500 was spent" in result["ma_sampled"]
    assert above(result["ma_density"]) > 50


def test_kept_vertices_are_samples():
    source = ellipsoid(segments=2)
    report_of = addon("bridge.report_object").report_of
    bpy.ops.object.medial_axis_sampling_report(
        sampling="SURFACE", samples=1_000, keep_vertices=True, smooth=False
    )
    samples = positions(report_of(source).data)
    nearest = np.linalg.norm(positions(source.data)[:, None] - samples, axis=2).min(axis=1)
    assert nearest.max() < 1e-6


def test_marked_edges_are_sharp():
    bpy.ops.mesh.primitive_uv_sphere_add()
    source = bpy.context.object
    plain = click(sampling="SURFACE", samples=2_000)["ma_density"]
    assert "with sharp edges" not in plain
    heights = positions(source.data)[:, 2]
    for edge in source.data.edges:  # the equator
        edge.use_edge_sharp = bool(np.abs(heights[list(edge.vertices)]).max() < 1e-3)
    select(source)
    assert "with sharp edges" in click(sampling="SURFACE", samples=2_000)["ma_density"]


def test_smooth_rounds_what_is_meant_to_be_round():
    """The facets of a coarse cylinder give its axis wings, its smooth surface does not."""
    bpy.ops.mesh.primitive_cylinder_add(vertices=20)
    source = bpy.context.object
    spread = {}
    for smooth in (True, False):
        select(source)
        result = click(form="PUBLISHED", sampling="SURFACE", samples=8_000, smooth=smooth)
        where = positions(result.data)
        middle = where[np.abs(where[:, 2]) < 0.2]
        spread[smooth] = np.hypot(middle[:, 0], middle[:, 1]).max() if len(middle) else 0.0
    assert spread[True] < 0.25 < spread[False]


def test_loose_vertices_are_left_out_of_samples_and_counted():
    source = ellipsoid(segments=2)
    source.data.vertices.add(3)
    source.data.vertices[len(source.data.vertices) - 1].co = (0.1, 0.1, 0.1)
    source.data.update()
    result = click()
    assert "3 vertices without a face were left out" in result["ma_warnings"]


# --- same answer, memory, sliders, cancel


def data_of(result):
    mesh = result.data
    return positions(mesh).tobytes(), attribute(mesh, "ma_radius").tobytes()


def test_the_same_click_gives_the_same_bytes_and_another_seed_others():
    source = torus()
    first = data_of(click(sampling="SURFACE", samples=2_000))
    addon("core.machine.cache").CACHE.clear()
    select(source)
    assert data_of(click(sampling="SURFACE", samples=2_000)) == first
    select(source)
    assert data_of(click(sampling="SURFACE", samples=2_000, seed=1)) != first


def test_a_second_click_and_the_report_analyse_nothing():
    source = thin_and_thick()
    settings = {"sampling": "ADAPTIVE", "samples": 1_500}
    click(**settings)
    count = analyses()
    assert count > 1  # passes
    select(source)
    click(**settings, theta=0.6)
    bpy.ops.object.medial_axis_sampling_report(**settings)
    assert analyses() == count


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("samples", 1_700),
        ("spacing", 3.0),
        ("sharp_angle", 1.4),
        ("smooth", False),
        ("keep_vertices", True),
        ("seed", 5),
        ("sampling", "VERTICES"),
        ("side", "BOTH"),
        ("sides", "NORMALS"),
    ],
)
def test_every_option_is_another_analysis(name, value):
    bpy.ops.mesh.primitive_cylinder_add()
    source = bpy.context.object
    settings = {"sampling": "SURFACE", "samples": 1_500}
    click(**settings)
    count = analyses()
    select(source)
    bpy.ops.object.medial_axis(**settings | {name: value})
    assert analyses() == count + 1


def test_epsilon_is_only_counted_again():
    source = torus()
    settings = {"sampling": "SURFACE", "samples": 1_500}
    click(**settings)
    count = analyses()
    select(source)
    assert "above 0.1" in click(**settings, epsilon=0.1)["ma_density"]
    assert analyses() == count


def test_sliders_work_on_samples():
    bpy.ops.mesh.primitive_cube_add()
    bpy.context.scene.medial_axis.crisp = False  # with it sheets lead into the edges at any Theta
    result = click(sampling="SURFACE", samples=3_000)
    count, facets = analyses(), len(result.data.polygons)
    panel = bpy.context.scene.medial_axis
    panel.samples = 5_000  # for the next click
    panel.theta = 1.2
    assert len(result.data.polygons) < facets and analyses() == count and panel.note == ""
    assert result["ma_samples"] == 3_000 and result["ma_sampling"] == "SURFACE"
    kept = addon("bridge.axis_object").settings_of(result)
    assert (kept.samples, kept.smooth, kept.sampling.name) == (3_000, True, "SURFACE")


def test_export_after_sampling(tmp_path):
    bpy.ops.mesh.primitive_cube_add()
    result = click(sampling="SURFACE", samples=1_000, mesh="VORONOI")
    path = tmp_path / "cube.npz"
    assert bpy.ops.export_scene.medial_axis(filepath=str(path)) == {"FINISHED"}
    axis = np.load(path)
    assert axis["generators"].max() < result["ma_points"] and axis["generators"].min() >= 0
    # Two samples of a facet are equally far from its corners, at the distance of the radius.
    bpy.context.view_layer.objects.active = result
    source = result["ma_source"]
    select(source)
    bpy.ops.object.medial_axis_sampling_report(sampling="SURFACE", samples=1_000)
    samples = positions(addon("bridge.report_object").report_of(source).data)
    first = axis["face_vertices"][axis["face_offsets"][:-1]]
    for end in (0, 1):
        away = np.linalg.norm(axis["vertices"][first] - samples[axis["generators"][:, end]], axis=1)
        np.testing.assert_allclose(away, axis["radius"][first], atol=1e-5)


@pytest.mark.parametrize("delay", [0.0, 0.1, 0.6])
def test_cancel_works_in_every_pass(delay):
    source = thin_and_thick()
    shape = addon("bridge.read_object").read_object(source, bpy.context.evaluated_depsgraph_get())
    settings = addon("core.settings")
    wanted = settings.Settings(
        sampling=settings.SamplingMode.ADAPTIVE, samples=200_000, budget=1_000_000, epsilon=0.02
    )
    work = partial(addon("core.samples.sampling_report").report_sampling, shape, wanted)
    job = addon("core.machine.job").Job([addon("core.machine.job").Task("Rod", work)])
    seen, end = [], time.monotonic() + delay
    while time.monotonic() < end:
        seen.append(job.fraction)
        time.sleep(0.01)
    job.stop()
    assert job.done and seen == sorted(seen)
    with pytest.raises(addon("core.errors").Cancelled):
        job.outcomes()


def test_progress_is_one_bar_over_all_passes():
    source = thin_and_thick()
    shape = addon("bridge.read_object").read_object(source, bpy.context.evaluated_depsgraph_get())
    settings = addon("core.settings")
    wanted = settings.Settings(sampling=settings.SamplingMode.ADAPTIVE, samples=3_000)
    work = partial(addon("core.samples.sampling_report").report_sampling, shape, wanted)
    job = addon("core.machine.job").Job([addon("core.machine.job").Task("Rod", work)])
    seen = []
    while not job.done:
        seen.append((job.fraction, job.stage))
        time.sleep(0.002)
    fractions = [fraction for fraction, _ in seen]
    assert fractions == sorted(fractions) and fractions[0] >= 0 and fractions[-1] <= 1
    assert len({stage for _, stage in seen}) > 3
    assert job.outcomes()[0].value.chosen.sampling is settings.SamplingMode.ADAPTIVE


# --- messy meshes


def two_balls(apart):
    """Two balls in one mesh that overlap when they are less than 2 apart."""
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=3)
    points, triangles = positions(bpy.context.object.data), triangles_of(bpy.context.object.data)
    bpy.data.objects.remove(bpy.context.object)
    points = np.concatenate([points, points + np.array([apart, 0.0, 0.0])])
    return link("Balls", points, np.concatenate([triangles, triangles + len(points) // 2]))


def test_overlapping_parts_are_one_solid():
    two_balls(1.2)
    result = click(sampling="SURFACE", samples=4_000)
    sound(result)
    assert "samples were left out because the surface there bounds nothing" in result["ma_warnings"]
    where = positions(result.data)
    middle = np.abs(where[:, 0] - 0.6) < 0.1
    assert middle.any(), "the axis leads from one ball to the other"
    # where the balls overlap, the axis is as far from the surface as the two together say
    assert attribute(result.data, "ma_radius")[middle].min() > 0.5


def test_parts_that_do_not_touch_have_an_axis_each():
    two_balls(3.0)
    result = click(sampling="SURFACE", samples=4_000)
    sound(result)
    assert "left out" not in result["ma_warnings"]
    where = positions(result.data)[:, 0]
    assert (np.minimum(np.abs(where), np.abs(where - 3.0)) < 0.2).all()
    assert (where < 1).any() and (where > 2).any()


def test_doubled_faces(capfd):
    """Every face twice, once each way: one of the two counts."""
    source = ellipsoid(segments=2)
    points, triangles = positions(source.data), triangles_of(source.data)
    thing = link(
        "Doubled",
        np.concatenate([points, points]),
        [*triangles, *(triangles[:, ::-1] + len(points))],
    )
    select(thing)
    doubled = click(sampling="SURFACE", samples=1_000)
    assert "lie on another face" in doubled["ma_warnings"]
    select(source)
    assert len(click(sampling="SURFACE", samples=1_000).data.polygons) == len(doubled.data.polygons)


def test_duplicate_vertices():
    source = ellipsoid(segments=2)
    points, triangles = positions(source.data), triangles_of(source.data)
    whole = click(sampling="SURFACE", samples=1_000)
    soup = link("Soup", points[triangles.ravel()], np.arange(triangles.size).reshape(-1, 3))
    select(soup)
    result = click(sampling="SURFACE", samples=1_000)
    sound(result)
    assert result["ma_points"] == pytest.approx(whole["ma_points"], rel=0.02)
    assert "the faces are closed" in result["ma_inside"]


def test_thin_sheet():
    """A plate a hundredth as thick as wide: its middle plane, though samples are farther apart than that."""
    bpy.ops.mesh.primitive_cube_add()
    bpy.context.object.scale = (1, 1, 0.01)
    result = click()
    sound(result)
    where = positions(result.data)
    assert np.abs(where[:, 2]).max() < 0.01
    radius = attribute(result.data, "ma_radius")
    assert np.median(radius) == pytest.approx(0.01, rel=0.25) and radius.max() < 0.03


def test_edge_of_three_faces():
    """A wing on a closed mesh: non-manifold, open, and yet no crash."""
    source = ellipsoid(segments=2)
    points, triangles = positions(source.data), triangles_of(source.data)
    a, b, _ = triangles[0]
    wing = np.concatenate([points, [1.5 * points[[a, b]].mean(axis=0)]])
    thing = link("Wing", wing, [*triangles, (a, b, len(points))])
    select(thing)
    sound(click())


def test_self_intersecting_tube():
    """A torus that passes through itself."""
    bpy.ops.mesh.primitive_torus_add(major_radius=0.5, minor_radius=0.6, minor_segments=24)
    sound(click())


@pytest.mark.parametrize("kind", ["ellipsoid", "suzanne", "half ball"])
def test_open_meshes_say_so(kind):
    if kind == "ellipsoid":
        source = opened()
    elif kind == "suzanne":
        source = suzanne(levels=0)
    else:
        bpy.ops.mesh.primitive_uv_sphere_add()
        ball = bpy.context.object
        kept = [list(p.vertices) for p in ball.data.polygons if p.center.z > 0]
        source = link("Half", positions(ball.data), kept)
    select(source)
    result = click(sampling="SURFACE", samples=4_000)
    sound(result)
    assert "open at" in result["ma_inside"] and "open" in result["ma_warnings"]


def test_nothing_is_written_on_the_source():
    bpy.ops.mesh.primitive_cube_add()
    source = bpy.context.object
    before = ([a.name for a in source.data.attributes], dict(source.items()))
    click(sampling="SURFACE", samples=1_000)
    assert ([a.name for a in source.data.attributes], dict(source.items())) == before


def test_scale_is_applied_before_sampling():
    bpy.ops.mesh.primitive_cube_add()
    source = bpy.context.object
    source.scale = (3, 1, 1)
    result = click(sampling="SURFACE", samples=4_000)
    where = positions(result.data)
    assert np.abs(where[:, 0]).max() > 2.5 and attribute(result.data, "ma_radius").max() < 1.02
    assert [tuple(row) for row in result.matrix_world] == [tuple(row) for row in np.eye(4)]


def test_reports_of_a_click(capfd):
    bpy.ops.mesh.primitive_cube_add()
    click(sampling="SURFACE", samples=1_000)
    infos = [text for kind, text in reports(capfd) if kind == "Info"]
    assert len(infos) == 1 and len(medial_objects()) == 1
    assert infos[0].startswith("Done: 1 piece, ")


def test_scan_on_an_ellipsoid_has_the_epsilon_of_its_spacing():
    """2,000 points on an ellipsoid of half-axes 1, 0.7, 0.5 are dense enough by far."""
    points, _ = on_ellipsoid()
    scan(points=points)
    density = click()["ma_density"]
    assert above(density) < 5 and 0.02 < float(density.split("median ")[1][:4]) < 0.25
