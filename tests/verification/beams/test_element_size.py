"""Meshes of beams: no light is green where elements make a stored number wrong, by boundary value problems, closed forms and published
values."""

import numpy as np
import pytest

import nivel
from nivel.elements.beams.other_elements import changed, doubled
from nivel.judge.after.other_elements import other_elements
from nivel.results.analyses.linear_model import LinearModel
from references.planar_beam import PlanarBeam
from simulating import G, machine

MODULUS, DENSITY = 210e9, 7850.0
STEEL = {"youngs_modulus": MODULUS, "poisson_ratio": 0.3, "density": DENSITY}
pytestmark = pytest.mark.usefixtures("verified")

GREEN, RED = 1e-2, 1e-1  # of the motion: the thresholds of the item `mesh`


def held(beam, point):
    return {"type": "fixed", "bodies": ["ground", beam], "point": point}


def item(trust):
    """The worst verdict on the mesh, green where nothing is said."""
    verdicts = [each.verdict for each in trust.items if each.name == "mesh"]
    return "red" if "red" in verdicts else "amber" if "amber" in verdicts else "green"


# ------------------------------------------------------------------ statics: the whole family against a boundary value problem
LENGTH, MASS = 2.0, 3.0
SLENDER, THICK = (4e7, 1.5e7, 400.0), (4e7, 1.5e7, 4e5)
RISE = 0.15  # of the arch [m]
SUPPORTS = {
    "clamped": ("clamped", "clamped"),
    "propped": ("clamped", "rolling"),
    "supported": ("rolling", "rolling"),
    "cantilever": ("clamped", "free"),
}


def reference(stiffness, shape, weight):
    begin, curvature, length = (0.0, 0.0, 0.0), 0.0, LENGTH
    if shape == "arch":
        radius = (RISE**2 + 0.25 * LENGTH**2) / (2.0 * RISE)
        half = np.arcsin(0.5 * LENGTH / radius)
        begin, curvature, length = (0.0, 0.0, float(half)), float(-1.0 / radius), float(2.0 * half * radius)
    return PlanarBeam(*stiffness, length, begin, curvature, weight)


def loaded(stiffness, shape, support, gravity, **mesh):
    """A plane beam under its weight; an end that rolls is held along x at the start alone."""
    EA, GA, EI = stiffness
    section = {"type": "general", "stiffness": [EA, GA, GA, EI, EI, EI], "mass": MASS, "inertia": [1e-3, 1e-3, 1e-3]}
    line = {
        "from": [0, 0, 0],
        "to": [LENGTH, 0, 0],
        "up": [0, 1, 0],
        **({"via": [1.0, 0, RISE]} if shape == "arch" else {}),
    }
    start = held("rod.start", [0, 0, 0])
    if SUPPORTS[support][0] == "rolling":
        start = {"type": "revolute", "bodies": ["ground", "rod.start"], "point": [0, 0, 0], "axis": [0, 1, 0]}
    joints = {"start": start}
    if SUPPORTS[support][1] != "free":
        joints["end"] = held("rod.end", [LENGTH, 0, 0])
    if SUPPORTS[support][1] == "rolling":
        joints["end"] = {
            "type": "point-on-line",
            "bodies": ["ground", "rod.end"],
            "point": [LENGTH, 0, 0],
            "axis": [1, 0, 0],
        }
    return {"gravity": [0, 0, -gravity], "beams": {"rod": {**line, "section": section, **mesh}}, "joints": joints}


def true_places(stiffness, shape, support, gravity, count):
    """(count, 2) x and z of the nodes; a beam that rolls at both ends is moved so that its start is at the origin."""
    beam = reference(stiffness, shape, MASS * gravity)
    ends = SUPPORTS[support]
    if ends == ("rolling", "rolling"):
        # by symmetry: half of it, guided in the middle
        half = PlanarBeam(beam.EA, beam.GA, beam.EI, 0.5 * beam.length, tuple(beam.unstressed(np.array([0.5 * beam.length]))[:, 0]),
                          beam.curvature, beam.weight)  # fmt: skip
        share = np.linspace(0.0, 1.0, count)
        right = half.places(np.abs(2.0 * share - 1.0), ("guided", "rolling"))[0]
        middle = half.begin[0]
        x = np.where(share < 0.5, 2.0 * middle - right[:, 0], right[:, 0])
        return np.column_stack([x - x[0], right[:, 1]])
    return beam.places(np.linspace(0.0, 1.0, count), ends)[0]


