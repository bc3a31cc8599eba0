"""Comparison of runs of one machine with many methods."""

import csv
import io
import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Final, Literal, NamedTuple

from nivel.errors import ModelError
from nivel.files.target import write_page, write_text
from nivel.lazy import Struct, asdict, field, fields, provided, replace
from nivel.results.comparison_table import as_html, as_text
from nivel.results.trust import Trust, storable
from nivel.words.arguments import checked_methods

if TYPE_CHECKING:
    from collections.abc import Iterable

CellOutcome = Literal["done", "failed", "refused"]
UNITS: Final = {
    "step": "s",
    "loop_seconds": "s",
    "seconds_per_step": "s",
    "constraint_rate_error": "1/s",
    "constraint_rate_error_mean": "1/s",
    "energy_error": "J",
    "motion_error_time": "s",
}
RESOLVED: Final = 3.0  # a motion error below this many times that of its reference says nothing more


class Method(NamedTuple):
    """The words of one combination, all but the step."""

    integrator: str
    formulation: str
    coordinates: str
    rotations: str
    stabilisation: str


class Row(Struct):
    """One cell of the grid. What a cell has not, because it was refused or stopped, is None.

    step [s] : of integrators with a fixed one; tolerance : of the others. reason : why it was refused, or what stopped it.
    end_time [s] : of its last frame; stopped_by : the event that ended the run there, before its duration was over, "" where none did.
    loop_seconds, seconds_per_step : process time in the compiled loop, the least of the repeats, frames included.
    constraint_error, _mean : largest and mean magnitude over frames and rows, lengths divided by the machine's size.
    constraint_rate_error, _mean [1/s] : the same of their rates. energy_error [J] : largest; energy_error_relative : divided by the
    largest kinetic energy, None of a machine at rest. motion_error : distance from the reference, see `nivel.results.motion`; its
    body
    and time [s].
    reference : the name of the reference it was held against; order : slope of the error from the next larger step to this one.
    """

    integrator: str
    formulation: str
    coordinates: str
    rotations: str
    stabilisation: str
    step: float | None = None
    tolerance: float | None = None
    outcome: CellOutcome = "done"
    reason: str = ""
    end_time: float | None = None
    stopped_by: str = ""
    loop_seconds: float | None = None
    seconds_per_step: float | None = None
    steps: int | None = None
    rejected: int | None = None
    evaluations: int | None = None
    iterations: int | None = None
    constraint_error: float | None = None
    constraint_error_mean: float | None = None
    constraint_rate_error: float | None = None
    constraint_rate_error_mean: float | None = None
    energy_error: float | None = None
    energy_error_relative: float | None = None
    motion_error: float | None = None
    motion_error_body: str = ""
    motion_error_time: float | None = None
    reference: str = ""
    order: float | None = None

    @property
    def method(self) -> Method:
        """Its words without the step."""
        return Method(self.integrator, self.formulation, self.coordinates, self.rotations, self.stabilisation)

    @property
    def fineness(self) -> float:
        """The step or the tolerance: the smaller, the finer."""
        return self.step if self.step is not None else self.tolerance or 0.0


class Reference(Struct):
    """A solution that others are held against. error : its own, estimated as `how` says, in the measure of motion errors. blind : why that
    estimate, and other methods too, may miss something, in words."""

    name: str
    integrator: str
    error: float
    how: str
    blind: str = ""


class Spread(Struct):
    """The two methods that are furthest apart, each at its finest step: labels, and their distance.

    methods : how many were looked at. left_out : completed methods that were not, because their own two finest runs are more than
    CONVERGED apart.
    """

    distance: float
    first: str
    second: str
    methods: int
    left_out: int = 0


