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
