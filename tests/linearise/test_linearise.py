"""Linear equations against one-degree-of-freedom derivations, closed forms of rotors, nonlinear runs, and each other."""

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.optimize import brentq
from scipy.signal import lsim

import nivel
from example_files import rigid_example
from nivel.elements.control.controllers import Pid
from references import four_bar, one_dof, slider_crank

EXAMPLES = "examples"


def sorted_values(model):
    """Eigenvalues, the imaginary part deciding."""
    return np.array(sorted(model.eigenvalues, key=lambda z: (round(z.imag, 9), round(z.real, 9))))


# --- a linkage with a spring on its crank, one equation ---

STIFFNESS, DAMPING = 4000.0, 30.0
CRANKS = {"slider-crank": (slider_crank, "hinge"), "four-bar": (four_bar, "crank_pivot")}


@pytest.fixture(params=CRANKS)
def sprung(request):
    """(linkage, angles at which the spring is slack and the machine rests, machine with a spring and a damper on its crank)."""
    module, joint = CRANKS[request.param]
    record = nivel.load(rigid_example(request.param)).record
    spring = nivel.JointSpringDamper(name="spring", coordinate=joint, stiffness=STIFFNESS, damping=DAMPING)
    machine = nivel.Machine.from_record(record.replace(forces=(*record.forces, spring)))
    start, still = machine.simulate(duration="1 ms", step="1 ms"), machine.statics(duration=0)
    begin, rest = (angle_of(request.param, each.array("crank.position")[0]) for each in (start, still))
    # the coordinate may be zero elsewhere, and turn the other way
    c, d = (float(each.array(f"{joint}.angle")[0]) for each in (start, still))
    slack = begin - c * (rest - begin) / (d - c)
    return module.LINKAGE, (slack, rest), machine


def angle_of(name, place):
    """The angle of the reference linkage from the place of its crank."""
    x, y, z = place
    return np.arctan2(y, -z) if name == "slider-crank" else np.arctan2(y, x)


def reference(linkage, angles):
    """(m, d, k) of δφ at equilibrium: (m φ̈ + ½ m' φ̇² + d φ̇ + k₁ (φ - φ₀) = Q) made linear, Q' = U''."""

    slack, rest = angles

    def left(angle):
        return float(one_dof.scalar_equation(linkage, np.array([angle]))[2][0]) - STIFFNESS * (angle - slack)

    angle = brentq(left, rest - 0.01, rest + 0.01, xtol=1e-15)
    _, _, second, _ = one_dof.curvature_of(linkage, np.array([angle]))
    mass = float(one_dof.scalar_equation(linkage, np.array([angle]))[0][0])
    slope = float(np.einsum("b,nbx,x->", linkage.mass, second, linkage.gravity))
    return mass, DAMPING, STIFFNESS - slope


@pytest.mark.parametrize("coordinates", ["relative", "absolute"])
def test_a_sprung_linkage_vibrates_as_its_single_equation_says(sprung, coordinates):
    linkage, slack, machine = sprung
    m, d, k = reference(linkage, slack)
    model = machine.linearise(about="equilibrium", coordinates=coordinates)
    wanted = np.roots([m, d, k])
    np.testing.assert_allclose(sorted_values(model), sorted(wanted, key=lambda z: z.imag), rtol=1e-8)
    assert model.steady
    assert model.stable


def test_without_the_stiffness_of_reactions_the_frequency_would_be_wrong(sprung):
    """So the test above sees it: Zᵀ K Z without ∂(C_qᵀ λ)/∂q differs by more than a part in 1e4."""
    linkage, slack, _ = sprung
    _, _, k = reference(linkage, slack)
    assert abs(k - STIFFNESS) > 1e-4 * STIFFNESS


def test_second_order_matrices_are_those_of_the_single_equation(sprung):
    """In relative coordinates the independent one is an angle or length x with φ' = dx/dφ: m scales with its square."""
    linkage, slack, machine = sprung
    m, d, k = reference(linkage, slack)
    model = machine.linearise(about="equilibrium", coordinates="relative")
    np.testing.assert_allclose(model.K[0, 0] / model.M[0, 0], k / m, rtol=1e-8)
    np.testing.assert_allclose(model.damping[0, 0] / model.M[0, 0], d / m, rtol=1e-8)


