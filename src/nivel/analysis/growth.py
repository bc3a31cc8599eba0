"""Motion that has grown without bound: what failed then only shows that the step was too long."""

from __future__ import annotations

from importlib import import_module
from typing import Any

import numpy as np

from nivel.analysis.equations import MotionEquations
from nivel.system.system import Array, System

# Energy that no load gave, as a multiple of that of the start and of the weights at the machine's length; as a share of the work.
GROWN, OF_WORK = 1e3, 0.1


def grown_motion(motion: MotionEquations, time: float, step: float, y: Array) -> tuple[str, str] | None:
    """(message, advice) where the last accepted state y has far more energy than anything gave it, in what is elastic too, and bodies that
    move by more than the length of the machine in a step of fixed size; None where it has not."""
    system, control = motion.system, motion.system.record.control
    motion.evaluate(time, y)
    observe: Any = import_module("nivel.kernels.observe").observe
    observe(motion.handle.address, time, y, np.zeros(system.layout.width))
    kinetic, potential, start = (float(each) for each in control.energy)
    work, dissipated = float(y[-2]), float(y[-1])
    gained = kinetic + potential - start - work + dissipated
    bodies = system.record.bodies
    mass = float(bodies.mass.sum())
    known = max(abs(start), mass * float(np.linalg.norm(bodies.gravity)) * system.size)
    slow = kinetic <= 0.5 * mass * (system.size / step) ** 2
    if slow or control.stored[0] <= GROWN * known or abs(gained) <= max(GROWN * known, OF_WORK * abs(work)):
        return None
    pulls = _strongest(system)
    gain = f"{abs(gained):.2g} J" if np.isfinite(gained) else "more energy than a number can hold,"
    message = (
        f"the motion has grown without bound: the machine has {gain} that no load gave it. A step of {step:.3g} s is too long for its "
        f"fastest vibration{pulls and f', and {pulls} is the force that is largest'}"
    )
    advice = (
        f"Try --step {step / 10:.3g}, or shorter the stiffer the spring or the lighter what it moves; or a method that steps over fast "
        f"vibrations: radau, generalised-alpha, or ros2 with --coordinates relative."
    )
    return message, advice


def _strongest(system: System) -> str:
    """The force with the largest magnitude in the state last evaluated; empty without any."""
    values = np.abs(system.record.outputs.value)
    names = [variable.name for variable in system.layout.variables if len(variable.dims) == 1]
    names = names[len(names) - len(values) :] if len(values) else []
    found = [
        (float(np.nan_to_num(value, nan=np.inf, posinf=np.inf)), name.split(".")[1])
        for name, value in zip(names, values, strict=True)
        if name.startswith("force.") and name.endswith(".magnitude") and name.split(".")[1] not in system.frictions
    ]
    return max(found)[1] if found else ""
