"""User states beside the motion against closed forms: filters, controllers, gas and samples, in all methods."""

from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from nivel.errors import ModelError, SolveError
from nivel.files.reader import parse_machine
from nivel.files.writer import write_machine
from nivel.integrate.catalogue import INTEGRATORS
from running import run
from simulating import G, hinge, machine, simulate, slide, solid

pytestmark = pytest.mark.covering

TAU, OMEGA = 0.1, 7.0
MASS, STIFFNESS, DAMPING, INTEGRAL, WANTED = 2.0, 80.0, 9.0, 60.0, 0.3
PERIOD = 0.05
PRESSURE, VOLUME, AREA, KAPPA = 3e5, 2e-4, 1e-3, 1.4
END = 0.5

# three carts on rails: one with a PI controller, one whose force is held between samples, one on a cushion of gas
CARTS = {
    "bodies": {name: solid(MASS, position=[0, y, 0]) for y, name in enumerate(("controlled", "held", "piston"))},
    "joints": {
        name: slide("ground", body, point=[0, y, 0])
        for y, (name, body) in enumerate({"a": "controlled", "b": "held", "c": "piston"}.items())
    },
    "states": {
        "filter": {"start": 0.5, "rate": f"(sin({OMEGA}*time) - filter.value)/{TAU}"},
        "error": {"rate": f"{WANTED} - a.displacement"},
        "effort": {"update": "1 - 20*b.displacement - 3*b.displacement_rate", "every": PERIOD},
        "samples": {"update": "samples.value + 1", "every": PERIOD, "start": "4"},
        "pressure": {
            "start": "3 bar",
            "units": "Pa",
            "rate": f"-{KAPPA}*pressure.value*{AREA}*c.displacement_rate/({VOLUME} + {AREA}*c.displacement)",
        },
    },
    "forces": {
        "control": {
            "type": "motor",
            "coordinate": "a.displacement",
            "effort": f"{STIFFNESS}*({WANTED} - a.displacement) + {INTEGRAL}*error.value - {DAMPING}*a.displacement_rate",
        },
        "hold": {"type": "motor", "coordinate": "b.displacement", "effort": "effort.value"},
        "gas": {"type": "motor", "coordinate": "c.displacement", "effort": f"{AREA}*(pressure.value - 2e5)"},
    },
}


def filtered(t):
    """x of ẋ = (sin ωt - x)/τ."""
    share = 1.0 / (1.0 + (OMEGA * TAU) ** 2)
    steady = share * (np.sin(OMEGA * t) - OMEGA * TAU * np.cos(OMEGA * t))
    return steady + (0.5 + share * OMEGA * TAU) * np.exp(-t / TAU)


def controlled(t):
    """Displacement and integral of the error, of the linear equations."""
    A = np.array(
        [[0, 1, 0], [-STIFFNESS / MASS, -DAMPING / MASS, INTEGRAL / MASS], [-1.0, 0, 0]],
    )
    b = np.array([0.0, STIFFNESS * WANTED / MASS, WANTED])
    rest = -np.linalg.solve(A, b)
    x = np.array([rest - expm(A * each) @ rest for each in t])
    return x[:, 0], x[:, 2]


def held(t):
    """Displacement of the cart whose force is constant between samples, and that force, which jumps at the samples."""
    x, v, out, force = 0.0, 0.0, [], 0.0
    samples = np.floor(t / PERIOD + 1e-9).astype(int)
    for k in range(samples.max() + 1):
        force = 1.0 - 20.0 * x - 3.0 * v
        out += [(x + v * s + 0.5 * force / MASS * s**2, force) for s in t[samples == k] - k * PERIOD]
        x, v = x + v * PERIOD + 0.5 * force / MASS * PERIOD**2, v + force / MASS * PERIOD
    return np.array(out).T


@cache
def cushion():
    """The motion on the cushion of gas, p (V + A s)^κ constant, as a function of time."""

    def rate(_, y):
        p = PRESSURE * (VOLUME / (VOLUME + AREA * y[0])) ** KAPPA
        return [y[1], AREA * (p - 2e5) / MASS]

    return solve_ivp(rate, (0.0, END), [0.0, 0.0], dense_output=True, rtol=1e-12, atol=1e-13, method="DOP853").sol


def piston(t):
    """Displacement on the cushion of gas."""
    return cushion()(t)[0]


