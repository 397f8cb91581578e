# SPDX-License-Identifier: GPL-3.0-or-later
"""Skeletons: ends and loops of real meshes, centre lines of solids that have known ones, files, bones and weights."""

import json

import numpy as np
import pytest
from medial_axis.cli import main
from medial_axis.core.curves.ends import balls_of
from medial_axis.core.curves.net import Net
from medial_axis.core.curves.rules import Loops, clear_loops, join_tips, open_loops, prune
from medial_axis.core.curves.spread import graph_of, spread
from medial_axis.core.errors import DegenerateInputError, InvalidInputError, ReadError
from medial_axis.core.files.read_shape import read_shape
from medial_axis.core.rig.bones import Bones, Stubs, bones_of
from medial_axis.core.rig.names import names_of
from medial_axis.core.rig.rig import compute_rig
from medial_axis.core.rig.weights import _share_with_parents, axis_weights
from medial_axis.core.settings import KeptLoops, SamplingMode, Settings, SkeletonSettings
from medial_axis.core.shape.shape import Shape
from medial_axis.core.shape.triangles import edges_of
from medial_axis.core.skeleton.chords import keep_inside, kept_inside, kept_points
from medial_axis.core.skeleton.chosen_ends import join_ends
from medial_axis.core.skeleton.compute import compute_skeleton
from medial_axis.core.skeleton.load_skeleton import load_skeleton
from medial_axis.core.skeleton.middle import lead_through_middle
from medial_axis.core.skeleton.mirror import _image
from medial_axis.core.skeleton.parts import Places
from medial_axis.core.skeleton.skeleton import Skeleton, centre_of_mass
from medial_axis.core.skeleton.warnings import skeleton_warnings
from medial_axis.core.skeleton.write_skeleton import export_skeleton
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import cKDTree
from support import distance, meshes, reference, swept, topology, tubes
from support.poses import posed, random_turn, random_turns, swapped, turn

pytestmark = pytest.mark.oracle

NO_FACES = np.zeros((0, 3), np.int32)


def skeleton_of(shape, settings=Settings(), ends=None, **wanted):
    return compute_skeleton(shape, settings, SkeletonSettings(**wanted), ends=ends)


def of_tubes(solid, count, **wanted):
    points = solid.sample(count)
    return skeleton_of(Shape(points, NO_FACES, solid.normals(points)), **wanted)


def places_of(skeleton, steps=10):
    """Places along all edges, and the radii there."""
    a, b = skeleton.edges.T
    share = np.linspace(0.0, 1.0, steps + 1)
    return (
        np.concatenate([(1 - t) * values[a] + t * values[b] for t in share])
        for values in (skeleton.points, skeleton.radius)
    )


# --- known centre lines


@pytest.mark.parametrize(
    ("solid", "tips", "loops", "forks"),
    [
        (tubes.y_of_tubes(), 3, 0, 1),
        (tubes.helix(), 2, 0, 0),
        (tubes.trefoil(), 0, 1, 0),
        (tubes.tree(), 5, 0, 3),
    ],
    ids=["y", "helix", "knot", "tree"],
)
def test_known_centre_lines(solid, tips, loops, forks):
    found = of_tubes(solid, 4000).skeleton
    assert (found.tips, found.loops, (found.degree > 2).sum()) == (tips, loops, forks)
    places, radii = places_of(found)
    away = solid.distances(places) / np.array(solid.radii)[:, None]
    assert away.min(axis=0).max() < 0.05
    assert found.length == pytest.approx(solid.length, rel=0.03)
    if forks:
        true = meeting_points(solid)
        at, which = cKDTree(true).query(found.points[found.degree > 2])
        assert len(set(which)) == forks
        assert at.max() < 0.1 * min(solid.radii)
        beside = cKDTree(true).query(places)[0] > 2.5 * max(solid.radii)
        radii, away = radii[beside], away[:, beside]
    expected = np.array(solid.radii)[away.argmin(axis=0)]
    assert np.abs(radii / expected - 1).max() < 0.03


def meeting_points(solid):
    ends = np.concatenate([line[[0, -1]] for line in solid.lines]).round(9)
    places, times = np.unique(ends, axis=0, return_counts=True)
    return places[times > 2]


def test_a_shell_has_no_curve():
    with pytest.raises(DegenerateInputError, match="closed sheets"):
        skeleton_of(Shape(*meshes.nested_shell(4)))


def test_a_plate_has_few_ends():
    plate = meshes.box((20, 14, 2), (1.0, 0.7, 0.05))
    assert skeleton_of(Shape(*plate)).skeleton.tips <= 4


# --- real meshes


@pytest.mark.parametrize(
    ("name", "tips", "loops"),
    [
        ("hand_closed.obj", {5, 6}, 0),
        ("spot_low.obj", {6, 7, 8}, 0),
        ("dilo.off", {6, 7, 8}, 0),
        ("human_woman.obj", {5}, 0),
        pytest.param("elephant-with-holes.off", set(range(6, 13)), 0, marks=pytest.mark.slow),
        ("3holes.off", {0}, 3),
        ("rocker-arm.off", {2, 3}, 1),
        ("knot1.off", {0}, 1),
    ],
)
def test_ends_and_loops_of_real_meshes(data_file, name, tips, loops):
    found = skeleton_of(read_shape(data_file(name))[0]).skeleton
    assert found.tips in tips and found.loops == loops and found.pieces == 1


