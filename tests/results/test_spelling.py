"""One quantity has one value under both of its spellings: that of expressions and that of results."""

import pytest

import nivel

MACHINE = """format: 1
gravity: [0, -9.81, 0]
states: {filter: {rate: hinge.angle - filter.value}}
control: {doubled: {type: signal, value: 2*SPEED}}
bodies: {bob: {mass: 1, inertia: [0.1, 0.1, 0.1], position: [1, 0, 0]}}
markers: {post: {body: ground, position: [2, 1, 0]}, tip: {body: bob, position: [1, 0, 0]}}
joints: {hinge: {type: revolute, bodies: [ground, bob], point: [0, 0, 0], axis: [0, 0, 1]}}
forces:
  spring: {type: spring-damper, markers: [post, tip], stiffness: 3, free_length: 0.5}
  wind: {type: force, body: bob, vector: [-0.1*HEIGHT, 0, 0]}
simulation: {duration: 0.3 s, step: 1 ms, integrator: rk4}
"""
PAIRS = {
    "hinge.angle_rate": "hinge.angle.rate",
    "bob.x": "bob.position.x",
    "bob.vy": "bob.velocity.y",
    "bob.wz": "bob.angular_velocity.z",
    "spring.magnitude": "force.spring.magnitude",
    "doubled.value": "control.doubled",
    "filter.value": "state.filter",
}


def run(speed, height, tmp_path):
    path = tmp_path / "pendulum.yaml"
    path.write_text(MACHINE.replace("SPEED", speed).replace("HEIGHT", height), encoding="utf-8")
    return nivel.load(path)


def test_results_and_stepping_read_what_expressions_write(tmp_path):
    machine = run("hinge.angle_rate", "bob.y", tmp_path)
    result, sim = machine.simulate(), machine.start()
    for _ in range(100):
        sim.step()
    for written, shown in PAIRS.items():
        assert written in result
        assert shown in result.names
        assert written not in result.names
        assert (result.array(written) == result.array(shown)).all()
        assert result.units(written) == result.units(shown)
        assert sim[written] == sim[shown] != 0.0
    assert "bob.u" not in result
    with pytest.raises(nivel.ModelError, match=r"no `bob\.u`"):
        result["bob.u"]


def test_expressions_read_what_results_show(tmp_path):
    first = run("hinge.angle_rate", "bob.y", tmp_path).simulate()
    other = run("hinge.angle.rate", "bob.position.y", tmp_path).simulate()
    for name in ("hinge.angle", "control.doubled"):
        assert (first.array(name) == other.array(name)).all()
    path = tmp_path / "pendulum.yaml"
    path.write_text(
        MACHINE.replace("SPEED", "bob.angular_velocity.z").replace(
            "-0.1*HEIGHT", "{of: bob.velocity.y, points: [-9, 9], values: [-1, 1]}"
        ),
        encoding="utf-8",
    )
    nivel.load(path).check()
