"""Sufficiency of the modes of a flexible body for its run: how far modes that it leaves out would bend it, under the loads that it bore.

The loads on the modes that are left out are the residual of a finer basis, see `nivel.flexible.body.body`: from the
accelerations of the body, and from the forces at its interfaces. Those of joints are known; the others follow from the equations of the
body itself.
"""

from collections.abc import Iterator
from typing import Final

import numpy as np

from nivel.elements.joints import JOINTS
from nivel.elements.joints.kind import POINT
from nivel.judge.after.checks.beams import MESH
from nivel.judge.after.flexible_bodies import Bent, ModalBody, numbered_bodies
from nivel.judge.after.report import FRAMES, STEPS, Check, Need
from nivel.judge.after.subject import Equilibria, Run
from nivel.known import Interface, Invariants, LeftOut, MeshError, Prepared
from nivel.lazy import Struct, nivel, replace
from nivel.machine.core.vectors import Array
from nivel.machine.machine_record import MachineRecord
from nivel.results.scales import Readable, rotated
from nivel.results.trust import Item, Threshold, number
from nivel.system.joint_frames import joint_frames

BACK = np.array([1.0, -1.0, -1.0, -1.0])  # on Euler parameters: from global axes to those of a body
MOST_FRAMES = 4000  # that are looked at, at most
STRAIGHT = 1e-4  # of its size: a body that bends by less is compared with one that bends by as much
FITS = 1e-3  # misfit, as a share, with which the forces at one interface explain the motion of a body
# of the lowest frequency that is left out: vibrations above it may be of modes that the body does not have
NEAR_LEFT = 0.8
LEAST_PART = 1e-2  # of the energy of a vibration: a body with less hardly takes part in it
DAMPED_MOST = 0.99  # of critical
NEAR = 1e-3  # of the size of a body: an interface so near to a marker is the one it is at
ENERGY_LEFT_OUT = Threshold(
    1e-2,
    1e-1,
    "Energy of the modes that are left out, as a share of the strain energy of the body (at least of that of a deflection of 1e-4 of "
    "its size). Displacements are too small by about this share. Stiffness is known to about a hundredth; a tenth is visible.",
)


class Held(Struct):
    """A joint of this name at interface `at`: `sign` of its reaction as the result has it, 1 on its first body."""

    joint: str
    at: int
    sign: float


class Basis(Struct):
    """The modes of a body. its : inertia invariants; left : modes left out, phi at the interfaces in use alone. phi (i, 6, n) and place
    (i, 3) [m] : of these interfaces. damping (n,) [1/s], damping_ratio : of the modes. gravity (3,) [m/s²]. mesh :
    what its mesh makes wrong, where it is known."""

    body: ModalBody
    its: Invariants
    left: LeftOut
    phi: Array
    place: Array
    damping: Array
    damping_ratio: float
    gravity: Array
    held: tuple[Held, ...]
    mesh: MeshError | None = None


class Lacking(Struct):
    """A body that lacks modes: energy of those left out as a share of its own, when [s], and the frequency [Hz] of the one with most."""

    body: str
    share: float
    time: float
    frequency: float
    modes: int


class Unsure(Struct):
    """A vibration whose frequency [Hz] is too high by the share `share` of it, 1 at most, by modes that the body lacks, of which the lowest
    is at `lowest` [Hz]."""

    body: str
    number: int
    frequency: float
    share: float
    lowest: float


class _Motion(Struct):
    """Of a body in its own axes: a (t, 3) less gravity, alpha, omega; modal p, pdot, pddot (t, n)."""

    a: Array
    alpha: Array
    omega: Array
    p: Array
    pdot: Array
    pddot: Array


def say(found: Lacking) -> Item:
    """Which modes would have how much energy."""
    said = (
        f"Modes: {found.body} has {found.modes} modes; those left out, mainly one at {number(found.frequency)} Hz, would have "
        f"{number(found.share)} of its strain energy at t = {found.time:.6g} s; use more `modes`"
    )
    return ENERGY_LEFT_OUT.item("modes", said, found.share, found.time, found.body)


def _say_unsure(found: Unsure) -> Item:
    said = (
        f"Modes: the frequency of vibration {found.number}, {number(found.frequency)} Hz, is too high by about {number(found.share)} of "
        f"it, because {found.body} leaves out modes from {number(found.lowest)} Hz on; use more `modes`"
    )
    return ENERGY_LEFT_OUT.item("modes", said, found.share, None, found.body)


def _say_mesh(found: Bent) -> Item:
    said = (
        f"Mesh: the finite elements of {found.body} have an error of {number(found.value)} of its strain energy at t = {found.time:.6g} s; "
        f"reduce it with smaller elements"
    )
    return MESH.item("mesh", said, found.value, found.time, found.body)


