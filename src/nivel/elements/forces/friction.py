"""Friction in joint coordinates and of patches of contacts, and the work of this."""

from collections.abc import Iterator
from typing import ClassVar, Literal

from nivel.elements.facts import Output, StateFact, add_outputs, is_angle, of_effort
from nivel.elements.kind import Kind
from nivel.elements.rows import Row, element
from nivel.kernels.bodies.coordinate import ALONG, CROSS_SECOND
from nivel.kernels.bodies.patch_coordinate import PATCH
from nivel.kernels.elements import friction
from nivel.kernels.record.record import NONE, record_at
from nivel.known import Contact, SystemBuilder
from nivel.machine.core.coefficient import (
    CoordinateDamping,
    DampingPerLoad,
    NotNegativeForce,
    NotNegativeLength,
    NotNegativeSpeed,
    PositiveForce,
    PositiveNumber,
    PositiveSpeed,
    StiffnessPerLoad,
)
from nivel.machine.core.element import ForceElement, Holds, Inequalities
from nivel.machine.core.record import GROUND, Problem, superfluous
from nivel.machine.given import Field, Maybe
from nivel.machine.units.quantity import PositiveLength
from nivel.machine.uses.coordinate_reference import CoordinateReference, kind_of, resolve


class Friction(ForceElement):
    """Dry friction of a joint coordinate: Coulomb's, with true sticking, or of bristles (LuGre); and viscous friction.

    Speeds are those of the rubbing surfaces: of an angle `radius` · rate.
    """

    outputs: ClassVar[tuple[str, ...]] = (
        *of_effort("effort on the coordinate"),
        Output("normal_load", "N", "normal load"),
        Output("bristle", "m", "deflection of the bristles"),  # of the lugre model
    )

    stiff: ClassVar[bool] = False

    inequalities: ClassVar[Inequalities] = (
        Holds(
            "coordinate",
            lambda own, of: of["magnitude"] + own.viscous * of.rate(own.coordinate),
            lambda own, of: own.static * own.arm * of["normal_load"],
            lambda own, of: own.coefficient * own.arm * of["normal_load"],
            lambda own, of: of.rate(own.coordinate),
            applies=lambda own: own.model == "stiction",
        ),
    )

    type: Literal["friction"] = "friction"
    coordinate: CoordinateReference
    model: Literal["coulomb", "stiction", "lugre"]
    coefficient: PositiveNumber = Field("of kinetic friction")
    static_coefficient: Maybe[PositiveNumber] = Field("default `coefficient`", default=None)
    stribeck_speed: Maybe[NotNegativeSpeed] = Field(
        "at which static friction has mostly become kinetic; 0, with stiction: as soon as it slides", default=None
    )
    transition_speed: Maybe[PositiveSpeed] = Field(
        "of the coulomb model: friction goes as tanh(speed / transition_speed)", default=None
    )
    viscous: CoordinateDamping = Field("effort per rate of the coordinate", default=0.0)
    bristle_stiffness: Maybe[StiffnessPerLoad] = Field("of the lugre model, per normal load", default=None)
    bristle_damping: DampingPerLoad = Field("of the lugre model, per normal load", default=0.0)
    normal_load: Maybe[PositiveForce] = Field("in place of the joint's own reaction", default=None)
    preload: NotNegativeForce = Field("added to the load by the reaction", default=0.0)
    radius: Maybe[PositiveLength] = Field(
        "of the pin; of a displacement, arm on which a torque about the axis loads it", default=None
    )
    collar_radius: NotNegativeLength = Field("at which the axial reaction rubs, of an angle", default=0.0)
    bearing_length: Maybe[PositiveLength] = Field(
        "over which a bending moment M loads the bearing by 2 M / bearing_length", default=None
    )

    @property
    def sticks(self) -> bool:
        """Whether it can hold the joint at rest."""
        return self.model == "stiction"

    @property
    def arm(self) -> float:
        """Speed of the surfaces by the rate of the coordinate [m], 1 of a length."""
        return self.radius or 1.0 if kind_of(self.coordinate) != "length" else 1.0

    @property
    def static(self) -> float:
        """Coefficient of static friction."""
        return self.coefficient if self.static_coefficient is None else self.static_coefficient

    def problems(self) -> Iterator[Problem]:
        yield from self._problems_of_model()
        yield from self._problems_of_load()

    def _problems_of_model(self) -> Iterator[Problem]:
        if self.static < self.coefficient:
            message = f"`static_coefficient` {self.static:g} is smaller than `coefficient` {self.coefficient:g}"
            yield Problem(("static_coefficient",), f"{message}; static friction is at least as strong as kinetic")
        if self.static > self.coefficient and self.stribeck_speed is None:
            message = "`stribeck_speed` is missing: at about this speed static friction has become kinetic"
            yield Problem((), message)
        if self.static > self.coefficient and self.stribeck_speed == 0.0 and self.model != "stiction":
            message = (
                f"`stribeck_speed` must be greater than zero: `model: {self.model}` would never have static friction"
            )
            yield Problem(("stribeck_speed",), f"{message}; `model: stiction` allows zero")
        if self.model == "coulomb" and self.transition_speed is None:
            message = "`transition_speed` is missing: below it the coulomb model lets the joint creep"
            yield Problem((), message)
        if self.model != "coulomb" and self.transition_speed is not None:
            yield superfluous("transition_speed", f"belongs to `model: coulomb`; this one is `{self.model}`")
        if self.model == "lugre" and self.bristle_stiffness is None:
            yield Problem((), "`bristle_stiffness` is missing: the lugre model needs one, e.g. 1e5/m")
        for name in ("bristle_stiffness", "bristle_damping"):
            if self.model != "lugre" and getattr(self, name):
                yield superfluous(name, f"belongs to `model: lugre`; this one is `{self.model}`")

    def _problems_of_load(self) -> Iterator[Problem]:
        kind = kind_of(self.coordinate)
        if kind == "angle" and self.radius is None:
            yield Problem((), "`radius` is missing: of the surface that rubs as the angle changes")
        if kind == "length" and self.collar_radius:
            yield superfluous("collar_radius", f"belongs to an angle; `{self.coordinate}` is a length")
        if self.normal_load is None:
            if self.coordinate.endswith((".x", ".y")):
                yield Problem((), f"`normal_load` is missing: no reaction loads `{self.coordinate}` alone")
            return
        by_reaction = ("preload", "collar_radius", "bearing_length", *(("radius",) if kind == "length" else ()))
        for name in by_reaction:
            if getattr(self, name):
                yield superfluous(name, "must not be given with `normal_load`, which is the whole load")


