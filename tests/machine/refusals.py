"""What the tests of records share: making them and reading what is wrong."""

import pytest

from nivel import Body, Marker
from nivel.errors import ModelError
from nivel.machine.bodies.shape import Sphere

BALL = {"mass": 1, "shape": Sphere(radius=0.1)}
CRANK, ROD = Body(name="crank", **BALL), Body(name="rod", **BALL)
BEAD = Body(name="bead", mass=1, point_mass=True)
MARKERS = (Marker(name="tip", body="rod"), Marker(name="eye", body="crank"), Marker(name="base", body="ground"))


def faults(make, **given):
    """What is wrong with a record, as texts `place: message`."""
    with pytest.raises(ModelError) as caught:
        make(**given)
    return [f"{fault.path}: {fault.message}" for fault in caught.value.faults]


def refused(make, **given):
    """The same in one text."""
    return "\n".join(faults(make, **given))