def limb_ends(shape, found):
    """The vertex of the surface farthest out at each tip of a skeleton, (t, 3), and the tips."""
    tips, radii = ends_of(found)
    ends = []
    for tip, radius in zip(tips, radii, strict=True):
        near = shape.points[np.linalg.norm(shape.points - tip, axis=1) < 2 * radius]
        ends.append(near[np.argmax((near - tip) @ (tip - found.points.mean(axis=0)))])
    return np.array(ends), tips


def test_chosen_ends_of_a_hand_and_no_others(data_file):
    """Five finger tips and the wrist, then fewer; the tips are where they were, and the rest is gone."""
    shape, _ = read_shape(data_file("hand_closed.obj"))
    settings = Settings(sampling=SamplingMode.SURFACE, samples=4000)
    ends, tips = limb_ends(shape, skeleton_of(shape, settings).skeleton)
    assert len(ends) == 6
    for chosen in ([0, 1, 2, 3, 4, 5], [0, 2, 5], [1, 4]):
        found = skeleton_of(shape, settings, ends=ends[chosen])
        points, radii = ends_of(found.skeleton)
        assert len(points) == len(chosen) and found.skeleton.loops == 0
        away = np.linalg.norm(points[:, None] - tips[chosen], axis=2)
        assert (away.min(axis=1) <= radii).all()
        assert len(set(away.argmin(axis=1))) == len(chosen)
        assert found.parts.vertices.branch.min() >= 0  # the whole surface follows what is left
    rig = compute_rig(shape, settings, SkeletonSettings(), ends=ends[[0, 2, 5]])
    assert len(rig.limbs) <= 3


def test_ends_that_cannot_be_joined_are_refused(data_file):
    shape, _ = read_shape(data_file("hand_closed.obj"))
    settings = Settings(sampling=SamplingMode.SURFACE, samples=3000)
    ends, _ = limb_ends(shape, skeleton_of(shape, settings).skeleton)
    apart = np.linalg.norm(ends[:, None] - ends, axis=2)
    far = ends[list(np.unravel_index(apart.argmax(), apart.shape))]
    middle = shape.points[np.argmin(np.linalg.norm(shape.points - far.mean(axis=0), axis=1))]
    for wrong, message in (
        (ends[:1], "two or more ends"),
        (np.full((2, 3), np.nan), "two or more ends"),
        (ends[[0, 1, 0]], "ends 1 and 3 at the same one"),
        (np.stack((*far, middle)), "lies between others"),
    ):
        with pytest.raises(InvalidInputError, match=message):
            skeleton_of(shape, settings, ends=wrong)


def test_loops_are_kept_or_opened_by_choice():
    """A ring with two tails: opened, it has all its length but one edge, and two ends more."""
    ring = skeleton_of(Shape(*meshes.torus())).skeleton
    for loops, count, tips in ((KeptLoops.KEEP, 1, 0), (KeptLoops.OPEN, 0, 2)):
        found = skeleton_of(Shape(*meshes.torus()), loops=loops).skeleton
        assert (found.loops, found.tips, found.pieces) == (count, tips, 1)
        assert found.length > 0.9 * ring.length


def ends_of(skeleton):
    tip = skeleton.degree == 1
    return skeleton.points[tip], skeleton.radius[tip]


@pytest.mark.parametrize(
    ("name", "tips", "loops", "radii_off", "mirrored"),
    [
        ("hand_closed.obj", 6, 0, 1.0, True),
        ("spot_low.obj", 8, 0, 1.0, False),  # its mirror image loses an ear at 32,000 samples
        # A leg ends in one or the other of its toes.
        pytest.param("dilo.off", 7, 0, 2.0, True, marks=pytest.mark.slow),
        # An arm is cut flat.
        pytest.param("rocker-arm.off", 3, 1, 1.5, True, marks=pytest.mark.slow),
        pytest.param("knot1.off", 0, 1, 1.0, True, marks=pytest.mark.slow),
    ],
)
def test_the_same_ends_at_every_density_and_however_turned(
    data_file, name, tips, loops, radii_off, mirrored
):
    """End points are within so many radii, of their own or of the usual one; the second body is a mirror image."""
    shape, _ = read_shape(data_file(name))
    first = None
    for samples in (16_000, 32_000, 64_000):
        settings = Settings(sampling=SamplingMode.SURFACE, samples=samples)
        side = -1 if mirrored and samples == 32_000 else 1
        frame = side * random_turn(samples)
        turned = Shape(shape.points @ frame.T, shape.triangles[:, ::side])
        found = skeleton_of(turned, settings).skeleton
        assert (found.tips, found.loops) == (tips, loops)
        points, radii = ends_of(found)
        first = first or (points @ frame, radii)
        if tips:
            away, which = cKDTree(points @ frame).query(first[0])
            assert len(set(which)) == tips
            assert (away <= radii_off * np.maximum(first[1], np.median(first[1]))).all()


