"""Hydraulic circuits: their balances of energy and mass, cavitation, valves that are always open, engines that stall, and their steps; and
blocks of the control that stand at their limits."""

import json
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.judge.after.checks.energy import BALANCE
from nivel.judge.after.report import FRAMES, Check, Need
from nivel.judge.after.subject import Motion, Run
from nivel.lazy import Struct, nivel
from nivel.results.scales import Readable
from nivel.results.trust import Item, Threshold, number, quantity

START = "hydraulics."
INTEGRALS = ("supplied", "delivered", "lost")
# below this absolute pressure [Pa] air and vapour take up several percent of the volume
CAVITATES = 3e4
# a spool this near to the end of its stroke is at its end; energies below [J] are none
AT_END, NO_ENERGY = 0.999, 1e-9
# [rad/s] of an engine that turns backwards
BACKWARDS = -1e-2
# share of the steps that may be of order one
GUARDED = Threshold(0.01, 0.1, "")
CIRCUITS = Need("circuits", lambda run: f"{START}stored" in run.result.variables)


class CircuitEnergy(Struct):
    """Energies [J] at the end: supplied, work on bodies, losses, stored; the largest error as a share of the largest of them, and its time
    [s]."""

    supplied: float
    delivered: float
    lost: float
    stored: float
    fraction: float
    time: float


class FluidMass(Struct):
    """The largest difference of the mass in all volumes and that which tanks gave, as a share, and its time [s]."""

    fraction: float
    time: float


class Cavitation(Struct):
    """A pressure, its lowest value [Pa] and the time of that [s], and the share of the frames in which the fluid cavitates."""

    name: str
    lowest: float
    time: float
    share: float


class Saturation(Struct):
    """A valve that is at the end of its stroke all the time. relief : whether it is a relief valve."""

    name: str
    relief: bool


class Stall(Struct):
    """An engine that turns backwards, and from when on [s]."""

    name: str
    time: float


class Guard(Struct):
    """Steps of a run over circuits, those among them that were made in parts, the parts whose extrapolation was not taken, and the largest
    difference [Pa] of a pressure between one step and two of half the length."""

    steps: int
    divided: int
    guarded: int
    difference: float


def look_at_energy(run: Motion) -> CircuitEnergy:
    """Supplied less delivered, lost and stored."""
    supplied, delivered, lost = (_history(run.result, f"state.{START}{name}") for name in INTEGRALS)
    stored = _history(run.result, f"{START}stored")
    error = np.abs(supplied - delivered - lost - (stored - stored[0]))
    flows = (supplied, delivered, lost, stored - stored[0])
    scale = max(float(np.max(np.abs(each))) for each in flows)
    k = int(np.argmax(error))
    fraction = float(error[k]) / scale if scale > NO_ENERGY else 0.0
    ends = [float(each[-1]) for each in flows]
    return CircuitEnergy(ends[0], ends[1], ends[2], ends[3], fraction, float(run.result.time[k]))


def say_energy(found: CircuitEnergy) -> Item:
    """The balance."""
    energies = (found.supplied, found.delivered, found.lost, found.stored)
    given, into_bodies, heat, kept = (quantity(each, "J") for each in energies)
    balance = f"{given} supplied = {into_bodies} work on bodies + {heat} losses + {kept} stored"
    said = f"Hydraulics: {balance}; error {number(found.fraction)} of the largest of these"
    return BALANCE.item("hydraulics", said, found.fraction, found.time)


def look_at_mass(run: Motion) -> FluidMass:
    """The mass in all volumes against what tanks gave, which every method integrates alike: they differ by round-off, and by what an
    iteration is not solved for."""
    result = run.result
    names = [name for name in result.variables if name.startswith("state.") and ".mass" in name]
    names = [name for name in names if ".mass_flow" not in name]
    mass = sum((_history(result, name) for name in names), np.zeros(len(result.time)))
    taken = _history(result, f"state.{START}taken_in")
    error = np.abs(mass - mass[0] - taken)
    k = int(np.argmax(error))
    scale = float(np.max(np.abs(mass))) + float(np.max(np.abs(taken)))
    return FluidMass(float(error[k]) / scale if scale > 0.0 else 0.0, float(result.time[k]))


def say_mass(found: FluidMass) -> Item:
    """The difference."""
    said = f"Fluid: mass taken from tanks and mass in volumes differ by {number(found.fraction)} of it"
    return BALANCE.item("fluid mass", said, found.fraction, found.time)


def _look_for_cavitation(run: Motion) -> list[Cavitation]:
    out, result = [], run.result
    signals = {f"{START}{each['name']}.pressure" for each in _components(result) if each["type"] == "load-sensing"}
    for name in result.variables:
        if name in signals or not name.startswith(START) or not name.rpartition(".")[2].startswith("pressure"):
            continue
        if name.replace(".pressure", ".temperature") in result.variables:
            continue  # gas may be thin
        pressure = _history(result, name)
        low = pressure < CAVITATES
        if np.any(low):
            k = int(np.argmin(pressure))
            share, time = float(np.mean(low)), float(result.time[k])
            out.append(Cavitation(name.removeprefix(START), float(pressure[k]), time, share))
    return out


def _say_cavitation(found: Cavitation) -> Item:
    said = f"the fluid cavitates: {found.name} falls to {found.lowest / 1e5:.3g} bar at t = {found.time:.6g} s"
    text = f"Cavitation: {said}, and is below {CAVITATES / 1e5:.2g} bar for {100 * found.share:.3g} % of the run"
    return Item("cavitation", "amber", text, row=found.name, time=found.time)


