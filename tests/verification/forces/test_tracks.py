"""Tracks against closed forms: drawbar pull, work of compaction, turning resistance, rolling, standing and sliding."""

import math

import numpy as np
import pytest

import nivel
from nivel.errors import ModelError, SolveError
from simulating import G, machine, simulate

LENGTH, GAUGE, RADIUS, MASS = 3.0, 2.0, 0.3, 10_000.0
SPROCKET, INERTIA = 50.0, 4.0
WEIGHT = (MASS + 2.0 * SPROCKET) * G
GRIP, PRESSED_IN = 0.8, 0.01  # as they are where nothing is given
SOIL = {"modulus": 1.5e6, "exponent": 0.7, "cohesion": 5e3, "friction_angle": 0.5, "shear_length": 0.025}
FIELD = {"heights": {"size": [16, 10], "function": "0", "points": [161, 101]}, "soil": SOIL}


def belt(speed, running, sinkage=0.05, **force):
    """A track of 2 m on a rail, `sinkage` deep, whose frame and belt have given speeds."""
    z = -sinkage
    return {
        "gravity": [0, 0, -G],
        "bodies": {
            "frame": {"mass": 1000, "inertia": [200, 300, 400], "position": [-3, 0, z]},
            "sprocket": {"mass": 20, "inertia": [1, 1, 1], "position": [-3, 0, z + RADIUS]},
        },
        "markers": {"road": {"body": "ground", "axis": [0, 0, 1]}},
        "joints": {
            "rail": {"type": "translational", "bodies": ["ground", "frame"], "point": [-3, 0, z], "axis": [1, 0, 0]},
            "hub": {"type": "revolute", "bodies": ["frame", "sprocket"], "point": [-3, 0, z + RADIUS], "axis": [0, 1, 0]},
        },
        "drivers": {
            "tow": {"coordinate": "rail.displacement", "value": f"{speed}*time"},
            "spin": {"coordinate": "hub.angle", "value": f"{running / RADIUS}*time"},
        },
        "forces": {
            "belt": {
                "type": "track", "contact": [{"body": "frame", "position": [x, 0, 0]} for x in (1, -1)], "width": 0.5,
                "sprocket": {"body": "sprocket", "axis": [0, 1, 0]}, "radius": RADIUS, "plane": "road", **force,
            }
        },
        "simulation": {"duration": 10, "step": 1e-3, "output_interval": 0.1},
    }  # fmt: skip


@pytest.mark.parametrize("patches", [2, 10])
@pytest.mark.parametrize("slip", [0.05, 0.2, 0.6, -0.3])
def test_the_drawbar_pull_on_soft_soil_is_wongs(slip, patches):
    speed = 0.4
    running = speed / (1.0 - slip) if slip > 0.0 else speed * (1.0 + slip)
    found = simulate(belt(speed, running, heights={"size": [20, 2], "function": "0", "points": [401, 41]}, soil=SOIL,
                          patches=patches), duration=20)  # fmt: skip
    pull, resisted, load, driving = (
        found.array(f"force.belt.{name}")[-1] for name in ("pull", "resistance", "magnitude", "driving_moment")
    )
    # p = k z^n over the area of 2 m by 0.5 m
    pressure = SOIL["modulus"] * 0.05 ** SOIL["exponent"]
    assert load == pytest.approx(pressure, rel=1e-12)
    # Wong 2008, 2.5, after Janosi and Hanamoto: (A c + W tan φ) (1 - K/(i L) (1 - exp(-i L/K))), and where it is towed with the shear of
    # the way j = |v_slide| x/v_belt instead; the damper leaves a part of τ v_belt/L exp(-i L/K)
    share = abs(running - speed) / running * 2.0 / SOIL["shear_length"]
    full = SOIL["cohesion"] + load * math.tan(SOIL["friction_angle"])
    wong = math.copysign(full * (1.0 - (1.0 - math.exp(-share)) / share), slip)
    assert pull + resisted == pytest.approx(wong, rel=1e-4 if slip == 0.05 else 1e-8)
    assert driving == pytest.approx(-RADIUS * (pull + resisted), rel=1e-12)
    # Bekker 1969: the work of a plate of this width that sinks as deep, by the length of the rut
    n = SOIL["exponent"]
    assert resisted == pytest.approx(0.5 * SOIL["modulus"] * 0.05 ** (n + 1.0) / (n + 1.0), rel=1e-9)