@pytest.mark.parametrize("seed", range(3))
def test_a_limb_that_is_cut_flat_ends_in_the_ball_that_touches_its_end(seed):
    """No joint lies in a corner of the solid, a rod of radius 0.2 from -1 to 1."""
    line, ones, frame = np.linspace((-1, 0, 0), (1, 0, 0), 31), np.ones((31, 1)), random_turn(seed)
    points, triangles = swept.swept(line, ones * (0.0, 0.2, 0.0), ones * (0.0, 0.0, 0.2), 24)
    points = ends_of(skeleton_of(Shape(points @ frame.T, triangles)).skeleton)[0] @ frame
    points = points[np.argsort(points[:, 0])]
    np.testing.assert_allclose(points, [(-0.8, 0, 0), (0.8, 0, 0)], atol=0.1)


# --- symmetry


def symmetric_tubes():
    arms = [[(0, 0, -1), (0, 0, 1)], [(0, 0, 0.6), (1, 0.2, 0.9)], [(0, 0, 0.6), (-1, 0.2, 0.9)]]
    legs = [[(0, 0, -1), (0.5, 0, -2)], [(0, 0, -1), (-0.5, 0, -2)]]
    lines = tuple(np.array(line, float) for line in (*arms, *legs))
    return tubes.Tubes(lines, (0.25, 0.12, 0.12, 0.14, 0.14))


def test_symmetric_skeletons_are_exactly_so():
    found = of_tubes(symmetric_tubes(), 3000)
    assert found.mirrored
    points = found.skeleton.points
    plane = centre_of_mass(found.skeleton)[0]
    image = points * (-1, 1, 1) + (2 * plane, 0, 0)
    assert cKDTree(points).query(image)[0].max() < 1e-9


def test_others_are_left_as_they_are():
    found = of_tubes(tubes.y_of_tubes(), 1500)
    plain = of_tubes(tubes.y_of_tubes(), 1500, mirror=False)
    assert not found.mirrored
    np.testing.assert_array_equal(found.skeleton.points, plain.skeleton.points)


def test_mirrored_model_mirrored_names():
    solid = symmetric_tubes()
    points = solid.sample(2500)
    named = []
    for sign in (1.0, -1.0):
        shape = Shape(points * (sign, 1, 1), NO_FACES, solid.normals(points) * (sign, 1, 1))
        bones, bodies = bones_of(skeleton_of(shape).skeleton)
        named.append(dict(zip(names_of(bodies, bones.count), bones.tail, strict=True)))
    first, second = named
    assert set(second) == set(first) == {swapped(name) for name in first}
    assert {"pelvis", "spine.01", "arm.01.L", "leg.01.R"} <= set(first)
    for name, tail in first.items():
        if name.endswith(".L"):
            assert tail[0] > 0 and second[name][0] > 0
            np.testing.assert_allclose(second[name], tail, atol=0.1)


# --- bones and weights


@pytest.fixture(
    params=["hand_closed.obj", "spot_low.obj", "dilo.off", "human_woman.obj"], scope="module"
)
def rigged(request, data_file):
    """A shape and its rig."""
    shape, _ = read_shape(data_file(request.param))
    return shape, compute_rig(shape, Settings(), SkeletonSettings())


def test_bones_are_few_connected_and_near_the_curve(rigged):
    _, rig = rigged
    bones, skeleton = rig.bones, rig.made_of.skeleton
    assert bones.count <= 3 * skeleton.tips + 20 and len(set(rig.names)) == bones.count
    child, forks = bones.connected, np.flatnonzero(skeleton.degree > 2)
    np.testing.assert_array_equal(bones.head[child], bones.tail[bones.parent[child]])
    assert (bones.parent < np.arange(bones.count)).all()
    assert bones.head_radius[0] >= 0.9 * skeleton.radius[forks].max()
    share = np.linspace(0, 1, 200)[:, None, None]
    along = ((1 - share) * bones.head + share * bones.tail).reshape(-1, 3)
    away = cKDTree(along).query(skeleton.points)[0]
    spacing = np.linalg.norm(bones.tail - bones.head, axis=1).max() / 200
    thin = np.zeros(len(skeleton.points))
    for rows in skeleton.branches:
        thin[rows] = np.maximum(thin[rows], skeleton.radius[rows].mean() / 2)
    gaps = np.linalg.norm(skeleton.points[:, None] - skeleton.points[forks], axis=2)
    aside = (gaps > 1.5 * skeleton.radius[forks]).all(axis=1)
    assert aside.any()
    # Half the radius, and a little more where bones would be shorter than the balls on them.
    assert (away <= 0.65 * np.maximum(skeleton.radius, thin) + spacing)[aside].all()


