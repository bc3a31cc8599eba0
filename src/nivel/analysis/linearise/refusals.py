"""Machines without linear equations: friction that may stick, code of other programs, states that events sample."""

from __future__ import annotations

from collections.abc import Collection

from nivel.errors import Fault, ModelError
from nivel.machine.control.order import PartOf, parts_of
from nivel.machine.control.unit import UnitBlock
from nivel.machine.forces import Contact, Friction, TransmissionLoss, holds_by_capacity
from nivel.machine.laws.symbols import find_in, follows_control, is_output
from nivel.machine.machine_record import MachineRecord

MOST = 1500  # velocities of full matrices


def refuse_jumps(machine: MachineRecord, sliding: Collection[str] = (), *, may_slide: bool = False) -> None:
    """Raises ModelError with all forces and states whose effect is no smooth function of the state. sliding : names of forces that slide at
    the state, as all that have a place for it `may_slide`."""
    faults = [
        Fault(
            "",
            0,
            0,
            f"forces.{force.name}.model",
            f"'{force.model}' friction has no derivative where it sticks: leave it out, use a damper in the joint, or use `lugre`",
        )
        for force in machine.forces
        if isinstance(force, Friction) and force.model == "stiction" and force.name not in sliding and not may_slide
    ]
    faults += [
        Fault(
            "",
            0,
            0,
            f"forces.{force.name}",
            f"a {force.type} has no derivative where it holds: couple what it holds, or leave it out",
        )
        for force in machine.forces
        if holds_by_capacity(force)
        and force.name not in sliding
        and not (may_slide and not isinstance(force, TransmissionLoss))
    ]
    faults += [
        Fault(
            "",
            0,
            0,
            f"forces.{force.name}.friction",
            "friction of a contact that sticks has no derivative: give a `friction_transition_speed`, as in "
            "`friction_transition_speed: 1 cm/s`, and linear equations have the smooth law of this speed; or leave the friction out",
        )
        for force in machine.forces
        if isinstance(force, Contact) and force.sticks and force.friction_transition_speed is None
    ]
    faults += [
        Fault(
            "",
            0,
            0,
            f"states.{state.name}.event",
            "a state that an event samples jumps at no given times, so that it has no linear equations: write it as a `rate`, or sample it "
            "with `every`",
        )
        for state in machine.states
        if state.event is not None
    ]
    faults += [
        Fault(
            "",
            0,
            0,
            f"control.{block.name}.type",
            "code of another program has no derivative: leave out the block to open the loop, or write it with blocks of `control`",
        )
        for block in machine.control
        if isinstance(block, UnitBlock)
    ]
    faults += [
        Fault(
            "",
            0,
            0,
            f"control.{each.block.name}{f'.{each.part.key}' if each.part.key else ''}",
            "a sample of what forces or flows report has no derivative here: read a pressure, a place or a speed, or leave out the block",
        )
        for each in parts_of(machine.control)
        if each.part.role in ("sample", "memory") and _reads_reports(each, machine)
    ]
    if faults:
        raise ModelError(faults)


def _reads_reports(each: PartOf, machine: MachineRecord) -> bool:
    """Whether a part reads what is known only when all forces and flows are."""
    own = {other.path for other in parts_of(machine.control)}
    symbols = [find_in(path, machine.index) for path in each.signals if path not in own]
    return any(is_output(symbol, machine.index) or follows_control(symbol, machine.index) for symbol in symbols)


def refuse_samples(machine: MachineRecord) -> None:
    """Raises ModelError with all states and blocks that are sampled, for what knows motions in continuous time alone."""
    faults = [
        Fault(
            "",
            0,
            0,
            f"states.{state.name}.update",
            "a sampled state changes in jumps, which linear equations in continuous time cannot describe: write it as a `rate`",
        )
        for state in machine.states
        if state.update is not None
    ]
    faults += [
        Fault(
            "",
            0,
            0,
            f"control.{block.name}.sample_time",
            "a sampled block changes in jumps, which linear equations in continuous time cannot describe: leave out `sample_time` "
            "to make it continuous, or leave out the block to open the loop",
        )
        for block in machine.control
        if block.sample_time is not None
    ]
    if faults:
        raise ModelError(faults)