def test_in_its_rut_nothing_resists_and_a_rut_has_the_depth_of_the_belt():
    sections = belt(1.0, 1.0, heights={"size": [20, 2], "function": "0", "points": [401, 41]}, soil=SOIL)
    sections["drivers"]["tow"]["value"] = "3*step(time, 0, 0, 3, 1) - 3*step(time, 4, 0, 7, 1)"
    sections["drivers"]["spin"]["value"] = f"({sections['drivers']['tow']['value']})/{RADIUS}"
    found = simulate(sections)
    resisted, time = found.array("force.belt.resistance"), found.time
    most = 0.5 * SOIL["modulus"] * 0.05**1.7 / 1.7
    assert resisted[np.searchsorted(time, 2.0)] == pytest.approx(most, rel=1e-6)
    # what is left is to press back the elastic return p/U of the rut
    pressure = SOIL["modulus"] * 0.05**0.7
    assert -resisted[np.searchsorted(time, 5.5)] == pytest.approx(0.5 * pressure**2 / 5e8, rel=1e-2)
    assert found.array("force.belt.sinkage")[-1] == pytest.approx(0.05, rel=1e-12)
    # what was pressed: the belt and its way, whole cells of 5 cm at each border
    assert found.array("force.belt.moved")[-1] == pytest.approx(0.05 * 0.5 * 5.0, rel=0.15)


def crawler(
    slope=0.0,
    *,
    across=False,
    locked=False,
    efforts=None,
    speed=0.0,
    sunk=0.005,
    forces=None,
    ground=None,
    **simulation,
):
    """A vehicle on two tracks, on a slope along its way or across. efforts : of the motors at its sprockets, or a brake."""
    down = -G * math.sin(slope)
    gravity = [0, down, -G * math.cos(slope)] if across else [down, 0, -G * math.cos(slope)]
    frame = {"mass": MASS, "inertia": [5e3, 1e4, 1.2e4], "position": [0, 0, 0.8 - sunk], "velocity": [speed, 0, 0]}
    made = {"bodies": {"frame": frame}, "joints": {}, "forces": {}}
    for name, y in (("left", 0.5 * GAUGE), ("right", -0.5 * GAUGE)):
        at = [-0.5 * LENGTH, y, 0.35 - sunk]
        made["bodies"][f"{name}_sprocket"] = {"mass": SPROCKET, "inertia": [2, INERTIA, 2], "position": at,
                                              "velocity": [speed, 0, 0], "angular_velocity": [0, speed / RADIUS, 0]}  # fmt: skip
        hub = {"type": "revolute", "axis": [0, 1, 0]} if not locked else {"type": "fixed"}
        made["joints"][f"{name}_hub"] = {**hub, "bodies": ["frame", f"{name}_sprocket"], "point": at}
        ends = [{"body": "frame", "position": [x, y, -0.8]} for x in (0.5 * LENGTH, -0.5 * LENGTH)]
        made["forces"][name] = {"type": "track", "contact": ends, "sprocket": {"body": f"{name}_sprocket", "axis": [0, 1, 0]},
                                "radius": RADIUS, "width": 0.5, "plane": "road", **(ground or {})}  # fmt: skip
        if efforts is not None:
            made["forces"][f"{name}_drive"] = {"type": "motor", "coordinate": f"{name}_hub", "effort": efforts[name]}
    made["forces"] |= forces or {}
    settings = {"duration": 4, "step": 1e-3, "output_interval": 0.05, **simulation}
    return {
        "gravity": gravity,
        "markers": {"road": {"body": "ground", "axis": [0, 0, 1]}},
        **made,
        "simulation": settings,
    }


TEN_PER_CENT = math.atan(0.1)
IDLING = {
    "idling": {"type": "force", "body": "frame", "vector": ["2000*sin(2*pi*25*time)", "1500*sin(2*pi*25*time)", 0]}
}
BRAKES = {
    f"{name}_brake": {"type": "brake", "coordinate": f"{name}_hub", "capacity": 1e6} for name in ("left", "right")
}


