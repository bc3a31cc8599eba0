"""`nivel kc MACHINE`: kinematics and compliance of a suspension on a test rig, their numbers, and a page of curves."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import click

from nivel.cli.handling import tell
from nivel.cli.options import file_argument, json_option, override_option, separated
from nivel.cli.progress import progress_listener
from nivel.errors import Fault, ModelError
from nivel.lazy import nivel, numpy

if TYPE_CHECKING:
    from nivel.api import Machine
    from nivel.report.kc_page import Curves, Wheel

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
def command(machine: str, overrides: dict[str, str], chassis: str | None, hold: tuple[str, ...] | None, travel: float, load: float,
            braking: tuple[float, float, float] | None, out: str | None, force: bool, quiet: bool, as_json: bool) -> None:  # fmt: skip
    """Move the wheels of MACHINE on a rig: bump, roll, longitudinal, lateral and aligning loads. Gives toe, camber, wheel rate, motion
    ratio, roll centre, anti-dive and compliance.

    The wheels are those of its tyres, whose place the rig takes; they do not spin. x points forwards, y to the left, z up.
    """
    loaded = nivel.api.load(machine, overrides)
    page, kc = Path(out or f"{loaded.name}-kc.html"), nivel.report.kc_page
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
        wheels.append(nivel.report.kc_page.Wheel(tyre.name, body, point, side * axle, side, tyre.radius))
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
    nodes = nivel.report.kc_page.WAY

    def way(share: float) -> Any:
        table = {"times": [*range(len(nodes))], "values": (size * share * nodes).tolist(), "interpolation": "cubic"}
        return table if share else 0.0

    for wheel in wheels:
        name, height = f"kc_{wheel.name}", heights[0] if wheel.side > 0.0 else heights[1]
        force = [way(ahead), way(aside), 0.0]
        moment = [way(aside * wheel.radius), way(-ahead * wheel.radius), way(turning)]
        added += [
            nivel.machine.core.marker.Marker(name=name, body=wheel.body, position=tuple(wheel.point)),
            nivel.elements.joints.drivers.Driver(name=name, marker=name, along="z", value=way(height), from_start=True),
            nivel.elements.forces.loads.PointForce(name=f"{name}_force", marker=name, vector=force),
            nivel.elements.forces.loads.Torque(name=f"{name}_moment", body=wheel.body, vector=moment),
        ]
    run = rig.with_elements(*added).statics(duration=len(nodes) - 1.0, step=1.0, listener=listener)
    return nivel.report.kc_page.Curves.of(run, wheels, size)