@pytest.mark.parametrize(
    ("stiffness", "shape"),
    [(SLENDER, "straight"), (THICK, "straight"), (SLENDER, "arch")],
    ids=["slender", "thick", "arch"],
)
@pytest.mark.parametrize("support", list(SUPPORTS))
def test_equilibria_are_wrong_by_no_more_than_ten_times_what_is_stated(support, stiffness, shape):
    """Every node; and the light is green where the elements are good, and is not where they are bad."""
    gravity = 4.0 if stiffness is SLENDER else 4e3
    for order, elements, coordinates in [
        (1, 2, "absolute"), (1, 5, "relative"), (2, 1, "relative"), (2, 3, "absolute"), (2, 7, "relative"), (3, 1, "absolute"),
    ]:  # fmt: skip
        sections = loaded(stiffness, shape, support, gravity, elements=elements, order=order)
        result = machine(sections).statics(duration=0, coordinates=coordinates)
        count = elements * order + 1
        found, true = result.array("position")[0][:, [0, 2]], true_places(stiffness, shape, support, gravity, count)
        drawn = reference(stiffness, shape, 0.0).unstressed(
            reference(stiffness, shape, 0.0).length * np.linspace(0, 1, count)
        )
        off, stated = np.abs(found - true), result.estimated_error("position")[0][:, [0, 2]]
        said = f"{order} {elements}: {off.max():.3g} m, {stated.max():.3g} m stated"
        assert np.all(off <= 10.0 * stated + 1e-8), said
        share = np.linalg.norm(off, axis=1).max() / np.linalg.norm(true - drawn[:2].T, axis=1).max()
        if share > 2.0 * GREEN:
            assert item(result.trust) != "green", said
        if share > 2.0 * RED:
            assert item(result.trust) == "red", said
        if (order, elements) == (2, 7):
            assert item(result.trust) == "green", said


# ------------------------------------------------------------------ the default mesh
BAR = {"type": "rectangle", "width": 0.04, "height": 0.01}
WEIGHT, STIFFNESS = DENSITY * 4e-4 * G, MODULUS * 0.04 * 0.01**3 / 12


def bar(length=2.0, gravity=1e-2 * G, **more):
    """A steel bar clamped at both ends; so light that it deflects in proportion."""
    beam = {
        "from": [0, 0, 0],
        "to": [length, 0, 0],
        "section": BAR,
        "material": STEEL,
        "stations": {"mid": 0.5},
        **more,
    }
    joints = {"a": held("rod.start", [0, 0, 0]), "b": held("rod.end", [length, 0, 0])}
    return {"gravity": [0, 0, -gravity], "beams": {"rod": beam}, "joints": joints}


def test_a_beam_without_elements_named_has_quadratic_ones():
    """A file that names `elements` alone keeps linear ones, and so do other models."""
    orders = [
        ({}, 2),
        ({"elements": 10}, 1),
        ({"order": 1}, 1),
        ({"elements": 4, "order": 3}, 3),
        ({"model": "segments"}, 1),
    ]
    for more, order in [*orders, ({"model": "ancf-beam"}, 1)]:
        beam = machine(bar(**more)).record.beams[0]
        assert (beam.order, beam.elements) == (order, more.get("elements", 10))


def test_the_default_mesh_sags_as_a_clamped_beam_does():
    """w L⁴/(384 EI), and shear w L²/(8 GA) with κ = 5/6."""
    shear = MODULUS / 2.6 * 4e-4 * 5 / 6
    exact = 1e-2 * WEIGHT * (2.0**4 / (384 * STIFFNESS) + 2.0**2 / (8 * shear))
    result = machine(bar()).statics(duration=0)
    sag = -result.array("rod.mid.position.z")[0]
    assert sag == pytest.approx(exact, rel=5e-4)
    assert item(result.trust) == "green"


