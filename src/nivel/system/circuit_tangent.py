"""Tables of the derivatives of circuits by hand: which states and coordinates they have, and in which order these are eliminated."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from nivel.elements.circuits import directional_valves, pistons, poppets, pump_control, rotary, spools, volumes
from nivel.elements.circuits.kind import SLOPES
from nivel.kernels.record.circuit_record import CircuitTangent
from nivel.kernels.record.hook import FAMILIES, Family
from nivel.kernels.record.record import NONE, Hooks, Record
from nivel.system.elimination.factor_plan import minimum_degree
from nivel.system.system import System
from nivel.system.tables import zeros

Index = NDArray[np.uint32]
# columns with the states that outputs of families are, at their first column
STATES: dict[Family, int] = {
    directional_valves.move: poppets.STATE,
    poppets.lift: poppets.STATE,
    spools.drive: spools.STATE,
    pump_control.regulate: pump_control.STATE,
}
# and with the coordinates on which families act
COORDINATES: dict[Family, int] = {
    pistons.guide: pistons.COORDINATE,
    rotary.turn: rotary.COORDINATE,
    spools.ride: spools.RIDDEN,
}


def with_circuit_tangent(system: System) -> System:
    """The system with room for the derivatives of its circuits, in relative coordinates."""
    record = system.record
    adding = [
        (number, slopes.address)
        for number, family in enumerate(_families(record))
        if (slopes := SLOPES.get(family)) is not None
    ]
    address = np.array([*record.hooks.address, *(address for _, address in adding)], dtype=np.uint64)
    tangent = _tables(system, np.array([number for number, _ in adding], dtype=np.uint32))
    return replace(
        system, record=record._replace(circuit=record.circuit._replace(tangent=tangent), hooks=Hooks(address))
    )


def _families(record: Record) -> list[Family]:
    return [FAMILIES[int(address)] for address in record.elements.address]


def _tables(system: System, family: Index) -> CircuitTangent:
    """family : as in `CircuitTangent`."""
    record = system.record
    state = _in_order(system)
    coordinate = np.unique([q for q in _coordinates(record) if q != NONE]).astype(np.uint32)
    unknown = _numbers(state, len(record.elements.state))
    own = _families(record)
    guides = own.index(pistons.guide) if pistons.guide in own else NONE
    states, count, nodes, velocities = len(state), len(coordinate), len(record.circuit.node), len(record.tree.column)
    size, width = states + count, states + 2 * count
    return CircuitTangent(
        family=family,
        pistons=np.array([guides], dtype=np.uint32),
        state=state,
        unknown=unknown,
        coordinate=coordinate,
        number=_numbers(coordinate, len(record.coordinates.what)),
        signal=_signals(record, unknown),
        source=_sources(record, unknown),
        by_mass=np.zeros(nodes),
        by_stroke=np.zeros((nodes, count)),
        effort=np.zeros((count, width)),
        slopes=np.zeros((size, width)),
        **zeros("direction response", count, velocities),
        compliance=np.zeros((count, count)),
        matrix=np.zeros((2, size, size)),
        b=np.zeros(size),
        load=np.zeros(count),
        travel=np.zeros((2, count)),
    )


def _in_order(system: System) -> Index:
    """States of circuits, by minimum degree of what their components couple."""
    count = len(system.record.elements.state)
    own = [k for k in range(count) if not (system.states[k].integral or system.states[k].sampled)]
    neighbours: list[set[int]] = [set() for _ in own]
    place = {state: k for k, state in enumerate(own)}
    for each in system.coupled:
        for a, b in combinations(sorted(place[state] for state in each.states if state in place), 2):
            neighbours[a].add(b)
            neighbours[b].add(a)
    order, _ = minimum_degree([1] * len(own), neighbours, {})
    return np.array([own[k] for k in order], dtype=np.uint32)


def _rows(record: Record, family: Family) -> Iterator[tuple[int, list[int]]]:
    """Number and columns of each element of a family; none where the machine does not have it."""
    own = _families(record)
    if family in own:
        for k in range(*record.elements.span[own.index(family)].tolist()):
            yield k, record.elements.columns[k].tolist()


def _coordinates(record: Record) -> Iterator[int]:
    """Those on which pistons and motors act."""
    for each, column in COORDINATES.items():
        for _, columns in _rows(record, each):
            yield columns[column]


def _numbers(chosen: Index, count: int) -> Index:
    """The inverse of `chosen`: the number of each of `count` among these, or NONE."""
    out = np.full(count, NONE, dtype=np.uint32)
    out[chosen] = np.arange(len(chosen))
    return out


def _signals(record: Record, unknown: Index) -> Index:
    """Of each node that is a signal the number of its state."""
    out = np.full(len(record.circuit.node), NONE, dtype=np.uint32)
    for _, columns in _rows(record, volumes.find_pressures):
        if columns[volumes.KIND] == volumes.SIGNAL:
            out[columns[volumes.NODE]] = unknown[columns[volumes.STATE]]
    return out


def _sources(record: Record, unknown: Index) -> Index:
    """Of each output that is a position or a setting its state, or the poppet whose pressures give it."""
    out = np.full((len(record.outputs.value), 2), NONE, dtype=np.uint32)
    for each, column in STATES.items():
        for k, columns in _rows(record, each):
            if columns[column] != NONE:
                out[columns[0], 0] = unknown[columns[column]]
            elif each is poppets.lift:
                out[columns[0], 1] = k
    return out
