"""Counterbalance valve of the loader crane, tuned so that the load is lowered with the least shaking.

python examples/optimisation/counterbalance.py

The boom is lifted and lowered. Pilot ratio and opening pressure are chosen for the least rms acceleration of the load, while the load comes
down as far as it does with the valve of the file, and the pump's pressure stays below a limit.
"""

from pathlib import Path

import nivel

HERE = Path(__file__).parent
VALVE = {"hydraulics.lift_hold.pilot_ratio": (1.5, 3.0, 6.0), "hydraulics.lift_hold.opens_at": (160e5, 180e5, 230e5)}
OUTPUTS = {"end": "load.position.z", "pressure": "max(hydraulics.supply.pressure)"}


def tuned(iterations: int = 40):
    """What was found; the first variant of its dataset is the machine as it is."""
    machine = nivel.load(HERE.parent / "hydraulics" / "loader-crane.yaml")
    end = float(machine.simulate(verify=False).array("load.position.z")[-1])
    limits = {"end": (None, end + 0.01), "pressure": (None, 200e5)}
    return machine.optimise(
        "rms(load.acceleration.z)", VALVE, outputs=OUTPUTS, limits=limits, method="COBYLA", iterations=iterations
    )


if __name__ == "__main__":
    found = tuned()
    before = float(found.dataset["objective"][0])
    print(f"rms acceleration of the load {before:.3f} m/s², tuned {found.objective:.3f} m/s²")
    for path, value in found.values.items():
        print(f"{path:35} {value:.4g}")
    print(f"limits kept: {found.kept}; {found.evaluations} runs")
