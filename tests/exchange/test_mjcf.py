"""MJCF: mass matrix, bias and inverse dynamics against MuJoCo itself, loops against the exact equations, and everything beside them."""

from pathlib import Path

import numpy as np
import pytest

import nivel
from needing import needs
from nivel.exchange import read_model

mj = needs("mujoco")

SLIDE = '<joint name="slide" type="slide" axis="1 0 0.3" armature="0.5"/>'
TREE = f"""<mujoco model="tree">
<option gravity="0.5 0 -9.81" timestep="0.001"/>
<default><geom density="800"/></default>
<worldbody>
  <body name="cart" pos="0 0 1">{SLIDE}<geom type="box" size=".2 .1 .1"/>
    <body name="hip" pos=".1 0 0" euler="10 20 30">
      <joint name="yaw" axis="0 0 1" ref="25"/><joint name="roll" axis="1 0 0" pos="0 .01 0" armature="0.02"/>
      <joint name="pitch" axis="0 1 .2"/>
      <geom type="capsule" size=".05 .3" pos="0 0 -.3"/>
      <body name="foot" pos="0 0 -.6" euler="0 0 40"><geom type="ellipsoid" size=".1 .05 .02"/><site name="sole" pos="0 0 -.02"/>
        <body name="toe" pos=".1 0 0" gravcomp="0.4"><joint name="bend" axis="0 1 0"/><geom type="cylinder" size=".02 .05"/></body>
      </body>
    </body>
  </body>
</worldbody></mujoco>"""
TREE_JOINTS = ("slide", "yaw", "roll", "pitch", "bend")


def written(folder, text, name="model.xml"):
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def matrices(model, q, v, a):
    """Mass matrix, bias and efforts of MuJoCo; gravcomp is one of its passive forces."""
    data = mj.MjData(model)
    data.qpos[:], data.qvel[:] = q, v
    mj.mj_forward(model, data)
    M, bias = np.zeros((model.nv, model.nv)), data.qfrc_bias - data.qfrc_passive
    mj.mj_fullM(model, data, M)
    data.qacc[:] = a
    mj.mj_inverse(model, data)
    return M, bias, data.qfrc_inverse.copy()


def test_a_tree_with_armature_stacked_joints_and_a_lifted_body_has_the_equations_of_mujoco(tmp_path):
    path = written(tmp_path, TREE)
    model = mj.MjSpec.from_file(str(path)).compile()
    model.opt.disableflags |= int(mj.mjtDisableBit.mjDSBL_CONTACT)
    mechanics = nivel.import_model(path, contacts="none").mechanics()
    index = [TREE_JOINTS.index(name.split(".")[0].removesuffix("_rotor")) for name in mechanics.names]
    places = [TREE_JOINTS.index(name.split(".")[0].removesuffix("_rotor")) for name in mechanics.position_names]
    zero = np.array(
        [
            model.qpos0[k] * name.endswith("_rotor.angle")
            for k, name in zip(places, mechanics.position_names, strict=True)
        ]
    )
    assert sorted(index) == [0, 1, 2, 3, 4]
    for q, v, a in np.random.default_rng(1).uniform(-1.0, 1.0, (3, 3, 5)):
        M, bias, efforts = matrices(model, model.qpos0 + q, v, a)
        ours = (model.qpos0 + q)[places] - zero
        np.testing.assert_allclose(mechanics.mass_matrix(ours), M[np.ix_(index, index)], atol=1e-12 * np.abs(M).max())
        np.testing.assert_allclose(mechanics.bias(ours, v[index]), bias[index], atol=1e-12 * np.abs(bias).max())
        found = mechanics.inverse_dynamics(ours, v[index], a[index])
        np.testing.assert_allclose(found, efforts[index], atol=1e-12 * np.abs(efforts).max())


BAR = '<geom type="capsule" fromto="0 0 0 {0}" size=".02" density="1000"/>'
LOOP = f"""<mujoco><option gravity="0 -9.81 0"/><worldbody>
<body name="crank"><joint name="a" axis="0 0 1"/>{BAR.format(".3 .2 0")}
  <body name="coupler" pos=".3 .2 0"><joint name="b" axis="0 0 1"/>{BAR.format(".6 .1 0")}</body></body>
<body name="rocker" pos="1.1 0 0"><joint name="c" axis="0 0 1"/>{BAR.format("-.2 .3 0")}</body>
</worldbody><equality><connect name="pin" body1="coupler" body2="rocker" anchor=".6 .1 0"/></equality></mujoco>"""


