"""Machine files that people get wrong: each fault is found at its line, with its element and what would be right."""

import pytest
from base_machine import BASE

from nivel.errors import ModelError
from nivel.files import parse_machine


def faults_of(text):
    with pytest.raises(ModelError) as caught:
        parse_machine(text, "machine.yaml")
    return caught.value.faults


def spoilt(old, new):
    """BASE with `new` in place of `old`, and the line where the change begins."""
    assert BASE.count(old) == 1
    return BASE.replace(old, new), BASE[: BASE.index(old)].count("\n") + 1


# what stands there → what is written instead; lines further down than the change; the element; part of the message
FAULTS = {
    "unit of another kind": (
        "mass: 21 kg",
        "mass: 3 m",
        0,
        "bodies.crank.mass",
        "`3 m` is a length (m); a mass (kg) was expected",
    ),
    "unknown unit": ("mass: 21 kg", "mass: 21 kgs", 0, "bodies.crank.mass", "did you mean `kg`"),
    "negative mass": ("mass: 21 kg", "mass: -21", 0, "bodies.crank.mass", "greater than zero was expected, got `-21`"),
    "no number at all": ("mass: 21 kg", "mass:", -1, "bodies.crank", "`mass` is missing"),
    "truth as a number": ("mass: 21 kg", "mass: true", 0, "bodies.crank.mass", "got `true`"),
    "infinite": ("mass: 21 kg", "mass: .inf", 0, "bodies.crank.mass", "too large"),
    "not a number": ("mass: 21 kg", "mass: .nan", 0, "bodies.crank.mass", "not a number"),
    "a list as a number": ("mass: 21 kg", "mass: [21]", 0, "bodies.crank.mass", "got a list"),
    "sixty": ("mass: 21 kg", "mass: 12:30", 0, "bodies.crank.mass", "`:` is not understood"),
    "misspelt key": (
        "mass: 21 kg",
        "mas: 21 kg",
        0,
        "bodies.crank.mas",
        "the key `mas` is not known; did you mean `mass`?",
    ),
    "American spelling": (
        "centre_of_mass:",
        "center_of_mass:",
        0,
        "bodies.crank.center_of_mass",
        "did you mean `centre_of_mass`",
    ),
    "missing key": ("    mass: 21 kg\n", "", -1, "bodies.crank", "`mass` is missing"),
    "misspelt parameter": ("-half]", "-hlf]", 0, "bodies.crank.position.2", "did you mean `half`"),
    "parameter at fault": ("half: radius/2", "half: radius/0", 0, "parameters.half", "division by zero"),
    "ring of parameters": ("radius: 0.25", "radius: 2*half", 0, "parameters.radius", "radius → half → radius"),
    "function as parameter": (
        "  half: radius/2",
        "  half: radius/2\n  sin: 9.81",
        1,
        "parameters.sin",
        "has a meaning",
    ),
    "too short": ("gravity: [0, -9.81, 0]", "gravity: [0, -9.81]", 0, "gravity", "there are only 2"),
    "too long": ("gravity: [0, -9.81, 0]", "gravity: [0, 0, -9.81, 0]", 0, "gravity", "3 entries were expected, got 4"),
    "a number as a vector": (
        "gravity: [0, -9.81, 0]",
        "gravity: 9.81",
        0,
        "gravity",
        "a list was expected, got `9.81`",
    ),
    "impossible inertia": (
        "[0.022, 0.513, 0.526]",
        "[0.022, 0.513, 5.26]",
        0,
        "bodies.crank.inertia",
        "about the body z axis",
    ),
    "infinite mass": ("mass: 21 kg", "mass: .inf", 0, "bodies.crank.mass", "a finite number was expected"),
    "endless name": ("format: 1\n", f"format: 1\nname: {'x' * 101}\n", 1, "name", "at most 100 characters"),
    "two inertias": ("[0.022, 0.513, 0.526]", "[0.022, 0.513]", 0, "bodies.crank.inertia", "a list of 2"),
    "inertia with units of mass": (
        "[0.022, 0.513, 0.526]",
        "[1 kg, 1, 1]",
        0,
        "bodies.crank.inertia.xx",
        "a moment of inertia",
    ),
    "inertia about nothing": (
        "inertia_about: centre-of-mass",
        "inertia_about: center-of-mass",
        0,
        "bodies.crank.inertia_about",
        "did you mean `centre-of-mass`",
    ),
    "capital sequence": ("sequence: zxz", "sequence: ZXZ", 0, "bodies.crank.orientation.sequence", "moving axes"),
    "impossible sequence": ("sequence: zxz", "sequence: zzx", 0, "bodies.crank.orientation.sequence", "is not known"),
    "no sequence": (", sequence: zxz", "", 0, "bodies.crank.orientation", "belong together"),
    "length as an angle": ("90 deg", "90 mm", 0, "bodies.crank.orientation.euler.1", "an angle (rad) was expected"),
    "Hz as angular velocity": ("30 rpm", "3 Hz", 0, "bodies.crank.angular_velocity.0", "write `rev/s`"),
    "velocity twice": (
        "    velocity: [0, 0, 0]",
        "    angular_velocity_body: [0, 0, 0]",
        -7,
        "bodies.crank",
        "not both",
    ),
    "unknown shape": (
        "type: box",
        "type: brick",
        0,
        "bodies.rod.shape",
        "did you mean `box`",
    ),
    "shape without type": ("type: box, ", "", 0, "bodies.rod.shape", "`type` is missing"),
    "half of from and to": (" to: [1, 0, 0],", "", 0, "bodies.rod.shape", "belong together"),
    "no width": (" width: 1 cm,", "", 0, "bodies.rod.shape", "`width` is missing"),
    "density and mass": (
        "    density: 7850 kg/m^3",
        "    density: 7850\n    mass: 1",
        1,
        "bodies.rod.mass",
        "`mass` follows",
    ),
    "key of a nested mapping": (
        "      radius: 10 cm",
        "      radios: 10 cm",
        0,
        "bodies.wheel.shape.radios",
        "did you mean `radius`",
    ),
    "missing in a nested mapping": ("      radius: 10 cm\n", "", -2, "bodies.wheel.shape", "`radius` is missing"),
    "word of a nested mapping": ("along: z", "along: Z", 0, "bodies.wheel.shape.along", "did you mean `z`"),
    "marker on no body": (
        "body: crank\n    position",
        "body: krank\n    position",
        0,
        "markers.tip.body",
        "did you mean `crank`",
    ),
    "parallel axes": ("x_axis: [1, 0, 0]", "x_axis: [0, 0, 2]", 0, "markers.hub.x_axis", "parallel"),
    "zero axis": ("axis: [1, 0, 0]}\n  pin", "axis: [0, 0, 0]}\n  pin", 0, "joints.hinge.axis", "no direction"),
    "no axis": (", axis: [1, 0, 0]}\n  pin", "}\n  pin", 0, "joints.hinge", "`axis` is missing"),
    "misspelt axis": (
        " axis: [1, 0, 0]}\n  pin",
        " axs: [1, 0, 0]}\n  pin",
        0,
        "joints.hinge.axs",
        "did you mean `axis`",
    ),
    "unknown joint": ("type: revolute", "type: revolut", 0, "joints.hinge.type", "did you mean `revolute`"),
    "joint without type": ("type: revolute, ", "", 0, "joints.hinge", "`type` is missing"),
    "joint on no body": ("[ground, crank]", "[ground, cronk]", 0, "joints.hinge.bodies.1", "did you mean `crank`"),
    "joint on itself": ("[ground, crank]", "[crank, crank]", 0, "joints.hinge.bodies", "two different bodies"),
    "joint on one body": ("[ground, crank]", "[crank]", 0, "joints.hinge.bodies", "there is only 1"),
    "unknown marker": (
        "[tip, {",
        "[tap, {",
        0,
        "joints.pin.markers.0",
        "there is no marker `tap`; did you mean `tip`?",
    ),
    "inline marker on no body": (
        "{body: rod, position",
        "{body: rad, position",
        0,
        "joints.pin.markers.1.body",
        "did you mean `rod`",
    ),
    "number as a marker": ("[tip, {", "[5, {", 0, "joints.pin.markers.0", "the name of a marker"),
    "slanted cross": ("[[0, 1, 0], [0, 0, 1]]", "[[0, 1, 0], [0, 1, 1]]", 0, "joints.knee.axes", "45 deg apart"),
    "unknown force": ("type: torque", "type: spring", 0, "forces.drive", "did you mean `spring-damper`?"),
    "force as a torque": ("[-50, 0, 0]", "[-50 N, 0, 0]", 0, "forces.drive.vector.0", "a torque (N*m) was expected"),
    "unknown axes": ("axes: global", "axes: gobal", 0, "forces.drive.axes", "did you mean `global`"),
    "force nowhere": ("    marker: tip\n", "", -2, "forces.push", "needs a `body`"),
    "bad expression": ("3*sin(2*pi*time)", "3*sin(2*pi*t)", 0, "forces.push.vector.1", "is taken of an angle"),
    "unbalanced expression": ("sin(2*pi*time)", "sin(2*pi*time", 0, "forces.push.vector.1", "`)` was expected"),
    "time goes back": (
        "times: [0, 1, 2]",
        "times: [0, 2, 1]",
        0,
        "forces.push.vector.2.times.2",
        "does not come after 2 s",
    ),
    "table too short": (
        "times: [0, 1, 2]",
        "times: [0, 1]",
        0,
        "forces.push.vector.2.values",
        "as many values as times",
    ),
    "time where nothing moves": (
        "duration: 8",
        "duration: 8*time",
        0,
        "simulation.duration",
        "`time` may only be used",
    ),
    "step too long": ("step: 1 ms", "step: 10", -2, "simulation", "longer than `duration`"),
    "unknown method": (
        "stabilisation: direct",
        "stabilisation: projection",
        0,
        "simulation.stabilisation",
        "none, baumgarte, direct",
    ),
    "unknown setting": ("step: 1 ms", "steps: 1 ms", 0, "simulation.steps", "write `step: 1 ms`"),
    "unknown section": ("simulation:", "simulations:", 0, "simulations", "did you mean `simulation`"),
    "key twice": ("    mass: 21 kg", "    mass: 21 kg\n    mass: 3", 1, "bodies.crank.mass", "the first is in line 10"),
    "body twice": ("  wheel:", "  rod:\n    mass: 1\n  wheel:", 0, "bodies.rod", "stands here a second time"),
    "body called ground": (
        "  wheel:",
        "  ground: {mass: 1, shape: {type: sphere, radius: 1}}\n  wheel:",
        0,
        "bodies.ground",
        "fixed world",
    ),
    "name with a dot": ("  tip:\n", "  t.ip:\n", 0, "markers.t.ip", "is not a name"),
    "name given twice": (
        "    mass: 21 kg",
        "    name: other\n    mass: 21 kg",
        0,
        "bodies.crank.name",
        "the name is the key `crank`",
    ),
    "body is a number": ("  wheel:\n", "  disc: 5\n  wheel:\n", 0, "bodies.disc", "a mapping was expected, got `5`"),
    "tag": ("mass: 21 kg", "mass: !!python/name:os.system ''", 0, "bodies.crank.mass", "is not used in machine files"),
    "merge key": ("  wheel:\n", "  wheel:\n    <<: {mass: 2}\n", 1, "bodies.wheel.<<", "the key `<<` is not known"),
    "no format": ("format: 1\n", "", 0, "", "`format: 1` is missing"),
    "format of the future": ("format: 1", "format: 2", 0, "format", "this nivel reads format 1, not `2`"),
    "format in words": ("format: 1", "format: one", 0, "format", "not `one`"),
    "name with a slash": ("name: base", "name: a/b", 0, "name", "name of a result file"),
    "number as a text": (
        "description: for the tests",
        "description: 5",
        0,
        "description",
        "a text was expected, got `5`",
    ),
    "tab": ("    mass: 21 kg", "\tmass: 21 kg", 0, "", "indent with spaces, not tabs"),
    "open bracket": ("gravity: [0, -9.81, 0]", "gravity: [0, -9.81, 0", 1, "", "this is not YAML"),
    "unknown alias": ("mass: 21 kg", "mass: *heavy", 0, "", "the alias `*heavy` has no anchor"),
    "two documents": ("joints:", "---\njoints:", 0, "", "another document"),
}


