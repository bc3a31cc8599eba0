"""The names of a machine and what they lead to. Reads raw data too: what makes no sense is passed over."""

from collections.abc import Mapping, Sequence
from typing import Any, Final

from nivel.lazy import Struct
from nivel.machine.core.record import entry

Place = tuple[str | int, ...]
SECTIONS: Final = (
    "bodies",
    "beams",
    "markers",
    "joints",
    "couplings",
    "drivers",
    "forces",
    "fluids",
    "hydraulics",
    "inputs",
    "states",
    "control",
    "sensors",
    "events",
)


def elements(machine: Any, section: str) -> Sequence[Any]:
    """The elements of a section."""
    return as_list(entry(machine, section))


def as_list(value: Any) -> Sequence[Any]:
    """`value`, if it is a list."""
    return value if isinstance(value, list | tuple) else ()


def as_mapping(value: Any) -> Mapping[str, Any]:
    """`value`, if it is a mapping."""
    return value if isinstance(value, Mapping) else {}


class Index(Struct, eq=False):
    """What the elements of a machine are, by name.

    bodies : type of the shape ("" without one), also of the stations of beams. touching : the same of bodies and of markers with a
    shape. beams : names of the stations.
    point_masses : bodies that are. markers : the body. joints : the type. locked : motions that generic joints lock. inputs, fluids : their
    names. forces, hydraulics, states, control, sensors : the element.
    """

    bodies: Mapping[str, str]
    touching: Mapping[str, str]
    beams: Mapping[str, tuple[str, ...]]
    point_masses: frozenset[str]
    markers: Mapping[str, str]
    joints: Mapping[str, str]
    inputs: tuple[str, ...]
    locked: Mapping[str, tuple[Any, ...]]
    forces: Mapping[str, Any]
    fluids: tuple[str, ...]
    hydraulics: Mapping[str, Any]
    states: Mapping[str, Any]
    control: Mapping[str, Any]
    sensors: Mapping[str, Any]

    @classmethod
    def of(cls, machine: Any) -> "Index":
        """The index of a machine record, or of what it is made of."""
        bodies, beams = _shapes(_by_name(machine, "bodies")), _stations(machine)
        markers = _by_name(machine, "markers")
        stations = {station: "" for names in beams.values() for station in names}
        return cls(
            bodies=bodies | stations,
            touching={name: shape for name, shape in _shapes(markers).items() if shape} | bodies | stations,
            beams=beams,
            point_masses=frozenset(
                name for name, body in _by_name(machine, "bodies").items() if entry(body, "point_mass") is True
            ),
            markers={name: _text(entry(marker, "body")) for name, marker in markers.items()},
            joints={name: _text(entry(joint, "type")) for name, joint in _by_name(machine, "joints").items()},
            inputs=tuple(_by_name(machine, "inputs")),
            locked={
                name: tuple(as_list(entry(joint, "locked"))) for name, joint in _by_name(machine, "joints").items()
            },
            forces=_by_name(machine, "forces"),
            fluids=tuple(_by_name(machine, "fluids")),
            hydraulics=_by_name(machine, "hydraulics"),
            states=_by_name(machine, "states"),
            control=_by_name(machine, "control"),
            sensors=_by_name(machine, "sensors"),
        )

    def body_of(self, end: Any) -> str | None:
        """The body that a marker is on, given by its name or written out; None where that is not known."""
        body = self.markers.get(end) if isinstance(end, str) else entry(end, "body")
        return body if isinstance(body, str) and body else None


def _stations(machine: Any) -> dict[str, tuple[str, ...]]:
    """The names of the stations of each beam, which are bodies without a shape."""
    return {
        name: tuple(f"{name}.{station}" for station in ("start", *as_mapping(entry(beam, "stations")), "end"))
        for name, beam in _by_name(machine, "beams").items()
    }


def _shapes(elements: Mapping[str, Any]) -> dict[str, str]:
    return {name: _text(entry(entry(each, "shape"), "type")) for name, each in elements.items()}


def _by_name(machine: Any, section: str) -> dict[str, Any]:
    return {name: each for each in elements(machine, section) if isinstance(name := entry(each, "name"), str)}


def _text(value: Any) -> str:
    return value if isinstance(value, str) else ""
