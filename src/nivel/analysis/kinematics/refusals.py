"""Machines without kinematic analysis: those with motions that nothing drives, with bodies that bend, with states beside the motion."""

from __future__ import annotations

import numpy as np

from nivel.analysis.assembly.equations import equations
from nivel.analysis.assembly.freedoms import coordinate_derivatives, freedoms
from nivel.analysis.plan.nonholonomic_refusals import refuse_rolling
from nivel.analysis.preparation.preparation import Prepared
from nivel.errors import Fault, ModelError
from nivel.machine.machine_record import MachineRecord
from nivel.system.beams.nodes import with_nodes


def refuse_what_bends(machine: MachineRecord) -> None:
    """Raises ModelError for bodies whose form, wheels whose way, and states whose values drivers do not determine."""
    refuse_rolling(machine, "use `nivel run`")
    faults = [
        Fault(
            "",
            0,
            0,
            f"bodies.{body.name}.flexible",
            "drivers alone do not determine the motion of a flexible body: use `nivel run`",
        )
        for body in machine.bodies
        if body.flexible is not None
    ]
    faults += [
        Fault("", 0, 0, f"beams.{beam.name}", "drivers alone do not determine the motion of a beam: use `nivel run`")
        for beam in machine.beams
    ]
    faults += [
        Fault(
            "",
            0,
            0,
            f"states.{state.name}",
            "a state has a history, which kinematics does not compute: use `nivel run`",
        )
        for state in machine.states
    ]
    if faults:
        raise ModelError(faults)


def refuse_free_motions(machine: MachineRecord, prepared: Prepared) -> None:
    """Raises ModelError where motions are not driven, naming coordinates to drive; or are driven twice."""
    redundancy = prepared.redundancy
    driven = [name for name in redundancy.redundant_rows if name.endswith(".driver")]
    if driven:
        names = ", ".join(name.removesuffix(".driver") for name in driven)
        message = f"the drivers prescribe more motions than there are degrees of freedom: {names} follows from the others; leave "
        "one out"
        raise ModelError(Fault("", 0, 0, "drivers", message))
    count = redundancy.degrees_of_freedom
    if count == 0:
        return
    free = free_coordinates(machine, prepared)
    what = f"{count} motion{'s are' if count > 1 else ' is'} not driven"
    how = f"drive {' and '.join(free)}, by `drivers` in the file or `--drive`" if free else "add drivers"
    if free and len(free) < count:
        how += f"; {count - len(free)} of them no joint coordinate measures, e.g. the spin of a rod between two ball joints: hold it"
    raise ModelError(Fault("", 0, 0, "machine", f"{what}, and kinematics needs all of them: {how}; or use `nivel run`"))


def free_coordinates(machine: MachineRecord, prepared: Prepared) -> list[str]:
    """Joint coordinates that can be chosen apart from each other, as many as there are free motions."""
    motion = equations(with_nodes(machine), measured=True)
    system = motion.system
    motion.evaluate(0.0, prepared.assembly.y)
    found = freedoms(motion)
    places = system.record.joints.coordinate.astype(np.int64).tolist()
    if found is None or not places:
        return []
    chosen = found.independent(coordinate_derivatives(motion, places))
    return [system.layout.coordinates["joint_coordinate"][k] for k in chosen]
