"""Gradients of analyses other than runs.

| analysis | slopes |
|---|---|
| statics | of an equilibrium F(z, p) = 0, z' = -F_z⁻¹ F_p with exact derivatives (implicit function theorem); of results by dual numbers |
| kinematics | the compiled loop over the positions on dual numbers, which Newton's corrections close with their slopes |
| inverse dynamics | the same, where actuators are in the place of the drivers |
| linear models | λ' = lᴴ A' r of an eigenvalue with the vectors lᴴ r = 1; A' by differences of order four of exact linear models |
| all else: buckling, margins, … | differences of order four of whole analyses, which are never green |
"""

from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Any

import numpy as np
import xarray

from nivel.analysis.gradients.check import REPEATED, Slope, check
from nivel.analysis.gradients.gradient import attributed, described
from nivel.analysis.gradients.outputs import Array, Parameter, outputs_of, parameters_of
from nivel.analysis.gradients.slopes import Lanes, Slopes, find_slopes, memory_of, seed, seeds_of, whole_of
from nivel.analysis.inverse.actuators import Actuation, actuation, driven_alone, drivers_replaced
from nivel.analysis.kinematics.run import FACTS, position_loop
from nivel.analysis.plan.compilation import build
from nivel.analysis.plan.settings import RunSettings, complete
from nivel.analysis.preparation.memory import MachineMemory
from nivel.analysis.preparation.preparation import Prepared
from nivel.analysis.progress.log import Listener
from nivel.analysis.statics.equations import Rest, StaticEquations
from nivel.analysis.statics.frames import FrameWriter
from nivel.analysis.statics.linear import PivotError, factors
from nivel.analysis.statics.run import begun, prepare_statics
from nivel.analysis.statics.states import Since, assembled
from nivel.analysis.sweep.outputs import OF_MODE, Found, history_of, number_of
from nivel.analysis.sweep.variant_runs import analysed
from nivel.errors import Fault, ModelError, NivelError, SolveError
from nivel.integrate.loop.sink import Header
from nivel.kernels.core.block import Handle
from nivel.kernels.core.status import OK
from nivel.kernels.output.observe import observe
from nivel.kernels.output.static_entries import accept_state
from nivel.kernels.record.hook import FAMILIES
from nivel.kernels.residual.tangent_entries import evaluate_residual
from nivel.lazy import nivel, replace
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.analyses import InverseSettings
from nivel.machine.study.parameter import SCALAR, Output, said_output
from nivel.model import Model
from nivel.native.duals import LANES, duals
from nivel.results.analyses.linear_model import LinearModel
from nivel.results.memory import Memory

# Parameters of machines beside are moved by this share of their scales, both ways, and twice as far.
STEP = 5e-4
# Eigenvalues that are nearer to each other than this share of their size bend away from each other, and have no slope where they meet.
CLOSE = 1e-3

# slopes (d,) for a change of each parameter by its scale, and their errors
SlopesOf = tuple[Array, Array]


def gradient(
    machine: Model,
    analysis: str,
    settings: Mapping[str, Any],
    labels: Sequence[str],
    paths: Sequence[str],
    *,
    checked: bool,
    listener: Listener | None = None,
) -> xarray.Dataset:
    """Derivatives of outputs of an analysis with respect to the numbers at `paths`: `nivel.api.Machine.gradient`.

    Raises ModelError where names or paths have no gradients, SolveError where the analysis fails.
    """
    of = _Analysed(machine, analysis, settings, parameters_of(machine, paths), listener or Listener())
    said = {label: said_output(label) for label in labels}
    numbers = {label: number_of(of.plain, output) for label, output in said.items()}
    of.listener.say("finding slopes")
    slopes = of.exact(labels)
    sure = {label for label in labels if label in slopes or _is_mode(of.plain, label)}
    slopes |= of.differences({label: output for label, output in said.items() if label not in slopes})
    lights = of.lights(said, slopes, sure) if checked else {label: ["not checked"] * len(paths) for label in labels}
    data = {}
    for label, (value, units, _) in numbers.items():
        data[label] = xarray.DataArray(value, attrs={"units": units, "long_name": label})
        for parameter, slope, error, light in zip(of.parameters, *slopes[label], lights[label], strict=True):
            name, attributes = described(label, parameter, units, error / parameter.scale, light)
            data[name] = xarray.DataArray(slope / parameter.scale, attrs=attributes)
    return attributed(data, machine.name)


