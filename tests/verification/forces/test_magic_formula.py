"""Tyres of `.tir` files against formulas that are written here once more, after Pacejka 2012, 4.3.2, foreign codes and symmetries."""

import math
from pathlib import Path

import numpy as np
import pytest

from nivel.elements.forces.magic_formula import Magic, MagicFormula, lever, magic, numbers_of, overturning, resistance
from nivel.errors import ModelError
from nivel.files import parse_machine
from nivel.files.tyre_file import formula_of, parsed
from simulating import G, machine

FILE = Path(__file__).parents[3] / "examples" / "vehicles" / "passenger-car.tir"
TEXT = FILE.read_text()
FILE_61 = formula_of(parsed(TEXT))


def sign(x):
    return 1.0 if x >= 0.0 else -1.0


def book(c, version, load, kappa, alpha, gamma, pressure, speed):
    """(F_x, F_y, M_x, -M_y, M_z) by the book's equations, whose numbers stand beside them; c : coefficients, absent ones are zero."""
    g = lambda key, absent=0.0: c.get(key, absent)  # noqa: E731
    lam = lambda key: c.get(key, 1.0)  # noqa: E731
    old = version == "5.2"
    fz0 = g("FNOMIN") * lam("LFZO")
    dfz = (load - fz0) / fz0  # 4.E2a
    dpi = 0.0 if old else (pressure - g("NOMPRES")) / g("NOMPRES")  # 4.E2b
    r0 = g("UNLOADED_RADIUS")
    a, cam = (alpha, gamma) if old else (math.tan(alpha), math.sin(gamma))  # 4.E3, 4.E4
    ca = math.cos(alpha)
    lx, ly = lam("LMUX"), lam("LMUY")
    sx, sy = (lx, ly) if old else (10 * lx / (1 + 9 * lx), 10 * ly / (1 + 9 * ly))  # 4.E8
    # longitudinal, alone
    shx = (g("PHX1") + g("PHX2") * dfz) * lam("LHX")  # 4.E17
    svx = load * (g("PVX1") + g("PVX2") * dfz) * lam("LVX") * sx  # 4.E18
    kx = kappa + shx  # 4.E10
    cx = g("PCX1") * lam("LCX")  # 4.E11
    mux = (
        (g("PDX1") + g("PDX2") * dfz) * (1 + g("PPX3") * dpi + g("PPX4") * dpi**2) * (1 - g("PDX3") * cam**2) * lx
    )  # 4.E13
    dx = mux * load  # 4.E12
    ex = (g("PEX1") + g("PEX2") * dfz + g("PEX3") * dfz**2) * (1 - g("PEX4") * sign(kx)) * lam("LEX")  # 4.E14
    kxk = (
        load
        * (g("PKX1") + g("PKX2") * dfz)
        * math.exp(g("PKX3") * dfz)
        * (1 + g("PPX1") * dpi + g("PPX2") * dpi**2)
        * lam("LKX")
    )  # 4.E15
    bx = kxk / (cx * dx)  # 4.E16
    fx0 = dx * math.sin(cx * math.atan(bx * kx - min(ex, 1) * (bx * kx - math.atan(bx * kx)))) + svx  # 4.E9

    def alone(cam):  # lateral
        kya = g("PKY1") * fz0 * (1 + g("PPY1") * dpi) * (1 - g("PKY3") * abs(cam)) * lam("LKY")
        at = load / fz0 / ((g("PKY2") + g("PKY5") * cam**2) * (1 + g("PPY2") * dpi))
        kya *= math.sin(g("PKY4", 2.0) * math.atan(at))  # 4.E25
        svyg = load * (g("PVY3") + g("PVY4") * dfz) * cam * lam("LKYC") * sy  # 4.E28
        kyg = load * (g("PKY6") + g("PKY7") * dfz) * (1 + g("PPY5") * dpi) * lam("LKYC")  # 4.E30
        shy = (g("PHY1") + g("PHY2") * dfz) * lam("LHY")
        shy += g("PHY3") * cam * lam("LKYC") if old else (kyg * cam - svyg) / kya  # 4.E27
        svy = load * (g("PVY1") + g("PVY2") * dfz) * lam("LVY") * sy + svyg  # 4.E29
        ay = a + shy  # 4.E20
        cy = g("PCY1") * lam("LCY")
        muy = (
            (g("PDY1") + g("PDY2") * dfz) * (1 + g("PPY3") * dpi + g("PPY4") * dpi**2) * (1 - g("PDY3") * cam**2) * ly
        )  # 4.E23
        dy = muy * load
        ey = (
            (g("PEY1") + g("PEY2") * dfz)
            * (1 + g("PEY5") * cam**2 - (g("PEY3") + g("PEY4") * cam) * sign(ay))
            * lam("LEY")
        )  # 4.E24
        by = kya / (cy * dy)
        f = dy * math.sin(cy * math.atan(by * ay - min(ey, 1) * (by * ay - math.atan(by * ay)))) + svy  # 4.E19
        return f, kya, shy, svy, muy, by, cy

    fy0, kya, shy, svy, muy, by, cy = alone(cam)
    # both slips
    bxa = (g("RBX1") + g("RBX3") * cam**2) * math.cos(math.atan(g("RBX2") * kappa)) * lam("LXAL")  # 4.E54
    exa, shxa = min(g("REX1") + g("REX2") * dfz, 1), g("RHX1")
    gx = lambda s: math.cos(g("RCX1") * math.atan(bxa * s - exa * (bxa * s - math.atan(bxa * s))))  # noqa: E731
    fx = fx0 * gx(a + shxa) / gx(shxa)  # 4.E50
    byk = (g("RBY1") + g("RBY4") * cam**2) * math.cos(math.atan(g("RBY2") * (a - g("RBY3")))) * lam("LYKA")  # 4.E62
    eyk, shyk = min(g("REY1") + g("REY2") * dfz, 1), g("RHY1") + g("RHY2") * dfz
    gy = lambda s: math.cos(g("RCY1") * math.atan(byk * s - eyk * (byk * s - math.atan(byk * s))))  # noqa: E731
    gyk = gy(kappa + shyk) / gy(shyk)  # 4.E59
    dvyk = muy * load * (g("RVY1") + g("RVY2") * dfz + g("RVY3") * cam) * math.cos(math.atan(g("RVY4") * a))  # 4.E67
    svyk = dvyk * math.sin(g("RVY5") * math.atan(g("RVY6") * kappa)) * lam("LVYKA")  # 4.E66
    fy = gyk * fy0 + svyk  # 4.E58
    # aligning moment
    ar = a + shy + svy / kya  # 4.E37, 4.E38
    at = a + g("QHZ1") + g("QHZ2") * dfz + (g("QHZ3") + g("QHZ4") * dfz) * cam  # 4.E34
    both = (kxk / kya) ** 2 * kappa**2
    areq = math.atan(math.sqrt(math.tan(ar) ** 2 + both)) * sign(ar)  # 4.E78
    ateq = math.atan(math.sqrt(math.tan(at) ** 2 + both)) * sign(at)  # 4.E77
    bt = (
        (g("QBZ1") + g("QBZ2") * dfz + g("QBZ3") * dfz**2)
        * (1 + g("QBZ4") * cam + g("QBZ5") * abs(cam))
        * lam("LKY")
        / ly
    )
    dt = (
        load
        * r0
        / g("FNOMIN")
        * (g("QDZ1") + g("QDZ2") * dfz)
        * (1 - g("PPZ1") * dpi)
        * (1 + g("QDZ3") * cam + g("QDZ4") * cam**2)
    )
    ct = g("QCZ1")
    et = (g("QEZ1") + g("QEZ2") * dfz + g("QEZ3") * dfz**2) * (
        1 + (g("QEZ4") + g("QEZ5") * cam) * 2 / math.pi * math.atan(bt * ct * at)
    )
    trail = (
        dt * lam("LTR") * math.cos(ct * math.atan(bt * ateq - min(et, 1) * (bt * ateq - math.atan(bt * ateq)))) * ca
    )  # 4.E73
    br = g("QBZ9") * lam("LKY") / ly + g("QBZ10") * by * cy  # 4.E45
    dr = (g("QDZ6") + g("QDZ7") * dfz) * lam("LRES")
    spread = (g("QDZ8") + g("QDZ9") * dfz) * (1 + g("PPZ2") * dpi) + (
        0 if old else (g("QDZ10") + g("QDZ11") * dfz) * abs(cam)
    )
    dr = load * r0 * (dr + spread * cam * lam("LKZC")) * ly * ca  # 4.E47
    mzr = dr * math.cos(math.atan(br * areq))  # 4.E75
    on_trail = fy - svyk if old else gyk * alone(0.0)[0]  # 4.E74
    s = r0 * (g("SSZ1") + g("SSZ2") * fy / g("FNOMIN") + (g("SSZ3") + g("SSZ4") * dfz) * gamma) * lam("LS")  # 4.E76
    mz = -trail * on_trail + mzr + s * fx  # 4.E71
    q, y = load / g("FNOMIN"), fy / g("FNOMIN")
    mx = g("QSX1") * lam("LVMX") - g("QSX2") * gamma * (1 + g("PPMX1") * dpi) + g("QSX3") * y
    mx += (
        g("QSX4")
        * math.cos(g("QSX5") * math.atan((g("QSX6") * q) ** 2))
        * math.sin(g("QSX7") * gamma + g("QSX8") * math.atan(g("QSX9") * y))
    )
    mx = r0 * load * (mx + g("QSX10") * math.atan(g("QSX11") * q) * gamma) * lam("LMX")  # 4.E69
    v = speed / g("LONGVL")
    f = g("QSY1") + g("QSY2") * fx / g("FNOMIN") + g("QSY3") * v + g("QSY4") * v**4
    if old:
        return fx, fy, mx, r0 * load * f * lam("LMY"), mz
    f += (g("QSY5") + g("QSY6") * q) * gamma**2
    my = (
        r0 * g("FNOMIN") * f * lam("LMY") * q ** g("QSY7", 1.0) * (pressure / g("NOMPRES")) ** g("QSY8")
    )  # 4.E70 with F_z0
    return fx, fy, mx, my, mz  # fmt: skip


