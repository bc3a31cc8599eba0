"""The small arithmetic of machine files as a tree: ``2*length + 5 mm``, ``7850 kg/m^3``, ``10 + 3*sin(2*pi*time)``.

A comparison is 1 where it holds and 0 where it does not; a condition holds where its value is greater than zero.

grammar.py makes trees of texts. Here names are bound to parameters and units, and what does not vary becomes a number.
What varies is `time` and signals: what the machine itself does, such as `hinge.angle_rate`.
"""

import math
from collections.abc import Collection, Mapping, Sequence
from difflib import get_close_matches
from itertools import pairwise
from typing import Final, SupportsFloat

from nivel.machine.units import tree
from nivel.machine.units.functions import FEWEST, FUNCTIONS, INTERPOLATIONS, interpolated, misses_its_period
from nivel.machine.units.slips import spelled
from nivel.machine.units.unit import UNITS, UnknownUnitError, unit

RESERVED: Final = frozenset({tree.TIME, tree.LOOKUP, *tree.LOGICAL, *tree.CONSTANTS, *FUNCTIONS})
FREE_CONSTANTS: Final = frozenset({"e"})  # names that parameters and arguments of functions may take over
NOT_FOR_PARAMETERS: Final = RESERVED - FREE_CONSTANTS
PLACE: Final = ("x", "y")  # on ground
# where a law may use them they are signals
LOCAL_SYMBOLS: Final = ("length", "angle", "value", "depth", "rate", *PLACE)


def given(value: SupportsFloat) -> float:
    """`value`, which stood as a number where it was read, as a float.

    Raises ExpressionError for inf, nan and integers beyond the range of floats.
    """
    if isinstance(value, float) and math.isinf(value):
        raise tree.ExpressionError("a finite number was expected, got one that is infinite or too large")
    return tree.finite(value)


def bind(node: tree.Node, parameters: tree.Parameters, local: Collection[str] = ()) -> tree.Node:
    """`node` with every name replaced by what it stands for: one of the `local` symbols, else a parameter, a constant
    or a unit; directly behind a number a unit comes first.

    Raises ExpressionError for an unknown name or one with two meanings, FaultyParameterError for one that has no value
    because of its own fault.
    """
    match node:
        case tree.Name(text, "unit") if text in UNITS:
            return tree.Number(*UNITS[text])
        case tree.Name(text, "product") if text in UNITS and (text in parameters or text in local):
            raise tree.ExpressionError(
                f"`{text}` behind `*` and a unit may be the unit or the {'argument' if text in local else 'parameter'}: write a "
                f"space in place of `*` for the unit, as in `2 N {text}`, or parentheses for the other, as in `(2 N)*{text}`"
            )
        case tree.Name(text) if text in local:
            if text in parameters:
                raise tree.ExpressionError(
                    f"`{text}` is a parameter and has a meaning of its own here; rename the parameter"
                )
            return tree.Signal(text)
        case tree.Name(text):
            return _value_of(text, parameters, local)
        case tree.Operation():
            try:
                return tree.with_parts(node, lambda part: bind(part, parameters, local))
            except tree.UnknownNameError as problem:
                raise _hinting_at_hyphen(problem, node) from None
        case tree.Call(function, arguments):
            return _bind_call(function, arguments, parameters, local)
    return tree.with_parts(node, lambda part: bind(part, parameters, local))


def _bind_call(
    function: str, arguments: tuple[tree.Node, ...], parameters: tree.Parameters, local: Collection[str]
) -> tree.Node:
    """A call of a function of ours, a curve, or the body of a named function with its arguments put in."""
    if function == tree.LOOKUP:
        return _bind_lookup(arguments, parameters, local)
    bound = tuple(bind(argument, parameters, local) for argument in arguments)
    if function in FUNCTIONS:
        kind = FUNCTIONS[function]
        _check_count(function, len(bound), len(kind.names), kind.most)
        return tree.Call(function, bound)
    meant = parameters.get(function)
    if isinstance(meant, tree.Function):
        _check_count(function, len(bound), len(meant.arguments), len(meant.arguments))
        return tree.substituted(meant.body, dict(zip(meant.arguments, bound, strict=True)))
    if function in parameters:
        if meant is None:
            raise tree.FaultyParameterError(function)
        raise tree.ExpressionError(f"`{function}` is a number and takes no arguments; `*` is missing behind it")
    known = [*FUNCTIONS, tree.LOOKUP, *(name for name, each in parameters.items() if isinstance(each, tree.Function))]
    last = function.casefold().rpartition(".")[2]  # of `math.sin`
    near = [each for each in known if each == last] or get_close_matches(function, known, n=1)
    hint = f"; did you mean `{near[0]}`?" if near else f"; there are {', '.join(known)}"
    raise tree.ExpressionError(f"there is no function `{function}`{hint}")


