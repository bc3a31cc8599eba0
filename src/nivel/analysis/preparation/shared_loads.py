"""Loads of redundant joints in frames, shared by least norm: of runs in relative and independent coordinates, and of equilibria.

Costs one evaluation of the constraints a frame, and nothing where no constraint is redundant.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.assembly.unique_reactions import leave_out, rows_everywhere
from nivel.analysis.preparation.preparation import Prepared
from nivel.integrate.loop.sink import Header, Sink
from nivel.kernels.core.arrays import copied
from nivel.lazy import dataclass, replace
from nivel.motion.shared_loads import share_loads
from nivel.results.motion import rotation_matrices
from nivel.system.system import Array

FROM_FRAME = ("position", "orientation", "velocity", "angular_velocity", "joint_coordinate")


@dataclass
class SharedLoads:
    """The equations in absolute coordinates, with a record of their own, and the state of a frame in them."""

    motion: MotionEquations
    y: Array

    @classmethod
    def of(cls, prepared: Prepared, *, keeps_sparse: bool = True) -> SharedLoads | None:
        """None where no reaction is open; and for flexible bodies and beams, whose stiffness decides how loads are shared.

        keeps_sparse : rows that repeat others everywhere are looked for, which takes as long as some hundred frames of a small machine.
        """
        of_run, machine = prepared.motion.system, prepared.machine
        if machine is None or not prepared.redundancy.redundant_rows:
            return None
        if machine.is_flexible or machine.beams or prepared.absolute.system.layout != of_run.layout:
            return None
        own = replace(prepared.absolute.system, record=copied(prepared.absolute.system.record))
        motion, y = MotionEquations(own, prepared.absolute.kernels), prepared.assembly.y.copy()
        if keeps_sparse and not own.units:  # these remember how often they are asked
            leave_out(own, rows_everywhere(motion, y, machine.simulation.duration))
        return cls(motion, y)

    def share(self, frames: NDArray[np.float64]) -> None:
        """Overwrite multipliers, reactions and efforts of frames (n, width)."""
        system, y = self.motion.system, self.y
        columns = {each.name: each.columns for each in system.layout.variables if each.name in FROM_FRAME}
        count, record = system.body_count, system.record
        q, v = y[: 7 * count].reshape(count, 7), y[7 * count : 13 * count].reshape(count, 6)
        address = self.motion.handle.address
        for frame in frames:
            place, theta, velocity, omega, coordinates = (frame[columns[name]] for name in FROM_FRAME)
            q[:, :3], q[:, 3:] = place.reshape(count, 3), theta.reshape(count, 4)
            v[:, :3] = velocity.reshape(count, 3)
            v[:, 3:] = np.einsum("bij,bi->bj", rotation_matrices(q[:, 3:]), omega.reshape(count, 3))
            record.coordinates.reference[record.joints.coordinate] = coordinates
            share_loads(address, float(frame[0]), y, frame)


@dataclass(frozen=True)
class SharingSink:
    """Other sinks behind shared loads."""

    loads: SharedLoads
    sinks: Sequence[Sink]

    def begin(self, header: Header) -> None:
        for sink in self.sinks:
            sink.begin(header)

    def take(self, frames: NDArray[np.float64]) -> None:
        self.loads.share(frames)
        for sink in self.sinks:
            sink.take(frames)


def are_open(prepared: Prepared) -> bool:
    """Whether frames of a run lack the loads of least norm, which those in absolute coordinates have already."""
    return bool(prepared.motion.system.tree_names or prepared.path.dependent)


def sharing(prepared: Prepared, sinks: Sequence[Sink]) -> Sequence[Sink]:
    """The sinks, behind shared loads where these are needed."""
    loads = SharedLoads.of(prepared) if are_open(prepared) else None
    return sinks if loads is None else (SharingSink(loads, sinks),)
