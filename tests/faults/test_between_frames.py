"""Numbers made from frames: right to their stated doubt, or told, whatever frames are kept; against closed forms of sines."""

from itertools import product
from pathlib import Path

import numpy as np
import pytest

import nivel
from nivel.analysis.sweep.outputs import Task
from nivel.analysis.sweep.variant import run_variant
from nivel.files import parse_machine
from nivel.machine.study.parameter import Reduced
from nivel.results.curve import REDUCTIONS, curve, curve_of, integral_of_magnitude, largest, turning_values

HERE = Path(__file__).parent
OMEGA, PHASE, END = 2.0 * np.pi * 3.0, 0.3, 2.0


def primitive(t):
    """∫ sin(ω t + φ) dt."""
    return -np.cos(OMEGA * t + PHASE) / OMEGA


def primitive_of_square(t):
    """∫ sin² dt."""
    return 0.5 * t - np.sin(2.0 * (OMEGA * t + PHASE)) / (4.0 * OMEGA)


# of sin(ω t + φ) over six periods
SINE = {
    "max": 1.0,
    "min": -1.0,
    "peak": 1.0,
    "mean": 0.0,
    "integral": 0.0,
    "rms": np.sqrt((primitive_of_square(END) - primitive_of_square(0.0)) / END),
}


@pytest.mark.parametrize("frames", [601, 241, 121, 61, 34, 19, 14, 13, 7, 4, 3, 2])
@pytest.mark.parametrize("rates", [2, 1, 0])
def test_numbers_of_a_sine_are_right_to_their_doubt(frames, rates):
    """100 to 0.2 frames a period, 1 and 2 of them among these. rates : derivatives that are known; without any, frames that stand for a
    slower sine cannot tell, and a run has probes."""
    t = np.linspace(0.0, END, frames)
    sine, slope = np.sin(OMEGA * t + PHASE), OMEGA * np.cos(OMEGA * t + PHASE)
    of = curve(t, sine, slope if rates else None, -(OMEGA**2) * sine if rates > 1 else None)
    if rates < 2 and frames < 34:
        return
    for name, wanted in SINE.items():
        found = REDUCTIONS[name](of)
        assert abs(found.value[0] - wanted) <= found.doubt[0] + 1e-12 or of.is_told(found.doubt)[0], name
        assert found.doubt[0] < (1e-3 if frames > 200 else 0.05 if frames > 60 else np.inf), name
    work = integral_of_magnitude(of)
    assert abs(work.value[0] - END * 2.0 / np.pi) <= work.doubt[0] + 1e-3


def test_a_peak_has_its_time_and_its_turns():
    t = np.linspace(0.0, END, 97)
    of = curve(t, np.sin(OMEGA * t + PHASE), OMEGA * np.cos(OMEGA * t + PHASE))
    top = largest(of)
    turns = (top.time[0] * OMEGA + PHASE - 0.5 * np.pi) / (2.0 * np.pi)
    assert turns == pytest.approx(round(turns), abs=1e-4)
    values = turning_values(of)
    assert np.sum(values > 0.9998) == 6
    part = REDUCTIONS["integral"](of.within(0.123, 1.0456))
    assert abs(part.value[0] - primitive(1.0456) + primitive(0.123)) <= part.doubt[0] < 1e-3


def test_a_jump_hides_no_peak_and_swings_nowhere():
    t = np.linspace(0.0, 1.0, 41)
    found = largest(curve(t, np.where(t < 0.5, 0.0, 100.0)))
    assert (found.value[0], found.doubt[0]) == (100.0, 0.0)
    spike = largest(curve(t, np.where(t == 0.5, 100.0, 0.0)))
    assert spike.doubt[0] > 10.0


@pytest.mark.parametrize(
    ("hertz", "positions"), [*product((360, 120, 7.3), (361, 721)), (720, 361), (359, 361), (3, 361)]
)
def test_efforts_of_a_driver_between_positions(hertz, positions):
    """m a ω² of a vibration of 1 mm; positions that meet it at rest are told."""
    machine = nivel.load(HERE / "aliased-driver.yaml")
    driver = machine.record.drivers[0]
    machine = machine.replace(driver.replace(value=f"0.1*time+1e-3*sin(2*pi*{hertz}*time)"))
    found = machine.kinematics(positions=positions)
    force = REDUCTIONS["peak"](curve_of(found, "driver.d.effort"))
    right = abs(force.value[0] - 1e-3 * (2.0 * np.pi * hertz) ** 2) <= force.doubt[0] + 1e-9
    assert right or found.trust.light != "green"
    assert right or "Between positions" in str(found.trust)
    assert found.trust.light == "green" or positions < 20 * hertz


