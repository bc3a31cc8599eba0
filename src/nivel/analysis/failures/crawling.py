"""Runs whose steps shrink to nothing where a function of the motion jumps."""

from __future__ import annotations

from dataclasses import dataclass

from nivel.integrate.loop.run import DONE_STEPS, TAKEN, TIME, Run

# A run is looked at after so many steps. It crawls where they were this much shorter than its longest one, and so many are left at least.
LOOKED_AT, SHORT, LEFT = 10_000, 1e-5, 1e7


@dataclass
class Crawl:
    """Whether a run of this duration [s] makes next to no way any more."""

    duration: float
    steps: int = 0
    time: float = 0.0

    def seen(self, run: Run) -> bool:
        """Called between chunks of steps."""
        steps, time = int(run.counter[DONE_STEPS]), float(run.clock[TIME])
        if steps - self.steps < LOOKED_AT:
            return False
        mean = (time - self.time) / (steps - self.steps)
        self.steps, self.time = steps, time
        return mean < SHORT * float(run.pace[TAKEN].max()) and self.duration - time > LEFT * mean


def jump_advice(jumping: tuple[str, ...]) -> str:
    """What to do about functions that jump."""
    few = " and ".join(jumping[:3])
    return (
        f"{few} {'jumps' if len(jumping) == 1 else 'jump'}: where it brings the motion to rest it turns round in every step. "
        f"Dry friction is a force `type: friction` with `model: stiction`, which stands still. Else let it pass smoothly, "
        f"tanh(v/(1 mm/s)) in place of sign(v), or take a fixed step."
    )
