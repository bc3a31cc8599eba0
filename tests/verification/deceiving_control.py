"""Ropes, stops, drives, states, blocks and tables of place made to deceive: what happens to them is shorter than the steps, or faster."""

from functools import cache

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from deceiving import Deceiving
from deceiving_circuits import CART, parsed

EXACTLY = {"method": "DOP853", "rtol": 1e-11, "atol": 1e-13, "dense_output": True}


def known(name, text, rates, start, duration, *, resolved):
    """A machine and the equations of its cart, ẏ = rates(harmless, t, y) with the place first; resolved : by steps of so much [s]."""

    @cache
    def solution(harmless):
        step = 2e-3 if harmless else resolved
        # where forces are of the size of the smallest numbers the error of a step is 0/0, and the step is made again
        with np.errstate(invalid="ignore"):
            found = solve_ivp(lambda t, y: rates(harmless, t, y), (0.0, duration), start, max_step=step, **EXACTLY)
        assert found.success
        return found.sol

    return Deceiving(
        name,
        lambda harmless: parsed(text(harmless)),
        "cart.position.x",
        lambda time, harmless: solution(harmless)(time)[0],
    )


def rope():
    """A mass at 2 m/s that a stiff rope turns round within 3 ms, in steps of 5 ms; harmlessly within 0.3 s."""
    stiffness = {False: 1e6, True: 100.0}

    def text(harmless):
        return (
            CART.format(name="rope", mass=1)
            + f"""
forces:
  push: {{type: force, body: cart, vector: [1, 0, 0]}}
  line: {{type: rope, bodies: [ground, cart], points: [[-1, 0, 0], [0, 0, 0]], stiffness: {stiffness[harmless]}, length: 2}}
simulation: {{duration: 2, step: 5 ms}}
"""
        )

    def rates(harmless, _t, y):
        return y[1], 1.0 - stiffness[harmless] * max(y[0] - 1.0, 0.0)

    return known("rope", text, rates, (0.0, 0.0), 2.0, resolved=1e-4)


def stop():
    """A stop that is hard enough to turn a slide round in 0.3 ms, in steps of 2 ms; harmlessly in 0.1 s."""
    stiffness = {False: 1e8, True: 1e3}

    def text(harmless):
        return (
            CART.format(name="stop", mass=1)
            + f"""
forces:
  push: {{type: force, body: cart, vector: [2, 0, 0]}}
  end: {{type: stop, coordinate: rail, upper: 0.5, stiffness: {stiffness[harmless]}, restitution: 1}}
simulation: {{duration: 1.2, step: {"5 ms" if harmless else "2 ms"}}}
"""
        )

    def rates(harmless, _t, y):
        return y[1], 2.0 - stiffness[harmless] * max(y[0] - 0.5, 0.0)

    return known("stop", text, rates, (0.0, 0.0), 1.2, resolved=2e-5)


def narrow_state():
    """A state that takes up a feature of place 1 mm wide, passed at 5 m/s in steps of 5 ms, and pushes; harmlessly 0.5 m wide."""
    width = {False: 1e-3, True: 0.5}

    def text(harmless):
        w = width[harmless]
        return (
            CART.format(name="state", mass=1).replace("inertia: [1, 1, 1]", "inertia: [1, 1, 1], velocity: [5, 0, 0]")
            + f"""
states: {{seen: {{rate: "{1.0 / w}*exp(-((rail.displacement - 1.003)/{w})**2)"}}}}
forces: {{push: {{type: motor, coordinate: rail, effort: 10*seen.value}}}}
simulation: {{duration: 0.6, step: 5 ms}}
"""
        )

    def rates(harmless, _t, y):
        w = width[harmless]
        return y[1], 10.0 * y[2], np.exp(-(((y[0] - 1.003) / w) ** 2)) / w

    return known("narrow-state", text, rates, (0.0, 5.0, 0.0), 0.6, resolved=5e-5)