def ours(formula, load, kappa, alpha, gamma, pressure, speed, side=None):
    """The same by the law of the tyre."""
    p = np.array(numbers_of(formula, pressure, side))
    tilt = math.sin(gamma)
    along, across, (beside, trail, rest) = magic(p, load, kappa, math.tan(alpha), tilt, 1.0)
    fx, fy = along[0], across[0]
    mz = -trail * (fy - beside) + rest + lever(p, load, fy, tilt) * fx
    return fx, fy, overturning(p, load, fy, tilt), resistance(p, load, fx, speed, tilt), mz


def varied(version, seed):
    """The file of the example, each of whose numbers is changed, with all terms of the formula."""
    rng = np.random.default_rng(seed)
    c = {
        key: value * rng.uniform(0.9, 1.1)
        for key, value in FILE_61.coefficients.items()
        if key not in ("FNOMIN", "FITTYP")
    }
    for name, count in Magic.several.items():
        for k in range(count):
            c.setdefault(f"{name}{k + 1}".upper(), rng.uniform(-0.05, 0.05))
    for key in ("LCX", "LMUX", "LEX", "LKX", "LHX", "LVX", "LXAL", "LCY", "LMUY", "LEY", "LKY", "LHY", "LVY", "LYKA", "LVYKA", "LKYC",
                "LTR", "LRES", "LKZC", "LS", "LVMX", "LMX", "LMY", "LFZO"):  # fmt: skip
        c[key] = rng.uniform(0.8, 1.2)
    for key in ("QSX12", "QSX13", "QSX14"):  # of version 6.2, which the book does not have
        c[key] = 0.0
    return MagicFormula(version=version, coefficients={**c, "FNOMIN": 4000.0, "QSY1": 0.3})


