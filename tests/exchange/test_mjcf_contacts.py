"""Contacts of MJCF: which geoms touch, how deep they sink, and what carries the weight."""

import numpy as np
import pytest

import nivel
from needing import needs
from nivel.exchange import read_model

mj = needs("mujoco")

MODEL = """<mujoco model="table">
<option gravity="0 0 -9.81"/>
<worldbody>
  <geom name="ground" type="plane" size="5 5 1" friction="0.4"/>
  <body name="table" pos="0 0 0.199">
    <freejoint/>
    <geom name="top" type="box" size=".3 .3 .02" mass="8" contype="0" conaffinity="0"/>
    <geom name="one" type="sphere" size=".03" pos=".25 .25 -.17" mass="0.5"/>
    <geom name="two" type="sphere" size=".03" pos="-.25 .25 -.17" mass="0.5" friction="0.7"/>
    <geom name="three" type="sphere" size=".03" pos="0 -.25 -.17" mass="0.5" condim="1"/>
    <body name="lid" pos="0 0 .1"><joint name="hinge" axis="0 1 0" damping="1" stiffness="50"/>
      <geom name="leaf" type="capsule" size=".02 .1" mass="0.5" euler="90 0 0"/>
      <body name="knob" pos="0 0 .2"><joint name="turn" axis="0 0 1" damping="1"/>
        <geom name="ball" type="sphere" size=".02" mass="0.1"/></body>
    </body>
  </body>
</worldbody>
<contact><exclude body1="table" body2="knob"/></contact>
</mujoco>"""


@pytest.fixture(name="path")
def written(tmp_path):
    (tmp_path / "table.xml").write_text(MODEL, encoding="utf-8")
    return tmp_path / "table.xml"


def test_the_pairs_are_those_that_masks_parents_and_exclusions_leave(path):
    """Without masks all solids of the table with the ground; the lid is a child of the table, the knob one of the lid and excluded."""
    forces = {name: each for name, each in read_model(path).data["forces"].items() if each["type"] == "contact"}
    assert set(forces) == {"ground_one", "ground_two", "ground_three", "ground_leaf", "ground_ball"}
    frictions = [forces[f"ground_{name}"].get("friction") for name in ("one", "two", "three")]
    assert frictions == [1.0, 0.7, 1.0]  # the larger one of both, of condim as well
    apart = read_model(path, contacts="none")
    assert not [each for each in apart.data["forces"].values() if each["type"] == "contact"]
    assert any("contact" in each for each in apart.data["left_out"])


@pytest.mark.parametrize(("balls", "sides", "integrator"), [(9, 3, None), (12, 3, "dopri5"), (12, 1, "dopri5")])
def test_models_with_many_contacts_are_stepped_explicitly(balls, sides, integrator, tmp_path):
    """n balls on the ground have n (n + 1)/2 contacts: 45 and 78."""
    bodies = "".join(
        f'<body pos="{k} 0 .1"><freejoint/><geom name="ball_{k}" type="sphere" size=".1" mass="1" condim="{sides}"/></body>'
        for k in range(balls)
    )
    ground = f'<geom name="ground" type="plane" size="5 5 1" condim="{sides}"/>'
    path = tmp_path / "balls.xml"
    path.write_text(f"<mujoco><worldbody>{ground}{bodies}</worldbody></mujoco>", encoding="utf-8")
    found = read_model(path)
    assert sum(each["type"] == "contact" for each in found.data["forces"].values()) == balls * (balls + 1) // 2
    assert found.data.get("simulation", {}).get("integrator") == integrator
    assert any("dopri5" in each for each in found.notes.changed) == (integrator is not None)


