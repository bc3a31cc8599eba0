"""Faults of beams in a file: each is found at its line, with its element and what would be right."""

import pytest

from nivel.errors import ModelError
from nivel.files import parse_machine

SECTION = "section: {type: circle, radius: 1 cm}"
MATERIAL = "    material: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850}\n"
BASE = f"""\
format: 1
beams:
  rod:
    from: [0, 0, 0]
    to: [1, 0, 0]
    {SECTION}
{MATERIAL}\
    stations: {{middle: 0.5}}
markers:
  tip: {{body: rod.end}}
joints:
  pin: {{type: revolute, bodies: [ground, rod.start], point: [0, 0, 0], axis: [0, 0, 1]}}
forces:
  push: {{type: force, body: rod.middle, position: [0.5, 0, 0], vector: [0, tip.vx, 0]}}
"""
GENERAL = "section: {{type: general, stiffness: {0}, mass: 1, inertia: [1, 1, 1]}}"
ASYMMETRIC = [[float(i == j or (i, j) == (0, 5)) for j in range(6)] for i in range(6)]
SINGULAR = [[float(i == j or {i, j} == {0, 5}) for j in range(6)] for i in range(6)]
VALUES = "section: {type: values, area: 1 cm^2, iy: 1 cm^4, iz: 1 cm^4, torsion: 1 cm^4}"
END = "to: [1, 0, 0]"
STATIONS = "    stations: {middle: 0.5}\n"
WITHOUT = {MATERIAL: ""}  # what a general section needs


def of_general(stiffness):
    return {**WITHOUT, SECTION: GENERAL.format(stiffness)}


