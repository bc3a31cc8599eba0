"""Hydraulic circuits in the trust report: their balances of energy and mass, cavitation, valves that are always open."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nivel.machine.hydraulics.directional import CENTRED
from nivel.results.scales import Readable
from nivel.results.trust.verdicts import THRESHOLDS, Item, number, quantity

START = "hydraulics."
INTEGRALS = ("supplied", "delivered", "lost")
# below this absolute pressure [Pa] air and vapour take up several percent of the volume
CAVITATES = 3e4
# a spool this near to the end of its stroke is at its end; energies below [J] are none
AT_END, NO_ENERGY = 0.999, 1e-9
# share of the steps that may be of order one
GUARDED_GREEN, GUARDED_AMBER = 0.01, 0.1


def circuit_items(result: Readable) -> Iterator[Item]:
    """Statements about the circuits of a run; none where there are none."""
    if f"{START}stored" not in result.variables or not len(result.time):
        return
    yield _energy_item(result)
    yield _mass_item(result)
    yield from _cavitation_items(result)
    yield from _saturation_items(result)


def pressures_at(result: Readable, frame: int) -> dict[str, float]:
    """Pressures of circuits [Pa] in one frame, by the name of the variable."""
    names = [name for name in result.variables if name.startswith(START) and ".pressure" in name]
    return {name: float(_history(result, name)[frame]) for name in names}


@dataclass(frozen=True)
class Guard:
    """Steps of a run over circuits, those among them that were made in parts, the parts whose extrapolation was not taken, and the largest
    difference [Pa] of a pressure between one step and two of half the length."""

    steps: int
    divided: int
    guarded: int
    difference: float


def guard_items(guard: Guard | None) -> Iterator[Item]:
    """How many steps were divided, how many parts were of order one, and how large the error of pressures in one was."""
    if guard is None or not guard.steps:
        return
    share = guard.guarded / guard.steps
    verdict = "green" if share < GUARDED_GREEN else "amber" if share < GUARDED_AMBER else "red"
    divided = f"{guard.divided} of {guard.steps} steps were divided into parts"
    counted = f"{divided}, {guard.guarded} parts were not extrapolated"
    largest = f"pressures after a full step and two half steps differed by at most {guard.difference / 1e5:.3g} bar"
    advice = "" if verdict == "green" else "; take a shorter step, or larger small volumes"
    text = f"Pressure steps: {counted} (green below {100 * GUARDED_GREEN:g} % of the steps), {largest}{advice}"
    yield Item("pressure steps", verdict, text, share, GUARDED_GREEN, GUARDED_AMBER)


def _history(result: Readable, name: str) -> NDArray[np.float64]:
    return np.asarray(result.array(name), dtype=float).ravel()


def _energy_item(result: Readable) -> Item:
    """Supplied less delivered, lost and stored."""
    supplied, delivered, lost = (_history(result, f"state.{START}{name}") for name in INTEGRALS)
    stored = _history(result, f"{START}stored")
    error = np.abs(supplied - delivered - lost - (stored - stored[0]))
    flows = (supplied, delivered, lost, stored - stored[0])
    scale = max(float(np.max(np.abs(each))) for each in flows)
    k = int(np.argmax(error))
    fraction = float(error[k]) / scale if scale > NO_ENERGY else 0.0
    threshold = THRESHOLDS["energy"]
    given, into_bodies, heat, kept = (quantity(float(each[-1]), "J") for each in flows)
    balance = f"{given} supplied = {into_bodies} work on bodies + {heat} losses + {kept} stored"
    said = f"{balance}; error {number(fraction)} of the largest of these ({threshold})"
    return Item(
        "hydraulics",
        threshold.verdict(fraction),
        f"Hydraulics: {said}",
        fraction,
        threshold.green,
        threshold.amber,
        time=float(result.time[k]),
    )


def _mass_item(result: Readable) -> Item:
    """The mass in all volumes against what tanks gave. Volumes exchange fluid to round-off; the integral is as exact as the method."""
    names = [name for name in result.variables if name.startswith("state.") and ".mass" in name]
    names = [name for name in names if not name.endswith("mass_flow")]
    mass = sum((_history(result, name) for name in names), np.zeros(len(result.time)))
    taken = _history(result, f"state.{START}taken_in")
    error = np.abs(mass - mass[0] - taken)
    k = int(np.argmax(error))
    scale = float(np.max(np.abs(mass))) + float(np.max(np.abs(taken)))
    fraction = float(error[k]) / scale if scale > 0.0 else 0.0
    threshold = THRESHOLDS["energy"]
    text = f"Fluid: mass taken from tanks and mass in volumes differ by {number(fraction)} of it ({threshold})"
    verdict = threshold.verdict(fraction)
    return Item("fluid mass", verdict, text, fraction, threshold.green, threshold.amber, time=float(result.time[k]))


def _cavitation_items(result: Readable) -> Iterator[Item]:
    for name in result.variables:
        if not name.startswith(START) or not name.rpartition(".")[2].startswith("pressure"):
            continue
        if name.replace(".pressure", ".temperature") in result.variables:
            continue  # gas may be thin
        pressure = _history(result, name)
        low = pressure < CAVITATES
        if np.any(low):
            k = int(np.argmin(pressure))
            time = float(result.time[k])
            share = float(np.mean(low))
            said = f"the fluid cavitates: {name.removeprefix(START)} falls to {pressure[k] / 1e5:.3g} bar at t = {time:.6g} s"
            text = f"Cavitation: {said}, and is below {CAVITATES / 1e5:.2g} bar for {100 * share:.3g} % of the run"
            yield Item("cavitation", "amber", text, row=name.removeprefix(START), time=time)


def _saturation_items(result: Readable) -> Iterator[Item]:
    """Valves that are at one end for the whole run: spools with a centre between their ends, and relief valves fully open."""
    for valve in json.loads(str(result.attributes.get("machine_record", "{}"))).get("hydraulics") or ():
        name, kind = valve["name"], valve["type"]
        centred = kind == "directional-valve" and valve["ways"] in CENTRED
        if not centred and kind != "relief-valve":
            continue
        position = _history(result, f"{START}{name}.position")[1:]
        if centred and len(position) and (np.all(position > AT_END) or np.all(position < -AT_END)):
            text = f"Saturation: the valve {name} is at the end of its stroke for the whole run; does its command have the right scale?"
            yield Item("saturation", "amber", text, row=name)
        if kind == "relief-valve" and len(position) and np.all(position > AT_END):
            text = f"Saturation: the relief valve {name} is fully open for the whole run and limits no pressure; is its flow right?"
            yield Item("saturation", "amber", text, row=name)
