"""The model in Python: elements by name, copies with other values, and machines that go to a file and back."""

import inspect

import pytest

import nivel
from example_files import EXAMPLES, RIGID
from nivel.elements.forces import FORCES
from nivel.errors import ModelError
from nivel.machine.uses.references import SECTIONS

LEG = """
format: 1
parameters: {length: 40 cm}
bodies:
  thigh: {shape: {type: cylinder, from: [0, 0, 0], to: [0, 0, -length], radius: 5 cm}, mass: 8 kg}
markers:
  foot: {body: thigh, position: [0, 0, -length]}
"""
WALKER = """
format: 1
parameters: {hip: 15 cm, width: 2*hip}
bodies: {trunk: {shape: {type: box, size: [20 cm, width, 10 cm]}, mass: 20 kg}}
assemblies:
  left: {file: leg.yaml, position: [0, hip, 0]}
  right: {file: leg.yaml, position: [0, -hip, 0], mirror: y, parameters: {length: 48 cm}}
joints:
  left_hip: {type: spherical, bodies: [trunk, left_thigh], point: [0, hip, 0]}
"""


@pytest.fixture
def crank():
    return nivel.load(EXAMPLES / "mechanisms" / "slider-crank.yaml")


@pytest.fixture
def walker(tmp_path):
    (tmp_path / "leg.yaml").write_text(LEG, encoding="utf-8")
    (tmp_path / "walker.yaml").write_text(WALKER, encoding="utf-8")
    return nivel.load(tmp_path / "walker.yaml")


def test_elements_go_by_their_names(crank):
    assert crank.bodies["crank"].mass == 21
    assert crank["crank"] is crank.bodies["crank"]
    assert crank["hinge"] is crank.joints["hinge"]
    assert list(crank.bodies) == ["crank", "rod", "slider"]
    assert crank["bodies.crank.mass"] == crank["crank.mass"] == 21
    assert crank["simulation.duration"] == 8
    assert crank["gravity.1"] == crank.gravity[1]
    assert "crank" in crank
    assert "crnk" not in crank


def test_every_section_of_a_machine_is_a_mapping_by_name(crank):
    for section in SECTIONS:
        assert len(getattr(crank, section)) == len(getattr(crank.record, section))


def test_parameters_and_subsystems_of_a_file_are_read(walker):
    assert walker.parameters == {"hip": 0.15, "width": 0.3}
    assert walker["parameters.width"] == 0.3
    right = walker.assemblies["right"]
    assert list(right.bodies) == ["thigh"]
    assert right.bodies["thigh"] is walker.bodies["right_thigh"]
    assert right.markers["foot"].position == pytest.approx((0, 0, -0.48))
    assert right.assembly.mirror == "y"


def test_what_depends_on_a_parameter_follows_it(walker):
    wider = walker.with_values({"parameters.hip": "20 cm", "assemblies.left.parameters": {"length": 0.5}})
    assert wider["trunk.shape.size"] == pytest.approx((0.2, 0.4, 0.1))
    assert wider["left_foot.position"] == pytest.approx((0, 0, -0.5))
    assert walker["parameters.hip"] == 0.15
    assert wider.with_values({"trunk.mass": 3})["trunk.shape.size"] == pytest.approx((0.2, 0.4, 0.1))


def test_values_of_a_machine_from_records_change_as_in_a_file(crank):
    changed = crank.replace(crank["crank"].replace(mass=5), gravity=(0, 0, -1.6))
    again = changed.with_values({"bodies.crank.mass": "22 kg", "joints.hinge.start.angle": "10 deg"})
    assert (changed["crank.mass"], again["crank.mass"]) == (5, 22)
    assert again.gravity == (0, 0, -1.6)


def test_settings_given_before_stay_and_later_values_win(crank):
    machine = crank.with_settings({"duration": 2.0, "step": "2 ms"}).with_values({"simulation.step": "4 ms"})
    assert (machine.simulation.duration, machine.simulation.step) == (2.0, 0.004)


def test_elements_are_replaced_added_and_taken_away(crank):
    ball = nivel.Body(name="ball", mass=1, inertia=(1, 1, 1))
    more = crank.with_elements(
        ball, nivel.Joint(name="pin2", type="spherical", bodies=("slider", "ball"), point=(0, 0, 0))
    )
    assert list(more.bodies) == ["crank", "rod", "slider", "ball"]
    assert more.without("ball", "pin2") == crank
    assert crank.replace(crank["rod"].replace(mass=3))["rod.mass"] == 3


def test_assigning_is_refused_with_the_line_to_write(crank):
    body = next(iter(crank.bodies))
    with pytest.raises(ModelError, match=rf"machine\.with_values\(\{{'{body}\.mass': 3\}}\)"):
        crank.bodies[body].mass = 3
    with pytest.raises(ModelError, match=r"machine = machine\.replace\(gravity=…\)"):
        crank.gravity = (0, 0, 0)
    with pytest.raises(AttributeError, match=r"write \['rod'\]"):
        _ = crank.bodies.rod