def test_the_default_mesh_rolls_up_to_a_circle():
    """The moment 2π EI/L; the end comes back to the start."""
    EI = 80.0
    section = {"type": "general", "stiffness": [1e7, 1e7, 1e7, EI, EI, EI], "mass": 1.0, "inertia": [1e-3] * 3}
    sections = {
        "gravity": [0, 0, 0],
        "beams": {"rod": {"from": [0, 0, 0], "to": [1, 0, 0], "section": section, "stations": {"mid": 0.5}}},
        "joints": {"wall": held("rod.start", [0, 0, 0])},
        "forces": {"twist": {"type": "torque", "body": "rod.end", "vector": [0, 0, f"{2 * np.pi * EI!r}*time"]}},
    }
    result = machine(sections).statics(duration=1, step=0.1)
    assert np.abs(result.array("rod.end.position")[-1]).max() < 1e-3
    assert result.array("rod.mid.position.y")[-1] == pytest.approx(1.0 / np.pi, rel=5e-3)
    assert item(result.trust) == "green"


@pytest.mark.parametrize(("name", "roots"), [("clamped", (4.730041, 7.853205)), ("cantilever", (1.875104, 4.694091))])
def test_the_default_mesh_vibrates_as_euler_and_bernoulli_say(name, roots):
    sections = bar(gravity=0.0)
    if name == "cantilever":
        del sections["joints"]["b"]
    result = machine(sections).statics(duration=0, modes=4)
    found = result.array("natural_frequency")[0]
    exact = np.array(roots) ** 2 / 4.0 * np.sqrt(STIFFNESS / (DENSITY * 4e-4)) / (2 * np.pi)
    for each in exact:
        assert np.abs(found / each - 1.0).min() < 5e-3
    assert item(result.trust) == "green"


# ------------------------------------------------------------------ faults that were green
@pytest.mark.parametrize(("mesh", "verdict"), [({"elements": 2}, "red"), ({"elements": 10}, "amber"), ({}, "green")])
def test_two_linear_elements_between_clamps_are_red(mesh, verdict):
    """They do not bend at all; ten of them are 4 % stiff."""
    result = machine(bar(gravity=0.1 * G, **mesh)).statics(duration=0)
    assert item(result.trust) == verdict
    assert result.trust.verdict == verdict


def test_one_element_between_clamps_has_no_node_that_is_wrong_but_reactions():
    sections = bar(gravity=0.1 * G, elements=1)
    del sections["beams"]["rod"]["stations"]
    result = machine(sections).statics(duration=0)
    assert item(result.trust) == "red"
    exact = 0.1 * WEIGHT * 2.0**2 / 12.0
    off = np.abs(np.abs(result.array("a.torque")[0]).max() - exact)
    assert off <= 10.0 * result.estimated_error("a.torque")[0].max()


def test_an_arch_of_two_elements_is_red_in_a_run():
    """The middle moves by 2.6e-4 m, and by 4e-6 m as it is."""
    beam = {
        "from": [-0.5, 0, 0],
        "via": [0, 0, 0.03],
        "to": [0.5, 0, 0],
        "section": {"type": "rectangle", "width": 0.02, "height": 0.003},
        "material": STEEL,
        "elements": 2,
        "stations": {"mid": 0.5},
    }
    sections = {
        "gravity": [0, 0, 0],
        "beams": {"rod": beam},
        "joints": {"a": held("rod.start", [-0.5, 0, 0]), "b": held("rod.end", [0.5, 0, 0])},
        "forces": {
            "f": {"type": "force", "body": "rod.mid", "vector": [0, 0, {"times": [0, 0.2], "values": [0, -60]}]}
        },
        "simulation": {"duration": 0.3, "step": 2e-4, "integrator": "generalised-alpha"},
    }
    result = machine(sections).simulate(verify=True)
    assert item(result.trust) == "red"
    stated = result.estimated_error("rod.mid.position.z")[-1]
    assert abs(result.array("rod.mid.position.z")[-1] - (0.03 - 2.6e-4)) < 10.0 * stated
    assert result.trust.elements_estimate > 1e-4
    assert "by the elements of beams" in result.trust.headline
    fine = {**sections, "beams": {"rod": {**beam, "elements": 8, "order": 2}}}
    assert item(machine(fine).simulate(verify=True).trust) == "green"