@pytest.mark.parametrize("version", ["5.2", "6.1"])
def test_forces_and_moments_are_those_of_the_book(version):
    rng = np.random.default_rng(5)
    for seed in range(60):
        formula = varied(version, seed)
        load, kappa, alpha = rng.uniform(400.0, 9000.0), rng.uniform(-1.2, 1.2), rng.uniform(-0.8, 0.8)
        gamma, pressure = rng.uniform(-0.15, 0.15), rng.uniform(1.5e5, 3e5)
        found = ours(formula, load, kappa, alpha, gamma, pressure, 20.0)
        expected = book(formula.coefficients, version, load, kappa, alpha, gamma, pressure, 20.0)
        np.testing.assert_allclose(found, expected, rtol=1e-11, atol=1e-11 * load)


# The tyre of `vehiclemodels/parameters/parameters_tire.yaml`, but for p_vx1, which `formula_longitudinal` adds within the sine
COMMONROAD = {"PCX1": 1.6411, "PDX1": 1.1739, "PEX1": 0.46403, "PKX1": 22.303, "PHX1": 0.0012297, "PVX1": 0.0, "RBX1": 13.276,
              "RBX2": -13.778, "RCX1": 1.2568, "REX1": 0.65225, "RHX1": 0.0050722, "PCY1": 1.3507, "PDY1": 1.0489, "PDY3": -2.8821,
              "PEY1": -0.0074722, "PKY1": -21.92, "PHY1": 0.0026747, "PHY3": 0.031415, "PVY1": 0.037318, "PVY3": -0.32931,
              "RBY1": 7.1433, "RBY2": 9.1916, "RBY3": -0.027856, "RCY1": 1.0719, "REY1": -0.27572, "RHY1": 5.7448e-06,
              "RVY1": -0.027825, "RVY3": -0.27568, "RVY4": 12.12, "RVY5": 1.9, "RVY6": -10.704}  # fmt: skip


