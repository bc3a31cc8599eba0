"""A study in Python: a study file with its machine, its variants, and what they were found to be."""

import json
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from os import PathLike, fspath
from pathlib import Path
from typing import Any, TypeVar

from nivel.analysis.progress.log import Listener
from nivel.api import Machine, code_of, load
from nivel.errors import Fault, ModelError, SolveError, gathered, refuse, retold
from nivel.files.sources import beside, read_bytes, read_text
from nivel.files.study_file import StudyFile, study_and_faults
from nivel.files.target import write_page
from nivel.known import Identified, Journal, Optimum, Resolved, Variants
from nivel.lazy import Struct, nivel, replace, xarray
from nivel.machine.study.parameter import Between
from nivel.results.frames.tabulated import write_netcdf
from nivel.words.arguments import checked_arguments, checked_methods

Found = TypeVar("Found", "Optimum", "Identified")
TIMES = ("seconds", "loop_seconds", "processes")  # attributes that are of the computation, and not of the study


@checked_methods
class Study(Struct, repr=False):
    """A study file with its machine: `variants`, and what `sweep` computes of them. Made by `nivel.load_study`."""

    resolved: Resolved

    @property
    def file(self) -> StudyFile:
        """The study as it was read."""
        return self.resolved.study

    @property
    def machine(self) -> Machine:
        """The machine of the study, with the values and settings that all variants have."""
        machine = self.resolved.machine
        assert isinstance(machine, Machine)
        return machine

    @property
    def variants(self) -> Variants:
        """The values of every variant. Raises ModelError where nothing varies, or too much."""
        record = self.file.record
        place = ("parameters",) if record.parameters else ()
        with retold(lambda fault: self.file.fault(place, fault.message)):
            return nivel.analysis.sweep.variants.draw(
                self.resolved.parameters, record.design, record.samples, record.seed
            )

    def sweep(
        self,
        *,
        out: str | PathLike[str] | None = None,
        workers: int | None = None,
        scheduler: str = "",
        resume: bool = False,
        force: bool = False,
        listener: Listener | None = None,
        heard: Callable[[int, Any], None] | None = None,
    ) -> xarray.Dataset:
        """Compute all variants in processes of their own, into one dataset: parameters, outputs and saved histories of each.

        out : data file (NetCDF), and a journal beside it, FILE.journal, until all variants are finished. workers : number of processes; as
        many as there are processors by default. scheduler : address of a Dask cluster that computes instead. resume : go on with the
        journal of an interrupted study; the dataset is then what it would be without the interruption, to the last bit. force : replace
        files. heard : is called with number and run of each variant that is finished.

        Variants that fail, take longer than the time limit, or end their process are rows with a `reason`. Interrupted by Ctrl-C, it
        returns what was computed, and the journal stays. Raises ModelError where outputs do not fit the results, or no variant could start.
        """
        record, variants = self.file.record, self.variants
        task = nivel.analysis.sweep.outputs.Task(
            self.machine,
            record.analysis,
            self.resolved.settings,
            record.outputs,
            record.save,
            record.verify,
            record.time_limit,
            record.judge,
            nivel.analysis.sweep.patched.sample_of(variants.values)
            if record.analysis == "run" and not record.verify
            else (),
        )
        listener = listener or Listener()
        target = None if out is None else Path(fspath(out))
        of = nivel.analysis.sweep.variant.study_fingerprint(task, variants)
        count = f"of {len(variants.values)} variants"
        with self._journal(target, of, count, resume=resume, force=force) as journal:
            code_of(self.machine, record.analysis, listener)
            engine = nivel.analysis.sweep.sweep.Engine(
                workers or nivel.native.workers.processors(), scheduler, apart=True
            )
            found = nivel.analysis.sweep.sweep.sweep(
                [task], variants, engine, listener=listener, heard=heard, journal=journal
            )
            found = found.assign_attrs({"study": record.name, "description": record.description, **self._about()})
            if journal is not None and "not run" not in found["outcome"].values:
                kept = {name: value for name, value in found.attrs.items() if name not in TIMES}
                write_netcdf(found.drop_attrs(deep=False).assign_attrs(kept), journal.target)
                journal.complete = True
        return found

    def report(self, found: Any, path: str | PathLike[str]) -> Path:
        """Write the report of what `sweep` found, a dataset or its file, as one HTML file that needs no network; an existing file is
        replaced."""
        return write_study_report(found, path)

    def optimise(
        self,
        *,
        out: str | PathLike[str] | None = None,
        threads: int | None = None,
        resume: bool = False,
        force: bool = False,
        listener: Listener | None = None,
    ) -> Optimum:
        """The search that the study calls `optimise`: the parameters with the least output, within the limits of the others.

        out : data file (NetCDF) of all variants, with the trust report of a run of the best machine, and a journal beside it, FILE.journal,
        until the search is finished. resume : go on with the journal of an interrupted search, whose variants are not computed again.
        force : replace files. Raises ModelError where the study has no such search, outputs do not fit the results, or no start has a
        result; the data file has all variants then too.
        """
        search, outputs = self.file.record.optimise, self.file.record.outputs
        if search is None:
            said = "the study says nothing of what is to be least: write `optimise: {output: NAME}`"
            raise ModelError(self.file.fault((), said))
        machine, analysis = self.machine, self.file.record.analysis
        if analysis == "run" and nivel.analysis.sweep.outputs.only_numbers(outputs):
            machine = nivel.analysis.plan.settings.with_usual_frames(machine)

        def find(journal: Journal | None) -> tuple[Optimum, bool]:
            units = {} if journal is None else journal.facts
            found = machine.optimise(
                self._output(search.output, units),
                self._bounds,
                maximise=search.maximise,
                outputs={name: self._output(name, units) for name in outputs},
                limits={name: each.limits for name, each in outputs.items() if each.limits != (None, None)},
                method=search.method,
                **self._shared(search),
                threads=threads,
                journal=journal,
                listener=listener,
            )
            dataset = self._of_search(found.dataset, list(outputs), units)
            return replace(found, dataset=dataset, machine=self.machine.with_values(found.values)), found.kept

        return self._searched(find, search, out, resume=resume, force=force)

    def identify(
        self,
        *,
        out: str | PathLike[str] | None = None,
        threads: int | None = None,
        resume: bool = False,
        force: bool = False,
        listener: Listener | None = None,
    ) -> Identified:
        """The search that the study calls `identify`: the parameters that explain its measurements. out, resume, force : as of `optimise`.

        Raises ModelError where the study has no such search, or its table does not fit.
        """
        search = self.file.record.identify
        if search is None:
            said = "the study says nothing of measurements: write `identify: {data: FILE.csv}`"
            raise ModelError(self.file.fault((), said))

        def find(journal: Journal | None) -> tuple[Identified, bool]:
            found = self.machine.identify(
                beside(self.file.file, search.data),
                self._bounds,
                deviations=search.deviations,
                **self._shared(search),
                threads=threads,
                journal=journal,
                listener=listener,
            )
            dataset = self._of_search(found.dataset, ["sum_of_squares"], {})
            return replace(found, dataset=dataset), not found.undetermined

        return self._searched(find, search, out, resume=resume, force=force)

    def _searched(
        self,
        find: Callable[[Journal | None], tuple[Found, bool]],
        search: Any,
        out: str | PathLike[str] | None,
        *,
        resume: bool,
        force: bool,
    ) -> Found:
        """What `find` finds, and whether nothing is left open, in a data file with the trust report of the machine that was found."""
        target = None if out is None else Path(fspath(out))
        outputs = {name: each.model_dump(mode="json") for name, each in self.file.record.outputs.items()}
        table = read_bytes(beside(self.file.file, search.data)) if hasattr(search, "data") else b""
        of = nivel.analysis.progress.journal.fingerprint(
            self.machine,
            search.model_dump(mode="json"),
            table,
            outputs,
            self._bounds,
            self.file.record.time_limit,
            self.file.record.analysis,
            json.dumps(self.resolved.settings, sort_keys=True, default=str),
        )
        with self._journal(target, of, "runs", resume=resume, force=force) as journal:
            try:
                found, whole = find(journal)
            except (nivel.analysis.optimise.evaluations.NothingFoundError, SolveError) as error:
                if journal is not None and error.result is not None:
                    write_netcdf(error.result, journal.target)  # type: ignore[arg-type]
                    journal.complete = True
                raise
            if journal is None:
                return found
            if self.file.record.analysis == "run":
                checked = found.machine.simulate()
                if checked.outcome == "interrupted":
                    raise KeyboardInterrupt
            else:
                checked = nivel.analysis.sweep.variant_runs.analysed(
                    found.machine, self.file.record.analysis, self.resolved.settings
                )
            kept = {"trust": checked.trust.to_json(), "verdict": checked.trust.light, "kept": int(whole)}
            found = replace(found, dataset=found.dataset.assign_attrs({**found.dataset.attrs, **kept}))
            write_netcdf(found.dataset, journal.target)
            journal.complete = True
        return found

    def _shared(self, search: Any) -> dict[str, Any]:
        """What all searches take of the study."""
        its = {name: getattr(search, name) for name in ("starts", "seed", "iterations")}
        record = self.file.record
        about = {"analysis": record.analysis, "analysis_settings": self.resolved.settings}
        return {**its, **about, "time_limit": record.time_limit}

    @property
    def _bounds(self) -> dict[str, tuple[float, float]]:
        return {path: each.bounds for path, each in self.resolved.parameters.items() if isinstance(each, Between)}

    def _output(self, name: str, units: dict[str, str]) -> Callable[[Any], float]:
        """An output of the study as a function of a result, which notes its unit."""
        record = {name: self.file.record.outputs[name]}

        def output(result: Any) -> float:
            number = nivel.analysis.sweep.outputs.outputs_of(result, record)[name]
            units[name] = number.units
            return number.value

        return output

    def _of_search(self, found: xarray.Dataset, outputs: list[str], units: Mapping[str, str]) -> xarray.Dataset:
        """The table of a search with what the report has to know of the study."""
        found = found.assign_attrs({**found.attrs, **self._about(), "design": "", "outputs": json.dumps(outputs)})
        found.attrs |= {"study": self.file.record.name, "description": self.file.record.description}
        for name in outputs:
            known = self.file.record.outputs.get(name)
            limits = (None, None) if known is None else known.limits
            facts = zip(("at_least", "at_most"), limits, strict=True)
            found[name].attrs |= {
                "units": units.get(name, ""),
                **{key: each for key, each in facts if each is not None},
            }
        return found

    @contextmanager
    def _journal(
        self, target: Path | None, of: str, count: str, *, resume: bool, force: bool
    ) -> Iterator[Journal | None]:
        """The journal beside a data file (`open_journal`), and faults of what goes on inside at their lines."""
        sources = [Path(self.file.file), Path(self.file.machine_file)]
        with nivel.analysis.progress.journal.open_journal(
            target, of, count, resume=resume, force=force, sources=sources
        ) as journal:
            try:
                yield journal
            except nivel.analysis.optimise.evaluations.NothingFoundError:
                raise
            except ModelError as error:
                raise ModelError([self._placed(each) for each in error.faults]) from None

    def _about(self) -> dict[str, Any]:
        """What the report has to know of the study."""
        record = self.file.record
        return {
            "design": record.design,
            "samples": record.samples or 0,
            "seed": record.seed,
            "parameters": json.dumps(list(record.parameters)),
            "outputs": json.dumps(list(record.outputs)),
        }

    def _placed(self, fault: Fault) -> Fault:
        """A fault of an output, or of measurements, at its line."""
        steps = tuple(fault.path.split("."))
        if not fault.line and steps[0] in ("data", "deviations"):
            return self.file.fault(("identify", steps[0]), fault.message)
        if fault.line or steps[0] not in ("outputs", "save"):
            return fault
        return self.file.fault(steps, fault.message)

    def __repr__(self) -> str:
        record = self.file.record
        return f"<Study {record.name}: {len(record.parameters)} parameters, {record.design}, {record.analysis}>"


@checked_arguments
def load_study(
    path: str | PathLike[str], overrides: Mapping[str, Any] | None = None, *, allow_code: bool = False
) -> Study:
    """Read a study file and its machine. `overrides` replace values by path, e.g. ``{"samples": 64}``.

    allow_code : outputs, and laws of the machine, may be Python functions, which run with all your rights.
    Raises ModelError with every fault of the files, each with its line.
    """
    file = fspath(path)
    study, faults = study_and_faults(read_text(file), file, overrides=dict(overrides or {}), allow_code=allow_code)
    if study is None:
        raise ModelError(faults)
    with gathered(faults):
        resolved = nivel.analysis.sweep.resolution.resolve(study, load(study.machine_file, allow_code=allow_code))
    refuse(faults)
    return Study(resolved)


def write_study_report(dataset: xarray.Dataset | str | PathLike[str], path: str | PathLike[str]) -> Path:
    """Write the report of a study, or of its data file, as one HTML file that needs no network; an existing file is replaced."""
    if isinstance(dataset, xarray.Dataset):
        return write_page(nivel.report.study_page.study_html(dataset), path)
    with xarray.open_dataset(dataset, engine="h5netcdf") as opened:
        return write_page(nivel.report.study_page.study_html(opened.load()), path)
