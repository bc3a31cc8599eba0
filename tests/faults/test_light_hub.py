"""Two drivers of a light cylindrical hub, whose beam is a million times heavier: they move it as they move a hub of 100 g."""

import numpy as np
import pytest

from simulating import machine

SECTION = {"type": "general", "stiffness": [1e6, 1e6, 1e6, 1e3, 1e3, 1e3], "mass": 1, "inertia": [0.5] * 3}
CARRIED = {"beam": {"type": "revolute", "axis": [1, 0, 0]}, "fixed": {"type": "fixed"}}


def hub(mass, inertia, carried):
    root = {"type": "cylindrical", "bodies": ["ground", "hub"], "point": [0, 0, 0], "axis": [0, 0, 1]}
    drivers = {"turn": "root.angle", "lift": "root.displacement"}
    return {
        "bodies": {"hub": {"mass": mass, "inertia": [inertia] * 3}},
        "beams": {"a": {"from": [0, 0, 0], "to": [5, 0, 0], "section": SECTION, "elements": 4}},
        "joints": {"root": root, "roll": {"bodies": ["hub", "a.start"], "point": [0, 0, 0], **CARRIED[carried]}},
        "drivers": {name: {"coordinate": each, "value": "1.5*time"} for name, each in drivers.items()},
        "simulation": {"duration": 0.01, "step": 1e-3, "integrator": "generalised-alpha"},
    }


@pytest.mark.parametrize("carried", CARRIED)
@pytest.mark.parametrize(("mass", "inertia"), [(1e-6, 1e-9), (1e-3, 1e-6), (0.1, 1e-2)])
def test_drivers_move_a_light_hub(mass, inertia, carried):
    result = machine(hub(mass, inertia, carried)).simulate(verify=False)
    coordinates = np.asarray(result.array("joint_coordinate"))[:, :2]
    np.testing.assert_allclose(coordinates, 1.5 * result.time[:, None] * np.ones(2), atol=1e-9)
    rates = np.asarray(result.array("joint_rate"))[:, :2]
    np.testing.assert_allclose(rates, 1.5, atol=1e-7)
