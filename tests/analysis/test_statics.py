"""Statics beyond closed forms: how Newton's iteration converges, what large machines count, and what failures say."""

import json

import numpy as np
import pytest

from nivel.analysis.statics import critical, linear
from nivel.analysis.statics.newton import EquilibriumError, Iteration, equilibrate
from nivel.analysis.statics.run import prepare_statics
from nivel.analysis.statics.search import settle
from nivel.errors import ModelError, SolveError
from nivel.machine.settings.analyses import StaticsSettings
from simulating import G, hinge, machine, slide, solid
from test_statics_beams import steel_column
from test_statics_closed_forms import chain, column, discrete_euler, four_bar, torsion_pendulum, truss

DOWN = [0, -G, 0]


def equations_of(sections, coordinates="absolute", duration=1.0):
    record = machine(sections).record
    prepared, equations = prepare_statics(record, StaticsSettings(duration=duration, coordinates=coordinates))
    return equations, equations.start(prepared.start)


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_tangent_is_the_derivative_of_the_residual(coordinates, rng):
    """Central differences of r and C along random changes, at a state with multipliers; and along time."""
    sections = four_bar()
    sections["forces"]["push"] = {"type": "force", "body": "coupler", "vector": [0, "3*time^2", 0], "axes": "body"}
    sections["drivers"] = {"turn": {"coordinate": "pivot.angle", "value": "0.1*sin(2*time)"}}
    equations, state = equations_of(sections, coordinates)
    found = settle(equations, state, Iteration())
    tangent, h = found.tangent, 1e-6
    state = found.state
    for _ in range(3):
        q = rng.standard_normal(len(equations.free))
        zero = np.zeros(equations.rows)
        ends = [equations.evaluate(equations.moved(state, linear.Change(sign * h * q, zero))) for sign in (1, -1)]
        slope_r, slope_C = ((a - b) / (2 * h) for a, b in zip(*ends, strict=True))
        np.testing.assert_allclose(tangent.K @ q, slope_r, atol=1e-7)
        np.testing.assert_allclose(tangent.C @ q, slope_C, atol=1e-7)
    still = linear.Change(np.zeros(len(equations.free)), np.zeros(equations.rows))
    ends = [equations.evaluate(equations.moved(state, linear.Change(still.q, still.lam, sign * h))) for sign in (1, -1)]
    slope_r, slope_C = ((a - b) / (2 * h) for a, b in zip(*ends, strict=True))
    np.testing.assert_allclose(tangent.slope, slope_r, atol=1e-8)
    np.testing.assert_allclose(tangent.opening, slope_C, atol=1e-8)


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_stiffness_is_symmetric_in_equilibrium(coordinates):
    """Of conservative forces it is a second derivative, on the motions that the joints allow."""
    equations, state = equations_of(four_bar(), coordinates)
    tangent = settle(equations, state, Iteration()).tangent
    Z = tangent.free_directions
    K = Z.T @ (tangent.K @ Z)
    np.testing.assert_allclose(K, K.T, atol=1e-12 * np.abs(K).max())


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_newton_converges_quadratically(coordinates):
    """Each change is below a multiple of the square of the one before, over four iterations of large rotations."""
    equations, state = equations_of(torsion_pendulum(20.0), coordinates)
    found = settle(equations, state, Iteration())
    away = linear.Change(0.0 * found.moved, np.zeros(equations.rows))
    Z = found.tangent.free_directions[:, 0]
    off = equations.moved(found.state, linear.Change(0.4 * Z / np.abs(Z).max(), away.lam))
    sizes = np.array(equilibrate(equations, off, Iteration(tolerance=1e-13)).sizes)
    used = sizes[sizes > 1e-14]
    assert len(used) >= 3
    assert np.all(used[1:] <= 2.0 * used[:-1] ** 2 + 1e-14)


