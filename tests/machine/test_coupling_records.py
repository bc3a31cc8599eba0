"""Couplings: their equations, and what they refuse."""

import pytest
from refusals import refused

from nivel import Belt, FunctionCoupling, Gear, LinearCoupling, Rack

AB = {"joints": ("a", "b.angle")}
CAM = {"coordinate": "a.angle"}
TABLE = {"of": "b.angle", "points": [0, 1], "values": [0, 2]}
LAW = {"source": "def f(q):\n    return q\n", "function": "f", "arguments": ["b.angle"]}


@pytest.mark.parametrize(
    ("coupling", "terms"),
    [
        (Gear(name="g", **AB, teeth=(20, 40)), (("a", 20.0), ("b.angle", 40.0))),
        (Gear(name="g", **AB, teeth=(20, 40), internal=True), (("a", 20.0), ("b.angle", -40.0))),
        (Gear(name="g", **AB, ratio="2.5"), (("a", 1.0), ("b.angle", 2.5))),
        (Belt(name="g", **AB, radii=("10 cm", 0.2)), (("a", 0.1), ("b.angle", -0.2))),
        (Belt(name="g", **AB, radii=("10 cm", 0.2), crossed=True), (("a", 0.1), ("b.angle", 0.2))),
        (Rack(name="g", **AB, radius=-0.5), (("b.angle", 1.0), ("a", 0.5))),
        (
            LinearCoupling(name="g", coordinates=("a", "b.x", "c.y"), factors=(1, -0.5, "1/4")),
            (("a", 1.0), ("b.x", -0.5), ("c.y", 0.25)),
        ),
        (
            FunctionCoupling(name="g", coordinate="a.displacement", value="1 cm * sin(b.angle) * c.angle"),
            (("a.displacement", 1.0), ("b.angle", 0.0), ("c.angle", 0.0)),
        ),
    ],
    ids=lambda value: value.type if hasattr(value, "type") else "",
)
def test_the_terms_are_those_of_the_equation(coupling, terms):
    assert coupling.terms == terms
    assert len(coupling.kinds) == len(terms)


@pytest.mark.parametrize(
    ("make", "given", "part"),
    [
        (Gear, {**AB}, "couplings.g: `teeth` is missing: a gear needs `teeth: [n1, n2]` or a `ratio` (n2/n1)"),
        (Gear, {**AB, "teeth": (20, 40), "ratio": 2}, "couplings.g.ratio: `ratio` must not be given with `teeth`"),
        (Gear, {**AB, "teeth": (20, 0)}, "couplings.g.teeth.1: a number greater than zero was expected"),
        (Gear, {**AB, "teeth": (20, 40.5)}, "couplings.g.teeth.1: a whole number of teeth was expected, got `40.5`"),
        (Gear, {**AB, "ratio": 2, "internal": "yes"}, "couplings.g.internal: true or false was expected, got `yes`"),
        (Gear, {"joints": ("a",), "ratio": 2}, "couplings.g.joints: entries are missing"),
        (Gear, {"joints": ("a", 5), "ratio": 2}, "couplings.g.joints.1: a joint coordinate such as `hinge.angle` was"),
        (Gear, {"joints": ("a", "b."), "ratio": 2}, "`b.` is not a joint coordinate; write `JOINT.COORDINATE`"),
        (Gear, {"joints": ("a", "b.c.d"), "ratio": 2}, "`b.c.d` is not a joint coordinate"),
        (
            Belt,
            {**AB, "radii": (1, "5 deg")},
            "couplings.g.radii.1: `5 deg` is an angle (rad); a length (m) was expected",
        ),
        (Belt, {**AB}, "`radii` is missing"),
        (Rack, {**AB, "radius": 0}, "couplings.g.radius: `radius` is zero: such a pinion moves no rack"),
        (LinearCoupling, {"coordinates": ("a",), "factors": (1,)}, "two or more coordinates were expected, got 1"),
        (LinearCoupling, {"coordinates": ("a", "b"), "factors": (1,)}, "as many factors as coordinates; got 1 and 2"),
        (LinearCoupling, {"coordinates": ("a", "b"), "factors": (1, 0)}, "couplings.g.factors.1: the factor is zero"),
        (
            FunctionCoupling,
            {**CAM, "value": "abs(b.angle)"},
            "couplings.g.value: `abs` has corners; a coupling must be",
        ),
        (FunctionCoupling, {**CAM, "value": "time*b.angle"}, "what follows `time` is the `value` of a driver"),
        (FunctionCoupling, {**CAM, "value": "5 deg"}, "no joint coordinate stands here"),
        (FunctionCoupling, {**CAM, "value": "2*a.angle"}, "`a.angle` follows from other coordinates, not from itself"),
        (FunctionCoupling, {**CAM, "value": "2 cm * b.angle"}, "an angle (rad) was expected"),
        (FunctionCoupling, {**CAM, "value": TABLE}, "corners, where speeds or accelerations would jump; write `interp"),
        (FunctionCoupling, {**CAM, "value": LAW}, "a function in Python has no exact derivatives"),
    ],
)
def test_refused(make, given, part):
    assert part in refused(make, name="g", **given)
