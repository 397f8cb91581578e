# SPDX-License-Identifier: GPL-3.0-or-later
"""`medial_axis robot` with models of MuJoCo: what may collide in a body gets other geoms, and all else stays."""

import json
import re
from xml.etree import ElementTree

import numpy as np
import pytest
from medial_axis import cli
from medial_axis.core.errors import ReadError
from medial_axis.core.robot.primitive_meshes import ball_mesh, box_mesh, cylinder_mesh
from medial_axis.core.robot.robot_file import read_robot
from scipy.spatial.transform import Rotation
from support.distance import points_on_triangles
from support.meshes import torus, write_obj, write_off
from support.robot_shapes import away

ARM = """<mujoco model="Grün &amp; Söhne"><compiler meshdir="meshes" autolimits="true"/>
  <default>
    <geom friction="0.7"/>
    <default class="seen"><geom type="mesh" contype="0" conaffinity="0"/></default>
    <default class="felt"><geom type="mesh" mesh="ring" pos="0.1 0 0" group="3"/><mesh scale="0.1 0.1 -0.2"/></default>
  </default>
  <asset><mesh class="felt" file="ring.obj"/></asset>
  <worldbody>
    <geom type="plane" size="1 1 1"/>
    <body name="hand" childclass="felt"><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <geom class="seen" mesh="ring"/>
      <geom name="rim &gt; 1" euler="0 90 0" condim="4" mass="1"/><!-- a ring -->
      <geom class="main" type="ellipsoid" size="0.02 0.05 0.1" rgba="1 0 0 1" mass="0.5"/>
      <body name="arm" childclass="main"><joint/>
        <geom type="cylinder" size="0.05" fromto="0 0 0 0.3 0 0.4" contype="2"/>
        <geom size="0.07" type="sphere" contype="2"/>
        <body name="tip"><geom type="sphere" size="0.02" density="0"/>
          <geom density="0" type="capsule" size="0.02 0.1"/></body>
      </body>
    </body>
  </worldbody>
</mujoco>
"""


@pytest.fixture
def arm(tmp_path):
    (tmp_path / "meshes").mkdir()
    write_obj(tmp_path / "meshes" / "ring.obj", torus(1.0, 0.4, 24, 12))
    (tmp_path / "arm.xml").write_text(ARM, encoding="utf-8")
    return tmp_path / "arm.xml"


def run(*words):
    return cli.main(["robot", *map(str, words), "--samples", "1000"])


def test_what_may_collide_is_held_and_all_else_stays(arm, tmp_path, capsys):
    out = tmp_path / "out.xml"
    assert run(arm, out, "--capsules", 2, "--json") == cli.DONE
    said = capsys.readouterr()
    assert [link["count"] for link in json.loads(said.out)["links"]] == [1, 2, 0]
    assert "the inertia of 'arm' comes from the geoms" in said.err
    bodies = {body.get("name"): body for body in ElementTree.parse(out).getroot().iter("body")}
    rng = np.random.default_rng(0)
    for link in read_robot(arm)[0].links[:2]:
        for geom in bodies[link.name].findall("geom[@class]"):
            bodies[link.name].remove(geom)  # it is seen only
        geoms = bodies[link.name].findall("geom")
        places = points_on_triangles(link.points[link.triangles], 3000, rng)
        assert away(bodies[link.name], places).max() <= 1e-9
        named = {"name": "rim > 1", "condim": "4", "mass": "1.5", "pos": "0 0 0", "mesh": ""}
        expected = named if link.name == "hand" else {"contype": "2"}
        # The hand is held best by a capsule without length, which is a sphere.
        kind, place = ("sphere", "pos") if link.name == "hand" else ("capsule", "fromto")
        shape = {"type": kind, place: geoms[0].get(place), "size": geoms[0].get("size")}
        assert geoms[0].attrib == {**expected, **shape}
    pattern = rb'\s*<geom (?!type="(?:plane|sphere)|class="seen)[^>]*/>'
    old, new = (re.sub(pattern, b"", path.read_bytes()) for path in (arm, out))
    assert old == new and new.count(b"<geom") == 3
    assert b'<geom density="0" type="capsule" size="0.02 0.1"/></body>' in out.read_bytes()
    assert run(arm, tmp_path / "balls.mjcf", "--balls", 3) == cli.DONE
    balls = (tmp_path / "balls.mjcf").read_text(encoding="utf-8")
    assert balls.count(' condim="4" mesh="" mass="0.5"') == 3 and balls.count('name="rim') == 1
    assert run(arm, tmp_path / "out.urdf") != cli.DONE and not (tmp_path / "out.urdf").exists()
    assert "format of the input, .xml or .mjcf, found 'out.urdf'" in capsys.readouterr().err


