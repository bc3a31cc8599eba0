"""Assemblies of FreeCAD: parts with the masses of their solids, links to parts, and joints at their connectors."""

import zipfile
from math import cos, sin

import numpy as np
import pytest

import nivel
from needing import needs
from nivel.exchange import read_model

gmsh = needs("gmsh")
L, W, H, TURN, RHO, G = 0.4, 0.02, 0.03, 0.4, 7850.0, 9.81
AT = np.array([0.1, 0.05, 0.3])  # of the arm


def placement(name, at, quaternion=(0, 0, 0, 1)):
    """A placement in millimetres, its quaternion with the scalar last."""
    places = " ".join(f'P{a}="{float(1e3 * x)!r}"' for a, x in zip("xyz", at, strict=True))
    turns = " ".join(f'Q{k}="{float(x)!r}"' for k, x in enumerate(quaternion))
    return f'<Property name="{name}" type="App::PropertyPlacement"><PropertyPlacement {places} {turns}/></Property>'


def reference(name, sub):
    return (
        f'<Property name="{name}" type="App::PropertyXLinkSubHidden"><XLink file="" name="Assembly" count="2">'
        f'<Sub value="{sub}"/><Sub value="{sub}"/></XLink></Property>'
    )


def written(folder, kind="Revolute", away=0.0):
    """A base on the ground and a link to an arm, a box whose hinge is at the middle of its end; the connector of the base is `away`."""
    for name, box, shift in (
        ("Base", (0, 0, 0, 100, 100, 50), 0.0),
        ("Arm", (0, 0, 0, 1e3 * L, 1e3 * W, 1e3 * H), 700.0),
    ):
        gmsh.initialize(interruptible=False)
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.model.add(name)
        tag = gmsh.model.occ.addBox(*box)
        gmsh.model.occ.translate([(3, tag)], shift, 0, 0)  # a shape is stored as its object is placed
        gmsh.model.occ.synchronize()
        gmsh.write(str(folder / f"{name}.brep"))
        gmsh.finalize()
    hinge = AT + np.array([-sin(TURN) * W / 2, cos(TURN) * W / 2, H / 2 + away])
    sideways = np.array([-np.sqrt(0.5), 0.0, 0.0, np.sqrt(0.5)])  # z along y
    c, s, root = cos(TURN / 2), sin(TURN / 2), np.sqrt(0.5)
    both = (-c * root, -s * root, s * root, c * root)  # the turn of the arm, then that of its connector
    shape = '<Property name="Shape" type="Part::PropertyPartShape"><Part file="{0}.Shape.brp"/></Property>'
    group = "".join(f'<Link value="{name}"/>' for name in ("Joints", "Base", "Arm001"))
    words = "".join(f'<Enum value="{word}"/>' for word in ("Fixed", "Revolute", "Gears"))
    number = ("Fixed", "Revolute", "Gears").index(kind)
    data = {
        "Base": ("Part::Feature", placement("Placement", (0, 0, 0)) + shape.format("Base")),
        "Arm": ("Part::Feature", placement("Placement", (0.7, 0, 0)) + shape.format("Arm")),
        "Arm001": (
            "App::Link",
            placement("Placement", AT, (0, 0, s, c))
            + '<Property name="LinkedObject" type="App::PropertyXLink"><XLink file="" name="Arm"/></Property>',
        ),
        "Assembly": (
            "Assembly::AssemblyObject",
            f'<Property name="Group" type="App::PropertyLinkList"><LinkList>{group}</LinkList></Property>',
        ),
        "Ground": (
            "App::FeaturePython",
            '<Property name="ObjectToGround" type="App::PropertyLink"><Link value="Base"/></Property>',
        ),
        "Hinge": (
            "App::FeaturePython",
            f'<Property name="JointType" type="App::PropertyEnumeration"><Integer value="{number}"/>'
            f"<CustomEnumList>{words}</CustomEnumList></Property>"
            + reference("Reference1", "Base.Edge1")
            + reference("Reference2", "Arm001.Face2")
            + placement("Placement1", hinge, both)
            + placement("Placement2", (0, W / 2, H / 2), sideways.tolist()),
        ),
        "Joints": ("Assembly::JointGroup", ""),
    }
    objects = "".join(f'<Object type="{kind}" name="{name}"/>' for name, (kind, _) in data.items())
    given = "".join(
        f'<Object name="{name}"><Properties>{text}</Properties></Object>' for name, (_, text) in data.items()
    )
    path = folder / "arm.FCStd"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr(
            "Document.xml", f"<Document><Objects>{objects}</Objects><ObjectData>{given}</ObjectData></Document>"
        )
        for name in ("Base", "Arm"):
            archive.write(folder / f"{name}.brep", f"{name}.Shape.brp")
    return path


@pytest.mark.parametrize("away", [0.0, 0.01])
def test_a_hinged_box_has_the_mass_matrix_and_the_weight_of_its_closed_form(away, tmp_path):
    """m ((L² + H²)/12 + L²/4) about the hinge and m g L/2 where it is level; a joint that is open comes together."""
    machine = nivel.import_model(written(tmp_path, away=away))
    mechanics = machine.mechanics()
    mass = RHO * L * W * H
    assert [body.mass for body in machine.record.bodies] == pytest.approx([mass], rel=1e-12)
    assert mechanics.names == ("Hinge.angle",)
    M = mass * ((L * L + H * H) / 12 + L * L / 4)
    np.testing.assert_allclose(mechanics.mass_matrix([0.0]), [[M]], rtol=1e-9)
    np.testing.assert_allclose(np.abs(mechanics.bias([0.0], [0.0])), [mass * G * L / 2], rtol=1e-9)
    np.testing.assert_allclose(np.abs(mechanics.bias([0.3], [0.0])), [mass * G * L / 2 * cos(0.3)], rtol=1e-9)


def test_joints_of_other_types_are_left_out_by_name_and_other_files_refused(tmp_path):
    found = read_model(written(tmp_path, "Gears"), density=1000.0).data
    assert found["left_out"] == ["joints of type Gears: Hinge (line 1)"]
    assert found["bodies"]["Arm001"]["mass"] == pytest.approx(1000.0 * L * W * H, rel=1e-12)
    with pytest.raises(nivel.ModelError, match="nothing in this model moves"):
        read_model(written(tmp_path, "Fixed"))
    (tmp_path / "no.FCStd").write_text("no archive", encoding="utf-8")
    with pytest.raises(nivel.ModelError, match="no file of FreeCAD"):
        read_model(tmp_path / "no.FCStd")
