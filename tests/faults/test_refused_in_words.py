"""Machines that are refused in words, with file, line and exit code 2: couplings of joints with several coordinates, points and axes
without a direction, joints written twice, sizes that numbers cannot hold."""

import itertools
import shutil
from contextlib import chdir, suppress
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from nivel import Body
from nivel.cli import main
from nivel.elements.joints import JOINTS
from nivel.errors import ModelError, SolveError
from nivel.judge.before.unusual import remarks
from nivel.machine.bodies.shape import Mesh
from nivel.machine.bodies.surface import surface_text
from nivel.machine.machine_record import MachineRecord
from nivel.machine.uses.coordinate_reference import COORDINATE_KINDS
from simulating import hinge, machine, solid
from solid_meshes import box_mesh

HERE = Path(__file__).parent


def command(*arguments, folder):
    """Exit code and what the command says; a defect is an error of the test."""
    with chdir(folder):
        done = CliRunner().invoke(main, list(map(str, arguments)), prog_name="nivel", catch_exceptions=False)
    return done.exit_code, done.stderr


@pytest.mark.parametrize(
    ("file", "place", "words"),
    [
        ("gear-planar", "9:28  couplings.c.joints.0", "write `joints: [p.angle, q]`"),
        ("squeezer-distance", "106:33  joints.P4.markers", "or write `type: spherical`"),
        ("long-beam", "3:6  beams.b", "a slip of a unit in `to` or in the section"),
    ],
)
def test_files_are_refused_at_their_line(file, place, words, tmp_path):
    code, said = command("check", HERE / f"{file}.yaml", folder=tmp_path)
    assert code == 2
    assert f"{file}.yaml:{place}" in said
    assert words in said


def test_a_failure_of_a_joint_written_twice_is_explained(tmp_path):
    shutil.copy(HERE / "twice.yaml", tmp_path)
    code, said = command("run", "twice.yaml", folder=tmp_path)
    assert code == 3
    assert (
        "top.euler_parameters is open by 0.001" in said
    )  # unit length to which steps of Euler's method do not hold them
    assert "--stabilisation direct" in said
    code, said = command("run", "twice.yaml", "--stabilisation", "direct", "--force", folder=tmp_path)
    assert code == 0


def joint(kind):
    """A joint of a kind between the ground and the body `a`."""
    keys = {
        "point": [0.1, 0.2, 0.3],
        "points": [[0, 0, 0], [0.4, 0.1, 0.2]],
        "axis": [0, 0, 1],
        "axes": [[0, 0, 1], [0, 1, 0]] if kind == "rolling" else [[1, 0, 0], [0, 1, 0]],
        "pitch": 0.01,
        "locked": ["x", "y", "rx"],
        "radius": 0.3,
    }
    facts = JOINTS[kind]
    return {"type": kind, "bodies": ["ground", "a"], **{key: keys[key] for key in (*facts.place, *facts.size)}}


PLACED = [kind for kind, facts in JOINTS.items() if not facts.rail]
COUPLINGS = {
    "gear": {"type": "gear", "ratio": 2},
    "belt": {"type": "belt", "radii": [1, 2]},
    "rack": {"type": "rack", "radius": 0.1},
}


def coupled(kind, coupling, reference):
    joints = [reference, "q"]
    return {
        "bodies": {"a": solid(), "b": solid(position=[1, 0, 0])},
        "joints": {"j": joint(kind), "q": hinge("ground", "b", (1, 0, 0))},
        "couplings": {"c": {**COUPLINGS[coupling], "joints": joints[::-1] if coupling == "rack" else joints}},
    }


@pytest.mark.parametrize(("kind", "coupling"), list(itertools.product(PLACED, COUPLINGS)))
def test_a_coupling_takes_a_joint_with_one_coordinate_of_its_kind(kind, coupling):
    names = JOINTS[kind].coordinates
    held = JOINTS[kind].held
    right = [COORDINATE_KINDS[name] for name in names if name not in held] == [
        "length" if coupling == "rack" else "angle"
    ]
    if right:
        machine(coupled(kind, coupling, "j")).check()
        return
    with pytest.raises(ModelError) as caught:
        machine(coupled(kind, coupling, "j")).check()
    assert all(fault.path.startswith("couplings.c.joints") and fault.line for fault in caught.value.faults)


