"""Models for other programs: machine → file → machine keeps the equations of motion."""

import json
import struct

import numpy as np
import pytest
from click.testing import CliRunner

import nivel
from needing import needs
from nivel.cli import main
from nivel.files import parse_machine
from nivel.files.mesh_file import parse

TREE = """format: 1
gravity: [0.4, 0, -9.81]
bodies:
  base: {position: [0.1, 0.2, 0.3], orientation: {axis: [1, 2, 3], angle: 10 deg}, mass: 3, inertia: {xx: 0.3, yy: 0.4, zz: 0.5, xy: 0.05},
    centre_of_mass: [0.1, 0, 0.2]}
  arm: {position: [0.5, 0, 0.5], mass: 2, inertia: [0.1, 0.2, 0.25], centre_of_mass: [0.2, 0.1, 0],
    shape: {type: box, size: [0.4, 0.1, 0.1], colour: orange}, looks: [{type: cylinder, radius: 0.1, length: 0.3, along: y}]}
  cross: {position: [0.9, 0, 0.5], orientation: {axis: [0, 0, 1], angle: 30 deg}, mass: 1.5, inertia: [0.1, 0.05, 0.12]}
  piston: {position: [1.2, 0.3, 0.5], mass: 0.8, inertia: [0.02, 0.02, 0.03], centre_of_mass: [0, 0.1, 0]}
  nut: {position: [0.5, 0.4, 0.5], mass: 0.6, inertia: [0.01, 0.01, 0.02]}
markers:
  tip: {body: piston, position: [0.1, 0, 0], axis: [0, 1, 0]}
joints:
  slide: {type: translational, bodies: [base, ground], point: [0.1, 0.2, 0.3], axis: [1, 0, 0.5]}
  pivot: {type: revolute, markers: [{body: base, position: [0.3, 0, 0.1], axis: [0, 1, 0.2]}, {body: arm, position: [-0.2, 0, 0],
    axis: [0, 1, 0], x_axis: [1, 0, 0.3]}], rotor_inertia: 0.2}
  cardan: {type: universal, bodies: [arm, cross], point: [0.9, 0, 0.5], axes: [[0, 1, 0], [0, 0, 1]]}
  sleeve: {type: cylindrical, bodies: [cross, piston], point: [1.1, 0.2, 0.5], axis: [1, 1, 0]}
  table: {type: planar, bodies: [arm, nut], point: [0.5, 0.4, 0.5], axis: [0, 1, 0]}
forces:
  damper: {type: joint-spring-damper, coordinate: pivot.angle, damping: 0.3, stiffness: 2, free_value: 0.1}
assembly: {largest_gap: 2 m}
"""
LOOP = """format: 1
gravity: [0, -9.81, 0]
bodies:
  crank: {shape: {type: box, from: [0, 0, 0], to: [0.3, 0.2, 0], width: 4 cm, height: 2 cm}, density: 7850}
  coupler: {shape: {type: box, from: [0.3, 0.2, 0], to: [0.9, 0.3, 0], width: 4 cm, height: 2 cm}, density: 7850}
  rocker: {shape: {type: box, from: [1.1, 0, 0], to: [0.9, 0.3, 0], width: 4 cm, height: 2 cm}, density: 7850}
  wheel: {position: [2, 0, 0], mass: 3, inertia: [0.1, 0.1, 0.2]}
joints:
  a: {type: revolute, bodies: [ground, crank], point: [0, 0, 0], axis: [0, 0, 1]}
  b: {type: revolute, bodies: [crank, coupler], point: [0.3, 0.2, 0], axis: [0, 0, 1]}
  c: {type: revolute, bodies: [coupler, rocker], point: [0.9, 0.3, 0], axis: [0, 0, 1]}
  d: {type: revolute, bodies: [ground, rocker], point: [1.1, 0, 0], axis: [0, 0, 1]}
  e: {type: revolute, bodies: [ground, wheel], point: [2, 0, 0], axis: [0, 0, 1]}
couplings:
  mesh: {type: gear, joints: [a, e], teeth: [20, 30]}
"""


def machine(text):
    return nivel.Machine.from_record(parse_machine(text, "machine.yaml"))


def translated_names(names, joints):
    """Names of coordinates in the translation: joints with several coordinates have become several joints."""
    out = []
    for name in names:
        joint, _, which = name.partition(".")
        several = len([each for each in joints if each == joint]) == 0 or joint in ("cardan", "sleeve", "table")
        kind = "displacement" if which in ("displacement", "x", "y") else "angle"
        out.append(f"{joint}_{which}.{kind}" if several else f"{joint}.{kind}")
    return out


def same_equations(ours, theirs, states, names_of):
    """Mass matrix and bias of two machines at the same coordinates, to 1e-10."""
    one, two = ours.mechanics(), theirs.mechanics()
    # a rotor turns as its coordinate does, and may be the independent one of the two
    known = [name.replace("_rotor", "") for name in two.names]
    order = [known.index(name) for name in names_of([name.replace("_rotor", "") for name in one.names])]
    place = {name: k for k, name in enumerate(one.position_names)}
    back = dict(zip(names_of(one.position_names), one.position_names, strict=True))
    for x, v in states:
        q = one.close(one.start + x[: len(one.start)])
        there = np.array([q[place[back[name.replace("_rotor", "")]]] for name in two.position_names])
        M, bias = one.mass_matrix(q), one.bias(q, v[: len(one.names)])
        speed = np.zeros(len(two.names))
        speed[order] = v[: len(one.names)]
        np.testing.assert_allclose(two.mass_matrix(there)[np.ix_(order, order)], M, atol=1e-10 * np.abs(M).max())
        np.testing.assert_allclose(two.bias(there, speed)[order], bias, atol=1e-10 * np.abs(bias).max())


