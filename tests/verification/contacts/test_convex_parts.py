"""Concave meshes as convex parts: a ball lies in a channel, whose hull is full; the cache; what is wrong."""

import json
import sys

import numpy as np
import pytest

from nivel.errors import ModelError
from nivel.extras import is_installed
from nivel.files import convex_parts as dividing
from nivel.files import parse_machine, read_machine, write_machine
from simulating import G, Machine

pytestmark = pytest.mark.covering

if not is_installed("coacd"):
    pytest.skip("coacd is not installed", allow_module_level=True)

# a channel along x, 1 m wide, 0.6 m high outside, with walls and a bottom of 0.2 m
OUTLINE = [(-0.5, 0), (0.5, 0), (0.5, 0.6), (0.3, 0.6), (0.3, 0.2), (-0.3, 0.2), (-0.3, 0.6), (-0.5, 0.6)]
ENDS = [(0, 5, 7), (5, 6, 7), (0, 4, 5), (0, 1, 4), (1, 3, 4), (1, 2, 3)]


def channel():
    """OBJ file of the channel."""
    n = len(OUTLINE)
    vertices = [(x, y, z) for x in (-1.0, 1.0) for y, z in OUTLINE]
    triangles = [(c, b, a) for a, b, c in ENDS] + [(a + n, b + n, c + n) for a, b, c in ENDS]
    for k in range(n):
        j = (k + 1) % n
        triangles += [(k, j, j + n), (k, j + n, k + n)]
    lines = [f"v {x} {y} {z}" for x, y, z in vertices]
    return "\n".join([*lines, *(f"f {a + 1} {b + 1} {c + 1}" for a, b, c in triangles)])


MACHINE = """format: 1
gravity: [0, 0, -9.81]
bodies:
  channel: {mass: 100, inertia: [1, 1, 1], shape: {type: mesh, file: channel.obj, convex_parts: 8}}
  ball: {mass: 2, position: [0.1, 0.05, 0.3], shape: {type: sphere, radius: 10 cm}}
joints: {held: {type: fixed, bodies: [ground, channel], point: [0, 0, 0]}}
forces: {lies: {type: contact, bodies: [ball, channel], stiffness: 1e5, exponent: 1, restitution: 0.3}}
simulation: {integrator: radau, duration: 1 s}
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("channel")
    (folder / "channel.obj").write_text(channel(), encoding="utf-8")
    (folder / "machine.yaml").write_text(MACHINE, encoding="utf-8")
    return folder


@pytest.fixture(autouse=True)
def cache(tmp_path_factory, monkeypatch):
    """A cache of its own, that of the module."""
    place = tmp_path_factory.getbasetemp() / "parts" / "objects"
    place.mkdir(parents=True, exist_ok=True)
    monkeypatch.setattr(dividing, "folder", lambda: place)


def test_a_ball_lies_on_the_bottom_of_a_channel(folder):
    """m g = K δ on the bottom at 0.2 m, to the precision with which parts meet the mesh; inside the hull it would be refused."""
    record = read_machine(folder / "machine.yaml")
    names = [force.name for force in record.forces]
    assert names == [f"lies_{k + 1}" for k in range(len(names))]
    assert 2 <= len(names) <= 8
    r = Machine.from_record(record).simulate()
    height = r.array("ball.position.z")[-1]
    assert height == pytest.approx(0.3 - 2 * G / 1e5, abs=2e-4)
    assert sum(r.array(f"force.{name}.normal_force")[-1] for name in names) == pytest.approx(2 * G, rel=1e-3)
    assert parse_machine(write_machine(record), str(folder / "machine.yaml")) == record
    assert "coacd" not in sys.modules  # gmsh fails where it is loaded


def test_a_mesh_is_divided_once(folder, monkeypatch):
    """The second time the parts are in the cache, and the library is not needed."""
    first = read_machine(folder / "machine.yaml")
    monkeypatch.setitem(sys.modules, "coacd", None)
    assert read_machine(folder / "machine.yaml") == first


def test_what_is_missing_is_said_with_the_command_to_install_it(folder, monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "coacd", None)
    monkeypatch.setattr(dividing, "folder", lambda: tmp_path / "objects")
    with pytest.raises(ModelError, match=r"machine.yaml:4.*convex_parts.*pip install 'nivel\[shapes\]'"):
        read_machine(folder / "machine.yaml")


@pytest.mark.parametrize(
    ("before", "after", "said"),
    [
        ("convex_parts: 8", "convex_parts: 0", "convex_parts"),
        ("convex_parts: 8", "convex_parts: many", "convex_parts"),
        (
            "lies:",
            "lies_1: {type: hand, body: ball}, lies:",
            "`lies_1` is the name of a contact of a convex part of `lies`",
        ),
    ],
)
def test_what_is_wrong_is_said(folder, before, after, said):
    with pytest.raises(ModelError, match=r"machine.yaml:\d") as error:
        parse_machine(MACHINE.replace(before, after), str(folder / "machine.yaml"))
    assert said in str(error.value)


def test_a_contact_elsewhere_needs_the_number_of_the_part(folder):
    """As in a machine of several files, whose contacts do not know the parts."""
    record = read_machine(folder / "machine.yaml")
    force = record.forces[0].replace(parts=None)
    with pytest.raises(ModelError, match="`channel` has `convex_parts`"):
        Machine.from_record(record.replace(forces=(force,))).simulate()
    force = record.forces[0].replace(parts=(1, 40))
    with pytest.raises(ModelError, match="and 40 was asked for"):
        Machine.from_record(record.replace(forces=(force,))).simulate()


def test_a_damaged_cache_is_made_anew(folder):
    first = read_machine(folder / "machine.yaml")
    (file,) = (dividing.folder().parent / "convex-parts").glob("*.json")
    file.write_text("{", encoding="utf-8")
    assert read_machine(folder / "machine.yaml") == first
    assert np.size(json.loads(file.read_text(encoding="utf-8"))) == len(first.body_named["channel"].shape.parts)


def test_a_concave_body_that_touches_with_its_hull_is_a_remark(folder):
    """The channel fills 0.6 · 1 - 0.6 · 0.4 of 0.6 m²; with convex parts, or on a plane, nothing is said."""
    text = MACHINE.replace(", convex_parts: 8", "").replace("0.05, 0.3]", "0.05, 0.8]")
    record = parse_machine(text, str(folder / "machine.yaml"))
    (remark,) = Machine.from_record(record).remarks
    assert (
        "`channel` is concave, and its hull touches, of which it fills 60 %; give the shape `convex_parts: 8`"
        in remark.message
    )
    assert not Machine.from_record(read_machine(folder / "machine.yaml")).remarks
