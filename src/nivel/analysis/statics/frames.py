"""Frames of a statics result: those of a run, without what is always zero at rest, and with what only statics knows."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from nivel.analysis.preparation.preparation import SharedLoads
from nivel.analysis.statics.equations import Rest, StaticEquations
from nivel.analysis.statics.linear import Vibrations
from nivel.kernels.core.block import Handle
from nivel.kernels.output.observe import observe
from nivel.kernels.residual.tangent_entries import evaluate_residual
from nivel.lazy import Struct
from nivel.motion.catalogue import IMPLICIT_ACCELERATIONS
from nivel.native.duals import LANES, duals
from nivel.system.layout import Entry, FrameLayout, Variable, laid_out
from nivel.system.system import Array

MOVING = frozenset(
    {
        "velocity", "angular_velocity", "acceleration", "angular_acceleration", "joint_rate", "constraint_rate_violation",
        "kinetic_energy", "external_work", "dissipated_energy", "energy_error", "modal_rate", "modal_acceleration",
    }
)  # fmt: skip
RATES = (".rate", ".power")
ELEMENTS = ("force.", "driver.", "coupling.")

# name, dimensions, units, long name of what comes behind
OWN: tuple[Entry, ...] = (
    ("path", ("time",), "s", "place along the path of equilibria: ascending also where time turns back"),
    (
        "residual",
        ("time",),
        "1",
        "largest unbalanced force, over the largest load of the state; or rest of the rate of a state",
    ),
    ("residual_round_off", ("time",), "1", "what round-off of the positions makes of the stiffest forces, likewise"),
    (
        "unstable_directions",
        ("time",),
        "1",
        "directions of negative stiffness; 0: stable where all loads have a potential",
    ),
    ("iterations", ("time",), "1", "iterations of Newton's method"),
)
VIBRATION: tuple[Entry, ...] = (
    ("vibration_stiffness", ("time", "vibration"), "1/s^2", "square of the natural angular frequency; negative: unstable"),
    ("natural_frequency", ("time", "vibration"), "Hz", "undamped natural frequency; not a number: unstable"),
    ("damped_frequency", ("time", "vibration"), "Hz", "frequency of the damped vibration; ordered by their magnitudes on their own"),
    ("decay_rate", ("time", "vibration"), "1/s", "rate at which the damped vibration dies away"),
    ("mode_shift", ("time", "vibration", "body", "xyz"), "kg^-0.5", "displacement of the body frame, unit modal mass"),
    ("mode_turn", ("time", "vibration", "body", "xyz"), "kg^-0.5/m", "small rotation of the body, unit modal mass, global axes"),
)  # fmt: skip
BENDING = (
    "mode_bending",
    ("time", "vibration", "mode"),
    "m",
    "modal coordinates of flexible bodies in the vibration, unit modal mass",
)


class Facts(Struct):
    """What a frame says beside the state. vibrations : None where none were asked for."""

    path: float
    residual: float
    round_off: float
    unstable: int
    iterations: int
    vibrations: Vibrations | None


class FrameWriter:
    """Frames of the equilibria of a machine; modes : number of vibrations in each. loads : what shares those of redundant joints."""

    def __init__(self, equations: StaticEquations, modes: int, loads: SharedLoads | None = None) -> None:
        self.equations, self.modes, self._loads = equations, modes, loads
        self._full = equations.system.layout
        kept = [variable for variable in self._full.variables if not _is_of_motion(variable.name)]
        self._columns = np.array([k for each in kept for k in range(each.columns.start, each.columns.stop)], dtype=int)
        self._bending = len(self._full.coordinates.get("mode", ()))
        self.layout = _layout(self._full, kept, modes)

    def frame(self, state: Rest, facts: Facts) -> Array:
        """The frame (1, width) of an equilibrium."""
        full = self._observed(state, np.zeros(self.equations.n))
        full[0] = state.t
        if self._loads is not None:
            self._loads.share(full[None])
        own = [facts.path, facts.residual, facts.round_off, float(facts.unstable), float(facts.iterations)]
        out = np.concatenate([[state.t], full[self._columns], own])
        if self.modes:
            out = np.concatenate([out, self._vibrating(state, facts.vibrations)])
        return out[None]

    def rates(self, state: Rest, directions: Array) -> Array:
        """(k, n) rates of all joint coordinates in motions (k, f) without units; angles per radian, ways per length of the machine."""
        equations = self.equations
        columns = next(each.columns for each in self._full.variables if each.name == "joint_rate")
        found = np.zeros((len(directions), columns.stop - columns.start))
        for k, direction in enumerate(directions):
            velocity = np.zeros(equations.n)
            velocity[equations.free] = direction * equations.length[equations.free]
            found[k] = self._observed(state, velocity)[columns]
        lengths = np.array([each == "m" for each in equations.system.coordinate_units], dtype=bool)
        found[:, lengths] /= equations.system.size
        return found

    def _observed(self, state: Rest, velocity: Array) -> Array:
        """A frame of a machine in this state without accelerations, moving at this velocity (n,).

        Reactions follow from the multipliers, so the wrenches of the bodies are those of the forces alone; but those of machines whose
        accelerations are found by the residual follow from what this transmits, multipliers included.
        """
        equations = self.equations
        record, address = equations.record, equations.motion.handle.address
        equations.evaluate(state, state.lam if self.by_residual else np.zeros(equations.rows))
        if np.any(velocity):
            equations.residual.y[equations.positions : equations.positions + equations.n] = velocity
            evaluate_residual(address, state.t)
        make_still(record, state.lam)
        frame = np.zeros(self._full.width)
        observe(address, state.t, equations.residual.y, frame)
        return frame

    @property
    def by_residual(self) -> bool:
        """Whether accelerations are found by the residual."""
        return self.equations.motion.kernels.__name__ == IMPLICIT_ACCELERATIONS

    def observed_on_duals(self, record: Any, t: Any) -> Array:
        """(width, 1 + LANES) the numbers of a frame of the machine's record on dual numbers, which has the residual at a state, with
        its multipliers, time t a dual number; not a number what stands behind those of a run, and that along no parameter."""
        own, handle = record.residual, Handle(record)
        lam = own.lam.copy()
        if not self.by_residual:
            own.lam[:] = 0.0
        evaluate_residual.whole(handle.address, t)
        make_still(record, lam)
        full = duals(np.zeros(self._full.width))
        observe.whole(handle.address, t, own.y, full)
        own.lam[:] = lam
        found = full.view(np.float64).reshape(-1, 1 + LANES)[self._columns]
        out = np.full((self.layout.width, 1 + LANES), np.nan)
        out[: 1 + len(found)] = np.concatenate([t.view(np.float64).reshape(1, -1), found])
        return out

    def _vibrating(self, state: Rest, found: Vibrations | None) -> Array:
        bodies = len(self._full.coordinates["body"])
        if found is None:
            return np.full((4 + 6 * bodies + self._bending) * self.modes, np.nan)
        place = {variable.name: variable.columns for variable in self._full.variables}
        shifts, turns = np.full((2, self.modes, 3 * bodies), np.nan)
        bending = np.full((self.modes, self._bending), np.nan)
        equations = self.equations
        for k in range(self.modes):
            if np.isfinite(found.shapes[:, k]).all():
                velocity = np.zeros(equations.n)
                # without units: unit mass is e s² over it
                velocity[equations.free] = found.shapes[:, k] * equations.length[equations.free]
                frame = self._observed(state, velocity / np.sqrt(equations.energy))
                shifts[k], turns[k] = frame[place["velocity"]], frame[place["angular_velocity"]]
                if self._bending:
                    bending[k] = frame[place["modal_rate"]]
        with np.errstate(invalid="ignore"):
            frequency = np.sqrt(found.squares) / (2.0 * np.pi)
        damped = found.rates.imag / (2.0 * np.pi), -found.rates.real
        return np.concatenate([found.squares, frequency, *damped, shifts.ravel(), turns.ravel(), bending.ravel()])


def make_still(record: Any, lam: Any) -> None:
    """What is observed next has these multipliers of the residual, and no accelerations."""
    record.constraints.lam[:] = 0.0
    record.constraints.lam[record.residual.row] = lam
    record.friction.force[:] = 0.0
    for still in (record.bodies.Rddot, record.bodies.alpha_b, record.tree.delta, record.tree.alpha0):
        still[:] = 0.0
    record.tree.Rddot0[:] = 0.0


def _is_of_motion(name: str) -> bool:
    return name in MOVING or (name.startswith(ELEMENTS) and name.endswith(RATES))


def _layout(full: FrameLayout, kept: Sequence[Variable], modes: int) -> FrameLayout:
    coordinates = dict(full.coordinates)
    entries = [(each.name, each.dims, each.units, each.long_name) for each in kept]
    entries += OWN
    if modes:
        coordinates["vibration"] = tuple(f"vibration_{k + 1}" for k in range(modes))
        entries += [*VIBRATION, BENDING] if "mode" in coordinates else VIBRATION
    return laid_out(entries, coordinates)
