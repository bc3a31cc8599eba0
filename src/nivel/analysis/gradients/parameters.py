"""Parameters of gradients: numbers of a machine by their paths."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, get_args

from nivel.errors import Fault, ModelError, refuse
from nivel.lazy import dataclass
from nivel.machine.units.dimension import KINDS
from nivel.machine.units.quantity import Quantity
from nivel.model import Model
from nivel.words.wording import shown


@dataclass(frozen=True)
class Parameter:
    """A number of a machine. value : in SI units. units : of it, empty where its field says none.

    scale : what its changes are measured by, |value|, or 1 where it is zero.
    """

    path: str
    value: float
    units: str

    @property
    def scale(self) -> float:
        """What its changes are measured by."""
        return abs(self.value) or 1.0


def parameters_of(machine: Model, paths: Sequence[str], of: str = "a gradient") -> tuple[Parameter, ...]:
    """The numbers at these paths. of : whose parameters they are, for messages. Raises ModelError with every path that leads to no number
    of which a run depends smoothly."""
    out: list[Parameter] = []
    faults: list[Fault] = []
    if not paths:
        faults.append(Fault.at("parameters", "no parameter is given: give paths of numbers, ['bodies.rod.mass']"))
    for path in paths:
        try:
            value = machine[path]
        except ModelError as error:
            faults += [Fault.at(path, fault.message) for fault in error.faults]
            continue
        if isinstance(value, bool) or not isinstance(value, int | float):
            faults.append(Fault.at(path, f"the parameter of {of} is a number; here is {shown(value)}"))
        elif path.split(".")[0].strip() == "simulation":
            faults.append(Fault.at(path, f"settings of a run are no parameters of {of}: it is that of one run"))
        elif path in (each.path for each in out):
            faults.append(Fault.at(path, "this parameter is given twice"))
        else:
            out.append(Parameter(path, float(value), unit_of(machine, path)))
    refuse(faults)
    return tuple(out)


def unit_of(machine: Model, path: str) -> str:
    """SI unit of the number at a path; empty where the field of a record does not say one."""
    owner, _, leaf = path.rpartition(".")
    while leaf.isdecimal():  # a place in a list has the unit of the list
        owner, _, leaf = owner.rpartition(".")
    if owner == "parameters":
        return ""
    record = machine[owner] if owner else machine.record
    fields: Any = getattr(type(record), "model_fields", {})
    field = next((each for name, each in fields.items() if leaf in (name, each.alias)), None)
    kind = None if field is None else _kind([field.annotation, *field.metadata])
    return KINDS[kind][1] if isinstance(kind, str) else ""


def _kind(parts: Sequence[Any]) -> Any:
    """The kind of quantity that an annotation names."""
    for part in parts:
        if isinstance(part, Quantity):
            return part.kind
        if (found := _kind([*get_args(part), *getattr(part, "__metadata__", ())])) is not None:
            return found
    return None