@pytest.mark.parametrize("across", [False, True])
@pytest.mark.parametrize("holds", ["locked", "brakes"])
def test_a_machine_parked_on_ten_per_cent_does_not_creep_while_its_engine_idles(holds, across):
    forces = {**IDLING, **(BRAKES if holds == "brakes" else {})}
    sections = crawler(TEN_PER_CENT, across=across, locked=holds == "locked", forces=forces, output_interval=0.04)
    place = machine(sections).simulate(verify=False, duration=60).array("position")[:, 0]
    assert np.abs(place[-1] - place[1000]).max() < 1e-9


def test_a_machine_parked_on_soil_comes_to_rest():
    found = machine(crawler(TEN_PER_CENT, locked=True, ground=FIELD)).simulate(
        verify=False, duration=60, output_interval=0.5
    )
    place = found.array("position")[:, 0]
    # it swings with √(c/m) and the damping of soil, and does not creep: amplitudes fall with every period
    swings = [np.abs(place[(found.time > t) & (found.time <= t + 10.0)] - place[-1]).max() for t in (10.0, 30.0, 49.0)]
    assert swings[0] > 10.0 * swings[1] > 100.0 * swings[2]
    pulls, loads = (
        sum(found.array(f"force.{name}.{what}")[-1] for name in ("left", "right")) for what in ("pull", "magnitude")
    )
    assert pulls == pytest.approx(WEIGHT * math.sin(TEN_PER_CENT), rel=5e-3)
    assert loads == pytest.approx(WEIGHT * math.cos(TEN_PER_CENT), rel=1e-3)


def test_statics_finds_the_stretch_of_the_patches_and_refuses_what_the_grip_does_not_hold():
    found = machine(crawler(TEN_PER_CENT, locked=True)).statics()
    # F = μ N s with s = x/K, and the belt gives way by 1 cm under the weight
    x, _, z = found.array("position")[-1, 0]
    assert x == pytest.approx(-0.01 * math.tan(TEN_PER_CENT) / GRIP, abs=1.1e-3)  # and it leans
    assert z == pytest.approx(0.8 - PRESSED_IN * math.cos(TEN_PER_CENT), abs=1e-4)
    with pytest.raises(SolveError):
        machine(crawler(math.atan(0.9), locked=True)).statics()
    rests = machine(crawler(TEN_PER_CENT, locked=True)).simulate(start="equilibrium", duration=1, verify=False)
    assert np.ptp(rests.array("position")[:, 0], axis=0).max() < 1e-12


def test_a_standing_machine_vibrates_up_and_down_on_its_belts():
    linear = machine(crawler(locked=True)).linearise(about="equilibrium")
    heave = np.abs(linear.eigenvalues[np.abs(np.imag(linear.eigenvalues)) > 0.0])
    assert np.abs(heave / math.sqrt(G / PRESSED_IN) - 1.0).min() < 1e-4


def test_locked_tracks_slide_down_a_steep_slope_by_the_grip():
    slope = math.atan(1.0)
    found = simulate(crawler(slope, locked=True, duration=6))
    late = found.time > 4.0
    slope_of_speed = np.polyfit(found.time[late], found.array("velocity")[late, 0, 0], 1)[0]
    assert slope_of_speed == pytest.approx(-G * (math.sin(slope) - GRIP * math.cos(slope)), rel=1e-4)


def test_free_tracks_roll_without_loss():
    found = simulate(crawler(speed=3.0, sunk=PRESSED_IN))
    speed = found.array("velocity")[:, 0, 0]
    assert np.abs(speed[found.time > 3.0] - 3.0).max() < 2e-9
    # down a slope its sprockets turn with it
    found = simulate(crawler(-TEN_PER_CENT))
    late = found.time > 2.0
    gained = np.polyfit(found.time[late], found.array("velocity")[late, 0, 0], 1)[0]
    whole = MASS + 2.0 * SPROCKET + 2.0 * INERTIA / RADIUS**2
    assert gained == pytest.approx(WEIGHT * math.sin(TEN_PER_CENT) / whole, rel=1e-6)