@pytest.mark.parametrize("change", FAULTS.values(), ids=FAULTS.keys())
def test_the_fault_is_found_where_it_stands(change):
    old, new, further, element, part = change
    text, line = spoilt(old, new)
    faults = faults_of(text)
    found = [fault for fault in faults if part in fault.message]
    assert found, faults
    assert [(fault.line, fault.path) for fault in found] == [(line + further, element)]
    assert found[0].file == "machine.yaml"


CASCADES = {
    "ring of parameters",
    "parameter at fault",
    "misspelt key",
    "missing key",
    "unknown shape",
    "body is a number",
    "bad expression",
}


@pytest.mark.parametrize("name", sorted(CASCADES))
def test_one_mistake_gives_one_fault(name):
    old, new, *_ = FAULTS[name]
    extra = 1 if name == "misspelt key" else 0  # the unknown key, and the one that is missing now
    assert len(faults_of(spoilt(old, new)[0])) <= 1 + extra


def test_there_are_enough_of_them():
    assert len(FAULTS) >= 40


def test_the_column_is_that_of_the_value_or_of_the_unknown_key():
    (fault,) = faults_of(spoilt("[-50, 0, 0]", "[-50, 0, 3 m]")[0])
    assert fault.column == BASE.splitlines()[fault.line - 1].index("0, 0]") + len("0, ") + 1
    (fault,) = faults_of(spoilt(" axes: global", " axs: global")[0])
    assert fault.column == BASE.splitlines()[fault.line - 1].index("axes") + 1


