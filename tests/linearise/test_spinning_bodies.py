"""Small motions of bodies that spin by themselves, in closed form: what a resting observer sees, whatever their phase and sense."""

import numpy as np
import pytest

import nivel

GRAVITY, MASS, HEIGHT, ACROSS, AXIAL = 9.81, 1.0, 0.2, 0.01, 0.008


def top(spin, phase=0.0, axial=AXIAL):
    """A top that sleeps upright on its tip; `axial` and ACROSS : moments of inertia about its centre of mass."""
    body = nivel.Body(
        name="top",
        mass=MASS,
        centre_of_mass=(0, 0, HEIGHT),
        inertia=(ACROSS, ACROSS, axial),
        orientation={"axis": (0, 0, 1), "angle": phase},
        angular_velocity=(0, 0, spin),
    )
    tip = nivel.Joint(name="tip", type="spherical", bodies=("ground", "top"), point=(0, 0, 0))
    return nivel.Machine("top", bodies=[body], joints=[tip], gravity=(0, 0, -GRAVITY))


def vibrations(model):
    return sorted(mode.eigenvalue.imag for mode in model.modes if not mode.structural)


@pytest.mark.parametrize(
    ("spin", "phase", "coordinates"), [(100, 0, "relative"), (-100, 2.1, "relative"), (100, 1, "absolute")]
)
def test_a_sleeping_top_has_the_frequencies_that_are_seen_from_the_ground(spin, phase, coordinates):
    """T ω² - A s ω + m g h = 0, T about the tip (Goldstein, section 5.7); its own axes see the spin s less."""
    model = top(spin, phase).linearise(coordinates=coordinates)
    wanted = np.roots([ACROSS + MASS * HEIGHT**2, -AXIAL * abs(spin), MASS * GRAVITY * HEIGHT])
    np.testing.assert_allclose(vibrations(model), sorted(wanted), rtol=1e-10)
    assert model.steady
    assert sum(model.structural) == 2
    assert "do not spin" in model.notes[-1]


def test_a_top_that_is_too_slow_falls_from_its_sleep():
    """A² s² < 4 T m g h: the roots of the same equation are complex."""
    model = top(30.0).linearise()
    roots = np.roots([ACROSS + MASS * HEIGHT**2, -AXIAL * 30.0, MASS * GRAVITY * HEIGHT])
    assert not model.stable
    np.testing.assert_allclose(max(model.eigenvalues.real), max(abs(roots.imag)), rtol=1e-9)


def test_an_unsymmetrical_body_is_seen_from_its_own_axes_and_says_so():
    """Euler's equations about the middle axis: λ² = s² (b - a)(c - b)/(a c) grows (Landau, Lifshitz, section 37)."""
    a, b, c, spin = 0.1, 0.15, 0.2, 3.0
    body = nivel.Body(name="box", mass=1, inertia=(a, b, c), angular_velocity=(0, spin, 0), velocity=(1, 0, 2))
    model = nivel.Machine("box", bodies=[body]).linearise()
    assert model.steady
    np.testing.assert_allclose(max(model.eigenvalues.real), spin * np.sqrt((b - a) * (c - b) / (a * c)), rtol=1e-9)
    assert "axes that turn with it" in model.notes[-1]


def coin(lean, turn, phase=0.0, mirrored=1.0):
    """A sharp disc that rolls in its steady circle, its axle `lean` from level; and the coefficients of its sway."""
    r, m = 0.3, 2.0
    C, A = 0.5 * m * r**2, 0.25 * m * r**2
    # θ from the vertical to the axle, u the rate of turning, w the speed about the axle
    theta = 0.5 * np.pi - lean
    s, c = np.sin(theta), np.cos(theta)
    w = (A * turn**2 * s * c - m * GRAVITY * r * c) / ((C + m * r**2) * turn * s)
    axle = np.array([0.0, s, c])
    up = np.array([0.0, -c, s])
    omega = w * axle + turn * s * up
    place = r * up
    turned = {"matrix": np.array([[1, 0, 0], [0, -up[1], s], [0, -up[2], c]]).tolist()}
    body = nivel.Body(
        name="coin",
        mass=m,
        inertia=(A, A, C),
        position=tuple(place),
        orientation=turned if not phase else {"matrix": (np.array(turned["matrix"]) @ about_z(phase)).tolist()},
        velocity=tuple(np.cross(omega, place)),
        angular_velocity=tuple(omega),
    )
    floor = nivel.Joint(
        name="floor",
        type="rolling",
        bodies=("ground", "coin"),
        points=((0, 0, 0), tuple(place)),
        axes=((0, 0, 1), tuple(mirrored * axle)),
        radius=r,
    )
    slope = A * turn**2 * np.cos(2 * theta) - (C + m * r**2) * turn * c * w + m * GRAVITY * r * s
    by_turn = 2 * A * turn * s * c - (C + m * r**2) * s * w
    by_spin = -(C + m * r**2) * turn * s
    square = slope + by_turn * (C * w / (A * s) - 2 * turn * c / s) + by_spin * m * r**2 * turn * s / (C + m * r**2)
    machine = nivel.Machine("coin", bodies=[body], joints=[floor], gravity=(0, 0, -GRAVITY))
    return machine, square / (A + m * r**2)


