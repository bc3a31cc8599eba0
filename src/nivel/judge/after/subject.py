"""Subjects of the trust report: a result, and what the analysis that computed it knows beside."""

import json
from collections.abc import Mapping
from copy import copy
from functools import cached_property
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from nivel import known
from nivel.integrate.loop.run import MOVING
from nivel.judge.after.touching_pairs import Passing, find_passing
from nivel.lazy import Struct, field
from nivel.results.curve import probed
from nivel.results.motion import Peak, worst_row
from nivel.results.scales import Readable, largest_speed, machine_size, speed_of_rest
from nivel.results.trust import Item


class Scales(Struct):
    """What errors are compared with: size [m] and what it is, to be said after "the"; speed [m/s], the least one that counts where the
    machine is `at_rest`."""

    size: float
    size_kind: str
    speed: float = 1.0
    at_rest: bool = False


class Subject(Struct, kw_only=True):
    """An analysis. outcome : done, interrupted, failed or running. failure : what stopped it, in a sentence.

    items : lines of the other checks, for checks that are looked at last.
    """

    outcome: str
    failure: str = ""
    items: tuple[Item, ...] = ()

    def with_lines(self, items: tuple[Item, ...]) -> Self:
        """The same subject, with lines of other checks."""
        known = copy(self)
        object.__setattr__(known, "items", items)
        return known


class Recorded(Subject, kw_only=True):
    """An analysis whose result has frames."""

    result: Readable

    @cached_property
    def scales(self) -> Scales:
        """Size and speed of the machine."""
        raise NotImplementedError

    @cached_property
    def opening(self) -> tuple[Peak, str]:
        """The constraint row that is open most, and its units: m, rad or 1."""
        return worst_row(self.result, "constraint_violation", {"m": 1.0 / self.scales.size, "1": 1.0})


class Motion(Recorded, kw_only=True):
    """A run in time, of which the result alone is known where it was killed, or still goes on.

    stopped_by : name of the event that ended it. kinetic_energy : the largest one that its steps had [J]; frames may all meet a vibration
    where it is slow.
    """

    stopped_by: str = ""
    kinetic_energy: float = 0.0

    @cached_property
    def scales(self) -> Scales:
        size, kind = machine_size(self.result)
        speed, slowest = largest_speed(self.result), speed_of_rest(self.result, size)
        return Scales(size, kind, max(speed, slowest), speed < slowest)


class Computed(Struct, kw_only=True):
    """What analyses know that have just been made."""

    machine: known.MachineRecord
    prepared: known.Prepared


class Run(Motion, Computed, kw_only=True):
    """A run that has ended. second : the second run, and `estimate` what follows from it for each number; None where there are none.
    elements : the run with other elements of beams, or None."""

    result: known.Result
    plan: known.Plan
    finished: known.RunOutcome
    second: known.Verified | None = None
    estimate: known.Estimate | None = None
    elements: known.Compared | None = None

    @cached_property
    def assembly(self) -> Mapping[str, Any]:
        """What the assembly changed of what was given."""
        return json.loads(str(self.result.attributes.get("assembly", "{}")))

    @cached_property
    def passing(self) -> Passing:
        """Bodies that went through each other between two frames."""
        return find_passing(self.machine, self.result)

    @property
    def between_frames(self) -> Mapping[str, list[float]]:
        """By variable what its numbers were apart from their curves at times between frames, of `nivel.analysis.run.probes.Probes`."""
        return self.finished.between_frames

    @property
    def finer(self) -> known.Verified:
        """The second run, for checks that need one."""
        assert self.second is not None
        return self.second

    @property
    def pace(self) -> np.ndarray:
        """Of `nivel.integrate.loop.run.Run`."""
        assert self.finished.pace is not None
        return self.finished.pace


def run_of(plan: known.Plan, prepared: known.Prepared, finished: known.RunOutcome, result: known.Result) -> Run:
    """A run that has ended, without a second one."""
    return Run(
        result=result,
        outcome=finished.outcome,
        failure=finished.failure[0] if finished.failure is not None else "",
        stopped_by=finished.stopped_by,
        kinetic_energy=float(finished.pace[MOVING].max()) if finished.pace is not None else 0.0,
        machine=plan.machine,
        prepared=prepared,
        plan=plan,
        finished=finished,
    )


class Equilibria(Recorded, Computed, kw_only=True):
    """States of equilibrium. critical : (kind, t [s], None or the times [s] between which it is where it was not found) of limit and
    bifurcation points, along the path. at_rest : sentences on what makes no force at rest. rigid : vibrations of no frequency.
    free_motions : rigid ones of the whole machine, which nothing resists. without_potential : some force has none, as one that follows a
    body. elements : what was found with other elements of beams, or None."""

    critical: tuple[tuple[str, float, tuple[float, float] | None], ...] = ()
    at_rest: tuple[str, ...] = ()
    rigid: int = 0
    free_motions: int = 0
    without_potential: bool = False
    elements: known.Compared | None = None

    @cached_property
    def scales(self) -> Scales:
        return Scales(*machine_size(self.result), at_rest=True)


