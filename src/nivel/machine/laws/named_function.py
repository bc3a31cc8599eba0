"""The `functions:` of a machine file: expressions with arguments, and curves through points, by name.

    functions:
      bump(x): 5 cm * exp(-(x/20 cm)^2)
      torque_curve: {points: [0, 100, 300], values: [50 N m, 80 N m, 20 N m], interpolation: monotone}
      torque_map: {points: [0, 100, 300], across: [0, 1], values: [[-5, -8, -20], [50, 80, 20]]}

They may use parameters and each other, in any order. Where an expression calls one, its body is put in.
"""

import re
from collections.abc import Mapping
from typing import Final

from pydantic import ValidationError

from nivel.machine.laws.varying_value import read_table
from nivel.machine.units import tree
from nivel.machine.units.arithmetic import NOT_FOR_PARAMETERS, RESERVED, bind, given
from nivel.machine.units.grammar import parse
from nivel.machine.units.quantity import ANY, FAULT, listed, shown
from nivel.machine.units.unit import UNITS

_HEAD: Final = re.compile(r"([^\W\d]\w*)\s*(?:\(\s*([^()]*?)\s*\))?")
_OF_CURVE: Final = "argument"
_ACROSS: Final = "second"
Place = tuple[str | int, ...]
Faults = dict[Place, str]


def resolve_functions(
    section: Mapping[str, object], parameters: tree.Parameters
) -> tuple[dict[str, tree.Function | None], Faults]:
    """The functions by name, and what is wrong with some, by place in the section. One at fault is None."""
    faults: Faults = {}
    trees: dict[str, tuple[str, tuple[str, ...], tree.Node, str]] = {}
    done: dict[str, tree.Function | None] = {}
    for key, value in section.items():
        try:
            name, arguments = _head(key, value, parameters)
        except tree.ExpressionError as problem:
            faults[key,] = str(problem)
            continue
        done[name] = None
        try:
            if isinstance(value, Mapping):
                done[name] = _map(value, parameters) if "across" in value else _curve(value, parameters)
            else:
                trees[name] = (key, arguments, _body(value), value if isinstance(value, str) else "")
        except tree.ExpressionError as problem:
            faults[key,] = str(problem)
        except ValidationError as error:
            faults |= {(key, *line["loc"]): line["msg"] for line in error.errors() if line["type"] == FAULT}
    for name in trees:
        _resolve(name, trees, done, parameters, faults, ())
    return done, faults


def _head(key: str, value: object, parameters: tree.Parameters) -> tuple[str, tuple[str, ...]]:
    """Name and arguments of `bump(x)`; a curve has no arguments in its name."""
    found = _HEAD.fullmatch(key)
    if found is None:
        raise tree.ExpressionError(
            f"`{key}` is not the head of a function; write `{key.split('(', maxsplit=1)[0].strip() or 'NAME'}(x): …`"
        )
    name, listed = found[1], found[2]
    if name in RESERVED or name in UNITS:
        raise tree.ExpressionError(f"`{name}` has a meaning already; choose another name")
    if name in parameters:
        raise tree.ExpressionError(f"`{name}` is a parameter; choose another name")
    if isinstance(value, Mapping):
        if listed is not None:
            raise tree.ExpressionError(f"a curve is named without arguments: write `{name}:`")
        return name, ()
    if not listed:
        raise tree.ExpressionError(
            f"the arguments are missing: write `{name}(x): …`; a number with a name is a parameter"
        )
    arguments = tuple(each.strip() for each in listed.split(","))
    for argument in arguments:
        if not argument.isidentifier() or argument in NOT_FOR_PARAMETERS:
            raise tree.ExpressionError(f"`{argument}` cannot be an argument; choose another name")
    if len(set(arguments)) < len(arguments):
        raise tree.ExpressionError("two arguments have the same name")
    return name, arguments


def _body(value: object) -> tree.Node:
    if isinstance(value, str):
        return parse(value)
    if isinstance(value, int | float) and not isinstance(value, bool):
        return tree.Number(given(value))
    raise tree.ExpressionError(f"an expression, or `{{points: […], values: […]}}` was expected, got {shown(value)}")


def _curve(value: Mapping[str, object], parameters: tree.Parameters) -> tree.Function:
    if "of" in value or "times" in value:
        key = "of" if "of" in value else "times"
        hint = "the call says what it depends on: leave `of` out" if key == "of" else "write `points`"
        raise tree.ExpressionError(f"`{key}` does not belong to a named curve; {hint}")
    table = read_table({**value, "of": _OF_CURVE}, ANY, parameters, (_OF_CURVE,))
    points, values = tuple(map(float, table.times)), tuple(map(float, table.values))
    return tree.Function((_OF_CURVE,), tree.Lookup(tree.Signal(_OF_CURVE), table.interpolation, points, values))


def _map(value: Mapping[str, object], parameters: tree.Parameters) -> tree.Function:
    """A map of two arguments: a curve of the first one at each point `across` of the second, and straight lines from curve to curve."""
    rows, across = listed(value.get("values")), value["across"]
    if not isinstance(rows, list | tuple) or not all(isinstance(listed(row), list | tuple) for row in rows):
        raise tree.ExpressionError(
            "with `across` the `values` are a list for each of its points, `[[1, 2, 3], [4, 5, 6]]`"
        )
    places = read_table({"of": _OF_CURVE, "points": across, "values": [0.0] * len(rows)}, ANY, parameters, (_OF_CURVE,))
    rest = {key: each for key, each in value.items() if key not in ("across", "values")}
    curves = [_curve({**rest, "values": row}, parameters).body for row in rows]
    points, body = tuple(map(float, places.times)), None
    for k, curve in enumerate(curves):
        share = tree.Lookup(tree.Signal(_ACROSS), "linear", points, tuple(float(k == at) for at in range(len(points))))
        term = tree.Operation("*", share, curve)
        body = term if body is None else tree.Operation("+", body, term)
    assert body is not None  # a table has a point
    return tree.Function((_OF_CURVE, _ACROSS), body)


def _resolve(
    name: str,
    trees: Mapping[str, tuple[str, tuple[str, ...], tree.Node, str]],
    done: dict[str, tree.Function | None],
    parameters: tree.Parameters,
    faults: Faults,
    users: tuple[str, ...],
) -> None:
    """Fill `done[name]`, first those it uses. `users` are the functions that led here."""
    key, arguments, root, text = trees[name]
    if done[name] is not None or (key,) in faults:
        return
    if name in users:
        faults[key,] = f"depends on itself: {' → '.join([*users[users.index(name) :], name])}"
        return
    for used in sorted(set(tree.calls(root)) & trees.keys()):
        _resolve(used, trees, done, parameters, faults, (*users, name))
    if (key,) in faults:
        return
    known = {each: value for each, value in {**parameters, **done}.items() if each not in arguments}
    try:
        done[name] = tree.Function(arguments, bind(root, known, arguments), key, text)
    except tree.FaultyParameterError:
        return
    except tree.ExpressionError as problem:
        faults[key,] = str(problem)
