"""Many copies of a machine in motion, stepped by one call: for learning, and for control that looks ahead."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.plan.compilation import build
from nivel.analysis.plan.plan import Plan
from nivel.analysis.progress.log import Listener
from nivel.analysis.run.fitting import fitted
from nivel.analysis.run.lanes import FEWEST, Lanes, unfit_in_steps
from nivel.analysis.run.prepared_state import prepare
from nivel.analysis.run.stepping import Simulation, Snapshot
from nivel.errors import Fault, ModelError, SolveError
from nivel.kernels.output.observe import observe
from nivel.native.library import missing
from nivel.native.packs import LanesWatched
from nivel.native.processor import lane_count
from nivel.native.workers import CompilationError
from nivel.results.frames.summary import Occurrence
from nivel.words.wording import shown

ALL: Final = slice(None)


class Simulations:
    """Copies of a machine: ``sims = machine.start(n=64)``, then ``sims.step({"push": forces})`` and ``sims["pole.angle"]`` (64,).

    Several of them go by each step, in lanes, where they can: see `in_lanes`. ``sims[k]`` of a number k is one of them, a `Simulation` of
    its own, which goes singly from then on. A copy that fails, or that an event ends, stands still: `alive` and `reasons` say so, and its
    readings are those of its last moment; `restore` revives it. not_in_lanes : why none goes in lanes, in words.
    """

    verified: Final = False

    def __init__(
        self, plans: Sequence[Plan], *, source: str = "", lanes: bool | None = None, listener: Listener | None = None
    ) -> None:
        """plans : one of each copy; those that are the same one are prepared once. lanes : whether they go in lanes, by machine code that
        is compiled where there is none; None : where there is some. Raises ModelError where they are to and cannot."""
        self._each: list[Simulation] = []
        last: Any = None
        for plan in plans:
            if last is None or plan is not last[0]:
                own = fitted(plan, prepare(plan.methods))
                last = plan, own
                self._each.append(Simulation(plan, source=source, ready=own))
                continue
            again = last[1][1].again()
            ready = (last[1][0], prepare(last[1][0].methods) if again is None else again)
            self._each.append(Simulation(plan, source=source, ready=ready))
        self._failures = [""] * len(plans)
        self._columns: dict[str | tuple[str, ...], tuple[Any, tuple[int, ...], bool, tuple[str, ...]]] = {}
        self._inside = np.zeros(len(plans), dtype=bool)
        self.not_in_lanes = self._unfit(lanes, listener)
        if lanes and self.not_in_lanes:
            raise ModelError(f"copies cannot go in lanes: {self.not_in_lanes}")
        count, end = lane_count(), 0 if self.not_in_lanes else len(self)
        self._parts = [slice(first, min(first + count, end)) for first in range(0, end, count)]
        self._lanes = [Lanes(self._each[part], self._inside[part]) for part in self._parts]

    def _unfit(self, wanted: bool | None, listener: Listener | None) -> str:
        """Why no copy goes in lanes; where they are wanted, after their machine code is compiled."""
        if wanted is False or len(self) < FEWEST:
            return "it is not asked for" if wanted is False else "there are too few"
        if why := unfit_in_steps(self._each[0]):
            return why
        entries = [*self._each[0].loop.entries_on("packed"), observe.packed]
        if wanted is None and missing(entries):
            return "there is no machine code for it yet: lanes=True compiles it"
        try:
            build(entries, listener)
        except CompilationError as problem:
            return f"there is no machine code for it: {problem}"
        return ""

    def __len__(self) -> int:
        return len(self._each)

    @property
    def in_lanes(self) -> NDArray[np.bool_]:
        """(n,) which of them went in lanes the last time."""
        return self._inside.copy()

    @property
    def alive(self) -> NDArray[np.bool_]:
        """(n,) which of them can go on."""
        out = self._inside.copy()
        for k in (~out).nonzero()[0]:
            out[k] = not (self._failures[k] or self._each[k].stopped_by)
        return out

    @property
    def reasons(self) -> list[str]:
        """Why each of them stands still; empty of those that can go on."""
        return [
            failure or (f"the event `{sim.stopped_by}` ended it at t = {sim.time:g} s" if sim.stopped_by else "")
            for failure, sim in zip(self._failures, self._each, strict=True)
        ]

    @property
    def events(self) -> list[tuple[Occurrence, ...]]:
        """The events of each so far."""
        return [sim.events for sim in self._each]

    @property
    def time(self) -> NDArray[np.float64]:
        """(n,) [s]"""
        out = np.array([sim.time for sim in self._each])
        for lanes, part in zip(self._lanes, self._parts, strict=True):
            out[part][lanes.inside] = lanes.time[lanes.inside]
        return out

    def step(self, inputs: Mapping[str, Any] | None = None) -> None:
        """One step of each. inputs : a number for all of them, or an array (n,), by input or state; they keep these values.

        Raises ModelError where `inputs` has a name that is neither, or a value of the wrong length, before any is stepped.
        """
        self.go(1, inputs)

    def advance(self, duration: float, inputs: Mapping[str, Any] | None = None) -> None:
        """As many steps of each as fill `duration` [s], a multiple of the step."""
        self.go(self._each[0].count_of(duration), inputs)

    def go(self, steps: int, inputs: Mapping[str, Any] | None = None, which: NDArray[np.bool_] | None = None) -> None:
        """So many steps of each, or of those of the mask `which` (n,)."""
        given, moves = self._given(inputs or {}), self.alive if which is None else self.alive & which

        def set_inputs(k: int) -> bool:
            row = {name: float(values[k]) for name, values in given.items()}
            return self._try(k, lambda sim: sim.set_inputs(row))

        for k in (moves & ~self._inside).nonzero()[0].tolist():
            moves[k] = set_inputs(k)
        if self._lanes:
            with LanesWatched() as left:
                for lanes, part in zip(self._lanes, self._parts, strict=True):
                    own = {name: values[part] for name, values in given.items()}
                    moves[part] &= ~lanes.go(steps, own, moves[part], left)
        for k in moves.nonzero()[0].tolist():
            if set_inputs(k):
                self._try(k, lambda sim: sim.go(steps))

    def _try(self, k: int, act: Callable[[Simulation], None]) -> bool:
        """Whether a copy could do it; else why not is noted."""
        try:
            act(self._each[k])
        except SolveError as error:
            self._failures[k] = str(error)
        return not self._failures[k]

    def _given(self, inputs: Mapping[str, Any]) -> dict[str, NDArray[np.float64]]:
        """(n,) values of each input. Raises ModelError."""
        out = {}
        for name, value in inputs.items():
            array = np.asarray(value, dtype=float)
            if array.shape not in ((), (len(self),)):
                message = f"a number, or {len(self)} of them, was expected, got {shown(value)}"
                raise ModelError(Fault.at(f"inputs.{name}", message))
            self._each[0].check_input(name, array.min(), array.max())  # no number is both
            out[name] = array if array.shape else np.full(len(self), array)
        return out

    def __getitem__(self, name: str | tuple[str, ...] | int) -> Any:
        """The present values (n, …) of `name`, as of a `Simulation`; all numbers (n, count) of several names; or the simulation of this
        number."""
        if name == "time":
            return self.time
        if not isinstance(name, int):
            return self._values(name)
        for lanes, part in zip(self._lanes, self._parts, strict=True):
            if part.start <= name % len(self) < part.stop:
                lanes.leave([name % len(self) - part.start], for_good=True)
        return self._each[name]

    def _values(self, names: str | tuple[str, ...]) -> NDArray[np.float64]:
        if names not in self._columns:
            several = (names,) if isinstance(names, str) else names
            found = [self._each[0].columns_of(name) for name in several]
            columns = np.concatenate([np.zeros(0, dtype=int), *(each.ravel() for each, _ in found)])
            shape = found[0][0].shape if isinstance(names, str) else columns.shape
            at = columns.reshape(shape) if shape else int(columns[0])
            self._columns[names] = at, shape, any(shared for _, shared in found), several
        columns, shape, shared, several = self._columns[names]
        out, singly = np.empty((len(self), *shape)), ~self._inside
        for lanes, part in zip(self._lanes, self._parts, strict=True):
            frame = None if shared else lanes.frames()
            if frame is None:
                lanes.bring(lanes.inside)
                singly[part] = True
            else:
                out[part] = frame[: part.stop - part.start, columns]
        for k in singly.nonzero()[0].tolist():
            sim = self._each[k]
            out[k] = sim[names] if isinstance(names, str) else [x for name in several for x in np.ravel(sim[name])]
        return out

    @property
    def states(self) -> tuple[Snapshot, ...]:
        """This moment of each, to be restored."""
        for lanes in self._lanes:
            lanes.bring(lanes.inside)
        return tuple(sim.state for sim in self._each)

    def restore(self, states: Snapshot | Sequence[Snapshot], which: Any = ALL) -> None:
        """Give states to all, or to those of the mask or numbers `which`; one state goes to each of them.

        Raises ModelError as `Simulation.restore` does.
        """
        numbers = np.arange(len(self))[which].tolist()
        given = [states] * len(numbers) if isinstance(states, Snapshot) else list(states)
        if len(given) != len(numbers):
            raise ModelError(Fault.at("states", f"{len(numbers)} states were expected, got {len(given)}"))
        for lanes, part in zip(self._lanes, self._parts, strict=True):
            lanes.leave([k - part.start for k in numbers if part.start <= k < part.stop])
        for k, state in zip(numbers, given, strict=True):
            self._each[k].restore(state)
            self._failures[k] = ""

    def replace(self, k: int, sim: Simulation) -> None:
        """Have another simulation in place of a copy."""
        self._each[k], self._failures[k] = sim, ""
        for lanes, part in zip(self._lanes, self._parts, strict=True):
            if part.start <= k < part.stop:
                lanes.replace(k - part.start, sim)

    def __getstate__(self) -> dict[str, Any]:
        """For `pickle` and `copy`: those that go in lanes go singly there."""
        for lanes in self._lanes:
            lanes.bring(lanes.inside)
        singly = {"_lanes": [], "_parts": [], "_inside": np.zeros_like(self._inside), "not_in_lanes": "they are copied"}
        return self.__dict__ | singly

    def __repr__(self) -> str:
        return f"<{len(self)} simulations of {self._each[0].machine_name}: {int(self.alive.sum())} alive, not verified>"
