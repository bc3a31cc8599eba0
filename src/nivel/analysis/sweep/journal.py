"""Rows of the journal of a sweep, and what its numbers depend on."""

from __future__ import annotations

import json
from dataclasses import fields
from typing import Any

from nivel.analysis.progress.journal import Row, count_finished, fingerprint, packed, unpacked
from nivel.analysis.sweep.outputs import Number
from nivel.analysis.sweep.task import Task
from nivel.analysis.sweep.variant import Saved, VariantRun
from nivel.analysis.sweep.variants import Variants

__all__ = ["count_finished", "row_of", "run_of", "study_fingerprint"]


def study_fingerprint(task: Task, variants: Variants) -> str:
    """Of a sweep."""
    outputs = {name: output.model_dump(mode="json") for name, output in task.outputs.items()}
    return fingerprint(
        task.machine,
        task.analysis,
        sorted(task.settings.items()),
        json.dumps(outputs, sort_keys=True),
        (task.save, task.verify, task.time_limit, task.judge),
        variants.values,
    )


def row_of(run: VariantRun) -> dict[str, Any]:
    """A variant of a sweep as a row."""
    out = {each.name: getattr(run, each.name) for each in fields(run)}
    out["time"] = packed(run.time)
    out["outputs"] = {name: list(number) for name, number in run.outputs.items()}
    out["saved"] = {
        name: [each.dims, dict(each.names), each.units, each.long_name, packed(each.values)]
        for name, each in run.saved.items()
    }
    return out


def run_of(row: Row) -> VariantRun:
    """The variant of a row, to the last bit."""
    outputs = {name: Number(*each) for name, each in row["outputs"].items()}
    saved = {
        name: Saved(
            tuple(dims), {dim: tuple(listed) for dim, listed in names.items()}, units, long_name, unpacked(values)
        )
        for name, (dims, names, units, long_name, values) in row["saved"].items()
    }
    return VariantRun(**{**row, "time": unpacked(row["time"]), "outputs": outputs, "saved": saved})
