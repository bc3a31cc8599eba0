"""Runs without an end: motion that has grown without bound, and steps that have become so short that the end is out of reach.

The fastest rate of a machine in a state, and the part that it is of: what an explicit step of fixed size has to be short for.
Rates are the eigenvalues λ of A = ∂ẏ/∂y, by differences. With right and left vectors v and w, entry k takes part in the fastest one by
|w_k v_k|, whatever its units (Pérez-Arriaga, Verghese and Schweppe 1982): where states of volumes, blocks or forces take the larger part,
the owner of most of it is named. Otherwise it is a motion, in which the work of each force per second has a part of the second order,
which is the work of that motion itself: the force, or the cylinder, with the largest one is named.
"""

from collections.abc import Callable
from typing import cast

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.preparation.preparation import Prepared
from nivel.integrate.catalogue import INTEGRATORS
from nivel.integrate.loop.run import DONE_STEPS, TAKEN, TIME, WAIT, Run
from nivel.judge.during.stop import Status
from nivel.kernels.core.status import OK
from nivel.kernels.output.observe import observe
from nivel.lazy import Struct
from nivel.machine.units.tree import Node
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
    frictions = [value for name, value in _outputs(system, "power") if name in system.frictions]
    power = float(control.power[1]) + sum(frictions)  # what dampers take
    stored, damped = float(control.stored[0]), step * power if np.isfinite(power) else np.inf
    fast = max(stored, damped)
    if slow or fast <= GROWN * known or abs(gained) <= max(GROWN * known, OF_WORK * abs(work)):
        return None
    decays = damped > stored
    kind, strongest = ("decay", "takes most power") if decays else ("vibration", "is largest")
    pulls = _most(system, "power" if decays else "magnitude")
    gain = f"{abs(gained):.2g} J" if np.isfinite(gained) else "more energy than a number can hold,"
    stiff, over = ("damper", "decays") if decays else ("spring", "vibrations")
    return (
        f"{UNBOUND}: the machine has {gain} that no load gave it. A step of {step:.3g} s is too long for its "
        f"fastest {kind}{pulls and f', and {pulls} is the force that {strongest}'}",
        f"Try --step {step / 10:.3g}, and less for a stiffer {stiff} or a lighter body; or a method that steps over fast "
        f"{over}: radau, generalised-alpha, or ros2 with --coordinates relative.",
    )


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


# A run is looked at after so many steps. It crawls where they were this much shorter than its longest one, and so many are left at least.
LOOKED_AT, SHORT, LEFT = 10_000, 1e-5, 1e7
# The same where a switch turns to and fro: so many steps have made less way than the longest one, and a hundred times as many are left.
SHORT_TO_AND_FRO, LEFT_TO_AND_FRO = 1e-4, 1e6
# Its end is out of reach where so many steps are left, at each of so many looks.
OUT_OF_REACH, OFTEN, TIMES = 1e8, 2_000, 20
# beside a position where the motion branches after so many looks
SOON = 2


class Pace(Struct, frozen=False):
    """Steps and time [s] of a run when it was looked at last."""

    steps: int = 0
    time: float = 0.0

    def mean(self, run: Run, least: int) -> float | None:
        """The mean step [s] since then; None where there were fewer than `least`."""
        steps, time = int(run.counter[DONE_STEPS]), float(run.clock[TIME])
        if steps - self.steps < least:
            return None
        mean = (time - self.time) / (steps - self.steps)
        self.steps, self.time = steps, time
        return mean


def to_and_fro(run: Run, system: System) -> tuple[Node, ...]:
    """Functions of the switches that turn to and fro without end, so that the run has let them go."""
    watched = system.record.watched
    waits = run.event_values[WAIT, len(watched.event) + len(watched.surface) :]
    return tuple(system.switching[k] for k in np.flatnonzero(waits))


class Crawl:
    """Whether a run of this duration [s] makes next to no way any more. jumps : some function jumps with the motion. branches : whether
    the motion does, beside the state of a run. system : its equations."""

    def __init__(self, duration: float, jumps: bool, branches: Callable[[Run], bool], system: System) -> None:
        self.duration, self.jumps, self.branches, self.system = duration, jumps, branches, system
        self.since, self.often, self.count = Pace(), Pace(), 0

    def seen(self, run: Run) -> Status | None:
        """Called between chunks of steps; the status with which the run ends, None where it goes on."""
        left = self.duration - float(run.clock[TIME])
        mean = self.since.mean(run, LOOKED_AT) if self.jumps else None
        if mean is not None:
            turning = to_and_fro(run, self.system)
            short, many = (SHORT_TO_AND_FRO, LEFT_TO_AND_FRO) if turning else (SHORT, LEFT)
            if mean < short * float(run.pace[TAKEN].max()) and left > many * mean:
                return Status.CRAWLS
        mean = self.often.mean(run, OFTEN)
        if mean is not None:
            self.count = self.count + 1 if left > OUT_OF_REACH * mean else 0
            if self.count == SOON and self.branches(run):
                return Status.OUT_OF_REACH
        return Status.OUT_OF_REACH if self.count >= TIMES else None


def jump_advice(jumping: tuple[str, ...]) -> str:
    """What to do about functions that jump."""
    few = " and ".join(jumping[:3])
    return (
        f"{few} {'jumps' if len(jumping) == 1 else 'jump'}: where it brings the motion to rest it turns round in every step. "
        f"Dry friction is a force `type: friction` with `model: stiction`, which stands still. Else let it pass smoothly, "
        f"tanh(v/(1 mm/s)) in place of sign(v), or take a fixed step."
    )