class _Analysed:
    """A machine and an analysis of it. plain : what that finds."""

    def __init__(
        self,
        machine: Model,
        analysis: str,
        settings: Mapping[str, Any],
        parameters: Sequence[Parameter],
        listener: Listener,
    ) -> None:
        self.machine, self.analysis, self.parameters, self.listener = machine, analysis, parameters, listener
        self.settings = {**({"verify": False} if analysis in ("statics", "linearise") else {}), **settings}
        self.plain: Any = analysed(machine, analysis, self.settings)
        self.scale = np.array([each.scale for each in parameters])

    def beside(self, k: int, share: float) -> Found:
        """What it finds where a parameter has changed by a share of its scale."""
        parameter = self.parameters[k]
        other = self.machine.with_values({parameter.path: parameter.value + share * parameter.scale})
        return analysed(other, self.analysis, self.settings)

    def exact(self, labels: Sequence[str]) -> dict[str, SlopesOf]:
        """Slopes of the outputs that have exact ones, with their errors."""
        names, slopes = list(labels), None
        if self.analysis == "statics" and not self.settings.get("arc_length"):
            slopes = self._of_equilibria()
        elif self.analysis == "kinematics":
            slopes = self._of_positions(lambda each: each.record, self.settings)
        elif self.analysis == "inverse" and self.settings.get("motion") is None:
            asked = nivel.machine.settings.values.settings_of(InverseSettings, "inverse", self.settings)
            record, wanted = _driven(self.machine, asked)
            # where actuators are in the place of the drivers, they have their efforts
            if (drivers := drivers_replaced(record, wanted)) and not np.isfinite(wanted.limits).any():
                for actuator, driver in zip(self.plain.actuators, drivers, strict=True):
                    names = [name.replace(f"{actuator}.", f"driver.{driver}.") for name in names]
                slopes = self._of_positions(lambda each: _driven(each, asked)[0], {})
        out = {}
        for label, name in zip(labels, names, strict=True):
            try:
                found = None if slopes is None else slopes.evaluate(outputs_of([name], slopes.result)[0])
            except (ModelError, ValueError):  # of what other analyses call so, as buckling loads
                continue
            if found is not None and np.isfinite(found.slope).all():
                out[label] = found.slope.ravel() * self.scale, found.doubt.ravel() * self.scale
        return out

    def _of_positions(self, record_of: Callable[[Model], MachineRecord], settings: Mapping[str, Any]) -> Slopes:
        """Slopes of kinematics. record_of : the machine that is driven."""
        given = {**settings, "positions": len(self.plain.time)}

        def start(values: Mapping[str, float]) -> tuple[Prepared, RunSettings]:
            record = record_of(self.machine.with_values(dict(values)))
            _, methods, _ = nivel.analysis.kinematics.drive.planned(record, given, self.listener)
            prepared = nivel.analysis.run.prepared_state.prepare(methods)
            return replace(prepared, integrator=FACTS), complete(methods.machine.simulation, methods.coordinates)

        def beside(parameter: Parameter, value: float) -> MachineMemory:
            return memory_of(position_loop(*start({parameter.path: value})))

        prepared, steps = start({})
        header = Header(prepared.motion.system.layout, {"name": self.plain.name})
        loops = find_slopes(lambda _: position_loop(*start({})), steps, header, self.parameters, beside, self.listener)
        return loops[0]

    def _of_equilibria(self) -> Slopes | None:
        """Slopes of statics; None where an equilibrium does not follow from the equations at its place alone: states keep what they began
        with, or nothing resists a motion."""
        record = self.machine.record
        asked, _ = nivel.analysis.statics.free_coordinates.planned(record, self.settings, lambda fault: fault)
        walk, _ = begun(record, asked, Memory(), chosen_duration="duration" in self.settings)
        walk.go(Listener())
        if walk.outcome != "done":
            return None

        def memory(other: MachineRecord) -> MachineMemory:
            return MachineMemory(prepare_statics(other, walk.settings)[1].record)

        passes = []
        for first in range(0, len(self.parameters), LANES):
            fresh = prepare_statics(record, walk.settings)[1].record
            used = dict.fromkeys((*fresh.hooks.address, *fresh.elements.address))
            families = [FAMILIES[int(address)].whole for address in used if address]
            build([*families, evaluate_residual.whole, observe.whole, accept_state.whole], self.listener)
            twin = whole_of(fresh)
            chosen = self.parameters[first : first + LANES]
            seeds = seeds_of(
                MachineMemory(fresh),
                chosen,
                lambda each, value: memory(self.machine.with_values({each.path: value}).record),
            )
            seed(seeds, twin)
            own = _Whole(walk.equations, walk.writer, twin)
            try:
                frames = np.array([own.frame(*each) for each in walk.rests])
            except PivotError:
                return None
            passes.append(Lanes(frames, np.zeros((0, 3, 1 + LANES))))
        return Slopes(Header(walk.writer.layout, self.plain.attributes), self.parameters, passes, ())

    def differences(self, said: Mapping[str, Output]) -> dict[str, SlopesOf]:
        """Slopes of outputs for a change of each parameter by its scale, of order four, and what they may be off by."""
        out = {label: (np.zeros(len(self.parameters)), np.zeros(len(self.parameters))) for label in said}
        for k, parameter in enumerate(self.parameters if said else ()):
            try:
                found = [self.beside(k, share * STEP) for share in (-2.0, -1.0, 1.0, 2.0)]
                if isinstance(self.plain, LinearModel):
                    found = [_followed(self.plain, each) for each in found if isinstance(each, LinearModel)]
            except NivelError as error:
                raise ModelError(Fault.at(parameter.path, f"there is no gradient: {error}")) from None
            for label, output in said.items():
                a, b, c, d = (number_of(each, output).value for each in found)
                near, far = (c - b) / (2.0 * STEP), (d - a) / (4.0 * STEP)
                slope = (4.0 * near - far) / 3.0
                # of what two differences are apart, that of order four is the square
                bent = (far - near) ** 2 / max(abs(slope), 1e-300)
                out[label][0][k], out[label][1][k] = slope, bent + REPEATED * max(map(abs, (a, b, c, d))) / STEP
        return out

    def lights(
        self, said: Mapping[str, Output], slopes: Mapping[str, SlopesOf], sure: Collection[str]
    ) -> dict[str, list[str]]:
        """Of all slopes, by differences of six analyses for each parameter; those that are not sure are amber at best."""

        def moved(k: int, share: float) -> list[Array] | None:
            try:
                found = self.beside(k, share)
                return [np.array(number_of(found, each).value) for each in said.values()]
            except (ModelError, SolveError):
                return None

        known = [Slope(*slopes[label], _extent(self.plain, output)) for label, output in said.items()]
        found = zip(said, check(known, moved, None, [0.0] * len(self.parameters)), strict=True)
        return {
            label: ["amber" if light == "green" and label not in sure else light for light in each.lights]
            for label, each in found
        }


