"""Outcome of an analysis, what has verified its result and what of it nothing has, variants of a sweep and references of a comparison."""

from nivel.judge.after import subject as subjects
from nivel.judge.after.checks.efforts import not_compared
from nivel.judge.after.other_elements import Compared
from nivel.judge.after.report import Check
from nivel.lazy import Struct
from nivel.machine.machine_record import MachineRecord
from nivel.results.trust import Item, Verdict, number
from nivel.words.wording import first_of

SHOWN = 4  # names in a sentence


class Verification(Struct):
    """What has examined a result, and what of it nothing has, in words that stand after "by" and after "not verified:"."""

    by: tuple[str, ...]
    lacks: tuple[str, ...] = ()


def _look_at_run(run: subjects.Run) -> Verification:
    if run.second is None or not len(run.second.result.time):
        return Verification((), ("no second run was made",))
    by, lacks = examined_elements(run.machine, run.elements)
    return Verification((f"a second run with {run.second.refinement.words}", *by), lacks)


def _look_at_equilibria(subject: subjects.Equilibria) -> Verification:
    by, lacks = examined_elements(subject.machine, subject.elements)
    return Verification(("the balance of forces in every state", *by), lacks)


def _look_at_positions(subject: subjects.Positions) -> Verification:
    """Constraints, and functions of drivers that are evaluated apart from them."""
    by, lacks = _followed(subject)
    return Verification(("the closed joints", *by), lacks)


def _look_at_efforts(subject: subjects.Actuated) -> Verification:
    """The balance of forces, what the motion says of itself, and the functions of the drivers."""
    by, lacks = _followed(subject)
    motion = subject.result.trust
    if not motion.verified:
        lacks = ("the motion", *lacks)
    return Verification(("the balance of forces at every time", *by), lacks)


def _followed(subject: subjects.Positions | subjects.Actuated) -> tuple[tuple[str, ...], tuple[str, ...]]:
    left = not_compared(subject)
    lacks = (f"what {first_of(left, SHOWN)} prescribe{'s' * (len(left) == 1)}",) if left else ()
    compared = len(left) < len(subject.drivers)
    return ("the functions of its drivers, evaluated apart",) if compared else (), lacks


def _look_at_led(subject: subjects.Led) -> Verification:
    """The postures themselves: where they put the point, evaluated at each of them."""
    return Verification(("the place of the point in every posture, with its joints closed",))


def _look_at_reach(subject: subjects.Reach) -> Verification:
    """The kinematic analyses of both ways, and the turning points of the curve of positions."""
    ways = "the closed joints of both ways"
    if subject.range.full_turn or not (subject.range.low_reason or subject.range.high_reason):
        return Verification((ways,))
    if not subject.turning:
        return Verification((ways,), ("the ends of the range",))
    return Verification((ways, "the turning points of the curve of positions"))


def _look_at_curve(_: subjects.Curve) -> Verification:
    return Verification(("the closed joints at every position",))


def _look_at_linear(subject: subjects.Linearisation) -> Verification:
    """What eigenvalues are of: an equilibrium, or a motion that was followed; and vibrations with other elements."""
    if subject.unsteady or any(each.jumps for each in subject.kinks):
        return Verification((), ("the linear equations, which describe no motion",))
    by = "A at two later moments of the motion" if subject.moves else "the equilibrium of the state"
    judged = subject.others is not None and not subject.others.why
    more, lacks = _elements(subject.machine, subject.others.pair.words if subject.others and judged else "")
    run = (f"the run to the state at {subject.reached:.6g} s",) if subject.reached else ()
    return Verification((by, *more), (*lacks, *run))


def _look_at_methods(subject: subjects.Methods) -> Verification:
    """The references, each of which checks the other."""
    references, rows = subject.references, [each for each in subject.rows if each.outcome == "done"]
    if not references or not rows:
        return Verification((), ("the motions, as there is no reference",))
    if any(each.blind for each in references):
        return Verification((), ("errors of motions, as references may have the same",))
    if len(references) == 1:
        return Verification((references[0].name,), ("the reference, as no other method came to the end",))
    return Verification(tuple(each.name for each in references))


