"""Statics of geometrically exact beams: closed forms, and published load-displacement paths."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import fsolve

from beams import general
from simulating import machine, solid

pytestmark = pytest.mark.covering

EI, LENGTH = 100.0, 10.0


def cantilever(load, elements=10, **beam):
    section = general(1e5, 1e5, EI, EI, 1.0, (0.1, 0.1, 0.1))
    return {
        "beams": {"rod": {"from": [0, 0, 0], "to": [LENGTH, 0, 0], "section": section, "elements": elements, **beam}},
        "joints": {"wall": {"type": "fixed", "bodies": ["ground", "rod.start"], "point": [0, 0, 0]}},
        "forces": {"load": {"body": "rod.end", **load}},
    }


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_cantilever_is_rolled_up_to_a_circle_in_ten_steps(coordinates):
    """M = 2 π EI/L: uniform curvature, which elements of one point hold exactly; every node turns by its share of t 2 π."""
    torque = {"type": "torque", "vector": [0, 0, f"{2 * np.pi * EI / LENGTH}*time"]}
    result = machine(cantilever(torque)).statics(duration=1, step=0.1, coordinates=coordinates)
    assert len(result.time) == 11
    assert result.array("iterations").max() < 12
    turned = np.outer(result.time, 2 * np.pi * np.linspace(0, 1, 11))
    # sections turn evenly: chords of a regular polygon
    half = 0.5 * np.diff(turned, axis=1)
    nodes = np.cumsum(np.exp(1j * (turned[:, :-1] + half)), axis=1) * LENGTH / 10
    np.testing.assert_allclose(result.array("position")[:, 1:, 0], nodes.real, atol=1e-8)
    np.testing.assert_allclose(result.array("position")[:, 1:, 1], nodes.imag, atol=1e-8)
    assert np.abs(result.array("position")[-1, -1]).max() < 1e-8


def test_small_tip_load_bends_and_shears():
    """w = P L³/3EI + P L/GA; curvature of elements of order 2 is linear, as the moment is."""
    result = machine(cantilever({"type": "force", "vector": [0, -1e-5, 0]}, elements=4, order=2)).statics()
    expected = 1e-5 * LENGTH**3 / (3 * EI) + 1e-5 * LENGTH / 1e5
    assert -result.array("position")[0, -1, 1] == pytest.approx(expected, rel=1e-6)


def test_euler_column_buckles():
    """Clamped and free: P = π² EI/4 L², less what shear and shortening take (P/GA and P/EA: 2e-4 together)."""
    P = np.pi**2 * EI / (4 * LENGTH**2)
    sections = cantilever({"type": "force", "vector": [f"-{1.2 * P}*time", 0, 0]}, elements=12, order=3)
    result = machine(sections).statics(duration=1, step=0.25)
    assert {event.name for event in result.events} == {"bifurcation"}
    np.testing.assert_allclose([event.time for event in result.events], 1 / 1.2, rtol=1e-3)
    assert len(result.events) == 2  # in both planes


def steel_column(load, **beam):
    """A clamped column of 1 m, 2 cm by 1 cm, under a load at its tip."""
    steel = {"youngs_modulus": 210e9, "poisson_ratio": 0.3, "density": 7850}
    section = {"type": "rectangle", "width": 0.02, "height": 0.01}
    column = {"from": [0, 0, 0], "to": [0, 0, 1], "section": section, "material": steel, "elements": 20, **beam}
    return {
        "beams": {"column": column},
        "joints": {"foot": {"type": "fixed", "bodies": ["ground", "column.start"], "point": [0, 0, 0]}},
        "forces": {"load": {"type": "force", "body": "column.end", "vector": load}},
    }


@pytest.mark.parametrize("arc_length", [False, True])
@pytest.mark.parametrize("order", [1, 2, 3])
def test_slender_steel_column_buckles_at_a_point_that_is_located(order, arc_length):
    """P = π² EI/4 L², less P/GA and P/EA (below 5e-5 of it); stiff along by 1e5 of across, where singular matrices are nearest.

    Elements of order 1, of length h and with one point of integration, have (2/h) tan(k h/2) for k = π/2 L.
    """
    half = np.pi / 4 / 20
    P = np.pi**2 * 210e9 * 0.02 * 0.01**3 / 12 / 4
    sections = steel_column([0, 0, "-2000*time"], order=order)
    result = machine(sections).statics(duration=1, step=0.05, arc_length=arc_length)
    assert [event.name for event in result.events] == ["bifurcation"]
    assert result.events[0].time == pytest.approx(
        P / 2000 * ((np.tan(half) / half) ** 2 if order == 1 else 1), rel=1e-4
    )
    assert f"bifurcation at t = {result.events[0].time:.9g} s" in str(result.trust)


def test_arc_length_of_an_imperfect_column_takes_about_as_many_states_as_load_steps():
    """Where time hardly counts any more, states are a tenth of the column apart, whose tip goes by less than twice its length."""
    sections = steel_column([0, "20*time", "-2000*time"])
    result = machine(sections).statics(duration=1, step=0.05, arc_length=True)
    assert result.time[-1] == 1.0
    assert len(result.time) <= 60
    by_loads = machine(sections).statics(duration=1, step=0.05)
    np.testing.assert_allclose(result.array("position")[-1], by_loads.array("position")[-1], atol=1e-8)


@pytest.mark.parametrize(("elements", "order", "close"), [(8, 2, 1e-2), (8, 3, 2e-3), (20, 2, 2e-3)])
def test_free_steel_beam_vibrates(elements, order, close):
    """cos x cosh x = 1: x = 4.730, 7.853, 10.996; f = (x/L)² (EI/ρA)^½/2π, each twice; less what shear and the turning of sections take,
    about (x r/L)² (1 + E/κG)/2 with the radius of gyration r = 2.5 mm: up to 1.5 ‰.
    Its round-off along the beam, of 1e-8 N, is no load: six rigid motions."""
    steel = {"youngs_modulus": 210e9, "poisson_ratio": 0.3, "density": 7850}
    section = {"type": "circle", "radius": 0.005}
    beam = {"from": [0, 0, 0], "to": [1, 0, 0], "section": section, "material": steel}
    result = machine({"beams": {"beam": {**beam, "elements": elements, "order": order}}}).statics(duration=0, modes=12)
    x = np.array([4.730041, 7.853205, 10.995608])
    expected = np.repeat(x**2 * np.sqrt(210e9 * 0.005**2 / 4 / 7850) / (2 * np.pi), 2)
    assert np.array_equal(result.array("vibration_stiffness")[0, :6], np.zeros(6))
    np.testing.assert_allclose(result.array("natural_frequency")[0, 6:], expected, rtol=close)
    assert "6 with frequency zero" in str(result.trust)
    assert np.all(result.array("unstable_directions") == 0)


@pytest.mark.parametrize("elements", [40, 120])
@pytest.mark.parametrize(("held", "x"), [(True, (1.875104, 4.694091)), (False, (4.730041, 7.853205))])
def test_a_wire_vibrates_though_its_sections_have_hardly_any_inertia(elements, held, x):
    """1 m of wire whose sections turn at 1e9 rad/s against shear: no round-off of these hides the low ones. Both ways to eigenvalues."""
    section = {"type": "general", "stiffness": [1e8, 1e8, 1e8, 1e3, 1e3, 1e3], "mass": 1.0, "inertia": [1e-11] * 3}
    sections = {"beams": {"wire": {"from": [0, 0, 0], "to": [1, 0, 0], "section": section, "elements": elements}}}
    if held:
        sections["joints"] = {"root": {"type": "fixed", "bodies": ["ground", "wire.start"], "point": [0, 0, 0]}}
    rigid = 0 if held else 6
    result = machine(sections).statics(duration=0, modes=rigid + 4)
    expected = np.repeat(np.array(x) ** 2 * np.sqrt(1e3) / (2 * np.pi), 2)
    found = result.array("natural_frequency")[0]
    np.testing.assert_array_equal(found[:rigid], 0.0)
    np.testing.assert_allclose(found[rigid:], expected, rtol=4e-3)


@pytest.mark.parametrize("elements", [20, 60])
@pytest.mark.parametrize(("load", "count"), [(0.01, 4), (0.02, 2)])
def test_a_wire_pressed_beyond_its_buckling_load(elements, load, count):
    """ω² = (nπ/L)² (EI (nπ/L)² - P)/ρA of a wire on pins, each twice: the most unstable ones first, and none is a rigid motion."""
    radius, E, density = 2e-4, 210e9, 7850.0
    wire = {
        "from": [0, 0, 0],
        "to": [1, 0, 0],
        "section": {"type": "circle", "radius": radius},
        "material": {"youngs_modulus": E, "poisson_ratio": 0.3, "density": density},
        "elements": elements,
        "order": 2,
    }
    sections = {
        "gravity": [0, 0, 0],
        "beams": {"wire": wire},
        "joints": {
            "start": {
                "type": "universal",
                "bodies": ["ground", "wire.start"],
                "point": [0, 0, 0],
                "axes": [[0, 1, 0], [0, 0, 1]],
            },
            "end": {"type": "point-on-line", "bodies": ["ground", "wire.end"], "point": [1, 0, 0], "axis": [1, 0, 0]},
        },
        "forces": {"pull": {"type": "force", "body": "wire.end", "position": [0, 0, 0], "vector": [-load, 0, 0]}},
    }
    result = machine(sections).statics(duration=0, modes=count)
    n = np.arange(1, 7) * np.pi
    squares = np.sort(np.repeat(n**2 * (E * np.pi * radius**4 / 4 * n**2 - load) / (density * np.pi * radius**2), 2))
    np.testing.assert_allclose(result.array("vibration_stiffness")[0], squares[:count], rtol=5e-3)


def test_curved_cantilever_bends_out_of_its_plane():
    """45° of a circle of 100, loaded across at its tip by 600: Bathe, Bolourchi 1979; tip (15.79, 47.23, 53.37) of Simo, Vu-Quoc 1986 with
    eight linear elements."""
    s, E = np.sqrt(0.5), 1e7
    section = {
        "type": "general",
        "stiffness": [E, E / 2, E / 2, E / 12, E / 12, E / 12],
        "mass": 1.0,
        "inertia": [1, 1, 1],
    }
    middle = [100 * (1 - np.cos(np.pi / 8)), 100 * np.sin(np.pi / 8), 0]
    arc = {"from": [0, 0, 0], "to": [100 * (1 - s), 100 * s, 0], "via": middle, "section": section, "elements": 8}
    sections = {
        "beams": {"arc": arc},
        "joints": {"wall": {"type": "fixed", "bodies": ["ground", "arc.start"], "point": [0, 0, 0]}},
        "forces": {"load": {"type": "force", "body": "arc.end", "vector": [0, 0, "600*time"]}},
    }
    result = machine(sections).statics(duration=1, step=0.5)
    np.testing.assert_allclose(result.array("position")[-1, -1], [15.79, 47.23, 53.37], rtol=5e-3)


def lee_frame(elements, order):
    """Two beams of 120 at a right angle, hinged at their far ends, loaded 24 from the corner; held in its plane by stiffness."""
    E, area, second = 7.2e6, 6.0, 2.0
    G = E / 2.6
    section = {
        "type": "general",
        "stiffness": [E * area, G * area, G * area, 1e3 * E * second, 1e3 * E * second, E * second],
        "mass": 1.0,
        "inertia": [1, 1, 1],
    }

    def beam(a, b, count):
        return {"from": a, "to": b, "section": section, "elements": count, "order": order}

    def pair(kind, a, b, point, **more):
        return {"type": kind, "bodies": [a, b], "point": point, **more}

    return {
        "beams": {
            "column": beam([0, 0, 0], [0, 120, 0], 5 * elements),
            "left": beam([0, 120, 0], [24, 120, 0], elements),
            "right": beam([24, 120, 0], [120, 120, 0], 4 * elements),
        },
        "joints": {
            "foot": pair("revolute", "ground", "column.start", [0, 0, 0], axis=[0, 0, 1]),
            "corner": pair("fixed", "column.end", "left.start", [0, 120, 0]),
            "middle": pair("fixed", "left.end", "right.start", [24, 120, 0]),
            "head": pair("revolute", "ground", "right.end", [120, 120, 0], axis=[0, 0, 1]),
        },
        "forces": {"load": {"type": "force", "body": "left.end", "vector": [0, "-20000*time", 0]}},
    }


def shoot(load, guess):
    """The same frame as a boundary value problem of the planar beam of Reissner: places (2,) of the corner and under the load.

    With the internal force n, r' = (1 + n·d₁/EA) d₁ + (n·d₂/GA) d₂, m' = -r' × n, θ' = m/EI; unknown are the force and the direction at the
    foot.
    """
    E, second = 7.2e6, 2.0
    EA, GA, EI = 6 * E, 6 * E / 2.6, E * second

    def part(begin, n, length):
        def rates(_, y):
            d1, d2 = np.array([np.cos(y[2]), np.sin(y[2])]), np.array([-np.sin(y[2]), np.cos(y[2])])
            r = (1 + n @ d1 / EA) * d1 + (n @ d2 / GA) * d2
            return [r[0], r[1], y[3] / EI, -(r[0] * n[1] - r[1] * n[0])]

        return solve_ivp(rates, (0, length), begin, method="DOP853", rtol=1e-11, atol=1e-9).y[:, -1]

    def ends(unknown):
        n = np.array(unknown[:2]) * 1e4
        corner = part([0, 0, unknown[2], 0], n, 120.0)
        middle = part(corner - [0, 0, np.pi / 2, 0], n, 24.0)
        head = part(middle, n - [0, load], 96.0)
        return corner, middle, head

    found = fsolve(lambda x: np.array(ends(x)[2])[[0, 1, 3]] / [120, 120, 1e5] - [1, 1, 0], guess, xtol=1e-8)
    corner, middle, _ = ends(found)
    return corner[:2], middle[:2]


def test_frame_snaps_back():
    """Lee, Manuel, Rossow 1968: first limit load 18 552 of Simo, Vu-Quoc 1986; all the way against the boundary value problem."""
    result = machine(lee_frame(1, 3)).statics(duration=1.5, step=0.1, arc_length=True)
    assert [event.name for event in result.events] == ["limit point", "limit point"]
    assert 20000 * result.events[0].time == pytest.approx(18552, rel=1e-3)
    assert result.time[-1] == 1.5
    names, position = result.coordinates["body"], result.array("position")
    turned = result.array("foot.angle")
    limits = np.array([event.time for event in result.events])
    # next to limit points the boundary value problem has no inverse
    compared = [k for k in range(4, len(result.time), 6) if np.abs(result.time[k] - limits).min() > 0.02]
    assert len(compared) >= 6
    for k in compared:
        reaction = result.array("foot.force")[k, :2] / 1e4  # on the ground: what the beam pulls with
        corner, middle = shoot(-20000 * result.time[k], [*reaction, np.pi / 2 + turned[k]])
        np.testing.assert_allclose(position[k, names.index("column.end"), :2], corner, atol=0.02)
        np.testing.assert_allclose(position[k, names.index("left.end"), :2], middle, atol=0.02)
    down = position[:, names.index("left.end"), 1]
    assert np.any(np.diff(down) > 0)  # snap-back
    assert down[-1] < down[0]


def two_beams(joint, **more):
    """A clamped beam that carries another one by a joint, which a bushing of the joint's coordinates or the joint itself holds."""
    beam = {"section": general(1e5, 4e4, 80.0, 100.0, 1.0, (0.1, 0.1, 0.1)), "elements": 4}
    return {
        "gravity": [0, 0, -0.5],
        "beams": {
            "first": {"from": [0, 0, 0], "to": [3, 0, 0], **beam},
            "second": {"from": [3, 0, 0], "to": [5, 1, 0], **beam},
        },
        "joints": {
            "wall": {"type": "fixed", "bodies": ["ground", "first.start"], "point": [0, 0, 0]},
            "joint": {"type": joint, "bodies": ["first.end", "second.start"], "point": [3, 0, 0], **more},
        },
        "forces": {
            "pull": {"type": "force", "body": "second.end", "vector": [1, 3, -2]},
            "hold": {
                "type": "bushing",
                "bodies": ["first.end", "second.start"],
                "points": [[3, 0, 0]] * 2,
                "stiffness": [50, 50, 50, 20, 20, 20],
            },
        },
    }


