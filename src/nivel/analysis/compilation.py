"""The entries that one run needs; those without machine code are compiled together, and later processes find it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from importlib import import_module
from time import perf_counter

from nivel.analysis.choice import slides
from nivel.analysis.listener import Listener
from nivel.analysis.modal_stiffness import integrator_of
from nivel.kernels.hook import Family
from nivel.machine.joint import JOINT_KINDS
from nivel.machine.machine_record import MachineRecord
from nivel.march.catalogue import BY_MODES, INTEGRATORS, IntegratorFacts, chooses
from nivel.march.stabilise.catalogue import STABILISATIONS
from nivel.motion.catalogue import BALANCED, BALANCED_CORRECTION, FLEXIBLE, PATHS, path_of
from nivel.native import library
from nivel.native.entry import Entry, entry_of
from nivel.system.beams import ELASTIC as ELASTIC_FAMILY
from nivel.system.beams import FAMILIES as BEAMS
from nivel.system.beams import family_of
from nivel.system.forces import FORCES
from nivel.system.user_states import FAMILY as STATE_FAMILY

# in these equations every machine is assembled
ASSEMBLY = "nivel.motion.newton_euler"
FOLLOWED = ("contact", "stop")
LOADS = ("force", "torque")
TANGENT = "nivel.kernels.tangent_entries"
MEASURE, FRICTION = "nivel.kernels.measure", "nivel.kernels.friction"
GIVEN_FRICTION, RAIL = "nivel.kernels.friction_residual", "nivel.kernels.rail"
ELASTIC, HELD = f"nivel.kernels.forces.{ELASTIC_FAMILY}", "nivel.kernels.forces.held_beam"
OF_BEAMS = (HELD, "nivel.kernels.beam_tangent")
POINTS = "nivel.kernels.point_inertia"
# nodes of trees that are no joints, for residuals in relative coordinates
OF_MODES, OF_SLIDERS = "nivel.kernels.modal_nodes", "nivel.kernels.slider_nodes"
PASSING = "nivel.kernels.slider_pass"
# what completes the frames of runs in relative coordinates
COMPLETIONS = ("nivel.kernels.carried", "nivel.kernels.carried_balance", "nivel.kernels.carried_flexible")
RARE = {
    MEASURE: "measured coordinates",
    FRICTION: "friction",
    RAIL: "joints that slide along beams",
    POINTS: "absolute nodal coordinates",
    "nivel.kernels.sensor": "sensors",
    "nivel.kernels.watch": "events",
    "nivel.kernels.sampling": "sampled states",
}


def compile_path(
    machine: MachineRecord,
    path: tuple[str, str, str],
    listener: Listener,
    *,
    integrator: str = "",
    stabilisation: str = "",
) -> float:
    """Compile what a run of `machine` needs and has no machine code yet; the listener is told.

    path : coordinates, formulation and rotations. A check has no integrator and no stabilisation. Unknown names are left alone.
    Returns the wall time [s].
    """
    begin = perf_counter()
    chosen = chooses(integrator, machine.simulation.step_control)
    parts = [("nivel.kernels.observe", "output"), *_rare_parts(machine, chosen)]
    parts.insert(0, (ASSEMBLY, "the equations of motion, newton-euler"))
    sliding = slides(machine, path[0], path[1])
    asks = machine.shares_mass or sliding
    asks = asks or (integrator in INTEGRATORS and bool(_facts(machine, path[0], integrator).residual))
    kinds = {"flexible": machine.is_flexible, "shared": machine.shares_mass, "sliding": sliding}
    if (facts := path_of(*path, **kinds)) is not None:
        if facts.module != ASSEMBLY:
            bending = ", with flexible bodies" if machine.is_flexible else ""
            bending += ", with beams of consistent mass" if machine.shares_mass else ""
            bending += ", with bodies that slide along beams" if sliding else ""
            parts.insert(1, (facts.module, f"the equations of motion, {path[1]} in {path[0]} coordinates{bending}"))
        if asks:
            parts += _node_parts(machine, path[0], sliding=sliding)
        corrects = stabilisation in STABILISATIONS and STABILISATIONS[stabilisation].CORRECTS
        if corrects and facts.correction != facts.module:
            parts.append((facts.correction, "the direct correction"))
    if integrator in INTEGRATORS:
        parts.append(("nivel.march.loop", "the time loop"))
        parts.append((_facts(machine, path[0], integrator).module, f"the integrator {integrator}"))
        if facts is not None and facts.dependent and INTEGRATORS[integrator].accelerations:
            parts.append((facts.dependent, "dependent coordinates"))
    entries = [entry for module, _ in parts for entry in entries_of(module)]
    if asks and integrator in INTEGRATORS and facts is not None and facts.residual:
        residual = INTEGRATORS[integrator].over_step(machine.is_flexible) or facts.residual
        plain = bool(INTEGRATORS[integrator].whole) or INTEGRATORS[integrator].along or path[1] == "lagrange"
        entries += _twins(residual, [module for module, _ in parts], held=not plain)
    build(entries, listener)
    return perf_counter() - begin


def build(entries: Iterable[Entry], listener: Listener) -> None:
    """Compile those of these entries that have no machine code, and tell how far it is."""
    missing = library.missing(entries)
    if not missing:
        return
    count = len(missing)
    listener.say(f"compiling {count} part{'s'[: count > 1]} of the machine code (only the first run does this)")
    done: list[str] = []

    def tell(name: str) -> None:
        done.append(name)
        listener.say(f"compiled {len(done)} of {count}: {_words(name)} (only the first run does this)")

    library.build(missing, tell)


def _words(name: str) -> str:
    """What an entry is, for people: the end of its module's name."""
    module, _, path = name.partition(":")
    return module.rpartition(".")[2].replace("_", " ") + (", exact derivatives" if path.endswith(".twin") else "")


