"""What people bring from other programs, and slips of a first day: each is answered with the right word or the line to write."""

import re

import pytest
import yaml

from nivel.errors import ModelError
from nivel.files import parse_machine, read_machine
from nivel.flexible.model.model_file import read_model
from nivel.words.vocabulary import lines, same, translated

BASE = """\
format: 1
gravity: [0, -9.81, 0]
bodies:
  rod:
    mass: 2 kg
    inertia: [0.1, 0.1, 0.1]
    position: [0.5, 0, 0]
    orientation: {axis: [0, 0, 1], angle: 0}
joints:
  hinge: {type: revolute, bodies: [ground, rod], point: [0, 0, 0], axis: [0, 0, 1]}
forces:
  push: {type: force, body: rod, vector: [1, 0, 0]}
simulation:
  duration: 1 s
  step: 1 ms
  integrator: rk4
"""
RATHER = "did you mean `{}`?"

# what stands there, what is written instead, the line of the fault, and what the answer must hold
MISTAKES = {
    "prismatic": ("type: revolute", "type: prismatic", 10, RATHER.format("translational")),
    "weld": ("type: revolute", "type: weld", 10, RATHER.format("fixed")),
    "ball": ("type: revolute", "type: ball", 10, RATHER.format("spherical")),
    "hooke": ("type: revolute", "type: hooke", 10, RATHER.format("universal")),
    "hinge": ("type: revolute", "type: hinge", 10, RATHER.format("revolute")),
    "capital": ("type: revolute", "type: Revolute", 10, RATHER.format("revolute")),
    "free": ("type: revolute", "type: free", 10, "leave the joint out"),
    "world": ("[ground, rod]", "[world, rod]", 10, RATHER.format("ground")),
    "parent and child": ("bodies: [ground, rod]", "parent: ground, child: rod", 10, "write `bodies: [PARENT, CHILD]`"),
    "one body": ("bodies: [ground, rod]", "bodies: rod", 10, "write `bodies: [ground, rod]`"),
    "origin of a joint": ("point: [0, 0, 0]", "origin: [0, 0, 0]", 10, RATHER.format("point")),
    "a letter as an axis": ("axis: [0, 0, 1]}\nf", "axis: z}\nf", 10, "write `axis: [0, 0, 1]`"),
    "limits": (
        "axis: [0, 0, 1]}\nf",
        "axis: [0, 0, 1], limits: [0, 1]}\nf",
        10,
        "`stops: {lower: -1, upper: 1, stiffness: 1e4, restitution: 0.5}`",
    ),
    "damping": ("axis: [0, 0, 1]}\nf", "axis: [0, 0, 1], damping: 3}\nf", 10, "type: joint-spring-damper"),
    "t_end": ("duration: 1 s", "t_end: 1", 14, RATHER.format("duration")),
    "stop_time": ("duration: 1 s", "stop_time: 1 s", 14, RATHER.format("duration")),
    "dt": ("step: 1 ms", "dt: 1 ms", 15, RATHER.format("step")),
    "solver": ("integrator: rk4", "solver: rk4", 16, RATHER.format("integrator")),
    "RK4": ("integrator: rk4", "integrator: RK4", 16, RATHER.format("rk4")),
    "ode45": ("integrator: rk4", "integrator: ode45", 16, RATHER.format("dopri5")),
    "rtol": ("integrator: rk4", "rtol: 1e-6", 16, RATHER.format("tolerance")),
    "t_end at the top": ("gravity: [0, -9.81, 0]", "t_end: 3", 2, "write `simulation: {duration: 5 s}`"),
    "quaternion": ("{axis: [0, 0, 1], angle: 0}", "{quaternion: [1, 0, 0, 0]}", 8, "`euler_parameters: [W, X, Y, Z]`"),
    "rpy": ("orientation: {axis: [0, 0, 1], angle: 0}", "rpy: [0, 0, 90 deg]", 8, "sequence: zyx}` for roll, pitch"),
    "angles as a list": ("{axis: [0, 0, 1], angle: 0}", "[0, 0, 90 deg]", 8, "{euler: [0, 0, 90 deg], sequence: xyz}`"),
    "decimal comma": ("mass: 2 kg", "mass: 2,5 kg", 5, "write `2.5 kg`"),
    "fixed body": (
        "mass: 2 kg",
        "mass: 2 kg\n    fixed: true",
        6,
        "joints: {base: {type: fixed, bodies: [ground, BODY]",
    ),
    "gravity as a number": ("gravity: [0, -9.81, 0]", "gravity: 9.81", 2, "write `gravity: [0, 0, -9.81]`"),
    "links": ("gravity: [0, -9.81, 0]", "links: {}", 2, RATHER.format("bodies")),
    "units": ("gravity: [0, -9.81, 0]", "units: mm", 2, "SI units"),
    "a list of bodies": (
        "  rod:\n    mass",
        "  - name: rod\n    mass",
        3,
        "write `rod: {…}` in place of `- name: rod`",
    ),
    "comma in a list": ("[1, 0, 0]}\nsim", "[min(time, 2), 0, 0]}\nsim", 12, 'put it in quotes: `"min(time, 2)"`'),
    "comma in a mapping": ("angle: 0}", "angle: max(1, 2)}", 8, 'put it in quotes: `"max(1, 2)"`'),
    "spring": ("type: force", "type: spring", 12, RATHER.format("spring-damper")),
    "a controller": ("type: force", "type: pid", 12, RATHER.format("servo")),
    "gravity as a force": ("type: force", "type: gravity", 12, "`gravity: [0, 0, -9.81]`"),
    "t compared": ("vector: [1, 0, 0]", 'vector: ["if(t > 3, 5, 0)", 0, 0]', 12, "the time is written `time`"),
    "t in a bell": ("vector: [1, 0, 0]", "vector: [exp(-((t - 7)/0.2)^2), 0, 0]", 12, "the time is written `time`"),
    "t for time": ("vector: [1, 0, 0]", "vector: [5 * t, 0, 0]", 12, "the time is written `time`"),
    "unit behind a list": ("[0.5, 0, 0]", "[500, 0, 0] mm", 7, "`[500 mm, 0, 0]`"),
    "numbers without brackets": ("[0.5, 0, 0]", "0.5 0 0", 7, "write `position: [0.5, 0, 0]`"),
    "x, y and z": ("position: [0.5, 0, 0]", "position: {x: 0.5, y: 0, z: 0}", 7, "write `position: [0.5, 0, 0]`"),
    "shape as a word": ("position: [0.5, 0, 0]", "shape: box", 7, "write `shape: {type: box, …}`"),
    "splines": ("gravity: [0, -9.81, 0]", "splines: {}", 2, RATHER.format("functions")),
    "number of steps": ("step: 1 ms", "numberOfSteps: 500", 15, "write `step: 1 ms`"),
    "gravity of the run": ("step: 1 ms", "gravity: [0, 0, -9.81]", 15, "a key of the whole file"),
    "output file": ("step: 1 ms", "output: a.csv", 15, "`nivel export NAME.nc --csv`"),
    "spectral radius": ("step: 1 ms", "spectralRadius: 0.8", 15, "`generalised_alpha: {spectral_radius: 0.8}`"),
    "internal mechanics": (
        "axis: [0, 0, 1]}\nf",
        "axis: [0, 0, 1], internal mechanics: {}}\nf",
        10,
        "joint-spring-damper",
    ),
    "armature": ("axis: [0, 0, 1]}\nf", "axis: [0, 0, 1], armature: 1}\nf", 10, "`rotor_inertia: 0.01 kg*m^2`"),
    "state targets": ("axis: [0, 0, 1]}\nf", "axis: [0, 0, 1], ref: 1}\nf", 10, "`start: {angle: 30 deg}`"),
    "velocity of a joint": (
        "axis: [0, 0, 1]}\nf",
        "axis: [0, 0, 1], start: {position: 1}}\nf",
        10,
        "`angle` of a revolute",
    ),
    "joint of markers i and j": ("bodies: [ground, rod]", "i: a, j: b", 10, "write `bodies: [FIRST, SECOND]`"),
    "tyre": ("type: force", "type: pacejka", 12, "`{type: rolling, …}`"),
    "STEP(TIME, …)": (
        "vector: [1, 0, 0]",
        "vector: ['STEP(TIME, 0, 0, 1, 1)', 0, 0]",
        12,
        "the time is written `time`",
    ),
    "STEP": ("vector: [1, 0, 0]", "vector: ['STEP(time, 0, 0, 1, 1)', 0, 0]", 12, RATHER.format("step")),
    "30d": ("angle: 0}", "angle: 30d}", 8, "degrees are written `30 deg`"),
    "question mark": ("vector: [1, 0, 0]", "vector: ['time > 1 ? 2 : 3', 0, 0]", 12, "write `if(condition, a, b)`"),
    "IMPACT": ("vector: [1, 0, 0]", "vector: ['IMPACT(time, time, 1, 1)', 0, 0]", 12, "`{type: contact, …}`"),
    "AKISPL": (
        "vector: [1, 0, 0]",
        "vector: ['AKISPL(time, 0, load)', 0, 0]",
        12,
        "`functions:` is called by its name",
    ),
    "DX": ("vector: [1, 0, 0]", "vector: ['DX(rod)', 0, 0]", 12, "read by name: `BODY.x`"),
    "index": ("vector: [1, 0, 0]", "vector: ['rod.position[0]', 0, 0]", 12, "components are read by name"),
    "a number as an input": ("gravity: [0, -9.81, 0]", "inputs: {lever: 0.5}", 2, "write `lever: {rest: 0.5}`"),
    "steel": (
        "gravity: [0, -9.81, 0]",
        "beams: {b: {material: steel}}",
        2,
        "write `material: {youngs_modulus: 210 GPa",
    ),
    "a solid in a body": ("position: [0.5, 0, 0]", "from: [0, 0, 0]", 7, "write `shape: {type: cylinder, from"),
    "kind of a body": ("position: [0.5, 0, 0]", "type: point", 7, "`point_mass: true`"),
    "one moment of inertia": ("inertia: [0.1, 0.1, 0.1]", "inertia: 0.1", 6, "write `inertia: [0.1, 0.1, 0.1]`"),
    "axis the other way": ("axis: [0, 0, 1]}\nf", "axis: -y}\nf", 10, "write `axis: [0, -1, 0]`"),
    "start of a hinge": (
        "axis: [0, 0, 1]}\nf",
        "axis: [0, 0, 1], start: 30 deg}\nf",
        10,
        "write `start: {angle: 30 deg}`",
    ),
    "a fixed joint anywhere": (
        "type: revolute, bodies: [ground, rod], point: [0, 0, 0], axis: [0, 0, 1]",
        "type: fixed, bodies: [ground, rod]",
        10,
        "write `bodies: [FIRST, SECOND], point: [0, 0, 0]`",
    ),
    "diameter": ("position: [0.5, 0, 0]", "shape: {type: cylinder, diameter: 1}", 7, "write `radius`, half of it"),
    "axis of a cylinder": (
        "position: [0.5, 0, 0]",
        "shape: {type: cylinder, radius: 1, length: 1, axis: z}",
        7,
        "write `along: z`",
    ),
    "density of steel": ("mass: 2 kg", "density: steel", 5, "the density of steel is `7850 kg/m^3`"),
    "kg/m3": ("mass: 2 kg", "density: 2 kg/m3", 5, "write `m^3`"),
    "actuators": ("gravity: [0, -9.81, 0]", "actuators: {}", 2, "`forces: {motor: {type: motor"),
    "contacts": ("gravity: [0, -9.81, 0]", "contacts: {}", 2, "`forces: {touch: {type: contact"),
    "trajectories": ("gravity: [0, -9.81, 0]", "trajectories: {}", 2, "`functions: {NAME: {points:"),
    "speed of a driver": (
        "gravity: [0, -9.81, 0]",
        "drivers: {d: {coordinate: hinge, value: 10 rad/s}}",
        2,
        "write `(10 rad/s)*time`",
    ),
    "velocity of a driver": (
        "gravity: [0, -9.81, 0]",
        "drivers: {d: {coordinate: hinge, velocity: 10 rad/s}}",
        2,
        "write `speed: 10 rad/s`",
    ),
    "material of a rope": (
        "type: force, body: rod",
        "type: rope, E: 2e11",
        12,
        "write the `stiffness` of the whole rope",
    ),
    "friction without a model": (
        "type: force, body: rod, vector: [1, 0, 0]",
        "type: friction, coordinate: hinge, mu: 0.1",
        12,
        "`model` is missing: one of coulomb, stiction, lugre",
    ),
    "mu": ("type: force, body: rod", "type: friction, coordinate: hinge, mu: 0.1", 12, RATHER.format("coefficient")),
    "torque of a motor": (
        "type: force, body: rod",
        "type: motor, coordinate: hinge, torque: 1",
        12,
        RATHER.format("effort"),
    ),
    "Ns/m": (
        "type: force, body: rod, vector: [1, 0, 0]",
        "type: joint-spring-damper, coordinate: hinge, damping: 3 Ns/m",
        12,
        "write `N*s`",
    ),
    "Nms/rad": (
        "type: force, body: rod, vector: [1, 0, 0]",
        "type: joint-spring-damper, coordinate: hinge, damping: 3 Nms/rad",
        12,
        "write `Nm*s`",
    ),
    "position of a body": ("gravity: [0, -9.81, 0]", "sensors: {s: rod.position.x}", 2, "write `s: {value: rod.x}`"),
    "moments with other names": (
        "inertia: [0.1, 0.1, 0.1]",
        "inertia: [0.1, 0.1, 0.1, 0, 0, 0]",
        6,
        "write `inertia: {xx: 0.1, yy: 0.1, zz: 0.1, xy: 0, xz: 0, yz: 0}`",
    ),
    "moments in parentheses": ("[0.1, 0.1, 0.1]", "(0.1, 0.1, 0.1)", 6, "write `inertia: [0.1, 0.1, 0.1]`"),
    "braces for brackets": ("bodies: [ground, rod]", "bodies: {ground, rod}", 10, "write `bodies: [ground, rod]`"),
    "a place in the plane": ("position: [0.5, 0, 0]", "position: [0.5, 0]", 7, "write `position: [0.5, 0, 0]`"),
    "one component": ("position: [0.5, 0, 0]", "velocity: {x: 1}", 7, "write `velocity: [1, 0, 0]`"),
    "a turn as a number": (
        "orientation: {axis: [0, 0, 1], angle: 0}",
        "orientation: 30 deg",
        8,
        "write `orientation: {axis: [0, 0, 1], angle: 30 deg}`",
    ),
    "gravity of a planet": ("gravity: [0, -9.81, 0]", "gravity: earth", 2, "write `gravity: [0, 0, -9.81]`"),
    "a marker as a point": ("point: [0, 0, 0]", "point: tip", 10, "write `markers: [FIRST, tip]`"),
    "math.sin": ("vector: [1, 0, 0]", "vector: [math.sin(time), 0, 0]", 12, RATHER.format("sin")),
    "a middle dot": ("mass: 2 kg", "mass: 2 kg·m", 5, "multiplied by `*`"),
    "a choice in Python": ("vector: [1, 0, 0]", "vector: [1 if time > 1, 0, 0]", 12, "write `if(condition, a, b)`"),
    "axes of a force": ("type: force", "frame: local, type: force", 12, "write `axes: body`"),
    "a comparison as an event": (
        "gravity: [0, -9.81, 0]",
        "events: {top: {when: hinge.angle > 2 + 1}}",
        2,
        "write `when: hinge.angle - (2 + 1), direction: rising`",
    ),
    "a ratio of teeth": (
        "gravity: [0, -9.81, 0]",
        "couplings: {g: {type: gear, joints: [hinge, hinge], ratio: 2:1}}",
        2,
        "write `2/1`",
    ),
    "no space behind the colon": ("mass: 2 kg", "mass:2 kg", 6, "write line 5 as `mass: 2 kg`"),
    "an equals sign": ("mass: 2 kg", "mass = 2 kg", 6, "write line 5 as `mass: 2 kg`"),
    "two keys in one line": ("duration: 1 s", "duration: 1 s, end: 2", 14, "in braces: `{a: 1, b: 2}`"),
    "start at rest": ("integrator: rk4", "start: static", 16, RATHER.format("equilibrium")),
    "modulus of a beam": (
        "gravity: [0, -9.81, 0]",
        "beams: {b: {E: 2e11}}",
        2,
        "write `material: {youngs_modulus: 210 GPa",
    ),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_a_typical_mistake_is_answered_with_what_to_write(name):
    old, new, line, answer = MISTAKES[name]
    assert BASE.count(old) == 1
    with pytest.raises(ModelError) as caught:
        parse_machine(BASE.replace(old, new), "machine.yaml")
    assert any(fault.line == line and answer in fault.message for fault in caught.value.faults), str(caught.value)


# of a machine that proposed lines are copied into, and what their words stand for there
PLAIN = {
    "format": 1,
    "bodies": {
        "rod": {"mass": 2, "shape": {"type": "sphere", "radius": "5 cm"}},
        "wheel": {"mass": 1, "inertia": [1, 1, 1]},
    },
    "markers": {"floor": {"body": "ground", "axis": [0, 1, 0]}},
    "joints": {
        name: {"type": "revolute", "bodies": ["ground", body], "point": [0, 0, 0], "axis": [0, 0, 1]}
        for name, body in (("hinge", "rod"), ("axle", "wheel"))
    },
}
STANDS_FOR = {
    "BODY": "rod",
    "JOINT": "hinge",
    "COORDINATE": "angle",
    "MARKER": "floor",
    "FIRST": "ground",
    "SECOND": "rod",
}
SECTIONS = "forces|couplings|drivers|joints|functions|simulation|parameters|inputs"
PROPOSED = sorted({line for each in lines() for line in re.findall(rf"`((?:{SECTIONS}): {{[^`…]*)`", each.answer)})


@pytest.mark.parametrize("line", PROPOSED)
def test_every_whole_line_that_is_proposed_can_be_copied_in(line):
    line = line.replace("joints: [FIRST, SECOND]", "joints: [hinge, axle]")
    for word, meant in STANDS_FOR.items():
        line = re.sub(rf"\b{word}\b", meant, line)
    ((section, proposed),) = yaml.safe_load(line).items()
    text = yaml.safe_dump(PLAIN | {section: PLAIN.get(section, {}) | proposed})
    assert parse_machine(text, "machine.yaml").joints


CIRCUIT = """\
format: 1
bodies: {ram: {mass: 3, inertia: [1, 1, 1]}}
joints: {guide: {type: translational, bodies: [ground, ram], point: [0, 0, 0], axis: [0, 0, 1]}}
fluids: {oil: {type: %s}}
hydraulics: {part: {type: %s}}
control: {block: {type: %s}, other: {type: gain, gain: 2, %s}}
inputs: {lever: {%s}}
sensors: {seen: {%s}}
simulation: {%s}
"""
# words of other programs in these places, and the answers
ELSEWHERE = [
    ("isothermal_liquid", RATHER.format("liquid")),
    ("double_acting_cylinder", RATHER.format("cylinder")),
    ("saturation", RATHER.format("limit")),
    ("u: guide.displacement", RATHER.format("input")),
    ("min: -1", "write `range: [MIN, MAX]`"),
    ("type: accelerometer", "a sensor is said by what it measures"),
    ("tspan: 3", "write `duration: 5 s`"),
]


def test_words_of_others_are_answered_in_every_section():
    with pytest.raises(ModelError) as caught:
        parse_machine(CIRCUIT % tuple(word for word, _ in ELSEWHERE), "machine.yaml")
    for word, answer in ELSEWHERE:
        name = word.partition(":")[0]
        assert any(f"`{name}`" in fault.message and answer in fault.message for fault in caught.value.faults), word


@pytest.mark.parametrize(
    ("word", "kind"),
    [
        ("4/3", "directional-valve"),
        ("pressure_relief_valve", "relief-valve"),
        ("fixed displacement pump", "pump"),
        ("throttle", "orifice"),
        ("reservoir", "tank"),
        ("non return valve", "check-valve"),
    ],
)
def test_components_of_hydraulics_are_known_by_their_other_names(word, kind):
    kinds = [
        "volume",
        "tank",
        "orifice",
        "pipe",
        "check-valve",
        "relief-valve",
        "directional-valve",
        "pump",
        "cylinder",
    ]
    assert translated(word, kinds) == RATHER.format(kind)


@pytest.mark.parametrize(
    ("word", "beside", "answer"),
    [
        ("oil", "load-sensing", "`fluids: {oil: {type: liquid, …}}`"),
        ("pressure sensor", "load-sensing", "results by themselves"),
        ("zero order hold", "lead-lag", "`sample_time: 10 ms`"),
        ("mux", "lead-lag", "it is not needed"),
        ("kalman", "lead-lag", "`{type: python, …}`"),
        ("Sine Wave", "signal", "`signal`"),
        ("type", "gamepad", "`control: slider`"),
    ],
)
def test_blocks_and_components_that_do_not_exist_are_answered_with_what_takes_their_place(word, beside, answer):
    assert answer in translated(word, [beside])


def test_the_machine_that_is_spoilt_here_is_right():
    assert parse_machine(BASE, "machine.yaml").name == "machine"


def test_sec_is_a_second():
    assert parse_machine(BASE.replace("1 s\n", "3 sec\n"), "machine.yaml").simulation.duration == 3.0


FILES = {
    "result.nc": (b"\x89HDF\r\n\x1a\n\x00\x00", "`nivel view {}` plays it"),
    "report.html": (b"<!doctype html>\n<title>rod</title>", "a page for a browser"),
    "robot.urdf": (b"<?xml version='1.0'?>\n<robot name='arm'>", "`nivel import {} --out machine.yaml` translates"),
    "bag.mcap": (b"\x89MCAP0\r\n\x01\x00", "a machine reads a signal: `{{csv: {}, column: /TOPIC.FIELD}}`"),
    "log.mf4": (b"MDF     4.10    ", "a recording (MDF)"),
    "log.parquet": (b"PAR1\x15\x04", "`{{csv: {}, column: NAME}}`"),
    "log.mat": (b"MATLAB 5.0 MAT-file, Platform", "`{{csv: {}, column: NAME}}`"),
    "crane.step": (b"ISO-10303-21;\nHEADER;", "`nivel import {} --out machine.yaml` makes bodies of its solids"),
    "part.stl": (b"solid part\nfacet normal 0 0 1\n", "`shape: {{type: mesh, file: {}}}`"),
}


def test_machines_and_models_of_flexible_bodies_are_told_apart(tmp_path):
    model, machine = tmp_path / "blade.yaml", tmp_path / "swing.yaml"
    model.write_text("format: 1\nframe: {}\nreduction: {modes: 3}\n", encoding="utf-8")
    machine.write_text(BASE, encoding="utf-8")
    with pytest.raises(ModelError, match=f"`nivel reduce {model}` makes the body"):
        read_machine(model)
    with pytest.raises(ModelError, match=f"`nivel run {machine}` simulates it"):
        read_model(machine)


@pytest.mark.parametrize("name", FILES)
def test_a_file_of_another_kind_is_recognised(name, tmp_path):
    content, answer = FILES[name]
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(ModelError) as caught:
        read_machine(path)
    assert answer.format(path) in str(caught.value)


def test_words_of_ours_are_never_translated_into_others():
    own = set(same())
    valid = sorted(own)
    assert all(translated(word, valid) in ("", f"did you mean `{word}`?") for word in own)


def test_no_word_is_answered_where_the_answer_is_not_valid():
    assert translated("prismatic", ["mass", "inertia"]) == ""
    assert all(translated(line.words.split(",")[0], []) == "" for line in lines())
