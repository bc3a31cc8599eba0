"""Words of other programs and textbooks, and what nivel calls the same thing: asked only where a word is not known.

A word of ours answers where it is valid in that place. Where no single word says it, a line to write does.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, NamedTuple

# ours: how other programs call it. Spelling counts without case, `-`, `_` and spaces.
SAME: Final[dict[str, str]] = {
    # joints
    "revolute": "hinge, pin, pinned, rotary, rotational, continuous, hinge joint, revolute joint",
    "translational": "prismatic, slider, sliding, linear, prismatic joint, translation, slide",
    "spherical": "ball, ball joint, ball socket, ball and socket, globe, gimbal",
    "universal": "hooke, hookes joint, cardan, u joint, universal joint, cardan joint",
    "fixed": "weld, welded, rigid, bolted, clamped, rigid connection, fixed joint",
    "planar": "plane, planar joint",
    "screw": "helical, lead screw, ball screw",
    "cylindrical": "cylindrical joint, telescoping",
    "point-on-line": "inline, point curve, point on a line, pin in slot",
    "point-on-plane": "inplane, point on a plane",
    "rolling": "wheel, disc, disk, rolling disc, rolling without slip, no slip, tyre, tire, nonholonomic, non holonomic",
    "distance": "rod, massless link, link, strut, length, range, gap",
    "variable-distance": "cylinder, hydraulic cylinder, linear actuator, actuator, telescopic, actuated distance, driven distance, ram",
    "generic": "general, six dof, 6dof, dof, custom",
    # keys of a run, and its methods
    "duration": "t end, end time, stop time, final time, t final, t stop, t max, tf, max time, simulation time, time",
    "step": "dt, time step, timestep, step size, delta t, h, sample time, fixed step",
    "largest_step": "max step, hmax, dt max, maximum step",
    "output_interval": "output step, dt out, output dt, save every, print interval, communication interval",
    "integrator": "solver, method, integration, time integration, scheme, algorithm, solver type",
    "tolerance": "rtol, reltol, tol, atol, abstol, rel tol, relative tolerance, error, precision",
    "rk4": "ode4, runge kutta, runge kutta 4, classic, explicit",
    "euler": "ode1, explicit euler, forward euler, semi implicit euler, symplectic euler",
    "dopri5": "ode45, rk45, dormand prince, runge kutta fehlberg, rkf45, variable step",
    "dop853": "rk853, ode8, dop",
    "adams": "ode113, abam, vode",
    "bdf": "ode15s, cvode, ida, lsoda, dassl, gstiff, wstiff, stiff, implicit euler, backward euler, daspk",
    "radau": "radau5, radau iia, ode23s, implicit",
    "newmark": "ode23t, trapezoidal, trapezoid rule",
    "hht": "hht i3, hht alpha, hilber hughes taylor",
    "generalised-alpha": "gen alpha, generalized alpha, chung hulbert",
    # bodies, places and turns
    "mass": "m, weight",
    "inertia": "i, ixx, moment of inertia, inertia tensor, moments of inertia, inertial",
    "centre_of_mass": "com, cog, cg, cm, centroid, center of gravity, centre of gravity",
    "position": "pos, xyz, origin, location, translation, coordinates, loc, place",
    "point": "origin, position, location, anchor, at, pos, loc, centre, center",
    "axis": "direction, dir, normal, hinge axis, axis direction",
    "orientation": "rotation, rot, rotate, angles, attitude, ori, pose",
    "euler_parameters": "quaternion, quat, wxyz, q",
    "angle": "theta, phi, angle 0, q",
    "velocity": "vel, v, linear velocity, v0, initial velocity",
    "angular_velocity": "omega, w, ang vel, rotational velocity, spin, gyro, gyroscope",
    "density": "rho, material density",
    "shape": "geometry, visual, geom, collision, solid",
    "start": "initial, q0, initial position, initial value, x0, ic, initial conditions, init",
    "start_rates": "qd0, initial velocity, initial velocities, initial rate, v0",
    # sections of a file
    "bodies": "links, parts, rigid bodies, masses, body, components",
    "joints": "constraints, connections, joint, connectors",
    "forces": "loads, springs, dampers, force, actuators, contacts, torques, elements, force elements",
    "drivers": "motions, motion, driver, prescribed motions, inputs",
    "couplings": "gears, coupling, transmissions, gearboxes",
    "sensors": "outputs, probes, measures, requests, sensor, measurements",
    "euler_angles": "euler, angles, orientation, rpy, rotation, camber, toe, roll, pitch, yaw",
    "markers": "frames, sites, points, marker, attachment points, connection points",
    "events": "event, stop conditions, triggers",
    "simulation": "settings, options, solver, run, solver settings, sim, analysis, integration",
    "parameters": "params, variables, constants, design variables, vars, parameter",
    "assemblies": "subsystems, instances, submodels, modules",
    "include": "import, imports, includes",
    "name": "title, model",
    "description": "comment, notes, about",
    # forces
    "spring-damper": "spring, damper, tsda, coil spring, shock, shock absorber, translational spring",
    "torsional-spring-damper": "rotational spring, torsion spring, rsda, torsional spring",
    "joint-spring-damper": "joint damping, joint spring, joint damper",
    "torque": "moment, couple",
    "force": "point force, applied force, external force, vector force, gforce",
    "stop": "limit, end stop, hard stop, joint limit, bumpstop, bump stop",
    "motor": "actuator, drive",
    "servo": "pid, pd, controller, position control, position servo, pid controller, pd controller",
    "target": "setpoint, set point, reference, command, desired, goal",
    "integral": "ki, integral gain",
    "rope": "cable, wire, wire rope, tendon, string, tether, tensile link",
    "dc-motor": "electric motor, dc machine, bldc, pmsm, servo drive",
    "contact": "sphere on plane, spatial contact force, contact force, collision, ground contact, impact",
    "hand": "mouse spring, perturbation",
    "three-axis-spring": "linear spring 3d, cartesian spring, translational bushing",
    "bushing": "bush, rubber mount, compliant joint, mount",
    "vector": "force, value, components, f, torque, load, magnitude",
    "stiffness": "k, spring constant, rate, spring rate, spring stiffness, kp, gain, proportional gain, p",
    "damping": "c, d, damping coefficient, damper, kd, derivative gain",
    "free_length": "l0, rest length, natural length, unstretched length, length, initial length",
    "preload": "initial force, pretension",
    "friction": "coulomb, coulomb friction",
    # hydraulics
    "liquid": "oil, hydraulic oil, water, isothermal liquid, hydraulic fluid, mineral oil, hlp46, fluid",
    "ideal-gas": "gas, air, perfect gas, nitrogen, pneumatic",
    "pump": "fixed displacement pump, variable displacement pump, gear pump, piston pump, axial piston pump, pressure compensated pump",
    "hydraulic-motor": "fixed displacement motor, variable displacement motor, gear motor, orbital motor",
    "flow-source": "flow rate source, ideal flow source, constant flow",
    "cylinder": "double acting cylinder, single acting cylinder, hydraulic cylinder, actuator, ram, jack, differential cylinder",
    "telescopic-cylinder": "telescope, multi stage cylinder",
    "rotary-actuator": "rotary cylinder, semi rotary actuator, swing actuator, vane actuator",
    "directional-valve": "4 way valve, 4/3, 4/2, 3/2, 4/3 valve, 4/2 valve, 3/2 valve, proportional valve, servo valve, spool valve, valve",
    "relief-valve": "pressure relief valve, safety valve, prv, pressure limiting valve",
    "reducing-valve": "pressure reducing valve, pressure reducer",
    "check-valve": "non return valve, one way valve, pilot operated check valve, po check valve",
    "counterbalance-valve": "overcentre valve, over center valve, load holding valve, brake valve",
    "compensator": "pressure compensator, pressure compensator valve",
    "orifice": "throttle, restrictor, nozzle, restriction, laminar resistance, local restriction, fixed orifice, variable orifice",
    "pipe": "line, tube, conduit",
    "volume": "node, chamber, constant volume chamber, hose, capacity, manifold",
    "tank": "reservoir, sump, reservoir port",
    "ports": "connections, nodes, connect, port, lines",
    "bulk_modulus": "beta, compressibility, k, stiffness",
    "air": "entrained air, gas fraction, undissolved gas, air content, alpha",
    "piston": "bore, piston diameter, diameter, d piston",
    "rod": "rod diameter, d rod",
    "opens_at": "pressure, set pressure, cracking pressure, setting, opening pressure, relief pressure",
    "pressure_drop": "dp, delta p, rated pressure, pressure difference, nominal pressure",
    "flow": "rated flow, nominal flow, flow rate, q, q nom, capacity",
    "command": "signal, spool, input, opening, position, control, u",
    "precharge": "precharge pressure, gas pressure, p0",
    "discharge_coefficient": "cd, flow coefficient, discharge coefficient",
    # control
    "limit": "saturation, saturate, clamp, clip, sat, limiter",
    "limits": "saturation, clamp, output limits, anti windup, range, bounds",
    "dead-zone": "dead band, deadband",
    "transfer-function": "tf, transfer fcn, lti",
    "state-space": "ss, abcd",
    "numerator": "num, b",
    "denominator": "den, a",
    "lookup": "lookup table, table, 1d lookup table, interpolation, map",
    "low-pass": "filter, pt1, first order filter, lag, lowpass filter",
    "high-pass": "washout, highpass filter",
    "delay": "transport delay, dead time, transport lag, zoh",
    "rate-limit": "rate limiter, slew rate, slew",
    "hysteresis": "relay, schmitt trigger",
    "sum": "add, summing junction, difference, subtract, summation",
    "switch": "selector, multiswitch",
    "state-machine": "stateflow, chart, sequence, grafcet, fsm, plc",
    "trapezoid": "trapezoidal profile, motion profile, trajectory, s curve",
    "waypoints": "path, spline, minimum jerk, trajectory points",
    "signal": "profile, table, data, source, series",
    "input": "u, in, in 1, of, from",
    "inputs": "u, in, of",
    "gain": "k, factor, amplification",
    "reference": "setpoint, set point, sp, target, desired, command",
    "measured": "measurement, feedback, pv, actual, process value, process variable, sensor",
    "sample_time": "ts, sampling time, sample period, period, rate, every",
    "latency": "delay, dead time, transport delay",
    "filter_time": "tf, derivative filter, n, filter",
    "tracking_time": "anti windup, tt, back calculation",
    "kp": "p, proportional, gain",
    "ki": "i, integral, integral gain",
    "kd": "d, derivative, derivative gain",
    # inputs
    "range": "limits, bounds, span",
    "rest": "default, initial, neutral, initial value, start, value, zero",
    "keys": "key, keyboard",
    "gamepad": "joystick, axis, controller",
    # sensors
    "acceleration": "accelerometer",
    "marker": "site, frame",
    # forces and drivers act on
    "coordinate": "joint, dof, axis, joint coordinate, degree of freedom",
    "value": "function, expression, motion, position, f, displacement, law, trajectory",
    "when": "condition, trigger, expression, if",
    "interpolation": "method, kind, interp, type",
    "linear": "straight, piecewise linear, lin, polyline, linear interpolation",
    "cubic": "spline, cubic spline, natural spline, smooth",
    "times": "t, time, x, points",
    "points": "x, abscissa, breakpoints, anchors, ends, positions",
    "values": "y, data, ordinate, value",
    "ground": "world, base, earth, inertial, global, fixed, origin, root, env, frame, base link",
}  # fmt: skip


class Line(NamedTuple):
    """What to write for a word, where `beside` is one of the words that are valid there."""

    words: str
    beside: str
    answer: str


LINES: Final = (
    Line("parent, child", "markers", "write `bodies: [PARENT, CHILD]`, first and second body of the joint"),
    Line(
        "body 1, body 2, body a, body b, from, to, base, follower, i, j, first, second, body i, body j",
        "markers",
        "write `bodies: [FIRST, SECOND]`",
    ),
    Line(
        "limits, limit, range, lower, upper, min, max",
        "markers",
        "limits of a joint are a force: `forces: {limit: {type: stop, coordinate: JOINT.COORDINATE, lower: …, upper: …, stiffness: …}}`",
    ),
    Line(
        "damping, stiffness, spring, damper",
        "x_axis",
        "a spring or damper in a joint is a force: "
        "`forces: {damper: {type: joint-spring-damper, coordinate: JOINT.COORDINATE, damping: …}}`",
    ),
    Line(
        "friction",
        "x_axis",
        "friction of a joint is a force: `forces: {rubbing: {type: friction, …}}`",
    ),
    Line(
        "motor, actuator, torque, force, motion, drive",
        "x_axis",
        "what moves a joint stands apart: `drivers: {drive: {coordinate: JOINT.COORDINATE, value: …}}` prescribes its motion, "
        "`forces: {motor: {type: motor, coordinate: JOINT.COORDINATE, effort: …}}` its effort",
    ),
    Line(
        "free, floating, none",
        "revolute",
        "a body without a joint is free; leave the joint out",
    ),
    Line("gear, belt, rack, coupler", "revolute", "a gear is a coupling: `couplings: {pair: {type: gear, …}}`"),
    Line("bushing, mount", "revolute", "a joint that yields is a force: `forces: {mount: {type: bushing, …}}`"),
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
    Line("colour, color, rgba", "density", "the viewer chooses the colours; leave it out"),
    Line(
        "rpy, roll pitch yaw, euler angles, ypr, euler, eulerangles",
        "orientation",
        "write `orientation: {euler: [YAW, PITCH, ROLL], sequence: zyx}` for roll, pitch and yaw",
    ),
    Line(
        "rpy, roll pitch yaw, ypr, xyz, euler angles",
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


def translated(word: str, valid: Sequence[str]) -> str:
    """What to write for `word` of another vocabulary where the words `valid` are known; empty where nothing is known of it."""
    meant = plain(word)
    for own in valid:
        if plain(own) == meant:
            return f"did you mean `{own}`?"
    for line in LINES:
        if line.beside in valid and meant in _plain_words(line.words):
            return line.answer
    for own, others in SAME.items():
        if own in valid and meant in _plain_words(others):
            return f"did you mean `{own}`?"
    return ""


def plain(word: str) -> str:
    """`word` without case, `-`, `_` and spaces."""
    return "".join(letter for letter in word.casefold() if letter not in "-_ ")


def _plain_words(words: str) -> tuple[str, ...]:
    return tuple(plain(word) for word in words.split(","))