@pytest.mark.parametrize("positions", [None, 361])
def test_positions_that_are_not_asked_for_show_the_motion(positions):
    """m a ω² of 360 Hz, met at rest by 361 positions a second; without a number there are as many as show it."""
    machine, wanted = nivel.load(HERE / "aliased-driver.yaml"), 1e-3 * (2.0 * np.pi * 360.0) ** 2
    efforts = machine.inverse(actuators="r", positions=positions)
    motion = machine.kinematics(positions=positions)
    for found, peak in (
        (efforts, efforts.facts()[0]["peak"]),
        (motion, REDUCTIONS["peak"](curve_of(motion, "driver.d.effort")).value[0]),
    ):
        assert peak == pytest.approx(0.0 if positions else wanted, abs=1e-4, rel=1e-3)
        assert found.trust.light == ("amber" if positions else "green")


@pytest.mark.parametrize("positions", [None, 361, 5761])
@pytest.mark.parametrize(
    ("law", "peak"),
    [
        # A exp(-(t/w)²) bends by 2 A/w²; a vibration with 1.6 positions a period is everywhere between its neighbours
        *((f"0.1*exp(-((time-0.4013)/{width})^2)", 0.2 / width**2) for width in (4e-2, 4e-4, 2e-5)),
        ("1e-3*sin(2*pi*3600*time)", 1e-3 * (2.0 * np.pi * 3600.0) ** 2),
    ],
)
def test_pulses_of_drivers_that_no_position_meets_are_told(law, peak, positions):
    machine = nivel.load(HERE / "aliased-driver.yaml")
    found = machine.replace(machine.record.drivers[0].replace(value=law)).kinematics(positions=positions)
    force = REDUCTIONS["peak"](curve_of(found, "driver.d.effort"))
    assert abs(force.value[0] - peak) <= 1e-2 * peak or found.trust.light != "green"


@pytest.mark.compiles
@pytest.mark.parametrize("interval", [0.05, 0.2])
def test_the_slope_of_a_maximum_is_that_of_the_curve(interval):
    """x = v/ω sin ω t, largest v √(m/k): the slope along k is -v √m / (2 k^1.5) = -5e-4."""
    machine = nivel.load(HERE / "gradient-max.yaml")
    outputs = ["max(r.displacement)", "integral(r.displacement)", "rms(r.displacement)"]
    found = machine.gradient(outputs, ["forces.k.stiffness"], output_interval=interval)
    slope = found[f"d({outputs[0]})/d(forces.k.stiffness)"]
    assert float(found[outputs[0]]) == pytest.approx(0.1, abs=1e-8)
    assert abs(float(slope) + 5e-4) <= slope.attrs["estimated_error"] + 1e-10
    assert slope.attrs["verdict"] == "green"
    # ∫ sin(ω t)/ω = (1 - cos ω)/ω², whose derivative along ω is times dω/dk = 1/(2 ω)
    w = 10.0
    wanted = (np.sin(w) / w**2 - 2.0 * (1.0 - np.cos(w)) / w**3) / (2.0 * w)
    whole = found[f"d({outputs[1]})/d(forces.k.stiffness)"]
    assert abs(float(whole) - wanted) <= whole.attrs["estimated_error"] + 1e-10
    assert float(whole) == pytest.approx(wanted, rel=1e-4)


RINGING = """
format: 1
name: ringing
bodies: {a: {mass: 1, inertia: [1, 1, 1], velocity: [3, 0, 0]}}
joints: {r: {type: translational, bodies: [ground, a], point: [0, 0, 0], axis: [1, 0, 0], start: {displacement: 0.1}}}
forces: {coil: {type: joint-spring-damper, coordinate: r, stiffness: (50*pi)^2}}
simulation: {duration: 2, step: 0.5 ms, output_interval: 40 ms, integrator: rk4}
"""


