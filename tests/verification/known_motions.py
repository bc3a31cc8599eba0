"""Machines with circuits, gas, control, contact, friction, drives and ropes whose motion is known: in closed form, by the exponential of a
matrix, or by SciPy from equations written here.

`deceiving.py` has machines of mechanics and loads; these have what else a step may get wrong.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import expm
from scipy.optimize import brentq

from nivel import MachineRecord
from nivel.files import parse_machine

CART = """
format: 1
name: {name}
{gravity}
bodies:
  cart: {{mass: {mass}, inertia: [1, 1, 1]{more}}}
joints:
  rail: {{type: translational, bodies: [ground, cart], point: [0, 0, 0], axis: [1, 0, 0]{start}}}
"""
ATMOSPHERE, GRAVITY = 101325.0, 9.81
EXACTLY = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-14, "dense_output": True}


@dataclass(frozen=True)
class Known:
    """text : of the machine. quantity : of its result. exact(time) : what that is. step [s] : that follows it roughly. beside : further
    numbers of the result, speeds, signals, currents, pressures and states, and what they are."""

    name: str
    text: str
    quantity: str
    exact: Callable[[np.ndarray], np.ndarray]
    step: float
    beside: tuple[tuple[str, Callable[[np.ndarray], np.ndarray]], ...] = ()

    def machine(self) -> MachineRecord:
        """The machine, with settings of its own."""
        return parse_machine(self.text)


def cart(name, *, mass=1.0, speed=0.0, place=None, gravity=False):
    """Text of a mass on a rail along x, which gravity presses down where asked."""
    return CART.format(
        name=name,
        mass=mass,
        gravity=f"gravity: [0, -{GRAVITY}, 0]" if gravity else "",
        more=f", velocity: [{speed}, 0, 0]" if speed else "",
        start="" if place is None else f", start: {{displacement: {place}}}",
    )


def linear(A, b, start):
    """x(t) of ẋ = A x + b, by the exponential of [A b; 0 0]; a function of times that gives (n, k)."""
    size = len(A)
    whole = np.zeros((size + 1, size + 1))
    whole[:size, :size], whole[:size, size] = A, b
    first = np.append(start, 1.0)

    def states(time):
        return np.array([(expm(whole * t) @ first)[:size] for t in np.atleast_1d(time)])

    return states


def integrated(rates, start, duration, **more):
    """Dense solution of ẏ = rates(t, y) that is much more exact than what it is compared with."""
    return cache(lambda: solve_ivp(rates, (0.0, duration), start, **(EXACTLY | more)).sol)


def low_pass():
    """A push of 1 N behind a block 1/(τ s + 1): x = t²/2 - τ t + τ² (1 - exp(-t/τ))."""
    tau = 0.05
    text = (
        cart("low-pass")
        + f"""
control: {{lag: {{type: low-pass, input: 1, time_constant: {tau}, start: 0}}}}
forces: {{push: {{type: force, body: cart, vector: [lag.value, 0, 0]}}}}
simulation: {{duration: 1}}
"""
    )
    return Known(
        "low-pass",
        text,
        "cart.position.x",
        lambda t: t**2 / 2 - tau * t + tau**2 * (1.0 - np.exp(-t / tau)),
        1e-2,
        (
            ("control.lag", lambda t: 1.0 - np.exp(-t / tau)),
            ("cart.velocity.x", lambda t: t - tau * (1.0 - np.exp(-t / tau))),
        ),
    )


def continuous_pid():
    """A PID with filtered rate on a mass of 2 kg: states x, v, integral, filtered place. D = kd (d/dt of -y through 1/(T s + 1))."""
    m, kp, ki, kd, filtering, wish = 2.0, 80.0, 60.0, 20.0, 0.02, 0.3
    text = (
        cart("continuous-pid", mass=m)
        + f"""
control:
  hold: {{type: pid, reference: {wish}, measured: rail.displacement, kp: {kp}, ki: {ki}, kd: {kd}, filter_time: {filtering}}}
