"""Contacts: bodies that pass through each other within a step, friction that lets bodies creep, wheels that roll,
loads of tyres, and the volume of soil.

Of contacts in passing spheres are exact. Of other shapes the convex hulls are looked at, of round ones polyhedra inside them.
"""

import math

import numpy as np

from nivel.judge.after.report import FRAMES, STEPS, Check
from nivel.judge.after.subject import Equilibria, Motion, Run
from nivel.judge.after.touching_pairs import Passed
from nivel.known import Contact, Contacts
from nivel.lazy import Struct
from nivel.machine.core.vectors import Array
from nivel.results.scales import Readable, machine_size
from nivel.results.trust import Item, Threshold, number

SHOWN = 5  # contacts of which each has a line


def _look_for_passing(run: Run) -> list[Passed]:
    return run.passing.passed[:SHOWN]


def _say_passing(found: Passed) -> Item:
    text = (
        f"Contact: {' and '.join(found.bodies)} pass through each other at t = {found.time:.6g} s, by {number(found.overlap)} of "
        f"{found.of}, and {found.contact} does not push them apart: they overlap for only "
        f"{number(found.lasted)} s; use steps of {number(found.lasted / 10.0)} s, or a method that chooses its steps "
        f"(green if none do, red otherwise)"
    )
    return Item("contact", "red", text, found.overlap, row=found.contact, time=found.time)


CREEP = Threshold(
    1e-4,
    np.inf,
    "Way over which a contact with `friction_model: coulomb` lets bodies creep, as a share of the size of the machine. Real friction would "
    "hold them.",
)


class Creep(Struct):
    """A contact, how far its bodies creep in all [m], as a share of the machine's size, and the time [s] and speed [m/s] where they are
    fastest."""

    contact: str
    way: float
    share: float
    time: float
    speed: float


def _look_at_creep(run: Run) -> list[Creep]:
    """Contacts that creep: they slide slower than the transition speed of their friction, from frame to frame."""
    time, found = run.result.time, []
    if len(time) < 2:
        return found
    for force in run.machine.forces:
        if not isinstance(force, Contact | Contacts) or not _is_smooth(force):
            continue
        speed = _sliding(run, force)
        touches = run.result.array(f"force.{force.name}.normal_force") > 0.0
        creeps = touches & (speed < (force.friction_transition_speed or np.inf))
        between = creeps[1:] & creeps[:-1]
        way = float(np.sum(np.where(between, 0.5 * (speed[1:] + speed[:-1]) * np.diff(time), 0.0)))
        if way > 0.0:
            fastest = int(np.argmax(np.where(creeps, speed, 0.0)))
            share = way / machine_size(run.result)[0]
            found.append(Creep(force.name, way, share, float(time[fastest]), float(speed[fastest])))
    return found


def _is_smooth(force: Contact | Contacts) -> bool:
    """Whether a force has friction that goes to zero with the speed of sliding."""
    if isinstance(force, Contact):
        return bool(force.friction) and not force.sticks
    return bool(force.friction) and force.friction_transition_speed is not None


def _sliding(run: Run, force: Contact | Contacts) -> Array:
    """(n,) [m/s] speed of sliding; of many pairs the mean by their friction."""
    if isinstance(force, Contact):
        return run.result.array(f"force.{force.name}.slip_speed")
    friction, power = (run.result.array(f"force.{force.name}.friction_{each}") for each in ("force", "power"))
    return np.divide(power, friction, out=np.zeros_like(power), where=friction > 0.0)


def _say_creep(found: Creep) -> Item:
    said = (
        f"Contact: {found.contact} lets its bodies creep by {number(found.way)} m, with up to {number(found.speed)} m/s at "
        f"t = {found.time:.6g} s, where friction would hold them: a `contact` with `friction_model: stiction` does"
    )
    return CREEP.item("creep", said, found.share, found.time, found.contact)


NORMAL = ".normal_force"
# a wheel that is pulled by less than this share of the largest normal force is not: that is round-off
PULLED = 1e-9


class Wheel(Struct):
    """The least normal force [N] on a wheel and its time [s]; lifts : from when on the plane would have to pull [s], None: never. The
    largest ratio of friction and normal force, and its time [s]."""

    name: str
    least: float
    time: float
    lifts: float | None
    ratio: float
    ratio_time: float


def _look_at_wheels(run: Motion) -> list[Wheel]:
    names = [name for name in run.result.variables if name.startswith("joint.") and name.endswith(NORMAL)]
    return [_wheel(run.result, name.removesuffix(NORMAL)) for name in names]


