"""Gradients of runs against closed forms, and against differences of runs."""

import sys
from pathlib import Path
from types import ModuleType, SimpleNamespace

import numpy as np
import pytest

import nivel
from nivel.analysis.gradients.check import Slope, check
from nivel.analysis.gradients.gradient import Varied
from nivel.analysis.gradients.outputs import outputs_of, parameters_of, value_of
from nivel.analysis.plan.plan import plan_run
from nivel.gradients import jax_function, torch_function, value_and_gradient
from nivel.report.write import report_html, tornados

pytestmark = pytest.mark.compiles  # runs on dual numbers, which `nivel warmup` leaves out

EXAMPLES = Path(__file__).parents[2] / "examples"

FALLING = """
format: 1
name: falling
parameters: {height: 2.0, g: 9.81, v: 0.5}
gravity: [0, 0, -g]
bodies: {ball: {mass: 2, inertia: [1, 1, 1], position: [0, 0, height], velocity: [v, 0, 0]}}
events: {landing: {when: ball.z, direction: falling, stop: true}}
simulation: {duration: 1 s, step: 10 ms, integrator: rk4}
"""

SWINGING = """
format: 1
name: swinging
parameters: {stiffness: 50.0, mass: 2.0, start: 0.1, speed: 0.0}
bodies: {block: {mass: mass, inertia: [1, 1, 1], position: [start, 0, 0], velocity: [speed, 0, 0]}}
joints: {rail: {type: translational, bodies: [ground, block], point: [0, 0, 0], axis: [1, 0, 0]}}
forces: {spring: {type: force, body: block, vector: [-stiffness*block.x, 0, 0]}}
simulation: {duration: 1 s, step: 2 ms, integrator: rk4}
"""

PRESSED = """
format: 1
name: pressed
gravity: [0, 0, -9.81]
bodies: {ball: {shape: {type: sphere, radius: 0.1}, mass: 2, position: [0, 0, 0.0996]}}
forces: {floor: {type: contact, body: ball, plane: {body: ground}, stiffness: 1e6, exponent: 1, restitution: 0.9}}
simulation: {duration: 0.02 s, step: 2 ms}
"""

# the velocity is not written
PUSHED = """
format: 1
name: pushed
bodies: {block: {mass: 2, inertia: [1, 1, 1]}}
joints: {rail: {type: translational, bodies: [ground, block], point: [0, 0, 0], axis: [1, 0, 0]}}
inputs: {push: {rest: 3, range: [-10, 10], units: N}}
forces: {drive: {type: motor, coordinate: rail, effort: push.value}}
simulation: {duration: 1 s, step: 10 ms, integrator: rk4}
"""

CLOSED = """
format: 1
name: four-bar
parameters: {crank: 1.0, base: 2.5}
gravity: [0, -9.81, 0]
bodies:
  crank: {mass: 3, inertia: [0.1, 0.3, 0.3], position: [crank/2, 0, 0]}
  coupler: {mass: 5, inertia: [0.1, 2, 2], position: [crank, 1, 0], orientation: {axis: [0, 0, 1], angle: pi/2}}
  rocker: {mass: 4, inertia: [0.1, 1, 1], position: [(crank + base)/2, 2, 0]}
joints:
  pivot: {type: revolute, bodies: [ground, crank], point: [0, 0, 0], axis: [0, 0, 1]}
  pin: {type: spherical, bodies: [crank, coupler], point: [crank, 0, 0]}
  knee: {type: cylindrical, bodies: [coupler, rocker], point: [crank, 2, 0], axis: [0, 0, 1]}
  foot: {type: revolute, bodies: [rocker, ground], point: [base, 2, 0], axis: [0, 0, 1]}
simulation: {duration: 0.3 s, step: 2 ms, output_interval: 10 ms, integrator: rk4}
"""


