"""Facts of flexible bodies for the checks after a run: their modes, those left out, and what holds them where."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from nivel.analysis.plan.plan import Plan
from nivel.analysis.preparation.preparation import Prepared
from nivel.flexible.body.body import Interface
from nivel.results.trust.basis import Basis, Held
from nivel.results.trust.bending import ModalBody
from nivel.system.beams.nodes import with_nodes
from nivel.system.flexible import Bending, bending_bodies
from nivel.system.joints.joint_frames import joint_frames
from nivel.system.system import Array

# Joints whose two markers are one point, so that the reaction on the second body is that on the first, turned round.
ONE_POINT = ("spherical", "universal", "revolute", "fixed")
NEAR = 1e-3  # of the size of a body: an interface so near to a marker is the one it is at


def modal_bodies(plan: Plan) -> list[ModalBody]:
    """The flexible bodies of the machine; those that stand for beams bend by any amount."""
    return [body for _, body in _numbered(plan)]


def modal_bases(plan: Plan, prepared: Prepared) -> list[Basis]:
    """The modes of these bodies as far as files say what they leave out."""
    out, tables = [], prepared.motion.system.record.flexible
    for (f, each), body in (
        (number, body) for number, body in _numbered(plan) if number[1].reduced.left_out is not None
    ):
        places = tables.place_b[tables.frame[:, 0] == f]
        used = sorted({_nearest(each.reduced.interfaces, place) for place in places})
        if not used:
            continue
        left, interfaces = each.reduced.left_out, [each.reduced.interfaces[k] for k in used]
        assert left is not None
        flexible = plan.machine.bodies[each.body].flexible
        out.append(
            Basis(
                body=body,
                its=each.reduced.invariants,
                left=replace(left, phi=left.phi[used]),
                phi=np.array([np.vstack([its.phi, its.psi]) for its in interfaces]),
                place=np.array([its.position for its in interfaces]),
                damping=each.damping,
                damping_ratio=getattr(flexible, "damping_ratio", 0.0),
                gravity=np.array(plan.machine.gravity, dtype=float),
                held=tuple(_held(plan, body, interfaces)),
                mesh=each.reduced.mesh_error,
            )
        )
    return out


def _numbered(plan: Plan) -> Iterator[tuple[tuple[int, Bending], ModalBody]]:
    """Each flexible body that stands for no node of a beam, with its number among those that bend."""
    first = 0
    for f, each in enumerate(bending_bodies(plan.machine) if plan.machine.is_flexible else ()):
        its, last = each.reduced, first + len(each.reduced.eigenvalues)
        if not each.beam:
            name, modes = plan.machine.bodies[each.body].name, np.nan_to_num(its.modes[:, :3])
            body = ModalBody(name, first, last, its.eigenvalues, its.position, modes, bool(its.stiffening))
            yield (f, each), body
        first = last


def _nearest(interfaces: tuple[Interface, ...] | list[Interface], place: Array) -> int:
    return int(np.argmin([np.linalg.norm(each.position - place) for each in interfaces]))


def _held(plan: Plan, body: ModalBody, interfaces: list[Interface]) -> Iterator[Held]:
    """The joints at these interfaces whose reactions on the body are known."""
    machine = with_nodes(plan.machine)
    for joint in plan.machine.joints:
        if any(beam.name in (joint.bodies or ()) for beam in machine.beams):
            continue  # it slides along the beam
        for k, (name, point, _) in enumerate(joint_frames(machine, joint)):
            at = _nearest(interfaces, point)
            there = np.linalg.norm(interfaces[at].position - point) < NEAR * body.extent
            if name == body.name and there and (k == 0 or joint.type in ONE_POINT):
                yield Held(joint.name, at, 1.0 if k == 0 else -1.0)
