"""Start of hydraulic circuits: the pressures that carry the loads of the machine as assembled, and a steady circuit around them.

1. The effort of every actuator at rest follows from accelerations, which are linear in the pressures: those that vanish are asked for,
   of all actuators at once, with the pressures that are given.
   The chamber that cannot carry its load has the pressure of the lowest tank, the other one what the load asks for. A piston without load
   at the end of its stroke is held there by its stop.
2. With these held, all other states of the circuits go to rest by steps of Euler's implicit method that become longer and longer
   (pseudo-transient continuation, Kelley and Keyes 1998). A volume that is closed keeps the pressure of the lowest tank.

Pressures that are given stay as they are.
"""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assembly.equations import MotionEquations
from nivel.elements.circuits.actuators import RotaryActuator
from nivel.elements.circuits.chambers import Actuator, chamber_node
from nivel.elements.circuits.density import ATMOSPHERE
from nivel.elements.circuits.engines import Engine
from nivel.elements.circuits.gases import GAS_CONSTANT, RATIO, SURROUNDINGS
from nivel.elements.circuits.nodes import Node
from nivel.elements.circuits.pistons import ORIGIN, guide
from nivel.elements.circuits.pumps import HydraulicMotor
from nivel.elements.circuits.tanks import Reservoir
from nivel.elements.circuits.volumes import VOLUME, mass_at
from nivel.errors import Fault, refuse
from nivel.kernels.core.status import OK
from nivel.kernels.record.record import NONE
from nivel.lazy import Struct, replace, scipy
from nivel.machine.machine_record import MachineRecord
from nivel.system.system import Array, System

# what a pressure is moved by to see what it does [Pa]
PROBE = 1e5
# Loads that ask for less pressure than this [Pa] are none; opposite a given pressure a chamber may be as empty as this.
NO_LOAD = 1e3
# Pressures with less than this share of the largest effect do nothing. The weight of equal shares against accelerations that vanish.
IDLE, WEIGHT = 1e-12, 1e-6
# steps of pseudo-time: the first one [s], the factor to the next, their number; at rest, states change by less than this share of their
# scale in a second
FIRST, FACTOR, MOST, AT_REST = 1e-6, 3.0, 200, 1e-9
# of Newton's iteration in each: most iterations, changes that end it and steps of differences as shares of the scales
ITERATIONS, CLOSE, DIFFERENCE = 8, 1e-6, 1e-7
# a change above this share of the last one asks for new derivatives
FALLING = 0.1
# Engines that come to rest turn forwards, and not faster than this many times the largest speed of their torque curve.
LEAST_SPEED, MOST_SPEED = -1e-3, 2.0
# A piston may stand beyond the end of its stroke by this share of it.
BEYOND = 1e-3


class _Pair(Struct):
    """The nodes on both sides of actuators, in which they have their loads: B None where it is the open air.

    at_end : whether a piston between them is at the end of its stroke, where a stop can hold it.
    """

    a: int
    b: int | None
    at_end: bool = False


def circuit_start(machine: MachineRecord, motion: MotionEquations, y: Array) -> tuple[System, Array]:
    """The system and its state y (absolute coordinates) with the start of its circuits.

    Raises ModelError where a piston stands beyond its stroke, and where an engine has no steady speed.
    """
    y = y.copy()
    motion.evaluate(0.0, y)
    _refuse_strokes(machine, motion.system)
    start = _Start(machine, motion, y)
    start.carry_loads()
    start.come_to_rest()
    start.refuse_engines()
    start.y[start.velocities] = start.moving
    system, first = motion.system, start.first
    x = start.y[first : first + len(system.states)]
    states = tuple(replace(fact, start=float(x[k])) for k, fact in enumerate(system.states))
    return replace(system, states=states), start.y


def _values_of(machine: MachineRecord, system: System) -> Iterator[tuple[Actuator, float, float]]:
    """Every actuator with its length or angle in the state last evaluated, and that at the start of its stroke."""
    elements = system.record.elements
    row = int(np.flatnonzero(elements.address == guide.address)[0]) if guide.address in elements.address else None
    for k, actuator in enumerate(each for each in machine.hydraulics if isinstance(each, Actuator)):
        assert row is not None
        e = int(elements.span[row, 0]) + k
        value = float(system.record.coordinates.value[elements.columns[e, 2]])
        yield actuator, value, float(elements.number[e, ORIGIN])


