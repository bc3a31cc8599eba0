"""K&C against an independent loop closure of a double wishbone, instant centres in the plane, energies of springs, and bushings."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from numpy.polynomial.chebyshev import Chebyshev
from scipy.optimize import fsolve
from scipy.spatial.transform import Rotation

import nivel
from nivel.cli import main
from nivel.cli.vehicles import measured, on_rig
from nivel.errors import ModelError
from nivel.report.vehicle_pages import ENDS, MIDDLE, numbers_of, roll_centre
from simulating import machine

RADIUS, TRAVEL, K = 0.31, 0.05, 3e4
CENTRE = np.array([0.0, 0.75, RADIUS])
SPATIAL = {"lower": ([0, 0.35, 0.18], [1, 0, 0], [0.01, 0.70, 0.17]), "upper": ([0, 0.42, 0.45], [1, 0.02, 0.06], [-0.02, 0.67, 0.47]),
           "rod": ([-0.14, 0.38, 0.22], [-0.14, 0.69, 0.215])}  # fmt: skip
# the rod is the lower arm farther back, so that nothing leaves its plane
PLANAR = {"lower": ([0, 0.35, 0.18], [1, 0, 0], [0, 0.70, 0.17]), "upper": ([0, 0.42, 0.45], [1, 0, 0], [0, 0.67, 0.47]),
          "rod": ([-0.14, 0.35, 0.18], [-0.14, 0.70, 0.17])}  # fmt: skip
STRUT = [0, 0.48, 0.66], [0.0, 0.59, 0.175]
TYRE = {"type": "tyre", "plane": "road", "radius": RADIUS, "width": 0.2, "nominal_load": 4000}
AXLE = Path(__file__).parents[3] / "examples" / "vehicles" / "front-axle.yaml"


def mirrored(vector, side):
    return [vector[0], side * vector[1], vector[2]]


def axle(places, free_length=None, sides=(1, -1)):
    """Wheels on double wishbones at a chassis that stands, without weight."""
    bodies, joints, forces = {"chassis": {"mass": 800, "inertia": [200, 400, 500], "position": [0, 0, 0.5]}}, {}, {}
    markers = {"road": {"body": "ground", "axis": [0, 0, 1]}}
    joints["stands"] = {
        "type": "translational",
        "bodies": ["ground", "chassis"],
        "point": [0, 0, 0.5],
        "axis": [0, 0, 1],
    }
    for side in sides:
        name = "left" if side > 0 else "right"

        def at(vector, side=side):
            return mirrored(vector, side)

        bodies[f"{name}_knuckle"] = {"mass": 20, "inertia": [1, 1, 1], "position": at(CENTRE)}
        bodies[f"{name}_wheel"] = {"mass": 20, "inertia": [1, 1, 1], "position": at(CENTRE)}
        joints[f"{name}_axle"] = {
            "type": "revolute",
            "bodies": [f"{name}_knuckle", f"{name}_wheel"],
            "point": at(CENTRE),
            "axis": [0, 1, 0],
        }
        markers[f"{name}_hub"] = {"body": f"{name}_wheel", "axis": [0, 1, 0]}
        for arm in ("lower", "upper"):
            pivot, axis, ball = places[arm]
            bodies[f"{name}_{arm}"] = {"mass": 5, "inertia": [0.1, 0.1, 0.1], "position": at(pivot)}
            joints[f"{name}_{arm}_hinge"] = {
                "type": "revolute",
                "bodies": ["chassis", f"{name}_{arm}"],
                "point": at(pivot),
                "axis": at(axis),
            }
            joints[f"{name}_{arm}_ball"] = {
                "type": "spherical",
                "bodies": [f"{name}_{arm}", f"{name}_knuckle"],
                "point": at(ball),
            }
        joints[f"{name}_rod"] = {
            "type": "distance",
            "bodies": ["chassis", f"{name}_knuckle"],
            "points": [at(each) for each in places["rod"]],
        }
        length = math.dist(*STRUT) if free_length is None else free_length
        forces[f"{name}_strut"] = {"type": "spring-damper", "bodies": ["chassis", f"{name}_lower"], "points": [at(each) for each in STRUT],
                                   "stiffness": K, "free_length": length}  # fmt: skip
        forces[f"{name}_tyre"] = {**TYRE, "wheel": f"{name}_hub"}
    return machine({"gravity": [0, 0, 0], "bodies": bodies, "markers": markers, "joints": joints, "forces": forces})


def test_joints_by_markers_are_those_by_points():
    wanted = measured(*on_rig(axle(SPATIAL)), "bump", TRAVEL)
    own = axle(SPATIAL)
    seen_from, marked = nivel.system.builder.SystemBuilder(own.record).seen_from, []
    for joint in own.record.joints:
        if joint.name in ("stands", "left_axle"):
            ends = [seen_from(body, np.array(joint.point), np.eye(3)) for body in joint.bodies]
            pair = tuple(nivel.Marker(body=end[0], position=tuple(end[1]), axis=joint.axis) for end in ends)
            marked.append(nivel.Joint(name=joint.name, type=joint.type, markers=pair))
    found = measured(*on_rig(own.replace(*marked)), "bump", TRAVEL)
    for name, angles in wanted.angles["camber"].items():
        assert found.angles["camber"][name] == pytest.approx(angles, abs=1e-9)


def closed(places):
    """Of the left wheel at heights TRAVEL·ENDS: centre, turn of the knuckle, length of the strut, balls; by all loops at once."""
    (pl, al, bl), (pu, au, bu), (ri, ro) = (
        [np.array(each, dtype=float) for each in places[name]] for name in ("lower", "upper", "rod")
    )
    top, foot = np.array(STRUT[0], dtype=float), np.array(STRUT[1])
    out, x = [], np.zeros(8)
    for height in TRAVEL * ENDS[np.argsort(np.abs(ENDS), kind="stable")]:

        def gaps(x, height=height):
            lower, upper = (Rotation.from_rotvec(x[k] * a / np.linalg.norm(a)) for k, a in ((6, al), (7, au)))
            turn, centre = Rotation.from_rotvec(x[3:6]), CENTRE + x[:3]

            def on(point):
                return centre + turn.apply(point - CENTRE)

            balls = [pl + lower.apply(bl - pl), pu + upper.apply(bu - pu)]
            rod = np.linalg.norm(on(ro) - ri) - np.linalg.norm(ro - ri)
            return np.concatenate([on(bl) - balls[0], on(bu) - balls[1], [rod, x[2] - height]])

        if abs(height) < 1e-12:
            x = np.zeros(8)
        x = fsolve(gaps, x if height * (out[-1][0] if out else 0.0) > 0.0 else np.zeros(8), xtol=1e-12)
        assert np.abs(gaps(x)).max() < 1e-11
        lower = Rotation.from_rotvec(x[6] * al / np.linalg.norm(al))
        strut = np.linalg.norm(pl + lower.apply(foot - pl) - top)
        turn = Rotation.from_rotvec(x[3:6])
        balls = [CENTRE + x[:3] + turn.apply(each - CENTRE) for each in (bl, bu)]
        out.append((height, CENTRE + x[:3], turn.apply([0.0, 1.0, 0.0]), strut, balls))
    out.sort(key=lambda each: -each[0])
    return [np.array([each[k] for each in out]) for k in range(1, 5)]


def test_a_double_wishbone_moves_as_its_closed_loops():
    rig, wheels = on_rig(axle(SPATIAL))
    bump = measured(rig, wheels, "bump", TRAVEL)
    centre, spin, strut, _ = closed(SPATIAL)
    assert np.abs(bump.centre["left_tyre"] - centre).max() < 1e-8
    assert np.abs(np.radians(bump.angles["camber"]["left_tyre"]) - -np.arcsin(spin[:, 2])).max() < 1e-8
    assert np.abs(np.radians(bump.angles["toe"]["left_tyre"]) - np.arctan2(spin[:, 0], spin[:, 1])).max() < 1e-8
    assert np.abs(bump.springs["left_strut"] - strut).max() < 1e-8
    assert np.ptp(bump.angles["camber"]["left_tyre"]) > 1.0
    assert np.ptp(bump.angles["toe"]["left_tyre"]) > 0.05
    # the right one is its image
    for ours in (*bump.angles.values(), bump.load):
        assert np.abs(ours["right_tyre"] - ours["left_tyre"]).max() < 1e-6 * (1.0 + np.abs(ours["left_tyre"]).max())


@pytest.mark.parametrize("sides", [(1, -1), (1,)])
def test_the_roll_centre_is_that_of_the_instant_centres(sides):
    rig, wheels = on_rig(axle(PLANAR, sides=sides))
    bump = measured(rig, wheels, "bump", TRAVEL)
    found = roll_centre(bump, wheels[0], wheels[1] if len(sides) > 1 else None)
    centre, _, _, balls = closed(PLANAR)
    (_, yl, zl), (_, yu, zu) = PLANAR["lower"][0], PLANAR["upper"][0]
    for k in range(len(ENDS)):
        (_, y1, z1), (_, y2, z2) = balls[k]
        lower, upper = (z1 - zl) / (y1 - yl), (z2 - zu) / (y2 - yu)
        y = (zu - zl + lower * yl - upper * yu) / (lower - upper)  # where the lines of the arms meet
        z = zl + lower * (y - yl)
        contact = centre[k, 1], centre[k, 2] - RADIUS
        height = contact[1] - contact[0] * (z - contact[1]) / (y - contact[0])
        assert found[k, 1] == pytest.approx(height - contact[1], abs=1e-8)
        assert found[k, 0] == pytest.approx(0.0, abs=1e-8)
    assert found[MIDDLE, 1] > 0.02


def test_a_wheel_rate_is_the_spring_rate_by_the_square_of_the_motion_ratio():
    rig, wheels = on_rig(axle(SPATIAL))
    found = {case: measured(rig, wheels, case, TRAVEL) for case in ("bump", "roll")}
    numbers = numbers_of(wheels, found)
    left, both = numbers["left_tyre"], numbers["left_tyre and right_tyre"]
    ratio = left["motion ratio of left_strut"][0]
    _, _, strut, _ = closed(SPATIAL)
    length = Chebyshev.fit(TRAVEL * ENDS, strut, len(ENDS) - 1)
    assert ratio == pytest.approx(length.deriv()(0.0), rel=1e-8)
    assert 1e3 * left["wheel rate"][0] == pytest.approx(K * ratio**2, rel=1e-8)
    assert "motion ratio of right_strut" not in left
    # the load of the rig is the derivative of the energy, ½ K (l - l₀)²
    load = K * (strut - math.dist(*STRUT)) * length.deriv()(TRAVEL * ENDS)
    assert found["bump"].load["left_tyre"] == pytest.approx(load, abs=1e-8 * np.abs(load).max())
    # in roll the wheels are t/2 from the middle: K_φ = K_w t²/2, and loads are none at the drawn height
    track = both["track"][0]
    assert track == pytest.approx(1.5, abs=1e-9)
    wanted = 1e3 * left["wheel rate"][0] * track**2 / 2.0 * math.pi / 180.0
    assert both["roll stiffness"][0] == pytest.approx(wanted, rel=1e-7)


def test_a_preloaded_spring_is_stiffer_or_softer_by_the_change_of_its_ratio():
    free = 0.60
    rig, wheels = on_rig(axle(SPATIAL, free))
    found = {case: measured(rig, wheels, case, TRAVEL) for case in ("bump",)}
    _, _, strut, _ = closed(SPATIAL)
    length = Chebyshev.fit(TRAVEL * ENDS, strut, len(ENDS) - 1)
    force = K * (math.dist(*STRUT) - free)
    wanted = K * length.deriv()(0.0) ** 2 + force * length.deriv(2)(0.0)
    assert abs(force * length.deriv(2)(0.0)) > 100.0
    assert 1e3 * numbers_of(wheels, found)["left_tyre"]["wheel rate"][0] == pytest.approx(wanted, rel=1e-7)


STIFFNESS = [2e6, 3e6, 4e6, 5e4, 6e4, 7e4]
OUT = 0.08  # [m] of the wheel from its bushing


def test_compliance_of_a_bushing_is_its_closed_form():
    """A wheel outside of one bushing: what turns about z by a force to the front, and about x by a force to the side."""
    bodies = {
        "chassis": {"mass": 800, "inertia": [200, 400, 500], "position": [0, 0, 0.5]},
        "hub": {"mass": 20, "inertia": [1, 1, 1], "position": list(CENTRE)},
    }
    inner = [0.0, CENTRE[1] - OUT, RADIUS]
    forces = {"rubber": {"type": "bushing", "bodies": ["chassis", "hub"], "points": [inner, inner], "stiffness": STIFFNESS},
              "tyre": {**TYRE, "wheel": "spindle"}}  # fmt: skip
    joints = {
        "stands": {"type": "translational", "bodies": ["ground", "chassis"], "point": [0, 0, 0.5], "axis": [0, 0, 1]}
    }
    markers = {"road": {"body": "ground", "axis": [0, 0, 1]}, "spindle": {"body": "hub", "axis": [0, 1, 0]}}
    rig, wheels = on_rig(
        machine({"gravity": [0, 0, 0], "bodies": bodies, "joints": joints, "markers": markers, "forces": forces})
    )
    found = {case: measured(rig, wheels, case, size) for case, size in
             (("bump", 1e-3), ("longitudinal", 100.0), ("lateral", 100.0), ("aligning", 10.0))}  # fmt: skip
    of = numbers_of(wheels, found, (2.5, 0.5, 0.6))["tyre"]
    kx, ky, kz, cx, _, cz = STIFFNESS
    degrees = math.degrees(1.0)
    # a turn by +1 about z moves the front of a left wheel outwards: toe -1; a force to the front at OUT turns by -OUT/c
    assert of["toe by aligning load"][0] == pytest.approx(-1e3 / cz * degrees, rel=1e-8)
    assert of["toe by longitudinal load"][0] == pytest.approx(1e3 * OUT / cz * degrees, rel=1e-8)
    assert of["centre to the front by longitudinal load"][0] == pytest.approx(1e6 * (1.0 / kx + OUT**2 / cz), rel=1e-8)
    assert of["centre to the left by lateral load"][0] == pytest.approx(1e6 / ky, rel=1e-8)
    # the rig holds the height of the centre: it sinks by N/k_z as it is lifted by OUT φ; (R F + OUT N) = c φ
    turn = RADIUS / (cx + OUT**2 * kz)
    assert of["camber by lateral load"][0] == pytest.approx(-1e3 * turn * degrees, rel=1e-8)
    # series of both springs under the wheel
    assert 1e3 * of["wheel rate"][0] == pytest.approx(1.0 / (1.0 / kz + OUT**2 / cx), rel=1e-8)
    assert of["anti-dive"][0] == pytest.approx(0.0, abs=1e-6)


def test_the_command_gives_the_axle_of_the_example_and_its_page(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    told = CliRunner().invoke(main, ["kc", str(AXLE), "--braking", "2.7", "0.55", "0.65", "--json", "--quiet"])
    assert told.exit_code == 0, told.output
    found = json.loads(told.stdout)
    left, right = found["left_tyre"], found["right_tyre"]
    assert left["toe by bump"] == pytest.approx(right["toe by bump"], rel=1e-6)
    assert left["toe by lateral load"] == pytest.approx(-right["toe by lateral load"], rel=1e-6)
    # anti-dive by its definition: share of the front brakes · slope of the contact · wheelbase/height
    assert left["anti-dive"] == pytest.approx(0.65 * left["contact to the front by bump"] / 10.0 * 2.7 / 0.55, rel=1e-9)
    assert 0.0 < found["left_tyre and right_tyre"]["roll centre above the ground"] < 0.3
    page = (tmp_path / "front-axle-kc.html").read_text()
    for title in ("toe by bump", "camber by roll", "roll centre by bump", "toe by lateral"):
        assert title in page


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--chassis", "frame"], "there is no body `frame`"),
        (["--braking", "2.7", "0.55", "-1"], "x>0"),
        (["--hold", "guide.displacemnt"], "did you mean `displacement`"),
    ],
)
def test_what_the_rig_cannot_do_is_said(options, said, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    told = CliRunner().invoke(main, ["kc", str(AXLE), *options, "--quiet"])
    assert told.exit_code == 2
    assert said in told.output


def test_a_machine_without_tyres_has_no_wheels():
    with pytest.raises(ModelError, match="type: tyre"):
        on_rig(machine({"bodies": {"a": {"mass": 1, "inertia": [1, 1, 1]}}}))
