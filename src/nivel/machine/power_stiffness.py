"""The stiffness K of an effort K · depth ** exponent, whose unit depends on the exponent: `2e9 N/m^1.5`."""

from typing import Annotated, Any, Final

from pydantic import PlainValidator, ValidationInfo, WithJsonSchema

from nivel.machine.core.coefficient import COORDINATE, COORDINATE_EFFORT, kind_for
from nivel.machine.given import OneNumber
from nivel.machine.units import quantity
from nivel.machine.units.arithmetic import evaluate
from nivel.machine.units.measure import measure
from nivel.machine.units.tree import ExpressionError, Parameters
from nivel.machine.units.unit import KINDS, Dimension, described, is_angular, without_angle

_HERTZ: Final = 1.5


def read_power_stiffness(
    value: object, kinds: tuple[tuple[str, str], ...], exponent: float, given: Parameters
) -> float:
    """`value` [SI] as an effort by a way to the power `exponent`; `kinds`: (kind of the effort, kind of the way), of
    which one must fit.

    Raises ExpressionError, FaultyParameterError.
    """
    if not isinstance(value, str):
        return quantity.read_quantity(value, "number", given)
    tree = quantity.constant_tree(value, given)
    its, number = measure(tree), evaluate(tree)
    if its is not None and not any(_fits(its, _dimension(pair, exponent)) for pair in kinds):
        units = [
            f"{KINDS[effort][1]}/{KINDS[way][1]}" + (f"^{exponent:g}" if exponent != 1 else "") for effort, way in kinds
        ]
        raise ExpressionError(f"{quantity.shown(value.strip())} is {described(its)}; {' or '.join(units)} was expected")
    return number


def _dimension(kinds: tuple[str, str], exponent: float) -> Dimension:
    effort, way = (KINDS[kind][2] for kind in kinds)
    return tuple(a - exponent * b for a, b in zip(effort, way, strict=True))


def _fits(its: Dimension, wanted: Dimension) -> bool:
    if is_angular(its) and its != wanted:
        return False
    return all(abs(a - b) < 1e-9 for a, b in zip(without_angle(its), without_angle(wanted), strict=True))


def _read(value: Any, info: ValidationInfo) -> float:
    data = info.data or {}
    exponent = data.get("exponent")
    exponent = _HERTZ if exponent is None else exponent
    kind = kind_for(data.get("coordinate"), COORDINATE) if "coordinate" in data else COORDINATE[0]
    pairs = tuple(pair for pair in zip(COORDINATE_EFFORT, COORDINATE, strict=True) if pair[1] in kind)
    with quantity.told(value, quantity.parameters_of(info)):
        number = read_power_stiffness(value, pairs, exponent, quantity.parameters_of(info))
    if number <= 0:
        raise quantity.fault(f"a stiffness greater than zero was expected, got {quantity.shown(value)}")
    return number


_SCHEMA: Final = {
    "anyOf": [{"type": "number", "exclusiveMinimum": 0}, {"type": "string"}],
    "description": "a stiffness K of the effort K · depth ** exponent, in SI or with a unit such as N/m^1.5",
}

# The fields `exponent` and, in records that have one, `coordinate` must stand before a field of this type.
PowerStiffness = Annotated[OneNumber, PlainValidator(_read), WithJsonSchema(_SCHEMA)]