def test_a_beam_on_a_hub_that_is_spun_up_and_let_go():
    """Converged values of two other formulations: 4.473 rad/s, the tip at (5.7636, -1.6674) m after 2 s."""
    beam = {
        "from": [1, 0, 0],
        "to": [6, 0, 0],
        "up": [0, 0, 1],
        "section": {"type": "rectangle", "width": 0.02, "height": 0.02},
        "material": {"youngs_modulus": 69e9, "poisson_ratio": 0.3, "density": 2770},
        "elements": 16,
        "damping": 5e-4,
    }
    sections = {
        "beams": {"cable": beam},
        "bodies": {"hub": {"mass": 50, "inertia": [5, 5, 5]}},
        "joints": {
            "pin": {"type": "revolute", "bodies": ["ground", "hub"], "point": [0, 0, 0], "axis": [0, 0, 1]},
            "root": {"type": "fixed", "bodies": ["hub", "cable.start"], "point": [1, 0, 0]},
        },
        "forces": {"t": {"type": "motor", "coordinate": "pin", "effort": "250*(time < 2)"}},
        "simulation": {"duration": 2, "integrator": "generalised-alpha", "step": 1e-3, "output_interval": 0.01},
    }
    result = machine(sections).simulate(verify=True)
    assert item(result.trust) == "amber"
    assert abs(result.array("pin.angle.rate")[-1] - 4.473) < 2.0 * result.estimated_error("pin.angle.rate")[-1]
    off = np.abs(result.array("cable.end.position")[-1, :2] - [5.7636, -1.6674])
    assert np.all(off < 10.0 * result.estimated_error("cable.end.position")[-1, :2])


# ------------------------------------------------------------------ buckling
def column(share, elements, side=0.0):
    """A clamped column pressed by a share of its buckling load (π/2L)² EI."""
    EI = MODULUS * 0.02**4 / 12
    beam = {
        "from": [0, 0, 0],
        "to": [0, 0, 1],
        "section": {"type": "rectangle", "width": 0.02, "height": 0.02},
        "material": STEEL,
    }
    load = {"type": "force", "body": "rod.end", "vector": [side, 0, -share * np.pi**2 * EI / 4]}
    return {
        "gravity": [0, 0, 0],
        "beams": {"rod": {**beam, "elements": elements}},
        "joints": {"foot": held("rod.start", [0, 0, 0])},
        "forces": {"push": load},
    }


@pytest.mark.parametrize(
    ("share", "side", "verdict"), [(0.999, 0.0, "red"), (1.002, 0.0, "red"), (0.99, 1.0, "red"), (0.3, 1.0, "green")]
)
def test_coarse_elements_next_to_buckling_are_red(share, side, verdict):
    """Ten linear elements buckle at 1.004 of the load: what is left of the stiffness is not known, or is there no more."""
    assert item(machine(column(share, 10, side)).statics(duration=0).trust) == verdict


# ------------------------------------------------------------------ runs: a closed form
@pytest.mark.parametrize(("order", "elements"), [(1, 2), (1, 4), (1, 12), (2, 1), (2, 2), (2, 4), (3, 1)])
def test_vibrations_are_wrong_by_no_more_than_ten_times_what_is_stated(order, elements):
    """A cantilever whose tip is loaded at once: Σ φ² P/(m ω²) (1 - cos ωt), φ² = 4/L for every mode of unit mass over the length."""
    length, load = 1.0, 0.5
    area, second = 0.02 * 0.01, 0.02 * 0.01**3 / 12
    beam = {
        "from": [0, 0, 0],
        "to": [length, 0, 0],
        "section": {"type": "rectangle", "width": 0.02, "height": 0.01},
        "material": STEEL,
    }
    sections = {
        "gravity": [0, 0, 0],
        "beams": {"rod": {**beam, "elements": elements, "order": order}},
        "joints": {"wall": held("rod.start", [0, 0, 0])},
        "forces": {"push": {"type": "force", "body": "rod.end", "vector": [0, 0, load]}},
        "simulation": {"duration": 0.3, "step": 5e-4, "integrator": "generalised-alpha", "output_interval": 3e-3},
    }
    result = machine(sections).simulate(verify=True)
    roots = np.array([1.875104069, 4.694091133, 7.854757438, 10.99554073, 14.13716839])
    omega = roots**2 * np.sqrt(MODULUS * second / (DENSITY * area)) / length**2
    parts = 4.0 * load / (DENSITY * area * length * omega**2) * (1.0 - np.cos(np.outer(result.time, omega)))
    exact = parts.sum(axis=1)
    off = np.maximum.accumulate(np.abs(result.array("rod.end.position.z") - exact))
    stated = result.estimated_error("rod.end.position.z")
    known = stated > 0.0
    assert np.all(off[known] <= 10.0 * stated[known] + 1e-2 * exact.max())
    share = off.max() / exact.max()
    if share > 3.0 * GREEN:
        assert item(result.trust) != "green"
    if elements * order >= 8:
        assert item(result.trust) == "green" or share > 0.5 * GREEN


