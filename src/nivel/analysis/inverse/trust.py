"""Trust report of inverse dynamics: of the efforts, of the motion that they belong to, and of the drivers that it is to follow."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from nivel.judge.after.report import assess
from nivel.judge.after.subject import Actuated
from nivel.machine.joints.driver import Driver
from nivel.results.analyses.efforts import Efforts
from nivel.results.result import Result


def with_trust(efforts: Efforts, drivers: Sequence[Driver], motion: Result, replaced: Sequence[Driver] = ()) -> Efforts:
    """The efforts with their trust report. drivers : of the machine; replaced : those whose motion another one was given in place of."""
    followed = tuple(each for each in drivers if each not in replaced)
    subject = Actuated(outcome="done", result=motion, efforts=efforts, drivers=followed, replaced=tuple(replaced))
    return replace(efforts, trust=assess(subject))
