"""The entries that a run needs; those without machine code are compiled together, and later processes find it."""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager, nullcontext
from importlib import import_module
from time import perf_counter

from nivel.analysis.curves.functions import ExpressionCurve, varying
from nivel.analysis.curves.path import has_switches
from nivel.analysis.plan.plan import Methods, Plan
from nivel.analysis.progress.log import Listener
from nivel.elements.forces import FORCES
from nivel.elements.joints import JOINTS
from nivel.errors import ModelError, NivelError
from nivel.integrate.catalogue import all_facts
from nivel.kernels.record.hook import Family
from nivel.kernels.record.program import run as run_expression
from nivel.kernels.signals.functions import compute, rate_states, read_inputs
from nivel.known import CFacts, Contact, UnitBlock
from nivel.lazy import nivel, rich
from nivel.machine.machine_record import MachineRecord
from nivel.motion.catalogue import FLEXIBLE, IMPLICIT_ACCELERATIONS, PATHS
from nivel.native import library
from nivel.native.entry import Entry, entry_of
from nivel.native.workers import NO_COMPILER, UNKNOWN_LEVEL, CompilationError
from nivel.system.beam_tables import ELASTIC

# in these equations every machine is assembled
ASSEMBLY = "nivel.motion.newton_euler"
OUTPUT, LOOP, FOLLOWING = "nivel.kernels.output.observe", "nivel.integrate.loop.loop", "nivel.integrate.loop.positions"
PACED, REPEATED = "nivel.integrate.loop.paced", "nivel.integrate.loop.repeated"
STATICS, RESIDUAL = "nivel.kernels.output.static_entries", "nivel.kernels.residual.tangent_entries:evaluate_residual"
TANGENT_ENTRIES = "nivel.kernels.residual.tangent_entries"
MANY_STATES = "nivel.kernels.residual.many_states"
FOLLOWED = ("contact", "contacts", "stop")
LOADS = ("force", "torque")
DRIVES = ("dc-motor", "servo-motor")
MEASURE, FRICTION = "nivel.kernels.bodies.measure", "nivel.kernels.elements.friction"
SENSOR, WATCH = "nivel.kernels.signals.sensor", "nivel.kernels.signals.watch"
SAMPLING, ON_SOIL = "nivel.kernels.signals.functions:sample", "nivel.elements.contacts.on_soil:sample"
HEIGHT_WAY = "nivel.elements.contacts.height_way"
VALUES, BOUNDS = "nivel.kernels.record.program:find_values", "nivel.kernels.record.program_bounds"
GIVEN_FRICTION, RAIL = "nivel.kernels.residual.friction_residual", "nivel.kernels.bodies.rail"
OF_BEAMS = "nivel.elements.beams.exact_slopes"
POINTS = "nivel.kernels.residual.point_inertia"
# flexible bodies in coordinates of single bodies: at an instant, and over a whole step
OF_FRAMES, OVER_STEP = "nivel.kernels.bodies.floating_dynamics", "nivel.motion.energy_momentum_residual:pass_flexible"
AT_INSTANT = f"{OF_FRAMES}:pass_flexible"
# nodes of trees that are no joints, for residuals in relative coordinates
OF_MODES, OF_SLIDERS = "nivel.kernels.tree.modal_nodes", "nivel.kernels.tree.tree_nodes"
PASSING = "nivel.kernels.residual.element_crossing"
# modules, besides those of residuals and forces, that exact derivatives may need on dual numbers
WITH_DERIVATIVES = (MEASURE, RAIL, GIVEN_FRICTION, POINTS, AT_INSTANT, OVER_STEP, OF_MODES, OF_SLIDERS)
# the loads of redundant joints in frames, known only when a machine is assembled
SHARED_LOADS = "nivel.motion.shared_loads"
# what completes the frames of runs in relative coordinates
COMPLETIONS = tuple(
    f"nivel.kernels.tree.tree_outputs:{name}" for name in ("complete", "complete_implicit", "complete_flexible")
)

