# SPDX-License-Identifier: GPL-3.0-or-later
"""`medial_axis robot`: links get capsules or balls that hold them, and everything else stays byte for byte."""

import json
import re
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
import test_import_meshes as cubes
from medial_axis import cli
from medial_axis.core.errors import ReadError
from medial_axis.core.machine import native
from medial_axis.core.robot.primitive_meshes import ball_mesh, box_mesh, cylinder_mesh
from medial_axis.core.robot.robot_file import read_robot
from medial_axis.core.robot.xml_spans import elements_of
from medial_axis.core.shape.shape import Shape
from support.distance import points_on_triangles
from support.meshes import torus, write_off
from support.robot_shapes import away, shapes_of
from support.thick_meshes import block

ARM = """<?xml version="1.0" encoding="UTF-8"?>
<!-- an arm of Grün & Söhne -->
<robot name='arm "1"'>
  <link name="base">
    <visual><geometry><mesh filename="base.off"/></geometry></visual>
    <collision name="base > hull"><!-- of a box -->
      <origin xyz="0.1 0 -0.2" rpy="0.3 -0.4 1.2"/>
      <geometry><box size="0.4 0.06 0.05"/></geometry>
    </collision><!-- behind -->
    <inertial><mass value="1e-1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <link name="upper">\r
    <collision>\r
      <geometry><cylinder radius="0.05" length="0.6"/></geometry>\r
    </collision>\r
    <collision><origin xyz="0 0 0.3"/><geometry><sphere radius="0.08"/></geometry></collision>\r
  </link>\r
  <link name="hand"><collision><origin rpy="0 1.5707963267948966 0"/>
    <geometry><mesh filename="package://arm_description/meshes/ring.off" scale="0.1 0.1 -0.2"/></geometry>
  </collision></link>
  <link name="tip"><collision><geometry><sphere radius="0.02"/></geometry></collision></link>
  <link name="frame"/>
  <joint name="j0" type="fixed"><parent link="base"/><child link="upper"/></joint>
  <joint name="j1" type="fixed"><parent link="upper"/><child link="hand"/></joint>
  <joint name="j2" type="fixed"><parent link="hand"/><child link="tip"/></joint>
  <joint name="j3" type="fixed"><parent link="tip"/><child link="frame"/></joint>
</robot>
"""


@pytest.fixture
def arm(tmp_path):
    folder = tmp_path / "arm_description"
    (folder / "meshes").mkdir(parents=True)
    (folder / "urdf").mkdir()
    write_off(folder / "meshes" / "ring.off", torus(1.0, 0.4, 24, 12))
    write_off(folder / "urdf" / "base.off", block(0.4, 0.06, 0.05))
    path = folder / "urdf" / "arm.urdf"
    path.write_bytes(ARM.encode("utf-8"))
    return path


def links_of(path):
    return {link.get("name"): link for link in ElementTree.parse(path).getroot().iter("link")}


def robot(tmp_path, *links):
    """The file of a robot whose links have these geometries."""
    text = "<collision><geometry>{}</geometry></collision>"
    rows = [f"<link name='{'ab'[i]}'>{text.format(link)}</link>" for i, link in enumerate(links)]
    (tmp_path / "a.urdf").write_text(f"<robot>{''.join(rows)}</robot>")
    return tmp_path / "a.urdf"


def run(*words):
    return cli.main(["robot", *map(str, words), "--samples", "1500"])


@pytest.mark.parametrize("words", [("--capsules", "1"), ("--balls", "12")])
def test_every_link_is_held(arm, tmp_path, words, capsys):
    out = tmp_path / "out.urdf"
    assert run(arm, out, *words, "--json") == cli.DONE
    report = json.loads(capsys.readouterr().out)
    links = links_of(out)
    for geometry, told in zip(read_robot(arm)[0].links, report["links"], strict=True):
        if geometry.name == "tip":
            assert told["count"] == 0 and not told["problem"], "a sphere stays"
            continue
        assert 1 <= told["count"] <= int(words[1])
        corners = geometry.points[geometry.triangles]
        places = points_on_triangles(corners, 3000, np.random.default_rng(0))
        assert away(links[geometry.name], places).max() <= 1e-9
        assert told["farthest"] > 0.0 and told["volume"] > 0.0
    assert report["links_left"] == []
    if "--capsules" in words:
        assert report["links"][0]["volume"] == pytest.approx(0.0022, rel=0.05)  # of the least one
        for told in report["links"][:3]:
            _, ends, radius = shapes_of(links[told["name"]])[-1]
            volume = np.pi * radius**2 * (np.linalg.norm(ends[1] - ends[0]) + 4 / 3 * radius)
            assert told["volume"] == pytest.approx(volume, rel=1e-9)