HALF = Rotation.from_rotvec(0.7 * np.pi * np.array([0.6, 0.0, 0.8]))
TO_AXIS = Rotation.from_euler("y", np.arctan2(3, 4))
TURNS = [
    ("", "", Rotation.identity()),
    ("", 'quat="{3} {0} {1} {2}"'.format(*2 * HALF.as_quat()), HALF),
    ("", 'axisangle="0.6 0 0.8 126"', HALF),
    ('angle="radian"', f'axisangle="0.6 0 0.8 {0.7 * np.pi}"', HALF),
    ("", 'euler="10 20 30"', Rotation.from_euler("XYZ", [10, 20, 30], degrees=True)),
    ('eulerseq="ZYX"', 'euler="1 2 3"', Rotation.from_euler("zyx", [1, 2, 3], degrees=True)),
    ("", 'zaxis="3 0 4"', TO_AXIS),
    ("", 'xyaxes="0 2 0 -1 5 0"', Rotation.from_euler("z", 90, degrees=True)),
    ("", 'zaxis="0 0 -1"', Rotation.from_euler("x", 180, degrees=True)),
    ("", 'class="inner"', Rotation.from_euler("x", 30, degrees=True)),
    ("", 'class="turned" zaxis="3 0 4" quat="0 1 0 0"', TO_AXIS),
]


@pytest.mark.parametrize("compiler, words, turn", TURNS)
def test_turns(tmp_path, compiler, words, turn):
    links = of_geom(tmp_path, f'type="box" size="1 2 3" pos="4 5 6" {words}', compiler)
    expected = turn.apply(box_mesh(np.array([2.0, 4.0, 6.0]))[0])
    assert links[0].points - [4, 5, 6] == pytest.approx(expected, abs=1e-12)


def of_geom(tmp_path, words, compiler="", more=""):
    (tmp_path / "a.xml").write_text(
        f'<mujoco><compiler {compiler}/><default><default class="turned"><geom euler="30 0 0"/>'
        f'<default class="inner"/></default><default class="far"><geom fromto="0 0 0 1 1 1"/></default></default>'
        f'<sensor><framepos objtype="body" objname="b"/><framepos objtype="geom" objname="y"/></sensor>{more}'
        f'<worldbody><body name="b"><geom {words}/></body></worldbody></mujoco>'
    )
    return read_robot(tmp_path / "a.xml")[0].links


@pytest.mark.parametrize(
    "words, mesh",
    [
        ('size="2" name="b"', ball_mesh(2.0)),
        ('type="capsule" size="1 3"', ball_mesh(1.0, 3.0)),
        ('type="cylinder" size="1 3 9"', cylinder_mesh(1.0, 6.0)),
        ('type="cylinder" size="1" fromto="0 0 3 0 0 -3"', cylinder_mesh(1.0, 6.0)),
        ('type="box" size="1 9" fromto="0 0 3 0 0 -3"', box_mesh(np.array([2.0, 2.0, 6.0]))),
        ('type="ellipsoid" size="1 1 1"', ball_mesh(1.0)),
    ],
)
def test_geoms(tmp_path, words, mesh):
    (link,) = of_geom(tmp_path, words)
    assert link.points == pytest.approx(mesh[0], abs=1e-12)


def test_a_mesh_is_moved_and_scaled(tmp_path):
    points, triangles = box_mesh(np.array([1.0, 2.0, 3.0]))
    write_off(tmp_path / "m.off", (points, triangles))
    more = '<asset><mesh name="m" file="m.off" scale="1 -2 3" refpos="1 2 3" refquat="1 0 0 1"/></asset>'
    (link,) = of_geom(tmp_path, 'type="mesh" mesh="m"', more=more)
    expected = Rotation.from_euler("z", -90, degrees=True).apply(points - [1, 2, 3]) * [1, -2, 3]
    assert link.points == pytest.approx(expected)
    assert (link.triangles == triangles[:, ::-1]).all()


@pytest.mark.parametrize(
    "words, said",
    [
        ('type="plane" size="1 1 1"', "or mesh, found 'plane'"),
        ('type="box" mesh="m"', "found 'box' round a mesh"),
        ('type="mesh" mesh="m"', "Expected a file of the mesh 'm', found none"),
        ('type="box" size="1 2"', "Expected 3 numbers above 0 as size of <geom>, found '1 2'"),
        ('size="1" zaxis="0 0 0"', "found a length of 0"),
        ('name="y" size="1"', "Expected geoms that nothing names, found 'y' in <framepos>"),
        ('name="x" size="1"', "Expected geoms that nothing names, found 'x' in <pair>"),
        ('class="far"', "Expected fromto of single geoms, found one of a class"),
        ('size="1"/><geom size="1" contype="2"', "geoms of one contype and conaffinity"),
    ],
)
def test_bodies_that_stay(tmp_path, words, said):
    (link,) = of_geom(tmp_path, words, more='<contact><pair geom1="x" geom2="z"/></contact>')
    assert said in link.problem


@pytest.mark.parametrize(
    "words, compiler, more, said",
    [
        ('size="1"', "", '<include file="b.xml"/>', "without <include>, found one; save it"),
        ('size="1"', 'eulerseq="xy"', "", "three of x, y and z as eulerseq, found 'xy'"),
        ('class="no"', "", "", "Expected a default of the class 'no', found none"),
        ('size="1" contype="0" conaffinity="0"', "", "", "geoms that collide, found none"),
    ],
)
def test_models_that_are_refused(tmp_path, words, compiler, more, said):
    with pytest.raises(ReadError, match=said):
        of_geom(tmp_path, words, compiler, more)


def test_mujoco_reads_it(arm, tmp_path):
    mujoco = pytest.importorskip("mujoco")
    assert run(arm, tmp_path / "out.xml") == cli.DONE
    kinds = mujoco.MjModel.from_xml_path(str(tmp_path / "out.xml")).geom_type.tolist()
    assert kinds.count(int(mujoco.mjtGeom.mjGEOM_CAPSULE)) == 3
