"""Lines of kernels spoilt by hand, each the mistake that one makes with it, and the tests that are said to notice it."""

from dataclasses import dataclass
from pathlib import Path

TESTS = Path(__file__).parent
# paths in `tests` of the tests in folders of `verification`, by name
PLACES = {
    path.stem.removeprefix("test_"): path.relative_to(TESTS).as_posix()
    for path in (TESTS / "verification").rglob("test_*.py")
}


@dataclass(frozen=True)
class Spoilt:
    """In `file` of the package `before`, which stands there once, becomes `after`; `tests` are files below `tests`."""

    name: str
    file: str
    before: str
    after: str
    tests: tuple[str, ...]


def verification(*names):
    """Paths in `tests` of tests by their names, in whichever folder of `verification` they are."""
    return tuple(PLACES[name] for name in names)


NAMED = [
    # forces
    Spoilt("spring: half the damper", "elements/forces/springs.py", "damping = n[SpringRow.DAMPING] * rate",
             "damping = 0.5 * n[SpringRow.DAMPING] * rate", verification("springs")),
    Spoilt("spring: energy of the preload", "elements/forces/springs.py",
             "(0.5 * n[SpringRow.STIFFNESS] * stretch + n[SpringRow.PRELOAD])",
             "(0.5 * n[SpringRow.STIFFNESS] * stretch)", verification("springs", "consistency")),
    Spoilt("impact: sign of the loss", "elements/contacts/impact.py", "elastic * (1.0 + (x", "elastic * (1.0 - (x",
             verification("contact", "contact_location")),
    Spoilt("contact: friction without its normal force", "elements/contacts/law.py",
             "numbers[FRICTION] * force * tanh", "numbers[FRICTION] * tanh", verification("contact", "consistency")),
    Spoilt("stop: the upper one pulls", "elements/forces/actuators.py", "depth[1], rate, stiffness", "depth[1], -rate, stiffness",
             verification("contact", "springs", "element_references", "contact_location", "residual_and_tangent")),
    Spoilt("bushing: moment of the offset", "elements/forces/bushing.py", "opposite(plus(torque, cross(d, force)))",
             "opposite(plus(torque, cross(force, d)))",
             verification("springs", "consistency")),
    Spoilt("motor: speed held the wrong way", "elements/forces/actuators.py", "gain * (effort - coordinates.rate[q])",
             "gain * (effort - 0.9 * coordinates.rate[q])", verification("motors")),
    Spoilt("push: lever of a point", "kernels/forces/wrench.py", "cross(minus(p, bodies.R[b]), force)",
             "cross(force, minus(p, bodies.R[b]))", verification("contact", "contact_location")),
    Spoilt("table: its slope", "kernels/record/function.py", "c[1] + s * (2.0 * c[2] + 3.0 * s * c[3]),",
             "c[1] + s * (2.0 * c[2] + 2.0 * s * c[3]),",
             ("machine/test_time_functions.py", *verification("drivers", "laws"))),
    Spoilt("tyre: force at the loaded radius", "elements/forces/tyre.py", "r * fr + (loaded - r) * fx + lean * fy",
             "r * fr + lean * fy", verification("tyres")),
    Spoilt("tyre: its curve before the peak", "elements/forces/tyre.py", "1.0 + n * (n + slope * s_m / f_m - 2.0)",
             "1.0 + n * (n + slope * s_m / f_m - 1.9)", verification("tyres")),
    Spoilt("soil: cohesion of the wedge", "elements/contacts/soil_cells.py", "np.sin(beta + phi) + held", "np.sin(beta + phi) + 0.9 * held",
             verification("soil")),
    Spoilt("soil: pressure at which it yields", "elements/contacts/soil_cells.py", "minimum(elastic, number[SoilRow.MODULUS]",
             "minimum(elastic, 1.1 * number[SoilRow.MODULUS]", verification("soil")),
    Spoilt("track: what a patch hands on", "elements/contacts/tracks.py", "left * sx - (1.0 - left) * vx / speed", "left * sx",
             verification("tracks")),
    Spoilt("track: moment on the sprocket", "elements/contacts/tracks.py", "driven - n[ForceRow.RADIUS] * fx",
             "driven - 0.9 * n[ForceRow.RADIUS] * fx", verification("tracks")),
    Spoilt("soil: impulse of what is pushed ahead", "elements/contacts/on_soil.py", "SoilRow.DENSITY] * (taken - ahead) * v[c]",
             "SoilRow.DENSITY] * taken * v[c]", verification("soil")),
    # constraints
    Spoilt("coincident points: their acceleration", "kernels/bodies/constraint.py", "markers.bias[i, x] - markers.bias[j, x]",
             "markers.bias[i, x] + markers.bias[j, x]", verification("joints")),
    Spoilt("coordinate: Coriolis along an axis", "kernels/bodies/coordinate.py", "- ad * dot(w, w) + 2.0 * (s0",
             "- ad * dot(w, w) + 1.0 * (s0",
             verification("joints")),
    Spoilt("coordinate: bias of an angle", "kernels/bodies/coordinate.py", "- rate * 2.0 * (c * cdot + s * sdot)",
             "- rate * (c * cdot + s * sdot)",
             verification("drivers", "joints", "couplings")),
    # bodies and trees
    Spoilt("Euler parameters: their rates", "kernels/algebra/rotation.py", "out[2] = theta[3] * x + theta[0] * y - theta[1] * z",
             "out[2] = theta[3] * x + theta[0] * y + theta[1] * z", ("kernels/test_rotation.py", *verification("motion"))),
    Spoilt("weight: its moment", "kernels/bodies/rigid.py", "put(F, 3, cross(c, F))", "put(F, 3, cross(F, c))",
             verification("consistency", "motion", "mechanisms")),
    Spoilt("kinetic energy of turning", "kernels/bodies/rigid.py", "+ 0.5 * turning", "+ 0.49 * turning", verification("motion")),
    Spoilt("tree: inertia of a child", "kernels/tree/articulated.py", "P[5] - 2.0 * (K6 * y - K7 * x)", "P[5] - (K6 * y - K7 * x)",
             verification("relative")),
    Spoilt("tree: motion of a child", "kernels/tree/articulated.py", "parent[4] + parent[2] * r[0] - parent[0] * r[2]",
             "parent[4] + parent[2] * r[0] + parent[0] * r[2]", verification("relative")),
    # friction and sensors
    Spoilt("friction: Stribeck's exponent", "kernels/elements/friction.py", "np.exp(-ratio * ratio)", "np.exp(-ratio)",
             verification("friction")),
    Spoilt("friction: load of a collar", "kernels/elements/friction.py", "return load + n[COLLAR] * absolute(f[2])",
             "return load + n[COLLAR] * f[2]",
             verification("friction", "frictions_together")),
    Spoilt("friction: multipliers", "kernels/elements/friction.py", "lam[row] += response[row] * force",
             "lam[row] -= response[row] * force", verification("friction")),
    Spoilt("sensor: Coriolis", "kernels/signals/sensor.py", "cross(w, cross(w, d))), coriolis), coriolis)",
             "cross(w, cross(w, d))), coriolis), d)",
             verification("sensors")),
    Spoilt("sensor: relative angular acceleration", "kernels/signals/sensor.py", "value = minus(value, cross(w, turning))",
             "value = minus(value, cross(turning, w))", verification("sensors")),
    # beams, rails, flexible bodies
    Spoilt("rail: product of rates", "kernels/bodies/rail.py", "+ 2.0 * dot(a[1], b[1])", "+ dot(a[1], b[1])", verification("rails")),
    Spoilt("beam: stored energy", "elements/beams/exact.py", "stored += 0.5 * s[i] * strain[i]",
             "stored += 0.51 * s[i] * strain[i]",
             verification("beam_elements")),
    Spoilt("beam: change of the tangent", "elements/beams/exact.py", "outwards = da * along - db * across",
             "outwards = da * along + db * across", verification("beam_elements")),
    Spoilt("flexible body: inertia of the second order", "kernels/bodies/floating_frame.py", "(2.0 * I8[c, k] + row[k])",
             "(I8[c, k] + row[k])",
             ("flexible/test_invariants.py", "flexible/test_flexible_motion.py", "flexible/test_tumbling.py")),
    Spoilt("flexible body: stiffening of a node", "kernels/bodies/floating_frame.py", "second -= pdot * across[j]",
             "second += pdot * across[j]",
             ("flexible/test_interfaces.py", "flexible/test_stiffening.py", "flexible/test_flexible_tree.py")),
    # integrators, events
    Spoilt("rk4: a weight", "integrate/explicit/runge_kutta.py", "1 / 6, 1 / 3, 1 / 3, 1 / 6", "1 / 6, 1 / 3, 1 / 6, 1 / 3",
             ("integrate/test_orders.py",)),
    Spoilt("ros2: second stage", "integrate/rosenbrock/rosenbrock.py", "add_times(-2.0, first, second)\n    return_to",
             "add_times(-1.9, first, second)\n    return_to", verification("ros2")),
    Spoilt("generalised-alpha: order of positions", "integrate/newmark/alpha_step.py", "(0.5 - c[BETA]) * a", "(0.55 - c[BETA]) * a",
             verification("alpha")),
    Spoilt("geometric stabilisation: the factor", "integrate/loop/loop.py", "np.sqrt(1.0 + missing / kinetic)",
             "1.0 + missing / kinetic",
             verification("geometric")),
    Spoilt("events: sides are kept", "integrate/loop/events.py", "now != 0.0 else -values[of_run.SIDE, k]",
             "now != 0.0 else values[of_run.SIDE, k]",
             verification("events")),
]  # fmt: skip
