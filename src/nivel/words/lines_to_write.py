"""Lines to write for words of other programs that no single word of ours stands for."""

from __future__ import annotations

from typing import Final, NamedTuple


class Line(NamedTuple):
    """What to write for a word, where the words of `beside` are valid."""

    words: str
    beside: str
    answer: str


LINES: Final = (
    Line("velocity, rate, omega", "start_speed", "write `speed: 10 rad/s`, or `speed: 10 cm/s` of a displacement"),
    Line(
        "efficiency, eta, loss, losses, friction",
        "teeth",
        "write under `forces`: `loss: {type: transmission-loss, coupling: NAME, coordinate: JOINT.angle, efficiency: 0.95}`",
    ),
    Line(
        "backlash, play, stiffness, damping",
        "teeth",
        "an elastic pair of wheels is a force: write under `forces` in place of this coupling "
        "`mesh: {type: shaft, coordinate: JOINT.angle, against: JOINT.angle, ratio: -2, stiffness: 1e5, backlash: 0.2 deg}`",
    ),
    Line(
        "youngs modulus, e, diameter, d, area, material, section, ea",
        "length, speed",
        "write the `stiffness` of the whole rope, E·A/length, e.g. `stiffness: 200 kN/m`",
    ),
    Line(
        "winch, speed profile, rate, payout, velocity",
        "length, speed",
        "a winch pays rope out by its speed: write `speed: -0.3 m/s`",
    ),
    Line("from, to, start, end", "length, speed", "write `bodies: [FIRST, SECOND], points: [[0, 0, 0], [0, 0, -5]]`"),
    Line("axis, direction, orientation", "colour, along", "write `along: z`, the body axis on which it lies"),
    Line(
        "start, end, p1, p2, ends, points, start point, end point",
        "colour, from",
        "write `from: [0, 0, 0], to: [1, 0, 0]`",
    ),
    Line("diameter, d, dia", "colour, radius", "write `radius`, half of it"),
    Line("material", "colour, centre", "write `density: 7850 kg/m^3`, of the body beside its `shape`"),
    Line("density, rho, mass", "colour, centre", "write `density` or `mass` of the body, beside its `shape`"),
    Line(
        "position, pos, origin, location",
        "colour, centre",
        "write `position` of the body, or `centre` in the body frame",
    ),
    Line(
        "type, kind",
        "point_mass",
        "write `shape: {type: cylinder, radius: 2 cm, length: 10 cm}`, or `point_mass: true`",
    ),
    Line(
        "from, to, length, radius, size, width, height, start, end, diameter",
        "point_mass",
        "a solid is a `shape`: write `shape: {type: cylinder, from: [0, 0, 0], to: [1, 0, 0], radius: 1 cm}`",
    ),
    Line(
        "output, out, result",
        "tracking_time",
        "what a block gives is read by its name: write `effort: NAME.value` in a motor",
    ),
    Line(
        "coordinate, joint", "tracking_time", "write `measured: JOINT.angle`; a motor applies it: `effort: NAME.value`"
    ),
    Line(
        "contacts, contact, collisions, impacts",
        "gravity",
        "a contact is a force: `forces: {touch: {type: contact, body: BODY, plane: MARKER, stiffness: 1e6, restitution: 0.5}}`",
    ),
    Line(
        "motors, motor, actuators, actuator, drives",
        "gravity",
        "an effort is a force: `forces: {motor: {type: motor, coordinate: JOINT.COORDINATE, effort: 5}}`; "
        "a prescribed motion a driver: `drivers: {drive: {coordinate: JOINT.COORDINATE, value: 0.5*time}}`",
    ),
    Line("time", "gravity", "write `simulation: {duration: 5 s, step: 1 ms}`"),
    Line(
        "trajectories, trajectory, paths, path, profiles",
        "gravity",
        "a curve is a function, called as `NAME(time)`: "
        "`functions: {NAME: {points: [0, 1, 2], values: [0, 0.5, 0], interpolation: cubic}}`",
    ),
    Line(
        "steps, number of steps, nsteps, n steps, n",
        "largest_step",
        "the length of a step is given, not their number: write `step: 1 ms`",
    ),
    Line(
        "output, output file, results, result, save, file, csv",
        "largest_step",
        "every run stores all results in `NAME.nc`; `nivel export NAME.nc --csv` writes tables",
    ),
    Line("gravity, g", "largest_step", "gravity is a key of the whole file: `gravity: [0, 0, -9.81]`"),
    Line("spectral radius, rho inf, rho", "largest_step", "write `generalised_alpha: {spectral_radius: 0.8}`"),
    Line(
        "mechanism configuration, mechanism",
        "gravity",
        "gravity and the run are keys of the file: `gravity: [0, 0, -9.81]`, `simulation: {duration: 5 s, step: 1 ms}`",
    ),
    Line(
        "internal mechanics, spring stiffness, damping coefficient",
        "rim_radius",
        "springs and dampers of a joint are a force: `forces: {coil: {type: joint-spring-damper, coordinate: JOINT.COORDINATE, "
        "stiffness: 10, damping: 0.1, free_value: 0}}`",
    ),
    Line(
        "armature, rotor inertia",
        "rim_radius",
        "there is no inertia of a rotor; add it to the `inertia` of the driven body",
    ),
    Line(
        "frictionloss, friction loss, joint friction, coulomb friction, dynamics",
        "rim_radius",
        "friction of a joint is a force: `forces: {rubbing: {type: friction, coordinate: JOINT.angle, model: stiction, coefficient: 0.2, "
        "radius: 1 cm}}`; of a `displacement` without `radius`",
    ),
    Line(
        "state targets, ref, initial, initial angle, springref, qpos0, qpos, position target",
        "rim_radius",
        "write `start: {angle: 30 deg}` of a revolute, `start: {displacement: 10 cm}` of a translational joint",
    ),
    Line(
        "angle, displacement, position target",
        "rim_radius",
        "write `start: {angle: 30 deg}`, or `start: {displacement: 10 cm}`",
    ),
    Line(
        "position, velocity, value, theta, q, rate, speed, omega, w",
        "angle_1",
        "write the name of a joint coordinate: `angle` of a revolute, `displacement` of a translational joint",
    ),
    Line(
        "expression, function, formula, f, equation",
        "interpolation",
        "a function of arguments is written in one line: `functions: {NAME(x): 2*x + 1}`",
    ),
    Line(
        "tire, magic formula, pacejka, tmeasy",
        "spring-damper",
        "a tyre is `{type: tyre, wheel: MARKER, plane: MARKER, radius: 0.3, width: 0.2, nominal_load: 4e3}`; a wheel that does not slip "
        "is a joint, `{type: rolling, …}`",
    ),
    Line(
        "aerodynamic, aero, drag, lift, wind, magnetic, user, user force, custom, electrostatic, sfosub",
        "spring-damper",
        "a force of your own is `{type: force, body: BODY, vector: [-5*BODY.vx, 0, 0]}`, or the `law` of a spring",
    ),
    Line("body 1, body 2, body a, body b, mobile", "plane", "write `bodies: [FIRST, SECOND]`, or `body` and `plane`"),
    Line(
        "between, body 1, body 2, body a, body b, from, to, i, j, attach 1, attach 2, point 1, point 2, site 1, site 2",
        "stiffness",
        "write `bodies: [FIRST, SECOND], points: [[0, 0, 0], [1, 0, 0]]`",
    ),
    Line(
        "e, g, youngs modulus, elastic modulus, young, nu, poisson, poisson ratio, rho, density, modulus, shear modulus",
        "shear_centre",
        "write `material: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3}`",
    ),
    Line(
        "a, area, iyy, izz, ix, iy, iz, i, j, ip, inertia, radius, diameter, width, height, profile, cross section, geometry",
        "shear_centre",
        "write `section: {type: circle, radius: 1 cm}`; sections are circle, tube, rectangle and others",
    ),
    Line("length, l", "shear_centre", "a beam lies between two points: write `from: [0, 0, 0], to: [1, 0, 0]`"),
    Line("nodes, n elements, number of elements, segments, mesh, n", "shear_centre", "write `elements: 8`"),
    Line("body, bodies", "sequence", "motion is measured at a marker: write `{marker: MARKER, quantity: position}`"),
    Line(
        "joint force, joint torque, reaction",
        "sequence",
        "reactions are results by themselves: `JOINT.force`, `JOINT.torque`",
    ),
    Line("measure, expression, function, measurement", "sequence", "write `{value: hinge.angle, units: rad}`"),
    Line(
        "fluid, oil, medium, liquid",
        "load-sensing",
        "a fluid stands in a section of its own: `fluids: {oil: {type: liquid, …}}`",
    ),
    Line(
        "filter, strainer, cooler, heat exchanger",
        "load-sensing",
        "write `{type: orifice, …}`, which has a pressure drop",
    ),
    Line(
        "sensor, pressure sensor, flow sensor, flow meter, manometer, gauge",
        "load-sensing",
        "pressures and flows are results by themselves: `NODE.pressure`, `COMPONENT.flow`",
    ),
    Line(
        "mux, demux, bus, bus selector, subsystem, terminator, goto, from, scope, display, to workspace, outport, out",
        "lead-lag",
        "it is not needed: a block names the signals that it reads, and each output is a result",
    ),
    Line(
        "zero order hold, zoh, sample and hold, rate transition, memory, unit delay",
        "lead-lag",
        "a block is sampled by `sample_time: 10 ms`; a delay by samples is `{type: delay, …}`",
    ),
    Line(
        "kalman, kalman filter, observer, mpc, matlab function, s function, fcn, c, c function, script, quantizer, backlash",
        "lead-lag",
        "a block of your own is `{type: python, …}`; a short formula is a signal: `{type: signal, …}`",
    ),
    Line("type, kind", "gamepad", "an input is a number; `control: slider` or `control: button` is how it is shown"),
    Line("parent, child", "markers", "write `bodies: [PARENT, CHILD]`, first and second body of the joint"),
    Line(
        "between, body 1, body 2, body a, body b, from, to, base, follower, i, j, first, second, body i, body j",
        "markers",
        "write `bodies: [FIRST, SECOND]`",
    ),
    Line(
        "limits, limit, range, lower, upper, min, max",
        "markers",
        "limits of a joint are a force: "
        "`forces: {limit: {type: stop, coordinate: JOINT.COORDINATE, lower: -1, upper: 1, stiffness: 1e4, restitution: 0.5}}`",
    ),
    Line(
        "damping, stiffness, spring, damper",
        "x_axis",
        "a spring or damper in a joint is a force: "
        "`forces: {damper: {type: joint-spring-damper, coordinate: JOINT.COORDINATE, damping: 0.1}}`",
    ),
    Line(
        "friction",
        "x_axis",
        "friction of a joint is a force: `forces: {rubbing: {type: friction, coordinate: JOINT.angle, model: stiction, coefficient: 0.2, "
        "radius: 1 cm}}`; of a `displacement` without `radius`",
    ),
    Line(
        "motor, actuator, torque, force, motion, drive",
        "x_axis",
        "what moves a joint stands apart: `drivers: {drive: {coordinate: JOINT.COORDINATE, value: 0.5*time}}` prescribes its motion, "
        "`forces: {motor: {type: motor, coordinate: JOINT.COORDINATE, effort: 5}}` its effort",
    ),
    Line(
        "free, floating, none",
        "revolute",
        "a body without a joint is free; leave the joint out",
    ),
    Line(
        "gear, belt, rack, coupler",
        "revolute",
        "a gear is a coupling: `couplings: {pair: {type: gear, joints: [FIRST, SECOND], teeth: [20, 40]}}`",
    ),
    Line(
        "bushing, mount",
        "revolute",
        "a joint that yields is a force: `forces: {mount: {type: bushing, bodies: [FIRST, SECOND], points: [[0, 0, 0], [0, 0, 0]], "
        "stiffness: [1e6, 1e6, 1e6, 1000, 1000, 1000]}}`",
    ),
    Line(
        "contact, collision, impact",
        "revolute",
        "a contact is a force: `forces: {touch: {type: contact, body: BODY, plane: MARKER, stiffness: 1e6, restitution: 0.5}}`",
    ),
    Line(
        "spring, damper, spring damper",
        "revolute",
        "a spring is a force: `forces: {spring: {type: spring-damper, bodies: [FIRST, SECOND], points: [[0, 0, 0], [1, 0, 0]], "
        "stiffness: 1 kN/m, free_length: 1 m}}`",
    ),
    Line(
        "rope, cable, wire",
        "revolute",
        "a rope that may slacken is a force; a link that keeps its length is a `distance` joint",
    ),
    Line(
        "fixed, static, ground, is static, immovable, kinematic",
        "assembly_weight",
        "a body that does not move is joined to the ground: `joints: {base: {type: fixed, bodies: [ground, BODY], point: [0, 0, 0]}}`",
    ),
    Line(
        "parent, joint",
        "assembly_weight",
        "bodies are connected under `joints:`, e.g. `hinge: {type: revolute, bodies: [ground, BODY], point: [0, 0, 0], axis: [0, 0, 1]}`",
    ),
    Line("material", "density", "write `density`, e.g. `density: 7850 kg/m^3` of steel"),
    Line(
        "colour, color, rgba",
        "density",
        "a colour is that of the shape: `shape: {type: sphere, radius: 5 cm, colour: red}`",
    ),
    Line(
        "damping, stiffness, friction, drag",
        "assembly_weight",
        "what acts on a body is a force: `forces: {drag: {type: force, body: BODY, vector: [-5*BODY.vx, 0, 0]}}`",
    ),
    Line(
        "frame, coordinate system, in, system, local",
        "vector, axes",
        "write `axes: body` where the vector turns with the body",
    ),
    Line("gears, wheels, shafts, joint 1, joint 2, first, second, driven", "teeth", "write `joints: [FIRST, SECOND]`"),
    Line(
        "radii, radius, radius 1, radius 2",
        "teeth",
        "write `ratio`, the radius of the second over that of the first: `ratio: 2`",
    ),
    Line(
        "rpy, roll pitch yaw, euler angles, ypr, euler, eulerangles",
        "orientation",
        "write `orientation: {euler: [YAW, PITCH, ROLL], sequence: zyx}` for roll, pitch and yaw",
    ),
    Line(
        "rpy, roll pitch yaw, ypr, xyz, euler angles, roll, pitch, yaw",
        "euler_parameters",
        "roll, pitch and yaw are `{euler: [YAW, PITCH, ROLL], sequence: zyx}`, each about the axis as turned so far",
    ),
    Line(
        "quaternion, quat, euler parameters",
        "orientation",
        "write `orientation: {euler_parameters: [W, X, Y, Z]}`, scalar first",
    ),
    Line("quaternion, quat, wxyz, xyzw", "euler_parameters", "write `euler_parameters: [W, X, Y, Z]`, scalar first"),
    Line(
        "t end, end time, stop time, duration, tf, t final, final time",
        "simulation",
        "write `simulation: {duration: 5 s}`",
    ),
    Line("dt, step, time step, timestep, step size", "simulation", "write `simulation: {step: 1 ms}`"),
    Line("integrator, method, rtol", "simulation", "write `simulation: {integrator: rk4}`"),
    Line("solver", "simulation", "write `simulation: {integrator: rk4, step: 1 ms, duration: 5 s}`"),
    Line("g, grav, gravitation", "gravity", "write `gravity: [0, 0, -9.81]`, where z points up"),
    Line(
        "units, unit, unit system",
        "gravity",
        "a number without a unit is in SI units; other units stand behind numbers: `12 cm`, `30 deg`",
    ),
    Line("ground, world", "gravity", "`ground` is there already; leave it out"),
    Line("materials", "gravity", "materials are parameters: `parameters: {steel: 7850 kg/m^3}`, then `density: steel`"),
    Line(
        "initial conditions, initial",
        "gravity",
        "the start is said where it belongs: `velocity` of a body, `start` and `start_rates` of a joint",
    ),
    Line("gravity, weight", "spring-damper", "gravity is a key of the whole file: `gravity: [0, 0, -9.81]`"),
    Line("min, max, minimum, maximum, lower, upper", "rest", "write `range: [MIN, MAX]`"),
    Line("min, max, minimum, maximum, lower, upper", "sample_time", "write `limits: [MIN, MAX]`"),
    Line(
        "source, sink, from, to, inlet, outlet, port a, port b, a, b, p, t",
        "ports",
        "write `ports: {…}` or `ports: […]` with names of nodes: ports of one name are connected",
    ),
    Line(
        "type, body, accelerometer, gyro, gyroscope, imu, encoder",
        "sequence",
        "a sensor is said by what it measures: `{coordinate: JOINT.COORDINATE, quantity: rate}`, "
        "or `{marker: MARKER, quantity: acceleration}`",
    ),
    Line(
        "tspan, time span, t span, t 0, t0, start time, begin",
        "duration",
        "a run begins at t = 0; write `duration: 5 s`",
    ),
    Line("fluid, oil, medium", "gravity", "write `fluids: {oil: {type: liquid, …}}`"),
    Line(
        "hydraulic, pneumatics, fluid power, circuit, circuits, valves, cylinders",
        "gravity",
        "write `hydraulics: {…}`, with what each component is by `type`",
    ),
    Line(
        "controller, controllers, blocks, controls, signals, pid",
        "gravity",
        "write `control: {…}`, with what each block is by `type`",
    ),
    Line("operator, joysticks, levers, commands, signals in", "gravity", "write `inputs: {lever: {range: [-1, 1]}}`"),
)
