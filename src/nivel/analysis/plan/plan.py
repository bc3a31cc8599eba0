"""Plan of a run, decided before anything is built or computed: the methods, where they are, and all settings."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass
from types import ModuleType

from nivel.analysis.plan.choice import (
    STIFF_CIRCUITS,
    choose_coordinates,
    choose_cut,
    names_no_integrator,
    slides,
    with_integrator,
)
from nivel.analysis.plan.combinations import refuse_combinations
from nivel.analysis.plan.modal_stiffness import integrator_of
from nivel.analysis.plan.nonholonomic_refusals import refuse_rolling_by_positions
from nivel.analysis.plan.refusals import (
    refuse_conserved_drivers,
    refuse_flexible_lagrange,
    refuse_for_shared_mass,
    refuse_friction_at_jumps,
    refuse_rough_motions,
    refuse_samples_between_steps,
    refuse_stiction_over_steps,
)
from nivel.analysis.plan.settings import RunSettings, complete
from nivel.errors import Fault, ModelError
from nivel.integrate.catalogue import INTEGRATORS
from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.stabilise.catalogue import STABILISATIONS
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.run import SimulationSettings
from nivel.methods import chooses
from nivel.motion.catalogue import FORMULATIONS, IMPLICIT_ACCELERATIONS, PathFacts, path_of
from nivel.system.beams.nodes import with_nodes

# settings that hold constants of one integrator each
CONSTANTS = {"newmark": "newmark", "hht": "hht", "generalised_alpha": "generalised-alpha"}


def unused_settings(given: Collection[str], settings: SimulationSettings, coordinates: str) -> list[Fault]:
    """Faults for those of the settings `given` that the methods of `settings` have no use for.

    coordinates : of the run, `auto` resolved.
    """
    return [
        Fault("", 0, 0, f"simulation.{name}", f"`{name}` has no effect here: {reason}")
        for name in given
        if (reason := _unused(name, settings, coordinates))
    ]


def _unused(name: str, settings: SimulationSettings, coordinates: str) -> str:
    """Why the setting `name` has no effect; empty where it has one."""
    integrator, formulation = INTEGRATORS[settings.integrator], FORMULATIONS[settings.formulation]
    if name in ("tolerance", "largest_step") and not chooses(settings.integrator, settings.step_control):
        fitting = [each for each, facts in INTEGRATORS.items() if facts.chooses_steps]
        more = "; `step_control: error` lets it choose its steps" if integrator.optional_control else ""
        return f"the step of `integrator: {settings.integrator}` is fixed; {_choice('it', fitting)}{more}"
    if name == "corrector" and integrator.kind != "corrector":
        fitting = [each for each, facts in INTEGRATORS.items() if facts.kind == "corrector"]
        return f"`integrator: {settings.integrator}` solves no equations; {_choice('it', fitting)}"
    if name in CONSTANTS and settings.integrator != CONSTANTS[name]:
        return f"it is for `integrator: {CONSTANTS[name]}`, and this run has `integrator: {settings.integrator}`"
    if name == "penalty" and formulation.factor == 0.0:
        fitting = [each for each, facts in FORMULATIONS.items() if facts.factor > 0.0]
        return f"`formulation: {settings.formulation}` has multipliers of its own; {_choice('it', fitting)}"
    if name == "free" and settings.free and settings.start != "equilibrium":
        return f"the run starts {settings.start}; it is for `start: equilibrium`"
    if name == "cut" and settings.cut and coordinates != "relative":
        return f"all joints stay constraints in {coordinates} coordinates; it is for `coordinates: relative`"
    if name == "independent" and settings.independent and coordinates != "independent":
        return f"all velocities are unknowns in {coordinates} coordinates; it is for `coordinates: independent`"
    return ""


def _choice(what: str, fitting: list[str]) -> str:
    return f"{what} is for {', '.join(fitting)}" if fitting else f"nothing uses {what}"


@dataclass(frozen=True)
class Methods:
    """How the equations of motion of a machine are written.

    machine : with the nodes of its beams as bodies. cut : its settings with the joints that are cut in relative coordinates. path : where
    the equations are. sliding : whether beams carry bodies that slide along them.
    """

    machine: MachineRecord
    formulation: str
    coordinates: str
    cut: SimulationSettings
    sliding: bool
    path: PathFacts
    integrator: IntegratorFacts

    @property
    def solves_residual(self) -> bool:
        """Whether accelerations are found by the residual."""
        return self.path.module == IMPLICIT_ACCELERATIONS

    @property
    def penalised(self) -> bool:
        """Whether constraints enter by penalties."""
        return FORMULATIONS[self.formulation].factor > 0.0

    @property
    def chooses_steps(self) -> bool:
        """Whether steps follow the error."""
        return chooses(self.machine.simulation.integrator, self.machine.simulation.step_control)


@dataclass(frozen=True)
class Plan:
    """One run: the machine as it was written, its settings completed, and its methods.

    is_open : the machine names no integrator, and has the usual one. reason : why it has its integrator where nobody asked for it.
    """

    machine: MachineRecord
    settings: RunSettings
    methods: Methods
    is_open: bool = False
    reason: str = ""

    @property
    def stabilisation(self) -> ModuleType:
        """The module of `nivel.integrate.stabilise`."""
        return STABILISATIONS[self.settings.stabilisation]


def plan_run(machine: MachineRecord, given: Collection[str] = ()) -> Plan:
    """The run of `machine` with its own settings. given : settings that were asked for this run, and must have an effect.

    Raises ModelError with everything that does not go together.
    """
    is_open, machine = names_no_integrator(machine), with_integrator(machine)
    coordinates, formulation = choose_coordinates(machine), machine.simulation.formulation
    settings: list[RunSettings] = []

    def complete_settings() -> None:
        settings.append(complete(machine.simulation, coordinates))
        refuse_samples_between_steps(machine, settings[0].step, fixed=settings[0].steps > 0)

    checks: list[Callable[[], object]] = [
        complete_settings,
        lambda: refuse_for_shared_mass(machine, formulation, coordinates),
        lambda: refuse_flexible_lagrange(machine, formulation),
        lambda: refuse_conserved_drivers(machine),
        lambda: refuse_stiction_over_steps(machine),
        lambda: refuse_rough_motions(machine),
        lambda: refuse_rolling_by_positions(machine, coordinates),
        lambda: refuse_friction_at_jumps(machine),
    ]
    faults: list[Fault] = [*unused_settings(given, machine.simulation, coordinates)]
    for check in checks:
        try:
            check()
        except ModelError as error:
            faults += error.faults
    if faults:
        raise ModelError(faults)
    methods = methods_of(machine, formulation, coordinates)
    reason = STIFF_CIRCUITS if is_open and machine.hydraulics else ""
    return Plan(machine, settings[0], methods, is_open and not machine.hydraulics, reason)


def methods_of(machine: MachineRecord, formulation: str = "newton-euler", coordinates: str = "absolute") -> Methods:
    """Where the equations of these methods are, for the rotations, cut joints and integrator of the machine's own settings.

    Raises ModelError where they do not go together.
    """
    machine = with_nodes(machine)
    refuse_for_shared_mass(machine, formulation, coordinates)
    refuse_flexible_lagrange(machine, formulation)
    simulation, cut = machine.simulation, choose_cut(machine)
    sliding = slides(machine, coordinates, formulation, cut)
    kinds = {"flexible": machine.is_flexible, "shared": machine.shares_mass, "sliding": sliding}
    path = path_of(coordinates, formulation, simulation.rotations, **kinds)
    if path is None:
        raise ModelError(refuse_combinations(simulation.replace(formulation=formulation), coordinates))
    return Methods(machine, formulation, coordinates, cut, sliding, path, integrator_of(machine, coordinates))
