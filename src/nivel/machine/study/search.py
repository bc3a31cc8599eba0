"""Searches of a study: for the best values of its parameters, or for those that explain measurements."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Final, Literal, get_args

from pydantic import BeforeValidator

from nivel.machine.core.checked import Checked
from nivel.machine.given import Field
from nivel.machine.settings.values import Count
from nivel.machine.units.quantity import Whole, fault
from nivel.words.wording import shown

SearchMethod = Literal[
    "SLSQP", "trust-constr", "L-BFGS-B", "Nelder-Mead", "COBYLA", "differential-evolution", "CMA-ES", "TPE"
]
SEARCH_METHODS: Final = get_args(SearchMethod)


def _positive(values: Any) -> Any:
    for name, value in values.items() if isinstance(values, Mapping) else ():
        if not isinstance(value, int | float) or isinstance(value, bool) or not value > 0.0:
            raise fault(f"a number above zero was expected for `{name}`, got {shown(value)}")
    return values


class Search(Checked):
    """What searches have in common."""

    starts: Count = Field(default=1, description="number of starts: the machine as it is, then others that are drawn")
    seed: Whole = Field(default=0, description="seed of the starts")
    iterations: Count = Field(default=100, description="most iterations of each start")


class OptimiseSearch(Search):
    """The parameters with the least output. Limits of outputs are kept."""

    output: str = Field(description="name of the output that is to be least")
    maximise: bool = Field(default=False, description="it is to be largest instead")
    method: SearchMethod = Field(default="SLSQP", description="method of SciPy; CMA-ES of pycma, or TPE of Optuna")


class IdentifySearch(Search):
    """The parameters that explain measurements, by least squares."""

    data: str = Field(description="table (CSV, MAT, Parquet) with a column `time` and columns with names of results")
    deviations: Annotated[Mapping[str, float], BeforeValidator(_positive)] = Field(
        default={},
        description="standard deviation of the noise of each signal, in SI units",
        absent="from what is left",
    )
