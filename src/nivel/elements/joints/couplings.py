"""Couplings in words: an equation between joint coordinates, linear as of gears, belts and racks, or any smooth one as of cams.

A linear coupling holds Σ factor · coordinate at the value that it has as the machine is placed.
"""

from collections.abc import Iterator
from functools import cached_property
from itertools import combinations_with_replacement
from math import pi
from typing import Annotated, ClassVar, Final, Literal

from nivel.elements.facts import is_angle
from nivel.known import RowTable, SystemBuilder
from nivel.lazy import Struct
from nivel.machine.core.coefficient import CoordinatePosition, PositiveNumber, Truth
from nivel.machine.core.record import Checked, Name, Problem, superfluous
from nivel.machine.given import Field, ManyNames, ManyNumbers, Maybe, TwoNames, TwoNumbers
from nivel.machine.laws.python_law import PythonLaw
from nivel.machine.laws.time_function import TimeFunction, signals_of
from nivel.machine.laws.varying_value import Expression, Table, expression_of
from nivel.machine.units.derivative import derivative
from nivel.machine.units.quantity import Length, PositiveLength, Scalar
from nivel.machine.units.tree import Call, ExpressionError, Lookup, Node, Number, Operation, Signal, parts
from nivel.machine.uses.coordinate_reference import CoordinateReference, Kind

Terms = tuple[tuple[str, float], ...]
_TWO = Field("two joint coordinates, or joints that have only one")


class JointCoupling(Checked):
    """An equation between joint coordinates. needed : kinds of the coordinates of its terms; none where any will do."""

    collection: ClassVar[str] = "couplings"
    needed: ClassVar[tuple[Kind, ...]] = ()

    name: Name

    @property
    def terms(self) -> Terms:
        """(coordinate as written, factor), … whose sum is held; of a function the linear part of coordinate - value = 0."""
        raise NotImplementedError

    @property
    def kinds(self) -> tuple[Kind | None, ...]:
        """What kind of coordinate each term needs."""
        return self.needed or (None,) * len(self.terms)


class Gear(JointCoupling):
    """Two wheels that mesh: n₁ angle₁ + n₂ angle₂ is held; of an internal gear n₁ angle₁ - n₂ angle₂."""

    needed: ClassVar[tuple[Kind, ...]] = ("angle", "angle")

    type: Literal["gear"] = "gear"
    joints: Annotated[TwoNames[CoordinateReference], _TWO]
    teeth: Maybe[TwoNumbers[PositiveNumber]] = Field("numbers of teeth n₁, n₂", default=None)
    ratio: Maybe[PositiveNumber] = Field("n₂/n₁, in place of `teeth`", default=None)
    internal: Truth = Field("one wheel runs inside the other: both turn the same way", default=False)

    @property
    def terms(self) -> Terms:
        first, second = self.teeth or (1.0, self.ratio or 1.0)
        return (self.joints[0], first), (self.joints[1], -second if self.internal else second)

    def problems(self) -> Iterator[Problem]:
        if self.teeth is None and self.ratio is None:
            yield Problem((), "`teeth` is missing: a gear needs `teeth: [n1, n2]` or a `ratio` (n2/n1)")
        if self.teeth is not None and self.ratio is not None:
            yield superfluous("ratio", "must not be given with `teeth`, from which it follows")
        for at, count in enumerate(self.teeth or ()):
            if count != round(count):
                yield Problem(
                    ("teeth", at), f"a whole number of teeth was expected, got `{count:g}`; or give a `ratio`"
                )


class Belt(JointCoupling):
    """Two pulleys and a belt that does not slip: r₁ angle₁ - r₂ angle₂ is held; crossed r₁ angle₁ + r₂ angle₂."""

    needed: ClassVar[tuple[Kind, ...]] = ("angle", "angle")

    type: Literal["belt"] = "belt"
    joints: Annotated[TwoNames[CoordinateReference], _TWO]
    radii: TwoNumbers[PositiveLength] = Field("of the pulleys r₁, r₂")
    crossed: Truth = Field("the belt crosses itself: the pulleys turn opposite ways", default=False)

    @property
    def terms(self) -> Terms:
        first, second = self.radii
        return (self.joints[0], first), (self.joints[1], second if self.crossed else -second)