def _look_at_valves(run: Motion) -> list[Saturation]:
    """Valves that are at one end for the whole run: spools with a centre between their ends, and relief valves fully open."""
    return list(_saturated(run.result))


def _say_saturation(found: Saturation) -> Item:
    said = (
        f"the valve {found.name} is at the end of its stroke for the whole run; does its command have the right scale?"
    )
    if found.relief:
        said = (
            f"the relief valve {found.name} is fully open for the whole run and limits no pressure; is its flow right?"
        )
    return Item("saturation", "amber", f"Saturation: {said}", row=found.name)


def _look_for_stalls(run: Motion) -> list[Stall]:
    """Engines that turn backwards: the law of an engine goes on there, and real ones have stopped."""
    found, time = [], np.asarray(run.result.time)
    for engine in _components(run.result):
        if engine["type"] == "engine":
            backwards = _history(run.result, f"{START}{engine['name']}.speed") < BACKWARDS
            if backwards.any():
                found.append(Stall(engine["name"], float(time[int(np.argmax(backwards))])))
    return found


def _say_stall(found: Stall) -> Item:
    said = f"the engine {found.name} stalls: it turns backwards from t = {found.time:.6g} s on, and what follows has no sense"
    text = f"Stall: {said}; give it more torque, or its pumps a `torque_limit`"
    return Item("stall", "amber", text, row=found.name, time=found.time)


def _look_at_steps(run: Run) -> Guard | None:
    """What the guard of steps over circuits did; None where there is none."""
    timing = run.finished.timing
    if not run.prepared.guards_circuits or not timing["steps"]:
        return None
    return Guard(int(timing["steps"]), int(timing["rejected"]), int(timing["guarded"]), timing["pressure_difference"])


def say_steps(found: Guard) -> Item:
    """How many steps were divided, how many parts were of order one, and how large the error of pressures in one was."""
    share = found.guarded / found.steps
    verdict = GUARDED.verdict(share)
    divided = f"{found.divided} of {found.steps} steps were divided into parts"
    counted = f"{divided}, {found.guarded} parts were not extrapolated"
    largest = f"pressures after a full step and two half steps differed by at most {found.difference / 1e5:.3g} bar"
    advice = "" if verdict == "green" else "; take a shorter step, or larger small volumes"
    text = f"Pressure steps: {counted} (green below {100 * GUARDED.green:g} % of the steps), {largest}{advice}"
    return Item("pressure steps", verdict, text, share, GUARDED.green, GUARDED.amber)


def _history(result: Readable, name: str) -> NDArray[np.float64]:
    return np.asarray(result.array(name), dtype=float).ravel()


def _components(result: Readable) -> list[dict[str, Any]]:
    """Those of the circuits, as records."""
    return json.loads(str(result.attributes.get("machine_record", "{}"))).get("hydraulics") or []


def _saturated(result: Readable) -> Iterator[Saturation]:
    for valve in _components(result):
        name, kind = valve["name"], valve["type"]
        centred = kind == "section" or (
            kind == "directional-valve" and valve["ways"] in nivel.elements.circuits.directional_valves.CENTRED
        )
        if not centred and kind != "relief-valve":
            continue
        position = _history(result, f"{START}{name}.position")[1:]
        if len(position) and (np.all(position > AT_END) or (centred and np.all(position < -AT_END))):
            yield Saturation(name, not centred)


WHOLE = 0.999  # share of the frames after the first
LEAST = 5  # frames of which something can be said
SOME_FRAMES = Need("frames", lambda run: len(run.result.time) > LEAST)


class Saturated(Struct):
    """A block whose value was a limit in all frames but the first."""

    name: str


def _look_at_control(run: Run) -> list[Saturated]:
    out = []
    for block in run.machine.control:
        limits = getattr(block, "limits", None)
        name = f"control.{block.name}"
        if limits is None or name not in run.result.variables:
            continue
        values = run.result.array(name)[1:]
        if np.mean((values <= limits[0]) | (values >= limits[1])) >= WHOLE:
            out.append(Saturated(block.name))
    return out


def _say_control(found: Saturated) -> Item:
    said = f"{found.name} stood at its limits for the whole run, so its gains did nothing"
    text = f"Control: {said}; check the signs of its inputs, its gains and its limits"
    return Item("control", "amber", text, row=found.name)


CHECKS = (
    Check("hydraulics", Motion, look_at_energy, say_energy, 430, (FRAMES, CIRCUITS), "Hydraulics"),
    Check("fluid mass", Motion, look_at_mass, say_mass, 440, (FRAMES, CIRCUITS), "Fluid"),
    Check("cavitation", Motion, _look_for_cavitation, _say_cavitation, 450, (FRAMES, CIRCUITS), "Cavitation"),
    Check("saturation", Motion, _look_at_valves, _say_saturation, 460, (FRAMES, CIRCUITS), "Saturation"),
    Check("stall", Motion, _look_for_stalls, _say_stall, 465, (FRAMES, CIRCUITS), "Stall"),
    Check("pressure steps", Run, _look_at_steps, say_steps, 470, (), "Pressure steps"),
    Check("control", Run, _look_at_control, _say_control, 410, (SOME_FRAMES,), "Control"),
)
