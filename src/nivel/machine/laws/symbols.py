"""Symbols of the machine in expressions: `hinge.angle_rate`, `tip.vx`.

A symbol is the name of an element, a dot and a quantity. Where several elements have one name, the first that has
the quantity is meant: of joints, inputs, states, blocks of the control, forces, hydraulics, sensors, markers and bodies, in this order.
"""

from collections.abc import Iterator, Mapping, Sequence
from difflib import get_close_matches
from functools import lru_cache
from typing import Any, Final, Literal

from nivel.elements.circuits import record_of
from nivel.elements.control import BLOCKS
from nivel.elements.forces import FORCES
from nivel.elements.joints import drawn
from nivel.lazy import Struct
from nivel.machine.core.index import Index, Place
from nivel.machine.core.record import entry
from nivel.machine.laws.time_function import Expression, PythonLaw, Table
from nivel.machine.laws.varying_value import SIGNAL_PATH
from nivel.machine.units.arithmetic import LOCAL_SYMBOLS, bind
from nivel.machine.units.grammar import parse
from nivel.machine.units.tree import ExpressionError, FaultyParameterError, Parameters, signals
from nivel.words.wording import in_expressions

Section = Literal["joints", "inputs", "states", "control", "forces", "hydraulics", "sensors", "markers", "bodies"]

POINT_QUANTITIES: Final = ("x", "y", "z", "vx", "vy", "vz")
STATE_QUANTITY: Final = "value"
TURN_QUANTITIES: Final = ("wx", "wy", "wz")
SENSOR_QUANTITIES: Final = {"distance": ("distance", "rate"), "angle": ("angle", "rate")}
# keys of what may use symbols
VARYING_KEYS: Final = ("vector", "law", "magnitude", "effort", "speed", "target", "value", "when", "rate", "update")


class Symbol(Struct):
    """`quantity` of the element `name` of a `section`."""

    section: Section
    name: str
    quantity: str


class UnknownSymbolError(ValueError):
    """There is no such symbol; the message says what there is."""


def find_symbol(path: str, machine: Any) -> Symbol:
    """What `path` stands for in `machine`, a record.

    Raises UnknownSymbolError.
    """
    return find_in(path, machine.index)


def find_in(path: str, index: Index) -> Symbol:
    """As `find_symbol`, with the index of the machine.

    Raises UnknownSymbolError.
    """
    name, _, quantity = path.partition(".")
    having: list[str] = []
    for section, elements in _quantities(index).items():
        if quantity in elements.get(name, ()):
            return Symbol(section, name, quantity)
        having += elements.get(name, ())
    if having:
        near = get_close_matches(quantity, having, n=1, cutoff=0.6)
        hint = f"did you mean `{name}.{near[0]}`?" if near else f"it has {', '.join(having)}"
        raise UnknownSymbolError(f"`{name}` has no `{quantity}`; {hint}")
    if name == "state" and quantity in index.states:
        raise UnknownSymbolError(f"the value of the state `{quantity}` is written `{quantity}.{STATE_QUANTITY}`")
    if name in index.beams:
        raise UnknownSymbolError(
            f"`{name}` is a beam and has no symbols; name a marker at one of its stations and use that"
        )
    if name in index.sensors:
        raise UnknownSymbolError(
            f"`{name}` is a sensor without symbols: use what it measures, such as `hinge.angle_rate`, or a sensor of a `distance` "
            f"or an `angle`, which has `{name}.rate`"
        )
    known = [each for elements in _quantities(index).values() for each, its in elements.items() if its]
    near = get_close_matches(name, known, n=1, cutoff=0.6)
    hint = f"; did you mean `{near[0]}.{quantity}`?" if near else ""
    empty = any(name in elements for elements in _quantities(index).values())
    kinds = "joint, input, state, block, component, sensor, marker or body"
    what = f"`{name}` has no symbols" if empty else f"there is no {kinds} `{name}`"
    raise UnknownSymbolError(f"{what}{hint}")


def _of_component(component: Any) -> tuple[str, ...]:
    """Names of the quantities of a component, a record or raw data: `pressure`, `flow_PA`, …"""
    kind = record_of(entry(component, "type"))
    return () if kind is None else kind.signals_in(component)


@lru_cache(maxsize=4)
def _quantities(index: Index) -> dict[Section, dict[str, tuple[str, ...]]]:
    """Section → element → the quantities that it has."""
    return {
        "joints": {name: _of_joint(type_) for name, type_ in index.joints.items()},
        "inputs": dict.fromkeys(index.inputs, (STATE_QUANTITY,)),
        "states": dict.fromkeys(index.states, (STATE_QUANTITY,)),
        "control": {name: quantities_of(block) for name, block in index.control.items()},
        "forces": {name: (*states_of(force), *outputs_of(force)) for name, force in index.forces.items()},
        "hydraulics": {name: _of_component(each) for name, each in index.hydraulics.items()},
        "sensors": {name: _of_sensor(sensor) for name, sensor in index.sensors.items()},
        "markers": {name: _of_frame(body, index) for name, body in index.markers.items()},
        "bodies": {name: _of_frame(name, index) for name in index.bodies if "." not in name},
    }


def _of_joint(type_: str) -> tuple[str, ...]:
    names = drawn(type_).coordinates
    return (*names, *(f"{name}_rate" for name in names))


