"""Random vibration, transmissibility, shock response spectra and order analysis against closed forms and Lyapunov's equation."""

import numpy as np
import pytest
import scipy.linalg

import nivel
from nivel.errors import ModelError
from nivel.files import parse_machine

# ground - k1, c1 - first - k2, c2 - second, along x
TWO_MASSES = """
format: 1
bodies: {first: {mass: 2, inertia: [1, 1, 1]}, second: {mass: 1, inertia: [1, 1, 1], position: [1, 0, 0]}}
joints:
  low: {type: translational, bodies: [ground, first], point: [0, 0, 0], axis: [1, 0, 0]}
  high: {type: translational, bodies: [first, second], point: [1, 0, 0], axis: [1, 0, 0]}
gravity: [0, 0, 0]
forces:
  base: {type: joint-spring-damper, coordinate: low, stiffness: 800, damping: 4}
  top: {type: joint-spring-damper, coordinate: high, stiffness: 300, damping: 1.5}
simulation: {duration: 1 s, step: 1 ms}
"""
SIMPLE = """
format: 1
bodies: {block: {mass: 2, inertia: [1, 1, 1]}}
joints: {rail: {type: translational, bodies: [ground, block], point: [0, 0, 0], axis: [1, 0, 0]}}
gravity: [0, 0, 0]
forces: {spring: {type: joint-spring-damper, coordinate: rail, stiffness: 500, damping: 6}}
simulation: {duration: 1 s, step: 1 ms}
"""
# a base that a driver moves carries a block on a spring
ON_BASE = """
format: 1
bodies: {plate: {mass: 1, inertia: [1, 1, 1]}, block: {mass: 2, inertia: [1, 1, 1], position: [1, 0, 0]}}
joints:
  floor: {type: translational, bodies: [ground, plate], point: [0, 0, 0], axis: [1, 0, 0]}
  mount: {type: translational, bodies: [plate, block], point: [1, 0, 0], axis: [1, 0, 0]}
gravity: [0, 0, 0]
drivers: {shake: {coordinate: floor, value: "0 m"}}
forces: {spring: {type: joint-spring-damper, coordinate: mount, stiffness: 500, damping: 6}}
simulation: {duration: 1 s, step: 1 ms}
"""


def machine(text):
    return nivel.Machine.from_record(parse_machine(text))


@pytest.fixture(scope="module")
def two():
    return machine(TWO_MASSES).linearise(inputs=["second.force.x"], outputs=["first.position.x", "second.position.x"])


def test_white_noise_on_two_masses_has_the_rms_of_lyapunovs_equation(two):
    """M ẍ + D ẋ + K x = f, f on the second mass of one-sided density S: A P + P Aᵀ + B (S/2) Bᵀ = 0 with the book's matrices.
    A wide band comes to the same by quadrature: what is beyond f₁ falls with f⁻⁴ and is below (f/f₁)³ of it."""
    m, k, d = np.diag([2.0, 1.0]), np.array([[1100.0, -300.0], [-300.0, 300.0]]), np.array([[5.5, -1.5], [-1.5, 1.5]])
    zero, one = np.zeros((2, 2)), np.eye(2)
    a = np.block([[zero, one], [-np.linalg.solve(m, k), -np.linalg.solve(m, d)]])
    b = np.concatenate([np.zeros(2), np.linalg.solve(m, [0.0, 1.0])])[:, None]
    covariance = scipy.linalg.solve_continuous_lyapunov(a, -0.5 * 0.3 * b @ b.T)
    wanted = np.sqrt(np.diagonal(covariance)[:2])
    white = two.random_response({"second.force.x": 0.3})
    assert white.rms.values == pytest.approx(wanted, rel=1e-9)
    band = two.random_response({"second.force.x": ([1e-6, 1e4], [0.3, 0.3])})
    assert band.rms.values == pytest.approx(wanted, rel=1e-6)
    assert band.psd.dims == ("frequency", "output")
    summed = np.sqrt(np.trapezoid(band.psd.values[:, 1], band.frequency.values))
    assert summed == pytest.approx(wanted[1], rel=0.05)  # the density as it is drawn