def narrow_block():
    """A lookup over place with a spike 2 mm wide, passed at 5 m/s in steps of 5 ms; harmlessly 0.6 m wide."""
    width = {False: 2e-3, True: 0.6}

    def points(harmless):
        w = width[harmless]
        return [0.0, 1.003, 1.003 + w / 2, 1.003 + w, 9.0], [0.0, 0.0, 40.0 / w, 0.0, 0.0]

    def text(harmless):
        places, values = points(harmless)
        return (
            CART.format(name="block", mass=1).replace("inertia: [1, 1, 1]", "inertia: [1, 1, 1], velocity: [5, 0, 0]")
            + f"""
control: {{bump: {{type: lookup, input: rail.displacement, points: {places}, values: {[-each for each in values]}}}}}
forces: {{push: {{type: motor, coordinate: rail, effort: 0.5*bump.value}}}}
simulation: {{duration: 0.6, step: 5 ms}}
"""
        )

    def rates(harmless, _t, y):
        places, values = points(harmless)
        return y[1], -0.5 * np.interp(y[0], places, values)

    return known("narrow-block", text, rates, (0.0, 5.0), 0.6, resolved=2e-5)


def quick_winding():
    """A winding with a time constant of 20 µs, in steps of 1 ms; harmlessly of 50 ms."""
    inductance = {False: 4e-5, True: 0.1}
    R, K, u = 2.0, 0.5, 24.0

    def text(harmless):
        return (
            CART.format(name="winding", mass=1)
            + f"""
forces:
  drive: {{type: dc-motor, coordinate: rail, voltage: {u}, torque_constant: {K}, resistance: {R}, inductance: {inductance[harmless]}}}
simulation: {{duration: 1, step: 1 ms}}
"""
        )

    def exact(time, harmless):
        L = inductance[harmless]
        A = np.array([[0.0, 1.0, 0.0, 0.0], [0.0, 0.0, K, 0.0], [0.0, -K / L, -R / L, u / L], [0.0, 0.0, 0.0, 0.0]])
        return np.array([(expm(A * t) @ [0.0, 0.0, 0.0, 1.0])[0] for t in time])

    return Deceiving("quick-winding", lambda harmless: parsed(text(harmless)), "cart.position.x", exact)


def humming_input():
    """An input with 1 kHz from a table of 20 points a period, in steps of 1 ms that see its begin alone; harmlessly 2 Hz."""
    pace = {False: 1000.0, True: 2.0}

    def table(harmless):
        step = 1.0 / (20.0 * pace[harmless])
        times = np.arange(0.0, 0.5 + step, step)
        return times, np.cos(2.0 * np.pi * pace[harmless] * times)

    def text(harmless):
        times, values = table(harmless)
        return (
            CART.format(name="hum", mass=1)
            + f"""
inputs: {{lever: {{range: [-2, 2], signal: {{times: {np.round(times, 9).tolist()}, values: {np.round(values, 12).tolist()}}}}}}}
forces: {{push: {{type: motor, coordinate: rail, effort: 10*lever.value}}}}
simulation: {{duration: 0.4, step: 1 ms}}
"""
        )

    def exact(time, harmless):
        times, values = table(harmless)
        h = times[1]
        speed = np.concatenate([[0.0], np.cumsum(5.0 * h * (values[1:] + values[:-1]))])
        places = np.concatenate(
            [[0.0], np.cumsum(speed[:-1] * h + 10.0 * h**2 * (values[:-1] / 3.0 + values[1:] / 6.0))]
        )
        k = np.minimum((time / h + 1e-9).astype(int), len(times) - 2)
        s = time - times[k]
        return places[k] + speed[k] * s + 5.0 * values[k] * s**2 + 10.0 / 6.0 * (values[k + 1] - values[k]) / h * s**3

    return Deceiving("humming-input", lambda harmless: parsed(text(harmless)), "cart.position.x", exact)


