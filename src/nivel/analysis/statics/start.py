"""The equilibrium from which a run in time starts."""

import numpy as np

from nivel.analysis.assembly.assemble import Assembly
from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.plan.plan import Methods, methods_of
from nivel.analysis.preparation.preparation import Assembled
from nivel.analysis.statics.critical import is_mechanism, softest
from nivel.analysis.statics.equations import StateError
from nivel.analysis.statics.free_coordinates import for_statics, refuse_moving
from nivel.analysis.statics.newton import EquilibriumError, Iteration
from nivel.analysis.statics.rigid_motions import of_whole
from nivel.analysis.statics.run import prepare_statics
from nivel.analysis.statics.search import no_start, settle, without_stiffness
from nivel.elements.contacts.contact import Contact, Contacts
from nivel.errors import Fault, ModelError, SolveError, refuse
from nivel.lazy import Struct, replace
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.analyses import StaticsSettings
from nivel.system.system import Array

# A constraint that changes by more than this share of its scale in a second moves at the start.
AT_REST = 1e-9


class Settled(Struct):
    """The positions q of all bodies (and modes) in equilibrium at t = 0, absolute coordinates, the angles of joints there, and the states
    of elements. machine : whose equilibrium it is."""

    machine: MachineRecord
    q: Array
    reference: Array
    states: Array

    def assembled(self, motion: MotionEquations, assembly: Assembly) -> Assembly:
        """The assembly with the bodies there, at rest. Raises ModelError where a driver moves at t = 0."""
        system = motion.system
        y = np.zeros_like(assembly.y)
        y[: system.positions] = self.q[: system.positions]
        # coordinates of joints come first; friction, which statics leaves out, may measure others behind them
        reference = system.record.coordinates.reference
        shared = min(len(reference), len(self.reference))
        reference[:shared] = self.reference[:shared]
        _, rate = motion.evaluate(0.0, y)
        constraints = system.record.constraints
        moving = np.abs(constraints.Cdot / constraints.scale)[: system.machine_rows] > AT_REST
        if np.any(moving):
            faults = [
                Fault.at(
                    f"drivers.{name}.value",
                    f"{name} moves at t = 0, and a run from equilibrium starts at rest: let it start slowly",
                )
                for name in dict.fromkeys(np.array(system.row_owner)[moving].tolist())
            ]
            raise ModelError(faults)
        count = system.body_count
        refuse_moving(self.machine, rate[system.positions :][: 6 * count].reshape(count, 6), system.size)
        return replace(assembly, y=y, reference=reference.copy(), velocity_change=(), followed=())


SETTINGS = StaticsSettings(duration=0.0, step=1.0, coordinates="absolute")


def methods_at_rest(machine: MachineRecord) -> Methods:
    """The methods by which `settled` finds the equilibrium."""
    return methods_of(for_statics(machine, SETTINGS)[0])


def _about_friction(machine: MachineRecord) -> str:
    """What to do where friction of contacts, which no equilibrium has, would hold a body."""
    if any(isinstance(each, Contact | Contacts) and each.friction for each in machine.forces):
        return (
            " Friction of contacts holds nothing in an equilibrium: what it alone holds begins with `start: as-given`."
        )
    return ""


def settled(machine: MachineRecord, given: Assembled | None = None) -> Settled:
    """The equilibrium of `machine` at t = 0; given : it is built and assembled already, with a record that may be changed.

    Raises ModelError where bodies or joints are given velocities, SolveError where there is no equilibrium.
    """
    _refuse_velocities(machine)
    prepared, equations = prepare_statics(machine, SETTINGS, given)
    try:
        found = settle(equations, equations.start(prepared.start), Iteration())
    except EquilibriumError as error:
        message, advice = no_start(equations, error)
        advice += _about_friction(machine)
        raise SolveError(f"the run starts from equilibrium, and {message}", time=0.0, advice=advice) from None
    except StateError:
        raise SolveError("the forces at t = 0 are not numbers", time=0.0, advice="Look at their laws.") from None
    loose = None if equations.states_move else softest(found.tangent)
    free = loose is not None and is_mechanism(loose)
    if loose is not None and free and not of_whole(equations, found.state, found.tangent).alone:
        message, advice = without_stiffness(equations, found.state, loose)
        advice += _about_friction(machine)
        raise SolveError(f"the run starts from equilibrium, and {message}", time=0.0, advice=advice)
    equations.follow(found.state)
    reference = equations.record.coordinates.reference.copy()
    y = found.state.y
    states = y[equations.first_state :][: equations.state_count]
    return Settled(machine, y[: equations.positions].copy(), reference, states.copy())


def _refuse_velocities(machine: MachineRecord) -> None:
    said = "`start: equilibrium` starts at rest: take the velocity away, or start as given"
    faults = [
        Fault.at(f"bodies.{body.name}.{key}", said)
        for body in machine.bodies
        for key in ("velocity", "angular_velocity", "angular_velocity_body")
        if np.any(np.array(getattr(body, key) or 0.0))
    ]
    faults += [
        Fault.at(f"joints.{joint.name}.start_rates", said)
        for joint in machine.joints
        if joint.start_rates is not None and any(joint.start_rates.given.values())
    ]
    refuse(faults)
