"""Table of `docs/trust.md` of what each line of the trust report examines, from the records of the checks, and of what nothing examines."""

from __future__ import annotations

import re
import sys
from pathlib import Path

from nivel.judge.after import subject
from nivel.judge.after.report import every_check, titles

PAGE = Path(__file__).parents[1] / "docs" / "trust.md"
BEGIN, END = "<!-- what each line examines -->\n", "<!-- to here from packaging/write_trust_table.py -->\n"
ANALYSES = {
    subject.Run: "run",
    subject.Equilibria: "statics",
    subject.Positions: "kinematics",
    subject.Actuated: "inverse",
    subject.Reach: "range of motion",
    subject.Curve: "curve of positions",
    subject.Led: "inverse kinematics",
    subject.Linearisation: "linearise",
    subject.Methods: "compare",
    subject.Sweep: "sweep",
}
SILENT = ("scales", "verification")  # checks without a line
# checks that have a row together, by their names, and what they examine
EXAMINED = """
accuracy, verified: Accuracy of a run, estimated from a second one whose error is a known share of that of the first
battery: Batteries that are emptier or fuller than their voltages are given for, and go on all the same
beam_mesh: Elements of beams that are too long: curvatures that change within an element, which linear elements take for constant, and
    quadratic ones for linear
stiffening, bending: Limits of modes in a run: fast turns without geometric stiffness, bending that is not small
between_frames, otherwise, pulses: Numbers between frames: how much farther they go than any stored number shows, and what no frame
    shows of them, of the functions of the machine too
branch: Branches: velocities that jump in a singular position, where the motion has gone on along another branch than by inertia
hydraulics, fluid mass, cavitation, saturation, stall, pressure steps: Hydraulic circuits: their balances of energy and mass,
    cavitation, valves that are always open, engines that stall, and their steps
places, postures, ways, ends, opening, curve: Configurations: places that a posture reaches, ranges of a joint coordinate, and curves of
    all positions of a machine
contact: Contacts in passing: bodies that go through each other between two frames, because steps are too long to see it
control: Blocks of the control that stand at their limits all the time, so that their gains do nothing
creep: Creep of contacts whose friction goes to zero with the speed of sliding: how far bodies slid that real friction would have held
damped: Damping by the method: energy that it takes from the motion, and takes from that of a second run with other steps too
motion, open_joints, held_states, missing, surplus: Efforts of inverse dynamics: whether the motion is one of the machine, how far it
    can be trusted, and whether the efforts make it
elements, element_size: Size of the elements of beams: what they make wrong of a run, of equilibria and of vibrations about these
energy: Energy balance of a run, and the force that it may be wrong by
residual, stability, critical, potential, vibrations, free, at_rest: States of equilibrium: how well they are balanced, how stable they
    are, and what statics does not tell of them
excitation: Excitation beyond the modes of a flexible body: loads and drivers that vibrate faster than the first mode that it does not
    have
followed, replaced: Drivers of kinematics and inverse dynamics: whether the positions that were found are those that the drivers'
    functions of time ask for
degrees_of_freedom: Degrees of freedom of the machine
shared_friction: Indeterminate friction: several frictions hold one motion at rest; what they hold it with together is known, their
    shares are not
violation, rate_violation: Joints: how far they are open, and how fast their parts move against each other
kinks: Kinks and jumps of the equations of motion at the state of linear equations, which have one of two slopes, or none
loads, sampling: Loads that the steps of a run miss, in whole or in part, and functions that change between two samples
missed_events, still: What had no part in a run: events that never came, and machines of which nothing moves
laden: Loads of tyres beyond those for which their curves are given
soil, spilt: Soil that was moved and carried: whether its volume was kept, and whether some fell beyond the border of its heights
losses: Losses of a translation: what the machine file of another program's model has under `left_out`
body_mesh, modes, vibration_modes: Sufficiency of the modes of a flexible body for its run: how far modes that it leaves out would bend
    it, under the loads that it bore
near_buckling: Buckling near the states of beams: next to it a small error of the stiffness is a large one of the deflection
neglected: Cost of inertia invariants that flexible bodies move without, by how far they bend in a run
outcome: Outcome: whether the analysis came to its end
part_energy: The balance of energy of each part of a machine that nothing joins to the others, against its own energy: a flywheel hides
    no pendulum
parts: Parts of a machine that are wrong against their own motion, as a second run tells
events: Events that were passed twice within a step, and that the run has not seen
plausible: Plausibility: numbers of the machine and of the result that are far from those of real machines
shortened_steps, branches, histories: Positions of a kinematic analysis: steps that were shortened, branches of positions, and states
    that have a history
quantities: Errors of all stored numbers beside positions: speeds, forces, pressures, flows, currents, signals, states and sensors
redundancy: Redundant constraints, and whether reactions are unique
references: References of a comparison of methods: whether they may have the same error, so that errors measured against them say
    nothing
rolling: Wheels of a run: whether the plane would have to pull, and how much friction rolling without slip takes
rounding: Round-off of positions, seen without a second run: places so far from the origin that steps move them by less
sensitivity: Sensitivity of a motion to its start: neighbouring motions that part, as a second run tells
state: States of elements against their own inequalities: open or closed, slack or taut, held or sliding
singular, unsearched: Positions passed in a run where constraints depend on each other that do not elsewhere: there a motion may
    continue in more than one way
start_equilibrium, start_moved, start_velocity, start_law: Start, where it is not what was given: positions that were moved to close joints,
    velocities that were changed to fit them
states: First-order states whose errors the tolerance hardly controls: they stay far below the scales by which these are measured
steady, growth: Steadiness of what linear equations are about: eigenvalues describe a motion where the machine rests in equilibrium, or
    moves so that the equations stay the same; growth that round-off hides
steps: Steps of fixed size that are too long for what is fastest in the machine, where a run is red
turn: Turning of bodies in a step, seen without a second run: beyond what the method resolves, or beyond what can be counted
unexamined: Functions and contacts of a machine that nothing in the trust report has examined
variants, verdicts: Variants of a sweep: how many came to their end, and how far each can be trusted
elements_of_vibrations, modes_of_vibrations: Vibrations of linear equations that the elements of beams or the modes of flexible bodies
    make wrong: from which one on
"""
NOTHING = (
    "whether the model describes the machine: masses, stiffnesses, friction, clearances, the law of a contact, the order of a control",
    "errors of elements of beams in stresses, in sections along a beam and in shapes of modes; in *Quantities*",
    "errors of stresses of flexible bodies beyond those of their modes and meshes",
    "Python laws between samples, and what they do outside of the run",
    "other motions that the same start allows: branches behind a singular position that both runs pass, other solutions of friction",
    "the numbers of a run that is not verified, except energy, joints and what is seen without a second run",
)