def modal_bases(machine: MachineRecord, prepared: Prepared) -> list[Basis]:
    """The modes of these bodies as far as files say what they leave out."""
    out, tables = [], prepared.motion.system.record.flexible
    for (f, each), body in numbered_bodies(machine):
        left = each.reduced.left_out
        if left is None:
            continue
        places = tables.place_b[tables.frame[:, 0] == f]
        used = sorted({_nearest(each.reduced.interfaces, place) for place in places})
        if not used:
            continue
        interfaces = [each.reduced.interfaces[k] for k in used]
        flexible = machine.bodies[each.body].flexible
        out.append(
            Basis(
                body=body,
                its=each.reduced.invariants,
                left=replace(left, phi=left.phi[used]),
                phi=np.array([np.vstack([its.phi, its.psi]) for its in interfaces]),
                place=np.array([its.position for its in interfaces]),
                damping=each.damping,
                damping_ratio=getattr(flexible, "damping_ratio", 0.0),
                gravity=np.array(machine.gravity, dtype=float),
                held=tuple(_held(machine, body, interfaces)),
                mesh=each.reduced.mesh_error,
            )
        )
    return out


def _nearest(interfaces: tuple[Interface, ...] | list[Interface], place: Array) -> int:
    return int(np.argmin([np.linalg.norm(each.position - place) for each in interfaces]))


def _held(whole: MachineRecord, body: ModalBody, interfaces: list[Interface]) -> Iterator[Held]:
    """The joints at these interfaces whose reactions on the body are known."""
    machine = nivel.system.beam_nodes.with_nodes(whole)
    for joint in whole.joints:
        if any(beam.name in (joint.bodies or ()) for beam in machine.beams):
            continue  # it slides along the beam
        for k, (name, point, _) in enumerate(joint_frames(machine, joint)):
            at = _nearest(interfaces, point)
            there = np.linalg.norm(interfaces[at].position - point) < NEAR * body.extent
            # of one point, the reaction on the second body is that on the first, turned round
            if name == body.name and there and (k == 0 or POINT in JOINTS[joint.type].of(joint).constraints):
                yield Held(joint.name, at, 1.0 if k == 0 else -1.0)


def look(subject: Run | Equilibria) -> Lacking | None:
    """The body that lacks most."""
    found = [_lacking(subject.result, each) for each in _bases(subject)]
    return max((each for each in found if each is not None), key=lambda each: each.share, default=None)


