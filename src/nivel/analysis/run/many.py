"""Many copies of a machine in motion, stepped by one call: for learning, and for control that looks ahead."""

from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.plan.plan import Plan
from nivel.analysis.run.fitting import fitted
from nivel.analysis.run.prepared_state import prepare
from nivel.analysis.run.stepping import Simulation, Snapshot
from nivel.errors import Fault, ModelError, SolveError
from nivel.words.wording import shown

ALL: Final = slice(None)


class Simulations:
    """Copies of a machine: ``sims = machine.start(n=64)``, then ``sims.step({"push": forces})`` and ``sims["pole.angle"]`` (64,).

    ``sims[k]`` of a number k is one of them, a `Simulation` of its own. A copy that fails, or that an event ends, stands still: `alive`
    and `reasons` say so, and its readings are those of its last moment; `restore` revives it.
    """

    verified: Final = False

    def __init__(self, plans: Sequence[Plan], *, source: str = "") -> None:
        """plans : one of each copy; those that are the same one are prepared once."""
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

    def __len__(self) -> int:
        return len(self._each)

    @property
    def alive(self) -> NDArray[np.bool_]:
        """(n,) which of them can go on."""
        return np.array(
            [not (reason or sim.stopped_by) for reason, sim in zip(self._failures, self._each, strict=True)]
        )

    @property
    def reasons(self) -> list[str]:
        """Why each of them stands still; empty of those that can go on."""
        return [
            failure or (f"the event `{sim.stopped_by}` ended it at t = {sim.time:g} s" if sim.stopped_by else "")
            for failure, sim in zip(self._failures, self._each, strict=True)
        ]

    @property
    def time(self) -> NDArray[np.float64]:
        """(n,) [s]"""
        return np.array([sim.time for sim in self._each])

    def step(self, inputs: Mapping[str, Any] | None = None) -> None:
        """One step of each. inputs : a number for all of them, or an array (n,), by input or state; they keep these values.

        Raises ModelError where `inputs` has a name that is neither, or a value of the wrong length, before any is stepped.
        """
        self._go(1, inputs)

    def advance(self, duration: float, inputs: Mapping[str, Any] | None = None) -> None:
        """As many steps of each as fill `duration` [s], a multiple of the step."""
        self._go(self._each[0].count_of(duration), inputs)

    def _go(self, steps: int, inputs: Mapping[str, Any] | None) -> None:
        rows = self._rows(inputs)
        for k, sim in enumerate(self._each):
            if self._failures[k] or sim.stopped_by:
                continue
            try:
                if rows is not None:
                    sim.set_inputs(rows[k])
                sim.go(steps)
            except SolveError as error:
                self._failures[k] = str(error)

    def _rows(self, inputs: Mapping[str, Any] | None) -> list[dict[str, float]] | None:
        """Inputs of each."""
        if not inputs:
            return None
        columns = {}
        for name, value in inputs.items():
            array = np.asarray(value, dtype=float)
            if array.shape not in ((), (len(self),)):
                message = f"a number, or {len(self)} of them, was expected, got {shown(value)}"
                raise ModelError(Fault.at(f"inputs.{name}", message))
            for worst in (array.min(), array.max()):  # no number is both
                self._each[0].check_inputs({name: float(worst)})
            columns[name] = np.broadcast_to(array, len(self)).tolist()
        if len(columns) == 1:
            ((name, values),) = columns.items()
            return [{name: value} for value in values]
        return [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)]

    def __getitem__(self, name: str | int) -> Any:
        """The present values (n, …) of `name`, as of a `Simulation`; or the simulation of this number."""
        if isinstance(name, str):
            return np.array([sim[name] for sim in self._each])
        return self._each[name]

    @property
    def states(self) -> tuple[Snapshot, ...]:
        """This moment of each, to be restored."""
        return tuple(sim.state for sim in self._each)

    def restore(self, states: Snapshot | Sequence[Snapshot], which: Any = ALL) -> None:
        """Give states to all, or to those of the mask or numbers `which`; one state goes to each of them.

        Raises ModelError as `Simulation.restore` does.
        """
        numbers = np.arange(len(self))[which].tolist()
        given = [states] * len(numbers) if isinstance(states, Snapshot) else list(states)
        if len(given) != len(numbers):
            raise ModelError(Fault.at("states", f"{len(numbers)} states were expected, got {len(given)}"))
        for k, state in zip(numbers, given, strict=True):
            self._each[k].restore(state)
            self._failures[k] = ""

    def __repr__(self) -> str:
        return f"<{len(self)} simulations of {self._each[0].machine_name}: {int(self.alive.sum())} alive, not verified>"
