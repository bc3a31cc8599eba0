"""Usual slips in expressions, most of them from other programs, and what to write."""

from __future__ import annotations

import re
from typing import Final

# pattern of the slip, ignoring case where it begins with (?i); the answer
_ANSWERS: Final = (
    (r"(?i)\bif\s*\([^:]*:[^)]*\)", "; write `if(condition, a, b)`"),
    (r"(?<![\w.])(?:TIME|Time|T)(?![\w.(])", " (the time is written `time`)"),
    (r"(?<![\w.])\d+(?:\.\d*)?[dD](?![\w.])", " (`d` is the unit day; degrees are written `30 deg`)"),
    (r"\?", "; write `if(condition, a, b)`"),
    (r"(?i)\bthen\b|\belse\b", "; write `if(condition, a, b)`"),
    (r"(?i)\b(?:akispl|cubspl|curve|interp1)\s*\(", "; a curve of `functions:` is called by its name: `NAME(time)`"),
    (r"(?i)\b(?:impact|bistop)\s*\(", "; an impact is a force: `{type: contact, …}`, or `{type: stop, …}` of a joint"),
    (r"(?i)\bstep5\s*\(|\bhavsin\s*\(|\bsmooth_?step\s*\(|\bsmoothstep\s*\(", "; write `step(time, t0, a, t1, b)`"),
    (r"(?i)\b[dvaw][xyzm]\s*\(", "; motion is read by name: `BODY.x`, `BODY.vx`, `SENSOR.value`"),
    (r"(?i)\b(?:ax|ay|az|psi|theta|phi)\s*\(", "; angles are read by name: `JOINT.angle`, `SENSOR.value`"),
    (r"(?i)\b(?:varval|arywal|aryval|dif|dif1)\s*\(", "; a state is read by name: `STATE.value`"),
    (r"(?i)\b(?:dtor|rtod)\b", "; write `30 deg` in place of a factor"),
    (r"\[\d\]|\[[xyz]\]", "; components are read by name: `BODY.x`, `BODY.vx`"),
    (r"\.dot\b|\bder\s*\(|'", "; rates are read by name: `JOINT.angle_rate`, `BODY.vx`"),
    (r"&&|\|\||(?<![\w.])!(?!=)", "; conditions are joined by `and`, `or` and `not(…)`"),
)  # fmt: skip


def slip(text: str) -> str:
    """What is meant by a usual slip in the expression `text`, as the end of the message on it; empty where none is seen."""
    if re.fullmatch(r"\s*[-+]?\d+,\d+(\s.*)?", text):
        return f"; write `{text.strip().replace(',', '.')}`: decimals stand behind a point"
    if re.search(r"(?<![\w.])t(?![\w.(])", text) and not re.search(r"\d\s*t\b", text):
        return " (`t` is the unit tonne; the time is written `time`)"
    return next((answer for pattern, answer in _ANSWERS if re.search(pattern, text)), "")