def states(seed):
    return np.random.default_rng(seed).uniform(-0.5, 0.5, (3, 2, 20))


def test_a_tree_of_all_joints_keeps_its_equations_through_mjcf(tmp_path):
    needs("mujoco")
    ours = machine(TREE)
    ours.export_mjcf(tmp_path / "tree.xml")
    theirs = nivel.import_model(tmp_path / "tree.xml")
    same_equations(
        ours, theirs, states(1), lambda names: translated_names(names, [each.name for each in theirs.record.joints])
    )
    np.testing.assert_allclose(theirs.markers["tip"].position, [0.1, 0, 0], atol=1e-15)
    assert [each.type for each in theirs.bodies["arm"].looks] == ["box", "cylinder"]


def test_a_loop_and_a_gear_keep_their_equations_through_mjcf(tmp_path):
    needs("mujoco")
    ours = machine(LOOP)
    assert any("soft in MuJoCo" in note for note in ours.export_mjcf(tmp_path / "loop.xml"))
    theirs = nivel.import_model(tmp_path / "loop.xml")
    one, two = ours.mechanics(), theirs.mechanics()
    assert len(one.names) == len(two.names) == 1
    # the accelerations of all bodies, whichever coordinate is independent
    for made in (one, two):
        made.found = made.jacobian("wheel", made.start)[5, 0]
    M = [made.mass_matrix()[0, 0] / made.found**2 for made in (one, two)]
    bias = [made.bias()[0] / made.found for made in (one, two)]
    assert M[1] == pytest.approx(M[0], rel=1e-10)
    assert bias[1] == pytest.approx(bias[0], rel=1e-10)


def test_a_tree_keeps_its_equations_through_urdf(tmp_path):
    ours = machine(TREE).replace(forces=(), gravity=(0, 0, -9.81))
    notes = ours.export_urdf(tmp_path / "tree.urdf")
    theirs = nivel.import_model(tmp_path / "tree.urdf")
    assert any("armature of joints: pivot.angle" in note for note in notes)
    plain = machine(TREE.replace(", rotor_inertia: 0.2", "")).replace(forces=(), gravity=(0, 0, -9.81))
    same_equations(
        plain, theirs, states(2), lambda names: translated_names(names, [each.name for each in theirs.record.joints])
    )


def test_what_a_urdf_or_mjcf_cannot_say_is_a_list_or_refused_by_name(tmp_path):
    notes = machine(LOOP).export_urdf(tmp_path / "loop.urdf")
    assert any("joints that close loops: a URDF is a tree: " in note for note in notes)
    assert "joints that close loops" in (tmp_path / "loop.urdf").read_text(encoding="utf-8")
    flat = TREE.replace("type: planar", "type: generic").replace(
        "axis: [0, 1, 0]}\nforces", "axis: [0, 1, 0], locked: [x, y]}\nforces"
    )
    path = tmp_path / "flat.yaml"
    path.write_text(flat, encoding="utf-8")
    done = CliRunner().invoke(main, ["export", str(path), "--mjcf", str(tmp_path / "flat.xml")])
    assert done.exit_code == 2
    assert f"{path}:19:" in done.stderr.replace("\n", "")
    assert "a joint of type generic cannot be written; there are fixed" in " ".join(done.stderr.split())


def test_an_animation_has_the_motion_and_the_shapes_of_the_result(tmp_path):
    ball = LOOP.replace("inertia: [0.1, 0.1, 0.2]}", "inertia: [0.1, 0.1, 0.2], shape: {type: sphere, radius: 0.2}}")
    out = tmp_path / "run.nc"
    result = machine(ball).simulate(duration=0.05, step=1e-3, out=out, verify=False)
    done = CliRunner().invoke(main, ["export", str(out), "--gltf", str(tmp_path / "run.glb")])
    assert done.exit_code == 0, done.stderr
    content = (tmp_path / "run.glb").read_bytes()
    (length,) = struct.unpack_from("<I", content, 12)
    document, data = json.loads(content[20 : 20 + length]), content[28 + length :]
    assert struct.unpack_from("<4sII", content) == (b"glTF", 2, len(content))

    def values(number, width):
        accessor = document["accessors"][number]
        view = document["bufferViews"][accessor["bufferView"]]
        return np.frombuffer(data, "<f4", accessor["count"] * width, view["byteOffset"]).reshape(-1, width)

    (animation,) = document["animations"]
    for channel in animation["channels"]:
        name = document["nodes"][channel["target"]["node"]]["name"]
        sampler = animation["samplers"][channel["sampler"]]
        np.testing.assert_allclose(values(sampler["input"], 1)[:, 0], result.time, atol=1e-6)
        if channel["target"]["path"] == "translation":
            np.testing.assert_allclose(values(sampler["output"], 3), result.array(f"{name}.position"), atol=1e-6)
        else:
            turns = np.roll(values(sampler["output"], 4), 1, axis=1)
            np.testing.assert_allclose(
                np.abs(np.sum(turns * result.array(f"{name}.orientation"), axis=1)), 1.0, atol=1e-6
            )
    # read as a mesh: bars and ball where they are at the start, y up
    vertices, _ = parse(content, "run.glb")
    np.testing.assert_allclose(vertices.max(axis=0)[[0, 1]], [2.2, 0.317], atol=1e-2)
