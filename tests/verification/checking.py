"""What a machine is, as its own settings would run it."""

from nivel.analysis.plan.plan import plan_run
from nivel.judge.before import check as of_plans


def check(machine):
    """The facts of a machine."""
    return of_plans.check(plan_run(machine))