def loaded(tmp_path, text):
    path = tmp_path / "machine.yaml"
    path.write_text(text, encoding="utf-8")
    return nivel.load(path)


def richardson(machine, outputs, parameter, h, **settings):
    """Slopes of the outputs by differences of runs over h and 2 h, of order four."""
    value = float(machine[parameter])

    def run(x):
        result = machine.with_values({parameter: x}).simulate(verify=False, **settings)
        return [value_of(each, result) for each in outputs_of(outputs, result)]

    near, far = (
        [(up - down) / (2 * k * h) for up, down in zip(run(value + k * h), run(value - k * h), strict=True)]
        for k in (1, 2)
    )
    return [(4 * a - b) / 3 for a, b in zip(near, far, strict=True)]


def slope(found, output, parameter):
    return found[f"d({output})/d({parameter})"].to_numpy()


def test_of_a_fall_by_its_closed_form(tmp_path):
    # z = h - g t²/2 and x = v t, which rk4 follows exactly; the landing is at t = √(2 h/g)
    machine = loaded(tmp_path, FALLING)
    parameters = ["parameters.height", "parameters.g", "parameters.v"]
    found = machine.gradient(
        [
            "ball.position.z at 0.3 s",
            "ball.position.x",
            "time(landing)",
            "max(ball.position.z)",
            "integral(ball.position.x)",
            "peak(ball.velocity.z)",
        ],
        parameters,
        check=False,
    )
    t = np.sqrt(2.0 * 2.0 / 9.81)
    assert found["time(landing)"].item() == pytest.approx(t, rel=1e-10)
    assert [slope(found, "ball.position.z at 0.3 s", each).item() for each in parameters] == pytest.approx(
        [1.0, -0.045, 0.0], abs=1e-9
    )
    assert slope(found, "time(landing)", parameters[0]).item() == pytest.approx(1.0 / (9.81 * t), rel=1e-7)
    assert slope(found, "time(landing)", parameters[1]).item() == pytest.approx(-0.5 * t / 9.81, rel=1e-7)
    # where the run ends moves with the landing
    assert slope(found, "ball.position.x", parameters[0]).item() == pytest.approx(0.5 / (9.81 * t), rel=1e-7)
    assert slope(found, "ball.position.x", parameters[2]).item() == pytest.approx(t, rel=1e-7)
    assert slope(found, "integral(ball.position.x)", parameters[0]).item() == pytest.approx(
        0.5 * t / (9.81 * t), rel=1e-7
    )
    assert slope(found, "max(ball.position.z)", parameters[0]).item() == pytest.approx(1.0, abs=1e-9)
    # v = -g t is largest at the landing, where |v| = √(2 g h)
    assert found["peak(ball.velocity.z)"].item() == pytest.approx(9.81 * t, rel=1e-9)
    assert slope(found, "peak(ball.velocity.z)", parameters[0]).item() == pytest.approx(1.0 / t, rel=1e-7)


def test_inputs_states_and_sums_by_their_closed_forms(tmp_path):
    # x = v t + F t²/2 m, so ∂x/∂F = t²/2 m and ∂x/∂v = t; the work F x has the slope x + F t²/2 m along F
    machine = loaded(tmp_path, PUSHED)
    parameters = ["inputs.push.rest", "bodies.block.velocity.0"]
    found = machine.gradient(
        ["block.position.x", "external_work", "integral(block.velocity.x)"], parameters, check=False
    )
    for output in ("block.position.x", "integral(block.velocity.x)"):
        assert [slope(found, output, each).item() for each in parameters] == pytest.approx([0.25, 1.0], abs=1e-9)
    assert slope(found, "external_work", parameters[0]).item() == pytest.approx(0.75 + 3.0 * 0.25, abs=1e-9)