def about_z(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


@pytest.mark.parametrize(("phase", "mirrored"), [(0.0, 1.0), (0.7, -1.0)])
def test_a_coin_sways_about_its_steady_circle_as_the_equations_of_a_disc_say(phase, mirrored):
    """(A + m r²) θ̈ = A u² sc - (C + m r²) u s w - m g r c,  A (u̇ s + 2 u θ̇ c) = C w θ̇,  (C + m r²) ẇ = m r² θ̇ u s (O'Reilly 1996)."""
    machine, square = coin(0.35, 2.0, phase, mirrored)
    model = machine.linearise()
    assert model.steady
    assert square < 0.0
    turning, sway = vibrations(model)
    np.testing.assert_allclose(sway, np.sqrt(-square), rtol=1e-9)
    np.testing.assert_allclose(turning, 2.0, rtol=1e-9)
    assert "± 2i" in model.notes[-1]


def test_a_coin_that_sways_already_has_no_eigenvalues():
    machine, _ = coin(0.35, 2.0)
    body = machine.record.bodies[0]
    omega = np.add(body.angular_velocity, (0.3, 0.0, 0.0))
    velocity = np.cross(omega, body.position)
    swaying = nivel.Machine.from_record(
        machine.record.replace(bodies=(body.replace(angular_velocity=tuple(omega), velocity=tuple(velocity)),))
    )
    assert not swaying.linearise().steady


def test_a_rounded_steady_circle_is_judged_though_it_is_unstable():
    """A slow disc falls out of its circle from the last digit that is given: λ² of its sway is positive."""
    machine, square = coin(0.05, 1.5)
    body = machine.record.bodies[0]
    rounded = body.replace(
        angular_velocity=tuple(round(x, 7) for x in body.angular_velocity),
        velocity=tuple(round(x, 7) for x in body.velocity),
    )
    model = nivel.Machine.from_record(machine.record.replace(bodies=(rounded,))).linearise()
    assert model.steady
    assert not model.stable
    assert int(model.structural.sum()) == 4
    np.testing.assert_allclose(max(model.eigenvalues.real), np.sqrt(square), rtol=1e-5)


@pytest.mark.parametrize(
    ("lean", "turn"), [(0.35, 0.2), (-0.1, 0.3), (0.35, 0.01), (-0.1, 0.1), (0.01, 0.01), (0.01, 0.03)]
)
def test_slow_circles_are_judged(lean, turn):
    """Heading, spin and the rates of both are zeros, whatever the rolling speed is beside that of turning."""
    machine, square = coin(lean, turn)
    model = machine.linearise()
    assert model.steady
    assert int(model.structural.sum()) == 4
    assert model.stable
    np.testing.assert_allclose(max(model.eigenvalues.imag), np.sqrt(-square), rtol=1e-8)


def test_what_is_not_steady_has_no_eigenvalues_to_read():
    machine, _ = coin(0.35, 2.0)
    body = machine.record.bodies[0]
    omega = np.add(body.angular_velocity, (2e-3, 0.0, 0.0))
    swaying = body.replace(angular_velocity=tuple(omega), velocity=tuple(np.cross(omega, body.position)))
    model = nivel.Machine.from_record(machine.record.replace(bodies=(swaying,))).linearise()
    assert not model.steady
    assert np.isnan(model.eigenvalues).all()
    assert np.isnan(model.to_xarray()["eigenvalue_real"]).all()
    assert not model.modes
    assert not model.stable
    assert np.isfinite(model.A).all()
    with pytest.raises(nivel.ModelError, match="describe no motion"):
        model.mode(1)
