"""A whole run: from a machine record to a result with its trust report; and the second choice of a run that names no integrator.

Other steps are tried where the trust report is not green for what steps can cure. States that stayed far below their scale have the largest
value of the first run as theirs. The second run of the first choice is there and finer: it becomes the result, and a third one with a tenth
of its tolerance verifies it. Where the motion turned to another branch, fixed steps are tried, which pass over the corner. Where steps are
fixed, the machine runs once more with steps as short as the lines that are not green ask for, and work allows. At last radau runs from the
start, but of beams, whose vibrations it would follow. The choice whose report is best is kept, and the report says what was tried.
"""

import json
import time
from collections.abc import Iterator, Mapping
from math import ceil, inf
from os import PathLike
from typing import Final

from nivel.analysis.plan.choice import FOR_STIFF, USUAL_TOLERANCE, with_scales
from nivel.analysis.plan.compilation import build, run_entries
from nivel.analysis.plan.plan import Plan, other_run
from nivel.analysis.preparation.attributes import run_attributes, settings_in_json
from nivel.analysis.progress.log import Listener, Progress
from nivel.analysis.progress.pacing import terminable
from nivel.analysis.run import attempt as attempts
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
from nivel.results.curve import PROBED, PULSE
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
# They are divided, and tolerances are, again where that leaves less than this share of what was not green.
LESS = 0.5
# Why a choice was not begun.
SPENT: Final = "other choices had done the work that they may do"
LITTLE: Final = f"the one before left more than {LESS:.0%} of what was not green"
CUT: Final = "the second run, which would be the result, did not come to its end"
REFUSED: Final = "other settings do not go with it"


class Try(Struct):
    """A choice that was tried, in words, and what it gave: its verdict by line of the report, or why it came to no end."""

    words: str
    verdicts: dict[str, str]
    ended: str = ""

    def gave(self, line: str) -> str:
        """What it gave for a line."""
        return self.ended or self.verdicts.get(line, "green")


def second_choice(
    first: attempts.Attempt, options: attempts.Options, *, judge: bool
) -> tuple[attempts.Attempt, Trust | None]:
    """The best choice and its trust report, where it is judged already. judge : there is a report."""
    finished = first.finished
    if not first.plan.is_open or finished.asked_to_stop or finished.outcome == "interrupted":
        return first, None
    if finished.outcome == "failed":
        return _instead_of_failed(first, options), None
    trust = assess(first.run) if judge and first.verified is not None else None
    if trust is None or first.plan.asked is None:
        return first, None
    tries, choices = [_tried(first, trust)], Choices(first.plan, options, [(first, trust)])
    others = choices.others()
    while _open_lines(choices.best[1]) and (choice := next(others, None)) is not None:
        if choice.finished.outcome != "done" or choice.verified is None:
            failed = choice.finished.failure is not None
            why = "failed" if failed else "was given up, as it took too much work"
            tries.append(Try(in_words(choice.plan), {}, why))
            continue
        choices.judged.append((choice, assess(choice.run)))
        tries.append(_tried(*choices.judged[-1]))
    best, trust = choices.best
    return best, _with_tries(trust, tries, best.plan, choices.not_begun)