def weights_along(along, radius):
    """(k, 3) the weights of the root and of two bones in line, each half of a branch, at shares of that branch."""
    shares = [(0.0, 0.0), (0.0, 0.5), (0.5, 1.0)]
    bones = bones_in_a_row((0, 0, 1), -1.0, radius, (1, 0, 0), [-1, 0, 0], shares, [0, 1, 1])
    along = np.asarray(along)
    places = Places(np.zeros(len(along), np.int32), along)
    points = np.column_stack((np.zeros((len(along), 2)), 2.0 * along))
    bone, weight = axis_weights(bones, places, points, np.zeros((0, 2), np.int32))
    found = np.zeros((len(along), 4))
    np.put_along_axis(found, bone.astype(np.int64), weight, axis=1)
    return found[:, :3]


def bones_in_a_row(way, start, radius, up, branch, along, chain):
    """Bones of length 1 from a place on an axis, of which each is the parent of the next one."""
    count = len(chain)
    head = np.outer(start + np.arange(count), way)
    return Bones(
        head=head,
        tail=head + way,
        head_radius=np.full(count, radius),
        tail_radius=np.full(count, radius),
        up=np.tile(np.array(up, float), (count, 1)),
        parent=np.arange(-1, count - 1, dtype=np.int32),
        connected=np.arange(count) > 0,
        branch=np.array(branch, np.int32),
        along=np.array(along),
        chain=np.array(chain, np.int32),
        to_tip=np.arange(count) > 0,
        stubs=Stubs(np.zeros(0, np.int32), np.zeros((0, 2)), np.zeros(0, np.int32)),
    )


def test_two_thick_bones_share_at_most_half_of_each():
    """However large the radius at their joint is, the outer half of each bone follows that bone alone."""
    weight = weights_along([0.1, 0.25, 0.4, 0.5, 0.6, 0.75, 0.9], radius=10.0)
    assert weight[:2].tolist() == [[0.0, 1.0, 0.0]] * 2
    assert weight[5:].tolist() == [[0.0, 0.0, 1.0]] * 2
    assert weight[3].tolist() == [0.0, 0.5, 0.5]
    assert weight[2, 1] == pytest.approx(weight[4, 2])
    assert 0.5 < weight[2, 1] < 1.0


def test_a_loop_closes_where_it_is_farthest_from_the_root():
    """Both ways round the ring from its node to where they meet are equally long."""
    points = np.array([(0, 0, 0), (4, 0, 0), (4, 4, 0), (3.4, 4.8, 0), (2.6, 5.4, 0)], float)
    ring = np.array([0, 1, 2, 3, 4, 0], np.int32)
    skeleton = Skeleton(
        points, np.full(5, 0.01), np.array([0, 6], np.int32), ring, np.array([0], np.int32)
    )
    bones, _ = bones_of(skeleton)
    ends = [np.flatnonzero(bones.chain == chain)[-1] for chain in (1, 2)]
    np.testing.assert_allclose(bones.tail[ends[0]], bones.tail[ends[1]])
    np.testing.assert_allclose(bones.tail[ends[0]], (4.0, 4.0, 0.0), atol=0.01)
    assert (bones.parent < 0).sum() == 1


def test_a_limb_leaves_to_its_parent_what_it_loses():
    """Towards the rim of a limb its weight fades, and both together stay 1."""
    x = np.linspace(-1.0, 1.0, 41)
    vertices = np.column_stack((x, 0 * x, 0 * x))
    rows = np.arange(40)
    chain = (x > 0.0).astype(np.int64)
    weight = np.column_stack((chain == 0, chain == 1)).astype(float)
    shares = [(0.0, 1.0), (0.0, 1.0)]
    bones = bones_in_a_row((1, 0, 0), -1.0, 0.4, (0, 0, 1), [0, 1], shares, [0, 1])
    edges = np.column_stack((rows, rows + 1)).astype(np.int32)
    _share_with_parents(weight, chain, bones, vertices, edges)
    np.testing.assert_allclose(weight.sum(axis=1), 1.0)
    limb = weight[x > 0.0, 1]
    assert limb[0] < 0.1 and (np.diff(limb) >= 0.0).all() and limb[-1] == 1.0


def test_weights_hold(rigged):
    shape, rig = rigged
    assert rig.bone.shape == rig.weight.shape == (len(shape.points), 4)
    assert (rig.weight >= 0).all() and (rig.weight[:, 0] > 0).all()
    np.testing.assert_allclose(rig.weight.sum(axis=1), 1.0)
    assert set(rig.bone[:, 0]) <= set(range(rig.bones.count))


def limbs_of(rig):
    """(the bones of each limb, the vertices that follow it most)."""
    bones = rig.bones
    mine = bones.chain[rig.bone[:, 0]]
    for chain in np.unique(bones.chain[bones.to_tip]):
        yield np.flatnonzero(bones.chain == chain), mine == chain


