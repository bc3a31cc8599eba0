"""`nivel demo`: a machine that comes with nivel, in real time in the browser."""

import click

from nivel.demos import DEMOS, demo_file
from nivel.lazy import nivel


@click.command()
@click.argument("name", type=click.Choice(tuple(DEMOS)), default=next(iter(DEMOS)))
@click.option("--port", type=click.IntRange(0, 65535), default=0, help="Port to listen at; default: any free port.")
@click.option("--no-browser", is_flag=True, help="Do not open a browser.")
@click.pass_context
def command(ctx: click.Context, name: str, port: int, no_browser: bool) -> None:
    """Operate a machine that comes with nivel, in the browser; default: the loader crane.

    The command prints the path of the machine file. `nivel live` with this file does the same.
    """
    nivel.extras.require("the page needs", "websockets")
    file = demo_file(name)
    click.echo(f"{name}: {DEMOS[name]}\nmachine file: {file}", err=True)
    ctx.invoke(nivel.cli.live.command, machine=str(file), overrides={}, port=port, no_browser=no_browser)