Vectors = NDArray[np.complex128]
# States with more entries are not looked at; increments as shares of the scales of y.
MOST_ENTRIES, SHARE, TINY = 300, 1e-6, 1e-12
# Shares of the increments that work is found with.
PART = 1e-2


class Fastest(Struct):
    """rate [1/s] of the state at `time` [s], and the name of the force, component or block that it is of; empty where none works in it."""

    rate: float
    part: str
    time: float


def held_step(integrator: str, rate: float) -> float:
    """The longest step [s] with which an explicit method holds this rate [1/s]."""
    return INTEGRATORS[integrator].held / rate if rate > 0.0 else np.inf


def fastest_beyond(prepared: Prepared, integrator: str, step: float, time: float, last: Array) -> Fastest | None:
    """The fastest rate at the start, or at time [s] in the `last` state, where a step [s] does not hold it; None where both are held."""
    rates = (fastest(prepared.motion, t, y) for t, y in ((0.0, prepared.start), (time, last)))
    return next((each for each in rates if each is not None and step > held_step(integrator, each.rate)), None)


@np.errstate(over="ignore", invalid="ignore", divide="ignore")  # of a state that may be beyond all bounds
def fastest(motion: MotionEquations, t: float, y: Array) -> Fastest | None:
    """In this state; None where it has no rates, nothing changes, or it has too many entries."""
    count = len(y) - 2  # energies follow from the others
    if not 0 < count <= MOST_ENTRIES or not np.isfinite(y).all():
        return None
    steps, A = increments(motion, y), np.zeros((count, count))
    for k in range(count):
        ends = [_rate(motion, t, y, k, side * steps[k]) for side in (1.0, -1.0)]
        if ends[0] is None or ends[1] is None:
            return None
        A[:, k] = (ends[0] - ends[1])[:count] / (2.0 * steps[k])
    if not np.isfinite(A).all():
        return None
    rates, right = cast(tuple[Vectors, Vectors], np.linalg.eig(A))
    k = int(np.argmax(np.abs(rates)))
    if not np.abs(rates[k]) > 0.0:
        return None
    # left vectors of A are right ones of its transpose
    its, left = cast(tuple[Vectors, Vectors], np.linalg.eig(A.T))
    j = int(np.argmin(np.abs(its - rates[k])))
    # a phase at which positions and speeds of a vibration are both there
    shape = np.real(right[:, k] * np.exp(0.25j * np.pi))
    owner = _taking_part(motion, np.abs(left[:, j] * right[:, k]))
    return Fastest(float(np.abs(rates[k])), owner or _working(motion, t, y, shape), t)


def increments(motion: MotionEquations, y: Array) -> Array:
    """(n,) of the entries of y without its energies, for differences."""
    facts, count = motion.system.states, len(y) - 2
    scales = np.full(count, motion.system.size)
    scales[count - len(facts) :] = [fact.scale if fact.relative else 0.0 for fact in facts]
    return SHARE * np.maximum(np.abs(y[:count]), np.maximum(scales, TINY))


def _taking_part(motion: MotionEquations, parts: Array) -> str:
    """The owner of states with the largest part, where it is larger than that of all positions and speeds."""
    facts = motion.system.states
    first = len(parts) - len(facts)
    shares: dict[str, float] = {}
    for fact, part in zip(facts, parts[first:], strict=True):
        owner = fact.variable.removeprefix("control.") if fact.variable.startswith("control.") else fact.name
        name = owner.split(".")[0]
        shares[name] = shares.get(name, 0.0) + float(part)
    largest = max(shares, key=lambda name: shares[name], default="")
    return largest if largest and shares[largest] > float(parts[:first].sum()) else ""


def _rate(motion: MotionEquations, t: float, y: Array, k: int, by: float) -> Array | None:
    moved = y.copy()
    moved[k] += by
    status, rate = motion.evaluate(t, moved)
    return rate if status == OK else None


def _working(motion: MotionEquations, t: float, y: Array, shape: Array) -> str:
    """The force or cylinder whose work in the motion `shape` is largest."""
    scale = PART * motion.system.size / max(float(np.abs(shape).max()), 1e-300)
    shape = shape.copy()
    shape[len(shape) - len(motion.system.states) :] = 0.0  # what springs and dampers do, not what is fed
    powers = [_powers(motion, t, y, side * scale * shape) for side in (1.0, 0.0, -1.0)]
    work = {name: abs(powers[0][name] - 2.0 * powers[1][name] + powers[2][name]) for name in powers[1]}
    finite = {name: value for name, value in work.items() if np.isfinite(value) and value > 0.0}
    return max(finite, key=lambda name: finite[name], default="")


def _powers(motion: MotionEquations, t: float, y: Array, change: Array) -> dict[str, float]:
    """The power [W] of each force and cylinder in a state aside."""
    aside, layout = y.copy(), motion.system.layout
    aside[: len(change)] += change
    motion.evaluate(t, aside)
    frame = np.zeros(layout.width)
    observe(motion.handle.address, t, aside, frame)
    return {
        each.name.split(".")[1]: float(frame[each.columns][0])
        for each in layout.variables
        if each.name.startswith(("force.", "hydraulics."))
        and each.name.endswith(".power")
        and each.name.count(".") == 2
    }
