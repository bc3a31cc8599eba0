"""The loader crane as an FMU: written by nivel, then moved by FMPy (`pip install fmpy`), which knows nothing of nivel.

    python loader_crane_fmu.py

The lift lever follows a ramp; the boom rises, and nivel itself computes the same.
"""

from pathlib import Path

import fmpy
import numpy as np

import nivel
from nivel.demos import demo_file

STEP, END = 0.005, 1.0  # [s] between two values of the lever, and the end


def lever(t):
    """Deflection of the lift lever."""
    return np.clip(t - 0.1, 0.0, 0.5)


def write(path):
    """Write the FMU; the damping of the swinging load can be set."""
    crane = nivel.load(demo_file("loader-crane"))
    names = ["luffing.angle", "hydraulics.lift.pressure_A"]
    crane.export_fmu(path, select=names, parameters=["forces.swing_x.damping"], force=True)


def angle_by_fmpy(path):
    """Angle of the boom [rad] after the last step, by FMPy."""
    folder, description = fmpy.extract(str(path)), fmpy.read_model_description(str(path))
    reference = {each.name: each.valueReference for each in description.modelVariables}
    unit = fmpy.instantiate_fmu(folder, description, "CoSimulation")
    unit.enterInitializationMode()
    unit.exitInitializationMode()
    for k in range(round(END / STEP)):
        unit.setFloat64([reference["lift_lever"]], [lever(k * STEP)])
        unit.doStep(k * STEP, STEP)
    (angle,) = unit.getFloat64([reference["luffing.angle"]])
    unit.terminate()
    unit.freeInstance()
    return angle


def angle_by_nivel():
    """The same by nivel."""
    simulation = nivel.load(demo_file("loader-crane")).start()
    for k in range(round(END / STEP)):
        simulation.advance(STEP, {"lift_lever": float(lever(k * STEP))})
    return simulation["luffing.angle"]


def main(path=Path("loader-crane.fmu")):
    """Write the FMU, and compare."""
    write(path)
    by_fmpy, by_nivel = angle_by_fmpy(path), angle_by_nivel()
    print(f"the boom stands at {by_fmpy} rad by FMPy, at {by_nivel} rad by nivel")
    return by_fmpy, by_nivel


if __name__ == "__main__":
    main()
