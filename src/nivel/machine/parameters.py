"""The `parameters:` of a machine file: named numbers that may use each other in any order."""

from collections.abc import Mapping

from nivel.machine.units.arithmetic import NOT_FOR_PARAMETERS, bind, evaluate, given
from nivel.machine.units.grammar import parse
from nivel.machine.units.measure import measure, shared_names_hint
from nivel.machine.units.quantity import ANY, lacking_unit
from nivel.machine.units.tree import ExpressionError, FaultyParameterError, Node, Number, Parameters, names, varies


def resolve(given: Mapping[str, object]) -> tuple[dict[str, Number | None], dict[str, str]]:
    """Values of all parameters, and what is wrong with some: (name → value, name → message).

    A parameter at fault, or one that uses such a parameter, has the value None; only the first kind has a message.
    """
    trees: dict[str, Node] = {}
    faults: dict[str, str] = {}
    for name, value in given.items():
        try:
            trees[name] = _tree(name, value)
        except ExpressionError as fault:
            faults[name] = str(fault)
    values: dict[str, Number | None] = dict.fromkeys(faults)
    texts = {name: value for name, value in given.items() if isinstance(value, str)}
    for name in trees:
        _resolve(name, trees, texts, values, faults, ())
    return values, faults


def _tree(name: str, value: object) -> Node:
    if not name.isidentifier():
        raise ExpressionError("the name of a parameter has letters, digits and `_` only")
    if name in NOT_FOR_PARAMETERS:
        raise ExpressionError(f"`{name}` has a meaning already; choose another name")
    if isinstance(value, Number):
        return value
    if isinstance(value, str):
        tree = parse(value)
        if varies(tree):
            raise ExpressionError("a parameter cannot change with `time`")
        return tree
    if isinstance(value, int | float) and not isinstance(value, bool):
        return Number(given(value))
    raise ExpressionError("a number, a quantity such as `10 cm`, or an expression was expected")


def _resolve(
    name: str,
    trees: Mapping[str, Node],
    texts: Mapping[str, str],
    values: dict[str, Number | None],
    faults: dict[str, str],
    users: tuple[str, ...],
) -> None:
    """Fill `values[name]`, first those it uses. `users` are the parameters that led here."""
    if name in values:
        return
    if name in users:
        ring = [*users[users.index(name) :], name]
        faults[name] = f"depends on itself: {' → '.join(ring)}"
        values[name] = None
        return
    if len(users) > 100:
        faults[name] = "is at the end of more than 100 parameters that use each other"
        values[name] = None
        return
    for used in sorted(names(trees[name]) & trees.keys()):
        _resolve(used, trees, texts, values, faults, (*users, name))
    if name in values:  # found to be in a ring on the way
        return
    try:
        bound = bind(trees[name], values)
        values[name] = _value(bound, texts.get(name, ""), values)
    except FaultyParameterError:
        values[name] = None
    except ExpressionError as fault:
        faults[name] = str(fault) + shared_names_hint(texts.get(name, ""), values)
        values[name] = None


def _value(bound: Node, text: str, values: Mapping[str, Number | None]) -> Number:
    """The value of a parameter. Raises ExpressionError, with the line to write where plain numbers lack units."""
    try:
        return Number(evaluate(bound), measure(bound))
    except ExpressionError as problem:
        raise (
            lacking_unit(problem, text.strip(), ANY, values, (), _check, constant=True) if text else problem
        ) from None


def _check(text: str, values: Parameters) -> None:
    """Raises ExpressionError where `text` is no value of a parameter."""
    bound = bind(parse(text), values)
    measure(bound)
    evaluate(bound)
