"""Words of the settings that choose methods of a run. Imports nothing heavy, so that help can list them."""

from __future__ import annotations

from types import MappingProxyType
from typing import Any, Final, Literal, get_args

Integrator = Literal[
    "euler", "heun", "rk4", "rkn4",
    "ab1", "ab2", "ab3", "ab4", "ab5",
    "am1", "am2", "am3", "am4", "am5",
    "abm1", "abm2", "abm3", "abm4", "abm5",
    "gear1", "gear2", "gear3", "gear4",
    "dopri5", "dop853", "adams", "gear",
    "newmark", "hht", "generalised-alpha", "energy-momentum",
    "bdf", "ros2", "extrapolated-euler", "radau",
]  # fmt: skip
# those of them that choose their steps, and those that do so with `step_control: error`
CHOOSING = ("dopri5", "dop853", "adams", "gear", "bdf", "radau")
EITHER = ("newmark", "hht", "generalised-alpha")
StepControl = Literal["own", "fixed", "error"]
Formulation = Literal["newton-euler", "lagrange", "penalty", "augmented-lagrangian"]
Coordinates = Literal["auto", "absolute", "relative", "independent"]
Rotations = Literal["euler-parameters", "euler-angles", "rotation-vector"]
Stabilisation = Literal["none", "baumgarte", "direct", "geometric"]
Start = Literal["as-given", "equilibrium"]

_WORDS: Final[MappingProxyType[str, Any]] = MappingProxyType(
    {
        "integrator": Integrator,
        "formulation": Formulation,
        "coordinates": Coordinates,
        "rotations": Rotations,
        "stabilisation": Stabilisation,
        "start": Start,
        "step_control": StepControl,
    }
)


def known_words(setting: str) -> tuple[str, ...]:
    """The words that a setting may be, e.g. of `integrator`."""
    return get_args(_WORDS[setting])