forces: {{push: {{type: motor, coordinate: rail, effort: hold.value}}}}
simulation: {{duration: 1}}
"""
    )
    # u = kp (r - x) + I + kd (f - x)/T with T f' = x - f
    A = np.array(
        [
            [0.0, 1.0, 0.0, 0.0],
            [-(kp + kd / filtering) / m, 0.0, 1.0 / m, kd / filtering / m],
            [-ki, 0.0, 0.0, 0.0],
            [1.0 / filtering, 0.0, 0.0, -1.0 / filtering],
        ]
    )
    states = linear(A, np.array([0.0, kp * wish / m, ki * wish, 0.0]), np.zeros(4))

    def signal(time):
        x, _, integral, filtered = states(time).T
        return kp * (wish - x) + integral + kd / filtering * (filtered - x)

    beside = (("cart.velocity.x", lambda t: states(t)[:, 1]), ("control.hold", signal))
    return Known("continuous-pid", text, "cart.position.x", lambda t: states(t)[:, 0], 1e-2, beside)


def sampled_control():
    """A force -k x - d v taken every 20 ms and held, on a mass with a spring: exact from sample to sample."""
    m, spring, k, d, period = 1.0, 40.0, 30.0, 4.0, 0.02
    text = (
        cart("sampled-control", mass=m, place=0.2)
        + f"""
control:
  hold: {{type: signal, value: -{k}*rail.displacement - {d}*rail.displacement_rate, sample_time: {period}}}
forces:
  push: {{type: motor, coordinate: rail, effort: hold.value}}
  coil: {{type: joint-spring-damper, coordinate: rail, stiffness: {spring}}}
simulation: {{duration: 1}}
"""
    )
    omega = np.sqrt(spring / m)

    def after(state, t):
        u = (-k * state[0] - d * state[1]) / spring
        c, s = np.cos(omega * t), np.sin(omega * t)
        away = state[0] - u
        return np.array([u + away * c + state[1] / omega * s, -away * omega * s + state[1] * c])

    def sampled(time):
        samples = [np.array([0.2, 0.0])]
        for _ in range(int(time[-1] / period + 1e-9)):
            samples.append(after(samples[-1], period))
        number = np.minimum((time / period + 1e-9).astype(int), len(samples) - 1)
        return [(samples[k], t - k * period) for k, t in zip(number, time, strict=True)]

    def exact(time, which=0):
        return np.array([after(state, since)[which] for state, since in sampled(time)])

    def held(time):
        return np.array([-k * state[0] - d * state[1] for state, _ in sampled(time)])

    beside = (("cart.velocity.x", lambda t: exact(t, 1)), ("control.hold", held))
    return Known("sampled-control", text, "cart.position.x", exact, 1e-2, beside)


def drive():
    """A dc-motor with an inductance that turns a rotor against a viscous load: two linear equations."""
    inertia, R, L, K, viscous, u = 1.0, 2.0, 0.1, 0.5, 0.4, 24.0
    text = f"""
format: 1
name: drive
bodies: {{rotor: {{mass: 1, inertia: [1, 1, {inertia}]}}}}
joints: {{axle: {{type: revolute, bodies: [ground, rotor], point: [0, 0, 0], axis: [0, 0, 1]}}}}
forces:
  motor: {{type: dc-motor, coordinate: axle, voltage: {u}, torque_constant: {K}, resistance: {R}, inductance: {L}, viscous: {viscous}}}
simulation: {{duration: 1}}
"""
    A = np.array([[0.0, 1.0, 0.0], [0.0, -viscous / inertia, K / inertia], [0.0, -K / L, -R / L]])
    states = linear(A, np.array([0.0, 0.0, u / L]), np.zeros(3))
    beside = (
        ("force.motor.speed", lambda t: states(t)[:, 1]),
        ("force.motor.current", lambda t: states(t)[:, 2]),
        ("force.motor.torque", lambda t: K * states(t)[:, 2]),
    )
    return Known("dc-motor", text, "axle.angle", lambda t: states(t)[:, 0], 5e-3, beside)


def bouncing():
    """A mass that falls on a stop without loss: free flight and half a vibration about m g/K, in turns."""
    m, stiffness, height = 1.0, 2e4, 0.2
    text = f"""