@pytest.mark.parametrize("integrator", ["rk4", "dopri5", "bdf", "generalised-alpha"])
def test_of_a_vibration_by_its_closed_form(tmp_path, integrator):
    # x = a cos ωt: ∂x/∂k = -a t sin(ωt)/(2 √(k m)), and each method follows it to its own error
    machine = loaded(tmp_path, SWINGING)
    settings = {"tolerance": 1e-10} if integrator in ("dopri5", "bdf") else {}
    parameters = ["parameters.stiffness", "parameters.mass", "parameters.start"]
    found = machine.gradient("block.position.x", parameters, check=False, integrator=integrator, **settings)
    w, a, k, m = 5.0, 0.1, 50.0, 2.0
    of_rate = -a * np.sin(w)
    exact = [of_rate / (2 * np.sqrt(k * m)), -of_rate * w / (2 * m), np.cos(w)]
    near = 2e-4 if integrator == "generalised-alpha" else 1e-7
    assert [slope(found, "block.position.x", each).item() for each in parameters] == pytest.approx(exact, abs=near)
    assert found["d(block.position.x)/d(parameters.mass)"].attrs["units"] == "m"


@pytest.mark.parametrize(
    ("coordinates", "integrator"), [("relative", "rk4"), ("absolute", "rk4"), ("relative", "generalised-alpha")]
)
def test_lengths_of_closed_loops_move_what_is_corrected(tmp_path, coordinates, integrator):
    # the value is closed, so without passes for the slopes nothing would bring these onto the moved constraints
    machine = loaded(tmp_path, CLOSED)
    settings = {"coordinates": coordinates, "integrator": integrator}
    settings |= {"corrector": {"tolerance": 1e-13}} if integrator != "rk4" else {"stabilisation": "direct"}
    outputs, parameters = ["rocker.position", "rms(crank.velocity)"], ["parameters.base", "bodies.coupler.mass"]
    found = machine.gradient(outputs, parameters, **settings)
    assert found.attrs["verdict"] == "green"
    for parameter in parameters:
        expected = richardson(machine, outputs, parameter, 1e-4, **settings)
        for output, exact in zip(outputs, expected, strict=True):
            got = slope(found, output, parameter)
            assert np.max(np.abs(got - exact)) <= 1e-7 * max(1.0, np.max(np.abs(exact)))


def test_a_slope_that_steps_cut_is_told(tmp_path):
    # the force goes up in steps: its slope is nothing almost everywhere, and yet it depends on what it is made of
    text = SWINGING.replace("-stiffness*block.x", "-0.001*floor(1000*stiffness*block.x)")
    found = loaded(tmp_path, text).gradient("block.position.x", ["parameters.stiffness", "parameters.mass"])
    assert found.attrs["verdict"] == "red"
    assert found["d(block.position.x)/d(parameters.stiffness)"].attrs["verdict"] == "red"


def _checked(slopes, at, values, far=0.01, step_error=0.0):
    """What the check says of slopes along parameters of a function of these."""

    def moved(k, share):
        point = np.array(values)
        point[k] *= 1.0 + share
        return [np.array(at(point))]

    by_scale = np.array(slopes) * values
    (found,) = check([Slope(by_scale, np.full(len(values), step_error), 1.0)], moved, None, [far] * len(values))
    return found.lights


def test_a_wrong_slope_is_red_and_a_right_one_beside_it_is_green():
    def product(x):
        return x[0] ** 2 * x[1]

    assert _checked([12.0, 4.0], product, [2.0, 3.0]) == ("green", "green")
    assert _checked([12.0, 4.0 * (1 + 1e-3)], product, [2.0, 3.0]) == ("green", "amber")
    assert _checked([12.0, 0.0], product, [2.0, 3.0]) == ("green", "red")
    assert _checked([12.0, np.nan], product, [2.0, 3.0]) == ("green", "amber")
    assert _checked([12.0, 4.0], product, [2.0, 3.0], step_error=0.5) == ("amber", "amber")