def test_large_machines_count_as_small_ones_do(monkeypatch):
    """Signs of pivots, and Lanczos's method, against the eigenvalues of full matrices."""
    equations, state = equations_of(chain(30))
    tangent = settle(equations, state, Iteration()).tangent
    shifts = (-0.9, -0.5, -0.41, -1e-2, 0.0)
    monkeypatch.setattr(linear, "DENSE", 10_000)
    counts = [linear.negative_directions(tangent, shift) for shift in shifts]
    values, _ = linear.lowest(tangent, 5, tangent.M)
    monkeypatch.setattr(linear, "DENSE", 10)
    assert [linear.negative_directions(tangent, shift) for shift in shifts] == counts
    assert counts[0] > 10
    assert counts[-1] == 0
    found, shapes = linear.lowest(tangent, 5, tangent.M)
    np.testing.assert_allclose(found, values, rtol=1e-8)
    np.testing.assert_allclose(shapes.T @ (tangent.M @ shapes), np.eye(5), atol=1e-8)
    assert np.abs(tangent.C @ shapes).max() < 1e-8 * np.abs(shapes).max()


def test_buckling_of_large_machines_is_that_of_small_ones(monkeypatch):
    monkeypatch.setattr(linear, "DENSE", 10)
    result = machine(column(40, load="-1*time")).statics(duration=1, step=1, buckling=2, coordinates="absolute")
    found = [each["time"] for each in json.loads(result.attributes["buckling"])]
    np.testing.assert_allclose(found, [discrete_euler(40, 2.0, 1.0, mode) for mode in (1, 2)], rtol=1e-7)


def test_point_masses_do_not_turn():
    """Three springs hold a point mass; its turns are no freedoms without stiffness."""
    sections = {
        "gravity": DOWN,
        "bodies": {"bead": {"point_mass": True, "mass": 1.0, "position": [0, 0, 0]}},
        "forces": {
            f"s{k}": {
                "type": "spring-damper",
                "bodies": ["ground", "bead"],
                "points": [place, [0, 0, 0]],
                "stiffness": 300.0,
                "free_length": 0.5,
            }
            for k, place in enumerate([[1, 0, 0], [-0.5, 0.8, 0.1], [-0.5, -0.8, 0.4], [0, 0, -1]])
        },
    }
    for coordinates in ("absolute", "relative"):
        result = machine(sections).statics(coordinates=coordinates, modes=3)
        assert result.trust.verdict == "green"
        assert np.all(result.array("vibration_stiffness") > 0)


def test_a_machine_that_is_only_free_as_a_whole_rests_where_it_is_drawn():
    """Two bodies with a rigid joint between them: six motions without stiffness, none of parts against each other."""
    weld = {"type": "fixed", "bodies": ["a", "b"], "point": [0.5, 0, 0]}
    sections = {"bodies": {"a": solid(), "b": solid(position=[1, 0, 0])}, "joints": {"weld": weld}}
    for coordinates in ("absolute", "relative"):
        trust = machine(sections).statics(coordinates=coordinates, duration=0).trust
        (free,) = [item for item in trust.items if item.name == "free"]
        assert trust.verdict == free.verdict == "amber"
        assert "nothing holds the machine as a whole in 6 motions" in free.text


def free_bar(*, right=5.0, **more):
    """Two bodies on a slide with a spring, in space; 5 N pull the left one, `right` the right one."""
    return {
        "bodies": {"a": solid(), "b": solid(position=[1, 0, 0])},
        "joints": {"rail": slide("a", "b")},
        "forces": {
            "coil": {"type": "joint-spring-damper", "coordinate": "rail.displacement", "stiffness": 100.0},
            "left": {"type": "force", "body": "a", "vector": [-5.0, 0, 0]},
            "right": {"type": "force", "body": "b", "vector": [right, 0, 0]},
        },
        **more,
    }


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_loads_that_balance_each_other_need_no_ground(coordinates):
    """The spring stretches by F/k; about its axis and along all three nothing holds the bar, and turned it swings back:
    ω² = F l/(2 I + 2 m l²/4)."""
    result = machine(free_bar()).statics(coordinates=coordinates, duration=0, modes=6)
    assert result.array("rail.displacement")[-1] == pytest.approx(0.05, rel=1e-9)
    squares = result.array("vibration_stiffness")[-1]
    mass, inertia = solid()["mass"], solid()["inertia"][1]
    turning = 5.0 * 1.05 / (2 * inertia + mass * 1.05**2 / 2)
    np.testing.assert_allclose(squares[:4], 0.0, atol=1e-12 * turning)
    np.testing.assert_allclose(squares[4:6], turning, rtol=1e-9)
    assert result.trust.verdict == "amber"