class Choices:
    """Other choices of a run, which together do no more than MOST_TIMES the work of the first one. judged : those that came to their end,
    with their reports; the first one at the start. left : work that the next ones may do. not_begun : why, of others in words."""

    def __init__(self, plan: Plan, options: attempts.Options, judged: list[tuple[attempts.Attempt, Trust]]) -> None:
        assert plan.asked is not None
        self.plan, self.options, self.judged = plan, options, judged
        self.asked, first = plan.asked, judged[0][0]
        # of beams the usual steps, which may be shorter than the first ones
        longer = (
            1.0 if plan.settings.tolerance is not None else max(1.0, plan.settings.step / self.asked.simulation.step)
        )
        self.left = attempts.most_work(longer * _work_of(first), len(first.prepared.start))
        self.share = first.finished.work / max(_work_of(first), 1)  # of a choice's work, before it is verified
        self.not_begun: dict[str, str] = {}

    @property
    def best(self) -> tuple[attempts.Attempt, Trust]:
        """The one whose report is best so far."""
        return min(self.judged, key=lambda each: _badness(each[1]))

    def others(self) -> Iterator[attempts.Attempt]:
        """They are made when they are asked for."""
        plan, asked, (first, trust) = self.plan, self.asked.simulation.model_fields_set, self.judged[0]
        if any(item.name == "branch" and item.verdict != "green" for item in trust.items):
            yield from self._started(plan, OF_FIXED_STEPS, reason=BRANCHED)
        if "states" in _open_lines(trust):
            scales = {each.place[1]: each.largest for each in look_at_states(first.run)}
            scaled = replace(plan, asked=with_scales(self.asked, scales))
            yield from self._started(scaled, plan.settings.integrator)
        if kept := asked & ({"tolerance"} if plan.settings.tolerance is not None else {"tolerance", "step"}):
            self.not_begun["other steps"] = f"`{min(kept)}` is given"
        if "tolerance" in asked:
            return
        if plan.settings.tolerance is not None:
            yield from self._finer()
        elif "step" not in asked:
            yield from self._shorter()
        usual = (FOR_STIFF, USUAL_TOLERANCE)
        if (plan.settings.integrator, plan.settings.tolerance) != usual and not plan.machine.beams:
            yield from self._started(plan, FOR_STIFF, reason=AT_LAST)

    def _finer(self) -> Iterator[attempts.Attempt]:
        """Second runs as results, as long as each is much better than the one before."""
        (last, report), before = self.judged[0], inf
        while last.plan.settings.tolerance is not None:
            tolerance = attempts.TENTH * last.plan.settings.tolerance
            plan = other_run(self.plan, self.plan.settings.integrator, tolerance=tolerance)
            little = _excess(report) >= LESS * before
            why = REFUSED if plan is None else LITTLE if little else SPENT if self.left <= 0.0 else CUT
            choice = _verified_anew(last, plan, self.options) if plan is not None and why is CUT else None
            if choice is None:
                self.not_begun[_words(self.plan.settings.integrator, tolerance=tolerance)] = why
                return
            self.left -= _work_of(choice) - choice.finished.work
            yield choice
            if self.judged[-1][0] is not choice:
                return
            before, (last, report) = _excess(report), self.judged[-1]

    def _shorter(self) -> Iterator[attempts.Attempt]:
        """Shorter fixed steps: as short as the lines that are not green ask for, the usual ones at first, and as work allows."""
        (last, report), before = self.judged[0], inf
        usual, order = self.asked.simulation.step, INTEGRATORS[self.plan.settings.integrator].order
        while True:
            longer = int(last.plan.settings.step / usual * (1.0 + 1e-9))
            wanted = max(2, ceil((MARGIN * _excess(report)) ** (1.0 / order)))
            affordable = int(self.left / max(_work_of(last), 1))
            parts = min(MOST_PARTS, wanted, longer if longer > 1 else wanted)
            little = longer <= 1 and _excess(report) >= LESS * before
            if little or affordable < 2:
                words = _words(self.plan.settings.integrator, step=last.plan.settings.step / parts)
                self.not_begun[words] = LITTLE if little else SPENT
                return
            step = last.plan.settings.step / min(parts, affordable)
            yield from self._started(self.plan, self.plan.settings.integrator, step=step)
            if self.judged[-1][0].plan.settings.step != step:
                return
            before, (last, report) = _excess(report), self.judged[-1]

    def _started(self, first: Plan, name: str, *, reason: str = "", **changes: float) -> Iterator[attempts.Attempt]:
        """A run of its own, in memory, with this integrator and other changes of its settings; none where the machine cannot be prepared
        for it, or no work is left."""
        plan, choice = other_run(first, name, **changes), None
        if plan is not None and self.left > 0.0:
            plan = replace(plan, asked=self.asked, reason=reason or plan.reason)
            choice = _run(plan, replace(self.options, most=self.left * self.share))
        if choice is not None:
            self.left -= _work_of(choice)
            yield choice
        else:
            self.not_begun[name if plan is None else in_words(plan)] = REFUSED if self.left > 0.0 else SPENT


def _work_of(choice: attempts.Attempt) -> int:
    return choice.finished.work + (choice.verified.finished.work if choice.verified is not None else 0)