SOFT = """<mujoco><worldbody><geom name="ground" type="plane" size="5 5 1"/><body name="stool" pos="0 0 0.0"><freejoint/>
<geom name="seat" type="box" size=".2 .2 .02" pos="0 0 .3" mass="8" contype="0" conaffinity="0"/>
<body name="one" pos=".2 .2 .03"><joint axis="0 1 0" stiffness="500" damping="5" frictionloss="0.3"/>
<geom name="a" size=".03" mass="0.2"/></body>
<body name="two" pos="-.2 .2 .03"><joint axis="0 1 0" stiffness="500" damping="5"/><geom name="b" size=".03" mass="0.2"/></body>
<body name="three" pos=".2 -.2 .03"><joint axis="0 1 0" stiffness="500" damping="5"/><geom name="c" size=".03" mass="0.2"/></body>
<body name="four" pos="-.2 -.2 .03"><joint axis="0 1 0" stiffness="500" damping="5"/><geom name="d" size=".03" mass="0.2"/></body>
</body></worldbody></mujoco>""".replace('<geom name="', '<geom solimp="0.015 1 0.023" priority="1" name="').replace(
    "0 0 0.0", "0 0 -.02"
)


def test_soft_feet_sink_as_in_mujoco_under_their_share_and_a_model_inside_the_ground_is_raised(tmp_path):
    """The impedance of these feet grows from 0.015 to 1 over 23 mm: what they sink depends on the load. Friction of a joint gives way at
    R loss/b, R = 0.1/0.9 of the inverse weight and b = 2/(0.95 · 0.02 s)."""
    (tmp_path / "stool.xml").write_text(SOFT, encoding="utf-8")
    model = mj.MjSpec.from_file(str(tmp_path / "stool.xml")).compile()
    data = mj.MjData(model)
    data.qpos[2] = 0.0
    for _ in range(int(3.0 / model.opt.timestep)):
        mj.mj_step(model, data)
    machine = nivel.import_model(tmp_path / "stool.xml", contacts="floor")
    friction = next(each for each in machine.record.forces if each.type == "friction")
    assert friction.transition_speed == pytest.approx(0.3 * model.dof_invweight0[6] / 9.0 * 0.95 * 0.02 / 2.0, rel=1e-5)
    contacts = [each for each in machine.record.forces if each.type == "contact"]
    assert len(contacts) == 4
    weight = 9.81 * float(sum(model.body_mass))
    sunk = weight / sum(each.stiffness for each in contacts)
    assert sunk == pytest.approx(0.0 - data.qpos[2], rel=0.1)
    start = next(body.position[2] for body in machine.record.bodies if body.name == "stool")
    assert start == pytest.approx(-0.5 * sunk, rel=1e-4)


def test_the_table_carries_its_weight_and_sinks_as_in_mujoco(path):
    """Both rest: the forces are the weight, and the depths agree within the range of the impedance of MuJoCo, 0.9 to 0.95."""
    model = mj.MjSpec.from_file(str(path)).compile()
    data = mj.MjData(model)
    for _ in range(int(2.0 / model.opt.timestep)):
        mj.mj_step(model, data)
    machine = nivel.import_model(path)
    result = machine.simulate(duration=2.0)
    weight = 9.81 * float(sum(model.body_mass))
    total = sum(result[f"force.ground_{name}.normal_force"][-1] for name in ("one", "two", "three"))
    assert total == pytest.approx(weight, rel=1e-4)
    assert sum(body.mass for body in machine.record.bodies) == pytest.approx(float(sum(model.body_mass)), rel=1e-12)
    height = result.array("position")[-1, result.coordinates["body"].index("table"), 2]
    sunk, own = 0.2 - data.qpos[2], 0.2 - height
    assert 0.5 * sunk < own < 2.0 * sunk
    np.testing.assert_allclose(height, data.qpos[2], atol=1e-3)


def test_what_a_weld_holds_to_the_ground_does_not_touch_it(tmp_path):
    path = tmp_path / "model.xml"
    path.write_text(
        '<mujoco><worldbody><geom type="plane" size="1 1 1"/><body name="held" pos="0 0 .05"><freejoint/><geom size=".1"/></body>'
        '<body name="ball" pos="0 .5 .1"><freejoint/><geom size=".1"/></body></worldbody>'
        '<equality><weld body1="held"/></equality></mujoco>',
        encoding="utf-8",
    )
    machine = nivel.import_model(path)
    touching = [each.name for each in machine.record.forces if each.type == "contact"]
    assert len(touching) == 2  # the ball and the plane, the ball and what is held
    assert [body.name for body in machine.record.bodies] == ["ball"]


