"""Parts that stand in files of their own and are placed, mirrored and named by the machine that uses them."""

import numpy as np
import pytest
from base_machine import LEG, write_files

from nivel.errors import ModelError
from nivel.files import parse_machine, read_machine

PART = """\
format: 1
parameters: {length: 1 m, half: length/2}
bodies:
  rod: {position: [half, 0, 0], mass: 1, inertia: [0.01, 0.02, 0.02]}
markers:
  end: {body: rod, position: [half, 0, 0]}
joints:
  hinge: {type: revolute, bodies: [ground, rod], point: [0, 0, 0], axis: [0, 0, 1]}
forces:
  pull: {type: force, marker: end, vector: [-10*hinge.angle, end.x - 1, 0]}
"""
FORMAT = "format: 1\n"


@pytest.fixture
def read(tmp_path):
    """Reads a machine beside the part `part.yaml`."""
    (tmp_path / "part.yaml").write_text(PART, encoding="utf-8")

    def reader(text, **options):
        return parse_machine(FORMAT + text, str(tmp_path / "main.yaml"), **options)

    reader.folder = tmp_path
    return reader


def by_name(records):
    return {record.name: record for record in records}


def messages(read, text, **options):
    with pytest.raises(ModelError) as caught:
        read(text, **options)
    return [fault.message for fault in caught.value.faults]


def test_one_part_twice_and_joined(read):
    machine = read(
        "assemblies:\n  a: {file: part.yaml}\n  b: {file: part.yaml, position: [1, 0, 0]}\n"
        "joints: {link: {type: spherical, bodies: [a_rod, b_rod], point: [1, 0, 0]}}"
    )
    assert set(by_name(machine.bodies)) == {"a_rod", "b_rod"}
    assert by_name(machine.bodies)["b_rod"].position == (1.5, 0, 0)
    assert by_name(machine.joints)["b_hinge"].bodies == ("ground", "b_rod")
    assert by_name(machine.joints)["b_hinge"].point == (1, 0, 0)
    assert by_name(machine.forces)["b_pull"].marker == "b_end"
    assert by_name(machine.forces)["b_pull"].vector[0].text == "-10.0*b_hinge.angle"


def test_parameters_are_those_of_the_part_unless_given_and_may_use_the_machines(read):
    machine = read(
        "parameters: {length: 7 m, arm: 2 m}\n"
        "assemblies:\n  a: {file: part.yaml}\n  b: {file: part.yaml, parameters: {length: 2*arm}}"
    )
    assert by_name(machine.bodies)["a_rod"].position == (0.5, 0, 0)
    assert by_name(machine.bodies)["b_rod"].position == (2, 0, 0)


@pytest.mark.parametrize("value", ["3", "300 cm", "6 m / 2", "-3*(-1)*1 m"])
def test_any_value_of_a_parameter(read, value):
    machine = read(f"assemblies:\n  a: {{file: part.yaml, parameters: {{length: {value}}}}}")
    assert machine.bodies[0].position == (1.5, 0, 0)


def test_what_is_global_in_an_expression_is_seen_from_the_part(read):
    machine = read(
        "assemblies: {a: {file: part.yaml, position: [5, 0, 0], orientation: {axis: [0, 0, 1], angle: 90 deg}}}"
    )
    first, second, third = machine.forces[0].vector
    values = {"a_hinge.angle": 0.3, "a_end.x": 5.0, "a_end.y": 0.8}  # the part sees its end at x = 0.8
    assert first(0, values) == pytest.approx(-(0.8 - 1))
    assert second(0, values) == pytest.approx(-10 * 0.3)
    assert third == 0


def test_prefixes(read):
    machine = read("assemblies: {a: {file: part.yaml, prefix: left-}}".replace("left-", "left"))
    assert machine.bodies[0].name == "leftrod"
    assert read("assemblies: {a: {file: part.yaml, prefix: ''}}").bodies[0].name == "rod"
    (message,) = messages(read, "assemblies: {a: {file: part.yaml, prefix: left-}}")
    assert "`-` is a minus sign; give a `prefix` without it" in message


def test_only_some_sections(read):
    machine = read("assemblies: {a: {file: part.yaml, only: [bodies, markers]}}")
    assert (len(machine.bodies), len(machine.markers), machine.joints, machine.forces) == (1, 1, (), ())