def test_the_response_to_a_small_load_agrees_to_second_order_in_its_size(sprung):
    """Halving the torque divides the difference of linear and nonlinear motion by four."""
    _, _, machine = sprung
    joint = machine.record.forces[-1].coordinate
    system = machine.linearise(about="equilibrium", inputs=[joint], outputs=[joint]).state_space()
    errors = []
    for torque in (80.0, 40.0):
        push = nivel.Motor(name="push", coordinate=joint, effort=f"{torque} * (1 - exp(-20*time))")
        loaded = nivel.Machine.from_record(machine.record.replace(forces=(*machine.record.forces, push)))
        run = loaded.simulate(duration=0.4, step="0.5 ms", output_interval="0.5 ms", start="equilibrium")
        _, linear, _ = lsim(system, torque * (1.0 - np.exp(-20.0 * run.time)), run.time)
        angle = run.array(joint)
        errors.append(np.abs(angle - angle[0] - linear).max())
    assert 3.6 < errors[0] / errors[1] < 4.4


# --- spin: a rotor on a gimbal, in closed form ---

J_ARM, J_ROTOR, C_ROTOR, SPIN, GRAVITY = 0.1, 0.1, 0.2, 30.0, 9.81


def gyroscope(angle=0.0, spin=SPIN):
    """A rotor of 1 kg a metre below a gimbal, on an arm of 2 kg; angle : of the rotor at the start."""
    arm = nivel.Body(name="arm", mass=2.0, inertia=(J_ARM, J_ARM, 0.02), position=(0, 0, -0.5))
    rotor = nivel.Body(
        name="rotor",
        mass=1.0,
        inertia=(J_ROTOR, J_ROTOR, C_ROTOR),
        position=(0, 0, -1),
        orientation={"axis": (0, 0, 1), "angle": angle},
        angular_velocity=(0, 0, spin),
    )
    gimbal = nivel.Joint(
        name="gimbal", type="universal", bodies=("ground", "arm"), point=(0, 0, 0), axes=((1, 0, 0), (0, 1, 0))
    )
    shaft = nivel.Joint(name="shaft", type="revolute", bodies=("arm", "rotor"), point=(0, 0, -1), axis=(0, 0, 1))
    return nivel.Machine("gyroscope", bodies=[arm, rotor], joints=[gimbal, shaft], gravity=(0, 0, -GRAVITY))


def nutation_and_precession(spin):
    """ω of I ω² ± H ω - m g l = 0: a heavy symmetrical rotor, hanging."""
    inertia = J_ARM + 2.0 * 0.25 + J_ROTOR + 1.0
    moment = (2.0 * 0.5 + 1.0) * GRAVITY
    momentum = C_ROTOR * spin
    root = np.sqrt(momentum**2 + 4.0 * inertia * moment)
    return sorted([(root - abs(momentum)) / (2.0 * inertia), (root + abs(momentum)) / (2.0 * inertia)])


@pytest.mark.parametrize("spin", [30.0, -30.0, 2.0])
@pytest.mark.parametrize("angle", [0.0, 1.1])
def test_a_spinning_rotor_has_the_same_eigenvalues_in_every_sense_and_phase(spin, angle):
    model = gyroscope(angle, spin).linearise()
    found = [mode.eigenvalue for mode in model.modes if not mode.structural]
    np.testing.assert_allclose([z.imag for z in found], nutation_and_precession(spin), rtol=1e-9)
    assert max(abs(z.real) for z in found) < 1e-12
    assert model.steady


def test_the_angle_and_speed_of_a_rotor_are_structural_zeros():
    model = gyroscope().linearise()
    zero = [mode for mode in model.modes if mode.structural]
    assert [mode.eigenvalue for mode in zero] == [0.0, 0.0]
    assert {name for mode in zero for name, _ in mode.participation} == {"shaft.angle", "shaft.angle.rate"}
    assert "exactly zero" in model.structural_zeros[0]


def test_turns_about_the_axes_of_a_spinning_body_are_not_taken_for_constant_coefficients():
    """An unsymmetrical rotor on an unsymmetrical arm has constant coefficients neither in its axes nor in those of the ground."""
    machine = gyroscope()
    arm, rotor = machine.record.bodies
    bodies = (arm.replace(inertia=(0.1, 0.4, 0.4)), rotor.replace(inertia=(0.1, 0.15, 0.2)))
    machine = nivel.Machine.from_record(machine.record.replace(bodies=bodies))
    for coordinates in ("absolute", "relative"):
        model = machine.linearise(coordinates=coordinates)
        assert not model.steady
        assert model.summary()["modes"] == []
        assert "describe no motion" in model.notes[1]


