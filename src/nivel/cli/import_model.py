"""`nivel import MODEL --out machine.yaml`: the model of another program as a machine file."""

from pathlib import Path
from typing import Literal

import click

from nivel.cli.options import file_argument, force_option, quiet_option, repeated
from nivel.lazy import nivel


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
    "--density", type=float, metavar="KG/M3", help="Density of the solids of a STEP file; default 7850 kg/m³."
)
@quiet_option
@force_option
def command(
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
    """Translate MODEL, a URDF, SDF, MJCF or STEP file, into a machine file.

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