def test_a_bent_limb_moves_no_other_one(rigged):
    """Next to the rim of a limb the skin of another one moves by 2 % of the size at most; 1.7 % were measured."""
    shape, rig = rigged
    limbs = list(limbs_of(rig))
    size = np.linalg.norm(np.ptp(shape.points, axis=0))
    for rows, here in limbs:
        for bone in rows:
            along = rig.bones.tail[bone] - rig.bones.head[bone]
            for axis in (np.cross(along, (0.0, 0.0, 1.0)), np.cross(along, (0.3, 1.0, 0.0))):
                moved = posed(rig, shape.points, {bone: turn(axis, np.pi / 3)}) - shape.points
                far = np.linalg.norm(moved, axis=1)
                assert far[here].max() > 0.1 * np.linalg.norm(along)
                for other, there in limbs:
                    if other is not rows and there.any():
                        assert far[there].max() <= 0.02 * size


def test_no_vertex_flies_away(rigged):
    """In twenty poses no edge of the surface grows by more than 7 % of the size; 5.0 % were measured."""
    shape, rig = rigged
    edges = edges_of(shape.triangles)
    size = np.linalg.norm(np.ptp(shape.points, axis=0))
    lengths = lambda points: np.linalg.norm(np.subtract(*points[edges.T]), axis=1)
    for seed in range(20):
        found = posed(rig, shape.points, random_turns(rig.bones, seed))
        assert (lengths(found) - lengths(shape.points)).max() < 0.07 * size


def test_little_skin_folds_in_a_bend(rigged):
    """When one bone turns by 40 degrees, up to 1.0 % of the surface folds; in the mean it is 0.04 % at most."""
    shape, rig = rigged
    across, folded = topology.vector_areas(shape.points, shape.triangles), []
    area = np.linalg.norm(across, axis=1)
    for bone in np.flatnonzero(rig.bones.parent >= 0):
        hinge = np.cross(rig.bones.tail[bone] - rig.bones.head[bone], rig.bones.up[bone])
        follows = (rig.weight * (rig.bone == bone)).sum(axis=1)[shape.triangles].mean(axis=1)
        for angle in np.radians((-40, 40)):
            bend = turn(hinge, angle)
            here = topology.vector_areas(posed(rig, shape.points, {bone: bend}), shape.triangles)
            way = across + follows[:, None] * (across @ bend.T - across)
            turned = (follows > 0.0) & ((way * here).sum(axis=1) < 0.0)
            folded.append(area[turned].sum() / area.sum())
    assert max(folded) < 0.03 and np.mean(folded) < 0.002


# --- files


@pytest.fixture(scope="module")
def two_rings_and_a_y():
    return of_tubes(tubes.y_of_tubes(), 1500), skeleton_of(Shape(*meshes.torus()))


def test_json_has_everything_and_is_read_back(two_rings_and_a_y, tmp_path):
    for found in two_rings_and_a_y:
        path = export_skeleton(found.skeleton, found.parts, tmp_path / "a.json")
        read = json.loads(path.read_text())
        assert [node["position"] for node in read["nodes"]] == found.skeleton.points.tolist()
        assert [node["radius"] for node in read["nodes"]] == found.skeleton.radius.tolist()
        assert read["edges"] == found.skeleton.edges.tolist()
        faces = [face for part in read["parts"] for face in part["faces"]]
        assert sorted(faces) == list(range(len(found.parts.faces)))
        back = load_skeleton(path)
        for name in ("points", "radius", "branch_offsets", "branch_points", "nodes"):
            np.testing.assert_array_equal(getattr(back, name), getattr(found.skeleton, name))


def test_swc_is_a_tree_of_all_points(two_rings_and_a_y, tmp_path):
    for found in two_rings_and_a_y:
        path = export_skeleton(found.skeleton, found.parts, tmp_path / "a.swc")
        table = np.loadtxt(path)
        assert len(table) == len(found.skeleton.points)
        assert (table[:, 6] < table[:, 0]).all() and (table[:, 6] == -1).sum() == 1
        balls = np.column_stack((found.skeleton.points, found.skeleton.radius))
        np.testing.assert_array_equal(np.sort(table[:, 2:6], axis=0), np.sort(balls, axis=0))
        closing = [line for line in path.read_text().splitlines() if "closes a loop" in line]
        assert len(closing) == found.skeleton.loops


def test_command_line(tmp_path, capsys):
    source, target = str(tmp_path / "ring.npz"), str(tmp_path / "ring.json")
    np.savez(source, **dict(zip(("points", "triangles"), meshes.torus())))
    assert main(["skeleton", source, target, "--detail", "0.4"]) == 0
    assert "1 branch, 0 ends, 1 loop" in capsys.readouterr().out
    assert len(json.loads((tmp_path / "ring.json").read_text())["parts"]) == 1
    assert main(["skeleton", source, target, "--loops", "open"]) == 0
    assert "1 branch, 2 ends, 0 loops" in capsys.readouterr().out


