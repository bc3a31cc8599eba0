"""`nivel import`: SDF, what is recognised and refused, and the machine file that is written."""

from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import nivel
from exchange_models import joint, link, robot
from nivel.cli import main
from nivel.exchange import read_model
from nivel.exchange.looks import Drawing
from nivel.exchange.mechanism import Frame, Link, Look
from nivel.exchange.translation import Notes
from nivel.files import parse_machine

ROOT = Path(__file__).parents[2]
ARM = ROOT / "examples" / "robots" / "arm.urdf"

BAR = """<inertial><pose>0.5 0 0 0 0 0</pose><mass>2</mass><inertia><ixx>0.01</ixx><iyy>0.2</iyy><izz>0.2</izz></inertia></inertial>"""
FOUR_BAR = f"""<sdf version="1.9"><model name="four_bar"><pose>0 0 1 0 0 0</pose>
<link name="crank">{BAR}</link>
<link name="coupler"><pose relative_to="crank">1 0 0 0 0 90</pose>{BAR}</link>
<link name="rocker"><pose relative_to="hinge">0 0 0 0 0 0</pose>{BAR}</link>
<frame name="hinge"><pose>0 1 0 0 0 0</pose></frame>
<joint name="a" type="revolute"><parent>world</parent><child>crank</child><axis><xyz>0 0 1</xyz>
<limit><lower>-inf</lower><upper>1e16</upper></limit><dynamics><damping>0.5</damping></dynamics></axis></joint>
<joint name="b" type="revolute"><parent>crank</parent><child>coupler</child><axis><xyz>0 0 1</xyz></axis></joint>
<joint name="c" type="ball"><pose>1 0 0 0 0 0</pose><parent>coupler</parent><child>rocker</child></joint>
<joint name="d" type="revolute"><parent>world</parent><child>rocker</child>
<axis><xyz expressed_in="crank">0 0 1</xyz></axis></joint>
</model></sdf>
""".replace("0 0 90</pose>", "0 0 1.5707963267948966</pose>")


def written(folder, text, name="model.sdf"):
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def test_sdf_places_links_and_joints_by_their_poses_and_closes_loops(tmp_path):
    data = read_model(written(tmp_path, FOUR_BAR)).data
    assert {name: body["position"] for name, body in data["bodies"].items()} == {
        "crank": [0, 0, 1],
        "coupler": [1, 0, 1],
        "rocker": [0, 1, 1],
    }
    assert {name: each["point"] for name, each in data["joints"].items()} == {
        "a": [0, 0, 1],
        "b": [1, 0, 1],
        "c": [1, 1, 1],
        "d": [0, 1, 1],
    }
    assert data["gravity"] == [0, 0, -9.8]
    assert list(data["forces"]) == ["a_damper"]  # an end beyond any machine is none
    # a parallelogram: the coupler moves without turning, and both other bars turn about their ends
    mechanics = nivel.import_model(tmp_path / "model.sdf").mechanics()
    assert len(mechanics.names) == 1
    about_end = 0.2 + 2 * 0.25
    np.testing.assert_allclose(mechanics.mass_matrix(), [[2 * about_end + 2.0]], rtol=1e-12)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('type="ball"', 'type="rope"', 'type="rope" cannot be translated; there are revolute'),
        ("<child>rocker</child>\n", "<child>rack</child>\n", "<child>: there is no link `rack`"),
        ('relative_to="hinge"', 'relative_to="rocker"', "the poses lead back to `rocker`"),
        ('relative_to="hinge"', 'relative_to="hing"', "there is no frame `hing`"),
        ("<mass>2</mass>", "<mass>2 kg</mass>", "one number such as `1` expected, got `2 kg`"),
        ('<joint name="b"', '<joint name="rocker"', "the name `rocker` stands twice"),
    ],
)
def test_faults_of_sdf_are_said_with_their_lines(tmp_path, old, new, message):
    with pytest.raises(nivel.ModelError) as caught:
        read_model(written(tmp_path, FOUR_BAR.replace(old, new, 1)))
    assert message in str(caught.value)
    assert all(fault.line for fault in caught.value.faults)


