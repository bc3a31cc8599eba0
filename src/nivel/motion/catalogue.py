"""Coordinates and formulations by name. This file imports no kernel: a path's modules are loaded, and compiled, when it is used."""

from importlib import import_module
from typing import Any

from nivel.lazy import dataclass, replace


@dataclass(frozen=True)
class PathFacts:
    """Where the equations of motion in some coordinates are.

    module : its `evaluate` and `normalise_state`; correction : its `correct`, the direct correction; arrangement : `module:function` of
    `nivel.system.states`, which turns an assembled machine in absolute coordinates into the numbers and the state of this path. residual :
    module of its residual for implicit methods, empty where there is none. dependent : module of its `depend`, what follows from
    independent coordinates, for those that solve for accelerations.
    """

    module: str
    correction: str
    arrangement: str
    residual: str = ""
    dependent: str = ""

    @property
    def arrange(self) -> Any:
        """The function that turns an assembled machine into the numbers and the state of this path."""
        module, name = self.arrangement.split(":")
        return getattr(import_module(module), name)


@dataclass(frozen=True)
class FormulationFacts:
    """How constraints enter: by multipliers where factor is 0, otherwise λ = α (C̈ + 2 Ω μ Ċ + Ω² C).

    factor : α as a multiple of the mass behind each row. iterated : until λ is that of the multipliers.
    """

    factor: float = 0.0
    iterated: bool = False


def _path(module: str, arrange: str, residual: str = "", *, dependent: bool = False) -> PathFacts:
    module = f"nivel.motion.{module}"
    arrangement = f"nivel.system.states.{arrange}"
    return PathFacts(module, module, arrangement, residual and f"nivel.motion.{residual}", module if dependent else "")


# coordinates, velocities and rotations → equations; penalty methods share those of newton-euler
PATHS: dict[tuple[str, str, str], PathFacts] = {
    ("absolute", "newton-euler", "euler-parameters"): _path("newton_euler", "absolute:arrange", "newton_euler"),
    ("absolute", "lagrange", "euler-parameters"): _path("lagrange", "absolute:arrange_parameters", "lagrange"),
    ("absolute", "lagrange", "euler-angles"): _path(
        "lagrange_three", "absolute:arrange_euler_angles", "lagrange_three"
    ),
    ("absolute", "lagrange", "rotation-vector"): _path(
        "lagrange_three", "absolute:arrange_rotation_vectors", "lagrange_three"
    ),
    ("relative", "newton-euler", "euler-parameters"): _path("relative", "relative:arrange", "relative"),
    ("independent", "newton-euler", "euler-parameters"): _path(
        "independent", "absolute:arrange_independent", "newton_euler", dependent=True
    ),
    ("independent", "lagrange", "euler-parameters"): _path(
        "lagrange_independent", "absolute:arrange_independent_parameters"
    ),
}

# the same for machines with flexible bodies
FLOATING = _path("newton_euler", "floating:arrange", "newton_euler")
FLEXIBLE_TREE = _path("flexible_tree", "flexible_tree:arrange", "relative")
FLEXIBLE: dict[tuple[str, str, str], PathFacts] = {
    ("absolute", "newton-euler", "euler-parameters"): FLOATING,
    ("relative", "newton-euler", "euler-parameters"): FLEXIBLE_TREE,
    ("independent", "newton-euler", "euler-parameters"): _path(
        "independent", "floating:arrange_independent", "newton_euler", dependent=True
    ),
}

FORMULATIONS: dict[str, FormulationFacts] = {
    "newton-euler": FormulationFacts(),
    "lagrange": FormulationFacts(),
    "penalty": FormulationFacts(factor=1e8),
    "augmented-lagrangian": FormulationFacts(factor=1e4, iterated=True),
}


# accelerations by the residual, where the mass matrix has no blocks of single bodies, and corrections with its matrix, where beams carry
# bodies that slide along them
IMPLICIT_ACCELERATIONS = "nivel.motion.implicit_accelerations"


def path_of(
    coordinates: str,
    formulation: str,
    rotations: str,
    *,
    flexible: bool = False,
    shared: bool = False,
    sliding: bool = False,
) -> PathFacts | None:
    """The equations of these methods, or None where the combination has no meaning.

    flexible : for machines with flexible bodies. shared : for those with mass that bodies have in common. sliding : for those with bodies
    carried by beams along which they slide.
    """
    velocities = "lagrange" if formulation == "lagrange" else "newton-euler"
    path = (FLEXIBLE if flexible else PATHS).get((coordinates, velocities, rotations))
    if path is None or not (shared or sliding):
        return path
    if not path.residual or formulation != "newton-euler":
        return None
    return replace(
        path, module=IMPLICIT_ACCELERATIONS, correction=IMPLICIT_ACCELERATIONS if sliding else path.correction
    )
