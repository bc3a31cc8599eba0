"""A machine file with a bit of everything, to be spoilt by the tests."""

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
