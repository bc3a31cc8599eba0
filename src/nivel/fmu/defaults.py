"""Defaults of parameters by their paths in a machine: numbers in SI units, and what the units are."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, get_args

from nivel.errors import Fault, ModelError
from nivel.machine.units.dimension import KINDS
from nivel.machine.units.quantity import Quantity
from nivel.model import Model
from nivel.words.wording import shown


def defaults_of(machine: Model, paths: Sequence[str]) -> dict[str, float]:
    """Values by path. Raises ModelError with every path that leads to no number."""
    out: dict[str, float] = {}
    faults: list[Fault] = []
    for path in paths:
        try:
            value = machine[path]
        except ModelError as error:
            faults += [Fault.at(path, fault.message) for fault in error.faults]
            continue
        if isinstance(value, bool) or not isinstance(value, int | float):
            faults.append(Fault.at(path, f"a parameter of an FMU is a number; here is {shown(value)}"))
        else:
            out[path] = float(value)
    if faults:
        raise ModelError(faults)
    return out


def units_of(machine: Model, paths: Sequence[str]) -> dict[str, str]:
    """SI units by path; empty where the field of a record does not say one."""
    out = {}
    for path in paths:
        owner, _, leaf = path.rpartition(".")
        record = None if owner in ("", "parameters") else machine[owner]
        field = getattr(type(record), "model_fields", {}).get(leaf)
        kind = None if field is None else _kind([field.annotation, *field.metadata])
        out[path] = KINDS[kind][1] if isinstance(kind, str) else ""
    return out


def _kind(parts: Sequence[Any]) -> Any:
    """The kind of quantity that an annotation names."""
    for part in parts:
        if isinstance(part, Quantity):
            return part.kind
        if (found := _kind([*get_args(part), *getattr(part, "__metadata__", ())])) is not None:
            return found
    return None