class Rack(JointCoupling):
    """A pinion and a rack: displacement - r · angle is held."""

    needed: ClassVar[tuple[Kind, ...]] = ("length", "angle")

    type: Literal["rack"] = "rack"
    joints: TwoNames[CoordinateReference] = Field("the pinion's angle, the rack's way")
    radius: Length = Field("of the pinion; negative: the rack moves the other way")

    @property
    def terms(self) -> Terms:
        return (self.joints[1], 1.0), (self.joints[0], -self.radius)

    def problems(self) -> Iterator[Problem]:
        if self.radius == 0:
            yield Problem(("radius",), "`radius` is zero: such a pinion moves no rack")


class LinearCoupling(JointCoupling):
    """Σ factor · coordinate is held."""

    type: Literal["linear"] = "linear"
    coordinates: ManyNames[CoordinateReference] = Field("two or more different joint coordinates")
    factors: ManyNumbers[Scalar] = Field("one for each coordinate [m or rad], none zero")

    @property
    def terms(self) -> Terms:
        return tuple(zip(self.coordinates, self.factors, strict=True))

    def problems(self) -> Iterator[Problem]:
        if len(self.coordinates) < 2:
            yield Problem(("coordinates",), f"two or more coordinates were expected, got {len(self.coordinates)}")
        if len(self.factors) != len(self.coordinates):
            counts = f"{len(self.factors)} and {len(self.coordinates)}"
            yield Problem(("factors",), f"a coupling needs as many factors as coordinates; got {counts}")
        for at, factor in enumerate(self.factors):
            if factor == 0:
                yield Problem(("factors", at), "the factor is zero; leave the coordinate out")


# interpolations of tables that are smooth enough: of the second derivative, which accelerations follow, none jumps
SMOOTH: Final = ("cubic", "quintic", "periodic")


class FunctionCoupling(JointCoupling):
    """A coordinate that is a function of others: coordinate = value, as of a cam, a pair of non-circular gears, a linkage as a curve."""

    type: Literal["function"] = "function"
    coordinate: CoordinateReference = Field("joint coordinate that follows")
    value: CoordinatePosition = Field("length or angle, a smooth function of other joint coordinates")
    from_start: Truth = Field(
        "the coordinate moves from where it is placed by what `value` changes from its value as placed", default=False
    )

    @property
    def coordinates(self) -> tuple[str, ...]:
        """The coordinates that it follows."""
        return signals_of(self.value)

    @property
    def terms(self) -> Terms:
        return (self.coordinate, 1.0), *((each, 0.0) for each in self.coordinates)

    @cached_property
    def counts_turns(self) -> bool:
        """Whether `value` has inverse tangents, which come back after a turn while the coordinate, if it is an angle, goes on."""
        return not self.from_start and isinstance(self.value, Expression) and _has_inverse_tangents(self.value.tree)

    @cached_property
    def slopes(self) -> dict[tuple[str, ...], Table | Expression | float]:
        """The derivatives of `value`, first by one coordinate (q,), then by two (q, r) in the order of `coordinates`; those that are
        zero are left out. A cubic table stands for its own derivatives: its pieces are differentiated.

        Raises ExpressionError where there are none: corners, time.
        """
        if isinstance(self.value, Table) and self.value.interpolation == "cubic":
            return {(self.value.of,): self.value, (self.value.of, self.value.of): self.value}
        tree = _tree(self.value)
        first = {path: derivative(tree, path) for path in self.coordinates}
        second = {
            (one, two): derivative(first[one], two) for one, two in combinations_with_replacement(self.coordinates, 2)
        }
        found = {**{(path,): node for path, node in first.items()}, **second}
        return {paths: _function(node) for paths, node in found.items() if node != Number(0.0)}

    def problems(self) -> Iterator[Problem]:
        value, place = self.value, ("value",)
        if isinstance(value, Table) and value.interpolation not in SMOOTH:
            yield Problem(
                place,
                f"a table with `interpolation: {value.interpolation}` has corners, where speeds or accelerations would jump; "
                "write `interpolation: cubic`",
            )
            return
        try:
            self.slopes  # noqa: B018
        except ExpressionError as problem:
            yield Problem(place, str(problem))
            return
        if not self.coordinates:
            yield Problem(place, "no joint coordinate stands here, e.g. `0.02*crank.angle`; what is constant is locked")
        if self.coordinate in self.coordinates:
            yield Problem(place, f"`{self.coordinate}` follows from other coordinates, not from itself")