def test_one_mass_has_the_closed_form_and_its_units_are_those_of_the_density(tmp_path):
    """σ² = S/(4 c k) for a force of one-sided density S on m ẍ + c ẋ + k x."""
    model = machine(SIMPLE).linearise(inputs=["block.force.x"], outputs=["rail", "block.velocity.x"])
    rms = np.sqrt(0.01 / (4.0 * 6.0 * 500.0))
    assert model.random_response({"block.force.x": "0.01 N^2/Hz"}).rms.values[0] == pytest.approx(rms, rel=1e-9)
    # σ² of the velocity: S/(4 c m)
    assert model.random_response({"block.force.x": 0.01}).rms.values[1] == pytest.approx(
        np.sqrt(0.01 / (4.0 * 6.0 * 2.0)), rel=1e-9
    )
    (tmp_path / "floor.csv").write_text("frequency [Hz],block.force.x [N^2/Hz]\n0.000001,0.01\n10000,0.01\n")
    found = model.random_response(tmp_path / "floor.csv")
    assert found.rms.values[0] == pytest.approx(rms, rel=1e-6)
    assert model.random_response({"block.force.x": str(tmp_path / "floor.csv")}).rms.values == pytest.approx(
        found.rms.values
    )


def test_slopes_of_a_spectrum_are_straight_in_logarithms(two):
    """S = s f² between 1 and 4 Hz and nothing beyond: the integral of |G|² S by another quadrature."""
    found = two.random_response({"second.force.x": ([1.0, 4.0], [0.5, 8.0])})
    f = np.linspace(1.0, 4.0, 200_001)
    gain = np.abs(two.frequency_response(f).to_numpy()[:, :, 0]) ** 2
    wanted = np.sqrt(np.trapezoid(gain * (0.5 * f**2)[:, None], f, axis=0))
    assert found.rms.values == pytest.approx(wanted, rel=1e-7)


def test_transmissibility_of_a_mount_is_that_of_the_book():
    """T = (k + iωc)/(k - m ω² + iωc), block over base (Den Hartog); the acceleration of the base is the input."""
    model = machine(ON_BASE).linearise(inputs=["shake"], outputs=["block.position.x", "plate.position.x"])
    f = np.array([0.5, 2.0, 2.5, 3.0, 10.0])
    found = model.transmissibility("plate.position.x", frequencies=f).sel(output="block.position.x").to_numpy()
    w = 2j * np.pi * f
    assert found == pytest.approx((500.0 + w * 6.0) / (500.0 + 2.0 * w**2 + w * 6.0), rel=1e-9)


@pytest.mark.parametrize(
    ("text", "given", "message"),
    [
        (SIMPLE, {"block.forces.x": 1.0}, "did you mean"),
        (SIMPLE, {"block.force.x": "1 N"}, "the number is in"),
        (SIMPLE, {"block.force.x": -1.0}, "above zero"),
        (SIMPLE, {"block.force.x": ([2, 1], [1, 1])}, "ascending"),
        (SIMPLE, {}, "no input"),
        (SIMPLE.replace("damping: 6", "damping: 0"), {"block.force.x": 1.0}, "nothing damps"),
        (SIMPLE.replace("stiffness: 500", "stiffness: 0"), {"block.force.x": 1.0}, "without end"),
    ],
)
def test_spectra_that_do_not_fit_are_refused(text, given, message):
    model = machine(text).linearise(inputs=["block.force.x"], outputs=["rail"])
    with pytest.raises(ModelError, match=message):
        model.random_response(given)


def shaken(signal, duration, interval="0.5 ms"):
    """A run of a free block whose acceleration is a function of time."""
    return machine(f"""
format: 1
bodies: {{block: {{mass: 1, inertia: [1, 1, 1]}}}}
joints: {{rail: {{type: translational, bodies: [ground, block], point: [0, 0, 0], axis: [1, 0, 0]}}}}
gravity: [0, 0, 0]
forces: {{push: {{type: force, body: block, vector: ["{signal}", 0, 0]}}}}
sensors: {{felt: {{coordinate: rail.displacement, quantity: acceleration}}}}
simulation: {{duration: {duration} s, step: 0.5 ms, output_interval: {interval}, integrator: rk4}}
""").simulate(verify=False)