def examined() -> dict[tuple[str, ...], str]:
    """What checks examine, by their names."""
    entries = (" ".join(entry.split()) for entry in re.split(r"\n(?=\w)", EXAMINED.strip()))
    parts = (entry.partition(": ") for entry in entries)
    return {tuple(names.split(", ")): text for names, _, text in parts}


def table() -> str:
    """The table as Markdown."""
    groups = examined()
    left = {check.name for check in every_check()} - {name for names in groups for name in names} - set(SILENT)
    assert not left, f"what {', '.join(sorted(left))} examine is not in EXAMINED"
    rows = [_row(names, text) for names, text in groups.items()]
    rows.sort()
    rows += [("nothing", "", "", each, "") for each in NOTHING]
    head = ("line", "of", "needs", "examines", "green below")
    lines = (f"| {' | '.join(row)} |" for row in (head, ("---",) * 5, *rows))
    return re.sub(r"\|  (?=\|)", "| ", "\n".join(lines)) + "\n"


def written(page: str) -> str:
    """The page with the table in its place."""
    before, _, rest = page.partition(BEGIN)
    return f"{before}{BEGIN}{table()}{END}{rest.partition(END)[2]}"


def _row(names: tuple[str, ...], examines: str) -> tuple[str, ...]:
    """The row of checks with these names."""
    its = sorted((check for check in every_check() if check.name in names), key=lambda check: names.index(check.name))
    said = titles()
    headed = dict.fromkeys(said[line] for each in its if (line := each.line or each.name) in said)
    of = [word for kind, word in ANALYSES.items() if any(issubclass(kind, each.of) for each in its)]
    needs = [
        need.words
        for need in its[0].needs
        if need.words not in ("frames", "steps") and all(need in each.needs for each in its)
    ]
    green = list(dict.fromkeys(f"{each.threshold.green:g}" for each in its if each.threshold is not None))
    every = "all" if len(of) == len(ANALYSES) else ", ".join(of)
    return (
        ", ".join(headed or [its[0].line.capitalize()]),
        every,
        ", ".join(dict.fromkeys(needs)),
        examines.replace("|", "\\|"),
        ", ".join(green),
    )


if __name__ == "__main__":
    PAGE.write_text(written(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
    sys.stdout.write(f"{PAGE.name}\n")
