"""A study: a machine, what varies, how variants are drawn, the analysis that each is, and what is kept of it."""

from collections.abc import Iterator, Mapping
from math import isfinite
from typing import Annotated, Any, ClassVar, Final, Literal, get_args

from pydantic import BeforeValidator

from nivel.machine.core.record import NAME, Checked, Problem
from nivel.machine.given import Field, Maybe
from nivel.machine.settings.values import Count, Names
from nivel.machine.study.parameter import AtTime, FinalValue, Output, Range, Reduced, StudyParameter, Values
from nivel.machine.units.quantity import Duration, Whole, fault
from nivel.methods import Analysis, Drawn, Planned
from nivel.words.wording import shown, unknown_word

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

    starts: Count = Field("number of starts: the machine as it is, then others that are drawn", default=1)
    seed: Whole = Field("seed of the starts", default=0)
    iterations: Count = Field("most iterations of each start", default=100)


class OptimiseSearch(Search):
    """The parameters with the least output. Limits of outputs are kept."""

    output: str = Field("name of the output that is to be least")
    maximise: bool = Field("it is to be largest instead", default=False)
    method: SearchMethod = Field("method of SciPy; CMA-ES of pycma, or TPE of Optuna", default="SLSQP")


class IdentifySearch(Search):
    """The parameters that explain measurements, by least squares."""

    data: str = Field("table (CSV, MAT, Parquet) with a column `time` and columns with names of results")
    deviations: Annotated[Mapping[str, float], BeforeValidator(_positive)] = Field(
        "standard deviation of the noise of each signal, in SI units", default={}, absent="from what is left"
    )


Design = Literal["grid", "rows", Planned, Drawn]
ANALYSES: Final = get_args(Analysis)
DRAWN: Final = get_args(Drawn)  # designs that take `samples`
PLANNED: Final = get_args(Planned)  # designs of levels between bounds
WITH_HISTORIES: Final = ("run", "statics", "kinematics")
SOBOL_INDICES: Final = "sobol-indices"
QUASI_RANDOM: Final = ("sobol", SOBOL_INDICES)  # of which samples are powers of two


def _named(value: Any) -> Any:
    """Names of outputs are names of variables in the dataset."""
    for name in value if isinstance(value, Mapping) else ():
        if not isinstance(name, str) or not NAME.fullmatch(name):
            raise fault(
                f"{shown(name)} is not a name: a name starts with a letter and has letters, digits, `-` and `_`"
            )
    return value


