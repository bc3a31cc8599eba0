"""The task that all variants of a study share, and the number that is kept of each for an output."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from nivel.machine.study import Output
from nivel.model import Model


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
