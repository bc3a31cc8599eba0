"""A machine file with a bit of everything, to be spoilt by the tests; and one made of several files."""

import pytest

from nivel.errors import ModelError
from nivel.files import read_machine

BASE = """\
format: 1
name: base
description: for the tests
parameters:
  radius: 0.25
  half: radius/2
gravity: [0, -9.81, 0]
bodies:
  crank:
    mass: 21 kg
    centre_of_mass: [1 cm, 0, 0]
    inertia: [0.022, 0.513, 0.526]
    inertia_about: centre-of-mass
    position: [0, 0, -half]
    orientation: {euler: [pi/2, 90 deg, -pi/2], sequence: zxz}
    velocity: [0, 0, 0]
    angular_velocity: [30 rpm, 0, 0]
  rod:
    shape: {type: box, from: [0, 0, 0], to: [1, 0, 0], width: 1 cm, height: 2 cm}
    density: 7850 kg/m^3
  wheel:
    shape:
      type: cylinder
      radius: 10 cm
      length: 2 cm
      along: z
    mass: 3
markers:
  tip:
    body: crank
    position: [radius, 0, 0]
  hub: {body: wheel, axis: [0, 0, 1], x_axis: [1, 0, 0]}
joints:
  hinge: {type: revolute, bodies: [ground, crank], point: [0, 0, 0], axis: [1, 0, 0]}
  pin: {type: spherical, markers: [tip, {body: rod, position: [-0.9, 0, 0]}]}
  knee: {type: universal, bodies: [rod, wheel], point: [1, 0, 0], axes: [[0, 1, 0], [0, 0, 1]]}
forces:
  drive: {type: torque, body: crank, vector: [-50, 0, 0], axes: global}
  push:
    type: force
    marker: tip
    vector:
      - 0
      - 10 + 3*sin(2*pi*time)
      - {times: [0, 1, 2], values: [0, 5, 0]}
    axes: body
simulation:
  duration: 8
  step: 1 ms
  stabilisation: direct
"""

FULL = """\
format: 1
name: full
include: [parts.yaml]
gravity: [0, 0, -9.81]
parameters:
  wide: 20 cm
  stiff: 5 kN/m
bodies:
  frame: {mass: 100 kg, inertia: [5, 5, 5], hold: true}
  disc: {position: [1, 0, 0], mass_properties: disc.json}
  shaft: {position: [1, 0, 0.5], mass: 2, inertia: [0.01, 0.01, 0.01], assembly_weight: 3}
  nut: {position: [2, 0, 0], mass: 1, inertia: [0.01, 0.01, 0.01]}
  slide: {position: [3, 0, 0], mass: 1, inertia: [0.01, 0.01, 0.01]}
  plate: {position: [4, 0, 0], mass: 5, inertia: [0.1, 0.1, 0.2]}
  bob: {position: [0, 3, 0], mass: 0.5 kg, point_mass: true}
markers:
  top: {body: frame, position: [0, 0, 1 m]}
  rim: {body: disc, position: [10 cm, 0, 0], axis: [0, 0, 1]}
  floor: {body: ground, position: [0, 0, -2], axis: [0, 0, 1]}
assemblies:
  left: {file: leg.yaml, position: [0, wide, 0], parameters: {length: 60 cm}}
  right: {file: leg.yaml, position: [0, -wide, 0], mirror: y, orientation: {axis: [0, 0, 1], angle: 10 deg}, prefix: r_}
joints:
  weld: {type: fixed, bodies: [ground, frame], point: [0, 0, 0]}
  hinge: {type: revolute, bodies: [frame, disc], point: [1, 0, 0], axis: [0, 0, 1], start: {angle: 5 deg}, start_rates: {angle: 2 rpm}}
  axle: {type: cylindrical, bodies: [frame, shaft], point: [1, 0, 0.5], axis: [0, 0, 1]}
  spindle: {type: screw, bodies: [frame, nut], point: [2, 0, 0], axis: [1, 0, 0], pitch: 5 mm}
  rail: {type: translational, bodies: [frame, slide], point: [3, 0, 0], axis: [0, 1, 0]}
  table: {type: planar, bodies: [ground, plate], point: [4, 0, 0], axis: [0, 0, 1], x_axis: [1, 0, 0]}
  string: {type: distance, bodies: [ground, bob], points: [[0, 3, 2], [0, 3, 0]], distance: 2 m}
  left_hip: {type: spherical, bodies: [frame, left_thigh], point: [0, wide, 0]}
  right_hip: {type: universal, bodies: [frame, r_thigh], point: [0, -wide, 0], axes: [[1, 0, 0], [0, 1, 0]]}
couplings:
  gears: {type: gear, joints: [hinge, axle.angle], teeth: [20, 40]}
  strap: {type: belt, joints: [hinge.angle, table.angle], radii: [0.1, 20 cm], crossed: true}
  pinion: {type: rack, joints: [hinge, rail], radius: 50 mm}
  mixed: {type: linear, coordinates: [axle.displacement, spindle.angle], factors: [1, -0.05]}
drivers:
  lift: {coordinate: axle.displacement, value: 0.1*sin(2*pi*time)}
  place: {marker: rim, along: x, relative_to: floor, value: {times: [0, 1, 2], values: [1, 1.1, 1], interpolation: cubic}}
forces:
  spring: {type: spring-damper, markers: [top, rim], stiffness: stiff, damping: 10, free_length: 30 cm, preload: 5 N}
  soft:
    type: spring-damper
    bodies: [ground, bob]
    points: [[1, 3, 0], [0, 3, 0]]
    free_length: 1
    table: {deflections: [0, 0.1], forces: [0, 5 N]}
  law: {type: spring-damper, markers: [top, floor], law: 100*length + 2*rate}
  twist: {type: torsional-spring-damper, markers: [top, floor], stiffness: 10, free_angle: 5 deg}
  centre: {type: joint-spring-damper, coordinate: hinge.angle, stiffness: 2, damping: 0.1}
  ends: {type: stop, coordinate: rail, lower: -10 cm, upper: 10 cm, stiffness: 1e5, restitution: 0.5}
  bearing: {type: friction, coordinate: hinge, model: coulomb, coefficient: 0.1, transition_speed: 1 mm/s, radius: 1 cm}
  brush: {type: friction, coordinate: rail, model: lugre, coefficient: 0.2, bristle_stiffness: 1e5, normal_load: 10 N}
  engine: {type: motor, coordinate: hinge.angle, speed: 10 + time, gain: 2, limit: 50 N m}
  brake: {type: motor, coordinate: axle.angle, effort: {python: laws.py, function: brake, arguments: [time, axle.angle_rate, 2 kN]}}
  pair: {type: pair-force, markers: [top, rim], magnitude: {of: length, points: [0, 1], values: [0, 10]}}
  mount: {type: bushing, markers: [top, {body: plate}], stiffness: [1, 1, 1, 2, 2, 2]}
  bump: {type: contact, body: ball, plane: floor, stiffness: 1e6, restitution: 0.7, friction: 0.3, friction_transition_speed: 0.01}
  drag: {type: force, body: slide, vector: [0, -5*rail.displacement_rate, 0]}
sensors:
  tip: {marker: rim, quantity: velocity, relative_to: top}
  turn: {coordinate: hinge, quantity: rate}
  gap: {distance: [top, rim]}
  lean: {angle: [top, rim]}
  pull: {force: spring, quantity: length}
  sum: {value: 2*gap.distance + hinge.angle, units: m}
events:
  far: {when: rail.displacement - 5 cm, direction: rising, stop: true}
  late: {when: 2*time - 1 + left_foot.z}
assembly: {largest_gap: 1 cm}
simulation: {duration: 1, step: 1 ms}
"""

