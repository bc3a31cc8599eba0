"""Ten boxes set down on a conveyor and a hundred spheres in a hopper, with nivel and MuJoCo (extra `robots`) in one run.

Time of a step, and the error of each against a run of its own with steps of a twentieth: of the places of the boxes, and of the mean height
of the spheres, whose single places are chaotic. MuJoCo has no moving surfaces: its boxes slide on a plane at rest, seen from the belt.
Then what a step of up to 800 spheres costs for each of them.
"""

from __future__ import annotations

import tempfile
import time
from pathlib import Path

import numpy as np

import nivel

STEP, FINE, G, BELT = 2e-4, 20, 9.81, 0.5
RADIUS, SPHERES = 0.02, 100
COUNTS = (100, 200, 400, 800)
BOX = (0.3, 0.2, 0.2)
# walls of the hopper: 45°
S = float(np.sqrt(0.5))
WALLS = ((S, 0.0, S), (-S, 0.0, S), (0.0, S, S), (0.0, -S, S))


def boxes():
    """Places of ten boxes."""
    return [(0.5 * k, 0.0, 0.5 * BOX[2] + 0.001 * (k + 1)) for k in range(10)]


def spheres():
    """Places of a hundred spheres, in layers of 25 that are not quite regular."""
    rng = np.random.default_rng(0)
    grid = [(x, y, z) for z in range(4) for x in range(5) for y in range(5)]
    shifts = rng.uniform(-1e-3, 1e-3, (SPHERES, 2))
    return [
        ((x - 2) * 0.045 + a, (y - 2) * 0.045 + b, 0.17 + 0.045 * z)
        for (x, y, z), (a, b) in zip(grid, shifts, strict=True)
    ]


def nivel_boxes() -> tuple[str, list[str]]:
    """The conveyor as a machine file."""
    touch = "stiffness: 5e4, exponent: 1, restitution: 0.3, friction: 0.4"
    lines = [
        "format: 1",
        f"gravity: [0, 0, {-G}]",
        "markers: {belt: {body: ground, axis: [0, 0, 1], x_axis: [1, 0, 0]}}",
        "bodies:",
    ]
    lines += [
        f"  b{k}: {{position: {list(place)}, shape: {{type: box, size: {list(BOX)}}}, density: 120}}"
        for k, place in enumerate(boxes())
    ]
    lines += ["forces:"]
    lines += [
        f"  c{k}: {{type: contact, body: b{k}, plane: belt, {touch}, surface_velocity: [{BELT}, 0, 0]}}"
        for k in range(len(boxes()))
    ]
    return "\n".join(lines), [f"b{k}" for k in range(len(boxes()))]


def nivel_spheres() -> tuple[str, list[str]]:
    """The hopper as a machine file."""
    shape = f"shape: {{type: sphere, radius: {RADIUS}}}, density: 2500"
    planes = ", ".join(f"{{body: ground, axis: {list(wall)}}}" for wall in WALLS)
    lines = ["format: 1", f"gravity: [0, 0, {-G}]", "bodies:"]
    lines += [f"  s{k}: {{position: {[float(x) for x in place]}, {shape}}}" for k, place in enumerate(spheres())]
    lines += [
        "forces:",
        f"  heap: {{type: contacts, between: all, planes: [{planes}], stiffness: 2e4, exponent: 1, restitution: 0.5,",
    ]
    lines += ["    friction: 0.3, friction_transition_speed: 0.1}"]
    return "\n".join(lines), [f"s{k}" for k in range(SPHERES)]


def run_nivel(text, names, step, duration):
    """(places (n, 3) at the end, µs of a step)."""
    settings = f"\nsimulation: {{integrator: rk4, step: {step}, duration: {duration}, output_interval: {duration}}}\n"
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.yaml"
        path.write_text(text + settings, encoding="utf-8")
        result = nivel.load(path).simulate(verify=False)
    places = np.array([result.array(f"{name}.position")[-1] for name in names])
    return places, 1e6 * result.timing["loop_seconds"] / result.timing["steps"]


