"""An integrator is one file and one line: the one of the documentation is added here, and converges."""

from pathlib import Path

import numpy as np

import machines
from nivel.integrate.catalogue import INTEGRATORS, IntegratorFacts
from running import run

HERE = Path(__file__).parent
PAGE = (HERE.parents[1] / "docs" / "extending.md").read_text(encoding="utf-8")


def test_integrator_of_the_documentation_runs_with_its_order(monkeypatch):
    source = (HERE / "midpoint.py").read_text(encoding="utf-8")
    assert source[source.index("@entry") :].strip() in PAGE
    monkeypatch.syspath_prepend(str(HERE))
    monkeypatch.setitem(INTEGRATORS, "heun", IntegratorFacts("midpoint", "midpoint", stages=1, order=2))
    machine = machines.slider_crank(duration=0.5, output_interval=0.1)
    fine = run(machine, integrator="rk4", step=1e-3)
    errors = [np.abs(run(machine, integrator="heun", step=h).position - fine.position).max() for h in (4e-3, 2e-3)]
    assert abs(np.log2(errors[0] / errors[1]) - 2.0) < 0.2
