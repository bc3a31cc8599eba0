"""A study in words: a machine, what varies, how variants are drawn, which analysis each is, and what is kept of it."""

from nivel.machine.study.output import (
    AtEvent,
    AtTime,
    EventTime,
    FinalValue,
    Output,
    PythonOutput,
    Reduced,
    ScalarOutput,
)
from nivel.machine.study.parameter import Normal, Range, StudyParameter, Tolerance, Triangular, Uniform, Values
from nivel.machine.study.study_record import ANALYSES, DRAWN, PLANNED, SOBOL_INDICES, StudyRecord

__all__ = [
    "ANALYSES",
    "DRAWN",
    "PLANNED",
    "SOBOL_INDICES",
    "AtEvent",
    "AtTime",
    "EventTime",
    "FinalValue",
    "Normal",
    "Output",
    "PythonOutput",
    "Range",
    "Reduced",
    "ScalarOutput",
    "StudyParameter",
    "StudyRecord",
    "Tolerance",
    "Triangular",
    "Uniform",
    "Values",
]