@pytest.mark.parametrize(
    ("kind", "coupling"), [("cylindrical", "gear"), ("planar", "belt"), ("screw", "gear"), ("planar", "gear")]
)
def test_the_line_that_a_refusal_proposes_is_right(kind, coupling):
    with pytest.raises(ModelError, match=r"write `joints: \[j.angle, q\]`"):
        machine(coupled(kind, coupling, "j"))
    sections = coupled(kind, coupling, "j.angle")
    sections["bodies"]["b"]["angular_velocity"] = [0, 0, 1]
    result = machine(sections).simulate(duration=0.1, step=1e-3, verify=False)
    first, second = (float(np.ravel(result.array(f"{name}.angular_velocity.z"))[-1]) for name in "ab")
    # gear: angle + 2 angle is held; belt: angle - 2 angle
    assert first == pytest.approx((2.0 if coupling == "belt" else -2.0) * second, rel=1e-9)
    assert second


WITH_LINE = ("distance", "spherical-spherical", "revolute-spherical")


def two_markers(kind, apart, **more):
    """A joint of a kind between two markers that are `apart` [m] along x, their axes z."""
    return {
        "bodies": {"a": solid(position=[1, 0, 0]), "b": solid(position=[2, 0, 0])},
        "joints": {
            "e": {
                "type": kind,
                "markers": [
                    {"body": "a", "position": [0.3, 0.1, 0.2]},
                    {"body": "b", "position": [-0.7 + apart, 0.1, 0.2]},
                ],
                **more,
            }
        },
    }


@pytest.mark.parametrize("coordinates", ["absolute", "relative", "independent"])
@pytest.mark.parametrize("apart", [0.0, 1e-16, 1e-10])
@pytest.mark.parametrize("kind", WITH_LINE)
def test_a_joint_along_a_line_needs_two_places(kind, apart, coordinates):
    sections = {**two_markers(kind, apart), "simulation": {"coordinates": coordinates}}
    with pytest.raises(ModelError, match="has no direction: move one of them, or write `type: spherical`") as caught:
        machine(sections).check()
    assert caught.value.faults[0].path == "joints.e.markers"
    machine({**sections, **two_markers(kind, 1e-3)}).check()  # a millimetre is a line


def test_points_that_coincide_are_opened_where_that_is_asked_for():
    """A rod of 0.7 m whose ends are drawn at one place: closed from there, or refused in words."""
    with pytest.raises(ModelError, match=r"largest_gap: 0\.77 m"):
        machine(two_markers("distance", 0.0, distance=0.7)).check()
    with pytest.raises(ModelError, match="cannot be closed: a gap of 0\\.7 m is left"):
        machine({**two_markers("distance", 0.0, distance=0.7), "assembly": {"largest_gap": 1}}).check()


def test_axes_of_a_skew_universal_joint_must_not_be_parallel():
    with pytest.raises(
        ModelError, match="are parallel here, and a skew-universal joint needs them at an angle"
    ) as caught:
        machine(two_markers("skew-universal", 0.0)).check()
    assert caught.value.faults[0].path == "joints.e.markers"


CYLINDER = {"type": "cylinder", "piston": 0.05, "rod": 0.03, "stroke": 1, "retracted_length": 0.5}
TELESCOPE = {"type": "telescopic-cylinder", "stages": [0.1, 0.08], "strokes": [0.5, 0.5], "retracted_length": 0.5}


@pytest.mark.parametrize("joints", [{}, {"pin": {"type": "spherical", "bodies": ["ground", "a"], "point": [1, 0, 0]}}])
@pytest.mark.parametrize("component", [CYLINDER, TELESCOPE])
def test_a_cylinder_between_markers_at_one_place_is_refused(component, joints):
    ends = [{"body": "a", "position": [0.3, 0.1, 0.2]}, {"body": "b", "position": [-0.7, 0.1, 0.2]}]
    bodies = two_markers("distance", 0.0)["bodies"]
    with pytest.raises(ModelError, match="between its ends at the start") as caught:
        machine({"bodies": bodies, "joints": joints, "hydraulics": {"e": {**component, "markers": ends}}}).check()
    assert caught.value.faults[0].path == "hydraulics.e.retracted_length"


METHODS = [
    {"coordinates": "absolute"},
    {"coordinates": "relative"},
    {"coordinates": "independent"},
    {"formulation": "lagrange"},
    {"formulation": "augmented-lagrangian"},
    {"integrator": "euler", "stabilisation": "none"},
    {"formulation": "lagrange", "integrator": "euler", "stabilisation": "none"},
]


