"""`nivel new NAME`: a commented machine file that runs."""

import json
import os
from pathlib import Path
from typing import Final

import click

from nivel.cli.options import force_option
from nivel.errors import ModelError
from nivel.lazy import nivel

TEMPLATE: Final = Path(__file__).with_name("new_machine.yaml")
SUFFIX: Final = ".yaml"
SCHEMA_NAME: Final = "nivel.schema.json"
STUDY_SCHEMA_NAME: Final = "nivel-study.schema.json"


@click.command()
@click.argument("name", type=click.Path(path_type=Path))
@force_option
@click.option(
    "--schema",
    "with_schema",
    is_flag=True,
    help=f"Also write {SCHEMA_NAME}, with which editors complete and check machine files, and {STUDY_SCHEMA_NAME} for studies.",
)
def command(name: Path, force: bool, with_schema: bool) -> None:
    """Write NAME.yaml: a small machine file with comments. `nivel run NAME.yaml` simulates it."""
    target = _target(name)
    text = new_machine(target.stem)
    if with_schema:
        text = f"# yaml-language-server: $schema={SCHEMA_NAME}\n{text}"
    _write(target, text, force)
    if with_schema:
        schemas = {SCHEMA_NAME: nivel.files.schema(), STUDY_SCHEMA_NAME: nivel.files.study_file.study_schema()}
        for schema, content in schemas.items():
            _write(target.with_name(schema), json.dumps(content, indent=1) + "\n", force=True)
    click.echo(f"{target} is written; run it with: nivel run {target}", err=True)


def _target(name: Path) -> Path:
    if not name.name or os.path.isdir(name):  # Path.is_dir raises where the name is too long
        raise ModelError(
            f"'{name}' is a folder; the name of a machine was expected, for instance {name / 'crane.yaml'}"
        )
    return name if name.suffix == SUFFIX else name.with_name(name.name + SUFFIX)


def new_machine(name: str) -> str:
    """The text of a new machine file whose machine is called `name`.

    Raises ModelError where `name` cannot be the name of a machine.
    """
    text = TEMPLATE.read_text(encoding="utf-8").replace("NAME", json.dumps(name, ensure_ascii=False), 1)
    nivel.files.parse_machine(text, f"{name}{SUFFIX}")
    return text


def _write(target: Path, text: str, force: bool) -> None:
    if target.exists() and not force:
        raise ModelError(f"{target} exists already; use --force to overwrite it, or another name")
    nivel.files.target.write_file(target, "file", text)
