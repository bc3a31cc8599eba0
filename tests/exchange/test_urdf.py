"""URDF: equations of motion against closed forms, and everything that a joint and a link may have."""

from math import cos, pi, sin

import numpy as np
import pytest

import nivel
from exchange_models import joint, link, robot
from nivel.exchange import as_machine, read_model
from nivel.machine.bodies.surface import surface_arrays

G = 9.81


def written(folder, text, name="robot.urdf"):
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def data(folder, text, **options):
    return read_model(written(folder, text), **options).data


# two links in the x-z plane that turn about y, angles relative, from the x axis downwards; the tip is lumped with the second link
L1, C1, C2, TIP = 0.8, 0.3, 0.25, 0.9
M1, M2, MT, I1, I2, IT = 2.0, 1.5, 0.4, 0.05, 0.03, 0.001
ARM = robot(
    link("base"),
    link("one", M1, f"{C1} 0 0", (I1, I1, I1)),
    # its inertial frame is turned: the moment about the joint's axis is the third one
    link("two", M2, f"{C2} 0 0", (0.04, 0.035, I2), rpy=f"{-pi / 2} 0 0"),
    link("tip", MT, "0 0 0", (IT, IT, IT)),
    joint("shoulder", "continuous", "base", "one", rpy="0 0 0"),
    joint("elbow", "continuous", "one", "two", f"{L1} 0 0"),
    joint("flange", "fixed", "two", "tip", f"{TIP} 0 0", rpy="0.3 0.2 0.1"),
)


def two_link_arm(q, v, a):
    """Mass matrix and efforts of a planar arm (Craig 2005, 6.8): the second link has the tip in its centre of mass."""
    m = M2 + MT
    c = (M2 * C2 + MT * TIP) / m
    J = I2 + IT + M2 * (C2 - c) ** 2 + MT * (TIP - c) ** 2
    h = m * L1 * c
    M = np.array(
        [
            [I1 + M1 * C1**2 + J + m * (L1**2 + c**2) + 2 * h * cos(q[1]), J + m * c**2 + h * cos(q[1])],
            [J + m * c**2 + h * cos(q[1]), J + m * c**2],
        ]
    )
    centrifugal = h * sin(q[1]) * np.array([-v[1] * (2 * v[0] + v[1]), v[0] ** 2])
    both = -m * G * c * cos(q[0] + q[1])  # about y an angle from x goes downwards
    return M, M @ a + centrifugal + np.array([-(M1 * C1 + m * L1) * G * cos(q[0]) + both, both])


def test_two_link_arm_has_the_mass_matrix_and_the_inverse_dynamics_of_its_closed_form(tmp_path):
    mechanics = nivel.import_model(written(tmp_path, ARM)).mechanics()
    assert mechanics.names == ("shoulder.angle", "elbow.angle")
    for q, v, a in np.random.default_rng(3).uniform(-2.0, 2.0, (4, 3, 2)):
        M, tau = two_link_arm(q, v, a)
        np.testing.assert_allclose(mechanics.mass_matrix(q), M, rtol=1e-12)
        np.testing.assert_allclose(mechanics.inverse_dynamics(q, v, a), tau, rtol=0, atol=1e-12 * np.abs(tau).max())


def test_cart_pole_has_the_mass_matrix_and_the_bias_of_its_closed_form(tmp_path):
    m, M, c, J = 0.3, 1.2, 0.5, 0.02
    cart_pole = robot(
        link("rail"),
        link("cart", M),
        link("pole", m, f"0 0 {c}", (J, J, J)),
        joint(
            "slide",
            "prismatic",
            "rail",
            "cart",
            axis="2 0 0",
            more='<limit effort="0" velocity="0" lower="-9" upper="9"/>',
        ),
        joint("pivot", "continuous", "cart", "pole", "0 0 0.1"),
    )
    machine = nivel.import_model(written(tmp_path, cart_pole))
    mechanics = machine.replace(forces=()).mechanics()
    for (_, q), (_, v) in np.random.default_rng(4).uniform(-2.0, 2.0, (4, 2, 2)):
        expected = [[M + m, m * c * cos(q)], [m * c * cos(q), J + m * c**2]]
        np.testing.assert_allclose(mechanics.mass_matrix([0.3, q]), expected, rtol=1e-12)
        bias = [-m * c * sin(q) * v**2, -m * G * c * sin(q)]
        np.testing.assert_allclose(mechanics.bias([0.3, q], [0.7, v]), bias, rtol=1e-12)