def test_what_shows_over_a_long_way_only_is_not_green():
    # goes up in steps of 1e-3: over a short way its slope is that of what the steps leave out
    def stairs(x):
        return x[0] + 1e-3 * np.floor((x[0] + 4e-4) / 1e-3)

    assert _checked([1.0], stairs, [1.0], far=0.01) == ("amber",)
    assert _checked([1.0], stairs, [1.0], far=1e-4) == ("green",)


def test_bends_over_a_long_way_are_no_contradiction():
    # a vibration after 30 periods: over a change of 1 % its phase moves by 2 rad
    assert _checked([200.0 * np.cos(200.0)], lambda x: np.sin(200.0 * x[0]), [1.0], far=0.01) == ("green",)


def test_round_off_of_an_output_is_no_contradiction():
    random = np.random.default_rng(1)

    def constant(_):
        return 3.75 * (1.0 + 1e-14 * random.standard_normal())

    assert _checked([1e-14, 0.0], constant, [2.0, 3.0]) == ("green", "green")


def test_a_machine_without_integrator_has_the_one_of_its_run(tmp_path):
    machine = loaded(tmp_path, PRESSED)
    plan = plan_run(machine.record)
    assert plan.is_open
    varied = Varied(machine, plan, "")
    result = machine.simulate(verify=False)
    last = result.settings.get("went_on", {}).get("integrator", result.settings["integrator"])
    assert varied.settings.integrator == last
    run = varied.run({"bodies.ball.mass": 2.0})
    assert run.time.shape == result.time.shape
    np.testing.assert_allclose(run.array("position"), result.array("position"), rtol=1e-7)


def test_what_the_file_computes_from_a_parameter_follows_it_in_the_comparison(tmp_path):
    machine = loaded(tmp_path, FALLING)
    found = machine.gradient(
        "ball.position.z", ["parameters.height", "bodies.ball.position.2"], integrator="rk4", duration=0.2
    )
    assert found.attrs["verdict"] == "green"
    for each in ("parameters.height", "bodies.ball.position.2"):
        assert slope(found, "ball.position.z", each) == pytest.approx(1.0, rel=1e-9)


def test_a_wheel_of_another_radius_turns_otherwise():
    """Angles of a wheel that rolls straight on grow by v t/r, whose slope by r is t (v' - v/r)/r."""
    machine, radius = nivel.load(EXAMPLES / "vehicles" / "bicycle.yaml"), "parameters.front"
    angles, speed = ("front_hub.angle at 0.02 s", "front_hub.angle at 0.04 s"), "front_wheel.velocity.x"
    found = machine.gradient([*angles, speed], [radius], integrator="rk4", duration=0.04, check=False)
    v, r = float(found[speed]), machine[radius]
    grown = slope(found, angles[1], radius) - slope(found, angles[0], radius)
    assert abs(grown) == pytest.approx(abs(0.02 * (slope(found, speed, radius) - v / r) / r), rel=1e-7)


def test_what_has_no_gradient_is_refused_by_its_name(tmp_path):
    machine = loaded(tmp_path, FALLING)
    with pytest.raises(nivel.ModelError, match=r"`integrator: extrapolated-euler` has no gradients.*ros2 or radau"):
        machine.gradient("ball.position.z", "parameters.g", integrator="extrapolated-euler")
    with pytest.raises(nivel.ModelError, match=r"`integrator: energy-momentum` has no gradients.*generalised-alpha"):
        machine.gradient("ball.position.z", "parameters.g", integrator="energy-momentum", stabilisation="none")
    with pytest.raises(nivel.ModelError, match="settings of a run are no parameters"):
        parameters_of(machine, ["simulation.step"])
    with pytest.raises(nivel.ModelError, match="is a number"):
        parameters_of(machine, ["bodies.ball"])


