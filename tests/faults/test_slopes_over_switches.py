"""Slopes over switches: carts side by side in one machine, each with one thing that switches on its way, and the slope of where it ends.

A slope is right within its estimated error, or not green. What a step of fixed size contains is no part of the slopes of that step alone.
"""

import numpy as np
import pytest

import nivel
from lanes import tail

pytestmark = pytest.mark.compiles  # runs on dual numbers, which `nivel warmup` leaves out

FAST = 40.0  # [rad/s] of springs that are met, carts have 1 kg
PLACE, TIME = 0.3, 0.41237  # [m], [s] where and when forces switch
PERIOD = 0.05  # [s] of samples

# name: force on the cart, speed at the begin [m/s]
CARTS = {
    "place": ("if(place.displacement > at, -2, 1)", 0.5),
    "instant": ("if(time < turn, 1, -2)", 0.5),
    "event": ("mode.value", 0.55),
    "corner": ("-9*max(corner.displacement - 0.3, 0)", 0.7),
    "table": ("{of: table.displacement, points: [0, 0.3, 1], values: [0, 0, -6.3]}", 0.65),
    "steps": ("-floor(5*steps.displacement)", 0.9),
    "dry": ("-if(dry.displacement_rate > 0, 1, -1)", 0.6),
    "sampled": ("held.value", 0.45),
    "relay": ("relay", 0.5),
    "stop": ("0", 0.7),
    "rub": ("0", 0.6),
    "driven": ("0", 1.0),
    "lead": ("-1", 1.5),
    "struck": ("0", 0.0),
    "ram": ("0", 0.8),
    "engaged": ("0", 0.0),
    "engine": ("0", 1.2),
}


def machine_file(names):
    """The machine with these carts."""
    k, way = FAST**2, {name: f"{name}_way" if name == "relay" else name for name in CARTS}
    more = {
        "stop": f"{{type: stop, coordinate: stop, upper: 0.3, stiffness: {k}, restitution: 1}}",
        "rub": "{type: friction, coordinate: rub, model: stiction, coefficient: rough, normal_load: 1}",
        "lead": "{type: freewheel, coordinate: lead, against: driven}",
        "struck": f"{{type: shaft, coordinate: struck, against: ram, stiffness: {k}, backlash: 1.2}}",
        "engaged": "{type: clutch, coordinate: engaged, against: engine, capacity: 1}",
    }
    bodies, joints, forces = [], [], []
    for n, name in enumerate(names):
        effort, speed = CARTS[name]
        place = f"[0, {0.5 * n}, 0]"
        bodies.append(f"  {name}: {{mass: 1, inertia: [1, 1, 1], position: {place}, velocity: [{speed}, 0, 0]}}")
        joint = f"type: translational, bodies: [ground, {name}], point: {place}, axis: [1, 0, 0]"
        joints.append(f"  {way[name]}: {{{joint}}}")
        written = effort if effort[0] == "{" else repr(effort)
        forces.append(f"  push_{name}: {{type: motor, coordinate: {way[name]}, effort: {written}}}")
        forces += [f"  with_{name}: {more[name]}"] if name in more else []
    lines = ["format: 1", f"parameters: {{at: {PLACE}, turn: {TIME}, rough: 0.9}}", "gravity: [0, 0, -9.81]"]
    lines += ["bodies:", *bodies, "joints:", *joints, "forces:", *forces, "states:"]
    lines += [
        f"  held: {{start: 1, update: 'if(sampled.displacement > 0.3, -2, 1)', every: {PERIOD}}}",
        "  mode: {start: 1, update: -2, event: passed}",
        "events: {passed: {when: event.displacement - 0.3, direction: rising}}",
        "simulation: {duration: 1, step: 2 ms, output_interval: 20 ms}",
    ]
    if "relay" in names:
        relay = "input: -relay_way.displacement, on: -0.1, off: -0.3, values: [-2, 1], start: 'on'"
        lines += ["control:", f"  relay: {{type: hysteresis, {relay}, sample_time: {PERIOD}}}"]
    return "\n".join(lines)


def over_place(v, at=PLACE):
    """x(1), dx/dv, dx/dat: v1² = v² + 2 at, then with -2 for u = 1 - t, t = v1 - v."""
    v1 = np.sqrt(v * v + 2.0 * at)
    u = 1.0 - v1 + v
    of_v1, of_u = u - (v1 - 2.0 * u), v1 - 2.0 * u
    return of_v1 * v / v1 + of_u, 1.0 + of_v1 / v1


def over_steps(v):
    """dx/dv for the force -n from n/5 on: in each part v' = √(v² - 2 n/5), and the time of the part moves."""
    t, x, dt, dv, n = 0.0, 0.0, 0.0, 1.0, 0
    while n == 0 or v * v > 2.0 * n / 5.0:
        after = np.sqrt(v * v - 2.0 * n / 5.0)
        part = 0.2 / v if n == 0 else (v - after) / n
        if t + part > 1.0:
            break
        d_after = v * dv / after
        dt += -0.2 / v**2 * dv if n == 0 else (dv - d_after) / n
        t, x, v, dv, n = t + part, x + 0.2, after, d_after, n + 1
    u = 1.0 - t
    return dv * u - (v - n * u) * dt