def _check_count(function: str, given: int, fewest: int, most: int) -> None:
    if not fewest <= given <= most:
        wanted = str(fewest) if fewest == most else f"at least {fewest}"
        raise tree.ExpressionError(f"`{function}` takes {wanted} argument{'s' if fewest > 1 else ''}, got {given}")


def _bind_lookup(arguments: tuple[tree.Node, ...], parameters: tree.Parameters, local: Collection[str]) -> tree.Lookup:
    form = f"`{tree.LOOKUP}(x, linear, x0, y0, x1, y1, …)`"
    if len(arguments) < 4 or len(arguments) % 2:
        raise tree.ExpressionError(f"{form} was expected: an argument, an interpolation, and points in pairs")
    argument, kind, *numbers = arguments
    word, _, order = kind.text.partition("_") if isinstance(kind, tree.Name) else ("", "", "")
    if word not in INTERPOLATIONS or order not in ("", "1", "2", "3", "4"):
        raise tree.ExpressionError(f"{form} was expected, with one of {', '.join(INTERPOLATIONS)} as the interpolation")
    bound = [bind(number, parameters, local) for number in numbers]
    if any(tree.varies(number) for number in bound):
        raise tree.ExpressionError(f"the points of {form} are numbers; they cannot vary")
    values = [evaluate(number) for number in bound]
    points = tuple(values[::2])
    if any(after <= before for before, after in pairwise(points)):
        raise tree.ExpressionError(f"the points x0, x1, … of `{tree.LOOKUP}` increase")
    if len(points) < FEWEST[word]:
        raise tree.ExpressionError(f"a {word} `{tree.LOOKUP}` needs at least {FEWEST[word]} points, got {len(points)}")
    heights = tuple(values[1::2])
    if misses_its_period(word, heights):
        raise tree.ExpressionError(
            f"a periodic `{tree.LOOKUP}` ends with the value with which it begins, {heights[0]:g}, got {heights[-1]:g}"
        )
    return tree.Lookup(bind(argument, parameters, local), word, points, heights, int(order or 0))


def _hinting_at_hyphen(problem: tree.UnknownNameError, node: tree.Operation) -> tree.ExpressionError:
    """`problem`, found in `node`, which may be meant as one symbol: `left-hinge.angle`."""
    before, after = list(tree.leaves(node.left))[-1], next(tree.leaves(node.right))
    is_name = isinstance(before, tree.Name) and before.text == problem.name
    if node.symbol != "-" or not is_name or not isinstance(after, tree.Signal):
        return problem
    element = after.path.partition(".")[0]
    return tree.ExpressionError(
        f"{problem}; and the name `{problem.name}-{element}` cannot stand in an expression, where `-` is the minus sign:"
        f" rename it to `{problem.name}_{element}`"
    )


def _value_of(name: str, parameters: tree.Parameters, local: Collection[str]) -> tree.Number | tree.Signal:
    if name in parameters:
        value = parameters[name]
        if value is None:
            raise tree.FaultyParameterError(name)
        if isinstance(value, tree.Function):
            raise tree.ExpressionError(f"`{name}` is a function; write `{name}({', '.join(value.arguments)})`")
        return value
    if name in tree.CONSTANTS:
        return tree.Number(tree.CONSTANTS[name])
    meant = spelled(name)
    try:
        if not meant or name in UNITS or not name.lstrip("kMm").startswith("N"):
            return tree.Number(*unit(name))  # pint would take the `s` of `Nms` for a plural
    except UnknownUnitError:
        pass
    if name.lower() in tree.NOT_FINITE:
        raise tree.ExpressionError(f"a finite number is needed, got `{name}`")
    near = _near(name, [*local, *parameters, *RESERVED, *UNITS])
    hint = f"; write `{meant}`" if meant else f"; did you mean `{near[0]}`?" if near else ""
    raise tree.UnknownNameError(name, hint)


