"""`nivel handling MACHINE`: standard manoeuvres of a vehicle with a block `vehicle-driver`, their numbers, and a page."""

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
from nivel.lazy import nivel

if TYPE_CHECKING:
    from nivel.api import Machine
    from nivel.elements.control.vehicle_driver import VehicleDriver
    from nivel.report.handling_page import Manoeuvre, Numbers

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
def command(machine: str, overrides: dict[str, str], only: tuple[str, ...] | None, width: float, out: str | None, force: bool,
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
            nivel.files.target.write_file(page, "page", nivel.report.handling_page.handling_html(loaded.name, found))
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
    history = nivel.report.handling_page.Manoeuvre.of(name, run, chassis, drivers[0].name)
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
    pages, wheelbase = nivel.report.handling_page, driver.wheelbase or 0.0
    made = machine.replace(own).with_settings({"duration": 2.0 * HOLD + RAMP})
    return made, lambda m: pages.circle_numbers(m, wheelbase, (HOLD, 2.0 * HOLD))


def step(machine: Machine, driver: VehicleDriver, speed: float, width: float) -> Made:
    own = _open_loop(driver, f"step(time, {AT}, 0, {AT + 0.1}, {_turning(driver, speed)!r})", speed)
    return machine.replace(own).with_settings({"duration": AT + 4.0}), nivel.report.handling_page.step_numbers


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
    return made, lambda m: nivel.report.handling_page.lane_numbers(m, gates, width)


def _over(share: float) -> float:
    """From 0 to 1 without a jump of curvature."""
    u = min(max(share, 0.0), 1.0)
    return u**3 * (10.0 - 15.0 * u + 6.0 * u * u)


def brake_in_turn(machine: Machine, driver: VehicleDriver, speed: float, width: float) -> Made:
    own = _open_loop(driver, f"step(time, 0, 0, 2, {_turning(driver, speed)!r})", f"if(time < {BRAKES}, {speed!r}, 0)")
    made = machine.replace(own).with_settings({"duration": BRAKES + speed / 4.0})
    return made, lambda m: nivel.report.handling_page.braking_numbers(m, BRAKES)


def split_grip(machine: Machine, driver: VehicleDriver, speed: float, width: float) -> Made:
    tyres = [each.replace(grip=f"if(y > 0, {GRIP}, 1)") for each in machine.record.forces if each.type == "tyre"]
    straight = tuple((k * 20.0, 0.0) for k in range(12))
    own = driver.replace(course=straight, target=f"if(time < {AT}, {speed!r}, 0)")
    made = machine.replace(own, *tyres).with_settings({"duration": AT + speed / 3.0})
    return made, lambda m: nivel.report.handling_page.braking_numbers(m, AT)


def slope(machine: Machine, driver: VehicleDriver, speed: float, width: float) -> Made:
    angle, down = math.atan(SLOPE), math.hypot(*machine.record.gravity)
    at_rest = [
        each.replace(velocity=(0.0, 0.0, 0.0), angular_velocity=(0.0, 0.0, 0.0)) for each in machine.record.bodies
    ]
    own = _open_loop(driver, 0.0, f"if(time < {AT}, 0, 5)")
    made = machine.replace(own, *at_rest, gravity=(-down * math.sin(angle), 0.0, -down * math.cos(angle)))
    return made.with_settings({"duration": 6.0}), nivel.report.handling_page.slope_numbers


MANOEUVRES: Final[Mapping[str, Callable[..., Made]]] = {
    "circle": circle, "step": step, "lane-change": lane_change, "brake-in-turn": brake_in_turn, "split-grip": split_grip, "slope": slope,
}  # fmt: skip