format: 1
name: bouncing
gravity: [-{GRAVITY}, 0, 0]
bodies: {{cart: {{mass: {m}, inertia: [1, 1, 1]}}}}
joints:
  rail: {{type: translational, bodies: [ground, cart], point: [0, 0, 0], axis: [1, 0, 0], start: {{displacement: {height}}}}}
forces:
  floor: {{type: stop, coordinate: rail, lower: 0, stiffness: {stiffness}, restitution: 1}}
simulation: {{duration: 1}}
"""
    fall, omega, sag = np.sqrt(2.0 * height / GRAVITY), np.sqrt(stiffness / m), m * GRAVITY / stiffness
    speed = GRAVITY * fall
    touching = 2.0 * (np.pi - np.arctan2(speed / omega, sag)) / omega

    # in contact x = -sag + sag cos - speed/ω sin, until x = 0 again
    def exact(time):
        since = np.mod(time + fall, 2.0 * fall + touching)  # of a period from the bounce before
        free = height - GRAVITY / 2.0 * (since - fall) ** 2
        s = omega * (since - 2.0 * fall)
        held = -sag + sag * np.cos(s) - speed / omega * np.sin(s)
        return np.where(since <= 2.0 * fall, free, held)

    return Known("bouncing", text, "cart.position.x", exact, 1e-3)


def creeping():
    """Coulomb friction by tanh(v/v_t), with steps that follow it: sinh(v/v_t) falls as exp(-μ g t/v_t)."""
    mu, transition, speed = 0.3, 0.2, 1.5
    text = (
        cart("creeping", speed=speed, gravity=True)
        + f"""
forces: {{sole: {{type: friction, coordinate: rail, model: coulomb, coefficient: {mu}, transition_speed: {transition}}}}}
simulation: {{duration: 1}}
"""
    )
    solution = integrated(lambda _t, y: (y[1], -mu * GRAVITY * np.tanh(y[1] / transition)), (0.0, speed), 1.0)
    beside = (("cart.velocity.x", lambda t: solution()(t)[1]),)
    return Known("coulomb-creep", text, "cart.position.x", lambda t: solution()(t)[0], 1e-2, beside)


def stopping():
    """A slide that dry friction brings to rest at v/(μ g), and holds there."""
    mu, speed = 0.3, 1.5
    text = (
        cart("stopping", speed=speed, gravity=True)
        + f"""
forces: {{sole: {{type: friction, coordinate: rail, model: stiction, coefficient: {mu}}}}}
simulation: {{duration: 1}}
"""
    )
    stop = speed / (mu * GRAVITY)

    def exact(time):
        t = np.minimum(time, stop)
        return speed * t - mu * GRAVITY * t**2 / 2.0

    return Known("slide-that-stops", text, "cart.position.x", exact, 5e-3)


def lugre():
    """A mass on a spring that rubs with bristles soft enough to be followed."""
    mu, sigma, damping, k = 0.2, 500.0, 2.0, 60.0
    text = (
        cart("lugre", place=0.3, gravity=True)
        + f"""
forces:
  sole: {{type: friction, coordinate: rail, model: lugre, coefficient: {mu}, bristle_stiffness: {sigma}, bristle_damping: {damping}}}
  coil: {{type: joint-spring-damper, coordinate: rail, stiffness: {k}}}
simulation: {{duration: 1}}
"""
    )

    def rates(_t, y):
        x, v, z = y
        zdot = v - sigma * abs(v) * z / mu
        return v, -k * x - GRAVITY * (sigma * z + damping * zdot), zdot

    solution = integrated(rates, (0.3, 0.0, 0.0), 1.0, max_step=1e-3)
    beside = (("cart.velocity.x", lambda t: solution()(t)[1]), ("force.sole.bristle", lambda t: solution()(t)[2]))
    return Known("lugre", text, "cart.position.x", lambda t: solution()(t)[0], 1e-3, beside)


def rope():
    """A load thrown up that falls into its rope: free flight where the rope is slack, a vibration where it is taut."""
    m, k, length, speed = 2.0, 800.0, 1.0, 2.0
    text = f"""
