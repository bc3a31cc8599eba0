"""`nivel stress RESULT`: where and when a flexible body of a run is stressed most, and how at chosen nodes."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import click

from nivel.cli.options import FILE, fatigue_option, file_argument, force_option, json_option, listed, quiet_option
from nivel.cli.progress import console, progress_stage
from nivel.errors import Fault, gathered, refuse
from nivel.known import RecoveredBody
from nivel.lazy import nivel


@click.command()
@file_argument("result")
@click.option("--body", metavar="NAME", help="Flexible body; needed if there are several.")
@click.option("--body-file", type=FILE, help="Body file, if it was moved since the run.")
@click.option("--count", type=click.IntRange(min=1), default=5, show_default=True, help="Number of hot spots.")
@listed("--node", "nodes", "NODES", "History at these nodes: numbers, or names of interfaces, separated by commas.")
@listed("--at", "times", "TIMES", "State at the frames nearest to these times, e.g. '0.5 s, 1 s'.")
@click.option("--strain", "strains", is_flag=True, help="Also write strains, with --csv and --node.")
@click.option(
    "--csv",
    "table",
    type=FILE,
    help="Write a table: one row per frame with --node, the states with --at, otherwise the largest stress of every station.",
)
@click.option("--rainflow", "cycles", type=FILE, help="Write the cycles at the nodes of --node as a table.")
@fatigue_option
@click.option("--plot", "picture", type=FILE, help="Draw the history at the nodes of --node (.png, .svg, .pdf).")
@click.option(
    "--load-case",
    "loads",
    type=FILE,
    help="Write nodal forces that bend the body so, at --at or when it is stressed most: CalculiX, Abaqus (.inp) or Nastran (.bdf).",
)
@click.option("--vtk", type=FILE, help="Write the motion for ParaView (.pvd), or only the frames of --at.")
@force_option
@quiet_option
@json_option
def command(
    result: str,
    body: str | None,
    body_file: Path | None,
    count: int,
    nodes: tuple[str, ...] | None,
    times: tuple[str, ...] | None,
    strains: bool,
    table: Path | None,
    cycles: Path | None,
    fatigue: dict[str, str],
    picture: Path | None,
    loads: Path | None,
    vtk: Path | None,
    force: bool,
    quiet: bool,
    as_json: bool,
) -> None:
    """Recover the stress of a flexible body from RESULT: hot spots with the time of the largest stress, histories, cycles.

    The run of RESULT may still be going on, or may have been killed. The body file must be the one of the run.
    """
    needing = {"--rainflow": cycles, "--fatigue": fatigue, "--plot": picture, "--strain": strains}
    if not nodes and (missing := [option for option, value in needing.items() if value]):
        raise click.UsageError(f"{missing[0]} needs --node: the nodes whose history it is of")
    if strains and table is None:
        raise click.UsageError("--strain needs --csv: the table in which the strains stand")
    if picture is not None:
        nivel.extras.require("plots need", "matplotlib")
    opened = nivel.results.Result.open(result)
    moments = _times(times or ())
    with progress_stage(quiet) as stage:
        stage("reading", 0.0)
        found = opened.recover(body, file=body_file)
        wanted = _known_nodes(found, nodes or ())
        for moment in moments:
            found.frame(moment)
        _refuse_to_replace((table, cycles, picture, loads, vtk), force, [Path(result), found.file])
        stage("looking for hot spots", 0.1)
        told = nivel.results.stress.stress_facts(found, count=count, nodes=wanted, times=moments, fatigue=fatigue)
        stage("writing", 0.6)
        _write(found, wanted, moments, strains=strains, table=table, cycles=cycles, picture=picture)
        if loads is not None:
            found.write_load_cases(loads, moments or None)
        if vtk is not None:
            found.write_vtk(vtk, moments or None, told=lambda text, share: stage(text, 0.6 + 0.4 * share))
    if as_json:
        click.echo(json.dumps(told, indent=2))
    if not quiet:
        _say(told, as_json)
        for name, path in (("table", table), ("cycles", cycles), ("plot", picture), ("loads", loads), ("motion", vtk)):
            if path is not None:
                click.echo(f"{name}: {path}", err=True)


def _times(words: tuple[str, ...]) -> list[float]:
    """[s] of `0.5`, `500 ms`."""
    out, faults = [], []
    for word in words:
        try:
            out.append(nivel.machine.units.quantity.read_quantity(word, "time", {}))
        except ValueError as error:
            faults.append(Fault.at("--at", str(error)))
    refuse(faults)
    return out


def _known_nodes(found: RecoveredBody, words: tuple[str, ...]) -> list[int]:
    """Numbers of nodes that have stress, each once. Raises ModelError naming all that are unknown."""
    out, faults = {}, []
    for word in words:
        with gathered(faults):
            number = found.node(word)
            found.labels(number)
            out[number] = None
    refuse(faults)
    return list(out)


def _refuse_to_replace(targets: tuple[Path | None, ...], force: bool, sources: list[Path]) -> None:
    for path, what in zip(targets, ("table", "table of cycles", "plot", "load case", "VTK file"), strict=True):
        if path is not None:
            nivel.files.target.check_text_target(path, what, force=force, sources=sources)


def _write(
    found: RecoveredBody,
    nodes: list[int],
    times: list[float],
    *,
    strains: bool,
    table: Path | None,
    cycles: Path | None,
    picture: Path | None,
) -> None:
    if table is not None:
        if nodes:
            nivel.results.stress.write_history(table, found, nodes, strains=strains)
        elif times:
            nivel.results.stress.write_states(table, found, times)
        else:
            nivel.results.stress.write_envelope(table, found)
    if cycles is not None:
        nivel.results.stress.write_cycles(cycles, found, nodes)
    if picture is not None:
        nivel.results.plots.save_plot(picture, found, nodes)


def _say(facts: dict[str, Any], to_standard_error: bool) -> None:
    """The facts for people: on standard output, unless JSON is there."""
    out = console(stderr=to_standard_error)
    for line in _lines(facts):
        out.print(line, markup=False, soft_wrap=True)


def _lines(facts: dict[str, Any]) -> Iterator[str]:
    yield f"{facts['body']}: largest stress at {facts['worst_time']:.6g} s"
    for spot in facts["hot_spots"]:
        place = ", ".join(f"{x:.4g}" for x in spot["position"])
        yield (
            f"  {spot['von_mises'] / 1e6:.5g} MPa von Mises, {spot['signed_principal'] / 1e6:+.5g} MPa signed principal at "
            f"{spot['time']:.6g} s, node {spot['node']} {spot['station']} ({place}) m"
        )
    for state in facts["states"]:
        where = f"node {state['node']} {state['station']}".strip()
        most = f"{state['von_mises'] / 1e6:.5g} MPa at {where}, displacement up to {1e3 * state['displacement']:.5g} mm"
        yield f"at {state['time']:.6g} s: {most}"
    for node in facts["nodes"]:
        yield (
            f"node {node['node']}: von Mises up to {node['von_mises'] / 1e6:.5g} MPa at {node['time']:.6g} s; signed principal "
            f"{node['least'] / 1e6:+.5g} to {node['greatest'] / 1e6:+.5g} MPa {node['station']}".rstrip()
        )
        for low, high, number in node["cycles"]:
            yield f"  {number:g} cycles of {low / 1e6:.4g} to {high / 1e6:.4g} MPa"
        if "damage" in node:
            yield f"  damage {node['damage']:.6g} (failure at 1)"
    yield f"trust: {nivel.results.trust.told(facts['trust']['verdict'], facts['trust']['headline'])}"
