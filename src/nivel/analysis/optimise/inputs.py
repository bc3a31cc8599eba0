"""Inputs over time as parameters: values of a table between which they change along straight lines (direct shooting)."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from nivel.analysis.optimise.evaluations import Box
from nivel.errors import Fault, refuse
from nivel.lazy import dataclass
from nivel.machine.laws.table import Table
from nivel.machine.machine_record import MachineRecord
from nivel.words.wording import shown, unknown_word


@dataclass(frozen=True)
class Course:
    """Inputs as tables, the paths of whose values are the parameters. names : of the inputs; times : (n,) [s] of the corners."""

    record: MachineRecord
    box: Box
    names: tuple[str, ...]
    times: tuple[float, ...]

    def tables(self, values: Mapping[str, float]) -> dict[str, Table]:
        """The inputs for values by path."""
        rows = {name: tuple(values[_path(name, k)] for k in range(len(self.times))) for name in self.names}
        return {name: Table(times=self.times, values=row) for name, row in rows.items()}


def course_of(record: MachineRecord, inputs: Mapping[str, int], duration: float) -> Course:
    """inputs : by name into how many pieces, all of one length, the duration [s] is cut; the same of all. Raises ModelError."""
    known, faults = {each.name: each for each in record.inputs}, []
    for name, pieces in inputs.items():
        if name not in known:
            faults.append(Fault.at("inputs", unknown_word(name, list(known), "input")))
        elif not isinstance(pieces, int) or isinstance(pieces, bool) or pieces < 1:
            faults.append(Fault.at(f"inputs.{name}", f"a number of pieces was expected, got {shown(pieces)}"))
        elif not np.isfinite(known[name].range).all():
            message = f"the input `{name}` needs a range, within which it is looked for: range: [-10, 10]"
            faults.append(Fault.at(f"inputs.{name}.range", message))
    if not inputs:
        faults.append(Fault.at("inputs", "name the inputs and their pieces, {'push': 10}"))
    if len({*inputs.values()}) > 1 and not faults:
        faults.append(Fault.at("inputs", "all inputs are cut into the same number of pieces"))
    refuse(faults)
    (pieces,) = {*inputs.values()}
    times = tuple(float(t) for t in np.linspace(0.0, duration, pieces + 1))
    paths, low, high, start, changed = [], [], [], [], []
    for each in record.inputs:
        if each.name not in inputs:
            changed.append(each)
            continue
        rest = min(max(0.0, each.range[0]), each.range[1])
        changed.append(each.replace(signal=Table(times=times, values=(rest,) * len(times))))
        paths += [_path(each.name, k) for k in range(len(times))]
        low += [each.range[0]] * len(times)
        high += [each.range[1]] * len(times)
        start += [rest] * len(times)
    box = Box(tuple(paths), np.array(low), np.array(high), np.array(start))
    names = tuple(each.name for each in record.inputs if each.name in inputs)
    return Course(record.replace(inputs=tuple(changed)), box, names, times)


def _path(name: str, k: int) -> str:
    return f"inputs.{name}.signal.values.{k}"
