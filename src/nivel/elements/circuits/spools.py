"""Spools that solenoids move against springs, and valves that switch late.

A proportional spool, with everything over the force of the spring between its middle and its full stroke:

    ü = ω² (D(w) - u - P u/√(u² + U²) - F tanh(u̇/V) - φ - s) - 2 ζ ω u̇

D is the input w without its dead band, P the preload of the springs, F friction, φ the steady force of the flow, which closes every edge
that it passes (`nivel.elements.circuits.edges`), and s the stop at the end of the stroke. The input follows c = command + dither with
a play of the width H:

    ẇ = (c - w - H/2)⁺/τ - (w - c - H/2)⁺/τ

A valve that switches is on where its command is above one half. An energy e goes to 1 within t_on + t_move, and back to 0 within
t_off + t_move; the valve moves where a < e < b, so that both delays are as they are given:

    ė = r tanh((g - e)/E)        u = S((e - a)/(b - a))
"""

import math
from dataclasses import replace
from typing import Annotated

import numpy as np

from nivel.elements.circuits.curves import CurveOf, SomeCurve, held_curve
from nivel.elements.circuits.kind import Phase, called, slopes_of
from nivel.elements.circuits.smooth import clipped, magnitude_within, sign_within, step
from nivel.elements.facts import StateFact
from nivel.elements.rows import element
from nivel.kernels.algebra.analytic import real, tanh
from nivel.kernels.record.function import evaluate_function, table_value
from nivel.kernels.record.record import NONE, record_at
from nivel.known import SpoolValve, SystemBuilder, TimeFunction
from nivel.machine.core.coefficient import Frequency, NotNegativeDuration, NotNegativeForce, PositiveNumber, Truth
from nivel.machine.core.record import Checked
from nivel.machine.given import Field, OneNumber
from nivel.machine.laws.varying_value import Table
from nivel.machine.units.quantity import Duration, Quantity
from nivel.native.function import leaf

SYMBOL, CURRENT_SYMBOL = "position", "current"


class Switching(Checked):
    """Delays of a valve that is on or off: on where its command is above one half."""

    on_delay: NotNegativeDuration = Field("from the command until it moves", default=0.0)
    off_delay: NotNegativeDuration = Field("the same when it is switched off", default=0.0)
    time: Duration = Field("from where it begins to move until it is open, or closed", default=0.01)


class Solenoid(Checked):
    """Forces of proportional solenoids, with springs that centre the spool or push it back."""

    force: Annotated[SomeCurve, CurveOf("force", CURRENT_SYMBOL)] = Field("over the magnitude of the current")
    spring: Annotated[OneNumber, Quantity("stiffness", positive=True)] = Field("stiffness of the spring")
    preload: NotNegativeForce = Field("of the spring in its middle", default=0.0)
    friction: NotNegativeForce = Field("of the spool; dither overcomes it", default=0.0)
    transition_speed: PositiveNumber = Field("strokes per second: friction changes its sign", default=0.02)
    flow_force: Truth = Field("whether the force of the flow acts on the spool", default=True)


class Dither(Checked):
    """A vibration of the command."""

    amplitude: PositiveNumber = Field("share of the full command, of the full force of solenoids")
    frequency: Frequency


# columns of `columns`; PLAY: state w, or NONE; STATE: u; CURVE: table of the force over the current that the command is, or NONE; output:
# position
OUTPUT, STATE, SPEED, COMMAND, PLAY, CURVE = 0, 1, 2, 3, 4, 5
# columns of `number`: least input, natural frequency ω [rad/s], ζ, P, F, V [1/s], H, dead band, dither: amplitude, frequency [rad/s];
# corner of the flows [Pa]; then the force of each edge over its Q √Δp, negative where it acts towards smaller positions
LEAST, FREQUENCY, DAMPING, PRELOAD, FRICTION, SLOW, PLAY_WIDTH, DEAD, DITHER, DITHER_FREQUENCY, CORNER, FIRST_FORCE = (
    range(12)
)
# U of the preload, τ [s] of the play, stiffness of the stop over that of the spring
CENTRE, PLAY_TIME, STOP = 0.005, 1e-3, 100.0

# valves that switch: columns of `columns` as above to COMMAND, STATE: e; of `number`: least position, rates [1/s] up and down, a, b
UP, DOWN, BEGIN, END = 1, 2, 3, 4
# spools that are bodies: the coordinate behind OUTPUT
RIDDEN = 1
ROUNDED = 0.01  # E


