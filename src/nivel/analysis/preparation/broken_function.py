"""Forces and drivers whose functions give no number."""

from __future__ import annotations

import numpy as np

from nivel.analysis.assembly.equations import MotionEquations
from nivel.system.layout import reported
from nivel.system.system import Array

# What is said of a function that has no value
NO_NUMBER = "is not a number at t ="
# Where a step became too small, it is asked how forces are so far ahead along the motion, as shares of the time.
AHEAD = (1e-9, 1e-7, 1e-5, 1e-3)


def owner_of(row: str) -> str:
    return row.split(".", maxsplit=1)[0]


def broken_function(motion: MotionEquations, time: float, step: float, y: Array) -> tuple[str, str] | None:
    """The first force or driver that is not a finite number at a time that the step from `time` looks at, in the state y or where it
    is going."""
    system, record = motion.system, motion.system.record
    outputs, constraints = record.outputs.value, record.constraints
    names = [variable.name for variable in reported(system.layout, len(outputs))]
    magnitudes = [(k, name.split(".")[1]) for k, name in enumerate(names) if name.endswith(".magnitude")]
    rows = constraints.combination[:, 0].astype(int)
    rate = motion.evaluate(time, y)[1]
    ahead = [0.5 * step, step, *(share * max(time, step) for share in AHEAD if share * time > step)]
    for by, moves in [(0.0, False), *((by, moves) for by in ahead for moves in (False, True))]:
        at, aside = time + by, y + by * rate if moves else y
        if not np.isfinite(aside).all():
            continue
        motion.evaluate(at, aside)
        broken = [f"the force {name}" for k, name in magnitudes if not np.isfinite(outputs[k])]
        known = (
            np.isfinite(constraints.C[rows])
            & np.isfinite(constraints.Cdot[rows])
            & np.isfinite(constraints.gamma[rows])
        )
        broken += [f"the motion of {owner_of(system.rows[row])}" for row in rows[~known]]
        if broken:
            name = broken[0].split()[-1]
            advice = f"Look at the law of {name}: a division by zero, or a root or logarithm of a negative number, or their derivatives?"
            if f"force.{name}.stretch" in names:
                advice = (
                    f"Has an end of {name} come into one of its wheels, or a wheel into another? The rope has no way there: "
                    "end the run before, by an event, or hold the bodies apart by a stop."
                )
            return f"{broken[0]} {NO_NUMBER} {at:.6g} s", advice
    return None