# --- identities ---


def test_eigenvalues_do_not_depend_on_coordinates_or_place():
    """A double pendulum on a cart, and the same machine turned and shifted."""
    models = [chain(turn).linearise(coordinates=name) for turn in (False, True) for name in ("relative", "absolute")]
    first = sorted_values(models[0])
    for other in models[1:]:
        np.testing.assert_allclose(sorted_values(other), first, rtol=1e-9, atol=1e-9)


def chain(turned):
    axes = np.array([[0.0, 0.6, -0.8], [1.0, 0.0, 0.0], [0.0, -0.8, -0.6]]) if turned else np.eye(3)
    shift = np.array([3.0, -2.0, 5.0]) if turned else np.zeros(3)

    def at(*x):
        return tuple(axes @ np.array(x) + shift)

    def along(*x):
        return tuple(axes @ np.array(x))

    turn = {"matrix": tuple(tuple(row) for row in axes)}
    bodies = [
        nivel.Body(name="cart", mass=3.0, inertia=(0.1, 0.1, 0.1), position=at(0, 0, 0), orientation=turn),
        nivel.Body(name="a", mass=1.0, inertia=(0.02, 0.03, 0.04), position=at(0, -0.5, 0), orientation=turn),
        nivel.Body(name="b", mass=2.0, inertia=(0.05, 0.03, 0.02), position=at(0, -1.5, 0), orientation=turn),
    ]
    joints = [
        nivel.Joint(
            name="rail", type="translational", bodies=("ground", "cart"), point=at(0, 0, 0), axis=along(1, 0, 0)
        ),
        nivel.Joint(name="p", type="revolute", bodies=("cart", "a"), point=at(0, 0, 0), axis=along(0, 0, 1)),
        nivel.Joint(name="q", type="spherical", bodies=("a", "b"), point=at(0, -1, 0)),
    ]
    forces = [nivel.JointSpringDamper(name="s", coordinate="rail", stiffness=50.0, damping=2.0)]
    return nivel.Machine("chain", bodies=bodies, joints=joints, forces=forces, gravity=along(0, -9.81, 0))


def test_a_is_the_derivative_of_the_rates_of_the_state():
    """A moving double pendulum, which is not in equilibrium: δẇ by central differences of the equations of motion."""

    def machine(value):
        record = chain(False).record
        first = record.joints[1].replace(start_rates={"angle": 1.3}, start={"angle": value})
        second = nivel.Joint(
            name="q", type="revolute", bodies=("a", "b"), point=(0, -1, 0), axis=(0, 0, 1), start={"angle": 0.3}
        ).replace(start_rates={"angle": -0.7})
        rail = record.joints[0].replace(start={"displacement": 0.1}, start_rates={"displacement": 0.2})
        return nivel.Machine.from_record(record.replace(joints=(rail, first, second)))

    model = machine(0.4).linearise(coordinates="relative")
    k, rate = model.states.index("p.angle"), model.states.index("p.angle.rate")
    size = 1e-4
    high, low = (
        machine(0.4 + each).simulate(duration="1 us", step="1 us").array("a.angular_acceleration.z")[0]
        for each in (size, -size)
    )
    assert model.A[rate, k] == pytest.approx((high - low) / (2.0 * size), rel=1e-6)


def test_forces_and_accelerations_feed_through():
    """A mass on a spring: G(0) = 1/k from the force to the place, 1/m at once to the acceleration, -1 to a driver that holds it."""
    body = nivel.Body(name="m", mass=2.0, inertia=(1, 1, 1))
    rail = nivel.Joint(name="rail", type="translational", bodies=("ground", "m"), point=(0, 0, 0), axis=(1, 0, 0))
    spring = nivel.JointSpringDamper(name="s", coordinate="rail", stiffness=50.0, damping=3.0)
    sensor = nivel.Sensor(name="felt", coordinate="rail", quantity="acceleration")
    machine = nivel.Machine("mass", bodies=[body], joints=[rail], forces=[spring], sensors=[sensor])
    model = machine.linearise(inputs=["rail.displacement", "m.force.x"], outputs=["rail.displacement", "felt"])
    response = model.frequency_response([1e-9, 1.0])
    np.testing.assert_allclose(response.sel(output="rail.displacement")[0], 1.0 / 50.0, rtol=1e-9)
    np.testing.assert_allclose(model.D, [[0.0, 0.0], [0.5, 0.5]], atol=1e-14)
    s = 2j * np.pi
    np.testing.assert_allclose(response.to_numpy()[1, 0], np.full(2, 1.0 / (2.0 * s * s + 3.0 * s + 50.0)), rtol=1e-12)