class Positions(Recorded, Computed, kw_only=True):
    """Positions of a kinematic analysis. halved : steps that were shortened on the way. near : the singular position that it came nearest
    to; None where there are no constraints. passed : pairs of times [s] between which one was passed. between_frames : of `Probes`."""

    halved: int = 0
    near: known.Singularity | None = None
    passed: tuple[tuple[float, float], ...] = ()
    between_frames: Mapping[str, list[float]] = field(default_factory=dict)

    @cached_property
    def scales(self) -> Scales:
        return Scales(*machine_size(self.result), max(largest_speed(self.result), 1e-300))

    @cached_property
    def joint_coordinates(self) -> dict[str, str]:
        """Names and units of the joint coordinates."""
        system = self.prepared.motion.system
        return dict(zip(system.layout.coordinates["joint_coordinate"], system.coordinate_units, strict=True))

    @property
    def drivers(self) -> tuple[known.Driver, ...]:
        """The drivers that the positions are to follow."""
        return self.machine.drivers


class Actuated(Subject, kw_only=True):
    """Efforts of actuators over the motion `result`. drivers : that the motion is to follow; replaced : those that another motion was
    given in place of."""

    result: known.Result
    efforts: known.Efforts
    drivers: tuple[known.Driver, ...]
    replaced: tuple[known.Driver, ...] = ()

    @property
    def between_frames(self) -> Mapping[str, list[float]]:
        """As of the analysis that made the motion."""
        return probed(self.result.attributes)

    @cached_property
    def scales(self) -> Scales:
        """Size of the machine."""
        return Scales(*machine_size(self.result))

    @cached_property
    def joint_coordinates(self) -> dict[str, str]:
        """Names and units of the joint coordinates of the motion."""
        names = self.result.coordinates.get("joint_coordinate_name", ())
        return {name: self.result.units(name) for name in names} if "joint_coordinate" in self.result.variables else {}


class Led(Subject, kw_only=True):
    """Postures that lead a point along a path."""

    path: known.JointPath


class Reach(Subject, kw_only=True):
    """The range of a joint coordinate. ways : trust reports of the kinematic analyses of both ways; turning : turning points of the
    coordinate on the curve of positions [rad or m], None where that could not be followed."""

    range: known.Range
    ways: tuple[known.Trust, ...]
    turning: tuple[float, ...] | None = None


class Curve(Subject, kw_only=True):
    """The curve of all positions of a machine. opening : how far its joints are open at most, as a share of their sizes."""

    curve: known.ConfigurationCurve
    opening: float


class OtherVibrations(Struct):
    """Eigenvalues (n,) [1/s] of the machine with other elements of its beams; none where `why` says what stopped it."""

    pair: known.Pair
    eigenvalues: NDArray[np.complex128]
    why: str = ""


class Linearisation(Subject, Computed, kw_only=True):
    """Linear equations about a state. eigenvalues (n,) [1/s] in ascending order of magnitude, not numbers where there are none to read;
    round_off (n,) [1/s] : to how much they are known.

    moves : whether the machine moves in this state; unsteady : why it is neither in equilibrium nor in a steady motion, in sentences.
    kinks : of the equations at the state. reached : the time [s] until which the machine was run to it, 0 where it was not.
    assembly : what it changed of what was given; empty after a run. size : of the machine [m]. others : the same of the machine with other
    elements of its beams, or None.
    """

    eigenvalues: NDArray[np.complex128]
    round_off: NDArray[np.float64]
    moves: bool = False
    unsteady: tuple[str, ...] = ()
    kinks: tuple[known.Kink, ...] = ()
    reached: float = 0.0
    assembly: Mapping[str, Any] = field(default_factory=dict)
    size: float = 1.0
    others: OtherVibrations | None = None

    @cached_property
    def scales(self) -> Scales:
        """Size of the machine."""
        return Scales(self.size, "machine's size")


class Variant(Struct):
    """A run of a sweep. name : its values, in words. outcome, reason, verdict, verified, headline : as the dataset has them."""

    name: str
    outcome: str
    reason: str
    verdict: str
    verified: bool
    headline: str


class Sweep(Subject, kw_only=True):
    """Runs, or linear models, of one machine with other values. by : what verifies them; without : that nothing did, in words."""

    variants: tuple[Variant, ...]
    by: str = "second runs"
    without: str = "no second runs were made"


class Methods(Subject, kw_only=True):
    """A comparison of methods: what their motions were held against, and the runs."""

    references: tuple[known.Reference, ...]
    rows: tuple[known.Row, ...]