def test_joints_bring_stops_dampers_friction_and_couplings(tmp_path):
    limits = '<limit lower="-1" upper="0.5" effort="3" velocity="1"/><dynamics damping="0.2" friction="0.4"/>'
    text = robot(
        link("base"),
        link("a", 2.0, "0.5 0 0", (0.1, 0.1, 0.1)),
        link("b", 1.0),
        joint("first", "revolute", "base", "a", more=limits),
        joint("second", "revolute", "a", "b", "1 0 0", more='<mimic joint="first" multiplier="-2" offset="0.3"/>'),
    )
    translation = read_model(written(tmp_path, text))
    machine = nivel.import_model(tmp_path / "robot.urdf")
    stop, friction = machine.forces["first_stop"], machine.forces["first_friction"]
    about = 0.1 + 2.0 * 0.25 + 0.2 + 1.0  # of both links about the first axis
    assert (stop.lower, stop.upper) == (-1.0, 0.5)
    assert stop.stiffness == pytest.approx(about * (2 * pi * 10) ** 2, rel=5e-3)
    assert machine.forces["first_damper"].damping == 0.2
    assert (friction.normal_load * friction.coefficient * friction.radius, friction.model) == (0.4, "stiction")
    coupling = machine.couplings["second_mimic"]
    assert (coupling.coordinates, coupling.factors) == (("second.angle", "first.angle"), (1.0, 2.0))
    said = "\n".join(translation.summary())
    assert "limits of effort: give them as `limit` of a motor or servo: first 3 N m (line 5)" in said
    assert "limits of speed: first" in said


def test_a_joint_follows_with_its_offset(tmp_path):
    text = robot(
        link("base"),
        link("a", 1.0),
        link("b", 1.0),
        joint("first", "continuous", "base", "a"),
        joint("second", "continuous", "a", "b", "1 0 0", more='<mimic joint="first" multiplier="-2" offset="0.3"/>'),
    )
    mechanics = nivel.import_model(written(tmp_path, text)).mechanics()
    assert mechanics.position_names == ("first.angle", "second.angle")
    first, second = closed = mechanics.close([0.2, 0.1])
    assert second == pytest.approx(-2 * first + 0.3, abs=1e-12)
    place, axes = mechanics.pose("b", closed)
    np.testing.assert_allclose(place, [cos(first), 0.0, -sin(first)], atol=1e-12)
    np.testing.assert_allclose(axes[:, 0], [cos(first + second), 0.0, -sin(first + second)], atol=1e-12)


def test_a_start_outside_the_limits_is_moved_within_them_and_other_joints_stay(tmp_path):
    text = robot(
        link("base"),
        link("a", 1.0),
        link("b", 1.0),
        joint("first", "continuous", "base", "a"),
        joint("second", "revolute", "a", "b", "1 0 0", more='<limit lower="-3" upper="-1" effort="0" velocity="0"/>'),
    )
    joints = data(tmp_path, text)["joints"]
    assert [joints[name]["start"] for name in ("first", "second")] == [{"angle": 0.0}, {"angle": -2.0}]


def test_axes_that_are_nearly_parallel_stay_as_they_are(tmp_path):
    text = robot(
        link("base"),
        link("a", 1.0),
        link("b", 1.0),
        joint("first", "continuous", "base", "a"),
        joint("second", "continuous", "a", "b", "1 0 0", rpy="1e-8 0 0"),
    )
    assert data(tmp_path, text)["assembly"] == {"parallel": 0.0}
    assert "assembly" not in data(tmp_path, text.replace("1e-8 0 0", "0 0 0"))


def test_base_is_fixed_or_free(tmp_path):
    text = robot(link("trunk", 5.0), link("leg", 1.0), joint("hip", "continuous", "trunk", "leg"))
    fixed, free = data(tmp_path, text)["joints"]["hip"], data(tmp_path, text, base="free")
    assert fixed["bodies"] == ["ground", "leg"]
    assert free["joints"]["hip"]["bodies"] == ["trunk", "leg"]
    assert set(free["bodies"]) == {"trunk", "leg"}


def test_names_that_nivel_does_not_take_are_changed_and_kept_in_the_description(tmp_path):
    text = robot(
        link("base"),
        link("a.1", 1.0),
        link("a 1", 1.0),
        link("ground", 1.0),
        joint("1st", "continuous", "base", "a.1"),
        joint("x", "continuous", "a.1", "a 1"),
        joint("y", "continuous", "a 1", "ground"),
    )
    out = data(tmp_path, text)
    assert list(out["bodies"]) == ["a_1", "a_1_2", "ground_2"]
    assert list(out["joints"]) == ["joint_1st", "x", "y"]
    assert "a_1 was a.1" in out["description"]
    assert "ground_2 was ground" in out["description"]


