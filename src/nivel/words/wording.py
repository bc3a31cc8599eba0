"""Wording of messages: what stood there, and what would be right."""

import re
from collections.abc import Mapping, Sequence
from difflib import get_close_matches
from typing import Final

from nivel.words.vocabulary import translated

LONGEST: Final = 40  # characters of a value in a message
MOST_NAMES: Final = 8  # of a list of names in a sentence
# the ends of names of one quantity: as expressions write it, and as results do
_VECTORS = (("", "position"), ("v", "velocity"), ("w", "angular_velocity"))
IN_RESULTS: Final = {f"{letter}{axis}": f"{vector}.{axis}" for letter, vector in _VECTORS for axis in "xyz"}
IN_EXPRESSIONS: Final = {long: short for short, long in IN_RESULTS.items()}
ROOMS: Final = ("control", "force", "hydraulics")  # in front of names in results


def shown(value: object) -> str:
    """`value` in a message: as in the file, short, and in one line."""
    if value is None:
        return "nothing"
    if isinstance(value, bool):
        return f"`{str(value).lower()}`"
    if isinstance(value, Mapping):
        return "a mapping"
    if isinstance(value, list | tuple) or getattr(value, "ndim", 0):
        return "a list"
    if isinstance(value, int) and abs(value) > 1e40:
        return "a number of more than 40 digits"  # Python does not write integers of thousands of digits
    if isinstance(value, type):
        return f"the class {value.__name__}"
    text = str(value)
    line = (text.splitlines() or [""])[0]
    return f"`{text}`" if line == text and len(text) <= LONGEST else f"`{line[: LONGEST - 3]}…`"


def set_in_motion(names: Sequence[str]) -> str:
    """A sentence without its full stop about bodies that move at the start though no velocity was given to them."""
    few = names if len(names) <= MOST_NAMES else [*names[: MOST_NAMES - 1], f"{len(names) - MOST_NAMES + 1} more"]
    return (
        f"velocities that are not given follow from the joints and the masses (least kinetic energy): {', '.join(few)}"
    )


def label_of(name: str) -> str:
    """A name as a label for people: `lift_lever` is "Lift lever"."""
    words = " ".join(re.split(r"[\s_-]+", name)).strip()
    return words[:1].upper() + words[1:]


def first_of(names: Sequence[str], most: int, between: str = ", ", more: str = "more") -> str:
    """The first `most` of the names, and how many more there are."""
    rest = f"{'; ' if between == '; ' else ' '}and {len(names) - most} {more}" if len(names) > most else ""
    return between.join(names[:most]) + rest


def listed(names: Sequence[str]) -> str:
    """`a`, `a and b`, `a, b and c`."""
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


def counted(count: int, one: str, many: str = "") -> str:
    """`1 joint`, `2 joints`, or `2 bodies` where the plural has a word of its own."""
    return f"{count} {one if count == 1 else many or f'{one}s'}"


def seconds(value: float) -> str:
    """A time [s] in the unit that suits it: 31 ms, 3.9 µs, 2.5 s."""
    for factor, unit in ((1.0, "s"), (1e3, "ms"), (1e6, "µs")):
        if abs(value) * factor >= 1.0:
            return f"{value * factor:.3g} {unit}"
    return f"{value * 1e9:.3g} ns"


def meant_word(word: str, valid: Sequence[str]) -> str | None:
    """The one of `valid` that `unknown_word` offers for `word`, where it is a slip of that one."""
    if translated(word, valid):
        return None
    return next(iter(get_close_matches(word, valid, n=1, cutoff=0.6)), None)


def unknown_word(word: str, valid: Sequence[str], what: str) -> str:
    """A sentence that refuses `word` and offers what it is called here, the nearest of `valid`, or all of them."""
    if answer := translated(word, valid):
        return f"the {what} `{word}` is not known; {answer}"
    if near := meant_word(word, valid):
        return f"the {what} `{word}` is not known; did you mean `{near}`?"
    if not valid:
        return f"the {what} `{word}` is not known; there are none"
    return f"the {what} `{word}` is not known; there {'are' if len(valid) > 1 else 'is'} {', '.join(valid)}"


def in_results(name: str) -> tuple[str, ...]:
    """Names that results may have for what expressions write `name`, in the order in which expressions look.

    `hinge.angle_rate` is `hinge.angle.rate`, `ball.vx` is `ball.velocity.x`, `spring.rate` is `force.spring.rate`, `servo.value` is
    `control.servo` or `state.servo`.
    """
    element, _, quantity = name.rpartition(".")
    rate = quantity.removesuffix("_rate")
    return (
        *((f"{element}.{rate}.rate",) if rate != quantity else ()),
        *((f"state.{element}", f"control.{element}") if quantity == "value" else ()),
        *(f"{room}.{name}" for room in ROOMS),
        *((f"{element}.{IN_RESULTS[quantity]}",) if quantity in IN_RESULTS else ()),
    )


def in_expressions(name: str) -> str:
    """What expressions write for a quantity that has `name` in results; `name` itself where it has one dot already, or no such form."""
    element, _, quantity = name.partition(".")
    room, _, rest = quantity.partition(".")
    if not rest:
        return name
    if element in ROOMS:
        return quantity
    return f"{element}.{room}_rate" if rest == "rate" else f"{element}.{IN_EXPRESSIONS.get(quantity, quantity)}"