@pytest.mark.parametrize(
    ("joint", "more"),
    [
        ("revolute", {"axis": [0, 0, 1]}),
        ("spherical", {}),
        ("universal", {"axes": [[0, 1, 0], [0, 0, 1]]}),
        ("cylindrical", {"axis": [1, 0, 0]}),
        ("translational", {"axis": [0, 1, 0]}),
        ("planar", {"axis": [0, 0, 1]}),
        ("screw", {"axis": [1, 0, 0], "pitch": 0.3}),
        ("fixed", {}),
    ],
)
def test_eliminated_and_kept_joints_rest_in_the_same_place(joint, more):
    """Every kind of joint between bent beams, to 1e-10 of the machine's size."""
    rest = [machine(two_beams(joint, **more)).statics(coordinates=each) for each in ("absolute", "relative")]
    places = [each.array("position")[0] for each in rest]
    assert np.abs(places[0][-1] - [5, 1, 0]).max() > 0.05
    np.testing.assert_allclose(places[0], places[1], rtol=0, atol=5e-10)
    forces = [each.array("joint_force")[0] for each in rest]
    np.testing.assert_allclose(forces[0], forces[1], rtol=0, atol=1e-8 * np.abs(forces[0]).max())


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_reactions_of_joints_that_carry_a_closed_loop(coordinates):
    """A post on a hinge holds a cantilever by its top: moments about the hinge, P x = F h, and forces in turn from joint to joint."""
    height, load = 0.2, 10.0
    sections = cantilever({"type": "force", "vector": [0, 0, -load]})
    sections["bodies"] = {"post": solid(1.0, 0.1, position=[0, 0, height])}
    sections["joints"] = {
        "hinge": {"type": "revolute", "bodies": ["ground", "rod.start"], "point": [0, 0, 0], "axis": [0, 1, 0]},
        "foot": {"type": "fixed", "bodies": ["rod.start", "post"], "point": [0, 0, 0]},
        "top": {"type": "point-on-line", "bodies": ["ground", "post"], "point": [0, 0, height], "axis": [0, 0, 1]},
    }
    result = machine(sections).statics(coordinates=coordinates)
    force = dict(zip(result.dataset["joint"].values, result.array("joint_force")[0], strict=True))
    push = load * result.dataset["position"].sel(body="rod.end").values[0, 0] / height
    for joint, expected in {"hinge": [-push, 0, -load], "foot": [-push, 0, 0], "top": [push, 0, 0]}.items():
        np.testing.assert_allclose(force[joint], expected, rtol=0, atol=1e-8 * push, err_msg=joint)