@checked_methods
class Comparison(Struct):
    """A grid of runs of one machine.

    rows : a Row for every cell. references : what the motions were held against, none where nothing could be computed (`note` says
    why). spread : how far the methods agree, None for less than two. size : of the machine [m]; kinetic_energy : its largest [J].
    duration, output_interval [s]. outcome : done, or interrupted: then some cells are missing. trust : the trust report: whether errors of
    motions are known.
    """

    machine: str
    duration: float
    output_interval: float
    repeat: int
    rows: tuple[Row, ...]
    references: tuple[Reference, ...]
    spread: Spread | None
    size: float
    kinetic_energy: float
    outcome: str = "done"
    note: str = ""
    nivel_version: str = ""
    trust: Trust = field(default_factory=lambda: Trust("green", "done"))

    @property
    def completed(self) -> tuple[Row, ...]:
        """The rows that ran to their end, or to an event that ended them."""
        return tuple(row for row in self.rows if row.outcome == "done")

    @property
    def stopped(self) -> tuple[Row, ...]:
        """The completed rows that an event ended."""
        return tuple(row for row in self.completed if row.stopped_by)

    @property
    def varying(self) -> tuple[str, ...]:
        """The axes of the grid on which there are several words."""
        return tuple(name for name in Method._fields if len({getattr(row, name) for row in self.rows}) > 1)

    @property
    def common(self) -> tuple[str, ...]:
        """The words that all cells share; rotation coordinates only where there are some to choose."""
        if not self.rows:
            return ()
        method = self.rows[0].method
        return tuple(
            word
            for name, word in method._asdict().items()
            if name not in self.varying and (name != "rotations" or method.formulation == "lagrange")
        )

    def label(self, row: Row) -> str:
        """The words of a row that tell it from others, without the step."""
        return method_label(row.method, self.varying)

    def reference_of(self, row: Row) -> Reference | None:
        """What the motion of a row was held against."""
        return next((each for each in self.references if each.name == row.reference), None)

    def is_resolved(self, row: Row) -> bool:
        """Whether the motion error of a row is clearly above the error of its reference."""
        reference = self.reference_of(row)
        return reference is not None and row.motion_error is not None and row.motion_error > RESOLVED * reference.error

    def curves(self) -> dict[Method, list[Row]]:
        """The completed rows of every method, from coarse to fine."""
        out: dict[Method, list[Row]] = {}
        for row in self.completed:
            out.setdefault(row.method, []).append(row)
        return {method: sorted(rows, key=lambda row: -row.fineness) for method, rows in out.items()}

    def to_csv(self, path: str | os.PathLike[str] | None = None, *, force: bool = False) -> str:
        """A table with a header (`step [s]`) and a line for every row; written to `path` where one is given. force : replace an existing
        file. Numbers are as short as they can be read back exactly, nothing where there is none."""
        names = [each.name for each in fields(Row)]
        file = io.StringIO()
        table = csv.writer(file, lineterminator="\n")
        table.writerow([f"{name} [{UNITS[name]}]" if name in UNITS else name for name in names])
        table.writerows([getattr(row, name) for name in names] for row in self.rows)
        return write_text(file.getvalue(), path, "table", force=force)

    def to_json(self, path: str | os.PathLike[str] | None = None, *, force: bool = False) -> str:
        """Everything as JSON, null for what is not a number; written to `path` where one is given. force : replace an existing file."""
        data = asdict(replace(self, trust=None)) | {"trust": json.loads(self.trust.to_json())}
        text = json.dumps(storable(data, lambda _: None), indent=2, ensure_ascii=False) + "\n"
        return write_text(text, path, "comparison", force=force)

    @classmethod
    def from_json(cls, text: str) -> "Comparison":
        """The comparison that `to_json` wrote. Raises ModelError where `text` is none."""
        try:
            data = json.loads(text)
            return cls(
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

    def report(self, path: str | os.PathLike[str], *, force: bool = False) -> Path:
        """Write a page with the table and a work–precision diagram, one HTML file that needs no network.

        force : replace an existing file.
        """
        return write_page(provided("comparison")(self), path, force=force)

    def __str__(self) -> str:
        return as_text(self)

    def _repr_html_(self) -> str:
        return as_html(self)


def method_label(method: Method, varying: "Iterable[str]") -> str:
    """The words of `method` on the axes `varying`; its integrator where there are none."""
    names = tuple(varying) or ("integrator",)
    words = [getattr(method, name) for name in names]
    # rotation coordinates are told only where there is a choice of them
    return " · ".join(
        word for name, word in zip(names, words, strict=True) if name != "rotations" or method.formulation == "lagrange"
    )