def test_command_line_takes_ends(tmp_path, capsys):
    """Two tips of a Y are joined by one branch; other ends are other work; nonsense is refused."""
    solid = tubes.y_of_tubes()
    words = ["skeleton", str(tmp_path / "y.npz"), str(tmp_path / "y.json")]
    points = solid.sample(1500)
    np.savez(words[1], points=points, normals=solid.normals(points))
    ends = [f"--end={','.join(map(str, line[-1]))}" for line in solid.lines[:2]]
    assert main([*words, *ends]) == 0
    assert "1 branch, 2 ends, 0 loops" in capsys.readouterr().out
    assert main(words) == 0
    assert "3 branches, 3 ends, 0 loops" in capsys.readouterr().out
    assert main([*words, ends[0]]) == 3
    for wrong in ("1,2", "a,b,c", "1,2,nan"):
        assert main([*words, "--end", wrong]) == 2
        assert f"Expected X,Y,Z, three finite numbers, found '{wrong}'" in capsys.readouterr().err


@pytest.mark.parametrize(
    "text",
    [
        "no json",
        "{}",
        "[]",
        '{"nodes": [{"position": [0, 0], "radius": 1}], "parts": []}',
        '{"nodes": [{"position": [0, 0, NaN], "radius": 1}], "parts": []}',
        '{"nodes": [{"position": [0, 0, 0], "radius": 1}], "parts": [{"nodes": [0, 1]}]}',
    ],
)
def test_files_that_are_no_skeletons_are_refused(tmp_path, text):
    path = tmp_path / "a.json"
    path.write_text(text)
    with pytest.raises(ReadError, match=r"Expected nodes and parts of a skeleton in 'a\.json'"):
        load_skeleton(path)


# --- parts of it


def test_spread_is_dijkstras():
    rng = np.random.default_rng(0)
    points = rng.normal(size=(300, 3))
    edges = np.unique(np.sort(rng.integers(0, 300, (700, 2)), axis=1), axis=0).astype(np.int32)
    edges = edges[edges[:, 0] != edges[:, 1]]
    seeds = np.array([3, 50, 120])
    label, distance = spread(graph_of(points, edges), seeds, np.arange(3))
    length = np.linalg.norm(np.subtract(*points[edges.T]), axis=1)
    graph = coo_array((length, edges.T), shape=(300, 300)).tocsr()
    away = dijkstra(graph, directed=False, indices=seeds)
    np.testing.assert_allclose(distance, away.min(axis=0))
    there = np.isfinite(distance)
    np.testing.assert_array_equal(label[there], away.argmin(axis=0)[there])
    assert (label[~there] == -1).all()


def test_chains_within_their_tolerance():
    t = np.linspace(0, 6, 300)
    points = np.column_stack((t, np.sin(t), 0 * t))
    kept = kept_points(points, np.full(300, 0.01))
    assert {0, 299} <= set(kept) and len(kept) < 40
    share = np.linspace(0, 1, 500)[:, None, None]
    chain = ((1 - share) * points[kept[:-1]] + share * points[kept[1:]]).reshape(-1, 3)
    assert cKDTree(chain).query(points)[0].max() < 0.0101
    ring = np.column_stack((np.cos(t / 6 * 2 * np.pi), np.sin(t / 6 * 2 * np.pi), 0 * t))
    ring[-1] = ring[0]
    assert len(kept_points(ring, np.full(300, 10.0))) == 4


def net_of(points, wires=None, radius=0.1, load=None):
    """A net of edges, by default those between points that follow each other."""
    row = np.arange(len(points))
    points = np.array(points, float)
    wires = np.array(np.column_stack((row[:-1], row[1:])) if wires is None else wires, np.int32)
    radius = np.broadcast_to(np.asarray(radius, float), len(points))
    load = np.full(len(points), 1 / len(points)) if load is None else np.asarray(load, float)
    return Net(points, radius, wires, np.zeros(0, np.int32), load)


def ladder(middle):
    """A large loop, and a rung whose middle has this radius."""
    points = [(0, 0, 0), (4, 0, 0), (4, 2, 0), (4, 4, 0), (0, 4, 0), (0, 2, 0), (2, 2, 0)]
    wires = [(0, 1), (1, 2), (2, 3), (3, 4), (4, 5), (5, 0), (2, 6), (6, 5)]
    return net_of(points, wires, [0.5] * 6 + [middle])


def test_thin_loops_are_cut_and_others_stay():
    net = ladder(0.01)
    assert clear_loops(net, np.full(7, 0.1)).cut == 1
    assert len(net.branches) == 1 and not net.tips() and net.load.sum() == pytest.approx(1.0)
    net = ladder(0.5)
    loops = clear_loops(net, np.full(7, 0.1))
    assert (loops.cut, loops.filled, len(net.branches)) == (0, 0, 3)


def test_loops_open_at_their_thinnest_edge():
    """Two loops that share a rung are both opened, every point stays, and nothing comes apart."""
    net = ladder(0.01)
    rows = {row for chain in net.branches.values() for row in chain}
    loops, tips = net.loops(), len(net.tips())
    open_loops(net)
    assert loops > 0 and net.loops() == 0 and len(net.tips()) >= tips + 1
    assert {row for chain in net.branches.values() for row in chain} == rows


