"""A whole run: from a machine record to a result with its trust report; and the second choice of a run that names no integrator.

Other steps are tried where the trust report is not green for what steps can cure. States that stayed far below their scale have the largest
value of the first run as theirs. The second run of the first choice is there and finer: it becomes the result, and a third one with a tenth
of its tolerance verifies it. Where the motion turned to another branch, fixed steps are tried, which pass over the corner. Where steps are
fixed, the machine runs once more with steps as short as the lines that are not green ask for, and work allows. At last radau runs from the
start, but of beams, whose vibrations it would follow. The choice whose report is best is kept, and the report says what was tried.
"""

import json
import time
from collections.abc import Iterator
from math import ceil
from os import PathLike
from typing import Final

from nivel.analysis.plan.choice import FOR_STIFF, USUAL_TOLERANCE, with_scales
from nivel.analysis.plan.compilation import build, run_entries
from nivel.analysis.plan.plan import Plan, other_run
from nivel.analysis.preparation.attributes import run_attributes, settings_in_json
from nivel.analysis.progress.log import Listener, Progress
from nivel.analysis.progress.pacing import terminable
from nivel.analysis.run.attempt import TENTH, Attempt, Options, SecondRun, attempt, header_of, most_work, resampled
from nivel.analysis.run.dynamics import march
from nivel.analysis.run.prepared_state import prepare
from nivel.errors import ModelError, SolveError
from nivel.integrate.catalogue import INTEGRATORS
from nivel.integrate.loop.run import ITERATED, MOST_ITERATED, STEPPED, TAKEN
from nivel.integrate.loop.sink import Header
from nivel.judge.after.checks.states import look_at_states
from nivel.judge.after.report import assess, lines_apart
from nivel.judge.after.subject import Run, run_of
from nivel.judge.during.stop import Status
from nivel.lazy import Struct, nivel, replace
from nivel.results.curve import PROBED
from nivel.results.estimate import ATTRIBUTE as ESTIMATES
from nivel.results.frames.summary import ATTRIBUTE as ITERATIONS
from nivel.results.frames.summary import iterations_in_json, to_json
from nivel.results.memory import Memory
from nivel.results.result import Result
from nivel.results.store import Store
from nivel.results.trust import Trust
from nivel.words.wording import seconds

# Lines of the trust report that speak of what steps do.
OF_STEPS = frozenset(
    {"energy", "violation", "rate_violation", "accuracy", "quantities", "parts", "states"}
    | {"loads", "sampling", "events", "contact", "steps", "turn", "hydraulics", "damped", "rolling"}
)
# Lines on what was not examined, or how a run ended.
OF_NOTHING = frozenset({"verified", "unexamined", "outcome"})
# A failure of steps, which another method may not have.
STATUSES = (
    *(Status.STEP_TOO_SMALL, Status.NOT_FINITE, Status.NOT_CONVERGED),
    *(Status.CRAWLS, Status.OUT_OF_REACH, Status.CONTRADICTION),
)
OF_FIXED_STEPS: Final = "rk4"
AT_LAST: Final = "no method is named, and the steps that are usual for such a machine were not exact enough"
FAILED: Final = "no method is named, and steps that follow the motion come to no end"
BRANCHED: Final = "no method is named, and steps that follow the motion turn where it branches"
# Fixed steps are divided by so much at most; the error is to be this much below what is green.
MOST_PARTS, MARGIN = 16, 1.5
# Work grows by this power of the number of steps (measured 0.1 to 0.7), as shorter ones need fewer iterations: what is not affordable is
# not begun.
GROWTH = 0.75


class Try(Struct):
    """A choice that was tried, in words, and what it gave: its verdict by line of the report, or why it came to no end."""

    words: str
    verdicts: dict[str, str]
    ended: str = ""

    def gave(self, line: str) -> str:
        """What it gave for a line."""
        return self.ended or self.verdicts.get(line, "green")


def second_choice(first: Attempt, options: Options, *, judge: bool) -> tuple[Attempt, Trust | None]:
    """The best choice and its trust report, where it is judged already.

    Other choices end where they do more work than the second run may. judge : there is a report.
    """
    finished = first.finished
    if not first.plan.is_open or finished.asked_to_stop or finished.outcome == "interrupted":
        return first, None
    if finished.outcome == "failed":
        return _instead_of_failed(first, options), None
    trust = assess(first.run) if judge and first.verified is not None else None
    if trust is None:
        return first, None
    best, tries = (first, trust), [_tried(first, trust)]
    most = most_work(finished.work, len(first.prepared.start))
    choices = _choices(first, trust, replace(options, most=most))
    while _open_lines(best[1]) and (choice := next(choices, None)) is not None:
        if choice.finished.outcome != "done" or choice.verified is None:
            tries.append(Try(in_words(choice.plan), {}, _why_not(choice)))
            continue
        other = assess(choice.run)
        tries.append(_tried(choice, other))
        best = min(best, (choice, other), key=lambda each: _badness(each[1]))
    return best[0], _with_tries(best[1], tries, best[0].plan)


