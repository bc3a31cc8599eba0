"""Magic Formula of tyres, versions 5.2 and 6.1: the numbers of a `.tir` file, and forces and moments of slips.

Pacejka 2012, 4.3.2 (equations 4.E1 to 4.E78), in the axes W of ISO 8855 as the files are: x forwards, y to the left, z up; κ > 0 drives,
α > 0 moves to the left and has F_y < 0, γ > 0 leans to the right. Version 5.2 is the same with α and γ in place of tan α and sin γ, with
PHY3 in place of PKY6 and PKY7, and with F_y - S_Vyκ on the trail in place of the force without camber. Where the book and the programs
that made the files differ, the programs are followed: the trail has 1 + QBZ4 γ + QBZ5 |γ| and 1 + QDZ3 γ + QDZ4 γ² (Besselink, Schmeitz,
Pacejka 2010, A58 and A60). Left out: turn slip (a patch that turns has the bore friction of `tyre`), and a radius that grows with speed.

Scaling factors and pressure do not change within a run: they are put into the coefficients, and so is what differs between versions.
"""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Literal

import numpy as np

from nivel.elements.rows import Row, several
from nivel.kernels.algebra.analytic import absolute, maximum, minimum, real
from nivel.machine.core.record import Checked, Problem
from nivel.machine.given import Field, Given
from nivel.native.function import leaf

SIZES = (
    "FITTYP", "FNOMIN", "UNLOADED_RADIUS", "LONGVL", "WIDTH", "VERTICAL_STIFFNESS", "VERTICAL_DAMPING", "LONGITUDINAL_STIFFNESS",
    "LATERAL_STIFFNESS", "INFLPRES", "NOMPRES", "BREFF", "DREFF", "FREFF", "PFZ1", "PTX1", "PTX2", "PTX3", "PTY1", "PTY2",
)  # fmt: skip
SCALES = (
    "LFZO", "LCX", "LMUX", "LEX", "LKX", "LHX", "LVX", "LXAL", "LCY", "LMUY", "LEY", "LKY", "LHY", "LVY", "LYKA", "LVYKA",
    "LKYC", "LTR", "LRES", "LKZC", "LS", "LVMX", "LMX", "LMY",
)  # fmt: skip
POSITIVE = ("FNOMIN", "UNLOADED_RADIUS", "PCX1", "PDX1", "PKX1", "PCY1", "PDY1", "PKY2")
DIVIDE = ("LFZO", "LCX", "LMUX", "LKX", "LCY", "LMUY", "LKY")
DECAY = 10.0  # of the shifts with friction in version 6.1 (A_µ, 4.E8)
MOST_SLIP = 1.5  # beyond which a patch counts as one that slides along its velocity, so that no speed divides
LEAST_WEIGHT = 0.05  # of combined slip in the rate at which a force follows; the force itself has all of it