@pytest.mark.parametrize("kind", PLACED)
def test_a_joint_written_twice_runs_or_says_why_not(kind):
    """The same joint twice changes no motion; where fixed steps drift, the reason is told."""
    spinning = {"a": solid(1.0, (1.0, 1.2, 1.4), angular_velocity_body=[0, 20, 150], velocity=[1, 2, 3])}
    for settings in METHODS:
        sections = {"bodies": spinning, "joints": {"j": joint(kind), "k": joint(kind)}}
        with suppress(ModelError, SolveError):  # which are words
            machine({**sections, "simulation": settings}).simulate(duration=0.01, step=1e-3, verify=False)


SIZES = [1e9, 1e15, 1e30, 1e99, 1e-30, 1e-99]
SECTION = {"type": "rectangle", "width": 0.01, "height": 0.01}
STEEL = {"youngs_modulus": 2.07e11, "poisson_ratio": 0.3, "density": 7801}


@pytest.mark.parametrize("model", ["geometrically-exact", "segments", "ancf-cable", "ancf-beam"])
def test_a_beam_of_any_length_is_computed_or_refused_in_words(model):
    for length in SIZES:
        beam = {
            "from": [0, 0, 0],
            "to": [0, 0, length],
            "section": SECTION,
            "material": STEEL,
            "elements": 4,
            "model": model,
        }
        with suppress(ModelError):
            machine({"beams": {"b": beam}}).check()


@pytest.mark.parametrize("model", ["segments", "ancf-cable", "ancf-beam"])
def test_a_slender_beam_of_a_kilometre_is_one(model):
    beam = {"from": [0, 0, 0], "to": [0, 0, 1e3], "section": SECTION, "material": STEEL, "elements": 4, "model": model}
    assert machine({"beams": {"b": beam}}).check().beams[0]


@pytest.mark.parametrize(
    "body",
    [
        {"mass": 1, "inertia": [1, 1, 1], "centre_of_mass": [0, 0, 1e30]},
        {"mass": 1e30, "inertia": [0.03, 0.03, 0.05], "centre_of_mass": [0, 0.05, 0]},
        {"mass": 1, "inertia": [1e-20, 1e-20, 1e-20], "centre_of_mass": [1, 0, 0]},
    ],
)
def test_an_inertia_that_is_round_off_beside_the_mass_is_refused(body):
    with pytest.raises(ModelError, match="is round-off beside") as caught:
        machine({"bodies": {"a": body}}).check()
    assert caught.value.faults[0].path == "bodies.a"


def test_a_thin_rod_with_its_frame_at_its_end_is_a_body():
    """Its small moment of inertia is about the way to its centre of mass, and nothing is lost."""
    rod = {"mass": 1, "inertia": [1e-12, 1 / 12, 1 / 12], "centre_of_mass": [0.5, 0, 0]}
    assert machine({"bodies": {"a": rod}}).check().bodies[0].principal_inertia[0] == pytest.approx(1e-12, rel=1e-3)


CYLINDER = "{type: cylinder, bodies: [ground, block], points: [[0, 0, 0], [1, 0, 0]], rod: 3 cm, stroke: 1 m, retracted_length: 50 cm, piston: %s}"  # noqa: E501
CIRCUIT = """format: 1
bodies: {{block: {{mass: 5 kg, inertia: [1, 1, 1]}}}}
joints: {{rail: {{type: translational, bodies: [ground, block], point: [0, 0, 0], axis: [1, 0, 0]}}}}
hydraulics:
  tank: {{type: tank}}
  supply: {{type: volume, volume: 1 L}}
  pump: {{type: pump, ports: {{A: {a}, B: {b}}}, displacement: 28 cm^3/rev, speed: 1500 rpm}}
  relief: {{type: relief-valve, ports: {{P: supply, T: tank}}, opens_at: 200 bar, opening_range: 20 bar, flow: 1 L/s, pressure_drop: 9 bar}}
  lift: {lift}
simulation: {{duration: 1 s, step: 1 ms}}
"""


@pytest.mark.parametrize(
    ("a", "b", "piston", "place", "words"),
    [
        ("tank", "supply", "9e301 mm", "9:", "is more than the limit of 1e+100: a slip of a unit?"),
        ("between", "supply", "50 mm", "7:", "add `between: {type: volume, volume: 0.2 L}`"),
    ],
)
def test_slips_of_circuits_are_told_at_their_line(a, b, piston, place, words, tmp_path):
    (tmp_path / "a.yaml").write_text(CIRCUIT.format(a=a, b=b, lift=CYLINDER % piston), encoding="utf-8")
    code, said = command("check", "a.yaml", folder=tmp_path)
    assert code == 2
    assert f"a.yaml:{place}" in said
    assert words in said