def over_corner(v):
    """dx/dv where a spring of 9 N/m is met at 0.3: x = 0.3 + v/3 sin 3 (1 - 0.3/v)."""
    angle = 3.0 * (1.0 - 0.3 / v)
    return np.sin(angle) / 3.0 + np.cos(angle) * 0.3 / v


def slopes():
    """(output, parameter): slope by closed forms."""
    by_speed = {
        "place": over_place(0.5)[0],
        "instant": 1.0,
        "event": over_place(0.55)[0],
        "corner": over_corner(0.7),
        "table": over_corner(0.65),
        "steps": over_steps(0.9),
        "dry": 0.6,
        # up to the speed at which one sample more or less is taken before the place
        "sampled": 1.0,
        "relay": 1.0,
        # back after half a period
        "stop": -1.0 + np.pi / FAST,
        "rub": 0.6 / 0.9,
        # slowed down by 1 up to the time 0.5, then both by 1/2
        "lead": 0.5 + 0.25,
    }
    return {(f"{name}.position.x", f"bodies.{name}.velocity.0"): slope for name, slope in by_speed.items()} | {
        # equal carts exchange their speeds within half a period of √(2 k/m)
        ("struck.position.x", "bodies.ram.velocity.0"): 1.0 - np.pi / (2.0 * np.sqrt(2.0) * FAST),
        # both have half of the speed w from the time w/2 on
        ("engaged.position.x", "bodies.engine.velocity.0"): 0.5 - 0.25 * 1.2,
        ("place.position.x", "parameters.at"): over_place(0.5)[1],
        ("instant.position.x", "parameters.turn"): 3.0 * (1.0 - TIME),
        ("rub.position.x", "parameters.rough"): -0.5 * (0.6 / 0.9) ** 2,
    }


# by default, and with chosen steps
FEW = ("place", "instant", "event", "corner", "sampled", "stop", "struck", "ram")
# has to be right and green, all else may be told; a last stage of dopri5 lies beyond a jump at an instant
GREEN = {
    "rk4": {"place", "instant", "event", "corner", "stop", "struck"},
    "rk4, all": {"place", "instant", "event", "corner", "stop", "struck"},
    "dopri5": {"place", "event", "corner", "stop", "struck"},
}
# of rates of events, by differences within short parts of steps
ROUND_OFF = 1e-6
METHODS = {
    "rk4": FEW,
    "rk4, all": tuple(CARTS),
    "generalised-alpha": tuple(CARTS),
    "abm4": tuple(CARTS),
    "ros2": tuple(CARTS),
    "dopri5": FEW,
    "radau": FEW,
    "default": FEW,
}


CHOSEN = ("dopri5", "radau", "default")


@pytest.mark.parametrize("method", tail(METHODS, ["rk4"]))
def test_a_slope_over_a_switch_is_right_or_not_green(tmp_path, method):
    carts, path = METHODS[method], tmp_path / "carts.yaml"
    path.write_text(machine_file(carts), encoding="utf-8")
    known = {pair: slope for pair, slope in slopes().items() if pair[0].split(".")[0] in carts}
    outputs, parameters = (list(dict.fromkeys(each)) for each in zip(*known, strict=True))
    settings = {} if method == "default" else {"integrator": method.split(",")[0]}
    settings |= {"tolerance": 1e-8} if method in CHOSEN else {}
    found = nivel.load(path).gradient(outputs, parameters, **settings)
    wrong, told = [], set()
    for (output, parameter), exact in known.items():
        slope = found[f"d({output})/d({parameter})"]
        off, error = abs(float(slope) - exact), slope.attrs["estimated_error"]
        if slope.attrs["verdict"] != "green":
            told.add(output.split(".")[0])
        elif not off <= max(error, ROUND_OFF):
            wrong.append(f"{output} by {parameter}: {float(slope):.6g} ± {error:.1e}, not {exact:.6g}, green")
    assert not wrong, "\n".join(wrong)
    assert not told & GREEN.get(method, set())


def test_a_verdict_does_not_depend_on_what_else_is_asked(tmp_path):
    path = tmp_path / "carts.yaml"
    path.write_text(machine_file(("place", "steps", "event", "sampled")), encoding="utf-8")
    outputs = ["place.position.x", "steps.position.x"]
    parameters = [f"bodies.{name}.velocity.0" for name in ("place", "steps")]
    machine = nivel.load(path)
    together = machine.gradient(outputs, parameters, integrator="rk4")
    for output in outputs:
        for parameter in parameters:
            name = f"d({output})/d({parameter})"
            alone = machine.gradient(output, parameter, integrator="rk4")[name]
            assert alone.attrs["verdict"] == together[name].attrs["verdict"]
            assert alone.attrs["estimated_error"] == together[name].attrs["estimated_error"]
    assert together.attrs["verdict"] != "green"
    assert together["d(place.position.x)/d(bodies.place.velocity.0)"].attrs["verdict"] == "green"


