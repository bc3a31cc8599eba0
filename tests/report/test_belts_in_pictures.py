"""Belts and chains in the picture of a machine: tangents and arcs around two pulleys."""

from __future__ import annotations

import numpy as np
import pytest

from nivel import Machine
from nivel.files import parse_machine
from nivel.looks.viewpoint import body_poses
from nivel.report.force_drawing import belt_line
from nivel.report.picture import machine_picture

MACHINE = """
format: 1
bodies:
  first: {position: [0, 0, 0], mass: 1, inertia: [1, 1, 1]}
  second: {position: [2, 1, 0], mass: 1, inertia: [1, 1, 1]}
joints:
  one: {type: revolute, bodies: [ground, first], point: [0, 0, 0], axis: [0, 0, 1]}
  two: {type: revolute, bodies: [ground, second], point: [2, 1, 0.5], axis: [0, 0, 1]}
simulation: {duration: 1}
"""
BELTS = {
    "couplings": "couplings: {strap: {type: belt, joints: [one, two], radii: [0.3, 0.8], crossed: CROSSED}}",
    "forces": "forces: {strap: {type: belt-drive, coordinate: one, against: two, radii: [0.3, 0.8], crossed: CROSSED, stiffness: 1e4}}",
}


@pytest.mark.parametrize("crossed", [False, True])
@pytest.mark.parametrize("section", BELTS)
def test_strands_are_tangents_of_both_pulleys(section: str, crossed: bool) -> None:
    text = MACHINE + BELTS[section].replace("CROSSED", str(crossed).lower())
    posed = Machine.from_record(parse_machine(text)).start()
    (belt,) = posed.scene["belts"]
    line = belt_line(belt, posed.scene["joints"], body_poses(posed.scene, posed["position"], posed["orientation"]))
    assert np.allclose(line[0], line[-1])
    flat, reach = line[:, :2], 1.1 if crossed else -0.5
    lengths = np.sort(np.linalg.norm(np.diff(flat, axis=0), axis=1))
    assert lengths[-2:] == pytest.approx(
        np.sqrt(5.0 - reach**2), rel=1e-12
    )  # the strands; arcs are cut into shorter parts
    assert lengths[-3] < 0.3
    to_centres = np.linalg.norm(flat[:, None] - np.array([[0.0, 0.0], [2.0, 1.0]]), axis=2)
    assert np.all(np.isclose(to_centres, [0.3, 0.8]).any(axis=1))
    assert np.all(to_centres > np.array([0.3, 0.8]) - 1e-12)
    assert ">strap</text>" in machine_picture(posed.scene, posed["position"], posed["orientation"])