def test_a_path_of_a_free_machine_whose_loads_grow_and_turn():
    """Loads F(t) (cos φ, sin φ) and their opposite: the bar turns by φ, and its spring stretches by F/k."""
    bar = free_bar()
    for name, sign in (("left", "-"), ("right", "")):
        bar["forces"][name]["vector"] = [f"{sign}(2+time)*cos(time)", f"{sign}(2+time)*sin(time)", 0]
    result = machine(bar).statics(duration=1, step=0.2)
    np.testing.assert_allclose(result.array("rail.displacement"), (2.0 + result.time) / 100.0, rtol=1e-9)
    along = result.array("b.position") - result.array("a.position")
    np.testing.assert_allclose(np.arctan2(along[:, 1], along[:, 0]), result.time, atol=1e-9)


def test_loads_that_do_not_balance_each_other_are_told_with_their_sum():
    failing(free_bar(right=7.0), r"their sum is \(2, 0, 0\) N", duration=0)
    bar = free_bar()
    bar["forces"]["twist"] = {"type": "torque", "body": "a", "vector": [3.0, 0, 0]}
    failing(bar, r"their sum is a moment of \(3, .*\) N m", duration=0)


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_of_a_free_mechanism_the_motion_of_its_parts_is_named(coordinates):
    pin = {"type": "revolute", "bodies": ["a", "b"], "point": [0.5, 0, 0], "axis": [0, 0, 1]}
    sections = {"bodies": {"a": solid(), "b": solid(position=[1, 0, 0])}, "joints": {"pin": pin}}
    error = failing(sections, "is a mechanism", coordinates=coordinates, duration=0)
    assert "pin.angle" in f"{error} {error.advice}"


# --- failures ---


def failing(sections, match, **options):
    with pytest.raises(SolveError, match=match) as caught:
        machine(sections).statics(**options)
    assert caught.value.advice
    assert caught.value.result.outcome == "failed"
    assert caught.value.result.trust.verdict == "red"
    return caught.value


@pytest.mark.parametrize(
    ("sections", "names"),
    [
        ({"bodies": {"b": solid()}, "joints": {"rail": slide("ground", "b")}}, "the joint rail, coordinate rail.displ"),
        (
            {"bodies": {"b": solid(position=[0.5, 0, 0])}, "joints": {"pin": hinge("ground", "b")}},
            "the joint pin, coordinate pin.angle",
        ),
        (
            {
                "gravity": DOWN,
                "bodies": {"rod": solid(position=[0.5, 0, 0])},
                "joints": {
                    "a": {"type": "spherical", "bodies": ["ground", "rod"], "point": [0, 0, 0]},
                    "b": {"type": "distance", "bodies": ["ground", "rod"], "points": [[1, 1, 0], [1, 0, 0]]},
                },
            },
            "rod, its turn about its x axis",
        ),
    ],
)
def test_mechanisms_are_named_with_what_moves(sections, names):
    error = failing(sections, names)
    assert "no stiffness" in error.message
    assert len(error.result.time) == 0


def test_what_falls_for_ever_is_named():
    failing({"gravity": DOWN, "bodies": {"stone": solid()}}, r"their sum is \(0, -9.81, 0\) N")


def test_forces_that_are_no_numbers_are_named():
    sections = {
        "bodies": {"b": solid()},
        "joints": {"g": slide("ground", "b")},
        "forces": {
            "s": {"type": "joint-spring-damper", "coordinate": "g.displacement", "stiffness": 10.0},
            "f": {"type": "force", "body": "b", "vector": ["sqrt(0.5-time)", 0, 0]},
        },
    }
    error = failing(sections, "not a number")
    assert error.result.time[-1] == pytest.approx(0.5, abs=1e-4)
    sections["forces"]["f"]["vector"] = ["sqrt(time-1)", 0, 0]
    with pytest.raises(SolveError, match="the force f is not a number at t = 0 s"):
        machine(sections).statics()