def _driven(machine: Model, asked: InverseSettings) -> tuple[MachineRecord, Actuation]:
    """The machine whose drivers do the work of actuators."""
    record = machine.record
    if asked.trajectory is not None:
        record = nivel.analysis.inverse.run.along_trajectory(record, asked.trajectory)
    wanted = actuation(record, asked)
    return driven_alone(record, wanted), wanted


class _Whole:
    """The equations of statics, and the record of their machine on dual numbers."""

    def __init__(self, equations: StaticEquations, writer: FrameWriter, record: Any) -> None:
        self._equations, self._writer, self._record = equations, writer, record
        self._address = Handle(record)

    def frame(self, state: Rest, reference: Array) -> Array:
        """(width, 1 + LANES) an equilibrium with its slopes. reference : angles that are followed. Raises PivotError."""
        equations, own, t = self._equations, self._record.residual, duals([state.t])
        n, first = equations.n, equations.first_state
        system = assembled(equations, state, Since.start(equations, state))
        if system.keeps:
            raise PivotError
        solve = factors(system.matrix).solve
        for lanes, values in ((own.y, state.y), (own.vdot, 0.0), (own.lam, state.lam)):
            lanes[:] = 0.0
            lanes["value"] = values
        self._record.coordinates.reference["value"] = reference
        if len(self._record.tree.node):
            self._record.tree.state[: equations.positions] = own.y[: equations.positions]
        for _ in range(2):  # the second solution takes away the round-off of the first one
            if evaluate_residual.whole(self._address.address, t) != OK:
                raise PivotError
            left = own.value["slopes"].copy()
            left[n : n + equations.state_count] *= -1.0
            change = np.zeros((len(left), LANES))
            change[system.chosen] = system.unit[:, None] * solve(-system.weight[:, None] * left[system.chosen])
            for lane in range(LANES):
                own.y["slopes"][: equations.positions, lane] += equations.position_rates(state.y, change[:n, lane])
            own.y["slopes"][first : first + equations.state_count] += change[n : n + equations.state_count]
            own.lam["slopes"] += change[n + equations.state_count :][: equations.rows]
        frame = self._writer.observed_on_duals(self._record, t)
        accept_state.whole(self._address.address, t)
        return frame


def _followed(plain: LinearModel, beside: LinearModel) -> LinearModel:
    """The model with the eigenvalues of a machine beside it, to first order: each is known by its vectors, not by its place."""
    if beside.states != plain.states or not beside.steady:
        raise ModelError("a small change of it changes the states of the linear model")
    change = np.einsum("ij,ij->j", plain.left.conj(), (beside.A - plain.A) @ plain.right)
    change[plain.structural] = 0.0
    return replace(plain, eigenvalues=plain.eigenvalues + change, sampled=beside.sampled)


def _is_mode(plain: Found, label: str) -> bool:
    """Whether an output is one of an eigenvalue that stands apart from others."""
    kind, _, rest = label.partition(".")
    if not isinstance(plain, LinearModel) or kind != "mode" or rest.rpartition(".")[2] not in OF_MODE:
        return False
    moving = [each.eigenvalue for each in plain.modes if not each.structural]
    own = moving[int(rest.rpartition(".")[0]) - 1 :][:1]
    return any(np.sum(np.abs(plain.eigenvalues - value) <= CLOSE * abs(value)) == 1 for value in own)


def _extent(plain: Found, output: Output) -> float:
    """The range of what an output is of; its magnitude where that has no history."""
    if isinstance(plain, LinearModel) or not (name := getattr(output, "of", "")) or SCALAR.fullmatch(name):
        return abs(number_of(plain, output).value)
    curve = history_of(plain, name).curve
    return float(np.ptp(curve.value)) * (float(np.ptp(curve.time)) if output.type == "integral" else 1.0)