def test_a_run_that_a_reversed_pump_ends_names_it(tmp_path):
    (tmp_path / "a.yaml").write_text(CIRCUIT.format(a="supply", b="tank", lift=CYLINDER % "50 mm"), encoding="utf-8")
    code, said = command("run", "a.yaml", "--no-report", "--no-verify", "--quiet", folder=tmp_path)
    assert code == 3
    assert "pump: the pump is reversed" in said
    assert "write `ports: {A: tank, B: supply}`" in said
    assert "shorter" not in said


@pytest.mark.parametrize(
    ("parameter", "words"),
    [
        (
            "{type: range, from: 1, to: 2, count: 100000000}",
            "this design has 100000000 variants; at most 1000000 are run",
        ),
        ("{type: tolerance, nominal: 1 kg, tolerance: 1e-20 kg}", "is less than the last digit of the nominal value 1"),
    ],
)
def test_counts_and_tolerances_of_studies_are_looked_at_before_anything_is_made(parameter, words, tmp_path):
    solid_text = "format: 1\nbodies: {block: {mass: 1 kg, inertia: [1, 1, 1]}}\n"
    (tmp_path / "machine.yaml").write_text(solid_text, encoding="utf-8")
    study = f"format: 1\nmachine: machine.yaml\nparameters:\n  block.mass: {parameter}\n"
    study += "" if "range" in parameter else "design: random\nsamples: 4\n"
    (tmp_path / "study.yaml").write_text(study, encoding="utf-8")
    code, said = command("sweep", "study.yaml", folder=tmp_path)
    assert code == 2
    assert "study.yaml:" in said
    assert words in said


def test_a_body_of_a_kilometre_is_remarked_on():
    """A cube of 1000 in a file of millimetres: 1e9 m³ of 1000 kg/m³."""
    surface = surface_text(*box_mesh(1000.0, 1000.0, 1000.0))
    body = Body(name="cube", shape=Mesh(type="mesh", surface=surface), density=1000)
    (remark,) = [each for each in remarks(MachineRecord(name="m", bodies=(body,))) if each.place == "bodies.cube.shape"]
    assert "is 1000 m long and has a mass of 1e+12 kg" in remark.text
    assert remark.text.endswith("with `unit: 1 mm` of its file, make 1 m and 1000 kg")


def test_advice_leaves_joints_as_they_are_whose_coordinates_are_used(tmp_path):
    """The closer turns the spindle, and the door rubs and stops at its hinges: neither may become another joint. The advice is followed."""
    code, said = command("check", HERE / "door-advice.yaml", folder=tmp_path)
    if code == 0:
        code, said = command("run", HERE / "door-advice.yaml", "--no-report", "--no-verify", folder=tmp_path)
    assert "or make elbow spherical and bracket cylindrical" in said
    text = (HERE / "door-advice.yaml").read_text(encoding="utf-8")
    for name, before, after in (("elbow", "revolute, ", "spherical, "), ("bracket", "revolute, ", "cylindrical, ")):
        start = text.index(f"  {name}: ")
        text = text[:start] + text[start:].replace(before, after, 1)
    line = text[text.index("  elbow: ") :].split("\n", 1)[0]
    text = text.replace(line, line.replace(", axis: [0, 0, 1]", ""))
    (tmp_path / "door.yaml").write_text(text.replace("duration: 10 s", "duration: 0.01 s"), encoding="utf-8")
    code, said = command("run", "door.yaml", "--no-report", "--no-verify", folder=tmp_path)
    assert code == 0, said


BEAM = """
format: 1
beams:
  b: {from: [0, 0, 0], to: [1, 0, 0], elements: 2, mass: %s, section: {type: rectangle, width: 1 cm, height: 1 cm},
    material: {youngs_modulus: 2.1e11, poisson_ratio: 0.3, density: 7850}}
joints:
  a: {type: fixed, bodies: [ground, b.start], point: [0, 0, 0]}
simulation: {duration: 0.01, coordinates: independent, formulation: lagrange}
"""


def test_no_method_that_nobody_named_is_refused(tmp_path):
    """These equations of beams have explicit methods alone, which are taken; where no method goes, only what was written is at fault."""
    (tmp_path / "lumped.yaml").write_text(BEAM % "lumped", encoding="utf-8")
    (tmp_path / "consistent.yaml").write_text(BEAM % "consistent", encoding="utf-8")
    code, _ = command("check", "lumped.yaml", folder=tmp_path)
    assert code == 0
    code, said = command("check", "consistent.yaml", folder=tmp_path)
    assert code == 2
    assert "write `mass: lumped`" in said or "or `mass: lumped`" in said
    assert "integrator" not in said
