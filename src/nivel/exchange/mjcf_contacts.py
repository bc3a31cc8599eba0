"""Contacts of MJCF: pairs of geoms that the masks, parents and exclusions of a compiled model let touch.

MuJoCo's contact is soft in accelerations: (A + R) f = b ẋ + k d r - a₀ with the overlap r, where R = w (1 - d)/d and w is the sum of the
inverse weights of both bodies. Under a steady load f it sinks to r = R f/(k d): a spring of the stiffness k d²/((1 - d) w), whose force
changes with the speed by b d/w. `damping` of a contact is this by the load: g/w, or on the ground the share of one foot in the weight of a
free model, where that is more.
"""

from collections.abc import Callable
from typing import Any, Final

import numpy as np

from nivel.exchange.contacts import FEET
from nivel.exchange.mechanism import Frame, Look, Mechanism, Solid, Touch
from nivel.lazy import replace

FREE: Final = 0  # mjtJoint
BISECTIONS: Final = 60
GRAVITY: Final = 9.81  # m/s²: the load where the model has no weight
CLIP: Final = 1e-4  # impedances are kept by so much from 0 and 1, as in MuJoCo
DEEP: Final = 0.01  # of the size of the model: solids that begin deeper in each other are no parts that touch
INSIDE: Final = "contacts of solids that begin deep inside each other"
MARGINS, DIRECTIONS, REBOUND = "margins of contacts", "friction of contacts by direction", "rebound of contacts"
LITTLE: Final = 0.9  # damping ratio below which more than 5 % of the speed of an impact is left in MuJoCo
WIDENED: Final = "planes are raised, and round solids widened, by the margins of their contacts"
TURNS: Final = "friction of contacts against rolling has a limit of its own, that of MuJoCo shares one with sliding"


def read_contacts(
    mj: Any, d: Any, mechanism: Mechanism, body: Callable[[int], str], look_of: Callable[[int], Look | None], kept: str
) -> None:
    """Add the solids and the pairs that touch, as placed in the data `d`. kept : `all`, or `floor`: what touches the ground alone."""
    m = d.model
    names = _names(m, body)
    mj.mj_comPos(m, d)
    mj.mj_collision(m, d)
    deep = set(map(frozenset, d.contact.geom[d.contact.dist < -DEEP * m.stat.extent].tolist()))
    solids: dict[int, Solid | None] = {}
    summed, skipped = _are_summed(mj), 0
    for first, second, given in _pairs(mj, m):
        moving = all(m.body_weldid[m.geom_bodyid[g]] for g in (first, second))
        if moving and kept == "floor":
            skipped += 1
            continue
        for g in (first, second):
            if g not in solids:
                look = look_of(g)
                solids[g] = None if look is None else Solid(names[g], body(int(m.geom_bodyid[g])), look)
                if look is None:
                    mechanism.notes.leave(f"contacts of geoms of type {kind_of(mj, m, g)}", names[g], acts=True)
        one, two = solids[first], solids[second]
        planes = [each.look.kind for each in (one, two) if each is not None].count("plane")
        if one is None or two is None or planes == 2:
            continue
        if frozenset((first, second)) in deep and not planes:  # out of a plane a model is raised
            mechanism.notes.leave(INSIDE, f"{one.name} and {two.name}", acts=True)
            continue
        margins = m.geom_margin[[first, second]] if given is None else m.pair_margin[[given]]
        margin = float(np.sum(margins) if summed else np.max(margins))
        kinds = [each.look.kind for each in (one, two)]
        wide = next((kind for kind in ("plane", "sphere", "capsule") if kind in kinds), "")
        if margin and wide:
            widened = [_widened(one, margin), two] if kinds[0] == wide else [one, _widened(two, margin)]
            mechanism.notes.change(WIDENED, f"{one.name} and {two.name}")
            one, two = widened
        elif margin:
            mechanism.notes.leave(MARGINS, f"{one.name} and {two.name}", acts=True)
        mechanism.solids |= {one.name: one, two.name: two}
        mechanism.touches.append(_touch(m, first, second, given, (one.name, two.name), mechanism))
    if skipped:
        mechanism.notes.leave(
            f"contacts between bodies that move ({skipped} pairs); `--contacts all` has them", acts=True
        )