def _near(name: str, known: Sequence[str]) -> list[str]:
    """What may be meant by `name`: a unit in small letters, or one of the `known`; nothing is near a single letter."""
    try:
        unit(name.lower())
    except UnknownUnitError:
        return get_close_matches(name, known, n=1, cutoff=0.6) if len(name) > 1 else []
    return [name.lower()]


def evaluate(node: tree.Node, time: float = math.nan, values: Mapping[str, float] | None = None) -> float:
    """The number that `node` stands for at `time` [s], in SI units. Names must be bound.

    values : the value of each signal by its path, SI

    Raises ExpressionError where there is none (division by zero, the root of a negative number, overflow).
    """
    try:
        value = _evaluate(node, time, values or {})
    except ZeroDivisionError:
        raise tree.ExpressionError("division by zero") from None
    except OverflowError:
        raise tree.ExpressionError("the number is too large") from None
    except ValueError as error:
        raise (
            error
            if isinstance(error, tree.ExpressionError)
            else tree.ExpressionError("outside the domain of a function")
        ) from None
    return tree.finite(value)


def _evaluate(node: tree.Node, time: float, values: Mapping[str, float]) -> float:
    match node:
        case tree.Number(value, _):
            return value
        case tree.Time():
            return time
        case tree.Signal(path):
            if path not in values:
                raise tree.ExpressionError(f"`{path}` is only known while the machine moves")
            return values[path]
        case tree.Negative(operand):
            return -_evaluate(operand, time, values)
        case tree.Operation(symbol, left, right):
            return _operate(symbol, _evaluate(left, time, values), _evaluate(right, time, values))
        case tree.Call("if", (condition, yes, no)):
            return _evaluate(yes if _evaluate(condition, time, values) > 0.0 else no, time, values)
        case tree.Call(function, arguments):
            kind, given = FUNCTIONS[function], [_evaluate(argument, time, values) for argument in arguments]
            if kind.value is None:
                return _evaluate(kind.body, time, dict(zip(kind.names, given, strict=True)))
            return float(kind.value(*given))
        case tree.Lookup(argument, kind, points, heights, order):
            return interpolated(kind, points, heights, _evaluate(argument, time, values), order)
        case tree.Name(text):
            raise tree.ExpressionError(f"`{text}` has no value")


def _operate(symbol: str, left: float, right: float) -> float:
    value = tree.OPERATORS[symbol](left, right)
    if isinstance(value, complex):
        raise tree.ExpressionError("a negative number raised to a fraction is not a real number")
    return float(value)


def fold(node: tree.Node) -> tree.Node:
    """`node` with every part that does not vary replaced by one bare number."""
    if not tree.varies(node):
        return tree.Number(evaluate(node))
    return tree.with_parts(node, fold)


_PRECEDENCE = {"or": -2, "and": -1, **dict.fromkeys(tree.COMPARISONS, 0), "+": 1, "-": 1, "*": 2, "/": 2, "**": 4}
_SIGN, _ATOM = 3, 5


def render(node: tree.Node) -> str:
    """`node` as text that Python and this parser read alike. Names must be bound; units have become SI numbers."""
    return _render(node)[0]


def _render(node: tree.Node) -> tuple[str, int]:
    match node:
        case tree.Number(value, _):
            return repr(value), _SIGN if math.copysign(1, value) < 0 else _ATOM
        case tree.Time():
            return tree.TIME, _ATOM
        case tree.Signal(text) | tree.Name(text):
            return text, _ATOM
        case tree.Negative(operand):
            return f"-{_within(operand, _SIGN)}", _SIGN
        case tree.Call(function, arguments):
            return f"{function}({', '.join(render(argument) for argument in arguments)})", _ATOM
        case tree.Lookup(argument, kind, points, values, order):
            pairs = ", ".join(f"{point!r}, {value!r}" for point, value in zip(points, values, strict=True))
            return f"{tree.LOOKUP}({render(argument)}, {kind}{f'_{order}' if order else ''}, {pairs})", _ATOM
        case tree.Operation(symbol, left, right):
            level = _PRECEDENCE[symbol]
            space = " " if level <= 1 else ""
            rightwards = symbol == "**"
            first = _within(left, level + (rightwards or level == 0))
            second = _within(right, _SIGN if rightwards else level + 1)
            return f"{first}{space}{symbol}{space}{second}", level


def _within(node: tree.Node, level: int) -> str:
    """`node` as an operand that must bind at least as tightly as `level`."""
    text, its = _render(node)
    return text if its >= level else f"({text})"