def test_balls_inside_stay_in_their_link(arm, tmp_path):
    out = tmp_path / "out.urdf"
    assert run(arm, out, "--balls", 8, "--mode", "inside") == cli.DONE
    links = links_of(out)
    ways = np.random.default_rng(0).normal(size=(200, 3))
    ways /= np.linalg.norm(ways, axis=1)[:, None]
    for geometry in read_robot(arm)[0].links[:3]:
        balls = shapes_of(links[geometry.name])
        assert 1 <= len(balls) <= 8
        for _, ends, radius in balls:
            places = ends[0] + 0.999 * radius * ways
            with native.own_errors() as module:
                winding = module.winding_number(places, geometry.points, geometry.triangles)
            assert winding.min() > 0.5


def test_everything_else_stays_byte_for_byte(arm, tmp_path):
    out = tmp_path / "out.urdf"
    assert run(arm, out, "--balls", 2) == cli.DONE
    old, new = arm.read_bytes(), out.read_bytes()
    pattern = rb"\s*<collision[^>]*>(?:(?!</collision>)[\s\S])*</collision>"
    # The first collision of a link keeps its name, which holds a >, and the place on its line.
    others = []
    for text, name in ((old, b'name="base > hull"'), (new, b'name="base &gt; hull"')):
        assert b"<collision " + name in text
        others.append(re.sub(pattern, b"", text.replace(name, b"")))
    assert others[0] == others[1]
    assert b'<collision><geometry><sphere radius="0.02"/></geometry></collision></link>' in new
    assert new.count(b"\r\n") == 4 and b"-->\n    <inertial>" in new


def test_a_tolerance_takes_as_few_as_it_needs(arm, tmp_path, capsys):
    words = ("--tolerance", 0.1, "--balls", 16, "--json")
    assert run(arm, tmp_path / "out.urdf", *words) == cli.DONE
    base, upper, hand, _ = json.loads(capsys.readouterr().out)["links"]
    assert max(link["farthest"] for link in (base, upper, hand)) <= 0.1
    assert [link["count"] for link in (base, upper)] == [2, 4] and hand["count"] > 2
    assert run(arm, tmp_path / "two.urdf", "--tolerance", 1e-4, "--balls", 2) == cli.DONE
    said = capsys.readouterr()
    assert "the link 'hand' keeps within" in said.err and "allow more of them" in said.err
    assert "4 links\n  base: 2 balls, volume" in said.out
    assert "tip: spheres or capsules, as it was" in said.out


def test_a_link_that_cannot_be_used_stays_and_is_told(arm, tmp_path, capsys):
    (arm.parent.parent / "meshes" / "ring.off").unlink()
    assert run(arm, tmp_path / "out.urdf", "--balls", 1) == cli.INPUT
    said = "the link 'hand' stays as it was: Expected the file of 'package://"
    assert said in capsys.readouterr().err
    assert b"ring.off" in (tmp_path / "out.urdf").read_bytes()


def test_links_of_equal_geometry_are_covered_once(tmp_path, capsys):
    box = "<box size='2 1 1'/>"
    assert run(robot(tmp_path, box, box), tmp_path / "b.urdf", "--json") == cli.DONE
    one, other = json.loads(capsys.readouterr().out)["links"]
    assert one["seconds"] > 0.0 == other["seconds"] and other["name"] == "b"
    assert {**one, "name": "b", "seconds": 0.0} == other
    assert (tmp_path / "b.urdf").read_text().count("<cylinder") == 2


