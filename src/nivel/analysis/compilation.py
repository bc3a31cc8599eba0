"""The kernels that one run needs, compiled one after another; later processes load them from the cache."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib import import_module
from time import perf_counter

from nivel.analysis.choice import slides
from nivel.analysis.listener import Listener
from nivel.analysis.modal_stiffness import integrator_of
from nivel.kernels import cache
from nivel.machine.joint import JOINT_KINDS
from nivel.machine.machine_record import MachineRecord
from nivel.march.catalogue import BY_MODES, INTEGRATORS, IntegratorFacts, chooses
from nivel.march.stabilise.catalogue import STABILISATIONS
from nivel.motion.catalogue import BALANCED, BALANCED_CORRECTION, FLEXIBLE, PATHS, path_of
from nivel.system.beams import ELASTIC as ELASTIC_FAMILY
from nivel.system.beams import FAMILIES as BEAMS
from nivel.system.beams import family_of
from nivel.system.forces import FORCES
from nivel.system.user_states import FAMILY as STATE_FAMILY

# in these equations every machine is assembled
ASSEMBLY = "nivel.motion.newton_euler"
FOLLOWED = ("contact", "stop")
LOADS = ("force", "torque")
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
    """Import the kernel modules of a run of `machine`; tell the listener about each that is not in the cache.

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
    missing = [part for part in parts if part[0] not in sys.modules and not cache.is_warm(part[0].rsplit(".", 1)[1])]
    for module, what in parts:
        if (module, what) in missing:
            place = f"{missing.index((module, what)) + 1}/{len(missing)}"
            listener.say(f"compiling {what} ({place}; only the first run does this)")
        import_module(module)
    if asks and integrator in INTEGRATORS and facts is not None and facts.residual:
        residual = INTEGRATORS[integrator].over_step(machine.is_flexible) or facts.residual
        plain = bool(INTEGRATORS[integrator].whole) or INTEGRATORS[integrator].along or path[1] == "lagrange"
        _compile_derivatives(residual, [module for module, _ in parts], listener, held=not plain)
    return perf_counter() - begin


def compile_statics(machine: MachineRecord, coordinates: str, listener: Listener) -> float:
    """The same for the statics of `machine` in these coordinates."""
    begin = perf_counter()
    path = (coordinates, "newton-euler", "euler-parameters")
    compile_path(machine, path, listener)
    sliding = slides(machine, coordinates, path[1])
    facts = path_of(*path, flexible=machine.is_flexible, sliding=sliding)
    if facts is not None and facts.residual:
        parts = [*_rare_parts(machine, False), *_node_parts(machine, coordinates, sliding=sliding)]
        used = [module for module, _ in parts]
        if not cache.is_warm("static_entries"):
            listener.say("compiling the equations of rest (only the first run does this)")
        _compile_derivatives(facts.residual, used, listener)
        import_module("nivel.kernels.tangent_entries")
        import_module("nivel.kernels.static_entries")
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


def complex_modules() -> list[str]:
    """Modules of families that exact derivatives may need on complex numbers."""
    families = dict.fromkeys([*(family for kind in FORCES.values() for family in kind.families), *BEAMS, STATE_FAMILY])
    residuals = [path.residual for path in (*PATHS.values(), *FLEXIBLE.values()) if path.residual]
    residuals += [module for facts in INTEGRATORS.values() for module in (facts.whole, facts.whole_flexible) if module]
    of_forces = [f"nivel.kernels.forces.{family}" for family in families]
    return [*dict.fromkeys(residuals), MEASURE, RAIL, GIVEN_FRICTION, POINTS, OF_MODES, OF_SLIDERS, *of_forces]


def _compile_derivatives(residual: str, used: Sequence[str], listener: Listener, *, held: bool = True) -> None:
    """The residual, and what a run uses of families, for exact derivatives. held : those of elements of beams are found by hand."""
    needed = [residual, *(module for module in complex_modules() if module in used)]
    if ELASTIC in needed and held:
        needed[needed.index(ELASTIC)] = HELD
    if FRICTION in used:
        needed.append(GIVEN_FRICTION)
    cold = [module for module in needed if not cache.is_warm_on_complex_numbers(module.rsplit(".", 1)[1])]
    for module in needed:
        if module in cold:
            place = f"{cold.index(module) + 1}/{len(cold)}"
            listener.say(
                f"compiling exact derivatives of {module.rsplit('.', 1)[1]} ({place}; only the first run does this)"
            )
        import_module("nivel.kernels.hook").compile_on_complex_numbers(import_module(module))


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
