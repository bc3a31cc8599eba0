"""`nivel.integrate.rosenbrock.circuit_euler` for machines with flexible bodies, whose modes are stiff too.

J is that of `nivel.motion.circuit_shift` with the modes of `nivel.motion.modal_shift`, whose factors are those of the state at which each
part begins.
"""

from __future__ import annotations

from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop.run import STEP_SIGNATURE
from nivel.integrate.rosenbrock.circuit_euler import BEGIN, attempt_over_circuits
from nivel.integrate.rosenbrock.parts import step_in_parts
from nivel.kernels.core.status import OK
from nivel.kernels.record.record import record_at
from nivel.motion.circuit_shift import factorise_circuit, soften
from nivel.motion.compliance import apply_compliance
from nivel.motion.flexible_compliance import project_flexible, respond_flexible
from nivel.motion.modal_shift import factorise_shifted_modes, solve_shifted_modes
from nivel.native.entry import entry
from nivel.native.function import part, stage


@part
def prepare_flexible(machine, number, s):
    """Factors `number` for s, and those of the tree. Returns a status."""
    status = factorise_shifted_modes(machine, s)
    if status == OK:
        status = apply_compliance(machine, project_flexible, respond_flexible)
    if status != OK:
        return status
    soften(record_at(machine).circuit.tangent)
    return factorise_circuit(machine, number, s)


@stage
def leave_modes(machine, y, f, s, other):
    """k of the modes and joints without circuits. Returns a status."""
    for i in range(f.shape[0]):
        other[i] = f[i]
    return solve_shifted_modes(machine, y, other, s)


@stage
def attempt_flexible(evaluate, machine, history):
    """`attempt_over_circuits` of flexible bodies."""
    return attempt_over_circuits(evaluate, machine, history, prepare_flexible, factorise_shifted_modes, leave_modes)


@entry(STEP_SIGNATURE)
def flexible_circuit_euler(evaluate, machine, history):
    """One step."""
    return step_in_parts(evaluate, machine, history, attempt_flexible, BEGIN)


FACTS = (
    IntegratorFacts(
        "extrapolated-euler",
        flexible_circuit_euler,
        order=2,
        stages=BEGIN + 1,
        kind="implicit",
        needs="circuits",
        machines="flexible circuits",
        guarded=True,
    ),
)