@pytest.mark.parametrize(("shear_length", "patches", "tolerance"), [(1e-3, 10, 1e-5), (1e-2, 40, 2e-4)])
def test_a_slow_turn_on_the_spot_needs_the_moment_of_the_closed_form(shear_length, patches, tolerance):
    sections = crawler(ground={"shear_length": shear_length, "patches": patches}, duration=20)
    sections["joints"]["turn"] = {
        "type": "cylindrical",
        "bodies": ["ground", "frame"],
        "point": [0, 0, 0],
        "axis": [0, 0, 1],
    }
    sections["drivers"] = {"yaw": {"coordinate": "turn.angle", "value": "0.2*time"}}
    found = machine(sections).simulate(verify=False)
    # μ W L/4 (Steeds 1950; Wong 2008, 6.2), less what shear that comes and turns over K takes. A free belt runs with ω B/2, so with
    # ds/dx = ∓(1 ± s) 2 x/(B K) s is 1 - exp(-(L²/4 - x²)/(B K)) up to the middle and 2 exp(-x²/(B K)) - 1 behind it; its moment has
    # the share 1 - 6 B K/L² of that
    expected = 0.25 * GRIP * WEIGHT * LENGTH * (1.0 - 6.0 * GAUGE * shear_length / LENGTH**2)
    assert found.array("driver.yaw.effort")[-1] == pytest.approx(expected, rel=tolerance)
    assert -sum(found.array(f"force.{name}.moment")[-1] for name in ("left", "right")) == pytest.approx(
        expected, rel=tolerance
    )


TURNING = {"left": "9000*step(time, 0, 0, 1, 1)", "right": "-6000*step(time, 0, 0, 1, 1)"}


@pytest.mark.parametrize("ground", [None, FIELD])
def test_left_and_right_are_alike(ground):
    one = simulate(crawler(efforts=TURNING, ground=ground))
    other = simulate(crawler(efforts={"left": TURNING["right"], "right": TURNING["left"]}, ground=ground))
    a, b = one.array("position")[:, 0], other.array("position")[:, 0]
    assert np.ptp(a, axis=0)[:2].min() > 0.02
    assert np.abs(a - b * [1, -1, 1]).max() < (1e-12 if ground is None else 1e-9)


def test_straight_on_there_is_no_lateral_force():
    found = simulate(crawler(efforts={"left": "3000", "right": "3000"}))
    assert np.abs(found.array("force.left.lateral")).max() < 1e-9


@pytest.mark.parametrize(
    "ground", [None, {"heights": {"size": [30, 30], "function": "0.1*sin(x)*cos(y)", "points": [121, 121]}}]
)
def test_two_steps_agree_and_energy_is_balanced(ground):
    sections = crawler(efforts=TURNING, ground=ground, duration=5)
    coarse, fine = machine(sections).simulate(verify=True), simulate(sections, step=5e-4)
    apart = np.abs(coarse.array("position") - fine.array("position")).max()
    lights = {item.name: item for item in coarse.trust.items}
    assert lights["energy"].verdict == "green"
    assert coarse.trust.verdict in ("green", "amber")
    fraction = lights["accuracy"].fraction
    assert fraction is not None
    assert apart <= max(3.0 * fraction, 1e-5)
    # what motors give is lost by sliding, but for what moves: on even ground the belt gives back what pressed it in
    assert (coarse.array("force.left.slip_loss") >= -1.0).all() or ground is not None


def test_grip_by_place_turns_a_machine_that_brakes():
    sections = crawler(
        speed=5.0, sunk=PRESSED_IN, locked=False, forces=BRAKES, ground={"grip": "if(y > 0, 0.2, 0.8)"}, duration=1
    )
    found = simulate(sections)
    assert found.array("orientation")[-1, 0, 3] < -0.01  # to the side that holds
    early = np.searchsorted(found.time, 0.2)
    for name, grip in (("left", 0.2), ("right", 0.8)):
        held = -found.array(f"force.{name}.pull")[early] / found.array(f"force.{name}.magnitude")[early]
        assert held == pytest.approx(grip, rel=0.01)


