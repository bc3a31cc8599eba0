"""Beams in files that others use: placed, set from outside, included."""

import numpy as np
import pytest

from nivel.errors import ModelError
from nivel.files import read_machine
from nivel.machine.core.orientation import Orientation, rotation_matrix

PART = """\
format: 1
parameters: {{length: 1 m}}
bodies:
  bob: {{mass: 1, inertia: [1, 1, 1], position: [length/2, 0.2, 0]}}
beams:
  rod:
    from: [0, 0, 0]
    to: [length, 0, 0]
    {line}
    section: {{type: rectangle, width: 2 cm, height: 1 cm}}
    material: {{youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850}}
    stations: {{middle: 0.5}}
    velocity: [0, 0, 1]
    angular_velocity: [0, 2, 0]
joints:
  pin: {{type: revolute, bodies: [ground, rod.start], point: [0, 0, 0], axis: [0, 0, 1]}}
  hang: {{type: universal, bodies: [rod.middle, bob], point: [length/2, 0, 0], axes: [[0, 1, 0], [0, 0, 1]]}}
forces:
  pad: {{type: bushing, bodies: [bob, rod.end], points: [[0, 0, 0], [length, 0, 0]], stiffness: [1, 2, 3, 4, 5, 6]}}
"""
LINES = {
    "straight": "",
    "twisted": "twist: 30 deg",
    "arc": "via: [length/2, 0.2, 0.1]",
    "plane curve": "through: [[length/2, 0.2, 0]]",
    "curve with up": "up: [0, 0, 1]\n    through: [[length/3, 0.2, 0], [length/2, 0.2, 0.2]]",
}
ORIENTATION = "{axis: [1, 2, 0.5], angle: 50 deg}"
TURN = rotation_matrix(Orientation(axis=(1, 2, 0.5), angle=np.radians(50)))
SHIFT = np.array([0.3, -0.2, 1.0])


def read(folder, line, assembly="", **overrides):
    (folder / "part.yaml").write_text(PART.format(line=line), encoding="utf-8")
    main = folder / "main.yaml"
    main.write_text(f"format: 1\nassemblies:\n  left: {{file: part.yaml{assembly}}}\n", encoding="utf-8")
    return read_machine(main, overrides=overrides)


def faults(*given, **overrides):
    with pytest.raises(ModelError) as caught:
        read(*given, **overrides)
    return caught.value.faults


@pytest.mark.parametrize("line", LINES.values(), ids=LINES.keys())
def test_a_placed_beam_is_the_image_of_the_beam(line, tmp_path):
    placing = f", position: [0.3, -0.2, 1], orientation: {ORIENTATION}"
    own, made = (read(tmp_path, line, each).beams[0] for each in ("", placing))
    assert made.name == "left_rod"
    (place, axes), (image, turned) = (each.frames(each.shares) for each in (own, made))
    np.testing.assert_allclose(image, SHIFT + place @ TURN.T, atol=1e-12)
    np.testing.assert_allclose(turned, TURN @ axes, atol=1e-9)
    np.testing.assert_allclose(
        [made.velocity, made.angular_velocity], np.array([[0, 0, 1], [0, 2, 0]]) @ TURN.T, atol=1e-15
    )


def test_what_holds_a_placed_beam_is_placed_with_it(tmp_path):
    machine = read(tmp_path, "", f", position: [0.3, -0.2, 1], orientation: {ORIENTATION}")
    pin, hang = machine.joints
    assert pin.bodies == ("ground", "left_rod.start")
    assert hang.bodies == ("left_rod.middle", "left_bob")
    np.testing.assert_allclose(hang.point, SHIFT + TURN @ [0.5, 0, 0], atol=1e-12)
    (pad,) = machine.forces
    marker = pad.markers[1]
    assert marker.body == "left_rod.end"
    np.testing.assert_allclose(marker.position, 0.0, atol=1e-12)
    np.testing.assert_allclose(rotation_matrix(marker.orientation), np.eye(3), atol=1e-12)


def test_a_beam_cannot_be_mirrored(tmp_path):
    (fault,) = faults(tmp_path, "", ", mirror: x")
    assert (fault.line, fault.path) == (3, "assemblies.left")
    assert "a beam cannot be mirrored" in fault.message


def test_a_curve_in_space_is_turned_with_an_up_only(tmp_path):
    """Its axes are carried along from those at its start, which follow from global Z: no `up` gives the same after the turn."""
    space = "through: [[length/3, 0.2, 0], [length/2, 0.2, 0.2]]"
    (fault,) = faults(tmp_path, space, f", orientation: {ORIENTATION}")
    assert "give the beam an `up`" in fault.message
    about_z = read(tmp_path, space, ", orientation: {axis: [0, 0, 1], angle: 40 deg}").beams[0]
    assert about_z.up is None


def test_a_parameter_that_spoils_a_beam_is_told_with_the_assembly(tmp_path):
    (fault,) = faults(tmp_path, "", ", parameters: {length: 0 m}")
    assert fault.file.endswith("part.yaml")
    assert (fault.line, fault.path) == (8, "beams.rod.to")
    assert "it has no length (in assemblies.left, with the parameters given there)" in fault.message


def test_values_of_beams_are_set_from_outside(tmp_path):
    beam = read(
        tmp_path,
        "",
        **{"beams.left_rod.elements": "20", "beams.left_rod.to": "[3, 0, 0]", "beams.left_rod.stations.tip": "0.9"},
    ).beams[0]
    assert (beam.elements, beam.to, beam.stations["tip"]) == (20, (3.0, 0.0, 0.0), 0.9)


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        ("beams.left_rod.elements", "0", "at least 1"),
        ("beams.left_rod.element", "20", "did you mean `elements`?"),
        ("beams.left_rood.elements", "20", "the name `rood` is not known; did you mean `rod`?"),
        ("beams.left_rod.section.width", "1 kg", "a length (m) was expected"),
    ],
)
def test_what_is_set_in_vain_is_told(path, value, message, tmp_path):
    (fault,) = faults(tmp_path, "", **{path: value})
    assert message in fault.message
    assert "(set from outside the file)" in fault.message


def test_an_included_beam_is_held_by_the_file_that_includes_it(tmp_path):
    read(tmp_path, "")
    main = tmp_path / "main.yaml"
    main.write_text(
        "format: 1\ninclude: part.yaml\njoints:\n  grip: {type: fixed, bodies: [ground, rod.end], point: [1, 0, 0]}\n",
        encoding="utf-8",
    )
    assert [joint.name for joint in read_machine(main).joints][-1] == "grip"
    main.write_text("format: 1\ninclude: {file: part.yaml, only: [beams]}\n", encoding="utf-8")
    assert read_machine(main).beams[0].name == "rod"
    main.write_text("format: 1\ninclude: part.yaml\nbeams:\n  rod: {from: [0, 0, 0]}\n", encoding="utf-8")
    with pytest.raises(ModelError, match="`rod` is defined twice"):
        read_machine(main)