# all modules that some machines, runs or trees need
OF_MACHINES = (MEASURE, FRICTION, RAIL, POINTS, SENSOR, WATCH, HEIGHT_WAY, SAMPLING, ON_SOIL, OF_BEAMS, GIVEN_FRICTION)
OF_RUNS = (LOOP, VALUES, BOUNDS, FOLLOWING, PACED, REPEATED, STATICS, TANGENT_ENTRIES, OUTPUT, SHARED_LOADS)
OF_TREES = (MANY_STATES, OF_FRAMES, OF_MODES, OF_SLIDERS, PASSING, IMPLICIT_ACCELERATIONS, *COMPLETIONS)


def build(entries: Iterable[Entry], listener: Listener | None) -> float:
    """Compile those of these entries that have no machine code, and tell how far it is. Returns the wall time [s].

    Without a listener a bar on standard error tells it, so that a script that compiles does not look as if it hung. Raises ModelError where
    the environment asks for a level of processors that there is not here.
    """
    begin = perf_counter()
    try:
        if missing := library.missing(entries):
            with nullcontext(listener) if listener else _bar() as hearer:
                _compile(missing, hearer, begin)
    except CompilationError as problem:
        if problem.kind == UNKNOWN_LEVEL:
            raise ModelError(str(problem)) from None
        if problem.kind == NO_COMPILER:
            what = "the library of this installation is for other sources or another processor"
            raise NivelError(f"{what}, and {problem}") from None
        raise
    return perf_counter() - begin


def _compile(missing: Sequence[Entry], listener: Listener, begin: float) -> None:
    count, done = len(missing), 0

    def tell(name: str) -> None:
        nonlocal done
        done += 1
        left = (perf_counter() - begin) * (count - done) / done
        listener.say(f"compiled {done} of {count}, about {left:.0f} s left: {in_words(name)}")

    listener.say(f"compiling {count} part{'s'[: count > 1]} of the machine code (only the first run does this)")
    library.build(missing, tell)


@contextmanager
def _bar() -> Iterator[Listener]:
    console = rich.console.Console(stderr=True)
    with console.status("") as status:

        def stage(text: str, _total: float | None = None) -> None:
            if text.startswith("compiling"):
                console.print(text)  # stays, also where no bar can be shown
            status.update(text)

        yield Listener(stage)


def in_words(name: str) -> str:
    """What an entry is, for people: the end of its module's name."""
    module, _, path = name.partition(":")
    name, _, duals = path.partition(".")
    part = {"correct": " correction", "residual": " residual", "depend": " dependent"}.get(name, "")
    of_duals = {"twin": ", exact derivatives", "whole": ", gradients"}.get(duals, "")
    return module.rpartition(".")[2].replace("_", " ") + part + of_duals


def assembly_entries(machine: MachineRecord) -> list[Entry]:
    """What it takes to assemble `machine`, and to say where everything is."""
    families = [family.code for family in _families(machine)]
    return [entry_of(f"{ASSEMBLY}:evaluate"), *_entries([OUTPUT, *_rare_modules(machine)]), *families]


def preparation_entries(methods: Methods) -> list[Entry]:
    """What it takes to prepare a machine for these methods."""
    machine, path, integrator = methods.machine, methods.path, methods.integrator
    modules = _rare_modules(machine)
    if machine.is_flexible and methods.coordinates != "relative":
        modules += [OF_FRAMES, *([OVER_STEP] if integrator.over_step else [])]
    twins: list[Entry] = []
    if integrator.residual or methods.solves_residual:
        modules += _node_modules(methods)
        plain = integrator.needs in ("whole steps", "directions") or methods.formulation == "lagrange"
        residual = integrator.over_step or path.residual
        twins = _with_twins(residual, modules, _families(machine), held=not plain)
        twins += _with_twins(path.residual, [], []) if methods.solves_residual else []
        twins.append(entry_of(RESIDUAL))
    if integrator.needs == "accelerations" and path.dependent:
        modules.append(f"{path.dependent}:depend")
    circuits = _of_circuits(machine) if integrator.needs == "circuits" else []
    slopes = [nivel.elements.circuits.kind.SLOPES.get(family) for family in circuits]
    own = _motions(machine) if methods.coordinates == "relative" else []
    twins += [motion.twin for motion in own if twins]
    if methods.coordinates == "relative":
        modules += [COMPLETIONS[0]] * (not methods.solves_residual) + [COMPLETIONS[1]] * methods.solves_residual
        modules += [COMPLETIONS[2]] * machine.is_flexible
    return [
        *assembly_entries(machine),
        entry_of(f"{path.module}:evaluate"),
        *_entries(modules),
        *(each.code for each in (*own, *slopes) if each is not None),
        *twins,
    ]