def test_a_link_may_be_a_dae(tmp_path):
    """It is a metre long by the unit of its file, before the scale of the robot; no axis is turned."""
    asset = "<unit meter='0.01'/><up_axis>Y_UP</up_axis>"
    (tmp_path / "a.dae").write_text(cubes.dae(scene=f"<node>{cubes.MESH}</node>", asset=asset))
    path = robot(tmp_path, "<mesh filename='a.dae' scale='100 200 -300'/>")
    (link,) = read_robot(path)[0].links
    np.testing.assert_allclose(link.points, cubes.POINTS * (1, 2, -3))
    assert Shape(link.points, link.triangles).volume == pytest.approx(6.0)
    assert run(path, tmp_path / "b.urdf") == cli.DONE
    assert away(links_of(tmp_path / "b.urdf")["a"], link.points).max() <= 1e-9


def test_a_link_gives_the_warnings_of_its_solid(tmp_path, capsys):
    points, triangles = block(2, 1, 1)
    write_off(tmp_path / "open.off", (points, triangles[1:]))
    path = robot(tmp_path, "<mesh filename='open.off'/>")
    assert run(path, tmp_path / "b.urdf") == cli.DONE
    assert "the link 'a': the surface is open at 3 edges" in capsys.readouterr().err


@pytest.mark.parametrize(
    "text, said",
    [
        ("<robot><link/></robot>", "Expected links with <collision>, found none"),
        ("<sdf/>", "robot or mujoco, found <sdf>"),
        ("<mujoco/>", "Expected bodies with geoms that collide, found none"),
        ("<robot", "Expected XML, found"),
        ("<robot xmlns:xacro='x'><xacro:arm/></robot>", "expand them with xacro"),
        ("<!DOCTYPE r [<!ENTITY a 'b'>]><robot/>", "Expected no entities"),
    ],
)
def test_what_is_no_robot_is_refused(tmp_path, text, said):
    (tmp_path / "a.urdf").write_text(text)
    with pytest.raises(ReadError, match=said):
        read_robot(tmp_path / "a.urdf")


@pytest.mark.parametrize(
    "geometry, said",
    [
        ("", "Expected a shape in <geometry>"),
        ("<cone/>", "found <cone>"),
        ("<box size='1 1'/>", "Expected 3 numbers above 0 as size of <box>"),
        ("<sphere radius='-1'/>", "Expected 1 number above 0 as radius"),
        ("<mesh filename='a.glb'/>", "ends in"),
    ],
)
def test_geometry_that_cannot_be_read_is_told(tmp_path, geometry, said):
    path = robot(tmp_path, geometry)
    (link,) = read_robot(path)[0].links
    assert said in link.problem
    assert run(path, tmp_path / "b.urdf") == cli.INPUT
    assert not (tmp_path / "b.urdf").exists()


def test_primitives_are_closed_and_hold_the_round_ones():
    for mesh, volume in (
        (box_mesh(np.array([1.0, 2.0, 3.0])), 6.0),
        (cylinder_mesh(0.5, 2.0), 0.5 * np.pi),
        (ball_mesh(0.5), np.pi / 6),
        (ball_mesh(0.5, 1.0), np.pi / 6 + np.pi / 2),
    ):
        shape = Shape(*mesh)
        assert shape.open_edges == 0 and shape.solid_betti == (1, 0, 0)
        assert volume * (1 - 1e-12) <= shape.volume < volume * 1.02


def test_elements_know_their_bytes():
    data = "<a x='>'><b/><c y=\"'>\" >ü</c ><d/></a>".encode()
    root = elements_of(data)
    parts = [data[e.start : e.end].decode() for e in root.children]
    assert parts == ["<b/>", '<c y="\'>" >ü</c >', "<d/>"]
    assert (root.start, root.end) == (0, len(data))


@pytest.mark.parametrize("parser", ["yourdfpy", "mujoco"])
def test_parsers_of_robots_read_them(arm, tmp_path, parser):
    module = pytest.importorskip(parser)
    out = Path(arm).with_name("out.urdf")
    assert run(arm, out) == cli.DONE
    if parser == "mujoco":
        kinds = module.MjModel.from_xml_path(str(out)).geom_type.tolist()
        assert kinds.count(int(module.mjtGeom.mjGEOM_CYLINDER)) == 3
        assert kinds.count(int(module.mjtGeom.mjGEOM_SPHERE)) == 7
        return
    robot = module.URDF.load(str(out), load_meshes=False).robot
    assert [len(link.collisions) for link in robot.links] == [3, 3, 3, 1, 0]
