"""The power unit with an accumulator against the same equations by SciPy's Radau."""

import math
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

from circuits import BAR, LITRE_PER_MINUTE, density, history
from nivel.api import load

EXAMPLE = Path(__file__).parents[2] / "examples" / "hydraulics" / "accumulator-station.yaml"
END, TANK, CORNER = 3.5, 1 * BAR, 0.5 * BAR
TIMES, VALUES = [0, 2.0, 2.05, 3.0, 3.05], [0, 0, 1, 1, 0]


def flow(litres, drop, share, a, b):
    """[kg/s] by catalogue, of a share of the opening."""
    size = litres * LITRE_PER_MINUTE / math.sqrt(drop * BAR) * share
    return 0.5 * (density(a) + density(b)) * size * (a - b) * ((a - b) ** 2 + CORNER**2) ** -0.25


def rates(t, y):
    """Of the pressures in line and accumulator [bar]."""
    line, store = y * BAR
    turning = 1500 * math.pi / 30
    side = turning / math.hypot(turning, 1.0)
    suction = 0.5 * (density(TANK) + density(line)) + 0.5 * (density(TANK) - density(line)) * side
    pumped = suction * 16e-6 / (2 * math.pi) * turning
    s = min(max((line - TANK - 160 * BAR) / (15 * BAR), 0.0), 1.0)
    relieved = flow(60, 160, s * s * (3 - 2 * s), line, TANK)
    taken = flow(80, 100, np.interp(t, TIMES, VALUES), line, TANK)
    into = flow(100, 2, 1.0, line, store)
    left = (90 * BAR / store) ** (1 / 1.3)
    slopes = [density(p + 1e-20j).imag / 1e-20 for p in (line, store)]
    room = 4e-3 * (0.02 + 1 - left)
    return [
        (pumped - relieved - taken - into) / (slopes[0] * 1e-3) / BAR,
        into / (slopes[1] * room + density(store) * 4e-3 * left / (1.3 * store)) / BAR,
    ]


def test_the_station_follows_its_equations_written_anew():
    """Charged, emptied by its consumer and charged again; each pressure within 1e-5 of its range."""
    result = load(EXAMPLE).simulate(
        duration=END, integrator="radau", tolerance=1e-9, step=None, output_interval=0.05, verify=False
    )
    t = np.asarray(result.time)
    found = [history(result, f"hydraulics.{each}.pressure") for each in ("line", "accumulator")]
    y0 = [each[0] / BAR for each in found]
    solved = solve_ivp(rates, (0, END), y0, "Radau", t_eval=t, rtol=1e-9, atol=1e-9, max_step=0.02)
    for one, other in zip(found, solved.y * BAR, strict=True):
        assert np.ptp(other) > 20 * BAR
        assert np.max(np.abs(one - other)) < 1e-5 * np.ptp(other)
