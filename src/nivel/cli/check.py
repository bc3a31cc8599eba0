"""`nivel check MACHINE`: what the machine is, or everything that is wrong with it."""

from __future__ import annotations

import dataclasses
import json
from typing import TYPE_CHECKING, Any

import click

from nivel.cli.options import file_argument, override_option

if TYPE_CHECKING:
    from nivel.analysis.check import Check


@click.command(short_help="Check and assemble a machine; say what it is.")
@file_argument("machine")
@override_option
@click.option("--json", "as_json", is_flag=True, help="Print the facts as JSON on standard output.")
def command(machine: str, overrides: dict[str, str], as_json: bool) -> None:
    """Check MACHINE: read it, assemble it, count its freedoms.

    Shows every joint with its first and second body, its zero and its positive direction. Exit code 2 with every fault that was found.
    """
    from nivel.api import load

    facts = load(machine, overrides).check()
    if as_json:
        click.echo(json.dumps(dataclasses.asdict(facts), indent=2))
    else:
        _show(facts)


def _show(facts: Check) -> None:
    from rich.console import Console

    console = Console(highlight=False)
    count = facts.degrees_of_freedom
    freedoms = f"{count} degree{'' if count == 1 else 's'} of freedom"
    console.print(f"[bold]{facts.name}[/bold]: {freedoms}, gravity {_vector(facts.gravity)} m/s²")
    console.print("[dim]bodies[/dim]")
    for body in facts.bodies:
        console.print(
            f"  [bold]{body.name}[/bold]  {body.mass:.6g} kg, principal inertia {_vector(body.principal_inertia)} kg m², "
            f"frame at {_vector(body.position)} m",
            soft_wrap=True,
        )
    if facts.joints:
        console.print("[dim]joints (first body → second body)[/dim]")
    for joint in facts.joints:
        axis = "" if joint.type == "spherical" else f", z axis {_vector(joint.axis)}"
        console.print(
            f"  [bold]{joint.name}[/bold]  {joint.type}, {joint.first} → {joint.second}, free motions {joint.free}, "
            f"at {_vector(joint.point)} m{axis}",
            soft_wrap=True,
        )
        for name, value, units in joint.coordinates:
            console.print(f"    {name} = {value:.6g} {units}")
    for kind, convention in {joint.type: joint.convention for joint in facts.joints if joint.coordinates}.items():
        console.print(f"  [dim]{kind}:[/dim] {convention}", soft_wrap=True)
    if facts.forces:
        console.print("[dim]forces[/dim]")
    for name, kind, body in facts.forces:
        console.print(f"  [bold]{name}[/bold]  {kind} on {body}")
    _say_assembly(console, facts)
    _say_redundancy(console, facts)


def _say_assembly(console: Any, facts: Check) -> None:
    if facts.moved:
        console.print(f"assembly: as given, {facts.gap_row} is open by {facts.gap:.3g}; closed by moving")
        for name, distance, angle in facts.moved:
            console.print(f"  {name} by {distance:.3g} m and {angle:.3g} rad")
    else:
        console.print("assembly: closed as given")
    for name, speed, rate in facts.velocity_change:
        console.print(f"  velocity of {name} changed by {speed:.3g} m/s and {rate:.3g} rad/s to fit the joints")


def _say_redundancy(console: Any, facts: Check) -> None:
    if not facts.redundant_rows:
        console.print(f"constraints: {facts.constraint_rows} rows, none redundant, every reaction is unique")
        return
    console.print(
        f"constraints: {facts.constraint_rows} rows, [yellow]redundant: {', '.join(facts.redundant_rows)}[/yellow]"
    )
    console.print(f"  the motion is unique; reactions are not in: {', '.join(facts.non_unique_joints)}")


def _vector(values: tuple[float, ...]) -> str:
    # + 0.0 turns -0 into 0
    return "(" + ", ".join(f"{round(value, 12) + 0.0:.6g}" for value in values) + ")"