def test_a_driver_as_input_is_the_acceleration_of_what_it_prescribes():
    """A pendulum on a driven cart: θ̈ = -(g θ + ẍ)/l for a point mass; the effort is (M + m) ẍ + m l θ̈."""
    cart = nivel.Body(name="cart", mass=3.0, inertia=(1, 1, 1))
    bob = nivel.Body(name="bob", mass=1.0, inertia=(1e-9, 1e-9, 1e-9), position=(0, -2, 0))
    joints = [
        nivel.Joint(name="rail", type="translational", bodies=("ground", "cart"), point=(0, 0, 0), axis=(1, 0, 0)),
        nivel.Joint(name="pin", type="revolute", bodies=("cart", "bob"), point=(0, 0, 0), axis=(0, 0, 1)),
    ]
    driver = nivel.Driver(name="pull", coordinate="rail", value="0*time")
    machine = nivel.Machine("crane", bodies=[cart, bob], joints=joints, drivers=[driver], gravity=(0, -9.81, 0))
    model = machine.linearise(outputs=["pin.angle", "driver.pull.effort"])
    assert model.inputs == ("pull",)
    rate, angle = model.states.index("pin.angle.rate"), model.states.index("pin.angle")
    assert model.A[rate, angle] == pytest.approx(-9.81 / 2.0, rel=1e-8)
    assert model.B[rate, 0] == pytest.approx(-0.5, rel=1e-8)
    assert model.D[1, 0] == pytest.approx(4.0 - 1.0, rel=1e-8)
    assert sum(mode.structural for mode in model.modes) == 2


def test_states_of_controllers_take_part_and_can_be_inputs():
    """A filter ẋ = (φ - x)/τ beside an oscillator; as an input its value enters, and it is no state."""
    body = nivel.Body(name="m", mass=2.0, inertia=(1, 1, 1))
    rail = nivel.Joint(name="rail", type="translational", bodies=("ground", "m"), point=(0, 0, 0), axis=(1, 0, 0))
    spring = nivel.JointSpringDamper(name="s", coordinate="rail", stiffness=50.0)
    motor = nivel.Motor(name="act", coordinate="rail", effort="-7*low.value")
    state = nivel.State(name="low", rate="(rail.displacement - low.value)/0.1", start=0.0, scale=1.0)
    machine = nivel.Machine("loop", bodies=[body], joints=[rail], forces=[spring, motor], states=[state])
    model = machine.linearise(outputs=["rail.displacement"])
    wanted = np.linalg.eigvals([[0.0, 1.0, 0.0], [-25.0, 0.0, -3.5], [10.0, 0.0, -10.0]])
    np.testing.assert_allclose(sorted_values(model), sorted(wanted, key=lambda z: z.imag), rtol=1e-10)
    opened = machine.linearise(inputs=["state.low"], outputs=["rail.displacement"])
    assert opened.states == ("rail.displacement", "rail.displacement.rate")
    np.testing.assert_allclose(opened.B, [[0.0], [-3.5]], rtol=1e-10)


def test_free_bodies_have_twelve_zeros_each_but_for_their_spring():
    a, b = (nivel.Body(name=n, mass=1.0, inertia=(1, 2, 2.5), position=(x, 0, 0)) for n, x in (("a", 0), ("b", 1)))
    spring = nivel.SpringDamper(
        name="s", bodies=("a", "b"), points=((0, 0, 0), (1, 0, 0)), stiffness=100.0, damping=0.1, free_length=1.0
    )
    model = nivel.Machine("free", bodies=[a, b], forces=[spring]).linearise()
    assert int(model.structural.sum()) == 22
    np.testing.assert_allclose(np.abs(model.eigenvalues[~model.structural]), np.sqrt(200.0), rtol=1e-9)


