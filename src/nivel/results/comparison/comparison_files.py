"""A comparison as a table of text and as JSON, and back."""

from __future__ import annotations

import csv
import io
import json
import math
import os
from pathlib import Path
from typing import Any, Final

from nivel.errors import ModelError
from nivel.files.target import check_target, write_file
from nivel.results.comparison.comparison import Comparison, Reference, Row, Spread, as_record
from nivel.results.trust import Trust

UNITS: Final = {
    "step": "s",
    "loop_seconds": "s",
    "seconds_per_step": "s",
    "constraint_rate_error": "1/s",
    "constraint_rate_error_mean": "1/s",
    "energy_error": "J",
    "motion_error_time": "s",
}


def csv_text(comparison: Comparison) -> str:
    """A header (`step [s]`) and a line for every row; numbers as short as they can be read back exactly, nothing where there is none."""
    names = list(as_record(Row("", "", "", "", "")))
    file = io.StringIO()
    table = csv.writer(file, lineterminator="\n")
    table.writerow([f"{name} [{UNITS[name]}]" if name in UNITS else name for name in names])
    for row in comparison.rows:
        record = as_record(row)
        table.writerow(["" if record[name] is None else record[name] for name in names])
    return file.getvalue()


def json_text(comparison: Comparison) -> str:
    """Everything; what is not a number is null."""
    data = as_record(comparison)
    data["rows"] = [as_record(row) for row in comparison.rows]
    data["references"] = [as_record(each) for each in comparison.references]
    data["spread"] = comparison.spread and as_record(comparison.spread)
    data["trust"] = json.loads(comparison.trust.to_json())
    return json.dumps(_finite(data), indent=2, ensure_ascii=False) + "\n"


def read_json(text: str) -> Comparison:
    """The comparison of `json_text`. Raises ModelError where `text` is none."""
    try:
        data = json.loads(text)
        return Comparison(
            **data
            | {
                "rows": tuple(Row(**row) for row in data["rows"]),
                "references": tuple(Reference(**each) for each in data["references"]),
                "spread": data["spread"] and Spread(**data["spread"]),
                # files of earlier versions have none
                "trust": Trust.from_json(json.dumps(data["trust"])) if "trust" in data else Trust("green", "done"),
            }
        )
    except (ValueError, TypeError, KeyError) as error:
        raise ModelError(f"this is not the text of a comparison, as `to_json` writes it: {error}") from error


def write_text(text: str, path: str | os.PathLike[str] | None, what: str, *, force: bool) -> str:
    """Write `text` to `path`, if there is one; returns it. `what` it is, for the message where it cannot be written.

    An existing file is replaced with `force` only.
    """
    if path is not None:
        check_target(Path(path), what, force=force)
        write_file(path, what, text)
    return text


def _finite(value: Any) -> Any:
    """JSON knows neither NaN nor infinity."""
    if isinstance(value, dict):
        return {key: _finite(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(each) for each in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
