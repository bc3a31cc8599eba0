"""Beams in absolute nodal coordinates: mass, tangents, objectivity, statics, vibrations and motion against closed forms, a published
element of another code, and geometrically exact beams."""

import json
from itertools import pairwise

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq, fsolve
from scipy.spatial.transform import Rotation

from beams import forces, prepared, trust
from gradient_beams import EI, LENGTH, MODELS, bodies_of_nodes, cantilever, deformed, flying, in_motion, section
from nivel.analysis.assembly import implicit
from nivel.analysis.plan.beam_facts import beam_facts
from nivel.errors import ModelError, SolveError
from nivel.kernels.output.observe import observe
from references.flexible_pendulum import TIP
from simulating import machine, simulate
from test_beam_elements import moved
from unknowns import Unknowns

pytestmark = pytest.mark.covering

BOTH = pytest.mark.parametrize("model", MODELS)


# --- equations ---


@BOTH
def test_matrix_is_the_derivative_of_the_residual(model, rng):
    sections = cantilever(model, None, 3, damping=0.01)
    sections["beams"]["rod"]["section"] = section(model, 100.0, 50.0, 8.0, 10.0)
    here = in_motion({**sections, "gravity": [1, 2, -3]}, rng)
    modal = slice(6 * here.motion.system.body_count, here.n)
    measure = np.ones(here.n)
    measure[modal] = here.motion.system.modal_sizes()
    for change in (None, 0.1 * measure * rng.uniform(-0.5, 0.5, here.n)):
        unknowns = Unknowns(here, change)
        widths = unknowns.widths()
        widths[: here.n] *= measure
        unknowns.widths = lambda widths=widths: widths
        assert unknowns.error() < 1e-10


@BOTH
@pytest.mark.parametrize("angle", [0.4, 3.1, 6.0, 40.0])
def test_rigid_rotations_of_any_size_change_no_strain(model, angle):
    ready = prepared(flying(model))
    motion, rng = ready.motion, np.random.default_rng(5)
    y = deformed(motion, ready.start, seed=1)
    axis = rng.standard_normal(3)
    turn = Rotation.from_rotvec(angle * axis / np.linalg.norm(axis))
    energy, wrench = forces(motion, y)
    turned_energy, turned_wrench = forces(motion, moved(motion, y, turn, rng.standard_normal(3)))
    assert energy > 1.0
    assert_allclose(turned_energy, energy, rtol=1e-11)
    expected = np.hstack([turn.apply(wrench[:, :3]), turn.apply(wrench[:, 3:])])
    assert_allclose(turned_wrench, expected, atol=1e-10 * np.abs(wrench).max())


@BOTH
def test_unstressed_beams_feel_nothing(model):
    ready = prepared(flying(model))
    energy, wrench = forces(ready.motion, ready.start)
    assert energy < 1e-24
    assert np.abs(wrench).max() < 1e-9


@BOTH
def test_forces_and_inertia_are_those_of_one_energy(model):
    """d(T + V)/dt of the equations themselves is zero in any state in motion: differences of the energy along the accelerations."""
    sections = {**flying(model), "gravity": [1.0, -9.81, 3.0]}
    ready = prepared(sections)
    motion = ready.motion
    system = motion.system
    y = deformed(motion, ready.start, seed=3, size=0.05)
    rate = np.zeros_like(y)
    assert motion.kernels.evaluate(motion.handle.address, 0.0, y, rate) == 0

    def energy(share):
        moved_on = y + share * rate
        for place, _ in system.map.turns:
            moved_on[place : place + 4] /= np.linalg.norm(moved_on[place : place + 4])
        motion.kernels.evaluate(motion.handle.address, 0.0, moved_on, np.zeros_like(y))
        observe(motion.handle.address, 0.0, moved_on, np.zeros(system.layout.width))
        return np.array(system.record.control.energy[:2])

    h = 1e-5
    change = [(energy(k * h) - energy(-k * h)) / (2 * k * h) for k in (1, 2, 3)]
    kinetic, potential = (15 * change[0] - 6 * change[1] + change[2]) / 10
    assert abs(kinetic) > 1.0
    assert_allclose(kinetic, -potential, rtol=1e-7)


