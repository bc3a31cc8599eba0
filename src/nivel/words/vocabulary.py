"""Words of other programs and textbooks, and what nivel calls the same thing: asked only where a word is not known.

A word of ours answers where it is valid in that place. Where no single word says it, a line to write does.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from nivel.words.lines_to_write import LINES

# ours: how other programs call it. Spelling counts without case, `-`, `_` and spaces.
SAME: Final[dict[str, str]] = {
    # joints
    "revolute": "hinge, pin, pinned, rotary, rotational, continuous, hinge joint, revolute joint",
    "translational": "prismatic, slider, sliding, linear, prismatic joint, translation, slide",
    "spherical": "ball, ball joint, ball socket, ball and socket, globe, gimbal",
    "universal": "hooke, hookes joint, cardan, u joint, universal joint, cardan joint",
    "fixed": "weld, welded, rigid, bolted, clamped, rigid connection, fixed joint",
    "planar": "plane, planar joint",
    "locked": "constrained axes, constrained, locked axes, fixed axes",
    "screw": "helical, lead screw, ball screw",
    "cylindrical": "cylindrical joint, telescoping",
    "point-on-line": "inline, point curve, point on a line, pin in slot",
    "point-on-plane": "inplane, point on a plane",
    "rolling": "wheel, disc, disk, rolling disc, rolling without slip, no slip, tyre, tire, nonholonomic, non holonomic",
    "distance": "rod, massless link, link, strut, length, range, gap",
    "variable-distance": "cylinder, hydraulic cylinder, linear actuator, actuator, telescopic, actuated distance, driven distance, ram",
    "generic": "general, six dof, 6dof, dof, custom",
    # keys of a run, and its methods
    "duration": "end, t end, end time, stop time, final time, t final, t stop, t max, tf, max time, simulation time, time",
    "step": "step time, dt, time step, timestep, step size, delta t, h, sample time, fixed step",
    "largest_step": "max step, hmax, dt max, maximum step",
    "output_interval": "fps, frame rate, frames, output step, dt out, output dt, save every, print interval, communication interval",
    "integrator": "solver, method, integration, time integration, scheme, algorithm, solver type",
    "tolerance": "rtol, reltol, tol, atol, abstol, rel tol, relative tolerance, error, precision",
    "rk4": "ode4, runge kutta, runge kutta 4, classic, explicit",
    "euler": "ode1, explicit euler, forward euler, semi implicit euler, symplectic euler",
    "dopri5": "ode45, rk45, dormand prince, runge kutta fehlberg, rkf45, variable step",
    "dop853": "rk853, ode8, dop",
    "adams": "ode113, abam, vode",
    "bdf": "ode15s, cvode, ida, lsoda, dassl, gstiff, wstiff, stiff, implicit euler, backward euler, daspk",
    "radau": "radau5, radau iia, ode23s, implicit, implicitfast, implicit midpoint",
    "newmark": "ode23t, trapezoidal, trapezoid rule",
    "hht": "hht i3, hht alpha, hilber hughes taylor",
    "generalised-alpha": "gen alpha, generalized alpha, chung hulbert",
    # bodies, places and turns
    "mass": "m, weight",
    "inertia": "i, ixx, iyy, izz, ixy, ixz, iyz, moment of inertia, inertia tensor, moments of inertia, inertial",
    "centre_of_mass": "com, cog, cg, cm, centroid, center of gravity, centre of gravity",
    "position": "pos, xyz, reference position, origin, location, translation, coordinates, loc, place",
    "point": "origin, position, location, anchor, at, pos, loc, centre, center",
    "axis": "direction, dir, normal, hinge axis, axis direction",
    "orientation": "rotation, rot, rotate, angles, attitude, ori, pose",
    "euler_parameters": "quaternion, quat, wxyz, q",
    "angle": "theta, phi, angle 0, q",
    "velocity": "vel, v, linear velocity, v0, initial velocity",
    "angular_velocity": "omega, w, ang vel, rotational velocity, spin, gyro, gyroscope",
    "density": "rho, material density",
    "shape": "geometry, dimensions, size, graphics, visual, geom, collision, solid",
    "start": "initial, q0, initial position, initial value, x0, ic, initial conditions, init",
    "start_rates": "qd0, initial velocity, initial velocities, initial rate, v0",
    # sections of a file
    "bodies": "links, parts, worldbody, objects, rigid bodies, masses, body, components",
    "joints": "constraints, connections, joint, connectors",
    "forces": "loads, springs, dampers, force, actuators, actuator, bushings, contacts, torques, elements, force elements",
    "drivers": "motions, motion, driver, prescribed motions, inputs",
    "couplings": "gears, coupling, transmissions, gearboxes",
    "sensors": "outputs, probes, measures, requests, sensor, measurements",
    "euler_angles": "euler, angles, orientation, rpy, rotation, camber, toe, roll, pitch, yaw",
    "markers": "frames, sites, points, marker, attachment points, connection points",
    "events": "event, stop conditions, triggers",
    "simulation": "settings, options, option, simulation settings, model settings, solver, run, sim, analysis, integration",
    "functions": "splines, spline, curves, tables, lookups",
    "parameters": "params, variables, constants, design variables, vars, parameter",
    "assemblies": "subsystems, instances, submodels, modules",
    "include": "import, imports, includes",
    "name": "title, model",
    "description": "comment, notes, about",
    # forces
    "spring-damper": "spring, damper, translational spring damper, connector spring damper, tsda, coil spring, shock, shock absorber",
    "torsional-spring-damper": "rotational spring, torsion spring, rsda, torsional spring",
    "joint-spring-damper": "joint damping, joint spring, joint damper",
    "torque": "moment, couple",
    "force": "point force, applied force, external force, vector force, gforce",
    "spectral_radius": "rho inf, rho, spectral radius infinity, rho infinity",
    "stop": "terminate, halt, action, limit, end stop, hard stop, joint limit, bumpstop, bump stop",
    "motor": "actuator, drive, sforce, joint torque, joint force, general force, velocity motor",
    "servo": "pid, pd, controller, position control, position servo, pid controller, pd controller",
    "target": "setpoint, set point, reference, command, desired, goal",
    "integral": "ki, integral gain",
    "pid": "pid controller, pi, pd, pi controller, pd controller, controller",
    "radius": "r, rad",
    "xx": "ixx, jxx, i1",
    "yy": "iyy, jyy, i2",
    "zz": "izz, jzz, i3",
    "xy": "ixy, jxy",
    "xz": "ixz, jxz, izx",
    "yz": "iyz, jyz",
    "rate": "speed, velocity, angular velocity, dot, qd",
    "free_value": "rest, neutral, rest angle, rest length, free angle, free length, springref, equilibrium, offset",
    "law": "force, torque, expression, function",
    "format": "version",
    "effort": "torque, moment, value, command, u",
    "coefficient": "mu, mu d, mu k, kinetic coefficient, friction coefficient, dynamic coefficient",
    "static_coefficient": "mu s, static friction, static",
    "equilibrium": "static, statics, rest, settled, balanced",
    "box": "brick, cuboid, block, rectangular, cube",
    "sphere": "ball, globe",
    "extrusion": "prism, extruded solid, polygon, profile",
    "mesh": "stl, cad, obj, step file, file solid, triangles",
    "rope": "cable, wire, wire rope, tendon, string, tether, tensile link",
    "dc-motor": "electric motor, dc machine, bldc, pmsm, servo drive",
    "contact": "sphere on plane, spatial contact force, contact force, collision, ground contact, impact",
    "hand": "mouse spring, perturbation",
    "three-axis-spring": "linear spring 3d, cartesian spring damper, cartesian spring, translational bushing",
    "bushing": "bush, rubber mount, rigid body spring damper, field, compliant joint, mount",
    "vector": "fx, fy, fz, mx, my, mz, force, value, components, f, torque, load, magnitude",
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
    "cylinder": "disc, disk, shaft, double acting cylinder, single acting cylinder, hydraulic cylinder, actuator, ram, jack",
    "telescopic-cylinder": "telescope, multi stage cylinder",
    "rotary-actuator": "rotary cylinder, semi rotary actuator, swing actuator, vane actuator",
    "directional-valve": "4 way valve, 4/3, 4/2, 3/2, 4/3 valve, 4/2 valve, 3/2 valve, proportional valve, servo valve, spool valve, valve",
    "spool-valve": "catalogue valve, notched spool, proportional spool, solenoid valve",
    "section": "valve section, mobile valve, load sensing section, ludv, flow sharing section",
    "flow-control": "flow control valve, pressure compensated flow control, flow regulator, flow regulating valve",
    "flow-divider": "flow combiner, flow divider combiner, divider",
    "priority-valve": "steering priority valve, priority flow divider",
    "shuttle-valve": "shuttle, or valve",
    "unloading-valve": "unloader, unloader valve, bypass compensator",
    "pilot-relief-valve": "pilot operated relief valve, two stage relief valve",
    "pilot-reducing-valve": "pilot operated reducing valve, two stage reducing valve",
    "cartridge-valve": "logic valve, logic element, two way cartridge, slip-in cartridge",
    "cross-port-relief": "crossover relief, cross over relief valve, shock valve, anti cavitation valve",
    "brake-valve": "motor brake valve, travel brake valve",
    "relief-valve": "pressure relief valve, safety valve, prv, pressure limiting valve",
    "reducing-valve": "pressure reducing valve, pressure reducer",
    "check-valve": "non return valve, one way valve, pilot operated check valve, po check valve",
    "counterbalance-valve": "overcentre valve, over center valve, load holding valve",
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
    "signal": "profile, table, data, source, series, step, sine, sine wave, ramp, chirp, pulse, clock, white noise, function",
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
    "marker": "site, frame, at, application point",
    # forces and drivers act on
    "relative": "joint, joint coordinates, minimal, reduced, internal, generalized, recursive",
    "absolute": "cartesian, global, maximal, redundant, body",
    "lagrange": "index 3, index 1, index3, index1, dae, multipliers",
    "coordinate": "joint, dof, axis, joint coordinate, degree of freedom",
    "value": "function, expression, motion, position, f, displacement, law, trajectory",
    "when": "condition, trigger, expression, if",
    "interpolation": "method, kind, interp, type",
    "linear": "mimic, equality, coordinate constraint, straight, piecewise linear, lin, polyline, linear interpolation",
    "cubic": "spline, cubic spline, natural spline, smooth",
    "times": "t, time, x, points",
    "points": "x, abscissa, breakpoints, anchors, ends, positions",
    "values": "y, data, ordinate, value",
    "ground": "world, base, earth, inertial, global, fixed, origin, root, env, frame, base link",
}  # fmt: skip


def translated(word: str, valid: Sequence[str]) -> str:
    """What to write for `word` of another vocabulary where the words `valid` are known; empty where nothing is known of it."""
    meant = plain(word)
    for own in valid:
        if plain(own) == meant:
            return f"did you mean `{own}`?"
    for line in LINES:
        if all(word in valid for word in line.beside.split(", ")) and meant in _plain_words(line.words):
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
