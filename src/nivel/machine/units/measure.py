"""The dimension of an expression, and whether it makes sense: lengths are not added to masses, no sine is of metres.

`time` and each signal may count as a bare number, as in `sin(2*pi*time)`, or as a quantity, as in `5 N/s * time`.
A dimension by name belongs to signals that are quantities; a `rate` is of a length or of an angle.
"""

import re
from collections.abc import Iterator, Mapping
from functools import reduce
from itertools import islice, product
from typing import Final

from nivel.machine.units import tree
from nivel.machine.units.arithmetic import FREE_CONSTANTS, evaluate
from nivel.machine.units.functions import FUNCTIONS
from nivel.machine.units.grammar import parse
from nivel.machine.units.tree import CONSTANTS, ExpressionError, Name, Number, Parameters, leaves
from nivel.machine.units.unit import UNITS, Dimension, described, dimension, known, power, symbol, without_angle
from nivel.machine.units.unit import product as product_of
from nivel.words.wording import listed

_RADIAN: Final = dimension(rad=1)
_SECOND: Final = dimension(s=1)
_METRE: Final = dimension(m=1)
_SPEED: Final = dimension(m=1, s=-1)
_TURN_RATE: Final = dimension(rad=1, s=-1)
_MOST_READINGS: Final = 2000

# The dimension of a variable in one reading; None for a bare number, which it also is where it is not listed.
Reading = Mapping[str, Dimension | None]


def signal_dimensions(path: str) -> tuple[Dimension, ...]:
    """What the signal `path` may measure, by its last name; empty where that name does not tell."""
    last = path.rpartition(".")[2]
    match last:
        case "displacement" | "distance" | "length" | "depth" | "bristle" | "x" | "y" | "z":
            return (_METRE,)
        case "vx" | "vy" | "vz":
            return (_SPEED,)
        case "wx" | "wy" | "wz":
            return (_TURN_RATE,)
        case "rate":
            return (_SPEED, _TURN_RATE)
        case "value" if "." not in path:  # of a state it may be anything
            return (_METRE, _RADIAN)
    if last.endswith("_rate"):
        of = signal_dimensions(last.removesuffix("_rate"))
        return tuple(tuple(a + b for a, b in zip(one, power(_SECOND, -1) or (), strict=True)) for one in of)
    return (_RADIAN,) if last.startswith("angle") else ()


def readings(node: tree.Node) -> Iterator[Reading]:
    """The ways to take the variables of `node`, likely ones first: all bare, all quantities, then each either way."""
    choices: dict[str, tuple[Dimension | None, ...]] = {
        path: (None, *signal_dimensions(path)) for path in tree.signals(node)
    }
    if any(isinstance(leaf, tree.Time) for leaf in tree.leaves(node)):
        choices[tree.TIME] = (None, _SECOND)
    yield {}
    quantities = [options[1:] or options for options in choices.values()]
    for options in (quantities, list(choices.values())):
        for chosen in islice(product(*options), _MOST_READINGS):
            yield dict(zip(choices, chosen, strict=True))


def measure(node: tree.Node, reading: Reading | None = None) -> Dimension | None:
    """Dimension of `node` in one reading of its variables; None for a bare number.

    Raises ExpressionError where dimensions clash.
    """
    reading = reading or {}
    match node:
        case tree.Number(_, its):
            return None if its is None else known(its)
        case tree.Time():
            return reading.get(tree.TIME)
        case tree.Signal(path):
            return reading.get(path)
        case tree.Negative(operand):
            return measure(operand, reading)
        case tree.Call(function, arguments):
            return _of_call(function, [measure(argument, reading) for argument in arguments])
        case tree.Operation(symbol, left, right):
            return _of_operation(symbol, left, right, reading)
        case tree.Lookup(argument):
            measure(argument, reading)  # for clashes in it; the points of a curve are numbers
            return None
        case tree.Name(text):
            raise tree.ExpressionError(f"`{text}` has no value")


def refuse_unlike_terms(node: tree.Node) -> None:
    """Refuse a sum in which a quantity with a unit stands beside `time` or a signal of another dimension: `hinge.angle - 2 m`.

    Only where they stand for themselves: in `200*arm.x - 5 N` the bare 200 may be a stiffness.
    Raises ExpressionError.
    """
    terms = list(_terms(node))
    quantities = [its for term in terms if not tree.varies(term) and (its := measure(term)) is not None]
    if len({without_angle(its) for its in quantities}) > 1:
        return  # what clashes without the signals is told by `measure`
    for term in terms:
        match term:
            case tree.Time():
                name, own = tree.TIME, (_SECOND,)
            case tree.Signal(path):
                name, own = path, signal_dimensions(path)
            case _:
                continue
        for its in quantities:
            if own and all(without_angle(its) != without_angle(each) for each in own):
                meant = " or ".join(described(each) for each in own)
                raise tree.ExpressionError(
                    f"`{name}` is {meant}; {described(its)} cannot be added to it or subtracted from it"
                )