def narrow_brake():
    """Damping that is closed but for 4 mm of the way, passed at 10 m/s in steps of 2 ms, by a force as a table of place times speed;
    harmlessly 0.5 m."""
    width = {False: 4e-3, True: 0.5}

    def text(harmless):
        w = width[harmless]
        gate = f"points: [0, 1.001, {1.001 + w / 2}, {1.001 + w}, 99], values: [0, 0, {6 / w}, 0, 0]"
        return (
            CART.format(name="brake", mass=1).replace("inertia: [1, 1, 1]", "inertia: [1, 1, 1], velocity: [10, 0, 0]")
            + f"""
control: {{gate: {{type: signal, value: {{of: rail.displacement, {gate}}}}}}}
forces: {{brake: {{type: motor, coordinate: rail, effort: -gate*rail.displacement_rate}}}}
simulation: {{duration: 0.5, step: 2 ms}}
"""
        )

    def rates(harmless, _t, y):
        w = width[harmless]
        return y[1], -y[1] * np.interp(y[0], [1.001, 1.001 + w / 2, 1.001 + w], [0.0, 6.0 / w, 0.0])

    return known("narrow-brake", text, rates, (0.0, 10.0), 0.5, resolved=1e-5)


def between_stops():
    """A ball between two stops under a driven push: neighbouring motions part; harmlessly it does not reach them."""
    amplitude = {False: 30.0, True: 0.5}

    def text(harmless):
        return (
            CART.format(name="rattle", mass=1)
            + f"""
forces:
  push: {{type: motor, coordinate: rail, effort: "{amplitude[harmless]}*cos(11*time)"}}
  ends: {{type: stop, coordinate: rail, lower: -0.05, upper: 0.1, stiffness: 2e5, restitution: 1}}
simulation: {{duration: 8, step: 1 ms}}
"""
        )

    def rates(harmless, t, y):
        stops = 2e5 * (max(-0.05 - y[0], 0.0) - max(y[0] - 0.1, 0.0))
        return y[1], amplitude[harmless] * np.cos(11.0 * t) + stops

    return known("rattle", text, rates, (0.0, 0.0), 8.0, resolved=2e-4)


def quick_filter():
    """A feedback through a filter of 50 µs, in steps of 1 ms; harmlessly of 20 ms."""
    tau = {False: 5e-5, True: 0.02}

    def text(harmless):
        return (
            CART.format(name="filter", mass=1)
            + f"""
control: {{lag: {{type: low-pass, input: 1 - rail.displacement, time_constant: {tau[harmless]}, start: 0}}}}
forces: {{push: {{type: motor, coordinate: rail, effort: 30*lag - 4*rail.displacement_rate}}}}
simulation: {{duration: 1, step: 1 ms}}
"""
        )

    def exact(time, harmless):
        T = tau[harmless]
        A = np.array([[0.0, 1.0, 0.0, 0.0], [0.0, -4.0, 30.0, 0.0], [-1.0 / T, 0.0, -1.0 / T, 1.0 / T], [0.0] * 4])
        return np.array([(expm(A * t) @ [0.0, 0.0, 0.0, 1.0])[0] for t in time])

    return Deceiving("quick-filter", lambda harmless: parsed(text(harmless)), "cart.position.x", exact)


def gust():
    """Wind by a user's expression of place and time that comes for 1 ms, in steps of 10 ms; harmlessly for 0.3 s."""
    width = {False: 1e-3, True: 0.3}

    def text(harmless):
        w = width[harmless]
        return (
            CART.format(name="gust", mass=1)
            + f"""
forces: {{wind: {{type: force, body: cart, vector: ["{1.0 / w}*exp(-((time - 0.4033)/{w})**2)*(1 + cart.x)", 0, 0]}}}}
simulation: {{duration: 1, step: 10 ms}}
"""
        )

    def rates(harmless, t, y):
        w = width[harmless]
        return y[1], np.exp(-(((t - 0.4033) / w) ** 2)) / w * (1.0 + y[0])

    return known("gust", text, rates, (0.0, 0.0), 1.0, resolved=5e-5)


KINDS = (
    rope(),
    stop(),
    narrow_state(),
    narrow_block(),
    quick_winding(),
    humming_input(),
    narrow_brake(),
    between_stops(),
    quick_filter(),
    gust(),
)