def test_elements_are_not_put_into_a_machine_by_assignment(crank):
    bodies = crank.bodies
    with pytest.raises(ModelError, match=r"write `machine = machine.replace\(crank\)`"):
        bodies["crank"] = bodies["rod"]
    with pytest.raises(ModelError, match=r"write `machine = machine.without\('crank'\)`"):
        del bodies["crank"]


def test_wrong_names_of_parameters_and_subsystems_are_answered_with_the_nearest(walker):
    with pytest.raises(ModelError, match="the parameter `widht` is not known; did you mean `width`"):
        walker.parameters["widht"]
    with pytest.raises(ModelError, match="the assembly `lft` is not known; did you mean `left`"):
        walker.assemblies["lft"]
    assert walker.parameters.get("widht") is None


def test_completion_offers_the_fields_of_a_record_and_nothing_of_its_machinery(crank):
    offered = {name for name in dir(crank["crank"]) if not name.startswith("_")}
    assert offered == {*nivel.Body.model_fields, "replace"}


def test_a_part_written_in_python_is_placed_like_that_of_a_file(walker, tmp_path):
    leg = nivel.load(tmp_path / "leg.yaml")
    alone = nivel.Machine("trunk", bodies=[walker["trunk"]])
    both = alone.with_part("left", leg, position=(0, 0.15, 0))
    assert both["left_thigh"] == walker["left_thigh"]


@pytest.mark.parametrize("path", [*RIGID, *sorted(EXAMPLES.glob("beams/*.yaml"))], ids=lambda path: path.stem)
def test_every_example_survives_the_way_to_a_file_and_back(path, tmp_path):
    machine = nivel.load(path, allow_code=True)
    machine.save(tmp_path / "again.yaml")
    assert nivel.load(tmp_path / "again.yaml", allow_code=True) == machine


FAULTS = {
    "the element `crnk` is not known; did you mean `crank`?": lambda m: m["crnk"],
    "the body `rood` is not known; did you mean `rod`?": lambda m: m.bodies["rood"],
    "bodies.crank.mas: the key `mas` is not known; did you mean `mass`?": lambda m: m["crank.mas"],
    "in `parameters`, the name `radius` is not known": lambda m: m.with_values({"parameters.radius": 1}),
    "nothing to replace: the name `pin2` is not known; did you mean `pin`?": lambda m: m.replace(
        m["pin"].replace(name="pin2")
    ),
    "graviti: the key `graviti` is not known; did you mean `gravity`?": lambda m: m.replace(graviti=(0, 0, 0)),
    "there is no body `crank`": lambda m: m.without("crank"),
    "the name `rod` stands twice in bodies": lambda m: m.with_elements(m["rod"]),
    "gravity.7: this is a list of 3; its entries are 0 to 2, not `7`": lambda m: m["gravity.7"],
    "bodies.crank.mass: `3 m` is a length (m); a mass (kg) was expected": lambda m: m.replace(name="other").with_values(
        {"crank.mass": "3 m"}
    ),
    "the machine has no parameters": lambda m: m.replace(name="other").with_values({"parameters.offset": 1}),
    "a Record was expected, got `rod`": lambda m: m.replace("rod"),
    "posit: the key `posit` is not known; did you mean `position`?": lambda m: m.with_part("left", m, posit=1),
    "several elements are called `rod`: write `bodies.rod` or `sensors.rod`": lambda m: m.with_elements(
        nivel.Sensor(name="rod", coordinate="hinge.angle", quantity="value")
    )["rod"],
}


@pytest.mark.parametrize("message", FAULTS)
def test_faults_say_what_to_write(message, crank):
    with pytest.raises(ModelError) as caught:
        FAULTS[message](crank)
    assert message in str(caught.value)


@pytest.mark.parametrize(
    "record", [nivel.Body, nivel.Joint, nivel.Sensor, *FORCES.records], ids=lambda record: record.__name__
)
def test_help_says_what_each_field_takes_in_words(record):
    text = str(inspect.signature(record))
    assert "Annotated" not in text
    assert "Validator" not in text
    assert "pydantic" not in text.lower()
    assert "(*, name: text" in text


def test_help_is_in_words_after_a_package_has_added_a_type_of_joint():
    nivel.Joint.model_rebuild(force=True)
    assert "Annotated" not in str(inspect.signature(nivel.Joint))


def test_a_body_is_shown_as_it_would_be_written():
    assert str(nivel.Body(name="ball", mass="2 kg", point_mass=True)) == "Body(name='ball', mass=2.0, point_mass=True)"
    assert "mass: a mass in kg = None" in str(inspect.signature(nivel.Body))