def _look_at_sweep(sweep: subjects.Sweep) -> Verification:
    ran = [each for each in sweep.variants if each.verdict]
    left = [each for each in ran if not each.verified]
    if len(left) == len(ran):
        return Verification((), (sweep.without,))
    count = len(ran) - len(left)
    lacks = (f"{len(left)} of {len(ran)} variants",) if left else ()
    return Verification((f"{sweep.by} of {count} variant{'s' * (count > 1)}",), lacks)


def examined_elements(machine: MachineRecord, elements: Compared | None) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """(by, lacks) of the elements of beams, nothing of machines without."""
    return _elements(machine, elements.pair.words if elements is not None and elements.errors is not None else "")


def _elements(machine: MachineRecord, words: str) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """words : which other elements there were; empty where none have told anything."""
    if not machine.beams:
        return (), ()
    return ((f"a machine with {words} elements of beams",), ()) if words else ((), ("the elements of beams",))


VERDICTS: dict[str, Verdict] = {"done": "green", "interrupted": "amber", "failed": "red", "running": "amber"}
SAID: dict[type[subjects.Subject], dict[str, str]] = {
    subjects.Motion: {
        "done": "the run reached its end",
        "interrupted": "interrupted; the result ends there",
        "failed": "the computation failed; the result ends there",
        "running": "the file was not closed: the run is still going on, or it was killed",
    },
    subjects.Equilibria: {
        "done": "every state of equilibrium was found",
        "interrupted": "interrupted; the result has the states up to there",
        "failed": "the computation failed; the result has the states up to there",
    },
    subjects.Positions: {
        "done": "every position was found",
        "interrupted": "interrupted; the result has the positions up to there",
        "failed": "the machine cannot move any further; the result has the positions up to there",
    },
    subjects.Actuated: {"done": "efforts were found for every time of the motion"},
    subjects.Linearisation: {"done": "the linear equations were found"},
    subjects.Methods: {"done": "every cell was tried", "interrupted": "interrupted; cells are missing"},
    subjects.Sweep: {"done": "every variant was tried", "interrupted": "interrupted; some variants are not run"},
}


class Outcome(Struct):
    """How an analysis ended, in a word and a sentence."""

    outcome: str
    said: str


def _look_at_outcome(subject: subjects.Subject) -> Outcome:
    words = next((each for kind, each in SAID.items() if isinstance(subject, kind)), {})
    said = words.get(subject.outcome, subject.outcome)
    if isinstance(subject, subjects.Motion) and subject.stopped_by:
        said = f"the event {subject.stopped_by} ended the run, as intended"
    return Outcome(subject.outcome, f"{said}: {subject.failure}" if subject.failure else said)


def _say_outcome(found: Outcome) -> Item:
    return Item("outcome", VERDICTS.get(found.outcome, "red"), f"Outcome: {found.said}")


ENDED = ("done", "stopped")  # outcomes of variants that ran as intended
WORST = ("red", "amber")  # of which one is named


class Ran(Struct):
    """How many variants there are, how many came to their end, and the first one that did not, with the reason."""

    count: int
    ended: int
    first: str
    reason: str


class Judged(Struct):
    """How many variants have a red and an amber trust report, of how many; the first of the worst and what is said of it."""

    count: int
    red: int
    amber: int
    worst: str
    headline: str


def _look_at_ends(sweep: subjects.Sweep) -> Ran:
    others = [each for each in sweep.variants if each.outcome not in ENDED]
    first, reason = (others[0].name, others[0].reason or others[0].outcome) if others else ("", "")
    return Ran(len(sweep.variants), len(sweep.variants) - len(others), first, reason)


def _say_ends(found: Ran) -> Item:
    said = f"Variants: {found.ended} of {found.count} came to their end"
    if found.ended == found.count:
        return Item("variants", "green", f"{said} (green if all do)")
    verdict: Verdict = "amber" if found.ended else "red"
    text = f"{said}; the first that did not is {found.first}: {found.reason} (green if all do, amber if some do)"
    return Item("variants", verdict, text, row=found.first)


