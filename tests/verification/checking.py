"""What a machine is, as its own settings would run it."""

from nivel.analysis.check import check as of_plans
from nivel.analysis.plan.plan import plan_run


def check(machine):
    """The facts of a machine."""
    return of_plans.check(plan_run(machine))
