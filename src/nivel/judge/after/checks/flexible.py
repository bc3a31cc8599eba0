"""Flexible bodies: limits of their modes in a run, neglected inertia, and excitation beyond their modes.

A load that vibrates faster than the first mode that a body does not have may meet a resonance that the body lacks. Functions of time
are looked at through windows of some periods, in which a line of the spectrum stands out of what surrounds it; steps and pulses have
none. A force F of the frequency ω moves a body of the mass m by F/(m ω²), times 1/2ζ at a resonance, and that counts against how far
the body bends.
"""

from collections.abc import Iterator

import numpy as np

from nivel.analysis.curves.functions import Curve, varying
from nivel.judge.after.checks.modes import ENERGY_LEFT_OUT, NEAR_LEFT, STRAIGHT, Basis, modal_bases
from nivel.judge.after.flexible_bodies import Bent, ModalBody, modal_bodies
from nivel.judge.after.report import FRAMES, STEPS, Check
from nivel.judge.after.subject import Equilibria, Run
from nivel.known import Invariants
from nivel.lazy import Struct
from nivel.machine.core.vectors import Array
from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.tree import TIME
from nivel.results.scales import Readable, blocks
from nivel.results.trust import Item, Threshold, number
from nivel.system.flexible import bending_bodies

MOST_FRAMES = 500  # that bending is looked at in, at most
STIFFENING = Threshold(
    1e-2,
    1e-1,
    "Centrifugal forces increase the stiffness of a slender body by about this share. Stiffness is known to about a hundredth; a tenth "
    "is visible.",
)
BENDING = Threshold(
    5e-2,
    2e-1,
    "A body that bends by the share x of its length becomes shorter by about x²/2 of its length: 1e-3 for x = 0.05, a fiftieth for "
    "x = 0.2. Linear modes do not include this.",
)


def _say_stiffening(found: Bent) -> Item:
    said = (
        f"Stiffening: {found.body} has no geometric stiffness; at t = {found.time:.6g} s the square of its rotational speed is "
        f"{number(found.value)} of that of its lowest frequency; reduce it with `stiffening: true`"
    )
    return STIFFENING.item("stiffening", said, found.value, found.time, found.body)


def _say_bending(found: Bent) -> Item:
    said = (
        f"Bending: {found.body} bends by {number(found.value)} of its size at t = {found.time:.6g} s, but modes describe small "
        f"displacements: use a beam in its place, or several bodies"
    )
    return BENDING.item("bending", said, found.value, found.time, found.body)


def _look_for_stiffening(run: Run) -> Bent | None:
    """The largest (Ω/ω₁)² of bodies without geometric stiffness: Ω is the angular velocity across the body's length, ω₁ its lowest
    frequency.

    Centrifugal forces stiffen a body that is long across its spin by about that share (Southwell, Gough 1921).
    """
    found, result = None, run.result
    names = result.coordinates.get("body", ())
    for each in modal_bodies(run.machine):
        elastic = each.eigenvalues[each.eigenvalues > 1e-9 * max(float(each.eigenvalues.max()), 1e-300)]
        if each.stiffened or not len(elastic):
            continue
        k = names.index(each.name)
        theta = result.array("orientation")[:, k]
        along = _turned(theta, each.axis)
        across = np.linalg.norm(np.cross(result.array("angular_velocity")[:, k], along), axis=1)
        frame = int(np.argmax(np.nan_to_num(across)))
        value = float(across[frame] ** 2 / elastic.min())
        if found is None or value > found.value:
            found = Bent(each.name, value, float(result.time[frame]))
    return found


def _look_for_bending(subject: Run | Equilibria) -> Bent | None:
    """The largest displacement of a node against the extent of its body."""
    found = [most_bent(subject.result, each) for each in modal_bodies(subject.machine)]
    return max(found, key=lambda each: each.value, default=None)


