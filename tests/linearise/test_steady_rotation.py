"""Vibrations about a steady rotation: hinged blades and their coning, rotating beams and flexible bodies, against independent solutions."""

import numpy as np
import pytest
from numpy.polynomial import Polynomial
from scipy.linalg import eigh
from scipy.optimize import brentq

from models import bar, reduced
from nivel.errors import ModelError
from nivel.flexible.body.body_file import write_body
from simulating import machine

OFFSET, LENGTH, MASS, INERTIA, AXIAL, SPEED = 0.2, 1.0, 1.0, 0.1, 0.001, 7.0


def turning(speed, **sections):
    """A hub that a driver turns about z."""
    return {
        "gravity": [0, 0, 0],
        "bodies": {"hub": {"mass": 5, "inertia": [1, 1, 1]}, **sections.pop("bodies", {})},
        "joints": {
            "shaft": {"type": "revolute", "bodies": ["ground", "hub"], "point": [0, 0, 0], "axis": [0, 0, 1]},
            **sections.pop("joints", {}),
        },
        "drivers": {"motor": {"coordinate": "shaft.angle", "value": f"{speed}*time"}},
        **sections,
    }


def hinged_blade(gravity, axis=(0, -1, 0), speed=SPEED):
    blade = {"mass": MASS, "inertia": [AXIAL, INERTIA, INERTIA], "position": [OFFSET + LENGTH / 2, 0, 0]}
    flap = {"type": "revolute", "bodies": ["hub", "blade"], "point": [OFFSET, 0, 0], "axis": list(axis)}
    return turning(speed, bodies={"blade": blade}, joints={"flap": flap}, gravity=[0, 0, -gravity])


def vibrations(model):
    """Angular frequencies of the modes, rising [rad/s]."""
    assert model.steady
    return np.array(sorted(mode.eigenvalue.imag for mode in model.modes if mode.eigenvalue.imag > 1e-6))


@pytest.mark.parametrize("coordinates", ["relative", "absolute"])
@pytest.mark.parametrize("gravity", [0.0, 9.81])
def test_flapping_blade_vibrates_about_its_coning_angle(gravity, coordinates):
    """At the angle b upwards I b̈ = -(I - J) Ω² sin b cos b - e S Ω² sin b - g S cos b about the hinge, with S = m l/2.
    Without gravity ω² = Ω² (1 - J/I + e S/I)."""
    about, S = INERTIA + MASS * (LENGTH / 2) ** 2, MASS * LENGTH / 2

    def moment(b):
        centrifugal = ((about - AXIAL) * np.cos(b) + OFFSET * S) * SPEED**2 * np.sin(b)
        return centrifugal + gravity * S * np.cos(b)

    cone = brentq(moment, -1.5, 1.5)
    stiffness = (moment(cone + 1e-5) - moment(cone - 1e-5)) / 2e-5
    model = machine(hinged_blade(gravity)).linearise(about="rotation", coordinates=coordinates, outputs=["flap.angle"])
    (found,) = vibrations(model)
    assert found == pytest.approx(np.sqrt(stiffness / about), rel=1e-8)


def test_lagging_blade_has_the_frequency_of_its_offset():
    """ω² = Ω² e S/I, a pendulum in the centrifugal field."""
    about, S = INERTIA + MASS * (LENGTH / 2) ** 2, MASS * LENGTH / 2
    (found,) = vibrations(machine(hinged_blade(0.0, axis=(0, 0, 1))).linearise(about="rotation"))
    assert found == pytest.approx(SPEED * np.sqrt(OFFSET * S / about), rel=1e-10)


def rotating_cantilever(EI, mass, length, speed, *, in_plane):
    """The lowest two frequencies [rad/s] by the method of Ritz, ten polynomials x² … x¹¹: E I w'''' - (T w')' = ρA (ω² [+ Ω²]) w with
    T = ρA Ω² (L² - x²)/2."""
    shapes = [Polynomial([0.0] * k + [1.0]) for k in range(2, 12)]
    x = Polynomial([0.0, 1.0])
    tension = 0.5 * mass * (speed * length) ** 2 * (1.0 - x**2)

    def over_length(p):
        return p.integ()(1.0) - p.integ()(0.0)

    bending = np.array([[over_length(a.deriv(2) * b.deriv(2)) for a in shapes] for b in shapes]) * EI / length**3
    stretching = np.array([[over_length(tension * a.deriv() * b.deriv()) for a in shapes] for b in shapes]) / length
    M = np.array([[over_length(a * b) for a in shapes] for b in shapes]) * mass * length
    squares = eigh(bending + stretching, M, eigvals_only=True)[:2]
    return np.sqrt(squares - (speed**2 if in_plane else 0.0))


