"""Checks of all springs: stiffness, table and law stand in place of each other."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from nivel.machine.core.checked import Problem, superfluous

if TYPE_CHECKING:
    from nivel.machine.forces.joint_spring_damper import JointSpringDamper
    from nivel.machine.forces.spring_damper import SpringDamper
    from nivel.machine.forces.torsional_spring_damper import TorsionalSpringDamper


def problems_of_spring(
    spring: SpringDamper | TorsionalSpringDamper | JointSpringDamper, free: str
) -> Iterator[Problem]:
    """What clashes in a spring; `free` is the name of its field for where the spring has no force."""
    if spring.law is not None:
        for name in ("stiffness", "table", "damping", free, "preload"):
            if getattr(spring, name):
                yield superfluous(name, "must not be given with a `law`, which is all that the element does")
        return
    if spring.stiffness is not None and spring.table is not None:
        yield superfluous("table", "stands in place of `stiffness`; give one of them")
    if spring.stiffness is None and spring.table is None:
        if getattr(spring, free):
            yield superfluous(free, "belongs to a `stiffness` or a `table`, and none is given")
        if not spring.damping and not spring.preload:
            message = f"a {spring.type} needs a `stiffness`, a `table`, a `damping`, a `preload` or a `law`"
            yield Problem((), message)
