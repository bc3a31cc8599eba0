"""The task that all variants of a study share, and the number that is kept of each for an output."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from nivel.analysis.plan.settings import with_usual_frames
from nivel.lazy import dataclass, field
from nivel.machine.study import Output, PythonOutput
from nivel.model import Model
from nivel.results.result import Result


@dataclass(frozen=True)
class Task:
    """What is done with a machine. analysis : run, statics, kinematics, linearise, inverse. settings : of the analysis; of a run none, as
    the machine has them.

    outputs : numbers of each variant. save : names of results whose history is kept; none where there are outputs, else all joint
    coordinates and sensors, or where there are none the positions of the bodies. time_limit [s] : of the computation.
    judge : each variant has a trust report. sample : values by path of some of many variants, with the bounds of all; runs are patched
    where their numbers follow from them by formulas.
    """

    machine: Model
    analysis: str = "run"
    settings: Mapping[str, Any] = field(default_factory=dict)
    outputs: Mapping[str, Output] = field(default_factory=dict)
    save: tuple[str, ...] = ()
    verify: bool = False
    time_limit: float | None = None
    judge: bool = True
    sample: tuple[Mapping[str, Any], ...] = ()

    def __post_init__(self) -> None:
        """Numbers alone are made from as many frames as usual, whatever the machine asks for."""
        if self.analysis == "run" and not self.save and only_numbers(self.outputs):
            object.__setattr__(self, "machine", with_usual_frames(self.machine))


def only_numbers(outputs: Mapping[str, Output]) -> bool:
    """Whether there are outputs, of which none is a function of the user, which sees frames."""
    return bool(outputs) and not any(isinstance(each, PythonOutput) for each in outputs.values())


def usual_names(result: Result) -> tuple[str, ...]:
    """Joint coordinates and sensors, or the positions of the bodies; of a circuit alone its pressures."""
    sensors = tuple(name for name in result.variables if name.startswith("sensor."))
    names = (*result.coordinates.get("joint_coordinate_name", ()), *sensors)
    return names or (("position",) if "position" in result.variables else pressures(result))


def pressures(result: Result) -> tuple[str, ...]:
    """Names of the pressures of a circuit."""
    return tuple(name for name in result.variables if name.startswith("hydraulics.") and name.endswith(".pressure"))