def test_a_beam_has_the_frequencies_of_statics():
    """The damped ones of a curved cantilever under its load."""
    machine = nivel.load(f"{EXAMPLES}/beams/bend-45.yaml")
    found = machine.statics(duration=0, modes=3)
    model = machine.linearise(about="equilibrium")
    slowest = [mode for mode in model.modes if mode.eigenvalue.imag > 0.0][:3]
    damped = [mode.eigenvalue.imag / (2.0 * np.pi) for mode in slowest]
    np.testing.assert_allclose(damped, found.array("damped_frequency")[0], rtol=1e-6)
    np.testing.assert_allclose([-m.eigenvalue.real for m in slowest], found.array("decay_rate")[0], rtol=1e-5)


# --- what is said ---


def test_a_machine_at_rest_out_of_balance_is_not_given_eigenvalues():
    model = nivel.load(f"{EXAMPLES}/mechanisms/simple-pendulum.yaml").linearise()
    assert not model.steady
    assert "not in equilibrium" in model.notes[0]


def test_a_moment_of_a_run_is_linearised_there():
    machine = nivel.load(f"{EXAMPLES}/mechanisms/simple-pendulum.yaml")
    model = machine.linearise(about="0.3 s")
    angle = machine.simulate(duration=0.3).array("hinge.angle")[-1]
    rate = model.states.index("hinge.angle.rate")
    # the bob is at -x at the start: θ̈ = -(g/l) sin(θ_from_below), with θ measured from the start
    assert model.A[rate, 0] == pytest.approx(-9.81 * np.cos(angle - np.pi / 2.0), rel=1e-6)
    assert model.time == pytest.approx(0.3)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"about": "noon"}, "`start`, `equilibrium`, `rotation` or a time"),
        ({"about": "-1 s"}, "zero or more"),
        ({"inputs": "henge.angle"}, "there is no input `henge.angle`; did you mean hinge.angle"),
        ({"outputs": ["hinge.anglee", "x"]}, "there is no output"),
        ({"coordinates": "polar"}, "absolute, relative"),
    ],
)
def test_bad_options_are_explained(given, said):
    with pytest.raises(nivel.ModelError, match=said):
        nivel.load(f"{EXAMPLES}/mechanisms/simple-pendulum.yaml").linearise(**given)


def test_friction_that_sticks_is_refused():
    with pytest.raises(nivel.ModelError, match="has no derivative where it sticks"):
        nivel.load(f"{EXAMPLES}/contact/friction-brake.yaml").linearise()


def test_a_model_without_inputs_has_no_response():
    model = nivel.load(f"{EXAMPLES}/mechanisms/simple-pendulum.yaml").linearise(about="equilibrium")
    with pytest.raises(nivel.ModelError, match="no inputs: name some"):
        model.state_space()


def test_an_opened_driver_leaves_zeros_and_nothing_that_looks_like_motion():
    """A driven lift at rest: its driver's place and speed, and no ±1e-7 of round-off."""
    model = nivel.load(f"{EXAMPLES}/mechanisms/scissor-lift.yaml").linearise()
    assert model.inputs == ("push",)
    np.testing.assert_array_equal(model.eigenvalues, [0.0, 0.0])
    assert model.structural.all()


def test_double_vibrations_without_damping_neither_grow_nor_decay():
    """A round beam bends alike both ways: pairs of equal eigenvalues, which round-off would part into a growing and a decaying one."""
    model = nivel.load(f"{EXAMPLES}/beams/spin-up.yaml").linearise()
    assert model.stable
    assert not np.any(model.eigenvalues.real)


def test_a_continuous_controller_is_part_of_the_loop():
    """A PID with a filtered derivative on a pendulum: (I s² + m g h + kp)(1 + τ s) + kd s = 0."""
    bar = nivel.Body(name="bar", mass=2.0, inertia=(0.1, 0.1, 0.1), position=(0, 0, -0.5))
    hinge = nivel.Joint(name="hinge", type="revolute", bodies=("ground", "bar"), point=(0, 0, 0), axis=(0, 1, 0))
    motor = nivel.Motor(name="motor", coordinate="hinge", effort="pid.value")
    given = {"name": "pid", "input": "0 - hinge.angle", "kp": 5, "kd": 1, "filter_time": 0.02}

    def machine(**more):
        block = Pid(**given, **more)
        return nivel.Machine(
            "loop", bodies=[bar], joints=[hinge], forces=[motor], control=[block], gravity=(0, 0, -9.81)
        )

    stiff = 2.0 * 9.81 * 0.5 + 5.0
    wanted = np.roots([0.6 * 0.02, 0.6, stiff * 0.02 + 1.0, stiff])
    found = machine().linearise(about="equilibrium")
    np.testing.assert_allclose(np.sort_complex(found.eigenvalues), np.sort_complex(wanted), rtol=1e-9)
    # between samples the command stays, here at 0: M = 0.6, h = m g l sin φ
    held = machine(sample_time=0.01).mechanics()
    assert held.mass_matrix([0.3]) == pytest.approx(np.array([[0.6]]), rel=1e-12)
    assert abs(held.bias([0.3], [0.0])) == pytest.approx([2.0 * 9.81 * 0.5 * np.sin(0.3)], rel=1e-12)