def test_a_driver_that_leads_out_of_reach_ends_where_the_machine_is_stretched():
    """Two links of 1 m: their end cannot be pulled further than 2 m, reached at t = 0.5 s."""
    sections = {
        "gravity": DOWN,
        "bodies": {
            "a": solid(1.0, 0.1, position=[0.25, -0.433012701892, 0]),
            "b": solid(1.0, 0.1, position=[0.75, -0.433012701892, 0]),
            "end": solid(1.0, 0.1, position=[1.0, 0, 0]),
        },
        "joints": {
            "j0": hinge("ground", "a", (0, 0, 0)),
            "j1": hinge("a", "b", (0.5, -0.866025403784, 0)),
            "j2": {"type": "point-on-line", "bodies": ["b", "end"], "point": [1.0, 0, 0], "axis": [0, 0, 1]},
            "rail": slide("ground", "end", point=[1.0, 0, 0]),
        },
        "drivers": {"pull": {"coordinate": "rail.displacement", "value": "2*time"}},
    }
    error = failing(sections, "stopped at t = 0.49")
    assert 0.49 < error.result.time[-1] < 0.5
    # closed form until there: x = 1 + 2 t
    x = error.result.array("end.position")[:, 0]
    np.testing.assert_allclose(x, 1 + 2 * error.result.time, atol=1e-9)


def test_friction_that_holds_at_rest_is_refused():
    sections = torsion_pendulum(6.0)
    rubbing = {"type": "friction", "coordinate": "pin.angle", "coefficient": 0.3, "radius": 0.02, "normal_load": 10}
    sections["forces"]["rub"] = {**rubbing, "model": "stiction"}
    with pytest.raises(ModelError, match="many equilibria") as caught:
        machine(sections).statics()
    assert caught.value.faults[0].path == "forces.rub.model"
    plain = machine(torsion_pendulum(6.0)).statics()
    sections["forces"]["rub"] = {**rubbing, "model": "coulomb", "transition_speed": 0.01}
    result = machine(sections).statics()
    np.testing.assert_allclose(result.array("pin.angle"), plain.array("pin.angle"), atol=1e-12)
    assert any("coulomb friction" in item.text for item in result.trust.items)


def test_all_faults_of_options_at_once():
    options = {"duration": "-1 s", "step": "2 kg", "tolerance": "often", "modes": -3, "coordinates": "polar"}
    with pytest.raises(ModelError) as caught:
        machine(truss()).statics(**options)
    assert {fault.path for fault in caught.value.faults} == {
        f"statics.{name}" for name in ("duration", "step", "tolerance", "modes", "coordinates")
    }
    with pytest.raises(ModelError, match="longer than the duration"):
        machine(truss()).statics(duration=1, step=2)
    with pytest.raises(ModelError, match="above zero"):
        machine(truss()).statics(duration=0, arc_length=True)


def test_duration_without_loads_that_change_gives_one_state():
    assert len(machine(torsion_pendulum(6.0)).statics().time) == 1
    assert len(machine(torsion_pendulum(6.0)).statics(duration=1, step=0.25).time) == 5


def test_states_stand_in_the_file_as_in_memory(tmp_path):
    in_memory = machine(truss()).statics(duration=1, step=0.1, arc_length=True, modes=1)
    stored = machine(truss()).statics(duration=1, step=0.1, arc_length=True, modes=1, out=tmp_path / "a.nc")
    for name in ("position", "path", "natural_frequency", "joint_force", "unstable_directions"):
        np.testing.assert_array_equal(stored.array(name), in_memory.array(name))
    assert stored.attributes["analysis"] == "statics"
    assert "velocity" not in stored.variables
    assert stored.dataset["position"].shape == in_memory.array("position").shape


@pytest.mark.parametrize("width", [1e-3, 1.0])
def test_critical_point_that_is_not_reached_is_said_to_be_between_two_states(width, monkeypatch):
    """No equilibrium within `width` of the buckling load is found: the report has the states on both sides of it, and no time."""
    sections = steel_column([0, 0, "-2000*time"], order=2)
    exact = machine(sections).statics(duration=1, step=0.1)
    load = exact.events[0].time
    first = critical.equilibrate

    def failing(equations, state, *rest):
        if abs(state.t - load) < width:
            raise EquilibriumError("nothing is found here", state)
        return first(equations, state, *rest)

    monkeypatch.setattr(critical, "equilibrate", failing)
    result = machine(sections).statics(duration=1, step=0.1)
    point = json.loads(result.attributes["critical_points"])[0]
    low, high = point["between"]
    assert not point["exact"]
    assert low < load < high
    assert high - low <= min(0.1 + 1e-9, 6 * width)
    assert f"{point['kind']} between the states of t = {low:.9g} s and {high:.9g} s" in str(result.trust)
