"""State machines: at each sample the guards of the present state are looked at, and the first that holds leads on."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator

from nivel.elements.kind import Kind
from nivel.machine.control.block import Block, Condition, Input, names_in
from nivel.machine.control.part import Part, PartFunction
from nivel.machine.core.record import Name, Problem, Record, entry, unknown_word
from nivel.machine.given import Field, Given, Maybe
from nivel.machine.laws.time_function import SomeFunction, TimeFunction
from nivel.machine.units.formula import Formula, formula, linear
from nivel.machine.units.tree import Call, Node, Operation, Signal
from nivel.machine.units.tree import Number as Constant


def _conditions(value: Any) -> Any:
    return value if isinstance(value, list | tuple) else [value]


def _named(key: str, content: str) -> Any:
    """Validator: a mapping from names to what they are, as a list of records."""

    def listed(value: Any) -> Any:
        if not isinstance(value, Mapping):
            return value
        return [
            {key: name, **each} if not content and isinstance(each, Mapping) else {key: name, content: each}
            for name, each in value.items()
        ]

    return BeforeValidator(listed)


class Transition(Record):
    """To another state, as soon as all conditions hold."""

    to: Name
    when: Annotated[
        Given[tuple[Condition, ...], tuple[TimeFunction, ...], str | Sequence[str]], BeforeValidator(_conditions)
    ]


class StateOutput(Record):
    """A value that a state gives to an output of its machine."""

    name: Name
    value: Input


class MachineState(Record):
    """One state: its value, what else it puts out, and where it leads."""

    name: Name
    value: Maybe[Input] = Field("default its number, from 0", default=None)
    outputs: Annotated[
        Given[tuple[StateOutput, ...], tuple[StateOutput, ...], Mapping[str, SomeFunction] | Sequence[StateOutput]],
        _named("name", "value"),
    ] = Field("further values by name, which are zero in states that do not give them", default=())
    next: Annotated[
        Given[tuple[Transition, ...], tuple[Transition, ...], Mapping[str, str | Sequence[str]] | Sequence[Transition]],
        _named("to", "when"),
    ] = Field("state → condition, or list of conditions that all hold; the first that holds is taken", default=())


class StateMachine(Block):
    """One of several states at a time; at each sample at most one transition."""

    quantities = ("value", "state", "time")

    type: Literal["state-machine"] = "state-machine"
    states: Annotated[
        Given[tuple[MachineState, ...], tuple[MachineState, ...], Mapping[str, Any] | Sequence[MachineState]],
        _named("name", ""),
    ]
    start: Name | None = Field("default the first state", default=None)

    @classmethod
    def symbols(cls, given: Any) -> tuple[str, ...]:
        states = entry(given, "states")
        each = states.values() if isinstance(states, Mapping) else states if isinstance(states, list | tuple) else ()
        return (*cls.quantities, *_output_names(entry(one, "outputs") for one in each))

    def computation(self) -> tuple[Part, ...]:
        names = [state.name for state in self.states]
        began = float(names.index(self.start)) if self.start else 0.0
        own = self.path("state")
        guards, arms = [], []
        for k, state in enumerate(self.states):
            arm: Node = Constant(float(k))
            for transition in reversed(state.next):
                first = len(guards)
                guards += transition.when
                conditions = [Signal(self.path(f"guard_{n + 1}")) for n in range(first, len(guards))]
                arm = Call("if", (_all(conditions), Constant(float(names.index(transition.to))), arm))
            arms.append(arm)
        since = formula(
            "if(state < before or state > before, time, entered)",
            **{name: self.path(name) for name in ("state", "before", "entered")},
        )
        return (
            *(Part(f"guard_{n + 1}", "sample", condition, key="states") for n, condition in enumerate(guards)),
            Part("state", "sample", Formula(_chosen(Signal(own), arms)), began, holds=True),
            *self._values(
                self.output,
                [state.value if state.value is not None else float(k) for k, state in enumerate(self.states)],
            ),
            *(
                part
                for name in _output_names(state.outputs for state in self.states)
                for part in self._named_values(name)
            ),
            Part("before", "memory", linear((1.0, own)), began, holds=True),
            Part("entered", "memory", since, holds=True),
            Part("time", "signal", linear((1.0, "time"), (-1.0, self.path("entered")))),
        )

    def _named_values(self, name: str) -> Iterator[Part]:
        given = [{each.name: each.value for each in state.outputs}.get(name, 0.0) for state in self.states]
        return self._values(name, given)

    def _values(self, name: str, given: Sequence[PartFunction]) -> Iterator[Part]:
        """What the states give, and of it that of the present state."""
        values: list[Node] = []
        for k, value in enumerate(given):
            if isinstance(value, float | int):
                values.append(Constant(float(value)))
            else:
                part = f"{name}_{k}"
                yield Part(part, "sample", value, key="states")
                values.append(Signal(self.path(part)))
        first = values[[state.name for state in self.states].index(self.start) if self.start else 0]
        chosen = Formula(_chosen(Signal(self.path("state")), values))
        yield Part(name, "sample", chosen, first.value if isinstance(first, Constant) else 0.0)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        names = [state.name for state in self.states]
        if not names:
            yield Problem(("states",), "a state was expected, got none")
        for name in dict.fromkeys(name for name in names if names.count(name) > 1):
            yield Problem(("states",), f"the state `{name}` stands twice")
        if self.start is not None and self.start not in names:
            yield Problem(("start",), unknown_word(self.start, names, "state"))
        for state in self.states:
            for transition in state.next:
                if transition.to not in names:
                    yield Problem(
                        ("states",),
                        f"`{state.name}` leads to a state that is not there: {unknown_word(transition.to, names, 'state')}",
                    )
            for each in state.outputs:
                if each.name in self.quantities or each.name.startswith(("guard_", "before", "entered")):
                    yield Problem(
                        ("states",),
                        f"the output `{each.name}` of `{state.name}` has a meaning already; choose another name",
                    )
        if self.sample_time is None:
            yield Problem((), "`sample_time` is missing: guards are looked at at samples")


def _output_names(outputs: Iterable[Any]) -> tuple[str, ...]:
    """Names of the outputs of all states, which may be raw data."""
    return tuple(dict.fromkeys(name for each in outputs for name in names_in(each)))


def _all(conditions: Sequence[Node]) -> Node:
    """Positive where all conditions are."""
    if len(conditions) > 1:
        return Call("min", (*conditions,))
    return conditions[0] if conditions else Constant(1.0)


def _chosen(state: Node, values: Sequence[Node], first: int = 0) -> Node:
    """The value that belongs to the number of a state. first : number of the first value. By halves, so that many states nest little."""
    half = len(values) // 2
    if not half:
        return values[0]
    before = Operation("<", state, Constant(first + half - 0.5))
    return Call("if", (before, _chosen(state, values[:half], first), _chosen(state, values[half:], first + half)))


KINDS = (Kind(StateMachine),)