format: 1
name: rope
gravity: [-{GRAVITY}, 0, 0]
bodies: {{cart: {{mass: {m}, inertia: [1, 1, 1], position: [-0.9, 0, 0], velocity: [{speed}, 0, 0]}}}}
joints:
  rail: {{type: translational, bodies: [ground, cart], point: [-0.9, 0, 0], axis: [1, 0, 0]}}
forces:
  line: {{type: rope, bodies: [ground, cart], points: [[0.6, 0, 0], [-0.9, 0, 0]], stiffness: {k}, length: 2}}
simulation: {{duration: 1}}
"""

    def rates(_t, y):
        return y[1], -GRAVITY + k / m * max(0.6 - y[0] - 2.0 * length, 0.0)

    solution = integrated(rates, (-0.9, speed), 1.0, max_step=1e-3)
    beside = (("cart.velocity.x", lambda t: solution()(t)[1]),)
    return Known("rope", text, "cart.position.x", lambda t: solution()(t)[0], 1e-3, beside)


def winding_state():
    """A state of its own that drives: ṡ = -3 s + x, force 5 - 20 s on a mass; linear."""
    text = (
        cart("state")
        + """
states: {s: {rate: -3*s.value + rail.displacement, start: 0.4}}
forces: {push: {type: motor, coordinate: rail, effort: 5 - 20*s.value}}
simulation: {duration: 1}
"""
    )
    A = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, -20.0], [1.0, 0.0, -3.0]])
    states = linear(A, np.array([0.0, 5.0, 0.0]), np.array([0.0, 0.0, 0.4]))
    beside = (
        ("state.s", lambda t: states(t)[:, 2]),
        ("cart.velocity.x", lambda t: states(t)[:, 1]),
        ("cart.acceleration.x", lambda t: 5.0 - 20.0 * states(t)[:, 2]),
    )
    return Known("state", text, "cart.position.x", lambda t: states(t)[:, 0], 1e-2, beside)


def oil_density(p, air=0.005, density=870.0, modulus=1.5e9, slope=10.0, exponent=1.4):
    """Density at the pressure p: ρ₀/ρ = (1 - α) (1 + β' (p - pa)/β₀)^(-1/β') + α (pa/p)^(1/n)."""
    liquid = (1.0 + slope * (p - ATMOSPHERE) / modulus) ** (-1.0 / slope)
    return density / ((1.0 - air) * liquid + air * (ATMOSPHERE / p) ** (1.0 / exponent))


def oil_pressure(rho):
    """The pressure of a density."""
    return brentq(lambda p: oil_density(p) - rho, 1.0, 1e9, xtol=1e-6, rtol=1e-14)


def cylinder():
    """A single-acting cylinder that lifts a mass on a spring, filled through an orifice from a supply of 60 bar."""
    m, k, piston, dead, viscous = 50.0, 2e5, 0.04, 0.5e-3, 2000.0
    area, edge, drop, corner = np.pi / 4.0 * piston**2, 10e-3 / 60.0, 10e5, 0.5e5
    text = (
        cart("cylinder", mass=m)
        + f"""
hydraulics:
  supply: {{type: tank, pressure: 60 bar}}
  inlet: {{type: orifice, ports: {{A: supply, B: jack.A}}, flow: 10 L/min, pressure_drop: 10 bar}}
  jack: {{type: cylinder, bodies: [ground, cart], points: [[-1, 0, 0], [0, 0, 0]], piston: {piston}, stroke: 0.5, acting: single,
    retracted_length: 0.9, dead_volume_A: {dead}, friction: {{viscous: {viscous}}}, start_A: 10 bar}}