def nivel_layers(count: int) -> tuple[str, list[str]]:
    """So many spheres in some layers above a floor, as a machine file."""
    side, rng = int(np.ceil(0.5 * np.sqrt(count))), np.random.default_rng(0)
    shape = f"shape: {{type: sphere, radius: {RADIUS}}}, density: 2500"
    lines = ["format: 1", f"gravity: [0, 0, {-G}]", "markers: {floor: {body: ground, axis: [0, 0, 1]}}", "bodies:"]
    for k in range(count):
        z, y, x = k // side**2, k // side % side, k % side
        a, b = rng.uniform(-1e-3, 1e-3, 2).tolist()
        lines.append(f"  s{k}: {{position: [{x * 0.043 + a}, {y * 0.043 + b}, {0.021 + z * 0.043}], {shape}}}")
    lines += [
        "forces:",
        "  heap: {type: contacts, between: all, planes: [floor], stiffness: 2e4, exponent: 1, restitution: 0.5,",
        "    friction: 0.3, friction_transition_speed: 0.1}",
    ]
    return "\n".join(lines), [f"s{k}" for k in range(count)]


def report_growth():
    """A line for each number of spheres: what a step costs for each."""
    for count in COUNTS:
        layers, balls = nivel_layers(count)
        spent = min(run_nivel(layers, balls, STEP, 0.02)[1] for _ in range(2))
        print(
            f"{count} spheres on a floor    nivel    {spent:8.1f} µs a step, {spent / count:.2f} µs for each sphere",
            flush=True,
        )


def mujoco_boxes() -> tuple[str, float]:
    """The same boxes as MuJoCo knows them; the belt is at rest."""
    bodies = "".join(
        f'<body pos="{x} {y} {z}"><freejoint/><geom type="box" size="{BOX[0] / 2} {BOX[1] / 2} {BOX[2] / 2}" density="120"/></body>'
        for x, y, z in boxes()
    )
    return f'<geom type="plane" size="50 50 1"/>{bodies}', -BELT


def mujoco_spheres() -> tuple[str, float]:
    """The same spheres."""
    walls = "".join(f'<geom type="plane" size="5 5 1" zaxis="{x} {y} {z}"/>' for x, y, z in WALLS)
    bodies = "".join(
        f'<body pos="{x} {y} {z}"><freejoint/><geom type="sphere" size="{RADIUS}" density="2500"/></body>'
        for x, y, z in spheres()
    )
    return walls + bodies, 0.0


def run_mujoco(world, speed, step, duration, friction):
    """(places at the end, µs of a step)."""
    import mujoco

    text = f"""<mujoco><option timestep="{step}" gravity="0 0 {-G}" cone="elliptic" integrator="implicitfast"/>
      <default><geom friction="{friction} 0 0" condim="3" solref="0.004 0.5"/></default><worldbody>{world}</worldbody></mujoco>"""
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    data.qvel[0::6] = speed
    steps = round(duration / step)
    begin = time.process_time()
    for _ in range(steps):
        mujoco.mj_step(model, data)
    spent = time.process_time() - begin
    places = data.qpos.reshape(-1, 7)[:, :3].copy()
    places[:, 0] -= speed * data.time
    return places, 1e6 * spent / steps


def report(scene, program, run, measure):
    """One line: time of a step and the error against finer steps."""
    places, spent = run(STEP)
    fine, _ = run(STEP / FINE)
    error = measure(places, fine)
    print(f"{scene:24s} {program:8s} {spent:8.1f} µs a step of {1e3 * STEP:g} ms   error {error:.2g} m", flush=True)


def main():
    """All lines."""

    def apart(places, fine):
        return float(np.sqrt(np.mean(np.sum((places - fine) ** 2, axis=1))))

    def height(places, fine):
        return float(abs(places[:, 2].mean() - fine[:, 2].mean()))

    text, names = nivel_boxes()
    world, speed = mujoco_boxes()
    report("ten boxes on a conveyor", "nivel", lambda step: run_nivel(text, names, step, 0.5), apart)
    report("ten boxes on a conveyor", "MuJoCo", lambda step: run_mujoco(world, speed, step, 0.5, 0.4), apart)
    heap, balls = nivel_spheres()
    hopper, still = mujoco_spheres()
    report("a hundred spheres", "nivel", lambda step: run_nivel(heap, balls, step, 0.4), height)
    report("a hundred spheres", "MuJoCo", lambda step: run_mujoco(hopper, still, step, 0.4, 0.3), height)
    report_growth()


if __name__ == "__main__":
    main()