class MagicFormula(Checked):
    """The numbers of a `.tir` file, in SI units."""

    version: Literal["5.2", "6.1"] = Field("of the formula")
    side: Literal["left", "right"] = Field("of the vehicle, for which the numbers are", default="left")
    coefficients: Given[dict[str, float], dict[str, float], Mapping[str, float]] = Field(
        "by the names of the file, in SI units; others than those of the formula are kept and not used"
    )

    def problems(self) -> Iterator[Problem]:
        yield from (Problem(("coefficients",), f"`{key}`: {text}") for key, text in faults_of(self.coefficients))

    @property
    def unused(self) -> list[str]:
        """Keys of the file that change nothing here."""
        of_formula = (f"{name}{k + 1}".upper() for name, n in Magic.several.items() for k in range(n))
        known = {*SIZES, *SCALES, *of_formula}
        return [key for key in self.coefficients if key not in known]

    @property
    def nominal_pressure(self) -> float:
        """For which the numbers are [Pa]; 0 where they are for any."""
        return self.get("NOMPRES") if self.version == "6.1" else 0.0

    def get(self, key: str, absent: float = 0.0) -> float:
        """A number of the file."""
        return self.coefficients.get(key, absent)

    def rolling_share(self) -> float | None:
        """Of the deflection that the rolling radius does not follow: r_e = R - ρ (D atan B + F) under the nominal load."""
        if not {"BREFF", "DREFF", "FREFF"} <= self.coefficients.keys():
            return None
        return max(1.0 - self.get("DREFF") * float(np.arctan(self.get("BREFF"))) - self.get("FREFF"), 0.0)

    def stiffness(self) -> float | None:
        """Of the tyre, vertical [N/m]."""
        return self.coefficients.get("VERTICAL_STIFFNESS")

    def carcass(self) -> tuple[float | None, float | None]:
        """Stiffness along and across [N/m]: of the file, or slope over relaxation length at the nominal load (version 5.2)."""
        load, radius = self.get("FNOMIN"), self.get("UNLOADED_RADIUS")
        along, across = self.get("PTX1") * radius, self.get("PTY1") * radius
        if across:
            across *= float(np.sin(2.0 * np.arctan(1.0 / (self.get("PTY2") or 1.0))))
        lateral = abs(self.get("PKY1")) * float(np.sin(self.get("PKY4", 2.0) * np.arctan(1.0 / self.get("PKY2", 1.0))))
        guessed = [load * k / s if s > 0.0 else None for k, s in ((self.get("PKX1"), along), (lateral, across))]
        given = self.coefficients
        return given.get("LONGITUDINAL_STIFFNESS", guessed[0]), given.get("LATERAL_STIFFNESS", guessed[1])


def faults_of(given: Mapping[str, float]) -> Iterator[tuple[str, str]]:
    """Key of a file and what is wrong with its number."""
    for key in (*POSITIVE, *DIVIDE):
        if key not in given and key in POSITIVE:
            yield key, "it is missing, and without it there is no formula"
        elif not given.get(key, 1.0) > 0.0:
            yield key, f"a positive number was expected, got {given[key]:g}"
    if not given.get("PKY1", 0.0) < 0.0:
        got = f", got {given.get('PKY1', 0.0):g}"
        yield (
            "PKY1",
            f"a negative number was expected, as the lateral force is against the slip in the axes of these files{got}",
        )
    for key, value in given.items():
        if not np.isfinite(value):
            yield key, f"a finite number was expected, got {value:g}"


class Magic(Row):
    """Coefficients, by the names of files without their numbers; `sign` is -1 for a tyre in the mirror, `newer` is 1 for version 6.1."""

    load: float
    scaled_load: float
    radius: float
    speed: float
    sign: float
    newer: float
    pressed: float  # share that pressure adds to the vertical stiffness
    pcx: Sequence[float] = several(1)
    pdx: Sequence[float] = several(3)
    pex: Sequence[float] = several(4)
    pkx: Sequence[float] = several(3)
    phx: Sequence[float] = several(2)
    pvx: Sequence[float] = several(2)
    rbx: Sequence[float] = several(3)
    rcx: Sequence[float] = several(1)
    rex: Sequence[float] = several(2)
    rhx: Sequence[float] = several(1)
    pcy: Sequence[float] = several(1)
    pdy: Sequence[float] = several(3)
    pey: Sequence[float] = several(5)
    pky: Sequence[float] = several(7)
    phy: Sequence[float] = several(3)
    pvy: Sequence[float] = several(4)
    rby: Sequence[float] = several(4)
    rcy: Sequence[float] = several(1)
    rey: Sequence[float] = several(2)
    rhy: Sequence[float] = several(2)
    rvy: Sequence[float] = several(6)
    qbz: Sequence[float] = several(10)
    qcz: Sequence[float] = several(1)
    qdz: Sequence[float] = several(11)
    qez: Sequence[float] = several(5)
    qhz: Sequence[float] = several(4)
    ssz: Sequence[float] = several(4)
    qsx: Sequence[float] = several(14)
    qsy: Sequence[float] = several(8)
    ppx: Sequence[float] = several(4)
    ppy: Sequence[float] = several(5)
    ppz: Sequence[float] = several(2)
    ppmx: Sequence[float] = several(1)


