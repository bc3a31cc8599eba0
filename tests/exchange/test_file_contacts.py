"""Contacts, worlds and rare joints of URDF and SDF: what touches, how hard, and what carries the weight."""

import numpy as np
import pytest

import nivel
from exchange_models import joint, link, robot
from nivel.errors import ModelError
from nivel.exchange import read_model

BALL = '<collision><origin xyz="0 0 {z}"/><geometry><sphere radius="0.05"/></geometry></collision>'


def written(folder, text, name):
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def walker(more=""):
    """A trunk of 4 kg on two balls, and a lever of 1 kg whose ball is higher."""
    feet = "".join(BALL.format(z=-0.4).replace('xyz="0 ', f'xyz="{x} ') for x in (-0.2, 0.2)).replace(
        " 0 -0.4", " 0.1 -0.4"
    )
    third = BALL.format(z=-0.4).replace('xyz="0 0', 'xyz="0 -0.2')
    return robot(
        link("trunk", 4.0, more=feet + third),
        link("lever", 1.0, inertia=(0.01, 0.01, 0.01), more=BALL.format(z=0.0)),
        joint("hinge", "revolute", "trunk", "lever", at="0.1 0 0", more='<limit lower="0.1" upper="0.3"/>'),
        more,
    )


def contacts(path, **given):
    return {
        name: each
        for name, each in read_model(path, **given).data.get("forces", {}).items()
        if each["type"] == "contact"
    }


def test_a_free_robot_stands_on_a_ground_below_it_and_a_fixed_one_touches_nothing(tmp_path):
    """Links of one robot do not touch; mu1 and kp are those of <gazebo>; rigid surfaces sink by 0.5 mm under the weight of all on a point,
    critically damped: K = m g/s and K a m g/(m g) = 2 √(K m)."""
    path = written(
        tmp_path, walker('<gazebo reference="lever"><mu1>0.3</mu1><mu2>0.4</mu2><kp>2e4</kp></gazebo>'), "walker.urdf"
    )
    found = contacts(path, base="free")
    assert len(found) == 4
    rigid = [each for each in found.values() if each["friction"] == 1.0]
    soft = [each for each in found.values() if each["friction"] == 0.3]
    weight = 5.0 * 9.81
    assert [each["stiffness"] for each in rigid] == pytest.approx([weight / 0.5e-3] * 3, rel=1e-5)
    assert [each["damping"] for each in rigid] == pytest.approx([2.0 * np.sqrt(weight / 0.5e-3 * 5.0) / weight] * 3)
    assert [each["stiffness"] for each in soft] == [2e4]
    assert not contacts(path)
    assert not contacts(path, base="free", contacts="none")
    assert any("collision" in each for each in read_model(path, base="free", contacts="none").data["left_out"])


def test_feet_carry_the_weight_and_joints_begin_within_their_limits_without_turning_the_base(tmp_path):
    """Σ N = m g, by more than two feet at rest; the trunk stands where the model places it, although the hinge cannot be at zero."""
    path = written(tmp_path, walker(), "walker.urdf")
    machine = nivel.import_model(path, base="free")
    result = machine.simulate(duration=1.5, verify=False)
    names = [name for name in contacts(path, base="free") if "lever" not in name]
    assert sum(result[f"force.{name}.normal_force"][-1] for name in names) == pytest.approx(5.0 * 9.81, rel=1e-3)
    trunk = result.coordinates["body"].index("trunk")
    np.testing.assert_allclose(result.array("position")[0, trunk], 0.0, atol=1e-12)
    assert result["hinge.angle"][0] == pytest.approx(0.2)
    assert abs(result.array("position")[-1, trunk, 2]) < 0.5e-3
    # contacts have no part in the matrices
    mechanics = machine.mechanics()
    assert set(mechanics.left_out) == set(contacts(path, base="free"))
    assert len(mechanics.names) == 7


