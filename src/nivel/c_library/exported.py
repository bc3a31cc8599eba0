"""Machines as programs without Python have them: image of the records, outputs, inputs, failures, and the machine code that they need."""

import re
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Final, NamedTuple

import numpy as np

from nivel.analysis.plan.compilation import run_entries
from nivel.analysis.plan.plan import Plan
from nivel.analysis.preparation.attributes import run_attributes
from nivel.analysis.preparation.preparation import Prepared
from nivel.analysis.run.dynamics import Loop, start_loop
from nivel.analysis.run.fitting import fitted
from nivel.analysis.run.prepared_state import prepare
from nivel.c_library.image import LINE, WORD, Image, UnknownAddressError
from nivel.elements.control.units import UnitBlock
from nivel.errors import Fault, ModelError, refuse
from nivel.integrate.loop.loop import advance
from nivel.integrate.loop.run import ALL_STEPS, END, EVERY
from nivel.integrate.loop.sink import Header
from nivel.judge.before.refusals import ON_SOIL
from nivel.judge.during.stop import Status
from nivel.kernels.core.block import Handle
from nivel.kernels.record.function import CONSTANT
from nivel.lazy import Struct
from nivel.machine.laws.time_function import Table
from nivel.machine.signals.input import Input
from nivel.native.entry import Entry
from nivel.results.frames.csv_table import columns
from nivel.results.memory import Memory
from nivel.results.result import Result
from nivel.system.system import System


class Failure(NamedTuple):
    """A status, a sentence on it with {} for the name of what failed, and the names that it may have."""

    status: Status
    sentence: str
    names: tuple[str, ...] = ()


# of each failure a sentence, in which stands what of a system it may be about
_SENTENCES: Final = {
    Status.SINGULAR: "the constraint {rows} depends on the others here: the step is too long for this motion, or the machine is in a "
    "singular position",
    Status.NOT_FINITE: "the state is no longer a number: the step is too long for this motion, or a function has no value",
    Status.FRICTION_DIVERGES: "no friction {frictions} is consistent with the reactions that it causes",
    Status.BRISTLE_TOO_FAST: "the bristles of {frictions} relax faster than the step can follow",
    Status.CONTRADICTION: "the constraint {rows}, which repeated others at the start, contradicts them now",
    Status.ROTATION_SINGULAR: "the rotation coordinates of {bodies} come to a singular position",
    Status.NOT_CONVERGED: "the iteration of an implicit step finds no solution: the step is too long, or a force jumps or is too stiff",
    Status.STEP_TOO_SMALL: "the error of even the smallest step is above the tolerance",
    Status.EVENT_NOT_FINITE: "the value of the event {events} is no longer a number",
    Status.MULTIPLIERS_NOT_FOUND: "the augmented Lagrangian finds no multipliers",
    Status.NO_MASS_LEFT: "the modes of {bodies} take up all the mass and inertia of its frame",
    Status.NOT_ON_RAIL: "{rails} has no place on its beam, or is beyond its end",
    Status.NOT_CLOSED: "joints cannot be closed by changes of positions, {rows} least of all: the step is too long, or the machine jams",
    Status.OPEN: "joints are open by a tenth of the machine: the step is too long, or the machine jams",
    Status.NO_VOLUME: "the volume {volumes} has no fluid left in it, or no room for it",
}


def failures_of(system: System) -> list[Failure]:
    """Every failure that a run of fixed steps of this machine may have, in the order of their numbers."""
    coordinates = system.record.joints.coordinate.tolist()
    joints = dict(zip(coordinates, system.layout.coordinates["joint_coordinate"], strict=True))
    names = {kind: getattr(system, kind) for kind in ("rows", "frictions", "bodies", "events")}
    names["rails"] = [joints.get(k, "a coordinate") for k in range(max(coordinates, default=-1) + 1)]
    names["volumes"] = [node.name for node in system.nodes]
    found = []
    for status, sentence in sorted(_SENTENCES.items()):
        before, brace, rest = sentence.partition("{")
        kind, end, after = rest.partition("}")
        found.append(Failure(status, before + brace + end + after, tuple(names.get(kind, ()))))
    return found