def largest_error(result):
    """Over all quantities, as a share of the size of each."""
    t = result.time
    x, error = controlled(t)
    y, force = held(t)
    s = piston(t)
    expected = {
        "state.filter": filtered(t),
        "a.displacement": x,
        "state.error": error,
        "b.displacement": y,
        "state.effort": force,
        "c.displacement": s,
        "state.pressure": PRESSURE * (VOLUME / (VOLUME + AREA * s)) ** KAPPA,
        "state.samples": 5.0 + np.floor(t / PERIOD + 1e-9),
    }
    return {
        name: float(np.max(np.abs(np.asarray(result[name]) - values)) / np.max(np.abs(values)))
        for name, values in expected.items()
    }


# what each method is off by at most with steps of 1 ms, or a tolerance of 1e-7: some three times what its order makes of the fastest motion
ERRORS = {
    **dict.fromkeys(("euler", "ab1", "am1", "abm1", "gear1"), 0.15),
    **dict.fromkeys(
        ("heun", "ab2", "am2", "abm2", "gear2", "newmark", "hht", "generalised-alpha", "ros2", "extrapolated-euler"),
        2e-3,
    ),
    **dict.fromkeys(("energy-momentum",), 2e-3),
    **dict.fromkeys(("ab3", "am3", "abm3", "gear3", "ab4", "am4", "abm4", "gear4", "ab5", "am5", "abm5"), 2e-5),
    **dict.fromkeys(("rk4", "rkn4"), 1e-7),
    **dict.fromkeys(("dopri5", "dop853", "adams", "gear", "bdf", "radau"), 1e-6),
}
FEW = ("rk4", "generalised-alpha", "dopri5", "bdf", "abm4")


def of_all_methods():
    """Every integrator in every coordinates that admit it; the tails of families are for the long lane."""
    for name in INTEGRATORS:
        for coordinates in ("relative", "absolute", "independent"):
            if name == "energy-momentum" and coordinates != "absolute":
                continue
            short = coordinates == "relative" or name in FEW or name == "energy-momentum"
            tail = name[-1] in "1235" and name not in ("dopri5", "dop853", "ros2")
            yield pytest.param(name, coordinates, marks=[] if short and not tail else [pytest.mark.full])


@pytest.mark.parametrize(("integrator", "coordinates"), list(of_all_methods()))
def test_every_method_follows_states_to_its_order(integrator, coordinates):
    facts = INTEGRATORS[integrator]
    more = {"tolerance": 1e-7} if facts.chooses_steps else {}
    more |= {"stabilisation": "none"} if integrator == "energy-momentum" else {}
    result = simulate(CARTS, integrator=integrator, coordinates=coordinates, duration=END, step=1e-3, **more)
    errors = largest_error(result)
    assert max(errors.values()) < ERRORS[integrator], errors
    assert errors["state.samples"] < 1e-12


@pytest.mark.parametrize("formulation", ["lagrange", "penalty", "augmented-lagrangian"])
def test_every_formulation_follows_states(formulation):
    result = simulate(CARTS, coordinates="absolute", formulation=formulation, duration=END, step=1e-3)
    assert max(largest_error(result).values()) < 1e-6


def test_results_do_not_depend_on_how_a_run_is_cut():
    record = machine(CARTS).record
    for settings in ({"integrator": "dopri5", "tolerance": 1e-6}, {"integrator": "abm4", "step": 1e-3}):
        whole, cut = (run(record, chunk_steps=chunk, duration=END, **settings) for chunk in (None, 1))
        np.testing.assert_array_equal(whole.frames, cut.frames)


def test_verification_sees_the_same_samples():
    """Half the step, and a tenth of the tolerance, take samples at the same times: what differs is the error of the steps alone."""
    for settings in ({"integrator": "rk4", "step": 1e-3}, {"integrator": "dopri5", "tolerance": 1e-7}):
        checked = machine({**CARTS, "simulation": {"duration": END, **settings}}).simulate(verify=True)
        assert checked.trust.accuracy_estimate < 1e-7


def swinging(**more):
    """A wheel that turns at 3 rad/s for ever, a clock that notes when it has turned by 1 rad, and a count of half turns."""
    return {
        "bodies": {"wheel": solid(angular_velocity=[0, 0, 3])},
        "joints": {"axle": hinge("ground", "wheel")},
        "states": {
            "noted": {"update": "time", "event": "at_one"},
            "half_turns": {"update": "half_turns.value + 1", "event": "across"},
        },
        "events": {"at_one": {"when": "axle.angle - 1"}, "across": {"when": "sin(axle.angle)", "direction": "both"}},
        **more,
    }