def numbers_of(formula: MagicFormula, pressure: float | None, side: str | None) -> list[float]:
    """The row of `Magic` of a tyre under a pressure [Pa] on a side of the vehicle, or on that of its file."""
    usual = {"PKY4": 2.0, "QSY7": 1.0}
    n: dict[str, Any] = {
        name: np.array(
            [formula.get(key, usual.get(key, 0.0)) for key in (f"{name}{k + 1}".upper() for k in range(count))]
        )
        for name, count in Magic.several.items()
    }
    scale = {key: formula.get(key, 1.0) for key in SCALES}
    newer, nominal = formula.version == "6.1", formula.nominal_pressure
    actual = formula.get("INFLPRES", nominal) if pressure is None else pressure
    dpi = (actual - nominal) / nominal if nominal and actual else 0.0
    ppx, ppy, ppz = n["ppx"], n["ppy"], n["ppz"]
    # friction scales peaks, and by less the shifts that go with it (4.E8); stiffness is by `LK`
    mu = scale["LMUX"], scale["LMUY"]
    shifts = [DECAY * each / (1.0 + (DECAY - 1.0) * each) for each in mu] if newer else mu
    factors: list[tuple[str, slice | int, float]] = [
        ("pcx", 0, scale["LCX"]), ("pdx", slice(0, 2), mu[0] * (1.0 + ppx[2] * dpi + ppx[3] * dpi**2)), ("pex", slice(0, 3), scale["LEX"]),
        ("pkx", slice(0, 2), scale["LKX"] * (1.0 + ppx[0] * dpi + ppx[1] * dpi**2)), ("phx", slice(0, 2), scale["LHX"]),
        ("pvx", slice(0, 2), scale["LVX"] * shifts[0]), ("rbx", 0, scale["LXAL"]), ("rbx", 2, scale["LXAL"]),
        ("pcy", 0, scale["LCY"]), ("pdy", slice(0, 2), mu[1] * (1.0 + ppy[2] * dpi + ppy[3] * dpi**2)), ("pey", slice(0, 2), scale["LEY"]),
        ("pky", 0, scale["LKY"] * (1.0 + ppy[0] * dpi)), ("pky", 1, 1.0 + ppy[1] * dpi), ("pky", 4, 1.0 + ppy[1] * dpi),
        ("pky", slice(5, 7), scale["LKYC"] * (1.0 + ppy[4] * dpi) * newer), ("phy", slice(0, 2), scale["LHY"]),
        ("phy", 2, scale["LKYC"] * (not newer)), ("pvy", slice(0, 2), scale["LVY"] * shifts[1]),
        ("pvy", slice(2, 4), scale["LKYC"] * shifts[1]),
        ("rby", 0, scale["LYKA"]), ("rby", 3, scale["LYKA"]), ("rvy", slice(0, 3), scale["LVYKA"]),
        ("qbz", slice(0, 3), scale["LKY"] / mu[1]), ("qbz", 8, scale["LKY"] / mu[1]),
        ("qdz", slice(0, 2), scale["LTR"] * (1.0 - ppz[0] * dpi)),
        ("qdz", slice(5, 7), scale["LRES"] * mu[1]), ("qdz", slice(7, 9), scale["LKZC"] * mu[1] * (1.0 + ppz[1] * dpi)),
        ("qdz", slice(9, 11), scale["LKZC"] * mu[1] * newer), ("ssz", slice(0, 4), scale["LS"]),
        ("qsx", 0, scale["LVMX"] * scale["LMX"]), ("qsx", 1, scale["LMX"] * (1.0 + n["ppmx"][0] * dpi)), ("qsx", slice(2, 4), scale["LMX"]),
        ("qsx", 9, scale["LMX"]), ("qsx", slice(11, 14), scale["LMX"]),
    ]  # fmt: skip
    for name, places, factor in factors:
        n[name][places] *= factor
    rolling = n["qsy"]
    if not newer:
        rolling[4:] = 0.0, 0.0, 1.0, 0.0
        if not rolling[:2].any():  # then it is the force of rolling freely
            rolling[0] = max(-n["pvx"][0] - n["pkx"][0] * n["phx"][0], 0.0)
    rolling[:6] *= scale["LMY"] * (1.0 + dpi) ** rolling[7]
    load = formula.get("FNOMIN")
    sign = -1.0 if side not in (None, formula.side) else 1.0
    return Magic(
        load=load,
        scaled_load=load * scale["LFZO"],
        radius=formula.get("UNLOADED_RADIUS"),
        speed=formula.get("LONGVL", 16.7),
        sign=sign,
        newer=float(newer),
        pressed=formula.get("PFZ1") * dpi,
        **{name: each.tolist() for name, each in n.items()},
    ).numbers


