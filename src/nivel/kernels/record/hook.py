"""Optional components, called by address: families of forces, measured coordinates, friction, sensors.

They are compiled apart, and only when a machine has them; the equations of motion reach them through their address, so they are
the same machine code for every machine. A call costs about a nanosecond.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import Any

from nivel.kernels.core.status import OK
from nivel.kernels.record.record import CORRECT, EVALUATE, FAMILY, FRICTION, MEASURE, record_at
from nivel.native.entry import Entry
from nivel.native.function import Intrinsic, caller, stage
from nivel.native.signature import LAW, Signature


class Family:
    """A function that kernels call by its address. code, twin, whole, packed : its entries, on real numbers, for records whose
    work is dual numbers, for those of which all numbers are, and for those of which all numbers are packs."""

    def __init__(self, function: Callable[..., Any], signature: Signature) -> None:
        self.py_func, self.module = function, function.__module__
        name = f"{function.__module__}:{function.__qualname__}"
        self.code = Entry(function, signature, f"{name}.code")
        self.twin = Entry(function, signature.on("twin"), f"{name}.twin")
        self.whole = Entry(function, signature.on("whole"), f"{name}.whole")
        self.packed = Entry(function, signature.on("packed"), f"{name}.packed")

    @cached_property
    def address(self) -> int:
        """Address of the function."""
        FAMILIES[self.code.address] = self
        return self.code.address

    @property
    def dual_address(self) -> int:
        """Address of the function for records whose work is dual numbers."""
        return self.twin.address


# those whose addresses are in use
FAMILIES: dict[int, Family] = {}


def family(function: Callable[..., Any]) -> Family:
    """Decorator: `function(machine, family, t) -> status`, a function of the module, as something with an address."""
    return Family(function, FAMILY)


def law(function: Callable[..., Any]) -> Family:
    """Decorator: `function(row) -> value`, a function of a row of numbers, as something with an address."""
    return Family(function, LAW)


call_family: Intrinsic = caller(FAMILY)
call_evaluate: Intrinsic = caller(EVALUATE)
call_correct: Intrinsic = caller(CORRECT)


# jobs of the hook MEASURE, see `nivel.kernels.bodies.measure`
ACTIVE, ACCEPTED, SHOWN = 0, 1, 2


@stage
def call_hook(machine, hook, job, t):
    """Call a hook of the machine where it has one."""
    record = record_at(machine)
    address = record.hooks.address[hook]
    return call_family(address, machine, job, t) if address != 0 else OK


@stage
def measure_active(machine, t):
    """Measure what constraints, forces and laws need in every evaluation, and fill the rows made of it. Returns a status."""
    record = record_at(machine)
    if record.coordinates.active.shape[0] == 0:
        return OK
    return call_hook(machine, MEASURE, ACTIVE, t)


@stage
def apply_forces(machine, t, y):
    """Let every family of elements add to the wrenches of the bodies, to power and stored energy, and to the rates of states.

    The states of elements stand in y before its last two entries.
    """
    record = record_at(machine)
    elements, control = record.elements, record.control
    control.power[0], control.power[1], control.stored[0] = 0.0, 0.0, 0.0
    count = elements.state.shape[0]
    first = y.shape[0] - 2 - count
    for i in range(count):
        elements.state[i] = y[first + i]
        elements.state_rate[i] = 0.0
    for k in range(elements.address.shape[0]):
        status = call_family(elements.address[k], machine, k, t)
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