def _look_at_verdicts(sweep: subjects.Sweep) -> Judged:
    by: dict[str, list[subjects.Variant]] = {
        colour: [each for each in sweep.variants if each.verdict == colour] for colour in WORST
    }
    worst = next((each[0] for each in by.values() if each), None)
    count = sum(bool(each.verdict) for each in sweep.variants)
    return Judged(count, len(by["red"]), len(by["amber"]), worst.name if worst else "", worst.headline if worst else "")


def _say_verdicts(found: Judged) -> Item:
    if not found.red and not found.amber:
        text = f"Verdicts: no trust report of {found.count} is amber or red (the colour is that of the worst)"
        return Item("verdicts", "green", text)
    said = f"Verdicts: of {found.count} trust reports {found.red} are red and {found.amber} amber"
    text = f"{said}; {found.worst}: {found.headline} (the colour is that of the worst)"
    return Item("verdicts", "red" if found.red else "amber", text, row=found.worst)


class Held(Struct):
    """Names of the references, their own errors as shares of the size, or radians, and why each may miss something; empty where nothing
    says so."""

    names: tuple[str, ...]
    errors: tuple[float, ...]
    blind: tuple[str, ...]


def _look_at_references(subject: subjects.Methods) -> Held:
    """The references, the best first."""
    every = subject.references
    return Held(
        tuple(each.name for each in every), tuple(each.error for each in every), tuple(each.blind for each in every)
    )


def _say_references(found: Held) -> Item:
    limits = "(green with two references of different methods that miss nothing)"
    if not found.names:
        return Item("references", "amber", f"References: there are none, so no error of a motion is known {limits}")
    blind = next((each for each in found.blind if each), "")
    if all(found.blind):
        several = "all of them" if len(found.names) > 1 else "the only one"
        said = f"{several} may have the same error as the runs: {blind}; errors of motions may be larger than they are shown"
        return Item("references", "amber", f"References: {said} {limits}")
    if blind:
        names = ", ".join(name for name, why in zip(found.names, found.blind, strict=True) if why)
        return Item("references", "amber", f"References: {names} may have an error that is not known: {blind} {limits}")
    if len(found.names) == 1:
        return Item("references", "amber", f"References: {found.names[0]} alone, which no other method checks {limits}")
    errors = " and ".join(number(each) for each in found.errors)
    said = f"{' and '.join(found.names)}, whose own errors are {errors}, check each other"
    return Item("references", "green", f"References: {said} {limits}")


CHECKS = (
    Check("verification", subjects.Run, _look_at_run, lambda _: None, 1),
    Check("verification", subjects.Equilibria, _look_at_equilibria, lambda _: None, 1),
    Check("verification", subjects.Positions, _look_at_positions, lambda _: None, 1),
    Check("verification", subjects.Actuated, _look_at_efforts, lambda _: None, 1),
    Check("verification", subjects.Led, _look_at_led, lambda _: None, 1),
    Check("verification", subjects.Reach, _look_at_reach, lambda _: None, 1),
    Check("verification", subjects.Curve, _look_at_curve, lambda _: None, 1),
    Check("verification", subjects.Linearisation, _look_at_linear, lambda _: None, 1),
    Check("verification", subjects.Methods, _look_at_methods, lambda _: None, 1),
    Check("verification", subjects.Sweep, _look_at_sweep, lambda _: None, 1),
    Check("outcome", subjects.Subject, _look_at_outcome, _say_outcome, 0, (), "Outcome"),
    Check("variants", subjects.Sweep, _look_at_ends, _say_ends, 12, (), "Variants"),
    Check("verdicts", subjects.Sweep, _look_at_verdicts, _say_verdicts, 14, (), "Verdicts"),
    Check("references", subjects.Methods, _look_at_references, _say_references, 10, (), "References"),
)