def test_all_faults_of_a_file_come_at_once_in_the_order_of_the_file():
    text = (
        BASE.replace("21 kg", "21 m").replace("zxz", "zzz").replace("[tip,", "[tap,").replace("step: 1 ms", "step: 1 m")
    )
    faults = faults_of(text.replace("radius: 0.25", "radius: 0.25 +").replace("type: torque", "type: twist"))
    assert [fault.path for fault in faults] == [
        "parameters.radius",
        "bodies.crank.mass",
        "bodies.crank.orientation.sequence",
        "joints.pin.markers.0",
        "forces.drive",
        "simulation.step",
    ]
    assert [fault.line for fault in faults] == sorted(fault.line for fault in faults)


def test_all_that_does_not_go_together_in_the_settings_comes_at_once():
    settings = """simulation:
  integrator: rk4
  duration: 1e-13
  output_interval: 1e-5
  baumgarte: {alpha: 1, beta: 1}
  penalty: {factor: 10, alpha: 3}"""
    text, _ = spoilt("simulation:\n  duration: 8", settings)
    words = ("`duration` 1e-13", "`step` 0.001", "`output_interval` 1e-05", "`baumgarte` needs", "`penalty` takes")
    told = [fault.message for fault in faults_of(text)]
    assert sorted(told) == sorted(message for word in words for message in told if message.startswith(word))
    assert len(told) == len(words)