def test_reference_has_the_published_frequencies():
    """Wright, Smith, Thresher, Wang 1982, uniform beam without a hub: 3.5160, 22.0345 at rest; 4.1373 at 2, 13.1702 at 12 √(EI/ρA)/L²."""
    known = {0.0: [3.5160, 22.0345], 2.0: [4.1373, 22.6149], 12.0: [13.1702, 37.6031]}
    for speed, published in known.items():
        found = rotating_cantilever(1.0, 1.0, 1.0, speed, in_plane=False)
        np.testing.assert_allclose(found, published, atol=6e-5)


@pytest.mark.parametrize(("coordinates", "speed"), [("relative", 0.0), ("relative", 12.0), ("absolute", 2.0)])
def test_rotating_beam_vibrates_as_the_theory_of_rotating_beams_says(coordinates, speed):
    """E I = 100 N m² across the plane and 200 N m² in it, 1 kg/m, 1 m. The beam is stretched by 7e-5 at the highest speed."""
    section = {"type": "general", "stiffness": [1e8, 1e8, 1e8, 1e3, 100, 200], "mass": 1, "inertia": [2e-8, 1e-8, 1e-8]}
    beam = {"from": [0, 0, 0], "to": [1, 0, 0], "elements": 3, "order": 3, "section": section}
    root = {"type": "fixed", "bodies": ["hub", "blade.start"], "point": [0, 0, 0]}
    blade = turning(10.0 * speed, beams={"blade": beam}, joints={"root": root})
    found = vibrations(machine(blade).linearise(about="rotation", coordinates=coordinates, verify=False))
    across = rotating_cantilever(100.0, 1.0, 1.0, 10.0 * speed, in_plane=False)
    within = rotating_cantilever(200.0, 1.0, 1.0, 10.0 * speed, in_plane=True)
    np.testing.assert_allclose(found[:4], np.sort([*across, *within]), rtol=3e-4)


@pytest.mark.parametrize(("speed", "modes"), [(30.0, 8), (200.0, 14)])
@pytest.mark.parametrize("coordinates", ["relative", "absolute"])
def test_flexible_blade_has_its_frequencies_in_all_coordinates(coordinates, speed, modes, tmp_path):
    """Steel, 1 m, 5 mm across the plane and 40 mm in it; the reduction leaves out what is above its modes. At 200 rad/s, 7.6 times
    the lowest frequency at rest, the second vibration is that in the plane."""
    E, rho, width, height = 210e9, 7850.0, 0.04, 0.005
    body, _ = reduced(bar(length=1.0, width=width, height=height, reduction=f"modes: {modes}, stiffening: true"))
    write_body(body, tmp_path / "blade.nc")
    bodies = {"blade": {"flexible": {"file": str(tmp_path / "blade.nc")}}}
    joints = {"root": {"type": "fixed", "bodies": ["hub", "blade"], "interface": "root"}}
    model = machine(turning(speed, bodies=bodies, joints=joints)).linearise(about="rotation", coordinates=coordinates)
    across = rotating_cantilever(E * width * height**3 / 12, rho * width * height, 1.0, speed, in_plane=False)
    within = rotating_cantilever(E * height * width**3 / 12, rho * width * height, 1.0, speed, in_plane=True)
    expected = np.sort([*across, within[0]])
    np.testing.assert_allclose(vibrations(model)[:3], expected, rtol=2e-3)
    assert model.stable
    assert model.trust.light == "green"


def test_machines_without_a_steady_rotation_are_refused_in_words():
    across = {**hinged_blade(0.0), "gravity": [0, -9.81, 0]}
    with pytest.raises(ModelError, match="gravity acts across the axis"):
        machine(across).linearise(about="rotation")
    flapping = hinged_blade(0.0)
    flapping["drivers"]["other"] = {"coordinate": "flap.angle", "value": "3*time"}
    with pytest.raises(ModelError, match="blade moves along the axis about which it turns"):
        machine(flapping).linearise(about="rotation")
    beside = hinged_blade(0.0)
    beside["bodies"]["rotor"] = {"mass": 1, "inertia": [1, 1, 1], "position": [0, 3, 0]}
    beside["joints"]["axle"] = {
        "type": "revolute",
        "bodies": ["ground", "rotor"],
        "point": [0, 3, 0],
        "axis": [0, 0, 1],
    }
    beside["drivers"]["other"] = {"coordinate": "axle.angle", "value": "3*time"}
    with pytest.raises(ModelError, match="does not turn as one"):
        machine(beside).linearise(about="rotation", coordinates="absolute")
