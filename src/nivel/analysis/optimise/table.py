"""Table of a search: every variant that was computed, as the dataset of a study, also where nothing was found."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray
from numpy.typing import NDArray

from nivel.analysis.optimise.evaluations import Evaluated, Evaluations
from nivel.errors import Fault, ModelError, NivelError, SolveError

Array = NDArray[np.float64]
FAILURES = ("failed", "timed out")


class NothingFoundError(ModelError):
    """No start has what is asked for, though runs came to their end; `result` is the table of all variants."""

    def __init__(self, fault: Fault, result: xarray.Dataset) -> None:
        super().__init__(fault)
        self.result = result


def table_of(evaluations: Evaluations, names: Sequence[str], attributes: Mapping[str, Any]) -> xarray.Dataset:
    """All variants that were computed, along the dimension `variant`, as those of a study. names : of the outputs."""
    made, box = evaluations.made, evaluations.box
    x = np.array([[*box.values(each.z).values()] for each in made]).reshape(len(made), len(box.paths))
    coords = {path: ("variant", x[:, k], {"long_name": f"value of {path}"}) for k, path in enumerate(box.paths)}
    data: dict[str, Any] = {
        "outcome": ("variant", np.array([each.outcome for each in made], dtype=str)),
        "reason": ("variant", np.array([each.reason for each in made], dtype=str)),
        "start": ("variant", np.array([each.start for each in made]), {"long_name": "number of the start"}),
    }
    for k, name in enumerate(names):
        data[name] = ("variant", np.array([each.outputs[k] for each in made]))
    counted = Counter(each.outcome for each in made)
    about = {
        "prepared_because": evaluations.prepared_because,
        "outcomes": ", ".join(f"{count} {outcome}" for outcome, count in counted.items()),
        "parameters": json.dumps(list(box.paths)),
        "outputs": json.dumps(list(names)),
        "bounds": json.dumps({path: [low, high] for path, low, high in zip(box.paths, box.low, box.high, strict=True)}),
    }
    return xarray.Dataset(data, coords=coords, attrs={**about, **attributes})


def nothing_found(made: Sequence[Evaluated], fault: Fault, otherwise: str, table: xarray.Dataset) -> NivelError:
    """Why no start has outputs: SolveError where runs fail, else NothingFoundError, with the table of all variants as its `result`.

    otherwise : the reason where variants tell none.
    """
    reasons = sorted({each.reason for each in made if each.reason})
    text = f"{fault.message}: {reasons[0] if reasons else otherwise}"
    if any(each.outcome in FAILURES for each in made):
        return SolveError(f"{fault.path}: {text}", time=0.0, result=table)
    return NothingFoundError(Fault.at(fault.path, text), table)