@leaf
def bent(x, e):
    """x - E (x - atan x)."""
    return x - e * (x - np.arctan(x))


@leaf
def weight(x, shift, b, c, e):
    """Of combined slip: cos(C atan(…)) at x + S_H over that at S_H."""
    return np.cos(c * np.arctan(bent(b * (x + shift), e))) / np.cos(c * np.arctan(bent(b * shift, e)))


@leaf
def sine(x, slope, c, d, e):
    """(D sin(C atan(…)) at x, the same over x, at the most slip) of a curve of this slope."""
    b = slope / (c * d)
    force = d * np.sin(c * np.arctan(bent(b * x, e)))
    most = d * np.sin(c * np.arctan(bent(b * MOST_SLIP, e)))
    return force, slope if real(absolute(x)) < 1e-9 else force / x, absolute(most)


@leaf
def lateral(p, load, df, a, camber, grip):
    """(sine, over slip, at the most slip, S_V, K, D, B C) of the lateral force alone at slip and camber of a version (4.E19 to 4.E30)."""
    ratio = load / p[Magic.SCALED_LOAD]
    k = p[Magic.PKY] * p[Magic.SCALED_LOAD] * (1.0 - p[Magic.PKY + 2] * absolute(camber))
    k *= np.sin(p[Magic.PKY + 3] * np.arctan(ratio / (p[Magic.PKY + 1] + p[Magic.PKY + 4] * camber * camber)))
    k = minimum(k, 1e-3 * p[Magic.PKY] * load)
    leans = load * (p[Magic.PVY + 2] + p[Magic.PVY + 3] * df) * camber * grip
    shift = p[Magic.PHY] + p[Magic.PHY + 1] * df + p[Magic.PHY + 2] * camber
    shift += p[Magic.NEWER] * (load * (p[Magic.PKY + 5] + p[Magic.PKY + 6] * df) * camber - leans) / k
    up = load * (p[Magic.PVY] + p[Magic.PVY + 1] * df) * grip + leans
    d = (
        maximum((p[Magic.PDY] + p[Magic.PDY + 1] * df) * (1.0 - p[Magic.PDY + 2] * camber * camber), 0.01 + 0.0 * load)
        * grip
        * load
    )
    x = a + shift
    side = 1.0 if real(x) >= 0.0 else -1.0
    e = (p[Magic.PEY] + p[Magic.PEY + 1] * df) * (
        1.0 + p[Magic.PEY + 4] * camber * camber - (p[Magic.PEY + 2] + p[Magic.PEY + 3] * camber) * side
    )
    force, secant, most = sine(x, k, p[Magic.PCY], d, minimum(e, 1.0 + 0.0 * e))
    return force, secant, most, up, shift + up / k, k, d


