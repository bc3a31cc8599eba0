"""Quantities of any kind, kept as they are written: what they have to measure is known by the machine or the result alone."""

from collections.abc import Iterable
from typing import Annotated, Any

from pydantic import AfterValidator, WithJsonSchema

from nivel.machine.units.measure import measure
from nivel.machine.units.quantity import ANY, constant_tree, expression_fault, read_quantity
from nivel.machine.units.tree import ExpressionError
from nivel.machine.units.unit import Dimension, described, without_angle
from nivel.words.arguments import plain


def _readable(value: Any) -> Any:
    value = plain(value)
    try:
        read_quantity(value, ANY, {})
    except ExpressionError as problem:
        raise expression_fault(problem, value) from None
    return value


AnyQuantity = Annotated[
    Any, AfterValidator(_readable), WithJsonSchema({"anyOf": [{"type": "number"}, {"type": "string"}]})
]


def si(value: Any) -> float:
    """The SI number of a quantity."""
    return read_quantity(value, ANY, {})


def si_or_text(value: Any) -> float | str:
    """The SI number of a quantity; of anything else its text."""
    try:
        return read_quantity(value, ANY, {})
    except (ExpressionError, TypeError):
        return str(value)


def dimension_of(value: Any) -> Dimension | None:
    """What a quantity measures; None for a bare number. Raises ExpressionError for what is none."""
    value = plain(value)
    return measure(constant_tree(value, {})) if isinstance(value, str) else None


def unlike(values: Iterable[Any]) -> tuple[int, str] | None:
    """Place of the first quantity that measures something else than those before it, and the message; None where all agree.

    Bare numbers and what is no quantity are passed over.
    """
    first: tuple[str, Dimension] | None = None
    for at, value in enumerate(values):
        try:
            its = dimension_of(value)
        except ExpressionError:
            continue
        if its is None:
            continue
        if first is not None and its != first[1]:
            return at, f"`{value}` is {described(its)}, but `{first[0]}` is {described(first[1])}"
        first = first or (str(value), its)
    return None


def another_measure(quantity: Any, units: str) -> str:
    """What is wrong where a quantity measures something else than a number in `units`; a number without a unit fits every one."""
    if (its := dimension_of(quantity)) is None:
        return ""
    try:
        wanted = dimension_of(f"1 {units.replace(' ', '*')}" if units not in ("", "1") else "1")
    except ExpressionError:
        return ""
    if without_angle(wanted) == without_angle(its):
        return ""
    return f"`{quantity}` is {described(its)}; the number is in {units or 'no unit'}"
