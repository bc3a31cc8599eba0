"""Refusals before a run whose numbers would mean nothing, though the machine can be assembled."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any

from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.assembly.redundancy import Redundancy
from nivel.analysis.curves.corners import corners_of
from nivel.analysis.plan.choice import screws_as_couplings
from nivel.errors import Fault
from nivel.integrate.catalogue import INTEGRATORS
from nivel.known import Contact, Contacts, Delay, Friction, Stop, TransmissionLoss
from nivel.lazy import Struct, nivel
from nivel.machine.core.element import ForceElement
from nivel.machine.laws.functions import functions_in
from nivel.machine.laws.python_law import PythonLaw
from nivel.machine.laws.varying_value import Expression, Table
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.run import SimulationSettings
from nivel.machine.units.functions import SMOOTH
from nivel.machine.uses.coordinate_reference import resolve
from nivel.methods import chooses
from nivel.motion.catalogue import FORMULATIONS
from nivel.system.laws.laws import false_derivative
from nivel.system.layout import reported
from nivel.system.system import Array

# Stops and contacts may start inside what they touch by this share of the machine's length, or of a radian.
DEEPEST_START = 0.02
# Times of samples are ends of steps to this share.
WHOLE = 1e-9
# The assembly may move a node of a beam by this share of the machine's length, or of a radian.
FITS = 1e-8
# and change its speed by this share of the machine's.
BLOW = 1e-3


class Refusal(Struct):
    """What an analysis refuses: elements of a section of the machine file that it `applies` to, by the `key` of each, and why.

    text : of an element where it names something of that.
    """

    section: str
    key: str
    applies: Callable[[Any], bool]
    text: str | Callable[[Any], str]

    def faults(self, machine: MachineRecord) -> Iterator[Fault]:
        """Of all elements that it applies to."""
        for element in filter(self.applies, getattr(machine, self.section)):
            text = self.text if isinstance(self.text, str) else self.text(element)
            yield Fault.at(f"{self.section}.{element.name}{self.key and f'.{self.key}'}", text)


# of what neither knows how soil was changed before, nor changes it
SOIL = "what soil bears depends on how it was pressed and cut before, which runs know: `nivel run`, `nivel live` or `machine.start()`"
ON_SOIL = Refusal("forces", "", lambda force: getattr(force, "soil", None) is not None, SOIL)


def faults_of(machine: MachineRecord, refusals: Iterable[Refusal]) -> Iterator[Fault]:
    """Everything in a machine that is refused."""
    return (fault for refusal in refusals for fault in refusal.faults(machine))


def rolling(instead: str) -> Refusal:
    """Of every wheel: it ties velocities, so positions alone do not say how it may move. instead : what to do, in words."""
    reason = "constrains velocities, not positions, so the position of a wheel depends on its path"
    return Refusal(
        "joints", "type", lambda joint: joint.type == "rolling", f"'rolling' without slip {reason}: {instead}"
    )


def deep_starts(machine: MachineRecord, motion: MotionEquations, y: Array) -> Iterator[Fault]:
    """Stops and contacts that start far inside what they touch: they would throw the machine apart."""
    if not any(isinstance(force, Stop | Contact | Contacts) for force in machine.forces):
        return
    motion.evaluate(0.0, y)
    system = motion.system
    values = system.record.outputs.value
    reports = reported(system.layout, len(values))
    names = [variable.name for variable in reports]
    for force in machine.forces:
        if isinstance(force, Stop | Contact | Contacts):
            place = names.index(f"force.{force.name}.depth")
            depth, units = float(values[place]), reports[place].units
            deepest = DEEPEST_START * (system.size if units == "m" else 1.0)
            if depth > deepest:
                yield Fault.at(
                    f"forces.{force.name}",
                    f"starts {depth:.4g} {units} inside what it touches (up to {deepest:.3g} {units} are taken): the contact force "
                    f"would be huge; move the bodies, or the limits of the stop",
                )


def sampled_times(machine: MachineRecord) -> list[tuple[str, float]]:
    """Periods, offsets and latencies of sampled states and blocks [s] that are not zero, with where they stand."""
    times = [(f"states.{state.name}.every", state.every or 0.0) for state in machine.states]
    on_soil: list[Any] = [*filter(ON_SOIL.applies, machine.forces)]
    times += [(f"forces.{each.name}.soil.period", each.soil.period) for each in on_soil]
    times += [
        (f"control.{block.name}.{key}", getattr(block, key) or 0.0)
        for block in machine.control
        for key in ("sample_time", "offset", "latency", *(("time",) if isinstance(block, Delay) else ()))
    ]
    return [(place, time) for place, time in times if time]


def samples_between_steps(machine: MachineRecord, step: float) -> Iterator[Fault]:
    """Sampled states and blocks whose times are not ends of fixed steps [s]."""
    for place, time in sampled_times(machine):
        count = round(time / step)
        if count < 1 or abs(count * step - time) > WHOLE * time:
            yield Fault.at(
                place,
                f"{time:.6g} s is no whole number of steps of {step:.6g} s: use `simulation: {{step: {time / max(count, 1):.6g}}}`, "
                f"or an integrator that chooses its steps",
            )


def unsettled_multipliers(machine: MachineRecord, constraints: int) -> Iterator[Fault]:
    """Methods without any damping as index 3: what a jump of the load leaves in the multipliers then alternates for ever."""
    settings = machine.simulation
    undamped = {
        "newmark": settings.newmark.gamma == 0.5,
        "hht": settings.hht.alpha == 0.0,
        "generalised-alpha": settings.generalised_alpha.spectral_radius == 1.0,
    }
    if constraints and settings.stabilisation == "none" and undamped.get(settings.integrator):
        yield Fault.at(
            "simulation.stabilisation",
            f"'none' makes `integrator: {settings.integrator}` solve the positions' constraints alone (index 3), and without "
            f"damping its multipliers oscillate after a load changes: use direct (stabilised index 2), or damping: "
            f"`generalised_alpha: {{spectral_radius: 0.8}}`, `hht: {{alpha: 0.1}}`",
        )


def stiction_over_steps(machine: MachineRecord) -> Iterator[Fault]:
    """Stiction is a law of the acceleration at a time, of which a balance over a whole step knows nothing."""
    integrator = machine.simulation.integrator
    at_once = INTEGRATORS[integrator].needs == "whole steps"
    for force in (force for force in machine.forces if at_once and force.sticks):
        key = _key_of_model(force)
        instead = {"model": "`model: lugre`", "type": "leave it out"}.get(key, "`friction_model: coulomb`")
        yield Fault.at(
            f"forces.{force.name}.{key}",
            f"'stiction' does not go with `integrator: {integrator}`, which balances momenta over whole steps, while sticking depends on "
            f"the acceleration at a time: use generalised-alpha, or {instead}",
        )


def _key_of_model(force: ForceElement) -> str:
    return "model" if isinstance(force, Friction) else "friction_model" if isinstance(force, Contact) else "type"


def conserved_drivers(machine: MachineRecord) -> Iterator[Fault]:
    """Drivers prescribe speeds, which the energy constraint would have to scale. What a fixed step misses of a contact that begins in
    it is no drift either: to scale all velocities for it would take momentum where no force does."""
    if machine.simulation.stabilisation != "geometric":
        return
    sudden = [force.name for force in machine.forces if isinstance(force, Contact | Contacts | Stop)]
    if sudden and not chooses(machine.simulation.integrator, machine.simulation.step_control):
        yield Fault.at(
            "simulation.stabilisation",
            f"'geometric' scales all velocities to conserve energy. It would also correct the error of a fixed step in which "
            f"{', '.join(sudden)} begin{'s' * (len(sudden) == 1)} to touch: use direct, or `integrator: dopri5`, whose steps end there",
        )
    if machine.drivers:
        names = ", ".join(driver.name for driver in machine.drivers)
        yield Fault.at(
            "simulation.stabilisation",
            f"'geometric' scales velocities to conserve energy, and {names} prescribe{'s' * (len(machine.drivers) == 1)} "
            f"velocities: take direct",
        )


def rough_motions(machine: MachineRecord) -> Iterator[Fault]:
    """Tables of drivers whose speed jumps, for integrators that would lose the jump within a step. Laws whose derivatives are not those of
    what they return."""
    settings = machine.simulation
    for owner, table in _motions(machine):
        message = ""
        if isinstance(table, PythonLaw) and (wrong := false_derivative(table, settings.duration)):
            message = f"the law `{table.function}` must return consistent value, rate and acceleration: {wrong}"
        elif isinstance(table, Table) and INTEGRATORS[settings.integrator].ends != "jumps":
            message = _jump_of(table, settings)
        if message:
            yield Fault.at(owner, message)


def _motions(machine: MachineRecord) -> Iterator[tuple[str, Expression | Table | PythonLaw]]:
    """The functions by which drivers move a machine, each with its place in the file: `drivers.lift.value`, or the list where it stands."""
    for driver in machine.drivers:
        for place, function in functions_in(driver):
            if place not in nivel.elements.joints.drivers.RATES:
                key = place if place == "value" else place.rpartition(".")[0] or place
                yield f"drivers.{driver.name}.{key}", function


def friction_at_jumps(machine: MachineRecord) -> Iterator[Fault]:
    """Friction loaded by reactions where the speed of a driver jumps: the impulse through the joints would ask for one of friction."""
    end = machine.simulation.duration
    tables = [(owner.split(".")[1], motion) for owner, motion in _motions(machine) if isinstance(motion, Table)]
    straight = [
        name
        for name, table in tables
        if table.interpolation == "linear" and min(corners_of(table, end), default=end) < end
    ]
    jumping = [name for name, table in tables if table.ends_before(end) or name in straight]
    loaded = [
        force.name
        for force in machine.forces
        if (isinstance(force, Friction) and force.normal_load is None) or isinstance(force, TransmissionLoss)
    ]
    if jumping and loaded:
        message = (
            f"the speed of {', '.join(jumping)} jumps, and the friction of {', '.join(loaded)} is loaded by reactions, which are impulses "
            f"there: give a `normal_load`, or take `interpolation: cubic` for the driver"
        )
        yield from (Fault.at(f"forces.{name}.normal_load", message) for name in loaded)


def _jump_of(table: Table, settings: SimulationSettings) -> str:
    """What is wrong with a table of a driver for an integrator that does not stop where its speed jumps; empty: nothing."""
    end, first, last = settings.duration, table.times[0], table.times[-1]
    lost = (
        f"`integrator: {settings.integrator}` would lose the jump within a step: take `integrator: newmark`, hht or generalised-alpha, "
        f"whose steps end there and begin with the new speed"
    )
    if (first > 0.0 and table.interpolation not in SMOOTH) or table.ends_before(end):
        return (
            f"the table holds from {first:.6g} to {last:.6g} s and the run lasts from 0 to {end:.6g} s: beyond its ends the speed jumps to "
            f"zero, and {lost}; or add points, or run for {last:.6g} s"
        )
    times = [time for time in corners_of(table, end) if time < last]
    if table.interpolation == "linear" and times:
        named = ", ".join(f"{time:.6g}" for time in times[:3]) + (", …" if len(times) > 3 else "")
        return f"the speed of straight lines jumps at {named} s, and {lost}; or take `interpolation: cubic`, which has no corners"
    return ""


def shared_mass(machine: MachineRecord, formulation: str, coordinates: str) -> Iterator[Fault]:
    """Methods that need a mass matrix of single bodies, for beams of consistent mass."""
    if not machine.shares_mass:
        return
    names = ", ".join(beam.name for beam in machine.beams if beam.shares_mass)
    gradients = ", ".join(f"the {beam.model} {beam.name}" for beam in machine.beams if beam.has_gradients)
    exact = "beams of `model: segments`, or geometrically-exact ones of `mass: lumped`"
    lumped = exact if gradients else "`mass: lumped` for the beams"
    why = f"does not go with the consistent mass of {names}: take {{}}, or {lumped}"
    integrator = machine.simulation.integrator
    if coordinates not in ("absolute", "relative"):
        yield Fault.at("simulation.coordinates", f"'{coordinates}' {why.format('absolute or relative')}")
    if formulation != "newton-euler":
        yield Fault.at("simulation.formulation", f"'{formulation}' {why.format('newton-euler')}")
    if INTEGRATORS[integrator].needs == "whole steps" and gradients:
        yield Fault.at(
            "simulation.integrator",
            f"'{integrator}' does not go with {gradients}, because the velocities of its gradients are not the mean of those at both ends "
            f"of a step: use generalised-alpha, or beams of another `model`",
        )
    for force in machine.forces:
        if isinstance(force, Friction) and not INTEGRATORS[integrator].residual:
            message = f"friction under `integrator: {integrator}` {why.format('generalised-alpha')}"
            yield Fault.at(f"forces.{force.name}", message)
        elif force.sticks:
            message = f"'stiction' {why.format('lugre or coulomb' if isinstance(force, Friction) else 'coulomb')}"
            yield Fault.at(f"forces.{force.name}.{_key_of_model(force)}", message)


def flexible_lagrange(machine: MachineRecord, formulation: str) -> Iterator[Fault]:
    """The Lagrange equations, which are for rigid bodies."""
    names = ", ".join(body.name for body in machine.bodies if body.flexible is not None)
    if names and formulation == "lagrange":
        message = f"'lagrange' does not go with flexible bodies ({names}): take `formulation: newton-euler`, whose motion is the same"
        yield Fault.at("simulation.formulation", message)


def moved_nodes(machine: MachineRecord, moved: Sequence[tuple[str, float, float]], size: float) -> Iterator[Fault]:
    """Beams that the assembly would stress, by moving single nodes of them. moved : body, distance [m], angle [rad]."""
    owners = {name: beam.name for beam in machine.beams for name in beam.node_names}
    for name, distance, angle in moved:
        if name in owners and max(distance / size, angle) > FITS:
            yield Fault.at(
                f"beams.{owners[name]}",
                f"its joints do not fit: the assembly would move its node {name} by {distance:.3g} m and {angle:.3g} rad, and stress it; "
                f"place the beam, or what is joined to it, so that they meet to {FITS * size:.0e} m, and drivers so that they start there",
            )


def struck_nodes(
    machine: MachineRecord, changes: Sequence[tuple[str, float, float]], speed: float, turning: float
) -> Iterator[Fault]:
    """Velocities of joints that the assembly would give to single nodes of beams: an impact, not a motion. Drivers may strike them.

    changes : body, speed [m/s], angular speed [rad/s]. speed, turning : largest ones of the machine [m/s, rad/s].
    """
    owners = {name: beam.name for beam in machine.beams for name in beam.node_names}
    for name, change, turn in changes if not machine.drivers else ():
        if name in owners and (change > BLOW * speed or turn > BLOW * turning):
            yield Fault.at(
                f"beams.{owners[name]}",
                f"the velocities of its joints change that of its node {name} alone by {change:.3g} m/s and {turn:.3g} rad/s: an impact. "
                f"Give the beam the `velocity` of its start and the `angular_velocity` with which it moves as a rigid body",
            )


def uncertain_loads(
    machine: MachineRecord, redundancy: Redundancy, exact: Callable[[], tuple[str, ...]]
) -> Iterator[Fault]:
    """Friction whose normal load is a reaction that the equations do not determine: the motion would be one of many.

    exact : changes of joints with which nothing is redundant, in words.
    """
    for force in machine.forces:
        if not isinstance(force, Friction) or force.normal_load is not None:
            continue
        joint, _ = resolve(force.coordinate, machine.joints)
        if joint not in redundancy.non_unique_joints:
            continue
        rows, screws = redundancy.redundant_rows, list(screws_as_couplings(machine, redundancy.non_unique_joints))
        written = " and ".join(f"in place of the joint {name} under `couplings` `{line}`" for name, line in screws)
        how = f"write {written}" if screws else "replace joints until no constraint is redundant"
        if not screws and (changes := exact()):
            how = f"make {' and '.join(changes)}"
        yield Fault.at(
            f"forces.{force.name}.coordinate",
            f"the reaction of {joint}, which loads this friction, is not unique: {', '.join(rows)} "
            f"repeat{'s' if len(rows) == 1 else ''} other constraints; give a `normal_load`, or {how}",
        )


def rolling_by_positions(machine: MachineRecord, coordinates: str) -> Iterator[Fault]:
    """Wheels under methods whose multipliers close positions, and so would let them slip."""
    settings = machine.simulation
    integrator, name = INTEGRATORS[settings.integrator], f"`integrator: {settings.integrator}`"
    feeds_back = FORMULATIONS[settings.formulation].factor > 0.0
    closes_positions = settings.stabilisation == "none" and not feeds_back and coordinates != "independent"
    if integrator.needs == "whole steps":
        instead = f"{name} solves position constraints only; use generalised-alpha, radau or rk4"
        yield from rolling(instead).faults(machine)
    elif integrator.needs == "accelerations" and closes_positions:
        instead = f"with 'none' the multipliers of {name} close positions alone (index 3); take `stabilisation: direct`"
        yield from rolling(instead).faults(machine)
