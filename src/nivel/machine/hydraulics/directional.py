"""Directional valves in words."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any, ClassVar, Final, Literal

from pydantic import AfterValidator

from nivel.machine.core.checked import Problem, superfluous
from nivel.machine.core.coefficient import Frequency, Leakage, PositiveNumber, Share
from nivel.machine.core.record import entry
from nivel.machine.given import Field, Maybe, OneNumber, OneRecord
from nivel.machine.hydraulics.component import Rated, problem_of_share
from nivel.machine.hydraulics.switching import Switching
from nivel.machine.hydraulics.usual import SPOOL_FREQUENCY
from nivel.machine.laws.time_function import OneFunction, varying
from nivel.machine.units.quantity import Quantity, Rate, fault

Ways = Literal["2/2", "3/2", "4/2", "4/3", "5/2", "5/3"]
Centre = Literal["closed", "tandem", "open", "float"]
PORTS: Final[dict[str, tuple[str, ...]]] = {
    "2/2": ("P", "A"),
    "3/2": ("P", "T", "A"),
    "4/2": ("P", "T", "A", "B"),
    "4/3": ("P", "T", "A", "B"),
    "5/2": ("P", "A", "B", "R", "S"),
    "5/3": ("P", "A", "B", "R", "S"),
}
# valves with a centre, whose positions go from -1 to 1
CENTRED: Final = ("4/3", "5/3")
# edges that open with a position from 0 to 1 (of centred valves), with one from 0 to -1 (of others: that close towards 1)
EDGES: Final[dict[str, tuple[tuple[str, ...], tuple[str, ...]]]] = {
    "2/2": (("PA",), ()),
    "3/2": (("PA",), ("AT",)),
    "4/2": (("PA", "BT"), ("PB", "AT")),
    "4/3": (("PA", "BT"), ("PB", "AT")),
    "5/2": (("PA", "BS"), ("PB", "AR")),
    "5/3": (("PA", "BS"), ("PB", "AR")),
}
CENTRES: Final[dict[str, tuple[str, ...]]] = {
    "closed": (),
    "tandem": ("PT",),
    "open": ("PT", "AT", "BT"),
    "float": ("AT", "BT"),
}
OF_FIVE: Final = {"AT": "AR", "BT": "BS"}  # outlets of A and B in valves with five ports


def centre_pairs(ways: str, centre: str) -> tuple[str, ...]:
    """Pairs of ports that are joined at the centre."""
    pairs = CENTRES.get(centre, ())
    return tuple(OF_FIVE.get(pair, pair) for pair in pairs) if ways == "5/3" else pairs


def _overlap(value: float) -> float:
    if not -0.5 < value < 0.9:
        raise fault(f"a share of the stroke from -0.5 (underlap) to 0.9 (overlap) was expected, got {value:g}")
    return value


class DirectionalValve(Rated):
    """A spool that joins P and T with A and B; with five ways R is the outlet of A, S that of B. `command` is its position: -1 to 1 of
    valves with a centre, 4/3 and 5/3, 0 to 1 of others.

    `flow` at `pressure_drop` is that of one edge at a full stroke; a sheet that states a drop over the whole valve means two edges.
    """

    functions: ClassVar[tuple[str, ...]] = ("command",)
    gases: ClassVar[bool] = True
    loads: ClassVar[bool] = True
    early: ClassVar[tuple[str, ...]] = ()
    late: ClassVar[tuple[str, ...]] = ("position", "flow_PA", "flow_PB", "flow_AT", "flow_BT", "flow_AR", "flow_BS")

    type: Literal["directional-valve"] = "directional-valve"
    ways: Ways = Field(description="ports and positions: 2/2, 3/2, 4/2, 4/3, 5/2 or 5/3")
    command: Annotated[OneFunction, varying("number")] = Field(description="position asked for")
    overlap: Annotated[OneNumber, Quantity("number"), AfterValidator(_overlap)] = Field(
        default=0.0, description="share of the stroke before an edge opens; negative: edges are open at the centre"
    )
    rounding: Share = Field(default=0.02, description="share of the stroke over which an edge begins to open")
    centre: Centre = Field(default="closed", description="what is joined at the centre of a 4/3 or 5/3 valve")
    frequency: Maybe[Frequency] = Field(
        default=None, description="natural frequency of the spool; default: no lag", usual=SPOOL_FREQUENCY
    )
    damping_ratio: PositiveNumber = Field(default=0.8, description="of the spool")
    rate_limit: Maybe[Rate] = Field(default=None, description="greatest speed of the spool, full strokes per second")
    leakage: Leakage = Field(default=0.0, description="of each edge")
    switching: Maybe[OneRecord[Switching]] = Field(
        default=None, description="whether it is on or off alone, with its delays; `command` then counts above one half"
    )

    @classmethod
    def signals_in(cls, data: Any) -> tuple[str, ...]:
        ways, centre = str(entry(data, "ways")), str(entry(data, "centre") or "closed")
        pairs = [edge for edges in EDGES.get(ways, ()) for edge in edges]
        pairs += [edge for edge in centre_pairs(ways, centre) if edge not in pairs]
        return ("position", *(f"flow_{pair}" for pair in pairs))

    @property
    def edges(self) -> tuple[str, ...]:
        """All edges, as pairs of ports."""
        return (*EDGES[self.ways][0], *EDGES[self.ways][1])

    def problems(self) -> Iterator[Problem]:
        yield from self.problems_of_ports(PORTS[self.ways])
        yield from self.problems_of_rating()
        yield from problem_of_share("command", self.command, -1.0 if self.ways in CENTRED else 0.0)
        if self.centre != "closed" and self.ways not in CENTRED:
            yield superfluous("centre", f"belongs to a 4/3 or 5/3 valve, not to {self.ways}")
        if self.ways == "5/3" and self.centre in ("tandem", "open"):
            yield Problem(("centre",), f"a 5/3 valve has the centre `closed` or `float`, got `{self.centre}`")
        if self.overlap + self.rounding > 1.0:
            yield Problem(
                ("rounding",), "an edge would not open within the stroke: overlap and rounding are more than 1"
            )
        if self.switching is not None and self.frequency is not None:
            yield superfluous("frequency", "belongs to a proportional valve; `switching` states how this one moves")
        if self.rate_limit is not None and self.frequency is None:
            yield Problem((), "`frequency` is missing: a spool with a `rate_limit` follows its command with it")