def _verified_anew(first: attempts.Attempt, plan: Plan, options: attempts.Options) -> attempts.Attempt | None:
    """The second run as the result of a run of this plan, with a third one that verifies it; None where that was not whole."""
    second = first.verified
    if second is None or second.ended or first.found is not None or second.finished.pace is None:
        return None
    third = attempts.SecondRun(next(attempts.resampled(plan), plan), options.limit)
    try:
        third.leader.taken, third.leader.work = second.finished.pace[TAKEN].copy(), second.finished.work
        verified = third.wait(options.listener)
    finally:
        third.cancel()
    return attempts.Attempt(plan, second.prepared, second.finished, second.result, second.frames, verified)


def _run(plan: Plan, options: attempts.Options) -> attempts.Attempt | None:
    """A run of its own, in memory; None where the machine cannot be prepared for it."""
    try:
        build(run_entries(plan), options.listener)
        options.listener.say(f"once more with {in_words(plan)}")
        return attempts.attempt(plan, Memory(plan.settings.frames + 1), options, prepare(plan.methods))
    except (ModelError, SolveError):
        return None


def _instead_of_failed(first: attempts.Attempt, options: attempts.Options) -> attempts.Attempt:
    """The run with another choice, where the first one failed for its steps and that one comes to its end: radau, else fixed steps, which
    pass a law that jumps to and fro and shrinks every chosen step."""
    plan = first.plan
    if first.finished.status not in STATUSES:
        return first
    for name in (FOR_STIFF, OF_FIXED_STEPS):
        other = None if plan.settings.integrator == name else other_run(plan, name)
        choice = None if other is None else _run(replace(other, reason=FAILED), options)
        if choice is not None and choice.finished.outcome != "failed":
            return choice
    return first


def in_words(plan: Plan) -> str:
    """Method and steps of a plan."""
    settings = plan.settings
    return _words(settings.integrator, tolerance=settings.tolerance, step=settings.step)


def _words(name: str, *, tolerance: float | None = None, step: float = 0.0) -> str:
    by = f"tolerance {tolerance:.0e}" if tolerance is not None else f"steps of {seconds(step)}"
    return f"{name}, {by.replace('e-0', 'e-')}"


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


def _tried(choice: attempts.Attempt, trust: Trust) -> Try:
    names = dict.fromkeys(item.name for item in trust.items)
    worst = {name: [item.verdict for item in trust.items if item.name == name] for name in names}
    order = ("red", "amber", "green")
    return Try(in_words(choice.plan), {name: min(found, key=order.index) for name, found in worst.items()})


def _with_tries(trust: Trust, tries: list[Try], plan: Plan, not_begun: Mapping[str, str]) -> Trust:
    """The report whose lines that are not green say what was tried, and which choices were not begun, and why."""
    others = [each for each in tries if each.words != in_words(plan)]
    items = []
    for item in trust.items:
        said = ""
        if item.verdict != "green" and item.name not in OF_STEPS | OF_NOTHING | lines_apart():
            said = "; no step makes this better: it is not of the steps"
        elif item.verdict != "green" and item.name in OF_STEPS and others:
            said = f"; tried: {', '.join(f'{each.words}: {each.gave(item.name)}' for each in others)}"
        if item.verdict != "green" and item.name in OF_STEPS and not_begun:
            said += f"; not begun: {', '.join(f'{words}, as {why}' for words, why in not_begun.items())}"
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
    options = attempts.Options(source, verify, verify_limit, listener)
    with terminable():
        first = attempts.attempt(plan, sink, options, prepared)
        best, trust = second_choice(first, options, judge=judge)
        if best is not first:
            sink.discard()
            sink = Memory(best.plan.settings.frames + 1) if out is None else Store(out, force)
            sink.begin(attempts.header_of(best.plan, best.prepared, source))
            sink.take(best.frames)
        seconds = {"prepare_seconds": prepare_seconds, "compile_seconds": compile_seconds}
        return close_run(sink, best.run, seconds, judge=judge, trust=trust)


def close_run(
    sink: Memory | Store, run: Run, timing: dict[str, float], *, judge: bool = True, trust: Trust | None = None
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
        attributes[PULSE] = finished.pulse
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
