"""Models of other programs: `nivel reduce MODEL`, a finite-element model becomes a flexible body, and a report says what it is worth;
`nivel import MODEL --out machine.yaml`, a model as a machine file."""

import json
from pathlib import Path
from typing import Literal

import click

from nivel.cli import options
from nivel.cli.options import file_argument, force_option, quiet_option, repeated
from nivel.cli.progress import progress_stage
from nivel.errors import ModelError
from nivel.known import Findings, Reduction
from nivel.lazy import nivel, rich


@click.command()
@file_argument("model")
@click.option(
    "--out", "target", metavar="FILE", help="Machine file to write; default: NAME.yaml in the working directory."
)
@click.option(
    "--base",
    type=click.Choice(["fixed", "free"]),
    help="Whether the first link is fixed to the ground; default: fixed for URDF, else as the model says.",
)
@repeated(
    "--package-path",
    "package_paths",
    "FOLDER",
    "Folder of packages, in which meshes at package:// are searched for.",
    type=click.Path(path_type=Path),
)
@repeated(
    "--include-path",
    "include_paths",
    "FOLDER",
    "Folder beside that of an MJCF model from which included files and meshes are read.",
    type=click.Path(path_type=Path),
)
@click.option(
    "--contacts",
    type=click.Choice(["all", "floor", "none"]),
    default="all",
    show_default=True,
    help="Contacts: all of the model, those with what stands still, or none.",
)
@click.option("--keyframe", metavar="NAME", help="Keyframe of an MJCF file at which the machine starts.")
@click.option(
    "--density",
    type=float,
    metavar="KG/M3",
    help="Density of the solids of a STEP or FreeCAD file; default 7850 kg/m³.",
)
@quiet_option
@force_option
def import_model(
    model: str,
    target: str | None,
    base: Literal["fixed", "free"] | None,
    package_paths: tuple[Path, ...],
    include_paths: tuple[Path, ...],
    contacts: Literal["all", "floor", "none"],
    keyframe: str | None,
    density: float | None,
    quiet: bool,
    force: bool,
) -> None:
    """Translate MODEL, a URDF, SDF, MJCF, STEP or FreeCAD file, into a machine file.

    The list of what was translated, in another form or not at all, is printed and stands in the comments of the file.
    """
    path = Path(target) if target is not None else Path(f"{Path(model).stem}.yaml")
    nivel.files.target.check_target(path, "machine file", force=force, sources=[Path(model)])
    translation = nivel.exchange.read_model(
        model,
        base=base,
        package_paths=package_paths,
        target=path,
        contacts=contacts,
        density=density,
        keyframe=keyframe,
        include_paths=include_paths,
    )
    for name, content in translation.files().items():
        mesh = path.parent / name
        mesh.parent.mkdir(exist_ok=True)
        nivel.files.target.check_target(mesh, "mesh", force=force, sources=[Path(model)])
        nivel.files.target.write_file(mesh, "mesh", content)
    text = translation.text()
    nivel.exchange.as_machine(text, str(path), translation, model)
    nivel.files.target.write_file(path, "machine file", text)
    if not quiet:
        click.echo("\n".join(translation.summary()))
    click.echo(f"machine file: {path}; `nivel check {path}` describes it", err=True)


SHOWN = 15  # modes in the table of the terminal


@click.command()
@options.file_argument("model")
@options.override_option
@options.out_option("Body file", "NAME.nc", None)
@options.report_option("body file")
@options.no_report_option
@click.option("--vtk", type=options.FILE, help="Also write the modes for ParaView: a .pvd file and its .vtu files.")
@options.force_option
@options.quiet_option
@options.json_option
def reduce(
    model: str,
    overrides: dict[str, str],
    out: Path | None,
    report: Path | None,
    no_report: bool,
    vtk: Path | None,
    force: bool,
    quiet: bool,
    as_json: bool,
) -> None:
    """Reduce a finite-element model to a flexible body: Craig–Bampton modes, inertia invariants, modal stresses.

    The model file MODEL describes the finite-element model, its interfaces and the reduction.

    Exit codes: 0 done, 2 fault in the input, 3 the computation failed, 130 interrupted.
    """
    if no_report and report is not None:
        raise ModelError(f"--no-report and --report {report} contradict each other: take one of them away")
    located = nivel.flexible.model.model_file.read_model(model, overrides=overrides)
    target = out or Path(f"{located.record.name}.nc")
    page = None if no_report else report or target.with_suffix(".html")
    _refuse_to_replace(target, page, vtk, force, Path(model))
    with progress_stage(quiet) as stage:
        reduction = nivel.flexible.reduce.reduce_model(located, stage=stage)
        nivel.flexible.body.body_file.write_body(
            reduction.body, target, findings=reduction.findings.as_data(), model=nivel.files.sources.read_text(model)
        )
        if page is not None:
            stage("writing the report", 1.0)
            text = nivel.report.reduction_page.reduction_html(reduction.body, reduction.findings)
            nivel.files.target.write_page(text, page, force=force)
        if vtk is not None:
            nivel.flexible.body.vtk.write_modes(reduction.body, vtk)
    if as_json:
        click.echo(json.dumps(reduction.findings.as_data(), indent=2))
    if not quiet:
        _say(reduction, target, page)


def _refuse_to_replace(target: Path, page: Path | None, vtk: Path | None, force: bool, model: Path) -> None:
    if page == target:
        raise ModelError(
            f"{target}: the body is a NetCDF file and the report would be written over it; use a name ending in .nc"
        )
    for path, what in ((target, "body file"), (page, "report"), (vtk, "VTK file")):
        if path is not None:
            nivel.files.target.check_target(path, what, force=force, sources=[model])


def _say(reduction: Reduction, target: Path, page: Path | None) -> None:
    console = rich.console.Console(stderr=True, highlight=False)
    body, findings = reduction.body, reduction.findings
    size = f"{findings.freedoms} degrees of freedom, {findings.nodes} nodes"
    console.print(f"[bold]{body.name}[/bold]: {size} → {len(body.eigenvalues)} modes", markup=True)
    centre = ", ".join(f"{x:.5g}" for x in findings.centre_of_mass)
    moments = ", ".join(f"{x:.5g}" for x in findings.principal_inertia)
    console.print(
        f"mass {findings.mass:.6g} kg, centre of mass ({centre}) m, principal inertia ({moments}) kg m²", soft_wrap=True
    )
    console.print(_table(findings))
    for line in (*findings.notes, *findings.statements):
        console.print(f"  ● {line}", markup=False, soft_wrap=True)
    console.print(f"body: {target}" + (f"\nreport: {page}" if page is not None else ""), soft_wrap=True)


def _table(findings: Findings):
    table = rich.table.Table(box=None, pad_edge=False)
    for heading in ("free mode", "whole model [Hz]", "reduced [Hz]", "error", "MAC"):
        table.add_column(heading, justify="right")
    for k, (full, reduced, error) in enumerate(zip(findings.full, findings.reduced, findings.errors, strict=False)):
        if k >= SHOWN:
            break
        partner = findings.partners[k]
        like = f"{findings.mac[k][partner]:.3f}" + (f" (mode {partner + 1})" if partner != k else "")
        table.add_row(str(k + 1), f"{full:.5g}", f"{reduced:.5g}", f"{100 * error:+.3g} %", like)
    return table