def test_parts_of_parts(read):
    nested = FORMAT + (
        "assemblies:\n"
        "  one: {file: part.yaml, position: [0, 1, 0], mirror: y}\n"
        "  two: {file: part.yaml, orientation: {axis: [0, 0, 1], angle: 90 deg}, parameters: {length: 2}}\n"
        "joints: {link: {type: spherical, bodies: [one_rod, two_rod], point: [0, 1, 0]}}"
    )
    (read.folder / "nested.yaml").write_text(nested, encoding="utf-8")
    machine = read("assemblies: {left: {file: nested.yaml, position: [0, 0, 1], mirror: x}}")
    assert set(by_name(machine.bodies)) == {"left_one_rod", "left_two_rod"}
    assert by_name(machine.joints)["left_link"].bodies == ("left_one_rod", "left_two_rod")
    assert by_name(machine.bodies)["left_one_rod"].position == (-0.5, 1, 1)
    assert np.allclose(by_name(machine.bodies)["left_two_rod"].position, (0, 1, 1))
    assert by_name(machine.joints)["left_two_hinge"].axis == (0, 0, -1)


def test_values_inside_assemblies_are_set_from_outside(read):
    text = "assemblies:\n  a: {file: part.yaml, position: [0, 0, 0]}\n  ab: {file: part.yaml}"

    def changed(**values):
        return by_name(read(text, overrides={path.replace("__", "."): value for path, value in values.items()}).bodies)

    assert changed(assemblies__a__position__0="2 m")["a_rod"].position == (2.5, 0, 0)
    assert changed(assemblies__ab__parameters__length="4 m")["ab_rod"].position == (2, 0, 0)
    assert changed(assemblies__ab__mirror="x")["ab_rod"].position == (-0.5, 0, 0)
    assert changed(bodies__ab_rod__mass="4 kg")["ab_rod"].mass == 4
    assert changed(bodies__a_rod__velocity="[1, 0, 0]")["a_rod"].velocity == (1, 0, 0)
    with pytest.raises(ModelError) as caught:
        changed(bodies__ab_rodd__mass=3, assemblies__abc__mirror="x", assemblies__a__mirrr="x")
    assert [(fault.path, fault.line, fault.message.partition(" (set")[0]) for fault in caught.value.faults] == [
        ("assemblies.a.mirrr", 0, "the key `mirrr` is not known; did you mean `mirror`?"),
        ("assemblies.abc.mirror", 0, "in `assemblies`, the name `abc` is not known; did you mean `ab`?"),
        ("bodies.ab_rodd.mass", 0, "in `bodies`, the name `rodd` is not known; did you mean `rod`?"),
    ]
    with pytest.raises(ModelError, match="did you mean `mass`"):
        changed(bodies__ab_rod__mas=3)


def test_an_assembly_that_an_included_file_brings(read):
    (read.folder / "more").mkdir()
    (read.folder / "more/arms.yaml").write_text(FORMAT + "assemblies: {a: {file: ../part.yaml}}", encoding="utf-8")
    assert read("include: more/arms.yaml").bodies[0].name == "a_rod"


def test_faults_that_follow_from_the_given_parameters_say_so(tmp_path):
    file = write_files(tmp_path, leg=LEG.replace("mass: 2,", "mass: length*4 kg/m, centre_of_mass: [0, 0, 1 s],"))
    with pytest.raises(ModelError) as caught:
        read_machine(file, allow_code=True, overrides={"assemblies.left.parameters.length": "-1 m"})
    found = {fault.path: fault.message for fault in caught.value.faults}
    assert found["bodies.shank.mass"].endswith("(in assemblies.left, with the parameters given there)")
    assert "given there" not in found["bodies.shank.centre_of_mass.2"]
    assert len(found) == len(caught.value.faults)


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("assemblies: 5", "a mapping from names"),
        ("assemblies: {a: 5}", "a mapping was expected, got `5`"),
        ("assemblies: {a: {file: [1]}}", "the name of a file was expected, got a list"),
        ("assemblies: {a: {file: part.yaml, parameters: 5}}", "a mapping from parameters"),
        ("assemblies: {a: {file: part.yaml, parameters: {length: time}}}", "cannot change with `time`"),
        ("assemblies: {5a: {file: part.yaml}}", "the start of a name"),
        ("assemblies: {a: {file: part.yaml, orientation: {axis: [0, 0, 0], angle: 1}}}", "no direction"),
        ("assemblies: {a: {file: part.yaml, name: b}}", "`name` must not be given"),
        ("parameters: {l: 1 +}\nassemblies: {a: {file: part.yaml, parameters: {length: l}}}", "ends too early"),
    ],
)
def test_faults_of_an_entry(read, text, part):
    (message,) = messages(read, text)
    assert part in message
