"""Beams: elements that are too long, and states near buckling.

Curvatures change within an element, which linear elements take for constant, and quadratic ones for linear. What they miss is estimated
by neighbours, as by a mesh of half the elements (Zienkiewicz, Zhu 1987): within an element of the length L a curvature changes by half
of what it differs by between the elements on both sides, c L, and ½ C c² L³/12 of bending energy is not there. Of quadratic elements it
is the slope of the curvature that changes, by d L, and ½ C d² L⁵/720 that is not there.

Near buckling a small error of the stiffness is a large one of the deflection. The lowest stiffness is extrapolated to finer elements:
where they would take all that is left of it, a state that was found is none.
"""

from collections.abc import Sequence
from typing import Final

import numpy as np

from nivel.analysis.assembly.equations import rotation_between
from nivel.judge.after.report import FRAMES, OTHERS, STEPS, Check
from nivel.judge.after.subject import Equilibria, Run
from nivel.lazy import Struct
from nivel.machine.core.orientation import euler_parameters_from_matrix
from nivel.machine.core.vectors import Array
from nivel.machine.machine_record import MachineRecord
from nivel.results.motion import common_frames
from nivel.results.scales import Readable, largest_mechanical_energy
from nivel.results.trust import Item, Threshold, number

MOST_FRAMES = 200  # that are looked at, at most
MESH = Threshold(
    1e-2,
    1e-1,
    "Displacements are too small by about the share of the energy that the elements miss. Stiffness is known to about a hundredth; a "
    "tenth is visible.",
)


class BeamMesh(Struct):
    """A beam of elements of this order, 1 or 2: nodes, their names from start to end; length (n,) [m] between them; stiffness (3,) [N m²]
    for twist and both curvatures; unstressed (n, 3) rotation vectors of each node against the one before."""

    name: str
    nodes: tuple[str, ...]
    length: Array
    stiffness: Array
    unstressed: Array
    order: int = 1


class Coarse(Struct):
    """A beam whose elements miss the share `share` of the largest energy of the machine, or of their own where that is larger, most at
    `time` [s]."""

    beam: str
    share: float
    time: float
    elements: int
    order: int


def look_at_mesh(run: Run) -> Coarse | None:
    """The beam whose elements miss most."""
    return coarsest(run.result, meshes(run.machine))


def say_mesh(coarse: Coarse) -> Item:
    """What the elements of a beam miss, and what to do."""
    advice = "use twice as many, or `order: 2`" if coarse.order == 1 else "use twice as many"
    said = (
        f"Mesh: the {coarse.elements} elements of {coarse.beam} miss {number(coarse.share)} of the largest energy at "
        f"t = {coarse.time:.6g} s, because the curvature changes within them; {advice}"
    )
    return MESH.item("mesh", said, coarse.share, coarse.time, coarse.beam)


def meshes(machine: MachineRecord) -> list[BeamMesh]:
    """The beams whose elements are linear or quadratic."""
    out = []
    for beam in machine.beams:
        if beam.order <= 2 and beam.model != "ancf-cable":
            axes = beam.frames(beam.shares)[1]
            theta = np.array([euler_parameters_from_matrix(each) for each in axes])
            length, stiffness = beam.line.length * np.diff(beam.shares), np.diag(beam.properties.stiffness)[3:]
            out.append(BeamMesh(beam.name, beam.node_names, length, stiffness, turns(theta), beam.order))
    return out