def test_a_loop_is_exact_where_mujoco_is_soft(tmp_path):
    """Accelerations of the exact equations, M a + Jᵀ λ = -h and J a = 0 from rest, with the matrices of MuJoCo."""
    path = written(tmp_path, LOOP)
    model = mj.MjSpec.from_file(str(path)).compile()
    data = mj.MjData(model)
    model.opt.disableflags |= int(mj.mjtDisableBit.mjDSBL_EQUALITY) | int(mj.mjtDisableBit.mjDSBL_CONTACT)
    mj.mj_forward(model, data)
    M, jacobians = np.zeros((3, 3)), np.zeros((2, 3, 3))
    mj.mj_fullM(model, data, M)
    for k, body in enumerate(("coupler", "rocker")):
        mj.mj_jac(model, data, jacobians[k], None, np.array([0.9, 0.3, 0.0]), model.body(body).id)
    J = (jacobians[0] - jacobians[1])[:2]
    saddle = np.block([[M, J.T], [J, np.zeros((2, 2))]])
    exact = np.linalg.solve(saddle, np.concatenate([-data.qfrc_bias, np.zeros(2)]))[:3]
    mechanics = nivel.import_model(path, contacts="none").mechanics()
    assert len(mechanics.names) == 1
    found = mechanics.forward_dynamics(mechanics.start, [0.0], [0.0])
    assert found[0] == pytest.approx(exact[("a", "b", "c").index(mechanics.names[0].split(".")[0])], rel=1e-10)


def test_springs_limits_friction_actuators_and_sites(tmp_path):
    text = """<mujoco><worldbody><body name="a"><geom size=".1" rgba="1 0 0 1"/><site name="tip" pos="0 0 1"/>
    <joint name="j" axis="0 1 0" damping=".1" stiffness="2" springref="10" range="-90 90" frictionloss=".2" ref="20"/></body>
    </worldbody><actuator><position name="hold" joint="j" kp="10" kv="2" gear="3" ctrlrange="-1 1" forcerange="-5 5"/>
    <motor name="push" joint="j" gear="4"/><cylinder name="oil" joint="j" timeconst=".1"/></actuator></mujoco>"""
    machine = nivel.import_model(written(tmp_path, text))
    spring, stop = machine.forces["j_spring"], machine.forces["j_stop"]
    assert (spring.stiffness, spring.damping) == (2.0, 0.1)
    assert spring.free_value == pytest.approx(np.deg2rad(10))
    assert (stop.lower, stop.upper) == pytest.approx((-np.pi / 2, np.pi / 2))
    # of solref 0.02 1 and the impedance 0.95: k d²/((1 - d) w), k = 1/(0.95 · 0.02)², w = 1/J of a ball of 1000 kg/m³
    moment = 0.4 * 4 / 3 * np.pi * 1000 * 0.1**5
    assert stop.stiffness == pytest.approx(0.95**2 / (0.95 * 0.02) ** 2 / 0.05 * moment, rel=1e-2)
    assert machine.forces["j_friction"].normal_load == pytest.approx(0.2)
    assert machine.forces["hold"].limit == pytest.approx(15.0)
    # gear · (10 u - 10 · gear · q - 2 · gear · q̇), at q = 20 deg and u = 0
    assert machine.simulate(duration=1e-3, step=1e-3, verify=False).array("force.hold.magnitude")[0] == pytest.approx(
        -15.0
    )
    assert machine.inputs["hold"].range == (-1.0, 1.0)
    assert machine.forces["push"].effort.text == "4.0*push.value"
    assert machine.markers["tip"].position == (0.0, 0.0, 1.0)
    assert machine.bodies["a"].looks[0].colour == "#ff0000"
    (state,) = machine.record.states
    assert (state.name, state.rate.text) == ("oil_activation", "(oil.value - oil_activation.value)/0.1")
    assert machine.forces["oil"].effort.text == "oil_activation.value"


