# ruff: noqa: E501
"""Controls of pumps as the page writes them: negative and positive flow control, electronic load limit with split torque, cut-off."""

import numpy as np
import pytest

from nivel.api import Machine
from nivel.files import parse_machine

BAR = 1e5
PUMPS = """
format: 1
inputs:
  lever: {{range: [0, 1], signal: {{of: time, times: [0, 1, 1.5], values: [0, 0, {lever}]}}}}
control:
  # what the engine can give: less where its speed falls below 1750 rpm
  torque: {{type: limit, input: 350 + 20*(diesel.speed - 1750 rpm), limits: [50, 350]}}
hydraulics:
  tank: {{type: tank}}
  diesel:
    type: engine
    speed: 1800 rpm
    inertia: 3 kg m^2
    droop: 0.06
    torque_curve: {{speeds: [800 rpm, 1400 rpm, 2000 rpm], torques: [380 N*m, 450 N*m, 400 N*m]}}
  negative: {{type: pump, ports: {{A: tank, B: left}}, engine: diesel, displacement: 71 cm^3/rev, frequency: 5 Hz, least_setting: 0, setting: "lookup(bleed.pressure, linear, 4 bar, 1, 30 bar, 0.1)", torque_limit: 0.6*torque}}
  positive: {{type: pump, ports: {{A: tank, B: right}}, engine: diesel, displacement: 71 cm^3/rev, frequency: 5 Hz, least_setting: 0, setting: 0.05 + 0.95*lever, torque_limit: 0.4*torque, cut_off_curve: {{pressures: [200 bar, 300 bar], settings: [1, 0.02]}}}}
  right: {{type: volume, volume: 10 L}}
  centre: {{type: orifice, ports: {{A: left, B: bleed}}, flow: 200 L/min, pressure_drop: 5 bar, opening: 1 - lever}}
  nozzle: {{type: orifice, ports: {{A: bleed, B: tank}}, flow: 40 L/min, pressure_drop: 30 bar}}
  work: {{type: orifice, ports: {{A: left, B: tank}}, flow: {flow}, pressure_drop: 100 bar, opening: lever}}
  other: {{type: orifice, ports: {{A: right, B: tank}}, flow: {other}, pressure_drop: 100 bar}}
  safety: {{type: relief-valve, ports: {{P: left, T: tank}}, opens_at: 350 bar, opening_range: 30 bar, flow: 200 L/min, pressure_drop: 350 bar}}
  guard: {{type: relief-valve, ports: {{P: right, T: tank}}, opens_at: 350 bar, opening_range: 30 bar, flow: 200 L/min, pressure_drop: 350 bar}}
simulation: {{duration: 6 s, step: 1 ms}}
"""


def steady(lever=0.0, flow="100 L/min", other="60 L/min"):
    """Results at the end."""
    result = Machine.from_record(parse_machine(PUMPS.format(lever=lever, flow=flow, other=other))).simulate()
    return lambda name: result.array(f"hydraulics.{name}")[-1]


def drop(of, node):
    return of(f"{node}.pressure") - of("tank.pressure")


def test_negative_flow_control_swings_back_where_the_centre_is_open():
    of = steady()
    share = np.interp(of("bleed.pressure"), [4 * BAR, 30 * BAR], [1.0, 0.1])
    assert 0.1 < share < 0.9
    assert of("negative.setting") == pytest.approx(share, abs=1e-6)
    assert of("positive.setting") == pytest.approx(0.05, abs=1e-6)


def test_the_load_limit_splits_what_the_engine_gives_at_its_speed():
    """Both pumps are asked for all: each takes its share of the torque, and the engine is where the limit meets its governor."""
    of = steady(1.0, flow="60 L/min", other="60 L/min")
    limit = np.clip(350 + 20 * (of("diesel.speed") - 1750 * np.pi / 30), 50, 350)
    D = 71e-6 / (2 * np.pi)
    for name, node, share in (("negative", "left", 0.6), ("positive", "right", 0.4)):
        assert of(f"{name}.setting") < 0.95
        assert of(f"{name}.setting") * D * drop(of, node) == pytest.approx(share * limit, rel=1e-5)
    assert of("diesel.torque") == pytest.approx(limit, rel=1e-5)
    assert of("diesel.speed") == pytest.approx((1 - 0.06 * limit / 450) * 1800 * np.pi / 30, rel=1e-5)


def test_the_cut_off_is_before_the_torque_limit_where_it_is_lower():
    of = steady(1.0, flow="100 L/min", other="10 L/min")
    pressure = drop(of, "right")
    assert of("positive.setting") == pytest.approx(np.interp(pressure, [200 * BAR, 300 * BAR], [1.0, 0.02]), rel=1e-5)
    assert 200 * BAR < pressure < 300 * BAR
