"""Vehicles: `nivel handling MACHINE`, standard manoeuvres of a vehicle with a block `vehicle-driver`; `nivel kc MACHINE`, kinematics and
compliance of a suspension on a test rig. Both give numbers and a page."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, cast

import click

from nivel.cli.options import file_argument, json_option, override_option, separated
from nivel.cli.progress import progress_listener
from nivel.errors import Fault, ModelError
from nivel.lazy import nivel, numpy

if TYPE_CHECKING:
    from nivel.api import Machine
    from nivel.elements.control.vehicle_driver import VehicleDriver
    from nivel.report.vehicle_pages import Curves, Manoeuvre, Numbers, Wheel


TURN, SMALL = 4.0, 0.2  # [m/s²] of a turn, and of one so small that its tyres are linear
# [s] of a step, of a small turn to each side, of the ramp after them; where brakes come
AT, HOLD, RAMP, BRAKES = 1.0, 4.0, 20.0, 5.0
GRIP, SLOPE = 0.3, 0.15  # of the left side of a split road, and of a slope
# lengths of ISO 3888-2:2011 from the first gate on: gates and ways between them; the lane beside is 1 m to the left
LENGTHS: Final = (12.0, 13.5, 11.0, 12.5, 12.0)
BEFORE = 20.0  # [m] that the vehicle drives up to them
Made = tuple["Machine", Callable[["Manoeuvre"], "Numbers"]]


@click.command()
@file_argument("machine")
@override_option
@click.option("--only", metavar="NAMES", multiple=True, callback=separated, help="Manoeuvres; default: all.")
@click.option("--width", default=1.8, show_default=True, help="Width of the vehicle [m], for the lanes of lane-change.")
@click.option("--out", type=click.Path(dir_okay=False), help="Page; default: MACHINE-handling.html.")
@click.option("--force", is_flag=True, help="Overwrite the page.")
@click.option("--no-verify", is_flag=True, help="Without second runs.")
@click.option("--quiet", is_flag=True, help="Print only faults.")
@json_option
def handling(machine: str, overrides: dict[str, str], only: tuple[str, ...] | None, width: float, out: str | None, force: bool,
            no_verify: bool, quiet: bool, as_json: bool) -> None:  # fmt: skip
    """Drive MACHINE through standard manoeuvres: circle (ISO 4138), step (ISO 7401), lane-change (ISO 3888-2), brake-in-turn, split-grip,
    slope.

    The speed is that of the machine at its start. It needs a block `vehicle-driver` with a `course`, whose pedals and steering act.
    """
    loaded = nivel.api.load(machine, overrides)
    for name in only or ():
        if name not in MANOEUVRES:
            raise ModelError(Fault.at("handling.only", f"one of {', '.join(MANOEUVRES)} was expected, got `{name}`"))
    page = Path(out or f"{loaded.name}-handling.html")
    nivel.files.target.check_target(page, "page", force=force, sources=[Path(machine)])
    found = {}
    try:
        with progress_listener(quiet) as listener:
            for name in only or MANOEUVRES:
                found[name] = drive(loaded, name, width, verify=not no_verify, listener=listener)
    finally:  # what was driven before one that fails is kept
        if found:
            nivel.files.target.write_file(page, "page", nivel.report.vehicle_pages.handling_html(loaded.name, found))
    tell({name: (numbers, trust) for name, (_, numbers, trust) in found.items()}, page, quiet=quiet, as_json=as_json)


def tell(told: Mapping[str, tuple[Numbers, str]], page: Path, *, quiet: bool, as_json: bool) -> None:
    """Print numbers with their verdicts, as JSON or in lines."""
    if as_json:
        values = {
            name: {what: value for what, (value, _) in numbers.items()} | {"trust": trust}
            for name, (numbers, trust) in told.items()
        }
        click.echo(json.dumps(values, indent=2))
    elif not quiet:
        for name, (numbers, trust) in told.items():
            click.echo(f"{name} (trust: {trust})")
            for what, (value, unit) in numbers.items():
                click.echo(f"  {what}: {value:.5g} {unit}")
        click.echo(f"page: {page}")


def drive(
    machine: Machine, name: str, width: float = 1.8, *, verify: bool = True, listener: Any = None
) -> tuple[Manoeuvre, Numbers, str]:
    """A manoeuvre: its histories, its numbers, and the verdict on the run. Raises ModelError where nobody drives."""
    drivers = cast("list[VehicleDriver]", [each for each in machine.record.control if each.type == "vehicle-driver"])
    if len(drivers) != 1 or drivers[0].course is None:
        wanted = "a control with one block `vehicle-driver` and its `course`, who steers and holds the speed"
        raise ModelError(Fault.at("control", f"{wanted}, was expected"))
    bodies = machine.record.bodies
    chassis = max(range(len(bodies)), key=lambda k: bodies[k].mass or 0.0)
    speed = math.hypot(*bodies[chassis].velocity)
    made, measured = MANOEUVRES[name](machine, drivers[0], speed, width)
    run = made.simulate(verify=verify, listener=listener)
    history = nivel.report.vehicle_pages.Manoeuvre.of(name, run, chassis, drivers[0].name)
    return history, measured(history), run.trust.verdict if verify else f"{run.trust.verdict}, not verified"


def _open_loop(driver: VehicleDriver, steering: str | float, target: str | float) -> VehicleDriver:
    return driver.replace(course=None, x=None, y=None, heading=None, wheelbase=None, steering=steering, target=target)


def _turning(driver: VehicleDriver, speed: float) -> float:
    """Steering of the linear single track for TURN."""
    return ((driver.wheelbase or 0.0) / speed**2 + driver.understeer) * TURN


def circle(machine: Machine, driver: VehicleDriver, speed: float, width: float) -> Made:
    angle, small = 1.5 * _turning(driver, speed), SMALL / TURN * _turning(driver, speed)
    sides = f"step(time, 0, 0, 1, {small!r}) - step(time, {HOLD}, 0, {HOLD + 1.0}, {2.0 * small!r})"
    own = _open_loop(driver, f"{sides} + {angle + small!r}*max(time - {2.0 * HOLD}, 0)/{RAMP}", speed)
    pages, wheelbase = nivel.report.vehicle_pages, driver.wheelbase or 0.0
    made = machine.replace(own).with_settings({"duration": 2.0 * HOLD + RAMP})
    return made, lambda m: pages.circle_numbers(m, wheelbase, (HOLD, 2.0 * HOLD))


def step(machine: Machine, driver: VehicleDriver, speed: float, width: float) -> Made:
    own = _open_loop(driver, f"step(time, {AT}, 0, {AT + 0.1}, {_turning(driver, speed)!r})", speed)
    return machine.replace(own).with_settings({"duration": AT + 4.0}), nivel.report.vehicle_pages.step_numbers


def lane_change(machine: Machine, driver: VehicleDriver, speed: float, width: float) -> Made:
    wide = 1.1 * width + 0.25, width + 1.0, max(1.3 * width + 0.25, 3.0)
    over = 0.5 * wide[0] + 1.0 + 0.5 * wide[1]
    ends = [BEFORE + sum(LENGTHS[:k]) for k in range(len(LENGTHS) + 1)]
    gates = [(ends[0], ends[1], -0.5 * wide[0], 0.5 * wide[0]), (ends[2], ends[3], over - 0.5 * wide[1], over + 0.5 * wide[1]),
             (ends[4], ends[5], 0.5 * wide[0] - wide[2], 0.5 * wide[0])]  # fmt: skip
    xs = [2.0 * k for k in range(int(ends[5] / 2.0) + 40)]
    places = [(x, over * (_over((x - ends[1]) / LENGTHS[1]) - _over((x - ends[3]) / LENGTHS[3]))) for x in xs]
    own = driver.replace(course=tuple(places), target=speed)
    made = machine.replace(own).with_settings({"duration": (ends[5] + 20.0) / speed})
    return made, lambda m: nivel.report.vehicle_pages.lane_numbers(m, gates, width)


def _over(share: float) -> float:
    """From 0 to 1 without a jump of curvature."""
    u = min(max(share, 0.0), 1.0)
    return u**3 * (10.0 - 15.0 * u + 6.0 * u * u)


def brake_in_turn(machine: Machine, driver: VehicleDriver, speed: float, width: float) -> Made:
    own = _open_loop(driver, f"step(time, 0, 0, 2, {_turning(driver, speed)!r})", f"if(time < {BRAKES}, {speed!r}, 0)")
    made = machine.replace(own).with_settings({"duration": BRAKES + speed / 4.0})
    return made, lambda m: nivel.report.vehicle_pages.braking_numbers(m, BRAKES)


def split_grip(machine: Machine, driver: VehicleDriver, speed: float, width: float) -> Made:
    tyres = [each.replace(grip=f"if(y > 0, {GRIP}, 1)") for each in machine.record.forces if each.type == "tyre"]
    straight = tuple((k * 20.0, 0.0) for k in range(12))
    own = driver.replace(course=straight, target=f"if(time < {AT}, {speed!r}, 0)")
    made = machine.replace(own, *tyres).with_settings({"duration": AT + speed / 3.0})
    return made, lambda m: nivel.report.vehicle_pages.braking_numbers(m, AT)


def slope(machine: Machine, driver: VehicleDriver, speed: float, width: float) -> Made:
    angle, down = math.atan(SLOPE), math.hypot(*machine.record.gravity)
    at_rest = [
        each.replace(velocity=(0.0, 0.0, 0.0), angular_velocity=(0.0, 0.0, 0.0)) for each in machine.record.bodies
    ]
    own = _open_loop(driver, 0.0, f"if(time < {AT}, 0, 5)")
    made = machine.replace(own, *at_rest, gravity=(-down * math.sin(angle), 0.0, -down * math.cos(angle)))
    return made.with_settings({"duration": 6.0}), nivel.report.vehicle_pages.slope_numbers


MANOEUVRES: Final[Mapping[str, Callable[..., Made]]] = {
    "circle": circle, "step": step, "lane-change": lane_change, "brake-in-turn": brake_in_turn, "split-grip": split_grip, "slope": slope,
}  # fmt: skip


ALIGNED: Final = 1e-3  # of the radius: how far the centre of a wheel is off its axle at most
LEVER = 0.1  # [m] of the aligning moment, by the force
# what each case does to left and right wheels: heights; force to the front and to the left, moment upwards
CASES: Final[Mapping[str, tuple[tuple[int, int], tuple[int, int, int]]]] = {
    "bump": ((1, 1), (0, 0, 0)),
    "roll": ((1, -1), (0, 0, 0)),
    "longitudinal": ((0, 0), (1, 0, 0)),
    "lateral": ((0, 0), (0, 1, 0)),
    "aligning": ((0, 0), (0, 0, 1)),
}


@click.command()
@file_argument("machine")
@override_option
@click.option("--chassis", metavar="BODY", help="Body that the rig holds, or `ground`; default: the heaviest.")
@click.option("--hold", metavar="COORDINATES", multiple=True, callback=separated, help="Coordinates that stay.")
@click.option("--travel", default=0.05, show_default=True, help="Way of the wheels up and down [m].")
@click.option("--load", default=1000.0, show_default=True, help="Force [N] at each wheel; moments are 0.1 m of it.")
@click.option("--braking", nargs=3, type=click.FloatRange(0.0, min_open=True), metavar="L H SHARE",
              help="For anti-dive: wheelbase, height of the centre of mass [m], share of the front brakes.")  # fmt: skip
@click.option("--out", type=click.Path(dir_okay=False), help="Page; default: MACHINE-kc.html.")
@click.option("--force", is_flag=True, help="Overwrite the page.")
@click.option("--quiet", is_flag=True, help="Print only faults.")
@json_option
def kc(machine: str, overrides: dict[str, str], chassis: str | None, hold: tuple[str, ...] | None, travel: float, load: float,
            braking: tuple[float, float, float] | None, out: str | None, force: bool, quiet: bool, as_json: bool) -> None:  # fmt: skip
    """Move the wheels of MACHINE on a rig: bump, roll, longitudinal, lateral and aligning loads. Gives toe, camber, wheel rate, motion
    ratio, roll centre, anti-dive and compliance.

    The wheels are those of its tyres, whose place the rig takes; they do not spin. x points forwards, y to the left, z up.
    """
    loaded = nivel.api.load(machine, overrides)
    page, kc = Path(out or f"{loaded.name}-kc.html"), nivel.report.vehicle_pages
    nivel.files.target.check_target(page, "page", force=force, sources=[Path(machine)])
    (rig, wheels), found, told = on_rig(loaded, chassis, hold or ()), dict[str, Any](), dict[str, Any]()
    try:
        with progress_listener(quiet) as listener:
            for case, (heights, _) in CASES.items():
                size = travel if any(heights) else LEVER * load if case == "aligning" else load
                found[case] = measured(rig, wheels, case, size, listener)
    finally:  # what was measured before a case that fails is kept
        if "bump" in found:
            trust = max((each.trust for each in found.values()), key=("green", "amber", "red").index)
            told = {owner: (each, trust) for owner, each in kc.numbers_of(wheels, found, braking).items()}
            nivel.files.target.write_file(page, "page", kc.kc_html(loaded.name, wheels, found, told))
    tell(told, page, quiet=quiet, as_json=as_json)


def on_rig(machine: Machine, chassis: str | None = None, hold: tuple[str, ...] = ()) -> tuple[Machine, list[Wheel]]:
    """The machine with its chassis fixed, without tyres, and its wheels, which do not spin. hold : joint coordinates that stay.

    Raises ModelError where it has no tyres, or no such chassis.
    """
    record, wheels, held = machine.record, list[Any](), [*hold]
    tyres: list[Any] = [each for each in record.forces if each.type == "tyre"]
    if not tyres:
        raise ModelError(Fault.at("forces", "a `type: tyre` at each wheel was expected: its marker says where it is"))
    if chassis is None:
        chassis = max(record.bodies, key=lambda each: each.mass or 0.0).name
    if chassis != "ground" and chassis not in record.body_named:
        raise ModelError(Fault.at("kc.chassis", f"there is no body `{chassis}`"))
    builder = nivel.system.builder.SystemBuilder(record)
    ends = {each.name: nivel.system.states.relative.bodies_of(record, each) for each in record.joints}
    turning: list[Any] = [each for each in record.joints if each.type == "revolute" and (each.point or each.markers)]
    centres = {each.name: each.point or builder.as_placed(each.markers[0])[1] for each in turning}
    for tyre in tyres:
        (body, centre, axes), m = builder.as_placed(tyre.wheel), builder.end(tyre.wheel)
        side, axle = math.copysign(1.0, centre[1]), builder.markers.frame[m][:, 2] * math.copysign(1.0, axes[1, 2])
        point = builder.markers.position[m]
        wheels.append(nivel.report.vehicle_pages.Wheel(tyre.name, body, point, side * axle, side, tyre.radius))
        off = {name: numpy.cross(each - centre, axes[:, 2]) for name, each in centres.items() if body in ends[name]}
        held += [f"{name}.angle" for name, gap in off.items() if numpy.linalg.norm(gap) < ALIGNED * tyre.radius]
    joints = [each for each in record.joints if {*ends[each.name]} != {"ground", chassis}]
    if chassis != "ground":
        place = (0.0, 0.0, 0.0)
        joints.append(
            nivel.elements.joints.joint.Joint(name="kc_rig", type="fixed", bodies=("ground", chassis), point=place)
        )
    driven = {each.coordinate for each in record.drivers}
    free = [each for each in dict.fromkeys(held) if not driven & {each, each.partition(".")[0]}]
    locks = [
        nivel.elements.joints.drivers.Driver(name=f"kc_{k}", coordinate=each, value=0.0, from_start=True)
        for k, each in enumerate(free)
    ]
    still = {*held, *(each.partition(".")[0] for each in held)}  # what acts there, as brakes do, moves nothing
    forces = [each for each in record.forces if each.type != "tyre" and getattr(each, "coordinate", None) not in still]
    return machine.replace(joints=joints, drivers=[*record.drivers, *locks], forces=forces, control=[]), wheels


def measured(rig: Machine, wheels: list[Wheel], case: str, size: float, listener: Any = None) -> Curves:
    """A case of CASES on the rig, up to `size` [m, N or N m]; forces act at the ground, by moments about the centre.

    Raises SolveError where there is no equilibrium.
    """
    added, (heights, (ahead, aside, turning)) = list[Any](), CASES[case]
    nodes = nivel.report.vehicle_pages.WAY

    def way(share: float) -> Any:
        table = {"times": [*range(len(nodes))], "values": (size * share * nodes).tolist(), "interpolation": "cubic"}
        return table if share else 0.0

    for wheel in wheels:
        name, height = f"kc_{wheel.name}", heights[0] if wheel.side > 0.0 else heights[1]
        force = [way(ahead), way(aside), 0.0]
        moment = [way(aside * wheel.radius), way(-ahead * wheel.radius), way(turning)]
        added += [
            nivel.machine.core.element.Marker(name=name, body=wheel.body, position=tuple(wheel.point)),
            nivel.elements.joints.drivers.Driver(name=name, marker=name, along="z", value=way(height), from_start=True),
            nivel.elements.forces.loads.PointForce(name=f"{name}_force", marker=name, vector=force),
            nivel.elements.forces.loads.Torque(name=f"{name}_moment", body=wheel.body, vector=moment),
        ]
    run = rig.with_elements(*added).statics(duration=len(nodes) - 1.0, step=1.0, listener=listener)
    return nivel.report.vehicle_pages.Curves.of(run, wheels, size)