@leaf
def beyond(x, band):
    """What of x is outside -band … band."""
    if real(x) > real(band):
        return x - band
    if real(x) < -real(band):
        return x + band
    return 0.0 * x


@leaf
def without_dead_band(w, band):
    """The input that a dead band leaves: full at a full input."""
    return beyond(w, band) * (1.0 / (1.0 - real(band)))


@leaf
def balance(n, u, v, wish):
    """The acceleration of a spool at its position u and speed v, without the force of the flow."""
    omega = n[FREQUENCY]
    force = wish - u - n[PRELOAD] * sign_within(u, CENTRE) - n[FRICTION] * tanh(v * (1.0 / n[SLOW]))
    acceleration = omega * omega * force - 2.0 * n[DAMPING] * omega * v
    over = beyond(u, 1.0 + 0.0 * u)
    if real(over) != 0.0:
        acceleration = acceleration - omega * omega * STOP * over - 2.0 * np.sqrt(STOP) * omega * v
    return acceleration


@leaf
def force_of(functions, curve, current, least):
    """The force of solenoids at a current, over that of the springs; a second solenoid, where `least` is negative, acts the other way."""
    back = real(current) < 0.0
    force, _, _ = table_value(functions, curve, -current if back else current)
    return -force if back and least < 0.0 else force


@called(Phase.POSITIONS, 5)
@element
def drive(machine, index, n, t):
    """Inputs and positions of proportional spools."""
    record = record_at(machine)
    elements, rate = record.elements, record.elements.state_rate
    wish = evaluate_function(machine, index[COMMAND], t)
    wish = (
        clipped(wish, n[LEAST])
        if index[CURVE] == NONE
        else force_of(record.functions, index[CURVE], wish, real(n[LEAST]))
    )
    if real(n[DITHER]) != 0.0:
        wish = wish + n[DITHER] * np.sin(n[DITHER_FREQUENCY] * t)
    if index[PLAY] != NONE:
        held = elements.state[index[PLAY]]
        rate[index[PLAY]] += beyond(wish - held, 0.5 * n[PLAY_WIDTH]) * (1.0 / PLAY_TIME)
        wish = held
    wish = without_dead_band(wish, n[DEAD])
    if index[STATE] == NONE:
        record.outputs.value[index[OUTPUT]] = wish
        return
    u, v = elements.state[index[STATE]], elements.state[index[SPEED]]
    rate[index[STATE]] += v
    rate[index[SPEED]] += balance(n, u, v, wish)
    record.outputs.value[index[OUTPUT]] = u


@called(Phase.POSITIONS, 2)
@element
def switch(machine, index, n, t):
    """Energies and positions of valves that switch."""
    record = record_at(machine)
    elements = record.elements
    command = clipped(evaluate_function(machine, index[COMMAND], t), n[LEAST])
    goal = 0.0
    if real(command) > 0.5:
        goal = 1.0
    elif real(command) < -0.5:
        goal = -1.0
    e = elements.state[index[STATE]]
    growing = goal != 0.0 and goal * real(e) >= 0.0
    pace = n[UP] if growing else n[DOWN]
    elements.state_rate[index[STATE]] += pace * tanh((goal - e) * (1.0 / ROUNDED))
    size = magnitude_within(e, 1e-9)
    opening = step((size - n[BEGIN]) * (1.0 / (n[END] - n[BEGIN])))
    record.outputs.value[index[OUTPUT]] = opening if real(e) >= 0.0 else -opening


@called(Phase.POSITIONS, 6, slow=True)
@element
def ride(machine, index, n, t):
    """Positions of spools that are bodies; columns: the output and the coordinate, number: strokes a metre."""
    record = record_at(machine)
    record.outputs.value[index[OUTPUT]] = n[0] * record.coordinates.value[index[RIDDEN]]


