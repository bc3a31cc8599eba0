"""Plan of a run, decided before anything is built or computed: the methods, where they are, and all settings."""

from collections.abc import Collection
from typing import Final

from nivel.analysis.plan import choice
from nivel.analysis.plan.beam_facts import integrator_of
from nivel.analysis.plan.choice import choose_coordinates
from nivel.analysis.plan.settings import RunSettings, complete, refuse_combinations
from nivel.errors import Fault, ModelError, refuse
from nivel.integrate.catalogue import INTEGRATORS
from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.stabilise import STABILISATIONS, Stabilisation
from nivel.judge.before import refusals
from nivel.known import Contact, Contacts, Friction
from nivel.lazy import Struct, all_kept, nivel, replace
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.run import SimulationSettings
from nivel.methods import chooses
from nivel.motion.catalogue import FORMULATIONS, IMPLICIT_ACCELERATIONS, PathFacts, path_of

# settings that hold constants of one integrator each
CONSTANTS = {"newmark": "newmark", "hht": "hht", "generalised_alpha": "generalised-alpha"}


def unused_settings(given: Collection[str], settings: SimulationSettings, coordinates: str) -> list[Fault]:
    """Faults for those of the settings `given` that the methods of `settings` have no use for.

    coordinates : of the run, `auto` resolved.
    """
    return [
        Fault.at(f"simulation.{name}", f"`{name}` has no effect here: {reason}")
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


class Methods(Struct):
    """How the equations of motion of a machine are written.

    machine : with the nodes of its beams as bodies. cut : its settings with the joints that are cut in relative coordinates. path : where
    the equations are. sliding : whether beams carry bodies that slide along them. stiff : the same equations with the integrator that
    goes on where stability bounds the steps of this one; None where this one stays.
    """

    machine: MachineRecord
    formulation: str
    coordinates: str
    cut: SimulationSettings
    sliding: bool
    path: PathFacts
    integrator: IntegratorFacts
    stiff: "Methods | None" = None

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


class Plan(Struct):
    """One run: the machine as it was written, its settings completed, and its methods.

    is_open : the machine names no integrator. reason : why it has its integrator where nobody asked for it. asked : the machine as it was
    written, where nivel has chosen the methods of `machine`.
    """

    machine: MachineRecord
    settings: RunSettings
    methods: Methods
    is_open: bool = False
    reason: str = ""
    asked: MachineRecord | None = None

    @property
    def stabilisation(self) -> Stabilisation:
        """How constraints are kept, see `nivel.integrate.stabilise`."""
        return STABILISATIONS[self.settings.stabilisation]


@all_kept()
def plan_run(machine: MachineRecord, given: Collection[str] = (), *, stepwise: bool = False) -> Plan:
    """The run of `machine` with its own settings. given : settings that were asked for this run, and must have an effect.

    stepwise : steps of one length are needed, as of a machine that is stepped or that goes into another program.
    Raises ModelError with everything that does not go together.
    """
    if not choice.names_no_integrator(machine) or (stepwise and not machine.hydraulics):
        return replace(_planned(machine, given), is_open=choice.names_no_integrator(machine))
    asked = {*given} if stepwise else {*given, *({"tolerance"} & machine.simulation.model_fields_set)}
    refused: list[ModelError] = []
    for name, reason in choice.integrators_for(machine):
        if stepwise and INTEGRATORS[name].chooses_steps:
            continue
        try:
            plan = _planned(choice.with_integrator(machine, name), asked)
        except ModelError as error:
            refused.append(error)
            continue
        return replace(with_stiff(plan), is_open=True, reason=reason, asked=machine)
    raise min(reversed(refused), key=lambda error: len(error.faults))  # what no method can cure


def other_run(plan: Plan, name: str, **changes: float) -> Plan | None:
    """The run of a plan whose machine names no integrator, with this one and other changes of its settings; None where that does not go."""
    assert plan.asked is not None
    try:
        new = _planned(choice.with_integrator(plan.asked, name, **changes), ())
    except ModelError:
        return None
    return replace(with_stiff(new), is_open=True, reason=plan.reason, asked=plan.asked)


def with_stiff(plan: Plan) -> Plan:
    """The plan whose explicit integrator is followed by an implicit one where stability bounds its steps, where that goes."""
    methods, settings = plan.methods, plan.settings
    machine = choice.with_integrator(plan.machine, choice.FOR_STIFF)
    if methods.integrator.name != "dopri5" or _faults_of(machine, settings.coordinates):
        return plan
    other = nivel.system.beam_nodes.with_nodes(machine)
    stiff = replace(methods, machine=other, integrator=integrator_of(other, settings.coordinates))
    return replace(plan, methods=replace(methods, stiff=stiff))


def _planned(machine: MachineRecord, given: Collection[str]) -> Plan:
    """The run of a machine with the integrator that it has."""
    machine = choice.with_dividing_step(machine)
    coordinates = choice.choose_coordinates(machine)
    refuse([*unused_settings(given, machine.simulation, coordinates), *_faults_of(machine, coordinates)])
    methods = methods_of(machine, machine.simulation.formulation, coordinates)
    return Plan(machine, complete(machine.simulation, coordinates), methods)


def _faults_of(machine: MachineRecord, coordinates: str) -> list[Fault]:
    """What does not go together in a run of a machine."""
    formulation = machine.simulation.formulation
    try:
        settings = complete(machine.simulation, coordinates)
        faults = [*refusals.samples_between_steps(machine, settings.step)] if settings.steps > 0 else []
    except ModelError as error:
        faults = [*error.faults]
    return [
        *faults,
        *refusals.shared_mass(machine, formulation, coordinates),
        *refusals.flexible_lagrange(machine, formulation),
        *refusals.conserved_drivers(machine),
        *refusals.stiction_over_steps(machine),
        *refusals.rough_motions(machine),
        *refusals.rolling_by_positions(machine, coordinates),
        *refusals.friction_at_jumps(machine),
    ]


def methods_of(machine: MachineRecord, formulation: str = "newton-euler", coordinates: str = "absolute") -> Methods:
    """Where the equations of these methods are, for the rotations, cut joints and integrator of the machine's own settings.

    Raises ModelError where they do not go together.
    """
    machine = nivel.system.beam_nodes.with_nodes(machine)
    refuse(refusals.shared_mass(machine, formulation, coordinates))
    refuse(refusals.flexible_lagrange(machine, formulation))
    simulation, cut = machine.simulation, choice.choose_cut(machine)
    sliding = choice.slides(machine, coordinates, formulation, cut)
    kinds = {"flexible": machine.is_flexible, "shared": machine.shares_mass, "sliding": sliding}
    path = path_of(coordinates, formulation, simulation.rotations, **kinds)
    if path is None:
        raise ModelError(refuse_combinations(simulation.replace(formulation=formulation), coordinates))
    return Methods(machine, formulation, coordinates, cut, sliding, path, integrator_of(machine, coordinates))


TRANSITION: Final = 1e-3  # [m/s] where no `friction_transition_speed` is given


def with_smooth_contacts(machine: MachineRecord) -> MachineRecord:
    """The machine with `friction_model: coulomb` in every contact that would stick: at rest it exerts no friction."""
    forces = tuple(
        force.replace(
            friction_model="coulomb",
            static_friction=None,
            rolling_resistance=0.0,
            patch_radius=None,
            friction_transition_speed=force.friction_transition_speed or TRANSITION,
        )
        if isinstance(force, Contact) and force.sticks
        else force
        for force in machine.forces
    )
    return machine if forces == tuple(machine.forces) else machine.replace(forces=forces)


def without_sticking(machine: MachineRecord) -> tuple[MachineRecord, tuple[str, ...]]:
    """The machine without its contacts and without friction of joints that sticks, and the names of what is left out: their efforts at rest
    are no function of the state. Raises ModelError where something reads one of them."""
    left = tuple(
        force.name
        for force in machine.forces
        if isinstance(force, Contact | Contacts) or (isinstance(force, Friction) and force.model == "stiction")
    )
    forces = tuple(force for force in machine.forces if force.name not in left)
    return (machine.replace(forces=forces) if left else machine), left


def neutral(machine: MachineRecord, coordinates: str, start: str = "as-given") -> tuple[MachineRecord, Methods]:
    """The machine in these coordinates, with settings of no method, and where its equations are. Raises ModelError."""
    machine = with_smooth_contacts(machine)
    given = machine.simulation
    step, interval = min(given.step, given.duration), given.output_interval
    simulation = given.replace(
        integrator="rk4",
        step=step,
        # one below a step that nobody gave is that of an integrator that chooses its own
        output_interval=None if interval is None or interval < step else interval,
        formulation="newton-euler",
        coordinates=coordinates,
        stabilisation="direct",
        rotations="euler-parameters",
        baumgarte=None,
        independent=(),
        start=start,
        step_control="own",
    )
    changed = machine.replace(simulation=simulation)
    # joint coordinates measure what spins
    joined = coordinates == "auto" and machine.joints and not machine.is_flexible and not machine.beams
    chosen = "relative" if joined else choose_coordinates(changed)
    plain = changed.replace(simulation=simulation.replace(coordinates=chosen))
    return plain, methods_of(plain, "newton-euler", chosen)