def _say_wheel(found: Wheel) -> Item:
    if found.lifts is not None:
        said = (
            f"the plane would have to pull {found.name} with {number(-found.least)} N at t = {found.time:.6g} s: a real wheel "
            f"lifts off, from t = {found.lifts:.6g} s on; use a contact there"
        )
        return Item("rolling", "amber", f"Rolling: {said}", row=found.name, time=found.time)
    said = f"the plane presses on {found.name} with {number(found.least)} N or more"
    slips = f"it does not slip where the coefficient of friction is {found.ratio:.3g} or more (t = {found.ratio_time:.6g} s)"
    return Item("rolling", "green", f"Rolling: {said}, and {slips} (green if it never pulls)", row=found.name)


def _wheel(result: Readable, wheel: str) -> Wheel:
    time, normal = result.time, result.array(f"{wheel}{NORMAL}")
    friction = np.hypot(result.array(f"{wheel}.friction_x"), result.array(f"{wheel}.friction_y"))
    least, largest = int(np.argmin(normal)), float(np.max(np.abs(normal)))
    pulled, pressed = normal < -PULLED * largest, normal > PULLED * largest
    ratio = np.divide(friction, normal, out=np.zeros_like(friction), where=pressed)
    worst = int(np.argmax(ratio))
    return Wheel(
        wheel.removeprefix("joint."),
        float(normal[least]),
        float(time[least]),
        float(time[int(np.argmax(pulled))]) if pulled.any() else None,
        float(ratio[worst]),
        float(time[worst]),
    )


LADEN = Threshold(
    2.0,
    np.inf,
    "Largest load of a tyre as a share of its nominal load. Its curves are given up to twice that. Up to three times they are "
    "extrapolated, and with more load the grip stays.",
)


class Laden(Struct):
    """The largest load of a tyre by its nominal load, and when [s]."""

    tyre: str
    share: float
    time: float


def _look_at_loads(subject: Run | Equilibria) -> list[Laden]:
    out = []
    for force in subject.machine.forces:
        if (nominal := getattr(force, "nominal_load", None)) is not None:  # of tyres
            load = subject.result.array(f"force.{force.name}.magnitude") / nominal
            k = int(np.argmax(load))
            out.append(Laden(force.name, float(load[k]), float(subject.result.time[k])))
    return out


def _say_load(found: Laden) -> Item:
    bears = f"{found.tyre} bears {number(found.share)} times its nominal load at t = {found.time:.6g} s"
    text = f"Tyres: {bears}, and its curves are given up to twice"
    return LADEN.item("laden", text, found.share, found.time, found.tyre)


KEPT = Threshold(
    1e-9,
    1e-6,
    "Volume of all cells and loads, less that at the start, by the volume that was moved. Each move is of equal volumes, so that only "
    "round-off is left.",
)
SPILT = Threshold(
    1e-6, math.inf, "Volume that fell beyond the border of the heights and lies on it, by the volume that was moved."
)
LEAST = 1e-9  # [m³] of volume moved, below which nothing was


class Moved(Struct):
    """Of all soil: volume moved [m³], and what is missing and what fell beyond the border by that, where it is most; a force on it."""

    force: str
    volume: float
    missing: float
    spilt: float


def _look_at_soil(run: Run) -> Moved | None:
    """None without soil."""
    names = [force.name for force in run.machine.forces if getattr(force, "soil", None) is not None]
    if not names:
        return None
    moved, missing, spilt = (
        [float(np.abs(run.result.array(f"force.{name}.{what}")).max()) for name in names]
        for what in ("moved", "balance", "spilt")
    )
    by = max(sum(moved), LEAST)
    return Moved(names[0], sum(moved), max(missing) / by, max(spilt) / by)


def _say_moved(found: Moved) -> Item:
    told = f"{number(found.volume)} m^3 moved under {found.force}, {number(found.missing)} of it missing; no second run has other cells"
    return KEPT.item("soil", f"Soil: {told}", found.missing, row=found.force)


def _say_spilt(found: Moved) -> Item:
    text = f"Soil: {number(found.spilt)} of the volume moved fell beyond the border of the `heights`, on which it lies; make them larger"
    return SPILT.item("spilt", text, found.spilt, row=found.force)


CHECKS = (
    Check("laden", (Run, Equilibria), _look_at_loads, _say_load, 227, (FRAMES,), "Tyres", LADEN, quiet=True),
    Check("contact", Run, _look_for_passing, _say_passing, 220, (STEPS,), "Contact", blind="their steps pass {row}"),
    Check("creep", Run, _look_at_creep, _say_creep, 225, (FRAMES,), "Contact", CREEP, quiet=True),
    Check("rolling", Motion, _look_at_wheels, _say_wheel, 420, (FRAMES,), "Rolling"),
    Check("soil", Run, _look_at_soil, _say_moved, 228, (FRAMES,), "Soil"),
    Check("spilt", Run, _look_at_soil, _say_spilt, 229, (FRAMES,), "Soil", SPILT, quiet=True),
)