# of a contact that is asked for it, behind its other outputs
class WorkRow(Row):
    """Work of the friction of a contact since the start: a STATE that nothing depends on. POWER: output with its rate, or NONE where a
    patch adds it, whose power is known behind all forces."""

    output: int
    state: int
    power: int


@element
def rub_off(machine, index, n, t):
    """Report the work of a contact, and add to its rate: these elements come last."""
    record = record_at(machine)
    elements, out = record.elements, record.outputs.value
    out[index[WorkRow.OUTPUT]] = elements.state[index[WorkRow.STATE]]
    if index[WorkRow.POWER] != NONE:
        elements.state_rate[index[WorkRow.STATE]] += out[index[WorkRow.POWER]]


def add_friction_work(builder: SystemBuilder, name: str, power: int) -> int:
    """State with the work of the contact `name`, which has the output WORK; power : output with its rate, or NONE where the patch of the
    contact adds to the state. Returns the state."""
    fact = StateFact(f"{name}.friction_work", "J", f"work of friction of {name}", 0.0, 1.0, integral=True)
    state = builder.own_state(fact)
    builder.add(rub_off, WorkRow(output=builder.outputs.index(f"force.{name}.friction_work"), state=state, power=power))
    return state


def add_friction(builder: SystemBuilder, force: Friction) -> None:
    """Friction in a joint coordinate: an extra row, see `nivel.kernels.elements.friction`."""
    joint, _ = resolve(force.coordinate, builder.machine.joints)
    coordinate = builder.coordinate(force.coordinate)
    angle = is_angle(builder, coordinate)
    state = NONE
    if force.model == "lugre":
        assert force.bristle_stiffness is not None  # the record was checked
        # deflection of the bristles in steady sliding
        scale = force.coefficient / force.bristle_stiffness
        name = f"{force.name}.bristle"
        state = builder.own_state(StateFact(name, "m", f"deflection of the bristles of {force.name}", 0.0, scale))
    first = add_outputs(builder, force, angle, without=() if force.model == "lugre" else ("bristle",))
    model = {"coulomb": friction.COULOMB, "stiction": friction.STICTION, "lugre": friction.LUGRE}[force.model]
    loaded_by = NONE if force.normal_load is not None else [each.name for each in builder.machine.joints].index(joint)
    radius = force.radius or 0.0
    kind, seen_from, to, _ = builder.coordinates.what[coordinate]
    frame = to if kind == CROSS_SECOND else seen_from
    # what slides on a beam has its bearing with it: `to` is only the first of the nodes
    bearing = seen_from if kind == ALONG else _bearing(builder, seen_from, to)
    index = [coordinate, model, loaded_by, int(angle), state, first, frame, bearing, NONE, NONE]
    numbers = [
        force.coefficient,
        force.static,
        1.0 if force.stribeck_speed is None else force.stribeck_speed,
        force.transition_speed or 1.0,
        force.viscous,
        force.bristle_stiffness or 0.0,
        force.bristle_damping,
        radius if angle else 1.0,
        force.collar_radius / radius if angle else 0.0,
        2.0 / force.bearing_length if force.bearing_length else 0.0,
        1.0 / radius if radius and not angle else 0.0,
        force.normal_load if force.normal_load is not None else force.preload,
        0.0,
    ]
    builder.frictions.append((index, numbers))
    builder.friction_names.append(force.name)


