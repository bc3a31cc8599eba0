"""What users of the package call: load a machine, check it, run it."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from nivel.analysis.compare_grid import Axes, compile_grid, lay_out
from nivel.analysis.compilation import assembly_entries, build, preparation_entries, run_entries, statics_entries
from nivel.analysis.listener import Listener
from nivel.analysis.plan import Plan, methods_of, plan_run
from nivel.analysis.settings import waiting_time
from nivel.arguments import checked_arguments
from nivel.errors import Fault, ModelError
from nivel.files.origin import Origin
from nivel.files.reader import parse_machine, read_text
from nivel.files.values import outside_paths
from nivel.machine import (
    AssemblySettings,
    Beam,
    Block,
    Body,
    Coupling,
    Driver,
    Event,
    Force,
    Joint,
    MachineRecord,
    Marker,
    Sensor,
    SimulationSettings,
    State,
)
from nivel.model import Model
from nivel.wording import shown

if TYPE_CHECKING:
    import xarray

    from nivel.analysis.check import Check
    from nivel.analysis.posing import Posing
    from nivel.analysis.stepping import Simulation
    from nivel.c_library.writer import Files
    from nivel.native.entry import Entry
    from nivel.results.comparison import Comparison
    from nivel.results.result import Result
    from nivel.view.sources import PosedMachine


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
        bodies: Sequence[Body] = (),
        beams: Sequence[Beam] = (),
        markers: Sequence[Marker] = (),
        joints: Sequence[Joint] = (),
        couplings: Sequence[Coupling] = (),
        drivers: Sequence[Driver] = (),
        forces: Sequence[Force] = (),
        states: Sequence[State] = (),
        control: Sequence[Block] = (),
        sensors: Sequence[Sensor] = (),
        events: Sequence[Event] = (),
        gravity: Sequence[float | str] = (0.0, 0.0, 0.0),
        assembly: AssemblySettings | Mapping[str, Any] | None = None,
        simulation: SimulationSettings | Mapping[str, Any] | None = None,
        description: str = "",
    ) -> None:
        sections = {
            "bodies": bodies,
            "beams": beams,
            "markers": markers,
            "joints": joints,
            "couplings": couplings,
            "drivers": drivers,
            "forces": forces,
            "states": states,
            "control": control,
            "sensors": sensors,
            "events": events,
        }
        given: dict[str, Any] = {section: tuple(records) for section, records in sections.items()}
        given |= {} if assembly is None else {"assembly": assembly}
        given |= {} if simulation is None else {"simulation": simulation}
        self.record = MachineRecord(name=name, description=description, gravity=gravity, **given)  # type: ignore[arg-type]
        self.origin = Origin()

    @checked_arguments
    def check(self, *, listener: Listener | None = None) -> Check:
        """Assemble the machine and say what it is: degrees of freedom, redundant rows, conventions of its joints."""
        plan = self._plan(self.origin.settings_outside)
        build(preparation_entries(plan.methods), listener)
        from nivel.analysis.check import check

        with self._faults_in_file():
            return check(plan)

    @checked_arguments
    def posed(self, *, listener: Listener | None = None) -> Posing:
        """The assembled machine, to be moved by hand. Raises ModelError where it cannot be assembled."""
        build(assembly_entries(self.record), listener)
        from nivel.analysis.posing import Posing

        with self._faults_in_file():
            return Posing(self.record)

    @checked_arguments
    def view(self, *, port: int = 0, browser: bool = True) -> None:
        """Show the assembled machine in a browser, with a slider for each joint that can move; returns after Ctrl-C."""
        from nivel.view.opening import serve

        serve(self.viewer_source(), host="127.0.0.1", port=port, browser=browser, say=print)

    @checked_arguments
    def viewer_source(self, *, listener: Listener | None = None) -> PosedMachine:
        """What the viewer shows of the machine before any run."""
        from nivel.view.sources import PosedMachine

        posed = self.posed(listener=listener)
        return PosedMachine(self.name, posed, self.record.model_dump(mode="json", by_alias=True, exclude_none=True))

    @checked_arguments
    def simulate(
        self,
        *,
        duration: float | str | None = None,
        step: float | str | None = None,
        output_interval: float | str | None = None,
        integrator: str | None = None,
        formulation: str | None = None,
        coordinates: str | None = None,
        rotations: str | None = None,
        stabilisation: str | None = None,
        start: str | None = None,
        step_control: str | None = None,
        tolerance: float | str | None = None,
        largest_step: float | str | None = None,
        cut: Sequence[str] | str | None = None,
        corrector: Mapping[str, Any] | None = None,
        penalty: Mapping[str, Any] | None = None,
        baumgarte: Mapping[str, Any] | None = None,
        newmark: Mapping[str, Any] | None = None,
        hht: Mapping[str, Any] | None = None,
        generalised_alpha: Mapping[str, Any] | None = None,
        out: str | PathLike[str] | None = None,
        force: bool = False,
        verify: bool = False,
        verify_limit: float | str | None = None,
        listener: Listener | None = None,
    ) -> Result:
        """Motion in time. Options given here override those of the machine's `simulation`.

        duration, step, output_interval, largest_step : [s], or texts with units. start : as-given, or equilibrium: at rest where the
        machine settles. step_control : fixed, or error: steps chosen for the
        tolerance, where the integrator can do both. tolerance : of integrators that choose their steps.
        cut : joints that stay constraints in relative coordinates. corrector, penalty, baumgarte, newmark,
        hht, generalised_alpha : mappings as in a machine file.
        out : result file (NetCDF); in memory if None. force : replace an existing file. verify : a second run
        beside this one, with finer steps on other times, tells how exact every number is; `nivel run` does so by itself. verify_limit
        [s] : the second run goes on for so long after the first at most, by default as long again as that took.
        A setting given here that has no effect with the methods of the run is refused; set in the file, it is ignored.
        Raises ModelError (nothing was computed) or SolveError (its `result` holds everything up to the failure).
        """
        given = {
            "duration": duration,
            "step": step,
            "output_interval": output_interval,
            "integrator": integrator,
            "formulation": formulation,
            "coordinates": coordinates,
            "rotations": rotations,
            "stabilisation": stabilisation,
            "start": start,
            "step_control": step_control,
            "tolerance": tolerance,
            "largest_step": largest_step,
            "cut": cut,
            "corrector": corrector,
            "penalty": penalty,
            "baumgarte": baumgarte,
            "newmark": newmark,
            "hht": hht,
            "generalised_alpha": generalised_alpha,
        }
        given = {key: value for key, value in given.items() if value is not None}
        limit = None if verify_limit is None else waiting_time("verify_limit", verify_limit)
        chosen = self.with_settings(given)
        plan = chosen._plan({*given, *self.origin.settings_outside})
        compile_seconds = build(_entries_of(plan, chosen.record), listener)
        # what follows takes longer to import
        from nivel.analysis.simulate import simulate
        from nivel.results.target import keep_sources

        if out is not None and self.origin.file:
            keep_sources(Path(fspath(out)), "result file", [Path(self.origin.file)])
        with chosen._faults_in_file():
            return simulate(
                plan,
                source=self.origin.source,
                out=out,
                force=force,
                verify=verify,
                verify_limit=limit,
                listener=listener,
                compile_seconds=compile_seconds,
            )

    def export_c(self, folder: str | PathLike[str], *, listener: Listener | None = None) -> Files:
        """Write the machine as a C library: what a run with its settings does step by step, for programs without Python.

        folder : a new one, for header, source, machine code of this processor, an example and a Makefile.
        Raises ModelError where steps are not fixed, a Python law takes part, or the folder is there already.
        """
        plan = self._plan({})
        build(run_entries(plan), listener)
        from nivel.c_library.writer import write_c_library

        with self._faults_in_file():
            return write_c_library(plan, Path(folder))

    @checked_arguments
    def start(
        self,
        *,
        step: float | str | None = None,
        output_interval: float | str | None = None,
        integrator: str | None = None,
        formulation: str | None = None,
        coordinates: str | None = None,
        stabilisation: str | None = None,
        start: str | None = None,
        record: bool = False,
        listener: Listener | None = None,
    ) -> Simulation:
        """The machine ready to move step by step: ``sim.step()``, ``sim["hinge.angle"]``, ``sim.state``.

        Options override those of the machine's `simulation`, as in `simulate`. The time has no end; steps are fixed.
        record : keep a frame every `output_interval`, for ``sim.result()``. Raises ModelError.
        """
        given = {
            "step": step,
            "output_interval": output_interval,
            "integrator": integrator,
            "formulation": formulation,
            "coordinates": coordinates,
            "stabilisation": stabilisation,
            "start": start,
        }
        given = {key: value for key, value in given.items() if value is not None}
        chosen = self.with_settings(given)
        plan = chosen._plan({*given, *self.origin.settings_outside})
        build(_entries_of(plan, chosen.record), listener)
        from nivel.analysis.stepping import Simulation

        with chosen._faults_in_file():
            return Simulation(plan, source=self.origin.source, record=record)

    @checked_arguments
    def sweep(
        self,
        values: Mapping[str, Any],
        *,
        combine: Literal["grid", "rows"] = "grid",
        samples: int | None = None,
        seed: int = 0,
        save: Sequence[str] | str = (),
        processes: int | None = None,
        listener: Listener | None = None,
        **settings: Any,
    ) -> xarray.Dataset:
        """Run the machine with other values, on all processors, into one xarray dataset.

        values : lists by path, ``{"bodies.rod.mass": [1, 2, 3], "parameters.length": ["20 cm", "30 cm"]}``. combine : `grid`, every value
        with every other, one dimension each; or `rows`, the first of all lists, the second of all, along the dimension `variant`.
        samples : so many variants of a Latin hypercube between two bounds, ``{"bodies.rod.mass": (1, 3)}``, or over distributions of
        `scipy.stats`; seed : of its random numbers. save : names of results; default all joint coordinates and sensors.
        processes : as many as there are processors by default. settings : as of `simulate`, for all variants.

        A variant that fails or is refused has its `reason` in the dataset, and NaN where nothing was computed. `outcome`, `end_time` and
        `verdict` stand there for every variant. Ctrl-C ends the sweep; what was computed is returned.
        Raises ModelError where values or names are not known, or no variant can be run.
        """
        machine = self.with_settings(settings)
        return _sweep([machine], values, (combine, samples, seed), (save, processes), listener)

    @checked_arguments
    def statics(
        self,
        *,
        duration: float | str | None = None,
        step: float | str | None = None,
        arc_length: bool = False,
        tolerance: float | str | None = None,
        most_iterations: int | str | None = None,
        line_search: bool = True,
        modes: int | str | None = None,
        buckling: int | str | None = None,
        coordinates: str | None = None,
        out: str | PathLike[str] | None = None,
        force: bool = False,
        listener: Listener | None = None,
    ) -> Result:
        """Static equilibrium: the states in which the machine rests under its loads, as time, on which loads and drivers depend, goes on.

        duration : to which time [s], or a text with units; default that of the machine, 0 where nothing depends on time: the equilibrium
        at t = 0 alone. step : of time between states [s], default a twentieth; halved where Newton's method fails.
        arc_length : follow the path through limit points, where time turns back. tolerance : of the last change, in lengths of the machine
        and radians. most_iterations : of Newton's method a state. line_search : shorten steps that come no nearer.
        modes : so many vibrations about every state. buckling : so many linearised buckling loads, from the tangents of the first and
        the last state. coordinates : auto, absolute or relative. out : result file (NetCDF); in memory if None. force : replace it.
        Raises ModelError (nothing was computed) or SolveError (its `result` holds the states until then).
        """
        from nivel.analysis.statics.settings import statics_settings

        simulation = self.record.simulation
        given = {
            "duration": simulation.duration if duration is None else duration,
            "step": step,
            "arc_length": arc_length,
            "tolerance": tolerance,
            "most_iterations": most_iterations,
            "line_search": line_search,
            "modes": modes,
            "buckling": buckling,
            "coordinates": coordinates,
        }
        settings = statics_settings(given, simulation.coordinates)
        from nivel.analysis.statics.refusals import for_statics

        neutral, chosen = for_statics(self.record, settings)
        with self._faults_in_file():
            methods = methods_of(neutral, "newton-euler", chosen)
        compile_seconds = build(statics_entries(methods), listener)
        # what follows takes longer to import
        from nivel.analysis.statics.run import statics
        from nivel.results.target import keep_sources

        if out is not None and self.origin.file:
            keep_sources(Path(fspath(out)), "result file", [Path(self.origin.file)])
        with self._faults_in_file():
            return statics(
                self.record,
                settings,
                chosen_duration=duration is not None,
                source=self.origin.source,
                out=out,
                force=force,
                listener=listener,
                compile_seconds=compile_seconds,
            )

    @checked_arguments
    def compare(
        self,
        *,
        integrators: Sequence[str] | str | None = None,
        formulations: Sequence[str] | str | None = None,
        coordinates: Sequence[str] | str | None = None,
        rotations: Sequence[str] | str | None = None,
        stabilisations: Sequence[str] | str | None = None,
        steps: Sequence[float | str] | float | str | None = None,
        tolerances: Sequence[float | str] | float | str | None = None,
        duration: float | str | None = None,
        output_interval: float | str | None = None,
        largest_step: float | str | None = None,
        cut: Sequence[str] | str | None = None,
        repeat: int = 3,
        listener: Listener | None = None,
    ) -> Comparison:
        """Run all combinations of the given words; an axis that is None has the machine's own setting.

        steps [s] : of integrators with a fixed one; tolerances : of the others. duration, output_interval, largest_step [s], cut : of
        all runs. repeat : every cell runs so often, its time is the least. Times are numbers in seconds, or texts with units.
        Failed or invalid combinations are reported in their row. Interrupted, it returns what was computed.
        Raises ModelError where words are not known, or the machine cannot be run at all.
        """
        if repeat < 1:
            raise ModelError(Fault("", 0, 0, "repeat", f"a whole number of at least 1 was expected, got `{repeat}`"))
        words: dict[str, Any] = {
            "integrators": integrators,
            "formulations": formulations,
            "coordinates": coordinates,
            "rotations": rotations,
            "stabilisations": stabilisations,
            "steps": steps,
            "tolerances": tolerances,
        }
        axes = Axes(**words)
        common = {"duration": duration, "output_interval": output_interval, "largest_step": largest_step, "cut": cut}
        given = {name: value for name, value in common.items() if value is not None}
        chosen = self.with_settings(given)
        grid = lay_out(chosen.record, axes, given)
        compile_grid(chosen.record, grid, listener)
        # what follows takes longer to import
        from nivel.analysis.compare import compare

        with chosen._faults_in_file():
            return compare(chosen.record, grid, repeat=repeat, listener=listener)

    def _plan(self, given: Collection[str]) -> Plan:
        """What a run will be. Raises ModelError where settings do not go together or have no effect though `given`, or joints do not
        meet the beams that they slide along."""
        with self._faults_in_file():
            return plan_run(self.record, given)

    @contextmanager
    def _faults_in_file(self) -> Iterator[None]:
        """Faults that the assembly finds get the line of the element in the machine's file."""
        try:
            yield
        except ModelError as error:
            raise ModelError(self.origin.placed(error.faults)) from error


