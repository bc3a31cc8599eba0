"""Flexible bodies of a machine, as the checks look at them: their modes, and where these stand in a result."""

from collections.abc import Iterator

import numpy as np

from nivel.lazy import Struct
from nivel.machine.core.vectors import Array
from nivel.machine.machine_record import MachineRecord
from nivel.results.scales import Readable
from nivel.system.flexible import Bending, bending_bodies

MODAL = ("modal_coordinate", "modal_rate", "modal_acceleration")  # of a result


class ModalBody(Struct):
    """A body that bends: its modal coordinates are the columns first to last - 1 of a run. eigenvalues (n,) [1/s²]; position (N, 3) [m] and
    modes (N, 3, n) of its nodes; stiffened : whether it has geometric stiffness."""

    name: str
    first: int
    last: int
    eigenvalues: Array
    position: Array
    modes: Array
    stiffened: bool

    @property
    def extent(self) -> float:
        """The diagonal of the box around its nodes [m]."""
        return float(np.linalg.norm(np.ptp(self.position, axis=0)))

    @property
    def reach(self) -> Array:
        """(n,) how far each mode displaces the node that it moves most, for a modal coordinate of one [1/kg^0.5]."""
        return np.linalg.norm(self.modes, axis=1).max(axis=0, initial=0.0)

    @property
    def axis(self) -> Array:
        """(3,) the direction in which it is longest."""
        return np.linalg.svd(self.position - self.position.mean(axis=0), full_matrices=False)[2][0]


class Bent(Struct):
    """What was found of a body, its largest value, and when [s]."""

    body: str
    value: float
    time: float


def modal_bodies(machine: MachineRecord) -> list[ModalBody]:
    """The flexible bodies of the machine; those that stand for beams bend by any amount."""
    return [body for _, body in numbered_bodies(machine)]


def numbered_bodies(machine: MachineRecord) -> Iterator[tuple[tuple[int, Bending], ModalBody]]:
    """Each flexible body that stands for no node of a beam, with its number among those that bend."""
    first = 0
    for f, each in enumerate(bending_bodies(machine) if machine.is_flexible else ()):
        its, last = each.reduced, first + len(each.reduced.eigenvalues)
        if not each.beam:
            name, modes = machine.bodies[each.body].name, np.nan_to_num(its.modes[:, :3])
            body = ModalBody(name, first, last, its.eigenvalues, its.position, modes, bool(its.stiffening))
            yield (f, each), body
        first = last


class PointRanges(Struct):
    """Ranges, over a run, of the motion of the points of a flexible body: displacement by bending [m], speed [m/s], acceleration [m/s²].
    modal (n,) [kg^0.5 m] : of each modal coordinate, what displaces a node by this displacement, or strains the body as much as it is
    strained, whichever is less."""

    displacement: float
    speed: float
    acceleration: float
    modal: Array


@np.errstate(divide="ignore", invalid="ignore")
def point_ranges(result: Readable, body: ModalBody) -> PointRanges:
    """The largest of what the modes of a body do to its points one by one, and of what its frame does."""
    k, own, reach = result.coordinates["body"].index(body.name), slice(body.first, body.last), body.reach
    bent = np.ptp(result.array("modal_coordinate")[:, own], axis=0)
    displacement = float(np.max(reach * bent, initial=0.0))

    def largest(modal: str, linear: str, angular: str) -> float:
        by_modes = reach * np.ptp(result.array(modal)[:, own], axis=0)
        moved, turned = (np.linalg.norm(np.ptp(result.array(name)[:, k], axis=0)) for name in (linear, angular))
        return float(max(moved, body.extent * turned, np.max(by_modes, initial=0.0)))

    # strain energy of a mode of unit modal mass: (ω q)²/2
    omega = np.sqrt(np.maximum(body.eigenvalues, 0.0))
    modal = np.fmin(displacement / reach, np.max(omega * bent, initial=0.0) / omega)
    speed = largest("modal_rate", "velocity", "angular_velocity")
    return PointRanges(
        displacement, speed, largest("modal_acceleration", "acceleration", "angular_acceleration"), modal
    )