forces: {{coil: {{type: joint-spring-damper, coordinate: rail, stiffness: {k}}}}}
simulation: {{duration: 0.5}}
"""
    )

    def rates(_t, y):
        x, v, mass = y
        rho = mass / (dead + area * (0.1 + x))
        p = oil_pressure(rho)
        gap = 60e5 - p
        flow = edge / np.sqrt(drop) * gap * (gap**2 + corner**2) ** -0.25
        force = (p - ATMOSPHERE) * area - viscous * v - k * x
        return v, force / m, flow * 0.5 * (rho + oil_density(60e5))

    start = (0.0, 0.0, oil_density(10e5) * (dead + area * 0.1))
    solution = integrated(rates, start, 0.5, rtol=1e-10, atol=1e-13)

    def pressure(time):
        x, _, mass = solution()(time)
        return np.array([oil_pressure(each) for each in mass / (dead + area * (0.1 + x))])

    beside = (
        ("hydraulics.jack.pressure_A", pressure),
        ("hydraulics.jack.speed", lambda t: solution()(t)[1]),
    )
    return Known("cylinder", text, "cart.position.x", lambda t: solution()(t)[0], 1e-3, beside)


def blow_down(isothermal):
    """Air that leaves a vessel at 8 bar choked: p falls as exp(-k t), or as (1 + (κ-1)/2 k t)^(-2 κ/(κ-1)) without heat."""
    volume, conductance, ratio, T = 10e-3, 2e-8, 1.4, 293.15
    text = (
        cart("blow-down", speed=1.0)
        + f"""
fluids: {{air: {{type: ideal-gas, isothermal: {str(isothermal).lower()}}}}}
hydraulics:
  vessel: {{type: volume, volume: {volume}, start: 8 bar}}
  room: {{type: tank}}
  nozzle: {{type: orifice, ports: {{A: vessel, B: room}}, sonic_conductance: {conductance}, critical_ratio: 0.3}}
simulation: {{duration: 1}}
"""
    )
    # ṁ = C p ρ_N √(T_N/T), m = p V/(R T), R = p_N/(ρ_N T_N): k = C ρ_N R T₀/V
    rate = conductance * 1e5 / 293.15 * T / volume

    def exact(t):
        if isothermal:
            return 8e5 * np.exp(-rate * t)
        return 8e5 * (1.0 + 0.5 * (ratio - 1.0) * rate * t) ** (-2.0 * ratio / (ratio - 1.0))

    name = "blow-down-isothermal" if isothermal else "blow-down-adiabatic"
    warm = (("hydraulics.vessel.temperature", lambda t: T * (exact(t) / 8e5) ** (1.0 - 1.0 / ratio)),)
    return Known(name, text, "hydraulics.vessel.pressure", exact, 5e-2, () if isothermal else warm)


def gas_spring():
    """A mass that swings on air shut in without heat: p V^1.4 stays."""
    m, piston, dead, reach = 5.0, 0.05, 1e-4, 0.15
    area = np.pi / 4.0 * piston**2
    text = (
        cart("gas-spring", mass=m)
        + f"""
fluids: {{air: {{type: ideal-gas}}}}
hydraulics:
  jack: {{type: cylinder, bodies: [ground, cart], points: [[-1, 0, 0], [0, 0, 0]], piston: {piston}, stroke: 0.5, acting: single,
    retracted_length: {1.0 - reach}, dead_volume_A: {dead}, start_A: 1.3 bar}}
simulation: {{duration: 0.5}}
"""
    )
    begin = dead + area * reach

    def rates(_t, y):
        p = 1.3e5 * (begin / (dead + area * (reach + y[0]))) ** 1.4
        return y[1], (p - ATMOSPHERE) * area / m

    solution = integrated(rates, (0.0, 0.0), 0.5)

    def pressure(time):
        return 1.3e5 * (begin / (dead + area * (reach + solution()(time)[0]))) ** 1.4

    beside = (("hydraulics.jack.pressure_A", pressure), ("cart.velocity.x", lambda t: solution()(t)[1]))
    return Known("gas-spring", text, "cart.position.x", lambda t: solution()(t)[0], 1e-2, beside)


KNOWN = (
    low_pass(),
    continuous_pid(),
    sampled_control(),
    drive(),
    bouncing(),
    creeping(),
    stopping(),
    lugre(),
    rope(),
    winding_state(),
    cylinder(),
    blow_down(isothermal=True),
    blow_down(isothermal=False),
    gas_spring(),
)