def at_its_load(load, coefficients):
    """A formula of version 5.2 whose nominal load is this one, with K_yα = PKY1 F_z, as others simplify it."""
    common = {"FNOMIN": load, "PKY2": 1.0, "UNLOADED_RADIUS": 0.32, "LONGVL": 16.6}
    return MagicFormula(version="5.2", coefficients={**coefficients, **common})


@pytest.mark.parametrize(
    ("load", "kappa", "alpha", "gamma", "fx", "fy"),
    [
        (4000.0, 0.03, 0.0, 0.01, 2492.123049759329, -51.12706978344582),
        (4000.0, 0.0, -0.05, 0.02, 88.2996274678328, 3264.702372038094),
        (2500.0, -0.1, 0.06, 0.05, -2388.0361125256222, -1995.508729111759),
        (6000.0, 0.2, 0.3, 0.1, 3486.238115992122, -5499.373495728831),
        (1000.0, -0.9, -0.6, 0.03, -675.2334743586206, 554.1618697869354),
        (8000.0, 0.01, 0.01, 0.14, 1920.8863733965932, -2825.839439994713),
    ],
)
def test_combined_slips_have_the_forces_of_commonroad_vehicle_models(load, kappa, alpha, gamma, fx, fy):
    """By `formula_longitudinal_comb` and `formula_lateral_comb` of commonroad-vehicle-models 3.0.2 (slips in the signs of the book)."""
    found = ours(at_its_load(load, COMMONROAD), load, kappa, alpha, gamma, None, 20.0)
    assert found[:2] == pytest.approx((fx, fy), rel=1e-12)


@pytest.mark.parametrize(
    ("load", "b", "c", "d", "e", "slip", "force"),
    [
        (4000.0, 10.0, 1.65, 1.0, 0.5, 0.07, 3270.3865797773847),
        (1500.0, 18.0, 1.3, 0.8, -2.0, -0.3, -1116.793442128009),
        (7000.0, 7.0, 1.9, 1.2, 0.9, 0.9, 7395.527270867627),
    ],
)
def test_one_slip_alone_has_the_curve_of_pacejka(load, b, c, d, e, slip, force):
    """By `Tire._magic_formula_core` of pacejka 0.1.0, B, C, D/F_z and E given."""
    formula = at_its_load(
        load, {"PCX1": c, "PDX1": d, "PEX1": e, "PKX1": b * c * d, "PCY1": c, "PDY1": d, "PEY1": e, "PKY1": -b * c * d}
    )
    assert ours(formula, load, slip, 0.0, 0.0, None, 20.0)[0] == pytest.approx(force, rel=1e-12)
    assert ours(formula, load, 0.0, slip, 0.0, None, 20.0)[1] == pytest.approx(-force, rel=1e-12)


