"""From a machine to its session, and one HTML file in which it lives: its machine code for WebAssembly, its memory, its picture, and the
page of `nivel live`."""

import json
import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import Any, NamedTuple, Unpack

from nivel.analysis.gradients.outputs import parameters_of
from nivel.analysis.plan.compilation import build, run_entries
from nivel.analysis.plan.plan import Plan
from nivel.analysis.preparation.attributes import run_attributes
from nivel.analysis.progress.log import Listener
from nivel.api import Machine
from nivel.c_library.exported import FRAMES_KEPT, Exported, export, failures_of, refusal
from nivel.c_library.image import WORD, Image, UnknownAddressError
from nivel.c_library.parameters import Followed, follow, memory_of
from nivel.errors import refuse, retold
from nivel.files.target import check_target, write_file
from nivel.integrate.loop.loop import advance
from nivel.integrate.loop.paced import SHOWN, TICKS, Live, drive
from nivel.integrate.loop.run import ACCEPTED, STOPPED, TIME
from nivel.integrate.loop.sink import Header
from nivel.judge.after.checks.circuits import INTEGRALS, START
from nivel.judge.after.checks.energy import BALANCE
from nivel.judge.after.checks.joints import OPENING, RATES
from nivel.judge.before.refusals import ON_SOIL
from nivel.kernels.core import status
from nivel.kernels.core.block import Handle
from nivel.kernels.output.observe import observe
from nivel.live.picture import Picture
from nivel.live.preparation import HAND_INPUTS, LiveRun, Pace, live_plan, pace_of, prepared_run
from nivel.live.recording import Journal, about_run, journal_of
from nivel.live.session import Session
from nivel.live.shared import Sizes, bytes_of, live_in
from nivel.live.timing import ENTRIES
from nivel.native import library, wasm, workers
from nivel.native.entry import Entry
from nivel.native.workers import CompilationError
from nivel.results.frames.contents import MemoryContents
from nivel.results.frames.csv_table import columns
from nivel.results.result import Result
from nivel.results.scales import ENERGY_FLOOR, REST, machine_size, reaches, weight
from nivel.settings import StepSettingsDict
from nivel.system.layout import FrameLayout
from nivel.view import local
from nivel.view.page import page_with_machine
from nivel.view.records import Parameter
from nivel.words.arguments import checked_arguments

LARGEST = 1e300
TAPE_ROWS, FRAME_ROWS = 4, 64  # of the rings: a page reads frames after every turn, and keeps no tape


class _Codes:
    """Names of functions of the module, each once, and their numbers."""

    def __init__(self) -> None:
        self.names: list[str] = []

    def number(self, entry: Entry | str) -> int:
        """Of an entry or its symbol."""
        symbol = entry if isinstance(entry, str) else entry.symbol
        if symbol not in self.names:
            self.names.append(symbol)
        return self.names.index(symbol)


class LivePage(NamedTuple):
    """What was written. inputs, parameters : that the page changes. kernels : bytes of machine code. verified : no; the errors of its steps
    were not examined."""

    path: Path
    inputs: tuple[str, ...]
    parameters: tuple[str, ...]
    kernels: int
    verified: bool = False


def write_live_page(plan: Plan, pace: Pace, path: Path, followed: Followed | None = None) -> LivePage:
    """Write the page of a live machine, which replaces an existing file. plan, pace : of `live_plan`. followed : its parameters.

    Raises ModelError where a Python law or foreign code takes part, or the machine cannot be assembled.
    """
    plan = plan if followed is None else followed.machine.plan
    refuse(ON_SOIL.faults(plan.machine))  # its cells are no part of the image
    run = _short(prepared_run(plan, pace))
    layout, inputs = run.prepared.motion.system.layout, plan.machine.inputs[:-HAND_INPUTS]
    sizes = Sizes(*run.sizes[:2], TAPE_ROWS, FRAME_ROWS)
    live = live_in(bytearray(bytes_of(sizes)), sizes)
    session = run.session(live)
    run.show(live)
    frame = live.frames[0].copy()
    attributes = run_attributes(plan.machine, "", run.prepared, plan.settings)
    parameters = () if followed is None else followed.parameters
    picture = Picture(attributes, layout, frame, inputs, plan.machine.sensors, _sliders(followed))
    entries = {each.symbol: each for each in (*run_entries(plan), drive, observe)}
    image = _image(run, session, [*entries.values()])
    codes = _Codes()
    machine = local.LocalMachine(
        bytes=image.words.nbytes,
        loop=_loop(run, session, image, codes),
        inner=list(image.inner.items()),
        outer=[(word, codes.number(symbol)) for word, symbol in image.outer.items()],
        codes=codes.names,
        tick=pace.tick,
        session=_session(live, image),
        inputs=[local.LocalInput(each.name, each.rest_value) for each in inputs],
        parameters=_follow(run, image, followed),
        bodies=len(plan.machine.bodies),
        picture=_columns_of(picture),
        failures=[
            local.LocalFailure(int(one), text, [*names]) for one, text, names in failures_of(run.prepared.motion.system)
        ],
        events=[*run.prepared.motion.system.events],
        spent=status.BUDGET_SPENT,
        done=status.DONE,
        **_light(Result(MemoryContents(Header(layout, attributes), frame[None], attributes)), layout),
    )
    try:
        objects = library.object_codes_for([entries[name] for name in codes.names], wasm.TARGET)
    except CompilationError as problem:
        raise refusal(f"a page is made of machine code for browsers, and {problem}") from None
    module = wasm.linked(wasm.needed([wasm.read_object(each) for each in objects.values()], wasm.library()))
    text = json.dumps(asdict(machine), separators=(",", ":"), allow_nan=False).encode()
    html = page_with_machine(plan.machine.name, picture.package, text, image.words.tobytes(), module)
    return LivePage(
        write_file(path, "page", html),
        tuple(each.name for each in inputs),
        tuple(each.path for each in parameters),
        len(module),
    )