def _refuse_strokes(machine: MachineRecord, system: System) -> None:
    """Actuators that are too long or too short for where they are, in the state last evaluated."""
    faults = []
    for actuator, value, origin in _values_of(machine, system):
        stroke = actuator.way
        if -BEYOND * stroke <= value - origin <= (1.0 + BEYOND) * stroke:
            continue
        turns = isinstance(actuator, RotaryActuator)
        unit, what = ("rad", "turned to") if turns else ("m", "between its ends")
        key = "lower" if turns else "retracted_length"
        message = f"{value:.6g} {unit} {what} at the start, and its stroke goes from {origin:.6g} to {origin + stroke:.6g} {unit}"
        faults.append(Fault.at(f"hydraulics.{actuator.name}.{key}", message))
    refuse(faults)


class _Loaded(Struct):
    """Line `high` of a motor that carries a load: its pressure follows that of the line `low`, by `ratio` from `offset` [Pa] on."""

    high: int
    low: int
    ratio: float
    offset: float


class _Start:
    """Pressures of nodes and states of circuits on their way to the start."""

    def __init__(self, machine: MachineRecord, motion: MotionEquations, y: Array) -> None:
        system = motion.system
        self.machine, self.motion, self.system, self.y = machine, motion, system, y
        self.circuit, self.nodes = system.record.circuit, system.nodes
        self.first = len(y) - len(system.start_of_states)
        self.velocities = slice(system.positions, self.first)
        self.moving = y[self.velocities].copy()
        self.y[self.velocities] = 0.0
        self.pressure = np.array([self._at_first(k, node) for k, node in enumerate(self.nodes)])
        self.held = {k for k, node in enumerate(self.nodes) if node.start is not None}
        self.gas = [node for node in self.nodes if node.energy != NONE]
        self.loaded: list[_Loaded] = []  # lines of motors, until the circuit is at rest

    def _given(self, k: int) -> float:
        return float(self.circuit.pressure[k])

    def _at_first(self, k: int, node: Node) -> float:
        if node.start is not None:
            return node.start
        return self._lowest(node.fluid) if _has_state(node) else self._given(k)

    def _lowest(self, fluid: int) -> float:
        """[Pa] of the lowest tank of a fluid."""
        tanks = [self._given(k) for k, node in enumerate(self.nodes) if not _has_state(node) and node.fluid == fluid]
        for each in (each for each in self.machine.hydraulics if isinstance(each, Reservoir)):
            tanks += [each.pressure for node in self.nodes if node.owner == each.name and node.fluid == fluid]
        return min(tanks, default=ATMOSPHERE)

    def _put(self, pressure: Array) -> None:
        """Give the volumes these pressures, and signals theirs."""
        for k, node in enumerate(self.nodes):
            if node.kind == VOLUME:
                fluid, room = self.circuit.fluid[node.fluid], self.circuit.room[k]
                self.y[self.first + node.state] = mass_at(fluid, room, float(self.circuit.volume[k]), pressure[k])
                self._warm(node)
            elif _has_state(node):
                self.y[self.first + node.state] = pressure[k]

    def _warm(self, node: Node) -> None:
        """Give gas the temperature of its surroundings."""
        if node.energy != NONE:
            f = self.circuit.fluid[node.fluid]
            inner = f[GAS_CONSTANT] / (f[RATIO] - 1.0) * f[SURROUNDINGS]
            self.y[self.first + node.energy] = self.y[self.first + node.state] * inner

    def _accelerations(self, pressure: Array) -> Array:
        self._put(pressure)
        _, rate = self.motion.evaluate(0.0, self.y)
        return rate[self.velocities]

    # --- loads ---

    def _pairs(self) -> list[_Pair]:
        """Nodes between which actuators and motors carry loads, each pair once."""
        index = {node.name: k for k, node in enumerate(self.nodes)}
        out: dict[tuple[int, int | None], _Pair] = {}
        values = _values_of(self.machine, self.system)
        strokes = {each.name: (value - origin) / each.way for each, value, origin in values}  # their shares
        for each in self.machine.hydraulics:
            at_end = each.name in strokes and min(strokes[each.name], 1.0 - strokes[each.name]) <= BEYOND
            if isinstance(each, Actuator):
                ends = [index[chamber_node(each, chamber)] for chamber in each.chambers]
            elif isinstance(each, HydraulicMotor):
                ends = [index[each.ports["A"]], index[each.ports["B"]]]
            else:
                continue
            if all(self.nodes[k].kind == VOLUME for k in ends):
                pair = _Pair(ends[0], ends[1] if len(ends) > 1 else None, at_end)
                out[pair.a, pair.b] = pair
        return list(out.values())

    def carry_loads(self) -> None:
        """Pressures of chambers for which the machine stays where it is, as far as pressures can hold it.

        All are found at once: the least squares of the accelerations, with pressures of free chambers not below their least one. Where
        several do, pistons carry equal shares.
        """
        pairs = self._pairs()
        sides = [k for pair in pairs for k in (pair.a, pair.b) if k is not None]
        free = [k for k in dict.fromkeys(sides) if k not in self.held]
        if not free:
            self._put(self.pressure)
            return
        base = self.pressure.copy()
        left = self._accelerations(base)
        effect = {k: self._effect(base, left, k) for k in dict.fromkeys(sides)}
        least = np.array([self._lowest(self.nodes[k].fluid) for k in free])
        base[free] = least
        for pair in pairs:
            if (given := self._opposite_a_given_one(pair)) is not None:
                k, opposite = given
                over = self._ratio(effect[k], effect[opposite]) * (base[opposite] - ATMOSPHERE)
                base[k] = max(base[k] + over - (least[free.index(k)] - ATMOSPHERE), NO_LOAD)
                least[free.index(k)] = NO_LOAD
        left = self._accelerations(base)
        columns = np.array([effect[k] for k in free]).T
        found = base.copy()
        found[free] += _held_by(columns, -left, least - base[free])
        for pair in pairs:
            self._take(pair, found, effect)
        self._put(self.pressure)

    def _opposite_a_given_one(self, pair: _Pair) -> tuple[int, int] | None:
        """The free chamber of a pair of which the other one has a given pressure, and that one."""
        if pair.b is None or (pair.a in self.held) == (pair.b in self.held):
            return None
        return (pair.b, pair.a) if pair.a in self.held else (pair.a, pair.b)

    def _effect(self, base: Array, left: Array, k: int) -> Array:
        """(nv,) accelerations per pressure in node k."""
        changed = base.copy()
        changed[k] += PROBE
        return (self._accelerations(changed) - left) / PROBE

    @staticmethod
    def _ratio(a: Array, b: Array) -> float:
        """Area of chamber b over that of the opposite chamber a, from what their pressures do."""
        square = float(a @ a)
        return -float(b @ a) / square if square > 0.0 else 1.0

    def _take(self, pair: _Pair, found: Array, effect: dict[int, Array]) -> None:
        """Hold the pressures that were found for a pair; without load a motor, or a piston at the end of its stroke, needs none."""
        own = [k for k in (pair.a, pair.b) if k is not None and k not in self.held]
        if pair.b is not None and len(own) == 2 and (pair.at_end or self._motor_between(pair) is not None):
            load = (
                found[pair.a] - ATMOSPHERE - self._ratio(effect[pair.a], effect[pair.b]) * (found[pair.b] - ATMOSPHERE)
            )
            if abs(load) <= NO_LOAD:
                return
        self.pressure[own] = found[own]
        self.held |= set(own)
        if pair.b is not None and len(own) == 2 and self._motor_between(pair) is not None:
            high, low = sorted((pair.a, pair.b), key=lambda k: -float(found[k]))
            ratio = self._ratio(effect[high], effect[low])
            self.loaded.append(_Loaded(high, low, ratio, float(found[high] - ratio * found[low])))

    def _motor_between(self, pair: _Pair) -> HydraulicMotor | None:
        names = {self.nodes[k].name for k in (pair.a, pair.b) if k is not None}
        motors = (each for each in self.machine.hydraulics if isinstance(each, HydraulicMotor))
        return next((each for each in motors if {each.ports["A"], each.ports["B"]} == names), None)

    # --- rest ---

    def come_to_rest(self) -> None:
        """Let all states that are not held go where they stay; the line of a loaded motor on its low side too, if there is such a place,
        with the load on top of it."""
        before, loaded = self.y.copy(), self.loaded
        if self._relax() or not loaded:
            return
        self.y[:], self.loaded = before, []
        self._relax()

    def _relax(self) -> bool:
        """Whether the states come to rest."""
        fixed = {self.nodes[k].state for k in self.held - {pair.low for pair in self.loaded}}
        fixed |= {state for node in self.nodes for state in (node.energy, node.warmth)}
        fixed |= {k for k, fact in enumerate(self.system.states) if fact.sampled or fact.name.startswith("hydraulics.")}
        own = _states_of_circuits(self.system)
        free = np.array([k for k in own if k not in fixed], dtype=int)
        if not len(free):
            return True
        step, scale = FIRST, np.array([self.system.states[k].scale for k in free])
        for _ in range(MOST):
            rate = self._rates(free)
            if rate is None or np.all(np.abs(rate) <= AT_REST * scale):
                return rate is not None
            step *= FACTOR if self._step(free, scale, step) else 1.0 / FACTOR**2
        return False

    def refuse_engines(self) -> None:
        """Engines that cannot turn what they drive: they have no steady speed."""
        speed = {fact.name: float(self.y[self.first + k]) for k, fact in enumerate(self.system.states)}
        faults = []
        for engine in (each for each in self.machine.hydraulics if isinstance(each, Engine)):
            share = speed[f"{engine.name}.speed"] / max(engine.torque_curve.speeds)
            if LEAST_SPEED <= share <= MOST_SPEED:
                continue
            if share < 0.0:
                told = "pumps and `load` ask for more torque at t = 0 than the `torque_curve` has, and stall it"
                advice = "give it more torque, or its pumps a `torque_limit` or a smaller `setting`"
            else:
                told = "pumps and `load` drive it at t = 0 with more torque than its `drag`"
                advice = "give it more `drag`, or drive it with less"
            faults.append(Fault.at(f"hydraulics.{engine.name}", f"no speed is steady: {told}; {advice}"))
        refuse(faults)

    def _rates(self, free: NDArray[np.intp]) -> Array | None:
        for node in self.gas:
            self._warm(node)
        status, rate = self.motion.evaluate(0.0, self.y)
        if status == OK and self.loaded:
            for pair in self.loaded:
                node, pressure = self.nodes[pair.high], pair.offset + pair.ratio * self._given(pair.low)
                fluid, room = self.circuit.fluid[node.fluid], self.circuit.room[pair.high]
                self.y[self.first + node.state] = mass_at(fluid, room, float(self.circuit.volume[pair.high]), pressure)
            status, rate = self.motion.evaluate(0.0, self.y)
        found = rate[self.first + free]
        return found if status == OK and np.isfinite(found).all() else None

    def _step(self, free: NDArray[np.intp], scale: Array, step: float) -> bool:
        """One step of Euler's implicit method, by Newton's iteration. Returns whether it ends; else nothing is changed."""
        places, before, matrix, size = self.first + free, self.y.copy(), None, np.inf
        for _ in range(ITERATIONS):
            rate = self._rates(free)
            if rate is not None and matrix is None:
                matrix = self._matrix(free, scale, rate)
            if rate is None or matrix is None:
                break
            try:
                change = np.linalg.solve(np.eye(len(free)) / step - matrix, rate - (self.y - before)[places] / step)
            except np.linalg.LinAlgError:  # singular for this step; for a shorter one it is not
                break
            self.y[places] += change
            size, last = float(np.max(np.abs(change) / scale)), size
            if size <= CLOSE:
                return True
            if size > FALLING * last:
                matrix = None  # of an earlier state: no longer good enough
        self.y[:] = before
        return False

    def _matrix(self, free: NDArray[np.intp], scale: Array, rate: Array) -> Array | None:
        """Derivatives of the rates, by differences; None where one cannot be evaluated."""
        matrix = np.zeros((len(free), len(free)))
        for j, k in enumerate(free):
            kept = self.y[self.first + k]
            self.y[self.first + k] = kept + DIFFERENCE * scale[j]
            moved = self._rates(free)
            self.y[self.first + k] = kept
            if moved is None:
                return None
            matrix[:, j] = (moved - rate) / (DIFFERENCE * scale[j])
        return matrix