@pytest.mark.parametrize("latency", [0.0, 0.5, 1.0, 1.5])
def test_a_sampled_controller_has_the_poles_of_its_difference_equations(latency):
    """u_k = kp e_k + D_k, D_k = a D_{k-1} + (1 - a) kd (e_k - e_{k-1})/T; a pendulum that takes u a latency later."""
    T, tau, kp, kd = 0.03, 0.02, 5.0, 1.0
    bar = nivel.Body(name="bar", mass=2.0, inertia=(0.1, 0.1, 0.1), position=(0, 0, -0.5))
    hinge = nivel.Joint(name="hinge", type="revolute", bodies=("ground", "bar"), point=(0, 0, 0), axis=(0, 1, 0))
    motor = nivel.Motor(name="motor", coordinate="hinge", effort="pid.value")
    pid = Pid(name="pid", input="0 - hinge.angle", kp=kp, kd=kd, filter_time=tau, sample_time=T, latency=latency * T)
    loop = nivel.Machine("loop", bodies=[bar], joints=[hinge], forces=[motor], control=[pid], gravity=(0, 0, -9.81))
    found = loop.linearise(about="equilibrium").sampled
    a, plant = tau / (tau + T), np.array([[0.0, 1.0, 0.0], [-2.0 * 9.81 * 0.5 / 0.6, 0.0, 1.0 / 0.6], [0.0, 0.0, 0.0]])

    def over(share, held):
        """(θ, ω) after a share of the period with the command that stands at `held` of (θ, ω, D, e, u, u before, u before that)."""
        moved, out = expm(plant * share * T), np.eye(8)
        out[:2, :2] = moved[:2, :2]
        out[:2, held] += moved[:2, 2]
        return out[:7, :7] if share else np.eye(7)

    sample = np.eye(7)
    sample[2, :4] = [-(1.0 - a) * kd / T, 0.0, a, -(1.0 - a) * kd / T]
    sample[3] = -np.eye(7)[0]
    sample[5:] = np.eye(7)[4:6]
    sample[4] = sample[2] + kp * sample[3]
    late, whole = latency % 1.0, int(latency)
    # until the latency is over the command before acts
    wanted = over(1.0 - late, 4 + whole) @ over(late, 5 + whole) @ sample
    poles = np.linalg.eigvals(wanted)
    poles = poles[np.abs(poles) > 1e-6]
    mine = found.poles[np.abs(found.poles) > 1e-6]
    np.testing.assert_allclose(np.sort_complex(mine), np.sort_complex(poles), atol=1e-9)


def test_an_input_of_the_machine_is_an_input_of_its_linear_equations():
    """A motor of 30 N times a lever on 5 kg: v' = 6 u."""
    table = nivel.Body(name="table", mass=5.0, inertia=(0.1, 0.1, 0.1))
    rail = nivel.Joint(name="rail", type="translational", bodies=("ground", "table"), point=(0, 0, 0), axis=(1, 0, 0))
    drive = nivel.Motor(name="drive", coordinate="rail", effort="30*lever.value")
    machine = nivel.Machine("sled", bodies=[table], joints=[rail], forces=[drive], inputs=[nivel.Input(name="lever")])
    model = machine.linearise(inputs=["lever"])
    assert model.inputs == ("lever",)
    np.testing.assert_allclose(model.B[:, 0], [0.0, 6.0], rtol=1e-12)


def test_what_a_pump_has_delivered_is_no_state_of_the_loop():
    model = nivel.load(f"{EXAMPLES}/hydraulics/cylinder-boom.yaml").linearise(about="equilibrium")
    assert model.steady
    assert not [name for name in model.states if name.startswith("state.hydraulics.")]