def _are_summed(mj: Any) -> bool:
    """Whether the margins of two geoms add up, as in later versions of MuJoCo; in earlier ones the larger one counts."""
    ball = '<body><freejoint/><geom size="1" margin="1"/></body>'
    m = mj.MjModel.from_xml_string(
        f'<mujoco><worldbody><geom type="plane" size="1 1 1" margin="1"/>{ball}</worldbody></mujoco>'
    )
    d = mj.MjData(m)
    mj.mj_forward(m, d)
    return bool(d.contact.includemargin[0] > 1.5)


def _widened(solid: Solid, margin: float) -> Solid:
    """A plane or a round solid whose surface is where what touches it from the distance `margin` [m] on begins to."""
    look = solid.look
    if look.kind == "plane":
        look = replace(look, place=look.place @ Frame(origin=np.array([0.0, 0.0, margin])))
    else:
        look = replace(look, sizes=(look.sizes[0] + margin, *look.sizes[1:]))
    return replace(solid, name=f"{solid.name}_{margin * 1e3:g}mm".replace(".", "_"), look=look)


def kind_of(mj: Any, m: Any, g: int) -> str:
    """The type of a geom in words."""
    return mj.mjtGeom(int(m.geom_type[g])).name.removeprefix("mjGEOM_").lower()


def _names(m: Any, body: Callable[[int], str]) -> list[str]:
    return [m.geom(g).name or f"{body(int(m.geom_bodyid[g])) or 'world'}_geom_{g}" for g in range(m.ngeom)]


def _pairs(mj: Any, m: Any) -> list[tuple[int, int, int | None]]:
    """Geoms that may touch, and the number of the <pair> that gives their numbers."""
    explicit = {tuple(sorted((int(m.pair_geom1[p]), int(m.pair_geom2[p])))): p for p in range(m.npair)}
    out: list[tuple[int, int, int | None]] = [(first, second, p) for (first, second), p in explicit.items()]
    excluded = {int(each) for each in m.exclude_signature}
    parents = not m.opt.disableflags & int(mj.mjtDisableBit.mjDSBL_FILTERPARENT)
    weld = [int(m.body_weldid[b]) for b in m.geom_bodyid]
    above = [int(m.body_weldid[m.body_parentid[w]]) for w in weld]
    touching = [g for g in range(m.ngeom) if m.geom_contype[g] or m.geom_conaffinity[g]]
    for k, i in enumerate(touching):
        for j in touching[k + 1 :]:
            if (i, j) in explicit or weld[i] == weld[j]:
                continue
            if not (m.geom_contype[i] & m.geom_conaffinity[j] or m.geom_contype[j] & m.geom_conaffinity[i]):
                continue
            if not m.body_invweight0[m.geom_bodyid[i]][0] + m.body_invweight0[m.geom_bodyid[j]][0] > 0.0:
                continue  # neither moves
            if parents and weld[i] and weld[j] and (weld[i] == above[j] or weld[j] == above[i]):
                continue
            low, high = sorted((int(m.geom_bodyid[i]), int(m.geom_bodyid[j])))
            if (low << 16) + high in excluded:
                continue
            out.append((i, j, None))
    return out