@np.errstate(over="ignore", invalid="ignore", divide="ignore")
def coarsest(result: Readable, beams: Sequence[BeamMesh]) -> Coarse | None:
    """The beam whose elements miss most."""
    found, energy = None, largest_mechanical_energy(result)
    stride = max(1, len(result.time) // MOST_FRAMES)
    names = result.coordinates.get("body", ())
    for beam in beams:
        count = len(beam.length) // beam.order
        theta = result.array("orientation")[::stride, [names.index(each) for each in beam.nodes]]
        curvature = (turns(theta) - beam.unstressed) / beam.length[:, None]
        own = np.nan_to_num(0.5 * (curvature**2 * beam.stiffness).sum(axis=2) @ beam.length)
        missed = np.nan_to_num(0.5 * (_missed(beam, curvature) * beam.stiffness).sum(axis=(1, 2)))
        k = int(np.argmax(missed))
        share = float(missed[k]) / max(energy, float(own.max()), 1e-300)
        if found is None or share > found.share:
            found = Coarse(beam.name, share, float(result.time[k * stride]), count, beam.order)
    return found


def _missed(beam: BeamMesh, curvature: Array) -> Array:
    """(t, elements, 3) [1/m] integral of the square of what elements do not have of curvatures (t, n, 3), means between nodes."""
    if len(beam.length) == beam.order:
        return _alone(beam, curvature)
    if beam.order == 1:
        middle = np.cumsum(beam.length) - 0.5 * beam.length
        return np.gradient(curvature, middle, axis=1) ** 2 * beam.length[:, None] ** 3 / 12.0
    length = beam.length[::2] + beam.length[1::2]
    slope = 2.0 * (curvature[:, 1::2] - curvature[:, ::2]) / length[:, None]
    change = np.gradient(slope, np.cumsum(length) - 0.5 * length, axis=1)
    return change**2 * length[:, None] ** 5 / 720.0


def _alone(beam: BeamMesh, curvature: Array) -> Array:
    """The same of one element without neighbours: as of a cantilever, a linear one under a load at its end, a quadratic one under an even
    load, whose part is a fifteenth of that of the slope."""
    length = float(beam.length.sum())
    if beam.order == 1:
        return curvature**2 * length / 3.0
    slope = 2.0 * (curvature[:, 1:] - curvature[:, :1]) / length
    return slope**2 * length**3 / 12.0 / 15.0


def turns(theta: Array) -> Array:
    """(…, n - 1, 3) [rad] rotation vectors of frames with Euler parameters (…, n, 4) against the one before each, in its axes."""
    return rotation_between(theta[..., :-1, :], theta[..., 1:, :])


SOFT: Final = 0.5  # of the lowest stiffness of the machine as drawn: below it loads have taken much of it


class OtherStability(Struct):
    """At `time` [s] the number of unstable directions is another with other elements, `words` says which."""

    time: float
    words: str


class Softened(Struct):
    """At `time` [s] loads have taken the share `taken` of the lowest stiffness; what is left is wrong by the share `off` of it, infinite
    where finer elements leave nothing."""

    time: float
    taken: float
    off: float


def look_at_buckling(subject: Equilibria) -> OtherStability | Softened | None:
    """Whether finer elements have the states, and how soft they are."""
    compared, result = subject.elements, subject.result
    if compared is None or compared.result is None or compared.why:
        return None
    if not compared.by_arc:
        first, second = common_frames(result.time, compared.result.time)
        counts = result.array("unstable_directions")[first], compared.result.array("unstable_directions")[second]
        other = np.flatnonzero(counts[0] != counts[1])
        if len(other):
            return OtherStability(float(result.time[first][other[0]]), compared.pair.words)
    own, its = compared.own, compared.its
    if own is None or its is None or not 0.0 < own.last < SOFT * own.drawn or not its.last > 0.0:
        return None
    exact = own.last - compared.pair.factor * (own.last - its.last)
    off = abs(own.last / exact - 1.0) if exact > 0.0 else float("inf")
    return Softened(float(result.time[-1]), 1.0 - own.last / own.drawn, off)


def say_buckling(found: OtherStability | Softened) -> Item:
    """How near buckling is, and what to do."""
    at, advice = f"at t = {found.time:.6g} s", "use twice as many `elements`"
    if isinstance(found, OtherStability):
        said = (
            f"Mesh: {at} the stability is another with {found.words} elements: the machine is near buckling; {advice}"
        )
        return Item("mesh", "red", f"{said} (green if it is the same, red otherwise)", time=found.time)
    if not np.isfinite(found.off):
        said = f"Mesh: {at} finer elements take all that loads leave of the stiffness: the machine is at its buckling load; {advice}"
        return Item("mesh", "red", f"{said} (green if it stays, red otherwise)", time=found.time)
    said = (
        f"Mesh: {at} loads have taken {number(found.taken)} of the lowest stiffness, near buckling; what is left is off by about "
        f"{number(found.off)} of it; {advice}"
    )
    return MESH.item("mesh", said, found.off, found.time)


CHECKS = (
    Check("beam_mesh", Run, look_at_mesh, say_mesh, 280, (STEPS,), "Mesh", MESH, line="mesh", quiet=True),
    Check("near_buckling", Equilibria, look_at_buckling, say_buckling, 284, (OTHERS, FRAMES), line="mesh", quiet=True),
)
