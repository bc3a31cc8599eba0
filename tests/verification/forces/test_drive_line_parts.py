"""Parts of drive lines written with couplings, motors and tables, against closed forms: differential, engine map, torque converter."""

import numpy as np
import pytest

from simulating import hinge, simulate, wheel

STEPS = {"integrator": "rk4", "step": "1 ms", "coordinates": "relative"}


def wheels(inertias, **sections):
    """Wheels on the ground about z, named after their joints."""
    bodies = {f"{name}_wheel": wheel(inertia, position=[k, 0, 0]) for k, (name, inertia) in enumerate(inertias.items())}
    joints = {name: hinge("ground", f"{name}_wheel", (k, 0, 0)) for k, name in enumerate(inertias)}
    return {"gravity": [0, 0, 0], "bodies": bodies, "joints": joints, **sections}


def test_an_open_differential_gives_both_shafts_the_same_torque():
    """2 φ_c = φ_l + φ_r; with the torque λ at each shaft and T = J_c α_c + 2 λ at the cage: λ = T/(2 + J_c/2 (1/J_l + 1/J_r))."""
    cage, left, right, torque = 0.3, 4.0, 1.0, 50.0
    sections = wheels(
        {"cage": cage, "left": left, "right": right},
        couplings={
            "differential": {"type": "linear", "coordinates": ["cage", "left", "right"], "factors": [2, -1, -1]}
        },
        forces={"drive": {"type": "motor", "coordinate": "cage", "effort": torque}},
    )
    r = simulate(sections, **STEPS, duration=1.0)
    each = torque / (2.0 + 0.5 * cage * (1.0 / left + 1.0 / right))
    np.testing.assert_allclose(r.array("left.angle.rate")[-1], each / left, rtol=1e-9)
    np.testing.assert_allclose(r.array("right.angle.rate")[-1], each / right, rtol=1e-9)


def test_a_limited_slip_differential_moves_torque_to_the_slower_shaft():
    """Its clutch slips with 3 N m, which the faster wheel loses and the slower one gains."""
    sections = wheels(
        {"cage": 0.3, "left": 4.0, "right": 1.0},
        couplings={
            "differential": {"type": "linear", "coordinates": ["cage", "left", "right"], "factors": [2, -1, -1]}
        },
        forces={
            "drive": {"type": "motor", "coordinate": "cage", "effort": 50.0},
            "plates": {"type": "clutch", "coordinate": "left", "against": "right", "capacity": 3.0},
        },
    )
    r = simulate(sections, **STEPS, duration=1.0)
    # α_l = (λ + 3)/4, α_r = (λ - 3)/1 and 50 = 0.3 (α_l + α_r)/2 + 2 λ
    shaft = np.linalg.solve([[4.0, 0.0, -1.0], [0.0, 1.0, -1.0], [0.15, 0.15, 2.0]], [3.0, -3.0, 50.0])
    np.testing.assert_allclose(r.array("left.angle.rate")[-1], shaft[0], rtol=1e-5)
    np.testing.assert_allclose(r.array("right.angle.rate")[-1], shaft[1], rtol=1e-5)


@pytest.mark.parametrize(("throttle", "top", "slope"), [(1.0, 100.0, -0.2), (0.5, 50.0, -0.15)])
def test_an_engine_map_by_speed_and_throttle(throttle, top, slope):
    """Straight lines of the map over the speed: J ω̇ = T₀ + s ω - b ω, so that ω = T₀/(b - s) (1 - exp(-(b - s) t/J))."""
    sections = wheels(
        {"crank": 0.2},
        inputs={"throttle": {"range": [0, 1], "signal": throttle}},
        functions={
            "engine_map": {"points": [0, "500 rad/s"], "across": [0, 1], "values": [[0, -50], [100, 0]]},
        },
        forces={
            "engine": {
                "type": "motor",
                "coordinate": "crank",
                "effort": "engine_map(crank.angle_rate, throttle.value)",
            },
            "load": {"type": "joint-spring-damper", "coordinate": "crank", "damping": 0.3},
        },
    )
    r = simulate(sections, **STEPS, duration=0.8)
    fall = 0.3 - slope
    wanted = top / fall * (1.0 - np.exp(-fall * r.time / 0.2))
    np.testing.assert_allclose(r.array("crank.angle.rate"), wanted, rtol=1e-6, atol=1e-6)


@pytest.mark.parametrize("load", [1e3, 40.0])
def test_a_torque_converter_by_its_tables(load):
    """With the turbine held, the engine of 80 N m turns at √(T/k(0)) and the turbine feels μ(0) T; with a load of 40 N m the speed ratio
    is the one at which μ(ν) = 40/80 would hold, or, where that is not reached, it climbs until both balance."""
    sections = wheels(
        {"engine": 0.1, "turbine": 0.2},
        functions={
            "capacity": {"points": [0, 0.8, 1], "values": [2e-3, 2e-3, 0]},
            "torque_ratio": {"points": [0, 0.8, 1], "values": [2.2, 1, 1]},
            "speed_ratio(i, o)": "min(max(o/max(i, 1), 0), 1)",
        },
        forces={
            "burn": {"type": "motor", "coordinate": "engine", "effort": 80},
            "impeller": {"type": "motor", "coordinate": "engine",
                         "effort": "-capacity(speed_ratio(engine.angle_rate, turbine.angle_rate))*engine.angle_rate^2"},
            "runner": {"type": "motor", "coordinate": "turbine",
                       "effort": "torque_ratio(speed_ratio(engine.angle_rate, turbine.angle_rate))"
                                 "*capacity(speed_ratio(engine.angle_rate, turbine.angle_rate))*engine.angle_rate^2"},
            "brake": {"type": "brake", "coordinate": "turbine", "capacity": load},
            "air": {"type": "joint-spring-damper", "coordinate": "turbine", "damping": 0.4},
        },
    )  # fmt: skip
    r = simulate(sections, **STEPS, duration=12.0, output_interval=0.1)
    engine, turbine = r.array("engine.angle.rate")[-1], r.array("turbine.angle.rate")[-1]
    nu = min(max(turbine / engine, 0.0), 1.0)
    capacity, ratio = np.interp(nu, [0, 0.8, 1], [2e-3, 2e-3, 0]), np.interp(nu, [0, 0.8, 1], [2.2, 1, 1])
    assert capacity * engine**2 == pytest.approx(80.0, rel=1e-4)
    if load == 1e3:
        assert engine == pytest.approx(np.sqrt(80.0 / 2e-3), rel=1e-6)
        assert abs(turbine) < 1e-9
        assert abs(r.array("force.brake.magnitude")[-1]) == pytest.approx(2.2 * 80.0, rel=1e-5)
    else:
        assert ratio * 80.0 == pytest.approx(load + 0.4 * turbine, rel=1e-3)
        assert 0.0 < nu < 1.0