def _terms(node: tree.Node) -> Iterator[tree.Node]:
    """What is added and subtracted in `node`, without signs."""
    match node:
        case tree.Operation("+" | "-", left, right):
            yield from _terms(left)
            yield from _terms(right)
        case tree.Negative(operand):
            yield from _terms(operand)
        case _:
            yield node


def _of_operation(symbol: str, left: tree.Node, right: tree.Node, reading: Reading) -> Dimension | None:
    first, second = measure(left, reading), measure(right, reading)
    match symbol:
        case "+" | "-":
            return _same(first, second, "added" if symbol == "+" else "subtracted")
        case "<" | "<=" | ">" | ">=":
            _same(first, second, "compared")
            return None
        case "and" | "or":
            return None
        case "*":
            return product_of(first, second)
        case "/":
            return product_of(first, power(second, -1))
    if without_angle(second) != without_angle(None):
        raise tree.ExpressionError(f"an exponent is a pure number, not {described(second)}")
    if first is None:
        return None
    if tree.varies(right):
        raise tree.ExpressionError("a quantity with a unit cannot be raised to a power that changes with time")
    return power(first, evaluate(right))


def _of_call(function: str, arguments: list[Dimension | None]) -> Dimension | None:
    units, result = FUNCTIONS[function].units, None
    if units.taken:
        for each in arguments:
            if without_angle(each) != without_angle(None):
                raise tree.ExpressionError(f"`{function}` is taken of {units.taken}, not of {described(each)}")
    for group in units.alike:
        its = reduce(lambda first, second, done=group.done: _same(first, second, done), group.of(arguments))
        result = product_of(result, power(its, group.exponent)) if group.exponent else result
    return _RADIAN if units.is_angle else result


def _same(first: Dimension | None, second: Dimension | None, action: str) -> Dimension | None:
    if first is None or second is None:
        return first if second is None else second
    if without_angle(first) != without_angle(second):
        raise tree.ExpressionError(f"{described(first)} and {described(second)} cannot be {action}")
    return first


# Names that are those of a parameter and of a unit or constant: what stands for which, in words.

LITRE: Final = ("l", "L")  # what a parameter may take the name of, also behind a number
# units with the letters of quantities
_WORDS: Final = {
    "m": "the metre",
    "g": "the gram",
    "t": "the tonne",
    "s": "the second",
    "h": "the hour",
    "N": "the newton",
    "J": "the joule",
    "W": "the watt",
}


def name_notes(parameters: Mapping[str, object]) -> tuple[str, ...]:
    """What a reader has to know of `parameters` that have the name of a unit or of a constant, in sentences without a full stop."""
    numbers = {name: value for name, value in parameters.items() if isinstance(value, Number)}
    units = {name: value for name, value in numbers.items() if name in UNITS}
    notes = []
    if units:
        which = listed([f"`{name}` ({_shown(value)})" for name, value in units.items()])
        others, first = listed([*map(_other_meaning, units)]), next(iter(units))
        are, they = (
            ("is the parameter", "it is the unit") if len(units) == 1 else ("are the parameters", "they are the units")
        )
        notes.append(f"in expressions {which} {are}, not {others}; directly after a number {they}: `2 {first}`")
    notes += [
        f"in expressions `{name}` ({_shown(value)}) is the parameter, not {_other_meaning(name)}"
        for name, value in numbers.items()
        if name in FREE_CONSTANTS
    ]
    return tuple(notes)


def shared_names_hint(text: str, parameters: Parameters) -> str:
    """What the shared names in an expression stand for there, as the end of a message on it; empty where there are none."""
    try:
        found = [leaf for leaf in leaves(parse(text)) if isinstance(leaf, Name) and leaf.text in parameters]
    except ExpressionError:
        return ""
    hints = []
    for name in dict.fromkeys(found):
        if name.place == "free" and (name.text in UNITS or name.text in FREE_CONSTANTS):
            hints.append(f"`{name.text}` is the parameter here, not {_other_meaning(name.text)}")
        elif name.text in LITRE and name.place != "free":
            others = [f"`{each}`" for each in (*LITRE, "dm^3") if each not in parameters]
            hints.append(f"`{name.text}` is your parameter; litre is {' or '.join(others)}")
        elif re.search(rf"\*\s*{name.text}\b", text) and name.text in UNITS:
            hints.append(
                f"`{name.text}` is {_other_meaning(name.text)} here; the parameter is written `(2 N)*{name.text}`"
            )
    return f" ({'; '.join(hints)})" if hints else ""


def _other_meaning(name: str) -> str:
    return f"the constant {CONSTANTS[name]:.5g}" if name in CONSTANTS else _WORDS.get(name, f"the unit `{name}`")


def _shown(number: Number) -> str:
    return f"{number.value:g}" if number.dimension is None else f"{number.value:g} {symbol(number.dimension)}"