def test_unknown_outputs_are_told_all_at_once(tmp_path):
    machine = loaded(tmp_path, FALLING)
    with pytest.raises(nivel.ModelError) as told:
        machine.gradient(["ball.zz", "maximum(ball.position.z)", "ball.position.z at 9 s"], "parameters.g", check=False)
    text = str(told.value)
    assert "ball.zz" in text
    assert "maximum" in text
    assert "from 0 s to" in text
    with pytest.raises(nivel.ModelError, match="landing"):
        machine.gradient("time(takeoff)", "parameters.g", check=False)


def test_parameters_have_units_and_scales(tmp_path):
    machine = loaded(tmp_path, FALLING)
    mass, place, gravity = parameters_of(machine, ["bodies.ball.mass", "bodies.ball.position.2", "gravity.2"])
    assert (mass.units, mass.scale) == ("kg", 2.0)
    assert (place.units, gravity.units) == ("m", "m/s^2")


def test_a_function_for_optimisers_finds_a_stiffness(tmp_path):
    from scipy.optimize import minimize

    machine = loaded(tmp_path, SWINGING)
    # mean of (x - x*)² is least, and nothing, where the motion is that of the stiffness 60
    f = value_and_gradient(machine, "block.position.x", ["parameters.stiffness"])
    wanted, _ = f([60.0])

    def miss(x):
        value, slopes = f(x)
        return (value - wanted) ** 2, 2.0 * (value - wanted) * slopes

    assert minimize(miss, [55.0], jac=True, tol=1e-14).x == pytest.approx([60.0], rel=1e-4)
    with pytest.raises(nivel.ModelError, match="array of shape"):
        value_and_gradient(machine, "block.position", ["parameters.stiffness"])([50.0])
    with pytest.raises(nivel.ModelError, match="one for each parameter"):
        f([1.0, 2.0])


@pytest.mark.parametrize("library", ["jax", "torch"])
def test_without_a_library_its_extra_is_named(tmp_path, monkeypatch, library):
    monkeypatch.setitem(sys.modules, library, None)
    make = {"jax": jax_function, "torch": torch_function}[library]
    with pytest.raises(nivel.ModelError, match=rf"pip install 'nivel\[{library}\]'"):
        make(loaded(tmp_path, SWINGING), ["block.position.x"], ["parameters.mass"])


def test_in_torch_gradients_go_on_from_the_run(tmp_path):
    torch = pytest.importorskip("torch")
    f = torch_function(loaded(tmp_path, SWINGING), ["block.position.x"], ["parameters.stiffness", "parameters.mass"])
    x = torch.tensor([50.0, 2.0], dtype=torch.float64, requires_grad=True)
    (3.0 * f(x)).sum().backward()
    rate = -0.1 * np.sin(5.0)
    assert x.grad.numpy() == pytest.approx([3.0 * rate / 20.0, -3.0 * rate * 5.0 / 4.0], abs=1e-6)


def test_in_jax_gradients_go_on_from_the_run(tmp_path):
    jax = pytest.importorskip("jax")
    jax.config.update("jax_enable_x64", True)
    f = jax_function(loaded(tmp_path, SWINGING), ["block.position.x"], ["parameters.stiffness", "parameters.mass"])
    rate = -0.1 * np.sin(5.0)
    found = jax.jit(jax.grad(lambda x: 3.0 * f(x)[0]))(jax.numpy.array([50.0, 2.0]))
    assert np.asarray(found) == pytest.approx([3.0 * rate / 20.0, -3.0 * rate * 5.0 / 4.0], abs=1e-6)


class _Saved:
    """What of PyTorch the bridge uses, for arrays of NumPy."""

    def save_for_backward(self, *tensors):
        self.saved_tensors = tensors


class _Tensor(np.ndarray):
    device = "cpu"

    def detach(self):
        return self

    cpu = double = detach

    def numpy(self):
        return np.asarray(self)


