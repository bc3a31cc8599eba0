"""Lines to write for words of other programs that no single word of ours stands for."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final, NamedTuple


class Line(NamedTuple):
    """What to write for a word, where the words of `beside` are valid."""

    words: str
    beside: str
    answer: str


# words of ours, beside them words of others, and below these what to write
TABLE: Final = """
start_speed
  velocity, rate, omega
    write `speed: 10 rad/s`, or `speed: 10 cm/s` of a displacement
teeth
  efficiency, eta, loss, losses, friction
    write under `forces`: `loss: {type: transmission-loss, coupling: NAME, coordinate: JOINT.angle, efficiency: 0.95}`
  backlash, play, stiffness, damping
    an elastic pair of wheels is a force: write under `forces` in place of this coupling `mesh: {type: shaft, coordinate:
    JOINT.angle, against: JOINT.angle, ratio: -2, stiffness: 1e5, backlash: 0.2 deg}`
length, speed
  youngs modulus, e, diameter, d, area, material, section, ea
    write the `stiffness` of the whole rope, E·A/length, e.g. `stiffness: 200 kN/m`
  winch, speed profile, rate, payout, velocity
    a winch pays rope out by its speed: write `speed: -0.3 m/s`
  from, to, start, end
    write `bodies: [FIRST, SECOND], points: [[0, 0, 0], [0, 0, -5]]`
colour, along
  axis, direction, orientation
    write `along: z`, the body axis on which it lies
colour, from
  start, end, p1, p2, ends, points, start point, end point
    write `from: [0, 0, 0], to: [1, 0, 0]`
colour, radius
  diameter, d, dia
    write `radius`, half of it
colour, centre
  material
    write `density: 7850 kg/m^3`, of the body beside its `shape`
  density, rho, mass
    write `density` or `mass` of the body, beside its `shape`
  position, pos, origin, location
    write `position` of the body, or `centre` in the body frame
point_mass
  type, kind
    write `shape: {type: cylinder, radius: 2 cm, length: 10 cm}`, or `point_mass: true`
  from, to, length, radius, size, width, height, start, end, diameter
    a solid is a `shape`: write `shape: {type: cylinder, from: [0, 0, 0], to: [1, 0, 0], radius: 1 cm}`
tracking_time
  output, out, result
    what a block gives is read by its name: write `effort: NAME.value` in a motor
  coordinate, joint
    write `measured: JOINT.angle`; a motor applies it: `effort: NAME.value`
gravity
  contacts, contact, collisions, impacts
    a contact is a force: `forces: {touch: {type: contact, body: BODY, plane: MARKER, stiffness: 1e6, restitution: 0.5}}`
  motors, motor, actuators, actuator, drives
    an effort is a force: `forces: {motor: {type: motor, coordinate: JOINT.COORDINATE, effort: 5}}`; a prescribed motion a
    driver: `drivers: {drive: {coordinate: JOINT.COORDINATE, value: 0.5*time}}`
  time
    write `simulation: {duration: 5 s, step: 1 ms}`
  trajectories, trajectory, paths, path, profiles
    a curve is a function, called as `NAME(time)`: `functions: {NAME: {points: [0, 1, 2], values: [0, 0.5, 0],
    interpolation: cubic}}`
  mechanism configuration, mechanism
    gravity and the run are keys of the file: `gravity: [0, 0, -9.81]`, `simulation: {duration: 5 s, step: 1 ms}`
largest_step
  steps, number of steps, nsteps, n steps, n
    the length of a step is given, not their number: write `step: 1 ms`
  output, output file, results, result, save, file, csv
    every run stores all results in `NAME.nc`; `nivel export NAME.nc --csv` writes tables
  gravity, g
    gravity is a key of the whole file: `gravity: [0, 0, -9.81]`
  spectral radius, rho inf, rho
    write `generalised_alpha: {spectral_radius: 0.8}`
rim_radius
  internal mechanics, spring stiffness, damping coefficient
    springs and dampers of a joint are a force: `forces: {coil: {type: joint-spring-damper, coordinate: JOINT.COORDINATE,
    stiffness: 10, damping: 0.1, free_value: 0}}`
  armature, rotor inertia
    write `rotor_inertia: 0.01 kg*m^2` at the joint, the value at its coordinate
  frictionloss, friction loss, joint friction, coulomb friction, dynamics
    friction of a joint is its key `friction: 2 N m`, of a `displacement` in N; by a coefficient and the load it is
    `friction: {coefficient: 0.2, radius: 1 cm}`, of a `displacement` without `radius`
  state targets, ref, initial, initial angle, springref, qpos0, qpos, position target
    write `start: {angle: 30 deg}` of a revolute, `start: {displacement: 10 cm}` of a translational joint
  angle, displacement, position target
    write `start: {angle: 30 deg}`, or `start: {displacement: 10 cm}`
angle_1
  position, velocity, value, theta, q, rate, speed, omega, w
    write the name of a joint coordinate: `angle` of a revolute, `displacement` of a translational joint