def test_one_slip_alone_has_the_slopes_of_the_file():
    """Shifts set to nothing: dF_x/dκ = K_xκ, -dF_y/dα = K_yα, M_z = -t F_y; at the nominal load K is that of the first coefficients."""
    c = {
        key: value
        for key, value in FILE_61.coefficients.items()
        if key[:3] not in ("PHX", "PVX", "PHY", "PVY", "QHZ", "RVY", "SSZ")
    }
    plain = MagicFormula(version="6.1", coefficients={**c, "QDZ6": 0.0, "RHX1": 0.0, "RHY1": 0.0})
    e, load = 1e-6, 4000.0
    up, down = ours(plain, load, e, 0.0, 0.0, None, 0.0)[0], ours(plain, load, -e, 0.0, 0.0, None, 0.0)[0]
    assert (up - down) / (2 * e) == pytest.approx(23.0 * load, rel=1e-8)
    up, down = ours(plain, load, 0.0, e, 0.0, None, 0.0), ours(plain, load, 0.0, -e, 0.0, None, 0.0)
    assert (up[1] - down[1]) / (2 * e) == pytest.approx(-19.5 * load * math.sin(2 * math.atan(1 / 1.75)), rel=1e-8)
    assert up[4] / up[1] == pytest.approx(-0.12 * 0.317, rel=1e-6)


def rig(kappa, alpha, gamma, side="left", turned=False, speed=20.0):
    """A wheel on a carriage that slides at the slip angle, cambered, with the spin of its slip; and its load."""
    height, stiffness = 0.295, 200e3
    c = math.cos(gamma)
    axle = [0.0, -c, -math.sin(gamma)] if turned else [0.0, c, math.sin(gamma)]
    way = [math.cos(alpha), math.sin(alpha), 0.0]
    deflection = 0.317 - height / c
    load = stiffness * deflection / c
    # the rolling radius: of the deflection it follows D atan B + F under 4 kN, and more of less
    stays = (1.0 - 0.27 * math.atan(8.4) - 0.07) * load / 4000.0
    spin = speed * way[0] * (1.0 + kappa) / (0.317 - (1.0 - stays) * deflection) * (-1.0 if turned else 1.0)
    at = {"position": [0, 0, height], "velocity": [speed * each for each in way]}
    wheel = {"mass": 20.0, "inertia": [0.6, 1.0, 0.6], "angular_velocity": [spin * each for each in axle], **at}
    joints = {
        "rail": {"type": "translational", "bodies": ["ground", "carriage"], "point": [0, 0, height], "axis": way},
        "axle": {"type": "revolute", "bodies": ["carriage", "wheel"], "point": [0, 0, height], "axis": axle},
    }
    drivers = {"moves": {"coordinate": "rail.displacement", "value": f"{speed}*time"},
               "turns": {"coordinate": "axle.angle", "value": f"{spin!r}*time"}}  # fmt: skip
    made = {"bodies": {"carriage": {"mass": 100.0, "inertia": [9, 9, 9], **at}, "wheel": wheel}, "joints": joints, "drivers": drivers,
            "markers": {"road": {"body": "ground", "axis": [0, 0, 1]}, "hub": {"body": "wheel", "axis": axle}},
            "forces": {"tyre": {"type": "tyre", "wheel": "hub", "plane": "road", "file": str(FILE), "side": side}},
            "simulation": {"step": 1e-3, "duration": 1.0}}  # fmt: skip
    return machine(made), load


def steady(kappa, alpha, gamma, **more):
    """(stiffness times deflection, load, F_x, F_y, M_x, M_z) at the end of a run on the rig."""
    made, load = rig(kappa, alpha, gamma, **more)
    run = made.simulate(verify=False)
    words = ("magnitude", "longitudinal", "lateral", "overturning_moment", "moment")
    return load, *(float(run.array(f"force.tyre.{word}")[-1]) for word in words)


@pytest.mark.parametrize(("kappa", "alpha", "gamma"), [(0.05, 0.0, 0.0), (-0.08, 0.06, 0.0), (0.02, -0.1, 0.05)])
def test_a_wheel_on_a_rig_has_the_forces_of_the_formula(kappa, alpha, gamma):
    load, magnitude, fx, fy, mx, mz = steady(kappa, alpha, gamma)
    assert magnitude == pytest.approx(load, rel=1e-9)
    expected = book(FILE_61.coefficients, "6.1", load, kappa, alpha, gamma, 2.2e5, 20.0)
    assert (fx, fy, mx) == pytest.approx(tuple(expected[:3]), rel=1e-6)
    assert mz == pytest.approx(expected[4], rel=1e-4)  # which fades below SLOW


