"""What flexible bodies cost: an evaluation with 20 modes beside that of a rigid body, and a loader crane with two flexible booms.

    OMP_NUM_THREADS=1 python benchmarks/flexible.py

The crane slews, lifts and folds a load on a rope by two cylinders: column, boom and jib (10 modes each, with geometric stiffening), two
barrels, two rods, the load. Least of several rounds, process time inside the compiled loops; both tables are of one run.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import numpy as np

import nivel
from nivel.analysis.plan.plan import methods_of
from nivel.analysis.plan.settings import complete
from nivel.analysis.run.dynamics import march
from nivel.analysis.run.prepared_state import prepare
from nivel.flexible.body.body_file import write_body
from nivel.flexible.model.model_file import parse_model
from nivel.flexible.reduce import reduce_model
from part import measure

STEP = 1e-3
KINDS = ("plain", "stiffened", "without I5 and I9")
BAR = """
format: 1
name: bar
materials: {{steel: {{youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3}}}}
sections: {{box: {{type: {section}}}}}
frame:
  nodes: {{{nodes}}}
  beams: {{{beams}}}
interfaces: {{{interfaces}}}
reduction: {{modes: {modes}, stiffening: {stiffening}}}
"""
CRANE = """
format: 1
bodies:
  column: {{mass: 300 kg, inertia: [60, 60, 20], position: [0, 0, 0], centre_of_mass: [0, 0, -1 m]}}
  boom: {{flexible: {{file: {folder}/boom.nc, modes: 10, damping_ratio: 0.02}}}}
  jib: {{flexible: {{file: {folder}/jib.nc, modes: 10, damping_ratio: 0.02}}, position: [3 m, 0, 0]}}
  barrel: {{mass: 40 kg, inertia: [1, 4, 4], position: [0.2 m, 0, -1.2 m]}}
  rod: {{mass: 30 kg, inertia: [1, 3, 3], position: [1.2 m, 0, 0]}}
  barrel2: {{mass: 30 kg, inertia: [1, 3, 3], position: [1.2 m, 0, 0]}}
  rod2: {{mass: 20 kg, inertia: [1, 2, 2], position: [3.6 m, 0, 0]}}
  load: {{mass: 500 kg, inertia: [20, 20, 20], position: [5.5 m, 0, -1.5 m]}}
gravity: [0, 0, -9.81]
joints:
  slew: {{type: revolute, bodies: [ground, column], point: [0, 0, 0], axis: [0, 0, 1]}}
  foot: {{type: revolute, bodies: [column, boom], point: [0, 0, 0], axis: [0, 1, 0]}}
  elbow: {{type: revolute, bodies: [boom, jib], point: [3 m, 0, 0], axis: [0, 1, 0]}}
  base: {{type: universal, bodies: [column, barrel], point: [0.2 m, 0, -1.2 m], axes: [[0, 1, 0], [-1.2, 0, 1]]}}
  cylinder: {{type: translational, bodies: [barrel, rod], point: [0.2 m, 0, -1.2 m], axis: [1, 0, 1.2]}}
  bracket: {{type: spherical, bodies: [rod, boom], point: [1.2 m, 0, 0]}}
  base2: {{type: universal, bodies: [boom, barrel2], point: [1.2 m, 0, 0], axes: [[0, 1, 0], [0, 0, 1]]}}
  cylinder2: {{type: translational, bodies: [barrel2, rod2], point: [1.2 m, 0, 0], axis: [1, 0, 0]}}
  link: {{type: spherical, bodies: [rod2, jib], point: [3.6 m, 0, 0.4 m]}}
  rope: {{type: spherical, bodies: [jib, load], point: [5.5 m, 0, 0]}}
drivers:
  slewing: {{coordinate: slew.angle, value: "0.3*(1 - cos(pi rad*time/5))"}}
  lifting: {{coordinate: cylinder.displacement, value: "0.1*(1 - cos(pi rad*time/5))"}}
  folding: {{coordinate: cylinder2.displacement, value: "-0.1*(1 - cos(pi rad*time/5))"}}
