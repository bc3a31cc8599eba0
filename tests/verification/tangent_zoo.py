"""Machines whose residual and tangent are verified: every joint, force, coupling and driver, loops, trees, examples."""

import numpy as np
import pytest

import force_zoo
import linked
import machines
import nivel
import stated
from example_files import RIGID
from unknowns import ROTATIONS, moving

# states of their controllers read each other, so their equations of states are no identity; a dc link near 0 V has rates beyond all bounds
CASCADES = ("servo-axis", "six-axis-arm", "electric-drive")


def seeded(make, *arguments, **options):
    return lambda: make(*arguments, np.random.default_rng(11), **options)


def example(path):
    """An example; stiction, for which there is `test_implicit_friction`, as Coulomb's friction, and where there is friction gravity
    aslant: a reaction of zero is at the kink of its size, where nothing has a derivative."""
    machine = nivel.load(path, allow_code=True).record
    if not any(force.type == "friction" for force in machine.forces):
        return machine
    forces = [
        force.replace(model="coulomb", transition_speed=0.1) if getattr(force, "model", "") == "stiction" else force
        for force in machine.forces
    ]
    return machine.replace(forces=tuple(forces), gravity=(1.0, 2.0, -9.81))


JOINTS = {
    f"{kind}{', ground' if ground else ''}": seeded(machines.pair, kind, ground=ground)
    for kind in machines.KINDS
    for ground in (False, True)
}
WHOLE = {
    "slider-crank": machines.slider_crank,
    "four-bar": machines.four_bar,
    "four-bar of revolutes": lambda: machines.four_bar("revolute", "revolute"),
    "bennett": machines.bennett,
    "heavy-top": machines.heavy_top,
    "tree": seeded(machines.tree),
    "marked tree": seeded(linked.marked_tree, branches=1),
    "free tree": seeded(linked.marked_tree, free=True, branches=1),
    "loops": lambda: linked.record(linked.loops()),
    "free ring": lambda: linked.record(linked.free_ring()),
    **{f"every element, {model}": (lambda model=model: linked.record(linked.every_element(model))) for model in ("coulomb", "lugre")},
    "states": lambda: stated.machine_with_states(bristles=False).record,
    "states and bristles": lambda: stated.machine_with_states(bristles=True).record,
    **{path.name: (lambda path=path: example(path)) for path in RIGID if path.stem not in CASCADES},
}  # fmt: skip
ZOO = {**JOINTS, **WHOLE, **force_zoo.ELEMENTS}
# draws until surfaces that are meant to press do
DRAWS = 40
COORDINATES = pytest.mark.parametrize("coordinates", ["absolute", "relative"])
# whole machines whose derivatives are found by default as well
FEW = ("slider-crank", "four-bar", "bennett", "tree", "every element, coulomb", "gear-train.yaml")


def tangent_rests(name, coordinates):
    """Whether derivatives by differences are left to the full tests: of large machines, and of elements in rotation coordinates beside
    Euler parameters."""
    return (name in WHOLE and name not in FEW) or (name in force_zoo.ELEMENTS and coordinates in ROTATIONS[1:])


def _rests(name, coordinates):
    """By default each element meets absolute coordinates and one of the others, in turn, so that all of these meet a part of the elements;
    joints and few machines meet relative ones as well, whose tree they are."""
    both = name in JOINTS or name in FEW
    if coordinates == "absolute" or (coordinates == "relative" and both):
        return False
    others = ROTATIONS if both else ("relative", *ROTATIONS)
    return list(ZOO).index(name) % len(others) != others.index(coordinates)


# all machines and elements, by the coordinates of the motion
FORMULATED = pytest.mark.parametrize(
    ("name", "coordinates"),
    [
        pytest.param(name, each, id=f"{name}-{each}", marks=[pytest.mark.full] if _rests(name, each) else [])
        for name in ZOO
        for each in ("absolute", "relative", *ROTATIONS)
    ],
)


def state_of(name, coordinates, rng):
    """A state of a machine of the zoo in motion; surfaces that touch are pressed together, which those that fly apart are not."""
    case = force_zoo.CASES.get(name, force_zoo.Case({}))
    for here in moving(ZOO[name](), coordinates, rng, DRAWS, place=case.place):
        if not case.touches or here.motion.system.record.outputs.value[0] != 0.0:
            here.name, here.coordinates = name, coordinates
            return here
    raise AssertionError(f"no state of {name} has a force")


def residual_of(here):
    """The record whose residual has the state and its unknowns."""
    record = here.motion.system.record
    record.newton.change[:] = 0.0
    record.residual.y[:], record.residual.vdot[:], record.residual.lam[:] = here.y, here.vdot, here.lam
    return record