def _touch(m: Any, i: int, j: int, pair: int | None, names: tuple[str, str], mechanism: Mechanism) -> Touch:
    if pair is not None:
        friction, turning = m.pair_friction[pair], m.pair_friction[pair][2:]
        ref, imp, condim = m.pair_solref[pair], m.pair_solimp[pair], int(m.pair_dim[pair])
    elif m.geom_priority[i] != m.geom_priority[j]:
        g = i if m.geom_priority[i] > m.geom_priority[j] else j
        friction, turning = m.geom_friction[g], m.geom_friction[g][1:]
        ref, imp, condim = m.geom_solref[g], m.geom_solimp[g], int(m.geom_condim[g])
    else:
        friction = np.maximum(m.geom_friction[i], m.geom_friction[j])
        turning, condim = friction[1:], int(max(m.geom_condim[i], m.geom_condim[j]))
        one, two = float(m.geom_solmix[i]), float(m.geom_solmix[j])
        share = one / (one + two) if one + two > 0.0 else 0.5
        ref, other = m.geom_solref[i], m.geom_solref[j]
        mixed = ref[0] > 0.0 and other[0] > 0.0
        ref = share * ref + (1.0 - share) * other if mixed else np.minimum(ref, other)
        imp = share * m.geom_solimp[i] + (1.0 - share) * m.geom_solimp[j]
    slide = float(friction[0]) if condim > 1 else 0.0
    spin, roll = float(turning[0]) * (condim > 3), float(turning[1]) * (condim > 4)
    if roll:
        mechanism.notes.change(TURNS, " and ".join(names))
    if pair is not None and condim > 1 and friction[0] != friction[1]:
        mechanism.notes.leave(DIRECTIONS, " and ".join(names), acts=True)
    # in an impact the solids vibrate with r'' = -d (b r' + k r), d the impedance of deep ones
    (k, b), d = _law(ref, float(imp[1]), float(m.opt.timestep)), float(imp[1])
    if b * np.sqrt(d) < 2.0 * LITTLE * np.sqrt(k):
        mechanism.notes.leave(REBOUND, " and ".join(names), acts=True)
    w = sum(float(m.body_invweight0[m.geom_bodyid[g]][0]) for g in (i, j))
    gravity = float(np.linalg.norm(m.opt.gravity)) or GRAVITY
    weight = max(gravity, w * _load(m, (i, j)) * gravity)
    stiffness, damping = _softness(ref, imp, w, float(m.opt.timestep), weight)
    return Touch(*names, slide, stiffness, damping, spin, roll)


def _load(m: Any, geoms: tuple[int, int]) -> float:
    """[kg] what one foot of a free model carries where one of these stands still; else nothing."""
    bodies = [int(m.geom_bodyid[g]) for g in geoms if m.body_weldid[m.geom_bodyid[g]]]
    root = int(m.body_rootid[bodies[0]]) if len(bodies) == 1 else 0
    free = m.body_jntnum[root] > 0 and m.jnt_type[m.body_jntadr[root]] == FREE
    return float(m.body_subtreemass[root]) / FEET if free else 0.0


def hardness(ref: Any, imp: Any, w: float, step: float) -> float:
    """Stiffness [N/m or N m/rad] of a limit whose impedance is at its end, as it is under any load that sinks beyond its width."""
    d = min(max(float(imp[1]), CLIP), 1.0 - CLIP)
    return _law(ref, d, step)[0] * d * d / ((1.0 - d) * w) if w > 0.0 else 0.0


def _law(ref: Any, most: float, step: float) -> tuple[float, float]:
    """(k [1/s²], b [1/s]) of a reference."""
    if ref[0] > 0.0:
        time = max(float(ref[0]), 2.0 * step)
        return 1.0 / (most * time * float(ref[1])) ** 2, 2.0 / (most * time)
    return -float(ref[0]) / most**2, -float(ref[1]) / most


def _softness(ref: Any, imp: Any, w: float, step: float, gravity: float) -> tuple[float, float]:
    """Stiffness [N/m] and damping [s/m] under the load `gravity`/w."""
    least, most, middle = (min(max(float(imp[k]), CLIP), 1.0 - CLIP) for k in (0, 1, 3))
    width, power = float(imp[2]), max(float(imp[4]), 1.0)
    k, b = _law(ref, most, step)
    low, high = 0.0, (1.0 - least) * gravity / (k * least * least)
    d = least
    for _ in range(BISECTIONS):  # the overlap r at which k d² r/(1 - d) is the load
        r = 0.5 * (low + high)
        x = min(r / width, 1.0) if width > 0.0 else 1.0
        rise = (
            x**power / middle ** (power - 1.0)
            if x <= middle
            else 1.0 - (1.0 - x) ** power / (1.0 - middle) ** (power - 1.0)
        )
        d = least + (most - least) * rise
        low, high = (r, high) if k * d * d * r < (1.0 - d) * gravity else (low, r)
    return k * d * d / ((1.0 - d) * w), b * d / gravity