@slopes_of(drive)
@element
def add_slopes(machine, index, n, t):
    """Slopes of the inputs, positions and speeds of spools, for commands that do not depend on the state."""
    record = record_at(machine)
    elements, tangent = record.elements, record.circuit.tangent
    moved = index[PLAY] != NONE and elements.state_rate[index[PLAY]] != 0.0
    if moved:
        play = tangent.unknown[index[PLAY]]
        tangent.slopes[play, play] -= 1.0 / PLAY_TIME
    if index[STATE] == NONE:
        return
    own, speed, omega = tangent.unknown[index[STATE]], tangent.unknown[index[SPEED]], n[FREQUENCY]
    u, v = elements.state[index[STATE]], elements.state[index[SPEED]]
    size, turning = magnitude_within(u, CENTRE), tanh(v / n[SLOW])
    stiffness = 1.0 + n[PRELOAD] * CENTRE * CENTRE / (size * size * size)
    loss = 2.0 * n[DAMPING] * omega + omega * omega * n[FRICTION] * (1.0 - turning * turning) / n[SLOW]
    if np.abs(u) > 1.0:
        stiffness += STOP
        loss += 2.0 * np.sqrt(STOP) * omega
    tangent.slopes[own, speed] += 1.0
    tangent.slopes[speed, own] -= omega * omega * stiffness
    tangent.slopes[speed, speed] -= loss
    if index[PLAY] != NONE and np.abs(elements.state[index[PLAY]]) > n[DEAD]:
        play = tangent.unknown[index[PLAY]]
        tangent.slopes[speed, play] += omega * omega / (1.0 - n[DEAD])


@slopes_of(switch)
@element
def add_slopes_of_switches(machine, index, n, t):
    """Slopes of the energies of valves that switch."""
    record = record_at(machine)
    elements, tangent = record.elements, record.circuit.tangent
    rate = elements.state_rate[index[STATE]]
    pace = max(n[UP], n[DOWN])
    share = min(np.abs(rate) / pace, 1.0)
    tangent.slopes[tangent.unknown[index[STATE]], tangent.unknown[index[STATE]]] -= (
        pace * (1.0 - share * share) / ROUNDED
    )


SLOW_START = 1e-3  # [s] the least time in which a valve that switches moves


def add_switch(
    builder: SystemBuilder, name: str, output: int, command: TimeFunction, switching: Switching, two_sided: bool
) -> None:
    """A valve that is on or off, with its delays."""
    state = builder.own_state(StateFact(f"{name}.energy", "1", f"energy of the solenoid of {name}", 0.0, 1.0))
    moving = max(switching.time, SLOW_START)
    share = 1.0 / (1.0 + switching.on_delay / moving + switching.off_delay / moving)
    begin = share * switching.on_delay / moving
    pace = share / moving
    numbers = [-1.0 if two_sided else 0.0, pace, pace, begin, begin + share]
    builder.elements.add(switch, [output, state, NONE, builder.function(command)], numbers)


def add_drive(builder: SystemBuilder, component: SpoolValve, position: int) -> int:
    """A proportional spool. Returns the state that is its speed, or NONE."""
    name, omega = component.name, 2.0 * math.pi * (component.frequency or 0.0)
    solenoid, dither = component.solenoid, component.dither
    state, speed, play = NONE, NONE, NONE
    if component.frequency is not None:
        state = builder.own_state(StateFact(f"{name}.spool", "1", f"position of {name}", 0.0, 1.0))
        speed = builder.own_state(StateFact(f"{name}.spool_speed", "1/s", f"speed of {name}", 0.0, omega))
    if component.hysteresis:
        play = builder.own_state(StateFact(f"{name}.input", "1", f"input of {name} behind its play", 0.0, 1.0))
    curve, preload, friction = NONE, 0.0, 0.0
    slow = 1.0
    least = -1.0 if component.two_sided else 0.0
    if solenoid is None:
        assert component.command is not None  # the record was checked
        command = builder.function(component.command)
    else:
        assert component.current is not None  # the record was checked
        full = full_force(component)
        command = builder.function(component.current)
        force = Table(solenoid.force.points, tuple(y / full for y in solenoid.force.values), "linear", "current")
        curve = held_curve(builder, replace(force, interpolation=solenoid.force.table.interpolation))
        preload, friction, slow = solenoid.preload / full, solenoid.friction / full, solenoid.transition_speed
    amplitude = dither.amplitude if dither is not None else 0.0
    numbers = [least, omega, component.damping_ratio, preload, friction, slow, component.hysteresis]
    numbers += [component.dead_band, amplitude, 2.0 * math.pi * (dither.frequency if dither is not None else 0.0)]
    builder.elements.add(drive, [position, state, speed, command, play, curve], numbers)
    return speed


def full_force(component: SpoolValve) -> float:
    """[N] of the springs between the middle and the full stroke."""
    assert component.solenoid is not None
    assert component.stroke is not None
    return component.solenoid.spring * component.stroke
