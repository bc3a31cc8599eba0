"""Equalities and tendons of MJCF.

Equalities are exact constraints here: points that are connected, welds, and joints that follow each other. MuJoCo's own are soft: there a
loop opens under load. Tendons are lengths of joints, or ways along sites and around cylinders and spheres, with pulleys.

A way along sites is a sum of measured distances, each divided as pulleys say, on which springs, limits and actuators act as on joints. One
around wheels, or with nothing but an upper limit, is a rope, which pulls and never pushes.
"""

from collections.abc import Callable
from typing import Any, Final

import numpy as np

from nivel.exchange.mechanism import Array, Connection, Frame, Mechanism, Rope, Span, Tendon, Terms

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


JOINT, PULLEY, SITE, SPHERE, CYLINDER = 1, 2, 3, 4, 5  # mjtWrap
PARALLEL: Final = 1e-6  # sine of the angle between axes of wheels
ROPES: Final = "tendons around wheels, and those that only have an upper limit, are ropes: they never push"
SPANS: Final = "tendons along sites are measured distances, on which motors act"
PLANE: Final = "turning of the plane of tendons around spheres: the sphere is a wheel in that of the start"


def terms_of(m: Any, tendon: int, joints: dict[int, Connection]) -> Terms | None:
    """Joints and factors of a fixed tendon; None of one that goes through space, or over joints without one coordinate."""
    out = []
    for w in range(m.tendon_adr[tendon], m.tendon_adr[tendon] + m.tendon_num[tendon]):
        joint = joints.get(int(m.wrap_objid[w])) if m.wrap_type[w] == JOINT else None
        if joint is None or not joint.coordinate:
            return None
        out.append((joint.name, float(m.wrap_prm[w])))
    return tuple(out)