def _held_by(columns: Array, right: Array, lowest: Array) -> Array:
    """(n,) changes of pressures x ≥ lowest with the least |columns x - right|, and of those the least |x| in units of their effects.

    Pressures that do nothing do not change. The least |x| is found with a small weight, which is left out again where the pressures at
    their bounds are known.
    """
    size = np.linalg.norm(columns, axis=0)
    working = size > IDLE * max(float(size.max()), 1e-300)
    out = np.zeros(columns.shape[1])
    scaled = columns[:, working] / size[working]
    count = scaled.shape[1]
    if not count:
        return out
    unit = float(np.linalg.norm(right)) or 1.0
    bound = lowest[working] * size[working] / unit
    weighted = np.vstack([scaled, WEIGHT * np.eye(count)])
    x = scipy.optimize.lsq_linear(
        weighted, np.concatenate([right / unit, np.zeros(count)]), (bound, np.inf), method="bvls"
    ).x
    inside = x > bound
    if np.any(inside):
        at_bounds = scaled[:, ~inside] @ bound[~inside]
        exact = np.linalg.lstsq(scaled[:, inside], right / unit - at_bounds, rcond=1e-9)[0]
        if np.all(exact >= bound[inside]):
            x[inside] = exact
    out[working] = x * unit / size[working]
    return out


def _has_state(node: Node) -> bool:
    return node.kind != 1


def _states_of_circuits(system: System) -> list[int]:
    names = {node.owner for node in system.nodes} | {""}
    return [k for k, fact in enumerate(system.states) if fact.name.partition(".")[0] in names or "." in fact.name]