PULLED = """<mujoco><option gravity="0 0 -9.81"/><worldbody><body name="a"><freejoint/><geom size=".1" mass="3" contype="0"/>
<body name="b" pos=".2 0 0"><joint name="p" axis="0 1 0" ref="10"/><geom type="capsule" fromto="0 0 0 .3 0 0" size=".02" contype="0"/>
<body name="c" pos=".3 0 0"><joint name="q" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 .3 0 0" size=".02" contype="0"/>
<body name="d" pos=".3 0 0"><joint name="r" type="slide" axis="1 0 0"/><geom size=".03" contype="0"/></body></body></body></body>
</worldbody>
<tendon><fixed name="t" stiffness="30" damping="2" springlength="-0.1 0.2"><joint joint="p" coef="1"/><joint joint="q" coef="-.5"/></fixed>
<fixed name="u"><joint joint="q" coef="2"/><joint joint="r" coef="3"/></fixed></tendon>
<actuator><general name="pull" tendon="t" gear="2" biastype="affine" gainprm="4" biasprm="1 -5 -.3"/>
<position name="hold" joint="r" kp="40" forcerange="-3 1"/>
<general name="lean" tendon="u" gaintype="affine" gainprm="1 2 .5" biastype="none" ctrlrange="-1 1"/></actuator>
<keyframe><key name="up" qpos="0 0 .4 1 0 0 0 .5 -.3 .1" ctrl=".7 -.2 5"/></keyframe></mujoco>"""


def test_tendons_actuators_and_keyframes_are_those_of_mujoco(tmp_path):
    """Accelerations of a free body with three joints at a keyframe, for springs, dampers and actuators along sums of coordinates."""
    path = written(tmp_path, PULLED)
    model = mj.MjSpec.from_file(str(path)).compile()
    data = mj.MjData(model)
    mj.mj_resetDataKeyframe(model, data, 0)
    data.qvel[6:] = (0.4, -0.7, 0.2)
    mj.mj_forward(model, data)
    machine = nivel.import_model(path, keyframe="up")
    assert {name: each.rest for name, each in machine.inputs.items()} == {"pull": 0.7, "hold": -0.2, "lean": 1.0}
    mechanics = machine.mechanics()
    joints = [mechanics.names.index(name) for name in ("p.angle", "q.angle", "r.displacement")]
    velocity = np.zeros(9)
    velocity[joints] = data.qvel[6:]
    places = [mechanics.position_names.index(name) for name in ("p.angle", "q.angle", "r.displacement")]
    np.testing.assert_allclose(mechanics.start[places], (0.5, -0.3, 0.1), atol=1e-12)
    found = mechanics.forward_dynamics(mechanics.start, velocity, np.zeros(9))
    np.testing.assert_allclose(found[joints], data.qacc[6:], rtol=1e-9)
    with pytest.raises(nivel.ModelError, match=r"no keyframe `down`; there are up"):
        read_model(path, keyframe="down")


def test_sums_of_joints_that_are_equal_are_couplings(tmp_path):
    """l_t = 2 l_u: p - q/2 - 4 q - 6 r stays zero."""
    equal = '<equality><tendon name="e" tendon1="t" tendon2="u" polycoef="0 2 0 0 0"/></equality></mujoco>'
    data = read_model(written(tmp_path, PULLED.replace("</mujoco>", equal))).data
    assert data["couplings"]["e"] == {
        "type": "linear",
        "coordinates": ["p.angle", "q.angle", "r.displacement"],
        "factors": [1.0, -4.5, -6.0],
    }
    assert not [each for each in data.get("left_out", []) if "tendon" in each]


def test_joints_follow_each_other_from_where_they_are_placed(tmp_path):
    text = """<mujoco><worldbody><body name="a"><joint name="p" axis="0 0 1" ref="30"/><geom size=".1" pos=".5 0 0"/></body>
    <body name="b"><joint name="q" axis="0 0 1" ref="-10"/><geom size=".1" pos="0 .5 0"/></body></worldbody>
    <equality><joint joint1="q" joint2="p" polycoef="0.2 -3 0 0 0"/></equality></mujoco>"""
    mechanics = nivel.import_model(written(tmp_path, text), contacts="none").mechanics()
    values = dict(zip(mechanics.position_names, mechanics.close(mechanics.start + 0.3), strict=True))
    expected = np.deg2rad(-10) + 0.2 - 3 * (values["p.angle"] - np.deg2rad(30))
    assert values["q.angle"] == pytest.approx(expected, abs=1e-12)


