"""Handling of a vehicle: histories of a manoeuvre in the axes of the level vehicle, its numbers, and the page of all manoeuvres."""

from collections.abc import Mapping

import numpy as np

from nivel.lazy import Struct
from nivel.machine.core.vectors import Array
from nivel.report.page import page
from nivel.report.plots import Line, curves, path_drawing
from nivel.results.result import Result

Numbers = dict[str, tuple[float, str]]  # value and unit by name
G = 9.80665
SETTLED = 0.02  # change of a state in half a second, up to which it is steady
NOTE = "x forwards, y to the left; accelerations without gravity, of the origin of the body."


class Manoeuvre(Struct):
    """(n,) time, steering angle, speeds and accelerations along and across, yaw, its rate, roll, place; SI. `name` of the manoeuvre."""

    name: str
    time: Array
    steering: Array
    vx: Array
    vy: Array
    ax: Array
    ay: Array
    yaw: Array
    yaw_rate: Array
    roll: Array
    x: Array
    y: Array

    @classmethod
    def of(cls, name: str, run: Result, body: int, driver: str) -> "Manoeuvre":
        """Of a run, the body of this number and the block that drives."""
        p, v, a = (run.array(each)[:, body] for each in ("position", "velocity", "acceleration"))
        e0, e1, e2, e3 = run.array("orientation")[:, body].T
        yaw = np.unwrap(np.arctan2(2.0 * (e0 * e3 + e1 * e2), 1.0 - 2.0 * (e2**2 + e3**2)))
        roll = np.arctan2(2.0 * (e0 * e1 + e2 * e3), 1.0 - 2.0 * (e1**2 + e2**2))
        c, s = np.cos(yaw), np.sin(yaw)
        along, across = (
            (each[:, 0] * c + each[:, 1] * s for each in (v, a)),
            (each[:, 1] * c - each[:, 0] * s for each in (v, a)),
        )
        (vx, ax), (vy, ay) = along, across
        rate = run.array("angular_velocity")[:, body, 2]
        return cls(name, run.time, run.array(f"control.{driver}"), vx, vy, ax, ay, yaw, rate, roll, p[:, 0], p[:, 1])


def circle_numbers(m: Manoeuvre, wheelbase: float, held: tuple[float, float]) -> Numbers:
    """Gradients by lateral acceleration v r at one speed (ISO 4138), of steering less L r/v, side slip and roll.

    They are slopes at straight ahead: differences of two steady states, a little to the left and to the right, at the times `held`.
    """
    lateral = m.vx * m.yaw_rate
    of = {
        "understeer gradient": m.steering - wheelbase * m.yaw_rate / m.vx,
        "side slip gradient": np.arctan2(m.vy, m.vx),
        "roll gradient": m.roll,
    }
    left, right = np.interp(held, m.time, lateral)
    out: Numbers = {}
    if left > right:
        slopes = {name: float(-np.diff(np.interp(held, m.time, each))[0] / (left - right)) for name, each in of.items()}
        out = {name: (float(np.degrees(slope)) * G, "°/g") for name, slope in slopes.items()}
        k = slopes["understeer gradient"]
        if k != 0.0:
            out["characteristic speed" if k > 0 else "critical speed"] = float(np.sqrt(wheelbase / abs(k))), "m/s"
        change = np.abs(np.interp(np.array(held) - 0.5, m.time, lateral) - (left, right))
        out |= _unsteady(float(np.max(change) / (left - right)))
    return {**out, "greatest lateral acceleration": (float(np.max(np.abs(m.ay))), "m/s²")}


def _unsteady(change: float) -> Numbers:
    """Said of a state that changes yet: by this share in half a second."""
    return {"not yet steady: change in the last half second": (100.0 * change, "%")} if change > SETTLED else {}


def step_numbers(m: Manoeuvre) -> Numbers:
    """Of a step of steering (ISO 7401): gain, time from half of the steering to 90 % of the yaw rate, its peak and overshoot."""
    end = float(m.yaw_rate[-1])
    half = float(np.interp(0.5, m.steering / m.steering[-1], m.time))
    shares = m.yaw_rate / end
    peak = int(np.argmax(shares))
    first = int(np.argmax(shares > 0.9))
    rise = float(np.interp(0.9, shares[first - 1 : first + 1], m.time[first - 1 : first + 1])) - half
    swing = float(np.ptp(m.yaw_rate[m.time > m.time[-1] - 0.5])) / abs(end)
    out = {"yaw rate gain": (end / float(m.steering[-1]), "1/s"), "response time of the yaw rate": (rise, "s"),
           "peak response time": (float(m.time[peak]) - half, "s"), "overshoot of the yaw rate": (100.0 * (float(shares[peak]) - 1.0), "%"),
           "lateral acceleration": (float(m.ay[-1]), "m/s²")}  # fmt: skip
    return out | _unsteady(swing)


