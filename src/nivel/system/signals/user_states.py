"""User states in numbers: continuous ones are elements that give a rate, sampled ones stand in a table of their own."""

from __future__ import annotations

from fractions import Fraction
from math import gcd

import numpy as np

from nivel.elements.states import StateFact
from nivel.errors import located
from nivel.kernels.record.record import NONE, Sampled
from nivel.kernels.signals.functions import rate_states
from nivel.known import State
from nivel.system.builder import SystemBuilder
from nivel.system.signals.control import ONCE, SampleTable, add_samples
from nivel.system.tables import index_array


def add_states(builder: SystemBuilder) -> None:
    """All user states, and the rates of continuous ones."""
    for state in builder.machine.states:
        with builder.noting():
            own = builder.own_state(_fact(state))
            key = "rate" if state.rate is not None else "update"
            with located(f"states.{state.name}.{key}"):
                function = builder.function(getattr(state, key), sampled=state.rate is None)
            if state.rate is not None or state.every is not None:
                builder.elements.add(rate_states, [own, function, int(state.rate is None)])


def _fact(state: State) -> StateFact:
    return StateFact(
        name=state.name,
        units=state.units or "1",
        long_name=f"state {state.name}",
        start=state.start,
        scale=state.size,
        sampled=state.update is not None,
    )


# Denominators up to here are tried: nanoseconds, and thirds, sevenths, nineteenths of microseconds.
MOST = 10**9
# A ratio this close to an interval is that interval: some units in its last place.
SAME = 1e-15


def ratio_of(interval: float) -> Fraction:
    """The simplest ratio of whole numbers that is `interval` [s], except for its round-off.

    With it n · numerator / denominator is rounded once: 3 samples of 0.3 s are 0.9 s, where 3 * 0.3 is a unit in the last place less.
    An interval that is no such ratio stays what it is.
    """
    ratio = Fraction(interval).limit_denominator(MOST)
    return ratio if abs(ratio - Fraction(interval)) <= SAME * abs(interval) else Fraction(interval)


def ticks(offset: float, interval: float) -> tuple[float, float, float]:
    """First, step and rate with (first + n step) / rate = offset + n interval [s], all whole where both times are such ratios."""
    begin, step = ratio_of(offset), ratio_of(interval)
    rate = begin.denominator * step.denominator
    first, each = begin * rate, step * rate
    if max(first, each, rate) > 2**53:
        return offset, interval, 1.0
    common = gcd(first.numerator, each.numerator, rate)
    return float(first / common), float(each / common), float(rate / common)


def sampled_states(builder: SystemBuilder) -> Sampled:
    """The table of what is sampled: user states, then blocks of the control."""
    events = [event.name for event in builder.machine.events]
    table = SampleTable()
    for state in builder.machine.states:
        if state.update is None:
            continue
        with located(f"states.{state.name}.update"):
            function = builder.function(state.update, sampled=True)
        event = NONE if state.event is None else events.index(state.event)
        table.add(builder.state(state.name), function, period=state.every or 0.0, event=event)
    functions: dict[int, int] = {}  # those of several samples
    for state, function, period, offset in builder.samples:
        if id(function) not in functions:
            functions[id(function)] = builder.function(function, sampled=True)
        table.add(state, functions[id(function)], period=period or ONCE, offset=offset)
    add_samples(builder, table)
    count = len(table.rows)
    state, output, at_once, function, event, period, offset = zip(*table.rows, strict=True) if count else ((),) * 7
    times = np.array([ticks(*each) for each in zip(offset, period, strict=True)]).reshape(count, 3)
    return Sampled(
        state=index_array(state, 1),
        output=index_array(output, 1),
        at_once=index_array(at_once, 1),
        function=index_array(function, 1),
        event=index_array(event, 1),
        first=times[:, 0].copy(),
        ticks=times[:, 1].copy(),
        rate=times[:, 2].copy(),
        at_rest=np.zeros(1, dtype=np.uint32),
        came=np.zeros(len(events), dtype=np.uint32),
        due=np.zeros(count, dtype=np.uint32),
        value=np.zeros(count),
    )