def test_joints_follow_each_other_by_a_polynomial(tmp_path):
    """A knee that slides as it bends, as of models of limbs; coefficients are of ways from the places of the model."""
    text = """<mujoco><worldbody><body name="a"><joint name="p" axis="0 0 1" ref="30"/><geom size=".1" pos=".5 0 0"/>
    <body name="b"><joint name="q" type="slide" axis="1 0 0" ref="0.1"/><geom size=".1" pos="0 .5 0"/></body></body></worldbody>
    <equality><joint joint1="q" joint2="p" polycoef="0.05 0.6 0.3 0.04 0.02"/></equality></mujoco>"""
    path = written(tmp_path, text)
    mechanics = nivel.import_model(path, contacts="none").mechanics()
    assert len(mechanics.names) == 1
    values = dict(zip(mechanics.position_names, mechanics.close(mechanics.start + 0.4), strict=True))
    way = values["p.angle"] - np.deg2rad(30)
    expected = 0.1 + np.polynomial.polynomial.polyval(way, [0.05, 0.6, 0.3, 0.04, 0.02])
    assert abs(way) > 0.1
    assert values["q.displacement"] == pytest.approx(expected, abs=1e-10)
    # reduced mass at another place, from the matrix of MuJoCo: tᵀ M t with t = (1, f'(way))
    model = mj.MjSpec.from_file(str(path)).compile()
    model.opt.disableflags |= int(mj.mjtDisableBit.mjDSBL_CONTACT)
    q = np.array([values["p.angle"], values["q.displacement"]])
    M, _, _ = matrices(model, q, np.zeros(2), np.zeros(2))
    slope = np.polynomial.polynomial.polyval(way, [0.6, 0.6, 0.12, 0.08])
    t = np.array([1.0, slope]) if mechanics.names[0] == "p.angle" else np.array([1.0 / slope, 1.0])
    found = mechanics.mass_matrix([values[name] for name in mechanics.position_names])
    assert found[0, 0] == pytest.approx(t @ M @ t, rel=1e-9)


BALL = """<mujoco><option gravity="0 0 -9.81"/><worldbody><body name="base" pos="0 0 1"><freejoint/>
<geom type="box" size=".2 .1 .05" density="500"/>
<body name="arm" pos=".2 0 0" euler="20 0 30"><joint name="shoulder" type="ball"/>
<geom type="capsule" size=".03 .2" pos="0 0 -.2" density="900"/></body></body></worldbody></mujoco>"""


def test_a_free_base_with_a_ball_joint_falls_and_turns_as_in_mujoco(tmp_path):
    """The motion of both bodies from the same velocities, by MuJoCo with RK4 and a tenth of the step."""
    path = written(tmp_path, BALL)
    model = mj.MjSpec.from_file(str(path)).compile()
    model.opt.disableflags |= int(mj.mjtDisableBit.mjDSBL_CONTACT)
    model.opt.integrator, model.opt.timestep = int(mj.mjtIntegrator.mjINT_RK4), 1e-4
    data = mj.MjData(model)
    machine = nivel.import_model(path)
    velocity = {"bodies.base.velocity": [0.3, 0.1, 0.5], "bodies.base.angular_velocity": [1.0, -0.5, 0.7]}
    # the arm moves with the base: its point of the joint has the velocity of that
    at = np.array(machine.bodies["arm"].position) - np.array(machine.bodies["base"].position)
    moved = (np.array([0.3, 0.1, 0.5]) + np.cross([1.0, -0.5, 0.7], at)).tolist()
    velocity |= {"bodies.arm.velocity": moved, "bodies.arm.angular_velocity": [1.0, -0.5, 0.7]}
    data.qvel[:6] = [
        0.3,
        0.1,
        0.5,
        1.0,
        -0.5,
        0.7,
    ]  # of the base, whose axes are those of the world; the ball at rest on it
    result = machine.with_values(velocity).simulate(duration=0.5, step=1e-3, verify=False)
    for _ in range(5000):
        mj.mj_step(model, data)
    for k, name in enumerate(("base", "arm")):
        number = model.body(name).id
        np.testing.assert_allclose(result.array(f"{name}.position")[-1], data.xpos[number], atol=2e-9)
        turn = abs(result.array(f"{name}.orientation")[-1] @ data.xquat[number])
        assert turn == pytest.approx(1.0, abs=1e-12), k


