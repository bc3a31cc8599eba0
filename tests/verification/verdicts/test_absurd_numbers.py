"""Numbers that no machine has are refused where they stand, and runs that leave all bounds end in an error: never in raw warnings."""

from contextlib import suppress

import pytest

from nivel.errors import ModelError, SolveError
from simulating import G, hinge, machine, simulate, solid


def bob(**changes):
    """An arm with a bob on a spring."""
    spring = {
        "type": "spring-damper",
        "bodies": ["arm", "bob"],
        "points": [[1, 0, 0], [1, -0.5, 0]],
        "free_length": 0.5,
    }
    return {
        "gravity": changes.get("gravity", [0, -G, 0]),
        "bodies": {
            "arm": solid(position=[0.5, 0, 0]),
            "bob": solid(changes.get("mass", 1.0), position=[1, -0.5, 0], velocity=changes.get("velocity", [0, 0, 0])),
        },
        "joints": {"pin": hinge("ground", "arm")},
        "forces": {
            "stay": {**spring, "stiffness": changes.get("stiffness", 1e3), "damping": changes.get("damping", 0)}
        },
    }


@pytest.mark.parametrize(
    ("changes", "element"),
    [
        ({"stiffness": 1e300}, "forces.stay.stiffness"),
        ({"damping": "1e150 N*s/m"}, "forces.stay.damping"),
        ({"mass": 1e101}, "bodies.bob.mass"),
        ({"velocity": [0, -1e200, 0]}, "bodies.bob.velocity.1"),
        ({"gravity": [0, -1e300, 0]}, "gravity.1"),
    ],
)
def test_numbers_whose_squares_cannot_be_held_are_refused(changes, element):
    with pytest.raises(ModelError, match=r"more than the limit of 1e\+100, in SI units: a slip of a unit\?") as caught:
        machine(bob(**changes))
    assert caught.value.faults[0].path == element


@pytest.mark.parametrize(
    ("body", "element"),
    [
        ({"mass": 1e-299, "inertia": [1, 1, 1]}, "bodies.speck.mass"),
        ({"mass": 1e-299, "point_mass": True}, "bodies.speck.mass"),
        ({"density": 7850, "shape": {"type": "box", "size": [1e-300, 1, 1]}}, "bodies.speck.shape"),
    ],
)
def test_a_mass_that_no_body_has_is_refused(body, element):
    with pytest.raises(ModelError, match="a slip of a unit") as caught:
        machine({"bodies": {"speck": body}})
    assert caught.value.faults[0].path == element


@pytest.mark.parametrize("radius", [1e-12, 1e9, 1e99])
def test_a_section_of_no_beam_is_refused(radius):
    rod = {"from": [0, 0, 0], "to": [1, 0, 0], "section": {"type": "circle", "radius": radius}, "elements": 2}
    steel = {"youngs_modulus": 2.1e11, "poisson_ratio": 0.3, "density": 7850}
    with pytest.raises(ModelError, match="is no size of a beam's section") as caught:
        machine({"beams": {"rod": {**rod, "material": steel}}})
    assert caught.value.faults[0].path == "beams.rod.section.radius"


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
@pytest.mark.parametrize("integrator", ["rk4", "dopri5", "generalised-alpha", "radau", "bdf"])
@pytest.mark.parametrize(
    "changes",
    [{"stiffness": 1e99}, {"velocity": [0, 1e99, 0]}, {"gravity": [0, -1e99, 0]}],
    ids=["stiff", "fast", "heavy"],
)
def test_below_the_limit_a_run_fails_with_an_error_or_is_done(changes, integrator, coordinates):
    """Warnings are errors in these tests."""
    settings = {"integrator": integrator, "coordinates": coordinates, "duration": 0.05, "step": 1e-3}
    with suppress(SolveError):
        assert simulate(bob(**changes), **settings).outcome == "done"
