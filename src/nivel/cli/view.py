"""`nivel view RESULT`: play results in a browser; `nivel view MACHINE`: move a machine by hand; or write pages, pictures and films."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from nivel.cli.options import allow_code_option, file_argument, force_option, override_option, quiet_option
from nivel.cli.progress import progress_count
from nivel.errors import Fault, ModelError, gathered, refuse
from nivel.lazy import nivel

if TYPE_CHECKING:
    from nivel.view.capture import Look
    from nivel.view.sources import Source

MACHINES = (".yaml", ".yml")


@click.command()
@file_argument("file")
@click.argument("ghosts", nargs=-1, type=click.Path(dir_okay=True))
@click.option(
    "--export",
    "exports",
    multiple=True,
    type=click.Path(dir_okay=False),
    help="Write a page FILE.html that needs no other file, or a film FILE.mp4 or FILE.gif. No browser is opened.",
)
@click.option(
    "--mode", "vibration", type=int, metavar="N", help="Play vibration N about the last state of a statics result."
)
@click.option("--still", type=click.Path(dir_okay=False), help="Write a picture FILE.png. No browser is opened.")
@click.option("--at", "moment", type=float, help="Time of the still [s]; default: the start.")
@click.option(
    "--size", default="1280x720", show_default=True, metavar="WxH", help="Size of stills and films in pixels."
)
@click.option(
    "--from",
    "side",
    default="first",
    show_default=True,
    help="Direction of view of stills and films: front, right, top, …",
)
@click.option(
    "--frames-per-second",
    "rate",
    default=25,
    show_default=True,
    type=click.IntRange(1, 60),
    help="Frames per second of films.",
)
@click.option(
    "--speed", default=1.0, show_default=True, type=float, help="Speed of films: seconds of motion per second."
)
@click.option(
    "--colours",
    default="",
    metavar="QUANTITY",
    help="Quantity shown by the colours of beams and flexible bodies in stills and films: axial force, …",
)
@click.option("--dark", is_flag=True, help="Dark background for stills and films.")
@click.option("--port", default=0, type=click.IntRange(0, 65535), help="Port to listen at; default: any free port.")
@click.option(
    "--host",
    default="127.0.0.1",
    show_default=True,
    help="Address to listen at. With another address than the default, clients need the token.",
)
@click.option("--no-browser", is_flag=True, help="Do not open a browser, only print the address.")
@force_option
@override_option
@allow_code_option
@quiet_option
def command(
    file: str,
    ghosts: tuple[str, ...],
    exports: tuple[str, ...],
    vibration: int | None,
    still: str | None,
    moment: float | None,
    size: str,
    side: str,
    rate: int,
    speed: float,
    colours: str,
    dark: bool,
    port: int,
    host: str,
    no_browser: bool,
    force: bool,
    overrides: dict[str, str],
    allow_code: bool,
    quiet: bool,
) -> None:
    """Show FILE in the browser: a result (.nc), or a machine file (.yaml) whose joints can be moved by hand.

    Further results are drawn transparently over the first one. The page is served only on this computer, unless --host is given, and
    needs no network. With --export or --still files are written and no browser is opened.
    """
    if not host.strip():
        raise click.BadParameter("an address was expected, got none", param_hint="--host")
    look = nivel.view.capture.Look.of(size=size, side=side, rate=rate, speed=speed, dark=dark, colours=colours)
    written = [*exports, *([still] if still else [])]
    _refuse_targets(written, [file, *ghosts], force)
    for target in written:
        if Path(target).suffix.lower() != ".html":
            nivel.view.capture.require_parts(Path(target))
    if not written:
        nivel.extras.require("the page needs", "websockets")
    if Path(file).suffix.lower() in MACHINES:
        if vibration is not None:
            raise ModelError("--mode is for results of `nivel statics --modes`; a machine file has none yet")
        source = _machine(file, ghosts, overrides, allow_code, quiet)
    else:
        source = _results(file, ghosts, overrides, vibration, alone=bool(written))
    for target in exports:
        _export(source, Path(target), look, quiet)
    if still:
        nivel.view.capture.still(source, Path(still), look, moment)
        _say(f"picture: {still}", quiet)
    if not written:
        nivel.view.server.serve(
            source, host=host, port=port, browser=not no_browser, say=lambda text: _say(text, quiet=False)
        )


def _refuse_targets(targets: list[str], sources: list[str], force: bool) -> None:
    """Refuse, before anything is computed, files that may not be written, and kinds that are not known."""
    faults = []
    for target in targets:
        kind = Path(target).suffix.lower()
        if kind not in (".html", ".png", *nivel.view.capture.FILMS):
            films = " or ".join(nivel.view.capture.FILMS)
            faults.append(Fault.at("", f"{target}: a name ending in .html, .png, {films} was expected"))
            continue
        with gathered(faults):
            nivel.files.target.check_target(Path(target), "file", force=force, sources=list(map(Path, sources)))
    refuse(faults)


def _machine(file: str, ghosts: tuple[str, ...], overrides: dict[str, str], allow_code: bool, quiet: bool) -> Source:
    if ghosts:
        raise ModelError(f"{ghosts[0]} cannot be laid over a machine: only results are laid over each other")
    machine = nivel.api.load(file, overrides, allow_code=allow_code)
    with nivel.cli.progress.progress_listener(quiet) as listener:
        return machine.viewer_source(listener=listener)


def _results(
    file: str, ghosts: tuple[str, ...], overrides: dict[str, str], vibration: int | None, *, alone: bool
) -> Source:
    if overrides:
        raise ModelError("--set is for machine files; a result is what it is")
    faults: list[Fault] = []
    results = []
    for path in (file, *ghosts):
        with gathered(faults):
            results.append(nivel.results.Result.open(path))
    refuse(faults)
    if vibration is not None:
        results = [each.mode(vibration) for each in results]
    return nivel.view.sources.Playback(results, nivel.view.playback.ALONE if alone else nivel.view.playback.SERVED)


def _export(source: Source, target: Path, look: Look, quiet: bool) -> None:
    if target.suffix.lower() == ".html":
        nivel.view.page.write_page(source, target)
    elif target.suffix.lower() == ".png":
        nivel.view.capture.still(source, target, look)
    else:
        with progress_count("drawing the film", quiet) as tell:
            nivel.view.capture.film(source, target, look, lambda done, count: tell(done, count, ""))
    _say(f"written: {target}", quiet)


def _say(text: str, quiet: bool) -> None:
    if not quiet:
        click.echo(text, err=True)