def test_an_inertia_that_is_impossible_by_round_off_is_raised_and_said(tmp_path):
    text = robot(link("base"), link("rod", 1.0, inertia=(0, 0.1, 0.1)), joint("j", "continuous", "base", "rod"))
    translation = read_model(written(tmp_path, text))
    assert 0.0 < translation.data["bodies"]["rod"]["inertia"][0] <= 1e-11
    assert "raised to 1e-11 of the largest one: rod (line 3)" in "\n".join(translation.summary())
    with pytest.raises(
        nivel.ModelError, match=r"robot\.urdf:3:1: <link name=\"rod\">: inertia of the link: .* exceeds the sum"
    ):
        data(tmp_path, text.replace('ixx="0"', 'ixx="1"'))


def test_moving_links_without_mass_are_light_bodies_or_refused_by_name(tmp_path):
    cross = (joint("a", "continuous", "base", "cross"), joint("b", "continuous", "cross", "arm", axis="1 0 0"))
    text = robot(link("base"), link("cross"), link("arm", 2.0, "0 0 -1", (0.1, 0.2, 0.3)), *cross)
    mechanics = nivel.import_model(written(tmp_path, text)).mechanics()
    # about y and x at angle zero: moments of the arm about its joint
    np.testing.assert_allclose(mechanics.mass_matrix([0.0, 0.0]), np.diag([2.2, 2.1]), rtol=1e-12, atol=1e-12)
    with pytest.raises(nivel.ModelError, match=r"<link name=\"cross\">: the link moves and has no mass"):
        data(tmp_path, robot(link("base"), link("cross"), cross[0]))


def test_everything_that_is_wrong_is_said_at_once_with_its_line(tmp_path):
    text = robot(
        link("base"),
        link("a", "heavy"),
        joint("first", "hinge", "base", "a"),
        joint("second", "continuous", "base", "b", at="0 0"),
    )
    with pytest.raises(nivel.ModelError) as caught:
        data(tmp_path, text)
    assert [fault.line for fault in caught.value.faults] == [3]  # numbers of links first
    with pytest.raises(nivel.ModelError) as caught:
        data(tmp_path, text.replace("heavy", "1"))
    lines = {fault.line: fault.message for fault in caught.value.faults}
    assert "there is no link `b`" in lines[5]


@pytest.mark.parametrize(
    ("elements", "message"),
    [
        ((joint("j", "continuous", "a", "b"), joint("k", "continuous", "b", "a")), "lead back to"),
        ((joint("j", "continuous", "a", "b"), joint("k", "fixed", "a", "b")), "is the child of two joints"),
        ((joint("j", "continuous", "a", "b", axis="0 0 0"),), "the axis has no direction"),
        ((joint("j", "continuous", "a", "b", axis="0 0 nan"),), "is not finite"),
        ((joint("j", "spline", "a", "b"),), 'type="spline" is not known; there are revolute'),
        ((), "every link is fixed to the ground"),
    ],
)
def test_what_is_no_tree_is_refused(tmp_path, elements, message):
    with pytest.raises(nivel.ModelError, match=message):
        data(tmp_path, robot(link("a", 1.0), link("b", 1.0), *elements))


def visual(geometry, origin=""):
    return f"<visual>{origin}<geometry>{geometry}</geometry></visual>"


def test_solids_that_lie_askew_and_scaled_meshes_are_written_as_surfaces(tmp_path):
    (tmp_path / "tri.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", encoding="utf-8")
    askew = '<origin xyz="0 0 1" rpy="0.4 0 0"/>'
    looks = visual('<box size="1 2 3"/>', askew) + visual('<mesh filename="tri.obj" scale="2 -1 1"/>')
    looks += visual('<cylinder radius="0.1" length="2"/>', f'<origin xyz="0 0 0" rpy="0 {pi / 2} 0"/>')
    looks += visual('<mesh filename="package://anything/tri.obj" scale="0.001 0.001 0.001"/>')
    path = written(tmp_path, robot(link("base"), link("a", 1.0, more=looks), joint("j", "continuous", "base", "a")))
    translation = read_model(path)
    box, mirrored, cylinder, scaled = translation.data["bodies"]["a"]["looks"]
    vertices, _ = translation.meshes[box["file"]]
    corner = np.array([0.5, cos(0.4) - 1.5 * sin(0.4), 1 + sin(0.4) + 1.5 * cos(0.4)])
    assert np.abs(vertices - corner).max(axis=1).min() < 1e-12
    points, triangles = translation.meshes[mirrored["file"]]
    assert points[triangles[0]].tolist() == [[0, -1, 0], [2, 0, 0], [0, 0, 0]]
    assert cylinder == {"type": "cylinder", "radius": 0.1, "length": 2.0, "along": "x"}
    assert (scaled["file"], scaled["unit"]) == ("tri.obj", 0.001)
    shape = nivel.import_model(path).bodies["a"].looks[1]
    np.testing.assert_array_equal(surface_arrays(shape.surface)[0], points)