@pytest.mark.parametrize("coordinates", ["relative", "absolute"])
def test_samples_at_events_are_taken_at_the_event(coordinates):
    result = simulate(swinging(), integrator="dopri5", tolerance=1e-9, duration=10.0, coordinates=coordinates)
    t = result.time
    expected = np.where(t > 1 / 3, 1 / 3, 0.0)
    np.testing.assert_allclose(np.asarray(result["state.noted"]), expected, atol=1e-8)
    np.testing.assert_array_equal(np.asarray(result["state.half_turns"]), np.floor(3 * t / np.pi))


def test_samples_at_events_end_the_step_where_steps_are_fixed():
    result = simulate(swinging(), integrator="rk4", step=1e-2, duration=1.0)
    assert float(np.asarray(result["state.noted"])[-1]) == pytest.approx(
        0.34, abs=1e-12
    )  # the first step end after 1/3 s


LOADED = {
    "gravity": [0, -G, 0],
    "bodies": {"arm": solid(2.0, centre_of_mass=[0.5, 0, 0]), "cart": solid(3.0, position=[0, 1, 0])},
    "joints": {"hinge": hinge("ground", "arm"), "lift": slide("ground", "cart", (0, 1, 0), point=[0, 1, 0])},
    "states": {
        "integral": {"rate": "0.3 - hinge.angle"},
        "filter": {"start": 0.5, "rate": "(hinge.angle - filter.value)/0.1"},
        "held": {"update": "10*filter.value", "every": 0.05},
        "pressure": {
            "start": 1e5,
            "rate": "1e4*(0.02*(5e5 - pressure.value) - 0.01*(pressure.value - 1e5)) - 1e9*lift.displacement_rate",
        },
        "closed": {"start": 7.0, "rate": "-closed.value*lift.displacement_rate"},
    },
    "forces": {
        "control": {
            "type": "motor",
            "coordinate": "hinge.angle",
            "effort": "50*(0.3 - hinge.angle) + 20*integral.value - 5*hinge.angle_rate",
        },
        "spring": {"type": "joint-spring-damper", "coordinate": "lift.displacement", "stiffness": 1000, "damping": 10},
        "push": {"type": "motor", "coordinate": "lift.displacement", "effort": "1e-4*(pressure.value - 1e5)"},
    },
}
PRESSED = (0.02 * 5e5 + 0.01 * 1e5) / 0.03
AT_REST = {
    "hinge.angle": 0.3,
    "lift.displacement": (1e-4 * (PRESSED - 1e5) - 3 * G) / 1000,
    "state.integral": 2 * G * 0.5 * np.cos(0.3) / 20,
    "state.filter": 0.3,
    "state.held": 3.0,
    "state.pressure": PRESSED,
    "state.closed": 7.0,
}


@pytest.mark.parametrize("coordinates", ["relative", "absolute"])
def test_in_statics_rates_are_zero(coordinates):
    result = machine(LOADED).statics(coordinates=coordinates)
    for name, expected in AT_REST.items():
        assert float(np.ravel(result[name])[-1]) == pytest.approx(expected, rel=1e-10, abs=1e-12), name
    assert float(np.ravel(result["unstable_directions"])[-1]) == 0.0


def test_statics_tells_that_a_controller_makes_an_equilibrium_unstable():
    """Inertia J, stiffness 50, damping 0.1, integral gain 20: unstable by Routh and Hurwitz where 50 * 0.1 < 20 J."""
    control = {
        **LOADED["forces"]["control"],
        "effort": "50*(0.3 - hinge.angle) + 20*integral.value - 0.1*hinge.angle_rate",
    }
    result = machine({**LOADED, "forces": {**LOADED["forces"], "control": control}}).statics()
    assert float(np.ravel(result["unstable_directions"])[-1]) == 2.0


@pytest.mark.parametrize("integrator", ["rk4", "generalised-alpha"])
def test_a_run_from_equilibrium_stands_still(integrator):
    result = simulate(
        LOADED, start="equilibrium", duration=0.2, step=1e-3, integrator=integrator, coordinates="relative"
    )
    for name, expected in AT_REST.items():
        np.testing.assert_allclose(np.asarray(result[name]), expected, rtol=1e-8, atol=1e-9, err_msg=name)


def test_a_state_that_never_rests_is_named():
    grows = {**LOADED, "states": {**LOADED["states"], "clock": {"rate": 2.0}}}
    with pytest.raises(SolveError, match="the state clock never rests: its rate is 2 per second"):
        machine(grows).statics()


@pytest.mark.parametrize("asked", [{"modes": 2}, {"buckling": 1}, {"arc_length": True}])
def test_what_statics_cannot_do_with_states_is_refused(asked):
    with pytest.raises(ModelError, match="knows positions alone"):
        machine(LOADED).statics(duration=1.0, **asked)