def vectors(machine_, place, axes, modal):
    """(N, w, 3) places and gradients of the nodes of a beam."""
    out = []
    for body, r, A, p in zip(bodies_of_nodes(machine_), place, axes, modal, strict=True):
        tips = np.array([interface.position + interface.phi @ p for interface in body.interfaces])
        reach = body.interfaces[0].position[0]
        out.append(np.vstack([r, (tips / reach) @ A.T]))
    return np.array(out)


@BOTH
def test_kinetic_energy_is_that_of_matter_spread_over_the_beam(model):
    """½ ∫ ρ |ẋ|² dV of x = Σ N_j v_j by quadrature, v̇ by differences, against that of bodies, modes and shared points."""
    sections = flying(model)
    own = machine(sections)
    ready = prepared(sections)
    motion = ready.motion
    system, record = motion.system, motion.system.record
    y = deformed(motion, ready.start, seed=4)
    rate = np.zeros_like(y)
    motion.kernels.evaluate(motion.handle.address, 0.0, y, rate)
    observe(motion.handle.address, 0.0, y, np.zeros(system.layout.width))
    kinetic = float(record.control.energy[0])
    count, modes = system.body_count, len(system.modes)
    width = modes // count

    def at(share):
        z = y + share * rate
        q = z[: 7 * count].reshape(count, 7)
        axes = Rotation.from_quat(q[:, [4, 5, 6, 3]]).as_matrix()
        return vectors(own, q[:, :3], axes, z[7 * count : 7 * count + modes].reshape(count, width))

    h = 1e-4
    speeds = [(at(k * h) - at(-k * h)) / (2 * k * h) for k in (1, 2, 3)]
    v = (15 * speeds[0] - 6 * speeds[1] + speeds[2]) / 10
    beam = own.record.beams[0]
    L = beam.line.length / beam.elements
    xi, weight = np.polynomial.legendre.leggauss(6)
    xi, weight = 0.5 * (xi + 1), 0.5 * weight * L
    m, (_, cy, cz), J = beam.properties.mass, beam.properties.mass_centre, beam.properties.inertia
    # four points of matter with the mass, the centre and the second moments of the section
    total = 0.0
    for a, b in pairwise(v):
        line = (
            np.outer(1 - 3 * xi**2 + 2 * xi**3, a[0]) + L * np.outer(xi - 2 * xi**2 + xi**3, a[1])
            + np.outer(3 * xi**2 - 2 * xi**3, b[0]) + L * np.outer(xi**3 - xi**2, b[1])
        )  # fmt: skip
        if model == "ancf-cable":
            total += 0.5 * m * np.sum(weight * np.sum(line**2, axis=1))
            continue
        y_, z_ = np.sqrt(2 * J[2, 2] / m), np.sqrt(2 * J[1, 1] / m)
        for Y, Z in ((cy + y_, cz), (cy - y_, cz), (cy, cz + z_), (cy, cz - z_)):
            point = line + Y * (np.outer(1 - xi, a[2]) + np.outer(xi, b[2]))
            point += Z * (np.outer(1 - xi, a[3]) + np.outer(xi, b[3]))
            total += 0.5 * 0.25 * m * np.sum(weight * np.sum(point**2, axis=1))
    if model == "ancf-cable":
        # nodes roll about the cable with their share of the sections' inertia
        roll = record.bodies.omega_b[:count, 0]
        shares = L * np.array([0.5, *[1.0] * (count - 2), 0.5])
        total += 0.5 * J[0, 0] * np.sum(shares * roll**2)
    assert_allclose(kinetic, total, rtol=1e-9)


@BOTH
def test_free_fall_is_that_of_all_matter(model):
    """Consistent weights: every vector falls as it should, so nothing is strained."""
    sections = {**flying(model, velocity=[0, 0, 0], angular_velocity=[0, 0, 0]), "gravity": [0, 0, -10]}
    result = simulate(sections, duration=1, step=0.01, integrator="generalised-alpha")
    moved_by = result.array("position")[-1] - result.array("position")[0]
    assert_allclose(moved_by, np.tile([0, 0, -5.0], (5, 1)), atol=1e-10)
    assert np.abs(result.array("modal_coordinate") - result.array("modal_coordinate")[0]).max() < 1e-10


