"""Parts of an evaluation again and again, so that their time can be measured."""

from nivel.kernels.bodies.constraint import constraint_rows
from nivel.kernels.core.status import DONE, OK
from nivel.kernels.record.hook import call_evaluate, call_family, family
from nivel.kernels.record.record import record_at
from nivel.native.entry import entry
from nivel.native.signature import Signature

FAMILY_AGAIN = Signature("status", ("entry", "machine", "count", "number", "count"))
ROWS_AGAIN = Signature("status", ("machine", "count"))
EVALUATE_AGAIN = Signature("status", ("entry", "machine", "number", "vector", "vector", "count"))


@entry(FAMILY_AGAIN)
def repeat_family(family, machine, number, t, times):
    """Call a family of elements so many times. What it adds to is not set back in between."""
    status = OK
    for _ in range(times):
        status = call_family(family, machine, number, t)
    return status


@entry(EVALUATE_AGAIN)
def repeat_evaluation(evaluate, machine, t, y, rate, times):
    """Evaluate the equations of motion at y so many times."""
    status = OK
    for _ in range(times):
        status = call_evaluate(evaluate, machine, t, y, rate)
    return status


@entry(ROWS_AGAIN)
def repeat_rows(machine, times):
    """Fill the rows of the constraints so many times."""
    record = record_at(machine)
    for _ in range(times):
        constraint_rows(record.bodies, record.markers, record.constraints)
    return OK


@family
def halt(machine, number, t):
    """In the place of the first family: the evaluation ends before the forces."""
    return DONE