def test_a_run_that_keeps_one_frame_a_period_is_not_green():
    """25 Hz, a frame every 40 ms: each shows the start."""
    result = nivel.Machine.from_record(parse_machine(RINGING)).simulate()
    assert np.ptp(result.array("r.displacement")) < 1e-3
    assert any("m beyond what frames show" in each.text and each.verdict == "amber" for each in result.trust.items)
    assert "peak power of force.coil between frames" in str(result.powers().attrs["headline"])


@pytest.mark.parametrize("interval", [1.0, 3.0])
def test_a_run_that_keeps_a_few_frames_of_many_periods_is_not_green(interval):
    """25 Hz; frames so few that no polynomial goes through five of them are held against probes too."""
    result = nivel.Machine.from_record(parse_machine(RINGING)).simulate(duration=3.0, output_interval=interval)
    assert result.trust.light != "green"
    assert any("beyond what frames show" in each.text for each in result.trust.items if each.verdict == "amber")


def test_outputs_of_studies_do_not_depend_on_frames():
    """Amplitude √(x₀² + (v₀/ω)²), and the spring's largest tension and mean square."""
    machine = nivel.Machine.from_record(parse_machine(RINGING))
    asked = {"x": ("peak", "r.displacement"), "f": ("max", "force.coil.magnitude"), "r": ("rms", "r.displacement")}
    outputs = {name: Reduced(type=kind, of=of) for name, (kind, of) in asked.items()}
    found = run_variant(Task(machine, outputs=outputs), {"bodies.a.mass": 1.0}).outputs
    size = np.hypot(0.1, 3.0 / (50.0 * np.pi))
    for name, wanted in (("x", size), ("f", size * (50.0 * np.pi) ** 2), ("r", size / np.sqrt(2.0))):
        assert found[name].value == pytest.approx(wanted, rel=2e-3 if name == "f" else 2e-4)


STRUCK = """
format: 1
gravity: [0, 0, 0]
bodies: {a: {mass: 1, inertia: [1, 1, 1], velocity: [2, 0, 0]}}
joints: {r: {type: translational, bodies: [ground, a], point: [0, 0, 0], axis: [1, 0, 0]}}
forces: {wall: {type: stop, coordinate: r, upper: 0.5, stiffness: 1e6, restitution: 1}}
simulation: {duration: 0.6, output_interval: 50 ms}
"""


def test_numbers_over_time_of_a_short_pulse_are_right_or_open():
    """A blow of π ms has the impulse 2 m v, the work 0 and the mean square (v √(k m))²/2 over its part of the time."""
    right = {
        "integral": (-4.0, "magnitude"),
        "mean": (-4.0 / 0.6, "magnitude"),
        "rms": (2000.0 * np.sqrt(np.pi / 1200.0), "magnitude"),
    }
    outputs = {kind: Reduced(type=kind, of=f"force.wall.{of}") for kind, (_, of) in right.items()}
    outputs["work"], right["work"] = Reduced(type="integral", of="force.wall.power"), (0.0, "power")
    row = run_variant(Task(nivel.Machine.from_record(parse_machine(STRUCK)), outputs=outputs), {"bodies.a.mass": 1.0})
    sizes = {"integral": 4.0, "mean": 4.0 / 0.6, "rms": right["rms"][0], "work": 4.0}
    for name, (wanted, _) in right.items():
        found = row.outputs[name]
        assert abs(found.value - wanted) < max(found.doubt, 1e-3 * sizes[name])
        assert found.doubt > 0.0


SWUNG = """
format: 1
gravity: [0, 0, 0]
bodies: {a: {mass: 1, inertia: [0.1, 0.1, 0.1], position: [1, 0, 0]}}
joints: {r: {type: revolute, bodies: [ground, a], point: [0, 0, 0], axis: [0, 0, 1], start_rates: {angle: 2}}}
forces: {wall: {type: stop, coordinate: r, upper: 0.53, stiffness: 1e6, restitution: 1}}
simulation: {duration: 0.6}
"""