# as many frames as a step may leave: its own, and that of the start
FRAMES_KEPT = 2
# steps without end, in which times are still exact products of the step
ENDLESS = 2**52
# what is an output where nothing is selected, besides sensors and inputs
USUAL = ("joint_coordinate", "joint_rate")
EVERYTHING = "*"


class Output(Struct):
    """A number of a frame. place : in the frame."""

    name: str
    units: str
    place: int


class InputPlace(Struct):
    """An input. kind, value : bytes of the image where its function has them. rest : its value while it is not set, at the start.
    followed : place in a frame of the value that it has.
    """

    name: str
    units: str
    kind: int
    value: int
    low: float
    high: float
    rest: float
    followed: int
    description: str


class Exported(Struct):
    """A machine prepared for a run of fixed steps without an end. what : it becomes, for messages. outputs : the time first."""

    what: str
    plan: Plan
    prepared: Prepared
    loop: Loop
    image: Image
    entries: tuple[Entry, ...]
    outputs: tuple[Output, ...]
    inputs: tuple[InputPlace, ...]
    failures: tuple[Failure, ...]

    @property
    def identifier(self) -> str:
        """The name of the machine as C writes names."""
        name = re.sub(r"\W", "_", self.plan.machine.name.lower(), flags=re.ASCII)
        return name if not name[:1].isdigit() else f"m_{name}"

    @cached_property
    def codes(self) -> tuple[str, ...]:
        """Symbols of the machine code that it reaches, the four that the loop is called with first.

        Families of forces call no entries except by addresses in the image.
        """
        loop = self.loop
        first = (advance.symbol, *(each.symbol for each in loop.codes))
        return (*first, *sorted({*self.image.outer.values()} - {*first}))

    @property
    def used(self) -> list[Entry]:
        """The entries of these symbols."""
        return [each for each in self.entries if each.symbol in {*self.codes}]

    @property
    def size(self) -> int:
        """Bytes of a block: the image, what is kept of inputs, outputs; whole lines of the cache."""
        return self.size_for(len(self.outputs))

    def size_for(self, outputs: int) -> int:
        """Bytes of a block with so many outputs."""
        size = self.image.words.nbytes + WORD * (1 + len(self.inputs) + outputs)
        return -(-size // LINE) * LINE

    @property
    def numbers(self) -> dict[str, int]:
        """The numbers of `nivel_model`, in its order."""
        image, run = self.image, self.loop.history.record
        place = {
            name: image.byte_of(getattr(run, name).ctypes.data) for name in ("clock", "counter", "frames", "y", "rate")
        }
        return {
            "image": image.words.nbytes,
            "size": self.size,
            "count": len(image.words.nonzero()[0]),
            "inner_count": len(image.inner),
            "outer_count": len(image.outer),
            "output_count": len(self.outputs),
            "input_count": len(self.inputs),
            "failure_count": len(self.failures),
            "machine": image.byte_of(int(self.loop.machine.address)),
            "history": image.byte_of(int(self.loop.history.address)),
            **place,
            "y_size": len(run.y),
            "failed": image.byte_of(self.loop.machine.record.control.failure.ctypes.data),
            "constant": CONSTANT,
            "advance": 0,
            "evaluate": 1,
            "correct": 2,
            "step": 3,
        }


def export(plan: Plan, what: str, select: Sequence[str] = ()) -> Exported:
    """Prepare a machine. what : `a C library`, for messages. select : names of outputs as `columns` takes them; empty: sensors, joint
    coordinates with their rates and inputs; "*": every number of a frame.

    Raises ModelError where the integrator chooses its steps, or a Python law takes part.
    """
    if plan.settings.steps == 0:
        raise refusal(
            f"{what} takes steps of one length, and {plan.settings.integrator} chooses them; "
            "take --integrator rk4, or --step-control fixed"
        )
    if named := [
        f"{each.what} of the block `{each.name}`" for each in plan.machine.control if isinstance(each, UnitBlock)
    ]:
        raise refusal(f"{what} cannot have what others have compiled: {named[0]}")
    refuse(ON_SOIL.faults(plan.machine))  # its cells are no part of the image
    plan, prepared = fitted(plan, prepare(plan.methods))
    loop = _endless(start_loop(prepared, plan.settings))
    entries = tuple(dict.fromkeys(run_entries(plan)))
    twins = [prepared.motion.twin] if prepared.motion.twin is not None else []
    try:
        image = Image([loop.machine, *twins, loop.history], {entry.address: entry.symbol for entry in entries})
    except UnknownAddressError:
        raise refusal(f"Python laws cannot go into {what}; write them as expressions") from None
    frame = _frame(plan, prepared)
    place = {name: k for k, name in enumerate(columns(frame), start=1)}
    outputs = _outputs(frame, place, plan.machine.inputs, select)
    inputs = tuple(
        _input_place(each, function, loop, image, place[f"{each.name}.value"])
        for each, function in zip(plan.machine.inputs, prepared.motion.system.input_functions, strict=True)
    )
    failures = tuple(failures_of(prepared.motion.system))
    return Exported(what, plan, prepared, loop, image, entries, outputs, inputs, failures)


def refusal(message: str) -> ModelError:
    """An error of the machine as a whole."""
    return ModelError(Fault.at("", message))


def _endless(loop: Loop) -> Loop:
    """The loop with a frame after each step and room for no more than that, and without an end."""
    run = loop.history.record
    run.counter[EVERY], run.counter[ALL_STEPS], run.clock[END] = 1, ENDLESS, 1e300
    kept = run._replace(frames=run.frames[:FRAMES_KEPT].copy())
    return loop._replace(history=Handle(kept))


def _frame(plan: Plan, prepared: Prepared) -> Result:
    """A result without frames, which knows the names of all numbers of a frame."""
    sink = Memory()
    attributes = run_attributes(plan.machine, "", prepared, plan.settings)
    sink.begin(Header(prepared.motion.system.layout, attributes))
    return sink.result()


def _outputs(
    frame: Result, place: Mapping[str, int], inputs: Sequence[Input], select: Sequence[str]
) -> tuple[Output, ...]:
    """Numbers of a frame, named as in results: the time, and what is selected."""
    if not select:
        chosen = _usual(frame, [*place], inputs) or [*place]
    elif EVERYTHING in select:
        chosen = [*place]
    else:
        chosen = columns(frame, select)
    return (Output("time", "s", 0), *(Output(name, frame.units(name), place[name]) for name in chosen))


def _usual(frame: Result, names: Sequence[str], inputs: Sequence[Input]) -> list[str]:
    """Sensors, joint coordinates and their rates, and inputs."""
    usual = {*USUAL, *(f"{each.name}.value" for each in inputs)}
    owner = ((name, frame.selection(name).variable) for name in names)
    return [name for name, variable in owner if variable in usual or variable.startswith("sensor.")]


def _input_place(each: Input, function: int, loop: Loop, image: Image, followed: int) -> InputPlace:
    functions = loop.machine.record.functions
    kinds, values = (image.byte_of(array.ctypes.data) for array in (functions.kind, functions.value))
    (low, high), course = each.range, each.course
    rest = float(np.interp(0.0, course.times, course.values)) if isinstance(course, Table) else float(course)
    kind, value = kinds + functions.kind.itemsize * function, values + WORD * function
    rest = min(max(rest, low), high)
    return InputPlace(each.name, each.units, kind, value, low, high, rest, followed, each.description)
