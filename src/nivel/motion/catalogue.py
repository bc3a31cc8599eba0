"""Coordinates and formulations by name. This file imports no kernel: a path's modules are loaded, and compiled, when it is used."""

from __future__ import annotations

from dataclasses import dataclass, replace


@dataclass(frozen=True)
class PathFacts:
    """Where the equations of motion in some coordinates are.

    module : its `evaluate` and `normalise_state`; correction : its `correct`, the direct correction; arrangement : a module of
    `nivel.system.states` that turns an assembled machine in absolute coordinates into the numbers and the state of this path. residual :
    module of its residual for implicit methods, empty where there is none. dependent : module of its `depend`, what follows from
    independent coordinates, for those that solve for accelerations.
    """

    module: str
    correction: str
    arrangement: str
    residual: str = ""
    dependent: str = ""


@dataclass(frozen=True)
class FormulationFacts:
    """How constraints enter: by multipliers where factor is 0, otherwise λ = α (C̈ + 2 Ω μ Ċ + Ω² C).

    factor : α as a multiple of the mass behind each row. iterated : until λ is that of the multipliers.
    """

    factor: float = 0.0
    iterated: bool = False


_ABSOLUTE = PathFacts(
    "nivel.motion.newton_euler",
    "nivel.motion.newton_euler_correction",
    "nivel.system.states.absolute",
    "nivel.motion.newton_euler_residual",
)
_PARAMETERS = PathFacts(
    "nivel.motion.lagrange",
    "nivel.motion.lagrange_correction",
    "nivel.system.states.parameters",
    "nivel.motion.lagrange_residual",
)
_INDEPENDENT = PathFacts(
    "nivel.motion.independent",
    "nivel.motion.independent",
    "nivel.system.states.independent",
    "nivel.motion.newton_euler_residual",
    "nivel.motion.dependent",
)
_PARAMETERS_INDEPENDENT = PathFacts(
    "nivel.motion.lagrange_independent",
    "nivel.motion.lagrange_independent",
    "nivel.system.states.parameters_independent",
)
_ANGLES, _VECTOR = (
    PathFacts(
        "nivel.motion.lagrange_three",
        "nivel.motion.lagrange_three_correction",
        f"nivel.system.states.{kind}",
        "nivel.motion.lagrange_three_residual",
    )
    for kind in ("euler_angles", "rotation_vector")
)

# of machines with flexible bodies
FLOATING = PathFacts(
    "nivel.motion.floating_frame",
    "nivel.motion.floating_frame_correction",
    "nivel.system.states.floating",
    "nivel.motion.floating_frame_residual",
)
FLEXIBLE_TREE = PathFacts(
    "nivel.motion.flexible_tree",
    "nivel.motion.flexible_tree_correction",
    "nivel.system.states.flexible_tree",
    "nivel.motion.relative_residual",
)
_FLOATING_INDEPENDENT = PathFacts(
    "nivel.motion.floating_independent",
    "nivel.motion.floating_independent",
    "nivel.system.states.floating_independent",
    "nivel.motion.floating_frame_residual",
    "nivel.motion.floating_dependent",
)

# coordinates, velocities and rotations → equations; penalty methods share those of newton-euler
PATHS: dict[tuple[str, str, str], PathFacts] = {
    ("absolute", "newton-euler", "euler-parameters"): _ABSOLUTE,
    ("absolute", "lagrange", "euler-parameters"): _PARAMETERS,
    ("absolute", "lagrange", "euler-angles"): _ANGLES,
    ("absolute", "lagrange", "rotation-vector"): _VECTOR,
    ("relative", "newton-euler", "euler-parameters"): PathFacts(
        "nivel.motion.relative",
        "nivel.motion.relative_correction",
        "nivel.system.states.relative",
        "nivel.motion.relative_residual",
    ),
    ("independent", "newton-euler", "euler-parameters"): _INDEPENDENT,
    ("independent", "lagrange", "euler-parameters"): _PARAMETERS_INDEPENDENT,
}

# the same for machines with flexible bodies
FLEXIBLE: dict[tuple[str, str, str], PathFacts] = {
    ("absolute", "newton-euler", "euler-parameters"): FLOATING,
    ("relative", "newton-euler", "euler-parameters"): FLEXIBLE_TREE,
    ("independent", "newton-euler", "euler-parameters"): _FLOATING_INDEPENDENT,
}

FORMULATIONS: dict[str, FormulationFacts] = {
    "newton-euler": FormulationFacts(),
    "lagrange": FormulationFacts(),
    "penalty": FormulationFacts(factor=1e8),
    "augmented-lagrangian": FormulationFacts(factor=1e4, iterated=True),
}


# accelerations by the residual, where the mass matrix has no blocks of single bodies; corrections with its matrix, where beams carry bodies
# that slide along them
IMPLICIT_ACCELERATIONS, IMPLICIT_CORRECTION = (
    "nivel.motion.implicit_accelerations",
    "nivel.motion.implicit_accelerations_correction",
)


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
    return replace(path, module=IMPLICIT_ACCELERATIONS, correction=IMPLICIT_CORRECTION if sliding else path.correction)
