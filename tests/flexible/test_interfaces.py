"""Interfaces by name, what is refused away from them, shapes of flexible bodies, freedoms that are modes."""

import numpy as np
import pytest

import nivel
from models import bar, reduced
from nivel.errors import ModelError
from nivel.flexible.body.body_file import write_body

MACHINE = """format: 1
gravity: [0, -9.81, 0]
bodies:
  bar: {flexible: {file: bar.nc, modes: 4}, position: [0.5, 0, 0], orientation: {axis: [0, 0, 1], angle: 30 deg}BAR}
  block: {mass: 1, inertia: [1, 1, 1]}
markers:
  tip: {body: bar, TIP}
MARKERS
joints:
  hinge: {type: revolute, bodies: [ground, bar], HINGE, axis: [0, 0, 1]}
  weld: {type: fixed, bodies: [ground, block], point: [0, 0, 0]}
JOINTS
forces:
  push: {type: force, marker: tip, vector: [0, 0, 1]}
FORCES
sensors:
  tip: {marker: tip, quantity: position}
SENSORS
simulation: {integrator: generalised-alpha, duration: 50 ms, step: 1 ms}
"""
GIVEN = {"TIP": "interface: tip", "HINGE": "interface: root"}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("interfaces")
    write_body(reduced(bar(reduction="modes: 4"))[0], folder / "bar.nc")
    return folder


def load(folder, **words):
    text = MACHINE
    for word in ("BAR", "TIP", "MARKERS", "HINGE", "JOINTS", "FORCES", "SENSORS"):
        text = text.replace(word, {**GIVEN, **words}.get(word, ""))
    (folder / "machine.yaml").write_text(text)
    return nivel.load(folder / "machine.yaml")


def test_interfaces_by_name_are_their_places(folder):
    named = load(folder).simulate()
    placed = load(folder, TIP="position: [2, 0, 0]", HINGE="point: [0.5, 0, 0]").simulate()
    np.testing.assert_allclose(named.array("position"), placed.array("position"), atol=1e-13)
    np.testing.assert_allclose(named.array("modal_coordinate"), placed.array("modal_coordinate"), atol=1e-13)
    assert np.abs(named.array("modal_coordinate")).max() > 1e-6
    (marker,) = named.scene["markers"]
    assert marker["position"] == [2.0, 0.0, 0.0]


def test_interfaces_of_assemblies_and_inline_markers(folder):
    load(folder)
    (folder / "whole.yaml").write_text(
        "format: 1\ngravity: [0, -9.81, 0]\nassemblies:\n  arm: {file: machine.yaml, only: [bodies, joints], position: [1, 2, 3]}\n"
        "joints:\n  stop:\n    type: spherical\n"
        "    markers: [{body: ground, position: [3.23205080756888, 3, 3]}, {body: arm_bar, interface: tip}]\n"
        "simulation: {integrator: generalised-alpha, duration: 10 ms, step: 1 ms}\n"
    )
    facts = nivel.load(folder / "whole.yaml").check()
    assert {joint.name: joint.point for joint in facts.joints}["stop"] == pytest.approx((1.5 + np.sqrt(3), 3.0, 3.0))


def test_flexible_bodies_are_not_mirrored(folder):
    load(folder)
    (folder / "whole.yaml").write_text(
        "format: 1\nassemblies:\n  arm: {file: machine.yaml, only: [bodies], mirror: x}\n"
    )
    with pytest.raises(ModelError, match="a flexible body cannot be mirrored"):
        nivel.load(folder / "whole.yaml")