PART = """format: 1
name: side
bodies:
  frame: {mass: 10 t, inertia: [5000, 10000, 12000], position: [0, 0, 0.79]}
  sprocket: {mass: 50, inertia: [2, 4, 2], position: [-1.5, 0, 0.34]}
markers:
  front: {body: frame, position: [1.5, 0.2, -0.8]}
  rear: {body: frame, position: [-1.5, 0.2, -0.8]}
  axle: {body: sprocket, axis: [0, 1, 0]}
  floor: {body: ground, axis: [0, 0, 1]}
joints:
  hub: {type: revolute, bodies: [frame, sprocket], point: [-1.5, 0, 0.34], axis: [0, 1, 0]}
  upright: {type: planar, bodies: [ground, frame], point: [0, 0, 0.79], axis: [0, 0, 1]}
forces:
  belt: {type: track, contact: [front, rear], sprocket: axle, radius: 0.3, width: 0.5, plane: floor}
  gust: {type: force, body: frame, position: [1, 0, 0], vector: ["40000*step(time, 0, 0, 0.2, 1)", 0, 0]}
"""
MACHINE = """format: 1
name: placed
gravity: [0, 0, -9.81]
assemblies:
  one: {file: side.yaml}
  turned: {file: side.yaml, position: [0, 9, 0], orientation: {axis: [0, 0, 1], angle: 90 deg}}
  mirrored: {file: side.yaml, mirror: y}
simulation: {duration: 1, step: 1 ms}
"""


def test_a_part_with_a_track_is_turned_and_mirrored(tmp_path):
    (tmp_path / "side.yaml").write_text(PART)
    (tmp_path / "machine.yaml").write_text(MACHINE)
    found = nivel.load(tmp_path / "machine.yaml").simulate(verify=False)
    names = [each["name"] for each in found.scene["bodies"]]
    one, turned, mirrored = (
        found.array("position")[:, names.index(f"{part}_frame")] for part in ("one", "turned", "mirrored")
    )
    assert np.ptp(one, axis=0)[0] > 0.5
    assert np.abs(one[:, [1, 0, 2]] * [-1, 1, 1] + [0, 9, 0] - turned).max() < 1e-9
    assert np.abs(one * [1, -1, 1] - mirrored).max() < 1e-9


@pytest.mark.parametrize(
    ("changes", "place", "said"),
    [
        ({"contact": [{"body": "frame"}, {"body": "sprocket"}]}, "contact", "stand on one body"),
        ({"contact": [{"body": "frame"}, {"body": "frame"}]}, "contact", "across the line"),
        (
            {"contact": [{"body": "frame", "position": [1, 0, 0], "axis": [1, 0, 0]}, {"body": "frame"}]},
            "contact",
            "across the line",
        ),
        ({"sprocket": {"body": "frame"}}, "sprocket", "needs a body that turns on the frame"),
        ({"sprocket": {"body": "ground"}}, "sprocket", "needs a body that turns on the frame"),
        ({"sprocket": "spocket"}, "sprocket", "there is no marker"),
        ({"patches": 1}, "patches", "2 to 100 patches"),
        ({"soil": {}}, "heights", "are missing"),
        (
            {"soil": {}, "heights": {"size": [4, 4], "function": "0", "points": [41, 41]}, "stiffness": 1e6},
            "stiffness",
            "hard ground",
        ),
        ({"width": -0.5}, "width", ""),
    ],
)
def test_a_track_that_cannot_be_is_refused(changes, place, said):
    with pytest.raises(ModelError) as raised:
        simulate(belt(1.0, 1.0, **changes))
    fault = raised.value.faults[0]
    assert said in fault.message
    assert fault.path.startswith(f"forces.belt.{place}")


def test_stiffness_that_is_not_given_is_by_all_weight_also_that_of_shapes():
    sections = crawler(locked=True)
    frame = sections["bodies"]["frame"]
    for key in ("mass", "inertia"):
        del frame[key]
    # a box of 2.5 m³ and 10 t, around the same point
    frame |= {"shape": {"type": "box", "size": [2.5, 1, 1]}, "density": MASS / 2.5}
    found = machine(sections).statics().array("position")[-1, 0, 2]
    assert found == pytest.approx(0.8 - PRESSED_IN, abs=1e-4)