def run_entries(plan: Plan) -> list[Entry]:
    """What a run takes."""
    methods = plan.methods
    modules = [LOOP, *([WATCH] if _watches(methods.machine, methods.chooses_steps) else [])]
    if any(isinstance(force, Contact) and force.heights is not None for force in methods.machine.forces):
        modules.append(HEIGHT_WAY)
    if any(isinstance(each.curve, ExpressionCurve) for each in varying(methods.machine)):
        modules += [VALUES, BOUNDS]
    path = methods.path
    if methods.machine.is_flexible:
        modules += [OF_FRAMES, f"{ASSEMBLY}:evaluate"]  # singular positions are searched for in absolute coordinates
    after_steps = f"{path.correction}:correct" if plan.stabilisation.corrects else f"{path.module}:normalise_state"
    return [*preparation_entries(methods), methods.integrator.step, *_entries(modules), entry_of(after_steps)]


def statics_entries(methods: Methods) -> list[Entry]:
    """What statics takes, in these coordinates."""
    modules = [*_rare_modules(methods.machine), *_node_modules(methods)]
    twins = _with_twins(methods.path.residual, modules, _families(methods.machine))
    return [*preparation_entries(methods), *_entries([STATICS]), *twins]


def kinematics_entries(methods: Methods) -> list[Entry]:
    """What a kinematic analysis takes."""
    correct = entry_of(f"{methods.path.correction}:correct")
    return [*preparation_entries(methods), *_entries([FOLLOWING]), correct]


def linear_entries(methods: Methods, entries: str = TANGENT_ENTRIES) -> list[Entry]:
    """What exact derivatives at an instant take; entries : the module that asks for them."""
    modules = [*_rare_modules(methods.machine), *_node_modules(methods)]
    twins = _with_twins(methods.path.residual, modules, _families(methods.machine), held=False)
    sensors = _twins(SENSOR) if methods.machine.sensors else []
    return [*preparation_entries(methods), *twins, *sensors, *_entries([entries])]


def all_entries() -> list[Entry]:
    """Every entry that any run may need, those that take longest to compile first."""
    paths, integrators = (*PATHS.values(), *FLEXIBLE.values()), all_facts()
    modules = [facts.module for facts in integrators]
    for facts in paths:
        modules += [facts.module, facts.correction, facts.residual, facts.dependent]
    over_steps = [facts.over_step for facts in integrators]
    modules += [*over_steps, *OF_MACHINES, *OF_RUNS, *OF_TREES]
    of_all = (read_inputs, compute, rate_states, run_expression)
    foreign = nivel.kernels.signals.c_function.output, nivel.kernels.signals.fmu.output
    forces = (family for kind in FORCES.values() for family in kind.families)
    beams, circuits = nivel.elements.beams.models.FAMILIES, nivel.system.circuit_elements.families()
    families = dict.fromkeys([*of_all, *forces, *circuits, *beams, *foreign])
    residuals = [module for module in (*(path.residual for path in paths), *over_steps) if module]
    twins = [twin for module in dict.fromkeys((*residuals, *WITH_DERIVATIVES)) for twin in _twins(module)]
    twins += [family.twin for family in (*families, nivel.elements.beams.exact.hold)] + _twins(SENSOR)
    slopes = [each for each in nivel.elements.circuits.kind.SLOPES.values() if each is not None]
    entries = [*_entries(module for module in modules if module), *(each.code for each in (*families, *slopes)), *twins]
    return [*dict.fromkeys(entries)]


def _entries(modules: Iterable[str]) -> list[Entry]:
    """The entries of modules, or single ones as `module:name`, on real numbers."""
    out = []
    for module in dict.fromkeys(modules):
        parts = [part.code if isinstance(part, Family) else part for part in _parts(module)]
        out += [entry for entry in parts if entry.name.startswith(f"{module.partition(':')[0]}:")]
    return out


def _parts(place: str) -> list[Family | Entry]:
    """Those of a module, or the one of `module:name`."""
    module, _, name = place.partition(":")
    found = vars(import_module(module))
    parts = [found[name]] if name else found.values()
    return [part for part in parts if isinstance(part, Family | Entry)]