def _of_sensor(sensor: Any) -> tuple[str, ...]:
    return next((its for form, its in SENSOR_QUANTITIES.items() if entry(sensor, form) is not None), ())


def states_of(force: Any) -> tuple[str, ...]:
    """The first-order states of a force: the bristle of friction by the lugre model, the length of a rope on a winch."""
    if entry(force, "type") == "rope":
        return ("length",) if entry(force, "speed") is not None else ()
    return ("bristle",) if entry(force, "model") == "lugre" else ()


def outputs_of(force: Any) -> tuple[str, ...]:
    """What a force reports, states and what it is not asked for left out."""
    kind = FORCES.get(str(entry(force, "type")))
    names = () if kind is None else kind.record.outputs
    hidden = {"bristle"} if entry(force, "friction_work") else {"bristle", "friction_work"}
    return tuple(name for name in names if name not in hidden)


def is_output(symbol: Symbol, index: Index) -> bool:
    """Whether it is reported by a force, and thus known only when all forces are."""
    return symbol.section == "forces" and symbol.quantity not in states_of(index.forces[symbol.name])


def follows_control(symbol: Symbol, index: Index) -> bool:
    """Whether it follows from flows, and these from the control."""
    if symbol.section != "hydraulics":
        return False
    kind = record_of(entry(index.hydraulics[symbol.name], "type"))
    return kind is not None and symbol.quantity not in kind.early


def quantities_of(block: Any) -> tuple[str, ...]:
    """The symbols of a block of a control: its value, and what else its kind has."""
    kind = BLOCKS.get(str(entry(block, "type")))
    return (STATE_QUANTITY,) if kind is None else kind.record.symbols(block)


def _of_frame(body: str, index: Index) -> tuple[str, ...]:
    return POINT_QUANTITIES if body in index.point_masses else (*POINT_QUANTITIES, *TURN_QUANTITIES)


def symbol_faults(
    element: Any, place: Place, index: Index, parameters: Parameters, keys: Sequence[str] = VARYING_KEYS
) -> Iterator[tuple[Place, str]]:
    """Symbols that a force, component, state, block, sensor or event uses in vain, under the `keys` that may use any."""
    late = reads_outputs(str(place[0]), element)
    for key in keys:
        value = entry(element, key)
        for where, path in paths_in(value, (*place, key), index, parameters):
            try:
                symbol = find_in(path, index)
            except UnknownSymbolError as problem:
                yield where, str(problem)
                continue
            if not late and is_output(symbol, index):
                yield where, of_forces(path)
            elif place[0] == "control" and not late and follows_control(symbol, index):
                yield where, of_circuits(path)


def reads_outputs(section: str, element: Any) -> bool:
    """Whether functions of an element are taken when all forces are known: of events, sensors and whatever is sampled."""
    if section in ("states", "control"):
        return any(entry(element, key) is not None for key in ("update", "sample_time"))
    return section in ("sensors", "events")


def of_forces(path: str) -> str:
    """What is wrong with an output of a force where forces are not known yet."""
    name = path.replace(".", "_")
    return (
        f"`{path}` is known only when all forces are, on which this depends; take a sample of it: "
        f"`control: {{{name}: {{type: signal, value: {path}, sample_time: 1 ms}}}}`, and here `{name}.value`"
    )


def of_circuits(path: str) -> str:
    """What is wrong with a signal that follows from flows where the control computes at once."""
    name = path.replace(".", "_")
    return (
        f"`{path}` follows from the flows, and these from the control; take a sample of it: "
        f"`{name}: {{type: signal, value: {path}, sample_time: 1 ms}}`, and here `{name}.value`"
    )


def paths_in(value: Any, place: Place, index: Index, parameters: Parameters) -> Iterator[tuple[Place, str]]:
    """Places and paths of the symbols in what varies; local symbols, which have no dot, are passed over."""
    match value:
        case str():
            yield from ((place, path) for path in _in_text(value, index, parameters))
        case Expression() | Table() | PythonLaw():
            yield from ((place, path) for path in value.signals if "." in path)
        case Mapping():
            of = value.get("of")
            if isinstance(of, str) and SIGNAL_PATH.fullmatch(of):  # a whole path, in which a name may have a `-`
                yield (*place, "of"), in_expressions(of)
            yield from paths_in(value.get("arguments"), (*place, "arguments"), index, parameters)
        case list() | tuple():
            for at, each in enumerate(value):
                yield from paths_in(each, (*place, at), index, parameters)


def _in_text(text: str, index: Index, parameters: Parameters) -> tuple[str, ...]:
    """The paths in an expression; what is reported where the text is read is left out."""
    try:
        tree = parse(text)
    except ExpressionError:
        return ()
    try:
        return tuple(path for path in signals(bind(tree, parameters, LOCAL_SYMBOLS)) if "." in path)
    except ExpressionError:
        return tuple(path for path in signals(tree) if not _has_hyphen(path, index))
    except FaultyParameterError:
        return signals(tree)


def _has_hyphen(path: str, index: Index) -> bool:
    """Whether an element's name ends in this one behind a `-`, which an expression takes for minus."""
    ending = f"-{path.partition('.')[0]}"
    moving = (index.joints, index.sensors, index.markers, index.bodies)
    names = (name for its in (*moving, index.inputs, index.states, index.control, index.hydraulics) for name in its)
    return any(name.endswith(ending) for name in names)