@leaf
def magic(p, load, kappa, tangent, tilt, grip):
    """Forces of slips κ and tan α at camber of this sine, for a tyre that is not in the mirror and rolls forwards.

    returns (along, across, moments); each of the first two is (F, K, most slip's F, D, F/slip without shifts), the last one
    (F_y that is not on the trail, trail t, M_zr): M_z = -t (F_y - …) + M_zr + s F_x.
    """
    df = load / p[Magic.SCALED_LOAD] - 1.0
    alpha, cosine = np.arctan(tangent), 1.0 / np.sqrt(1.0 + tangent * tangent)
    a, camber = tangent, tilt
    if p[Magic.NEWER] == 0.0:
        a, camber = alpha, np.arcsin(tilt)
    # along (4.E9 to 4.E18, 4.E50 to 4.E57)
    k = load * (p[Magic.PKX] + p[Magic.PKX + 1] * df) * np.exp(p[Magic.PKX + 2] * df)
    k = maximum(k, 1e-3 * p[Magic.PKX] * load)
    d = (
        maximum((p[Magic.PDX] + p[Magic.PDX + 1] * df) * (1.0 - p[Magic.PDX + 2] * camber * camber), 0.01 + 0.0 * load)
        * grip
        * load
    )
    x = kappa + p[Magic.PHX] + p[Magic.PHX + 1] * df
    side = 1.0 if real(x) >= 0.0 else -1.0
    e = (p[Magic.PEX] + p[Magic.PEX + 1] * df + p[Magic.PEX + 2] * df * df) * (1.0 - p[Magic.PEX + 3] * side)
    force, secant, most = sine(x, k, p[Magic.PCX], d, minimum(e, 1.0 + 0.0 * e))
    b = (p[Magic.RBX] + p[Magic.RBX + 2] * camber * camber) * np.cos(np.arctan(p[Magic.RBX + 1] * kappa))
    e = minimum(p[Magic.REX] + p[Magic.REX + 1] * df, 1.0 + 0.0 * df)
    g = weight(a, p[Magic.RHX], b, p[Magic.RCX], e)
    fx = g * (force + load * (p[Magic.PVX] + p[Magic.PVX + 1] * df) * grip)
    along = fx, k, most, d, maximum(g, LEAST_WEIGHT + 0.0 * g) * secant
    # across (4.E58 to 4.E67)
    force, secant, most, up, shift, ky, d = lateral(p, load, df, a, camber, grip)
    b = (p[Magic.RBY] + p[Magic.RBY + 3] * camber * camber) * np.cos(
        np.arctan(p[Magic.RBY + 1] * (a - p[Magic.RBY + 2]))
    )
    e = minimum(p[Magic.REY] + p[Magic.REY + 1] * df, 1.0 + 0.0 * df)
    g = weight(kappa, p[Magic.RHY] + p[Magic.RHY + 1] * df, b, p[Magic.RCY], e)
    beside = (
        d * (p[Magic.RVY] + p[Magic.RVY + 1] * df + p[Magic.RVY + 2] * camber) * np.cos(np.arctan(p[Magic.RVY + 3] * a))
    )
    beside *= np.sin(p[Magic.RVY + 4] * np.arctan(p[Magic.RVY + 5] * kappa))
    fy = g * (force + up) + beside
    turned = a / tangent if real(absolute(tangent)) > 1e-9 else 1.0 + 0.0 * tangent
    across = fy, -ky, most, d, -maximum(g, LEAST_WEIGHT + 0.0 * g) * secant * turned
    # moment (4.E31 to 4.E49, 4.E71 to 4.E78)
    if p[Magic.NEWER] == 1.0:
        plain = lateral(p, load, df, a, 0.0 * camber, grip)
        beside = fy - g * (plain[0] + plain[3])
    shape = p[Magic.QBZ] + p[Magic.QBZ + 1] * df + p[Magic.QBZ + 2] * df * df
    shape *= (1.0 + p[Magic.QBZ + 3] * camber + p[Magic.QBZ + 4] * absolute(camber)) / grip
    behind = load / p[Magic.LOAD] * p[Magic.RADIUS] * (p[Magic.QDZ] + p[Magic.QDZ + 1] * df)
    behind *= 1.0 + p[Magic.QDZ + 2] * camber + p[Magic.QDZ + 3] * camber * camber
    at = a + p[Magic.QHZ] + p[Magic.QHZ + 1] * df + (p[Magic.QHZ + 2] + p[Magic.QHZ + 3] * df) * camber
    e = p[Magic.QEZ] + p[Magic.QEZ + 1] * df + p[Magic.QEZ + 2] * df * df
    e *= 1.0 + (p[Magic.QEZ + 3] + p[Magic.QEZ + 4] * camber) * 2.0 / np.pi * np.arctan(shape * p[Magic.QCZ] * at)
    along_too = k / ky * kappa
    trailing, rest = shape * equivalent(at, along_too), equivalent(a + shift, along_too)
    trail = behind * np.cos(p[Magic.QCZ] * np.arctan(bent(trailing, minimum(e, 1.0 + 0.0 * e)))) * cosine
    left = (p[Magic.QDZ + 5] + p[Magic.QDZ + 6] * df) + (
        p[Magic.QDZ + 7] + p[Magic.QDZ + 8] * df + (p[Magic.QDZ + 9] + p[Magic.QDZ + 10] * df) * absolute(camber)
    ) * camber
    narrow = p[Magic.QBZ + 8] / grip + p[Magic.QBZ + 9] * ky / d
    left *= load * p[Magic.RADIUS] * grip * cosine * np.cos(np.arctan(narrow * rest))
    return along, across, (beside, trail, left)


