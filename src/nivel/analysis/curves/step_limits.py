"""Limits of chosen steps over time: what a function of time alone does in between would not be seen."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.curves.functions import Curve, TableCurve, varying
from nivel.integrate.loop.run import PARTS
from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.tree import TIME

Array = NDArray[np.float64]
# samples in one of the PARTS of a run
SAMPLES = 16
# Within a step a function changes by this share of its range at most: six steps a period.
CHANGE = 0.5
# Bounds beyond the samples by this share of the range are looked into by so many halvings, so many intervals at once.
BEYOND, HALVINGS, MOST_INTERVALS = 0.05, 16, 4096


def allowed_steps(machine: MachineRecord, duration: float) -> Array:
    """(PARTS,) [s] the longest step that may begin in each part of a run; infinite where nothing varies fast."""
    allowed = np.full(PARTS, np.inf)
    time = np.linspace(0.0, duration, PARTS * SAMPLES + 1)
    for function in varying(machine):
        curve = function.curve
        if curve.signals or (isinstance(curve, TableCurve) and curve.table.interpolation == "linear"):
            continue  # steps end at the points of tables of straight lines
        values = curve.values({TIME: time})
        if not np.isfinite(values).any():
            continue
        at, seen = with_features(curve, time, np.nan_to_num(values))
        with np.errstate(over="ignore"):  # a jump has no slope that is a number
            slope = np.abs(np.diff(seen)) / np.maximum(np.diff(at), 1e-300)
        slope[np.diff(at) < 1.5 * duration / (PARTS * SAMPLES * 2**HALVINGS)] = 0.0  # a jump, which no step resolves
        part = np.minimum((0.5 * (at[:-1] + at[1:]) / duration * PARTS).astype(int), PARTS - 1)
        steepest = np.zeros(PARTS)
        np.maximum.at(steepest, part, slope)
        span = float(np.ptp(seen))
        moving = steepest * duration > span * (1.0 + 1e-9)
        allowed[moving] = np.minimum(allowed[moving], CHANGE * span / steepest[moving])
    part = duration / PARTS
    return _ending_before(_beside(allowed, part), part)


@np.errstate(over="ignore", invalid="ignore")  # of functions that are no numbers somewhere
def rounding_of_times(machine: MachineRecord, duration: float) -> float:
    """By what share of its impulse a function of time alone is uncertain, at most, because times are rounded: its total variation by what
    the end of the run [s] is rounded to, over the integral of its magnitude. Two runs are not apart by that."""
    share = 0.0
    for function in varying(machine):
        curve = function.curve
        if curve.signals:
            continue
        time = np.linspace(0.0, duration, PARTS * SAMPLES + 1)
        if isinstance(curve, TableCurve):
            points = curve.points[0]
            time = np.union1d(time, points[(points > 0.0) & (points < duration)])
        at, seen = with_features(curve, time, np.nan_to_num(curve.values({TIME: time})))
        impulse = float(np.trapezoid(np.abs(seen), at))
        uncertain = float(np.abs(np.diff(seen)).sum()) * float(np.spacing(duration))
        if impulse > 0.0 and np.isfinite(uncertain / impulse):
            share = max(share, uncertain / impulse)
    return share


def with_features(curve: Curve, time: Array, values: Array) -> tuple[Array, Array]:
    """Times and values with more of them where the function has more than was sampled."""
    begin, width = time[:-1], np.diff(time)
    low, high = np.minimum(values[:-1], values[1:]), np.maximum(values[:-1], values[1:])
    for _ in range(HALVINGS):
        found = curve.bounds({TIME: (begin, begin + width)})
        if found is None:
            break
        beyond = np.maximum(found[1] - high, low - found[0])
        floor = max(
            BEYOND * float(np.ptp(values)), 1e-6 * float(np.max(beyond, initial=0.0, where=np.isfinite(beyond)))
        )
        keep = np.flatnonzero(beyond > floor)
        if len(keep) > MOST_INTERVALS:
            keep = keep[np.argsort(-beyond[keep], kind="stable")[:MOST_INTERVALS]]
        if not len(keep):
            break
        begin, width, low, high = begin[keep], width[keep], low[keep], high[keep]
        middle = begin + 0.5 * width
        inside = np.nan_to_num(curve.values({TIME: middle}))
        order = np.argsort(np.concatenate([time, middle]), kind="stable")
        time, values = np.concatenate([time, middle])[order], np.concatenate([values, inside])[order]
        low, high = np.minimum(low, inside), np.maximum(high, inside)
        begin, width = np.concatenate([begin, middle]), np.tile(0.5 * width, 2)
        low, high = np.tile(low, 2), np.tile(high, 2)
    return time, values


def _beside(allowed: Array, part: float) -> Array:
    """No more than what is allowed in any part nearer than a step of that length: the top of a sine is as fast as its sides."""
    out = allowed.copy()
    for k in np.flatnonzero(np.isfinite(allowed)):
        reach = int(allowed[k] / part)
        near = slice(max(0, k - reach), k + reach + 1)
        out[near] = np.minimum(out[near], allowed[k])
    return out


def _ending_before(allowed: Array, part: float) -> Array:
    """What is allowed where a step may not reach beyond the begin of a later part by more than what is allowed there."""
    out = allowed.copy()
    for k in range(len(out) - 2, -1, -1):
        out[k] = min(out[k], out[k + 1] + part)
    return out