@pytest.mark.parametrize("apart, limbs", [(0.9, 1), (1.1, 3)])
def test_limbs_that_end_in_one_ball_are_one(apart, limbs):
    """The lighter one goes, and the other one continues the branch; two fingers with room between them stay."""
    points = [(0, 0, 0), (4, 0, 0), (5, -apart / 2, 0), (5, apart / 2, 0)]
    net = net_of(points, [(0, 1), (1, 2), (1, 3)], 1.0, [4, 1, 1, 2])
    join_tips(net)
    assert len(net.branches) == limbs and net.load.sum() == 8.0
    assert limbs > 1 or list(map(sorted, net.branches.values())) == [[0, 1, 3]]


def test_an_end_where_a_limb_forks_once_more():
    """The end is the fork of two leaves that go, and stays a node between the first and the second."""
    wires = [(0, 1), (1, 2), (2, 3), (2, 4)]
    points = [(0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 1, 0), (3, -1, 0)]
    net = net_of(points, wires, load=np.ones(5))
    assert join_ends(net, np.array([0, 2])) == [0]
    assert list(map(sorted, net.branches.values())) == [[0, 1, 2]] and net.load[2] == 3.0


def test_hanging_loops_join_no_ends():
    """A chain from 0 to 3 with a ring on a stalk and a leaf: only the chain is left, and owns all."""
    points = np.column_stack((np.arange(9.0), np.zeros((9, 2))))
    wires = [(0, 1), (1, 2), (2, 3), (1, 4), (4, 5), (5, 6), (6, 4), (2, 7)]
    net = net_of(points, wires, load=np.ones(9))
    assert join_ends(net, np.array([0, 3])) == [0, 3]
    assert sorted(map(sorted, net.branches.values())) == [[0, 1, 2, 3]]
    assert net.load.sum() == 9.0 and net.load[:4].sum() == 8.0


def test_loops_of_closed_faces_stay():
    """The samples of a thin ring are as far apart as it is thick."""
    settings = Settings(sampling=SamplingMode.SURFACE, samples=2_000)
    found = skeleton_of(Shape(*meshes.torus(1.0, 0.04, 160, 24)), settings)
    assert found.chosen.samples.by_faces == (1, 1, 0)
    assert (found.loops.cut, found.loops.filled) == (0, 0)
    assert len(found.skeleton.edges) == len(np.unique(found.skeleton.edges))


def test_pinholes_are_filled():
    """A loop inside one of its own balls, with two limbs."""
    points = [(0, 0, 0), (0.2, 0.1, 0), (0.2, -0.1, 0), (0.4, 0, 0), (3, 0, 0), (-3, 0, 0)]
    wires = [(0, 1), (1, 3), (0, 2), (2, 3), (3, 4), (0, 5)]
    net = net_of(points, wires, [0.6, 0.5, 0.5, 0.6, 0.5, 0.5])
    assert clear_loops(net, np.full(6, 0.1)).filled == 1
    assert len(net.branches) == 1 and len(net.tips()) == 2
    assert net.load.sum() == pytest.approx(1.0)
    (chain,) = net.branches.values()
    assert set(net.stands_for()[[1, 2]]) <= set(chain)


def test_limbs_stay_and_ridges_go():
    points = [(0, 0, 0), (-3, 0, 0), (3, 0, 0), (0, 3, 0), (0, -0.6, 0)]
    wires, load = [(0, 1), (0, 2), (0, 3), (0, 4)], [0.5, 0.15, 0.15, 0.15, 0.05]
    net = net_of(points, wires, [1.0, 0.5, 0.5, 0.5, 0.5], load)
    none = np.zeros(0, np.int64)
    balls = balls_of(none, np.zeros((0, 3)), np.zeros(0), none, 5)
    prune(net, 0.025, balls)
    assert len(net.tips()) == 3 and net.stands_for()[4] == 0 and net.load[0] == pytest.approx(0.55)
    prune(net, 0.4, balls)
    assert len(net.tips()) == 2


@pytest.mark.parametrize(
    "tolerance, kept", [((0.1, 2.0, 0.1), [0, 2]), ((2.0, 0.1, 2.0), [0, 1, 2])]
)
def test_each_point_of_a_chain_has_its_own_tolerance(tolerance, kept):
    points = np.array([(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)])
    assert kept_points(points, np.array(tolerance)).tolist() == kept


def test_an_image_is_as_far_behind_the_plane():
    assert _image(np.array([(1.0, 2.0, 3.0)]), 5.0).tolist() == [[9.0, 2.0, 3.0]]


# --- balls that fit, lines that stay inside


def distance_to_faces(places, shape):
    return distance.to_triangles(places, shape.points[shape.triangles])


@pytest.mark.parametrize(
    "name", ["spot_low.obj", pytest.param("hand_closed.obj", marks=pytest.mark.slow)]
)
def test_radii_are_of_the_ball_that_fits_and_lines_stay_inside(data_file, name):
    shape, _ = read_shape(data_file(name))
    found = skeleton_of(shape, mirror=False).skeleton
    np.testing.assert_allclose(found.radius, distance_to_faces(found.points, shape), rtol=1e-3)
    places, _ = places_of(found, steps=4)
    assert reference.winding_number(places, shape.points, shape.triangles).min() > 0.5


