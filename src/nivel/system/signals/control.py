"""Blocks of a control in numbers: signals are elements that come before all forces, memories are states, samples a table of their own."""

from fractions import Fraction
from math import gcd

import numpy as np

from nivel.elements.facts import StateFact
from nivel.errors import located
from nivel.kernels.record.function import OUTPUT, STATE
from nivel.kernels.record.record import NONE, Sampled
from nivel.kernels.signals.functions import compute, rate_states
from nivel.known import PartOf, State
from nivel.lazy import dataclass, field
from nivel.machine.control.order import in_order, parts_of
from nivel.machine.control.part import VALUE
from nivel.machine.laws.symbols import find_in, follows_control, is_output
from nivel.system.builder import SystemBuilder
from nivel.system.tables import index_array

ONCE = 1e300  # [s] period of what is sampled once


@dataclass
class SampleTable:
    """Rows of `Sampled`: state, output, at once, function, event, period, offset."""

    rows: list[tuple[int, int, int, int, int, float, float]] = field(default_factory=list)

    def add(
        self, state: int, function: int, *, period: float, offset: float = 0.0, event: int = NONE, at_once: bool = False
    ) -> None:
        """A sample of a state: after a period [s], at an event, or both."""
        self.rows.append((state, NONE, int(at_once), function, event, period, offset))

    def add_signal(self, output: int, function: int) -> None:
        """A signal, which is computed anew at all samples."""
        self.rows.append((NONE, output, 1, function, NONE, 0.0, 0.0))


def variable_of(each: PartOf) -> str:
    """Result variable of a part."""
    return f"control.{each.block.name}" if each.part.name == VALUE else f"control.{each.path}"


def add_control(builder: SystemBuilder) -> None:
    """All parts of all blocks, and what computes signals and rates in every evaluation."""
    parts = parts_of(builder.machine.control)
    for each in parts:
        if each.part.role == "signal":
            output = builder.outputs.add((variable_of(each), _units(each), _words(each)))
            builder.control[each.path] = (OUTPUT, output, 0)
        else:
            builder.control[each.path] = (STATE, builder.own_state(_fact(each)), 0)
    order, _ = in_order(parts)
    for each in order:
        if each.part.role == "signal":
            builder.elements.add(compute, [builder.control[each.path][1], _noted(builder, each)])
    for each in parts:
        if each.part.role == "state":
            builder.elements.add(rate_states, [builder.control[each.path][1], _noted(builder, each), 0])
        elif each.part.role in ("sample", "memory") and not each.part.holds and not _reads_forces(builder, each):
            builder.elements.add(rate_states, [builder.control[each.path][1], _noted(builder, each), 1])


def add_samples(builder: SystemBuilder, table: SampleTable) -> None:
    """What is sampled: first what is computed at an instant, in order, then memories, all from the values before."""
    parts = parts_of(builder.machine.control)
    if not any(
        each.part.role != "signal" and (each.block.is_sampled or each.part.begins is not None) for each in parts
    ):
        return
    order, _ = in_order(parts)
    for each in order:
        index, place = builder.control[each.path][1], _place(each)
        with located(place):
            if each.part.role == "signal":
                table.add_signal(index, _function(builder, each))
            elif each.part.begins is not None:
                table.add(
                    index,
                    builder.function(each.present, sampled=True),
                    period=ONCE,
                    offset=each.block.offset,
                    at_once=True,
                )
            else:
                table.add(
                    index,
                    _function(builder, each),
                    period=each.block.period,
                    offset=each.block.offset + each.part.offset,
                    at_once=True,
                )
    for each in parts:
        if each.part.role == "memory":
            index, function = builder.control[each.path][1], _function(builder, each)
            table.add(index, function, period=each.block.period, offset=each.block.offset)


def _function(builder: SystemBuilder, each: PartOf) -> int:
    """Index of the function of a part; one that nothing has asked for before reads what forces report."""
    if each.path not in builder.functions_of:
        with located(_place(each)):
            builder.functions_of[each.path] = builder.function(each.part.function, sampled=True)
    return builder.functions_of[each.path]


def _reads_forces(builder: SystemBuilder, each: PartOf) -> bool:
    """Whether a sample takes something that forces report: it then keeps its value in statics."""
    index = builder.machine.index
    paths = [path for path in each.signals if path not in builder.control]
    symbols = [find_in(path, index) for path in paths]
    return any(is_output(symbol, index) or follows_control(symbol, index) for symbol in symbols)


def _noted(builder: SystemBuilder, each: PartOf) -> int:
    """The function of a part. What it depends on is noted, also for those that read its signal."""
    with builder.noting(), located(_place(each)):
        if each.part.role != "signal":
            builder.signal_at(each.path)
        in_motion = each.part.role in ("signal", "state") and not each.block.is_sampled
        function = builder.function(each.part.function, sampled=not in_motion)
    if each.part.role == "signal":
        builder.behind_signals[each.path] = builder.noted[-1]
    builder.functions_of[each.path] = function
    return function


def _place(each: PartOf) -> str:
    return f"control.{each.block.name}{f'.{each.part.key}' if each.part.key else ''}"


def _units(each: PartOf) -> str:
    return (each.block.units if each.part.name == VALUE else "") or "1"


def _words(each: PartOf) -> str:
    return f"{each.part.name.replace('_', ' ')} of {each.block.name}"


def _fact(each: PartOf) -> StateFact:
    name = variable_of(each)
    return StateFact(
        name=name,
        units=_units(each),
        long_name=_words(each),
        start=each.part.start,
        scale=max(each.block.size, abs(each.part.start)),
        sampled=each.part.role != "state",
        variable=name,
    )


# User states in numbers: continuous ones are elements that give a rate, sampled ones stand in a table of their own.


def add_states(builder: SystemBuilder) -> None:
    """All user states, and the rates of continuous ones."""
    for state in builder.machine.states:
        with builder.noting():
            own = builder.own_state(_fact_of(state))
            key = "rate" if state.rate is not None else "update"
            with located(f"states.{state.name}.{key}"):
                function = builder.function(getattr(state, key), sampled=state.rate is None)
            if state.rate is not None or state.every is not None:
                builder.elements.add(rate_states, [own, function, int(state.rate is None)])


def _fact_of(state: State) -> StateFact:
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