@BOTH
def test_free_flight_keeps_energy_and_momentum_to_the_order_of_the_integrator(model):
    errors = []
    for step in (1e-5, 5e-6):
        simulation = {"duration": 4e-3, "step": step, "integrator": "rk4", "output_interval": 4e-3}
        result = simulate({**flying(model), "simulation": simulation})
        errors.append(trust(result)["energy_error_max"])
    kinetic = float(result.dataset["kinetic_energy"][0])
    assert float(result.dataset["potential_energy"].max()) > 1e-4 * kinetic
    assert errors[1] < 1e-9 * kinetic
    assert errors[1] < errors[0] / 12 or errors[0] < 1e-12 * kinetic


# --- statics ---


def rolled_up(model, elements):
    """(x, y) of the end under M = 2 π EI/L, which would bring it to the start."""
    torque = {"type": "torque", "vector": [0, 0, f"{2 * np.pi * EI / LENGTH}*time"]}
    result = machine(cantilever(model, torque, elements)).statics(duration=1, step=0.1)
    assert len(result.time) == 11
    return result.array("position")[-1, -1, :2]


def end_of_arc(stretch, curvature):
    """(x, y) of the end of an arc with this curvature over unstressed length, stretched."""
    turn = curvature * LENGTH
    return stretch / curvature * np.array([np.sin(turn), 1 - np.cos(turn)])


def arc_of_green(elements):
    """Stretch λ, thickness μ and turn θ' over length that leave ½ EA (½ (λ² - 1))² + ½ k (½ (μ² - 1))² + ½ EI (λ μ θ')² - M θ' stationary:
    what a moment does to a beam with Green's strains, whose fibres here are strained by 3 %; k = EA + 144 EI over the square of the length
    of an element."""
    EA, M = 1e5, 2 * np.pi * EI / LENGTH
    section = EA + 144.0 * EI * (elements / LENGTH) ** 2

    def slopes(z):
        stretch, thick, turn = z
        own = [k * 0.5 * (x**2 - 1) * x for k, x in ((EA, stretch), (section, thick))]
        bent = EI * turn**2 * stretch * thick
        return [own[0] + bent * thick, own[1] + bent * stretch, EI * (stretch * thick) ** 2 * turn - M]

    stretch, _, turn = fsolve(slopes, [1.0, 1.0, M / EI], xtol=1e-13)
    assert 1e-4 < 1 - stretch < 1e-3
    return end_of_arc(stretch, turn)


@pytest.mark.parametrize(
    ("model", "coarse", "order"), [("ancf-cable", 8, 4.0), pytest.param("ancf-beam", 32, 2.0, marks=pytest.mark.full)]
)
def test_rolled_up_to_a_circle_with_the_order_of_the_element(model, coarse, order):
    errors = []
    for elements in (coarse, 2 * coarse):
        expected = np.zeros(2) if model == "ancf-cable" else arc_of_green(elements)
        errors.append(np.linalg.norm(rolled_up(model, elements) - expected))
    assert errors[1] < 0.05
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.25)


@pytest.mark.parametrize(("model", "order"), [("ancf-cable", None), ("ancf-beam", 2.0)])
def test_small_tip_load(model, order):
    """w = P L³/3EI, and P L/GA of a beam: cubic lines have it exactly, linear sections to the second order."""
    load = {"type": "force", "vector": [0, -1e-3, 5e-4]}
    expected = 1e-3 * (LENGTH**3 / (3 * EI) + (LENGTH / 1e5 if order else 0.0))
    errors = []
    for elements in (4, 8):
        tip = machine(cantilever(model, load, elements)).statics().array("position")[0, -1]
        assert tip[2] == pytest.approx(-0.5 * tip[1], rel=1e-6)
        errors.append(abs(-tip[1] / expected - 1.0))
    if order is None:
        assert max(errors) < 1e-5  # the load is not infinitely small
    else:
        assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.1)