PARTS = """\
format: 1
description: included by the machine
bodies:
  ball: {position: [6, 0, 0], shape: {type: sphere, radius: 5 cm}, mass: 1}
parameters: {spare: 3 m}
"""

LEG = """\
format: 1
name: leg
parameters:
  length: 50 cm
bodies:
  thigh: {shape: {type: box, from: [0, 0, 0], to: [0, 0, -length], width: 4 cm, height: 3 cm}, density: 7850}
  shank: {position: [0, 0, -1.4*length], mass: 2, inertia: {xx: 0.02, yy: 0.03, zz: 0.025, xy: 0.003}}
markers:
  foot: {body: shank, position: [0, 0, -0.1]}
joints:
  knee: {type: revolute, bodies: [thigh, shank], point: [0, 0, -length], axis: [0, 1, 0.2]}
forces:
  bend: {type: joint-spring-damper, coordinate: knee.angle, stiffness: 100, free_value: 10 deg}
  push: {type: force, marker: foot, vector: [10 - 5*foot.x, 2*time, 0]}
events:
  down: {when: foot.z + length, direction: falling}
"""

DISC = '{"mass": "3 kg", "centre_of_mass": [0, 0, 0.01], "inertia": [0.01, 0.01, 0.02]}\n'

LAWS = """\
def brake(time, rate, size):
    return -size * rate
"""

FILES = {"machine.yaml": FULL, "parts.yaml": PARTS, "leg.yaml": LEG, "disc.json": DISC, "laws.py": LAWS}


def write_files(folder, **changed):
    """All files of the full machine in `folder`; `changed`: other texts, by the file's stem. Returns the main file."""
    for name, text in FILES.items():
        (folder / name).write_text(changed.get(name.split(".")[0], text), encoding="utf-8")
    return folder / "machine.yaml"


def faults_of_full(folder, stem, old, new, **options):
    """The faults of the full machine with `new` in place of `old` in one file, and the line where the change begins."""
    (text,) = [text for name, text in FILES.items() if name.split(".")[0] == stem]
    assert text.count(old) == 1, old
    file = write_files(folder, **{stem: text.replace(old, new)})
    with pytest.raises(ModelError) as caught:
        read_machine(file, **{"allow_code": True, **options})
    return caught.value.faults, text[: text.index(old)].count("\n") + 1