# ------------------------------------------------------------------ linear models
def mesh_note(model: LinearModel) -> str:
    return next(note for note in model.notes if note.startswith("Mesh:"))


def test_linear_models_say_which_vibrations_elements_make_wrong():
    sections = bar(gravity=0.0, elements=10)
    exact = 4.730041**2 / 4.0 * np.sqrt(STIFFNESS / (DENSITY * 4e-4)) / (2 * np.pi)
    model = machine(sections).linearise()
    assert model.modes[0].natural_frequency > 1.02 * exact
    assert "the vibration of mode 1" in mesh_note(model)
    fine = machine(bar(gravity=0.0)).linearise()
    assert fine.modes[0].natural_frequency == pytest.approx(exact, rel=2e-3)
    assert "mode 1," not in mesh_note(fine)


# ------------------------------------------------------------------ which elements are compared
def test_other_elements_keep_stations_and_names_of_nodes():
    record = machine(bar(elements=7, order=2)).record
    beam = record.beams[0]
    for other in (doubled(beam), changed(beam, ())[0]):
        names = dict(zip(other.node_names, other.shares.tolist(), strict=True))
        assert {"rod.start", "rod.mid", "rod.end"} <= set(names)
        both = [name for name in beam.node_names if name in names]
        shares = dict(zip(beam.node_names, beam.shares.tolist(), strict=True))
        assert [names[name] for name in both] == pytest.approx([shares[name] for name in both], abs=1e-12)
        assert len(set(other.node_names)) == len(other.shares)


@pytest.mark.parametrize(
    ("elements", "held_there", "words"),
    [(8, (), "half as many"), (6, ("mid",), "twice as many"), (3, (), "twice as many"), (8, ("mid",), "half as many")],
)
def test_elements_are_halved_where_four_of_them_lie_between_what_holds_a_beam(elements, held_there, words):
    sections = bar(elements=elements, stations={"mid": 0.5} if elements != 3 else {"mid": 1 / 3})
    for station in held_there:
        sections["joints"][station] = held(f"rod.{station}", [1, 0, 0])
    pair = other_elements(machine(sections).record)
    assert pair is not None
    assert pair.words == words


def test_a_ring_is_not_halved_beyond_a_quarter_turn():
    """Four elements of a half circle turn by 45 deg each, half as many by 90 deg; of six over 1.4 of half a circle by too much."""
    ring = bar(elements=4, order=2, via=[1, 0, 1.0])
    del ring["beams"]["rod"]["stations"]
    pair = other_elements(machine(ring).record)
    assert pair is not None
    assert pair.words == "half as many"
    ring["beams"]["rod"]["via"] = [1, 0, 1.6]
    pair = other_elements(machine(ring).record)
    assert pair is not None
    assert pair.words == "twice as many"


def test_a_run_that_rests_in_equilibrium_is_compared_with_its_deflection(tmp_path):
    """Nothing moves in the run; the tip of a cantilever stands F l³/(3 E I) below where it is drawn, 0.3 % off by its elements."""
    path = tmp_path / "cantilever.yaml"
    path.write_text(
        "format: 1\nbeams:\n  rod: {from: [0, 0, 0], to: [1, 0, 0], section: {type: rectangle, width: 2 cm, height: 2 cm}, elements: 8,\n"
        "    damping: 1 ms, material: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850}}\n"
        "joints: {wall: {type: fixed, bodies: [ground, rod.start], point: [0, 0, 0]}}\n"
        "forces: {load: {type: force, body: rod.end, vector: [0, -50, 0]}}\nsimulation: {duration: 20 ms, start: equilibrium}\n"
    )
    result = nivel.load(path).simulate(verify=True)
    deflection = 50.0 / (3.0 * 210e9 * 0.02**4 / 12.0)
    assert abs(result["rod.end.position.y"].values + deflection).max() < 0.01 * deflection
    assert item(result.trust) == "green"