# what stands there → what is written instead; line, element and part of the message
FAULTS = {
    "negative stiffness": (of_general([1, 1, 1, 1, 1, -1]), 6, "rod.section.stiffness", "stores negative energy"),
    "no stiffness": (of_general([1, 1, 1, 1, 1, 0]), 6, "rod.section.stiffness", "some strain costs no energy"),
    "singular stiffness": (of_general(SINGULAR), 6, "rod.section.stiffness", "some strain costs no energy"),
    "asymmetric stiffness": (of_general(ASYMMETRIC), 6, "rod.section.stiffness", "symmetric; 1 and 0 differ"),
    "five numbers": (of_general([1, 1, 1, 1, 1]), 6, "rod.section.stiffness", "got a list of 5"),
    "stiffness of a unit": (of_general("[1 m, 1, 1, 1, 1, 1]"), 6, "rod.section.stiffness.0", "a force (N) was expected"),
    "general and material": ({SECTION: GENERAL.format([1] * 6)}, 7, "rod.material", "its own stiffness and mass"),
    "general and centroid": (
        {**of_general([1] * 6), STATIONS: "    centroid: [0, 1]\n"}, 7, "rod.centroid", "its `mass_centre`"
    ),
    "no mass": (of_general([1] * 6) | {"mass: 1,": "mass: 0,"}, 6, "rod.section.mass", "greater than zero"),
    "impossible inertia": (
        of_general([1] * 6) | {"inertia: [1, 1, 1]": "inertia: [3, 1, 1]"}, 6, "rod.section.inertia", "exceeds the sum"
    ),
    "no length": ({END: "to: [0, 0, 0]"}, 5, "rod.to", "it has no length"),
    "no end": ({f"    {END}\n": ""}, 3, "rod", "`to` is missing"),
    "too far": ({END: "to: [1e200, 0, 0]"}, 5, "rod.to", "a slip of a unit?"),
    "via on the line": ({END: f"{END}\n    via: [0.5, 0, 0]"}, 6, "rod.via", "leave `via` out"),
    "arc to its start": ({END: "to: [0, 0, 0]\n    via: [1, 0, 0]"}, 5, "rod.to", "does not end where it starts"),
    "via and through": ({END: f"{END}\n    via: [0, 1, 0]\n    through: [[1, 1, 0]]"}, 7, "rod.through", "does not go with"),
    "doubled points": ({END: f"{END}\n    through: [[0, 1, 0], [0, 1, 0]]"}, 6, "rod.through.1", "the same as the one before"),
    "through its start": ({END: f"{END}\n    through: [[0, 0, 0]]"}, 6, "rod.through.0", "the same as the one before"),
    "through its end": ({END: f"{END}\n    through: [[1, 0, 0]]"}, 5, "rod.to", "the same as the one before"),
    "folded back": ({END: f"{END}\n    through: [[2, 0, 0]]"}, 3, "rod", "turns by 180 deg"),
    "up along": ({END: f"{END}\n    up: [1, 0, 0]"}, 6, "rod.up", "must point across the beam"),
    "no up": ({END: f"{END}\n    up: [0, 0, 0]"}, 6, "rod.up", "it is zero"),
    # the tangent at 0.14 of this arc: no section stands there, those beside it are turned by half a turn
    "up along an arc": ({END: f"{END}\n    via: [0.5, 0.5, 0]\n    up: [0.2213, 0.9752, 0]"}, 3, "rod", "runs along `up`"),
    "half circle in one": (
        {END: f"{END}\n    via: [0.5, 0.5, 0]", STATIONS: "    elements: 1\n"}, 9, "rod.elements", "180 deg; 90 deg at most"
    ),
    "twisted too much": ({END: f"{END}\n    twist: 3 rev"}, 3, "rod", "turns by 108 deg"),
    "station at the start": ({"middle: 0.5": "middle: 0.5, foot: 0"}, 8, "rod.stations.foot", "between 0 and 1"),
    "station beyond": ({"middle: 0.5": "middle: 0.5, tip: 1.5"}, 8, "rod.stations.tip", "between 0 and 1"),
    "station by length": ({"middle: 0.5": "middle: 0.5, tip: 0.2 m"}, 8, "rod.stations.tip", "a number was expected"),
    "two at one place": ({"middle: 0.5": "middle: 0.5, waist: 0.5"}, 8, "rod.stations.waist", "it is where `middle` is"),
    "two nearly at one": ({"middle: 0.5": "middle: 0.5, waist: 0.50001"}, 8, "rod.stations.waist", "apart at least"),
    "station called start": ({"middle: 0.5": "middle: 0.5, start: 0.1"}, 8, "rod.stations.start", "choose another name"),
    "station without a name": ({"middle: 0.5": "middle: 0.5, 3: 0.1"}, 8, "rod.stations.3", "`3` is not a name"),
    "station twice": ({"middle: 0.5": "middle: 0.5, middle: 0.6"}, 8, "rod.stations.middle", "a second time"),
    "no elements": ({STATIONS: f"{STATIONS}    elements: 0\n"}, 9, "rod.elements", "at least 1"),
    "a billion elements": ({STATIONS: f"{STATIONS}    elements: 1000000000\n"}, 9, "rod.elements", "at most 100000"),
    "half an element": ({STATIONS: f"{STATIONS}    elements: 2.5\n"}, 9, "rod.elements", "a whole number"),
    "fewer than stations": ({STATIONS: f"{STATIONS}    elements: 1\n"}, 9, "rod.elements", "2 at least are needed"),
    "order four": ({STATIONS: f"{STATIONS}    order: 4\n"}, 9, "rod.order", "at most 3"),
    "mass in kilograms": ({STATIONS: f"{STATIONS}    mass: 3 kg\n"}, 9, "rod.mass", "there are consistent, lumped"),
    "negative damping": ({STATIONS: f"{STATIONS}    damping: -1 ms\n"}, 9, "rod.damping", "got -0.001 s"),
    "damping of a spring": ({STATIONS: f"{STATIONS}    damping: 1 N s/m\n"}, 9, "rod.damping", "a time (s) was expected"),
    "no material": (WITHOUT, 3, "rod", "`material` is missing"),
    "no section": ({f"    {SECTION}\n": ""}, 3, "rod", "`section` is missing"),
    "no shear areas": ({SECTION: VALUES}, 6, "rod.section", "`shear_area_y` and `shear_area_z` are missing"),
    "one shear area": (
        {SECTION: VALUES.replace("}", ", shear_area_y: 1 cm^2}")}, 6, "rod.section", "`shear_area_z` is missing"
    ),
    "unknown key": ({STATIONS: f"{STATIONS}    element: 3\n"}, 9, "rod.element", "did you mean `elements`?"),
}  # fmt: skip


