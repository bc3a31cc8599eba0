"""What `nivel check` says of beams, against closed forms."""

import dataclasses
import json

import numpy as np
import pytest
from click.testing import CliRunner

import machines
from checking import check
from nivel import Beam
from nivel.analysis.plan.beam_facts import beam_facts
from nivel.cli import main
from nivel.files import parse_machine

MACHINE = """\
format: 1
bodies:
  bob: {mass: 3, inertia: [1, 1, 1], position: [2, 0, 0]}
beams:
  rod:
    from: [0, 0, 0]
    to: [2, 0, 0]
    section: {type: rectangle, width: 2 cm, height: 1 cm}
    material: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850}
    elements: 12
    order: 2
    stations: {late: 0.75, early: 0.25}
    velocity: [0, 0, 1]
joints:
  pin: {type: revolute, bodies: [ground, rod.start], point: [0, 0, 0], axis: [0, 0, 1]}
  grip: {type: fixed, bodies: [rod.end, bob], point: [2, 0, 0]}
drivers:
  hold: {coordinate: pin.angle, value: 0}    # what drives may strike a beam
"""


def rod(axial=1e6, bending=1e-3, **more):
    section = {
        "type": "general",
        "stiffness": [axial, 1, 1, 1e-3, bending, 4 * bending],
        "mass": 2.0,
        "inertia": [1, 1, 1],
    }
    return Beam(**{"name": "rod", "from": (0, 0, 0), "to": (3, 0, 0), "section": section, "elements": 6, **more})


@pytest.mark.parametrize(("mass", "factor"), [("consistent", 12.0), ("lumped", 4.0)])
def test_fastest_vibration_of_a_stiff_bar_is_that_of_its_stretch(mass, factor):
    """Two nodes, linear between them: ω² = 12 EA/(m l²) with the consistent mass m l/6 [2 1; 1 2], 4 EA/(m l²) with m l/2 at each."""
    facts = beam_facts(rod(mass=mass))
    assert 2 * np.pi * facts.fastest == pytest.approx(np.sqrt(factor * 1e6 / 2.0) / 0.5, rel=1e-9)


@pytest.mark.parametrize("order", [1, 2, 3])
def test_no_vibration_of_the_beam_is_faster_than_that_of_an_element(order):
    """Irons and Treharne 1971. Frequencies of the whole bar along itself, from stiffness and mass put together here."""
    from scipy.linalg import eigh

    from nivel.elements.beams.exact import gauss, lagrange

    count, length = 6, 0.5
    (N, w), (D, v) = (
        (lagrange(order, xi)[k], weight) for k, (xi, weight) in enumerate((gauss(order + 1), gauss(order)))
    )
    k, m = 1e6 / length * np.einsum("g,ga,gb->ab", v, D, D), 2 * length * np.einsum("g,ga,gb->ab", w, N, N)
    K, M = np.zeros((2, count * order + 1, count * order + 1))
    for e in range(count):
        here = slice(e * order, e * order + order + 1)
        K[here, here] += k
        M[here, here] += m
    whole = np.sqrt(eigh(K, M, eigvals_only=True)[-1]) / (2 * np.pi)
    facts = beam_facts(rod(order=order))
    assert whole <= facts.fastest * (1 + 1e-9)
    assert whole > 0.9 * facts.fastest


def test_slowest_vibration_is_bending_about_the_softer_axis():
    """(4.73004/L)² √(EI/m)/(2 π): textbooks on a uniform beam with free ends."""
    assert beam_facts(rod(bending=8.0)).first_bending == pytest.approx(4.73004**2 / 9 * 2 / (2 * np.pi), rel=1e-5)


def test_a_beam_is_said_in_a_few_lines():
    facts = check(parse_machine(MACHINE))
    assert [body.name for body in facts.bodies] == ["bob"]
    (rod,) = facts.beams
    assert rod.mass == pytest.approx(7850 * 2e-4 * 2)
    assert rod.length == pytest.approx(2.0)
    assert (rod.elements, rod.nodes) == (12, 25)
    assert rod.stations == ("rod.start", "rod.early", "rod.late", "rod.end")
    text = str(facts)
    for words in (
        "3.14 kg, 2 m long",
        "12 quadratic elements, 25 nodes",
        "stations rod.start, rod.early",
        "ground → rod.start",
    ):
        assert words in text
    assert "rod.7" not in text
    assert len(text.splitlines()) < 21
    assert (
        json.loads(json.dumps(dataclasses.asdict(facts) | {"settings": facts.settings.as_dict()}))["beams"][0]["name"]
        == "rod"
    )


def test_a_machine_without_beams_says_nothing_of_them():
    assert "beams" not in str(check(machines.slider_crank()))


def test_changes_of_many_nodes_are_one_line():
    """A beam that flies off its hinge along Z: every node is stopped, or none; either way one line."""
    text = str(check(parse_machine(MACHINE)))
    lines = [line for line in text.splitlines() if "velocity of" in line]
    assert lines
    assert sum("rod" in line for line in lines) == 1


def test_the_command_says_the_same_in_json(tmp_path):
    """Newmark has settings of its own, a record in the facts."""
    (tmp_path / "rod.yaml").write_text(MACHINE + "simulation: {integrator: newmark}\n", encoding="utf-8")
    done = CliRunner().invoke(main, ["check", str(tmp_path / "rod.yaml"), "--json"])
    facts = json.loads(done.stdout)
    assert facts["beams"][0]["stations"] == ["rod.start", "rod.early", "rod.late", "rod.end"]
    assert facts["settings"]["integrator"] == "newmark"