def lane_numbers(m: Manoeuvre, gates: list[tuple[float, float, float, float]], width: float) -> Numbers:
    """Of a lane change between gates (begin, end, right, left): what passes the middle of the vehicle by, with half of its width."""
    beyond = [
        np.maximum(right - (m.y - 0.5 * width), m.y + 0.5 * width - left)[(m.x >= begin) & (m.x <= end)]
        for begin, end, right, left in gates
    ]
    worst = max((float(np.max(each)) for each in beyond if len(each)), default=float("nan"))
    speed, turns = np.hypot(m.vx, m.vy), np.degrees(float(np.max(np.abs(m.yaw_rate))))
    passed = "beyond the gates" if worst > 0.0 else "room left in the gates"
    return {passed: (abs(worst), "m"), "speed at the first gate": (float(np.interp(gates[0][0], m.x, speed)), "m/s"),
            "speed at the last gate": (float(np.interp(gates[-1][1], m.x, speed)), "m/s"),
            "greatest lateral acceleration": (float(np.max(np.abs(m.ay))), "m/s²"), "greatest yaw rate": (turns, "°/s"),
            "greatest steering": (np.degrees(float(np.max(np.abs(m.steering)))), "°")}  # fmt: skip


def braking_numbers(m: Manoeuvre, begin: float) -> Numbers:
    """Of braking from a time on, in a turn or on split grip: way, deceleration, and what yaw and side slip do."""
    during = (m.time >= begin) & (m.vx > 1.0)
    before = m.time < begin
    k, last = int(np.argmax(during)), int(len(m.time) - 1 - np.argmax(during[::-1]))
    turned = m.yaw[during] - m.yaw[k] - m.yaw_rate[k] * (m.time[during] - m.time[k])
    mean = (float(m.vx[k]) - float(m.vx[last])) / max(float(m.time[last] - m.time[k]), 1e-9)
    out = {"speed": (float(m.vx[k]), "m/s"), "mean deceleration": (mean, "m/s²"),
           "way": (float(np.sum(np.hypot(np.diff(m.x[k:]), np.diff(m.y[k:])))), "m"),
           "greatest yaw rate": (np.degrees(float(np.max(np.abs(m.yaw_rate[during])))), "°/s"),
           "greatest side slip": (np.degrees(float(np.max(np.abs(np.arctan2(m.vy, m.vx)[during])))), "°"),
           "yaw beyond that of the turn before": (np.degrees(float(turned[np.argmax(np.abs(turned))])), "°")}  # fmt: skip
    return {"lateral acceleration before": (float(m.ay[before][-1]), "m/s²"), **out}


def slope_numbers(m: Manoeuvre) -> Numbers:
    """Of a start on a slope along x: how far it rolls back, and how soon it has gone five metres."""
    gone = m.x - m.x[0]
    there = np.argmax(gone > 5.0)
    out: Numbers = {"rolls back": (max(-float(np.min(gone)), 0.0), "m"), "speed at the end": (float(m.vx[-1]), "m/s")}
    return out | (
        {"time to 5 m": (float(m.time[there]), "s")} if gone[-1] > 5.0 else {"gone at the end": (float(gone[-1]), "m")}
    )


def handling_html(machine: str, found: Mapping[str, tuple[Manoeuvre, Numbers, str]]) -> str:
    """The page as text: numbers of each manoeuvre with the verdict on its run, understeer plot, g-g diagram, histories."""
    plots, told = [], {name: (numbers, trust) for name, (_, numbers, trust) in found.items()}
    for name, (m, _, _) in found.items():
        if name == "circle":
            angles = {"steering": m.steering, "side slip": np.arctan2(m.vy, m.vx), "roll": m.roll}
            lines = [Line(of, m.vx * m.yaw_rate / G, np.degrees(angle)) for of, angle in angles.items()]
            plots.append(("Understeer", curves(lines, "lateral acceleration [g]", "angle [°]")))
        else:
            rate = [
                Line("yaw rate [°/s]", m.time, np.degrees(m.yaw_rate)),
                Line("steering [°]", m.time, np.degrees(m.steering)),
            ]
            plots.append((f"{name}: yaw rate", curves(rate, "time [s]", "yaw rate [°/s], steering [°]")))
        plots.append((f"{name}: way", path_drawing(m.x, m.y, "x [m]", "y [m]")))
    all_of = [Line(name, m.ay / G, m.ax / G) for name, (m, _, _) in found.items()]
    plots.insert(0, ("g-g diagram", curves(all_of, "lateral acceleration [g]", "longitudinal acceleration [g]")))
    return plots_page(f"{machine}: handling", told, plots, NOTE)


def plots_page(name: str, told: Mapping[str, tuple[Numbers, str]], plots: list[tuple[str, str]], note: str) -> str:
    """A page of numbers, a column each with its verdict, and of plots with their titles."""
    units = {what: unit for numbers, _ in told.values() for what, (_, unit) in numbers.items()}
    columns = [{what: f"{value:.4g}" for what, (value, _) in numbers.items()} for numbers, _ in told.values()]
    rows = [(f"{what} [{unit}]", [column.get(what, "") for column in columns]) for what, unit in units.items()]
    rows.append(("trust", [trust for _, trust in told.values()]))
    styles = ("reduction.css", "plots.css")
    return page("plots.html.j2", styles, name=name, heads=[*told], rows=rows, plots=plots, note=note)