def test_sdf_before_1_7_names_joints_as_links_and_gives_links_their_inertia(tmp_path):
    """A joint stands at its child; a link without <inertial> has the default of the SDF specification, 1 kg and 1 kg m²."""
    old = FOUR_BAR.replace('version="1.9"', 'version="1.6"').replace('<joint name="b"', '<joint name="coupler"')
    data = read_model(written(tmp_path, old.replace(BAR, "", 1))).data
    assert data["joints"]["coupler"]["point"] == data["bodies"]["coupler"]["position"] == [1, 0, 1]
    assert (data["bodies"]["crank"]["mass"], data["bodies"]["crank"]["inertia"]) == (1, [1, 1, 1])


def test_what_is_left_out_and_acts_is_in_the_light_of_every_run(tmp_path):
    """Collision geometry acts where bodies touch; a look does not."""
    outside = '<collision name="c"><geometry><heightmap/></geometry></collision><sensor name="s"/>'
    text = FOUR_BAR.replace('<link name="crank">', f'<link name="crank">{outside}')
    losses = read_model(written(tmp_path, text)).data["left_out"]
    assert losses == ["collision geometry <heightmap>: crank (line 2)"]
    assert "left_out" not in read_model(written(tmp_path, FOUR_BAR)).data
    trust = nivel.import_model(written(tmp_path, text)).simulate(duration=0.01, verify=False).trust
    assert [(item.name, item.verdict) for item in trust.items if item.row == losses[0]] == [("losses", "amber")]


def test_the_machine_file_has_the_list_in_its_comments_and_is_that_of_the_example(tmp_path):
    out = tmp_path / "arm.yaml"
    done = CliRunner().invoke(main, ["import", str(ARM), "--out", str(out)])
    assert done.exit_code == 0, done.output
    text = out.read_text(encoding="utf-8")
    for line in done.stdout.splitlines():
        assert line.split(":")[0].split("(line")[0][:80] in text.replace("\n#     ", " ")
    assert "limits of effort: give them as `limit` of a motor or servo: shoulder 60 N m (line 44)" in done.stdout
    example = (ARM.with_suffix(".yaml")).read_text(encoding="utf-8")
    ours, theirs = parse_machine(text, "arm.yaml"), parse_machine(example, "arm.yaml")
    for section in ("bodies", "markers", "joints", "couplings", "gravity"):
        assert getattr(ours, section) == getattr(theirs, section)
    again = CliRunner().invoke(main, ["import", str(ARM), "--out", str(out)])
    assert again.exit_code == 2
    assert "exists already; use --force" in again.stderr.replace("\n", " ")


def test_meshes_that_are_made_stand_beside_the_machine_file(tmp_path):
    look = '<visual><origin rpy="0.3 0 0"/><geometry><box size="1 2 3"/></geometry></visual>'
    model = written(
        tmp_path, robot(link("base"), link("a", 1.0, more=look), joint("j", "continuous", "base", "a")), "m.urdf"
    )
    out = tmp_path / "m.yaml"
    assert CliRunner().invoke(main, ["import", str(model), "--out", str(out), "--quiet"]).exit_code == 0
    assert (tmp_path / "m-meshes" / "a.stl").stat().st_size == 84 + 12 * 50
    assert nivel.load(out).bodies["a"].looks[0].file == "m-meshes/a.stl"


