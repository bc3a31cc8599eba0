"""Inputs in numbers: elements that write their values where signals read them, before all other elements."""

from __future__ import annotations

from nivel.kernels.record.function import OUTPUT
from nivel.kernels.signals.input import apply
from nivel.machine.table import Table
from nivel.system.builder import SystemBuilder
from nivel.system.located import located


def add_inputs(draft: SystemBuilder) -> None:
    """All inputs. Their functions are numbers `draft.inputs` of the functions, in the order of the machine."""
    for each in draft.machine.inputs:
        with located(f"inputs.{each.name}"), draft.noting():
            course = each.course
            function = draft.function(course if isinstance(course, Table) else float(course))
            output = draft.outputs.add((f"{each.name}.value", each.units or "1", f"input {each.name}"))
            draft.elements.add(apply, [output, function])
            draft.inputs[each.name] = (OUTPUT, output, 0)
            draft.input_functions.append(function)
