"""Sufficiency of the modes of a flexible body for its run: how far modes that it leaves out would bend it, under the loads that it bore.

The loads on the modes that are left out are the residual of a finer basis, see `nivel.flexible.body.truncated_modes`: from the
accelerations of the body, and from the forces at its interfaces. Those of joints are known; the others follow from the equations of the
body itself.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.trust.check import STEPS, Check
from nivel.analysis.trust.checks.beam_mesh import THRESHOLD as MESH
from nivel.analysis.trust.flexible_bodies import Bent, ModalBody, numbered_bodies
from nivel.analysis.trust.subject import Run
from nivel.machine.machine_record import MachineRecord
from nivel.results.scales import Readable, rotated
from nivel.results.trust import Item, Threshold, number
from nivel.system.beams.nodes import with_nodes
from nivel.system.joints.composition import POINT
from nivel.system.joints.joint_frames import joint_frames
from nivel.system.joints.joints import composition_of

if TYPE_CHECKING:
    from nivel.analysis.preparation.preparation import Prepared
    from nivel.flexible.body.body import Interface, MeshError
    from nivel.flexible.body.invariants import Invariants
    from nivel.flexible.body.truncated_modes import LeftOut

Array = NDArray[np.float64]
FRAMES = 4000  # that are looked at, at most
STRAIGHT = 1e-4  # of its size: a body that bends by less is compared with one that bends by as much
FITS = 1e-3  # misfit, as a share, with which the forces at one interface explain the motion of a body
DAMPED_MOST = 0.99  # of critical
NEAR = 1e-3  # of the size of a body: an interface so near to a marker is the one it is at
THRESHOLD = Threshold(
    1e-2,
    1e-1,
    "Energy of the modes that are left out, as a share of the strain energy of the body (at least of that of a deflection of 1e-4 of "
    "its size). Displacements are too small by about this share. Stiffness is known to about a hundredth; a tenth is visible.",
)


@dataclass(frozen=True)
class Held:
    """A joint of this name at interface `at`: `sign` of its reaction as the result has it, 1 on its first body."""

    joint: str
    at: int
    sign: float


@dataclass(frozen=True)
class Basis:
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


@dataclass(frozen=True)
class Lacking:
    """A body that lacks modes: energy of those left out as a share of its own, when [s], and the frequency [Hz] of the one with most."""

    body: str
    share: float
    time: float
    frequency: float
    modes: int


@dataclass(frozen=True)
class _Motion:
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
    return THRESHOLD.item("modes", said, found.share, found.time, found.body)


def say_mesh(found: Bent) -> Item:
    """What the mesh of a body makes wrong."""
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
    machine = with_nodes(whole)
    for joint in whole.joints:
        if any(beam.name in (joint.bodies or ()) for beam in machine.beams):
            continue  # it slides along the beam
        for k, (name, point, _) in enumerate(joint_frames(machine, joint)):
            at = _nearest(interfaces, point)
            there = np.linalg.norm(interfaces[at].position - point) < NEAR * body.extent
            # of one point, the reaction on the second body is that on the first, turned round
            if name == body.name and there and (k == 0 or POINT in composition_of(joint).constraints):
                yield Held(joint.name, at, 1.0 if k == 0 else -1.0)


def look(run: Run) -> Lacking | None:
    """The body that lacks most."""
    found = [_lacking(run.result, each) for each in modal_bases(run.machine, run.prepared)]
    return max((each for each in found if each is not None), key=lambda each: each.share, default=None)


def look_at_mesh(run: Run) -> Bent | None:
    """The largest energy that meshes of bodies make wrong, as a share of their own."""
    found, result = None, run.result
    frames = slice(None, None, max(1, len(result.time) // FRAMES))
    for each in modal_bases(run.machine, run.prepared):
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
    frames = slice(None, None, max(1, len(result.time) // FRAMES))
    time, left = result.time[frames], basis.left
    if len(time) < 2 or not len(left.eigenvalues):
        return None
    motion = _motion(result, basis, frames)
    load = _inertia(motion, left.I3, left.I4, left.I8) - motion.pddot @ left.mass.T - motion.p @ left.stiffness.T
    if np.any(left.phi):
        forces = _forces(result, basis, motion, frames)
        load = load + np.einsum("tia,iaj->tj", forces, left.phi)
    q = response(time, load, np.sqrt(left.eigenvalues), basis.damping_ratio)
    parts = 0.5 * left.eigenvalues * q**2
    missed = np.nan_to_num(parts.sum(axis=1))
    k = int(np.argmax(missed))
    scale = _own_energy(basis, motion)
    if not scale > 0.0:
        return None
    j = int(np.argmax(np.nan_to_num(parts[k])))
    frequency = float(np.sqrt(left.eigenvalues[j]) / (2.0 * np.pi))
    return Lacking(basis.body.name, float(missed[k]) / scale, float(time[k]), frequency, motion.p.shape[1])


def _motion(result: Readable, basis: Basis, frames: slice) -> _Motion:
    body = result.coordinates["body"].index(basis.body.name)
    own = slice(basis.body.first, basis.body.last)
    theta = result.array("orientation", frames)[:, body] * np.array([1.0, -1.0, -1.0, -1.0])
    a = result.array("acceleration", frames)[:, body] - basis.gravity
    vectors = (a, *(result.array(name, frames)[:, body] for name in ("angular_acceleration", "angular_velocity")))
    modal = (result.array(f"modal_{name}", frames)[:, own] for name in ("coordinate", "rate", "acceleration"))
    return _Motion(*(rotated(theta, each) for each in vectors), *modal)


def _inertia(motion: _Motion, I3: Array, I4: Array, I8: Array) -> Array:
    """(t, k) generalised inertia forces of the moving frame on modes with these invariants."""
    spun = np.einsum("ta,kab,tb->tk", motion.omega, I8, motion.omega, optimize=True)
    return spun - motion.a @ I3 - motion.alpha @ I4


def _forces(result: Readable, basis: Basis, motion: _Motion, frames: slice) -> Array:
    """(t, i, 6) forces and torques at the interfaces in use, axes of the body: those of joints, and what the balance of the body asks for
    besides, at one interface where that is enough."""
    known = _reactions(result, basis, frames)
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
    theta = result.array("orientation", frames)[:, body] * np.array([1.0, -1.0, -1.0, -1.0])
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


CHECKS = (
    Check("body_mesh", Run, look_at_mesh, say_mesh, 290, (STEPS,), line="mesh", quiet=True),
    Check("modes", Run, look, say, 300, (STEPS,), "Modes", THRESHOLD, quiet=True),
)