def test_a_collada_mesh_is_read_with_its_unit_and_its_nodes(tmp_path):
    (tmp_path / "part.dae").write_text(
        """<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema"><asset><unit meter="0.01"/></asset>
        <library_geometries><geometry id="g"><mesh>
        <source id="p"><float_array id="f" count="12">0 0 0 1 0 0 1 1 0 0 1 0</float_array>
        <technique_common><accessor source="#f" count="4" stride="3"/></technique_common></source>
        <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
        <polylist count="1"><input semantic="VERTEX" source="#v" offset="0"/><input semantic="NORMAL" source="#p" offset="1"/>
        <vcount>4</vcount><p>0 0 1 0 2 0 3 0</p></polylist></mesh></geometry></library_geometries>
        <library_visual_scenes><visual_scene id="s"><node><translate>10 0 0</translate><rotate>0 0 1 90</rotate>
        <instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
        <scene><instance_visual_scene url="#s"/></scene></COLLADA>""",
        encoding="utf-8",
    )
    look = visual('<mesh filename="part.dae"/>')
    path = written(tmp_path, robot(link("base"), link("a", 1.0, more=look), joint("j", "continuous", "base", "a")))
    vertices, triangles = surface_arrays(nivel.import_model(path).bodies["a"].looks[0].surface)
    np.testing.assert_allclose(vertices, [[0.1, 0, 0], [0.1, 0.01, 0], [0.09, 0.01, 0], [0.09, 0, 0]], atol=1e-15)
    assert triangles.tolist() == [[0, 1, 2], [0, 2, 3]]


def test_missing_meshes_and_meshes_outside_of_the_folders_are_notes(tmp_path):
    outside = tmp_path / "tri.obj"
    outside.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", encoding="utf-8")
    folder = tmp_path / "robot" / "urdf"
    folder.mkdir(parents=True)
    names = ("../../tri.obj", "gone.stl", f"file://{outside}", "http://example.org/tri.obj", "/etc/passwd")
    looks = "".join(visual(f'<mesh filename="{name}"/>') for name in names)
    path = written(folder, robot(link("base"), link("a", 1.0, more=looks), joint("j", "continuous", "base", "a")))
    said = "\n".join(read_model(path).summary())
    assert "`../../tri.obj` leaves the folder of the model and is not read; `--package-path" in said
    assert "there is no file `gone.stl`" in said
    assert f"`file://{outside}` leaves the folder" in said
    assert "`http://example.org/tri.obj` is an address that is not read" in said
    assert "`/etc/passwd` is no mesh" in said
    allowed = read_model(path, package_paths=[tmp_path])
    assert [each["file"] for each in allowed.data["bodies"]["a"]["looks"]] == ["../../tri.obj"] * 2


def test_what_is_wrong_with_a_translation_is_said_at_its_source(tmp_path):
    path = written(tmp_path, robot(link("base"), link("one", 1.0), joint("left-hip", "continuous", "base", "one")))
    translation = read_model(path)
    assert list(translation.data["joints"]) == ["left_hip"]
    translation.data["joints"]["left_hip"]["stops"] = {"upper": 1.0, "stiffness": -2.0, "restitution": 0.5}
    line = next(k for k, text in enumerate(path.read_text().splitlines(), 1) if 'joint name="left-hip"' in text)
    message = rf'robot\.urdf:{line}:1: <joint name="left-hip">: .*forces\.left_hip_stop\.stiffness'
    with pytest.raises(nivel.ModelError, match=message):
        as_machine(translation.text(), str(tmp_path / "robot.yaml"), translation, str(path))
    with pytest.raises(nivel.ModelError, match="`include_paths` belong to MJCF files"):
        nivel.import_model(path, include_paths=[tmp_path])


# two cranks that hang from the base and a coupler, which as the file places them do not meet: the second crank is turned by OFF
CRANK, SPAN, OFF = 0.4, 0.7, 0.3
MC, JC, MK, MB, JB = 1.1, 0.02, 2.3, 0.2, 0.01


