"""FMUs as blocks of a control: a unit is called by the addresses of its functions, once a sample.

A unit has the time of the machine. At its first sample it is initialised with the inputs of that time. At each further one it gets the
inputs of then and makes a step from the sample before; its outputs are those at its end.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.arrays import A1, F1, I1, U1
from nivel.kernels.core.handle import reader
from nivel.kernels.record.hook import law
from nivel.kernels.signals.c_function import give_environment_back, keep_environment
from nivel.native.function import caller, leaf
from nivel.native.signature import Signature

# entries of Fmu.address: functions; the instance; memory of inputs, outputs, their references, flags and time of a step; the environment
# of floating-point numbers
(SET, GET, STEP, SETUP, ENTER, LEAVE, INSTANCE, INPUTS, OUTPUTS, INPUT_REFERENCES, OUTPUT_REFERENCES, FLAGS, LAST) = (
    range(13)
)
ENVIRONMENT = 13
ADDRESSES = 16
# entries of Fmu.number
VERSION, PHASE, FAULT, CALLS = 0, 1, 2, 3
NUMBERS = 4
# phases
ABSENT, MADE, RUNNING = 0, 1, 2
# faults: where a function returned a status that is neither of these two, what it gave is no number, or it asks to end the run
NONE, WARNING = 0, 1
OF_START, OF_STEP, OF_VALUES, NO_NUMBER, ENDS = 1, 2, 3, 4, 5
# places of what a law is called with, before the inputs
WHERE, OUTPUT, TIME = 0, 1, 2
FIRST_INPUT = 3


class Fmu(NamedTuple):
    """A unit in numbers."""

    address: A1  # (ADDRESSES,)
    number: I1  # (NUMBERS,) version of FMI; ABSENT, MADE or RUNNING; what went wrong; calls so far
    time: F1  # (1,) [s] that it has reached
    inputs: F1
    outputs: F1
    input_references: U1
    output_references: U1
    flags: U1  # (3,) event, end and early return, a byte each
    last: F1  # (1,) [s]


def unloaded(version: int, inputs: Sequence[int], outputs: Sequence[int]) -> Fmu:
    """The record of an FMU that is not loaded. inputs, outputs : references of its variables."""
    record = Fmu(
        address=np.zeros(ADDRESSES, dtype=np.uint64),
        number=np.zeros(NUMBERS, dtype=np.int64),
        time=np.full(1, -np.inf),
        inputs=np.zeros(len(inputs)),
        outputs=np.full(len(outputs), np.nan),
        input_references=np.array(inputs, dtype=np.uint32),
        output_references=np.array(outputs, dtype=np.uint32),
        flags=np.zeros(3, dtype=np.uint32),
        last=np.zeros(1),
    )
    record.number[VERSION] = version
    return record


fmu_at = reader(Fmu)
# of FMI 3.0 and 2.0; truths are passed as whole numbers, and of a result only the lower half is a status
call_values_3 = caller(Signature("status", ("entry", "entry", "count", "entry", "count")))
call_values_2 = caller(Signature("status", ("entry", "entry", "count", "entry")))
call_step_3 = caller(Signature("status", ("entry", "number", "number", "count", "entry", "entry", "entry", "entry")))
call_step_2 = caller(Signature("status", ("entry", "number", "number", "count")))
call_setup = caller(Signature("status", ("entry", "count", "number", "number", "count", "number")))
call_mode = caller(Signature("status", ("entry",)))


@leaf
def failed(status):
    """Whether a function of a unit reports more than a warning."""
    return (status & 0xFFFFFFFF) > WARNING


@leaf
def transfer(fmu, function, references, values, count):
    """Let the unit read its inputs or write its outputs. Whether that fails."""
    address = fmu.address
    if count == 0:
        return False
    if fmu.number[VERSION] == 2:
        return failed(call_values_2(address[function], address[INSTANCE], address[references], count, address[values]))
    return failed(
        call_values_3(address[function], address[INSTANCE], address[references], count, address[values], count)
    )


@leaf
def initialise(fmu, t):
    """Initialise the unit at the time t [s]. What went wrong, or NONE."""
    address = fmu.address
    if fmu.number[VERSION] == 2:
        status = call_setup(address[SETUP], address[INSTANCE], 0, 0.0, t, 0, 0.0)
        if not failed(status):
            status = call_mode(address[ENTER], address[INSTANCE])
    else:
        status = call_setup(address[SETUP], address[INSTANCE], 0, 0.0, t, 0, 0.0)
    if failed(status):
        return OF_START
    if transfer(fmu, SET, INPUT_REFERENCES, INPUTS, fmu.inputs.shape[0]):
        return OF_VALUES
    return OF_START if failed(call_mode(address[LEAVE], address[INSTANCE])) else NONE


@leaf
def take_step(fmu, t):
    """Let the unit go on to the time t [s]. What went wrong, or NONE."""
    address, begin = fmu.address, fmu.time[0]
    if transfer(fmu, SET, INPUT_REFERENCES, INPUTS, fmu.inputs.shape[0]):
        return OF_VALUES
    if fmu.number[VERSION] == 2:
        return OF_STEP if failed(call_step_2(address[STEP], address[INSTANCE], begin, t - begin, 1)) else NONE
    flag = address[FLAGS]
    fmu.flags[:] = 0
    status = call_step_3(
        address[STEP],
        address[INSTANCE],
        begin,
        t - begin,
        1,
        flag,
        flag + np.uint64(4),
        flag + np.uint64(8),
        address[LAST],
    )
    if failed(status):
        return OF_STEP
    return ENDS if (fmu.flags[1] & np.uint32(255)) != 0 else NONE


@leaf
def go_on(fmu, t):
    """Bring the unit to the time t [s], with its outputs. What went wrong, or NONE."""
    if fmu.number[PHASE] == ABSENT:
        return OF_START
    if fmu.number[PHASE] == MADE:
        fault = initialise(fmu, t)
        fmu.number[PHASE] = RUNNING
    else:
        fault = take_step(fmu, t)
    fmu.time[0] = t
    fmu.number[CALLS] += 1
    if fault == NONE and transfer(fmu, GET, OUTPUT_REFERENCES, OUTPUTS, fmu.outputs.shape[0]):
        fault = OF_VALUES
    if fault == NONE:
        for k in range(fmu.outputs.shape[0]):
            if not np.abs(fmu.outputs[k]) < np.inf:
                fault = NO_NUMBER
    return fault


@law
def output(row):
    """An output of the unit whose record stands at row[WHERE], at row[TIME]; of a unit that has failed it is no number."""
    fmu = fmu_at(np.uint64(real(row[WHERE])))
    t = real(row[TIME])
    if fmu.number[FAULT] == NONE and (fmu.number[PHASE] != RUNNING or t > fmu.time[0]):
        for k in range(fmu.inputs.shape[0]):
            fmu.inputs[k] = real(row[FIRST_INPUT + k])
        keep_environment(fmu.address, ENVIRONMENT)
        fmu.number[FAULT] = go_on(fmu, t)
        give_environment_back(fmu.address, ENVIRONMENT)
    value = fmu.outputs[np.int64(real(row[OUTPUT]))] if fmu.number[FAULT] == NONE else np.nan
    return value + 0.0 * row[OUTPUT]