def entries_of(module: str) -> list[Entry]:
    """The entries of a module, on real numbers."""
    parts = vars(import_module(module)).values()
    entries = [part.code if isinstance(part, Family) else part for part in parts if isinstance(part, Family | Entry)]
    return [entry for entry in entries if entry.name.startswith(f"{module}:")]


def twins_of(module: str) -> list[Entry]:
    """Those of its families on complex numbers."""
    parts = vars(import_module(module)).values()
    return [part.twin for part in parts if isinstance(part, Family) and part.module == module]


def compile_statics(machine: MachineRecord, coordinates: str, listener: Listener) -> float:
    """The same for the statics of `machine` in these coordinates."""
    begin = perf_counter()
    path = (coordinates, "newton-euler", "euler-parameters")
    compile_path(machine, path, listener)
    sliding = slides(machine, coordinates, path[1])
    facts = path_of(*path, flexible=machine.is_flexible, sliding=sliding)
    if facts is not None and facts.residual:
        parts = [*_rare_parts(machine, False), *_node_parts(machine, coordinates, sliding=sliding)]
        entries = [entry_of(f"{TANGENT}:evaluate_residual"), *entries_of("nivel.kernels.static_entries")]
        entries += [entry for module, _ in parts for entry in entries_of(module)]
        build([*entries, *_twins(facts.residual, [module for module, _ in parts])], listener)
    return perf_counter() - begin


def _node_parts(machine: MachineRecord, coordinates: str, *, sliding: bool) -> list[tuple[str, str]]:
    """Modules of nodes of the tree that are no joints."""
    parts = []
    if machine.is_flexible and coordinates == "relative":
        parts.append((OF_MODES, "flexible bodies in relative coordinates"))
    if sliding:
        parts += [(module, "bodies that slide along beams") for module in (OF_SLIDERS, PASSING)]
    return parts


def _facts(machine: MachineRecord, coordinates: str, integrator: str) -> IntegratorFacts:
    """The integrator of this name for a machine in these coordinates."""
    return integrator_of(machine.replace(simulation=machine.simulation.replace(integrator=integrator)), coordinates)


