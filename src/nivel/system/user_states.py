"""User states in numbers: continuous ones are elements that give a rate, sampled ones stand in a table of their own."""

from __future__ import annotations

import numpy as np

from nivel.kernels.forces.state_rate import apply as state_rate
from nivel.kernels.record import NONE, Sampled
from nivel.machine.state import State
from nivel.system.builder import SystemBuilder
from nivel.system.located import located
from nivel.system.state_facts import StateFact
from nivel.system.tables import index_array


def add_states(draft: SystemBuilder) -> None:
    """All user states, and the rates of continuous ones."""
    for state in draft.machine.states:
        with draft.noting():
            own = draft.own_state(_fact(state))
            key = "rate" if state.rate is not None else "update"
            with located(f"states.{state.name}.{key}"):
                function = draft.function(getattr(state, key))
            if state.rate is not None or state.every is not None:
                draft.elements.add(state_rate, [own, function, int(state.rate is None)])


def _fact(state: State) -> StateFact:
    return StateFact(
        name=state.name,
        units=state.units or "1",
        long_name=f"state {state.name}",
        start=state.start,
        scale=state.size,
        sampled=state.update is not None,
    )


def sampled_states(draft: SystemBuilder) -> Sampled:
    """The table of sampled states."""
    states = [state for state in draft.machine.states if state.update is not None]
    events = [event.name for event in draft.machine.events]
    functions = []
    for state in states:
        assert state.update is not None
        with located(f"states.{state.name}.update"):
            functions.append(draft.function(state.update))
    return Sampled(
        state=index_array([draft.state(state.name) for state in states], 1),
        function=index_array(functions, 1),
        event=index_array([NONE if state.event is None else events.index(state.event) for state in states], 1),
        period=np.array([state.every or 0.0 for state in states]),
        at_rest=np.zeros(1, dtype=np.uint32),
        came=np.zeros(len(events), dtype=np.uint32),
        due=np.zeros(len(states), dtype=np.uint32),
        value=np.zeros(len(states)),
    )