ROUND_FACE = 2.0 / 3.0  # mean lever of a disc that is pressed evenly, by its radius


def add_patch(
    builder: SystemBuilder, contact: Contact, ends: tuple[int, int], output: int, spins: bool, share: float = 1.0
) -> list[int]:
    """Frictions along two tangents and, where the contact `spins`, about the normal; then those of resistance to rolling. ends : markers of
    the two bodies. output : first one of the contact. share : of the radius of gyration of its points that is the lever of a spin. Returns
    the first friction, how many there are without those of rolling, and the first coordinate: see `nivel.kernels.elements.patch`."""
    first, count = len(builder.frictions), 3 if spins or contact.patch_radius else 2
    rolls, axes = contact.rolling_resistance > 0.0, ["slip_x", "slip_y", "spin"][:count]
    work = add_friction_work(builder, contact.name, NONE) if contact.friction_work else NONE
    reach = ROUND_FACE * (contact.patch_radius or 0.0)
    coordinates = []
    for axis, name in enumerate([*axes, *(["roll_x", "roll_y"] if rolls else [])]):
        turns = axis >= count
        coordinates.append(builder.coordinates.add(PATCH, *ends, axis))
        own = [first + count, 2] if turns else [first, count]
        index = [coordinates[-1], friction.PATCH, NONE, int(axis >= 2), work, output, *ends, *own]
        limits = [contact.rolling_resistance] * 2 if turns else [contact.friction, contact.static]
        levers = [reach, 0.0 if reach else share, float(rolls)] if axis == 0 else [0.0] * 3
        builder.frictions.append((index, [*limits, 0.0, 1.0, *[0.0] * 3, 1.0, *levers, 0.0, 0.0]))
        builder.friction_names.append(f"{contact.name}.{name}")
    return [first, count, coordinates[0]]


def _bearing(builder: SystemBuilder, first: int, second: int) -> int:
    """Which of two markers is at the bearing: that of the second body, unless this is the ground and the first is not."""
    ground = builder.body(GROUND)
    return first if builder.markers.body[second] == ground != builder.markers.body[first] else second


KINDS = (Kind(Friction, add_friction, ()),)
