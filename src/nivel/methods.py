"""Words of the settings that choose methods of a run. Imports nothing heavy, so that help can list them."""

from types import MappingProxyType
from typing import Any, Final, Literal, get_args

# Integrators by what their steps are: of a fixed size, chosen for the tolerance, or either, as `step_control` says.
FixedStep = Literal[
    "euler", "heun", "rk4", "rkn4",
    "ab1", "ab2", "ab3", "ab4", "ab5",
    "am1", "am2", "am3", "am4", "am5",
    "abm1", "abm2", "abm3", "abm4", "abm5",
    "gear1", "gear2", "gear3", "gear4",
    "energy-momentum", "ros2", "extrapolated-euler",
]  # fmt: skip
ChosenStep = Literal["dopri5", "dop853", "adams", "gear", "bdf", "radau"]
EitherStep = Literal["newmark", "hht", "generalised-alpha"]
Integrator = Literal[FixedStep, ChosenStep, EitherStep]
CHOSEN: Final[tuple[str, ...]] = get_args(ChosenStep)
EITHER: Final[tuple[str, ...]] = get_args(EitherStep)
StepControl = Literal["own", "fixed", "error"]
Formulation = Literal["newton-euler", "lagrange", "penalty", "augmented-lagrangian"]
Coordinates = Literal["auto", "absolute", "relative", "independent"]
StaticCoordinates = Literal["auto", "absolute", "relative"]  # of analyses other than runs
Planned = Literal["fractional-factorial", "box-behnken", "central-composite"]  # designs of a few levels between bounds
# of the values of a sweep
Combination = Literal["grid", "rows", "fractional-factorial", "box-behnken", "central-composite"]
Drawn = Literal["latin-hypercube", "random", "sobol", "sobol-indices"]  # designs of samples
Analysis = Literal["run", "statics", "kinematics", "linearise", "inverse"]  # of the variants of a sweep
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


def chooses(integrator: str, step_control: str) -> bool:
    """Whether the integrator controls its error in a run with this `step_control`; one that is not known does not."""
    return integrator in CHOSEN or (integrator in EITHER and step_control == "error")