def all_entries() -> list[Entry]:
    """Every entry that any run may need, those that take longest to compile first."""
    paths, integrators = (*PATHS.values(), *FLEXIBLE.values()), INTEGRATORS.values()
    modules = [facts.module for facts in integrators] + [facts.module for facts in BY_MODES.values()]
    modules += [
        module for facts in paths for module in (facts.module, facts.correction, facts.residual, facts.dependent)
    ]
    modules += [module for facts in integrators for module in (facts.whole, facts.whole_flexible)]
    modules += [*rare_modules(), "nivel.march.loop", TANGENT, "nivel.kernels.static_entries", "nivel.kernels.observe"]
    modules = [module for module in dict.fromkeys(modules) if module]
    entries = [entry for module in modules for entry in entries_of(module)]
    return [*entries, *(twin for module in complex_modules() for twin in twins_of(module))]


def complex_modules() -> list[str]:
    """Modules of families that exact derivatives may need on complex numbers."""
    families = dict.fromkeys([*(family for kind in FORCES.values() for family in kind.families), *BEAMS, STATE_FAMILY])
    residuals = [path.residual for path in (*PATHS.values(), *FLEXIBLE.values()) if path.residual]
    residuals += [module for facts in INTEGRATORS.values() for module in (facts.whole, facts.whole_flexible) if module]
    of_forces = [f"nivel.kernels.forces.{family}" for family in families]
    return [*dict.fromkeys(residuals), MEASURE, RAIL, GIVEN_FRICTION, POINTS, OF_MODES, OF_SLIDERS, *of_forces]


def _twins(residual: str, used: Sequence[str], *, held: bool = True) -> list[Entry]:
    """What exact derivatives need: the residual, and what a run uses of families, on complex numbers. held : those of elements of beams are
    found by hand."""
    needed = [residual, *(module for module in complex_modules() if module in used)]
    if ELASTIC in needed and held:
        needed[needed.index(ELASTIC)] = HELD
    if FRICTION in used:
        needed.append(GIVEN_FRICTION)
    residuals = entries_of(residual)
    return [*residuals, *(twin for module in needed for twin in twins_of(module))]


def rare_modules() -> list[str]:
    """Modules of all kinds of forces and of everything else that only some machines have."""
    families = dict.fromkeys([*(family for kind in FORCES.values() for family in kind.families), *BEAMS, STATE_FAMILY])
    return [
        *(f"nivel.kernels.forces.{family}" for family in families),
        *RARE,
        BALANCED,
        BALANCED_CORRECTION,
        *(facts.module for facts in BY_MODES.values()),
        *COMPLETIONS,
        *OF_BEAMS,
        OF_MODES,
        OF_SLIDERS,
        PASSING,
    ]


def _rare_parts(machine: MachineRecord, chosen: bool) -> list[tuple[str, str]]:
    """Modules of what only some machines have: kinds of forces, measured coordinates, friction, sensors, events.

    chosen : the integrator chooses its steps; it follows contacts and stops.
    """
    types = {force.type for force in machine.forces}
    families = dict.fromkeys(family for force in types for family in FORCES[force].families)
    families |= dict.fromkeys(family_of(beam) for beam in machine.beams)
    if machine.states:
        families |= {STATE_FAMILY: None}
    needed = {
        "nivel.kernels.sampling": any(state.update is not None for state in machine.states),
        MEASURE: bool(machine.joints or machine.drivers or machine.sensors or machine.events or types - {*LOADS}),
        FRICTION: "friction" in types,
        RAIL: any(JOINT_KINDS[joint.type].rail for joint in machine.joints),
        POINTS: any(beam.has_gradients for beam in machine.beams),
        "nivel.kernels.sensor": bool(machine.sensors),
        "nivel.kernels.watch": bool(machine.events) or (chosen and bool(types & {*FOLLOWED})),
    }
    parts = [(f"nivel.kernels.forces.{family}", f"forces: {family}") for family in families]
    if any(family_of(beam) == ELASTIC_FAMILY for beam in machine.beams):
        parts += [(module, "beams") for module in OF_BEAMS]
    return parts + [(module, what) for module, what in RARE.items() if needed[module]]