def test_the_shock_response_spectrum_of_half_a_sine_is_that_of_its_closed_form():
    """ÿ + ω² y = ω² a sin Ωt for 0 < t < π/Ω: y = a (sin Ωt - (Ω/ω) sin ωt)/(1 - (Ω/ω)²), afterwards a free vibration."""
    length, height = 0.02, 30.0
    result = shaken("30 N * sin(3.141592653589793 * time / (0.02 s))", length)
    frequencies = np.array([5.0, 20.0, 40.0, 90.0])
    found = result.shock_response_spectrum("sensor.felt", frequencies, damping=0.0).to_numpy()
    wanted = []
    for omega in 2.0 * np.pi * frequencies:
        ratio = np.pi / length / omega
        t = np.linspace(0.0, length, 200_001)
        y = height * (np.sin(np.pi * t / length) - ratio * np.sin(omega * t)) / (1.0 - ratio**2)
        rate = height * (np.pi / length) * (np.cos(np.pi) - np.cos(omega * length)) / (1.0 - ratio**2)
        wanted.append(max(np.abs(y).max(), np.hypot(y[-1], rate / omega)))
    assert found == pytest.approx(wanted, rel=2e-3)  # straight lines between samples: (ω step)²/8


@pytest.mark.parametrize(("interval", "is_told"), [("0.5 ms", False), ("2 ms", True), ("5 ms", True), ("20 ms", True)])
def test_a_shock_between_frames_is_a_doubt_of_its_spectrum(interval, is_told):
    """1 - cos Ωt for one period, undamped: y'' + ω² y = ω² a (1 - cos Ωt). Frames of 20 ms meet nothing of it."""
    length, height = 0.02, 30.0
    pulse = "30 N * (1 - cos(314.1592653589793*time)) * (time < 0.02)"
    result = shaken(pulse, 0.1, interval)
    frequencies = np.array([5.0, 20.0, 90.0])
    found = result.shock_response_spectrum("sensor.felt", frequencies, damping=0.0)
    wanted, fast = [], 2.0 * np.pi / length
    for omega in 2.0 * np.pi * frequencies:
        t = np.linspace(0.0, length, 200_001)
        part = omega**2 / (omega**2 - fast**2)
        y = height * (1.0 - part * np.cos(fast * t) - (1.0 - part) * np.cos(omega * t))
        rate = height * (1.0 - part) * omega * np.sin(omega * length)
        wanted.append(max(np.abs(y).max(), np.hypot(y[-1], rate / omega)))
    off = np.abs(found.to_numpy() - wanted)
    assert (off < found.doubt.to_numpy() + 2e-3 * np.array(wanted)).all()
    assert ("between frames, which may be off" in found.attrs["headline"]) == is_told


def test_a_vibration_between_frames_is_no_amplitude_of_a_slower_one_without_a_word():
    """Frames of 10 ms see 93 Hz as 7 Hz."""
    fast, slow = (shaken(f"3 N * sin(6.283185307179586*{f}*time)", 2.0, "10 ms") for f in (93, 2))
    told, quiet = (each.waterfall("sensor.felt", resolution=2.0).attrs["headline"] for each in (fast, slow))
    assert "may vibrate faster" in told
    assert "may vibrate faster" not in quiet


def test_a_waterfall_has_the_amplitude_of_a_steady_vibration():
    result = shaken("3 N * sin(6.283185307179586 * 40 * time / (1 s))", 2.0)
    found = result.waterfall("sensor.felt", resolution=2.0)
    assert found.sel(frequency=40.0, method="nearest").to_numpy() == pytest.approx(3.0, rel=1e-4)
    assert found.sel(frequency=100.0, method="nearest").to_numpy() == pytest.approx(0.0, abs=1e-3)


def test_orders_of_a_run_up_stay_where_they_are():
    """A shaft that speeds up evenly, φ = α t²/2, and a signal a cos 3 φ: order 3 has the amplitude a at every speed."""
    result = machine("""
format: 1
bodies: {shaft: {mass: 1, inertia: [1, 1, 1]}, block: {mass: 1, inertia: [1, 1, 1]}}
joints:
  hinge: {type: revolute, bodies: [ground, shaft], point: [0, 0, 0], axis: [0, 0, 1]}
  rail: {type: translational, bodies: [ground, block], point: [0, 0, 0], axis: [1, 0, 0]}
gravity: [0, 0, 0]
forces:
  motor: {type: torque, body: shaft, vector: [0, 0, 20]}
sensors: {shaking: {value: "5 * cos(3 * hinge.angle)", units: "1"}}
simulation: {duration: 4 s, step: 1 ms, output_interval: 1 ms, integrator: rk4}
""").simulate(verify=False)
    found = result.orders("sensor.shaking", "hinge.angle", resolution=0.25, most=8.0)
    third = found.sel(order=3.0, method="nearest").to_numpy()
    assert third == pytest.approx(5.0, rel=1e-3)
    assert found.sel(order=6.0, method="nearest").to_numpy() == pytest.approx(0.0, abs=1e-2)
    assert (np.diff(found.speed) > 0.0).all()