def _tree(value: TimeFunction) -> Node:
    match value:
        case Table():
            return Lookup(Signal(value.of), value.interpolation, tuple(value.times), tuple(value.values))
        case Expression():
            return value.tree
        case PythonLaw():
            raise ExpressionError(
                "a function in Python has no exact derivatives; write an expression or a smooth table"
            )
    return Number(float(value))


def _has_inverse_tangents(node: Node) -> bool:
    own = isinstance(node, Call) and node.function in ("atan", "atan2")
    return own or any(_has_inverse_tangents(part) for part in parts(node))


def _function(node: Node) -> Expression | float:
    return node.value if isinstance(node, Number) else expression_of(node)


Coupling = Annotated[Gear | Belt | Rack | LinearCoupling | FunctionCoupling, Field(discriminator="type")]
TURN: Final = 2.0 * pi


class Curve(Struct):
    """A function of coordinates in numbers of functions: its value, ∂/∂q of each coordinate q, and (q, r, function) of its second
    derivatives, those of two different coordinates in both orders."""

    value: int
    slopes: dict[int, int]
    bends: list[tuple[int, int, int]]


def add_couplings(builder: SystemBuilder, rows: RowTable) -> None:
    """Rows of all couplings, scaled so that the first coordinate has the factor one: its effort is what is reported."""
    for coupling in builder.machine.couplings:
        terms = [
            (builder.coordinate(reference, kind), factor)
            for (reference, factor), kind in zip(coupling.terms, coupling.kinds, strict=True)
        ]
        leading = terms[0][1]
        units = "rad" if is_angle(builder, terms[0][0]) else "m"
        row = rows.row(coupling.name, "coupling", units)
        follows = isinstance(coupling, FunctionCoupling)
        curve = _curve(builder, coupling) if follows else None
        offset = 0.0 if follows and not coupling.from_start else None
        effort = "N m" if units == "rad" else "N"
        output = builder.outputs.add(
            (f"coupling.{coupling.name}.effort", effort, f"effort of {coupling.name} on its first coordinate")
        )
        scaled = [(coordinate, factor / leading) for coordinate, factor in terms]
        builder.transmissions[coupling.name] = row, {each: factor for each, factor in scaled if factor}
        rows.combine(builder, row, scaled, offset=offset, curve=curve, report=(output, 0))


def _curve(builder: SystemBuilder, coupling: FunctionCoupling) -> Curve:
    """The value that a coordinate follows, and its derivatives. A cubic table goes on straight beyond its ends, where it has no corner."""
    coordinate = {path: builder.coordinate(path) for path in coupling.coordinates}
    slopes: dict[int, int] = {}
    bends: list[tuple[int, int, int]] = []
    for paths, function in coupling.slopes.items():
        number = _smooth(builder, function, len(paths))
        first, *others = [coordinate[path] for path in paths]
        if not others:
            slopes[first] = number
        else:
            bends += [(one, two, number) for one, two in dict.fromkeys([(first, *others), (*others, first)])]
    return Curve(_smooth(builder, _counted(builder, coupling), 0), slopes, bends)


def _counted(builder: SystemBuilder, coupling: FunctionCoupling) -> TimeFunction:
    """The value that a coordinate follows, g; of an angle b by inverse tangents g + 2π n with the whole n that is nearest to b, as these
    come back after a turn while b goes on."""
    g, index = coupling.value, builder.coordinate(coupling.coordinate)
    if not isinstance(g, Expression) or not coupling.counts_turns or not is_angle(builder, index):
        return g
    path = next(name for name, each in builder.joint_coordinates.items() if each == index)
    turns = Operation("/", Operation("-", Signal(path), g.tree), Number(TURN))
    nearest = Call("floor", (Operation("+", turns, Number(0.5)),))
    return expression_of(Operation("+", g.tree, Operation("*", Number(TURN), nearest)))


def _smooth(builder: SystemBuilder, function: TimeFunction, order: int) -> int:
    """Number of a function, of a cubic table of its derivative of this order."""
    if isinstance(function, Table) and function.interpolation == "cubic":
        return builder.spline(function, order)
    return builder.function(function, switching=False)
