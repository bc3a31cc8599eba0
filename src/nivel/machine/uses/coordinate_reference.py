"""References to joint coordinates: `hinge.angle`, or `hinge` where only one can be meant."""

from collections.abc import Mapping, Sequence
from difflib import get_close_matches
from typing import Annotated, Any, Final, Literal

from pydantic import BeforeValidator, WithJsonSchema

from nivel.elements.joints import JOINTS
from nivel.elements.joints.joint import Joint
from nivel.machine.core.record import NAME, unknown_word
from nivel.machine.units.quantity import fault, shown
from nivel.words.vocabulary import translated

Kind = Literal["angle", "length"]

COORDINATE_KINDS: Final[dict[str, Kind]] = {
    "angle": "angle",
    "angle_1": "angle",
    "angle_2": "angle",
    "displacement": "length",
    "distance": "length",
    "x": "length",
    "y": "length",
}


def _reference(value: Any) -> str:
    if not isinstance(value, str):
        raise fault(f"a joint coordinate such as `hinge.angle` was expected, got {shown(value)}")
    joint, dot, coordinate = value.partition(".")
    if not NAME.fullmatch(joint) or (dot and not coordinate.isidentifier()):
        raise fault(f"`{value}` is not a joint coordinate; write `JOINT.COORDINATE`, e.g. `hinge.angle`")
    return value


CoordinateReference = Annotated[str, BeforeValidator(_reference), WithJsonSchema({"type": "string"})]


def kind_of(reference: object) -> Kind | None:
    """Whether `reference` is an angle or a length, where its text alone says so."""
    return COORDINATE_KINDS.get(reference.partition(".")[2]) if isinstance(reference, str) else None


class UnknownCoordinateError(ValueError):
    """The reference leads to no coordinate, or to more than one; the message says what there is."""


def resolve(reference: str, joints: Sequence[Joint], kind: Kind | None = None) -> tuple[str, str]:
    """The joint and the coordinate that `reference` means; `kind`: only coordinates of this kind are asked for.

    Raises UnknownCoordinateError.
    """
    return find(reference, {joint.name: joint.type for joint in joints}, kind)


def find(reference: str, types: Mapping[str, str], kind: Kind | None = None) -> tuple[str, str]:
    """As `resolve`, with the types of the joints by name.

    Raises UnknownCoordinateError.
    """
    joint, _, coordinate = reference.partition(".")
    if joint not in types:
        raise UnknownCoordinateError(unknown_name("joint", joint, list(types)))
    if types[joint] not in JOINTS:
        raise UnknownCoordinateError(f"the type of joint `{joint}` is not known")
    having = JOINTS[types[joint]].coordinates
    suitable = [name for name in having if kind in (None, COORDINATE_KINDS[name])]
    what = "coordinate" if kind is None else "angle" if kind == "angle" else "displacement"
    if coordinate:
        if coordinate not in having:
            _none_of(joint, types[joint], what, suitable)
            raise UnknownCoordinateError(f"of joint `{joint}`, {unknown_word(coordinate, having, 'coordinate')}")
        if coordinate not in suitable:
            raise UnknownCoordinateError(
                f"`{reference}` is {'a length' if kind == 'angle' else 'an angle'}; {an(what)} was expected"
            )
        return joint, coordinate
    _none_of(joint, types[joint], what, suitable)
    if len(suitable) > 1:
        listed = ", ".join(f"`{joint}.{name}`" for name in suitable)
        raise UnknownCoordinateError(f"joint `{joint}` has {len(suitable)} {what}s; write one of {listed}")
    return joint, suitable[0]


def _none_of(joint: str, type_: str, what: str, suitable: Sequence[str]) -> None:
    if not suitable:
        raise UnknownCoordinateError(f"joint `{joint}` has no {what}: it is {an(type_)} joint")


def an(words: str) -> str:
    """`words` with the indefinite article."""
    return f"{'an' if words[0] in 'aeio' else 'a'} {words}"


def unknown_name(what: str, name: str, known: Sequence[str]) -> str:
    """A sentence that says that no element is called `name`, and offers the nearest, or all of them."""
    near = get_close_matches(name, known, n=1, cutoff=0.6)
    if answer := translated(name, known):
        hint = f"; {answer}"
    elif near:
        hint = f"; did you mean `{near[0]}`?"
    else:
        hint = f"; there {'are' if len(known) > 1 else 'is'} {', '.join(known)}" if known else f"; there are no {what}s"
    return f"there is no {what} `{name}`{hint}"
