"""Usual slips in expressions, most of them from other programs, and what to write."""

import re
from collections.abc import Collection
from typing import Final

# pattern of the slip, ignoring case where it begins with (?i); the answer
_ANSWERS: Final = (
    (r"(?i)\bif\s*\([^:]*:[^)]*\)", "; write `if(condition, a, b)`"),
    (r"(?<![\w.])(?:TIME|Time|T)(?![\w.(])", " (the time is written `time`)"),
    (r"(?<![\w.])\d+(?:\.\d*)?[dD](?![\w.])", " (`d` is the unit day; degrees are written `30 deg`)"),
    (r"\?", "; write `if(condition, a, b)`"),
    (r"(?i)\b(?:where|ifelse|iif|select)\s*\(|\S\s+if\s", "; write `if(condition, a, b)`"),
    (r"(?i)\b(?:heaviside|unit_?step|u_step)\s*\(", "; a jump is a comparison: write `(time > 1)`"),
    (r"·|×", "; units and numbers are multiplied by `*`"),
    (r"[²³]", "; powers are written `^2`, `^3`"),
    (r"(?i)\d\s*kilos?\b", "; write `kg`"),
    (r"^\s*[\d.]+\s*:\s*[\d.]+\s*$", "; it does not divide: write `2/1`"),
    (r"(?i)\bthen\b|\belse\b", "; write `if(condition, a, b)`"),
    (r"(?i)\b(?:akispl|cubspl|curve|interp|interp1|interp1d)\s*\(", "; a curve of `functions:` is called by its name: `NAME(time)`"),
    (r"(?i)\b(?:impact|bistop)\s*\(", "; an impact is a force: `{type: contact, …}`, or `{type: stop, …}` of a joint"),
    (r"(?i)\bstep5\s*\(|\bhavsin\s*\(|\bsmooth_?step\s*\(|\bsmoothstep\s*\(", "; write `step(time, t0, a, t1, b)`"),
    (r"(?i)\b[dvaw][xyzm]\s*\(", "; motion is read by name: `BODY.x`, `BODY.vx`, `SENSOR.value`"),
    (r"(?i)\b(?:ax|ay|az|psi|theta|phi)\s*\(", "; angles are read by name: `JOINT.angle`, `SENSOR.value`"),
    (r"(?i)\b(?:varval|arywal|aryval|dif|dif1)\s*\(", "; a state is read by name: `STATE.value`"),
    (r"(?i)\b(?:dtor|rtod)\b", "; write `30 deg` in place of a factor"),
    (r"\[\d\]|\[[xyz]\]", "; components are read by name: `BODY.x`, `BODY.vx`"),
    (r"\.dot\b|\bder\s*\(|'", "; rates are read by name: `JOINT.angle_rate`, `BODY.vx`"),
    (r"(?i)^\s*(?:steel|iron|stainless)\s*$", "; the density of steel is `7850 kg/m^3`"),
    (r"(?i)^\s*alumini?um\s*$", "; the density of aluminium is `2700 kg/m^3`"),
    (r"(?i)^\s*(?:plastic|wood|concrete|brass|copper|titanium|nylon|abs|pla)\s*$", "; write a number, e.g. `1200 kg/m^3`"),
    (r"&&|\|\||(?<![\w.])!(?!=)", "; conditions are joined by `and`, `or` and `not(…)`"),
)  # fmt: skip


_BARE_T: Final = r"(?<![\w.])(?<!\d )t(?![\w.(])"  # no unit behind a number
_PART: Final = r"k?Nm(?!m)|[kMm]?N|[kMG]?Pa|bar|k?J|k?W|kg|[mck]?m|rad|deg|min|[sghNt]|\d"
# abbreviations of data sheets, in small letters
_OF_SHEETS: Final = {"gpm": "gal/min", "lpm": "L/min", "barg": "bar", "bara": "bar", "psig": "psi", "psia": "psi"}
_OF_FORCE: Final = r"[kMm]?N|[kMG]?Pa|bar|k?J|k?W"  # before an `s` that is no plural


def spelled(name: str) -> str:
    """The units that are meant by `name`: ``kg*m^2`` for `kgm2`, ``N*s`` for `Ns`, ``L/min`` for `lpm`; empty where none are seen."""
    if name.lower() in _OF_SHEETS:
        return _OF_SHEETS[name.lower()]
    parts = re.findall(_PART, name)
    if len(parts) < 2 or "".join(parts) != name or parts[0].isdigit():
        return ""
    if parts[-1] == "s" and not re.match(_OF_FORCE, name):
        return ""
    text = parts[0]
    for part in parts[1:]:
        text += f"^{part}" if part.isdigit() else f"*{part}"
    return text


def in_kelvin(text: str) -> str:
    """The absolute temperature that is meant by one such as `20 degC` or `68 degF`; empty where none is seen."""
    found = re.fullmatch(
        r"\s*([-+]?\d+\.?\d*)\s*\*?\s*(?:deg|°|o)?\s*([CF]|celsius|Celsius|fahrenheit|Fahrenheit)\s*", text
    )
    if not found:
        return ""
    degrees = float(found[1]) if found[2][0] in "Cc" else (float(found[1]) - 32.0) / 1.8
    return f"{round(degrees + 273.15, 4):g} K"


def is_tonne_compared(text: str, taken: Collection[str]) -> bool:
    """Whether a bare `t` is compared, as in `if(t > 3, 1, 0)`: in plain SI numbers that makes sense, of a thousand kilograms."""
    return "t" not in taken and re.search(rf"{_BARE_T}\s*[<>]|[<>]=?\s*{_BARE_T}", text) is not None


def is_time_meant(text: str, taken: Collection[str]) -> bool:
    """Whether `t` stands for the time, as it is behind no number and no parameter."""
    return "t" not in taken and bool(re.search(_BARE_T, text)) and not re.search(r"\d\s*t\b", text)


def slip(text: str, taken: Collection[str] = ()) -> str:
    """What is meant by a usual slip in the expression `text`, as the end of the message on it; empty where none is seen.

    taken : names of parameters, which are no slips
    """
    if re.fullmatch(r"\s*[-+]?\d+,\d+(\s.*)?", text):
        return f"; write `{text.strip().replace(',', '.')}`: decimals stand behind a point"
    if is_time_meant(text, taken):
        return " (`t` is the unit tonne; the time is written `time`)"
    found = ((re.search(pattern, text), answer) for pattern, answer in _ANSWERS)
    return next((answer for match, answer in found if match and match[0] not in taken), "")