def test_by_default_a_clutch_that_locks_has_slopes(tmp_path):
    """J₁ at 30 rad/s and J₂ at rest lock at 3.6/C s, at 12 rad/s. ∫T dt falls by J² s³/(6 C²), J = J₁J₂/(J₁ + J₂); φ₂ rises by 21.6/C²."""
    path = tmp_path / "clutch.yaml"
    path.write_text(
        "format: 1\ngravity: [0, 0, 0]\nparameters: {cap: 6}\nbodies:\n"
        "  a: {mass: 1, inertia: [0.2, 0.2, 0.2], angular_velocity: [30, 0, 0]}\n"
        "  b: {mass: 1, inertia: [0.3, 0.3, 0.3], position: [1, 0, 0]}\njoints:\n"
        "  ja: {type: revolute, bodies: [ground, a], point: [0, 0, 0], axis: [1, 0, 0]}\n"
        "  jb: {type: revolute, bodies: [ground, b], point: [1, 0, 0], axis: [1, 0, 0]}\n"
        "forces: {plates: {type: clutch, coordinate: jb, against: ja, capacity: cap}}\nsimulation: {duration: 1.2}\n"
    )
    outputs, exact = ["integral(kinetic_energy)", "jb.angle"], [-(0.12**2) * 30.0**3 / 216.0, 0.6]
    found = nivel.load(path).gradient(outputs, ["parameters.cap"])
    for output, slope in zip(outputs, exact, strict=True):
        known = found[f"d({output})/d(parameters.cap)"]
        assert abs(float(known) - slope) <= max(known.attrs["estimated_error"], 1e-6)
        assert known.attrs["estimated_error"] < 1e-4


def test_by_default_a_rope_that_catches_a_fall_twice_has_slopes(tmp_path):
    """A fall of h = l - 0.5 takes t = √(2h/g), the rope τ = 2 (π - atan(v ω/g))/ω to throw it back with v = g t: z = -l + v u - g u²/2
    with u = T - 3 t - 2 τ. dt/dl = 1/v, dv/dl = g/v, dτ/dl = -2/v/(1 + (v ω/g)²)."""
    path = tmp_path / "rope.yaml"
    path.write_text(
        "format: 1\ngravity: [0, 0, -9.81]\nparameters: {l: 0.8}\nbodies: {b: {mass: 2, inertia: [1, 1, 1], position: [0, 0, -0.5]}}\n"
        "joints: {g: {type: translational, bodies: [ground, b], point: [0, 0, -0.5], axis: [0, 0, 1]}}\nforces:\n"
        "  r: {type: rope, bodies: [ground, b], points: [[0, 0, 0], [0, 0, -0.5]], stiffness: 5000, length: l}\n"
        "simulation: {duration: 0.9}\n"
    )
    g, omega = 9.81, 50.0
    t = np.sqrt(2.0 * 0.3 / g)
    v, tau = g * t, 2.0 * (np.pi - np.arctan(t * omega)) / omega
    u = 0.9 - 3.0 * t - 2.0 * tau
    of_u = -3.0 / v + 4.0 / v / (1.0 + (v * omega / g) ** 2)
    exact = -1.0 + g / v * u + (v - g * u) * of_u
    slope = nivel.load(path).gradient("b.position.z", "parameters.l")["d(b.position.z)/d(parameters.l)"]
    assert slope.attrs["verdict"] == "green"
    assert abs(float(slope) - exact) <= max(slope.attrs["estimated_error"], 1e-6)


def test_by_default_what_comes_to_rest_by_friction_has_slopes(tmp_path):
    """From 1 m/s, after v²/(2 μ N/m) with N = 8 N and 1 kg; in the same words whatever the coefficient is, and without a warning."""
    path = tmp_path / "sledge.yaml"
    path.write_text(
        "format: 1\ngravity: [0, 0, 0]\nparameters: {mu: 0.3}\nbodies: {a: {mass: 1, inertia: [1, 1, 1], velocity: [1, 0, 0]}}\n"
        "joints: {r: {type: translational, bodies: [ground, a], point: [0, 0, 0], axis: [1, 0, 0]}}\n"
        "forces: {f: {type: friction, coordinate: r, model: stiction, coefficient: mu, normal_load: 8}}\nsimulation: {duration: 1}\n"
    )
    found = nivel.load(path).gradient("r.displacement", ["bodies.a.velocity.0", "parameters.mu"])
    for name, exact in (("bodies.a.velocity.0", 1.0 / 2.4), ("parameters.mu", -1.0 / (16.0 * 0.3**2))):
        slope = found[f"d(r.displacement)/d({name})"]
        assert slope.attrs["verdict"] == "green"
        assert abs(float(slope) - exact) <= max(slope.attrs["estimated_error"], 1e-9)