def elastica(load):
    """(x, y) of the end of an inextensible cantilever under a transverse dead load: θ'' = -P/EI cos θ, θ(0) = 0, θ'(L) = 0."""

    def shot(bend):
        def rates(_, z):
            return [z[1], -load / EI * np.cos(z[0]), np.cos(z[0]), np.sin(z[0])]

        return solve_ivp(rates, (0, LENGTH), [0.0, bend, 0.0, 0.0], rtol=1e-12, atol=1e-12).y[:, -1]

    bend = brentq(lambda b: shot(b)[1], 0.0, 2.0 * load * LENGTH / EI, xtol=1e-13)
    return shot(bend)[2:]


def test_elastica_of_a_cable():
    """Bent by 8 m of its 10 m; a stretch of 1e-5 is left out."""
    sections = cantilever("ancf-cable", {"type": "force", "vector": [0, "10*time", 0]}, 32)
    sections["beams"]["rod"]["section"]["stiffness"][0] = 1e6
    tip = machine(sections).statics(duration=1, step=0.2).array("position")[-1, -1]
    assert_allclose(tip[:2], elastica(10.0), atol=2e-4)
    assert tip[1] > 7.0


def test_all_gradients_bend_twist_and_shear_as_the_exact_beam():
    """A quarter of a circle out of whose plane a load pulls: bending, torsion and large turns; both converge to one shape."""
    arc = {"from": [0, 0, 0], "via": [7.0710678, 2.9289322, 0], "to": [10, 10, 0]}
    load = {"type": "force", "vector": [0, 0, "4*time"]}

    def tip(model, elements, **more):
        sections = cantilever("ancf-beam", load, elements, **arc, **more)
        sections["beams"]["rod"]["model"] = model
        return machine(sections).statics(duration=1, step=0.25).array("position")[-1, -1]

    exact = tip("geometrically-exact", 24, order=2)
    errors = [np.linalg.norm(tip("ancf-beam", elements) - exact) for elements in (16, 32)]
    assert exact[2] > 6.0
    assert errors[1] < 0.03
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.3)


def test_short_elements_of_a_thick_beam_have_no_critical_load_of_their_own():
    """P L² = 24 EI at a beam ten times as long as high: where the stretch of its sections were not stiffer than the line, 32 elements
    turned back at 20, 64 at 10. The end is where the exact beam's is, but for Green's strains."""

    def tip(model, elements):
        rod = {
            "from": [0, 0, 0],
            "to": [1, 0, 0],
            "section": {"type": "rectangle", "width": 0.1, "height": 0.1},
            "material": {"density": 7850, "youngs_modulus": 2.07e11, "poisson_ratio": 0.3},
            "elements": elements,
            "model": model,
        }
        sections = {
            "beams": {"rod": rod},
            "joints": {"root": {"type": "fixed", "bodies": ["ground", "rod.start"], "point": [0, 0, 0]}},
            "forces": {
                "push": {"type": "force", "body": "rod.end", "vector": [0, f"{24 * 2.07e11 * 1e-4 / 12}*time", 0]}
            },
        }
        result = machine(sections).statics(duration=1, step=0.25)
        assert result.trust.verdict == "green", result
        return result.array("position")[-1, -1]

    assert_allclose(tip("ancf-beam", 32), tip("geometrically-exact", 8), atol=0.05)


def test_sections_of_a_cantilever():
    """Under a tip load: constant shear force, moment P (L - x); under a torque about its line, that."""
    for model in MODELS:
        result = machine(cantilever(model, {"type": "force", "vector": [0, -1e-2, 0]}, 16)).statics()
        of = result.sections("rod")
        x = of["share"].values * LENGTH
        assert_allclose(of["moment"].values[-1, :, 2], -1e-2 * (LENGTH - x), atol=4e-3)
        assert_allclose(of["force"].values[-1, :, 1].mean(), -1e-2, rtol=1e-2)
        assert float(of["energy"][-1]) == pytest.approx(float(result.array("potential_energy")[-1]), rel=1e-9)
        result = machine(cantilever(model, {"type": "torque", "vector": [1.0, 0, 0]}, 4)).statics()
        assert_allclose(result.sections("rod")["moment"].values[-1, :, 0], 1.0, rtol=1e-3)
        turned = result.array("orientation")[-1, -1]
        assert 2 * np.arctan2(turned[1], turned[0]) == pytest.approx(LENGTH / 80.0, rel=1e-3)