class StudyRecord(Checked):
    """A study of one machine."""

    tagged: ClassVar[Mapping[str, int]] = {"parameters": 2, "outputs": 2}

    name: str = Field("name of the study", default="study", absent="that of its file")
    description: str = Field("what the study is for", default="")
    machine: str = Field("machine file, beside the study file")
    values: Mapping[str, Any] = Field(
        "values of the machine file by path that all variants have", default={}, key="set"
    )
    parameters: Mapping[str, StudyParameter] = Field(
        "what varies, by path in the machine file, such as bodies.crank.mass", default={}
    )
    design: Design = Field(
        "grid: every value with every other; rows: the first of all lists, the second of all; planned with two, three or five "
        "levels between bounds: a fraction of all corners, Box and Behnken's, central composite; or drawn at random, "
        "from a Latin hypercube, from Sobol's sequence, or for Sobol indices",
        default="grid",
    )
    samples: Count | None = Field("number of variants that are drawn; for Sobol indices of base samples", default=None)
    seed: Whole = Field("seed of what is drawn", default=0)
    analysis: Analysis = Field("what is computed of each variant", default="run")
    settings: Mapping[str, Any] = Field(
        "settings of the analysis, as the options of its command, with _ for -", default={}
    )
    outputs: Annotated[Mapping[str, Output], BeforeValidator(_named)] = Field(
        "numbers of each variant, by name", default={}
    )
    save: Names = Field("names of results of which the whole history is kept", default=())
    verify: bool = Field("a second run beside each variant, to estimate its error", default=False)
    optimise: OptimiseSearch | None = Field(
        "the search of `nivel optimise`: for the least output", default=None, absent="none"
    )
    identify: IdentifySearch | None = Field(
        "the search of `nivel identify`: for what explains measurements", default=None, absent="none"
    )
    judge: bool = Field(
        "a trust report of each variant; without it a run costs little more than its steps", default=True
    )
    time_limit: Maybe[Duration] = Field("longest computing time of a variant", default=None, absent="none")

    def problems(self) -> Iterator[Problem]:
        """Designs that do not go with what varies."""
        drawn = self.design in DRAWN
        if drawn and self.samples is None:
            yield Problem(("design",), f"`design: {self.design}` needs the number of variants: write `samples: 128`")
        if not drawn and self.samples is not None:
            yield Problem(("samples",), f"`design: {self.design}` takes all values; write `design: latin-hypercube`")
        if self.design in QUASI_RANDOM and self.samples is not None and self.samples & (self.samples - 1):
            near = 1 << (self.samples - 1).bit_length()
            yield Problem(
                ("samples",), f"Sobol's sequence needs a power of two, got `{self.samples}`; write `samples: {near}`"
            )
        if self.optimise is not None or self.identify is not None:
            yield from self._of_searches()
        elif self.design in PLANNED:
            for path, each in self.parameters.items():
                if not isinstance(each, Values) and not all(isfinite(bound) for bound in each.bounds):
                    yield Problem(
                        ("parameters", path, "type"), f"`design: {self.design}` needs two bounds: write `from` and `to`"
                    )
        elif not drawn:
            yield from self._without_values()
        if self.analysis not in WITH_HISTORIES and self.save:
            yield Problem(("save",), f"`{self.analysis}` has no histories to keep; take numbers with `outputs`")
        if self.analysis not in WITH_HISTORIES and not self.outputs:
            yield Problem(
                ("analysis",), f"`{self.analysis}` needs `outputs`: the numbers that are kept of each variant"
            )
        if not self.judge:
            yield from self._without_report()
        if self.settings.get("arc_length") and (self.save or not self.outputs):
            yield Problem(
                ("settings", "arc_length"), "histories along arcs are not kept, as their times differ; take `outputs`"
            )
        if self.verify and self.analysis not in ("run", "statics"):
            yield Problem(("verify",), f"`{self.analysis}` makes no second run; its trust report has other checks")

    def _of_searches(self) -> Iterator[Problem]:
        """Searches need bounds; limits of time are watched in runs alone."""
        for path, each in self.parameters.items():
            if isinstance(each, Values) or not all(isfinite(bound) for bound in each.bounds):
                message = "a search needs two bounds: write `{type: range, from: …, to: …}`"
                yield Problem(("parameters", path, "type"), message)
        if self.analysis != "run" and self.time_limit is not None:
            yield Problem(("time_limit",), f"searches watch the time of runs, not of `{self.analysis}`: leave it out")
        if self.optimise is not None and self.optimise.output not in self.outputs:
            known = list(self.outputs)
            yield Problem(("optimise", "output"), unknown_word(self.optimise.output, known, "output"))

    def _without_report(self) -> Iterator[Problem]:
        if self.analysis != "run" or self.verify:
            other = "verify: true" if self.verify else f"analysis: {self.analysis}"
            yield Problem(("judge",), f"`judge: false` is for runs that are not verified, and not for `{other}`")
        for name, output in self.outputs.items():
            if not isinstance(output, Reduced | FinalValue | AtTime):
                message = f"`judge: false` keeps no events and no facts of a run, which `{output.type}` needs"
                yield Problem(("outputs", name, "type"), message)

    def _without_values(self) -> Iterator[Problem]:
        counts: dict[str, int] = {}
        for path, each in self.parameters.items():
            if isinstance(each, Values):
                counts[path] = len(each.values)
            elif isinstance(each, Range) and each.count is not None:
                counts[path] = each.count
            elif isinstance(each, Range):
                message = f"`design: {self.design}` needs the number of values: write `count: 5`"
                yield Problem(("parameters", path), message)
            else:
                message = (
                    f"`design: {self.design}` takes values one by one: write `{{type: range, from: …, to: …, count: 5}}`, "
                    "or `design: latin-hypercube` with `samples`"
                )
                yield Problem(("parameters", path, "type"), message)
        if self.design == "rows" and len(set(counts.values())) > 1:
            told = ", ".join(f"{count} of `{path}`" for path, count in counts.items())
            yield Problem(("design",), f"`design: rows` needs lists of one length; there are {told}")
