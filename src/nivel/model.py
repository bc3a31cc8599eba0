"""Elements of a machine: its elements by name, and copies with other values or elements."""

from collections.abc import Mapping
from functools import cached_property
from html import escape
from os import PathLike
from typing import TYPE_CHECKING, Any, Generic, Self, TypeVar

from nivel import known
from nivel.elements.joints.joint import Joint
from nivel.errors import Fault, ModelError, retold
from nivel.files.outline import Known
from nivel.files.reader import Origin
from nivel.files.scope import FileNames, Scope
from nivel.files.sources import Sources
from nivel.files.target import write_file
from nivel.files.values import elements_named, replaced, section_of_element, value_at, whole_path, with_values
from nivel.files.writer import write_machine
from nivel.judge.before.unusual import remarks
from nivel.lazy import Struct, nivel, replace
from nivel.machine.bodies.body import Body
from nivel.machine.core.element import Marker
from nivel.machine.core.named import Named, NamedValues
from nivel.machine.core.record import Record, entry
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.run import AssemblySettings, SimulationSettings, changed
from nivel.machine.uses.references import SECTIONS
from nivel.words.arguments import checked_methods
from nivel.words.wording import unknown_word

Element = TypeVar("Element", bound=Record)
Value = TypeVar("Value")


class Kept(property, Generic[Value]):
    """What the record of a machine has under the same name."""

    def __init__(self, doc: str) -> None:
        super().__init__(self._of)
        self.__doc__ = doc

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    def _of(self, part: "Elements") -> Any:
        return getattr(part.record, self._name)

    if TYPE_CHECKING:

        def __get__(self, part: Any, owner: type | None = None) -> Value: ...  # type: ignore[override]


class Section(Kept[Named[Element]]):
    """The elements of a section by name. singular : one of them in words."""

    def __init__(self, singular: str, doc: str) -> None:
        super().__init__(doc)
        self._singular = singular

    def _of(self, part: "Elements") -> Named[Element]:
        mine = [each for each in super()._of(part) if str(getattr(each, "name", "")).startswith(part._prefix)]
        return Named(self._singular, mine, part._prefix)


class Elements:
    """The elements of a machine, or of a part of it, by kind and name."""

    record: MachineRecord
    _prefix = ""

    bodies: Section[Body] = Section("body", "Bodies by name.")
    beams: Section[known.Beam] = Section("beam", "Beams by name.")
    markers: Section[Marker] = Section("marker", "Markers by name.")
    joints: Section[Joint] = Section("joint", "Joints by name.")
    couplings: Section[known.Coupling] = Section(
        "coupling", "Couplings by name: gears, belts, racks and linear couplings."
    )
    drivers: Section[known.Driver] = Section("driver", "Drivers by name.")
    forces: Section[known.Force] = Section("force", "Forces by name, of all types.")
    fluids: Section[known.AnyFluid] = Section("fluid", "Fluids by name.")
    hydraulics: Section[known.HydraulicComponent] = Section("component", "Components of hydraulic circuits by name.")
    inputs: Section[known.Input] = Section("input", "Inputs by name.")
    states: Section[known.State] = Section("state", "States beside the motion, by name.")
    control: Section[known.ControlBlock] = Section("block", "Blocks of the control by name.")
    sensors: Section[known.Sensor] = Section("sensor", "Sensors by name.")
    events: Section[known.Event] = Section("event", "Events by name.")


class Subsystem(Struct, Elements, repr=False):
    """A part of a machine that an assembly makes: ``machine.assemblies["left"].bodies["thigh"]``.

    assembly : file, place and parameters, as given. Its elements go by their names in the part; in the machine these have its `prefix`.
    """

    record: MachineRecord
    assembly: known.Assembly

    @property
    def prefix(self) -> str:
        """What stands before the names of its elements in the machine."""
        return self.assembly.prefix

    _prefix = prefix

    def __repr__(self) -> str:
        counts = [f"{len(getattr(self, section))} {section}" for section in SECTIONS if len(getattr(self, section))]
        return f"<Subsystem {self.prefix}*: {', '.join(counts)}>"


