"""A sensor in words: a quantity that a run stores."""

from collections.abc import Iterator
from typing import Annotated, Any, ClassVar, Final

from pydantic import BeforeValidator, ValidationInfo, WithJsonSchema

from nivel.machine.core.element import TwoMarkers
from nivel.machine.core.orientation import AxisSequence
from nivel.machine.core.record import Checked, Name, Problem, superfluous, unknown_word
from nivel.machine.given import Field, Maybe
from nivel.machine.laws.time_function import Measured
from nivel.machine.units.measure import measure
from nivel.machine.units.quantity import ANY, constant_tree, fault, listed, parameters_of, read_quantity, shown, told
from nivel.machine.units.tree import ExpressionError, Parameters
from nivel.machine.units.unit import without_angle
from nivel.machine.uses.coordinate_reference import CoordinateReference


def _read(value: Any, info: ValidationInfo) -> float:
    parameters, units = parameters_of(info), info.data.get("units", "")
    with told(value):
        number = read_quantity(value, ANY, parameters)
        if not isinstance(value, str) or not units or measure(constant_tree(value, parameters)) is None:
            return number
        return number / _unit_of(value, units, parameters)


def _unit_of(text: str, units: str, parameters: Parameters) -> float:
    """`units` in SI, which must measure what the quantity `text` does.

    Raises ExpressionError.
    """
    try:
        its, unit = measure(constant_tree(f"1 {units}", {})), read_quantity(f"1 {units}", ANY, {})
    except ExpressionError:
        raise ExpressionError(f"the sensor is in `{units}`, which is no unit; write a plain number") from None
    given = measure(constant_tree(text, parameters))
    if its is None or given is None or without_angle(its) != without_angle(given):
        raise ExpressionError(f"the sensor is in `{units}`, which `{text.strip()}` is not")
    return unit


ShownNumber = Annotated[
    float, BeforeValidator(_read), WithJsonSchema({"anyOf": [{"type": "number"}, {"type": "string"}]})
]
"""A plain number is in the units of the sensor; a text with a unit is converted to them."""


MARKER_QUANTITIES: Final = (
    "position",
    "velocity",
    "acceleration",
    "angular_velocity",
    "angular_acceleration",
    "euler_angles",
)
COORDINATE_QUANTITIES: Final = ("value", "rate", "acceleration")

_FORMS: Final = ("marker", "coordinate", "distance", "angle", "force", "value")


def _word(value: Any) -> str:
    if not isinstance(value, str):
        raise fault(f"a quantity such as `velocity` was expected, got {shown(value)}")
    return value


_Word = Annotated[str, BeforeValidator(_word), WithJsonSchema({"type": "string"})]


class Sensor(Checked):
    """What a run stores beside what it always does.

    The motion of a `marker`, a joint `coordinate`, the `distance` or `angle` of two markers, an output of a `force`,
    or the `value` of an expression.
    """

    collection: ClassVar[str] = "sensors"

    name: Name
    marker: Name | None = Field("whose motion is measured", default=None)
    coordinate: CoordinateReference | None = Field("joint coordinate", default=None)
    distance: Maybe[TwoMarkers] = Field("of the points of two markers", default=None)
    angle: Maybe[TwoMarkers] = Field("of the second marker about the z axis of the first", default=None)
    force: Name | None = Field("of which an output is measured", default=None)
    value: Maybe[Measured] = Field("expression of `time` and symbols", default=None)
    quantity: _Word | None = Field("what is measured of a marker, a coordinate or a force", default=None)
    relative_to: Name | None = Field(
        "marker from which, and in whose axes, a marker is seen; default the global frame", default=None
    )
    sequence: AxisSequence | None = Field(
        "of `euler_angles`: the axes of the three turns, each about an axis as turned so far", default=None
    )
    units: str = Field("of a `value`, for people", default="")
    label: str = Field("what a gauge of the page calls it; default follows from the name", default="")
    range: Annotated[tuple[ShownNumber, ShownNumber], BeforeValidator(listed)] | None = Field(
        "ends of the scale of its gauge", default=None
    )
    limit: ShownNumber | None = Field("magnitude beyond which its gauge warns, greater than zero", default=None)

    @property
    def form(self) -> str:
        """Which of marker, coordinate, distance, angle, force and value is given."""
        return next(name for name in _FORMS if getattr(self, name) is not None)

    def problems(self) -> Iterator[Problem]:
        given = [name for name in _FORMS if getattr(self, name) is not None]
        if len(given) != 1:
            got = f"; got {' and '.join(given)}" if given else ""
            yield Problem((), f"a sensor needs one of {', '.join(_FORMS)}{got}")
            return
        form = given[0]
        if form in ("marker", "coordinate", "force"):
            if self.quantity is None:
                yield Problem((), f"`quantity` is missing: what is measured of the {form}")
        elif self.quantity is not None:
            yield superfluous("quantity", f"belongs to a marker, a coordinate or a force, not to `{form}`")
        words = {"marker": MARKER_QUANTITIES, "coordinate": COORDINATE_QUANTITIES}.get(form)
        if words and self.quantity is not None and self.quantity not in words:
            yield Problem(("quantity",), unknown_word(self.quantity, words, "quantity"))
        if self.relative_to is not None and form != "marker":
            yield superfluous("relative_to", "belongs to a `marker`")
        if self.relative_to is not None and self.relative_to == self.marker:
            yield Problem(("relative_to",), "a marker does not move relative to itself")
        if self.quantity == "euler_angles" and self.sequence is None:
            yield Problem((), "`sequence` is missing: the axes of the three turns, e.g. `zyx` for yaw, pitch and roll")
        if self.sequence is not None and (form != "marker" or self.quantity != "euler_angles"):
            yield superfluous("sequence", "belongs to the quantity `euler_angles` of a marker")
        if self.units and form != "value":
            yield superfluous("units", "belongs to a `value`; all else is in SI")
        yield from self._problems_of_gauge()
        pair = self.distance or self.angle
        if pair is not None and pair[0] == pair[1]:
            yield Problem((form,), f"{form} is measured between two different markers")

    def _problems_of_gauge(self) -> Iterator[Problem]:
        if self.range is not None and not self.range[0] < self.range[1]:
            low, high = self.range
            yield Problem(
                ("range",), f"the least value comes first and is below the greatest; got {low:g} and {high:g}"
            )
        if self.limit is not None and self.limit <= 0.0:
            yield Problem(("limit",), f"a magnitude greater than zero was expected, got {self.limit:g}")
        if self.marker is not None:
            for name in ("range", "limit"):
                if getattr(self, name) is not None:
                    yield superfluous(name, "belongs to a sensor of one number; a marker gives three")