@checked_arguments
def sweep(
    make: Callable[..., Any],
    values: Mapping[str, Any],
    *,
    combine: Literal["grid", "rows"] = "grid",
    samples: int | None = None,
    seed: int = 0,
    save: Sequence[str] | str = (),
    processes: int | None = None,
    listener: Listener | None = None,
) -> xarray.Dataset:
    """As `Machine.sweep`, of machines that a function makes: ``nivel.sweep(make_crane, {"length": [4, 5, 6]})`` calls
    ``make_crane(length=4)`` and so on. Every machine runs by its own settings.
    """
    return _sweep(make, values, (combine, samples, seed), (save, processes), listener)


def _sweep(
    machines: Sequence[Machine] | Callable[..., Any],
    values: Mapping[str, Any],
    layout: tuple[str, int | None, int],
    run: tuple[Sequence[str] | str, int | None],
    listener: Listener | None,
) -> xarray.Dataset:
    from nivel.analysis.sweep.sweep import progress_bar, sweep
    from nivel.analysis.sweep.variants import lay_out
    from nivel.native.workers import processors

    variants = lay_out(values, *layout)
    made = [machines(**each) for each in variants.values] if callable(machines) else machines
    for machine in made:
        if not isinstance(machine, Machine):
            raise ModelError(
                Fault("", 0, 0, "make", f"a function that returns a Machine was expected; it returned {shown(machine)}")
            )
    plan = made[0]._plan(made[0].origin.settings_outside)
    build(_entries_of(plan, made[0].record), listener)
    save, processes = run
    names = (save,) if isinstance(save, str) else tuple(save)
    with nullcontext(listener) if listener else progress_bar(len(variants.values)) as hearer:
        return sweep(made, variants, names, processes=processes or processors(), listener=hearer)


def _entries_of(plan: Plan, record: MachineRecord) -> list[Entry]:
    """The machine code that a run needs, from the start that it has."""
    entries = [*run_entries(plan)]
    if plan.settings.start == "equilibrium":
        from nivel.analysis.statics.start import methods_at_rest

        entries += statics_entries(methods_at_rest(record))
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
def open_result(path: str | PathLike[str]) -> Result:
    """Open a result file."""
    from nivel.results.result import Result

    return Result.open(path)
