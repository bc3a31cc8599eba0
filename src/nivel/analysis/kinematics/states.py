"""States and accelerations in absolute coordinates from the frames of a result."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from nivel.errors import ModelError
from nivel.results.motion import rotation_matrices
from nivel.results.result import Result
from nivel.system.system import Array, System


@dataclass(frozen=True)
class MovingState:
    """time [s], the state y, the accelerations v̇ (n,) of the bodies, and all joint coordinates; none where the motion has other ones."""

    time: float
    y: Array
    vdot: Array
    coordinates: Array


def moving_states(system: System, result: Result, every: int = 1) -> Iterator[MovingState]:
    """Every so many frames of a result of a machine with the same bodies. Raises ModelError where bodies differ."""
    names = list(result.coordinates.get("body", ()))
    if names != list(system.bodies):
        raise ModelError(f"the motion has the bodies {', '.join(names)}, the machine {', '.join(system.bodies)}")
    missing = [name for name in ("acceleration", "angular_acceleration", "velocity") if name not in result.variables]
    if missing:
        raise ModelError(f"the motion has no {', '.join(missing)}: give a result of a run or of kinematics")
    some = slice(None, None, every)
    position, orientation = result.array("position")[some], result.array("orientation")[some]
    rates = [
        result.array(name)[some] for name in ("velocity", "angular_velocity", "acceleration", "angular_acceleration")
    ]
    states = [
        result.array(f"state.{fact.name}")[some] if f"state.{fact.name}" in result.variables else None
        for fact in system.states
    ]
    known = list(result.coordinates.get("joint_coordinate_name", ())) == list(
        system.layout.coordinates["joint_coordinate"]
    )
    measured = known and "joint_coordinate" in result.variables
    angles = result.array("joint_coordinate")[some] if measured else np.zeros((len(position), 0))
    for k, time in enumerate(result.time[some]):
        A = rotation_matrices(orientation[k])
        velocity, omega, acceleration, alpha = (each[k] for each in rates)
        local = [np.einsum("bij,bi->bj", A, each) for each in (omega, alpha)]
        q = np.hstack([position[k], orientation[k]]).ravel()
        y = system.state(q, velocity, local[0])
        first = len(y) - len(system.start_of_states)
        for j, values in enumerate(states):
            if values is not None:
                y[first + j] = values[k]
        yield MovingState(float(time), y, np.hstack([acceleration, local[1]]).ravel(), angles[k])
