"""A whole machine in words."""

from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Final, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import (
    BeforeValidator,
    ModelWrapValidatorHandler,
    ValidationError,
    ValidationInfo,
    WithJsonSchema,
    model_validator,
)
from pydantic_core import InitErrorDetails

from nivel.elements.circuits import HydraulicComponent
from nivel.elements.control import ControlBlock
from nivel.elements.forces import Force
from nivel.elements.joints.joint import Joint
from nivel.elements.kind import RecordAt
from nivel.lazy import nivel
from nivel.machine.bodies.body import Body
from nivel.machine.bodies.point_masses import problems_of_points
from nivel.machine.bodies.shape import Shape, Standing
from nivel.machine.bodies.touching import Touching
from nivel.machine.control.order import problems_of_control
from nivel.machine.core.element import Marker
from nivel.machine.core.index import Index
from nivel.machine.core.orientation import matrix_from_euler_parameters
from nivel.machine.core.placement import placement
from nivel.machine.core.record import Checked, Problem, entry, lines_of, restated
from nivel.machine.given import GRAVITY, SIZE, Field, ManyNames, ManyRecords, OneRecord, Usual
from nivel.machine.laws.functions import MachineFunction, functions_of
from nivel.machine.settings.run import AssemblySettings, SimulationSettings
from nivel.machine.units.quantity import AccelerationVector, fault, listed, parameters_of, shown
from nivel.machine.uses.coordinate_uses import with_whole_coordinates
from nivel.machine.uses.references import problems_of_interfaces, reference_faults

if TYPE_CHECKING:
    from nivel.elements.beams.beam import Beam
    from nivel.elements.circuits.fluids import AnyFluid
    from nivel.elements.joints.couplings import Coupling
    from nivel.elements.joints.drivers import Driver
    from nivel.machine.signals.input import Event, Input, State
    from nivel.machine.signals.sensor import Sensor
else:  # sections that few machines have
    Beam = Annotated[Any, RecordAt("nivel.elements.beams.beam:Beam")]
    AnyFluid = Annotated[Any, RecordAt("nivel.elements.circuits.fluids:AnyFluid")]
    Coupling = Annotated[Any, RecordAt("nivel.elements.joints.couplings:Coupling")]
    Driver = Annotated[Any, RecordAt("nivel.elements.joints.drivers:Driver")]
    Event = Annotated[Any, RecordAt("nivel.machine.signals.input:Event")]
    Input = Annotated[Any, RecordAt("nivel.machine.signals.input:Input")]
    Sensor = Annotated[Any, RecordAt("nivel.machine.signals.sensor:Sensor")]
    State = Annotated[Any, RecordAt("nivel.machine.signals.input:State")]

LONGEST_NAME: Final = 100  # characters: the files of a run are named after the machine


def _title(value: Any) -> str:
    if not isinstance(value, str) or not value.strip():
        raise fault(f"a name was expected, got {shown(value)}")
    if any(character in '/\\<>:"|?*' or not character.isprintable() for character in value):
        raise fault(f"`{value}` cannot be the name of a result file, which is named after the machine")
    if len(value.strip()) > LONGEST_NAME:
        raise fault(
            f"a name of at most {LONGEST_NAME} characters was expected, got {len(value.strip())}: {shown(value)}"
        )
    return value.strip()


def _has_none(data: Any, section: str) -> bool:
    """Whether the machine in `data` lacks a section, or has an empty one."""
    records = entry(data, section)
    return records is None or (isinstance(records, list | tuple) and not records)


def _solids(value: Any) -> Any:
    """A list of solids; they have no names."""
    if isinstance(value, Mapping):
        raise fault(
            "a list was expected, got a mapping; solids have no names: write `- {type: box, size: [4, 4, 0.1]}`"
        )
    return listed(value)


Title = Annotated[str, BeforeValidator(_title), WithJsonSchema({"type": "string"})]


# sections of which a machine has one at least
MOVING: Final = ("bodies", "beams", "hydraulics")