interpolation
  expression, function, formula, f, equation
    a function of arguments is written in one line: `functions: {NAME(x): 2*x + 1}`
spring-damper
  tire, magic formula, pacejka, tmeasy
    a tyre is `{type: tyre, wheel: MARKER, plane: MARKER, radius: 0.3, width: 0.2, nominal_load: 4e3}`; a wheel that does
    not slip is a joint, `{type: rolling, …}`
  aerodynamic, aero, drag, lift, wind, magnetic, user, user force, custom, electrostatic, sfosub
    a force of your own is `{type: force, body: BODY, vector: [-5*BODY.vx, 0, 0]}`, or the `law` of a spring
  gravity, weight
    gravity is a key of the whole file: `gravity: [0, 0, -9.81]`
plane
  body 1, body 2, body a, body b, mobile
    write `bodies: [FIRST, SECOND]`, or `body` and `plane`
stiffness
  between, body 1, body 2, body a, body b, from, to, i, j, attach 1, attach 2, point 1, point 2, site 1, site 2
    write `bodies: [FIRST, SECOND], points: [[0, 0, 0], [1, 0, 0]]`
shear_centre
  e, g, youngs modulus, elastic modulus, young, nu, poisson, poisson ratio, rho, density, modulus, shear modulus
    write `material: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3}`
  a, area, iyy, izz, ix, iy, iz, i, j, ip, inertia, radius, diameter, width, height, profile, cross section, geometry
    write `section: {type: circle, radius: 1 cm}`; sections are circle, tube, rectangle and others
  length, l
    a beam lies between two points: write `from: [0, 0, 0], to: [1, 0, 0]`
  nodes, n elements, number of elements, segments, mesh, n
    write `elements: 8`
sequence
  body, bodies
    motion is measured at a marker: write `{marker: MARKER, quantity: position}`
  joint force, joint torque, reaction
    reactions are results by themselves: `JOINT.force`, `JOINT.torque`
  measure, expression, function, measurement
    write `{value: hinge.angle, units: rad}`
load-sensing
  fluid, oil, medium, liquid
    a fluid stands in a section of its own: `fluids: {oil: {type: liquid, …}}`
  filter, strainer, cooler, heat exchanger
    write `{type: orifice, …}`, which has a pressure drop
  sensor, pressure sensor, flow sensor, flow meter, manometer, gauge
    pressures and flows are results by themselves: `NODE.pressure`, `COMPONENT.flow`
lead-lag
  mux, demux, bus, bus selector, subsystem, terminator, goto, from, scope, display, to workspace, outport, out
    it is not needed: a block names the signals that it reads, and each output is a result
  zero order hold, zoh, sample and hold, rate transition, memory, unit delay
    a block is sampled by `sample_time: 10 ms`; a delay by samples is `{type: delay, …}`
  kalman, kalman filter, observer, mpc, matlab function, s function, fcn, c, c function, script, quantizer, backlash
    a block of your own is `{type: python, …}`; a short formula is a signal: `{type: signal, …}`
gamepad
  type, kind
    an input is a number; `control: slider` or `control: button` is how it is shown
markers
  parent, child
    write `bodies: [PARENT, CHILD]`, first and second body of the joint
  between, body 1, body 2, body a, body b, from, to, base, follower, i, j, first, second, body i, body j
    write `bodies: [FIRST, SECOND]`
  limits, limit, range, lower, upper, min, max
    limits of a joint are a force: `forces: {limit: {type: stop, coordinate: JOINT.COORDINATE, lower: -1, upper: 1,
    stiffness: 1e4, restitution: 0.5}}`
x_axis
  damping, stiffness, spring, damper
    a spring or damper in a joint is a force: `forces: {damper: {type: joint-spring-damper, coordinate: JOINT.COORDINATE,
    damping: 0.1}}`
  friction
    friction of a joint is its key `friction: 2 N m`, of a `displacement` in N; by a coefficient and the load it is
    `friction: {coefficient: 0.2, radius: 1 cm}`, of a `displacement` without `radius`
  motor, actuator, torque, force, motion, drive
    what moves a joint stands apart: `drivers: {drive: {coordinate: JOINT.COORDINATE, value: 0.5*time}}` prescribes its
    motion, `forces: {motor: {type: motor, coordinate: JOINT.COORDINATE, effort: 5}}` its effort
revolute
  free, floating, none
    a body without a joint is free; leave the joint out
  gear, belt, rack, coupler
    a gear is a coupling: `couplings: {pair: {type: gear, joints: [FIRST, SECOND], teeth: [20, 40]}}`
  bushing, mount
    a joint that yields is a force: `forces: {mount: {type: bushing, bodies: [FIRST, SECOND], points: [[0, 0, 0], [0, 0,
    0]], stiffness: [1e6, 1e6, 1e6, 1000, 1000, 1000]}}`
  contact, collision, impact
    a contact is a force: `forces: {touch: {type: contact, body: BODY, plane: MARKER, stiffness: 1e6, restitution: 0.5}}`
  spring, damper, spring damper
    a spring is a force: `forces: {spring: {type: spring-damper, bodies: [FIRST, SECOND], points: [[0, 0, 0], [1, 0, 0]],
    stiffness: 1 kN/m, free_length: 1 m}}`
  rope, cable, wire
    a rope that may slacken is a force; a link that keeps its length is a `distance` joint