def test_bristles_are_states_like_others():
    """A block on bristles under a slow push: z of LuGre's law, as force output, as state, and as a signal of a sensor."""
    sections = {
        "bodies": {"block": solid()},
        "joints": {"rail": slide("ground", "block")},
        "forces": {
            "grip": {"type": "friction", "coordinate": "rail.displacement", "model": "lugre", "coefficient": 0.3,
                     "bristle_stiffness": 1e4, "bristle_damping": 10, "normal_load": 10},
            "push": {"type": "motor", "coordinate": "rail.displacement", "effort": "2*time"},
        },
        "sensors": {"z": {"value": "grip.bristle"}},
    }  # fmt: skip
    result = simulate(sections, duration=0.5, step=1e-4)
    z = np.asarray(result["state.grip.bristle"])
    np.testing.assert_array_equal(z, np.asarray(result["force.grip.bristle"]))
    np.testing.assert_array_equal(z, np.asarray(result["sensor.z"]))
    # pushed slowly the bristles carry the load: sigma_0 N z = 2 t
    assert z[-1] == pytest.approx(2 * 0.5 / (1e4 * 10), rel=0.02)


def test_rates_may_be_python_laws_and_tables():
    law = {"source": "def leak(x, gain):\n    return -gain*x\n", "function": "leak", "arguments": ["x.value", 3.0]}
    sections = {
        "bodies": {"wheel": solid()},
        "joints": {"axle": hinge("ground", "wheel")},
        "states": {
            "x": {"start": 2.0, "rate": law},
            "ramp": {"rate": {"times": [0, 1], "values": [0, 1]}},
        },
    }
    result = simulate(sections, duration=1.0, step=1e-3)
    np.testing.assert_allclose(np.asarray(result["state.x"]), 2 * np.exp(-3 * result.time), rtol=1e-10)
    np.testing.assert_allclose(np.asarray(result["state.ramp"]), result.time**2 / 2, atol=1e-12)


def test_states_far_below_their_scale_are_named():
    """x = 1e-6 sin t is followed to the tolerance with its scale, and told to be none of the tolerance's business without."""
    small = {"rate": "1e-6*cos(time)"}
    common = {"bodies": {"wheel": solid()}, "joints": {"axle": hinge("ground", "wheel")}}
    bare = simulate({**common, "states": {"x": small}}, integrator="dopri5", tolerance=1e-6, duration=2.0)
    item = next(item for item in bare.trust.items if item.name == "states")
    assert item.verdict == "amber"
    assert "scale: 1e-06" in item.text
    scaled = simulate(
        {**common, "states": {"x": {**small, "scale": 1e-6}}}, integrator="dopri5", tolerance=1e-6, duration=2.0
    )
    assert all(item.name != "states" for item in scaled.trust.items)
    assert np.max(np.abs(np.asarray(scaled["state.x"]) - 1e-6 * np.sin(scaled.time))) < 1e-11


FAULTS = [
    ({"x": {}}, "a state needs `rate` (it is continuous) or `update` (it is sampled)"),
    ({"x": {"rate": 1, "update": 2}}, "got both"),
    ({"x": {"update": "time"}}, "a sampled state needs `every`"),
    ({"x": {"rate": "time", "every": 1}}, "belongs to a sampled state"),
    ({"x": {"update": "time", "event": "none"}}, "there is no event `none`"),
    ({"x": {"rate": "state.x"}}, "the value of the state `x` is written `x.value`"),
    ({"x": {"rate": "x.pressure"}}, "`x` has no `pressure`"),
    ({"x": {"rate": "1", "scale": -1}}, "a number greater than zero was expected"),
    ({"x": {"rate": "1", "strat": 1}}, "start"),
]


@pytest.mark.parametrize(("states", "message"), FAULTS)
def test_faults_are_told_in_words(states, message):
    with pytest.raises(ModelError) as error:
        machine({**swinging(), "states": states})
    assert message in str(error.value)


def test_samples_between_fixed_steps_are_refused():
    states = {"x": {"update": "time", "every": 0.0015}}
    with pytest.raises(ModelError, match=r"0\.0015 s is no whole number of steps of 0\.001 s"):
        simulate({**swinging(), "states": states}, step=1e-3, duration=0.1)
    simulate({**swinging(), "states": states}, integrator="dopri5", duration=0.1)


def test_states_are_written_and_read_again():
    record = machine(CARTS).record
    assert parse_machine(write_machine(record)) == record