def test_a_hanging_cable_is_a_catenary():
    """Between two points on one level, 8 m apart, 10 m long: y = a cosh(x/a), sag from its length; bending is 1e-3 of the weight."""
    a = brentq(lambda a: 2 * a * np.sinh(4 / a) - 10.0, 1.0, 100.0)
    sag = a * (np.cosh(4 / a) - 1)
    beam = {"from": [0, 0, 0], "to": [10, 0, 0], "model": "ancf-cable", "elements": 20, "stations": {"middle": 0.5}}
    own = section("ancf-cable", 1e6, 1e6, 0.3, 0.3)
    ends = {
        "left": {"type": "revolute", "bodies": ["ground", "rope.start"], "point": [0, 0, 0], "axis": [0, 1, 0]},
        "right": {"type": "translational", "bodies": ["ground", "slider"], "point": [10, 0, 0], "axis": [1, 0, 0]},
        "eye": {"type": "spherical", "bodies": ["slider", "rope.end"], "point": [10, 0, 0]},
    }
    sections = {
        "gravity": [0, 0, -9.81],
        "bodies": {"slider": {"mass": 1.0, "inertia": [1, 1, 1], "position": [10, 0, 0]}},
        "beams": {"rope": {**beam, "section": own}},
        "joints": ends,
        "drivers": {"pull": {"coordinate": "right.displacement", "value": "-2*time"}},
    }
    result = machine(sections).statics(duration=1, step=0.1)
    middle = result["rope.middle.position"].values[-1]
    assert middle[2] == pytest.approx(-sag, rel=2e-3)
    assert middle[0] == pytest.approx(4.0, abs=1e-3)
    # horizontal force of a catenary: w a
    assert abs(float(result["left.force"].values[-1, 0])) == pytest.approx(9.81 * a, rel=2e-3)


# --- vibrations ---


@BOTH
def test_lowest_frequencies_of_a_cantilever(model):
    """Bending β² √(EI/m L⁴), β = 1.875, 4.694; twist √(GJ/J)/4L, stretch √(EA/m)/4L: shear and the turning of sections take 1e-3."""
    sections = cantilever(model, None, 12)
    sections["beams"]["rod"]["section"] = section(model, 1e7, 1e7, 80.0, EI, 1.0, 1e-3)
    result = machine(sections).statics(modes=14)
    found = np.sort(result.array("natural_frequency").ravel())
    bending = np.array([1.875104, 4.694091]) ** 2 * np.sqrt(EI / LENGTH**4) / (2 * np.pi)
    for expected in bending:
        near = np.sort(np.abs(found / expected - 1))
        assert near[1] < 2e-2 if model == "ancf-beam" else near[1] < 2e-3  # in both planes
    twist = np.sqrt(80.0 / 2e-3) / (4 * LENGTH)
    assert np.abs(found / twist - 1).min() < 2e-3


@BOTH
def test_no_vibration_is_faster_than_the_fastest_element(model):
    sections = cantilever(model, None, 3)
    beam = machine(sections).record.beams[0]
    ready = prepared(sections)
    own = ready.motion.system.record.residual
    own.y[:], own.vdot[:], own.lam[:] = ready.start, 0.0, 0.0
    n = len(own.vdot)
    _, mass = implicit.find_tangent(ready.motion, 0.0, 0.0, 0.0, 0.0)
    _, both = implicit.find_tangent(ready.motion, 0.0, 1.0, 0.0, 0.0)
    M, K = mass[:n, :n], (both - mass)[:n, :n]
    assert_allclose(M, M.T, atol=1e-12 * np.abs(M).max())
    assert np.linalg.eigvalsh(M).min() > 0.0
    fastest = np.sqrt(np.linalg.eigvals(np.linalg.solve(M, K)).real.max()) / (2 * np.pi)
    claimed = beam_facts(beam).fastest
    assert 0.5 * claimed < fastest <= claimed * (1 + 1e-9)