def test_a_tyre_on_the_other_side_is_in_the_mirror_and_an_axle_may_point_either_way():
    left = steady(0.03, 0.04, 0.03)
    right = steady(0.03, -0.04, -0.03, side="right")
    np.testing.assert_allclose(np.array(right) * [1, 1, 1, -1, -1, -1], left, rtol=1e-9)
    turned = steady(0.03, 0.04, 0.03, turned=True)
    np.testing.assert_allclose(np.array(turned) * [1, 1, -1, -1, -1, 1], left, rtol=1e-9)


def car(slope=0.0, speed=0.0, locked=True, **more):
    """A body on four wheels of the file, on a slope [-] along x; locked wheels are one with it."""
    bodies = {
        "body": {"mass": 1600.0, "inertia": [900.0, 1500.0, 1500.0], "position": [0, 0, 0.4], "velocity": [speed, 0, 0]}
    }
    markers, joints, forces = {"road": {"body": "ground", "axis": [0, 0, 1]}}, {}, {}
    for k, (x, y) in enumerate(((1.2, 0.7), (1.2, -0.7), (-1.2, 0.7), (-1.2, -0.7))):
        if locked:
            markers[f"m{k}"] = {"body": "body", "position": [x, y, -0.1], "axis": [0, 1, 0]}
        else:
            bodies[f"w{k}"] = {"mass": 20.0, "inertia": [0.6, 1.0, 0.6], "position": [x, y, 0.3], "velocity": [speed, 0, 0],
                               "angular_velocity": [0, speed / 0.31, 0]}  # fmt: skip
            joints[f"j{k}"] = {"type": "revolute", "bodies": ["body", f"w{k}"], "point": [x, y, 0.3], "axis": [0, 1, 0]}
            markers[f"m{k}"] = {"body": f"w{k}", "axis": [0, 1, 0]}
        forces[f"t{k}"] = {
            "type": "tyre",
            "wheel": f"m{k}",
            "plane": "road",
            "file": str(FILE),
            "side": "left" if y > 0 else "right",
        }
    angle = math.atan(slope)
    gravity = [-G * math.sin(angle), 0, -G * math.cos(angle)]
    forces |= more.pop("forces", {})
    return machine({"gravity": gravity, "bodies": bodies, "joints": joints, "markers": markers, "forces": forces,
                    "simulation": {"step": 1e-3, **more}})  # fmt: skip


def test_a_parked_car_does_not_creep_while_its_engine_idles():
    """At whole periods of the engine, once the first vibration has died out."""
    idling = {
        "idling": {"type": "force", "body": "body", "vector": ["400*sin(2*pi*25*time)", "300*sin(2*pi*25*time)", 0]}
    }
    run = car(0.1, forces=idling, start="equilibrium", duration=50, output_interval=0.04).simulate(verify=False)
    place = run.array("position")[:, 0]
    assert np.abs(place[-1] - place[1000]).max() < 1e-9


def test_sides_in_the_mirror_drive_straight_on_and_energy_is_kept():
    """Ply steer and conicity of both sides cancel; what the tyres lose is what the car loses."""
    run = car(speed=20.0, locked=False, duration=3).simulate(verify=False)
    assert np.abs(run.array("position")[-1, 0, 1]) < 1e-9
    assert np.abs(run.array("force.t0.lateral")[-1]) > 10.0
    kinetic = 0.5 * 1680.0 * 20.0**2
    assert np.abs(run.array("energy_error")).max() < 1e-8 * kinetic
    # the resistance of the file: it slows by f m g over the mass with the turning wheels
    v, f = run.array("velocity")[:, 0, 0], 0.009 + 0.0005 * 20 / 16.7 + 0.0001 * (20 / 16.7) ** 4
    mass = 1680.0 + 4.0 / 0.308**2
    a = (v[100] - v[-1]) / (run.time[-1] - run.time[100])
    assert a == pytest.approx(f * 0.317 / 0.308 * 1680.0 * G / mass, rel=0.03)