@pytest.mark.parametrize(
    ("interval", "settings"), [(1e-2, {}), (1e-2, {"integrator": "rk4", "step": 5e-5}), (1e-4, {})]
)
def test_loads_of_a_blow_that_no_frame_shows_are_open(interval, settings):
    """The stop brings 2 J ω √(K/J) to an arm with J = 1.1 kg m², of which the hinge bears 1/1.1 m; it lasts 3.3 ms."""
    result = nivel.Machine.from_record(parse_machine(SWUNG)).simulate(verify=True, output_interval=interval, **settings)
    hinge = 2.0 * np.sqrt(1e6 / 1.1)
    loads, found = result.reactions(), float(result.reactions().peak_force[0])
    if interval < 1e-3:
        assert found == pytest.approx(hinge, rel=2e-3)
        return
    assert found < 0.01 * hinge
    for each in (loads, result.powers(), result.cycles("r.force.x")):
        assert each.attrs["verdict"] != "green"
        assert "an impact between frames, on a at t = 0.26 s" in str(each.attrs["headline"])


RAIL = """
format: 1
gravity: [0, 0, 0]
bodies: {a: {mass: 1, inertia: [1, 1, 1], velocity: [VELOCITY, 0, 0]}}
joints: {r: {type: translational, bodies: [ground, a], point: [0, 0, 0], axis: [1, 0, 0]}}
MORE
simulation: {duration: 20}
"""
HELD = 'drivers: {d: {coordinate: r, value: "VELOCITY*time"}}\n'
PUSHED = 'forces: {f: {type: motor, coordinate: r, effort: "LAW"}}'


@pytest.mark.parametrize(
    ("velocity", "more", "law"),
    [
        (0.1, HELD + PUSHED, "step(time, 2.509, 0, 2.51, 100) - step(time, 2.51, 0, 2.511, 100)"),
        (10, HELD + PUSHED, "if(abs(r.displacement - 30.1) < 1e-3, 100, 0)"),
        (
            0.1,
            HELD
            + 'control: {c: {type: gain, input: "LAW", gain: 1, sample_time: 1 ms, units: N}}\n'
            + PUSHED.replace("LAW", "c"),
            "if(abs(time - 2.51) < 2.2e-3, 100, 0)",
        ),
    ],
)
def test_pulses_that_no_frame_meets_and_that_move_nothing_are_told(velocity, more, law):
    """A pulse of 100 N in 2 ms, between frames 20 ms apart, that a driver bears: neither frames, nor accelerations, nor probes show it."""

    def machine_of(law):
        text = RAIL.replace("MORE", more).replace("LAW", law).replace("VELOCITY", str(velocity))
        return nivel.Machine.from_record(parse_machine(text))

    outputs = {"most": Reduced(type="peak", of="driver.d.effort"), "work": Reduced(type="integral", of="force.f.power")}
    row = run_variant(Task(machine_of(law), outputs=outputs, verify=True), {})
    assert row.outputs["most"].value < 1.0
    assert row.verdict != "green"
    assert "a pulse of " in row.headline
    slope = machine_of(law).gradient("peak(driver.d.effort)", "bodies.a.mass")
    assert slope.attrs["verdict"] == "amber"
    assert "a pulse of " in slope.attrs["headline"]
    assert machine_of("100*sin(time)").simulate(verify=True).powers().attrs["verdict"] == "green"


@pytest.mark.parametrize("before", [100.0137, 100.1])
def test_the_least_distance_of_a_passage_is_right_or_open(before):
    """0.01 m at 50 m/s, between frames 0.2 m apart: little beside a range of 100 m, and many times the number itself."""
    text = f"""
format: 1
gravity: [0, 0, 0]
bodies: {{a: {{mass: 1, inertia: [1, 1, 1], velocity: [50, 0, 0], position: [-{before}, 0.01, 0]}}}}
markers: {{m: {{body: a}}, o: {{body: ground}}}}
sensors: {{d: {{distance: [o, m]}}}}
simulation: {{duration: 4}}
"""
    outputs = {"least": Reduced(type="min", of="sensor.d.distance")}
    row = run_variant(Task(nivel.Machine.from_record(parse_machine(text)), outputs=outputs, verify=True), {})
    assert row.outputs["least"].value == pytest.approx(0.01, rel=1e-2) or row.verdict != "green"