def test_lines_are_in_the_middle_of_a_body(data_file):
    """A ball that touches the surface where it is nearest hardly grows; 15 % had room before."""
    shape, _ = read_shape(data_file("spot_low.obj"))
    places, _ = places_of(skeleton_of(shape).skeleton, steps=3)
    room = distance_to_faces(places, shape)
    way = [
        distance_to_faces(places + step, shape) - distance_to_faces(places - step, shape)
        for step in 1e-3 * np.mean(room) * np.eye(3)
    ]
    way = np.transpose(way) / np.maximum(np.linalg.norm(way, axis=0), 1e-300)[:, None]
    larger = distance_to_faces(places + 0.05 * room[:, None] * way, shape) > 1.049 * room
    assert larger.mean() < 0.05


def to_walls(places):
    """The distance from a bent wall: the solid is between two circles round the origin, of radii 0.9 and 1.1."""
    away = np.linalg.norm(places, axis=1)
    return np.minimum(np.abs(away - 0.9), np.abs(away - 1.1))


def arc(turn, away=1.0):
    """(n, 3) places at angles round the origin."""
    return np.column_stack((away * np.cos(turn), away * np.sin(turn), 0 * turn))


def net_in_wall(points):
    return net_of(points, radius=to_walls(points), load=np.ones(len(points)))


def test_points_move_to_the_middle_between_walls():
    """Points beside the circle between the walls, and jagged: they move onto it; both ends stay."""
    away = 1.0 + 0.03 * np.where(np.arange(61) % 2, 1.0, 0.4)
    net = net_in_wall(arc(np.linspace(0.0, np.pi, 61), away))
    ends = net.points[[0, -1]].copy()
    lead_through_middle(net, to_walls)
    assert np.array_equal(net.points[[0, -1]], ends)
    inner = net.points[1:-1]
    np.testing.assert_allclose(np.linalg.norm(inner, axis=1), 1.0, atol=2e-4)
    np.testing.assert_allclose(net.radius[1:-1], 0.1, atol=2e-4)
    turned = np.abs(np.diff(np.unwrap(np.arctan2(*np.diff(inner[:, :2], axis=0).T))))
    assert turned.max() < 0.2  # half a step of the circle is 0.03, and a tooth before was 0.6


@pytest.mark.parametrize("count", [9, 40])
def test_a_chord_that_leaves_gets_points(count):
    """Points are on the circle between the walls; too few of them cut through the inner one."""
    net = net_of(arc(np.linspace(0.0, np.pi, count)), load=np.ones(count))
    assert keep_inside(net, to_walls) == 0
    chain = net.points[net.branches[0]]
    share = np.linspace(0, 1, 50)[:, None, None]
    away = np.linalg.norm((1 - share) * chain[:-1] + share * chain[1:], axis=2)
    assert away.min() > 0.9 and away.max() < 1.1
    assert count < 40 or len(chain) == count


def test_edges_that_no_ball_mends_are_counted():
    """A way straight through the hollow and one that is inside: the one is told of, the other is not."""
    net = net_in_wall(np.array([(-1.0, 0, 0), (1.0, 0, 0), (1.0, 0.01, 0)]))
    assert keep_inside(net, to_walls) == 1
    assert not skeleton_warnings(Loops(0, 0), 0, 0)
    (sentence,) = skeleton_warnings(Loops(0, 0), 0, 1)
    assert sentence.startswith("1 edges of the skeleton leave the solid")


@pytest.mark.parametrize("way", [1, -1])
def test_a_tip_beyond_a_crease_is_reached_from_an_earlier_point(way):
    """The line runs past the place below its tip, and from its last point only a way through the hollow leads there."""
    turn, high = np.append(np.linspace(0.0, np.pi, 40), 1.7), np.append(np.zeros(40), 0.6)
    points = arc(turn, np.cos(high)) + np.outer(np.sin(high), (0, 0, 1))
    net = net_in_wall(points[::way])
    assert keep_inside(net, to_walls) == 0
    (chain,) = net.branches.values()
    last, before = net.points[chain[::way]][[-1, -2]]
    assert np.array_equal(last, points[-1]) and before[2] == 0.0
    assert np.linalg.norm(last + before) / 2 > 0.9
    assert 20 < len(chain) < 35 and net.load.sum() == 41 and len(net.tips()) == 2


def test_edges_that_stay_inside_are_measured_once():
    asked = []

    def told(places):
        asked.extend(map(tuple, places.tolist()))
        return to_walls(places)

    net = net_in_wall(arc(np.array([0.0, 0.25, 1.4])))  # the second step cuts through the wall
    middle = tuple(net.points[:2].mean(axis=0).tolist())
    assert keep_inside(net, told) == 1
    assert asked.count(middle) == 1


def test_thinning_keeps_the_points_that_a_chord_needs():
    points = arc(np.linspace(0.0, np.pi, 65))
    kept = kept_inside(points, np.full(65, 0.1), np.array([0, 64]), to_walls)
    middles = (points[kept[:-1]] + points[kept[1:]]) / 2
    assert 4 < len(kept) < 65 and np.linalg.norm(middles, axis=1).min() > 0.9
