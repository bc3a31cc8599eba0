"""Machines made to deceive: wrong by more than they look, each with its exact motion, and the same made harmless.

A machine is deceiving where a run looks well while its answer is wrong: its loads fall between the steps, a light part hides behind a heavy
one, its places are rounded away. All solutions are closed forms, or solutions of equations written here.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import erf

from nivel import (
    Body,
    Contact,
    Friction,
    Joint,
    JointSpringDamper,
    MachineRecord,
    PointForce,
    SimulationSettings,
    Table,
)
from nivel.machine.bodies.shape import Sphere

ALONG_X = {"type": "translational", "bodies": ("ground", "slide"), "point": (0, 0, 0), "axis": (1, 0, 0)}
ABOUT_Z = {"type": "revolute", "point": (0, 0, 0), "axis": (0, 0, 1)}


@dataclass(frozen=True)
class Deceiving:
    """machine(harmless) : with settings of its own. quantity : of its result; exact(time, harmless) : what that is. arm : metres a unit."""

    name: str
    machine: Callable[[bool], MachineRecord]
    quantity: str
    exact: Callable[[np.ndarray, bool], np.ndarray]
    arm: float = 1.0

    def error(self, result, harmless=False):
        """The largest error of a run [m]."""
        off = np.abs(result.array(self.quantity) - self.exact(result.time, harmless))
        return self.arm * float(np.max(off))


def slide(force, *, mass=1.0, velocity=0.0, at=0.0, duration=2.0, **settings):
    """A mass on a rail along x."""
    joint = {**ALONG_X, "point": (at, 0, 0)}
    return MachineRecord(
        name="slide",
        bodies=(
            Body(name="slide", mass=mass, inertia=(1, 1, 1), position=(at + 0.5, 0, 0), velocity=(velocity, 0, 0)),
        ),
        joints=(Joint(name="rail", **joint),),
        forces=() if force is None else (PointForce(name="push", body="slide", vector=(force, 0, 0)),),
        simulation=SimulationSettings(duration=duration, step=1e-3, **settings),
    )


def pulse(width):
    """A triangular push of 1 N s at 0.70003 s."""
    begin = 0.70003

    def machine(harmless):
        w = 0.8 if harmless else width
        return slide(Table((0.0, begin, begin + w / 2, begin + w, 3.0), (0.0, 0.0, 2.0 / w, 0.0, 0.0)))

    def exact(time, harmless):
        w = 0.8 if harmless else width
        s = np.clip((time - begin) / w, 0.0, 1.0)
        rising = np.minimum(s, 0.5)
        falling = np.maximum(s - 0.5, 0.0)
        place = w * (2.0 / 3.0 * rising**3 + 0.5 * falling + falling**2 - 2.0 / 3.0 * falling**3)
        return 0.5 + place + np.maximum(time - begin - w, 0.0)

    return Deceiving(f"pulse-of-{width:g}-s", machine, "slide.position.x", exact)


def gaussian(width):
    """A push of 1 N s of this width at 1.2 s, by an expression."""

    def machine(harmless):
        w = 0.3 if harmless else width
        return slide(f"{1.0 / (w * float(np.sqrt(np.pi)))!r}*exp(-((time - 1.2)/{w!r})**2)")

    def exact(time, harmless):
        w = 0.3 if harmless else width

        def integral(t):
            u = (t - 1.2) / w
            return 0.5 * w * (u * erf(u) + np.exp(-(u**2)) / np.sqrt(np.pi)) + 0.5 * t

        rest = 0.5 * erf(-1.2 / w) + 0.5  # of the speed at t = 0
        return 0.5 + integral(time) - integral(0.0) - rest * time

    return Deceiving(f"gaussian-of-{width:g}-s", machine, "slide.position.x", exact)


def glitch():
    """A push of 10 N, and a small one of 1 N more within 20 µs, which is nothing in its impulse; harmless within 0.3 s."""

    def machine(harmless):
        w = 0.3 if harmless else 2e-5
        return slide(f"10 + exp(-((time - 1.2003)/{w!r})**2)")

    def exact(time, harmless):
        w = 0.3 if harmless else 2e-5

        def integral(t):
            u = (t - 1.2003) / w
            return 0.5 * np.sqrt(np.pi) * w * (w * (u * erf(u) + np.exp(-(u**2)) / np.sqrt(np.pi)))

        rest = 0.5 * np.sqrt(np.pi) * w * erf(-1.2003 / w)  # of the speed at t = 0
        return 0.5 + 5.0 * time**2 + integral(time) - integral(0.0) - rest * time

    return Deceiving("glitch-of-a-push", machine, "slide.position.x", exact)


def narrow_drag():
    """A push of 10 N, at speeds within 5 mm/s of 3 m/s almost none, in steps of 5 ms; harmless within 1 m/s."""
    width = {False: 0.005, True: 1.0}

    def machine(harmless):
        record = slide(f"10 - 9.5*exp(-((slide.vx - 3)/{width[harmless]})**2)", duration=1.0)
        return record.replace(simulation=record.simulation.replace(step=5e-3))

    @cache
    def solution(harmless):
        def rates(_t, y):
            return y[1], 10.0 - 9.5 * np.exp(-(((y[1] - 3.0) / width[harmless]) ** 2))

        options = {"method": "DOP853", "rtol": 1e-11, "atol": 1e-12, "max_step": 1e-3, "dense_output": True}
        return solve_ivp(rates, (0.0, 1.0), (0.5, 0.0), **options).sol

    def exact(time, harmless):
        return solution(harmless)(time)[0]

    return Deceiving("narrow-drag", machine, "slide.position.x", exact)


def bullet():
    """A ball at 80 m/s that hits another one like it, in steps of 3 ms that lead through it; harmlessly it flies by."""
    radius, mass, speed, stiffness = 0.01, 0.03, 80.0, 1e9

    def machine(harmless):
        ball = {"mass": mass, "inertia": (1e-6, 1e-6, 1e-6), "shape": Sphere(radius=radius)}
        aside = 0.05 if harmless else 0.0
        return MachineRecord(
            name="bullet",
            bodies=(
                Body(name="ball", position=(-1.03, aside, 0), velocity=(speed, 0, 0), **ball),
                Body(name="post", **ball),
            ),
            forces=(Contact(name="hit", bodies=("ball", "post"), stiffness=stiffness, restitution=1),),
            simulation=SimulationSettings(duration=0.06, step=3e-3),
        )

    @cache
    def solution():
        begin = (1.03 - 2 * radius) / speed  # they touch
        options = {"method": "DOP853", "rtol": 1e-11, "atol": 1e-14, "max_step": 1e-6, "dense_output": True}

        def rates(_t, y):
            push = stiffness * max(y[0] - y[2] + 2 * radius, 0.0) ** 1.5 / mass
            return y[1], -push, y[3], push

        return begin, solve_ivp(rates, (0.0, 2e-4), (-2 * radius, speed, 0.0, 0.0), **options).sol

    def exact(time, harmless):
        begin, touching = solution()
        x, v, *_ = touching(2e-4)
        after = np.where(
            time < begin + 2e-4, touching(np.clip(time - begin, 0.0, 2e-4))[0], x + v * (time - begin - 2e-4)
        )
        return np.where(harmless | (time < begin), -1.03 + speed * time, after)

    return Deceiving("bullet", machine, "ball.position.x", exact)


def hum():
    """4 kHz from the first moment on: it leaves a mean speed of A/(m ω)."""
    pace = {False: 2.0 * np.pi * 4000.0, True: 2.0 * np.pi * 2.0}

    def machine(harmless):
        return slide(f"{pace[harmless] * 1.0!r}*sin({pace[harmless]!r}*time)", duration=1.0)

    def exact(time, harmless):
        return 0.5 + time - np.sin(pace[harmless] * time) / pace[harmless]

    return Deceiving("4-khz", machine, "slide.position.x", exact)


def wall():
    """A wall 2 mm wide from a table of place, higher than the energy of a slide at 10 m/s; made harmless it is a hill 0.5 m wide."""
    forms = {
        False: ((0.0, 1.0, 1.001, 1.002, 3.0), (0.0, 0.0, -1e5, 0.0, 0.0)),
        True: ((0.0, 1.0, 1.25, 1.5, 3.0), (0.0, 0.0, -400.0, 0.0, 0.0)),
    }

    def machine(harmless):
        points, values = forms[harmless]
        record = slide(Table(points, values, of="slide.x"), velocity=10.0, duration=0.2)
        return record.replace(simulation=record.simulation.replace(step=2e-4 if harmless else 1e-3))

    @cache
    def solution(harmless):
        points, values = forms[harmless]

        def rates(_t, y):
            return y[1], np.interp(y[0], points, values)

        options = {"rtol": 1e-11, "atol": 1e-13, "max_step": 2e-5, "dense_output": True}
        return solve_ivp(rates, (0.0, 0.2), (0.5, 10.0), **options).sol

    def exact(time, harmless):
        return solution(harmless)(time)[0]

    return Deceiving("wall-2-mm", machine, "slide.position.x", exact)


def far(away):
    """A slide that creeps, far from the origin: a step moves it by less than its place is rounded to."""

    def machine(harmless):
        at = 0.0 if harmless else away
        return slide(None, velocity=4e-14 * away, at=at, duration=2.0)

    def exact(time, harmless):
        at = 0.0 if harmless else away
        return at + 0.5 + 4e-14 * away * time

    return Deceiving(f"far-{away:g}", machine, "slide.position.x", exact)


def flywheel(speed):
    """A wheel that turns by more than a radian a step: its angle is speed · time."""

    def machine(harmless):
        return MachineRecord(
            name="flywheel",
            bodies=(
                Body(
                    name="wheel",
                    mass=1,
                    inertia=(0.02, 0.02, 0.02),
                    angular_velocity=(0, 0, 100.0 if harmless else speed),
                ),
            ),
            joints=(Joint(name="axle", bodies=("ground", "wheel"), **ABOUT_Z),),
            simulation=SimulationSettings(duration=1.0, step=1e-3),
        )

    def exact(time, harmless):
        return (100.0 if harmless else speed) * time

    return Deceiving(f"flywheel-{speed:g}", machine, "axle.angle", exact, arm=0.2)


def sphere():
    """A free sphere that turns about z by a radian a step, 0.3 m beside a mass at rest."""

    def machine(harmless):
        return MachineRecord(
            name="sphere",
            bodies=(
                Body(
                    name="ball",
                    mass=1,
                    inertia=(0.01, 0.01, 0.01),
                    angular_velocity=(0, 0, 50.0 if harmless else 1000.0),
                ),
                Body(name="weight", mass=1, inertia=(0.01, 0.01, 0.01), position=(0.3, 0, 0)),
            ),
            simulation=SimulationSettings(duration=1.0, step=1e-3),
        )

    def exact(time, harmless):
        return np.abs(np.cos(0.5 * (50.0 if harmless else 1000.0) * time))

    class Sphere(Deceiving):
        def error(self, result, harmless=False):
            angle = (50.0 if harmless else 1000.0) * result.time
            theta = result.array("ball.orientation")
            half = np.stack([np.cos(angle / 2), 0 * angle, 0 * angle, np.sin(angle / 2)], axis=1)
            chord = np.minimum(np.linalg.norm(theta - half, axis=1), np.linalg.norm(theta + half, axis=1))
            return 0.3 * float(np.max(4.0 * np.arcsin(0.5 * chord)))

    return Sphere("sphere-1-rad", machine, "ball.orientation.0", exact)


def hidden_pendulum():
    """A light pendulum of 0.1 m in steps of 30 ms, beside a flywheel with 5e4 J; harmless in steps of 1 ms."""
    g, length, mass, turn = 9.81, 0.1, 1e-3, 1e-6

    def machine(harmless):
        return MachineRecord(
            name="hidden",
            gravity=(0, -g, 0),
            bodies=(
                Body(name="wheel", mass=100, inertia=(10, 10, 10), position=(1, 0, 0), angular_velocity=(0, 0, 1.0)),
                Body(name="bob", mass=mass, inertia=(turn, turn, turn), position=(length, 0, 0)),
            ),
            joints=(
                Joint(name="axle", bodies=("ground", "wheel"), **{**ABOUT_Z, "point": (1, 0, 0)}),
                Joint(name="pin", bodies=("ground", "bob"), **ABOUT_Z),
            ),
            simulation=SimulationSettings(duration=3.0, step=1e-3 if harmless else 3e-2),
        )

    @cache
    def solution():
        inertia = mass * length**2 + turn

        def rates(_t, y):
            return y[1], -mass * g * length * np.cos(y[0]) / inertia

        return solve_ivp(rates, (0.0, 3.0), (0.0, 0.0), method="DOP853", rtol=1e-11, atol=1e-12, dense_output=True).sol

    def exact(time, harmless):
        return solution()(time)[0]

    return Deceiving("pendulum-beside-flywheel", machine, "pin.angle", exact, arm=length)


def cup():
    """A cup on a spring in a train at 50 m/s: it vibrates by a millimetre at 300 rad/s, in steps of 5 ms; harmless at 6 rad/s."""
    train, mass, pace = 1e4, 0.2, {False: 300.0, True: 6.0}

    def machine(harmless):
        k = mass * pace[harmless] ** 2
        return MachineRecord(
            name="train",
            bodies=(
                Body(name="slide", mass=train, inertia=(1e4, 1e4, 1e4), velocity=(50, 0, 0)),
                Body(name="cup", mass=mass, inertia=(1e-3, 1e-3, 1e-3), position=(1.001, 0, 0), velocity=(50, 0, 0)),
            ),
            joints=(
                Joint(name="rail", **ALONG_X),
                Joint(name="table", type="translational", bodies=("slide", "cup"), point=(1, 0, 0), axis=(1, 0, 0)),
            ),
            forces=(JointSpringDamper(name="spring", coordinate="table.displacement", stiffness=k, free_value=-0.001),),
            simulation=SimulationSettings(duration=1.0, step=5e-3),
        )

    def exact(time, harmless):
        k = mass * pace[harmless] ** 2
        w = np.sqrt(k * (1 / train + 1 / mass))
        return -0.001 + 0.001 * np.cos(w * time)

    return Deceiving("cup-in-train", machine, "table.displacement", exact)


def hammer():
    """A hammer that falls while its tip vibrates by a millimetre, at 2e4 rad/s or harmlessly at 20, in steps of 1 ms."""
    heavy, tip, g, pace = 1.0, 0.01, 9.81, {False: 2e4, True: 20.0}

    def machine(harmless):
        k = tip * pace[harmless] ** 2
        return MachineRecord(
            name="hammer",
            gravity=(-g, 0, 0),
            bodies=(
                Body(name="slide", mass=heavy, inertia=(1, 1, 1)),
                Body(name="tip", mass=tip, inertia=(1e-4, 1e-4, 1e-4), position=(0.5, 0, 0)),
            ),
            joints=(
                Joint(name="rail", **ALONG_X),
                Joint(name="neck", type="translational", bodies=("slide", "tip"), point=(0.5, 0, 0), axis=(1, 0, 0)),
            ),
            forces=(JointSpringDamper(name="spring", coordinate="neck.displacement", stiffness=k, free_value=-0.001),),
            simulation=SimulationSettings(duration=1.0, step=1e-3),
        )

    def exact(time, harmless):
        k = tip * pace[harmless] ** 2
        return -0.001 + 0.001 * np.cos(np.sqrt(k * (1 / heavy + 1 / tip)) * time)

    return Deceiving("vibrating-tip", machine, "neck.displacement", exact)


def chaos():
    """A double pendulum of two equal bars for 25 s, harmlessly for 1 s."""
    L, g = 0.5, 9.81

    def machine(harmless):
        bar = {"mass": 1.0, "inertia": (1e-4, L**2 / 12, L**2 / 12)}
        return MachineRecord(
            name="double",
            gravity=(0, -g, 0),
            bodies=(
                Body(name="upper", position=(L / 2, 0, 0), **bar),
                Body(name="lower", position=(3 * L / 2, 0, 0), **bar),
            ),
            joints=(
                Joint(name="shoulder", bodies=("ground", "upper"), **ABOUT_Z),
                Joint(name="elbow", bodies=("upper", "lower"), **{**ABOUT_Z, "point": (L, 0, 0)}),
            ),
            simulation=SimulationSettings(duration=1.0 if harmless else 25.0, step=1e-3),
        )

    @cache
    def solution(end):
        J = L**2 / 12

        def rates(_t, s):
            a, b, da, db = s
            M = np.array([[J + L**2 / 4 + L**2, L**2 / 2 * np.cos(a - b)], [L**2 / 2 * np.cos(a - b), J + L**2 / 4]])
            Q = np.array(
                [
                    -(L**2) / 2 * np.sin(a - b) * db**2 - 1.5 * g * L * np.cos(a),
                    L**2 / 2 * np.sin(a - b) * da**2 - 0.5 * g * L * np.cos(b),
                ]
            )
            return [da, db, *np.linalg.solve(M, Q)]

        return solve_ivp(rates, (0, end), [0.0] * 4, method="DOP853", rtol=1e-12, atol=1e-13, dense_output=True).sol

    def exact(time, harmless):
        a, b = solution(1.0 if harmless else 25.0)(time)[:2]
        return L * np.cos(a) + L / 2 * np.cos(b)

    return Deceiving("chaos", machine, "lower.position.x", exact)


def stiction():
    """A block that a push of 12 N sin(10 t) lets stick and slide, in steps of 5 ms; harmless with 4 N: it rests."""
    mass, g, mu, push, pace = 1.0, 9.81, 0.5, 12.0, 10.0

    def machine(harmless):
        record = slide(f"{4.0 if harmless else push}*sin({pace}*time)", mass=mass, duration=1.0)
        friction = Friction(
            name="rub", coordinate="rail.displacement", coefficient=mu, normal_load=mass * g, model="stiction"
        )
        settings = record.simulation.replace(step=5e-3)
        return record.replace(forces=(*record.forces, friction), simulation=settings)

    @cache
    def solution():
        limit, times = mu * mass * g, np.linspace(0.0, 1.0, 1_000_001)
        h, x, v = times[1], 0.5, 0.0
        out = np.empty_like(times)
        for k, t in enumerate(times):
            out[k] = x
            force = push * np.sin(pace * (t + h / 2))
            if v == 0.0 and abs(force) <= limit:
                continue
            way = np.sign(v) if v != 0.0 else np.sign(force)
            new = v + h * (force - way * limit) / mass
            if v != 0.0 and new * v < 0.0:
                new = 0.0
            x += h * 0.5 * (v + new)
            v = new
        return times, out

    def exact(time, harmless):
        return 0.5 + 0.0 * time if harmless else np.interp(time, *solution())

    return Deceiving("stiction-5-ms", machine, "slide.position.x", exact)


KINDS = (
    *(pulse(width) for width in (0.4, 2e-2, 1e-3, 2e-5)),
    gaussian(1e-2),
    gaussian(2e-5),
    glitch(),
    narrow_drag(),
    hum(),
    wall(),
    bullet(),
    far(1e7),
    far(1e9),
    flywheel(1000.0),
    flywheel(5000.0),
    sphere(),
    hidden_pendulum(),
    cup(),
    hammer(),
    chaos(),
    stiction(),
)
