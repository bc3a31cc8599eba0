"""What users of the package call: load a machine, check it, run it."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from html import escape
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any

from nivel.analysis.changes import changed
from nivel.analysis.compare_grid import Axes, compile_grid, lay_out
from nivel.analysis.compilation import assembly_entries, build, preparation_entries, run_entries, statics_entries
from nivel.analysis.listener import Listener
from nivel.analysis.plan import Plan, methods_of, plan_run
from nivel.arguments import checked_arguments
from nivel.errors import Fault, ModelError
from nivel.files.origin import Origin
from nivel.files.reader import parse_machine, read_text
from nivel.files.writer import write_machine
from nivel.machine import (
    AssemblySettings,
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
from nivel.machine.hydraulics import Fluid, HydraulicComponent

if TYPE_CHECKING:
    from nivel.analysis.check import Check
    from nivel.analysis.posing import Posing
    from nivel.results.comparison import Comparison
    from nivel.results.result import Result
    from nivel.view.sources import PosedMachine


class Machine:
    """A machine and what can be asked of it.

    Made from records (everything in SI units, or texts with units), or with `nivel.load` from a file::

        arm = nivel.Body(name="arm", mass=2.0, inertia=(0.01, 0.2, 0.2), position=(0.5, 0, 0))
        pin = nivel.Joint(name="pin", type="revolute", bodies=("ground", "arm"), point=(0, 0, 0), axis=(0, 0, 1))
        machine = nivel.Machine("pendulum", bodies=[arm], joints=[pin], gravity=(0, -9.81, 0))

    Raises ModelError with everything that is wrong.
    """

    @checked_arguments
    def __init__(
        self,
        name: str = "machine",
        *,
        bodies: Sequence[Body] = (),
        markers: Sequence[Marker] = (),
        joints: Sequence[Joint] = (),
        couplings: Sequence[Coupling] = (),
        drivers: Sequence[Driver] = (),
        forces: Sequence[Force] = (),
        fluids: Sequence[Fluid] = (),
        hydraulics: Sequence[HydraulicComponent] = (),
        states: Sequence[State] = (),
        sensors: Sequence[Sensor] = (),
        events: Sequence[Event] = (),
        gravity: Sequence[float | str] = (0.0, 0.0, 0.0),
        assembly: AssemblySettings | Mapping[str, Any] | None = None,
        simulation: SimulationSettings | Mapping[str, Any] | None = None,
        description: str = "",
    ) -> None:
        sections = {
            "bodies": bodies,
            "markers": markers,
            "joints": joints,
            "couplings": couplings,
            "drivers": drivers,
            "forces": forces,
            "fluids": fluids,
            "hydraulics": hydraulics,
            "states": states,
            "sensors": sensors,
            "events": events,
        }
        given: dict[str, Any] = {section: tuple(records) for section, records in sections.items()}
        given |= {} if assembly is None else {"assembly": assembly}
        given |= {} if simulation is None else {"simulation": simulation}
        self.record = MachineRecord(name=name, description=description, gravity=gravity, **given)  # type: ignore[arg-type]
        self.origin = Origin()

    @classmethod
    @checked_arguments
    def from_record(cls, record: MachineRecord, origin: Origin | None = None) -> Machine:
        """Wrap a record; `origin` says where its values were set."""
        machine = cls.__new__(cls)
        machine.record = record
        machine.origin = origin or Origin()
        return machine

    @property
    def name(self) -> str:
        """Name of the machine."""
        return self.record.name

    @checked_arguments
    def check(self, *, listener: Listener | None = None) -> Check:
        """Assemble the machine and say what it is: degrees of freedom, redundant rows, conventions of its joints."""
        plan = self._plan(self.origin.settings_outside)
        build(preparation_entries(plan.methods), listener or Listener())
        from nivel.analysis.check import check

        with self._faults_in_file():
            return check(plan)

    @checked_arguments
    def posed(self, *, listener: Listener | None = None) -> Posing:
        """The assembled machine, to be moved by hand. Raises ModelError where it cannot be assembled."""
        build(assembly_entries(self.record), listener or Listener())
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
        listener: Listener | None = None,
    ) -> Result:
        """Motion in time. Options given here override those of the machine's `simulation`.

        duration, step, output_interval, largest_step : [s], or texts with units. start : as-given, or equilibrium: at rest where the
        machine settles. step_control : fixed, or error: steps chosen for the
        tolerance, where the integrator can do both. tolerance : of integrators that choose their steps.
        cut : joints that stay constraints in relative coordinates. corrector, penalty, baumgarte, newmark,
        hht, generalised_alpha : mappings as in a machine file.
        out : result file (NetCDF); in memory if None. force : replace an existing file. verify : estimate the accuracy with a second
        run, at half the step or a tenth of the tolerance. A setting given here that has no effect with the methods of the run is
        refused; set in the file, it is ignored.
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
        chosen = self.with_settings(given)
        plan = chosen._plan({*given, *self.origin.settings_outside})
        entries = run_entries(plan)
        if plan.settings.start == "equilibrium":
            from nivel.analysis.statics.start import methods_at_rest

            entries += statics_entries(methods_at_rest(chosen.record))
        compile_seconds = build(entries, listener or Listener())
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
                listener=listener,
                compile_seconds=compile_seconds,
            )

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
        compile_seconds = build(statics_entries(methods), listener or Listener())
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
        compile_grid(chosen.record, grid, listener or Listener())
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
    def with_settings(self, settings: Mapping[str, Any]) -> Machine:
        """The same machine with some simulation settings replaced."""
        if not settings:
            return self
        # what was set from outside of the file is asked for as well, and never left behind
        outside, origin = self.origin.settings_outside, self.origin.with_settings(settings)
        asked = {name: getattr(self.record.simulation, name) for name in outside if name in ("rotations", "baumgarte")}
        try:
            simulation = changed(self.record.simulation, {**asked, **settings})
        except ModelError as error:
            raise ModelError(origin.placed(origin.of_settings(fault, settings) for fault in error.faults)) from None
        try:
            return Machine.from_record(self.record.replace(simulation=simulation), origin)
        except ModelError as error:
            raise ModelError(origin.placed(error.faults)) from None

    @checked_arguments
    def save(self, path: str | PathLike[str]) -> None:
        """Write the machine as a YAML file; an existing file is replaced. Raises ModelError where it cannot be written."""
        text = write_machine(self.record)
        try:
            Path(path).write_text(text, encoding="utf-8")
        except (OSError, ValueError) as error:
            reason = getattr(error, "strerror", None) or str(error)
            raise ModelError(f"the machine file {fspath(path)} cannot be written: {reason.lower()}") from error

    def _repr_html_(self) -> str:
        """A card for notebooks: what the machine consists of."""
        record = self.record
        rows = [
            ("body", body.name, f"{body.mass:g} kg" if body.mass is not None else "from its shape")
            for body in record.bodies
        ]
        rows += [("joint", joint.name, joint.type) for joint in record.joints]
        rows += [("force", force.name, force.type) for force in record.forces]
        lines = "".join(
            f"<tr><td>{kind}</td><th>{escape(name)}</th><td>{escape(fact)}</td></tr>" for kind, name, fact in rows
        )
        return f"<table><caption>{escape(record.name)}</caption>{lines}</table>"

    def __repr__(self) -> str:
        record = self.record
        parts = [
            f"{len(items)} {word if len(items) != 1 else singular}"
            for items, word, singular in (
                (record.bodies, "bodies", "body"),
                (record.joints, "joints", "joint"),
                (record.forces, "forces", "force"),
            )
        ]
        return f"<Machine {record.name}: {', '.join(parts)}>"


@checked_arguments
def load(path: str | PathLike[str], overrides: Mapping[str, Any] | None = None, *, allow_code: bool = False) -> Machine:
    """Read a machine file. `overrides` replace values by path, e.g. ``{"bodies.crank.mass": "22 kg"}``.

    allow_code : laws of the machine may be Python functions, which run with all your rights.
    Raises ModelError with every fault of the file, each with its line.
    """
    text, file = read_text(fspath(path)), fspath(path)
    record = parse_machine(text, file, overrides=dict(overrides or {}), allow_code=allow_code)
    outside = frozenset(".".join(step.strip() for step in path.split(".")) for path in overrides or ())
    return Machine.from_record(record, Origin(text, file, outside))


@checked_arguments
def open_result(path: str | PathLike[str]) -> Result:
    """Open a result file."""
    from nivel.results.result import Result

    return Result.open(path)
