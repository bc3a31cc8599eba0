"""`nivel check MACHINE`: what the machine is, or everything that is wrong with it."""

import dataclasses
import json

import click

from nivel.cli.options import allow_code_option, file_argument, json_option, listed, override_option
from nivel.errors import SolveError
from nivel.lazy import nivel


@click.command()
@file_argument("machine")
@override_option
@allow_code_option
@click.option("--circuit", type=click.Path(dir_okay=False), help="Draw the hydraulic circuit to this SVG file.")
@click.option("--valves", type=click.Path(dir_okay=False), help="Draw the curves of all valves to this SVG file.")
@click.option(
    "--mass",
    metavar="MARKER",
    help="Also print mass, centre of mass and inertia about a marker, a body's frame or ground.",
)
@listed("--of", "of", "BODIES", "Bodies that --mass includes; default: all.")
@json_option
def command(
    machine: str,
    overrides: dict[str, str],
    allow_code: bool,
    circuit: str | None,
    valves: str | None,
    mass: str | None,
    of: tuple[str, ...] | None,
    as_json: bool,
) -> None:
    """Check MACHINE: read it, assemble it and count its degrees of freedom.

    Lists every joint with its first and second body, its zero and its positive direction. If the file has faults, all of them are listed
    and the exit code is 2.
    """
    loaded = nivel.api.load(machine, overrides, allow_code=allow_code)
    facts = loaded.check(listener=nivel.analysis.progress.log.Listener(lambda text, _total: click.echo(text, err=True)))
    if circuit is not None:
        drawn = nivel.looks.circuit.drawing.circuit_diagram(loaded.record.model_dump(mode="json"), facts.pressures)
        if not drawn:
            raise click.UsageError("the machine has no `hydraulics` that could be drawn with --circuit")
        nivel.files.target.write_file(circuit, "drawing", drawn)
    if valves is not None:
        curves = nivel.looks.circuit.characteristics.valve_diagram(loaded.record.model_dump(mode="json"))
        if not curves:
            raise click.UsageError("the machine has no valves whose curves could be drawn with --valves")
        nivel.files.target.write_file(valves, "drawing", curves)
    if of and mass is None:
        raise click.UsageError("--of belongs to --mass, e.g. --mass ground")
    weighed = None if mass is None else loaded.mass_properties(mass, of or ())
    if as_json:
        out = dataclasses.asdict(facts) | {"settings": facts.settings.as_dict()}
        out |= {} if weighed is None else {"mass_properties": weighed.summary()}
        click.echo(json.dumps(out, indent=2))
    else:
        click.echo(str(facts))
        if weighed is not None:
            click.echo(str(weighed))
    message, advice = facts.unsettled
    if message:
        raise SolveError(message, time=0.0, advice=advice)