def test_units_of_the_file_are_converted():
    """The same file in millimetres, kilonewtons and bar."""
    text = TEXT.replace("LENGTH                   = 'meter'", "LENGTH = 'mm'").replace(
        "FORCE                    = 'newton'", "FORCE = 'kN'"
    )
    text = text.replace("TIME                     = 'second'", "TIME = 'second'\nPRESSURE = 'bar'")
    for old, new in (("= 0.317", "= 317"), ("= 0.195", "= 195"), ("= 16.7", "= 16700"), ("= 4000", "= 4"), ("= 220000", "= 2.2"),
                     ("= 200000", "= 0.2"), ("= 180000", "= 0.18"), ("= 130000", "= 0.13"), ("= 400\n", "= 0.0004\n")):  # fmt: skip
        text = text.replace(old, new)
    found, expected = formula_of(parsed(text)).coefficients, FILE_61.coefficients
    assert found == pytest.approx(expected, rel=1e-14)


MACHINE = """format: 1
bodies: {a: {mass: 1, inertia: [1, 1, 1], shape: {type: sphere, radius: 0.3}}}
markers: {hub: {body: a, axis: [0, 1, 0]}, road: {body: ground}}
tyres: {front: {file: front.tir}}
forces:
  left: {type: tyre, wheel: hub, plane: road, tyre: front}
  right: {type: tyre, wheel: hub, plane: road, tyre: front, side: right, width: 0.2}
"""


def said(folder, text):
    (folder / "front.tir").write_text(text)
    with pytest.raises(ModelError) as error:
        parse_machine(MACHINE, str(folder / "m.yaml"))
    return error.value.faults


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("= 23\n", "= many\n", "`PKX1`: a number was expected, got `many`"),
        ("= -19.5\n", "= 19.5\n", "`PKY1`: a negative number was expected"),
        ("PCX1  ", "PCX9  ", "`PCX1`: it is missing"),
        ("FITTYP                   = 61", "FITTYP = 70", "line 13: `FITTYP` 5, 6"),
        ("'meter'", "'ell'", "line 7: `LENGTH`: one of meter"),
        ("ANGLE                    = 'radians'", "ANGLE = 'degrees'", "line 9: `ANGLE`"),
        ("= 4000\n", "= -4000\n", "`FNOMIN`: a positive number was expected"),
        ("= 4000\n", "= 0\n", "line 26: `FNOMIN`: a positive number was expected, got 0"),
        ("= 4000\n", "= 1e999\n", "`FNOMIN`: a finite number was expected"),
        ("LMUX  ", "LWET = 0.5\nLMUX  ", "`LWET`: this scaling factor is not known here but as 1"),
        ("LMUX                     = 1", "LMUX = 0", "`LMUX`: a positive number was expected"),
        ("PEX1  ", "PCX1 = 1.2\nPEX1  ", "`PCX1` stands here a second time; the first is in line"),
        ("[UNITS]", "[UNITS", "`KEY = number` was expected, got `[UNITS`"),
        ("PEX1  ", "so much for that\nPEX1  ", "`KEY = number` was expected, got `so much for that`"),
        (TEXT, "no section\n", "line 1: a section such as `[UNITS]` was expected"),
        (TEXT, "", "`FITTYP` 5, 6"),
    ],
)
def test_hostile_files_are_refused_with_the_line_once(tmp_path, old, new, expected):
    text = TEXT.replace(old, new, 1)
    faults = said(tmp_path, text)
    assert len(faults) == 1
    assert faults[0].line == 4
    assert expected in faults[0].message


def test_what_is_not_used_is_told_and_what_the_machine_says_goes_before(tmp_path):
    (tmp_path / "front.tir").write_text(TEXT)
    left, right = parse_machine(MACHINE, str(tmp_path / "m.yaml")).forces
    assert left.source == "Magic Formula 6.1 of front.tir; not used: VXLOW, ASPECT_RATIO, RIM_RADIUS, PECP1"
    assert " in the mirror" in right.source
    assert (left.width, right.width, left.radius, left.nominal_load) == (0.195, 0.2, 0.317, 4000.0)
    assert left.along.stiffness == 180e3