def four_bar(kind):
    """Of frames by the names of onshape-to-robot, at points, or on a link between, as those of parallel robots are."""
    first, second = ("closing_pin_1", "closing_pin_2") if kind == "3d" else ("closedloop_pin_A", "closedloop_pin_B")
    between = [
        link("bush", MB, inertia=(JB, JB, JB)),
        joint("turn", "continuous", "coupler", "bush", f"{SPAN} 0 0"),
    ]
    return robot(
        link("base"),
        link("left", MC, f"0 0 {-CRANK / 2}", (JC, JC, JC)),
        link("coupler", MK, f"{0.4 * SPAN} 0 0", (0.1, 0.1, 0.1)),
        link("right", MC, f"0 0 {-CRANK / 2}", (JC, JC, JC)),
        link(first),
        link(second),
        *(between if kind == "6d" else ()),
        joint("a", "continuous", "base", "left"),
        joint("b", "continuous", "left", "coupler", f"0 0 {-CRANK}"),
        joint("c", "continuous", "base", "right", f"{SPAN} 0 0", rpy=f"0 {OFF} 0"),
        joint(f"{first}_frame", "fixed", *(("bush", first) if kind == "6d" else ("coupler", first, f"{SPAN} 0 0"))),
        joint(f"{second}_frame", "fixed", "right", second, f"0 0 {-CRANK}"),
    )


@pytest.mark.parametrize("kind", ["3d", "6d"])
def test_frames_of_a_loop_close_it(kind, tmp_path):
    """The coupler of a parallelogram goes along a circle: (2 J + m L²) φ'' = -(2 m_c L/2 + m L) g sin φ, J about the pins of the base;
    what is between goes with it and turns with the second crank."""
    mechanics = nivel.import_model(written(tmp_path, four_bar(kind))).mechanics()
    (name,) = mechanics.names
    away = {"a.angle": 0.0, "b.angle": 0.0, "c.angle": OFF, "turn.angle": OFF}[name]
    phi = float(mechanics.start[mechanics.position_names.index(name)])
    phi = away - phi if name in ("b.angle", "turn.angle") else away + phi
    assert 0.01 < abs(phi) < OFF
    mb, jb = (MB, JB) if kind == "6d" else (0.0, 0.0)
    about = 2 * (JC + MC * CRANK**2 / 4) + (MK + mb) * CRANK**2 + jb
    expected = -(MC + MK + mb) * CRANK * G * sin(phi) / about
    found = mechanics.forward_dynamics(mechanics.start, [0.0], [0.0])[0]
    assert abs(found) == pytest.approx(abs(expected), rel=1e-10)


def test_a_file_beside_the_model_says_which_frames_close_a_loop_and_how(tmp_path):
    text = four_bar("6d").replace("closedloop_pin_A", "one").replace("closedloop_pin_B", "two")
    beside = tmp_path / "robot.yaml"
    beside.write_text(
        "closed_loop: [[one, two]]\ntype: [3d]\njoint_name: [turn]\njoint_type: [UJOINT_YZ]\n", encoding="utf-8"
    )
    found = data(tmp_path, text)
    assert [each["type"] for each in found["joints"].values()].count("spherical") == 1
    assert found["joints"]["turn"]["type"] == "universal"
    beside.write_text("closed_loop: [[one, three]]\ntype: [6d]\n", encoding="utf-8")
    with pytest.raises(nivel.ModelError, match=r"robot.yaml:1.*three"):
        data(tmp_path, text)
    for wrong in ("closed_loop: [[one, two]]\ntype: []\n", "closed_loop: [one]\ntype: [6d]\n"):
        beside.write_text(wrong, encoding="utf-8")
        with pytest.raises(nivel.ModelError, match=r"robot.yaml:1.*expected"):
            data(tmp_path, text)
    beside.unlink()
    alone = data(tmp_path, four_bar("3d").replace("closing_pin_2", "two"))
    assert any("closing_pin_1" in each for each in alone["left_out"])


def test_a_link_next_to_no_mass_in_a_closed_loop_has_no_part_in_its_mechanics(tmp_path, monkeypatch):
    plain = nivel.import_model(written(tmp_path, four_bar("3d"))).mechanics()
    for name in ("MB", "JB"):
        monkeypatch.setitem(globals(), name, 1e-9)
    light = nivel.import_model(written(tmp_path, four_bar("6d"))).mechanics()
    v, tau = np.array([0.3]), np.array([0.2])
    assert light.mass_matrix(plain.start) == pytest.approx(plain.mass_matrix(plain.start), rel=1e-7)
    expected = plain.forward_dynamics(plain.start, v, tau)
    assert light.forward_dynamics(plain.start, v, tau) == pytest.approx(expected, rel=1e-7)
