"""Calls to what only some machines need: families of forces, measured coordinates, friction, sensors.

They are compiled apart, and only when a machine has them; the equations of motion reach them through their address, so they are
the same machine code for every machine. A call costs about a nanosecond.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from nivel.kernels.compile import address, stage
from nivel.kernels.handle import complex_address_type
from nivel.kernels.record import FRICTION, MEASURE, complex_family_signature, family_signature, record_at
from nivel.kernels.status import OK


class Family:
    """A function `(machine, number, t) -> status` that kernels call by its address; on complex numbers it is compiled when first used."""

    def __init__(self, function: Callable[..., Any]) -> None:
        self._function = function
        self._code = address(family_signature)(function)
        self.address = int(self._code.address)
        FAMILIES[self.address] = self

    @property
    def module(self) -> str:
        """Name of the module in which the function is written."""
        return self._function.__module__

    @cached_property
    def complex_address(self) -> int:
        """Address of the function for records whose work is complex."""
        self._complex_code = address(complex_family_signature)(self._function)
        return int(self._complex_code.address)


FAMILIES: dict[int, Family] = {}


def compile_on_complex_numbers(module: Any) -> None:
    """Compile the families of a module for exact derivatives, or load them from the cache."""
    for part in vars(module).values():
        if isinstance(part, Family) and part.module == module.__name__:
            assert part.complex_address


def family(function: Callable[..., Any]) -> Family:
    """Decorator: `function(machine, family, t) -> status` compiled, now and cached, to something with an `address`."""
    return Family(function)


@intrinsic
def call_family(typingctx, address, machine, number, t):
    """Call a function of `family_signature` at `address` (uint64), or one on complex numbers where the machine is."""
    is_complex = machine == complex_address_type
    kind = complex_family_signature if is_complex else family_signature
    signature = types.int64(types.uint64, *kind.args)

    def generate(context, builder, sig, args):
        values = [context.get_value_type(each) for each in kind.args]
        code = ir.FunctionType(context.get_value_type(types.int64), values)
        return builder.call(builder.inttoptr(args[0], code.as_pointer()), args[1:])

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