def _short(run: LiveRun) -> LiveRun:
    """The run with room for no more frames than a step leaves."""
    history = run.run
    run.loop = run.loop._replace(history=Handle(history._replace(frames=history.frames[:FRAMES_KEPT].copy())))
    return run


def _image(run: LiveRun, session: Handle, entries: list[Entry]) -> Image:
    twin = run.prepared.motion.twin
    handles = [run.loop.machine, *([] if twin is None else [twin]), run.loop.history, session]
    try:
        return Image(handles, {each.address: each.symbol for each in entries})
    except UnknownAddressError:
        raise refusal("Python laws cannot go into a page; write them as expressions") from None


def _sliders(followed: Followed | None) -> list[Parameter]:
    if followed is None:
        return []
    rows = zip(followed.parameters, followed.least, strict=True)
    return [Parameter(each.path, each.units, each.value, max(least, -LARGEST)) for each, least in rows]


def _follow(run: LiveRun, image: Image, followed: Followed | None) -> local.LocalParameters:
    """The numbers of the page that follow from parameters, as those of the machine that was exported do; they are put into the image."""
    energy = image.byte_of(run.loop.machine.record.control.energy.ctypes.data)
    if followed is None or (numbers := followed.numbers) is None:
        return local.LocalParameters([], [], [], energy)
    addresses = memory_of(run.prepared, run.loop).addresses[numbers.places]
    words = [image.byte_of(int(each)) // WORD for each in addresses]
    image.words[words] = followed.machine.image.words[followed.words]
    terms: list[list[tuple[int, list[float], list[float]]]] = [[] for _ in words]
    for number, k in followed.terms:
        terms[number].append((k, numbers.factors[number, k].tolist(), numbers.divisors[number, k].tolist()))
    laws = (numbers.constants.tolist(), numbers.powers.tolist(), numbers.signs.tolist())
    rows = [local.LocalNumber(*each) for each in zip(words, *laws, terms, strict=True)]
    frames = [*zip(numbers.centres.tolist(), numbers.widths.tolist(), strict=True)]
    return local.LocalParameters(rows, [each.value for each in followed.parameters], frames, energy)


def _loop(run: LiveRun, session: Handle, image: Image, codes: _Codes) -> local.LocalLoop:
    """Where the loop finds what it is called with."""
    loop, history = run.loop, run.run
    places = {name: image.byte_of(getattr(history, name).ctypes.data) for name in ("y", "rate", "clock", "counter")}
    entries = {"drive": drive, "advance": advance, "observe": observe}
    entries |= {name: getattr(loop, name) for name in ("evaluate", "correct", "step")}
    return local.LocalLoop(
        **{name: codes.number(each) for name, each in entries.items()},
        machine=image.byte_of(int(loop.machine.address)),
        history=image.byte_of(int(loop.history.address)),
        session=image.byte_of(int(session.address)),
        **places,
        count=len(history.y),
        time=TIME,
        accepted=ACCEPTED,
        stopped=STOPPED,
        failed=image.byte_of(loop.machine.record.control.failure.ctypes.data),
    )


def _session(live: Live, image: Image) -> local.LocalSession:
    places = {name: image.byte_of(getattr(live, name).ctypes.data) for name in ("control", "target", "value", "frames")}
    rows, width = live.frames.shape
    return local.LocalSession(**places, rows=rows, width=width, ticks=TICKS, shown=SHOWN)


def _columns_of(picture: Picture) -> local.LocalPicture:
    """Which columns of a frame of the run make one of the page."""
    places = (picture.places.position, picture.places.orientation, picture.places.modal)
    position, orientation, modal = ((each.start, each.stop) for each in places)
    x, y, z = picture.origin.tolist()
    return local.LocalPicture(position, orientation, modal, (x, y, z), picture.columns, picture.traced)


def _light(result: Result, layout: FrameLayout) -> dict[str, Any]:
    """Names of all columns, and what the light looks at; `result` has the first frame."""
    names = columns(result)
    span = {each.name: each.columns for each in layout.variables}
    size = machine_size(result)[0]
    watched = [*_watched(result, span, size)]
    v, w = (span[name].start if name in span else 0 for name in ("velocity", "angular_velocity"))
    speeds = local.Speeds(v, w, reaches(result).tolist(), REST * size)
    return {"names": [f"{each} [{result.units(each)}]" for each in names], "watched": watched, "speeds": speeds}


def _watched(result: Result, span: dict[str, slice], size: float) -> Iterator[local.Watched]:
    """Energy, joints and circuits; the time is the page's own."""

    def of(name: str) -> list[int]:
        return [*range(span[name].start, span[name].stop)] if name in span else []

    energies = [*of("kinetic_energy"), *of("external_work"), *of("dissipated_energy")]
    said = f"Energy: error {{}} of the largest energy ({BALANCE})"
    error, changes = of("energy_error"), of("potential_energy")
    floor = ENERGY_FLOOR * weight(result) * size
    yield local.Watched(said, error, [1.0], False, energies, changes, floor, 0.0, BALANCE.green, BALANCE.amber)
    units = [*json.loads(str(result.attributes.get("constraint_units", "{}"))).values()]
    opened = f"Joints: open by {{}} of the machine's size, or of 1 as a cosine ({OPENING})"
    parted = f"Joint rates: off by {{}} of the largest speed ({RATES})"
    for name, limit, said, of_length, of_cosine, floor in (
        ("constraint_violation", OPENING, opened, 1.0 / size, 1.0, 1.0),
        ("constraint_rate_violation", RATES, parted, 1.0, size, 0.0),
    ):
        if rows := of(name):
            factors = [of_length if unit == "m" else of_cosine for unit in units]
            yield local.Watched(said, rows, factors, False, [], [], floor, 1.0 - floor, limit.green, limit.amber)
    if f"{START}stored" in span:
        supplied, delivered, lost = (of(f"state.{START}{name}")[0] for name in INTEGRALS)
        stored = of(f"{START}stored")
        terms, factors = [supplied, delivered, lost, *stored], [1.0, -1.0, -1.0, -1.0]
        said = f"Hydraulics: error {{}} of the largest energy of the circuits ({BALANCE})"
        against = [supplied, delivered, lost]
        yield local.Watched(said, terms, factors, True, against, stored, 1e-9, 0.0, BALANCE.green, BALANCE.amber)


@contextmanager
def session_of(
    machine: Machine,
    settings: Mapping[str, Any],
    *,
    tick: float | None = None,
    urgent: bool = True,
    record: Path | None = None,
    force: bool = False,
    listener: Listener | None = None,
) -> Iterator[Session]:
    """The machine, prepared in the solver's process, paused at its start.

    record : the recording that it is to become; its journal stands beside it until `Recorder.complete` puts the recording in its place.
    force : an older journal is written over. Raises ModelError where it cannot be.
    """
    machine = machine.with_settings(settings)
    with _planned(machine, settings, tick) as (plan, pace), ExitStack() as undone:
        journal = None
        if record is not None:
            about = about_run(plan.machine, machine.origin.source, settings, pace)
            journal = Journal(journal_of(record), about, force=force)
            undone.callback(journal.discard)
        build([*run_entries(plan), drive, *ENTRIES], listener)
        workers.COMPILERS.end_all()
        session = Session(plan, pace, urgent=urgent, journal=journal)
        undone.pop_all()
    try:
        yield session
    finally:
        session.close()


@checked_arguments
def export_page(
    machine: Machine,
    path: str | os.PathLike[str],
    *,
    tick: float | None = None,
    parameters: Sequence[str] | str = (),
    force: bool = False,
    listener: Listener | None = None,
    **settings: Unpack[StepSettingsDict],
) -> LivePage:
    """Write one HTML file in which the machine lives, to be operated as in `nivel live`, without Python, a server or a network.

    tick : time between two readings of the inputs [s], a whole number of steps; by default 1 ms, or a longer step. parameters : numbers of
    the machine by path, which the page changes by sliders, as of `Machine.export_fmu`. force : replace an existing file. settings : of the
    run, as in `Machine.start`.
    Raises ModelError where the integrator chooses its steps, a Python law or foreign code takes part, a parameter cannot be varied, or the
    file is there already.
    """
    target = Path(os.fspath(path))
    check_target(target, "page", force=force, sources=machine.origin.files)
    with _planned(machine := machine.with_settings(settings), settings, tick) as (plan, pace):
        build([*run_entries(plan), drive], listener)
        if not parameters:
            return write_live_page(plan, pace, target)
        given = parameters_of(machine, [parameters] if isinstance(parameters, str) else parameters, "a page")
        same = {**settings, "integrator": plan.settings.integrator}

        def varied(changes: Mapping[str, float]) -> Exported:
            return export(live_plan(machine.with_values(changes).record, same, tick)[0], "a page")

        return write_live_page(plan, pace, target, follow(given, export(plan, "a page"), varied))


@contextmanager
def _planned(machine: Machine, settings: Mapping[str, Any], tick: float | None) -> Iterator[tuple[Plan, Pace]]:
    """The live run of a machine, whose faults are placed in its file."""
    pace_of(machine.record.simulation.step, tick)  # a tick that is not right is no fault of the file
    with retold(machine.origin.placed):
        yield live_plan(machine.record, settings, tick)
