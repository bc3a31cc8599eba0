"""Equalities of MJCF as exact constraints: points that are connected, welds, and joints that follow each other.

MuJoCo's own are soft: there a loop opens under load.
"""

from collections.abc import Callable
from typing import Any, Final

import numpy as np

from nivel.exchange.mechanism import Connection, Frame, Mechanism, Terms

CLOSED: Final = 1e-6  # [m, rad] by which a weld may be open where the bodies are placed
EXACT: Final = "equalities are exact constraints, not soft ones"


def read_equalities(
    mj: Any,
    m: Any,
    mechanism: Mechanism,
    joints: dict[int, Connection],
    body: Callable[[int], str],
    lengths: dict[int, tuple[Terms, float]],
) -> None:
    """Add what the active equalities of a compiled model are. lengths : of tendons by number, with a constant part."""
    for e in range(m.neq):
        kind = mj.mjtEq(int(m.eq_type[e])).name.removeprefix("mjEQ_").lower()
        name = m.equality(e).name or f"{kind}_{e}"
        if not m.eq_active0[e]:
            mechanism.notes.leave("equalities that are not active", name)
        elif kind in ("connect", "weld"):
            _attach(mj, m, e, kind, name, mechanism, body)
        elif kind == "joint":
            _follow(m, e, name, mechanism, joints)
        elif kind == "tendon" and _add_sum(m, e, name, mechanism, lengths):
            mechanism.notes.change(EXACT, name)
        else:
            mechanism.notes.leave(f"equalities of type {kind}", name, acts=True)


def _attach(mj: Any, m: Any, e: int, kind: str, name: str, mechanism: Mechanism, body: Callable[[int], str]) -> None:
    ids = int(m.eq_obj1id[e]), int(m.eq_obj2id[e])
    by_sites = int(m.eq_objtype[e]) == int(mj.mjtObj.mjOBJ_SITE)
    owners = [int(m.site_bodyid[each]) if by_sites else each for each in ids]
    links = [body(each) for each in owners]
    places = [mechanism.links[each].place if each else Frame() for each in links]
    numbers = m.eq_data[e]
    if by_sites:
        inside = [Frame(axes_of(mj, m.site_quat[each]), m.site_pos[each].copy()) for each in ids]
    elif kind == "connect":
        inside = [Frame(origin=numbers[0:3].copy()), Frame(origin=numbers[3:6].copy())]
    else:  # the second body seen from the first one
        inside = [Frame(axes_of(mj, numbers[6:10]), numbers[3:6].copy()), Frame()]
    first, second = (place @ each for place, each in zip(places, inside, strict=True))
    gap = float(np.linalg.norm(first.origin - second.origin))
    turn = float(np.abs(first.axes - second.axes).max()) if kind == "weld" else 0.0
    if kind == "connect":
        mechanism.notes.change(EXACT, name)
        open_by = (inside[0], inside[1]) if gap > CLOSED else None
        if open_by is not None:
            mechanism.notes.change("points that are connected come together at the start", f"{name} {gap * 1e3:.3g} mm")
        joint = Connection(name, "spherical", (links[0], links[1]), first.origin, frames=open_by)
        mechanism.connections.append(joint)
        return
    if max(gap, turn) > CLOSED:
        mechanism.notes.leave(f"equalities that are open where the bodies are placed, by {gap:.3g} m", name, acts=True)
        return
    mechanism.notes.change(EXACT, name)
    mechanism.notes.change("bodies that a weld holds together are one body", name)
    mechanism.connections.append(Connection(name, "fixed", (links[0], links[1]), first.origin))


def axes_of(mj: Any, parameters: Any) -> Any:
    """(3, 3) axes of a frame with these Euler parameters."""
    out = np.zeros(9)
    mj.mju_quat2Mat(out, np.asarray(parameters, dtype=float))
    return out.reshape(3, 3)


def _follow(m: Any, e: int, name: str, mechanism: Mechanism, joints: dict[int, Connection]) -> None:
    """q₁ - q₁₀ = a₀ + a₁ (q₂ - q₂₀) + …, with the coordinates of qpos0."""
    joint, other = joints.get(int(m.eq_obj1id[e])), joints.get(int(m.eq_obj2id[e]))
    if joint is None or other is None:
        mechanism.notes.leave("equalities that hold one joint", name, acts=True)
        return
    a = m.eq_data[e][:5]
    if joint.mimic is not None or joint.follows is not None:
        mechanism.notes.leave("the second equality of a joint", name, acts=True)
        return
    mechanism.notes.change(EXACT, name)
    if np.any(a[2:]):
        joint.follows = (other.name, tuple(float(each) for each in a))
        return
    joint.mimic = (other.name, float(a[1]), joint.reference + float(a[0]) - float(a[1]) * other.reference)


def _add_sum(m: Any, e: int, name: str, mechanism: Mechanism, lengths: dict[int, tuple[Terms, float]]) -> bool:
    """l₁ - a₁ l₂ stays as it is; False where that is not what the equality says."""
    a, second = m.eq_data[e][:5], int(m.eq_obj2id[e])
    terms, others = lengths.get(int(m.eq_obj1id[e])), lengths.get(second, ((), 0.0))
    if np.any(a[2:]) or a[0] or terms is None or (second >= 0 and second not in lengths):
        return False
    factors: dict[str, float] = {}
    for joint, factor in (*terms[0], *((joint, -float(a[1]) * factor) for joint, factor in others[0])):
        factors[joint] = factors.get(joint, 0.0) + factor
    mechanism.sums.append((name, tuple((joint, factor) for joint, factor in factors.items() if factor)))
    return True