class Tendons:
    """The tendons of a compiled model; `d` holds its kinematics. terms : of those that are lengths, with a constant part [m], by number."""

    def __init__(
        self, m: Any, d: Any, mechanism: Mechanism, joints: dict[int, Connection], body: Callable[[int], str]
    ) -> None:
        self.m, self.d, self.mechanism, self.joints, self.body = m, d, mechanism, joints, body
        self.terms: dict[int, tuple[Terms, float]] = {}

    def read(self, off: set[str], pulled: set[int]) -> None:
        """Add all of them. off : what the model switches off. pulled : tendons on which actuators act."""
        for t in range(self.m.ntendon):
            self._tendon(t, off, t in pulled)

    def _tendon(self, t: int, off: set[str], pulled: bool) -> None:
        m, notes = self.m, self.mechanism.notes
        name = m.tendon(t).name or f"tendon_{t}"
        tendon = Tendon(name, ())
        if "springs" not in off:
            tendon.stiffness = float(m.tendon_stiffness[t])
            tendon.free = (float(m.tendon_lengthspring[t, 0]), float(m.tendon_lengthspring[t, 1]))
        if "dampers" not in off:
            tendon.damping = float(m.tendon_damping[t])
        if "limits" not in off and m.tendon_limited[t]:
            tendon.ends = (float(m.tendon_range[t, 0]), float(m.tendon_range[t, 1]))
        for value, what in ((m.tendon_frictionloss[t], "friction"), (m.tendon_armature[t], "armature")):
            if value:
                notes.leave(f"{what} of tendons", name, acts=True)
        places = range(m.tendon_adr[t], m.tendon_adr[t] + m.tendon_num[t])
        kinds = {int(m.wrap_type[w]) for w in places}
        if JOINT in kinds:
            terms = terms_of(m, t, self.joints)
            if terms is None:
                notes.leave("tendons of joints with other coordinates than one", name, acts=True)
                return
            self.terms[t] = (terms, 0.0)
        elif kinds <= {SITE, PULLEY} and (pulled or PULLEY in kinds or not _only_above(tendon)):
            self.terms[t] = self._spans(places, name)
            notes.change(SPANS, name)
        else:
            self._ropes(places, tendon, pulled)
            return
        tendon.terms, constant = self.terms[t]
        tendon.free = (tendon.free[0] - constant, tendon.free[1] - constant)
        tendon.ends = tendon.ends and (tendon.ends[0] - constant, tendon.ends[1] - constant)
        self.mechanism.tendons.append(tendon)

    def _site(self, s: int) -> tuple[str, Array]:
        return self.body(int(self.m.site_bodyid[s])), np.array(self.m.site_pos[s], dtype=float)

    def _spans(self, places: range, name: str) -> tuple[Terms, float]:
        """Distances between sites that follow each other, with their factors, and what is the same all the time."""
        out, constant, divisor, before = [], 0.0, 1.0, None
        for w in places:
            if self.m.wrap_type[w] == PULLEY:
                divisor, before = float(self.m.wrap_prm[w]), None
                continue
            site = int(self.m.wrap_objid[w])
            if before is not None:
                ends = self._site(before), self._site(site)
                far = self.d.site_xpos[before] - self.d.site_xpos[site]
                if ends[0][0] == ends[1][0]:
                    constant += float(np.linalg.norm(far)) / divisor
                else:
                    span = Span(f"{name}_{len(out) + 1}", (ends[0], ends[1]))
                    self.mechanism.spans.append(span)
                    out.append((span.name, 1.0 / divisor))
            before = site
        return tuple(out), constant

    def _ropes(self, places: range, tendon: Tendon, pulled: bool) -> None:
        """A rope for the spring, one for the upper limit."""
        m, notes, name = self.m, self.mechanism.notes, tendon.name
        way: list[tuple[str, Array, float]] = []
        axes: list[Array] = []
        seen = [self._global(w) for w in places]
        if any(m.wrap_type[w] == PULLEY for w in places) or pulled:
            notes.leave("tendons around wheels with pulleys or actuators", name, acts=True)
            return
        for k, w in enumerate(places):
            kind, number_of = int(m.wrap_type[w]), int(m.wrap_objid[w])
            if kind == SITE:
                way.append((*self._site(number_of), 0.0))
                continue
            centre, before, behind = seen[k], seen[k - 1], seen[k + 1]
            side = int(m.wrap_prm[w])
            along = (behind - before) / np.linalg.norm(behind - before)
            at = self.d.site_xpos[side] if side >= 0 else before + along * float((centre - before) @ along)
            passed = at - centre
            if kind == SPHERE:
                notes.leave(PLANE, name, acts=True)
            axis = np.cross(passed, along) if kind == SPHERE else self.d.geom_xmat[number_of].reshape(3, 3)[:, 2]
            if not np.linalg.norm(axis):
                notes.leave("tendons through the middle of a sphere", name, acts=True)
                return
            axes.append(axis / np.linalg.norm(axis))
            if np.linalg.norm(np.cross(axes[0], axes[-1])) > PARALLEL:
                notes.leave("tendons around wheels whose axes are not parallel", name, acts=True)
                return
            radius = float(m.geom_size[number_of, 0])
            if side >= 0 and np.linalg.norm(np.cross(passed, axes[-1])) < radius:
                notes.leave("tendons that wrap around the inside of a wheel", name, acts=True)
                return
            sign = 1.0 if float(np.cross(passed, along) @ axes[0]) >= 0.0 else -1.0
            way.append((self.body(int(m.geom_bodyid[number_of])), m.geom_pos[number_of].copy(), sign * radius))
        parts = [("", tendon.stiffness, tendon.damping, tendon.free[1])] if tendon.stiffness else []
        parts += [("_end", 0.0, 0.0, tendon.ends[1])] if tendon.ends is not None else []
        for suffix, stiffness, damping, length in parts:
            self.mechanism.ropes.append(Rope(name + suffix, way, axes[0] if axes else None, length, stiffness, damping))
        notes.change(ROPES, name)

    def _global(self, w: int) -> Array:
        places = self.d.site_xpos if self.m.wrap_type[w] == SITE else self.d.geom_xpos
        return places[int(self.m.wrap_objid[w])]


def _only_above(tendon: Tendon) -> bool:
    """Whether it has an upper limit, or a spring that is slack from zero on, and nothing else."""
    slack = not tendon.stiffness or tendon.free[0] <= 0.0 < tendon.free[1]
    return slack and not (tendon.damping and not tendon.stiffness) and (tendon.ends is None or tendon.ends[0] <= 0.0)