MACRO = (
    """<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">\n<link name="a"/>\n<link name="${side}_b"/></robot>"""
)
ADAMS = "! adams_view_name='arm'\nPART/1, MASS=2\nJOINT/1, REVOLUTE\n"
MODELICA = "model Pendulum\n  Modelica.Mechanics.MultiBody.World world;\nend Pendulum;\n"


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        (
            "r.urdf",
            MACRO,
            r"r\.urdf:3:1\s+<link name=\"\$\{side\}_b\">\s+this is xacro.* write `xacro r\.urdf > robot\.urdf`",
        ),
        (
            "arm.adm",
            ADAMS,
            r"dataset of Adams.* `nivel import parts\.step --out machine\.yaml`, and write each JOINT as `hinge: ",
        ),
        (
            "Pendulum.mo",
            MODELICA,
            r"this is Modelica.* write each Modelica\.Mechanics\.MultiBody\.Parts\.Body as `arm: \{mass: 2",
        ),
        ("a.urdf", "<robot><link></robot>", r"a\.urdf:1:16\s+this is no XML: mismatched tag"),
        ("a.txt", "hello", "this is no model that is read; there are URDF, SDF"),
        ("a.xml", "<html/>", r"<html> is no model that is read"),
    ],
)
def test_files_of_other_kinds_are_recognised_with_what_to_write(tmp_path, name, text, message):
    done = CliRunner().invoke(main, ["import", str(written(tmp_path, text, name)), "--out", str(tmp_path / "m.yaml")])
    assert done.exit_code == 2
    import re

    assert re.search(message, done.stderr), done.stderr
    assert not (tmp_path / "m.yaml").exists()


BILLION = '<!DOCTYPE a [<!ENTITY x "ha"><!ENTITY y "&x;&x;&x;&x;">]>\n<robot name="&y;"/>'
OUTSIDE = '<!DOCTYPE a [<!ENTITY x SYSTEM "file:///etc/passwd">]>\n<robot name="&x;"/>'


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (BILLION, "a document type .* is not read"),
        (OUTSIDE, "a document type .* is not read"),
        ("<robot>" + 300 * "<link>" + 300 * "</link>" + "</robot>", "more than 200 elements stand inside each other"),
        ("<robot>" + 10_001 * '<link name="a{}"/>' + "</robot>", "10001 links; up to 10000 are translated"),
        ('<?xml version="1.0" encoding="klingon"?><robot/>', "this is no XML"),
        ("<robot>\x00</robot>", "this is no XML"),
    ],
)
def test_hostile_documents_are_refused(tmp_path, text, message):
    count = iter(range(10_001))
    text = (
        "".join(part + (str(next(count)) if k < 10_001 else "") for k, part in enumerate(text.split("{}")))
        if "{}" in text
        else text
    )
    with pytest.raises(nivel.ModelError, match=message):
        read_model(written(tmp_path, text, "a.urdf"))


def test_a_document_of_too_many_elements_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr("nivel.files.xml_source.MOST_ELEMENTS", 50)
    with pytest.raises(nivel.ModelError, match=r"a\.urdf:1:\d+: the file has more than 50 elements"):
        read_model(written(tmp_path, "<robot>" + 60 * "<a/>" + "</robot>", "a.urdf"))


@pytest.mark.parametrize("name", ["arm.yaml", "leg.yaml"])
def test_imported_examples_run(name):
    result = nivel.load(ARM.with_name(name)).simulate(duration=0.1, verify=False)
    assert result.outcome == "done"
    assert abs(result.array("energy_error")).max() < 1e-6


def test_an_ellipsoid_along_the_axes_is_a_shape_and_one_askew_a_surface(tmp_path):
    """Half a turn about (1, 1, 0) exchanges two of its semi-axes."""
    drawing, notes = Drawing(tmp_path / "model.xml", (), tmp_path), Notes()
    for turned, kind in (
        (np.array([[0, 1, 0], [1, 0, 0], [0, 0, -1]]), "ellipsoid"),
        (np.array([[0.8, -0.6, 0], [0.6, 0.8, 0], [0, 0, 1]]), "mesh"),
    ):
        look = Look("ellipsoid", place=Frame(turned.astype(float), np.array([0.1, 0, 0])), sizes=(0.3, 0.2, 0.1))
        (shape,) = drawing.shapes(Link("foot", Frame(), looks=[look]), Frame(), notes)
        assert shape.get("type", "mesh") == kind
        if kind == "ellipsoid":
            assert shape["semi_axes"] == [0.2, 0.3, 0.1]
            assert list(shape["centre"]) == [0.1, 0, 0]
