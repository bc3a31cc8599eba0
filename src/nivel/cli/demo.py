"""`nivel demo`: a machine that comes with nivel, in real time in the browser."""

from __future__ import annotations

import click

from nivel.demos.catalogue import DEMOS, demo_file


@click.command(short_help="Drive a machine that comes with nivel.")
@click.argument("name", type=click.Choice(tuple(DEMOS)), default=next(iter(DEMOS)))
@click.option("--port", type=click.IntRange(0, 65535), default=0, help="Port to listen at; default: a free one.")
@click.option("--no-browser", is_flag=True, help="Open no browser.")
@click.pass_context
def command(ctx: click.Context, name: str, port: int, no_browser: bool) -> None:
    """Drive the machine NAME in the browser; without a name the loader crane.

    It is the same as `nivel live` with the machine file whose place is printed.
    """
    from nivel.cli.live import command as live

    file = demo_file(name)
    click.echo(f"{name}: {DEMOS[name]}\nmachine file: {file}", err=True)
    ctx.invoke(live, machine=str(file), overrides={}, port=port, no_browser=no_browser)
