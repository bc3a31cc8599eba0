"""Commands of analyses: a machine, settings, files, progress, messages and exit codes. A command is then what is its own."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import click

from nivel.cli.failures import say_faults
from nivel.cli.options import (
    allow_code_option,
    file_argument,
    force_option,
    json_option,
    no_report_option,
    out_option,
    override_option,
    quiet_option,
    resume_option,
    set_option,
    setting_options,
)
from nivel.cli.progress import progress_listener
from nivel.errors import ModelError, SolveError
from nivel.known import Listener, Machine, Study
from nivel.lazy import Struct, nivel


class Order(Struct):
    """What a command was asked for. machine : its file. settings : those that were given. out : a result file, if one was named."""

    machine: str
    overrides: dict[str, str]
    allow_code: bool
    settings: dict[str, Any]
    out: str | None
    force: bool
    no_report: bool
    quiet: bool
    as_json: bool

    def load(self, overrides: dict[str, str] | None = None) -> Machine:
        """The machine, with more overrides. Raises ModelError."""
        return nivel.api.load(self.machine, {**self.overrides, **(overrides or {})}, allow_code=self.allow_code)

    def files(self, name: str) -> tuple[Path, Path | None]:
        """The result file, `name` unless another was named, and the report. Raises ModelError where they exist and may not be replaced."""
        target = Path(self.out) if self.out is not None else Path(name)
        report = None if self.no_report else beside(target)
        refuse_to_replace(report, target, self.force, Path(self.machine))
        return target, report

    def run(
        self,
        name: str,
        compute: Callable[..., Any],
        say: Callable[[Any, Path, Path | None], None],
        more: Callable[[Any], Any] = lambda result: result,
        reported: tuple[str, ...] = (),
    ) -> None:
        """Compute a result into its file, write the report, and say what it is. Of a failure everything computed is kept and told first.

        name : of the result file. compute : takes the settings, `out`, `force` and `listener`. more : what is reported and said in place
        of the result. reported : more that its report takes.
        """
        target, report = self.files(name)
        failure: SolveError | None = None
        unwritten: ModelError | None = None
        with progress_listener(self.quiet) as listener:
            try:
                result = compute(**self.settings, out=target, force=self.force, listener=listener)
            except SolveError as error:
                failure, result = error, error.result
            result = None if result is None else more(result)
            if report is not None and result is not None:
                listener.say("writing the report")
                try:
                    result.report(report, *reported)
                except ModelError as error:
                    if failure is None:
                        raise
                    unwritten = error  # the failure counts: it decides about the exit code
        self.tell(result, lambda: say(result, target, None if unwritten else report))
        if unwritten is not None:
            say_faults(unwritten)
        if failure is not None:
            raise failure
        if result is not None and result.outcome == "interrupted":
            raise KeyboardInterrupt

    def keep(
        self, name: str, compute: Callable[[Listener], Any], say: Callable[[Any], list[str]], *report: Any
    ) -> None:
        """Compute what has a summary, write it and its page, and say it. report : more that its report takes."""
        target, page = self.files(name)
        with progress_listener(self.quiet) as listener:
            found = compute(listener)
            found.save(target, force=self.force)
            if page is not None:
                found.report(page, *report)
        written = [f"data: {target}"] + ([f"report: {page}"] if page is not None else [])
        self.tell(found, lambda: click.echo("\n".join([*say(found), *written]), err=True))

    def tell(self, found: Any, say: Callable[[], Any]) -> None:
        """The summary as JSON, and what is said to people, as they were asked for; nothing of what was not found."""
        if self.as_json and found is not None:
            click.echo(json.dumps(found.summary(), indent=2))
        if not self.quiet and found is not None:
            say()


def analysis_command(keys: Any, name: str) -> Callable[[Callable[..., None]], click.Command]:
    """A command of an `Order`, with options for the settings of `keys`, then its own, then those that all analyses have.

    name : of the result file.
    """

    def made(function: Callable[..., None]) -> click.Command:
        def command(settings: dict[str, Any], **given: Any) -> None:
            asked = {each: given.pop(each) for each in Order.__dataclass_fields__ if each != "settings"}
            function(Order(settings=settings, **asked), **given)

        out = out_option("Result file", name, kind=click.Path())
        shared = (override_option, allow_code_option, out, force_option, no_report_option, quiet_option, json_option)
        for option in reversed(shared):
            option(command)
        command.__click_params__ += getattr(function, "__click_params__", [])  # type: ignore[attr-defined]
        command.__doc__ = function.__doc__
        return click.command()(file_argument("machine")(setting_options(keys)(command)))

    return made


class StudyOrder(Struct):
    """What a command of a study was asked for. count : of processes or threads; None: one for each processor."""

    study: str
    overrides: dict[str, str]
    allow_code: bool
    out: Path | None
    count: int | None
    resume: bool
    force: bool
    no_report: bool
    quiet: bool
    as_json: bool

    def targets(self, study: Study) -> tuple[Path, Path | None]:
        """Data file and report. Raises ModelError where both are one."""
        target = self.out or Path(f"{study.file.record.name}.nc")
        page = None if self.no_report else beside(target)
        if page == target:
            raise ModelError(f"{target}: the report would be written over the data file; use a name ending in .nc")
        return target, page


def study_command(count: str, meaning: str, *own: Any) -> Callable[[Callable[..., None]], click.Command]:
    """A command of a `StudyOrder`. count : its option for the number of processes or threads. own : more options."""

    def made(function: Callable[..., None]) -> click.Command:
        def command(**given: Any) -> None:
            given["count"] = given.pop(count.removeprefix("--"))
            asked = {name: given.pop(name) for name in StudyOrder.__dataclass_fields__}
            function(StudyOrder(**asked), **given)

        number = click.option(count, type=click.IntRange(1), metavar="NUMBER", help=meaning)
        set_study, out = set_option("study", "samples=256", " or verify=true"), out_option("Data file", "NAME.nc")
        shared = (resume_option, force_option, no_report_option, quiet_option, json_option)
        for option in reversed((file_argument("study"), set_study, allow_code_option, out, number, *own, *shared)):
            option(command)
        command.__doc__ = function.__doc__
        return click.command()(command)

    return made


def beside(target: Path) -> Path:
    """The report of the result file `target`."""
    if target.name in ("", ".."):
        raise ModelError(f"'{target}' is a folder; the name of a result file was expected, for instance result.nc")
    return target.with_suffix(".html")


def refuse_to_replace(report: Path | None, target: Path, force: bool, machine: Path) -> None:
    """Refuse files that exist, unless they may be replaced; the machine file is never written over."""
    if report is not None and report == target:
        raise ModelError(
            f"{target}: the result is a NetCDF file and the report would be written over it; use a name ending in .nc"
        )
    nivel.files.target.check_target(target, "result file", force=force, sources=[machine])
    if report is not None:
        nivel.files.target.check_target(report, "report", force=force, sources=[machine])
