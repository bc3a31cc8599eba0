"""Calls to what only some machines need: families of forces, measured coordinates, friction, sensors.

They are compiled apart, and only when a machine has them; the equations of motion reach them through their address, so they are
the same machine code for every machine. A call costs about a nanosecond.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from nivel.kernels.compile import address, stage
from nivel.kernels.record import FRICTION, MEASURE, family_signature, record_at
from nivel.kernels.status import OK


def family(function: Callable[..., Any]) -> Any:
    """Decorator: `function(machine, family, t) -> status` compiled, now and cached, to something with an `address`."""
    return address(family_signature)(function)


@intrinsic
def call_family(typingctx, address, machine, number, t):
    """Call a function of `family_signature` at `address` (uint64)."""
    signature = types.int64(types.uint64, types.uint64, types.int64, types.float64)

    def generate(context, builder, sig, args):
        word, double = context.get_value_type(types.int64), context.get_value_type(types.float64)
        kind = ir.FunctionType(word, [word, word, double])
        return builder.call(builder.inttoptr(args[0], kind.as_pointer()), args[1:])

    return signature, generate


# jobs of the hook MEASURE, see `nivel.kernels.measure`
ACTIVE, ACCEPTED, SHOWN = 0, 1, 2


@stage
def call_hook(machine, hook, job, t):
    """Call a hook of the machine where it has one."""
    record = record_at(machine)
    address = record.hooks.address[hook]
    return call_family(address, machine, job, t) if address != 0 else OK  # type: ignore[call-arg]


@stage
def measure_active(machine, t):
    """Measure what constraints, forces and laws need in every evaluation, and fill the rows made of it. Returns a status."""
    record = record_at(machine)
    if record.coordinates.active.shape[0] == 0:
        return OK
    return call_hook(machine, MEASURE, ACTIVE, t)


@stage
def apply_forces(machine, t, y):
    """Let every family of forces add to the wrenches of the bodies, to power and stored energy, and give the rates of its states.

    The states of the forces stand in y before its last two entries.
    """
    record = record_at(machine)
    elements, control = record.elements, record.control
    control.power[0], control.power[1], control.stored[0] = 0.0, 0.0, 0.0
    count = elements.state.shape[0]
    first = y.shape[0] - 2 - count
    for i in range(count):
        elements.state[i] = y[first + i]
    for k in range(elements.address.shape[0]):
        status = call_family(elements.address[k], machine, k, t)  # type: ignore[call-arg]
        if status != OK:
            return status
    return OK


@stage
def finish_forces(machine, t, ydot):
    """After the multipliers are known: friction, the work of drivers, and the rates of the states of forces and energies."""
    record = record_at(machine)
    elements, control, constraints = record.elements, record.control, record.constraints
    status = call_hook(machine, FRICTION, 0, t)
    for k in range(constraints.combination.shape[0]):
        # what holds a coordinate to its motion does the work -λ f'(t)
        control.power[0] -= constraints.lam[constraints.combination[k, 0]] * constraints.motion[k]
    count = elements.state.shape[0]
    first = ydot.shape[0] - 2 - count
    for i in range(count):
        ydot[first + i] = elements.state_rate[i]
    ydot[first + count], ydot[first + count + 1] = control.power[0], control.power[1]
    return status