def test_gravity_that_is_switched_off_is_off(tmp_path):
    text = TREE.replace('timestep="0.001"/>', 'timestep="0.001"><flag gravity="disable"/></option>')
    data = read_model(written(tmp_path, text), contacts="none").data
    assert data["gravity"] == [0.0, 0.0, 0.0]
    assert "forces" not in data
    assert data["simulation"] == {"step": 0.001, "coordinates": "relative"}


MANY = '<replicate count="100000"><replicate count="1000"><geom size="1"/></replicate></replicate>'


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("<worldbody>", '<include file="../secret.xml"/><worldbody>', r'xml:4:1: <include>: file="\.\./secret\.xml" leaves the folder'),
        ("<worldbody>", '<compiler meshdir="/"/><worldbody>', 'meshdir="/" leaves the folder'),
        ("<worldbody>", f"<worldbody>{MANY}", "100000000 repetitions; up to 10000 are read"),
        ("<worldbody>", '<include file="model.xml"/><worldbody>', "is included twice, or leads back to itself"),
        ('type="box"', 'type="bix"', "MuJoCo cannot compile the model: "),
        ("<mujoco", "<!DOCTYPE a []><mujoco", "a document type"),
        ('<geom type="box"', '<geom rgba="0.3 0.5 nan 1" type="box"', r'xml:5:.*<geom>: rgba="0\.3 0\.5 nan 1" is not finite'),
        ('density="800"', 'density="1e999"', 'density="1e999" is not finite'),
        ("<worldbody>", '<worldbody><replicate count="inf"><geom size="1"/></replicate>', 'count="inf" is not finite'),
    ],
)  # fmt: skip
def test_what_is_wrong_or_hostile_is_refused(tmp_path, old, new, message):
    with pytest.raises(nivel.ModelError, match=message):
        read_model(written(tmp_path, TREE.replace(old, new, 1)))


def test_names_with_a_hyphen_stand_in_expressions(tmp_path):
    """Torque 5 min(u, 2) of an actuator `left-hip` on a joint of that name, which is told to be called otherwise."""
    text = TREE.replace('"bend"', '"left-hip"').replace(
        "</worldbody>",
        '</worldbody><actuator><position name="left-hip" joint="left-hip" kp="5" ctrllimited="true" ctrlrange="-2 2"/></actuator>',
    )
    model = read_model(written(tmp_path, text))
    assert "left_hip was left-hip" in "\n".join(model.summary())
    machine = nivel.import_model(tmp_path / "model.xml")
    assert [*machine.inputs] == ["left_hip"]
    (force,) = [each for each in machine.record.forces if each.name == "left-hip"]
    assert "left_hip.value" in str(force.effort)


def test_a_name_may_look_like_a_number(tmp_path):
    assert "inf" in read_model(written(tmp_path, TREE.replace('name="yaw"', 'name="inf"', 1))).data["joints"]


def test_the_example_of_a_leg_is_the_translation_of_its_model():
    folder = Path(__file__).parents[2] / "examples" / "robots"
    ours, example = (
        nivel.import_model(folder / "leg.xml", contacts="none").record,
        nivel.load(folder / "leg.yaml").record,
    )
    for section in ("bodies", "markers", "joints", "couplings", "forces", "gravity"):
        assert getattr(ours, section) == getattr(example, section)


def test_included_files_may_be_in_folders_that_are_named(tmp_path):
    """Where the file says, outside of its folder, and under its name in another folder."""
    parts = tmp_path / "parts"
    parts.mkdir()
    (tmp_path / "model").mkdir()
    written(parts, '<mujoco><option timestep="0.004"/></mujoco>', "step.xml")
    body = '<worldbody><body><joint name="left-hip"/><geom size=".1"/></body></worldbody>'
    for place in ("step.xml", "../parts/step.xml"):
        path = written(tmp_path / "model", f'<mujoco><include file="{place}"/>{body}</mujoco>')
        with pytest.raises(nivel.ModelError, match=r"model\.xml:1:9: <include>: .*`--include-path FOLDER` names a"):
            nivel.import_model(path)
        machine = nivel.import_model(path, include_paths=[parts])
        assert machine.record.simulation.step == 0.004
        assert [joint.name for joint in machine.record.joints] == ["left_hip"]
