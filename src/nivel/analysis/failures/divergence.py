"""Motion that has grown without bound: what failed then only shows that the step was too long."""

from __future__ import annotations

import numpy as np

from nivel.analysis.assembly.equations import MotionEquations
from nivel.kernels.output.observe import observe
from nivel.system.layout import reported
from nivel.system.system import Array, System

# Energy that no load gave, as a multiple of that of the start and of the weights at the machine's length; as a share of the work.
GROWN, OF_WORK = 1e3, 0.1
UNBOUND = "the motion has grown without bound"


def grown_motion(motion: MotionEquations, time: float, step: float, y: Array) -> tuple[str, str] | None:
    """(message, advice) where the last accepted state y has far more energy than anything gave it, in what is elastic too or in what
    dampers take in a step, and bodies that move by more than the length of the machine in a step of fixed size; None where it has not."""
    system, control = motion.system, motion.system.record.control
    motion.evaluate(time, y)
    observe(motion.handle.address, time, y, np.zeros(system.layout.width))
    kinetic, potential, start = (float(each) for each in control.energy)
    work, dissipated = float(y[-2]), float(y[-1])
    gained = kinetic + potential - start - work + dissipated
    bodies = system.record.bodies
    mass = float(bodies.mass.sum())
    known = max(abs(start), mass * float(np.linalg.norm(bodies.gravity)) * system.size)
    slow = kinetic <= 0.5 * mass * (system.size / step) ** 2
    stored, damped = float(control.stored[0]), step * _damping_power(system)
    fast = max(stored, damped)
    if slow or fast <= GROWN * known or abs(gained) <= max(GROWN * known, OF_WORK * abs(work)):
        return None
    decays = damped > stored
    kind, strongest = ("decay", "takes most power") if decays else ("vibration", "is largest")
    pulls = _most(system, "power" if decays else "magnitude")
    gain = f"{abs(gained):.2g} J" if np.isfinite(gained) else "more energy than a number can hold,"
    message = (
        f"{UNBOUND}: the machine has {gain} that no load gave it. A step of {step:.3g} s is too long for its "
        f"fastest {kind}{pulls and f', and {pulls} is the force that {strongest}'}"
    )
    stiff, over = ("damper", "decays") if decays else ("spring", "vibrations")
    advice = (
        f"Try --step {step / 10:.3g}, and less for a stiffer {stiff} or a lighter body; or a method that steps over fast "
        f"{over}: radau, generalised-alpha, or ros2 with --coordinates relative."
    )
    return message, advice


def _damping_power(system: System) -> float:
    """What dampers take from the machine in the state last evaluated, frictions not counted [W]; infinite beyond all numbers."""
    frictions = [value for name, value in _outputs(system, "power") if name in system.frictions]
    power = float(system.record.control.power[1]) + sum(frictions)
    return power if np.isfinite(power) else np.inf


def _most(system: System, output: str) -> str:
    """The force with the largest `output` in the state last evaluated, frictions not counted; empty without any."""
    found = [
        (float(np.nan_to_num(abs(value), nan=np.inf, posinf=np.inf)), name)
        for name, value in _outputs(system, output)
        if name not in system.frictions
    ]
    return max(found)[1] if found else ""


def _outputs(system: System, output: str) -> list[tuple[str, float]]:
    """(name, value) of the forces that report `output`, in the state last evaluated."""
    values = system.record.outputs.value
    names = [variable.name for variable in reported(system.layout, len(values))]
    parts = [(name.split("."), float(value)) for name, value in zip(names, values, strict=True)]
    return [(part[1], value) for part, value in parts if part[0] == "force" and part[-1] == output]