def most_bent(result: Readable, body: ModalBody) -> Bent:
    """The largest displacement of a node of a body."""
    stride = max(1, len(result.time) // MOST_FRAMES)
    q = result.array("modal_coordinate")[::stride, body.first : body.last]
    moved = np.linalg.norm(np.einsum("aij,tj->tai", body.modes, q, optimize=True), axis=2).max(axis=1)
    frame = int(np.argmax(np.nan_to_num(moved)))
    return Bent(body.name, float(moved[frame]) / max(body.extent, 1e-300), float(result.time[frame * stride]))


def _turned(theta: Array, axis: Array) -> Array:
    """(n, 3) a direction of the body in global axes, for Euler parameters (n, 4)."""
    e0, e = theta[:, :1], theta[:, 1:]
    t = 2.0 * np.cross(e, axis)
    return axis + e0 * t + np.cross(e, t)


NEGLECTED = Threshold(
    1e-3,
    1e-2,
    "Inertia of real bodies is rarely known to 1 %. Above this limit the neglected inertia invariants matter. 1e-3 is a decade below.",
)


class Neglected(Struct):
    """A body whose modal coordinates are the columns first to last - 1 of a run, its invariants, and names of those it moves without."""

    body: str
    first: int
    last: int
    invariants: Invariants
    names: tuple[str, ...]

    def errors(self, q: Array) -> Array:
        """(frames,) what its mass matrix lacks, as a share, for modal coordinates q (frames, n).

        I8 and I9 are parts of the inertia, compared with that of the undeformed body; I5 couples turns and modes of unit mass, and is
        compared with the geometric mean of both.
        """
        its, inertia = self.invariants, float(np.abs(self.invariants.I7).max())
        parts = [np.zeros((len(q), 1))]
        if "I5" in self.names:
            parts.append(np.abs(np.einsum("tj,jak->tak", q, its.I5)).reshape(len(q), -1) / np.sqrt(inertia))
        if "I8" in self.names:
            both = its.I8 + its.I8.transpose(0, 2, 1)
            parts.append(np.abs(np.einsum("tj,jab->tab", q, both)).reshape(len(q), -1) / inertia)
        if "I9" in self.names:
            square = np.einsum("tj,tk,jkab->tab", q, q, its.I9, optimize=True)
            parts.append(np.abs(square).reshape(len(q), -1) / inertia)
        return np.concatenate(parts, axis=1).max(axis=1)


class Cost(Struct):
    """The largest share of a mass matrix that was neglected, its body, the names of what was neglected there, and the time [s]."""

    share: float
    body: str
    names: tuple[str, ...]
    time: float


def _look_at_neglected(run: Run) -> Cost | None:
    """The largest cost of a run; None where nothing is neglected."""
    result = run.result
    found: Cost | None = None
    for each in neglected(run.machine):
        for frames in blocks(result):
            errors = each.errors(result.array("modal_coordinate", frames)[:, each.first : each.last])
            if not len(errors):
                continue
            k = int(np.argmax(errors))
            if found is None or not errors[k] <= found.share:
                found = Cost(float(errors[k]), each.body, each.names, float(result.time[frames.start + k]))
    return found


def _say_neglected(found: Cost) -> Item:
    names = " and ".join(found.names)
    lacks = f"without {names} the mass matrix of {found.body} lacks at most {number(found.share)} for the deflections of this run"
    said = f"Neglected: {lacks}, at t = {found.time:.6g} s"
    return NEGLECTED.item("neglected", said, found.share, found.time, found.body)


def neglected(machine: MachineRecord) -> tuple[Neglected, ...]:
    """The flexible bodies that move without some inertia invariants."""
    out, first = [], 0
    for each in bending_bodies(machine) if machine.is_flexible else ():
        last = first + len(each.reduced.eigenvalues)
        if each.neglected:
            name = machine.bodies[each.body].name
            out.append(Neglected(name, first, last, each.reduced.invariants, each.neglected))
        first = last
    return tuple(out)


# in a window of the frequency at which the modes end; samples in one of four times that frequency
PERIODS, SAMPLES = (32, 8)
MOST_WINDOWS = 200
LEAST_DAMPING = 0.005  # of critical: structures have no less
LINE = 3.0  # times what surrounds it: above that it is a line


class Excited(Struct):
    """A function whose vibration of `frequency` [Hz] may move the body by the share `share` of what all of it does; the modes of the body
    end at `limit` [Hz]."""

    body: str
    function: str
    frequency: float
    share: float
    limit: float
    time: float


def _look_at_excitation(run: Run) -> Excited | None:
    """The line of the functions of a run that goes most beyond the modes of a body."""
    if not run.machine.is_flexible or not float(run.result.time[-1]) > 0.0:
        return None
    bases = modal_bases(run.machine, run.prepared)
    found = [excited for basis in bases for excited in _of_body(run.machine, basis, run.result)]
    return max(found, key=lambda each: each.share, default=None)


def _say_excitation(excited: Excited) -> Item:
    said = (
        f"Modes: {excited.function} vibrates with {number(excited.frequency)} Hz, above {number(excited.limit)} Hz, where the modes of "
        f"{excited.body} end: at a resonance there it would move the body by about {number(excited.share)} of what it does in all; use "
        f"more `modes`"
    )
    return ENERGY_LEFT_OUT.item("modes", said, excited.share, excited.time, excited.body)


def _of_body(machine: MachineRecord, basis: Basis, result: Readable) -> Iterator[Excited]:
    body = basis.body
    bent = most_bent(result, body)
    if not len(basis.left.eigenvalues):
        return
    limit = NEAR_LEFT * float(np.sqrt(basis.left.eigenvalues.min())) / (2.0 * np.pi)
    amplification = 0.5 / min(max(basis.damping_ratio, LEAST_DAMPING), 0.5)
    for function in varying(machine):
        if function.curve.signals or not function.of.startswith(("force.", "driver.")):
            continue
        found = _line(function.curve, limit, float(result.time[-1]))
        if found is None:
            continue
        amplitude, frequency, time = found
        # a driver moves the body by its own amplitude, a force by that over its inertia
        slow = 1.0 if function.of.startswith("driver.") else basis.its.I1 * (2.0 * np.pi * frequency) ** 2
        moved, least = amplitude * amplification / slow, STRAIGHT * body.extent
        share = min(moved / max(bent.value * body.extent, least), 1.0)
        yield Excited(body.name, function.name, frequency, share, limit, time)


def _line(curve: Curve, limit: float, end: float) -> tuple[float, float, float] | None:
    """The amplitude of the largest line above `limit` [Hz], its frequency [Hz] and time [s]; None where there is none."""
    window = min(PERIODS / limit, end)
    count = SAMPLES * 4 * PERIODS
    windows = min(MOST_WINDOWS, max(1, int(np.ceil(end / window))))
    begin = np.linspace(0.0, end - window, windows)
    time = begin[:, None] + window * np.arange(count) / count
    values = np.asarray(curve.values({TIME: time.ravel()}), dtype=float).reshape(time.shape)
    if not np.isfinite(values).all():
        return None
    shape = np.hanning(count)
    spectrum = 4.0 / count * np.abs(np.fft.rfft((values - values.mean(axis=1, keepdims=True)) * shape, axis=1))
    frequency = np.arange(spectrum.shape[1]) / window
    above = np.flatnonzero(frequency > limit)
    best: tuple[float, int, int] = (0.0, 0, 0)
    for k in range(windows):
        j = int(above[np.argmax(spectrum[k, above])])
        around = spectrum[k, j // 2 : 2 * j]
        line = float(spectrum[k, j] - LINE * np.median(around))
        if line > best[0]:
            best = line, k, j
    if best[0] <= 0.0:
        return None
    return best[0], float(frequency[best[2]]), float(begin[best[1]])


CHECKS = (
    Check(
        "stiffening", Run, _look_for_stiffening, _say_stiffening, 260, (STEPS,), "Stiffening", STIFFENING, quiet=True
    ),
    Check(
        "bending", (Run, Equilibria), _look_for_bending, _say_bending, 270, (FRAMES,), "Bending", BENDING, quiet=True
    ),
    Check("neglected", Run, _look_at_neglected, _say_neglected, 100, (), "Neglected", NEGLECTED),
    Check("excitation", Run, _look_at_excitation, _say_excitation, 304, (STEPS,), "Modes", line="modes", quiet=True),
)
