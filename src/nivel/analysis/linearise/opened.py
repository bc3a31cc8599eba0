"""Commands and inputs as states that stay: linear equations have their columns as those of an input.

The law of a command becomes that law and a state x without a rate, which is zero: c + x. An input of the machine becomes a state of its
name, so that everything goes on reading it. Derivatives with respect to such states are exact, as those of all states.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, Final

from nivel.elements.circuits.component import Component
from nivel.errors import Fault, ModelError
from nivel.lazy import dataclass
from nivel.machine.laws.table import Table
from nivel.machine.machine_record import MachineRecord
from nivel.machine.signals.state import State
from nivel.machine.units.expression import Expression

# what moves a circuit: inputs of its linear equations where none are named
COMMANDS: Final = ("command", "current")
UNITS: Final = {
    "command": "1",
    "current": "A",
    "flow": "m^3/s",
    "load": "N m",
    "margin": "Pa",
    "opening": "1",
    "opens_at": "Pa",
    "pressure": "Pa",
    "setting": "1",
    "speed": "rad/s",
    "torque_limit": "N m",
}


@dataclass(frozen=True)
class Opened:
    """A machine whose commands are states. states : name of an input of its linear equations → (name of its state, unit).

    commands : those of its circuits that are inputs without being named.
    """

    machine: MachineRecord
    states: dict[str, tuple[str, str]]
    commands: tuple[str, ...] = ()


def opened(machine: MachineRecord, wanted: Sequence[str] | None, time: float) -> Opened:
    """The machine at `time` [s] with these inputs as states, those of them that are inputs or laws of a circuit; None: its commands.

    Raises ModelError for laws to which nothing can be added.
    """
    known = {
        f"{component.name}.{key}": (component, key) for component in machine.hydraulics for key in _varying(component)
    }
    commands = () if wanted is not None else tuple(name for name, (_, key) in known.items() if key in COMMANDS)
    inputs = {each.name: each for each in machine.inputs}
    names = dict.fromkeys(name.removeprefix("hydraulics.") for name in (commands if wanted is None else wanted))
    taken = {each.name for section in (machine.states, machine.inputs, machine.control) for each in section}
    states: dict[str, tuple[str, str]] = {}
    added: list[State] = []
    laws: dict[str, dict[str, Expression]] = {}
    for name in names:
        if name in inputs:
            course = inputs[name].course
            value = course(time) if isinstance(course, Table) else float(course)
            added.append(State(name=name, rate=0.0, start=value))
            states[name] = (name, inputs[name].units or "1")
        elif name in known:
            component, key = known[name]
            own = _free_name(f"{component.name}_{key}", taken)
            laws.setdefault(component.name, {})[key] = _sum(f"hydraulics.{name}", getattr(component, key), own, time)
            added.append(State(name=own, rate=0.0))
            states[name] = (own, UNITS.get(key, ""))
    if not added:
        return Opened(machine, {})
    left = tuple(each for each in machine.inputs if each.name not in states)
    components = tuple(each.replace(**laws[each.name]) if each.name in laws else each for each in machine.hydraulics)
    changed = machine.replace(inputs=left, states=(*machine.states, *added), hydraulics=components)
    return Opened(changed, states, commands)


def _varying(component: Component) -> Iterator[str]:
    return (key for key in type(component).functions if getattr(component, key) is not None)


def _free_name(name: str, taken: set[str]) -> str:
    while name in taken:
        name += "_"
    taken.add(name)
    return name


def _sum(place: str, law: Any, state: str, time: float) -> Expression:
    """A law and a state. Raises ModelError where there is no sum."""
    match law:
        case Expression():
            return Expression(f"({law.text}) + {state}.value")
        case Table() if not law.signals:
            return Expression(f"{law(time)!r} + {state}.value")
        case float() | int():
            return Expression(f"{float(law)!r} + {state}.value")
    key = place.rpartition(".")[2]
    message = f"no input can be added to a table of a signal or a law in Python: write it as `{key}: lever.value`, with an input `lever`"
    raise ModelError(Fault.at(place, message))