def test_solids_that_begin_deep_in_each_other_are_no_pair(tmp_path):
    ball = '<body name="{0}" pos="{1} 0 1"><freejoint/><geom name="{0}_ball" size=".1"/></body>'
    bodies = "".join(ball.format(name, x) for name, x in (("one", 0), ("two", 0.1), ("three", 0.299)))
    (tmp_path / "model.xml").write_text(f"<mujoco><worldbody>{bodies}</worldbody></mujoco>", encoding="utf-8")
    machine = nivel.import_model(tmp_path / "model.xml")
    assert [each.name for each in machine.record.forces] == ["one_ball_three_ball", "two_ball_three_ball"]
    assert any("deep inside each other: one_ball and two_ball" in each for each in machine.record.left_out)


@pytest.mark.parametrize("reference", ["0.02 1", "0.01 0.2", "-10000 -20", "-10000 -180", "-10000 -250"])
def test_what_rebounds_in_mujoco_is_left_out_by_name(reference, tmp_path):
    """A ball that falls by 40 cm in MuJoCo, and its speed after the impact by the height to which it comes."""
    path = tmp_path / "ball.xml"
    path.write_text(
        f'<mujoco><option timestep="1e-4"/><worldbody><geom name="floor" type="plane" size="1 1 1" solref="{reference}"/>'
        f'<body name="ball" pos="0 0 .5"><freejoint/><geom name="skin" size=".1" solref="{reference}"/></body></worldbody></mujoco>',
        encoding="utf-8",
    )
    model = mj.MjSpec.from_file(str(path)).compile()
    data, heights = mj.MjData(model), []
    while data.time < 0.9:
        mj.mj_step(model, data)
        heights.append(data.qpos[2])
    lowest = int(np.argmin(heights[:4000]))
    left = np.sqrt(max(max(heights[lowest:]) - 0.1, 0.0) / 0.4)
    machine = nivel.import_model(path)
    assert ("rebound of contacts: floor and skin" in machine.record.left_out) == (left > 0.05), left


def test_balls_and_capsules_rest_where_the_margins_of_their_contacts_hold_them(tmp_path):
    """As in MuJoCo, where the margins are the distances above the plane and the box; between boxes margins are left out, by name."""
    body = '<body pos="{0} {1}"><freejoint/><geom name="{2}" {3} mass="4"/></body>'
    bodies = body.format(0, "0 .2", "near", 'size=".1"') + body.format(1, "0 .2", "far", 'size=".1" margin=".015"')
    bodies += body.format(3, "0 .3", "high", 'size=".1" margin=".02"')
    bodies += body.format(3.2, ".2 .3", "bar", 'type="capsule" size=".1 .05" euler="0 90 0"')
    bodies += body.format(9, "0 .1", "crate", 'type="box" size=".1 .1 .1"')
    shelf = '<geom name="shelf" type="box" pos="3 0 0" size=".5 .5 .1" margin=".01"/>'
    floor = '<geom name="floor" type="plane" size="5 5 1" margin=".01"/>'
    text = f"<mujoco><worldbody>{floor}{shelf}{bodies}</worldbody></mujoco>"
    (tmp_path / "balls.xml").write_text(text, encoding="utf-8")
    model = mj.MjSpec.from_string(text).compile()
    data = mj.MjData(model)
    for _ in range(int(2.0 / model.opt.timestep)):
        mj.mj_step(model, data)
    machine = nivel.import_model(tmp_path / "balls.xml", contacts="floor")
    height = machine.simulate(duration=2.0, verify=False).array("position")[-1, :4, 2]
    np.testing.assert_allclose(height, data.qpos[[2, 9, 16, 23]], atol=2e-4)
    assert any("margins of contacts: shelf and crate" in each for each in machine.record.left_out)