def test_the_bridge_to_torch_weighs_the_slopes(tmp_path, monkeypatch):
    stub = ModuleType("torch")
    stub.autograd = SimpleNamespace(Function=type("Function", (), {"apply": None}))
    stub.as_tensor = lambda x, dtype, device: np.asarray(x, dtype)
    monkeypatch.setitem(sys.modules, "torch", stub)
    machine, names = loaded(tmp_path, SWINGING), ["parameters.stiffness", "parameters.mass"]
    monkeypatch.setattr(stub.autograd.Function, "apply", classmethod(lambda cls, ctx, x: (cls, cls.forward(ctx, x))))
    ctx, x = _Saved(), np.array([50.0, 2.0]).view(_Tensor)
    run, values = torch_function(machine, ["block.position.x", "block.velocity.x"], names)(ctx, x)
    found = machine.gradient(["block.position.x", "block.velocity.x"], names, check=False)
    assert values == pytest.approx([found["block.position.x"].item(), found["block.velocity.x"].item()])
    expected = [
        sum(w * slope(found, f"block.{o}.x", n).item() for w, o in ((2.0, "position"), (-1.0, "velocity")))
        for n in names
    ]
    assert run.backward(ctx, np.array([2.0, -1.0])) == pytest.approx(expected)


def test_results_carry_sensitivities_and_the_report_draws_them(tmp_path):
    machine, names = loaded(tmp_path, SWINGING), ["parameters.start", "bodies.block.mass", "parameters.speed"]
    result = machine.simulate(sensitivities=names, out=tmp_path / "run.nc", verify=False)
    again = nivel.open_result(tmp_path / "run.nc")
    # x = a cos ωt: ∂x/∂a = cos ωt, ∂x/∂v₀ = sin ωt/ω
    assert again["d(block.position.x)/d(parameters.start)"].to_numpy() == pytest.approx(
        np.cos(5.0 * again.time), abs=1e-7
    )
    of_speed = again["d(rail.displacement)/d(parameters.speed)"]
    assert of_speed.to_numpy() == pytest.approx(np.sin(5.0 * again.time) / 5.0, abs=1e-7)
    assert again["d(rail.displacement.rate)/d(bodies.block.mass)"].attrs["units"] == "m/s/kg"
    assert again.dataset["d(velocity)/d(bodies.block.mass)"].dims == ("time", "body", "xyz")
    assert np.array_equal(result.array("position"), machine.simulate(verify=False).array("position"))
    (tornado,) = tornados(again)
    change = {bar.parameter: bar.change for bar in tornado.bars}
    # the displacement is counted from the start: a (cos ωt - 1)
    assert change["parameters.start"] == pytest.approx(
        0.01 * 0.1 * (np.cos(5.0) - 1.0) / np.ptp(again.array("rail.displacement"))
    )
    assert [abs(bar.change) for bar in tornado.bars] == sorted((abs(bar.change) for bar in tornado.bars), reverse=True)
    page = report_html(again)
    assert "What moves the end of the run" in page
    assert "not compared" in page
    assert "What moves the end of the run" not in report_html(machine.simulate(verify=False))


@pytest.mark.full
@pytest.mark.parametrize("integrator", ["generalised-alpha", "bdf"])
def test_constants_of_circuits_have_slopes(integrator):
    # flows, ranges and widths of circuits stand in arithmetic, where a slope that is left out is no error but a wrong gradient
    machine = nivel.load(EXAMPLES / "hydraulics" / "cylinder-boom.yaml")
    names = [
        "relief.flow",
        "relief.opening_range",
        "valve.flow",
        "lift.piston",
        "lift.friction.viscous",
        "pump.displacement",
    ]
    settings = {"tolerance": 1e-9} if integrator == "bdf" else {}
    found = machine.gradient(
        "hinge.angle", [f"hydraulics.{name}" for name in names], duration=0.3, integrator=integrator, **settings
    )
    assert found.attrs["verdict"] == "green"
    assert abs(found["d(hinge.angle)/d(hydraulics.relief.flow)"].item()) > 1e-3
