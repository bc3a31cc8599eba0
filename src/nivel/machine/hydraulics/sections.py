"""Sections of mobile directional valves in words: a metering spool with its pressure compensator."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any, ClassVar, Literal

from nivel.machine.core.checked import Problem, superfluous
from nivel.machine.core.coefficient import (
    Frequency,
    Leakage,
    NotNegativeDuration,
    PositiveNumber,
    Pressure,
    Volume,
    VolumeFlow,
)
from nivel.machine.core.coefficient import Share as Proportion
from nivel.machine.core.record import entry
from nivel.machine.given import Field, Maybe, OneNumber
from nivel.machine.hydraulics.component import Rated, problem_of_share
from nivel.machine.hydraulics.flow_valves import INNER_VOLUME
from nivel.machine.hydraulics.usual import DIFFERENCE, FLOW, LAG, SPOOL_FREQUENCY, VOLUME
from nivel.machine.hydraulics.valves import VaryingPressure
from nivel.machine.laws.time_function import OneFunction, varying
from nivel.machine.units.quantity import Quantity

NODES_OF = {"none": (), "pre": (".M",), "post": (".M", ".C")}


class Section(Rated):
    """A 4/3 section of a mobile valve: `command` from -1 to 1 meters the flow from P to A, or to B; the other side drains to T.

    pre : a compensator before the spool holds the `margin` over it; with `saturation_share` it holds that share of what the pump gives
    above LS. post : a compensator behind the metering edge brings the pressure there to LS plus `margin`, so that all sections share
    what there is. none : the spool alone.
    """

    needs: ClassVar[tuple[str, ...]] = ("P", "T", "A", "B")
    may: ClassVar[tuple[str, ...]] = ("LS",)
    nodes: ClassVar[tuple[str, ...]] = (".M", ".C")
    loads: ClassVar[bool] = True
    functions: ClassVar[tuple[str, ...]] = ("command", "margin")
    early: ClassVar[tuple[str, ...]] = ("pressure_M", "pressure_C")
    late: ClassVar[tuple[str, ...]] = (
        "position",
        "compensator_position",
        "compensator_flow",
        "flow_PA",
        "flow_PB",
        "flow_PM",
        "flow_MA",
        "flow_MB",
        "flow_CA",
        "flow_CB",
        "flow_AT",
        "flow_BT",
    )

    type: Literal["section"] = "section"
    compensation: Literal["pre", "post", "none"] = Field(default="pre", description="where its compensator is")
    command: Annotated[OneFunction, varying("number")] = Field(description="position asked for")
    flow_B: Maybe[VolumeFlow] = Field(default=None, description="of the edge to B; default `flow`", usual=FLOW)
    return_flow: Maybe[VolumeFlow] = Field(
        default=None, description="of the edges to T, at `pressure_drop`; default: that of the other edges", usual=FLOW
    )
    overlap: Annotated[OneNumber, Quantity("number")] = Field(
        default=0.05, description="share of the stroke before an edge opens"
    )
    rounding: Proportion = Field(default=0.02, description="share of the stroke over which an edge begins to open")
    frequency: Maybe[Frequency] = Field(
        default=None, description="natural frequency of the spool; default: no lag", usual=SPOOL_FREQUENCY
    )
    damping_ratio: PositiveNumber = Field(default=0.8, description="of the spool")
    margin: VaryingPressure = Field(
        default=7e5, description="of pre: held over the spool; of post: above LS; 0 of post with `saturation_share`"
    )
    saturation_share: Maybe[Proportion] = Field(
        default=None, description="of pre, in place of `margin`: share of p_P - p_LS, so that all fall together"
    )
    opening_range: Pressure = Field(
        default=4e5, description="of the compensator, from closed to fully open", usual=DIFFERENCE
    )
    compensator_flow: Maybe[VolumeFlow] = Field(
        default=None, description="of it, fully open, at `pressure_drop`; default twice `flow`", usual=FLOW
    )
    lag: NotNegativeDuration = Field(default=0.01, description="time constant of the compensator; 0: none", usual=LAG)
    leakage: Leakage = Field(default=0.0, description="of each edge")
    inner_volume: Volume = Field(default=INNER_VOLUME, description="between spool and compensator", usual=VOLUME)

    @classmethod
    def nodes_in(cls, data: Any) -> tuple[str, ...]:
        return NODES_OF.get(str(entry(data, "compensation") or "pre"), ())

    @classmethod
    def signals_in(cls, data: Any) -> tuple[str, ...]:
        kind = str(entry(data, "compensation") or "pre")
        of_kind = {
            "none": ("flow_PA", "flow_PB"),
            "pre": ("compensator_position", "compensator_flow", "flow_MA", "flow_MB"),
            "post": ("compensator_position", "compensator_flow", "flow_PM", "flow_CA", "flow_CB"),
        }
        pressures = tuple(f"pressure_{node[1:]}" for node in cls.nodes_in(data))
        return (*pressures, "position", *of_kind.get(kind, ()), "flow_AT", "flow_BT")

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        yield from problem_of_share("command", self.command, -1.0)
        if not 0.0 <= self.overlap < 0.9:
            yield Problem(("overlap",), f"a share of the stroke from 0 to 0.9 was expected, got {self.overlap:g}")
        if self.is_of_gas:
            yield superfluous("sonic_conductance", "is of gases; a section is for liquids")
        if (self.compensation == "none") == ("LS" in self.ports):
            if self.compensation == "none":
                yield superfluous("ports", "LS belongs to a section with a compensator")
            else:
                yield Problem((), "port LS is missing: the compensator reads the load-sensing pressure; write `LS: ls`")
        if self.saturation_share is not None and self.compensation != "pre":
            yield superfluous("saturation_share", "belongs to `compensation: pre`; post shares the flow by itself")