def spoilt(changes):
    text = BASE
    for there, instead in changes.items():
        assert there in text
        text = text.replace(there, instead)
    return text


def faults(text):
    with pytest.raises(ModelError) as caught:
        parse_machine(text, "machine.yaml")
    return caught.value.faults


@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_of_a_beam_is_found_where_it_is(name):
    changes, line, path, message = FAULTS[name]
    (fault,) = (each for each in faults(spoilt(changes)) if each.path.startswith("beams."))
    assert (fault.file, fault.line, fault.path) == ("machine.yaml", line, f"beams.{path}")
    assert message in fault.message


def test_the_machine_itself_is_right():
    assert parse_machine(BASE).beams[0].node_names[0] == "rod.start"


STANDING = "`rod.start`, `rod.middle`, `rod.end`"


@pytest.mark.parametrize(
    ("there", "instead", "path", "message"),
    [
        (
            "rod.start]",
            "rod.strat]",
            "joints.pin.bodies.1",
            f"the beam `rod` has no station `strat`; there are {STANDING}",
        ),
        ("rod.start]", "rod.1]", "joints.pin.bodies.1", f"the beam `rod` has no station `1`; there are {STANDING}"),
        (
            "rod.start]",
            "rod]",
            "joints.pin.bodies.1",
            f"`rod` is a beam; a place on it is needed; there are {STANDING}",
        ),
        (
            "rod.start]",
            "road.start]",
            "joints.pin.bodies.1",
            "there is no body `road.start`; did you mean `rod.start`?",
        ),
        ("ground, rod.start", "rod.end, rod.end", "joints.pin.bodies", "needs two different bodies"),
        ("body: rod.end", "body: rod", "markers.tip.body", "`rod` is a beam; a place on it is needed"),
        ("body: rod.middle", "body: rod.mid", "forces.push.body", "the beam `rod` has no station `mid`"),
        ("tip.vx", "rod.vx", "forces.push.vector.1", "`rod` is a beam and has no symbols; name a marker"),
        ("tip.vx", "rod.end.vx", "forces.push.vector.1", "has more than one dot"),
    ],
)
def test_what_takes_hold_of_no_station_is_told_which_there_are(there, instead, path, message):
    (fault,) = faults(BASE.replace(there, instead, 1))
    assert fault.path == path
    assert fault.line
    assert message in fault.message


def test_a_sensor_of_a_station_is_told_to_name_a_marker():
    found = faults(BASE + "sensors:\n  height: {marker: rod.end, quantity: position}\n")
    assert any("name a marker on it: `markers: {tip: {body: rod.end}}`" in fault.message for fault in found)


def test_a_station_has_no_shape_to_touch_with():
    contact = "  floor: {type: contact, body: rod.end, plane: {body: ground}, stiffness: 1e5, restitution: 1}\n"
    (fault,) = faults(BASE + contact)
    assert fault.path == "forces.floor.body"
    assert "has no shape" in fault.message


@pytest.mark.parametrize(
    ("name", "message"), [("rod", "bodies and beams share their names"), ("ground", "the fixed world")]
)
def test_names_of_beams_are_their_own(name, message):
    text = BASE.replace("rod", name) + "bodies:\n  rod: {mass: 1, inertia: [1, 1, 1]}\n"
    fault = faults(text)[0]
    assert (fault.line, fault.path) == (3, f"beams.{name}")
    assert message in fault.message


def test_all_faults_of_a_beam_come_at_once():
    text = spoilt({END: "to: [0, 0, 0]", STATIONS: "    stations: {middle: 1.5}\n    damping: -1\n    order: 2\n"})
    assert {fault.path for fault in faults(text)} == {"beams.rod.to", "beams.rod.stations.middle", "beams.rod.damping"}