def _choices(first: Attempt, trust: Trust, options: Options) -> Iterator[Attempt]:
    """Other choices, made when they are asked for."""
    plan = first.plan
    if plan.asked is None:
        return
    asked = plan.asked.simulation.model_fields_set
    if any(item.name == "branch" and item.verdict != "green" for item in trust.items):
        passing = other_run(plan, OF_FIXED_STEPS)
        if passing is not None and (choice := _started(replace(passing, reason=BRANCHED), options)) is not None:
            yield choice
    if "states" in _open_lines(trust):
        small = look_at_states(first.run)
        scaled = with_scales(plan.asked, {each.place[1]: each.largest for each in small})
        other = other_run(replace(plan, asked=scaled), plan.settings.integrator)
        if other is not None and (choice := _started(replace(other, asked=plan.asked), options)) is not None:
            yield choice
    if "tolerance" in asked:
        return
    if plan.settings.tolerance is not None:
        finer = other_run(plan, plan.settings.integrator, tolerance=TENTH * plan.settings.tolerance)
        if finer is not None and (choice := _finer(first, finer, options)) is not None:
            yield choice
    elif "step" not in asked:
        order = INTEGRATORS[plan.settings.integrator].order
        wanted = max(2, ceil((MARGIN * _excess(trust)) ** (1.0 / order)))
        parts = min(MOST_PARTS, wanted, int((options.most / max(first.finished.work, 1)) ** (1.0 / GROWTH)))
        finer = other_run(plan, plan.settings.integrator, step=plan.settings.step / parts) if parts > 1 else None
        if finer is not None:
            yield _run(finer, options)
    usual = (FOR_STIFF, USUAL_TOLERANCE)
    if (plan.settings.integrator, plan.settings.tolerance) != usual and not plan.machine.beams:
        last = other_run(plan, FOR_STIFF)
        if last is not None and (choice := _started(replace(last, reason=AT_LAST), options)) is not None:
            yield choice


def _finer(first: Attempt, plan: Plan, options: Options) -> Attempt | None:
    """The second run as the result of a run of this plan, with a third one that verifies it; None where that was not whole."""
    second = first.verified
    if second is None or second.ended or first.found is not None or second.finished.pace is None:
        return None
    third = SecondRun(next(resampled(plan), plan), options.limit)
    try:
        third.leader.taken, third.leader.work = second.finished.pace[TAKEN].copy(), second.finished.work
        verified = third.wait(options.listener)
    finally:
        third.cancel()
    return Attempt(plan, second.prepared, second.finished, second.result, second.frames, verified)


def _run(plan: Plan, options: Options) -> Attempt:
    """A run of its own, in memory."""
    build(run_entries(plan), options.listener)
    options.listener.say(f"once more with {in_words(plan)}")
    return attempt(plan, Memory(plan.settings.frames + 1), options, prepare(plan.methods))


def _started(plan: Plan, options: Options) -> Attempt | None:
    """The same; None where the machine cannot be prepared for it."""
    try:
        return _run(plan, options)
    except (ModelError, SolveError):
        return None


def _instead_of_failed(first: Attempt, options: Options) -> Attempt:
    """The run with another choice, where the first one failed for its steps and that one comes to its end: radau, else fixed steps, which
    pass a law that jumps to and fro and shrinks every chosen step."""
    plan = first.plan
    if first.finished.status not in STATUSES:
        return first
    for name in (FOR_STIFF, OF_FIXED_STEPS):
        other = None if plan.settings.integrator == name else other_run(plan, name)
        choice = None if other is None else _started(replace(other, reason=FAILED), options)
        if choice is not None and choice.finished.outcome != "failed":
            return choice
    return first


def in_words(plan: Plan) -> str:
    """Method and steps of a plan."""
    settings = plan.settings
    by = (
        f"tolerance {settings.tolerance:.0e}"
        if settings.tolerance is not None
        else f"steps of {seconds(settings.step)}"
    )
    return f"{settings.integrator}, {by.replace('e-0', 'e-')}"


def _why_not(choice: Attempt) -> str:
    failure = choice.finished.failure
    return "failed" if failure is not None else "was given up, as it took too much work"


def _open_lines(trust: Trust) -> list[str]:
    """Lines that are not green and that other steps may cure."""
    return [item.name for item in trust.items if item.verdict != "green" and item.name in OF_STEPS]


def _excess(trust: Trust) -> float:
    """The largest number of the lines that steps may cure, over what is green."""
    lines = [item for item in trust.items if item.name in OF_STEPS and item.fraction is not None and item.green]
    return max((float(item.fraction or 0.0) / float(item.green or 1.0) for item in lines), default=1.0)


def _badness(trust: Trust) -> tuple[int, int, float]:
    """Red lines, amber lines, and the estimated error [m]."""
    lines = [item.verdict for item in trust.items if item.name in OF_STEPS]
    return lines.count("red"), lines.count("amber"), trust.accuracy_estimate or 0.0


def _tried(choice: Attempt, trust: Trust) -> Try:
    names = dict.fromkeys(item.name for item in trust.items)
    worst = {name: [item.verdict for item in trust.items if item.name == name] for name in names}
    order = ("red", "amber", "green")
    return Try(in_words(choice.plan), {name: min(found, key=order.index) for name, found in worst.items()})