WORLD = """<sdf version="1.9"><world name="w"><gravity>0 0 -10</gravity>
<include><uri>model://ground_plane</uri></include><include><uri>model://sun</uri></include>
<model name="table"><static>true</static><link name="top"><collision name="c"><geometry><box><size>1 1 0.1</size></box></geometry>
<surface><friction><ode><mu>0.6</mu><mu2>0.5</mu2></ode></friction></surface></collision></link></model>
<model name="cart"><pose>0 0 1 0 0 0</pose>
<link name="body"><collision name="c"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision></link>
<link name="arm"><pose>0 0 0.3 0 0 0</pose><gravity>false</gravity>
<collision name="c"><geometry><sphere><radius>0.05</radius></sphere></geometry>
<surface><contact><ode><kp>3e4</kp><kd>400</kd></ode></contact></surface></collision></link>
<link name="out"><pose>0 0 0.6 0 0 0</pose></link>
<joint name="steer" type="revolute2"><parent>body</parent><child>arm</child><axis><xyz>0 0 1</xyz></axis>
<axis2><xyz>0 1 0</xyz><dynamics><damping>2</damping></dynamics></axis2></joint>
<joint name="turn" type="revolute"><parent>body</parent><child>out</child><axis><xyz>0 0 -1</xyz></axis></joint>
<joint name="gear" type="gearbox"><parent>arm</parent><child>out</child><gearbox_ratio>3</gearbox_ratio>
<gearbox_reference_body>body</gearbox_reference_body><axis><xyz>0 0 1</xyz></axis><axis2><xyz>0 0 1</xyz></axis2></joint>
</model></world></sdf>
"""


def test_models_of_a_world_touch_each_other_and_the_ground(tmp_path):
    """The cart's two solids touch the plane and the table, whose smaller coefficient counts, and not each other."""
    path = written(tmp_path, WORLD, "w.sdf")
    data = read_model(path).data
    assert set(data["bodies"]) == {"cart_body", "cart_arm", "cart_out", "cart_steer_between"}
    found = contacts(path)
    assert len(found) == 4
    assert sorted(each["friction"] for each in found.values()) == [0.5, 0.5, 1.0, 1.0]
    assert sorted(each.get("stiffness", 0.0) for each in found.values())[1:3] == [3e4, 3e4]
    assert {force["body"]: force["vector"] for force in data["forces"].values() if force["type"] == "force"} == {
        "cart_arm": [0, 0, 10]
    }
    assert (
        len(
            contacts(
                written(
                    tmp_path, WORLD.replace("<pose>0 0 1 0 0 0</pose>", "<self_collide>true</self_collide>"), "x.sdf"
                )
            )
        )
        == 4
    )


def test_a_second_axis_is_a_second_joint_and_a_gearbox_is_a_coupling(tmp_path):
    """θ₂ = -3 θ₁, both from the body of reference: `turn` counts against its axis2. The first angle of two axes has no joint of its own
    from the body to the arm, so the gearbox of this model is left out."""
    data = read_model(written(tmp_path, WORLD, "w.sdf")).data
    assert {name: each["type"] for name, each in data["joints"].items()} == {
        "cart_steer": "revolute",
        "cart_steer_2": "revolute",
        "cart_turn": "revolute",
    }
    assert data["forces"]["cart_steer_2_damper"]["damping"] == 2
    assert any("gearboxes" in each for each in data["left_out"])
    text = WORLD.replace('type="revolute2"', 'type="revolute"')
    coupling = read_model(written(tmp_path, text, "g.sdf")).data["couplings"]["cart_turn_mimic"]
    assert coupling["coordinates"] == ["cart_turn.angle", "cart_steer.angle"]
    assert coupling["factors"] == [1.0, -3.0]


def test_friction_below_zero_is_without_limit(tmp_path):
    path = written(tmp_path, WORLD.replace("<mu>0.6</mu><mu2>0.5</mu2>", "<mu>-1</mu><mu2>-1</mu2>"), "world.sdf")
    translation = read_model(path)
    kept = [each for each in translation.data["forces"].values() if each["type"] == "contact"]
    assert {each["friction"] for each in kept} == {1.0}  # that of the other surface
    assert any("friction below zero is without limit" in each for each in translation.summary())


def test_a_robot_whose_meshes_are_all_missing_has_no_ground_and_says_so(tmp_path):
    solid = '<collision><geometry><mesh filename="no.stl"/></geometry></collision>'
    parts = link("trunk", 4.0, more=solid), link("arm", 1.0, more=solid), joint("hinge", "revolute", "trunk", "arm")
    path = written(tmp_path, robot(*parts), "bare.urdf")
    data = read_model(path, base="free").data
    assert "ground_plane" not in data.get("markers", {})
    assert any("meshes of all" in each for each in data["left_out"])
    assert len(nivel.import_model(path, base="free").record.bodies) == 2


def test_a_joint_on_a_link_of_an_included_model_is_refused_with_its_line(tmp_path):
    base = '<link name="rack"/>'
    rest = '<include><uri>model://create</uri></include>\n<joint name="hold" type="fixed"><parent>create::base</parent>'
    model = f'<sdf version="1.6"><model name="m">{base}{rest}<child>rack</child></joint></model></sdf>'
    path = written(tmp_path, model, "model.sdf")
    with pytest.raises(ModelError, match=r'(?s)model.sdf:2:.*joint name="hold".*create::base.*includes are not read'):
        read_model(path)
