"""Python interface: load a machine, check it, run it."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import replace
from functools import cached_property, partial
from math import pi
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Unpack, overload

from nivel.analysis.progress.log import Listener
from nivel.errors import Fault, ModelError, refuse, retold
from nivel.files.reader import Origin, parse_machine, read_text
from nivel.files.values import outside_paths
from nivel.lazy import nivel, numpy, xarray
from nivel.machine.machine_record import MachineRecord
from nivel.machine.uses.references import SECTIONS
from nivel.methods import Analysis
from nivel.model import Model
from nivel.settings import (
    CompareSettingsDict,
    InverseSettingsDict,
    KinematicsSettingsDict,
    LineariseSettingsDict,
    MachineSweepSettingsDict,
    RunSettingsDict,
    StaticsSettingsDict,
    StepSettingsDict,
    SweepSettingsDict,
)
from nivel.words.arguments import checked_arguments, checked_methods
from nivel.words.wording import shown

if TYPE_CHECKING:
    from nivel.analysis.assembly.assemble import MassProperties
    from nivel.analysis.interactive.posing import Posing
    from nivel.analysis.inverse.mechanics import Mechanics
    from nivel.analysis.optimise.evaluations import Exact
    from nivel.analysis.optimise.identify import Identified
    from nivel.analysis.optimise.optimise import Optimum
    from nivel.analysis.plan.plan import Plan
    from nivel.analysis.run.many import Simulations
    from nivel.analysis.run.stepping import Simulation
    from nivel.c_library.writer import Files
    from nivel.fmu.writer import Unit
    from nivel.judge.before.check import Check
    from nivel.machine.settings.sweep import SweepSettings
    from nivel.methods import StaticCoordinates
    from nivel.native.entry import Entry
    from nivel.results.analyses.efforts import Efforts, JointPath
    from nivel.results.analyses.linear_model import LinearModel
    from nivel.results.analyses.mechanism import ConfigurationCurve, Range
    from nivel.results.comparison import Comparison
    from nivel.results.result import Result
    from nivel.view.sources import PosedMachine
else:  # other words are refused by those who read settings, with the nearest one
    StaticCoordinates = str


@checked_methods
class Machine(Model):
    """A machine: its elements by name, copies of it with other values, and what can be asked of it.

    Made from records (everything in SI units, or texts with units), or with `nivel.load` from a file::

        arm = nivel.Body(name="arm", mass=2.0, inertia=(0.01, 0.2, 0.2), position=(0.5, 0, 0))
        pin = nivel.Joint(name="pin", type="revolute", bodies=("ground", "arm"), point=(0, 0, 0), axis=(0, 0, 1))
        machine = nivel.Machine("pendulum", bodies=[arm], joints=[pin], gravity=(0, -9.81, 0))
        machine.bodies["arm"].mass  # 2.0
        heavier = machine.with_values({"bodies.arm.mass": "4 kg"})

    Raises ModelError with everything that is wrong.
    """

    @checked_arguments
    def __init__(
        self,
        name: str = "machine",
        *,
        bodies: Sequence[nivel.Body] = (),
        beams: Sequence[nivel.Beam] = (),
        markers: Sequence[nivel.Marker] = (),
        joints: Sequence[nivel.Joint] = (),
        couplings: Sequence[nivel.elements.joints.couplings.Coupling] = (),
        drivers: Sequence[nivel.Driver] = (),
        forces: Sequence[nivel.elements.forces.Force] = (),
        fluids: Sequence[nivel.elements.circuits.fluids.AnyFluid] = (),
        hydraulics: Sequence[nivel.elements.circuits.HydraulicComponent] = (),
        inputs: Sequence[nivel.Input] = (),
        states: Sequence[nivel.State] = (),
        control: Sequence[nivel.Block] = (),
        sensors: Sequence[nivel.Sensor] = (),
        events: Sequence[nivel.Event] = (),
        gravity: Sequence[float | str] = (0.0, 0.0, 0.0),
        assembly: nivel.AssemblySettings | Mapping[str, Any] | None = None,
        simulation: nivel.SimulationSettings | Mapping[str, Any] | None = None,
        description: str = "",
        surroundings: Sequence[Any] = (),
        left_out: Sequence[str] = (),
    ) -> None:
        given: dict[str, Any] = {word: each for word, each in locals().items() if word != "self" and each is not None}
        given |= {word: tuple(given[word]) for word in (*SECTIONS, "surroundings", "left_out")}
        self.record = MachineRecord(**given)
        self.origin = Origin()

    def check(self, *, listener: Listener | None = None) -> Check:
        """Assemble the machine and say what it is: degrees of freedom, redundant rows, conventions of its joints."""
        plan = self._plan(self.origin.settings_outside)
        with self._compiled(nivel.analysis.plan.compilation.preparation_entries(plan.methods), listener):
            place = partial(nivel.system.joint_frames.as_placed, self.record)
            ropes = nivel.judge.before.unusual.stretched_ropes(self.record, place)
            remarks = (*self.remarks, *(self.origin.placed(finding.fault) for finding in ropes))
            return replace(
                nivel.judge.before.check.check(plan), name_notes=self.name_notes, remarks=tuple(map(str, remarks))
            )

    def mass_properties(
        self, about: str = "ground", bodies: Sequence[str] | str = (), *, listener: Listener | None = None
    ) -> MassProperties:
        """Mass, centre of mass and inertia of these bodies, or of all, as assembled, about a marker or body and along its axes."""
        with self._assembled(listener):
            return nivel.analysis.assembly.assemble.mass_properties(self.record, about, tuple(_names(bodies)))

    def posed(self, *, listener: Listener | None = None) -> Posing:
        """The assembled machine, to be moved by hand. Raises ModelError where it cannot be assembled."""
        with self._assembled(listener):
            return nivel.analysis.interactive.posing.Posing(self.record)

    def view(self, *, port: int = 0, browser: bool = True) -> None:
        """Show the assembled machine in a browser, with a slider for each joint that can move; returns after Ctrl-C."""
        nivel.view.server.serve(self.viewer_source(), host="127.0.0.1", port=port, browser=browser, say=print)

    def viewer_source(self, *, listener: Listener | None = None) -> PosedMachine:
        """What the viewer shows of the machine before any run."""
        posed = self.posed(listener=listener)
        return nivel.view.sources.PosedMachine(
            self.name, posed, self.record.model_dump(mode="json", by_alias=True, exclude_none=True)
        )

    def simulate(
        self,
        *,
        inputs: Mapping[str, float | str | PathLike[str] | nivel.Table] | None = None,
        out: str | PathLike[str] | None = None,
        force: bool = False,
        verify: bool = True,
        verify_limit: float | str | None = None,
        sensitivities: Sequence[str] | str = (),
        listener: Listener | None = None,
        **settings: Unpack[RunSettingsDict],
    ) -> Result:
        """Motion in time. Settings given here override those of the machine's `simulation`, and are what they are there.

        inputs : what inputs of the machine follow in this run: a number, a `Table` of time, or a file of columns `time`, `value` (CSV).
        out : result file (NetCDF); in memory if None. force : replace an existing file. verify : a second run
        beside this one, with finer steps on other times, tells how exact every number is, as with `nivel run`; without it the result says
        that it is not verified. verify_limit [s] : the second run goes on for so long after the first at most, by default for
        three times the work of the first. sensitivities : numbers of the machine by path, as of `gradient`; the result then has curves
        ``"d(crank.angle)/d(bodies.rod.mass)"`` of everything, and its file is written when they are found.
        A setting given here that has no effect with the methods of the run is refused; set in the file, it is ignored.
        Raises ModelError (nothing was computed) or SolveError (its `result` holds everything up to the failure).
        """
        given = _given(settings)
        limit = (
            None if verify_limit is None else nivel.analysis.plan.settings.waiting_time("verify_limit", verify_limit)
        )
        chosen = self.with_inputs(inputs or {}).with_settings(given)
        plan = chosen._plan({*given, *self.origin.settings_outside})
        self._refuse_target(out, force)
        compile_seconds = nivel.analysis.plan.compilation.build(_entries_of(plan, chosen.record), listener)
        # what follows takes longer to import
        paths = _names(sensitivities)
        with retold(chosen.origin.placed):
            if paths:
                nivel.analysis.gradients.gradient.check_parameters(chosen, plan, paths)
            result = nivel.analysis.run.simulate.simulate(
                plan,
                source=self.origin.source,
                out=None if paths else out,
                force=force,
                verify=verify,
                verify_limit=limit,
                listener=listener,
                compile_seconds=compile_seconds,
            )
            if not paths:
                return result
            source = self.origin.source
            whole = nivel.analysis.gradients.gradient.with_sensitivities(
                chosen, plan, result, paths, source=source, checked=verify, listener=listener
            )
        return whole if out is None else open_result(whole.save(out, force=force))

    def export_mjcf(self, path: str | PathLike[str], *, force: bool = False) -> tuple[str, ...]:
        """Write the rigid part of the machine as a model of MuJoCo, with its meshes in a folder beside `path`.

        Returns the list of what has another form there, and of what was left out. Raises ModelError where bodies or joints cannot be
        written, and where `path` exists and `force` is false.
        """
        return self._write_model(nivel.exchange.robot_writers.mjcf, Path(fspath(path)), "MJCF file", force)

    def export_urdf(self, path: str | PathLike[str], *, force: bool = False) -> tuple[str, ...]:
        """Write the tree of the machine's rigid bodies as a URDF, with its meshes in a folder beside `path`.

        Returns the list of what has another form there, and of what was left out. Raises ModelError where bodies or joints cannot be
        written, and where `path` exists and `force` is false.
        """
        return self._write_model(nivel.exchange.robot_writers.urdf, Path(fspath(path)), "URDF", force)

    def _write_model(
        self,
        written: Callable[[MachineRecord, str], tuple[str, dict[str, bytes], list[str]]],
        path: Path,
        what: str,
        force: bool,
    ) -> tuple[str, ...]:
        nivel.files.target.check_target(path, what, force=force, sources=self.origin.files)
        with retold(self.origin.placed):
            text, meshes, notes = written(self.record, f"{path.stem}-meshes")
        for name, content in meshes.items():
            mesh = path.parent / name
            mesh.parent.mkdir(exist_ok=True)
            nivel.files.target.check_target(mesh, "mesh", force=force)
            nivel.files.target.write_file(mesh, "mesh", content)
        nivel.files.target.write_file(path, what, text)
        return tuple(notes)

    def export_c(
        self,
        folder: str | PathLike[str],
        *,
        select: Sequence[str] | str = (),
        platform: str = "",
        listener: Listener | None = None,
    ) -> Files:
        """Write the machine as a C library: what a run with its settings does step by step, for programs without Python.

        folder : a new one, for header, source, machine code, an example and a Makefile. select : names of outputs, as of columns of a
        table; by default sensors, joint coordinates with their rates, and inputs; "*" : every number of a frame. platform : the system
        that it is for, as in `export_fmu`; by default this one.
        Raises ModelError where steps are not fixed, a Python law takes part, or the folder is there already.
        """
        plan = self._plan({}, stepwise=True)
        with self._compiled(nivel.analysis.plan.compilation.run_entries(plan), listener):
            return nivel.c_library.writer.write_c_library(plan, Path(folder), _names(select), platform)

    def export_fmu(
        self,
        path: str | PathLike[str],
        *,
        fmi: int = 3,
        select: Sequence[str] | str = (),
        parameters: Sequence[str] | str = (),
        platforms: Sequence[str] | str = (),
        force: bool = False,
        listener: Listener | None = None,
    ) -> Unit:
        """Write the machine as an FMU for co-simulation: what a run with its settings does, for other simulation programs.

        fmi : version of the standard, 3 or 2. select : outputs, as in `export_c`. parameters : numbers of the machine by path that can be
        set before the unit starts, as "bodies.crank.mass" or "parameters.load". platforms : "x86_64-linux", "x86_64-windows",
        "aarch64-linux"; by default this one. force : replace an existing file.
        Raises ModelError where steps are not fixed, a Python law takes part, a compiler is missing, or a parameter changes more than
        numbers that follow from it by a formula, such as the assembly.
        """
        chosen, paths = _names(select), _names(parameters)
        if fmi not in nivel.fmu.writer.VERSIONS:
            raise ModelError(Fault.at("fmi", f"the version of FMI is 3 or 2, got {shown(fmi)}"))
        self._refuse_target(path, force)
        given = nivel.analysis.gradients.outputs.parameters_of(self, paths, "an FMU") if paths else ()
        plan = self._plan({}, stepwise=True)
        with self._compiled(nivel.analysis.plan.compilation.run_entries(plan), listener):
            nominal = nivel.c_library.exported.export(plan, "an FMU", chosen)
            # with other values it keeps its method, which may follow from them
            same = self.with_settings({"integrator": nominal.plan.settings.integrator}) if given else self
            return nivel.fmu.writer.write_unit(
                nominal,
                Path(fspath(path)),
                version=fmi,
                platforms=_names(platforms),
                parameters=given,
                vary=lambda changes: nivel.c_library.exported.export(
                    same.with_values(changes)._plan({}, stepwise=True), "an FMU", chosen
                ),
            )

    @overload
    def start(
        self, *, record: bool = False, listener: Listener | None = None, **settings: Unpack[StepSettingsDict]
    ) -> Simulation: ...

    @overload
    def start(
        self,
        *,
        n: int,
        values: Mapping[str, Any] | None = None,
        lanes: bool | None = None,
        listener: Listener | None = None,
        **settings: Unpack[StepSettingsDict],
    ) -> Simulations: ...

    def gradient(
        self,
        outputs: Sequence[str] | str,
        parameters: Sequence[str] | str,
        *,
        check: bool = True,
        analysis: Analysis = "run",
        analysis_settings: Mapping[str, Any] | None = None,
        listener: Listener | None = None,
        **settings: Unpack[RunSettingsDict],
    ) -> xarray.Dataset:
        """Derivatives of what a run, or another analysis, computes with respect to numbers of the machine, exact to round-off.

        outputs : names of the result, at the end of the run, ``"crank.angle"``; or ``"crank.angle at 0.5 s"``, ``"max(crank.angle)"``,
        `min`, `rms`, `mean`, `integral`; ``"time(lift)"``, when an event came. parameters : paths of numbers, as of `sweep`,
        ``"bodies.rod.mass"``. check : compare each with differences of six runs; settings : as of `simulate`. analysis : `run`, or
        `statics`, `kinematics`, `linearise` or `inverse` with their `analysis_settings`, and outputs as of `optimise`, each one number.

        The dataset has the outputs, and their slopes as ``"d(crank.angle)/d(bodies.rod.mass)"``, with `units`, `estimated_error` and
        `verdict`: green, amber where the differences do not confirm a slope, red where they contradict it. Its attributes have the worst
        verdict and its `headline`. The compiled code runs on dual numbers, seven parameters at a time; that is compiled on first use.
        Raises ModelError where names, paths or methods have no gradients, SolveError where a run fails.
        """
        if analysis != "run":
            chosen = self._searched(settings, listener, analysis)
            with retold(chosen.origin.placed):
                return nivel.analysis.gradients.analyses.gradient(
                    chosen,
                    analysis,
                    analysis_settings or {},
                    _names(outputs),
                    _names(parameters),
                    checked=check,
                    listener=listener,
                )
        chosen, plan = self._ready(settings, listener)
        with retold(chosen.origin.placed):  # what follows takes longer to import
            return nivel.analysis.gradients.gradient.gradient(
                chosen,
                plan,
                _names(outputs),
                _names(parameters),
                checked=check,
                source=self.origin.source,
                listener=listener,
            )

    def start(
        self,
        *,
        n: int | None = None,
        values: Mapping[str, Any] | None = None,
        lanes: bool | None = None,
        record: bool = False,
        listener: Listener | None = None,
        **settings: Unpack[StepSettingsDict],
    ) -> Simulation | Simulations:
        """The machine ready to move step by step: ``sim.step()``, ``sim["hinge.angle"]``, ``sim.state``.

        Settings override those of the machine's `simulation`, as in `simulate`. The time has no end; steps are fixed.
        record : keep a frame every `output_interval`, for ``sim.result()``. n : so many copies, which one call steps:
        ``sims.step({"push": forces})``, ``sims["hinge.angle"]`` (n,); values : lists of n values by path, other numbers of each copy;
        lanes : whether several go by each step, by machine code that is compiled in about a minute, once; None : where there is some.
        Raises ModelError.
        """
        chosen, plan = self._ready(settings, listener, stepwise=True)
        if n is None:
            if values:
                raise ModelError(Fault.at("values", "lists of values make several copies: say how many, n=3"))
            if lanes:
                raise ModelError(Fault.at("lanes", "several copies go in lanes: say how many, n=8"))
            with retold(chosen.origin.placed):
                return nivel.analysis.run.stepping.Simulation(plan, source=self.origin.source, record=record)
        if n < 1 or record:
            message = "copies keep no frames" if record else f"a number of copies of at least 1 was expected, got {n}"
            raise ModelError(Fault.at("record" if record else "n", message))
        plans = [plan] * n
        if values:
            rows = nivel.analysis.sweep.variants.rows_of(values)
            if len(rows) != n:
                raise ModelError(Fault.at("values", f"lists of {n} values are needed; there are {len(rows)}"))
            machines = [chosen.with_values(row) for row in rows]
            plans = [each._plan(each.origin.settings_outside, stepwise=True) for each in machines]
        with retold(chosen.origin.placed):
            return nivel.analysis.run.many.Simulations(plans, source=self.origin.source, lanes=lanes, listener=listener)

    def sweep(
        self,
        values: Mapping[str, Any],
        *,
        listener: Listener | None = None,
        **settings: Unpack[MachineSweepSettingsDict],
    ) -> xarray.Dataset:
        """Run the machine with other values, on all processors, into one xarray dataset.

        values : lists by path, ``{"bodies.rod.mass": [1, 2, 3], "parameters.length": ["20 cm", "30 cm"]}``. combine : `grid`, every value
        with every other, one dimension each; or `rows`, the first of all lists, the second of all, along the dimension `variant`.
        samples : so many variants of a Latin hypercube between two bounds, ``{"bodies.rod.mass": (1, 3)}``, or over distributions of
        `scipy.stats`; seed : of its random numbers. save : names of results; default all joint coordinates and sensors.
        processes : as many as there are processors by default. verify : a second run beside each variant tells how exact it is; without
        it the dataset says that it is not verified. All other settings are those of `simulate`, for all variants.

        A variant that fails or is refused has its `reason` in the dataset, and NaN where nothing was computed. `outcome`, `end_time`,
        `verdict`, `verified`, `headline` and `estimated_error` [m] stand there for every variant; attributes have the verdict on all of
        them. Ctrl-C ends the sweep; what was computed is returned.
        Raises ModelError where values or names are not known, or no variant can be run.
        """
        given = _given(settings)
        record = nivel.machine.settings.sweep.SweepSettings
        own = {name: given.pop(name) for name in record.model_fields if name in given}
        return _sweep([self.with_settings(given)], values, record(**own), listener)

    def batch(
        self,
        values: Mapping[str, Sequence[Any] | Any],
        *,
        save: Sequence[str] | str = (),
        threads: int | None = None,
        listener: Listener | None = None,
        **settings: Unpack[RunSettingsDict],
    ) -> xarray.Dataset:
        """Run many variants in one call, without trust reports: for optimisation, learning and sampling.

        values : lists of equal length by path, ``{"bodies.rod.mass": masses, "forces.load.stiffness": stiffnesses}``; the first of all
        lists make the first variant. save : names of results; default all joint coordinates and sensors. threads : as many as there are
        processors by default. settings : of all runs, as in `simulate`.

        Where numbers of the machine follow from the values by formulas (masses, stiffnesses, loads and the like; fixed steps of an
        explicit integrator), the machine is prepared once and its numbers are patched, so that a variant costs little more than its
        steps; else every variant is prepared: the attribute `prepared_because` says why. Nothing tells how exact the runs are;
        `sweep` does. Raises ModelError where values or names are not known, or no variant can be run.
        """
        given = _given(settings)
        chosen, rows = self.with_settings(given), nivel.analysis.sweep.variants.rows_of(values)
        plan = chosen.with_values(rows[0])._plan({*given, *self.origin.settings_outside})
        nivel.analysis.plan.compilation.build(_entries_of(plan, chosen.record), listener)
        return nivel.analysis.sweep.sweep.run_batch(
            chosen, rows, tuple(_names(save)), threads=threads, listener=listener or Listener()
        )

    def optimise(
        self,
        objective: str | Callable[..., float],
        parameters: Mapping[str, Sequence[Any]],
        *,
        maximise: bool = False,
        outputs: Mapping[str, str | Callable[..., float]] | None = None,
        limits: Mapping[str, Sequence[float | None]] | None = None,
        method: str = "SLSQP",
        starts: int = 1,
        seed: int = 0,
        iterations: int = 200,
        accuracy: float = 1e-8,
        exact_slopes: bool = False,
        time_limit: float | None = None,
        threads: int | None = None,
        analysis: Analysis = "run",
        analysis_settings: Mapping[str, Any] | None = None,
        journal: Any = None,
        listener: Listener | None = None,
        **settings: Unpack[RunSettingsDict],
    ) -> Optimum:
        """The values of parameters with which an analysis has the least objective, or the largest: ``optimum.values``, ``optimum.machine``.

        objective : an output in words, ``"max(crank.angle)"``, ``"slider.position.x at 0.5 s"``, ``"time(lift)"``, a name (its value at the
        end), ``"mode.1.frequency"`` of linear models, ``"buckling.1"`` of statics, or a function of the result. analysis : what is computed
        of each variant: `run`, or `statics`, `kinematics`, `linearise` or `inverse` with their `analysis_settings`. parameters : bounds by
        path, ``{"bodies.rod.mass": (1, 3)}``, or (1, 2, 3) with a start between them. outputs : others, by name; limits : (least, greatest)
        of outputs, ``{"force": (None, 500.0)}``. method : of `scipy.optimize.minimize`, `differential-evolution`, or `CMA-ES` and `TPE` of
        the extra `search`. starts : the first is the machine's own values, the others are drawn from a Latin hypercube with `seed`.
        time_limit [s] : of the processor time of each run, which has no outputs where it takes longer. iterations : of each start, at
        most. accuracy : of the objective, as a share. journal : of a study, which keeps every run. settings : of the runs.

        Slopes are differences; with `exact_slopes` those of `gradient`, for which all outputs are said in words.
        `optimum.dataset` has every variant that was computed. Runs are not verified: look at ``optimum.machine.simulate()``.
        Raises ModelError where words, paths or limits are not known, or no start has an objective; SolveError where that is because
        runs fail.
        """
        chosen = self._searched(settings, listener, analysis)
        return nivel.analysis.optimise.optimise.optimise(
            chosen,
            nivel.analysis.optimise.evaluations.box_of(chosen, parameters),
            nivel.analysis.optimise.optimise.Aim(objective, maximise, outputs, limits),
            method=method,
            starts=starts,
            seed=seed,
            most=iterations,
            tolerance=accuracy,
            computation=nivel.analysis.optimise.evaluations.Computation(
                analysis,
                analysis_settings or {},
                threads,
                time_limit,
                chosen._exact_outputs([objective, *(outputs or {}).values()], analysis, analysis_settings)
                if exact_slopes
                else None,
                journal,
            ),
            listener=listener,
        )

    def _exact_outputs(
        self,
        said: Sequence[str | Callable[..., float]],
        analysis: Analysis = "run",
        settings: Mapping[str, Any] | None = None,
    ) -> Exact:
        """Outputs and their slopes from one run, or another analysis. Raises ModelError for outputs that are functions."""
        names = [each for each in said if isinstance(each, str)]
        if len(names) < len(said):
            message = "exact slopes are those of outputs in words, such as 'max(hinge.angle)', not of functions"
            raise ModelError(Fault.at("exact_slopes", message))

        def exact(values: Mapping[str, float]) -> tuple[Any, Any]:
            machine, asked = self.with_values(values), list(dict.fromkeys(names))
            found = machine.gradient(asked, list(values), check=False, analysis=analysis, analysis_settings=settings)
            rows = [[float(found[f"d({name})/d({path})"]) for path in values] for name in names]
            return numpy.array([float(found[name]) for name in names]), numpy.array(rows)

        return exact

    def optimal_inputs(
        self,
        objective: str | Callable[..., float],
        inputs: Mapping[str, int],
        *,
        maximise: bool = False,
        outputs: Mapping[str, str | Callable[..., float]] | None = None,
        limits: Mapping[str, Sequence[float | None]] | None = None,
        iterations: int = 100,
        accuracy: float = 1e-8,
        exact_slopes: bool = False,
        threads: int | None = None,
        listener: Listener | None = None,
        **settings: Unpack[RunSettingsDict],
    ) -> tuple[dict[str, nivel.Table], Optimum]:
        """Inputs over time with which a run has the least objective: tables for ``machine.simulate(inputs=tables)``, and the optimum.

        inputs : by name, the number of pieces, all of one length, in each of which the input changes along a straight line within its
        range: direct shooting, by SLSQP. limits : as in `optimise`; two equal numbers prescribe an output, ``{"swing": (0.0, 0.0)}``.
        objective, outputs, iterations, accuracy, exact_slopes, settings : as in `optimise`. Raises ModelError as `optimise` does,
        and for inputs without a range.
        """
        chosen, _ = self._ready(settings, listener)
        course = nivel.analysis.optimise.inputs.course_of(chosen.record, inputs, float(chosen.simulation.duration))
        machine = Machine.from_record(course.record)
        found = nivel.analysis.optimise.optimise.optimise(
            machine,
            course.box,
            nivel.analysis.optimise.optimise.Aim(objective, maximise, outputs, limits),
            most=iterations,
            tolerance=accuracy,
            computation=nivel.analysis.optimise.evaluations.Computation(
                threads=threads,
                exact=machine._exact_outputs([objective, *(outputs or {}).values()]) if exact_slopes else None,
            ),
            listener=listener,
        )
        return course.tables(found.values), found

    def identify(
        self,
        data: str | PathLike[str] | Mapping[str, Any],
        parameters: Mapping[str, Sequence[Any]],
        *,
        deviations: Mapping[str, float] | None = None,
        starts: int = 1,
        seed: int = 0,
        iterations: int = 100,
        accuracy: float = 1e-10,
        exact_slopes: bool = False,
        time_limit: float | None = None,
        threads: int | None = None,
        analysis: Analysis = "run",
        analysis_settings: Mapping[str, Any] | None = None,
        journal: Any = None,
        listener: Listener | None = None,
        **settings: Unpack[RunSettingsDict],
    ) -> Identified:
        """Parameters with which runs come nearest to measurements, by least squares: ``found.values``, ``found.deviations``.

        data : a file (CSV, MAT, Parquet) with a column `time` and columns with names of results, each with its unit in the heading,
        ``hinge.angle [deg]``; or (times, values) by name of a result, in SI units. Numbers without history need no times: with
        ``analysis="linearise"`` ``{"mode.1.frequency": 12.0}``, or a list of repeated measurements. parameters : as in `optimise`.
        deviations : standard deviations of the signals, where they are known; else each signal is measured by how much it varies, and the
        covariance follows from what is left. exact_slopes : those of `gradient`, in place of differences.
        starts, seed, iterations, accuracy, time_limit, analysis, analysis_settings, journal, settings : as in `optimise`.

        `found.covariance` is that of the parameters in their order, `found.undetermined` names those that the measurements do not tell
        apart, `found.on_bounds` those that would go on beyond their bounds, which have no deviation.
        Raises ModelError where the file, a name or a path is not known, or no start has results at all measurements.
        """
        chosen = self._searched(settings, listener, analysis)
        return nivel.analysis.optimise.identify.identify(
            chosen,
            nivel.analysis.optimise.evaluations.box_of(chosen, parameters),
            nivel.analysis.optimise.inputs.signals_of(data, deviations or {}),
            with_slopes=chosen._with_slopes if exact_slopes and analysis == "run" else None,
            exact_of=(lambda names: chosen._exact_outputs(names, analysis, analysis_settings))
            if exact_slopes and analysis != "run"
            else None,
            starts=starts,
            seed=seed,
            most=iterations,
            tolerance=accuracy,
            computation=nivel.analysis.optimise.evaluations.Computation(
                analysis, analysis_settings or {}, threads, time_limit, journal=journal
            ),
            listener=listener,
        )

    def _with_slopes(self, values: Mapping[str, float]) -> Result:
        """The run with these values, with the slopes of all that it computes with respect to them."""
        return self.with_values(values).simulate(verify=False, sensitivities=list(values))

    def _ready(
        self, settings: Mapping[str, Any], listener: Listener | None, *, stepwise: bool = False
    ) -> tuple[Machine, Plan]:
        """The machine with these settings, and its run, which is compiled."""
        given = _given(settings)
        chosen = self.with_settings(given)
        plan = chosen._plan({*given, *self.origin.settings_outside}, stepwise=stepwise)
        nivel.analysis.plan.compilation.build(_entries_of(plan, chosen.record), listener)
        return chosen, plan

    def _searched(self, settings: RunSettingsDict, listener: Listener | None, analysis: str) -> Machine:
        """The machine with these settings, whose runs are compiled; other analyses compile themselves."""
        return self._ready(settings, listener)[0] if analysis == "run" else self.with_settings(_given(settings))

    def statics(
        self,
        *,
        out: str | PathLike[str] | None = None,
        force: bool = False,
        listener: Listener | None = None,
        **settings: Unpack[StaticsSettingsDict],
    ) -> Result:
        """Static equilibrium: the states in which the machine rests under its loads, as time, on which loads and drivers depend, goes on.

        settings : as the options of `nivel statics`; times [s], or texts with units. Without a duration it is that of the machine, 0 where
        nothing depends on time: the equilibrium at t = 0 alone. out : result file (NetCDF); in memory if None. force : replace it.
        Raises ModelError (nothing was computed) or SolveError (its `result` holds the states until then).
        """
        planned = nivel.analysis.statics.free_coordinates.planned
        asked, methods = planned(self.record, _given(settings), self.origin.placed)
        self._refuse_target(out, force)
        entries = nivel.analysis.plan.compilation.statics_entries(methods)
        with self._compiled(entries, listener) as compile_seconds:  # what follows takes longer to import
            return nivel.analysis.statics.run.statics(
                self.record,
                asked,
                chosen_duration=settings.get("duration") is not None,
                source=self.origin.source,
                out=out,
                force=force,
                listener=listener,
                compile_seconds=compile_seconds,
            )

    def kinematics(
        self,
        *,
        out: str | PathLike[str] | None = None,
        force: bool = False,
        listener: Listener | None = None,
        **settings: Unpack[KinematicsSettingsDict],
    ) -> Result:
        """Positions, velocities, accelerations and reactions of a machine whose motions are all driven, without integration.

        settings : as the options of `nivel kinematics`, with `start` and `end` for `--from` and `--to` [rad or m, or texts with units].
        out : result file (NetCDF); in memory if None. force : replace it.
        Raises ModelError where motions are not driven (nothing was computed), SolveError where the machine cannot go on: its `result` holds
        the positions until then, its message says what holds which driver.
        """
        with retold(self.origin.placed):
            machine, methods, asked = nivel.analysis.kinematics.drive.planned(self.record, settings, listener)
        self._refuse_target(out, force)
        entries = nivel.analysis.plan.compilation.kinematics_entries(methods)
        with self._compiled(entries, listener) as compile_seconds:  # what follows takes longer to import
            return nivel.analysis.kinematics.run.kinematics(
                machine,
                methods,
                asked,
                source=self.origin.source,
                out=out,
                force=force,
                listener=listener,
                compile_seconds=compile_seconds,
            )

    def range_of_motion(
        self,
        coordinate: str,
        *,
        positions: int | str | None = None,
        coordinates: StaticCoordinates | None = None,
        listener: Listener | None = None,
    ) -> Range:
        """How far a joint coordinate can be driven from where it is, both ways: a whole turn, or, of a length, twice the machine's size.

        positions : so many each way, default 361. Raises ModelError where other motions are not driven.
        """
        most = positions or nivel.machine.settings.values.POSITIONS
        settings = nivel.machine.settings.analyses.kinematics_settings(
            self.record, {"drive": coordinate, "end": 0.0, "positions": most, "coordinates": coordinates}
        )
        with self._assembled(listener):
            name = settings.drive
            start, unit, size = nivel.analysis.kinematics.drive.present_value(self.record, name)
        return nivel.analysis.kinematics.drive.range_of_motion(
            name,
            unit,
            start,
            2.0 * pi if unit == "rad" else 2.0 * size,
            lambda begin, end: self.kinematics(
                drive=name,
                start=begin,
                end=end,
                positions=settings.positions,
                coordinates=coordinates,
                listener=listener,
            ),
            lambda: self.configuration_curve(name),
        )

    def configuration_curve(self, coordinate: str, *, listener: Listener | None = None) -> ConfigurationCurve:
        """All positions of a machine with one free motion, by arc length, also beyond the turning points of a coordinate, which are given.

        Raises ModelError where more motions are free, or none; SolveError where the positions cannot be followed.
        """
        name = nivel.machine.settings.analyses.kinematics_settings(self.record, {"drive": coordinate, "end": 0.0}).drive
        with self._assembled(listener):
            return nivel.analysis.kinematics.continuation.configuration_curve(self.record, name)

    def inverse(self, *, listener: Listener | None = None, **settings: Unpack[InverseSettingsDict]) -> Efforts:
        """Inverse dynamics: the efforts of actuators that make the machine follow a motion.

        settings : as the options of `nivel inverse`, with `limits` and `weights` by actuator; motion : a result, or its file. Of more
        actuators than needed the least Σ (weight · effort)² is taken within the limits, weights being one over the limit where there is
        one. Of machines with friction drivers or the trajectory prescribe the coordinates of the actuators.
        Raises ModelError (nothing was computed), SolveError where the drivers' motion cannot be reached.
        """
        words = nivel.machine.settings.analyses.InverseSettings
        asked = nivel.machine.settings.values.settings_of(words, "inverse", settings)
        motion, trajectory, positions = asked.motion, asked.trajectory, asked.positions
        with retold(self.origin.placed):
            refuse(nivel.judge.before.refusals.faults_of(self.record, nivel.judge.before.analyses.OF_INVERSE))
            record = self.record
            if trajectory is not None:
                record = nivel.analysis.inverse.run.along_trajectory(record, trajectory)
            wanted = nivel.analysis.inverse.actuators.actuation(record, asked)
            if nivel.analysis.inverse.actuators.rubs(record):
                drivers = nivel.analysis.inverse.actuators.acting_drivers(record, wanted, recorded=motion is not None)
                driven = Machine.from_record(nivel.analysis.inverse.actuators.driven_alone(record, wanted), self.origin)
                followed = driven.kinematics(positions=positions, listener=listener)
                efforts = nivel.analysis.inverse.actuators.efforts_of_drivers(wanted, drivers, followed)
                return nivel.analysis.inverse.run.with_trust(efforts, record.drivers, followed)
            moved = nivel.analysis.inverse.run.without_actuators(record, wanted)
            _, methods = nivel.analysis.plan.plan.neutral(moved, "absolute")
        if motion is None:
            followed = Machine.from_record(record, self.origin).kinematics(positions=positions, listener=listener)
        else:
            followed = open_result(motion) if isinstance(motion, str | PathLike) else motion
            if not isinstance(followed, nivel.results.result.Result):
                message = f"a result or the name of its file was expected, got {type(motion).__name__}"
                raise ModelError(Fault.at("inverse.motion", message))
        with self._compiled(nivel.analysis.plan.compilation.linear_entries(methods), listener):
            found = nivel.analysis.inverse.run.inverse(methods, wanted, followed, listener=listener)
        replaced = [each for each in record.drivers if motion is not None and each.name not in wanted.hold]
        return nivel.analysis.inverse.run.with_trust(found, record.drivers, followed, replaced)

    def mechanics(self, *, coordinates: str | None = None, listener: Listener | None = None) -> Mechanics:
        """The machine as robotics knows it, to be asked for many states: `names`, `start`, `mass_matrix(q)`, `bias(q, v)`,
        `inverse_dynamics(q, v, a)`, `forward_dynamics(q, v, tau)`, `inverse_dynamics_derivatives(q, v, a)`, `jacobian(point, q)`,
        `jacobian_bias(point, q, v)`.

        coordinates : relative (default where there are joints) or absolute. Contacts, and friction of joints that sticks, have no part in
        them: `left_out` names them. Raises ModelError where the machine cannot be assembled.
        """
        with retold(self.origin.placed):
            record, left_out = nivel.analysis.plan.plan.without_sticking(self.record)
            faults = nivel.judge.before.analyses.not_smooth(record)
            refuse(each for each in faults if each.path.partition(".")[0] not in ("control", "states"))
            plain, methods = nivel.analysis.plan.plan.neutral(record, coordinates or "auto")
        entries = nivel.analysis.plan.compilation.linear_entries(methods, nivel.analysis.plan.compilation.MANY_STATES)
        with self._compiled(entries, listener):
            return nivel.analysis.inverse.mechanics.Mechanics(
                plain, nivel.analysis.run.prepared_state.at_start(methods), left_out
            )

    def inverse_kinematics(
        self,
        point: str,
        places: Any,
        *,
        times: Any = None,
        orientations: Any = None,
        limits: Mapping[str, Any] | None = None,
        posture: Mapping[str, Any] | None = None,
        coordinates: StaticCoordinates | None = None,
        listener: Listener | None = None,
    ) -> JointPath:
        """Joint coordinates that lead a marker, or the frame of a body, along a path.

        places : (T, 3) [m] global. times : (T,) [s], default 0, 1, 2 …. orientations : (T, 4) Euler parameters of its axes, scalar first;
        default: they do not matter. limits : (low, high) by joint coordinate. posture : preferred values of joint coordinates, for degrees
        of freedom that the path leaves. Places that cannot be reached are reported, with the nearest posture found.
        Raises ModelError where the machine cannot be assembled, or arguments do not fit.
        """
        mechanics = self.mechanics(coordinates=coordinates, listener=listener)
        task = nivel.analysis.inverse.paths.task_for(mechanics, point, places, orientations, limits, posture)
        return nivel.analysis.inverse.paths.PathFollower(mechanics, task).follow(
            nivel.analysis.inverse.paths.path_times(times, len(task.places))
        )

    @cached_property
    def _mechanics(self) -> Mechanics:
        return self.mechanics()

    def mass_matrix(self, q: Any = None) -> Any:
        """(f, f) mass matrix in the independent coordinates `mechanics().names`, at positions q; default: the start."""
        return self._mechanics.mass_matrix(q)

    def bias(self, q: Any = None, v: Any = None) -> Any:
        """(f,) efforts that no acceleration asks for at positions q and velocities v: weight, centrifugal and all other forces."""
        return self._mechanics.bias(q, v)

    def inverse_dynamics(self, q: Any, v: Any, a: Any) -> Any:
        """(f,) efforts that make the accelerations a at positions q and velocities v."""
        return self._mechanics.inverse_dynamics(q, v, a)

    def jacobian(self, point: str, q: Any = None) -> Any:
        """(6, f) velocity and angular velocity of a marker or body per velocity, global axes, at positions q."""
        return self._mechanics.jacobian(point, q)

    def linearise(self, *, listener: Listener | None = None, **settings: Unpack[LineariseSettingsDict]) -> LinearModel:
        """The equations of motion made linear about a state: eigenvalues, modes, and A, B, C, D between inputs and outputs.

        settings : as the options of `nivel linearise`. about : `start`, `equilibrium` (at t = 0), or a time [s] to which it is run first.
        inputs : joint coordinates (efforts on them), motors, drivers (accelerations of what they prescribe), `BODY.force.x`,
        `BODY.torque.x`, `state.NAME`, inputs of the machine, commands of a circuit (`VALVE.command`); default: motors, drivers, commands
        and sampled values that the machine reads. outputs : joint coordinates, their `.rate`, sensors, `BODY.position.x`,
        `BODY.velocity.x`, `BODY.angular_velocity.x`, `driver.NAME.effort`, `force.NAME.…`, `state.NAME`, results of a circuit
        (`CYLINDER.pressure_A`); default: sensors, or without any all joint coordinates and the pressures of volumes.
        Raises ModelError (nothing was computed) or SolveError.
        """
        simulation, words = self.record.simulation, nivel.machine.settings.analyses
        own = {"coordinates": nivel.machine.settings.values.static_coordinates(simulation.coordinates)}
        own |= {"about": words.EQUILIBRIUM} if simulation.start == words.EQUILIBRIUM else {}
        asked = nivel.machine.settings.values.settings_of(words.LineariseSettings, "linearise", own | _given(settings))
        at_rest = asked.about == words.EQUILIBRIUM
        with retold(self.origin.placed):
            may_slide = asked.about not in (words.EQUILIBRIUM, words.ROTATION)
            refuse(nivel.judge.before.analyses.not_smooth(self.record, may_slide=may_slide))
            inputs = nivel.analysis.linearise.ports.opened(self.record, asked.inputs, asked.time)
            start = words.EQUILIBRIUM if at_rest else "as-given"
            plain, methods = nivel.analysis.plan.plan.neutral(inputs.machine, asked.coordinates, start)
        entries = nivel.analysis.plan.compilation.linear_entries(methods)
        if at_rest:
            resting = nivel.analysis.statics.start.methods_at_rest(plain)
            entries += nivel.analysis.plan.compilation.statics_entries(resting)
        run = None
        if asked.time > 0.0:
            run = self.with_settings({"duration": asked.time})._plan(())
            entries += nivel.analysis.plan.compilation.run_entries(run)
        with self._compiled(entries, listener):  # what follows takes longer to import
            inputs = replace(inputs, machine=plain)
            return nivel.analysis.linearise.linearise.linearise(
                inputs, methods, asked, run=run, source=self.origin.source, listener=listener
            )

    def compare(
        self,
        *,
        repeat: int = 3,
        journal: Any = None,
        listener: Listener | None = None,
        **settings: Unpack[CompareSettingsDict],
    ) -> Comparison:
        """Run all combinations of the given words, steps and tolerances; an axis that is not given has the machine's own setting.

        duration, output_interval, largest_step, cut : of all runs. Times are numbers in seconds, or texts with units. repeat : every cell
        runs so often, its time is the least. journal : of the command, which keeps every cell.
        Failed or invalid combinations are reported in their row. Interrupted, it returns what was computed.
        Raises ModelError where words are not known, or the machine cannot be run at all.
        """
        if repeat < 1:
            raise ModelError(Fault.at("repeat", f"a whole number of at least 1 was expected, got `{repeat}`"))
        asked = _given(settings)
        words = nivel.machine.settings.sweep
        axes = words.Axes(**{key: value for key, value in asked.items() if key in words.Axes.model_fields})
        given = {key: value for key, value in asked.items() if key in words.COMMON}
        chosen = self.with_settings(given)
        grid = nivel.analysis.compare.compare_grid.lay_out(chosen.record, axes, given)
        nivel.analysis.compare.compare_grid.compile_grid(chosen.record, grid, listener)
        # what follows takes longer to import
        with retold(chosen.origin.placed):
            return nivel.analysis.compare.compare.compare(
                chosen.record, grid, repeat=repeat, journal=journal, listener=listener
            )

    def _plan(self, given: Collection[str], *, stepwise: bool = False) -> Plan:
        """What a run will be; stepwise : in steps of one length.

        Raises ModelError where settings do not go together or have no effect though `given`, or joints do not meet the
        beams that they slide along.
        """
        with retold(self.origin.placed):
            return nivel.analysis.plan.plan.plan_run(self.record, given, stepwise=stepwise)

    def _refuse_target(self, out: str | PathLike[str] | None, force: bool) -> None:
        """Refuse a result file that cannot be written, before anything is compiled. Raises ModelError."""
        if out is not None:
            nivel.files.target.check_target(Path(fspath(out)), "result file", force=force, sources=self.origin.files)

    @contextmanager
    def _compiled(self, entries: Sequence[Entry], listener: Listener | None) -> Iterator[float]:
        """With the machine code of these entries, and faults at their lines. It gives the wall time [s] that this took."""
        took = nivel.analysis.plan.compilation.build(entries, listener)
        with retold(self.origin.placed):
            yield took

    def _assembled(self, listener: Listener | None) -> AbstractContextManager[float]:
        """With what it takes to assemble the machine."""
        return self._compiled(nivel.analysis.plan.compilation.assembly_entries(self.record), listener)

    def with_inputs(self, inputs: Mapping[str, float | str | PathLike[str] | nivel.Table]) -> Machine:
        """The same machine whose inputs follow numbers, tables of time, or files of columns `time`, `value` (CSV).

        Raises ModelError where there is no such input, or a value leaves its range or changes faster than its rate.
        """
        if not inputs:
            return self
        return Machine.from_record(nivel.files.input_table.with_signals(self.record, inputs), self.origin)


@checked_arguments
def sweep(
    make: Callable[..., Any],
    values: Mapping[str, Any],
    *,
    listener: Listener | None = None,
    **settings: Unpack[SweepSettingsDict],
) -> xarray.Dataset:
    """As `Machine.sweep`, of machines that a function makes: ``nivel.sweep(make_crane, {"length": [4, 5, 6]})`` calls
    ``make_crane(length=4)`` and so on. Every machine runs by its own settings.
    """
    return _sweep(make, values, nivel.machine.settings.sweep.SweepSettings(**_given(settings)), listener)


def _sweep(
    machines: Sequence[Machine] | Callable[..., Any],
    values: Mapping[str, Any],
    settings: SweepSettings,
    listener: Listener | None,
) -> xarray.Dataset:
    variants = nivel.analysis.sweep.variants.lay_out(
        values, settings.combine, settings.samples, settings.seed, settings.design
    )
    made = [machines(**each) for each in variants.values] if callable(machines) else machines
    for machine in made:
        if not isinstance(machine, Machine):
            raise ModelError(
                Fault.at("make", f"a function that returns a Machine was expected; it returned {shown(machine)}")
            )
    code_of(made[0], settings.analysis, listener)
    shared = {name: getattr(settings, name) for name in ("analysis", "outputs", "save", "verify")}
    shared |= {"settings": settings.analysis_settings, "time_limit": settings.time_limit}
    tasks = [nivel.analysis.sweep.outputs.Task(machine, **shared) for machine in made]
    engine = nivel.analysis.sweep.sweep.Engine(
        settings.processes or nivel.native.workers.processors(),
        settings.scheduler,
        apart=settings.time_limit is not None,
    )
    with nullcontext(listener) if listener else nivel.analysis.sweep.sweep.progress_bar(len(variants.values)) as hearer:
        return nivel.analysis.sweep.sweep.sweep(tasks, variants, engine, listener=hearer)


def code_of(machine: Machine, analysis: str, listener: Listener | None) -> None:
    """Compile what runs of variants of this machine need; other analyses do it themselves. Raises ModelError."""
    if analysis == "run":
        machine._ready({}, listener)


def _names(given: Sequence[str] | str) -> Sequence[str]:
    """Names, of which one may be given alone."""
    return (given,) if isinstance(given, str) else given


def _given(settings: Mapping[str, Any]) -> dict[str, Any]:
    """Settings that are given: None stands for what is not."""
    return {name: value for name, value in settings.items() if value is not None}


def _entries_of(plan: Plan, record: MachineRecord) -> list[Entry]:
    """The machine code that a run needs, from the start that it has."""
    entries = [*nivel.analysis.plan.compilation.run_entries(plan)]
    if plan.settings.asked.start == "equilibrium":
        entries += nivel.analysis.plan.compilation.statics_entries(nivel.analysis.statics.start.methods_at_rest(record))
    return entries


@checked_arguments
def load(path: str | PathLike[str], overrides: Mapping[str, Any] | None = None, *, allow_code: bool = False) -> Machine:
    """Read a machine file. `overrides` replace values by path, e.g. ``{"bodies.crank.mass": "22 kg"}``.

    allow_code : laws of the machine may be Python functions, which run with all your rights.
    Raises ModelError with every fault of the file, each with its line.
    """
    text, file = read_text(fspath(path)), fspath(path)
    record = parse_machine(text, file, overrides=dict(overrides or {}), allow_code=allow_code)
    values = dict(overrides or {})
    return Machine.from_record(record, Origin(text, file, outside_paths(values), values=values, allow_code=allow_code))


@checked_arguments
def import_model(
    path: str | PathLike[str],
    *,
    base: Literal["fixed", "free"] | None = None,
    package_paths: Sequence[str | PathLike[str]] = (),
    contacts: Literal["all", "floor", "none"] = "all",
    keyframe: str | None = None,
    include_paths: Sequence[str | PathLike[str]] = (),
) -> Machine:
    """The machine that a model of another program describes: a URDF, SDF or MJCF file (MJCF with the extra `robots`).

    base : whether the first link is fixed to the ground; default fixed for URDF, else as the model says. package_paths : folders in which
    meshes at ``package://`` are searched for. contacts : all of the model, those with what stands still (`floor`), or none. keyframe :
    of an MJCF model, at which the machine starts. include_paths : folders beside that of an MJCF model from which included files and
    meshes are read. What is not translated is listed by `nivel import`.
    Raises ModelError with every fault of the model, each with its line.
    """
    given = {name: each for name, each in locals().items() if name != "path"}
    return Machine.from_record(nivel.exchange.translated_machine(fspath(path), **given))


@checked_arguments
def open_result(path: str | PathLike[str]) -> Result:
    """Open a result file."""
    return nivel.results.result.Result.open(path)