assembly_weight
  fixed, static, ground, is static, immovable, kinematic
    a body that does not move is joined to the ground: `joints: {base: {type: fixed, bodies: [ground, BODY], point: [0, 0,
    0]}}`
  parent, joint
    bodies are connected under `joints:`, e.g. `hinge: {type: revolute, bodies: [ground, BODY], point: [0, 0, 0], axis: [0,
    0, 1]}`
  damping, stiffness, friction, drag
    what acts on a body is a force: `forces: {drag: {type: force, body: BODY, vector: [-5*BODY.vx, 0, 0]}}`
density
  material
    write `density`, e.g. `density: 7850 kg/m^3` of steel
  colour, color, rgba
    a colour is that of the shape: `shape: {type: sphere, radius: 5 cm, colour: red}`
vector, axes
  frame, coordinate system, in, system, local
    write `axes: body` where the vector turns with the body
teeth
  gears, wheels, shafts, joint 1, joint 2, first, second, driven
    write `joints: [FIRST, SECOND]`
  radii, radius, radius 1, radius 2
    write `ratio`, the radius of the second over that of the first: `ratio: 2`
orientation
  rpy, roll pitch yaw, euler angles, ypr, euler, eulerangles
    write `orientation: {euler: [YAW, PITCH, ROLL], sequence: zyx}` for roll, pitch and yaw
  quaternion, quat, euler parameters
    write `orientation: {euler_parameters: [W, X, Y, Z]}`, scalar first
euler_parameters
  rpy, roll pitch yaw, ypr, xyz, euler angles, roll, pitch, yaw
    roll, pitch and yaw are `{euler: [YAW, PITCH, ROLL], sequence: zyx}`, each about the axis as turned so far
  quaternion, quat, wxyz, xyzw
    write `euler_parameters: [W, X, Y, Z]`, scalar first
simulation
  t end, end time, stop time, duration, tf, t final, final time
    write `simulation: {duration: 5 s}`
  dt, step, time step, timestep, step size
    write `simulation: {step: 1 ms}`
  integrator, method, rtol
    write `simulation: {integrator: rk4}`
  solver
    write `simulation: {integrator: rk4, step: 1 ms, duration: 5 s}`
gravity
  g, grav, gravitation
    write `gravity: [0, 0, -9.81]`, where z points up
  units, unit, unit system
    a number without a unit is in SI units; other units stand behind numbers: `12 cm`, `30 deg`
  ground, world
    `ground` is there already; leave it out
  materials
    materials are parameters: `parameters: {steel: 7850 kg/m^3}`, then `density: steel`
  initial conditions, initial
    the start is said where it belongs: `velocity` of a body, `start` and `start_rates` of a joint
  fluid, oil, medium
    write `fluids: {oil: {type: liquid, …}}`
  hydraulic, pneumatics, fluid power, circuit, circuits, valves, cylinders
    write `hydraulics: {…}`, with what each component is by `type`
  controller, controllers, blocks, controls, signals, pid
    write `control: {…}`, with what each block is by `type`
  operator, joysticks, levers, commands, signals in
    write `inputs: {lever: {range: [-1, 1]}}`
rest
  min, max, minimum, maximum, lower, upper
    write `range: [MIN, MAX]`
sample_time
  min, max, minimum, maximum, lower, upper
    write `limits: [MIN, MAX]`
ports
  source, sink, from, to, inlet, outlet, port a, port b, a, b, p, t
    write `ports: {…}` or `ports: […]` with names of nodes: ports of one name are connected
sequence
  type, body, accelerometer, gyro, gyroscope, imu, encoder
    a sensor is said by what it measures: `{coordinate: JOINT.COORDINATE, quantity: rate}`, or `{marker: MARKER, quantity:
    acceleration}`
duration
  tspan, time span, t span, t 0, t0, start time, begin
    a run begins at t = 0; write `duration: 5 s`
"""


def lines(table: str) -> Iterator[Line]:
    """The lines of a table, whose indentation tells what stands there: none, two or four spaces."""
    beside, words, answer = "", "", ""
    for text in (*table.strip().splitlines(), ""):
        if not text.startswith("    ") and answer:
            yield Line(words, beside, answer)
            answer = ""
        if text.startswith("    "):
            answer = f"{answer} {text.strip()}".strip()
        elif text.startswith("  "):
            words = text.strip()
        else:
            beside = text


LINES: Final = tuple(lines(TABLE))