def _with_tries(trust: Trust, tries: list[Try], plan: Plan) -> Trust:
    """The report whose lines that are not green say what was tried."""
    others = [each for each in tries if each.words != in_words(plan)]
    items = []
    for item in trust.items:
        said = ""
        if item.verdict != "green" and item.name not in OF_STEPS | OF_NOTHING | lines_apart():
            said = "; no step makes this better: it is not of the steps"
        elif item.verdict != "green" and item.name in OF_STEPS and others:
            said = f"; tried: {', '.join(f'{each.words}: {each.gave(item.name)}' for each in others)}"
        items.append(replace(item, text=f"{item.text}{said}"))
    return replace(trust, items=tuple(items))


def simulate(
    plan: Plan,
    *,
    source: str = "",
    out: str | PathLike[str] | None = None,
    force: bool = False,
    verify: bool = False,
    verify_limit: float | None = None,
    listener: Listener | None = None,
    compile_seconds: float = 0.0,
    judge: bool = True,
) -> Result:
    """Run as planned; the result is in memory, or streamed to the file `out`.

    compile_seconds : what was spent on compiling before, for the result's timing.
    verify : a second run goes beside this one, with finer steps on other times, and its distance tells how exact this one is; it goes on
    after it for `verify_limit` [s] at most, by default for three times the work of the first.
    judge : a trust report is made; without one the result is that of a run of which nobody knows how exact it is.
    A machine that names no integrator has a second choice where the first one fails, or its trust report is not green for what other steps
    can cure: `nivel.analysis.run.simulate`.
    Raises ModelError before anything is computed, SolveError (with the result so far) when the computation fails, SystemExit where SIGTERM
    came, with the result closed.
    """
    listener = listener or Listener()
    sink = Memory(plan.settings.frames + 1) if out is None else Store(out, force)  # a failure adds one
    begin = time.perf_counter()
    listener.say("preparing")
    prepared = prepare(plan.methods)
    prepare_seconds = time.perf_counter() - begin
    options = Options(source, verify, verify_limit, listener)
    with terminable():
        first = attempt(plan, sink, options, prepared)
        best, trust = second_choice(first, options, judge=judge)
        if best is not first:
            sink.discard()
            sink = Memory(best.plan.settings.frames + 1) if out is None else Store(out, force)
            sink.begin(header_of(best.plan, best.prepared, source))
            sink.take(best.frames)
        seconds = {"prepare_seconds": prepare_seconds, "compile_seconds": compile_seconds}
        return close_run(sink, best.run, seconds, judge=judge, trust=trust)


def close_run(
    sink: Memory | Store,
    run: Run,
    timing: dict[str, float],
    *,
    judge: bool = True,
    trust: Trust | None = None,
) -> Result:
    """Close the sink of a run with its trust report, where it is to be judged, and all that is known of how it ended.

    timing : seconds besides the loop's. trust : the report, where it is made already.
    Raises SolveError, with the result, where the run failed.
    """
    plan, finished, estimate = run.plan, run.finished, run.estimate
    message, advice, at = finished.failure or ("", "", 0.0)
    attributes: dict[str, str | float | int] = {
        "outcome": finished.outcome,
        "failure": message,
        "advice": advice,
        "events": to_json(finished.events),
        "stopped_by": finished.stopped_by,
        "timing": json.dumps({**finished.timing, **timing}),
        PROBED: json.dumps(finished.between_frames),
    }
    if finished.pace is not None:
        steps, total, most = finished.pace[[STEPPED, ITERATED, MOST_ITERATED]]
        if iterated := iterations_in_json(steps, total, most, plan.settings.duration):
            attributes[ITERATIONS] = iterated
    if finished.terrain:
        attributes[nivel.results.terrain.ATTRIBUTE] = finished.terrain
    if finished.went_on is not None:
        attributes["settings"] = settings_in_json(plan.settings, plan.reason, finished.went_on)
    if judge:
        attributes["trust"] = (trust or assess(run)).to_json()
    if estimate is not None and run.elements is not None and run.elements.errors is not None:
        estimate = nivel.judge.after.other_elements.with_elements(estimate, run.elements.errors)
    if estimate is not None:
        attributes[ESTIMATES] = estimate.to_json()
    closed = sink.close(attributes)
    if finished.failure is not None:
        raise SolveError(message, time=at, advice=advice, result=closed)
    return closed


def run_in_memory(plan: Plan, progress: Progress | None = None) -> Run:
    """Prepare and run; what its trust report would look at.

    The result holds the frames and what is known before the first of them, no trust report. Raises ModelError before anything is
    computed, KeyboardInterrupt where Ctrl-C came.
    """
    sink = Memory()
    prepared = prepare(plan.methods)
    sink.begin(Header(prepared.motion.system.layout, run_attributes(plan.machine, "", prepared, plan.settings)))
    finished = march(prepared, plan.settings, [sink], progress=progress)
    if finished.asked_to_stop:
        raise KeyboardInterrupt
    return run_of(plan, prepared, finished, sink.result())