# --- motion ---


def pendulum(model, elements, step):
    """The flexible pendulum: a steel bar of 2 m released from the horizontal."""
    return simulate(
        {
            "gravity": [0, -9.81, 0],
            "beams": {
                "bar": {
                    "from": [0, 0, 0],
                    "to": [2, 0, 0],
                    "section": {"type": "rectangle", "width": 0.01, "height": 0.01},
                    "material": {"youngs_modulus": 2.07e11, "poisson_ratio": 0.3, "density": 7801},
                    "elements": elements,
                    "model": model,
                }
            },
            "joints": {"pin": {"type": "revolute", "bodies": ["ground", "bar.start"], "point": [0, 0, 0], "axis": [0, 0, 1]}},
        },
        duration=2,
        step=step,
        output_interval=0.1,
        integrator="generalised-alpha",
    )  # fmt: skip


@pytest.mark.parametrize(
    ("model", "step", "within"),
    [("ancf-cable", 2.5e-4, 4e-5), ("ancf-beam", 1e-3, 8e-4)],
)
@pytest.mark.full
def test_flexible_pendulum_is_that_of_another_code(model, step, within):
    result = pendulum(model, 16, step)
    reference = np.array(TIP)
    np.testing.assert_allclose(result.time[1:], reference[:, 0], atol=1e-9)
    assert np.abs(result["bar.end.position"].values[1:, :2] - reference[:, 1:]).max() < within


def test_hinged_cables_and_beams_swing_as_exact_beams_do():
    """Two bars in a hinge, the second free to swing: joints, gravity and damping of all models."""

    def tip(model):
        bar = {
            "section": section(model, 1e6, 1e6, 300.0, 400.0, 1.0, 4e-4), "elements": 8, "model": model, "damping": 1e-3,
        }  # fmt: skip
        result = simulate(
            {
                "gravity": [0, -9.81, 0],
                "beams": {
                    "inner": {"from": [0, 0, 0], "to": [1, 0, 0], **bar},
                    "outer": {"from": [1, 0, 0], "to": [2, 0, 0], **bar},
                },
                "joints": {
                    "root": {"type": "revolute", "bodies": ["ground", "inner.start"], "point": [0, 0, 0], "axis": [0, 0, 1]},
                    "hinge": {"type": "revolute", "bodies": ["inner.end", "outer.start"], "point": [1, 0, 0], "axis": [0, 0, 1]},
                },
            },
            duration=1, step=1e-3, integrator="generalised-alpha",
        )  # fmt: skip
        potential = result.array("potential_energy")
        assert trust(result)["energy_error_max"] < 1e-3 * np.ptp(potential)
        assert float(result.array("dissipated_energy")[-1]) > 1e-7
        return result["outer.end.position"].values

    exact = tip("geometrically-exact")
    assert np.abs(tip("ancf-beam") - exact).max() < 4e-3
    assert np.abs(tip("ancf-cable") - exact).max() < 4e-3


def test_a_moment_of_inertia_of_matter_is_asked_for():
    sections = cantilever("ancf-beam", None)
    sections["beams"]["rod"]["section"]["inertia"] = [1, 1, 1]
    with pytest.raises(ModelError, match=r"sum of those about y and z, 2, not 1 kg m"):
        machine(sections)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ({"order": 2}, "elements of `model: ancf-cable` have two nodes"),
        ({"mass": "lumped"}, "always consistent"),
        ({"interpolation": "total"}, "no rotations to interpolate"),
        ({"via": [5, 1, 0]}, "straight and not twisted"),
        ({"twist": 0.1}, "straight and not twisted"),
        ({"centroid": [0.1, 0]}, "superfluous|belongs to a section of a material"),
        ({"shear_centre": [0.1, 0]}, "shear_centre: an `ancf-cable` is the same in all directions"),
    ],
)
def test_what_a_cable_does_not_have_is_refused(words, message):
    with pytest.raises(ModelError, match=message):
        machine(cantilever("ancf-cable", None, **words))


def test_unknown_models_are_named():
    sections = cantilever("ancf-cable", None)
    sections["beams"]["rod"]["model"] = "ancf"
    with pytest.raises(ModelError, match="`ancf` is not known; did you mean `ancf-beam`"):
        machine(sections)