@leaf
def equivalent(a, along):
    """The slip angle that has the effect of both slips (A54): of tan α and K_x/K_y κ, with the sign of α."""
    tangent = np.tan(a)
    size = np.arctan(np.sqrt(tangent * tangent + along * along)) if real(along) != 0.0 else absolute(a)
    return size if real(a) >= 0.0 else -size


@leaf
def lever(p, load, fy, tilt):
    """[m] to the side at which F_x acts (4.E76)."""
    df = load / p[Magic.SCALED_LOAD] - 1.0
    camber = np.arcsin(tilt)
    return p[Magic.RADIUS] * (
        p[Magic.SSZ] + p[Magic.SSZ + 1] * fy / p[Magic.LOAD] + (p[Magic.SSZ + 2] + p[Magic.SSZ + 3] * df) * camber
    )


@leaf
def overturning(p, load, fy, tilt):
    """M_x (4.E69)."""
    q, y, g = load / p[Magic.LOAD], fy / p[Magic.LOAD], np.arcsin(tilt)
    squared = p[Magic.QSX + 5] * q
    m = p[Magic.QSX] - p[Magic.QSX + 1] * g + p[Magic.QSX + 2] * y - p[Magic.QSX + 11] * g * absolute(g)
    m += (
        p[Magic.QSX + 3]
        * np.cos(p[Magic.QSX + 4] * np.arctan(squared * squared))
        * np.sin(p[Magic.QSX + 6] * g + p[Magic.QSX + 7] * np.arctan(p[Magic.QSX + 8] * y))
    )
    m += p[Magic.QSX + 9] * np.arctan(p[Magic.QSX + 10] * q) * g
    return p[Magic.RADIUS] * (load * m + fy * (p[Magic.QSX + 12] + p[Magic.QSX + 13] * absolute(g)))


@leaf
def resistance(p, load, fx, speed, tilt):
    """-M_y of a tyre that rolls forwards (A48), 0 or more."""
    q, v, g = load / p[Magic.LOAD], speed / p[Magic.SPEED], np.arcsin(tilt)
    f = p[Magic.QSY] + p[Magic.QSY + 1] * fx / p[Magic.LOAD] + p[Magic.QSY + 2] * absolute(v) + p[Magic.QSY + 3] * v**4
    f += (p[Magic.QSY + 4] + p[Magic.QSY + 5] * q) * g * g
    return maximum(p[Magic.RADIUS] * p[Magic.LOAD] * f * np.exp(p[Magic.QSY + 6] * np.log(q)), 0.0 * f)