def test_a_format_in_words_does_not_hide_the_rest():
    text, _ = spoilt("format: 1", "format: one")
    assert [fault.path for fault in faults_of(text.replace("mass: 21 kg", "mass: -21"))] == [
        "format",
        "bodies.crank.mass",
    ]


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("", "the file is empty"),
        ("# only a comment\n", "the file is empty"),
        ("5", "a machine file is a mapping"),
        ("- a\n- b\n", "a machine file is a mapping"),
        ("format: 1", "a machine needs at least one body"),
        ("format: 1\nbodies:", "a machine needs at least one body"),
        ("format: 1\nbodies: [a, b]", "a mapping from names"),
        ("format: 1\nbodies: 5", "a mapping from names"),
        ("format: 1\nparameters: 5\nbodies: {}", "a mapping from names"),
        ("format: true\nbodies: {}", "this nivel reads format 1"),
        ("format: 1\n? [a, b]\n: 5", "a key must be a single word"),
        ("format: 1\nbodies: &a\n  crank: *a", "leads back to itself"),
        ("[" * 900, "nested too deeply"),
        ("[" * 100_000, "nested too deeply"),
        ("{a: " * 100_000, "nested too deeply"),
        ("- " * 100_000, "nested too deeply"),
        ("\0", "this is not YAML"),
        ("a\ud800", "this is not YAML"),
        ("format: 1\nbodies: {a: &x [[[1]]], b: [*x, *x]}", "a mapping was expected"),
    ],
)
def test_what_is_hardly_a_machine_file(text, part):
    assert any(part in fault.message for fault in faults_of(text))


def test_aliases_of_aliases_have_an_end():
    lines = ["format: 1", "a0: &a0 [1]", *(f"a{i}: &a{i} [*a{i - 1}]" for i in range(1, 3000))]
    assert "nested too deeply" in faults_of("\n".join(lines))[0].message


def test_aliases_that_grow_without_end_are_stopped():
    lines = ["format: 1", "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]"]
    lines += [f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 10)}]" for i in range(1, 12)]
    assert "200000 values" in faults_of("\n".join(lines))[0].message