@pytest.mark.parametrize(
    ("words", "faults"),
    [
        ({"MARKERS": "  idle: {body: bar, position: [1 m, 0, 0]}"}, [(8, "markers.idle", r"is at \(1, 0, 0\) m .* `bar`.* tip at \(2")]),
        ({"MARKERS": "  idle: {body: bar, interface: tpi}"}, [(8, "markers.idle", "no interface `tpi`; did you mean `tip`")]),
        ({"MARKERS": "  idle: {body: block, interface: tip}"}, [(8, "markers.idle.interface", "`block` is not flexible")]),
        ({"TIP": "interface: tip, position: [1, 0, 0]"}, [(7, "markers.tip.position", "not both")]),
        ({"HINGE": "interface: rot"}, [(10, "joints.hinge.interface", "no interface `rot`; did you mean `root`")]),
        ({"HINGE": "interface: root, point: [0.5, 0, 0]"}, [(10, "joints.hinge.interface", "not both")]),
        (
            {"JOINTS": "  pin: {type: revolute, bodies: [ground, block], interface: tip, axis: [0, 0, 1]}"},
            [(12, "joints.pin.interface", "neither of the bodies is flexible")],
        ),
        (
            {"JOINTS": "  rod: {type: distance, bodies: [ground, bar], interface: tip}"},
            [(12, "joints.rod", "needs `bodies` and `points`"), (12, "joints.rod.interface", "has no `interface`")],
        ),
        (
            {
                "JOINTS": "  pin: {type: spherical, bodies: [bar, block], point: [0.5, 1, 0]}",
                "FORCES": "  s: {type: spring-damper, bodies: [ground, bar], points: [[0, 1, 0], [0, 1, 1]], stiffness: 1, free_length: 1}",
                "SENSORS": "  far: {distance: [{body: bar, position: [0.3, 0, 0]}, {body: block}]}",
            },
            [(12, "joints.pin", "no interface"), (15, "forces.s", "no interface"), (18, "sensors.far", r"at \(0.3, 0, 0\)")],
        ),
        ({"BAR": ", shape: {type: sphere, radius: 1 cm, centre: [1, 0, 0]}"}, [(4, "bodies.bar.shape", r"at \(1, 0, 0\)")]),
        ({"BAR": ", shape: {type: cylinder, radius: 1 cm, from: [0, 0, 0], to: [1, 0, 0]}"}, [
                (4, "bodies.bar.shape", "drawn from its file"),
                (4, "bodies.bar.position", "follows from"),
                (4, "bodies.bar.orientation", "follows from"),
            ]),
    ],
)  # fmt: skip
def test_what_is_away_is_named_with_its_line(folder, words, faults):
    with pytest.raises(ModelError) as caught:
        load(folder, **words).check()
    import re

    for line, path, message in faults:
        assert any(
            fault.path == path and fault.line == line and re.search(message, fault.message)
            for fault in caught.value.faults
        ), caught.value.faults
    assert len(caught.value.faults) == len(faults)


def test_joint_between_different_places_of_one_name_is_refused(folder):
    pin = "  pin: {type: spherical, bodies: [bar, other], interface: tip}"
    other = "}\n  other: {flexible: bar.nc, position: [0, 0, 1]"
    with pytest.raises(ModelError, match="both bodies have an interface `tip`, at different places"):
        load(folder, BAR=other, JOINTS=pin).check()


def test_sphere_at_an_interface_touches_there(folder):
    """A bar on a hinge that rests with its tip's sphere on a plane: the plane carries what lever and weight ask for."""
    machine = load(
        folder,
        BAR=", shape: {type: sphere, radius: 1 cm, centre: [2, 0, 0]}",
        FORCES=(
            "  floor: {type: contact, body: bar, plane: {body: ground, position: [0, 0.989, 0], axis: [0, 1, 0]}, "
            "stiffness: 1e6, exponent: 1, restitution: 0.3}"
        ),
    )
    result = machine.simulate(duration=2.0, step="1 ms")
    tip = result.array("sensor.tip.y")[-1]
    assert tip == pytest.approx(0.999, abs=2e-4)
    # normal force N at the tip: N · 2 cos 30° = m g · 1 cos 30°
    normal = result.array("joint_force")[-200:, 0, 1].mean()
    weight = 7850 * 0.02 * 0.03 * 2.0 * 9.81
    assert abs(normal) == pytest.approx(weight / 2, rel=0.02)


def test_freedoms_count_modes(folder):
    machine = load(folder)
    facts = machine.check()
    assert (facts.degrees_of_freedom, facts.modes) == (1 + 4, 4)
    assert "5 degrees of freedom, with 4 modes of flexible bodies" in str(facts)
    trust = machine.simulate().trust
    assert (trust.degrees_of_freedom, trust.modes) == (5, 4)
    assert any("5 degrees of freedom, with 4 modes of flexible bodies" in item.text for item in trust.items)