simulation: {{step: 1 ms, duration: 2, output_interval: 0.1}}
"""


def beam_file(
    folder: Path,
    name: str,
    section: str,
    nodes: dict[str, str],
    beams: list[tuple[str, str]],
    modes: int,
    stiffening: bool,
) -> Path:
    """A reduced frame of beams, all of whose nodes are interfaces."""
    text = BAR.format(
        section=section,
        nodes=", ".join(f"{key}: {value}" for key, value in nodes.items()),
        beams=", ".join(f"{a}{b}: {{nodes: [{a}, {b}], section: box, material: steel, elements: 8}}" for a, b in beams),
        interfaces=", ".join(f"{key}: {{node: {key}}}" for key in nodes),
        modes=modes,
        stiffening=str(stiffening).lower(),
    )
    path = folder / f"{name}.nc"
    write_body(reduce_model(parse_model(text, str(folder / "model.yaml"))).body, path)
    return path


def loaded(folder: Path, text: str):
    """The machine of a text."""
    path = folder / "machine.yaml"
    path.write_text(text, encoding="utf-8")
    return nivel.load(path).record


def crane(folder: Path, **settings: object):
    """The loader crane of the benchmark."""
    section = "rectangle, width: 0.12, height: 0.16"
    boom = {"foot": "[0, 0, 0]", "lift": "[1.2, 0, 0]", "head": "[3, 0, 0]"}
    beam_file(folder, "boom", section, boom, [("foot", "lift"), ("lift", "head")], 10, stiffening=True)
    jib = {"foot": "[0, 0, 0]", "lever": "[0.6, 0, 0.4]", "knee": "[0.6, 0, 0]", "tip": "[2.5, 0, 0]"}
    jib_beams = [("foot", "knee"), ("knee", "lever"), ("knee", "tip")]
    beam_file(folder, "jib", "rectangle, width: 0.1, height: 0.12", jib, jib_beams, 10, stiffening=True)
    machine = loaded(folder, CRANE.format(folder=folder))
    return machine.replace(simulation=machine.simulation.replace(**settings))


def run_time(machine) -> tuple[float, dict[str, float], float]:
    """Least µs a step of three runs, the counts of the last one, and its largest energy error as a share of the largest kinetic energy."""
    best = np.inf
    for _ in range(3):
        settings = complete(machine.simulation)
        prepared = prepare(methods_of(machine, settings.formulation, settings.coordinates))
        kept = []

        class Sink:
            def take(self, frames, kept=kept):
                kept.append(frames.copy())

        finished = march(prepared, settings, [Sink()])
        if finished.outcome != "done":
            raise SystemExit(str(finished.failure))
        best = min(best, finished.timing["loop_seconds"])
    layout = {variable.name: variable.columns for variable in prepared.motion.system.layout.variables}
    frames = np.vstack(kept)
    error = np.abs(frames[:, layout["energy_error"]]).max() / frames[:, layout["kinetic_energy"]].max()
    return 1e6 * best / finished.timing["steps"], finished.timing, float(error)


def evaluation_time(machine, coordinates: str) -> float:
    """µs of one evaluation."""
    prepared = prepare(methods_of(machine, "newton-euler", coordinates))
    from part import part

    evaluate = prepared.motion.kernels.evaluate

    @part
    def loop(address, y, out, repeats):
        for _ in range(repeats):
            evaluate(address, 0.0, y, out)

    y, out = prepared.start.copy(), np.zeros_like(prepared.start)
    y[:] += 1e-4
    return 1e-3 * measure(loop, prepared.motion.handle.address, y, out, repeats=2000)


def pendulum(folder: Path, modes: int, *, kind: str):
    """A bar on a hinge: rigid, or one of KINDS."""
    stiffening = kind == "stiffened"
    nodes = {"root": "[0, 0, 0]", "tip": "[2, 0, 0]"}
    path = beam_file(
        folder,
        f"bar{modes}{stiffening}",
        "rectangle, width: 0.02, height: 0.03",
        nodes,
        [("root", "tip")],
        14,
        stiffening,
    )
    neglect = ", neglect: [I5, I9]" if kind == "without I5 and I9" else ""
    body = f"{{flexible: {{file: {path}, modes: {modes}{neglect}}}}}"
    if kind == "rigid":
        body = "{mass: 9.42 kg, centre_of_mass: [1, 0, 0], inertia: [0.01, 3.14, 3.14]}"
    text = f"""
format: 1
bodies: {{bar: {body}}}
gravity: [0, -9.81, 0]
joints: {{hinge: {{type: revolute, bodies: [ground, bar], point: [0, 0, 0], axis: [0, 0, 1]}}}}
simulation: {{step: 1 ms, duration: 1}}
"""
    return loaded(folder, text)


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for coordinates in ("absolute", "relative"):
            rigid = evaluation_time(pendulum(folder, 20, kind="rigid"), coordinates)
            print(f"one evaluation of a bar on a hinge, {coordinates:9}: {rigid:5.2f} µs rigid; with 20 modes", end="")
            for kind in KINDS:
                flexible = evaluation_time(pendulum(folder, 20, kind=kind), coordinates)
                print(f", +{flexible - rigid:.2f} µs {kind}", end="")
            print()
        methods = sys.argv[1:] or ["ros2", "generalised-alpha"]
        for method in methods:
            for coordinates in ("absolute", "relative"):
                machine = crane(folder, integrator=method, coordinates=coordinates, stabilisation="direct")
                microseconds, _, error = run_time(machine)
                ratio = 1e6 * STEP / microseconds
                print(
                    f"crane, {method}, {coordinates:9}: {microseconds:8.1f} µs a step, {ratio:6.1f} × real time, energy error {error:.1e}"
                )


if __name__ == "__main__":
    main()