def _twins(module: str) -> list[Entry]:
    """The families of a module, or a single one, on dual numbers."""
    families = [part for part in _parts(module) if isinstance(part, Family)]
    return [family.twin for family in families if family.module == module.partition(":")[0]]


def _with_twins(residual: str, used: Sequence[str], families: Iterable[Family], *, held: bool = True) -> list[Entry]:
    """A residual, and on dual numbers it and what a run uses: modules, families. held : elements of beams are found by hand."""
    needed = [f"{residual}:residual", *(module for module in WITH_DERIVATIVES if module in used)]
    if FRICTION in used:
        needed.append(GIVEN_FRICTION)

    def of_force(family: Family) -> Family:
        return nivel.elements.beams.exact.hold if held and family.code.name == ELASTIC else family

    return [
        *_entries(needed),
        *(of_force(each).twin for each in families),
        *(twin for module in needed for twin in _twins(module)),
    ]


def _families(machine: MachineRecord) -> list[Family]:
    """The families of forces that a machine has, and what runs its expressions."""
    families = dict.fromkeys(family for force in machine.forces for family in FORCES[force.type].needed(machine, force))
    families |= dict.fromkeys(_of_circuits(machine))
    families |= dict.fromkeys(nivel.elements.beams.models.family_of(beam) for beam in machine.beams)
    families |= dict.fromkeys([read_inputs] if machine.inputs else [])
    families |= dict.fromkeys([compute, rate_states] if machine.control else [rate_states] if machine.states else [])
    units = [block.facts for block in machine.control if isinstance(block, UnitBlock)]
    # a unit in another process is called as an FMU
    in_c = (isinstance(each, CFacts) and not each.own_process for each in units)
    signals = nivel.kernels.signals
    families |= dict.fromkeys((signals.c_function if own else signals.fmu).output for own in in_c)
    return [*families, run_expression]


def _of_circuits(machine: MachineRecord) -> list[Family]:
    return nivel.system.circuit_elements.families_of(machine) if machine.hydraulics else []


def _motions(machine: MachineRecord) -> list[Family]:
    """Motions of joints of a tree that have an address of their own."""
    kinds = dict.fromkeys(joint.type for joint in machine.joints)
    trees = (JOINTS[kind].tree for kind in kinds)
    return [tree.motion for tree in trees if tree is not None and isinstance(tree.motion, Family)]


def _node_modules(methods: Methods) -> list[str]:
    """Modules of nodes of the tree that are no joints."""
    of_modes = [OF_MODES if methods.coordinates == "relative" else AT_INSTANT] if methods.machine.is_flexible else []
    return [*of_modes, *([OF_SLIDERS, PASSING] if methods.sliding else [])]


def _watches(machine: MachineRecord, chooses_steps: bool) -> bool:
    """Whether events are looked for: of the machine, or where steps are chosen contacts, stops, ends of cylinders and switches."""
    touches = any(force.type in FOLLOWED or getattr(force, "backlash", 0.0) for force in machine.forces)
    ends = any(isinstance(each, nivel.elements.circuits.chambers.Actuator) for each in machine.hydraulics)
    return bool(machine.events) or (chooses_steps and (touches or ends or has_switches(machine)))


def _rare_modules(machine: MachineRecord) -> list[str]:
    """Modules of what only some machines have, besides forces: measured coordinates, friction, sensors, samples."""
    types = {force.type for force in machine.forces}
    measured = (
        machine.joints or machine.drivers or machine.sensors or machine.events or machine.hydraulics or types - {*LOADS}
    )
    needed = {
        MEASURE: bool(measured),
        FRICTION: "friction" in types or any(force.sticks for force in machine.forces),
        RAIL: any(JOINTS[joint.type].rail for joint in machine.joints),
        POINTS: any(beam.has_gradients for beam in machine.beams),
        SENSOR: bool(machine.sensors),
        SAMPLING: any(state.update is not None for state in machine.states)
        or bool(machine.control or types & {*DRIVES}),
        ON_SOIL: any(getattr(force, "soil", None) for force in machine.forces),
        OF_BEAMS: any(nivel.elements.beams.models.family_of(beam).code.name == ELASTIC for beam in machine.beams),
    }
    return [module for module, asked in needed.items() if asked]