def test_a_cable_that_bends_unalike_is_refused():
    sections = cantilever("ancf-cable", None)
    sections["beams"]["rod"]["section"]["stiffness"][5] = 3.0
    with pytest.raises(
        ModelError, match=r"has the same bending stiffness in all directions.*here EI_y = 100, EI_z = 3 N m\^2"
    ):
        machine(sections)
    section_, coupled = sections["beams"]["rod"]["section"], np.diag([1e5, 1e5, 1e5, 80.0, 100.0, 100.0])
    coupled[0, 3] = coupled[3, 0] = 20.0
    section_["stiffness"] = coupled.tolist()
    with pytest.raises(ModelError, match="numbers off the diagonal"):
        machine(sections)
    section_ |= {"stiffness": [1e5, 1e5, 1e5, 80.0, 100.0, 100.0], "mass_centre": [0.1, 0]}
    with pytest.raises(ModelError, match="`mass_centre` is off the line"):
        machine(sections)


def test_a_cable_needs_no_shear_areas():
    """It does not shear: the same motion with any."""
    values = {"type": "values", "area": 1e-4, "iy": 1e-9, "iz": 1e-9, "torsion": 2e-9}
    steel = {"youngs_modulus": 210e9, "poisson_ratio": 0.3, "density": 7850}
    sections = cantilever("ancf-cable", {"type": "force", "vector": [0, -0.1, 0]}, 4, section=values, material=steel)
    tip = machine(sections).statics().array("position")[-1, -1]
    assert tip[1] == pytest.approx(-0.1 * LENGTH**3 / (3 * 210), rel=1e-2)
    sections["beams"]["rod"]["section"] = {**values, "shear_area_y": 5e-5, "shear_area_z": 5e-5}
    assert_allclose(machine(sections).statics().array("position")[-1, -1], tip, rtol=1e-12)


def test_the_check_names_the_model():
    for model in MODELS:
        assert f"8 {model} elements, 9 nodes" in str(machine(cantilever(model, None)).check())


def test_methods_that_do_not_know_gradients_name_the_beam():
    sections = cantilever("ancf-beam", None)
    conserving = {"integrator": "energy-momentum", "stabilisation": "none"}
    for words in ({"coordinates": "independent"}, {"formulation": "lagrange"}, conserving):
        with pytest.raises(ModelError, match="rod"):
            simulate(sections, duration=0.1, step=0.01, **words)


def test_explicit_steps_that_are_too_long_name_the_beam_and_the_longest_step():
    """√(EA/μ)-waves in elements of 1.25 m and the turning of gradients: rk4 is stable up to 2.8 over the angular frequency."""
    sections, settings = cantilever("ancf-cable", {"type": "force", "vector": [0, -1, 0]}), {"integrator": "rk4"}
    fastest = beam_facts(machine(sections).record.beams[0]).fastest
    limit = 2.8 / (2 * np.pi * fastest)
    with pytest.raises(SolveError, match=f"element of the beam rod vibrates with up to {fastest:.3g} Hz") as caught:
        simulate(sections, duration=1000 * limit, step=2 * limit, **settings)
    assert "--integrator generalised-alpha" in str(caught.value)
    steps = simulate(sections, duration=100 * limit, step=0.5 * limit, **settings)
    assert np.isfinite(steps.array("position")).all()


def test_catenary_length_is_what_it_is_compared_with():
    """The closed form itself: the arc of a cosh between its ends."""
    a = brentq(lambda a: 2 * a * np.sinh(4 / a) - 10.0, 1.0, 100.0)
    assert quad(lambda x: np.cosh(x / a), -4, 4)[0] == pytest.approx(10.0, rel=1e-12)


def test_outputs_of_a_run_name_the_gradients():
    result = simulate(flying("ancf-beam"), duration=0.01, step=1e-3, integrator="generalised-alpha")
    assert list(result.coordinates["mode"][:2]) == ["rod.start.1", "rod.start.2"]
    assert json.loads(result.dataset.attrs["trust"])["modes"] == 30
