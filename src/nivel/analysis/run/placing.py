"""Joint coordinates and rates of a machine in motion, set by its caller: bodies and velocities follow, with all joints closed.

Coordinates that the joints leave free keep their values and rates. What no joint coordinate describes moves as little as it can; of
velocities, by the change of the least kinetic energy.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import numpy as np

from nivel.analysis.assembly.closing import Wishes, close_positions, least_change
from nivel.analysis.assembly.equations import equations
from nivel.analysis.assembly.named_freedoms import coordinate_derivatives, freedoms
from nivel.analysis.assembly.velocities import whitened
from nivel.analysis.plan.plan import Methods
from nivel.analysis.preparation.preparation import Prepared
from nivel.errors import Fault, ModelError, refuse
from nivel.lazy import dataclass
from nivel.results.motion import rotation_matrices
from nivel.system.system import Array, System

# velocities are solved for so often: the second solution takes the round-off of the first one away
SOLUTIONS: Final = 2
# rates may miss what is asked of them by this share of the largest one
MISSED: Final = 1e-9


@dataclass(frozen=True)
class Placed:
    """A state in the coordinates of a run, the measured coordinates there, and the places (B, 3) [m] of the bodies."""

    y: Array
    reference: Array
    position: Array


class Placing:
    """What it takes to place a machine that runs.

    Raises ModelError for machines with flexible bodies.
    """

    def __init__(self, methods: Methods, prepared: Prepared) -> None:
        machine = methods.machine
        if machine.is_flexible:
            message = (
                "joint coordinates of a machine with flexible bodies cannot be set while it moves: restore a state"
            )
            raise ModelError(Fault.at("flexible", message))
        self._methods, self._prepared = methods, prepared
        self._motion = equations(machine, measured=True)
        system = self._motion.system
        names = system.layout.coordinates["joint_coordinate"]
        self._place = dict(zip(names, system.record.joints.coordinate.tolist(), strict=True))
        self._weight = np.array([body.assembly_weight for body in machine.bodies], dtype=float)

    def placed(
        self,
        t: float,
        posture: Mapping[str, Array],
        reference: Array,
        states: Array,
        wanted: tuple[Mapping[str, float], Mapping[str, float]],
    ) -> Placed:
        """The state with the wanted values and rates by joint coordinate.

        posture : position, orientation, velocity, angular_velocity of all bodies now, as in results; reference : of the measured
        coordinates; states : of elements, the last entries of y. Raises ModelError where the joints do not allow it.
        """
        motion, (values, rates) = self._motion, wanted
        system, functions = motion.system, self._prepared.motion.system.record.functions
        # inputs have the values that the run has set
        system.record.functions.kind[:], system.record.functions.value[:] = functions.kind, functions.value
        y = _absolute(system, posture, states)
        system.record.coordinates.reference[:] = reference
        motion.evaluate(t, y)
        now = {name: float(system.record.coordinates.value[k]) for name, k in self._place.items()}
        speeds = {name: float(system.record.coordinates.rate[k]) for name, k in self._place.items()}
        if values:
            self._close(t, y, {**{name: now[name] for name in self._keeping(values)}, **values}, values)
        q = y[: system.positions].reshape(-1, 7)
        y = _absolute(system, {**posture, "position": q[:, :3], "orientation": q[:, 3:]}, states)
        motion.evaluate(t, y)
        self._fit_rates(t, y, {**{name: speeds[name] for name in self._keeping(rates)}, **rates}, rates)
        found = system.record.coordinates.reference.copy()
        return Placed(
            self._in_run_coordinates(y, found, states),
            found,
            y[: system.positions].reshape(-1, 7)[:, :3].copy(),
        )

    def _keeping(self, wanted: Mapping[str, float]) -> list[str]:
        """The other joint coordinates that may keep what they have."""
        here = freedoms(self._motion)
        others = [name for name in self._place if name not in wanted]
        if here is None:
            return others if len(self._methods.machine.joints) <= len(self._methods.machine.bodies) else []
        own = coordinate_derivatives(self._motion, [self._place[name] for name in wanted])
        rows = coordinate_derivatives(self._motion, [self._place[name] for name in others])
        return [others[k] for k in here.keeping(own, [row[None] for row in rows])]

    def _close(self, t: float, y: Array, values: Mapping[str, float], wanted: Mapping[str, float]) -> None:
        """Close all joints with these values of coordinates; with the wanted ones alone where not all can be kept."""
        before, reference = y.copy(), self._motion.system.record.coordinates.reference.copy()
        for each in (values, wanted):
            y[:] = before
            self._motion.system.record.coordinates.reference[:] = reference
            wishes = Wishes(
                self._weight,
                np.zeros(len(self._weight), dtype=bool),
                tuple((name, self._place[name], value) for name, value in each.items()),
            )
            with np.errstate(over="ignore", invalid="ignore"):
                if close_positions(self._motion, t, y, wishes):
                    return
        faults = [
            Fault.at(name, f"the joints do not allow the value {value:.6g}; values that they tie together need one")
            for name, value in wanted.items()
        ]
        raise ModelError(faults)

    def _fit_rates(self, t: float, y: Array, rates: Mapping[str, float], wanted: Mapping[str, float]) -> None:
        """Give the joints velocities that fit, with these rates. The state last evaluated is y."""
        motion, system = self._motion, self._motion.system
        record, count, rows = system.record, system.body_count, slice(0, system.machine_rows)
        chosen, aims = [self._place[name] for name in rates], np.array([*rates.values()])
        units = [1.0 if name.partition(".")[2].startswith("angle") else system.size for name in rates]
        scale = np.append(record.constraints.scale[rows], units)
        ways = whitened(system, np.ones((count, 6), dtype=bool), 0.0)
        velocities = y[system.positions : system.positions + 6 * count].reshape(count, 6)
        for _ in range(SOLUTIONS):
            target = np.append(-record.constraints.Cdot[rows], aims - record.coordinates.rate[chosen])
            change = least_change(motion, target, chosen, scale, ways).reshape(count, 6)
            velocities[:, :3] += change[:, :3] * system.size
            velocities[:, 3:] += change[:, 3:]
            motion.evaluate(t, y)
        fastest = max(1.0, *(abs(rate) for rate in rates.values())) if rates else 1.0
        faults = []
        for name, rate in wanted.items():
            got = float(record.coordinates.rate[self._place[name]])
            if not abs(got - rate) <= MISSED * fastest * max(1.0, system.size):
                faults.append(Fault.at(name, f"the joints do not allow the rate {rate:.6g}: the nearest is {got:.6g}"))
        refuse(faults)

    def _in_run_coordinates(self, y: Array, reference: Array, states: Array) -> Array:
        """The state in the coordinates of the run. y : in absolute ones."""
        prepared, methods = self._prepared, self._methods
        absolute = self._motion.system
        arrange = methods.path.arrange
        rank = absolute.machine_rows - len(prepared.redundancy.redundant_rows)
        _, out = arrange(methods.machine, absolute, y, rank, methods.cut)
        out[len(out) - len(states) :] = states
        tree = prepared.motion.system.record.tree
        for (coordinate, place), (sign, offset) in zip(tree.counted.tolist(), tree.turn.tolist(), strict=True):
            # angles of the tree count turns, of which an assembled posture knows nothing
            turns = (sign * (reference[coordinate] - offset) - out[place]) / (2.0 * np.pi)
            out[place] += 2.0 * np.pi * np.round(turns)
        return out


def _absolute(system: System, posture: Mapping[str, Array], states: Array) -> Array:
    """The state in absolute coordinates."""
    q = np.hstack([posture["position"], posture["orientation"]])
    omega_b = np.einsum("bij,bi->bj", rotation_matrices(q[:, 3:]), posture["angular_velocity"])
    y = system.state(q.ravel(), posture["velocity"], omega_b)
    y[len(y) - len(states) :] = states
    return y