def _look_at_mesh(subject: Run | Equilibria) -> Bent | None:
    """The largest energy that meshes of bodies make wrong, as a share of their own."""
    found, result = None, subject.result
    frames = slice(None, None, max(1, len(result.time) // MOST_FRAMES))
    for each in _bases(subject):
        motion, mesh = _motion(result, each, frames), each.mesh
        scale = _own_energy(each, motion)
        if mesh is None or not scale > 0.0:
            continue
        stiffness = each.body.eigenvalues
        energy = 0.5 * motion.pddot**2 / stiffness if mesh.dynamic else 0.5 * motion.p**2 * stiffness
        wrong = np.nan_to_num(energy @ mesh.share)
        k = int(np.argmax(wrong))
        if found is None or float(wrong[k]) / scale > found.value:
            found = Bent(each.body.name, float(wrong[k]) / scale, float(result.time[frames][k]))
    return found


def _lacking(result: Readable, basis: Basis) -> Lacking | None:
    frames = slice(None, None, max(1, len(result.time) // MOST_FRAMES))
    time, left = result.time[frames], basis.left
    at_rest = "acceleration" not in result.variables
    if (len(time) < 2 and not at_rest) or not len(left.eigenvalues):
        return None
    motion = _motion(result, basis, frames)
    load = _load(basis, motion, _reactions(result, basis, frames))
    q = load / left.eigenvalues if at_rest else response(time, load, np.sqrt(left.eigenvalues), basis.damping_ratio)
    parts = 0.5 * left.eigenvalues * q**2
    missed = np.nan_to_num(parts.sum(axis=1))
    k = int(np.argmax(missed))
    scale = _own_energy(basis, motion)
    if not scale > 0.0:
        return None
    j = int(np.argmax(np.nan_to_num(parts[k])))
    frequency = float(np.sqrt(left.eigenvalues[j]) / (2.0 * np.pi))
    return Lacking(basis.body.name, float(missed[k]) / scale, float(time[k]), frequency, motion.p.shape[1])


def _load(basis: Basis, motion: _Motion, known: Array) -> Array:
    """(t, k) on the modes that are left out; known : (t, i, 6) forces at the interfaces."""
    left = basis.left
    load = _inertia(motion, left.I3, left.I4, left.I8) - motion.pddot @ left.mass.T - motion.p @ left.stiffness.T
    if np.any(left.phi):
        load = load + np.einsum("tia,iaj->tj", _forces(basis, motion, known), left.phi)
    return load


@np.errstate(over="ignore", invalid="ignore", divide="ignore")
def _look_at_vibrations(subject: Equilibria) -> Unsure | None:
    """The vibration about the last equilibrium whose frequency the modes that bodies leave out would lower most.

    Of unit modal mass a mode of the frequency ω_k that bears the load f in a vibration of ω takes f²/(ω_k² - ω²) of ω² (Rayleigh).
    """
    result = subject.result
    if "vibration_stiffness" not in result.variables or not len(result.time):
        return None
    last = slice(len(result.time) - 1, len(result.time))
    squares = result.array("vibration_stiffness", last)[0]
    moving = np.flatnonzero(squares > 0.0)
    out = list[Unsure]()
    for basis in _bases(subject):
        left, k = basis.left, result.coordinates["body"].index(basis.body.name)
        if not len(left.eigenvalues) or not len(moving):
            continue
        theta = result.array("orientation", last)[:, k] * BACK
        axes = np.repeat(theta, len(moving), axis=0)
        shift, turn = (rotated(axes, result.array(name, last)[0, moving, k]) for name in ("mode_shift", "mode_turn"))
        bent = result.array("mode_bending", last)[0, moving, basis.body.first : basis.body.last]
        omega2, none = squares[moving, None], np.zeros_like(shift)
        motion = _Motion(-omega2 * shift, -omega2 * turn, none, bent, np.zeros_like(bent), -omega2 * bent)
        load = _load(basis, motion, np.zeros((len(moving), len(basis.phi), 6)))
        lowest = float(left.eigenvalues.min())
        lowered = (load**2 / np.maximum(left.eigenvalues - omega2, 1e-300)).sum(axis=1) / squares[moving]
        share = np.where(squares[moving] < NEAR_LEFT**2 * lowest, 0.5 * lowered, 1.0)
        # a body that hardly takes part in a vibration says nothing of it
        part = squares[moving] * (bent**2).sum(axis=1) + (bent**2) @ basis.body.eigenvalues
        share = np.where(part > LEAST_PART * squares[moving], share, 0.0)
        frequency = np.sqrt(squares[moving]) / (2.0 * np.pi)
        for j, k in enumerate(moving):
            its = min(float(np.nan_to_num(share[j], nan=np.inf, posinf=np.inf)), 1.0)
            out.append(Unsure(basis.body.name, int(k) + 1, float(frequency[j]), its, lowest**0.5 / (2.0 * np.pi)))
    return max(out, key=lambda each: each.share, default=None)


def _motion(result: Readable, basis: Basis, frames: slice) -> _Motion:
    body = result.coordinates["body"].index(basis.body.name)
    own = slice(basis.body.first, basis.body.last)
    theta = result.array("orientation", frames)[:, body] * BACK
    p = result.array("modal_coordinate", frames)[:, own]
    if "acceleration" not in result.variables:  # at rest
        none, still = np.zeros((len(p), 3)), np.zeros_like(p)
        return _Motion(rotated(theta, none - basis.gravity), none, none, p, still, still)
    a = result.array("acceleration", frames)[:, body] - basis.gravity
    alpha, omega = (result.array(name, frames)[:, body] for name in ("angular_acceleration", "angular_velocity"))
    pdot, pddot = (result.array(f"modal_{name}", frames)[:, own] for name in ("rate", "acceleration"))
    return _Motion(rotated(theta, a), rotated(theta, alpha), rotated(theta, omega), p, pdot, pddot)


def _inertia(motion: _Motion, I3: Array, I4: Array, I8: Array) -> Array:
    """(t, k) generalised inertia forces of the moving frame on modes with these invariants."""
    spun = np.einsum("ta,kab,tb->tk", motion.omega, I8, motion.omega, optimize=True)
    return spun - motion.a @ I3 - motion.alpha @ I4


def _forces(basis: Basis, motion: _Motion, known: Array) -> Array:
    """(t, i, 6) forces and torques at the interfaces in use, axes of the body: those `known`, of joints, and what the balance of the body
    asks for besides, at one interface where that is enough."""
    equations, right = _balance(basis, motion)
    rest = right - np.einsum("eia,tia->te", equations, known)
    size = float(np.linalg.norm(right))
    if not np.isfinite(size) or np.linalg.norm(rest) <= FITS * size:
        return known
    for at in ([i] for i in range(len(basis.phi))):
        found = _solved(equations[:, at], rest)
        if np.linalg.norm(rest - np.einsum("eia,tia->te", equations[:, at], found)) <= FITS * size:
            known[:, at] += found
            return known
    return known + _solved(equations, rest)


def _solved(equations: Array, rest: Array) -> Array:
    """(t, i, 6) the forces of least norm that come nearest."""
    count = equations.shape[1]
    solution = np.linalg.lstsq(equations.reshape(len(equations), -1), rest.T, rcond=1e-10)[0]
    return np.array(solution.T, dtype=float).reshape(len(rest), count, 6)


def _reactions(result: Readable, basis: Basis, frames: slice) -> Array:
    """(t, i, 6) of the joints at the interfaces, axes of the body."""
    body = result.coordinates["body"].index(basis.body.name)
    theta = result.array("orientation", frames)[:, body] * BACK
    out = np.zeros((len(theta), len(basis.phi), 6))
    for each in basis.held:
        joint = result.coordinates["joint"].index(each.joint)
        for k, name in enumerate(("joint_force", "joint_torque")):
            out[:, each.at, 3 * k : 3 * k + 3] += each.sign * rotated(theta, result.array(name, frames)[:, joint])
    return out


def _balance(basis: Basis, motion: _Motion) -> tuple[Array, Array]:
    """(e, i, 6) what forces and torques at the interfaces do in the equations of the body, and (t, e) what they have to: force, torque
    over the size of the body, efforts on its modes over their largest displacement, all in N."""
    its, w, size = basis.its, motion.omega, basis.body.extent
    spin = np.cross(w, np.cross(w, its.I2))
    force = its.I1 * motion.a + np.cross(motion.alpha, its.I2) + spin + motion.pddot @ its.I3.T
    turning = motion.alpha @ its.I7 + np.cross(w, w @ its.I7)
    torque = np.cross(its.I2, motion.a) + turning + motion.pddot @ its.I4.T
    modal = motion.pddot + basis.damping * motion.pdot + basis.body.eigenvalues * motion.p
    modal = modal - _inertia(motion, its.I3, its.I4, its.I8)
    count = len(basis.place)
    lever = np.zeros((3, count, 6))
    for i, x in enumerate(basis.place):
        lever[:, i, :3] = np.array([[0.0, -x[2], x[1]], [x[2], 0.0, -x[0]], [-x[1], x[0], 0.0]])
        lever[:, i, 3:] = np.eye(3)
    push = np.zeros((3, count, 6))
    push[:, :, :3] = np.eye(3)[:, None, :]
    largest = np.abs(basis.phi[:, :3]).max(axis=(0, 1))
    seen = largest > 1e-9 * largest.max(initial=0.0)
    effort = (basis.phi[:, :, seen] / largest[seen]).transpose(2, 0, 1)
    equations = np.concatenate([push, lever / size, effort])
    return equations, np.hstack([force, torque / size, modal[:, seen] / largest[seen]])


def _own_energy(basis: Basis, motion: _Motion) -> float:
    """The largest strain energy of the body [J]; of one that bends by less than STRAIGHT, that of one bent like it by as much."""
    body = basis.body
    strain = np.nan_to_num(0.5 * (motion.p**2) @ body.eigenvalues)
    k = int(np.argmax(strain))
    bent = float(np.linalg.norm(np.einsum("aij,j->ai", body.modes, motion.p[k]), axis=1).max())
    return float(strain[k]) * max(1.0, STRAIGHT * body.extent / bent) ** 2 if bent > 0.0 else 0.0


def response(time: Array, load: Array, omega: Array, ratio: float) -> Array:
    """(t, k) q of q̈ + 2 ζ ω q̇ + ω² q = load (t, k), exact for loads that are straight between the times, from rest under the first."""
    zeta = min(ratio, DAMPED_MOST)
    s = omega * (-zeta + 1j * np.sqrt(1.0 - zeta**2))
    z = np.empty(load.shape, dtype=complex)
    z[0] = -load[0] / s
    step, grown = 0.0, np.ones_like(s)
    for k in range(1, len(time)):
        if time[k] - time[k - 1] != step:
            step = time[k] - time[k - 1]
            grown = np.exp(s * step)
        change = (load[k] - load[k - 1]) / (s * step)
        z[k] = grown * (z[k - 1] + load[k - 1] / s + change / s) - load[k] / s - change / s
    return np.imag(z) / np.imag(s)


def _bases(subject: Run | Equilibria) -> list[Basis]:
    return modal_bases(subject.machine, subject.prepared) if subject.machine.is_flexible else []


MOVING: Final = Need(
    "steps, or states of equilibrium",
    lambda subject: FRAMES.met(subject) and (isinstance(subject, Equilibria) or STEPS.met(subject)),
)


CHECKS = (
    Check("body_mesh", (Run, Equilibria), _look_at_mesh, _say_mesh, 290, (MOVING,), line="mesh", quiet=True),
    Check("modes", (Run, Equilibria), look, say, 300, (MOVING,), "Modes", ENERGY_LEFT_OUT, quiet=True),
    Check("vibration_modes", Equilibria, _look_at_vibrations, _say_unsure, 302, (FRAMES,), line="modes", quiet=True),
)
