"""C functions as blocks of a control: called by their addresses, once a sample.

A function gets the time, the inputs of then and the state that the sample before has left, and writes the state and the outputs.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.arrays import A1, F1, I1
from nivel.kernels.core.handle import reader
from nivel.kernels.record.hook import law
from nivel.native.function import caller, leaf
from nivel.native.signature import Signature

# entries of CFunction.address: the function; memory of inputs, state and outputs; `fegetenv`, `fesetenv` and memory of what they keep
FUNCTION, INPUTS, STATE, OUTPUTS, ENVIRONMENT = range(5)
ADDRESSES = 7
# entries of CFunction.number
FAULT, STATUS, CALLS = 0, 1, 2
NUMBERS = 3
# faults
NONE, RETURNED, NO_NUMBER, ABSENT = 0, 1, 2, 3
# places of what a law is called with, before the inputs
WHERE, OUTPUT, TIME = 0, 1, 2
FIRST_INPUT = 3


class CFunction(NamedTuple):
    """A function in numbers."""

    address: A1  # (ADDRESSES,)
    number: I1  # (NUMBERS,) what went wrong, what it returned, calls so far
    time: F1  # (1,) [s] of the last call
    inputs: F1
    state: F1
    outputs: F1


c_function_at = reader(CFunction)
call_function = caller(Signature("status", ("number", "entry", "entry", "entry")))
call_environment = caller(Signature("status", ("entry",)))


@leaf
def keep_environment(address, at):
    """Keep how floating-point numbers are rounded and flushed to zero, which foreign code may change. at : of `fegetenv` in `address`."""
    if address[at] != 0:
        call_environment(address[at], address[at + 2])


@leaf
def give_environment_back(address, at):
    """As it was kept."""
    if address[at] != 0:
        call_environment(address[at + 1], address[at + 2])


@leaf
def call(unit, t):
    """Call the function at the time t [s]. What went wrong, or NONE."""
    address = unit.address
    if address[FUNCTION] == 0:
        return ABSENT
    unit.time[0] = t
    unit.number[CALLS] += 1
    keep_environment(address, ENVIRONMENT)
    status = call_function(address[FUNCTION], t, address[INPUTS], address[STATE], address[OUTPUTS]) & 0xFFFFFFFF
    give_environment_back(address, ENVIRONMENT)
    unit.number[STATUS] = status
    if status != 0:
        return RETURNED
    for k in range(unit.outputs.shape[0]):
        if not np.abs(unit.outputs[k]) < np.inf:
            return NO_NUMBER
    return NONE


@law
def output(row):
    """An output of the function whose record stands at row[WHERE], at row[TIME]; of one that has failed it is no number."""
    unit = c_function_at(np.uint64(real(row[WHERE])))
    t = real(row[TIME])
    if unit.number[FAULT] == NONE and t > unit.time[0]:
        for k in range(unit.inputs.shape[0]):
            unit.inputs[k] = real(row[FIRST_INPUT + k])
        unit.number[FAULT] = call(unit, t)
    value = unit.outputs[np.int64(real(row[OUTPUT]))] if unit.number[FAULT] == NONE else np.nan
    return value + 0.0 * row[OUTPUT]
