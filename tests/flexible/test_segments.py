"""Beams as rigid segments joined by springs: one word on an unchanged machine, against closed forms and geometrically exact beams."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from beams import flying, general
from checking import check
from nivel import Beam
from nivel.analysis.plan.beam_facts import beam_facts
from nivel.elements.beams.exact import skew
from nivel.elements.beams.segments import segments_of
from nivel.errors import ModelError
from preparing import prepare
from simulating import machine, simulate

pytestmark = pytest.mark.covering

STEEL = {"youngs_modulus": 210e9, "poisson_ratio": 0.3, "density": 7850}
SECTION = {"type": "rectangle", "width": 0.02, "height": 0.01}
EI, LENGTH, MASS = 100.0, 2.0, 3.0
SEGMENTS = {"model": "segments"}


def clamped(load=(0, 0, 0), elements=6, EA=1e8, GA=1e8, **beam):
    """A cantilever along x; without shear or stretch worth a name, its sections without inertia."""
    section = general(EA, GA, EI, EI, MASS, (1e-9, 1e-9, 1e-9))
    rod = {"from": [0, 0, 0], "to": [LENGTH, 0, 0], "section": section, "elements": elements, **SEGMENTS, **beam}
    return {
        "gravity": [0, 0, 0],
        "beams": {"rod": rod},
        "joints": {"wall": {"type": "fixed", "bodies": ["ground", "rod.start"], "point": [0, 0, 0]}},
        "forces": {"load": {"type": "force", "body": "rod.end", "vector": list(load)}},
    }


def test_frequencies_of_a_cantilever_converge_with_order_two():
    """cos x cosh x = -1: x = 1.8751, 4.6941, 7.8548; ω = (x/L)² √(EI/m), Euler and Bernoulli; each in both planes."""
    expected = np.array([1.8751040687, 4.6940911330, 7.8547574382]) ** 2 / LENGTH**2 * np.sqrt(EI / MASS) / (2 * np.pi)
    errors = []
    for elements in (8, 16, 32):
        found = machine(clamped(elements=elements)).statics(duration=0, modes=6).array("natural_frequency")[0]
        np.testing.assert_allclose(found[0::2], found[1::2], rtol=1e-5)
        errors.append(found[0::2] / expected - 1.0)
    slopes = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    np.testing.assert_allclose(slopes[1], 2.0, atol=0.05)
    assert np.abs(errors[-1]).max() < 5e-3


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_deflection_under_a_tip_load_is_the_sum_over_the_springs(coordinates):
    """Σ F (L - s_k)² h/EI over the middles s_k of n pieces is F L³/3EI (1 - 1/4n²); F L/GA of shear is more."""
    n, F, GA = 5, 1e-4, 1e3
    result = machine(clamped([0, 0, -F], elements=n, GA=GA)).statics(coordinates=coordinates)
    expected = F * LENGTH**3 / (3 * EI) * (1 - 1 / (4 * n**2)) + F * LENGTH / GA
    assert -result.array("position")[0, -1, 2] == pytest.approx(expected, rel=1e-8)


def test_a_moment_rolls_the_cantilever_up():
    """Every spring turns by M h/EI, so segments lie on a regular polygon of any size of turn."""
    n = 8
    sections = clamped(elements=n)
    sections["forces"] = {
        "load": {"type": "torque", "body": "rod.end", "vector": [0, 0, f"{2 * np.pi * EI / LENGTH}*time"]}
    }
    result = machine(sections).statics(duration=1, step=0.1)
    h = LENGTH / n
    turned = np.outer(result.time, 2 * np.pi * np.arange(n + 1) / n)
    pieces = 0.5 * h * (np.exp(1j * turned[:, :-1]) + np.exp(1j * turned[:, 1:]))
    nodes = np.cumsum(pieces, axis=1)
    np.testing.assert_allclose(result.array("position")[:, 1:, 0], nodes.real, atol=1e-6)
    np.testing.assert_allclose(result.array("position")[:, 1:, 1], nodes.imag, atol=1e-6)


def test_sections_are_those_of_statics_and_have_the_energy_of_the_run():
    n, F = 6, 2.0
    result = machine(clamped([0.0, 0, -F], elements=n, GA=1e6)).statics()
    sections = result.sections("rod")
    np.testing.assert_allclose(sections["share"], (np.arange(n) + 0.5) / n, rtol=1e-12)
    arm = LENGTH * (1 - sections["share"].values)
    # of the part behind on the part before; the rod bends by 2 % of its length
    np.testing.assert_allclose(sections["moment"].sel(component="y").values[0], F * arm, rtol=1e-2)
    np.testing.assert_allclose(sections["force"].sel(component="z").values[0], -F, rtol=1e-2)
    np.testing.assert_allclose(sections["curvature"].sel(component="y").values[0], F * arm / EI, rtol=1e-2)
    run = simulate(
        {**clamped([0, 0, -50.0]), "simulation": {"duration": 0.2, "step": 1e-3, "integrator": "generalised-alpha"}}
    )
    stored = run.dataset["potential_energy"].values
    assert stored.max() > 0.5
    np.testing.assert_allclose(run.sections("rod")["energy"].values, stored, rtol=1e-9, atol=1e-9 * stored.max())


@pytest.mark.parametrize("order", [1, 2])
def test_segments_weigh_what_the_beam_weighs(order):
    """Mass, first moment and inertia of a curved beam with mass centres off its line do not depend on how many segments there are."""
    sections = flying(order, None)["beams"]["rod"] | SEGMENTS
    totals = []
    for elements in (3, 40):
        beam = Beam.model_validate({**sections, "name": "rod", "elements": elements})
        own = segments_of(beam)
        place, axes = beam.frames(beam.shares)
        centre = place + np.einsum("nij,nj->ni", axes, own.centre)
        J = np.einsum("nij,njk,nlk->il", axes, own.inertia, axes)
        J += sum(m * skew(c).T @ skew(c) for m, c in zip(own.mass, centre, strict=True))
        totals.append((own.mass.sum(), own.mass @ centre, J))
    for a, b in zip(*totals, strict=True):
        np.testing.assert_allclose(a, b, rtol=1e-10, atol=1e-12)


def test_a_straight_beam_of_segments_is_a_rigid_bar():
    """m L²/12 + j L about its middle."""
    beam = Beam.model_validate(
        {"name": "rod", "from": (0, 0, 0), "to": (2, 0, 0), "section": general(mass=3.0), "elements": 4, **SEGMENTS}
    )
    own = segments_of(beam)
    np.testing.assert_allclose(own.mass, 3.0 * np.array([0.25, 0.5, 0.5, 0.5, 0.25]))
    np.testing.assert_allclose(own.centre[:, 0], [0.125, 0, 0, 0, -0.125], atol=1e-15)
    x = beam.frames(beam.shares)[0][:, 0] + own.centre[:, 0] - 1.0
    total = own.inertia[:, 2, 2].sum() + own.mass @ x**2
    assert total == pytest.approx(6.0 * 4.0 / 12.0 + 2.0, rel=1e-12)


def of_free(result):
    """(time, 3) linear and angular momentum about the origin of a machine of rigid bodies."""
    record = prepare(machine(flying(1, None, **SEGMENTS)).record).motion.system.record.bodies
    R, V = result.array("position"), result.array("velocity")
    A = (
        Rotation.from_quat(result.array("orientation").reshape(-1, 4), scalar_first=True)
        .as_matrix()
        .reshape(*R.shape, 3)
    )
    w = result.array("angular_velocity")
    c = np.einsum("tbij,bj->tbi", A, record.centre_b)
    p = record.mass[None, :, None] * (V + np.cross(w, c))
    spin = np.einsum("tbij,bjk,tblk,tbl->tbi", A, record.inertia_b, A, w)
    return p.sum(axis=1), (np.cross(R + c, p) + spin).sum(axis=1)


def test_a_free_beam_of_segments_keeps_energy_and_momenta():
    settings = {"integrator": "dop853", "tolerance": 1e-11, "duration": 0.3, "output_interval": 0.02}
    result = simulate(
        {**flying(1, None, **SEGMENTS), "gravity": [0, 0, 0], "simulation": {**settings, "coordinates": "absolute"}}
    )
    assert result.array("potential_energy").max() > 1e-4 * result.array("kinetic_energy").max()
    assert np.abs(result.array("energy_error")).max() < 1e-8 * result.array("kinetic_energy").max()
    for momentum in of_free(result):
        np.testing.assert_allclose(
            momentum, momentum[:1].repeat(len(momentum), axis=0), atol=1e-8 * np.abs(momentum).max()
        )


def test_rigid_motions_strain_nothing():
    """A curved, twisted beam that is placed turned has no force in any spring, and none comes while it translates."""
    result = simulate(
        {
            **flying(1, None, **SEGMENTS, twist=0.4, angular_velocity=[0, 0, 0]),
            "gravity": [0, 0, 0],
            "simulation": {"duration": 0.1, "step": 1e-3, "integrator": "generalised-alpha"},
        }
    )
    assert np.abs(result.array("potential_energy")).max() < 1e-20
    assert np.abs(result.array("acceleration")).max() < 1e-7


def pendulum(elements, **beam):
    """A steel bar with a bob, on a hinge, that slides nothing and bends by a few per cent of its length."""
    rod = {"from": [0, 0, 0], "to": [1, 0, 0], "section": SECTION, "material": STEEL, "elements": elements, **beam}
    return {
        "gravity": [0, 0, -9.81],
        "beams": {"rod": {**rod, "stations": {"middle": 0.5}}},
        "bodies": {"bob": {"position": [1, 0, 0], "mass": 0.5, "inertia": [1e-3, 1e-3, 1e-3]}},
        "joints": {
            "hinge": {"type": "revolute", "bodies": ["ground", "rod.start"], "point": [0, 0, 0], "axis": [0, 1, 0]},
            "grip": {"type": "fixed", "bodies": ["rod.end", "bob"], "point": [1, 0, 0]},
        },
        "forces": {"push": {"type": "force", "body": "rod.middle", "vector": [0, "4*sin(8*time)", 0]}},
        "simulation": {"duration": 0.5, "step": 5e-4, "integrator": "generalised-alpha", "output_interval": 0.01},
    }


def test_one_word_makes_a_pendulum_of_segments_that_moves_like_the_exact_one():
    """The difference falls with the square of the length of the segments."""
    exact = simulate(pendulum(16, order=2)).dataset["position"].sel(body=["rod.middle", "bob"]).values
    errors = []
    for elements in (4, 8, 16):
        found = simulate(pendulum(elements, model="segments"))
        assert list(found.dataset["body"].values)[-1] == "rod.end"
        errors.append(np.abs(found.dataset["position"].sel(body=["rod.middle", "bob"]).values - exact).max())
    assert errors[0] / errors[1] > 3.0
    assert errors[1] / errors[2] > 3.0
    assert errors[2] < 2e-4


@pytest.mark.parametrize(
    "method",
    [
        {"coordinates": "relative"},
        {"formulation": "lagrange", "coordinates": "absolute", "integrator": "dop853", "tolerance": 1e-7},
        {"coordinates": "independent", "integrator": "dop853", "tolerance": 1e-7},
        {"integrator": "energy-momentum", "stabilisation": "none", "coordinates": "absolute"},
    ],
    ids=lambda method: next(iter(method.values())),
)
def test_segments_run_in_all_methods_of_rigid_bodies(method):
    """Also those that consistent mass refuses."""
    short = {"duration": 0.05, "step": 2e-4}
    sections = pendulum(3, model="segments")
    expected = simulate({**sections, "simulation": {**sections["simulation"], **short, "coordinates": "absolute"}})
    settings = {**sections["simulation"], **short, **method}
    if "tolerance" in settings:
        del settings["step"]
    result = simulate({**sections, "simulation": settings})
    np.testing.assert_allclose(result.array("position"), expected.array("position"), atol=2e-5)


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_stiction_in_a_joint_of_segments_is_that_of_explicit_methods(coordinates):
    """A hinge that rubs, loaded by its reaction, held at first and then slid by a bar that bends; dopri5 with the same τ."""
    sections = pendulum(2, model="segments", damping=1e-4)
    rub = {"type": "friction", "coordinate": "hinge.angle", "model": "stiction", "coefficient": 0.5, "radius": 0.3}
    sections["forces"] = {"rub": rub}
    common = {**sections["simulation"], "duration": 1.0, "step": 1e-3}
    chosen = {**common, "integrator": "dopri5", "tolerance": 1e-5, "coordinates": "absolute"}
    expected = simulate({**sections, "simulation": chosen})
    found = simulate({**sections, "simulation": {**common, "coordinates": coordinates}})
    assert np.ptp(found.array("hinge.angle")) > 2.0
    np.testing.assert_allclose(found.array("position"), expected.array("position"), atol=1e-4)


def test_a_slider_comes_by_on_segments():
    """The joints that slide along a beam take hold of its nodes, whatever is between them."""
    places = {}
    for model in ("geometrically-exact", "segments"):
        sections = pendulum(12, model=model)
        sections["bodies"]["bead"] = {"position": [0.3, 0, 0], "mass": 0.1, "inertia": [1e-4, 1e-4, 1e-4]}
        sections["joints"]["glide"] = {"type": "point-on-beam", "bodies": ["bead", "rod"], "point": [0.3, 0, 0]}
        sections["simulation"]["duration"] = 0.2
        places[model] = simulate(sections).dataset["position"].sel(body="bead").values
    assert np.ptp(places["segments"][:, 0]) > 1e-3
    np.testing.assert_allclose(places["segments"], places["geometrically-exact"], atol=2e-3)


def test_damping_is_that_of_elements():
    """Stress from the rate of strain: a vibration of ω has the damping ratio ½ ω `damping`, here of the lowest bending."""
    omega = 1.8751040687**2 / LENGTH**2 * np.sqrt(EI / MASS)
    damping = 2 * 0.05 / omega
    sections = clamped(["0", 0, "1 N*max(0, min(1, (0.01 - time)*1e9))"], elements=10, damping=damping, EA=1e6, GA=1e6)
    sections["simulation"] = {"duration": 4.0, "step": 2e-3, "integrator": "generalised-alpha", "output_interval": 2e-3}
    result = simulate(sections)
    tip = result.dataset["position"].sel(body="rod.end").values[200:, 2]
    peaks = np.flatnonzero((tip[1:-1] > tip[:-2]) & (tip[1:-1] > tip[2:])) + 1
    decay = np.log(tip[peaks[0]] / tip[peaks[-1]]) / (len(peaks) - 1)
    assert decay / (2 * np.pi) == pytest.approx(0.05, rel=0.05)


def test_the_check_says_what_it_is_made_of():
    sections = clamped(elements=6)
    text = str(check(machine(sections).record))
    assert "7 rigid segments" in text
    assert "(a single spring)" in text


def test_no_vibration_is_faster_than_that_of_two_half_segments():
    sections = clamped(elements=4, EA=1e6, GA=1e5)
    del sections["joints"], sections["forces"]
    facts = beam_facts(machine(sections).record.beams[0])
    found = machine(sections).statics(duration=0, modes=30).array("natural_frequency")[0]
    assert 0.2 * facts.fastest < found.max() < facts.fastest * (1 + 1e-9)


def test_words_that_segments_have_no_use_for_are_refused():
    for words, said in (
        ({"mass": "consistent"}, "a mass of its own"),
        ({"interpolation": "total"}, "nothing is interpolated"),
    ):
        with pytest.raises(ModelError, match=said):
            machine(clamped(**words))
    machine(clamped(mass="lumped"))