@checked_methods
class Model(Elements):
    """A machine as a model that can be read, changed and written. Nothing changes a machine; what changes it returns another."""

    origin: Origin
    name: Kept[str] = Kept("Name of the machine.")
    description: Kept[str] = Kept("What the machine is, in the words of its author.")
    gravity: Kept[tuple[float, float, float]] = Kept("[m/s²] global axes.")
    assembly: Kept[AssemblySettings] = Kept("How the machine is assembled.")
    simulation: Kept[SimulationSettings] = Kept("How the machine is simulated unless a run has settings of its own.")

    @classmethod
    def from_record(cls, record: MachineRecord, origin: Origin | None = None) -> Self:
        """Wrap a record; `origin` says where its values were set."""
        machine = cls.__new__(cls)
        machine.record = record
        machine.origin = origin or Origin()
        return machine

    def __setattr__(self, name: str, value: Any) -> None:
        if name in MachineRecord.model_fields:
            message = f"nothing changes a machine; write `machine = machine.replace({name}=…)`, which gives another one"
            raise ModelError(Fault.at(name, message))
        object.__setattr__(self, name, value)

    @property
    def _scope(self) -> Scope | None:
        """The machine's file; None where there is none."""
        its = self.origin
        if not its.source:
            return None
        return Scope(its.source, its.file, Sources(its.allow_code).inside(its.file), its.values)

    @cached_property
    def _file_names(self) -> FileNames:
        return FileNames({}, {}) if self._scope is None else self._scope.names()

    @cached_property
    def _known(self) -> Known | None:
        """Its elements, as the file has them; None where there is no file."""
        return self._scope and self._scope.known(self.record)

    @cached_property
    def name_notes(self) -> tuple[str, ...]:
        """Sentences on parameters of the machine's file that have the name of a unit or of a constant, and stand in its place."""
        return () if self._scope is None else self._scope.name_notes()

    @property
    def remarks(self) -> tuple[Fault, ...]:
        """Values that are far from those of real machines, with the place where each stands; the machine is computed as it is."""
        return tuple(self.origin.placed(finding.fault) for finding in remarks(self.record))

    @property
    def parameters(self) -> Mapping[str, float]:
        """Values of the parameters of the machine's file, in SI units; none where the machine was written in Python."""
        return NamedValues("parameter", self._file_names.parameters)

    def decides(self, path: str) -> bool:
        """Whether a parameter of the machine's file decides between pieces of an expression: numbers follow it by several formulas."""
        section, _, name = path.partition(".")
        return section.strip() == "parameters" and name.strip() in self._file_names.deciding

    @property
    def assemblies(self) -> Mapping[str, Subsystem]:
        """The subsystems that the `assemblies` of the machine's file make, by name."""
        found = {name: Subsystem(self.record, assembly) for name, assembly in self._file_names.assemblies.items()}
        return NamedValues("assembly", found)

    def __getitem__(self, path: str) -> Any:
        """The element of this name, ``machine["crank"]``, or what stands at a path as in a machine file,
        ``machine["bodies.crank.mass"]`` or ``machine["crank.mass"]``, in SI units. Raises ModelError with the nearest name.
        """
        if path.split(".", maxsplit=1)[0].strip() == "parameters" and "." in path:
            return self._parameter(path.partition(".")[2].strip())
        whole = whole_path(self.record, path)
        if whole == path and "." not in path and path not in MachineRecord.model_fields:
            names = [str(entry(each, "name")) for section in SECTIONS for each in getattr(self.record, section)]
            raise ModelError(Fault.at("", unknown_word(path, list(dict.fromkeys(names)), "element")))
        return value_at(self.record, whole)

    def _parameter(self, name: str) -> float:
        return self.parameters[name]

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and bool(elements_named(self.record, name))

    def with_values(self, values: Mapping[str, Any]) -> Self:
        """The same machine with other values by path: ``{"bodies.crank.mass": "22 kg", "parameters.length": 0.3}``.

        Paths and texts are those of `nivel run --set`; numbers are in SI units. What a file computes from a parameter follows it.
        Raises ModelError with every fault.
        """
        whole = {whole_path(self.record, path): value for path, value in values.items()}
        given = {name: value for name, value in self.origin.given.items() if f"simulation.{name}" not in whole}
        record, origin = with_values(self.record, self.origin, whole, self._known)
        machine = type(self).from_record(record, origin)
        return machine.with_settings(given) if given else machine

    def with_settings(self, settings: Mapping[str, Any]) -> Self:
        """The same machine with some simulation settings replaced."""
        if not settings:
            return self
        # what was set from outside of the file is asked for as well, and never left behind
        outside, origin = self.origin.settings_outside, self.origin.with_settings(settings)
        asked = {name: getattr(self.record.simulation, name) for name in outside if name in ("rotations", "baumgarte")}
        with retold(lambda fault: origin.placed(origin.of_settings(fault, settings))):
            simulation = changed(self.record.simulation, {**asked, **settings})
        old = self.record.simulation
        if simulation.cut == old.cut and simulation.free == old.free:
            return type(self).from_record(self.record.with_simulation(simulation), origin)
        with retold(origin.placed):
            return type(self).from_record(self.record.replace(simulation=simulation), origin)

    def replace(self, *elements: Record, **words: Any) -> Self:
        """The same machine with other elements or words: ``machine.replace(rod.replace(mass=3), gravity=(0, 0, -1.62))``.

        elements : records that stand in place of those with their names. words : sections as lists of records, `gravity`, `name`,
        `description`, `assembly`, `simulation`. Raises ModelError with everything that is wrong.
        """
        return self._edited({**replaced(self.record, elements), **words})

    def with_elements(self, *elements: Record) -> Self:
        """The same machine with more elements. Raises ModelError where a name is taken, or something does not fit."""
        sections: dict[str, tuple[Any, ...]] = {}
        for element in elements:
            section = section_of_element(element)
            before: tuple[Any, ...] = sections.get(section) or getattr(self.record, section)
            sections[section] = (*before, element)
        return self._edited(sections)

    def without(self, *names: str) -> Self:
        """The same machine without the elements of these names. Raises ModelError where one is not there, or is needed by others."""
        sections: dict[str, tuple[Any, ...]] = {}
        for name in names:
            self[name]  # refuses names that are not there, or that several have
            (section,) = elements_named(self.record, name)
            before: tuple[Any, ...] = sections[section] if section in sections else getattr(self.record, section)
            sections[section] = tuple(each for each in before if each.name != name)
        return self._edited(sections)

    def with_part(self, name: str, part: "Model", **placing: Any) -> Self:
        """The same machine with all elements of another one, `part`, placed and named as by an entry of `assemblies:`.

        placing : `position`, `orientation`, `mirror`, `prefix` (default the name and `_`), as in a machine file.
        """
        assembly = nivel.files.assembly.Assembly(file="part", **{"prefix": f"{name}_", **placing})
        try:
            made = nivel.files.assembly.elements_of(part.record, assembly)
        except nivel.files.assembly.NotRepresentableError as error:
            raise ModelError(Fault.at(name, str(error))) from None
        more = {section: (*getattr(self.record, section), *records) for section, records in made.items() if records}
        return self._edited(more)

    def _edited(self, changes: Mapping[str, Any]) -> Self:
        with retold(lambda fault: replace(fault, file="", line=0, column=0)):
            record = self.record.replace(**changes)
        return type(self).from_record(record, self.origin.edited())

    def save(self, path: str | PathLike[str]) -> None:
        """Write the machine as a YAML file; an existing file is replaced. Raises ModelError where it cannot be written."""
        write_file(path, "machine file", self.to_yaml())

    def to_yaml(self) -> str:
        """The machine as the text of a machine file, which reads back to an equal machine. SI units, defaults left out."""
        return write_machine(self.record)

    def __eq__(self, other: object) -> bool:
        return self.record == other.record if isinstance(other, Model) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.record.name)

    def _repr_html_(self) -> str:
        """A card for notebooks: what the machine consists of."""
        record = self.record
        rows = [
            ("body", body.name, f"{body.mass:g} kg" if body.mass is not None else "from its shape")
            for body in record.bodies
        ]
        rows += [("joint", joint.name, joint.type) for joint in record.joints]
        rows += [("force", force.name, force.type) for force in record.forces]
        lines = "".join(
            f"<tr><td>{kind}</td><th>{escape(name)}</th><td>{escape(fact)}</td></tr>" for kind, name, fact in rows
        )
        return f"<table><caption>{escape(record.name)}</caption>{lines}</table>"

    def __repr__(self) -> str:
        record = self.record
        parts = [
            f"{len(items)} {word if len(items) != 1 else singular}"
            for items, word, singular in (
                (record.bodies, "bodies", "body"),
                (record.joints, "joints", "joint"),
                (record.forces, "forces", "force"),
            )
        ]
        return f"<Machine {record.name}: {', '.join(parts)}>"

    def _ipython_key_completions_(self) -> list[str]:
        return [str(entry(each, "name")) for section in SECTIONS for each in getattr(self.record, section)]
