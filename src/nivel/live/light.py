"""The light of a live run: what its trust report would say if it ended now, as far as that can be told while it goes on.

It looks at the frames that watchers get, once a second, in the process of the server: the solver's loop does nothing for it.
"""

from collections.abc import Iterator
from math import isnan
from typing import Any, Final

import numpy as np

from nivel.integrate.loop.sink import Header
from nivel.judge.after.checks import circuits, energy, joints
from nivel.judge.after.checks.energy import Energy
from nivel.judge.after.checks.joints import Violation
from nivel.judge.after.subject import Motion
from nivel.lazy import Struct, field, replace
from nivel.live.timing import Timing
from nivel.machine.core.vectors import Array
from nivel.results.frames.contents import MemoryContents
from nivel.results.result import Result
from nivel.results.scales import largest_speed, speed_of_rest
from nivel.results.trust import Item, Threshold, Verdict, number, worst
from nivel.system.layout import FrameLayout

REAL_TIME: Final = Threshold(
    1e-2,
    1e-1,
    "Share of the time by which the simulated time was stretched, or of the ticks that take longer to compute than they last. A hundredth "
    "is less than an operator notices; a tenth changes how the machine responds.",
)


class Counts(Struct):
    """What the solver knows of the steps since the start of the motion: the largest kinetic energy [J], and of steps over circuits those
    that were divided, their parts that were not extrapolated, and the largest difference of a pressure in one [Pa]. guards : whether
    these are counted."""

    kinetic_energy: float = 0.0
    guards: bool = False
    divided: int = 0
    guarded: int = 0
    difference: float = 0.0


class Light(Struct):
    """A verdict, and in sentences why it is not green."""

    verdict: Verdict = "green"
    reasons: tuple[str, ...] = ()


class Judge(Struct, frozen=False):
    """Finds the light from frames. layout, attributes : of the run, as a result has them."""

    layout: FrameLayout
    attributes: dict[str, Any]
    _first: Array | None = None  # the frame at the start, from which energies and the time are counted
    _new: list[Array] = field(default_factory=list)
    _worst: tuple[Energy, Violation, Violation] | None = None  # the worst so far: energy, joints and their rates
    _speed: float = 0.0
    _circuits: tuple[Item, ...] = ()

    def begin_again(self) -> None:
        """The machine was put somewhere else: what was found before does not belong to this motion."""
        self._new, self._worst, self._speed, self._circuits = [], None, 0.0, ()

    def take(self, frames: Array) -> None:
        """New frames (n, width)."""
        if self._first is None and len(frames):
            self._first = frames[0].copy()
        self._new.append(frames.copy())

    def light(self, timing: Timing, counts: Counts, steps: int, problem: str = "") -> Light:
        """The light now. steps : done in this motion. problem : why it failed, or empty."""
        if self._new and self._first is not None:
            self._look(np.concatenate([self._first[None], *self._new]), counts.kinetic_energy)
            self._new = []
        items = tuple(self._items(timing, counts, steps, problem))
        order = sorted((each for each in items if each.verdict != "green"), key=lambda each: each.verdict != "red")
        return Light(worst(items), tuple(each.text for each in order))

    def _items(self, timing: Timing, counts: Counts, steps: int, problem: str) -> Iterator[Item]:
        if problem:
            yield Item("outcome", "red", f"Outcome: {problem}")
        if self._worst is not None:
            balance, opening, rates = self._worst
            said = energy.say_balance(balance), joints.say_opening(opening), joints.say_rates(rates)
            yield from (each for each in said if each is not None)
        yield from self._circuits
        if counts.guards and steps:
            yield circuits.say_steps(circuits.Guard(steps, counts.divided, counts.guarded, counts.difference))
        if timing.ticks:
            long, stretched = timing.own / timing.ticks, timing.stretched / (timing.ticks * timing.tick)
            text = (
                f"Real time: {number(100.0 * long)} % of the ticks take longer to compute than {1e3 * timing.tick:g} ms, and the time is "
                f"stretched by {number(100.0 * stretched)} % ({REAL_TIME}); take longer steps, or a simpler model"
            )
            fraction = max(long, stretched)
            yield Item("real time", REAL_TIME.verdict(fraction), text, fraction, REAL_TIME.green, REAL_TIME.amber)

    @np.errstate(over="ignore", invalid="ignore")  # a motion that grows beyond all bounds is red, not a warning
    def _look(self, frames: Array, kinetic_energy: float) -> None:
        """Judge frames, the first of which is that of the start; kinetic_energy : the largest one of steps [J]."""
        result = Result(MemoryContents(Header(self.layout, self.attributes), frames, self.attributes))
        motion = Motion(result=result, outcome="running", kinetic_energy=kinetic_energy)
        found = (
            replace(energy.look_at_balance(motion), force=""),
            joints.look_at_opening(motion),
            joints.look_at_rates(motion),
        )
        self._speed = max(self._speed, largest_speed(result))
        if circuits.CIRCUITS.met(motion):
            balances = (
                circuits.say_energy(circuits.look_at_energy(motion)),
                circuits.say_mass(circuits.look_at_mass(motion)),
            )
            self._circuits = balances
        slowest = speed_of_rest(result, motion.scales.size)
        balance, opening, rates = found if self._worst is None else _worse(self._worst, found)
        scales = replace(rates.scales, speed=max(self._speed, slowest), at_rest=self._speed < slowest)
        self._worst = balance, opening, replace(rates, scales=scales)


def _worse(
    old: tuple[Energy, Violation, Violation], new: tuple[Energy, Violation, Violation]
) -> tuple[Energy, Violation, Violation]:
    """The worst of both, each against the larger scale."""
    balance, now = old[0], new[0]
    if not now.error <= balance.error:
        balance = replace(balance, error=now.error, time=now.time)
    if now.scale > balance.scale:
        balance = replace(balance, scale=now.scale, scale_kind=now.scale_kind)
    opening, rates = (
        after if not before.row or isnan(after.value) or after.value > before.value else before
        for before, after in zip(old[1:], new[1:], strict=True)
    )
    return balance, opening, rates
