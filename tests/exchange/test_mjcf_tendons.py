"""Tendons of MJCF through space, against MuJoCo: along sites, over pulleys, around cylinders, and as ends of a way."""

import numpy as np
import pytest

import nivel
from needing import needs

mj = needs("mujoco")

STEP = 1e-4
FREE = '<default><geom contype="0" conaffinity="0"/></default>'
BODIES = """<worldbody>
<site name="wall" pos="-.5 0 .6"/><site name="top" pos="0 0 1.4"/>
<geom name="wheel" type="cylinder" size=".1 .05" pos="-.3 0 1.2" euler="90 0 0" contype="0" conaffinity="0"/>
<site name="side" pos="-.3 0 1.5"/>
<body name="arm" pos="0 0 1"><joint name="p" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 .5 0 0" size=".03" density="1000"/>
  <site name="middle" pos=".25 0 .05"/>
  <body name="fore" pos=".5 0 0"><joint name="q" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 .3 0 0" size=".02" density="1000"/>
    <site name="tip" pos=".3 0 .02"/></body></body></worldbody>"""
SITES = '<site site="wall"/><site site="top"/><site site="middle"/>'
MODELS = {
    "a spring along sites": f'<tendon><spatial name="t" stiffness="90" damping="2" springlength="0.8">{SITES}</spatial></tendon>',
    "pulleys": '<tendon><spatial name="t" stiffness="60" springlength="0.5 0.7"><site site="top"/><site site="middle"/>'
    '<pulley divisor="2"/><site site="middle"/><site site="tip"/><pulley divisor="2"/><site site="wall"/><site site="tip"/>'
    "</spatial></tendon>",
    "an actuator": f'<tendon><spatial name="t">{SITES}</spatial></tendon><actuator>'
    '<general tendon="t" gear="2" biastype="affine" gainprm="5" biasprm="3 -9 -1"/></actuator>',
    "a wheel": '<tendon><spatial name="t" stiffness="70" springlength="0 0.4"><site site="wall"/><geom geom="wheel" sidesite="side"/>'
    '<site site="middle"/></spatial></tendon>',
}


def moved(path, duration=0.3):
    """Coordinates of MuJoCo from rest after a while, by its Runge–Kutta steps."""
    model = mj.MjSpec.from_file(str(path)).compile()
    model.opt.timestep, model.opt.integrator = STEP, int(mj.mjtIntegrator.mjINT_RK4)
    data = mj.MjData(model)
    data.ctrl[:] = 0.0
    for _ in range(round(duration / STEP)):
        mj.mj_step(model, data)
    return data.qpos.copy()


@pytest.mark.parametrize("name", MODELS)
def test_an_arm_on_a_tendon_moves_as_in_mujoco(name, tmp_path):
    path = tmp_path / "model.xml"
    path.write_text(f"<mujoco>{FREE}{BODIES}{MODELS[name]}</mujoco>", encoding="utf-8")
    machine = nivel.import_model(path, contacts="none")
    assert not machine.record.left_out
    result = machine.simulate(duration=0.3, step=1e-3, integrator="dopri5", tolerance=1e-9, verify=False)
    np.testing.assert_allclose([result[f"{joint}.angle"][-1] for joint in "pq"], moved(path), atol=2e-7)


def test_a_ball_hangs_on_a_tendon_with_an_upper_limit(tmp_path):
    """ẍ = 0: the rope carries the weight, and sinks by what lets the ball vibrate at 10 Hz."""
    path = tmp_path / "model.xml"
    path.write_text(
        '<mujoco><worldbody><site name="hook" pos="0 0 1"/><body name="ball" pos="0 0 .5"><freejoint/><geom size=".05" mass="2"/>'
        '<site name="eye"/></body></worldbody><tendon><spatial name="string" limited="true" range="0 .5"><site site="hook"/>'
        '<site site="eye"/></spatial></tendon></mujoco>',
        encoding="utf-8",
    )
    machine = nivel.import_model(path, contacts="none")
    (rope,) = [each for each in machine.record.forces if each.type == "rope"]
    result = machine.simulate(duration=2.0, step=1e-3, integrator="dopri5", verify=False)
    assert result["force.string_end.magnitude"][-1] == pytest.approx(2 * 9.81, rel=1e-6)
    assert rope.stiffness == pytest.approx(2 * (20 * np.pi) ** 2, rel=1e-5)


@pytest.mark.parametrize(
    ("way", "left"),
    [
        (
            '<site site="wall"/><geom geom="wheel"/><site site="middle"/>',
            "tendons around wheels with pulleys or actuators",
        ),
        (
            '<site site="wall"/><geom geom="ball"/><site site="middle"/>',
            "turning of the plane of tendons around spheres",
        ),
        (
            '<site site="wall"/><geom geom="wheel"/><site site="top"/><geom geom="upright"/><site site="tip"/>',
            "axes are not parallel",
        ),
    ],
)
def test_what_no_rope_can_be_is_said_by_name(way, left, tmp_path):
    more = '<geom name="ball" size=".1" pos="-.2 0 .8"/><geom name="upright" type="cylinder" size=".05 .05" pos="0 0 1.2"/>'
    actuator = '<actuator><motor tendon="t"/></actuator>' if "actuators" in left else ""
    spring = f'<tendon><spatial name="t" stiffness="5" springlength="0.1">{way}</spatial></tendon>'
    text = f"<mujoco>{FREE}{BODIES.replace('<body', more + '<body', 1)}{spring}{actuator}</mujoco>"
    (tmp_path / "model.xml").write_text(text, encoding="utf-8")
    record = nivel.import_model(tmp_path / "model.xml", contacts="none").record
    assert any(left in each and "t" in each for each in record.left_out)