class MachineRecord(Checked):
    """Everything that describes a machine. SI, angles in radians."""

    tagged = {"couplings": 2, "fluids": 2, "surroundings": 2}  # noqa: RUF012
    usual: ClassVar[Mapping[str, Usual]] = {"size": SIZE}

    name: Title
    description: str = ""
    left_out: Annotated[ManyNames[str], BeforeValidator(listed)] = Field(
        "what a translation of another program's model left out; every trust report names it", default=()
    )
    surroundings: Annotated[ManyRecords[Shape], BeforeValidator(_solids)] = Field(
        "solids that are drawn on the ground, at global places; nothing touches them", default=()
    )
    gravity: AccelerationVector = Field(default=(0.0, 0.0, 0.0), usual=GRAVITY)
    bodies: ManyRecords[Body] = Field(default=())
    beams: ManyRecords[Beam] = Field(default=())
    markers: ManyRecords[Marker] = Field(default=())
    joints: ManyRecords[Joint] = Field(default=())
    couplings: ManyRecords[Coupling] = Field(default=())
    drivers: ManyRecords[Driver] = Field(default=())
    forces: ManyRecords[Force] = Field(default=())
    fluids: ManyRecords[AnyFluid] = Field(default=())
    hydraulics: ManyRecords[HydraulicComponent] = Field(default=())
    inputs: ManyRecords[Input] = Field(default=())
    states: ManyRecords[State] = Field(default=())
    control: ManyRecords[ControlBlock] = Field(default=())
    sensors: ManyRecords[Sensor] = Field(default=())
    events: ManyRecords[Event] = Field(default=())
    assembly: OneRecord[AssemblySettings] = Field(default=AssemblySettings())
    simulation: OneRecord[SimulationSettings] = Field(default=SimulationSettings())

    @cached_property
    def body_named(self) -> Mapping[str, Body]:
        """The bodies by name."""
        return {body.name: body for body in self.bodies}

    @cached_property
    def touching(self) -> Mapping[str, Touching]:
        """What may touch in a contact, by name: bodies, and markers with a shape."""
        markers = {each.name: Touching.of_marker(each) for each in self.markers if each.shape is not None and each.name}
        return markers | {body.name: Touching.of_body(body) for body in self.bodies}

    @cached_property
    def poses(self) -> Mapping[str, tuple[NDArray[np.float64], NDArray[np.float64]]]:
        """Position (3,) [m] and Euler parameters (4,) of the frame of every body, global, as given (before assembly)."""
        return {name: placement(body) for name, body in self.body_named.items()}

    @cached_property
    def placed(self) -> Mapping[str, tuple[NDArray[np.float64], NDArray[np.float64]]]:
        """The same with rotation matrices (3, 3)."""
        return {name: (position, matrix_from_euler_parameters(theta)) for name, (position, theta) in self.poses.items()}

    @cached_property
    def marker_named(self) -> Mapping[str, Marker]:
        """The markers that have a place of their own, by name."""
        return {marker.name: marker for marker in self.markers if marker.name is not None}

    @cached_property
    def functions(self) -> tuple[MachineFunction, ...]:
        """All functions, those that do not vary left out, section by section; settings have none."""
        return tuple(functions_of(self))

    @cached_property
    def index(self) -> Index:
        """What the elements are, by name."""
        return Index.of(self)

    def with_simulation(self, simulation: SimulationSettings) -> Self:
        """The same machine with other settings, which name no joints that these did not: nothing is checked again."""
        return self.model_copy(update={"simulation": simulation})

    @model_validator(mode="wrap")
    @classmethod
    def _in_plain_words(cls, data: Any, handler: ModelWrapValidatorHandler[Self], info: ValidationInfo) -> Self:
        """Faults of all parts, and names that lead nowhere, in one error."""
        data = with_whole_coordinates(data)
        if not _has_none(data, "hydraulics"):
            data = nivel.machine.uses.hydraulic_uses.with_named_nodes(data)
        faults = reference_faults(data, parameters_of(info))
        lines = [InitErrorDetails(type=fault(text), loc=place, input=None) for place, text in faults]
        if all(_has_none(data, section) for section in MOVING):
            message = "a machine needs at least one body, beam or circuit"
            lines.append(InitErrorDetails(type=fault(message), loc=("bodies",), input=None))
        try:
            record = handler(data)
        except ValidationError as error:
            raise restated(error, cls, [*lines, *cls.lines_beside(error, data, info)]) from None
        if lines:
            lines += lines_of(problems_of_control(record))
            raise ValidationError.from_exception_data(cls.__name__, lines)
        return record

    @property
    def is_flexible(self) -> bool:
        """Whether a body of it bends, or a beam of it has nodes that deform."""
        return any(body.flexible is not None for body in self.bodies) or any(beam.has_gradients for beam in self.beams)

    @property
    def shares_mass(self) -> bool:
        """Whether a beam of it has a consistent mass, which its nodes have in common."""
        return any(beam.shares_mass for beam in self.beams)

    def problems(self) -> Iterator[Problem]:
        for k, each in enumerate(self.surroundings):
            if not isinstance(each, Standing) and each.from_ is not None:
                yield Problem(("surroundings", k), "a solid of the surroundings stands along the axes, at its `centre`")
        yield from problems_of_points(self)
        yield from problems_of_interfaces(self)
        yield from problems_of_control(self)
